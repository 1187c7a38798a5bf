/* Values at the extremes: jumps of 1e-300, 2^-1074 and 1e300, errors below the
 * rounding of what they are errors of, up to 10^7 values and 10^4 dimensions. */
#include <check.h>
#include <float.h>

#include "bound.h"
#include "cells.h"
#include "curve.h"
#include "extremes_fixture.h"
#include "fit.h"
#include "variation.h"

/* Sizes of jumps: each a number whose sums and differences here are exact. */
static const double sizes[] = {1.0, 1e-300, LEAST, 1e300, 0x1p-1000};
enum { SIZES = sizeof sizes / sizeof sizes[0] };

/* ---- Variation --------------------------------------------------------------- */

/* J where all coordinates are above 1/2, else 0. */
static double corner_value(const koksma_integrand *f, const double *x)
{
    double v = *(const double *)f->state;

    for (size_t k = 0; k < f->dim; k++)
        v = x[k] > 0.5 ? v : 0.0;
    return v;
}

static koksma_range corner_range(const koksma_integrand *f, const double *lower,
                                 const double *upper)
{
    double v = *(const double *)f->state;
    bool all = true, none = false;

    for (size_t k = 0; k < f->dim; k++) {
        all = all && lower[k] >= 0.5;
        none = none || upper[k] <= 0.5;
    }
    return (koksma_range){{all ? v : 0.0, none ? 0.0 : v}, !all && !none};
}

/* Of the 2^dim - 1 faces each has one cell whose corners differ, by J: V_k is
 * (2^dim - 1) J on every grid. */
START_TEST(variation_of_a_corner)
{
    double jump = sizes[_i];

    for (size_t dim = 1; dim <= 8; dim += dim < 4 ? 1 : 4)
        for (int m = KOKSMA_VARIATION_GRID; m <= KOKSMA_VARIATION_RANDOM; m++) {
            koksma_integrand f = {.dim = dim,
                                  .value = corner_value,
                                  .range = corner_range,
                                  .state = &jump};
            koksma_variation_opts opts = {.method = (koksma_variation_method)m,
                                          .cells = dim > 4 ? 2 : 16,
                                          .samples = 0x1p14,
                                          .seed = 1};
            koksma_variation_result r;
            koksma_error err = {0};
            double want = (ldexp(1.0, (int)dim) - 1.0) * jump, got;
            koksma_estimate v;

            ck_assert_msg(koksma_variation(&r, NULL, &f, &opts, &err) == KOKSMA_OK,
                          "%s", err.text);
            v = r.level[r.levels - 1].value;
            got = v.value;
            if (m == KOKSMA_VARIATION_RANDOM && v.level < 1.0)
                continue; /* statistical: other tests */
            ck_assert_msg(fabs(got - want) <= 4 * DBL_EPSILON * want,
                          "method %d, dim %zu, jump %g: %g", m, dim, jump, got);
        }
}
END_TEST

static koksma_variation_result of_line(double (*f)(size_t i), size_t n)
{
    koksma_variation_grid *g;
    koksma_variation_result r;

    ck_assert_int_eq(koksma_variation_open(&g, &n, 1, NULL), KOKSMA_OK);
    for (size_t i = 0; i < n; i++) {
        double v = f(i);

        if (koksma_variation_add(g, &v, 1, NULL) != KOKSMA_OK) ck_abort();
    }
    ck_assert_int_eq(koksma_variation_finish(&r, NULL, g, NULL), KOKSMA_OK);
    koksma_variation_close(g);
    return r;
}

static double least_saw(size_t i) { return i % 2 == 1 ? LEAST : 0.0; }
static double saw_on_1(size_t i) { return i % 2 == 1 ? 1.0 : BELOW; }
static double ramp(size_t i) { return (double)i * 1e-300; }
static double flat(size_t i) { return (void)i, 1e300; }

/* n - 1 steps of one size; the ramp's end. */
static void check_samples(size_t n)
{
    koksma_variation_result saw = of_line(least_saw, n),
                            near = of_line(saw_on_1, n);
    koksma_variation_result rise = of_line(ramp, n), level = of_line(flat, n);

    ck_assert(saw.level[saw.levels - 1].value.value == (double)(n - 1) * LEAST);
    ck_assert(near.level[near.levels - 1].value.value == (double)(n - 1) * ULP);
    ck_assert_double_eq_tol(rise.level[rise.levels - 1].value.value * 1e300,
                            (double)(n - 1), 1e-9 * (double)n);
    ck_assert(level.level[level.levels - 1].value.value == 0.0);
}

START_TEST(sampled_values)
{
    check_samples(2);
    check_samples(3);
    check_samples(10001);
}
END_TEST

START_TEST(many_sampled_values) { check_samples(10000000); }
END_TEST

/* ---- Cells ------------------------------------------------------------------- */

/* sum x > dim/2 in two cells an axis: that with j upper halves has sums from j/2 to
 * (j + dim)/2, which the jump at dim/2 cuts but for j = 0 and j = dim; those it
 * touches.  In the plane with k cells an axis it cuts the k on the diagonal and
 * touches the 2(k-1) beside them. */
