#ifndef KI_GEN_KERNELS_H
#define KI_GEN_KERNELS_H

#include "gen.h"
#include "rng.h"

/* Private: what a family brings, and the arithmetic they share. */

/* Versions of a loop over integers for wider vectors. */
#ifdef HAVE_TARGET_CLONES
#define KI_GEN_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define KI_GEN_CLONES
#endif
#define KI_GEN_INLINE static inline __attribute__((always_inline))

__extension__ typedef unsigned __int128 ki_u128;

struct koksma_gen {
    const koksma_gen_family *family;
    koksma_gen_opts opts; /* its arrays are the caller's: only prepare reads them */
    void *state;          /* the kernel's */
    uint32_t net;         /* what koksma_gen_net returns; prepare sets it */
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

/* What coordinate k draws from. */
koksma_rng ki_gen_stream(const koksma_gen *g, uint64_t k);

/* x[0], x[stride], ... are the first 53 of the 64 binary places of bits. */
void ki_fractions(double *x, size_t stride, const uint64_t *bits, size_t count);

/* The same of the values of r from now on, side by side. */
void ki_random_fractions(double *x, koksma_rng r, size_t count);

/* The coordinates of count points plus the random shift, and count numbers
 * folded. */
void ki_gen_shift(const koksma_gen *g, double *x, size_t count);
void ki_gen_fold(double *x, size_t count);

/* The options against what the family takes. */
koksma_status ki_gen_check(const koksma_gen_family *f, const koksma_gen_opts *o,
                           koksma_error *err);

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
int ki_radical_permute(ki_radical *r, koksma_rng rng);

/* Write the inverses of first, ..., first + count - 1 to x[0], x[stride], ... */
void ki_radical_fill(const ki_radical *r, double *x, size_t stride, uint64_t first,
                     size_t count);

/* ---- Digital sequences in base 2 -----------------------------------------------
 */

enum { KI_BINARY_BITS = 64, KI_SOBOL_DIMS = 1111 };

/* The direction numbers of coordinate k, counted from 0: v[j] is what bit j of the
 * Gray code of the index adds, the first binary place on top. */
typedef void ki_binary_directions(uint64_t v[KI_BINARY_BITS], size_t k);

koksma_status ki_binary_prepare(koksma_gen *g, ki_binary_directions *directions,
                                koksma_error *err);
void ki_binary_fill(const koksma_gen *g, double *x, uint64_t first, size_t count);
void ki_binary_release(void *state);

/* ---- Nested scrambling in base 2 ------------------------------------------------
 */

/* The scrambling of one coordinate: its random bits, and what they flip on the way
 * to each node of depth KI_OWEN_DEPTH, zeros behind it. */
enum { KI_OWEN_DEPTH = 8, KI_OWEN_RUN = 1 << KI_OWEN_DEPTH };
typedef struct ki_owen {
    koksma_rng r;
    uint64_t top[KI_OWEN_RUN];
} ki_owen;

void ki_owen_init(ki_owen *o, koksma_rng r);

/* Scramble all 64 binary places of count <= KI_OWEN_RUN numbers.  Several times as
 * fast if the places behind the first KI_OWEN_DEPTH are the same in all, as they
 * are in a block of a sequence whose first d places, for every d, take all values
 * in any 2^d elements. */
void ki_owen_scramble(const ki_owen *o, uint64_t *y, size_t count);

#endif
