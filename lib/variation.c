#include "variation.h"

#include <math.h>

#include "error.h"
#include "variation_kernels.h"

/* ---- What grows, and what ends ----------------------------------------------- */

/* log2(V_2k/V_k) of levels i - 1 and i, and how far off it may be: to first order
 * the relative half-widths of both, added as independent errors are. */
static double rate_at(const koksma_variation_result *r, size_t i, double *off)
{
    koksma_estimate from = r->level[i - 1].value, to = r->level[i].value;

    *off = hypot((from.upper - from.lower) / from.value,
                 (to.upper - to.lower) / to.value) /
           2.0 / log(2.0);
    return log2(to.value / from.value);
}

void koksma_variation_judge(koksma_variation_result *r)
{
    double p, q, off_p, off_q, most;

    r->trend = KOKSMA_TREND_UNDECIDED;
    r->rate = (double)NAN;
    if (r->levels >= 2) r->rate = rate_at(r, r->levels - 1, &off_q);
    if (r->levels < 3) return;
    q = r->rate;
    p = rate_at(r, r->levels - 2, &off_p);
    if (r->level[r->levels - 1].value.upper == 0.0) {
        r->trend = KOKSMA_TREND_CONVERGED;
        return;
    }
    most = off_p > 0.0 || off_q > 0.0 ? 0.05 : 0.01;
    if (p - off_p > 0.25 && q - off_q > 0.25 && q + off_q >= p - off_p - 0.05 &&
        isfinite(p))
        r->trend = KOKSMA_TREND_DIVERGING;
    else if (fabs(p) + off_p < most && fabs(q) + off_q < most)
        r->trend = KOKSMA_TREND_CONVERGED;
}

/* ---- The choice -------------------------------------------------------------- */

enum { CELLS_MOST = 1 << 24 };

/* The largest k, a power of 2 and at least 2, of which the power is at most `most`.
 */
static size_t side_of(size_t power, double most)
{
    size_t k = 2;

    while (k < CELLS_MOST && pow(2.0 * (double)k, (double)power) <= most)
        k *= 2;
    return k;
}

/* Whether the tree would pass over many cells: a try on a coarse grid. */
static bool has_flat_parts(const koksma_integrand *f)
{
    size_t k = side_of(f->dim, 0x1p12);

    return f->range != NULL && (double)ki_variation_tree_leaves(f, k) <
                                   0.75 * pow((double)k, (double)f->dim);
}

static koksma_variation_method choose(const koksma_integrand *f,
                                      const koksma_variation_opts *o)
{
    if (o->method != KOKSMA_VARIATION_AUTO) return o->method;
    return f->dim <= 4 && has_flat_parts(f) ? KOKSMA_VARIATION_BOUNDARY
                                            : KOKSMA_VARIATION_GRID;
}

static koksma_status check(const koksma_integrand *f,
                           const koksma_variation_opts *o, koksma_error *err)
{
    koksma_status status = ki_variation_check_dim(f->dim, err);
    size_t k = o->cells;

    if (status != KOKSMA_OK) return status;
    if (k != 0 && (k < 2 || k > CELLS_MOST || (k & (k - 1)) != 0))
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "%zu cells an axis, which is no power of 2 from 2 to 2^24",
                       k);
    if (o->method == KOKSMA_VARIATION_BOUNDARY && f->range == NULL)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "boundary cells take an integrand whose range is known");
    if (o->method == KOKSMA_VARIATION_GRID && k != 0 &&
        pow((double)k + 1.0, (double)f->dim) > 0x1p40)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "%zu cells on each of %zu axes have %.3g nodes: too many", k,
                       f->dim, pow((double)k + 1.0, (double)f->dim));
    if (!(o->samples >= 0.0 && o->samples <= 0x1p50))
        return ki_fail(err, KOKSMA_EINVAL, 0, "%g samples, and there may be 2^50",
                       o->samples);
    return KOKSMA_OK;
}

/* The level that comes next, and what to do with it. */
static koksma_variation_level *next_level(koksma_variation_result *r)
{
    return &r->level[r->levels];
}

static void keep_level(koksma_variation_result *r, ki_variation_watch *w)
{
    w->value = r->level[r->levels++].value.value;
}

