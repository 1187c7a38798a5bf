#ifndef KOKSMA_CELLS_H
#define KOKSMA_CELLS_H

#include <stddef.h>
#include <stdint.h>

#include "integrand.h"
#include "num.h"
#include "points.h"

/* How large the discontinuity of an integrand is, as quasi-Monte Carlo meets it.
 *
 * Of a grid with k cells along each axis, K are boundary cells: the inside of the
 * cell meets the discontinuity.  N points, one a cell, have M = N V of them in
 * boundary cells, of the volume V = K/k^dim; and where the discontinuity has an
 * extent l, the integral of |n|_1 over it or the sum of its projected areas A_j,
 * K is about l k^(dim-1), so that V is about l N^(-1/dim) [Szirmay-Kalos,
 * Purgathofer 1998].  K/k^(dim-1), the digital extent, is less than l where
 * surfaces run through the corners of the cells, or along their faces: x+y = 1 has
 * the extent 2 and in every grid the digital extent 1. */

/* ---- Grids ------------------------------------------------------------------- */

/* A grid for n points: cells along each axis, their product at most n.
 *
 * Out:     cells  dim of them
 * In:      bases  NULL: the same number along each axis, floor(n^(1/dim)), exactly.
 *                 Else powers of these, pairwise coprime: elementary intervals, of
 *                 which the powers minimise (mean side / geometric mean of the
 *                 sides) (n/product)^((dim-1)/2dim), the first factor being by how
 *                 much they inflate l at the most and the second the loss by cells
 *                 that are larger than need be
 * Returns: KOKSMA_OK; KOKSMA_EINVAL: n or dim is 0; or bases are below 2 or have a
 *          common factor, or dim is above KOKSMA_GRID_BASES_MOST
 * Cost:    dim log n; with bases at most one step a product of their powers */
enum { KOKSMA_GRID_BASES_MOST = 15 };
koksma_status koksma_grid_choose(uint64_t *cells, uint64_t n, size_t dim,
                                 const uint32_t *bases, koksma_error *err);

/* ---- Counting, where f says how its discontinuity lies to boxes -------------- */

/* Numbers of cells.  Of what was stopped, lower is counted and upper could still
 * be; otherwise they are equal. */
typedef struct koksma_cell_count {
    uint64_t total;        /* of all cells */
    uint64_t lower, upper; /* K */
    uint64_t touched;      /* cells whose faces alone it meets: where they are not
                              few, it is aligned with the grid */
    double work;           /* boxes looked at */
} koksma_cell_count;

typedef struct koksma_cells_opts {
    uint64_t ratio;            /* of the k of one scale to the next; 0: 2 */
    koksma_progress *progress; /* gets K so far and at most, and the work */
    void *state;
} koksma_cells_opts;

/* Count the boundary cells of a grid: boxes of cells that the discontinuity meets
 * are halved until they are cells.
 *
 * In:      f      with meets; with range alone, corners are rounded to doubles,
 *                 which is exact for powers of 2 below 2^53, and nothing is touched
 *          cells  along each axis, their product below 2^64
 * Returns: KOKSMA_OK; KOKSMA_EINVAL: f has neither, or the product is 0 or too
 *          large; KOKSMA_ENOMEM; KOKSMA_STOPPED
 * Cost:    2 to 6 boxes a cell met; memory for dim + 64 boxes */
koksma_status koksma_cells_count(koksma_cell_count *out, const koksma_integrand *f,
                                 const uint64_t *cells,
                                 const koksma_cells_opts *opts, koksma_error *err);

/* The slope of log K against log k: a box dimension at these scales. */
typedef struct koksma_cell_slope {
    double value; /* NaN from fewer than three scales, or where some K is 0 */
    double bend;  /* slope of the finer half less that of the coarser half: the
                     line is no fit where this is not small against 1 */
    size_t scales;
} koksma_cell_slope;

/* The slope over grids whose k is the one for n, and then each time 1/ratio of it,
 * as far as 2 cells along every axis and at most KOKSMA_SLOPE_SCALES of them.  Sets
 * that are made by dividing cells into ratio^dim are counted at their own scales,
 * k = ratio^j, without what their larger pieces add at others.
 *
 * In:      first  the count in the grid for n; NULL: not known yet
 * Returns: as koksma_grid_choose and koksma_cells_count
 *          KOKSMA_EINVAL: a ratio of 1
 * Cost:    about that of counting in the first, or twice that */
enum { KOKSMA_SLOPE_SCALES = 6 };
koksma_status koksma_cells_slope(koksma_cell_slope *out, const koksma_integrand *f,
                                 uint64_t n, const uint32_t *bases,
                                 const koksma_cell_count *first,
                                 const koksma_cells_opts *opts, koksma_error *err);

/* ---- Random lines, for any f ------------------------------------------------- */

typedef struct koksma_lines_opts {
    size_t lines;     /* along each axis, and as many in all directions: 1000 */
    size_t steps;     /* a line has: 64 */
    double tolerance; /* the least jump, in terms of the range of f: 1e-3 */
    double level;     /* of the intervals: 0.95 */
    uint64_t seed;
    koksma_progress *progress; /* gets the extent so far, as both numbers, and the
                                  evaluations */
    void *state;
} koksma_lines_opts;
#define KOKSMA_LINES_DEFAULTS                                                      \
    {                                                                              \
        1000, 64, 1e-3, 0.95, 1, NULL, NULL                                        \
    }

