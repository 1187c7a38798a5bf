#include "star.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "star_kernels.h"

koksma_interval koksma_box_local(const koksma_box *box, koksma_points p)
{
    size_t inside = ki_box_count(p, box->corner, p.dim, box->closed);

    return ki_box_deviation(p, box->corner, p.dim, inside, box->closed);
}

ki_run_opts ki_star_run_opts(const koksma_star_opts *opts)
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

static ki_star_kernel *const kernels[] = {
    [KOKSMA_STAR_SWEEP] = ki_star_sweep,   [KOKSMA_STAR_TREE] = ki_star_tree,
    [KOKSMA_STAR_LINES] = ki_star_lines,   [KOKSMA_STAR_DEM] = ki_star_dem,
    [KOKSMA_STAR_SEARCH] = ki_star_search,
};

/* The sweep is the plainest one, and the fastest for few corners: measured. */
static koksma_star_method choose(const koksma_star_opts *opts, koksma_points p)
{
    double corners = pow((double)p.n, (double)p.dim);
    bool lines = p.dim == 2 || p.dim == 3;

    if (opts->method != KOKSMA_STAR_AUTO) return opts->method;
    if (opts->parts > 1) return lines ? KOKSMA_STAR_LINES : KOKSMA_STAR_TREE;
    if (p.dim == 1 || corners <= (lines ? 0x1p16 : 0x1p20))
        return KOKSMA_STAR_SWEEP;
    return lines ? KOKSMA_STAR_LINES : KOKSMA_STAR_TREE;
}

static koksma_status check_opts(const koksma_star_opts *opts, koksma_points p,
                                koksma_error *err)
{
    if (opts->method < KOKSMA_STAR_AUTO || opts->method > KOKSMA_STAR_SEARCH)
        return ki_fail(err, KOKSMA_EINVAL, 0, "there is no method %d",
                       (int)opts->method);
    if (opts->parts > 1 && opts->method != KOKSMA_STAR_AUTO &&
        opts->method != KOKSMA_STAR_TREE && opts->method != KOKSMA_STAR_LINES)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "only the tree and the lines are cut into parts");
    if (opts->method == KOKSMA_STAR_LINES && p.dim != 2 && p.dim != 3)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "filtered lines take 2 or 3 coordinates, not %zu", p.dim);
    return ki_run_opts_check(ki_star_run_opts(opts), p.n, err);
}

koksma_status koksma_star(koksma_star_result *out, koksma_points p,
                          const koksma_star_opts *opts, koksma_error *err)
{
    static const koksma_star_opts defaults = KOKSMA_STAR_DEFAULTS;
    koksma_status status = koksma_points_check(p, err);
    koksma_star_result r = {.witness = {.corner = out->witness.corner}};
    double *corner;
    bool stopped = false;

    if (opts == NULL) opts = &defaults;
    if (status == KOKSMA_OK) status = check_opts(opts, p, err);
    if (status != KOKSMA_OK) return status;
    corner = calloc(p.dim, sizeof *corner);
    if (corner == NULL) return ki_fail_memory(err, "a corner");

    ki_best best = ki_best_begin(p, corner);

    r.method = choose(opts, p);
    status = kernels[r.method](&best, opts, &r.value.upper, &r.work, &stopped);
    if (status != KOKSMA_OK) {
        free(corner);
        return ki_fail_memory(err, "the search for boxes");
    }
    r.value.lower = best.value.lower;
    r.witness.inside = best.witness.inside;
    r.witness.closed = best.witness.closed;
    if (r.witness.corner != NULL)
        memcpy(r.witness.corner, corner, p.dim * sizeof *corner);
    free(corner);
    *out = r;
    if (!stopped) return KOKSMA_OK;
    return ki_fail(err, KOKSMA_STOPPED, 0,
                   "stopped after %.3g steps; the interval so far is true", r.work);
}
