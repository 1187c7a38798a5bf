#ifndef KOKSMA_VARIATION_H
#define KOKSMA_VARIATION_H

#include <stddef.h>
#include <stdint.h>

#include "integrand.h"
#include "num.h"
#include "points.h"

/* The variation of a function on [0,1]^dim in the sense of Hardy and Krause,
 * anchored at 1, as far as grids show it.
 *
 * A grid cuts the cube into boxes.  Delta(f; box) is the sum of f over its corners,
 * with a minus for every lower coordinate.  For a set u of axes let f_u be f as a
 * function of the coordinates in u, with all others at 1: f on a face.  Then
 *
 *     V(f; u)  =  sup over grids of  sum over boxes of |Delta(f_u; box)|   (Vitali)
 *     V_HK(f)  =  sum of V(f; u) over the 2^dim - 1 sets u that are not empty
 *
 * This is the variation of the Koksma-Hlawka inequality where D* is that of boxes
 * anchored at 0 [Niederreiter 1992, thm 2.11].
 *
 * What a grid gives is a lower bound of V_HK, up to rounding, and no grid gives an
 * upper one.  A grid whose last nodes are not at 1 gives a lower bound too: what
 * lies beyond them only adds.  Grids of k = 2, 4, 8, ... cells an axis are nested,
 * so V_k never falls, and how it grows is what says whether it ends.  Exact are
 * V_k of a function that is linear in each coordinate within the cells, and in one
 * dimension V of sampled data: the sum of |f_(i+1) - f_i|.
 *
 * A difference of 2^m values below 2^(m-52) of the largest value beside it counts
 * as 0 where m >= 2: there rounding speaks. */

enum { KOKSMA_VARIATION_DIM_MOST = 16, KOKSMA_VARIATION_LEVELS_MOST = 48 };

/* ---- Results ----------------------------------------------------------------- */

/* V_k of one grid.  Where every cell was looked at lower = upper = value and level
 * is 1; of random cells lower and upper are an interval, or NaN with level 0 where
 * those that matter may be too rare among them. */
typedef struct koksma_variation_level {
    size_t cells; /* k: of the axis that has the most */
    koksma_estimate value;
} koksma_variation_level;

/* What V_k does, by the last two of its rates log2(V_2k/V_k), p and then q:
 *   diverging  p, q > 1/4 and q >= p - 0.05
 *   converged  |p|, |q| < 0.01: two doublings, since a kink between two nodes or a
 *              peak that is not on a node may hide from one
 *   undecided  otherwise; and where there are fewer than three grids
 * The rates of random cells count with their intervals, and are converged where
 * these lie in [-0.05, 0.05].  A smooth ramp diverges until a cell is narrower than
 * it is: the trend holds up to k, and is no proof.  q near dim - 1 is what a jump
 * does, near dim - 2 a kink. */
typedef enum koksma_trend {
    KOKSMA_TREND_UNDECIDED,
    KOKSMA_TREND_CONVERGED,
    KOKSMA_TREND_DIVERGING
} koksma_trend;

typedef struct koksma_variation_result {
    koksma_variation_level level[KOKSMA_VARIATION_LEVELS_MOST];
    size_t levels; /* >= 1, unless stopped before; the last has the finest grid */
    koksma_trend trend;
    double rate; /* q; NaN where there is one grid, or V_k is 0 */
    double work; /* values of the function */
} koksma_variation_result;

/* ---- Of an integrand --------------------------------------------------------- */

typedef enum koksma_variation_method {
    KOKSMA_VARIATION_AUTO,     /* see below */
    KOKSMA_VARIATION_GRID,     /* every node */
    KOKSMA_VARIATION_BOUNDARY, /* by f's range, only cells in which f varies */
    KOKSMA_VARIATION_RANDOM    /* random cells */
} koksma_variation_method;

typedef struct koksma_variation_opts {
    koksma_variation_method method;
    size_t cells;   /* k of the finest grid, a power of 2; 0: by the method */
    double samples; /* of f, for a grid of random cells; 0: 2^22 */
    uint64_t seed;
    /* Called every few thousand values, with V_k of the finest grid that is done, or
     * 0, as both ends, and the values so far.  Where it is there, GRID takes some of
     * the coarser grids before one of more than 2^16 nodes, to have something when it
     * is stopped: at most a third more values.  NULL: never. */
    koksma_progress *progress;
    void *state; /* handed to progress */
} koksma_variation_opts;

