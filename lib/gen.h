#ifndef KOKSMA_GEN_H
#define KOKSMA_GEN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "points.h"

/* Generators of point sets in [0,1)^dim: families, each a row of
 * koksma_gen_families.  A sequence is a family whose elements do not depend on how
 * many are asked for; it starts at index 0 unless told. */

/* What a family takes besides dim, n, shift and baker; the rest it refuses. */
typedef enum koksma_takes {
    KOKSMA_TAKES_START = 1,  /* start and leap: a sequence, and n only says where it
                              * stops */
    KOKSMA_TAKES_BASES = 2,  /* bases */
    KOKSMA_TAKES_DIGITS = 4, /* scrambling of digits, and nested scrambling */
    KOKSMA_TAKES_MATRIX = 8, /* scrambling by matrices */
    KOKSMA_TAKES_SEED = 16,  /* random even unscrambled: replicates differ */
    KOKSMA_TAKES_VECTOR = 32,
    KOKSMA_TAKES_ALPHA = 64,
    KOKSMA_TAKES_RADIUS = 128 /* radius and torus */
} koksma_takes;

typedef struct koksma_gen_family {
    const char *name;
    const char *summary;
    const char *needs; /* what must hold or be given, in words; "-": nothing */
    size_t max_dim;
    unsigned takes; /* koksma_takes, added up */
    const struct ki_gen_kernel *kernel;
} koksma_gen_family;

/* All families, ended by a row whose name is NULL. */
extern const koksma_gen_family koksma_gen_families[];

/* The family of that name, or NULL. */
const koksma_gen_family *koksma_gen_find(const char *name);

typedef enum koksma_scramble {
    KOKSMA_SCRAMBLE_NONE,
    /* Every digit place of every coordinate permuted at random; in base 2, the
     * digital shift. */
    KOKSMA_SCRAMBLE_DIGITS,
    /* Nested: permuted at random, depending on the digits before it [Owen 1995]. */
    KOKSMA_SCRAMBLE_OWEN,
    /* Digits times a random lower triangular matrix, then permuted [Matousek 1998].
     */
    KOKSMA_SCRAMBLE_MATRIX,
    /* Every coordinate plus a random number, modulo 1, cut off to a multiple of
     * 2^-53 [Cranley, Patterson 1976]. */
    KOKSMA_SCRAMBLE_SHIFT
} koksma_scramble;

typedef struct koksma_gen_opts {
    size_t dim;
    uint64_t n;     /* points in all: a grid's and Hammersley's depend on it */
    uint64_t start; /* index of the first point of a sequence */
    uint64_t leap;  /* from one index to the next; 0 means 1 */
    const uint32_t *bases;  /* pairwise coprime, >= 2: dim of them, for Hammersley
                             * dim - 1; NULL: the first primes */
    const uint64_t *vector; /* lattices: what generates them, dim numbers or, for
                             * Korobov's, 1 */
    size_t vector_size;
    const double *alpha; /* Kronecker: dim multipliers in [0, 2^53] */
    size_t alpha_size;
    double radius; /* Poisson: in (0,1], or 0 for as large as found */
    bool torus;    /* Poisson: distances go across the faces */
    koksma_scramble scramble;
    bool baker;         /* then fold: x becomes 1 - |2x - 1| [Hickernell 2002] */
    uint64_t seed;      /* fixes every bit, on every machine */
    uint64_t replicate; /* independent randomisations of one seed: 0, 1, ... */
} koksma_gen_opts;

typedef struct koksma_gen koksma_gen;

