#include <math.h>

#include "box_kernels.h"

/* Linear bounds of the volumes of the boxes in a cell, for tree_bound.c.
 *
 * Let w_k = b_k - a_k be the widths of a box of the cell, h_k those of its largest
 * box, at `high`, and l_k those of its smallest, or 0 where that is crossed: a
 * crossed box has no points and does not matter.  So 0 <= l_k <= w_k <= h_k.
 *
 * Open boxes: the volume bounded from above.  Let V = prod h_k, and u_k = w_k/h_k
 * for the m coordinates where the widths vary, so that vol = V prod u_k.  The
 * geometric mean of the u_k is at most their mean y, so vol <= V y^m; and y^m,
 * being convex, lies on [z,1] below its chord 1 - (1 + z + ... + z^(m-1)) (1 - y),
 * for any z <= y.  As 1 - y = sum (1 - u_k)/m,
 *
 *     vol  <=  V - sum_k s_k (h_k - w_k),
 *     s_k  =  (V/h_k) (1 + z + ... + z^(m-1))/m.
 *
 * Which z?  A box that matters has a volume of at least some E, hence u_k >= E/V as
 * the others are at most 1: y is at least the mean of max(l_k/h_k, E/V), and also
 * at least (E/V)^(1/m), being no less than the geometric mean.
 *
 * Closed boxes: the volume bounded from below, by two lines, of which we take the
 * mean.  With w_k = l_k + (w_k - l_k) the product has no negative terms, so
 *
 *     vol  >=  prod l_k + sum_k (w_k - l_k) prod_{j/=k} l_j ;
 *
 * and prod (1 - x_k) >= 1 - sum x_k for 0 <= x_k <= 1 [Weierstrass], so
 *
 *     vol  >=  prod h_k - sum_k (h_k - w_k) prod_{j/=k} h_j .
 *
 * Here h_k may be less than the width of the largest box: one that matters has a
 * volume below some F, and w_k is its volume over the other widths.
 *
 * A width grows with both of its sides, h_k - w_k = (a_k - a_high) + (b_high -
 * b_k): so either line is a sum over the axes, with places -a and b.
 *
 * Rounding.  Coordinates are doubles, so each difference of places rounds once, and
 * no number here or in the terms of the bound is above 1 in absolute value.  A
 * product of widths takes less than axes roundings, a slope some more, base a sum
 * of axes such numbers, each term of the bound four roundings, and each sum over
 * the axes one an axis: less than (axes + 1) (axes + 2) 2^-51 in all.  pad() is
 * twice that. */
static double pad(size_t axes)
{
    double d = (double)axes;

    return (d + 1.0) * (d + 2.0) * 0x1p-50;
}

/* The width of the smallest box, negative if it is crossed, and of the largest. */
static double least_width(const ki_worker *w, const ki_cell *c, size_t k)
{
    const ki_ranks *r = w->ranks;
    size_t upper = r->dim + k;

    return r->axis[upper].value[c->low[upper]] - r->axis[k].value[c->low[k]];
}

static double greatest_width(const ki_worker *w, const ki_cell *c, size_t k)
{
    const ki_ranks *r = w->ranks;
    size_t upper = r->dim + k;

    return r->axis[upper].value[c->high[upper]] - r->axis[k].value[c->high[k]];
}

static double product(const double *x, size_t dim, size_t but)
{
    double product = 1.0;

    for (size_t k = 0; k < dim; k++)
        if (k != but) product *= x[k];
    return product;
}

/* A number z >= 0 with z^m <= v, and hardly less than the greatest, 0 <= v <= 1.
 * pow is not trusted: what it says is tried. */
static double root_below(double v, size_t m)
{
    double z = (m == 2 ? sqrt(v) : pow(v, 1.0 / (double)m)) * (1.0 - 0x1p-40);
    double power = 1.0;

    for (size_t i = 0; i < m; i++)
        power *= z;
    return power * (1.0 + (double)m * 0x1p-52) <= v ? z : 0.0;
}

