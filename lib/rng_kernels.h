#ifndef KI_RNG_KERNELS_H
#define KI_RNG_KERNELS_H

#include "num_wide.h"
#include "rng.h"

/* Private: the generator of rng.h in the open, for loops that take millions of
 * values, or the value at any place. */

/* The odd integer nearest to 2^64 over the golden ratio: successive counters
 * are far apart in every leading bit. */
#define KI_RNG_STEP 0x9E3779B97F4A7C15u

/* The finaliser "mix64 variant 13" of [Steele, Lea, Flood 2014]: a bijection of 64
 * bits. */
static inline uint64_t ki_rng_hash(uint64_t z)
{
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/* The value that koksma_rng_next returns after i others. */
static inline uint64_t ki_rng_at(koksma_rng r, uint64_t i)
{
    return ki_rng_hash(r.counter + (i + 1) * KI_RNG_STEP);
}

/* One of 0, ..., n-1 from 64 random bits; each is too likely or not likely enough
 * by at most one part in 2^64/n. */
static inline uint64_t ki_rng_scale(uint64_t bits, uint64_t n)
{
    return (uint64_t)((ki_u128)bits * n >> 64);
}

/* The first 53 of 64 binary places behind the point. */
static inline double ki_rng_fraction(uint64_t bits)
{
    return (double)(int64_t)(bits >> 11) * 0x1p-53;
}

#endif
