#ifndef KI_L2_KERNELS_H
#define KI_L2_KERNELS_H

#include <stdbool.h>
#include <stdint.h>

#include "l2.h"
#include "num_twice.h"
#include "part.h"

/* Private: what the methods of the L2 discrepancies share. */

/* Versions of a loop for wider vectors, with the same bits: no operation is fused
 * that the source does not fuse. */
#ifdef HAVE_TARGET_CLONES
#define KI_L2_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#define KI_L2_FMA_CLONES __attribute__((target_clones("avx512f", "fma", "default")))
#else
#define KI_L2_CLONES
#define KI_L2_FMA_CLONES
#endif
#define KI_L2_INLINE static inline __attribute__((always_inline))

/* Coordinates between 0 and this are taken for it by the kinds whose k vanishes
 * there; ki_l2_flushed says what that costs. */
#define KI_L2_LEAST 0x1p-200

/* The number (m.hi + m.lo) 2^e, off by at most err 2^e. */
typedef struct ki_l2_number {
    ki_twice m;
    double err;
    int64_t e;
} ki_l2_number;

/* x with its mantissa in [1/2, 1) or 0. */
ki_l2_number ki_l2_normal(ki_l2_number x);
/* The sum, and the product with a power of two. */
ki_l2_number ki_l2_add(ki_l2_number a, ki_l2_number b);
ki_l2_number ki_l2_scale(ki_l2_number a, int64_t e);
/* x / n, n < 2^53. */
ki_l2_number ki_l2_divide_by(ki_l2_number x, double n);

/* A row of the table of kinds. */
typedef struct ki_l2_row {
    double numerator, denominator; /* c, of k without the factor below */
    int sign;   /* of c^dim in the sum: -1 where h is constant, else 1 */
    int twos;   /* k has a factor 2^twos, which is left out of it and of c */
    int arrays; /* numbers a coordinate that pairs works with */
    int ulps;   /* k from these is off by at most so many times 2^-53, relatively */
    int chunk;  /* so many factors multiply without leaving [2^-900, 2^900] */
    int terms;  /* of divide, besides its core: l2_terms.c */
} ki_l2_row;
extern const ki_l2_row ki_l2_rows[KOKSMA_L2_KINDS];

/* A set as the kernels take it. */
typedef struct ki_l2_job {
    koksma_points p;
    koksma_l2_kind kind;
    const ki_l2_row *row;
    ki_team *team;
    const koksma_l2_opts *opts;
    double work; /* under the team's lock */
} ki_l2_job;

/* A task has ended after so much work: report. */
void ki_l2_report(ki_l2_job *job, double work);

/* sum_i h(x_i), and c^dim. */
ki_l2_number ki_l2_linear(koksma_points p, koksma_l2_kind kind);
ki_l2_number ki_l2_constant(koksma_l2_kind kind, size_t dim);
/* A bound of what taking small coordinates for KI_L2_LEAST changes. */
ki_l2_number ki_l2_flushed(koksma_points p, koksma_l2_kind kind);

/* sum_i sum_j K(x_i,x_j), without the factors 2^twos.  KOKSMA_OK, also where the
 * team was stopped, or KOKSMA_ENOMEM. */
typedef koksma_status ki_l2_method(ki_l2_number *sum, ki_l2_job *job);
ki_l2_method ki_l2_pairs;
ki_l2_method ki_l2_divide;
/* The most coordinates that it takes. */
size_t ki_l2_divide_dim(koksma_l2_kind kind);

/* What pairs does at once: a block of rows against a panel of columns.  A panel
 * holds KI_L2_PANEL points, for each coordinate so many first numbers and, where
 * the kind has arrays == 2, so many second ones.  A block is up to KI_L2_BLOCK
 * panels. */
enum { KI_L2_PANEL = 64, KI_L2_BLOCK = 4 };

/* The numbers of coordinate x. */
void ki_l2_prepare(koksma_l2_kind kind, double x, double number[2]);

typedef struct ki_l2_tile {
    const double *rows, *columns; /* panels; of columns one */
    size_t row_count, column_count, dim;
    int64_t e; /* where scaled, the result is in units of 2^e */
    bool scaled;
} ki_l2_tile;
typedef ki_twice ki_l2_tile_sum(const ki_l2_tile *t);
extern ki_l2_tile_sum *const ki_l2_tile_sums[KOKSMA_L2_KINDS];

/* K(x,x) for a point of a panel, in some doubles' precision. */
ki_l2_number ki_l2_diagonal(koksma_l2_kind kind, const double *panel, size_t i,
                            size_t dim);

#endif
