#include "fit.h"

#include <math.h>
#include <stdlib.h>

#include "error.h"
#include "fit_kernels.h"

/* Everything is linear in ln rms but the two terms.  So each replicate is left out
 * of the means once, and the fits look at columns. */
typedef struct fit_work {
    ki_grid grid;
    ki_weights weights;
    double *log_rms; /* rows*(sets+1), later rows*(groups+1) */
    double *values;  /* sets+1: of one functional */
    double *memory;  /* three rows of weights */
    double level;
} fit_work;

enum { GROUPS = 16 };

static koksma_status fail_unusable(const ki_grid *g, const koksma_fit_opts *o,
                                   koksma_error *err)
{
    if (g->rows == 0 && g->zero > 0 && g->missing + g->below_floor == 0)
        return ki_fail(
            err, KOKSMA_EINVAL, 0,
            "errors of 0 at all %zu N in the window: there is nothing to fit",
            g->zero);
    return ki_fail(err, KOKSMA_EINVAL, 0,
                   "%zu usable N in [%g, %g], and a fit takes 3; left out: %zu "
                   "incomplete, %zu of zeros, %zu below rounding",
                   g->rows, o->from, o->to > 0.0 ? o->to : HUGE_VAL, g->missing,
                   g->zero, g->below_floor);
}

/* A weighted sum of ln rms, and of ln rms without each replicate. */
static koksma_fit_term functional(fit_work *w, const double *weight, double shift)
{
    const ki_grid *g = &w->grid;

    for (size_t r = 0; r <= g->sets; r++) {
        w->values[r] = -shift;
        for (size_t i = 0; i < g->rows; i++)
            w->values[r] += weight[i] * w->log_rms[i * (g->sets + 1) + r];
    }
    return ki_jackknife(w->values, g->sets, w->level);
}

static koksma_fit_shape shape_of(koksma_fit_term curvature)
{
    double q = curvature.value.value;

    if (isnan(curvature.se)) return KOKSMA_SHAPE_UNKNOWN;
    /* Where the replicates agree to the last digits, the rest is rounding. */
    if (fabs(q) <= 2.6 * curvature.se + 1e-12) return KOKSMA_STRAIGHT;
    return q > 0.0 ? KOKSMA_FLATTENS : KOKSMA_STEEPENS;
}

static void fit_power(koksma_fit_result *f, fit_work *w)
{
    const ki_grid *g = &w->grid;
    double mean = 0.0;

    for (size_t i = 0; i < g->rows; i++)
        mean += w->log_rms[i * (g->sets + 1) + g->sets] / (double)g->rows;
    f->slope = functional(w, w->weights.slope, 0.0);
    f->curvature = functional(w, w->weights.bend, 0.0);
    f->shape = shape_of(f->curvature);
    f->log_power = (koksma_fit_term){{nan(""), nan(""), nan(""), 0.0}, nan(""), 0};
    if (w->weights.has_log_power)
        f->log_power =
            functional(w, w->weights.log_power, w->weights.log_power_of_inverse);
    f->model = KOKSMA_FIT_POWER;
    f->exponent = f->slope;
    f->constant = g->largest * exp(mean - f->slope.value.value * w->weights.centre);
    f->smooth = f->cross = nan("");
}

/* In groups: each fit is an iteration, and deleting a sixteenth at a time shows the
 * curvature of the estimate better than deleting one path. */
static koksma_status fit_two_terms(koksma_fit_result *f, fit_work *w,
                                   koksma_fit_model model, koksma_error *err)
{
    const ki_grid *g = &w->grid;
    size_t groups = g->sets < GROUPS ? g->sets : GROUPS;
    double values[GROUPS + 1];
    ki_mixture m = {0};

    if (g->rows < 4 || g->n[0] <= 1.0)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "two terms take 4 usable N above 1, not %zu from %g",
                       g->rows, g->n[0]);
    ki_grid_log_rms_groups(w->log_rms, g, groups);
    for (size_t out = groups < 2 ? groups : 0; out <= groups; out++) {
        m = ki_mixture_fit(g->n, w->log_rms + out, groups + 1, g->rows,
                           model == KOKSMA_FIT_TWO_TERMS ? 1.0 : 0.0);
        values[out] = m.s;
    }
    f->model = model;
    f->exponent = ki_jackknife(values, groups, w->level);
    f->constant = m.has_first ? g->largest * exp(m.c) : 0.0;
    f->smooth = m.has_second ? g->largest * exp(m.c + m.b) : 0.0;
    f->cross = ki_mixture_cross(&m);
    return KOKSMA_OK;
}

static koksma_status fit_grid(koksma_fit_result *out, fit_work *w,
                              const koksma_fit_opts *o, koksma_error *err)
{
    const ki_grid *g = &w->grid;
    koksma_fit_result f = {.sets = g->sets,
                           .used = g->rows,
                           .missing = g->missing,
                           .zero = g->zero,
                           .below_floor = g->below_floor,
                           .saturation = o->saturation};
    koksma_fit_model model = o->model;
    koksma_status status = KOKSMA_OK;

    if (g->rows < 3) return fail_unusable(g, o, err);
    f.from = g->n[0];
    f.to = g->n[g->rows - 1];
    if (!ki_weights_fill(&w->weights, g))
        return ki_fail(
            err, KOKSMA_EINVAL, 0,
            "the N from %g to %g are too close to each other for a slope", f.from,
            f.to);
    ki_grid_log_rms(w->log_rms, g);
    fit_power(&f, w);
    if (model == KOKSMA_FIT_AUTO)
        model = f.shape == KOKSMA_FLATTENS && koksma_fit_can_part(&f)
                    ? KOKSMA_FIT_TWO_TERMS
                    : KOKSMA_FIT_POWER;
    if (model != KOKSMA_FIT_POWER) status = fit_two_terms(&f, w, model, err);
    if (status == KOKSMA_OK) *out = f;
    return status;
}

koksma_status koksma_fit(koksma_fit_result *out, koksma_fit_data data,
                         const koksma_fit_opts *opts, koksma_error *err)
{
    static const koksma_fit_opts defaults = KOKSMA_FIT_DEFAULTS;
    const koksma_fit_opts *o = opts != NULL ? opts : &defaults;
    fit_work w = {.level = o->level > 0.0 ? o->level : 0.95};
    koksma_status status = ki_grid_fill(&w.grid, data, o, err);

    if (status == KOKSMA_OK) {
        size_t rows = w.grid.rows, columns = data.sets + 1, cells;

        w.memory = ki_alloc(rows, 3 * sizeof *w.memory);
        w.values = ki_alloc(columns, sizeof *w.values);
        if (!__builtin_mul_overflow(rows, columns, &cells))
            w.log_rms = ki_alloc(cells, sizeof *w.log_rms);
        if (w.memory == NULL || w.values == NULL || w.log_rms == NULL) {
            status = ki_fail_memory(err, "the fit");
        } else {
            w.weights = (ki_weights){.slope = w.memory,
                                     .bend = w.memory + rows,
                                     .log_power = w.memory + 2 * rows};
            status = fit_grid(out, &w, o, err);
        }
    }
    free(w.memory);
    free(w.values);
    free(w.log_rms);
    ki_grid_free(&w.grid);
    return status;
}
