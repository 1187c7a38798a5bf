#include <math.h>
#include <stdlib.h>

#include "error.h"
#include "star_tree_kernels.h"

/* Depth first, the upper part of a cell first: large boxes hold the extremes. */

typedef struct search {
    ki_worker *worker;
    const koksma_star_opts *opts;
    double upper; /* proven so far */
    double work_before, next_report;
    bool stopped, no_memory;
} search;

static double target(const ki_worker *w) { return w->best->proven * w->factor; }

/* Whether one corner is left; it is then offered. */
static bool is_corner(ki_worker *w, const ki_cell *c)
{
    const ki_ranks *r = w->ranks;

    for (size_t k = 0; k < r->dim; k++)
        if (c->low[k] != c->high[k]) return false;
    for (size_t k = 0; k < r->dim; k++)
        w->corner[k] = r->axis[k].value[c->low[k]];
    ki_best_offer(w->best, w->corner, c->inside, r->closed);
    return true;
}

static size_t entries(const ki_worker *w, const ki_cell *c)
{
    size_t sum = 0;

    for (size_t k = 0; k < w->ranks->dim; k++)
        sum += c->end[k] - c->begin[k];
    return sum;
}

/* Split where most points are open along other axes too, over the longest range,
 * at the middle of the list. */
static void choose_split(ki_worker *w, ki_cell *c)
{
    double best = -1.0;

    for (size_t k = 0; k < w->ranks->dim; k++) {
        const double *log = w->ranks->axis[k].log;
        size_t count = c->end[k] - c->begin[k];
        double weight = ((double)w->pillars[k] + 0.1 * (double)count) *
                        (log[c->high[k]] - log[c->low[k]]);

        if (c->low[k] == c->high[k] || weight <= best) continue;
        best = weight;
        c->split = k;
    }

    const ki_entry *e = w->entry + c->begin[c->split],
                   *end = w->entry + c->end[c->split];

    /* The upper part begins there, so it must not be `low`. */
    e += (end - e) / 2;
    while (e < end && e->rank == c->low[c->split])
        e++;
    c->middle = e < end ? e->rank : c->high[c->split];
}

/* Settle the cell; whether anything is left of it. */
static bool settle(search *s, ki_cell *c)
{
    bool empty = false;

    s->no_memory = !ki_cell_settle(s->worker, c, &empty);
    return !s->no_memory && !empty;
}

/* Bound the cell, tighten it while that pays, and settle how to split it.
 * Returns whether there is anything left to split. */
static bool examine(search *s, ki_cell *c)
{
    ki_worker *w = s->worker;
    size_t before;

    if (!settle(s, c) || is_corner(w, c)) return false;
    do {
        before = entries(w, c);
        c->bound = ki_cell_bound(w, c, target(w));
        if (c->bound < target(w)) return false;
        s->no_memory = c->bound == HUGE_VAL || !ki_cell_narrow(w, c);
        if (s->no_memory || !settle(s, c) || is_corner(w, c)) return false;
    } while ((double)entries(w, c) <= 0.95 * (double)before);
    choose_split(w, c);
    return true;
}

static bool told_to_stop(search *s)
{
    const koksma_star_opts *opts = s->opts;
    const ki_worker *w = s->worker;
    double work = s->work_before + w->work;

    if (work < s->next_report) return false;
    s->next_report = work + 0x1p18;
    return (opts->work > 0.0 && work > opts->work) ||
           (opts->progress != NULL &&
            opts->progress(opts->state, w->best->value.lower, s->upper, work) != 0);
}

/* Enter the next part of cell `depth`: its upper one, then its lower one. */
static ki_cell *enter_part(search *s, size_t depth)
{
    ki_worker *w = s->worker;
    ki_cell *c = ki_cell_enter(w, depth + 1), *whole;

    s->no_memory = c == NULL;
    if (c == NULL) return NULL;
    whole = c - 1;
    for (size_t k = 0; k < w->ranks->dim; k++) {
        w->new_low[k] = whole->low[k];
        w->new_high[k] = whole->high[k];
    }
    if (whole->parts++ == 0)
        w->new_low[whole->split] = whole->middle;
    else
        w->new_high[whole->split] = whole->middle - 1;
    s->no_memory = !ki_cell_narrow(w, c);
    return s->no_memory ? NULL : c;
}

