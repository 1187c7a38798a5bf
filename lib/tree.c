#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "rng.h"
#include "tree_climb_kernels.h"
#include "tree_kernels.h"

/* The whole search: stages, each of which proves a bound; tasks, cells that the
 * threads take one after the other; shares, to which the tasks are dealt.
 *
 * An answer that was finished does not depend on the threads: whatever the order,
 * all boxes are offered that may be the best or tie with it. */

typedef struct search {
    ki_run run;
    ki_ranks ranks[2]; /* of open and of closed boxes */
    ki_worker *worker; /* two a thread, one a kind; all 0 until used */
    size_t part, parts;
    double climbed; /* points looked at before the tree, as last reported */
    ki_tasks tasks;
    uint32_t *low, *high; /* dim: of all the boxes of a kind */
} search;

/* The search for good boxes first: what is known early prunes.  It ends after so
 * many starts a kind and axis that made nothing better. */
enum { PATIENCE = 5 };

/* Tasks are made in so many cuts at most. */
enum { CUTS = 16 };

static bool climbed(void *state, double work)
{
    search *s = state;
    double more = work - s->climbed;

    ki_team_raise(s->run.team, s->run.best->proven);
    if (ki_run_told_to_stop(&s->run, &more)) return true;
    s->climbed = work - more;
    return false;
}

/* Thread `thread`'s worker for boxes of a kind; NULL without memory. */
static ki_worker *worker_of(search *s, size_t thread, bool closed)
{
    ki_worker *w = &s->worker[2 * thread + closed];

    if (w->run != NULL ||
        ki_worker_begin(w, &s->run, &s->ranks[closed]) == KOKSMA_OK)
        return w;
    ki_run_give_up(&s->run);
    return NULL;
}

/* The ranges of all boxes of a kind; whether there are any with a volume. */
static bool all_boxes(search *s, bool closed)
{
    const ki_ranks *r = &s->ranks[closed];

    for (size_t k = 0; k < r->axes; k++) {
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
    s->tasks.most = 0.0;
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
    size_t size = 2 * s->run.best->sides + 1, kept = 0;
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
    size_t axes = s->run.best->sides;
    const uint32_t *task = s->tasks.number + number * (2 * axes + 1);
    ki_worker *w = worker_of(s, thread, task[0] == 1);

    if (w != NULL) ki_dive(w, task + 1, task + 1 + axes, 0.0, NULL);
}

/* How many tasks there should be: shares of equal work take many, and must not
 * depend on the threads. */
static size_t enough_tasks(const search *s)
{
    size_t threads = ki_team_threads(s->run.team);

    if (s->parts > 1) return 32 * s->parts;
    return threads > 1 ? 64 * threads : 1;
}

/* Tasks of about equal work, as far as a cell's bound can tell: how much of it is
 * above the target decides how deep the search below goes.  Each cut takes the
 * hardest cells apart. */
static void cut(search *s)
{
    double target = ki_run_target(&s->run);

    make_tasks(s, HUGE_VAL);
    for (int cuts = 0;
         cuts < CUTS && s->tasks.count > 0 && s->tasks.count < enough_tasks(s) &&
         !ki_team_stopped(s->run.team);
         cuts++)
        make_tasks(s, target + 0.75 * (s->tasks.most - target));
    if (s->parts > 1) deal_tasks(s);
}

static void search_stage(void *state)
{
    search *s = state;

    cut(s);
    ki_team_run(s->run.team, s->tasks.count, work_on, s);
}

static koksma_status begin(search *s, ki_best *b, const ki_run_opts *opts,
                           const ki_measure *measure)
{
    size_t axes = b->sides;

    *s = (search){.part = opts->parts > 1 ? opts->part - 1 : 0,
                  .parts = opts->parts > 1 ? opts->parts : 1};
    if (ki_run_begin(&s->run, b, opts) != KOKSMA_OK) return KOKSMA_ENOMEM;
    s->worker = calloc(2 * ki_team_threads(s->run.team), sizeof *s->worker);
    s->low = ki_alloc(axes, 2 * sizeof *s->low);
    if (s->worker == NULL || s->low == NULL ||
        ki_ranks_make(&s->ranks[0], b->p, false, measure) != KOKSMA_OK ||
        ki_ranks_make(&s->ranks[1], b->p, true, measure) != KOKSMA_OK)
        return KOKSMA_ENOMEM;
    s->high = s->low + axes;
    return KOKSMA_OK;
}

static void end(search *s)
{
    if (s->worker != NULL)
        for (size_t i = 0; i < 2 * ki_team_threads(s->run.team); i++)
            ki_worker_end(&s->worker[i]);
    ki_ranks_free(&s->ranks[0]);
    ki_ranks_free(&s->ranks[1]);
    free(s->worker);
    free(s->low);
    free(s->tasks.number);
    ki_run_end(&s->run);
}

koksma_status ki_tree(ki_best *b, const ki_run_opts *opts,
                      const ki_measure *measure, ki_tree_before *before,
                      double *upper, double *work, bool *stopped)
{
    double *corner = ki_alloc(b->sides, sizeof *corner);
    search s = {0};
    koksma_status status =
        corner != NULL ? begin(&s, b, opts, measure) : KOKSMA_ENOMEM;

    if (status == KOKSMA_OK) {
        if (before != NULL) before(&s.run, corner);
        status = ki_climb(b, s.ranks, opts->seed, PATIENCE * b->p.dim, climbed, &s);
    }
    if (status == KOKSMA_OK) {
        ki_run_stages(&s.run, search_stage, &s);
        for (size_t i = 0; i < 2 * ki_team_threads(s.run.team); i++)
            s.run.work += s.worker[i].work;
        status = ki_run_outcome(&s.run, upper, work, stopped);
    }
    end(&s);
    free(corner);
    return status;
}
