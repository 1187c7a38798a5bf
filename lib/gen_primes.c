#include "error.h"
#include "gen_kernels.h"

/* What the generators know of whole numbers. */

uint64_t ki_gcd(uint64_t a, uint64_t b)
{
    while (b > 0) {
        uint64_t rest = a % b;

        a = b;
        b = rest;
    }
    return a;
}

/* Such a leap would leave out whole intervals. */
koksma_status ki_check_leap(uint64_t leap, uint32_t base, koksma_error *err)
{
    if (leap < 2 || ki_gcd(leap, base) == 1) return KOKSMA_OK;
    return ki_fail(err, KOKSMA_EINVAL, 0,
                   "leap %ju and base %ju have a common factor", (uintmax_t)leap,
                   (uintmax_t)base);
}

static bool is_prime(uint32_t p)
{
    for (uint64_t d = 2; d * d <= p; d++)
        if (p % d == 0) return false;
    return p > 1;
}

uint32_t ki_next_prime(uint32_t from)
{
    while (!is_prime(from))
        from++;
    return from;
}
