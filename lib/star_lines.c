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

/* Without the hull there are a few lines a point, but where many heights are
 * collinear. */
enum { LEAF_SLAB = 64, LEAF_CELL = 16, DENSE = 2 };

typedef struct search {
    ki_run run;
    ki_lines_grid grid;
    ki_lines_worker *worker; /* one a thread */
    ki_lines_finds known;
    ki_lines_tasks tasks;
    size_t part, parts;
} search;

static size_t columns(const ki_lines_worker *w, const ki_lines_cell *c)
{
    size_t all = 1;

    for (size_t k = 0; k < w->grid->axes; k++)
        all *= c->high[k] - c->low[k];
    return all;
}

/* Whether there is anything to split; a small cell is worked off here. */
static bool examine(ki_lines_worker *w, const ki_lines_cell *c)
{
    if (c->lines == 0) return false;
    if (c->of_grid || columns(w, c) > w->sizes.leaf) return true;
    if (!ki_lines_leaf(w, c)) ki_run_give_up(w->run);
    return false;
}

static void split(ki_lines_worker *w, const ki_lines_cell *c, size_t depth)
{
    if (!ki_lines_cell_split(w, c, depth)) ki_run_give_up(w->run);
}

/* Search a cell that is to be split. */
static void dive(ki_lines_worker *w, const ki_lines_cell *whole)
{
    size_t depth = 0;

    split(w, whole, 0);
    while (!ki_run_told_to_stop(w->run, &w->work)) {
        ki_lines_split *here = &w->path[depth];

        if (here->left == 0) {
            if (depth-- == 0) return;
        } else if (examine(w, &here->part[--here->left])) {
            split(w, &here->part[here->left], ++depth);
        }
    }
}

static void work_on(void *state, size_t thread, size_t number)
{
    search *s = state;
    ki_lines_task *task = &s->tasks.task[number];
    ki_lines_worker *w = &s->worker[thread];
    ki_lines_cell whole;

    if (!ki_lines_bring_in(w, task, &whole)) ki_run_give_up(w->run);
    if (!ki_team_stopped(w->run->team) && examine(w, &whole)) dive(w, &whole);
}

/* How many tasks there should be: shares of equal work take many, and must not
 * depend on the threads.  In the plane cells are much alike, and to make tasks of
 * them costs more than a thread that waits at the end. */
static size_t enough_tasks(const search *s)
{
    size_t threads = ki_team_threads(s->run.team);

    if (s->parts > 1) return 64 * s->parts;
    return threads == 1 || s->grid.axes == 1 ? threads : 16 * threads;
}

static void pass(search *s, bool scout)
{
    size_t threads = ki_team_threads(s->run.team);

    for (size_t i = 0; i < threads; i++) {
        s->worker[i].scout = scout;
        s->worker[i].finds.count = 0;
        s->worker[i].finds.too_many = false;
    }
    if (!ki_lines_make_tasks(&s->tasks, s->worker, enough_tasks(s)))
        ki_run_give_up(&s->run);
    if (s->parts > 1 && scout) ki_lines_deal_tasks(&s->tasks, s->part, s->parts);
    ki_team_run(s->run.team, s->tasks.count, work_on, s);
    ki_lines_tasks_free(&s->tasks);
}

static void revisit(void *state, size_t thread, size_t number)
{
    search *s = state;

    if (!ki_lines_revisit(&s->worker[thread], &s->known, number * KI_LINES_PARTS))
        ki_run_give_up(&s->run);
}

/* A scout first; where the answer is to be exact, whoever may be the witness is
 * then looked at again; each share does that for what its own scouts have found. */
static void search_stage(void *state)
{
    search *s = state;
    size_t threads = ki_team_threads(s->run.team);

    pass(s, true);
    if (s->run.factor > 1.0 || ki_team_stopped(s->run.team)) return;
    ki_lines_gather(&s->known, s->worker, threads);
    if (s->known.too_many) {
        pass(s, false);
        return;
    }
    for (size_t i = 0; i < threads; i++)
        s->worker[i].scout = false;
    ki_team_run(s->run.team, (s->known.count + KI_LINES_PARTS - 1) / KI_LINES_PARTS,
                revisit, s);
}

/* A search that is cut short may have passed one of several tied ranks, and not
 * the one where the count is right. */
static koksma_status settle_witness(ki_best *b)
{
    double *corner = ki_alloc(b->p.dim, sizeof *corner);
    bool closed = b->witness.closed;

    if (corner == NULL) return KOKSMA_ENOMEM;
    memcpy(corner, b->witness.corner, b->p.dim * sizeof *corner);
    ki_best_offer(b, corner, ki_lines_inside(b->p, corner, closed), closed);
    free(corner);
    return KOKSMA_OK;
}

static koksma_status begin(search *s, ki_best *b, const koksma_star_opts *opts,
                           ki_lines_sizes sizes)
{
    ki_run_opts shared = ki_star_run_opts(opts);

    s->part = opts->parts > 1 ? opts->part - 1 : 0;
    s->parts = opts->parts > 1 ? opts->parts : 1;
    if (ki_run_begin(&s->run, b, &shared) != KOKSMA_OK ||
        ki_lines_grid_make(&s->grid, b->p, s->run.team) != KOKSMA_OK ||
        ki_lines_climb(&s->grid, &s->run, sizes.climbs) != KOKSMA_OK)
        return KOKSMA_ENOMEM;
    s->worker = calloc(ki_team_threads(s->run.team), sizeof *s->worker);
    for (size_t i = 0; i < ki_team_threads(s->run.team); i++)
        if (s->worker == NULL || ki_lines_worker_begin(&s->worker[i], &s->grid,
                                                       &s->run, sizes) != KOKSMA_OK)
            return KOKSMA_ENOMEM;
    return KOKSMA_OK;
}

static void end(search *s)
{
    if (s->worker != NULL)
        for (size_t i = 0; i < ki_team_threads(s->run.team); i++)
            ki_lines_worker_end(&s->worker[i]);
    free(s->worker);
    ki_lines_grid_free(&s->grid);
    ki_run_end(&s->run);
}

koksma_status ki_star_lines_with(ki_best *b, const koksma_star_opts *opts,
                                 ki_lines_sizes sizes, double *upper, double *work,
                                 bool *stopped)
{
    search *s = calloc(1, sizeof *s);
    koksma_status status;

    if (s == NULL) return KOKSMA_ENOMEM;
    status = begin(s, b, opts, sizes);
    if (status == KOKSMA_OK) {
        ki_run_stages(&s->run, search_stage, s);
        for (size_t i = 0; i < ki_team_threads(s->run.team); i++)
            s->run.work += s->worker[i].work;
        status = ki_run_outcome(&s->run, upper, work, stopped);
    }
    if (status == KOKSMA_OK && *stopped) status = settle_witness(b);
    end(s);
    free(s);
    return status;
}

koksma_status ki_star_lines(ki_best *b, const koksma_star_opts *opts, double *upper,
                            double *work, bool *stopped)
{
    bool slab = b->p.dim == 2;
    ki_lines_sizes sizes = {.leaf = slab ? LEAF_SLAB : LEAF_CELL,
                            .finds = KI_LINES_FINDS,
                            .dense = DENSE,
                            .climbs = slab ? 1 : KI_LINES_CLIMBS};

    return ki_star_lines_with(b, opts, sizes, upper, work, stopped);
}
