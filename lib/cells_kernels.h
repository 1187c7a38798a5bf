#ifndef KI_CELLS_KERNELS_H
#define KI_CELLS_KERNELS_H

#include "cells.h"
#include "rng.h"

/* Private: what the files of cells share. */

/* Powers of pairwise coprime bases for n points, as koksma_grid_choose says. */
void ki_grid_powers(uint64_t *cells, uint64_t n, size_t dim, const uint32_t *bases);

/* The product of the cells; 0 if it is 0 or not below 2^64. */
uint64_t ki_grid_total(const uint64_t *cells, size_t dim);

/* The slope of log count against log k, and its bend; k falls.  The halves share
 * the scale in the middle of an odd number. */
koksma_cell_slope ki_slope(const double *k, const double *count, size_t scales);

/* The cell, from 0, that x is in, the last coordinate fastest. */
uint64_t ki_cell_of(const double *x, size_t dim, const uint64_t *cells);

/* A line in the cube: start + t way, 0 <= t <= length. */
typedef struct ki_line {
    double *start, *way; /* dim numbers each */
    double length;
} ki_line;

/* Uniform among those parallel to an axis, and among all that meet the cube; room
 * is for dim + 3 numbers. */
void ki_line_along(ki_line *line, size_t dim, size_t axis, koksma_rng *rng);
void ki_line_across(ki_line *line, size_t dim, double *room, koksma_rng *rng);

#endif
