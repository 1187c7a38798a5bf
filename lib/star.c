#include "star.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "num_kernels.h"
#include "star_kernels.h"

static size_t count_inside(const double *corner, koksma_points p, bool closed)
{
    size_t inside = 0;

    for (size_t i = 0; i < p.n; i++) {
        const double *x = p.x + i * p.dim;
        size_t k = 0;

        while (k < p.dim && (closed ? x[k] <= corner[k] : x[k] < corner[k]))
            k++;
        inside += k == p.dim;
    }
    return inside;
}

/* No deviation is above 1, though a rounded one may seem so. */
static koksma_interval local(koksma_points p, const double *corner, size_t inside,
                             bool closed)
{
    koksma_interval v =
        ki_deviation(closed ? 1.0 : -1.0, inside, p.n, ki_volume(corner, p.dim));

    if (v.upper > 1.0) v.upper = 1.0;
    return v;
}

koksma_interval koksma_box_local(const koksma_box *box, koksma_points p)
{
    return local(p, box->corner, count_inside(box->corner, p, box->closed),
                 box->closed);
}

/* Whether a comes before b in lexicographic order. */
static bool precedes(const double *a, const double *b, size_t dim)
{
    size_t k = 0;

    while (k < dim && a[k] == b[k])
        k++;
    return k < dim && a[k] < b[k];
}

void ki_best_offer(ki_best *b, const double *corner, size_t inside, bool closed)
{
    size_t dim = b->p.dim;
    koksma_interval v = local(b->p, corner, inside, closed);

    if (v.upper > b->value.upper) b->value.upper = v.upper;
    if (v.lower < b->value.lower ||
        (v.lower == b->value.lower && !precedes(corner, b->witness.corner, dim)))
        return;
    memcpy(b->witness.corner, corner, dim * sizeof *corner);
    b->witness.inside = inside;
    b->witness.closed = closed;
    b->value.lower = v.lower;
    b->bar = v.lower - b->slack;
}

/* A plain deviation is off by less than dim + 2 half-ulps of 1: dim - 1 products,
 * two roundings in count * (1/n) or one in count/n, one subtraction, and a
 * margin for second-order terms and underflow. */
static ki_best best_begin(koksma_points p, double *corner)
{
    double slack = (double)(p.dim + 2) * 2.0 * DBL_EPSILON;

    return (ki_best){
        .p = p, .witness.corner = corner, .slack = slack, .bar = -slack};
}

koksma_status koksma_star(koksma_star_result *out, koksma_points p,
                          const koksma_star_opts *opts, koksma_error *err)
{
    static const koksma_star_opts defaults = KOKSMA_STAR_DEFAULTS;
    koksma_status status = koksma_points_check(p, err);
    double *corner, *wanted = out->witness.corner;
    ki_sweep_scratch *room;
    bool stopped = false;

    if (status != KOKSMA_OK) return status;
    if (opts == NULL) opts = &defaults;
    if (!(opts->work >= 0.0))
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "the work to stop after is %g corners", opts->work);
    corner = ki_alloc(p.dim, sizeof *corner);
    room = ki_sweep_room(p.n, p.dim);
    if (corner == NULL || room == NULL) {
        free(corner);
        free(room);
        return ki_fail_memory(err, "the sweep's lists");
    }

    for (size_t k = 0; k < p.dim; k++)
        corner[k] = 0.0;
    ki_best best = best_begin(p, corner);
    double work = ki_star_sweep(&best, room, opts, &stopped);

    if (wanted != NULL) memcpy(wanted, corner, p.dim * sizeof *corner);
    out->value = best.value;
    out->witness = best.witness;
    out->witness.corner = wanted;
    out->work = work;
    free(corner);
    free(room);
    if (!stopped) return KOKSMA_OK;
    out->value.upper = 1.0;
    return ki_fail(err, KOKSMA_STOPPED, 0,
                   "stopped after %.3g corners; the interval so far is true", work);
}
