#include <string.h>

#include "edge_kernels.h"

koksma_status ki_edge_run_begin(ki_edge_run *r, size_t n,
                                const koksma_edge_opts *opts)
{
    *r = (ki_edge_run){.opts = opts,
                       .n = n,
                       .excess = {-1.0, 0.0, 0.0},
                       .factor = 1.0,
                       .upper = 1.0};
    r->team = ki_team_open(opts->threads);
    return r->team != NULL ? KOKSMA_OK : KOKSMA_ENOMEM;
}

void ki_edge_run_end(ki_edge_run *r) { ki_team_close(r->team); }

double ki_edge_bar(const ki_edge_run *r)
{
    return r->factor * ki_team_peak(r->team) - KI_EDGE_SLACK;
}

/* With the lock held. */
static void report(ki_edge_run *r, double work)
{
    const koksma_edge_opts *opts = r->opts;

    r->work += work;
    if (ki_team_stopped(r->team)) return;
    if (opts->progress != NULL &&
        opts->progress(opts->state, r->value.lower, r->upper, r->work) != 0)
        ki_team_stop(r->team);
}

bool ki_edge_told_to_stop(ki_edge_run *r, double *work)
{
    if (*work >= 0x1p22) {
        ki_team_lock(r->team);
        report(r, *work);
        ki_team_unlock(r->team);
        *work = 0.0;
    }
    return ki_team_stopped(r->team);
}

void ki_edge_give_up(ki_edge_run *r)
{
    ki_team_lock(r->team);
    r->no_memory = true;
    ki_team_unlock(r->team);
    ki_team_stop(r->team);
}

/* ---- The incumbent ------------------------------------------------------ */

static int compare(const double *a, const double *b)
{
    if (a[0] != b[0]) return a[0] < b[0] ? -1 : 1;
    return (a[1] > b[1]) - (a[1] < b[1]);
}

/* Whether a comes before b in lexicographic order. */
static bool precedes(const koksma_half_plane *a, const koksma_half_plane *b)
{
    int order = compare(a->from, b->from);

    return order != 0 ? order < 0 : compare(a->to, b->to) < 0;
}

/* An order of the half-planes alone, so that the witness does not depend on the
 * order in which they come.  All have the same error, so that the value does not
 * either. */
static bool is_better(const ki_edge_run *r, ki_twofold excess,
                      const koksma_half_plane *h)
{
    if (excess.hi != r->excess.hi) return excess.hi > r->excess.hi;
    if (excess.lo != r->excess.lo) return excess.lo > r->excess.lo;
    return precedes(h, &r->witness);
}

static void take(ki_edge_run *r, ki_twofold excess, const koksma_half_plane *h)
{
    double before = r->value.lower;

    r->excess = excess;
    r->witness = *h;
    r->value = ki_divide(excess, r->n);
    r->value.lower = fmax(r->value.lower, 0.0);
    r->value.upper = fmin(r->value.upper, 1.0);
    if (!(r->value.lower > before)) return;
    ki_team_raise(r->team, r->value.lower);
    report(r, 0.0);
}

static void offer_half(ki_edge_run *r, const double *from, const double *to,
                       double inside)
{
    koksma_half_plane h = {.inside = (size_t)inside};
    ki_twofold excess = ki_edge_excess(from, to, h.inside, r->n);

    memcpy(h.from, from, sizeof h.from);
    memcpy(h.to, to, sizeof h.to);
    ki_team_lock(r->team);
    if (is_better(r, excess, &h)) take(r, excess, &h);
    ki_team_unlock(r->team);
}

/* Both half-planes of a line.  Going across, what is below is right; the second
 * pass sees the square in a mirror, so there it is left. */
void ki_edge_offer(ki_edge_run *r, int pass, const double *a, const double *b,
                   double under, double on)
{
    double from[2] = {a[pass], a[1 - pass]}, to[2] = {b[pass], b[1 - pass]};
    bool across = a[0] < b[0], below_is_left = (pass == 1) == across;
    double all = (double)r->n, over = all - under - on;

    offer_half(r, from, to, on + (below_is_left ? under : over));
    offer_half(r, to, from, on + (below_is_left ? over : under));
}

/* Outwards from the corner (x,y) is (2x - 1, 2y - 1), and to the left of what
 * points a quarter turn before that. */
void ki_edge_offer_corners(ki_edge_run *r, const ki_edge_points *p)
{
    for (size_t i = 0; i < p->count; i++) {
        double at[2] = {p->x[0][i], p->x[1][i]}, end[2][2];
        double to[2] = {at[0] + (2.0 * at[1] - 1.0), at[1] - (2.0 * at[0] - 1.0)};

        if (!ki_edge_chord(end, at[0], at[1]))
            offer_half(r, at, to, ki_edge_weight(p->w, i));
    }
}

/* ---- Stages ------------------------------------------------------------- */

void ki_edge_run_stage(ki_edge_run *r, double factor, ki_edge_stage *stage,
                       void *state)
{
    if (ki_team_stopped(r->team)) return;
    r->factor = factor;
    stage(state);
    if (ki_team_stopped(r->team)) return;
    r->upper = fmin(r->upper, fmax(r->value.upper, factor * ki_team_peak(r->team)));
    ki_team_lock(r->team);
    report(r, 0.0);
    ki_team_unlock(r->team);
}

/* A stage with the factor f takes about 1/f^2 of what the last one takes: a few are
 * enough. */
void ki_edge_run_stages(ki_edge_run *r, ki_edge_stage *stage, void *state)
{
    static const double stages[] = {1.0, 0.25};
    double tolerance = r->opts->tolerance;

    if (r->opts->anytime)
        for (size_t i = 0; i < sizeof stages / sizeof stages[0]; i++)
            if (stages[i] > tolerance)
                ki_edge_run_stage(r, 1.0 + stages[i], stage, state);
    ki_edge_run_stage(r, 1.0 + tolerance, stage, state);
}
