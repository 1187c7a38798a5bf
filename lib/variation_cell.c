/* What all ways to a grid's variation need: the difference of a cell, and why there
 * is none. */
#include <math.h>
#include <stdio.h>

#include "error.h"
#include "variation_kernels.h"

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