static void check_cells(size_t dim, uint64_t k, uint64_t cut, uint64_t touched)
{
    uint64_t cells[64];
    koksma_integrand f;
    koksma_cell_count c;
    koksma_error err = {0};
    double half[] = {0.5};

    for (size_t j = 0; j < dim; j++)
        cells[j] = k;
    ck_assert_int_eq(
        koksma_integrand_make(&f, NULL,
                              koksma_integrand_find(dim == 1 ? "box" : "halfspace"),
                              dim, half, NULL),
        KOKSMA_OK);
    ck_assert_msg(koksma_cells_count(&c, &f, cells, NULL, &err) == KOKSMA_OK,
                  "%zu, %llu: %s", dim, (unsigned long long)k, err.text);
    ck_assert_msg(c.lower == cut && c.upper == cut && c.touched == touched,
                  "%zu, %llu: %llu to %llu, %llu", dim, (unsigned long long)k,
                  (unsigned long long)c.lower, (unsigned long long)c.upper,
                  (unsigned long long)c.touched);
}

START_TEST(cells)
{
    check_cells(2, 1, 1, 0);
    check_cells(2, 1000, 1000, 1998);
    check_cells(3, 2, 6, 2);
    check_cells(14, 2, 16382, 2);
    check_cells(1, (uint64_t)1 << 63, 0, 2);       /* at a node */
    check_cells(1, ((uint64_t)1 << 63) - 1, 1, 0); /* in a cell's middle */
}
END_TEST

START_TEST(many_cells)
{
    check_cells(2, 10000000, 10000000, 19999998);
    check_cells(20, 2, 1048574, 2);
}
END_TEST

/* ---- Curves ------------------------------------------------------------------ */

/* n values exact + J, exact - J, exact + J, ...: the error is J/N for odd N and 0
 * for even ones. */
static void check_curve(double exact, double jump, size_t n)
{
    koksma_curve *c;
    const koksma_curve_row *row;
    size_t rows;

    ck_assert_int_eq(koksma_curve_open(&c, 2, NULL), KOKSMA_OK);
    koksma_curve_begin(c, exact);
    for (size_t i = 0; i < n; i++) {
        double v = i % 2 == 0 ? exact + jump : exact - jump;

        koksma_curve_add(c, &v, 1, 1);
    }
    ck_assert_int_eq(koksma_curve_rows(c, &row, &rows, NULL), KOKSMA_OK);
    ck_assert(row[rows - 1].n == n);
    for (size_t i = 0; i < rows; i++) {
        double want = row[i].n % 2 == 1 ? jump / (double)row[i].n : 0.0;

        ck_assert_msg(row[i].error == want, "%g +- %g: %g and not %g", exact, jump,
                      row[i].error, want);
        /* The next odd N has the greatest error to come. */
        if (row[i].n < n) ck_assert(row[i].tail == jump / (double)(row[i].n | 1));
    }
    koksma_curve_close(c);
}

/* 1, -1, 1, -1, ... with an integral of 2^-60, which no difference shows: of an
 * even number the error is -2^-60. */
static void check_offset(void)
{
    static const uint64_t n[] = {2, 100, 65536};
    koksma_curve *c;
    const koksma_curve_row *row;
    size_t rows;

    ck_assert_int_eq(koksma_curve_open_at(&c, n, 3, NULL), KOKSMA_OK);
    koksma_curve_begin(c, 0x1p-60);
    for (int i = 0; i < 65536; i++) {
        double v = i % 2 == 0 ? 1.0 : -1.0;

        koksma_curve_add(c, &v, 1, 1);
    }
    ck_assert_int_eq(koksma_curve_rows(c, &row, &rows, NULL), KOKSMA_OK);
    ck_assert_uint_eq(rows, 3);
    for (size_t i = 0; i < rows; i++)
        ck_assert(row[i].error == -0x1p-60);
    koksma_curve_close(c);
}

START_TEST(curves)
{
    check_offset();
    for (int s = 0; s < SIZES; s++)
        check_curve(0.0, sizes[s], 1001);
    check_curve(1.0, 0.0, 1001);     /* no error at all */
    check_curve(1.0, 0x1p-52, 1001); /* an ulp of the values, and less */
    check_curve(1e300, 0.0, 1001);
    check_curve(0x1p52, 1.0, 1001);
}
END_TEST

START_TEST(long_curves)
{
    check_curve(1.0, 0x1p-52, 9999999);
    check_curve(0.0, 1e-300, 9999999);
}
END_TEST

/* The root of the mean square of equal errors is that error, though its square is
 * no double. */
START_TEST(rms_of_any_size)
{
    for (int s = 0; s < SIZES; s++) {
        double e[] = {sizes[s], -sizes[s], sizes[s], sizes[s]};
        koksma_estimate v = koksma_curve_rms(e, 4, 0.95);

        ck_assert_msg(fabs(v.value / sizes[s] - 1.0) <= 1e-13, "%g: %g", sizes[s],
                      v.value);
    }
}
END_TEST

