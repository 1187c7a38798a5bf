#include "l2_kernels.h"

const char *const koksma_l2_names[KOKSMA_L2_KINDS] = {
    "star",       "extreme", "periodic", "centered",
    "wraparound", "mixture", "symmetric"};

/* Roundings of k from the numbers that l2_tile.c keeps (u = 2^-53):
 *
 *   star       1-x rounds once, and monotonely, so that the min of rounded numbers
 *              is the rounded min: 1.
 *   extreme    the same for 1-x, and the product: 2.
 *   symmetric  min(x,y) + min(1-x,1-y): 1-x, and the sum of numbers >= 0: 2.
 *   centered   min(a,a') + min(q,q') with a = 1 + max(x-1/2,0), q = max(1/2-x,0),
 *              where a = 1 or q = 0.  x-1/2 is off by u/4 at most (exact from 1/4
 *              on), a sum in [1,3/2] by u: below 2.
 *   periodic   1/4 + r^2, r = |x-y| - 1/2.  |x-y| is off by u/2 at most, which 1/2
 *              and more are; from 1/4 to 1 the subtraction is exact, below it adds
 *              u/4 to the u/8 of so small a |x-y|.  So r is off by u/2, r^2 by
 *              |r| u + r^2 u, and the sum by u relatively: (|r| + r^2)/(1/4 + r^2)
 *              <= 3/2, in all 5/2 u: below 3.
 *   wraparound 5/4 + r^2: (|r| + r^2)/(5/4 + r^2) <= 1/2, in all 3/2 u: below 2.
 *   mixture    (g + g') + s (s/2 - 3/4), g = 15/16 - t/4, s = |x-y|: g is off by
 *              u/2 + u/16, the sum by u, s by u/2, s/2 - 3/4 by u/4 + u/2, the
 *              product by 3/4 u/2 + 3/4 u + u/4, the last sum by u: at most 4.6 u,
 *              where k >= 11/8: below 4.
 *
 * Second-order terms are far smaller than what is left in each case.
 *
 * Least factors above 0, and greatest, for `chunk`: star 2^-53 (1-x exact near 1);
 * extreme 2^-253, symmetric 2^-200, with coordinates no less than KI_L2_LEAST; the
 * others lie between 1/4 and 2. */
const ki_l2_row ki_l2_rows[KOKSMA_L2_KINDS] = {
    [KOKSMA_L2_STAR] = {1, 3, 1, 0, 1, 1, 16, 0},
    [KOKSMA_L2_EXTREME] = {1, 12, 1, 0, 2, 2, 3, 0},
    [KOKSMA_L2_PERIODIC] = {1, 3, -1, 0, 1, 3, 64, 3},
    [KOKSMA_L2_CENTERED] = {13, 12, 1, 0, 2, 2, 64, 0},
    [KOKSMA_L2_WRAPAROUND] = {4, 3, -1, 0, 1, 2, 64, 3},
    [KOKSMA_L2_MIXTURE] = {19, 12, 1, 0, 2, 4, 64, 3},
    [KOKSMA_L2_SYMMETRIC] = {2, 3, 1, 1, 2, 2, 4, 2},
};
