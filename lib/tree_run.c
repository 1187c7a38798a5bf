#include <math.h>

#include "error.h"
#include "tree_run_kernels.h"

koksma_status ki_run_opts_check(ki_run_opts opts, size_t n, koksma_error *err)
{
    if (!(opts.work >= 0.0))
        return ki_fail(err, KOKSMA_EINVAL, 0, "the work to stop after is %g steps",
                       opts.work);
    if (!(opts.tolerance >= 0.0))
        return ki_fail(err, KOKSMA_EINVAL, 0, "the tolerance is %g",
                       opts.tolerance);
    if (opts.parts > 1 && (opts.part < 1 || opts.part > opts.parts))
        return ki_fail(err, KOKSMA_EINVAL, 0, "there is no part %zu of %zu",
                       opts.part, opts.parts);
    if (n >= (size_t)1 << 31)
        return ki_fail(err, KOKSMA_EINVAL, 0, "%zu points: 2^31 are too many", n);
    return KOKSMA_OK;
}

koksma_status ki_run_begin(ki_run *r, ki_best *b, const ki_run_opts *opts)
{
    *r = (ki_run){.opts = *opts, .best = b, .factor = 1.0, .upper = 1.0};
    r->team = ki_team_open(opts->threads);
    if (r->team == NULL) return KOKSMA_ENOMEM;
    ki_team_raise(r->team, b->proven);
    return KOKSMA_OK;
}

void ki_run_end(ki_run *r) { ki_team_close(r->team); }

double ki_run_target(const ki_run *r) { return r->factor * ki_team_peak(r->team); }

/* With the lock held. */
static void report(ki_run *r, double work)
{
    const ki_run_opts *opts = &r->opts;

    r->work += work;
    if (ki_team_stopped(r->team)) return; /* the caller has had his say */
    if ((opts->work > 0.0 && r->work > opts->work) ||
        (opts->progress != NULL &&
         opts->progress(opts->state, r->best->value.lower, r->upper, r->work) != 0))
        ki_team_stop(r->team);
}

void ki_run_offer(ki_run *r, const double *corner, size_t inside, bool closed)
{
    double before;

    ki_team_lock(r->team);
    before = r->best->proven;
    ki_best_offer(r->best, corner, inside, closed);
    if (r->best->proven > before) {
        ki_team_raise(r->team, r->best->proven);
        report(r, 0.0);
    }
    ki_team_unlock(r->team);
}

bool ki_run_told_to_stop(ki_run *r, double *work)
{
    if (*work >= 0x1p18) {
        ki_team_lock(r->team);
        report(r, *work);
        ki_team_unlock(r->team);
        *work = 0.0;
    }
    return ki_team_stopped(r->team);
}

void ki_run_give_up(ki_run *r)
{
    ki_team_lock(r->team);
    r->no_memory = true;
    ki_team_unlock(r->team);
    ki_team_stop(r->team);
}

static void run_stage(ki_run *r, double factor, ki_run_stage *stage, void *state)
{
    if (ki_team_stopped(r->team)) return;
    r->factor = factor;
    stage(state);
    if (ki_team_stopped(r->team)) return;
    r->upper = fmin(r->upper, fmax(r->best->value.upper, factor * r->best->proven));
    report(r, 0.0);
}

/* The stages make early bounds: each costs a part of the next.  Shares have none:
 * what is dealt to them must not depend on what one of them has found. */
void ki_run_stages(ki_run *r, ki_run_stage *stage, void *state)
{
    static const double stages[] = {7.0, 3.0, 1.0, 0.5, 0.25, 0.1, 0.05};
    double tolerance = r->opts.tolerance;

    if (r->opts.anytime && r->opts.parts <= 1)
        for (size_t i = 0; i < sizeof stages / sizeof stages[0]; i++)
            if (stages[i] > tolerance) run_stage(r, 1.0 + stages[i], stage, state);
    run_stage(r, 1.0 + tolerance, stage, state);
}

koksma_status ki_run_outcome(const ki_run *r, double *upper, double *work,
                             bool *stopped)
{
    *upper = r->upper;
    *work = r->work;
    *stopped = ki_team_stopped(r->team);
    return r->no_memory ? KOKSMA_ENOMEM : KOKSMA_OK;
}