/* Grids of random cells, from `k` on. */
static koksma_status add_random(koksma_variation_result *r, koksma_estimate *faces,
                                const koksma_integrand *f, size_t k, size_t finest,
                                const koksma_variation_opts *o,
                                ki_variation_watch *w, koksma_error *err)
{
    double samples = o->samples > 0.0 ? o->samples : 0x1p22;
    koksma_status status = KOKSMA_OK;

    for (; k <= finest && status == KOKSMA_OK; k *= 2) {
        status = ki_variation_random(next_level(r), k == finest ? faces : NULL, f,
                                     k, samples, o->seed, w, err);
        if (status == KOKSMA_OK) keep_level(r, w);
    }
    return status;
}

static koksma_status add_trees(koksma_variation_result *r, koksma_estimate *faces,
                               const koksma_integrand *f, size_t finest,
                               ki_variation_watch *w, koksma_error *err)
{
    koksma_status status = KOKSMA_OK;

    for (size_t k = 2; k <= finest && status == KOKSMA_OK; k *= 2) {
        status = ki_variation_tree(next_level(r), k == finest ? faces : NULL, f, k,
                                   w, err);
        if (status == KOKSMA_OK) keep_level(r, w);
    }
    return status;
}

/* All grids up to k come out of one pass; who may stop a long one gets some before,
 * of k/4, k/16 and so on. */
static koksma_status dense_grids(koksma_variation_result *r, koksma_estimate *faces,
                                 const koksma_integrand *f, size_t k,
                                 ki_variation_watch *w, koksma_error *err)
{
    koksma_status status = KOKSMA_OK;
    size_t first = k;

    while (w->progress != NULL && first >= 8 &&
           pow((double)first + 1.0, (double)f->dim) > 0x1p16)
        first /= 4;
    for (; first <= k && status == KOKSMA_OK; first *= 4) {
        status = ki_variation_dense(r, first == k ? faces : NULL, f, first, w, err);
        if (status == KOKSMA_OK) w->value = r->level[r->levels - 1].value.value;
    }
    return status;
}

static koksma_status measure(koksma_variation_result *r, koksma_estimate *faces,
                             const koksma_integrand *f,
                             const koksma_variation_opts *o, ki_variation_watch *w,
                             koksma_error *err)
{
    koksma_variation_method method = choose(f, o);
    double most = f->dim == 1 ? 0x1p16 : f->dim <= 4 ? 0x1p24 : 0x1p20;
    size_t dense = side_of(f->dim, most);
    size_t finest = o->cells;
    koksma_status status;

    if (method == KOKSMA_VARIATION_BOUNDARY) {
        if (finest == 0) finest = side_of(f->dim > 1 ? f->dim - 1 : 1, 0x1p18);
        return add_trees(r, faces, f, finest, w, err);
    }
    if (finest == 0)
        finest = f->dim <= 4 || o->method == KOKSMA_VARIATION_GRID ? dense : 64;
    if (method == KOKSMA_VARIATION_RANDOM ||
        (o->method == KOKSMA_VARIATION_AUTO && f->dim > 4 &&
         pow((double)dense + 1.0, (double)f->dim) > 0x1p23))
        return add_random(r, faces, f, 2, finest, o, w, err);
    if (o->method == KOKSMA_VARIATION_GRID || dense > finest) dense = finest;
    status = dense_grids(r, dense == finest ? faces : NULL, f, dense, w, err);
    if (status != KOKSMA_OK) return status;
    return add_random(r, faces, f, 2 * dense, finest, o, w, err);
}

koksma_status koksma_variation(koksma_variation_result *out, koksma_estimate *faces,
                               const koksma_integrand *f,
                               const koksma_variation_opts *opts, koksma_error *err)
{
    static const koksma_variation_opts defaults = KOKSMA_VARIATION_DEFAULTS;
    const koksma_variation_opts *o = opts != NULL ? opts : &defaults;
    ki_variation_watch watch = {.progress = o->progress, .state = o->state};
    koksma_variation_result r = {0};
    koksma_status status = check(f, o, err);

    if (status == KOKSMA_OK) status = measure(&r, faces, f, o, &watch, err);
    if (status != KOKSMA_OK && status != KOKSMA_STOPPED) return status;
    koksma_variation_judge(&r);
    r.work = watch.work;
    *out = r;
    return status;
}
