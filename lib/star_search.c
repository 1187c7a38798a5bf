#include <stdlib.h>

#include "star_climb_kernels.h"

/* The heuristic alone: climbers for both kinds of boxes take turns, for as long as
 * that pays. */

/* Stop after so many starts a kind and axis that made nothing better.  Measured:
 * that finds D* where it is known, but for one set in many. */
enum { PATIENCE = 100 };

/* What is known without a search: no deviation is above 1. */
static const double UPPER = 1.0;

typedef struct search {
    ki_best *best;
    const koksma_star_opts *opts;
    ki_climber climber[2];
    double next_report;
} search;

static double work_of(const search *s)
{
    return s->climber[0].work + s->climber[1].work;
}

static bool told_to_stop(search *s)
{
    const koksma_star_opts *opts = s->opts;
    double work = work_of(s);

    if (work < s->next_report) return false;
    s->next_report = work + 0x1p20;
    return (opts->work > 0.0 && work > opts->work) ||
           (opts->progress != NULL &&
            opts->progress(opts->state, s->best->value.lower, UPPER, work) != 0);
}

/* Returns false when it was stopped. */
static bool run(search *s)
{
    size_t patience = PATIENCE * s->best->p.dim;

    for (size_t idle = 0; idle < patience; idle++) {
        double before = s->best->value.lower;

        for (int kind = 0; kind < 2; kind++)
            ki_climber_go(&s->climber[kind], 1);
        if (s->best->value.lower > before) idle = 0;
        if (told_to_stop(s)) return false;
    }
    return true;
}

koksma_status ki_star_search(ki_best *b, const koksma_star_opts *opts,
                             double *upper, double *work, bool *stopped)
{
    search s = {.best = b, .opts = opts, .next_report = 0x1p20};
    ki_ranks ranks[2] = {{0}};
    koksma_status status = KOKSMA_OK;

    for (int kind = 0; kind < 2 && status == KOKSMA_OK; kind++) {
        status = ki_ranks_make(&ranks[kind], b->p, kind == 1);
        if (status == KOKSMA_OK)
            status =
                ki_climber_begin(&s.climber[kind], &ranks[kind], b, opts->seed);
    }
    if (status == KOKSMA_OK) *stopped = !run(&s);
    *upper = UPPER;
    *work = work_of(&s);
    for (int kind = 0; kind < 2; kind++) {
        ki_climber_end(&s.climber[kind]);
        ki_ranks_free(&ranks[kind]);
    }
    return status;
}
