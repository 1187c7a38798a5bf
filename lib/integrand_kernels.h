#ifndef KI_INTEGRAND_KERNELS_H
#define KI_INTEGRAND_KERNELS_H

#include "integrand.h"

/* Private: the rows of koksma_integrands, each in the file of its kernel, and
 * what those files share. */

/* integrand_sum.c */
extern const koksma_integrand_row ki_row_f2, ki_row_f3, ki_row_halfspace,
    ki_row_simplex, ki_row_mixture, ki_row_sum;

/* integrand_product.c */
extern const koksma_integrand_row ki_row_product, ki_row_product_peak,
    ki_row_gaussian, ki_row_continuous, ki_row_discontinuous;

/* integrand_wave.c, _box.c, _ball.c, _koch.c, _fractal.c */
extern const koksma_integrand_row ki_row_oscillatory, ki_row_corner_peak,
    ki_row_box, ki_row_ball, ki_row_koch, ki_row_fractal2, ki_row_fractal3;

/* Where there is no jump: one piece, zeros, and NaN for the rest. */
koksma_facts ki_facts_smooth(double integral, double error);

/* A set of that measure, and the (dim-1)-measures of its boundary in the cube. */
koksma_facts ki_facts_indicator(double measure, double error, double area,
                                double extent, size_t dim);

/* The piece of what has one, and of what is 1 in one of its two and 0 in the
 * other. */
size_t ki_piece_only(const koksma_integrand *f, const double *x);
size_t ki_piece_by_value(const koksma_integrand *f, const double *x);

/* Where there is no discontinuity. */
koksma_meeting ki_meets_nothing(const koksma_integrand *f,
                                const koksma_cell_box *box);

/* That of the indicator of [0,c]^axes x [0,1]^(dim-axes). */
koksma_meeting ki_meets_corner(double c, size_t axes, const koksma_cell_box *box);

/* Whether there are as many cells along each axis. */
static inline bool ki_cubes(const koksma_cell_box *box, size_t dim)
{
    bool same = true;

    for (size_t k = 1; k < dim; k++)
        same &= box->cells[k] == box->cells[0];
    return same;
}

/* The common unit of a box's coordinates, 1/unit, in cells a coordinate. */
static inline uint64_t ki_common_unit(const koksma_cell_box *box, size_t dim)
{
    uint64_t unit = box->cells[0];
    bool cubes = ki_cubes(box, dim);

    for (size_t k = 1; k < dim && !cubes; k++)
        unit *= box->cells[k];
    return unit;
}

/* integrand_spline.c: the sum s of dim uniform numbers, dim <= KI_SUM_DIM_MOST.
 * All are off by no more than 8 (dim + 2) DBL_EPSILON, relatively. */
enum { KI_SUM_DIM_MOST = 31 };

/* b[i] = f_n(x - i), i = 0, ..., n, where f_n is the density of n of them. */
void ki_sum_densities(double *b, double x, size_t n);

/* P(s > t), and the covariance of s and [s > t]; 0 <= t <= dim. */
double ki_sum_share_above(double t, size_t dim);
double ki_sum_covariance(double t, size_t dim);

#endif
