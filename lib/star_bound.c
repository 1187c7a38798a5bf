#include <float.h>
#include <math.h>

#include "error.h"
#include "star_tree_kernels.h"

/* What the corners of a cell can hold at most: a bound that is a sum of one term
 * an axis, so that its maximum is found axis by axis.
 *
 * Let t = sum_k log z_k, so that the volume is e^t, and u_j = 1 if a point is
 * inside along axis j and 0 if not: it is in the box when all u_j are 1.
 *
 * Open boxes, vol - count/n.  Over the volumes that matter e^t, being convex, lies
 * below a line: e^t <= V - s (t_high - t), with V the volume at `high` and a slope
 * s no more than that of the chord.  And AND(u) >= w (1 - sum_j (1 - u_j)) for any
 * weight w in [0,1]: a point counts along each axis where it is open.
 *
 * Closed boxes, count/n - vol.  For any g > 0, -e^t <= -g (1 + t - log g), the
 * tangent; and AND(u) <= u_j for any one axis j: a point is charged to one.
 *
 * Either way the bound is  base + sum_k (extreme over the ranks v in the list of
 * k of  K_k(v)/n and s log v), with K_k(v) the weight passed on the way up to v:
 * one walk along each list.  In a run of equal ranks one end has the right K, and
 * the other entries only claim less.
 *
 * Weights are 0 or 1, so that every K is an exact integer.
 *
 * Rounding.  Let A = sum_k |log low_k|, computed, and assume of libm that log is
 * good to 2^-51 of itself (koksma(7) says so, a test checks it).  Then every
 * difference of logarithms below is off by less than 2^-50 A, slope included
 * 2^-50 s A.  Each term takes four roundings, each sum over the axes one an axis,
 * all of numbers below dim + 1 + s A: together less than (dim + 1) (dim + 2 + s A)
 * 2^-51.  pad() is twice that and covers both. */
static double pad(size_t dim, double slope_times_logs)
{
    double d = (double)dim;

    return (d + 1.0) * (d + 2.0 + slope_times_logs) * 0x1p-50;
}

/* The volumes at the ends of the cell, and their logarithms; A as above. */
typedef struct extent {
    double volume_low, volume_high, log_low, log_high, logs;
} extent;

static extent measure(const ki_worker *w, const ki_cell *c)
{
    extent x = {1.0, 1.0, 0.0, 0.0, 0.0};

    for (size_t k = 0; k < w->ranks->dim; k++) {
        const ki_axis *axis = &w->ranks->axis[k];

        x.volume_low *= axis->value[c->low[k]];
        x.volume_high *= axis->value[c->high[k]];
        x.log_low += axis->log[c->low[k]];
        x.log_high += axis->log[c->high[k]];
    }
    x.logs = -x.log_low;
    return x;
}

/* The entries of axis k that are open along it. */
static void open_entries(const ki_worker *w, const ki_cell *c, size_t k,
                         size_t *begin, size_t *end)
{
    const ki_entry *e = w->entry;

    *begin = c->begin[k];
    *end = c->end[k];
    if (w->ranks->closed)
        while (*begin < *end && e[*begin].rank == c->low[k])
            ++*begin;
    else
        while (*end > *begin && e[*end - 1].rank == c->high[k])
            --*end;
}

/* How far up the range of axis k a rank stands, from 0 to 1, by logarithms. */
typedef struct scale {
    const double *log;
    double low, inverse;
} scale;

static scale axis_scale(const ki_worker *w, const ki_cell *c, size_t k)
{
    const double *log = w->ranks->axis[k].log;
    double width = log[c->high[k]] - log[c->low[k]];

    return (scale){log, log[c->low[k]], width > 0.0 ? 1.0 / width : 0.0};
}

/* Weights for open boxes: a point counts when on the whole it stands low in its
 * ranges, since then most corners have it inside.  Returns the constant that the
 * weights bring: sum w (axes where it is open - 1). */
