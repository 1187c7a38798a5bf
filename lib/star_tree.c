#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "rng.h"
#include "star_climb_kernels.h"
#include "star_tree_kernels.h"

/* The whole search: stages, each of which proves a bound; tasks, cells that the
 * threads take one after the other; shares, every m-th task.
 *
 * An answer that was finished does not depend on the threads: whatever the order,
 * all boxes are offered that may be the best or tie with it. */

typedef struct search {
    ki_tree tree;
    ki_worker
        *worker; /* two a thread, for open and closed boxes; all 0 until used */
    size_t part, parts;
    double climbed; /* points looked at before the tree, as last reported */
    ki_tasks tasks;
    uint32_t *low, *high; /* dim: of all the boxes of a kind */
} search;

void ki_tree_report(ki_tree *t, double work)
{
    const koksma_star_opts *opts = t->opts;

    t->work += work;
    if (ki_team_stopped(t->team)) return; /* the caller has had his say */
    if ((opts->work > 0.0 && t->work > opts->work) ||
        (opts->progress != NULL &&
         opts->progress(opts->state, t->best->value.lower, t->upper, t->work) != 0))
        ki_team_stop(t->team);
}

void ki_tree_offer(ki_tree *t, const double *corner, size_t inside, bool closed)
{
    ki_team_lock(t->team);

    double before = t->best->proven;

    ki_best_offer(t->best, corner, inside, closed);
    if (t->best->proven > before) {
        ki_team_raise(t->team, t->best->proven);
        ki_tree_report(t, 0.0);
    }
    ki_team_unlock(t->team);
}

/* Closed boxes with a side of length 0 have no volume, and no logarithm: the one
 * that matters along each axis holds the points at 0 there, and no more. */
static void offer_flat_boxes(ki_tree *t, double *corner)
{
    koksma_points p = t->best->p;

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
        if (inside > 0) ki_tree_offer(t, corner, inside, true);
    }
}

/* The search for good boxes first: what is known early prunes.  It ends after so
 * many starts a kind and axis that made nothing better. */
enum { PATIENCE = 5 };

static bool climbed(void *state, double work)
{
    search *s = state;
    ki_tree *t = &s->tree;

    ki_team_raise(t->team, t->best->proven);
    if (work - s->climbed < 0x1p18) return false;
    ki_team_lock(t->team);
    ki_tree_report(t, work - s->climbed);
    ki_team_unlock(t->team);
    s->climbed = work;
    return ki_team_stopped(t->team);
}

/* Thread `thread`'s worker for boxes of a kind; NULL without memory. */
static ki_worker *worker_of(search *s, size_t thread, bool closed)
{
    ki_worker *w = &s->worker[2 * thread + closed];

    if (w->tree == NULL && ki_worker_begin(w, &s->tree, closed) != KOKSMA_OK) {
        ki_team_lock(s->tree.team);
        s->tree.no_memory = true;
        ki_team_unlock(s->tree.team);
        ki_team_stop(s->tree.team);
        return NULL;
    }
    return w;
}

/* The ranges of all boxes of a kind; whether there are any with a volume. */
static bool all_boxes(search *s, bool closed)
{
    const ki_ranks *r = &s->tree.ranks[closed];

    for (size_t k = 0; k < r->dim; k++) {
        s->low[k] = 1;
        s->high[k] = r->axis[k].top;
        if (s->high[k] == 0) return false;
    }
    return true;
}

/* Cut the search into tasks: the cells that cannot hold more than `most`. */
static void make_tasks(search *s, double most)
{
    s->tasks.count = 0;
    /* Closed boxes first: of most sets they hold the extreme, and knowing it early
     * prunes the other search. */
    for (int closed = 1; closed >= 0; closed--) {
        ki_worker *w = worker_of(s, 0, closed);

        if (w == NULL) return;
        if (all_boxes(s, closed)) ki_dive(w, s->low, s->high, most, &s->tasks);
    }
}

/* Keep this share of the tasks.  They are dealt at random, since neighbours are
 * alike, and the same way for all shares. */
static void deal_tasks(search *s)
{
    size_t size = 2 * s->tree.best->p.dim + 1, kept = 0;
    koksma_rng rng = koksma_rng_seed(0, 0);

    for (size_t i = 0; i < s->tasks.count; i++)
        if (koksma_rng_below(&rng, s->parts) == s->part)
            memmove(s->tasks.number + kept++ * size, s->tasks.number + i * size,
                    size * sizeof *s->tasks.number);
    s->tasks.count = kept;
}

