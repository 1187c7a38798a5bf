#include "variation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

/* ---- Cells ------------------------------------------------------------------- */

/* From corner to corner one coordinate changes: the Gray code of their number. */
double ki_variation_cell(const koksma_integrand *f, unsigned u, const size_t *low,
                         size_t k, double *x, double *work)
{
    size_t axis[KOKSMA_VARIATION_DIM_MOST], order = 0;
    double sum = 0.0, top = 0.0;
    unsigned upper = 0;
    bool minus = false;

    for (size_t j = 0; j < f->dim; j++)
        if (u >> j & 1) {
            axis[order++] = j;
            x[j] = (double)low[j] / (double)k;
        }
    for (unsigned corner = 0; corner < 1u << order; corner++, minus = !minus) {
        double v;

        if (corner > 0) {
            unsigned b = (unsigned)__builtin_ctz(corner);
            size_t j = axis[b];

            upper ^= 1u << b;
            x[j] = (double)(low[j] + (upper >> b & 1)) / (double)k;
        }
        v = f->value(f, x);
        if (!isfinite(v)) return v;
        sum += minus ? -v : v;
        top = fmax(top, fabs(v));
    }
    *work += (double)(1u << order);
    sum = fabs(sum);
    return sum < ki_variation_floor(top, order) ? 0.0 : sum;
}

koksma_status ki_variation_bad_value(const koksma_integrand *f, const double *x,
                                     koksma_error *err)
{
    double v = f->value(f, x);
    char place[100] = "";
    size_t used = 0;

    ki_c_locale l;

    if (isfinite(v)) return ki_variation_too_large(err);
    l = ki_c_locale_enter();
    for (size_t j = 0; j < f->dim && used < sizeof place - 24; j++)
        used += (size_t)snprintf(place + used, sizeof place - used, "%s%g",
                                 j > 0 ? ", " : "", x[j]);
    ki_c_locale_leave(l);
    return ki_fail(err, KOKSMA_EDOMAIN, 0, "the value at (%s) is %g, not finite",
                   place, v);
}

koksma_status ki_variation_too_large(koksma_error *err)
{
    return ki_fail(err, KOKSMA_EDOMAIN, 0,
                   "differences of the values leave the range of a double");
}

koksma_status ki_variation_stopped(const ki_variation_watch *w, koksma_error *err)
{
    return ki_fail(err, KOKSMA_STOPPED, 0,
                   "stopped after %.3g values; the grids so far are done", w->work);
}

/* ---- Every node -------------------------------------------------------------- */

/* Rows along the last axis, one after the other. */
static koksma_status add_nodes(koksma_variation_grid *g, const koksma_integrand *f,
                               double *row, size_t k, ki_variation_watch *w,
                               koksma_error *err)
{
    size_t last = f->dim - 1, at[KOKSMA_VARIATION_DIM_MOST] = {0};
    double x[KOKSMA_VARIATION_DIM_MOST] = {0.0};

    for (;;) {
        size_t j = last;
        koksma_status status;

        for (size_t i = 0; i <= k; i++) {
            if (ki_variation_told_to_stop(w)) return ki_variation_stopped(w, err);
            x[last] = (double)i / (double)k;
            row[i] = f->value(f, x);
            w->work++;
            if (!isfinite(row[i])) return ki_variation_bad_value(f, x, err);
        }
        status = koksma_variation_add(g, row, k + 1, err);
        if (status != KOKSMA_OK) return status;
        while (j > 0 && at[j - 1] == k) {
            at[--j] = 0;
            x[j] = 0.0;
        }
        if (j == 0) return KOKSMA_OK;
        x[j - 1] = (double)++at[j - 1] / (double)k;
    }
}

koksma_status ki_variation_dense(koksma_variation_result *out,
                                 koksma_estimate *faces, const koksma_integrand *f,
                                 size_t k, ki_variation_watch *w, koksma_error *err)
{
    size_t nodes[KOKSMA_VARIATION_DIM_MOST];
    double *row = ki_alloc(k + 1, sizeof *row);
    koksma_variation_grid *g = NULL;
    koksma_status status;

    if (row == NULL) return ki_fail_memory(err, "a row of a grid");
    for (size_t j = 0; j < f->dim; j++)
        nodes[j] = k + 1;
    status = koksma_variation_open(&g, nodes, f->dim, err);
    if (status == KOKSMA_OK) status = add_nodes(g, f, row, k, w, err);
    if (status == KOKSMA_OK) status = koksma_variation_finish(out, faces, g, err);
    koksma_variation_close(g);
    free(row);
    return status;
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
