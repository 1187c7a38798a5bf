#include <math.h>

#include "fit_kernels.h"
#include "num_kernels.h"

/* The log power's own line: y = c - ln n + k v with v = ln ln n, so that k is the
 * slope of y + ln n against v. */
static void fill_log_power(ki_weights *w, const ki_grid *g)
{
    double m = (double)g->rows, centre = 0.0, v2 = 0.0;

    w->log_power_of_inverse = 0.0;
    w->has_log_power = g->n[0] >= 3.0;
    if (!w->has_log_power) return;
    for (size_t i = 0; i < g->rows; i++)
        centre += log(log(g->n[i])) / m;
    for (size_t i = 0; i < g->rows; i++)
        v2 += pow(log(log(g->n[i])) - centre, 2.0);
    for (size_t i = 0; i < g->rows; i++) {
        w->log_power[i] = (log(log(g->n[i])) - centre) / v2;
        w->log_power_of_inverse -= w->log_power[i] * (log(g->n[i]) - w->centre);
    }
}

/* The quadratic part is what u^2 leaves after its own line in u. */
bool ki_weights_fill(ki_weights *w, const ki_grid *g)
{
    double m = (double)g->rows, u2 = 0.0, u3 = 0.0, p2 = 0.0;

    w->centre = 0.0;
    for (size_t i = 0; i < g->rows; i++)
        w->centre += log(g->n[i]) / m;
    for (size_t i = 0; i < g->rows; i++) {
        double u = log(g->n[i]) - w->centre;

        u2 += u * u;
        u3 += u * u * u;
    }
    for (size_t i = 0; i < g->rows; i++) {
        double u = log(g->n[i]) - w->centre;

        w->slope[i] = u / u2;
        w->bend[i] = u * u - u2 / m - u * (u3 / u2);
        p2 += w->bend[i] * w->bend[i];
    }
    for (size_t i = 0; i < g->rows; i++)
        w->bend[i] /= p2;
    fill_log_power(w, g);
    /* Far above what the rounding of the logarithms makes of equal N's. */
    return u2 / m > 1e-12 && p2 > 1e-10 * u2 * u2 / m;
}

koksma_fit_term ki_jackknife(const double *values, size_t groups, double level)
{
    double v = values[groups], m = (double)groups, sum = 0.0, squares = 0.0;
    koksma_fit_term t = {{v, nan(""), nan(""), 0.0}, nan(""), groups};

    if (groups < 2 || isnan(v)) return t;
    /* Deviations from the first one: the mean's own rounding does not matter. */
    for (size_t g = 1; g < groups; g++) {
        double d = values[g] - values[0];

        sum += d;
        squares += d * d;
    }
    t.se = sqrt(fmax(squares - sum * sum / m, 0.0) * (m - 1.0) / m);

    double reach = t.se * ki_student_quantile(level, groups - 1);

    t.value = (koksma_estimate){v, v - reach, v + reach, level};
    return t;
}