static double weigh(ki_worker *w, const ki_cell *c)
{
    const uint32_t *live = w->live + c->live;
    double constant = 0.0;

    for (size_t i = 0; i < c->lives; i++)
        w->reach[live[i]] = 0.0;
    for (size_t k = 0; k < w->ranks->dim; k++) {
        scale s = axis_scale(w, c, k);
        size_t i, end, pillars = 0;

        for (open_entries(w, c, k, &i, &end); i < end; i++) {
            ki_entry e = w->entry[i];

            w->reach[e.point] += (s.log[e.rank] - s.low) * s.inverse;
            pillars += w->opens[e.point] > 1;
        }
        w->pillars[k] = pillars;
    }
    for (size_t i = 0; i < c->lives; i++) {
        uint32_t p = live[i];

        w->weight[p] = w->opens[p] == 1 || w->reach[p] < 1.0 ? 1.0 : 0.0;
        constant += w->weight[p] * (double)(w->opens[p] - 1);
    }
    return constant;
}

/* Charges for closed boxes: to the axis where the point stands highest, since
 * there most corners leave it outside. */
static void charge(ki_worker *w, const ki_cell *c)
{
    const uint32_t *live = w->live + c->live;

    for (size_t i = 0; i < c->lives; i++)
        w->reach[live[i]] = -1.0;
    for (size_t k = 0; k < w->ranks->dim; k++) {
        scale s = axis_scale(w, c, k);
        size_t i, end, pillars = 0;

        for (open_entries(w, c, k, &i, &end); i < end; i++) {
            ki_entry e = w->entry[i];
            double up = (s.log[e.rank] - s.low) * s.inverse;

            if (up > w->reach[e.point]) {
                w->reach[e.point] = up;
                w->axis_of[e.point] = (uint32_t)k;
            }
            pillars += w->opens[e.point] > 1;
        }
        w->pillars[k] = pillars;
    }
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

/* One walk along the list of axis k for open boxes: terms, and the least. */
static double walk_open(ki_worker *w, const ki_cell *c, size_t k, double *term,
                        double slope)
{
    const double *log = w->ranks->axis[k].log;
    double high = log[c->high[k]], share = 1.0 / (double)w->ranks->n;
    double passed = 0.0, least = HUGE_VAL;
    const ki_entry *e = w->entry + c->begin[k];
    size_t count = c->end[k] - c->begin[k], i, end;

    open_entries(w, c, k, &i, &end);
    end -= i;
    for (i = 0; i < end; i++) {
        double v = slope * (high - log[e[i].rank]) + passed * share;

        term[i] = v;
        least = v < least ? v : least;
        passed += w->weight[e[i].point];
    }
    for (; i < count; i++)
        term[i] = passed * share;
    /* One more: at `high` itself, where 1 is the end of the range. */
    term[count] = c->high[k] == w->ranks->axis[k].top ? passed * share : HUGE_VAL;
    if (count > end) term[count] = passed * share;
    return fmin(least, term[count]);
}

/* The same for closed boxes: terms, and the greatest. */
static double walk_closed(ki_worker *w, const ki_cell *c, size_t k, double *term,
                          double slope)
{
    const double *log = w->ranks->axis[k].log;
    double low = log[c->low[k]], share = 1.0 / (double)w->ranks->n;
    double passed = 0.0, greatest = -HUGE_VAL;
    const ki_entry *e = w->entry + c->begin[k];
    size_t count = c->end[k] - c->begin[k], i = 0;

    for (; i < count && e[i].rank == c->low[k]; i++)
        term[i] = greatest = 0.0;
    for (; i < count; i++) {
        double v;

        passed += w->axis_of[e[i].point] == k ? 1.0 : 0.0;
        v = passed * share - slope * (log[e[i].rank] - low);
        term[i] = v;
        greatest = v > greatest ? v : greatest;
    }
    return greatest;
}

/* Keep of each range what lies between the first and the last rank whose term is
 * within `slack` of the best: with any other, even the best of all other axes
 * stay below the target.  side: -1 where the least is best, 1 the greatest. */
static void tighten(ki_worker *w, const ki_cell *c, double slack, double side)
{
    const double *term = w->term;

    for (size_t k = 0; k < w->ranks->dim; k++) {
        const ki_entry *e = w->entry + c->begin[k];
        size_t count = c->end[k] - c->begin[k], first = 0, last = count;
        size_t terms = count + (w->ranks->closed ? 0 : 1);
        double limit = side * w->best_term[k] - slack;

        while (first < terms && side * term[first] < limit)
            first++;
        last = terms;
        while (last > first && side * term[last - 1] < limit)
            last--;
        w->new_low[k] = first < count ? e[first].rank : c->high[k];
        w->new_high[k] =
            last > 0 && last - 1 < count ? e[last - 1].rank : c->high[k];
        term += terms;
    }
}

static bool room_for_terms(ki_worker *w, const ki_cell *c)
{
    size_t need = w->ranks->dim;

    for (size_t k = 0; k < w->ranks->dim; k++)
        need += c->end[k] - c->begin[k];
    w->work += (double)need;
    return ki_grow((void **)&w->term, &w->room_terms, need, sizeof *w->term) == 0;
}

static double bound_open(ki_worker *w, ki_cell *c, double target)
{
    size_t dim = w->ranks->dim;
    double n = (double)w->ranks->n, inside = (double)c->inside / n;
    extent x = measure(w, c);
    double bound = x.volume_high - inside + pad(dim, 0.0), slope, slack;
    double *term = w->term;

    if (bound < target) return bound;
    /* A corner above the target has a volume above target + inside. */
    slope = chord_slope(x, (target + inside) * (1.0 - 0x1p-50), dim);
    bound = x.volume_high - ((double)c->inside - weigh(w, c)) / n;
    for (size_t k = 0; k < dim; k++) {
        w->best_term[k] = walk_open(w, c, k, term, slope);
        bound -= w->best_term[k];
        term += c->end[k] - c->begin[k] + 1;
    }
    bound += pad(dim, slope * x.logs);
    slack = bound - target + pad(dim, slope * x.logs);
    if (bound >= target) tighten(w, c, slack, -1.0);
    return bound;
}

static double bound_closed(ki_worker *w, ki_cell *c, double target)
{
    size_t dim = w->ranks->dim;
    double n = (double)w->ranks->n, most = (double)(c->inside + c->lives) / n;
    extent x = measure(w, c);
    double bound = most - x.volume_low + pad(dim, 0.0), greatest, at, slope, margin;
    double *term = w->term;

    if (bound < target) return bound;
    /* A corner above the target has a volume below most - target.  The tangent
     * touches between there and the volume at `low`, nearer to the former. */
    greatest = fmin(most - target, x.volume_high);
    at = greatest > x.volume_low ? x.log_low + 0.65 * (log(greatest) - x.log_low)
                                 : x.log_low;
    slope = exp(at);
    at = log(slope);
    charge(w, c);
    bound = (double)c->inside / n - slope * (1.0 + x.log_low - at);
    for (size_t k = 0; k < dim; k++) {
        w->best_term[k] = walk_closed(w, c, k, term, slope);
        bound += w->best_term[k];
        term += c->end[k] - c->begin[k];
    }
    margin = pad(dim, slope * (x.logs - at + 1.0));
    bound += margin;
    if (bound >= target) tighten(w, c, bound - target + margin, 1.0);
    return bound;
}

double ki_cell_bound(ki_worker *w, ki_cell *c, double target)
{
    if (!room_for_terms(w, c)) return HUGE_VAL;
    return w->ranks->closed ? bound_closed(w, c, target) : bound_open(w, c, target);
}