static void run(search *s)
{
    ki_worker *w = s->worker;
    size_t depth = 0;

    if (!examine(s, &w->cell[0])) return;
    for (;;) {
        ki_cell *c = &w->cell[depth];

        if (c->parts == 2 || c->bound < target(w)) {
            ki_cell_leave(w, c);
            if (depth-- == 0) return;
            continue;
        }
        s->stopped = told_to_stop(s);
        if (s->stopped) return;
        c = enter_part(s, depth);
        if (c == NULL) return;
        if (examine(s, c))
            depth++;
        else
            ki_cell_leave(w, c);
        if (s->no_memory) return;
    }
}

/* Closed boxes with a side of length 0 have no volume, and no logarithm: the one
 * that matters along each axis holds the points at 0 there, and no more. */
static void offer_flat_boxes(ki_best *b, double *corner)
{
    koksma_points p = b->p;

    for (size_t k = 0; k < p.dim; k++) {
        size_t inside = 0;

        for (size_t l = 0; l < p.dim; l++)
            corner[l] = 0.0;
        for (size_t i = 0; i < p.n; i++) {
            const double *x = p.x + i * p.dim;

            if (x[k] > 0.0) continue;
            inside++;
            for (size_t l = 0; l < p.dim; l++)
                corner[l] = fmax(corner[l], x[l]);
        }
        if (inside > 0) ki_best_offer(b, corner, inside, true);
    }
}

/* Whether every side of a box of this kind can have a length. */
static bool has_volume(const ki_ranks *r)
{
    for (size_t k = 0; k < r->dim; k++)
        if (r->axis[k].top == 0) return false;
    return true;
}

/* Search one kind of box for what is above factor * the incumbent. */
static koksma_status search_kind(search *s, ki_best *b, const ki_ranks *ranks,
                                 double factor)
{
    ki_worker w;

    if (!has_volume(ranks)) return KOKSMA_OK;
    if (ki_worker_begin(&w, ranks, b) != KOKSMA_OK) return KOKSMA_ENOMEM;
    w.factor = factor;
    s->worker = &w;
    run(s);
    s->work_before += w.work;
    ki_worker_end(&w);
    return s->no_memory ? KOKSMA_ENOMEM : KOKSMA_OK;
}

/* A stage: no box of either kind deviates by more than factor * the incumbent, as
 * it ends.  Closed boxes first: of most sets they hold the extreme, and knowing
 * it early prunes the other search. */
static koksma_status search_stage(search *s, ki_best *b, const ki_ranks *open,
                                  const ki_ranks *closed, double factor)
{
    koksma_status status = search_kind(s, b, closed, factor);

    if (status == KOKSMA_OK && !s->stopped)
        status = search_kind(s, b, open, factor);
    if (status == KOKSMA_OK && !s->stopped)
        s->upper = fmin(s->upper, fmax(b->value.upper, factor * b->proven));
    return status;
}

/* The stages make early bounds: each costs a part of the next. */
static koksma_status search_all(search *s, ki_best *b, const ki_ranks *open,
                                const ki_ranks *closed)
{
    static const double stages[] = {1.0, 0.5, 0.25, 0.1, 0.05};
    double tolerance = s->opts->tolerance;
    koksma_status status = KOKSMA_OK;

    for (size_t i = 0; i < sizeof stages / sizeof stages[0]; i++)
        if (s->opts->anytime && stages[i] > tolerance && status == KOKSMA_OK &&
            !s->stopped)
            status = search_stage(s, b, open, closed, 1.0 + stages[i]);
    if (status == KOKSMA_OK && !s->stopped)
        status = search_stage(s, b, open, closed, 1.0 + tolerance);
    return status;
}

koksma_status ki_star_tree(ki_best *b, const koksma_star_opts *opts, double *upper,
                           double *work, bool *stopped)
{
    search s = {.opts = opts, .upper = 1.0, .next_report = 0x1p18};
    double *corner = ki_alloc(b->p.dim, sizeof *corner);
    ki_ranks open = {0}, closed = {0};
    koksma_status status = corner != NULL ? KOKSMA_OK : KOKSMA_ENOMEM;

    if (status == KOKSMA_OK) status = ki_ranks_make(&open, b->p, false);
    if (status == KOKSMA_OK) status = ki_ranks_make(&closed, b->p, true);
    if (status == KOKSMA_OK) {
        offer_flat_boxes(b, corner);
        status = search_all(&s, b, &open, &closed);
    }
    ki_ranks_free(&open);
    ki_ranks_free(&closed);
    free(corner);
    *upper = s.upper;
    *work = s.work_before;
    *stopped = s.stopped;
    return status;
}