/* A thread's work on a task. */
static void work_on(void *state, size_t thread, size_t number)
{
    search *s = state;
    size_t dim = s->tree.best->p.dim;
    const uint32_t *task = s->tasks.number + number * (2 * dim + 1);
    ki_worker *w = worker_of(s, thread, task[0] == 1);

    if (w != NULL) ki_dive(w, task + 1, task + 1 + dim, 0.0, NULL);
}

/* How many tasks there should be: shares of equal work take many, and must not
 * depend on the threads. */
static size_t enough_tasks(const search *s)
{
    size_t threads = ki_team_threads(s->tree.team);

    if (s->parts > 1) return 128 * s->parts;
    return threads > 1 ? 128 * threads : 1;
}

/* Tasks of about equal work, as far as a cell's bound can tell: how much of it is
 * above the target decides how deep the search below goes. */
static void cut(search *s)
{
    double target = s->tree.factor * s->tree.best->proven, above = 1.0 - target;

    make_tasks(s, HUGE_VAL);
    while (s->tasks.count > 0 && s->tasks.count < enough_tasks(s) && above > 1e-9 &&
           !ki_team_stopped(s->tree.team)) {
        above *= 0.7;
        make_tasks(s, target + above);
    }
}

/* A stage: as it ends no box of this share deviates by more than factor * the
 * incumbent. */
static void search_stage(search *s, double factor)
{
    ki_tree *t = &s->tree;

    if (ki_team_stopped(t->team)) return;
    t->factor = factor;
    cut(s);
    if (s->parts > 1) deal_tasks(s);
    ki_team_run(t->team, s->tasks.count, work_on, s);
    if (ki_team_stopped(t->team)) return;
    t->upper = fmin(t->upper, fmax(t->best->value.upper, factor * t->best->proven));
    ki_tree_report(t, 0.0);
}

/* The stages make early bounds: each costs a part of the next. */
static void search_all(search *s)
{
    static const double stages[] = {1.0, 0.5, 0.25, 0.1, 0.05};
    const koksma_star_opts *opts = s->tree.opts;

    if (opts->anytime)
        for (size_t i = 0; i < sizeof stages / sizeof stages[0]; i++)
            if (stages[i] > opts->tolerance) search_stage(s, 1.0 + stages[i]);
    search_stage(s, 1.0 + opts->tolerance);
}

static koksma_status begin(search *s, ki_best *b, const koksma_star_opts *opts)
{
    size_t dim = b->p.dim;

    *s = (search){.tree = {.opts = opts, .best = b, .upper = 1.0},
                  .part = opts->parts > 1 ? opts->part - 1 : 0,
                  .parts = opts->parts > 1 ? opts->parts : 1};
    s->tree.team = ki_team_open(opts->threads);
    if (s->tree.team == NULL) return KOKSMA_ENOMEM;
    ki_team_raise(s->tree.team, b->proven);
    s->worker = calloc(2 * ki_team_threads(s->tree.team), sizeof *s->worker);
    s->low = ki_alloc(dim, 2 * sizeof *s->low);
    if (s->worker == NULL || s->low == NULL ||
        ki_ranks_make(&s->tree.ranks[0], b->p, false) != KOKSMA_OK ||
        ki_ranks_make(&s->tree.ranks[1], b->p, true) != KOKSMA_OK)
        return KOKSMA_ENOMEM;
    s->high = s->low + dim;
    return KOKSMA_OK;
}

static void end(search *s)
{
    if (s->worker != NULL)
        for (size_t i = 0; i < 2 * ki_team_threads(s->tree.team); i++)
            ki_worker_end(&s->worker[i]);
    ki_ranks_free(&s->tree.ranks[0]);
    ki_ranks_free(&s->tree.ranks[1]);
    free(s->worker);
    free(s->low);
    free(s->tasks.number);
    ki_team_close(s->tree.team);
}

koksma_status ki_star_tree(ki_best *b, const koksma_star_opts *opts, double *upper,
                           double *work, bool *stopped)
{
    double *corner = ki_alloc(b->p.dim, sizeof *corner);
    search s = {0};
    koksma_status status = corner != NULL ? begin(&s, b, opts) : KOKSMA_ENOMEM;

    if (status == KOKSMA_OK) {
        offer_flat_boxes(&s.tree, corner);
        status =
            ki_climb(b, s.tree.ranks, opts->seed, PATIENCE * b->p.dim, climbed, &s);
        if (status == KOKSMA_OK) search_all(&s);
        if (s.tree.no_memory) status = KOKSMA_ENOMEM;
        for (size_t i = 0; i < 2 * ki_team_threads(s.tree.team); i++)
            s.tree.work += s.worker[i].work;
        *upper = s.tree.upper;
        *work = s.tree.work;
        *stopped = ki_team_stopped(s.tree.team);
    }
    end(&s);
    free(corner);
    return status;
}