/* Prepare a generator.  It does not change afterwards: threads can share it.
 *
 * Digits.  Halton: coordinate k is the radical inverse of the index in base b_k,
 * the largest double not above it, never 1 [Halton 1960].  Digits scrambled: each
 * of the digit places, infinitely many zeros in front of the index included, has a
 * permutation of its own, drawn uniformly [Owen, Pan 2023 on its variance]; the
 * result, and that of nested scrambling, is within two ulps and below 1.  Van der
 * Corput: Halton in one dimension.  Hammersley: i/n, then Halton.  Faure: the least
 * prime base b >= dim, matrices C^k for k = 0, ..., dim-1 and Pascal's C, natural
 * order [Faure 1982]; rounded and scrambled as Halton.  Sobol': Gray-code order,
 * the direction numbers of [Joe, Kuo 2008], 64 binary places; scrambled, cut off to
 * a multiple of 2^-53, as random coordinates are.  Niederreiter: the same with the
 * matrices of [Bratley, Fox, Niederreiter 1994].  Zaremba: i/n, and the radical
 * inverse in base 2 with its places 2, 4, ... turned round, n = 2^m [Halton,
 * Zaremba 1969].
 *
 * Multiples.  Kronecker: i alpha_k mod 1 for an alpha cut off to 128 binary places,
 * and so within 2^-64 at any i, cut off to a multiple of 2^-53.  Richtmyer: alpha
 * the square roots of the first primes [Richtmyer 1951].  R-sequence: g, ..., g^dim
 * with g^dim + g^(dim+1) = 1 [Roberts 2018].  Lattice: i z_k/n mod 1, the largest
 * double not above it.  Korobov: z = 1, a, a^2, ... [Korobov 1959].  Fibonacci: n =
 * F_m and z = 1, F_(m-1).
 *
 * Cells.  Grid: {0..m-1}/m in each axis, n = m^dim, the last coordinate fastest.
 * Centred: {1/2..m-1/2}/m.  Jittered: uniform in cell i of the grid [Cook 1986].
 * Latin: each of n strata of each axis has one point, uniform in it, in an order
 * drawn uniformly for each axis [McKay, Beckman, Conover 1979].  Multi-jittered:
 * both, all such orders as likely [Chiu, Shirley, Wang 1994].  No rounding takes a
 * point out of its cell or stratum.
 *
 * Disks.  Poisson: random darts, of which those are kept that are not nearer than a
 * radius to one before.  Without a given radius it shrinks by 1/256 every n darts,
 * from where n balls of half of it are as dense as darts can get [McCool, Fiume
 * 1992; Torquato, Uche, Stillinger 2006].
 *
 * Folding makes of the 1 that it may come to the double below it.
 *
 * Returns: KOKSMA_OK; KOKSMA_EINVAL: dim out of the family's range, n = 0, too
 * large or not m^dim, 2^m, F_m, an index above 2^64 - 1, an option given to a
 *          family that does not take it, bases below 2 or with a common factor, a
 *          leap with a factor in common with a base, a vector of another length,
 *          fewer than n points found at the radius; KOKSMA_ENOMEM
 * Cost:    permutations of digits take 4 sum_k b_k ceil(64/log2 b_k) bytes;
 * sequences in base 2 take 0.7 kB a coordinate, and 2 kB more when nested; nested
 *          scrambling of a digit a in another base takes some a steps; latin and
 *          multi-jittered take 4 dim n bytes; Poisson takes 8 (dim + 1) n bytes and
 *          some tens of darts a point */
koksma_status koksma_gen_open(koksma_gen **out, const koksma_gen_family *family,
                              const koksma_gen_opts *opts, koksma_error *err);
void koksma_gen_close(koksma_gen *g); /* g may be NULL */

/* Write points first, ..., first + count - 1 of the opts.n into x, row after row:
 * room for count*dim doubles.  Reaching any index takes O(dim) steps.
 *
 * Returns: KOKSMA_OK; KOKSMA_EINVAL when first + count is above n */
koksma_status koksma_gen_fill(const koksma_gen *g, double *x, uint64_t first,
                              size_t count, koksma_error *err);

/* The base b of a digital sequence, of which b^m points are a net for every m; 0
 * for other families. */
uint32_t koksma_gen_net(const koksma_gen *g);

#endif
