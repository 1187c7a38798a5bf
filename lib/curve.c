#include "curve.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "error.h"
#include "num_kernels.h"

enum { OCTAVES = 64 };

struct koksma_curve {
    unsigned steps, step; /* an octave; and those passed */
    double exact;
    ki_sum sum; /* of f_i - exact */
    uint64_t n, next;
    double worst; /* |e| since the last row */
    bool ended;   /* the tails of the rows are final */
    size_t count;
    koksma_curve_row rows[]; /* room for every row that 2^64 values can make */
};

koksma_status koksma_curve_open(koksma_curve **out, unsigned steps,
                                koksma_error *err)
{
    koksma_curve *c;

    if (steps < 1 || steps > 64)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "%u steps an octave: 1 to 64 make sense", steps);
    c = ki_alloc(1, sizeof *c + (steps * OCTAVES + 2) * sizeof c->rows[0]);
    if (c == NULL) return ki_fail_memory(err, "a curve");
    c->steps = steps;
    koksma_curve_begin(c, 0.0);
    *out = c;
    return KOKSMA_OK;
}

void koksma_curve_close(koksma_curve *c) { free(c); }

void koksma_curve_begin(koksma_curve *c, double exact)
{
    c->exact = exact;
    c->sum = (ki_sum){0.0, 0.0};
    c->n = 0;
    c->next = 1;
    c->step = 0;
    c->worst = 0.0;
    c->ended = false;
    c->count = 0;
}

/* A row at the present n.  Until koksma_curve_rows its tail is the worst |e| from
 * the row before it up to this one, this one left out. */
static void add_row(koksma_curve *c, double error)
{
    c->rows[c->count++] = (koksma_curve_row){c->n, error, c->worst};
    c->worst = 0.0;
    while (c->next <= c->n && c->step < c->steps * OCTAVES)
        c->next = (uint64_t)rint(exp2((double)++c->step / c->steps));
}

void koksma_curve_add(koksma_curve *c, const double *f, size_t stride, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double rest, deviation = ki_two_sum(f[i * stride], -c->exact, &rest), error;

        ki_sum_add(&c->sum, deviation);
        c->sum.rest += rest;
        error = ki_sum_value(c->sum) / (double)++c->n;
        if (c->n == c->next) add_row(c, error);
        if (fabs(error) > c->worst) c->worst = fabs(error);
    }
}

koksma_status koksma_curve_rows(koksma_curve *c, const koksma_curve_row **rows,
                                size_t *count, koksma_error *err)
{
    double tail;

    if (!isfinite(ki_sum_value(c->sum)))
        return ki_fail(err, KOKSMA_EDOMAIN, 0, "the sum of the values overflows");
    if (c->n > 0 && c->rows[c->count - 1].n < c->n)
        add_row(c, ki_sum_value(c->sum) / (double)c->n);
    tail = c->worst;
    for (size_t j = c->count; !c->ended && j-- > 0;) {
        double before = c->rows[j].tail;

        tail = fmax(tail, fabs(c->rows[j].error));
        c->rows[j].tail = tail;
        tail = fmax(tail, before);
    }
    c->ended = true;
    *rows = c->rows;
    *count = c->count;
    return KOKSMA_OK;
}

/* ln of the root mean square of all errors but one (count: of all), in units of
 * `unit`.  Summed anew each time: subtracting the one would cancel. */
static double log_rms(const double *errors, size_t count, size_t left_out,
                      double unit)
{
    double sum = 0.0;

    for (size_t r = 0; r < count; r++)
        if (r != left_out) sum += pow(errors[r] / unit, 2.0);
    return log(sum / (double)(count - (left_out < count))) / 2.0;
}

koksma_estimate koksma_curve_rms(const double *errors, size_t count, double level)
{
    koksma_estimate e = {0.0, nan(""), nan(""), 0.0};
    double largest = 0.0, mean = 0.0, spread = 0.0, m = (double)count;
    size_t live = 0;

    for (size_t r = 0; r < count; r++) {
        largest = fmax(largest, fabs(errors[r]));
        live += errors[r] != 0.0;
    }
    if (live > 0) e.value = largest * exp(log_rms(errors, count, count, largest));
    if (live < 2) return e;
    for (size_t r = 0; r < count; r++)
        mean += log_rms(errors, count, r, largest) / m;
    for (size_t r = 0; r < count; r++)
        spread += pow(log_rms(errors, count, r, largest) - mean, 2.0);
    double reach =
        ki_student_quantile(level, count - 1) * sqrt(spread * (m - 1.0) / m);
    e.lower = e.value * exp(-reach);
    e.upper = e.value * exp(reach);
    e.level = level;
    return e;
}
