#ifndef KOKSMA_TESTS_EXACT_ORACLE_H
#define KOKSMA_TESTS_EXACT_ORACLE_H

#include "exact.h"
#include "l2.h"
#include "points.h"

/* The measures as their public headers define them, in integers that do not round:
 * any coordinates, few points.  Where oracle.h counts in 128 bits and takes coarse
 * coordinates in more than two dimensions, these take all 53 bits. */
enum { EXACT_POINTS = 32, EXACT_DIM = 4, EXACT_NUMBERS = EXACT_POINTS * EXACT_DIM };

/* Aborts where there are more. */
void exact_check(koksma_points p);

/* D*, over all corners that 0, 1 and the coordinates make: (n+2)^dim of them. */
exact_ratio exact_star(koksma_points p);

/* E, over all boxes between two of them. */
exact_ratio exact_box(koksma_points p);

/* D, over the lines through two points, and through one so that it halves the
 * chord; dim 2.  n^3 steps. */
exact_ratio exact_edge(koksma_points p);

/* L2^2, by the formula. */
exact_ratio exact_l2(koksma_points p, koksma_l2_kind kind);

/* vol - open/n or closed/n - vol of the box between lower (NULL: 0) and upper. */
exact_ratio exact_local(koksma_points p, const double *lower, const double *upper,
                        bool closed);

/* count/n - area of the closed half-plane left of from -> to. */
exact_ratio exact_half_plane(koksma_points p, const double *from, const double *to);

#endif
