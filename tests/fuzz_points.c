/* libFuzzer target: whatever bytes arrive, as points or values they are read as
 * check_sets wants it. */
#include "fuzz_sets.h"

/* The first byte says what the others are. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    if (size == 0) return 0;
    check_sets(bytes + 1, size - 1, bytes[0] == 'v' ? KOKSMA_VALUES : KOKSMA_POINTS,
               1 + bytes[0] % 7);
    return 0;
}
