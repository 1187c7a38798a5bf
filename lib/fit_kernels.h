#ifndef KI_FIT_KERNELS_H
#define KI_FIT_KERNELS_H

#include "fit.h"

/* Private: errors in a grid, one row an N, in increasing order, one column a
 * replicate, and the linear functionals of ln rms that the fits are made of. */
typedef struct ki_grid {
    size_t rows, sets;
    double *n;      /* rows */
    double *square; /* rows*sets: e^2 over the largest e^2; NaN: none */
    double largest; /* |e|, in the window */
    size_t missing, zero, below_floor;
} ki_grid;

/* Check the data and put those of the window into the grid, without the rows that
 * koksma_fit leaves out.  ki_grid_free undoes it, also after a failure. */
koksma_status ki_grid_fill(ki_grid *g, koksma_fit_data d, const koksma_fit_opts *o,
                           koksma_error *err);
void ki_grid_free(ki_grid *g);

/* log_rms[i*(sets+1) + r]: ln of the root mean square of row i without replicate r,
 * and of the whole row for r = sets, in units of the largest error. */
void ki_grid_log_rms(double *log_rms, const ki_grid *g);

/* The same for groups: replicate r belongs to group r mod groups. */
void ki_grid_log_rms_groups(double *log_rms, const ki_grid *g, size_t groups);

/* Least squares as fixed weights: slope = sum slope[i]*y[i], and so on.  u = ln n
 * is centred at `centre`. */
typedef struct ki_weights {
    double *slope, *bend, *log_power; /* rows each */
    double centre;
    double log_power_of_inverse; /* what log_power[] makes of y = ln 1/n */
    bool has_log_power;
} ki_weights;

/* Returns false when the N's are so close that there is no slope. */
bool ki_weights_fill(ki_weights *w, const ki_grid *g);

/* values[groups] is what all data give, values[g] what they give without group g:
 * the jackknife's estimate; no interval for one group. */
koksma_fit_term ki_jackknife(const double *values, size_t groups, double level);

/* y_i = c + 1/2 ln( n_i^(2s) + exp(2b) n_i^-2 (ln n_i)^log ), -1 <= s <= 0, by
 * least squares, log 0 or 1; y[0], y[stride], ... belong to n[0], n[1], ..., all n
 * above 1.  Without the first term s is -1. */
typedef struct ki_mixture {
    double s, b, c, log;
    bool has_first, has_second;
} ki_mixture;

ki_mixture ki_mixture_fit(const double *n, const double *y, size_t stride,
                          size_t rows, double log);

/* The n from which on the first term is the larger; 0: it always is, HUGE_VAL:
 * never. */
double ki_mixture_cross(const ki_mixture *m);

#endif
