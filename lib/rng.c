#include "rng.h"

/* The odd integer nearest to 2^64 over the golden ratio: successive counters
 * are far apart in every leading bit. */
static const uint64_t STEP = 0x9E3779B97F4A7C15u;

/* The finaliser "mix64 variant 13" of the paper: a bijection of 64 bits. */
static uint64_t hash(uint64_t z)
{
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

koksma_rng koksma_rng_seed(uint64_t seed, uint64_t stream)
{
    /* Hashed twice, with a step between, so that neither (seed, stream) and
     * (stream, seed) nor neighbouring seeds meet. */
    return (koksma_rng){hash(hash(seed + STEP) + stream * STEP)};
}

uint64_t koksma_rng_next(koksma_rng *r) { return hash(r->counter += STEP); }

void koksma_rng_skip(koksma_rng *r, uint64_t steps) { r->counter += steps * STEP; }

double koksma_rng_unit(koksma_rng *r)
{
    return (double)(koksma_rng_next(r) >> 11) * 0x1p-53;
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
