#ifndef KI_BOX_SWEEP_KERNELS_H
#define KI_BOX_SWEEP_KERNELS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "box_kernels.h"

/* Private: the sweep of the plane, in these files:
 *
 *   box_kinetic.c   the best interval of y, kept while a strip of x widens
 *   box_strip.c     all good boxes of one strip
 *   box_sweep.c     which strips, in which order, by which thread
 *   box_line.c      the line, which is one strip
 *
 * All in units of points: a strip of width w has the weight W = n w, and an
 * interval of length l with c points the excess c - W l (closed boxes) or W l - c
 * (open). */

/* An amount of excess: a weight and a length, amount[0] + W * amount[1]. */
typedef double ki_amount __attribute__((vector_size(16)));
typedef int64_t ki_mask __attribute__((vector_size(16)));

/* The points of some consecutive places in the order of y, each with the gap above
 * it: the excess of all, and the best of what begins at the lower end, of what ends
 * at the upper end, and of any interval; these are right for the W that they were
 * found for, and as long as W stays below `until`. */
typedef struct ki_span_best {
    ki_amount all, first, last, any;
    double until;
} ki_span_best;

/* A binary tree of such, node[1] at the top; place i is node[places + i]. */
typedef struct ki_kinetic {
    bool closed;
    size_t places; /* a power of two */
    const double *gap;
    ki_span_best *node;
    double work; /* nodes found anew */
} ki_kinetic;

/* y: coordinates of n points in increasing order; gap has room for `places`
 * numbers, and place i < n will be y's, place n the face y = 0; see
 * ki_kinetic_places. */
size_t ki_kinetic_places(size_t n);
void ki_kinetic_gaps(double *gap, size_t places, const double *y, size_t n);

/* Begin with the points that are there, by their y-ranks, at any W. */
void ki_kinetic_start(ki_kinetic *t, const bool *there, size_t n, double W);

/* Put in the point at y-rank i (0, ..., n - 1), at a W no less than before. */
void ki_kinetic_insert(ki_kinetic *t, size_t i, double W);

/* The greatest excess of an interval, or 0, at a W no less than before. */
double ki_kinetic_best(ki_kinetic *t, double W);

/* What all these roundings may take from it: less than this a point. */
#define KI_KINETIC_SLACK 0x1p-42

/* Points in the order of y: their last coordinate and, if dim is 2, the other. */
typedef struct ki_column {
    size_t n, dim;
    const double *x, *y;
} ki_column;

/* Room for a strip: n + 2 numbers and n + 3 counts. */
typedef struct ki_strip_room {
    double *level;
    size_t *passed;
} ki_strip_room;

/* The distinct coordinates y of the points in a strip, between those of the faces
 * for open boxes, and passed[i]: the points below level i, so that there are
 * passed[i + 1] - passed[i] on it.  left, right: its sides, which the points of a
 * closed box may lie on; not read if dim is 1.  Returns how many levels there
 * are. */
size_t ki_strip_levels(const ki_column *c, double left, double right, bool closed,
                       const ki_strip_room *room);

/* Offer all boxes of a strip of the plane that may be better than what the run
 * knows, or tie with it. */
void ki_strip_offer(ki_run *run, const ki_column *c, double left, double right,
                    bool closed, const ki_strip_room *room);

/* All of dim 1. */
ki_box_kernel ki_box_line;

#endif
