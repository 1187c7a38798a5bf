#include <math.h>

#include "tree_kernels.h"

/* The bound for closed boxes; tree_bound.c has the mathematics. */

/* How far each entry is from the lower end, and for each point the axis where it
 * stands highest. */
static void measure_gaps(ki_worker *w, const ki_cell *c)
{
    double *gap = w->gap;

    for (size_t i = 0; i < c->severals; i++)
        w->standing[w->several[c->several + i]].reach = 0;
    for (size_t k = 0; k < w->ranks->axes; k++) {
        const double *place = w->ranks->axis[k].place;
        double low = place[c->low[k]], scale = ki_reach_scale(w, c, k);
        ki_span open = ki_open_entries(w, c, k);
        size_t pillars = 0;

        for (size_t i = c->begin[k]; i < open.begin; i++)
            gap++;
        for (size_t i = open.begin; i < open.end; i++) {
            ki_standing *s = &w->standing[w->entry[i].point];
            uint32_t several = s->opens > 1, highest = several * s->reach, up;
            uint32_t choice = s->choice; /* read anyhow: a branch costs more */

            *gap = place[w->entry[i].rank] - low;
            up = 1 + (uint32_t)(*gap++ * scale); /* not 0 */
            s->choice = up > highest ? (uint32_t)k : choice;
            s->reach = up > highest ? up : highest;
            pillars += several;
        }
        w->pillars[k] = pillars;
    }
}

/* A whole charge, in the units of w->share.  Rounding only ever adds to the shares
 * of a point: they sum to a whole or more, which is what the bound needs. */
static const uint32_t WHOLE = 1 << 15;

/* The choice of a point that the best corner has inside. */
static const uint32_t INSIDE = UINT32_MAX;

/* Choose for each point an axis along which the best corner leaves it outside; one
 * open along a single axis keeps that. */
static void choose_outside(ki_worker *w, const ki_cell *c)
{
    for (size_t i = 0; i < c->severals; i++)
        w->standing[w->several[c->several + i]].choice = INSIDE;
    for (size_t k = 0; k < w->ranks->axes; k++)
        for (size_t i = c->end[k];
             i-- > c->begin[k] && w->entry[i].rank > w->best_rank[k];)
            w->standing[w->entry[i].point].choice = (uint32_t)k;
}

/* The first charges: a whole one at the axis of a point's choice. */
static void charge(ki_worker *w, const ki_cell *c, size_t k, uint16_t *share)
{
    const ki_entry *e = w->entry + c->begin[k];
    size_t count = c->end[k] - c->begin[k];

    for (size_t i = 0; i < count; i++)
        share[i] = (uint16_t)(w->standing[e[i].point].choice == k ? WHOLE : 0);
}

/* Move 1/round of the charges of every point to the axis of its choice, if it has
 * one. */
static void move_charges(ki_worker *w, const ki_cell *c, size_t k, uint16_t *share,
                         uint32_t round)
{
    const ki_entry *e = w->entry + c->begin[k];
    size_t count = c->end[k] - c->begin[k];
    uint32_t part = 65536 / round, gain = (WHOLE + round - 1) / round;

    for (size_t i = 0; i < count; i++) {
        uint32_t choice = w->standing[e[i].point].choice, s = share[i];

        s -= choice == INSIDE ? 0 : s * part >> 16;
        s += choice == k ? gain : 0;
        share[i] =
            (uint16_t)(s < UINT16_MAX ? s : UINT16_MAX); /* after 40000 rounds */
    }
}

/* One walk along the list of axis k, whose gaps, shares and terms begin at `at`: the
 * terms, and the greatest of them. */
static void walk(ki_worker *w, const ki_cell *c, size_t k, size_t at)
{
    const ki_entry *e = w->entry + c->begin[k];
    const double *gap = w->gap + at;
    const uint16_t *share = w->share + at;
    double *term = w->term + at, greatest = -HUGE_VAL;
    double unit = 1.0 / ((double)WHOLE * (double)w->ranks->n), slope = w->slope[k];
    size_t count = c->end[k] - c->begin[k], i, best = 0;
    int64_t passed = 0;

    for (i = 0; i < count && e[i].rank == c->low[k]; i++)
        term[i] = greatest = 0.0;
    for (; i < count; i++) {
        double v;

        passed += share[i];
        v = (double)passed * unit - slope * gap[i];
        term[i] = v;
        best = v > greatest ? i : best;
        greatest = v > greatest ? v : greatest;
    }
    w->best_term[k] = greatest;
    w->best_rank[k] = e[best].rank;
}

/* Bound the cell after a round of moving charges. */
static double evaluate(ki_worker *w, const ki_cell *c, const ki_slopes *line,
                       uint32_t round, double target)
{
    double bound =
        (double)c->inside / (double)w->ranks->n + line->margin - line->base;
    size_t before = 0;

    for (size_t k = 0; k < w->ranks->axes; k++) {
        if (round == 1)
            charge(w, c, k, w->share + before);
        else
            move_charges(w, c, k, w->share + before, round);
        walk(w, c, k, before);
        bound += w->best_term[k];
        before += c->end[k] - c->begin[k];
    }
    if (bound >= target) ki_tighten(w, c, bound - target + line->margin, 1.0);
    return bound;
}

double ki_bound_closed(ki_worker *w, const ki_cell *c, double target)
{
    const ki_measure *measure = w->ranks->measure;
    ki_slopes line;
    double bound;

    measure->closed(w, c, target, 0, &line);
    if (line.quick < target) return line.quick;
    measure_gaps(w, c);
    bound = evaluate(w, c, &line, 1, target);
    for (uint32_t round = 1;
         bound >= target && ki_round_pays(w, round, bound - target); round++) {
        measure->closed(w, c, target, round, &line);
        choose_outside(w, c);
        bound = fmin(bound, evaluate(w, c, &line, round + 1, target));
    }
    return bound;
}
