#ifndef KOKSMA_INTEGRAND_H
#define KOKSMA_INTEGRAND_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "num.h"
#include "points.h"

/* Integrands on [0,1]^dim.  The measures take a koksma_integrand, which a program
 * fills in for one of its own; koksma_integrands is a table of those whose
 * integral, discontinuity and variation are known. */

/* ---- An integrand ------------------------------------------------------------ */

/* What a function does on a box.  value contains what it returns at every point
 * strictly inside; cut says whether the discontinuity meets the inside. */
typedef struct koksma_range {
    koksma_interval value;
    bool cut;
} koksma_range;

/* A box of cells: in each coordinate k from lower[k]/cells[k] to
 * upper[k]/cells[k], lower < upper <= cells.  The product of the cells is below
 * 2^64. */
typedef struct koksma_cell_box {
    const uint64_t *lower, *upper, *cells;
} koksma_cell_box;

/* How a box lies to the discontinuity inside the cube, or rather to its closure. */
typedef enum koksma_meeting {
    KOKSMA_APART,   /* they have no point in common */
    KOKSMA_TOUCHES, /* points of the box's faces alone */
    KOKSMA_CUTS     /* points of its inside */
} koksma_meeting;

enum { KOKSMA_PARAMS_MOST = 6, KOKSMA_DERIVED_MOST = 8 };

/* A function, its dimension, and what it computes with.  value alone is needed;
 * NULL stands for what is not known.  Functions get the struct itself, and may be
 * called from several threads.
 *
 *   value   f at x, dim coordinates in [0,1]
 *   piece   the number, from 0, of the smooth part that x is in; two points with
 *           a jump between them have different ones
 *   range   what f does on the box with those corners, lower < upper in all
 *           coordinates
 *   meets   how the discontinuity lies to a box of cells, whose corners need not be
 *           doubles
 *
 *     static double disc(const koksma_integrand *f, const double *x)
 *     {
 *         return hypot(x[0], x[1]) < *(const double *)f->state;
 *     }
 *     koksma_integrand f = {.dim = 2, .value = disc, .state = &radius}; */
typedef struct koksma_integrand {
    size_t dim;
    double (*value)(const struct koksma_integrand *f, const double *x);
    size_t (*piece)(const struct koksma_integrand *f, const double *x);
    koksma_range (*range)(const struct koksma_integrand *f, const double *lower,
                          const double *upper);
    koksma_meeting (*meets)(const struct koksma_integrand *f,
                            const koksma_cell_box *box);
    const void *state;                   /* the caller's */
    double param[KOKSMA_PARAMS_MOST];    /* in the order of its row */
    double derived[KOKSMA_DERIVED_MOST]; /* what its row makes of them */
} koksma_integrand;

/* out[i] = f at point i.
 *
 * Returns: KOKSMA_OK; KOKSMA_EINVAL when p.dim is not f's; as koksma_points_check
 */
koksma_status koksma_integrand_eval(double *out, const koksma_integrand *f,
                                    koksma_points p, koksma_error *err);

/* ---- What is known of one ---------------------------------------------------- */

/* NaN stands for what is not known.  Infinity is proven.  Where there is no jump,
 * jump, area, extent and axes are 0. */
typedef struct koksma_facts {
    double integral;  /* over [0,1]^dim */
    double error;     /* it is off by no more than that: 0 where it is exact */
    double variance;  /* of f at a uniform point */
    double jump;      /* the largest absolute value on the discontinuity */
    double jump_rms;  /* its root mean square over the area */
    double area;      /* S, of the discontinuity inside the cube */
    double extent;    /* l, the sum over the axes of its projected areas */
    double axes;      /* d_u, the most coordinates that a smooth part of the
                         discontinuity depends on */
    double box_dim;   /* box dimension of the discontinuity: dim - 1 unless it is
                         a fractal */
    double pieces;    /* how many */
    double variation; /* Hardy and Krause's, anchored at 1 */
} koksma_facts;

/* ---- The table --------------------------------------------------------------- */

typedef enum koksma_param_kind {
    KOKSMA_CLOSED, /* a number of [least, most] */
    KOKSMA_OPEN,   /* a number strictly between */
    KOKSMA_WHOLE   /* a whole number of [least, most] */
} koksma_param_kind;

typedef struct koksma_param {
    const char *name;
    double usual, least, most;
    koksma_param_kind kind;
} koksma_param;

