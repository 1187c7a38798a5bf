#ifndef KOKSMA_RNG_H
#define KOKSMA_RNG_H

#include <stdint.h>

/* Random bits that a seed fixes, on every machine: SplitMix64, a counter whose
 * every value is hashed on its own, so that any element is reached in O(1)
 * [Steele, Lea, Flood 2014].  The state lives with the caller. */
typedef struct koksma_rng {
    uint64_t counter;
} koksma_rng;

/* The generator of a seed and a stream.  Streams of one seed (replicates,
 * coordinates) start at hashed places of one period of 2^64. */
koksma_rng koksma_rng_seed(uint64_t seed, uint64_t stream);

/* The next 64 bits. */
uint64_t koksma_rng_next(koksma_rng *r);

/* Pass over `steps` values in O(1). */
void koksma_rng_skip(koksma_rng *r, uint64_t steps);

/* Uniform on the 2^53 multiples of 2^-53 in [0,1). */
double koksma_rng_unit(koksma_rng *r);

/* Uniform on 0, ..., n-1, without bias; n >= 1.  Takes one value or, with a
 * chance below n/2^64 each time, one more. */
uint64_t koksma_rng_below(koksma_rng *r, uint64_t n);

#endif
