#include <stdlib.h>

#include "edge_kernels.h"

/* All lines about all points, or about a few, in both passes. */

static void about_both(ki_edge_sweeper *s, ki_edge_run *r, const ki_edge_points *p,
                       size_t i)
{
    s->best = -1.0;
    s->partner = p->count;
    for (int pass = 0; pass < KI_EDGE_PASSES; pass++) {
        ki_edge_list l = ki_edge_whole(p, pass);

        ki_edge_sweep_about(s, r, &l, i, NULL);
    }
}

void ki_edge_climb(ki_edge_run *r, const ki_edge_points *p)
{
    enum { STARTS = 2, STEPS = 8 };
    ki_edge_sweeper s = {0};
    double work = 0.0;

    if (!ki_edge_sweeper_grow(&s, p->count)) {
        ki_edge_give_up(r);
        return;
    }
    for (size_t start = 0; start < STARTS; start++) {
        size_t i = (2 * start + 1) * p->count / (2 * STARTS);
        double best = -1.0;

        for (int step = 0; step < STEPS && i < p->count; step++) {
            about_both(&s, r, p, i);
            work += 2.0 * (double)p->count;
            if (ki_edge_told_to_stop(r, &work) || !(s.best > best)) break;
            best = s.best;
            i = s.partner;
        }
    }
    r->work += work;
    ki_edge_sweeper_free(&s);
}

typedef struct sweepers {
    ki_edge_run *run;
    const ki_edge_points *p;
    ki_edge_sweeper *of; /* each thread */
    double *work;
} sweepers;

static void sweep_point(void *state, size_t worker, size_t i)
{
    sweepers *all = state;
    ki_edge_sweeper *s = &all->of[worker];

    if (ki_edge_told_to_stop(all->run, &all->work[worker])) return;
    if (ki_edge_sweeper_grow(s, all->p->count))
        about_both(s, all->run, all->p, i);
    else
        ki_edge_give_up(all->run);
    all->work[worker] += 2.0 * (double)all->p->count;
}

void ki_edge_sweep_all(ki_edge_run *r, const ki_edge_points *p)
{
    size_t threads = ki_team_threads(r->team);
    sweepers all = {r, p, calloc(threads, sizeof *all.of),
                    calloc(threads, sizeof *all.work)};

    if (all.of == NULL || all.work == NULL)
        ki_edge_give_up(r);
    else
        ki_team_run(r->team, p->count, sweep_point, &all);
    for (size_t i = 0; i < threads && all.of != NULL && all.work != NULL; i++) {
        ki_edge_sweeper_free(&all.of[i]);
        r->work += all.work[i];
    }
    free(all.of);
    free(all.work);
}

typedef struct whole {
    ki_edge_run *run;
    const ki_edge_points *p;
} whole;

static void stage(void *state)
{
    const whole *w = state;

    ki_edge_sweep_all(w->run, w->p);
}

void ki_edge_sweep(ki_edge_run *r, const ki_edge_points *p)
{
    whole w = {r, p};

    ki_edge_run_stage(r, 1.0, stage, &w);
}
