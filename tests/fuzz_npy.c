/* libFuzzer target: arrays of which the framing is right, so that what is tried is
 * the rest of their headers and their numbers.  They are read as check_sets wants
 * it, also one after the other. */
#include "fuzz_npy.h"
#include "fuzz_sets.h"

/* The first byte says what the numbers are, and the second how many arrays the
 * others are cut into. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    char *file;
    size_t length;

    if (size < 2) return 0;
    length = npy_of(&file, bytes + 2, size - 2, 1 + bytes[1] % 3);
    check_sets((const uint8_t *)file, length,
               bytes[0] == 'v' ? KOKSMA_VALUES : KOKSMA_POINTS, 1 + bytes[0] % 7);
    free(file);
    return 0;
}
