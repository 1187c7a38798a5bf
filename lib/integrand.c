#include "integrand.h"

#include <math.h>
#include <string.h>

#include "error.h"
#include "integrand_kernels.h"

const koksma_integrand_row *const koksma_integrands[] = {
    &ki_row_f2,
    &ki_row_f3,
    &ki_row_halfspace,
    &ki_row_simplex,
    &ki_row_mixture,
    &ki_row_sum,
    &ki_row_product,
    &ki_row_box,
    &ki_row_oscillatory,
    &ki_row_product_peak,
    &ki_row_corner_peak,
    &ki_row_gaussian,
    &ki_row_continuous,
    &ki_row_discontinuous,
    &ki_row_ball,
    &ki_row_koch,
    &ki_row_fractal2,
    &ki_row_fractal3,
    NULL,
};

const koksma_integrand_row *koksma_integrand_find(const char *name)
{
    for (const koksma_integrand_row *const *r = koksma_integrands; *r != NULL; r++)
        if (strcmp((*r)->name, name) == 0) return *r;
    return NULL;
}

size_t koksma_integrand_params(const koksma_integrand_row *row)
{
    size_t count = 0;

    while (count < KOKSMA_PARAMS_MOST && row->params[count].name != NULL)
        count++;
    return count;
}

static koksma_status check_dim(const koksma_integrand_row *row, size_t dim,
                               koksma_error *err)
{
    if (dim >= row->dim_least && dim <= row->dim_most &&
        (dim - row->dim_least) % row->dim_step == 0)
        return KOKSMA_OK;
    if (row->dim_least == row->dim_most)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "%zu coordinate%s a point, but %s takes %zu", dim,
                       ki_plural(dim), row->name, row->dim_least);
    return ki_fail(err, KOKSMA_EINVAL, 0,
                   "%zu coordinate%s a point, but %s takes from %zu to %zu%s", dim,
                   ki_plural(dim), row->name, row->dim_least, row->dim_most,
                   row->dim_step == 2 ? ", an even number" : "");
}

/* Written so that a NaN, which fails every comparison, is refused. */
static koksma_status check_param(const koksma_integrand_row *row,
                                 const koksma_param *p, double v, koksma_error *err)
{
    switch (p->kind) {
    case KOKSMA_OPEN:
        if (v > p->least && v < p->most) return KOKSMA_OK;
        return ki_fail(err, KOKSMA_EDOMAIN, 0,
                       "%s has %s between %g and %g, both excluded, not %g",
                       row->name, p->name, p->least, p->most, v);
    case KOKSMA_WHOLE:
        if (v >= p->least && v <= p->most && v == floor(v)) return KOKSMA_OK;
        return ki_fail(err, KOKSMA_EDOMAIN, 0,
                       "%s has %s a whole number from %g to %g, not %g", row->name,
                       p->name, p->least, p->most, v);
    default:
        if (v >= p->least && v <= p->most) return KOKSMA_OK;
        return ki_fail(err, KOKSMA_EDOMAIN, 0, "%s has %s from %g to %g, not %g",
                       row->name, p->name, p->least, p->most, v);
    }
}

koksma_status koksma_integrand_make(koksma_integrand *f, koksma_facts *facts,
                                    const koksma_integrand_row *row, size_t dim,
                                    const double *param, koksma_error *err)
{
    koksma_integrand made = row->functions;
    size_t count = koksma_integrand_params(row);
    koksma_status status;

    made.dim = dim == 0 ? row->dim : dim;
    status = check_dim(row, made.dim, err);
    for (size_t i = 0; i < count && status == KOKSMA_OK; i++) {
        made.param[i] = param == NULL ? row->params[i].usual : param[i];
        status = check_param(row, &row->params[i], made.param[i], err);
    }
    if (status != KOKSMA_OK) return status;
    if (row->prepare != NULL) row->prepare(&made);
    if (facts != NULL) row->facts(facts, &made);
    *f = made;
    return KOKSMA_OK;
}

koksma_status koksma_integrand_eval(double *out, const koksma_integrand *f,
                                    koksma_points p, koksma_error *err)
{
    koksma_status status = koksma_points_check(p, err);

    if (status != KOKSMA_OK) return status;
    if (p.dim != f->dim)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "%zu coordinate%s a point, but the integrand takes %zu",
                       p.dim, ki_plural(p.dim), f->dim);
    for (size_t i = 0; i < p.n; i++)
        out[i] = f->value(f, p.x + i * p.dim);
    return KOKSMA_OK;
}

/* ---- What the kernels share -------------------------------------------------- */

koksma_facts ki_facts_smooth(double integral, double error)
{
    return (koksma_facts){.integral = integral,
                          .error = error,
                          .variance = (double)NAN,
                          .box_dim = (double)NAN,
                          .pieces = 1.0,
                          .variation = (double)NAN};
}

koksma_facts ki_facts_indicator(double measure, double error, double area,
                                double extent, size_t dim)
{
    return (koksma_facts){.integral = measure,
                          .error = error,
                          .variance = measure * (1.0 - measure),
                          .jump = 1.0,
                          .jump_rms = 1.0,
                          .area = area,
                          .extent = extent,
                          .axes = (double)dim,
                          .box_dim = (double)(dim - 1),
                          .pieces = 2.0,
                          .variation = (double)INFINITY};
}

size_t ki_piece_only(const koksma_integrand *f, const double *x)
{
    (void)f;
    (void)x;
    return 0;
}

size_t ki_piece_by_value(const koksma_integrand *f, const double *x)
{
    return f->value(f, x) != 0.0;
}

koksma_meeting ki_meets_nothing(const koksma_integrand *f,
                                const koksma_cell_box *box)
{
    (void)f;
    (void)box;
    return KOKSMA_APART;
}
