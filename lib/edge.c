#include "edge.h"

#include <stdlib.h>

#include "edge_kernels.h"
#include "error.h"

/* Below this the sweep is as fast: measured. */
enum { SWEEP_MOST = 64 };

static koksma_status check_opts(const koksma_edge_opts *opts, koksma_points p,
                                koksma_error *err)
{
    if (opts->method < KOKSMA_EDGE_AUTO || opts->method > KOKSMA_EDGE_TREE)
        return ki_fail(err, KOKSMA_EINVAL, 0, "there is no method %d",
                       (int)opts->method);
    if (!(opts->tolerance >= 0.0))
        return ki_fail(err, KOKSMA_EINVAL, 0, "the tolerance is %g",
                       opts->tolerance);
    if (p.dim != 2)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "half-planes take 2 coordinates, not %zu", p.dim);
    if (p.n >= (size_t)1 << 31)
        return ki_fail(err, KOKSMA_EINVAL, 0, "%zu points: 2^31 are too many", p.n);
    return KOKSMA_OK;
}

static int by_place(const void *a, const void *b)
{
    const double *p = a, *q = b;
    int order = (p[0] > q[0]) - (p[0] < q[0]);

    return order != 0 ? order : (p[1] > q[1]) - (p[1] < q[1]);
}

/* The different points of `at`, which are sorted, into x, y, and into w how often
 * each is there.  -0 becomes 0.  Returns how many. */
static size_t merge(double *x, double *y, double *w, const double *at, size_t n)
{
    size_t count = 0;

    for (size_t i = 0; i < n; i++) {
        if (i > 0 && by_place(at + 2 * i, at + 2 * (i - 1)) == 0) {
            w[count - 1] += 1.0;
            continue;
        }
        x[count] = at[2 * i] + 0.0;
        y[count] = at[2 * i + 1] + 0.0;
        w[count++] = 1.0;
    }
    return count;
}

/* `memory` has room for 5 n numbers and three paddings. */
static ki_edge_points different_points(double *memory, koksma_points p)
{
    double *x = memory, *y = x + p.n + KI_EDGE_LANES, *w = y + p.n + KI_EDGE_LANES;
    double *at = w + p.n + KI_EDGE_LANES;
    size_t count;

    for (size_t i = 0; i < 2 * p.n; i++)
        at[i] = p.x[i];
    qsort(at, p.n, 2 * sizeof *at, by_place);
    count = merge(x, y, w, at, p.n);
    ki_edge_pad(x, y, w, count);
    return (ki_edge_points){{x, y}, count < p.n ? w : NULL, count, p.n};
}

koksma_status koksma_edge(koksma_edge_result *out, koksma_points p,
                          const koksma_edge_opts *opts, koksma_error *err)
{
    static const koksma_edge_opts defaults = KOKSMA_EDGE_DEFAULTS;
    koksma_status status = koksma_points_check(p, err);
    koksma_edge_method method;
    ki_edge_points points;
    double *memory;
    ki_edge_run run;
    bool stopped;

    if (opts == NULL) opts = &defaults;
    if (status == KOKSMA_OK) status = check_opts(opts, p, err);
    if (status != KOKSMA_OK) return status;
    method = opts->method;
    if (method == KOKSMA_EDGE_AUTO)
        method = p.n <= SWEEP_MOST ? KOKSMA_EDGE_SWEEP : KOKSMA_EDGE_TREE;
    memory = ki_alloc(5 * p.n + 3 * KI_EDGE_LANES, sizeof *memory);
    if (memory == NULL) return ki_fail_memory(err, "the different points");
    if (ki_edge_run_begin(&run, p.n, opts) != KOKSMA_OK) {
        free(memory);
        return ki_fail_memory(err, "threads");
    }
    points = different_points(memory, p);
    ki_edge_offer_corners(&run, &points);
    (method == KOKSMA_EDGE_SWEEP ? ki_edge_sweep : ki_edge_tree)(&run, &points);
    stopped = ki_team_stopped(run.team);
    ki_edge_run_end(&run);
    free(memory);
    if (run.no_memory) return ki_fail_memory(err, "the search for lines");
    *out = (koksma_edge_result){
        {run.value.lower, run.upper}, run.witness, method, run.work};
    if (!stopped) return KOKSMA_OK;
    return ki_fail(err, KOKSMA_STOPPED, 0,
                   "stopped after %.3g steps; the interval so far is true",
                   run.work);
}
