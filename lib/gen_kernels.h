#ifndef KI_GEN_KERNELS_H
#define KI_GEN_KERNELS_H

#include "gen.h"
#include "num_wide.h"

/* Private: what a family brings, and the arithmetic they share. */

struct koksma_gen {
    const koksma_gen_family *family;
    koksma_gen_opts opts; /* its bases are the caller's: only prepare reads them */
    void *state;          /* the kernel's */
};

typedef struct ki_gen_kernel {
    /* Check what is the family's own and fill g->state; may be NULL. */
    koksma_status (*prepare)(koksma_gen *g, koksma_error *err);
    /* Write `count` points from index `first` on. */
    void (*fill)(const koksma_gen *g, double *x, uint64_t first, size_t count);
    void (*release)(void *state); /* may be NULL: free */
} ki_gen_kernel;

extern const ki_gen_kernel ki_gen_halton, ki_gen_hammersley, ki_gen_sobol,
    ki_gen_random, ki_gen_grid, ki_gen_centred;

/* The largest double not above r/p, 0 <= r < p < 2^127: always below 1. */
double ki_ratio(ki_u128 r, ki_u128 p);

/* One coordinate in one base: radical inverses, plain or with permuted digits. */
typedef struct ki_radical {
    uint32_t base;
    uint32_t *permutation; /* of digit place j at j*base; NULL: plain */
} ki_radical;

/* Digit places that any index below 2^64 needs in base b. */
unsigned ki_radical_digits(uint32_t base);

/* Draw the permutations of r's base.  Returns 0, or -1 without memory. */
int ki_radical_permute(ki_radical *r, uint64_t seed, uint64_t stream);

/* Write the inverses of first, ..., first + count - 1 to x[0], x[stride], ... */
void ki_radical_fill(const ki_radical *r, double *x, size_t stride, uint64_t first,
                     size_t count);

#endif