/* Of f = smooth part + part with the jump. */
typedef enum koksma_part { KOKSMA_PART_SMOOTH, KOKSMA_PART_JUMP } koksma_part;

/* Sums, s = x_1 + ... + x_dim:
 *
 *     f2            a s + (1 - 2a) [s > 1]            dim 2, 0 <= a <= 1/2
 *     f3            a s + (0.6 - 1.8a) [s > 1]        dim 3, 0 <= a <= 1/3
 *     halfspace     [s > c dim]                       c dim rounded
 *     simplex       [s <= 1]
 *     mixture       2a s/dim + 2(1 - a) [s > dim/2]
 *     sum           s
 *
 * f2 and f3 are (13) and (14) of [Szirmay-Kalos, Purgathofer 1998]; they integrate
 * to 1/2, and mixture to 1, whatever a is, which moves weight from the jump to
 * the smooth part.  Products over the coordinates of
 *
 *     product       x
 *     box           [x <= c]
 *     product-peak  1 / (1/c^2 + (x - w)^2)
 *     gaussian      exp(-c^2 (x - w)^2)
 *     continuous    exp(-c |x - w|)
 *     discontinuous exp(c x) [x <= w] in the first two, exp(c x) in the others
 *
 * and, the last four being with these the families of [Genz 1984],
 *
 *     oscillatory   cos(2 pi w + c s)
 *     corner-peak   (1 + c s)^-(dim+1)
 *
 * Shapes:
 *
 *     ball          [|x - (1/2,...,1/2)| <= r]
 *     koch          1 inside of Koch's snowflake: an equilateral triangle round
 *                   (1/2,1/2) with that side, one facing the angle turn - pi/2,
 *                   whose sides grow smaller triangles for ever
 *     fractal2, fractal3
 *                   in each cell of a 5^dim grid m subcells, drawn at random, are
 *                   divided again and so on; half of the others, rounded down,
 *                   are in (1), and the rest out (0).  pattern is the seed
 *
 * On which side of its discontinuity a point lies is decided exactly for the sums,
 * the products and the ball, for the doubles given (the ball: where no square
 * underflows); for koch up to some 1e-15; the fractals take coordinates down to
 * multiples of 2^-61. */
typedef struct koksma_integrand_row {
    const char *name;
    const char *summary;
    size_t dim;                              /* the usual one */
    size_t dim_least, dim_most, dim_step;    /* dim_least + i dim_step */
    koksma_param params[KOKSMA_PARAMS_MOST]; /* ended by a NULL name */
    koksma_integrand functions;              /* value, piece, range, meets */
    void (*prepare)(koksma_integrand *f);    /* fills derived; may be NULL */
    void (*facts)(koksma_facts *out, const koksma_integrand *f);
    void (*split)(koksma_integrand *f, koksma_facts *facts, koksma_part part);
} koksma_integrand_row; /* split may be NULL */

/* All rows, ended by NULL. */
extern const koksma_integrand_row *const koksma_integrands[];

/* The row of that name, or NULL. */
const koksma_integrand_row *koksma_integrand_find(const char *name);

/* How many parameters a row has. */
size_t koksma_integrand_params(const koksma_integrand_row *row);

/* Make an integrand of a row.
 *
 * Out:     f      complete; nothing to free
 *          facts  NULL: not wanted
 * In:      dim    0 means the usual one
 *          param  as many as the row has, in its order; NULL: the usual ones
 * Returns: KOKSMA_OK; KOKSMA_EINVAL: not a dim of this row; KOKSMA_EDOMAIN: a
 *          parameter out of its range */
koksma_status koksma_integrand_make(koksma_integrand *f, koksma_facts *facts,
                                    const koksma_integrand_row *row, size_t dim,
                                    const double *param, koksma_error *err);

/* Make f, which was made of that row, one of the two parts that it is the sum of.
 *
 * The smooth part of a sum is a multiple of s, and the rest steps from one constant
 * to another.  What is constant on each piece has the smooth part 0, and so has
 * discontinuous, which varies on the one side and is 0 on the other; what does not
 * jump is its own smooth part.  Neither part depends on how many points there are.
 *
 * In/out:  f, facts  as koksma_integrand_make left them */
void koksma_integrand_split(koksma_integrand *f, koksma_facts *facts,
                            const koksma_integrand_row *row, koksma_part part);

#endif
