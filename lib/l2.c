#include "l2.h"

#include <float.h>
#include <stdlib.h>

#include "error.h"
#include "l2_kernels.h"

void ki_l2_report(ki_l2_job *job, double work)
{
    ki_team_lock(job->team);
    job->work += work;
    if (job->opts->progress != NULL && !ki_team_stopped(job->team) &&
        job->opts->progress(job->opts->state, 0.0, HUGE_VAL, job->work) != 0)
        ki_team_stop(job->team);
    ki_team_unlock(job->team);
}

/* ---- From the sums to intervals ---------------------------------------------- */

/* c^dim - 2/n sum h + 1/n^2 sum K, or sum K / n^2 - c^dim. */
static ki_l2_number combine(const ki_l2_job *job, ki_l2_number pairs)
{
    double n = (double)job->p.n;
    ki_l2_number c = ki_l2_constant(job->kind, job->p.dim), h = {0};

    pairs = ki_l2_divide_by(ki_l2_divide_by(pairs, n), n);
    pairs = ki_l2_scale(pairs, (int64_t)job->p.dim * job->row->twos);
    if (job->row->sign < 0) {
        c.m = ki_twice_negate(c.m);
    } else {
        h = ki_l2_divide_by(ki_l2_linear(job->p, job->kind), n);
        h = ki_l2_scale(h, 1);
        h.m = ki_twice_negate(h.m);
    }
    c = ki_l2_add(ki_l2_add(ki_l2_normal(c), h), ki_l2_normal(pairs));
    return ki_l2_add(c, ki_l2_flushed(job->p, job->kind));
}

static double down(double v) { return nextafter(v, -HUGE_VAL); }
static double up(double v) { return nextafter(v, HUGE_VAL); }

/* v 2^e rounded outward: ldexp rounds where it underflows, and is HUGE_VAL where it
 * overflows, from which down leads back to the greatest double. */
static double scale(double v, int64_t e, bool upward)
{
    int shift = e > 5000 ? 5000 : e < -5000 ? -5000 : (int)e;
    double s;

    if (v <= 0.0) return 0.0;
    s = ldexp(v, shift);
    if (s >= DBL_MIN && s <= DBL_MAX) return s;
    return upward ? up(s) : s > 0.0 ? down(s) : 0.0;
}

/* log10(v 2^e) / factor to within 1e-13 of it: log is within 2^-51, and three
 * roundings and two constants follow. */
static double logarithm(double v, int64_t e, bool upward)
{
    static const double LOG_2 = 0.69314718055994530942,
                        LOG_10 = 2.30258509299404568402;
    double a, b, value, slack;

    if (v <= 0.0) return -HUGE_VAL;
    a = log(v);
    b = (double)e * LOG_2;
    value = 0.5 * (a + b) / LOG_10;
    slack = (fabs(a) + fabs(b) + DBL_MIN) * 0x1p-49;
    return upward ? up(value + slack) : down(value - slack);
}

/* L2^2 is in [lower, upper] 2^e; sqrt rounds once. */
static void fill(koksma_l2_result *r, double lower, double upper, int64_t e)
{
    int64_t odd = e & 1, half = (e - odd) / 2;

    if (!(lower > 0.0)) lower = 0.0;
    if (!(upper > 0.0)) upper = 0.0;
    r->squared = (koksma_interval){scale(lower, e, false), scale(upper, e, true)};
    r->log10 =
        (koksma_interval){logarithm(lower, e, false), logarithm(upper, e, true)};
    r->value.lower = scale(down(sqrt(ldexp(lower, (int)odd))), half, false);
    r->value.upper = scale(up(sqrt(ldexp(upper, (int)odd))), half, true);
}

static void conclude(koksma_l2_result *r, ki_l2_number v)
{
    v = ki_l2_normal(v);

    /* The roundings of m.lo - err, and of the sum. */
    double lower = down(v.m.hi + down(v.m.lo - v.err));
    double upper = up(v.m.hi + up(v.m.lo + v.err));

    fill(r, lower, upper, v.e);
}

