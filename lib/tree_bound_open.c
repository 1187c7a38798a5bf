#include <math.h>

#include "tree_kernels.h"

/* The bound for open boxes; tree_bound.c has the mathematics. */

/* A whole weight, in the units of a point's choice. */
enum { WHOLE = 256 };

/* A point open along one axis has the whole weight there, whatever the corner: only
 * those open along several are weighed. */

/* What the weights bring as a constant: sum w (axes where it is open - 1). */
static double constant_of(const ki_worker *w, const ki_cell *c)
{
    const uint32_t *several = w->several + c->several;
    uint64_t constant = 0;

    for (size_t i = 0; i < c->severals; i++) {
        const ki_standing *s = &w->standing[several[i]];

        constant += (uint64_t)s->choice * (s->opens - 1);
    }
    return (double)constant / WHOLE;
}

/* How far each entry is from the upper end, and each point that is open along
 * several axes up its ranges. */
static void measure_gaps(ki_worker *w, const ki_cell *c)
{
    double *gap = w->gap;

    for (size_t i = 0; i < c->severals; i++)
        w->standing[w->several[c->several + i]].reach = 0;
    for (size_t k = 0; k < w->ranks->axes; k++) {
        const double *place = w->ranks->axis[k].place;
        double high = place[c->high[k]], scale = ki_reach_scale(w, c, k);
        ki_span open = ki_open_entries(w, c, k);
        size_t pillars = 0;

        for (size_t i = open.begin; i < open.end; i++) {
            ki_standing *s = &w->standing[w->entry[i].point];

            *gap = high - place[w->entry[i].rank];
            s->reach += KI_REACH - (uint32_t)(*gap++ * scale);
            s->choice = WHOLE;
            pillars += s->opens > 1;
        }
        gap += c->end[k] - open.end + 1;
        w->pillars[k] = pillars;
    }
}

/* The first weights: a point counts when on the whole it stands low in its ranges,
 * since then most corners have it inside. */
static void weigh(ki_worker *w, const ki_cell *c)
{
    for (size_t i = 0; i < c->severals; i++) {
        ki_standing *s = &w->standing[w->several[c->several + i]];

        s->choice = s->reach < KI_REACH ? WHOLE : 0;
    }
}

/* Move the weights a step towards what is exact at the best corner: 1 for a point
 * that is inside there, 0 for one that is outside along two axes or more. */
static void reweigh(ki_worker *w, const ki_cell *c, uint32_t round)
{
    const uint32_t *several = w->several + c->several;

    for (size_t i = 0; i < c->severals; i++)
        w->standing[several[i]].reach = 0;
    for (size_t k = 0; k < w->ranks->axes; k++) {
        ki_span open = ki_open_entries(w, c, k);

        /* From the upper end: those that are outside along k. */
        for (size_t i = open.end;
             i-- > open.begin && w->entry[i].rank >= w->best_rank[k];)
            w->standing[w->entry[i].point].reach++;
    }
    for (size_t i = 0; i < c->severals; i++) {
        ki_standing *s = &w->standing[several[i]];
        int goal = s->reach == 0 ? WHOLE : 0, choice = (int)s->choice;

        if (s->reach != 1)
            s->choice = (uint32_t)(choice + (goal - choice) / (int)(round + 1));
    }
}

/* One walk along the list of axis k, whose gaps and terms begin at `at`: the terms,
 * and the least of them. */
static void walk(ki_worker *w, const ki_cell *c, size_t k, size_t at)
{
    const ki_entry *e = w->entry + c->begin[k];
    const double *gap = w->gap + at;
    double *term = w->term + at, least = HUGE_VAL, last;
    double unit = 1.0 / ((double)WHOLE * (double)w->ranks->n), slope = w->slope[k];
    size_t count = c->end[k] - c->begin[k], i, best = 0;
    size_t end = ki_open_entries(w, c, k).end - c->begin[k];
    int64_t passed = 0;

    for (i = 0; i < end; i++) {
        double v = slope * gap[i] + (double)passed * unit;

        term[i] = v;
        best = v < least ? i : best;
        least = v < least ? v : least;
        passed += w->standing[e[i].point].choice;
    }
    last = (double)passed * unit;
    for (; i < count; i++)
        term[i] = last;
    /* One more: at `high` itself, if a point is there or it is 1. */
    term[count] =
        count > end || c->high[k] == w->ranks->axis[k].top ? last : HUGE_VAL;
    w->best_term[k] = fmin(least, term[count]);
    w->best_rank[k] = term[count] < least ? c->high[k] : e[best].rank;
}

/* Bound the cell with the weights as they are. */
static double evaluate(ki_worker *w, const ki_cell *c, const ki_slopes *line,
                       double target)
{
    double bound = line->base + line->margin -
                   ((double)c->inside - constant_of(w, c)) / (double)w->ranks->n;
    size_t at = 0;

    for (size_t k = 0; k < w->ranks->axes; k++) {
        walk(w, c, k, at);
        bound -= w->best_term[k];
        at += c->end[k] - c->begin[k] + 1;
    }
    if (bound >= target) ki_tighten(w, c, bound - target + line->margin, -1.0);
    return bound;
}

double ki_bound_open(ki_worker *w, const ki_cell *c, double target)
{
    const ki_measure *measure = w->ranks->measure;
    ki_slopes line;
    double bound;

    measure->open(w, c, target, 0, &line);
    if (line.quick < target) return line.quick;
    measure_gaps(w, c);
    weigh(w, c);
    bound = evaluate(w, c, &line, target);
    for (uint32_t round = 1;
         bound >= target && ki_round_pays(w, round, bound - target); round++) {
        reweigh(w, c, round);
        measure->open(w, c, target, round, &line);
        bound = fmin(bound, evaluate(w, c, &line, target));
    }
    return bound;
}
