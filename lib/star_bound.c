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
 * tangent; and AND(u) <= sum_j w_j u_j for any weights with sum_j w_j = 1: a point
 * is charged to the axes where it is open, by shares.
 *
 * Either way the bound is  base + sum_k (extreme over the ranks v in the list of
 * k of  K_k(v)/n and s log v), with K_k(v) the weight passed on the way up to v:
 * one walk along each list.  In a run of equal ranks one end has the right K, and
 * the other entries only claim less.
 *
 * All weights are multiples of 1/256, so that every K is exact.  They start as 0 or
 * 1; from 9 axes on it pays to move them, a few times, towards what is exact at the
 * corner that the bound found best (a subgradient step on the dual), and every
 * round bounds anew.
 *
 * Rounding.  Let A = sum_k |log low_k|, computed, and assume of libm that log is
 * good to 2^-51 of itself (koksma(7) says so, a test checks it).  Then every
 * difference of logarithms below is off by less than 2^-50 A, slope included
 * 2^-50 s A.  Each term takes four roundings, each sum over the axes one an axis,
 * all of numbers below dim + 1 + s A: together less than (dim + 1) (dim + 2 + s A)
 * 2^-51.  pad() is twice that and covers both. */
double ki_bound_pad(size_t dim, double slope_times_logs)
{
    double d = (double)dim;

    return (d + 1.0) * (d + 2.0 + slope_times_logs) * 0x1p-50;
}

ki_extent ki_cell_extent(const ki_worker *w, const ki_cell *c)
{
    ki_extent x = {1.0, 1.0, 0.0, 0.0, 0.0};

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

ki_span ki_open_entries(const ki_worker *w, const ki_cell *c, size_t k)
{
    const ki_entry *e = w->entry;
    ki_span s = {c->begin[k], c->end[k]};

    if (w->ranks->closed)
        while (s.begin < s.end && e[s.begin].rank == c->low[k])
            s.begin++;
    else
        while (s.end > s.begin && e[s.end - 1].rank == c->high[k])
            s.end--;
    return s;
}

double ki_inverse_width(const ki_worker *w, const ki_cell *c, size_t k)
{
    const double *log = w->ranks->axis[k].log;
    double width = log[c->high[k]] - log[c->low[k]];

    return width > 0.0 ? 1.0 / width : 0.0;
}

/* Measured: rounds cost more than they save below 9 axes, and the more axes there
 * are the more of them pay. */
bool ki_round_pays(const ki_worker *w, uint32_t round, double gap)
{
    size_t dim = w->ranks->dim;
    double pillars = 0.0;

    if (dim < 9 || round > (dim - 5) / 2) return false;
    for (size_t k = 0; k < dim; k++)
        pillars += (double)w->pillars[k];
    return gap * round <= 0.1 * pillars / (double)w->ranks->n;
}

void ki_tighten(ki_worker *w, const ki_cell *c, double slack, double side)
{
    const double *term = w->term;

    for (size_t k = 0; k < w->ranks->dim; k++) {
        const ki_entry *e = w->entry + c->begin[k];
        size_t count = c->end[k] - c->begin[k], first = 0, last;
        size_t terms = count + (w->ranks->closed ? 0 : 1);
        double limit = side * w->best_term[k] - slack;
        uint32_t low, high;

        while (first < terms && side * term[first] < limit)
            first++;
        last = terms;
        while (last > first && side * term[last - 1] < limit)
            last--;
        low = first < count ? e[first].rank : c->high[k];
        high = last > 0 && last - 1 < count ? e[last - 1].rank : c->high[k];
        if (low > w->new_low[k]) w->new_low[k] = low;
        if (high < w->new_high[k]) w->new_high[k] = high;
        term += terms;
    }
}

static bool make_room(ki_worker *w, const ki_cell *c)
{
    size_t need = w->ranks->dim;

    for (size_t k = 0; k < w->ranks->dim; k++)
        need += c->end[k] - c->begin[k];
    w->work += (double)need;
    return ki_grow((void **)&w->gap, &w->room_gaps, need, sizeof *w->gap) == 0 &&
           ki_grow((void **)&w->share, &w->room_shares, need, sizeof *w->share) ==
               0 &&
           ki_grow((void **)&w->term, &w->room_terms, need, sizeof *w->term) == 0;
}

double ki_cell_bound(ki_worker *w, const ki_cell *c, double target)
{
    if (!make_room(w, c)) return HUGE_VAL;
    for (size_t k = 0; k < w->ranks->dim; k++) {
        w->new_low[k] = c->low[k];
        w->new_high[k] = c->high[k];
    }
    return w->ranks->closed ? ki_bound_closed(w, c, target)
                            : ki_bound_open(w, c, target);
}
