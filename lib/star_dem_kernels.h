#ifndef KI_STAR_DEM_KERNELS_H
#define KI_STAR_DEM_KERNELS_H

#include <stdbool.h>
#include <stddef.h>

#include "star_kernels.h"

/* Private: the method of Dobkin, Eppstein and Mitchell, in these files:
 *
 *   star_dem.c        the partition of all corners into cells
 *   star_dem_cell.c   the best corners of a cell
 *
 * Corners are points of a dual space, in which a point of the set is an orthant:
 * the corners whose boxes it is in.  Relative to a cell of corners a point is,
 * along each axis, in (inside whatever the corner), out, or open.  The cells here
 * are so small that no point is open along two axes.  One that is open along a
 * single axis and in along the others is a slab: within the cell its orthant is
 * bounded by one plane.
 *
 * Open and closed boxes differ in a sign.  The volume of an open box is to be
 * great, and each slab that is in takes 1/n from its deviation; the volume of a
 * closed box is to be small, and each slab that is not in takes 1/n.  So a slab on
 * the wrong side is a loss, and with a first factor of 1 or -1, `sign`, a product
 * of sides is always to be great. */

/* One axis of a cell; there is one more behind the last, for its row alone. */
typedef struct ki_dem_axis {
    size_t slabs; /* points open along this axis */
    double *side; /* side[loss], loss <= slabs: the sides that there are, by what
                   * they cost; each is no worse than the one before */
    double *row;  /* row[sum], sum <= top: the greatest product of sign and sides of
                   * the axes before this one whose losses have that sum */
    size_t top;
    size_t loss, left; /* of a corner: its loss here, and here and before */
} ki_dem_axis;

typedef struct ki_dem_cell {
    ki_best *best;
    bool closed;
    double sign;
    double *rank;  /* rank[j] = j/n */
    size_t inside; /* points in along all axes */
    size_t slabs;  /* of all axes */
    double limit;  /* sign times the best side of every axis */
    ki_dem_axis *axis;
    double *corner; /* dim */
} ki_dem_cell;

/* Offer the best corners of the cell, with all that may tie, if they are above the
 * bar.  axis[k].slabs and .side, inside and limit describe the cell; the rest is
 * scratch.  Returns the number of products formed. */
double ki_dem_solve(ki_dem_cell *c);

#endif
