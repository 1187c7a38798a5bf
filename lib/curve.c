#include "curve.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "error.h"
#include "num_kernels.h"

enum { OCTAVES = 64 };

struct koksma_curve {
    double exact;
    ki_sum sum; /* of f_i - exact */
    double squares, largest;
    uint64_t n;
    size_t next;        /* the first of wanted[] that is above n */
    double least, most; /* of e since the last row */
    bool to_the_end;    /* a row at the last value, too */
    bool ended;         /* the extremes in the rows are final */
    size_t count, wanted_count;
    uint64_t *wanted; /* in this block, behind the rows */
    koksma_curve_row rows[];
};

/* A curve with room for `count` N's and a row for each, and one for the end. */
static koksma_curve *allocate(size_t count)
{
    size_t each = sizeof(koksma_curve_row) + sizeof(uint64_t), size;
    koksma_curve *c;

    if (count == SIZE_MAX || __builtin_mul_overflow(count + 1, each, &size) ||
        __builtin_add_overflow(size, sizeof *c, &size))
        return NULL;
    c = ki_alloc(1, size);
    if (c == NULL) return NULL;
    c->wanted = (uint64_t *)(void *)(c->rows + count + 1);
    c->wanted_count = 0;
    koksma_curve_begin(c, 0.0);
    return c;
}

koksma_status koksma_curve_open(koksma_curve **out, unsigned steps,
                                koksma_error *err)
{
    koksma_curve *c;

    if (steps < 1 || steps > 64)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "%u steps an octave: 1 to 64 make sense", steps);
    c = allocate(steps * OCTAVES);
    if (c == NULL) return ki_fail_memory(err, "a curve");
    c->to_the_end = true;
    for (unsigned i = 0; i < steps * OCTAVES; i++) {
        double n = rint(exp2((double)i / steps));

        if (n < 0x1p64 && (i == 0 || (uint64_t)n > c->wanted[c->wanted_count - 1]))
            c->wanted[c->wanted_count++] = (uint64_t)n;
    }
    *out = c;
    return KOKSMA_OK;
}

koksma_status koksma_curve_open_at(koksma_curve **out, const uint64_t *n,
                                   size_t count, koksma_error *err)
{
    koksma_curve *c;

    if (count == 0)
        return ki_fail(err, KOKSMA_EINVAL, 0, "a curve takes at least one N");
    for (size_t j = 0; j < count; j++)
        if (n[j] <= (j > 0 ? n[j - 1] : 0))
            return ki_fail(err, KOKSMA_EINVAL, 0,
                           "N = %ju does not follow %ju: they have to rise",
                           (uintmax_t)n[j], j > 0 ? (uintmax_t)n[j - 1] : 0);
    c = allocate(count);
    if (c == NULL) return ki_fail_memory(err, "a curve");
    c->to_the_end = false;
    for (size_t j = 0; j < count; j++)
        c->wanted[j] = n[j];
    c->wanted_count = count;
    *out = c;
    return KOKSMA_OK;
}

void koksma_curve_close(koksma_curve *c) { free(c); }

static void forget_extremes(koksma_curve *c)
{
    c->least = HUGE_VAL;
    c->most = -HUGE_VAL;
}

void koksma_curve_begin(koksma_curve *c, double exact)
{
    c->exact = exact;
    c->sum = (ki_sum){0.0, 0.0};
    c->squares = c->largest = 0.0;
    c->n = 0;
    c->next = 0;
    forget_extremes(c);
    c->ended = false;
    c->count = 0;
}

/* A row at the present n.  Until koksma_curve_rows its extremes are those of e
 * from the row before it up to this one, this one left out. */
static void add_row(koksma_curve *c, double error)
{
    c->rows[c->count++] = (koksma_curve_row){c->n, error, 0.0, c->least, c->most};
    forget_extremes(c);
    c->next++;
}

void koksma_curve_add(koksma_curve *c, const double *f, size_t stride, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double v = f[i * stride], rest, deviation = ki_two_sum(v, -c->exact, &rest);
        double error;

        ki_sum_add(&c->sum, deviation);
        c->sum.rest += rest;
        c->squares += deviation * deviation;
        if (fabs(v) > c->largest) c->largest = fabs(v);
        error = ki_sum_value(c->sum) / (double)++c->n;
        if (c->next < c->wanted_count && c->n == c->wanted[c->next])
            add_row(c, error);
        if (error < c->least) c->least = error;
        if (error > c->most) c->most = error;
    }
}

koksma_curve_total koksma_curve_so_far(const koksma_curve *c)
{
    double m = (double)c->n;

    if (c->n == 0) return (koksma_curve_total){0};
    return (koksma_curve_total){c->n, ki_sum_value(c->sum) / m, c->squares / m,
                                c->largest};
}

/* Never -0. */
static double tail_of(double least, double most)
{
    return fabs(fmax(most, -least));
}

koksma_curve_row koksma_curve_shifted(koksma_curve_row row, double shift)
{
    row.error -= shift;
    row.least -= shift;
    row.most -= shift;
    row.tail = tail_of(row.least, row.most);
    return row;
}

/* From the last row on, let each row's extremes reach to the end. */
static void end_rows(koksma_curve *c)
{
    double least = c->least, most = c->most;

    for (size_t j = c->count; j-- > 0;) {
        koksma_curve_row *row = &c->rows[j];
        double before_least = row->least, before_most = row->most;

        row->least = fmin(least, row->error);
        row->most = fmax(most, row->error);
        row->tail = tail_of(row->least, row->most);
        least = fmin(row->least, before_least);
        most = fmax(row->most, before_most);
    }
    c->ended = true;
}

koksma_status koksma_curve_rows(koksma_curve *c, const koksma_curve_row **rows,
                                size_t *count, koksma_error *err)
{
    if (!isfinite(ki_sum_value(c->sum)))
        return ki_fail(err, KOKSMA_EDOMAIN, 0, "the sum of the values overflows");
    if (c->to_the_end && c->n > 0 && c->rows[c->count - 1].n < c->n)
        add_row(c, ki_sum_value(c->sum) / (double)c->n);
    if (!c->ended) end_rows(c);
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