/* ---- Fits -------------------------------------------------------------------- */

/* J/N in every replicate: the exponent is -1 and the constant J.  Where rounding
 * speaks nothing is fitted. */
static void check_fit(double jump, size_t sets)
{
    enum { LEVELS = 16 };
    double *x = malloc(2 * LEVELS * sets * sizeof *x), *y = x + LEVELS * sets;
    size_t *set = malloc(LEVELS * sets * sizeof *set), rows = 0;
    koksma_fit_opts opts = KOKSMA_FIT_DEFAULTS;
    koksma_fit_result r;
    koksma_error err = {0};

    ck_assert(x != NULL && set != NULL);
    for (size_t s = 0; s < sets; s++)
        for (int i = 0; i < LEVELS; i++, rows++) {
            x[rows] = ldexp(1.0, i);
            y[rows] = jump / x[rows];
            set[rows] = s;
        }

    koksma_fit_data data = {x, y, set, rows, sets};

    ck_assert_msg(koksma_fit(&r, data, &opts, &err) == KOKSMA_OK, "%g: %s", jump,
                  err.text);
    ck_assert_msg(fabs(r.exponent.value.value + 1.0) < 1e-9, "%g: %.17g", jump,
                  r.exponent.value.value);
    ck_assert_msg(fabs(r.constant / jump - 1.0) < 1e-9, "%g: %g", jump, r.constant);
    ck_assert_uint_eq(r.used, LEVELS);

    /* Of values 2^55 times as large all errors are below the floor, 2^-50. */
    opts.scale = jump * 0x1p55;
    ck_assert_int_eq(koksma_fit(&r, data, &opts, &err), KOKSMA_EINVAL);
    opts.scale = jump * 0x1p38; /* N <= 2^12 stay */
    ck_assert_int_eq(koksma_fit(&r, data, &opts, &err), KOKSMA_OK);
    ck_assert_uint_eq(r.used, 13);
    ck_assert_uint_eq(r.below_floor, 3);
    free(x);
    free(set);
}

START_TEST(fits)
{
    check_fit(1.0, 1);
    check_fit(1e-150, 4);
    check_fit(1e-250, 8);
    check_fit(1e-300, 8);
    check_fit(1e250, 8);
}
END_TEST

START_TEST(large_fits) { check_fit(1e-300, 100000); }
END_TEST

/* ---- Bounds ------------------------------------------------------------------ */

/* sqrt(S/6) J N^(-(d+1)/2d) is J sqrt(S/6)/N for d = 1, and close to J sqrt(S/6N)
 * in many dimensions. */
static void check_bound(double jump, double n, size_t dim)
{
    koksma_bound_facts facts = koksma_bound_no_facts(dim);
    koksma_bound_term term[KOKSMA_BOUND_TERMS];
    double d = (double)dim;
    double want = jump * pow(n, -0.5 - 0.5 / d);
    koksma_error err = {0};

    facts.jump = jump;
    facts.area = 6.0;
    facts.extent = 6.0;
    facts.smooth = 0.0;
    ck_assert_msg(koksma_bound(term, &facts, n, 1.0, 2.0, &err) == KOKSMA_OK, "%s",
                  err.text);
    ck_assert_msg(fabs(term[KOKSMA_BOUND_JUMP].value - want) <=
                      1e-12 * want + LEAST,
                  "%g, %g, %zu: %g, not %g", jump, n, dim,
                  term[KOKSMA_BOUND_JUMP].value, want);
    ck_assert(fabs(term[KOKSMA_BOUND_RMS].value - want) <= 1e-12 * want + LEAST);
}

START_TEST(bounds)
{
    static const size_t dims[] = {1, 20, 100, 1000, 10000};
    static const double n[] = {1, 1e7, 0x1p60};

    for (int s = 0; s < SIZES; s++)
        for (size_t d = 0; d < 5; d++)
            for (size_t i = 0; i < 3; i++)
                check_bound(sizes[s], n[i], dims[d]);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("extremes, values");
    TCase *tc = tcase_create("small"), *big = tcase_create("large");

    tcase_set_timeout(tc, 60);
    tcase_add_loop_test(tc, variation_of_a_corner, 0, SIZES);
    tcase_add_test(tc, sampled_values);
    tcase_add_test(tc, cells);
    tcase_add_test(tc, curves);
    tcase_add_test(tc, rms_of_any_size);
    tcase_add_test(tc, fits);
    tcase_add_test(tc, bounds);
    suite_add_tcase(suite, tc);
    tcase_set_timeout(big, 1200);
    tcase_set_tags(big, "big");
    tcase_add_test(big, many_sampled_values);
    tcase_add_test(big, many_cells);
    tcase_add_test(big, long_curves);
    tcase_add_test(big, large_fits);
    suite_add_tcase(suite, big);
    return oracle_run(suite);
}
