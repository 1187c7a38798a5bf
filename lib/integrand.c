#include "integrand.h"

#include <math.h>
#include <string.h>

#include "error.h"
#include "num_kernels.h"

/* Whether x_1 + ... + x_dim > 1, exactly.  The sum in doubles decides unless it
 * is within its own rounding, dim - 1 half-ulps of dim, of 1. */
static int above_one(const double *x, size_t dim)
{
    double sum = 0.0, term[KI_SIGN_TERMS];

    for (size_t k = 0; k < dim; k++)
        sum += x[k];
    if (fabs(sum - 1.0) > 0x1p-48) return sum > 1.0;
    for (size_t k = 0; k < dim; k++)
        term[k] = x[k];
    term[dim] = -1.0;
    return ki_sum_sign(term, dim + 1) > 0;
}

static double f2_jump(double a) { return 1.0 - 2.0 * a; }

static double f2(const double *x, double a)
{
    return a * (x[0] + x[1]) + (above_one(x, 2) ? f2_jump(a) : 0.0);
}

static double f3_jump(double a) { return 0.6 - 1.8 * a; }

static double f3(const double *x, double a)
{
    return a * (x[0] + x[1] + x[2]) + (above_one(x, 3) ? f3_jump(a) : 0.0);
}

const koksma_integrand koksma_integrands[] = {
    {"f2", "a(x+y), and 1-2a more where x+y > 1", 2, 0.5, 0.5, f2, f2_jump},
    {"f3", "a(x+y+z), and 0.6-1.8a more where x+y+z > 1", 3, 1.0 / 3.0, 0.5, f3,
     f3_jump},
    {NULL, NULL, 0, 0.0, 0.0, NULL, NULL},
};

const koksma_integrand *koksma_integrand_find(const char *name)
{
    for (const koksma_integrand *f = koksma_integrands; f->name != NULL; f++)
        if (strcmp(f->name, name) == 0) return f;
    return NULL;
}

koksma_status koksma_integrand_eval(double *f, const koksma_integrand *integrand,
                                    double a, koksma_points p, koksma_error *err)
{
    koksma_status status = koksma_points_check(p, err);

    if (status != KOKSMA_OK) return status;
    if (p.dim != integrand->dim)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "%zu coordinates a point, but %s takes %zu", p.dim,
                       integrand->name, integrand->dim);
    if (!(a >= 0.0 && a <= integrand->a_most))
        return ki_fail(err, KOKSMA_EDOMAIN, 0,
                       "a is %g, not in [0,%g] as %s has it", a, integrand->a_most,
                       integrand->name);
    for (size_t i = 0; i < p.n; i++)
        f[i] = integrand->value(p.x + i * p.dim, a);
    return KOKSMA_OK;
}
