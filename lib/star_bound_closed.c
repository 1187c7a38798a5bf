#include <float.h>
#include <math.h>

#include "star_tree_kernels.h"

/* The bound for closed boxes; star_bound.c has the mathematics. */

/* The first charges: whole, to the axis where the point stands highest, since there
 * most corners leave it outside.  w->share has one number an entry, list after list
 * as the terms. */
static void charge(ki_worker *w, const ki_cell *c)
{
    const uint32_t *live = w->live + c->live;
    double *share = w->share;

    for (size_t i = 0; i < c->lives; i++)
        w->reach[live[i]] = -1.0;
    for (size_t k = 0; k < w->ranks->dim; k++) {
        ki_scale s = ki_axis_scale(w, c, k);
        ki_span open = ki_open_entries(w, c, k);
        size_t pillars = 0;

        for (size_t i = open.begin; i < open.end; i++) {
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
    for (size_t k = 0; k < w->ranks->dim; k++) {
        size_t first_open = ki_open_entries(w, c, k).begin;

        for (size_t i = c->begin[k]; i < c->end[k]; i++)
            *share++ =
                i >= first_open && w->axis_of[w->entry[i].point] == k ? 1.0 : 0.0;
    }
}

/* Move a part of the charges of every point that the best corner leaves outside to
 * an axis along which it does. */
static void recharge(ki_worker *w, const ki_cell *c, double step)
{
    const uint32_t *live = w->live + c->live;
    double *share = w->share;

    for (size_t i = 0; i < c->lives; i++) {
        w->axis_of[live[i]] = UINT32_MAX;
        w->reach[live[i]] = 0.0;
    }
    for (size_t k = 0; k < w->ranks->dim; k++)
        for (size_t i = c->end[k];
             i-- > c->begin[k] && w->entry[i].rank > w->best_rank[k];)
            w->axis_of[w->entry[i].point] = (uint32_t)k;
    for (size_t k = 0; k < w->ranks->dim; k++)
        for (size_t i = c->begin[k]; i < c->end[k]; i++, share++) {
            uint32_t p = w->entry[i].point;
            double moved;

            if (*share == 0.0 || w->axis_of[p] == UINT32_MAX) continue;
            moved = floor(*share * step * 256.0) / 256.0;
            *share -= moved;
            w->reach[p] += moved;
        }
    share = w->share;
    for (size_t k = 0; k < w->ranks->dim; k++) {
        size_t first_open = ki_open_entries(w, c, k).begin;

        for (size_t i = c->begin[k]; i < c->end[k]; i++, share++)
            if (i >= first_open && w->axis_of[w->entry[i].point] == k)
                *share += w->reach[w->entry[i].point];
    }
}

/* One walk along the list of axis k: terms, and the greatest. */
static double walk_closed(ki_worker *w, const ki_cell *c, size_t k, double *term,
                          const double *share, double slope)
{
    const double *log = w->ranks->axis[k].log;
    double low = log[c->low[k]], part = 1.0 / (double)w->ranks->n;
    double passed = 0.0, greatest = -HUGE_VAL;
    const ki_entry *e = w->entry + c->begin[k];
    size_t count = c->end[k] - c->begin[k], i = 0;

    for (; i < count && e[i].rank == c->low[k]; i++)
        term[i] = greatest = 0.0;
    for (; i < count; i++) {
        double v;

        passed += share[i];
        v = passed * part - slope * (log[e[i].rank] - low);
        term[i] = v;
        greatest = v > greatest ? v : greatest;
    }
    return greatest;
}

/* Bound the cell with the charges as they are and the tangent at `at`. */
static double evaluate(ki_worker *w, const ki_cell *c, ki_extent x, double at,
                       double target)
{
    size_t dim = w->ranks->dim, before = 0;
    double slope = fmax(exp(at), DBL_MIN); /* any slope above 0 makes a bound */
    double touch = log(slope), margin, bound;

    margin = ki_bound_pad(dim, slope * (x.logs - touch + 1.0));
    bound = (double)c->inside / (double)w->ranks->n + margin -
            slope * (1.0 + x.log_low - touch);
    for (size_t k = 0; k < dim; k++) {
        w->best_term[k] =
            walk_closed(w, c, k, w->term + before, w->share + before, slope);
        bound += w->best_term[k];
        before += c->end[k] - c->begin[k];
    }
    if (bound >= target) ki_tighten(w, c, bound - target + margin, 1.0);
    return bound;
}

/* The logarithm of the volume of the corner that was found best. */
static double log_of_best(const ki_worker *w)
{
    double sum = 0.0;

    for (size_t k = 0; k < w->ranks->dim; k++)
        sum += w->ranks->axis[k].log[w->best_rank[k]];
    return sum;
}

double ki_bound_closed(ki_worker *w, const ki_cell *c, double target)
{
    double most = (double)(c->inside + c->lives) / (double)w->ranks->n;
    ki_extent x = ki_cell_extent(w, c);
    double bound = most - x.volume_low + ki_bound_pad(w->ranks->dim, 0.0), greatest,
           at;

    if (bound < target) return bound;
    /* A corner above the target has a volume below most - target.  The tangent
     * touches between there and the volume at `low`, nearer to the former. */
    greatest = fmin(most - target, x.volume_high);
    at = x.log_low;
    if (greatest > x.volume_low) at += 0.65 * (log(greatest) - x.log_low);
    charge(w, c);
    bound = evaluate(w, c, x, at, target);
    for (int round = 1; bound >= target && ki_round_pays(w, round, bound - target);
         round++) {
        double step = 1.0 / (round + 1);

        ki_find_best(w, c);
        at += step * (log_of_best(w) - at);
        recharge(w, c, step);
        bound = fmin(bound, evaluate(w, c, x, at, target));
    }
    return bound;
}
