#include <math.h>

#include "error.h"
#include "tree_kernels.h"

/* What the corners of a cell can hold at most: a bound that is a sum of one term
 * an axis, so that its maximum is found axis by axis.
 *
 * Let u_j = 1 if a point is inside along axis j and 0 if not: it is in the box when
 * all u_j are 1.  The measure bounds the volumes by a line, sloping along each axis
 * (ki_slopes).
 *
 * Open boxes, vol - count/n.  AND(u) >= w (1 - sum_j (1 - u_j)) for any weight w in
 * [0,1]: a point counts along each axis where it is open.
 *
 * Closed boxes, count/n - vol.  AND(u) <= sum_j w_j u_j for any weights with
 * sum_j w_j = 1: a point is charged to the axes where it is open, by shares.
 *
 * Either way the bound is  base + sum_k (extreme over the ranks v in the list of
 * k of  K_k(v)/n and slope_k place(v)), with K_k(v) the weight passed on the way up
 * to v: one walk along each list.  In a run of equal ranks one end has the right K,
 * and the other entries only claim less.
 *
 * All weights are multiples of 2^-8 (open boxes) or 2^-15 (closed ones), so that
 * every K is exact.  They start as 0 or 1; from 9 axes on it pays to move them, a few
 * times, towards what is exact at the corner that the bound found best (a
 * subgradient step on the dual), and every round bounds anew.
 *
 * Each term takes four roundings and each sum over the axes one an axis: the margin
 * of the line covers them. */
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

double ki_reach_scale(const ki_worker *w, const ki_cell *c, size_t k)
{
    const double *place = w->ranks->axis[k].place;
    double width = place[c->high[k]] - place[c->low[k]];

    return width > 0x1p-1000 ? KI_REACH / width : 0.0;
}

/* Measured: rounds cost more than they save below 9 axes, and the more axes there
 * are the more of them pay. */
bool ki_round_pays(const ki_worker *w, uint32_t round, double gap)
{
    size_t axes = w->ranks->axes;
    double pillars = 0.0;

    if (axes < 9 || round > (axes - 5) / 2) return false;
    for (size_t k = 0; k < axes; k++)
        pillars += (double)w->pillars[k];
    return gap * round <= 0.1 * pillars / (double)w->ranks->n;
}

void ki_tighten(ki_worker *w, const ki_cell *c, double slack, double side)
{
    const double *term = w->term;

    for (size_t k = 0; k < w->ranks->axes; k++) {
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
    size_t need = w->ranks->axes;

    for (size_t k = 0; k < w->ranks->axes; k++)
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
    for (size_t k = 0; k < w->ranks->axes; k++) {
        w->new_low[k] = c->low[k];
        w->new_high[k] = c->high[k];
    }
    return w->ranks->closed ? ki_bound_closed(w, c, target)
                            : ki_bound_open(w, c, target);
}
