#include "box.h"

#include <stdlib.h>
#include <string.h>

#include "box_kernels.h"
#include "error.h"

koksma_interval koksma_box_between(const koksma_box_witness *w, koksma_points p)
{
    size_t inside = ki_box_count(p, w->corners, 2 * p.dim, w->closed);

    return ki_box_deviation(p, w->corners, 2 * p.dim, inside, w->closed);
}

static koksma_status tree(ki_best *b, const ki_run_opts *opts, double *upper,
                          double *work, bool *stopped)
{
    return ki_tree(b, opts, &ki_box_measure, NULL, upper, work, stopped);
}

static koksma_status search(ki_best *b, const ki_run_opts *opts, double *upper,
                            double *work, bool *stopped)
{
    return ki_tree_search(b, opts, &ki_box_measure, KI_PATIENCE, upper, work,
                          stopped);
}

static ki_box_kernel *const kernels[] = {
    [KOKSMA_BOX_SWEEP] = ki_box_sweep,
    [KOKSMA_BOX_TREE] = tree,
    [KOKSMA_BOX_SEARCH] = search,
};

/* Where the best box found has fewer points too many than this, or few points are
 * there at all, the sweep is the faster one: measured. */
enum { CLOSE = 10, FEW = 64 };

/* Climbs in vain, a kind and coordinate, before the choice. */
enum { CLIMBS = 5 };

/* In the plane a few climbs say how uniform the points are; the incumbent keeps
 * what they find.  Where they are stopped they were all of it. */
static koksma_status choose(koksma_box_method *method, ki_best *b,
                            const ki_run_opts *opts, double *upper, double *work,
                            bool *stopped)
{
    bool told = *method != KOKSMA_BOX_AUTO;
    koksma_status status;

    if (!told) *method = b->p.dim == 1 ? KOKSMA_BOX_SWEEP : KOKSMA_BOX_TREE;
    if (*method == KOKSMA_BOX_SEARCH || b->p.dim != 2) return KOKSMA_OK;
    status = ki_tree_search(b, opts, &ki_box_measure, CLIMBS, upper, work, stopped);
    if (!told && (b->p.n <= FEW || (double)b->p.n * b->proven < CLOSE))
        *method = KOKSMA_BOX_SWEEP;
    if (*stopped) *method = KOKSMA_BOX_SEARCH;
    return status;
}

static ki_run_opts run_opts(const koksma_box_opts *opts)
{
    return (ki_run_opts){.tolerance = opts->tolerance,
                         .anytime = opts->anytime,
                         .threads = opts->threads,
                         .part = opts->part,
                         .parts = opts->parts,
                         .work = opts->work,
                         .seed = opts->seed,
                         .progress = opts->progress,
                         .state = opts->state};
}

static koksma_status check_opts(const koksma_box_opts *opts, koksma_points p,
                                koksma_error *err)
{
    if (opts->method < KOKSMA_BOX_AUTO || opts->method > KOKSMA_BOX_SEARCH)
        return ki_fail(err, KOKSMA_EINVAL, 0, "there is no method %d",
                       (int)opts->method);
    if (opts->parts > 1 && opts->method == KOKSMA_BOX_SEARCH)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "the search cannot be cut into parts");
    if (opts->method == KOKSMA_BOX_SWEEP && p.dim > 2)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "the sweep takes 1 or 2 coordinates, not %zu", p.dim);
    return ki_run_opts_check(run_opts(opts), p.n, err);
}

koksma_status koksma_box_discrepancy(koksma_box_result *out, koksma_points p,
                                     const koksma_box_opts *opts, koksma_error *err)
{
    static const koksma_box_opts defaults = KOKSMA_BOX_DEFAULTS;
    koksma_status status = koksma_points_check(p, err);
    koksma_box_result r = {.witness = {.corners = out->witness.corners}};
    double *corners;
    bool stopped = false;

    if (opts == NULL) opts = &defaults;
    if (status == KOKSMA_OK) status = check_opts(opts, p, err);
    if (status != KOKSMA_OK) return status;
    corners = p.dim <= SIZE_MAX / 2 ? calloc(2 * p.dim, sizeof *corners) : NULL;
    if (corners == NULL) return ki_fail_memory(err, "a box");

    ki_best best = ki_best_begin_between(p, corners);
    ki_run_opts shared = run_opts(opts);

    r.method = opts->method;
    status = choose(&r.method, &best, &shared, &r.value.upper, &r.work, &stopped);
    if (status == KOKSMA_OK && !stopped)
        status =
            kernels[r.method](&best, &shared, &r.value.upper, &r.work, &stopped);
    if (status != KOKSMA_OK) {
        free(corners);
        return ki_fail_memory(err, "the search for boxes");
    }
    r.value.lower = best.value.lower;
    r.witness.inside = best.witness.inside;
    r.witness.closed = best.witness.closed;
    if (r.witness.corners != NULL)
        memcpy(r.witness.corners, corners, 2 * p.dim * sizeof *corners);
    free(corners);
    *out = r;
    if (!stopped) return KOKSMA_OK;
    return ki_fail(err, KOKSMA_STOPPED, 0,
                   "stopped after %.3g steps; the interval so far is true", r.work);
}
