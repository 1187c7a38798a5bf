#include <float.h>
#include <math.h>

#include "fit.h"
#include "num_kernels.h"

bool koksma_fit_can_part(const koksma_fit_result *fit)
{
    return fit->sets >= 64 && fit->to / fit->from >= 0x1p16;
}

koksma_fit_test koksma_fit_try(const koksma_fit_result *fit, double candidate,
                               double margin)
{
    const koksma_fit_term *s = &fit->exponent;
    double off = s->value.value - candidate, reach;

    if (isnan(s->se)) return (koksma_fit_test){nan(""), false, false};
    /* Two tests at 5 % each: the interval at 90 %. */
    reach = s->se * ki_student_quantile(0.90, s->groups - 1);
    return (koksma_fit_test){.z = off == 0.0 ? 0.0 : off / s->se,
                             .rejected = candidate < s->value.lower ||
                                         candidate > s->value.upper,
                             .near = fabs(off) + reach < margin};
}

static koksma_judgement undecided(koksma_doubt doubt)
{
    return (koksma_judgement){KOKSMA_UNDECIDED, doubt};
}

koksma_judgement koksma_fit_judge(const koksma_fit_result *fit, double claim,
                                  const double *rivals, size_t count, double margin)
{
    koksma_fit_test test = koksma_fit_try(fit, claim, margin);
    bool alone = true;

    if (isnan(test.z))
        return (koksma_judgement){KOKSMA_NO_VERDICT, KOKSMA_DOUBT_PATH};
    /* There the points do as random ones, and no claim to be better can be judged.
     */
    if (fit->to < fit->saturation && claim < -0.5)
        return undecided(KOKSMA_DOUBT_SATURATED);
    if (fit->model == KOKSMA_FIT_POWER && fit->shape != KOKSMA_STRAIGHT)
        return undecided(KOKSMA_DOUBT_BENT);
    if (fit->model != KOKSMA_FIT_POWER && !koksma_fit_can_part(fit))
        return undecided(KOKSMA_DOUBT_FEW);
    for (size_t i = 0; i < count; i++)
        alone = alone && (fabs(rivals[i] - claim) < 1e-9 ||
                          koksma_fit_try(fit, rivals[i], margin).rejected);
    if (test.near && alone)
        return (koksma_judgement){KOKSMA_EQUIVALENT, KOKSMA_NO_DOUBT};
    if (test.rejected) return (koksma_judgement){KOKSMA_DIFFERENT, KOKSMA_NO_DOUBT};
    return undecided(test.near ? KOKSMA_DOUBT_RIVAL : KOKSMA_DOUBT_WIDE);
}

double koksma_fit_theory(size_t dim)
{
    return -((double)dim + 1.0) / (2.0 * (double)dim);
}

double koksma_fit_theory_box(size_t dim, double beta)
{
    return beta / (2.0 * (double)dim) - 1.0;
}

double koksma_fit_break_even(size_t dim, double area, double jump, double sigma)
{
    return pow(area * pow(jump / sigma, 2.0) / 6.0, (double)dim);
}