/* (1 + z + ... + z^(m-1))/m, or slightly less: a smaller slope is a bound too. */
static double mean_power(double z, size_t m)
{
    double sum = 1.0;

    for (size_t i = 1; i < m; i++)
        sum = 1.0 + z * sum;
    return sum / (double)m * (1.0 - (double)(m + 4) * 0x1p-50);
}

/* Slopes for boxes with at least `least` of the largest box's volume, `most`; high
 * holds the h_k, of which none is 0. */
static void open_slopes(ki_worker *w, const ki_cell *c, const double *high,
                        double most, double least)
{
    size_t dim = w->ranks->dim, varying = 0;
    double ratio = fmin(fmax(least / most, 0.0) * (1.0 - 0x1p-40), 1.0);
    double mean = 0.0, z, power;

    for (size_t k = 0; k < dim; k++) {
        double low = least_width(w, c, k);

        if (low == high[k]) continue;
        mean += fmax(low / high[k], ratio);
        varying++;
    }
    if (varying == 0) varying = 1;
    mean = mean / (double)varying * (1.0 - (double)(varying + 4) * 0x1p-50);
    z = fmin(fmax(mean, root_below(ratio, varying)), 1.0);
    power = mean_power(z, varying) * most;
    for (size_t k = 0; k < dim; k++)
        w->slope[k] = w->slope[dim + k] = fmin(power / high[k], 1.0);
}

static void open_line(ki_worker *w, const ki_cell *c, double target, uint32_t round,
                      ki_slopes *line)
{
    size_t dim = w->ranks->dim;
    double inside = (double)c->inside / (double)w->ranks->n, most;
    double *high = w->best_term; /* free until the terms are known */

    if (round > 0) return;
    for (size_t k = 0; k < dim; k++) {
        high[k] = fmax(greatest_width(w, c, k), 0.0);
        w->slope[k] = w->slope[dim + k] = 0.0;
    }
    most = product(high, dim, dim);
    line->margin = pad(w->ranks->axes);
    line->quick = most - inside + line->margin;
    line->base = most;
    /* A box above the target has a volume above target + inside. */
    if (line->quick >= target && most > 0.0)
        open_slopes(w, c, high, most, target + inside);
}

/* low and high hold the l_k and h_k.  Where the smallest box is crossed its sides
 * are not w_k - l_k = 0 apart, but the width of that box less. */
static void closed_slopes(ki_worker *w, const ki_cell *c, const double *low,
                          const double *high, ki_slopes *line)
{
    size_t dim = w->ranks->dim;

    line->base = 0.5 * (product(low, dim, dim) + product(high, dim, dim));
    for (size_t k = 0; k < dim; k++) {
        double by_low = product(low, dim, k), by_high = product(high, dim, k);
        double slope = 0.5 * (by_low + by_high);

        line->base -= 0.5 * by_high * (high[k] - low[k]);
        line->base += slope * (least_width(w, c, k) - low[k]);
        w->slope[k] = w->slope[dim + k] = slope;
    }
}

static void closed_line(ki_worker *w, const ki_cell *c, double target,
                        uint32_t round, ki_slopes *line)
{
    size_t dim = w->ranks->dim;
    double most = (double)c->within / (double)w->ranks->n, volume;
    double *low = w->best_term,
           *high = low + dim; /* free until the terms are known */

    if (round > 0) return;
    for (size_t k = 0; k < dim; k++) {
        low[k] = fmax(least_width(w, c, k), 0.0);
        high[k] = fmax(greatest_width(w, c, k), 0.0);
    }
    volume = product(low, dim, dim);
    line->margin = pad(w->ranks->axes);
    line->quick = most - volume + line->margin;
    if (line->quick < target) return;
    /* A box above the target has a volume below most - target. */
    for (size_t k = 0; k < dim; k++) {
        double others = product(low, dim, k);
        double width = fmax(most - target, 0.0) * (1.0 + 0x1p-40) + line->margin;

        if (width < high[k] * others) high[k] = fmax(width / others, low[k]);
    }
    closed_slopes(w, c, low, high, line);
}

const ki_measure ki_box_measure = {false, open_line, closed_line};
