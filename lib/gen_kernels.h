#ifndef KI_GEN_KERNELS_H
#define KI_GEN_KERNELS_H

#include "gen.h"
#include "num_wide.h"
#include "rng.h"

/* Private: what a family brings, and the arithmetic they share. */

/* Versions of a loop for wider vectors, with the same bits; for static functions.
 */
#ifdef HAVE_TARGET_CLONES
#define KI_GEN_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#define KI_GEN_FMA_CLONES                                                          \
    __attribute__((target_clones("avx512f", "fma", "default")))
#else
#define KI_GEN_CLONES
#define KI_GEN_FMA_CLONES
#endif
#define KI_GEN_INLINE static inline __attribute__((always_inline))

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

extern const ki_gen_kernel ki_gen_halton, ki_gen_hammersley, ki_gen_faure,
    ki_gen_sobol, ki_gen_niederreiter, ki_gen_richtmyer, ki_gen_rsequence,
    ki_gen_kronecker, ki_gen_lattice, ki_gen_korobov, ki_gen_fibonacci,
    ki_gen_zaremba, ki_gen_random, ki_gen_grid, ki_gen_centred, ki_gen_jittered,
    ki_gen_latin, ki_gen_multijittered, ki_gen_poisson;

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

/* The m with m^dim = n, or 0; and a refusal where it is 0. */
uint64_t ki_grid_side(const koksma_gen *g);
koksma_status ki_grid_check(koksma_gen *g, koksma_error *err);

/* The largest double not above r/p, 0 <= r < p < 2^127: always below 1. */
double ki_ratio(ki_u128 r, ki_u128 p);

/* A double holds every integer up to here, so that a division of two such
 * integers rounds once. */
#define KI_EXACT ((uint64_t)1 << 53)

/* Digit places at most: of 64 bits in base 2. */
enum { KI_DIGITS_MOST = 64 };

/* One coordinate in one base: plain, or with its digits scrambled. */
typedef struct ki_radical {
    uint32_t base;
    koksma_scramble how;   /* NONE, DIGITS, OWEN; others are as NONE */
    uint32_t *permutation; /* DIGITS: of digit place j at j*base */
    koksma_rng nested;     /* OWEN */
} ki_radical;

/* Digit places that any index below 2^64 needs in base b. */
unsigned ki_radical_digits(uint32_t base);

/* Draw the scrambling of r's base.  Returns 0, or -1 without memory. */
int ki_radical_scramble(ki_radical *r, koksma_scramble how, koksma_rng rng);

/* The number that has these digits behind the point, all that there are: plain, the
 * largest double not above it, otherwise scrambled and within two ulps. */
double ki_radical_value(const ki_radical *r, const uint32_t *digit,
                        unsigned digits);

/* (head + tail/tail_p)/p < 1, within two ulps and below 1. */
double ki_radical_join(uint64_t head, uint64_t p, uint64_t tail, uint64_t tail_p);

/* A leap with a factor in common with the base is refused. */
koksma_status ki_check_leap(uint64_t leap, uint32_t base, koksma_error *err);

/* Write the inverses of first, ..., first + count - 1 to x[0], x[stride], ... */
void ki_radical_fill(const ki_radical *r, double *x, size_t stride, uint64_t first,
                     size_t count);

/* The least prime not below `from`, by division; below 2^32 there has to be one. */
uint32_t ki_next_prime(uint32_t from);

uint64_t ki_gcd(uint64_t a, uint64_t b);

/* The fraction of the square root of a prime, cut off to 128 binary places. */
ki_u128 ki_root_fraction(uint32_t p);

/* The same of g, ..., g^dim for the g in (1/2,1) with g^dim + g^(dim+1) = 1. */
void ki_golden_powers(ki_u128 *alpha, size_t dim);

/* ---- Digital sequences in base 2 --------------------------------------------- */

enum { KI_BINARY_BITS = 64, KI_SOBOL_DIMS = 1111, KI_NIEDERREITER_DIMS = 1377 };

/* The direction numbers of coordinate k, counted from 0 and asked for in turn: v[j]
 * is what bit j of the Gray code of the index adds, the first binary place on top.
 */
typedef void ki_binary_directions(uint64_t v[KI_BINARY_BITS], size_t k,
                                  void *state);

koksma_status ki_binary_prepare(koksma_gen *g, ki_binary_directions *directions,
                                void *state, koksma_error *err);
void ki_binary_fill(const koksma_gen *g, double *x, uint64_t first, size_t count);
void ki_binary_release(void *state);

/* ---- Nested scrambling in base 2 --------------------------------------------- */

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
