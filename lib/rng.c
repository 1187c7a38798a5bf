#include "rng.h"

#include "rng_kernels.h"

koksma_rng koksma_rng_seed(uint64_t seed, uint64_t stream)
{
    /* Hashed twice, with a step between, so that neither (seed, stream) and
     * (stream, seed) nor neighbouring seeds meet. */
    return (koksma_rng){
        ki_rng_hash(ki_rng_hash(seed + KI_RNG_STEP) + stream * KI_RNG_STEP)};
}

uint64_t koksma_rng_next(koksma_rng *r)
{
    return ki_rng_hash(r->counter += KI_RNG_STEP);
}

void koksma_rng_skip(koksma_rng *r, uint64_t steps)
{
    r->counter += steps * KI_RNG_STEP;
}

double koksma_rng_unit(koksma_rng *r)
{
    return ki_rng_fraction(koksma_rng_next(r));
}

uint64_t koksma_rng_below(koksma_rng *r, uint64_t n)
{
    /* Values below 2^64 mod n would make small results too likely. */
    uint64_t reject = -n % n, v;

    do
        v = koksma_rng_next(r);
    while (v < reject);
    return v % n;
}
