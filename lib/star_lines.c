#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "star_lines_kernels.h"

/* Depth first, the upper part of a cell first: large boxes hold the extremes.
 *
 * What the filters drop is surely no better than what they keep, so that every box
 * that could be the witness, ties included, is offered.  A column costs no more
 * than all lines at its leaf, and a cell no more than all lines and points: n^dim
 * steps at worst, like the sweep, if no filter ever drops a line. */

enum { LEAF_SLAB = 64, LEAF_CELL = 16 };

typedef struct search {
    const ki_lines_grid *grid;
    const koksma_star_opts *opts;
    ki_best *best;
    size_t leaf;
    double upper; /* proven so far */
    double work_before, next_report;
    bool stopped, no_memory;
} search;

static size_t columns(const ki_lines_worker *w, const ki_lines_cell *c)
{
    size_t all = 1;

    for (size_t k = 0; k < w->grid->axes; k++)
        all *= c->high[k] - c->low[k];
    return all;
}

/* Whether there is anything to split; a small cell is worked off here. */
static bool examine(search *s, ki_lines_worker *w, const ki_lines_cell *c)
{
    if (c->lines[0] + c->lines[1] == 0) return false;
    if (!w->scout && !ki_lines_found_in(w, c)) return false;
    if (!c->of_grid && columns(w, c) <= w->leaf) {
        s->no_memory = !ki_lines_leaf(w, c);
        return false;
    }
    return true;
}

static bool told_to_stop(search *s, const ki_lines_worker *w)
{
    const koksma_star_opts *opts = s->opts;
    double work = s->work_before + w->work;

    if (work < s->next_report) return false;
    s->next_report = work + 0x1p20;
    return (opts->work > 0.0 && work > opts->work) ||
           (opts->progress != NULL &&
            opts->progress(opts->state, w->best->value.lower, s->upper, work) != 0);
}

/* Search a cell: any that a thread is given. */
static void run(search *s, ki_lines_worker *w, const ki_lines_cell *whole)
{
    size_t depth = 0;

    s->no_memory = !ki_lines_cell_split(w, whole, 0);
    if (s->no_memory) return;
    for (;;) {
        ki_lines_split *split = &w->path[depth];
        const ki_lines_cell *c;

        if (split->left == 0) {
            if (depth-- == 0) return;
            continue;
        }
        s->stopped = told_to_stop(s, w);
        if (s->stopped) return;
        c = &split->part[--split->left];
        if (examine(s, w, c)) s->no_memory = !ki_lines_cell_split(w, c, ++depth);
        if (s->no_memory) return;
    }
}

/* A stage: no box deviates by more than factor * the incumbent, as it ends. */
static koksma_status search_stage(search *s, double factor)
{
    ki_lines_worker *w = ki_alloc(1, sizeof *w);
    ki_lines_cell whole = ki_lines_cell_whole(s->grid);

    s->no_memory = w == NULL ||
                   ki_lines_worker_begin(w, s->grid, s->best, s->leaf) != KOKSMA_OK;
    if (!s->no_memory) {
        w->factor = factor;
        w->scout = true;
        run(s, w, &whole);
        w->scout = false;
        if (factor == 1.0 && !s->stopped && !s->no_memory) run(s, w, &whole);
        s->work_before += w->work;
        ki_lines_worker_end(w);
    }
    free(w);
    if (s->no_memory) return KOKSMA_ENOMEM;
    if (!s->stopped)
        s->upper =
            fmin(s->upper, fmax(s->best->value.upper, factor * s->best->proven));
    return KOKSMA_OK;
}

/* The stages make early bounds: each costs a part of the next. */
static koksma_status search_all(search *s)
{
    static const double stages[] = {1.0, 0.5, 0.25, 0.1, 0.05};
    double tolerance = s->opts->tolerance;
    koksma_status status = KOKSMA_OK;

    for (size_t i = 0; i < sizeof stages / sizeof stages[0]; i++)
        if (s->opts->anytime && stages[i] > tolerance && status == KOKSMA_OK &&
            !s->stopped)
            status = search_stage(s, 1.0 + stages[i]);
    if (status == KOKSMA_OK && !s->stopped)
        status = search_stage(s, 1.0 + tolerance);
    return status;
}

/* A search that is cut short may have passed one of several tied ranks, and not
 * the one where the count is right. */
static koksma_status settle_witness(ki_best *b)
{
    double *corner = ki_alloc(b->p.dim, sizeof *corner);

    if (corner == NULL) return KOKSMA_ENOMEM;
    memcpy(corner, b->witness.corner, b->p.dim * sizeof *corner);
    ki_lines_recount(b, corner, b->witness.closed);
    free(corner);
    return KOKSMA_OK;
}

koksma_status ki_star_lines_with(ki_best *b, const koksma_star_opts *opts,
                                 size_t leaf, double *upper, double *work,
                                 bool *stopped)
{
    ki_lines_grid grid;
    search s = {.grid = &grid,
                .opts = opts,
                .best = b,
                .leaf = leaf,
                .upper = 1.0,
                .next_report = 0x1p20};
    koksma_status status = ki_lines_grid_make(&grid, b->p);

    if (status != KOKSMA_OK) return status;
    status = ki_lines_climb(&grid, b);
    if (status == KOKSMA_OK) status = search_all(&s);
    if (status == KOKSMA_OK && s.stopped) status = settle_witness(b);
    ki_lines_grid_free(&grid);
    *upper = s.upper;
    *work = s.work_before;
    *stopped = s.stopped;
    return status;
}

koksma_status ki_star_lines(ki_best *b, const koksma_star_opts *opts, double *upper,
                            double *work, bool *stopped)
{
    return ki_star_lines_with(b, opts, b->p.dim == 2 ? LEAF_SLAB : LEAF_CELL, upper,
                              work, stopped);
}
