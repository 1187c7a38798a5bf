#include <math.h>

#include "star_tree_kernels.h"

/* The bound for open boxes; star_bound.c has the mathematics. */

/* What the weights bring as a constant: sum w (axes where it is open - 1). */
static double constant_of(const ki_worker *w, const ki_cell *c)
{
    const uint32_t *live = w->live + c->live;
    double constant = 0.0;

    for (size_t i = 0; i < c->lives; i++)
        constant += w->weight[live[i]] * (double)(w->opens[live[i]] - 1);
    return constant;
}

/* The first weights: a point counts when on the whole it stands low in its ranges,
 * since then most corners have it inside. */
static void weigh(ki_worker *w, const ki_cell *c)
{
    const uint32_t *live = w->live + c->live;

    for (size_t i = 0; i < c->lives; i++)
        w->reach[live[i]] = 0.0;
    for (size_t k = 0; k < w->ranks->dim; k++) {
        ki_scale s = ki_axis_scale(w, c, k);
        ki_span open = ki_open_entries(w, c, k);
        size_t pillars = 0;

        for (size_t i = open.begin; i < open.end; i++) {
            ki_entry e = w->entry[i];

            w->reach[e.point] += (s.log[e.rank] - s.low) * s.inverse;
            pillars += w->opens[e.point] > 1;
        }
        w->pillars[k] = pillars;
    }
    for (size_t i = 0; i < c->lives; i++) {
        uint32_t p = live[i];

        w->weight[p] = w->opens[p] == 1 || w->reach[p] < 1.0 ? 1.0 : 0.0;
    }
}

/* Move the weights a step towards what is exact at the best corner: 1 for a point
 * that is inside there, 0 for one that is outside along two axes or more. */
static void reweigh(ki_worker *w, const ki_cell *c, double step)
{
    const uint32_t *live = w->live + c->live;

    for (size_t i = 0; i < c->lives; i++)
        w->reach[live[i]] = 0.0;
    for (size_t k = 0; k < w->ranks->dim; k++) {
        ki_span open = ki_open_entries(w, c, k);

        /* From the upper end: those that are outside along k. */
        for (size_t i = open.end;
             i-- > open.begin && w->entry[i].rank >= w->best_rank[k];)
            w->reach[w->entry[i].point] += 1.0;
    }
    for (size_t i = 0; i < c->lives; i++) {
        uint32_t p = live[i];
        double goal = w->reach[p] == 0.0 ? 1.0 : 0.0;

        if (w->opens[p] > 1 && w->reach[p] != 1.0)
            w->weight[p] =
                rint((w->weight[p] + step * (goal - w->weight[p])) * 256.0) / 256.0;
    }
}

/* The slope of a line through (t_high, V) that stays above e^t on the volumes
 * that matter: those from E on.  The chord's is (V - E)/(log V - log E); less is
 * safe.  Below a width of 2^-10 the computed chord could err by more than its own
 * part, and the slope at its lower end, E, serves: it is nearly the same.  Above,
 * the difference V - E is good to dim 2^-41 of itself and the width to A 2^-40. */
static double chord_slope(ki_extent x, double least, size_t dim)
{
    double low = fmax(least, x.volume_low), width;
    double safe = 1.0 - (x.logs + (double)dim + 2.0) * 0x1p-38;

    if (!(safe > 0.0) || !(low > 0.0) || low >= x.volume_high) return 0.0;
    width = x.log_high - (low > x.volume_low ? log(low) : x.log_low);
    if (width < 0x1p-10) return low * safe;
    return (x.volume_high - low) / width * safe;
}

/* One walk along the list of axis k: terms, and the least. */
static double walk_open(ki_worker *w, const ki_cell *c, size_t k, double *term,
                        double slope)
{
    const double *log = w->ranks->axis[k].log;
    double high = log[c->high[k]], share = 1.0 / (double)w->ranks->n;
    double passed = 0.0, least = HUGE_VAL;
    const ki_entry *e = w->entry + c->begin[k];
    size_t count = c->end[k] - c->begin[k], i;
    size_t end = ki_open_entries(w, c, k).end - c->begin[k];

    for (i = 0; i < end; i++) {
        double v = slope * (high - log[e[i].rank]) + passed * share;

        term[i] = v;
        least = v < least ? v : least;
        passed += w->weight[e[i].point];
    }
    for (; i < count; i++)
        term[i] = passed * share;
    /* One more: at `high` itself, if a point is there or it is 1. */
    term[count] = count > end || c->high[k] == w->ranks->axis[k].top
                      ? passed * share
                      : HUGE_VAL;
    return fmin(least, term[count]);
}

/* Bound the cell with the weights as they are. */
static double evaluate(ki_worker *w, const ki_cell *c, ki_extent x, double slope,
                       double target)
{
    size_t dim = w->ranks->dim;
    double margin = ki_bound_pad(dim, slope * x.logs);
    double bound = x.volume_high + margin -
                   ((double)c->inside - constant_of(w, c)) / (double)w->ranks->n;
    double *term = w->term;

    for (size_t k = 0; k < dim; k++) {
        w->best_term[k] = walk_open(w, c, k, term, slope);
        bound -= w->best_term[k];
        term += c->end[k] - c->begin[k] + 1;
    }
    if (bound >= target) ki_tighten(w, c, bound - target + margin, -1.0);
    return bound;
}

double ki_bound_open(ki_worker *w, const ki_cell *c, double target)
{
    size_t dim = w->ranks->dim;
    double inside = (double)c->inside / (double)w->ranks->n;
    ki_extent x = ki_cell_extent(w, c);
    double bound = x.volume_high - inside + ki_bound_pad(dim, 0.0), slope;

    if (bound < target) return bound;
    /* A corner above the target has a volume above target + inside. */
    slope = chord_slope(x, (target + inside) * (1.0 - 0x1p-50), dim);
    weigh(w, c);
    bound = evaluate(w, c, x, slope, target);
    for (int round = 1; bound >= target && ki_round_pays(w, round, bound - target);
         round++) {
        ki_find_best(w, c);
        reweigh(w, c, 1.0 / (round + 1));
        bound = fmin(bound, evaluate(w, c, x, slope, target));
    }
    return bound;
}
