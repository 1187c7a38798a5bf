#include "tree_climb_kernels.h"

/* The heuristic alone. */

/* What is known without a search: no deviation is above 1. */
static const double UPPER = 1.0;

typedef struct search {
    const ki_best *best;
    const ki_run_opts *opts;
    double work;
    double since; /* the last report, what it took */
    bool stopped;
} search;

static bool told_to_stop(void *state, double work)
{
    search *s = state;
    const ki_run_opts *opts = s->opts;
    double sides = (double)s->best->sides;

    /* A climb multiplies all sides at each: with many of them the points are few. */
    s->since += work - s->work + sides * sides;
    s->work = work;
    if (s->since < 0x1p20) return false;
    s->since = 0.0;
    s->stopped =
        (opts->work > 0.0 && work > opts->work) ||
        (opts->progress != NULL &&
         opts->progress(opts->state, s->best->value.lower, UPPER, work) != 0);
    return s->stopped;
}

koksma_status ki_tree_search(ki_best *b, const ki_run_opts *opts,
                             const ki_measure *measure, size_t patience,
                             double *upper, double *work, bool *stopped)
{
    search s = {.best = b, .opts = opts};
    ki_ranks ranks[2] = {{0}};
    koksma_status status = ki_ranks_make(&ranks[0], b->p, false, measure);

    if (status == KOKSMA_OK) status = ki_ranks_make(&ranks[1], b->p, true, measure);
    if (status == KOKSMA_OK)
        status =
            ki_climb(b, ranks, opts->seed, patience * b->p.dim, told_to_stop, &s);
    ki_ranks_free(&ranks[0]);
    ki_ranks_free(&ranks[1]);
    *upper = UPPER;
    *work = s.work;
    *stopped = s.stopped;
    return status;
}