#define KOKSMA_VARIATION_DEFAULTS                                                  \
    {                                                                              \
        KOKSMA_VARIATION_AUTO, 0, 0.0, 1, NULL, NULL                               \
    }

/* The variation of f on grids of 2, 4, ..., k cells an axis.
 *
 * AUTO takes BOUNDARY up to dim 4 where f's range is constant on most boxes, and
 * else GRID up to 2^24 cells (above dim 4 up to 2^20, or none where that has more
 * than 2^23 nodes); above dim 4, or where k asks for more cells than that, RANDOM
 * for the grids beyond.
 *
 * BOUNDARY halves boxes of cells until f's range on a box, half a cell wider, is
 * one number.  It assumes that f goes on as it is inside up to the cube's faces,
 * and checks that at the corners of the boxes there.
 *
 * RANDOM draws faces and cells of each order, the number of axes, in proportion to
 * what a first eighth of the samples shows of their spread.  The interval at 95 %
 * is that of the mean of many; there is none where fewer than 30 of one order
 * differ from 0, since what is that rare may not have been met.
 *
 * Out:     out
 *          faces  V(f; u) on the finest grid, at the number in which bit j says
 *                 that axis j is in u: room for 2^dim; NULL: not wanted; not
 *                 filled when stopped
 * Returns: KOKSMA_OK; KOKSMA_STOPPED when progress said so: out has the grids that
 *          are done, and may have none; KOKSMA_EINVAL: dim is 0 or above
 *          KOKSMA_VARIATION_DIM_MOST, k is no power of 2 from 2 to 2^24, a grid
 *          of more than 2^40 nodes, BOUNDARY without a range; KOKSMA_EDOMAIN: a
 *          value that is not finite; KOKSMA_ENOMEM
 * Cost:    GRID (k+1)^dim values and 2 dim (k+1)^dim steps, memory (k+1)^(dim-1);
 *          BOUNDARY some 2^dim values a boundary cell and face, memory dim^2 log k;
 *          RANDOM `samples` a grid
 * Source:  [Szirmay-Kalos, Purgathofer 1998, (7), (8)], with all faces */
koksma_status koksma_variation(koksma_variation_result *out, koksma_estimate *faces,
                               const koksma_integrand *f,
                               const koksma_variation_opts *opts,
                               koksma_error *err);

/* ---- Of values on a grid ----------------------------------------------------- */

/* The values come one after the other, the last axis fastest.  Where the nodes are
 * does not matter.  The coarser grids have every second node, every fourth and so
 * on, and the last. */
typedef struct koksma_variation_grid koksma_variation_grid;

/* In:      nodes  how many each axis has, at least 2; dim numbers
 * Returns: KOKSMA_OK; KOKSMA_EINVAL: dim or an axis out of range; KOKSMA_ENOMEM
 * Cost:    memory: three layers of the grid, each all nodes at one place of the
 *          first axis */
koksma_status koksma_variation_open(koksma_variation_grid **out,
                                    const size_t *nodes, size_t dim,
                                    koksma_error *err);
void koksma_variation_close(koksma_variation_grid *g); /* g may be NULL */

/* Returns: KOKSMA_OK; KOKSMA_EDOMAIN naming the node of a value that is not finite;
 *          KOKSMA_EINVAL: more values than nodes.  After a failure only close g. */
koksma_status koksma_variation_add(koksma_variation_grid *g, const double *values,
                                   size_t count, koksma_error *err);

/* Returns: KOKSMA_OK; KOKSMA_EINVAL: fewer values than nodes; KOKSMA_EDOMAIN: the
 *          differences leave the range of a double */
koksma_status koksma_variation_finish(koksma_variation_result *out,
                                      koksma_estimate *faces,
                                      const koksma_variation_grid *g,
                                      koksma_error *err);

/* The same of n values f[i] at points of a grid, in any order.
 *
 * Returns: as above, and as koksma_points_check; KOKSMA_EINVAL: the points are not
 *          the grid of their coordinates, each once, or that has one node on some
 *          axis
 * Cost:    dim n log n; memory dim n */
koksma_status koksma_variation_points(koksma_variation_result *out,
                                      koksma_estimate *faces, koksma_points p,
                                      const double *f, koksma_error *err);

/* What `levels` say by themselves: fills trend and rate. */
void koksma_variation_judge(koksma_variation_result *r);

#endif