/* ---- The public function ----------------------------------------------------- */

/* From how many points on divide is faster with one thread, about, by its terms and
 * the dimension; measured on Halton points. */
static koksma_l2_method choose(const koksma_l2_opts *opts, koksma_points p)
{
    static const double FROM[4][6] = {
        [0] = {0.0, 0.0, 4e3, 1e4, 3e4, 2e5},
        [2] = {0.0, 0.0, 5e3, 1e4, 8e4, 1e6},
        [3] = {0.0, 0.0, 5e3, 2e4, 2e5, 4e6},
    };

    if (opts->method != KOKSMA_L2_AUTO) return opts->method;
    if (p.dim > 5) return KOKSMA_L2_PAIRS;
    return (double)p.n >= FROM[ki_l2_rows[opts->kind].terms][p.dim]
               ? KOKSMA_L2_DIVIDE
               : KOKSMA_L2_PAIRS;
}

static koksma_status check_opts(const koksma_l2_opts *opts, koksma_points p,
                                koksma_error *err)
{
    if (opts->kind < KOKSMA_L2_STAR || opts->kind >= KOKSMA_L2_KINDS)
        return ki_fail(err, KOKSMA_EINVAL, 0, "there is no kind %d",
                       (int)opts->kind);
    if (opts->method < KOKSMA_L2_AUTO || opts->method > KOKSMA_L2_DIVIDE)
        return ki_fail(err, KOKSMA_EINVAL, 0, "there is no method %d",
                       (int)opts->method);
    if (p.n >= (size_t)1 << 31)
        return ki_fail(err, KOKSMA_EINVAL, 0, "%zu points: 2^31 are too many", p.n);
    if (p.dim >= (size_t)1 << 30)
        return ki_fail(err, KOKSMA_EINVAL, 0, "%zu coordinates: 2^30 are too many",
                       p.dim);
    if (opts->method == KOKSMA_L2_DIVIDE && p.dim > ki_l2_divide_dim(opts->kind))
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "%zu coordinates: divide takes at most %zu of %s", p.dim,
                       ki_l2_divide_dim(opts->kind), koksma_l2_names[opts->kind]);
    return KOKSMA_OK;
}

koksma_status koksma_l2(koksma_l2_result *out, koksma_points p,
                        const koksma_l2_opts *opts, koksma_error *err)
{
    static const koksma_l2_opts defaults = KOKSMA_L2_DEFAULTS;
    koksma_status status = koksma_points_check(p, err);
    koksma_l2_result r = {.squared = {0.0, HUGE_VAL}};
    ki_l2_number pairs = {0};
    bool stopped;

    if (opts == NULL) opts = &defaults;
    if (status == KOKSMA_OK) status = check_opts(opts, p, err);
    if (status != KOKSMA_OK) return status;

    ki_l2_job job = {.p = p,
                     .kind = opts->kind,
                     .row = &ki_l2_rows[opts->kind],
                     .team = ki_team_open(opts->threads),
                     .opts = opts};

    if (job.team == NULL) return ki_fail_memory(err, "threads");
    r.method = choose(opts, p);
    status = r.method == KOKSMA_L2_PAIRS ? ki_l2_pairs(&pairs, &job)
                                         : ki_l2_divide(&pairs, &job);
    stopped = ki_team_stopped(job.team);
    ki_team_close(job.team);
    if (status != KOKSMA_OK) return ki_fail_memory(err, "the sum over pairs");
    r.work = job.work;
    if (!stopped) {
        conclude(&r, combine(&job, pairs));
        *out = r;
        return KOKSMA_OK;
    }
    r.value = r.squared;
    r.log10 = (koksma_interval){-HUGE_VAL, HUGE_VAL};
    *out = r;
    return ki_fail(err, KOKSMA_STOPPED, 0, "stopped after %.3g steps", r.work);
}