typedef struct koksma_lines_result {
    koksma_estimate extent; /* l, the sum of the A_j */
    koksma_estimate area;   /* S */
    double jump;            /* the largest met, in absolute value */
    double jump_rms;        /* over the area */
    size_t axes;            /* how many of the A_j are not 0: d_u is at most that */
    koksma_cell_slope slope; /* dim - 1 and how fast the jumps that are seen become
                                more with shorter steps */
    size_t lines;            /* of each kind */
    double least_jump;       /* what is less was taken for no jump */
    double work;             /* evaluations */
} koksma_lines_result;

/* Measure the discontinuity of f, of which only the value is looked at, by where
 * random lines cross it.
 *
 * Lines parallel to axis j cross it A_j times in the mean, and lines that are
 * uniform among all that meet the cube S/dim times (Crofton).  On each line, steps
 * over which f changes by more than the tolerance are halved 40 times, into the
 * half with the larger change; what then still changes by that much is a jump, and
 * the rest of its step is looked at again.  A slope, however steep, is taken for a
 * jump only if it rises so much within 2^-40 of the line; two jumps within one step
 * that cancel each other are missed.  The range is that of f at 4096 random points
 * and on the lines so far.
 *
 * The intervals are Student's, from the differences between lines.  Where all
 * lines of a kind cross equally often, they allow for what happens on too few
 * lines to have been seen, and are wider by -log((1 - level)/2)/lines.
 *
 * Out:     axes  A_j, dim of them; NULL: not wanted
 * Returns: KOKSMA_OK; KOKSMA_EINVAL: an option out of its range (lines from 2 to
 *          2^32, steps from 1 to 2^20, tolerance and level between 0 and 1);
 *          KOKSMA_EDOMAIN: f is not finite somewhere; KOKSMA_ENOMEM;
 *          KOKSMA_STOPPED: the result of the lines so far, if there are two or more
 * Cost:    (dim + 1) lines (steps + 1 + 40 jumps) evaluations, and a few for every
 *          step that is steep */
koksma_status koksma_lines(koksma_lines_result *out, koksma_estimate *axes,
                           const koksma_integrand *f, const koksma_lines_opts *opts,
                           koksma_error *err);

/* ---- Samples, where there is no f to ask ------------------------------------- */

typedef struct koksma_samples_result {
    uint64_t total, empty; /* cells, and those without a sample */
    uint64_t pairs;        /* neighbours along an axis, both with a sample */
    uint64_t changes;      /* pairs that differ by more than the jump */
    koksma_estimate extent;
    double jump_rms; /* of the changes */
    double bias;     /* by which their number was divided */
} koksma_samples_result;

/* Guess the extent from values at points: the first point in each cell, against
 * those in the neighbouring cells.
 *
 * Where a smooth surface is flat over two cells, neighbours along the axes lie on
 * both sides of it more often than l says, by a factor that depends on its
 * direction n: the sum over j of E|n.(e_j + U - U')| / |n|_1, where U, U' are
 * uniform in the unit cube.  For directions that are uniform on the sphere this is
 * E|e_1 + U - U'| on the mean, 1.09, 1.17, 1.24 in two, three, four dimensions,
 * which is divided out.  The factor is never below 1 or above 1 + (dim - 1)/3, and
 * the interval is that of both, with two standard deviations of the number of
 * changes, as if they were independent.  It says nothing of what is curved within
 * a few cells.  Pairs with an empty cell are taken to be like the others.
 *
 * In:      p, f   the points and their values
 *          cells  along each axis
 *          jump   differences above it count
 * Returns: KOKSMA_OK; KOKSMA_EINVAL: jump is negative or NaN, or the cells are 0 or
 *          too many; or no two neighbours have samples; as koksma_points_check;
 *          KOKSMA_ENOMEM
 * Cost:    n + dim cells; 8 bytes a cell */
koksma_status koksma_samples(koksma_samples_result *out, koksma_points p,
                             const double *f, const uint64_t *cells, double jump,
                             koksma_error *err);

/* ---- How many points the cells have ------------------------------------------ */

typedef struct koksma_occupancy {
    uint64_t total, empty;
    uint64_t least, most; /* points in a cell */
} koksma_occupancy;

/* A point is in cell floor(x_k cells_k) along axis k, computed exactly, or in the
 * last one if x_k is 1.
 *
 * Doubles are not the numbers that they stand for: a radical inverse that is a
 * multiple of 1/b^m is rounded, and may be in the cell below.  The second function
 * therefore takes the first n elements, from index `start` on, of the Halton
 * sequence in these bases, and decides by their digits.
 *
 * Returns: KOKSMA_OK; KOKSMA_EINVAL: the cells are 0 or 2^32 or more, and so for
 *          the points; a base is below 2, or start + n above 2^64; as
 *          koksma_points_check; KOKSMA_ENOMEM
 * Cost:    n dim; with digits n dim log n; 4 bytes a cell */
koksma_status koksma_cells_occupancy(koksma_occupancy *out, koksma_points p,
                                     const uint64_t *cells, koksma_error *err);
koksma_status koksma_cells_occupancy_halton(koksma_occupancy *out, uint64_t start,
                                            uint64_t n, size_t dim,
                                            const uint32_t *bases,
                                            const uint64_t *cells,
                                            koksma_error *err);

#endif
