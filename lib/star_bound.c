#include <float.h>
#include <math.h>

#include "star_kernels.h"

/* Linear bounds of the volumes [0,z) in a cell, for tree_bound.c.
 *
 * Places are logarithms.  Let t = sum_k log z_k, so that the volume is e^t.
 *
 * Open boxes: over the volumes that matter e^t, being convex, lies below a line,
 * e^t <= V - s (t_high - t), with V the volume at `high` and a slope s no more than
 * that of the chord.
 *
 * Closed boxes: for any g > 0, e^t >= g (1 + t - log g), the tangent.
 *
 * Rounding.  Let A = sum_k |log low_k|, computed, and assume of libm that log is
 * good to 2^-51 of itself (koksma(7) says so, a test checks it).  Then every
 * difference of logarithms is off by less than 2^-50 A, slope included 2^-50 s A.
 * Each term of the bound takes four roundings, each sum over the axes one an axis,
 * all of numbers below dim + 1 + s A: together less than (dim + 1) (dim + 2 + s A)
 * 2^-51.  pad() is twice that and covers both. */
static double pad(size_t dim, double slope_times_logs)
{
    double d = (double)dim;

    return (d + 1.0) * (d + 2.0 + slope_times_logs) * 0x1p-50;
}

/* The volumes at the ends of a cell, their logarithms, and A. */
typedef struct extent {
    double volume_low, volume_high, log_low, log_high, logs;
} extent;

static extent extent_of(const ki_worker *w, const ki_cell *c)
{
    extent x = {1.0, 1.0, 0.0, 0.0, 0.0};

    for (size_t k = 0; k < w->ranks->dim; k++) {
        const ki_axis *axis = &w->ranks->axis[k];

        x.volume_low *= axis->value[c->low[k]];
        x.volume_high *= axis->value[c->high[k]];
        x.log_low += axis->place[c->low[k]];
        x.log_high += axis->place[c->high[k]];
    }
    x.logs = -x.log_low;
    return x;
}

/* The slope of a line through (t_high, V) that stays above e^t on the volumes
 * that matter: those from E on.  The chord's is (V - E)/(log V - log E); less is
 * safe.  Below a width of 2^-10 the computed chord could err by more than its own
 * part, and the slope at its lower end, E, serves: it is nearly the same.  Above,
 * the difference V - E is good to dim 2^-41 of itself and the width to A 2^-40. */
static double chord_slope(extent x, double least, size_t dim)
{
    double low = fmax(least, x.volume_low), width;
    double safe = 1.0 - (x.logs + (double)dim + 2.0) * 0x1p-38;

    if (!(safe > 0.0) || !(low > 0.0) || low >= x.volume_high) return 0.0;
    width = x.log_high - (low > x.volume_low ? log(low) : x.log_low);
    if (width < 0x1p-10) return low * safe;
    return (x.volume_high - low) / width * safe;
}

static void same_slope(ki_worker *w, double slope)
{
    for (size_t k = 0; k < w->ranks->axes; k++)
        w->slope[k] = slope;
}

static void open_line(ki_worker *w, const ki_cell *c, double target, uint32_t round,
                      ki_slopes *line)
{
    size_t dim = w->ranks->dim;
    double inside = (double)c->inside / (double)w->ranks->n, slope;
    extent x;

    if (round > 0) return;
    x = extent_of(w, c);
    line->quick = x.volume_high - inside + pad(dim, 0.0);
    if (line->quick < target) return;
    /* A corner above the target has a volume above target + inside. */
    slope = chord_slope(x, (target + inside) * (1.0 - 0x1p-50), dim);
    line->margin = pad(dim, slope * x.logs);
    line->base = x.volume_high;
    same_slope(w, slope);
}

/* The logarithm of the volume of the corner that was found best. */
static double log_of_best(const ki_worker *w)
{
    double sum = 0.0;

    for (size_t k = 0; k < w->ranks->axes; k++)
        sum += w->ranks->axis[k].place[w->best_rank[k]];
    return sum;
}

/* A corner above the target has a volume below most - target.  The tangent touches
 * between there and the volume at `low`, nearer to the former; then nearer and
 * nearer to the volumes of the corners found best. */
static void closed_line(ki_worker *w, const ki_cell *c, double target,
                        uint32_t round, ki_slopes *line)
{
    double most = (double)c->within / (double)w->ranks->n;
    extent x = extent_of(w, c);
    double slope, touch;

    if (round == 0) {
        double greatest = fmin(most - target, x.volume_high);

        line->quick = most - x.volume_low + pad(w->ranks->dim, 0.0);
        if (line->quick < target) return;
        line->at = x.log_low;
        if (greatest > x.volume_low) line->at += 0.65 * (log(greatest) - x.log_low);
    } else {
        line->at += (log_of_best(w) - line->at) / (round + 1);
    }
    slope = fmax(exp(line->at), DBL_MIN); /* any slope above 0 makes a bound */
    touch = log(slope);
    line->margin = pad(w->ranks->dim, slope * (x.logs - touch + 1.0));
    line->base = slope * (1.0 + x.log_low - touch);
    same_slope(w, slope);
}

const ki_measure ki_star_measure = {true, open_line, closed_line};
