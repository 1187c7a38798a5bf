/* curve.h against sums of integers: values here are multiples of 2^-UNIT, and the
 * running sum of their deviations is never rounded. */
#include <check.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "curve.h"
#include "num_kernels.h"
#include "oracle.h"

enum { UNIT = 60, MOST = 20000 };

static double values[2 * MOST], running[MOST + 1];

static oracle_int units(double v)
{
    return (oracle_int)ldexp(v, UNIT); /* exact: |v| < 2^60 here */
}

static koksma_curve *open_curve(unsigned steps, double exact)
{
    koksma_curve *c = NULL;

    ck_assert_int_eq(koksma_curve_open(&c, steps, NULL), KOKSMA_OK);
    koksma_curve_begin(c, exact);
    return c;
}

static size_t get_rows(koksma_curve *c, const koksma_curve_row **rows)
{
    size_t count = 0;
    koksma_error err = {0};
    koksma_status status = koksma_curve_rows(c, rows, &count, &err);

    ck_assert_msg(status == KOKSMA_OK, "%s", err.text);
    return count;
}

/* What is wanted is computed in long double.  Where that is no longer than double,
 * as under valgrind, which looks for other faults, it is not good enough. */
static bool can_judge(void)
{
    volatile long double one = 1.0L;

    return one + 0x1p-60L > one;
}

/* "An ulp or so": 1.5, seen from either side of a power of 2. */
static bool near(double v, double want)
{
    return fabs(v - want) <= 3.4e-16 * fabs(want) || !can_judge();
}

/* Every row of the first n values from values[], in order. */
static void check_rows(const koksma_curve_row *row, size_t count, size_t n,
                       unsigned steps, double exact)
{
    oracle_int sum = 0;
    size_t j = 0;
    double tail = 0.0;
    uint64_t last = 0;

    for (size_t i = 1; i <= n; i++) {
        sum += units(values[i - 1]) - units(exact);
        running[i] = (double)ldexpl((long double)sum / (long double)i, -UNIT);
    }
    for (unsigned i = 0; last < n; i++) {
        uint64_t next = (uint64_t)roundl(exp2l((long double)i / steps));

        if (next > n) next = n;
        if (next == last) continue;
        last = next;
        ck_assert_uint_lt(j, count);
        ck_assert_uint_eq(row[j++].n, last);
    }
    ck_assert_uint_eq(j, count);
    for (size_t i = n; j-- > 0;) {
        for (; i >= row[j].n; i--)
            tail = fmax(tail, fabs(running[i]));
        ck_assert_msg(near(row[j].error, running[row[j].n]),
                      "e(%zu) is %.17g, %.17g", (size_t)row[j].n, row[j].error,
                      running[row[j].n]);
        ck_assert_msg(near(row[j].tail, tail), "E(%zu) is %.17g, not %.17g",
                      (size_t)row[j].n, row[j].tail, tail);
    }
}

static void check_curve(size_t n, unsigned steps, double exact)
{
    koksma_curve *c = open_curve(steps, exact);
    const koksma_curve_row *row;
    size_t count;

    koksma_curve_add(c, values, 1, n);
    count = get_rows(c, &row);
    check_rows(row, count, n, steps, exact);
    koksma_curve_close(c);
}

START_TEST(row_numbers)
{
    static const uint64_t half_octaves[] = {1, 2, 3, 4, 6, 8, 11, 16, 23, 32, 33};
    koksma_curve *c = open_curve(2, 0.0);
    const koksma_curve_row *row;

    koksma_curve_add(c, values, 1, 33);
    ck_assert_uint_eq(get_rows(c, &row), 11);
    for (size_t j = 0; j < 11; j++)
        ck_assert_uint_eq(row[j].n, half_octaves[j]);
    koksma_curve_close(c);
}
END_TEST

/* Every number of values up to 70, every step. */
START_TEST(constant_values)
{
    for (size_t i = 0; i < 70; i++)
        values[i] = 0.75;
    for (unsigned steps = 1; steps <= 64; steps += steps < 4 ? 1 : 20)
        for (size_t n = 1; n <= 70; n++) {
            check_curve(n, steps, 0.5);
            check_curve(n, steps, 0.75);
            check_curve(n, steps, 1.0);
        }
}
END_TEST

/* 0 and 1; any in [0,1); and large ones that cancel but for a small rest.  The
 * mean error of all but the last kind comes near 0 now and then. */
static void random_values(oracle_rng *rng, size_t n, size_t kind)
{
    for (size_t i = 0; i < n; i++) {
        values[i] = oracle_dyadic(rng, kind == 0 ? 1 : 50);
        if (kind == 0) values[i] *= 2.0;
        if (kind == 3) values[i] -= 0.5;
        if (kind < 2) continue;
        values[i] = ldexp(floor(values[i] * 0x1p40), 10);
        if (i % 2 == 1) values[i] = oracle_dyadic(rng, 8) - values[i - 1];
    }
}

START_TEST(random_curves)
{
    static const size_t longest[] = {3000, 3000, 1000, 1000};

    for (uint64_t round = 0; round < 80; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        size_t n = 1 + oracle_below(&rng, longest[round % 4]);

        random_values(&rng, n, round % 4);
        check_curve(n, 1 + (unsigned)oracle_below(&rng, 12),
                    round % 4 < 2 && round % 8 < 4 ? 0.3 : 0.5);
    }
}
END_TEST

/* However the values come, the bits are the same; and a curve can begin anew. */
START_TEST(pieces)
{
    oracle_rng rng = oracle_rng_start(oracle_seed(), 5);
    koksma_curve *once = open_curve(3, 0.25), *more = open_curve(3, 7.0);
    const koksma_curve_row *a, *b;
    size_t count;

    random_values(&rng, 2 * MOST, 1);
    koksma_curve_add(once, values, 2, MOST);
    count = get_rows(once, &a);
    for (int round = 0; round < 3; round++) {
        koksma_curve_begin(more, 0.25);
        for (size_t at = 0; at < MOST;) {
            size_t part = oracle_below(&rng, round == 0 ? 3 : 3000);

            if (part > MOST - at) part = MOST - at;
            koksma_curve_add(more, values + 2 * at, 2, part);
            at += part;
        }
        ck_assert_uint_eq(get_rows(more, &b), count);
        for (size_t j = 0; j < count; j++)
            ck_assert(a[j].n == b[j].n && a[j].error == b[j].error &&
                      a[j].tail == b[j].tail);
    }
    koksma_curve_close(once);
    koksma_curve_close(more);
}
END_TEST

/* Nothing in the header says that one may ask once only. */
START_TEST(rows_twice)
{
    koksma_curve *c = open_curve(1, 0.0);
    const koksma_curve_row *row;
    size_t count;

    memset(values, 0, sizeof values);
    values[4] = 50.0; /* the worst error is at 5, between the rows 4 and 8 */
    koksma_curve_add(c, values, 1, 12);
    count = get_rows(c, &row);
    check_rows(row, count, 12, 1, 0.0);
    ck_assert_uint_eq(get_rows(c, &row), count);
    check_rows(row, count, 12, 1, 0.0);
    koksma_curve_close(c);
}
END_TEST

/* A naive sum of a million tenths is off by 1e-11 of itself. */
START_TEST(a_million_tenths)
{
    static const double exact[] = {0.0, 0.3, 0.1 + 0x1p-56, 0.09};
    koksma_curve *c;
    const koksma_curve_row *row;

    for (size_t i = 0; i < 1000; i++)
        values[i] = 0.1;
    for (size_t e = 0; e < 4; e++) {
        c = open_curve(2, exact[e]);
        for (int i = 0; i < 1000; i++)
            koksma_curve_add(c, values, 1, 1000);

        size_t count = get_rows(c, &row);
        double want = (double)((long double)values[0] - (long double)exact[e]);

        ck_assert_uint_eq(row[count - 1].n, 1000000);
        for (size_t j = 0; j < count; j++)
            ck_assert(near(row[j].error, want) && near(row[j].tail, fabs(want)));
        koksma_curve_close(c);
    }
}
END_TEST

START_TEST(no_values)
{
    koksma_curve *c = open_curve(1, 0.0);
    const koksma_curve_row *row;

    koksma_curve_add(c, NULL, 1, 0);
    ck_assert_uint_eq(get_rows(c, &row), 0);
    koksma_curve_close(c);
    koksma_curve_close(NULL);
}
END_TEST

/* Rows where they are wanted, as far as the values reach, and tails to the end. */
START_TEST(given_rows)
{
    static const uint64_t wanted[] = {2, 3, 7, 500, 1000};
    oracle_rng rng = oracle_rng_start(oracle_seed(), 9);
    const koksma_curve_row *all, *row;
    size_t count;

    random_values(&rng, 900, 1);
    for (size_t n = 1; n <= 900; n += n < 20 ? 1 : 83) {
        koksma_curve *every = open_curve(64, 0.5), *c = NULL;
        size_t reached = n < 2 ? 0 : n < 3 ? 1 : n < 7 ? 2 : n < 500 ? 3 : 4;

        ck_assert_int_eq(koksma_curve_open_at(&c, wanted, 5, NULL), KOKSMA_OK);
        koksma_curve_begin(c, 0.5);
        koksma_curve_add(c, values, 1, n);
        koksma_curve_add(every, values, 1, n);
        ck_assert_uint_eq(get_rows(c, &row), reached);
        count = get_rows(every, &all);
        for (size_t j = 0; j < reached; j++)
            for (size_t i = 0; i < count; i++)
                if (all[i].n == wanted[j])
                    ck_assert(row[j].n == all[i].n &&
                              row[j].error == all[i].error &&
                              row[j].tail == all[i].tail);
        for (size_t j = 0; j < reached; j++)
            ck_assert_uint_eq(row[j].n, wanted[j]);
        koksma_curve_close(every);
        koksma_curve_close(c);
    }
}
END_TEST

START_TEST(extremes)
{
    for (uint64_t round = 0; round < 20; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        size_t n = 1 + oracle_below(&rng, 300), count;
        koksma_curve *c = open_curve(2, 0.25), *other = open_curve(2, 0.5);
        const koksma_curve_row *row, *shifted;
        double least = HUGE_VAL, most = -HUGE_VAL, sum = 0.0;

        random_values(&rng, n, 0);
        koksma_curve_add(c, values, 1, n);
        koksma_curve_add(other, values, 1, n);
        count = get_rows(c, &row);
        ck_assert_uint_eq(get_rows(other, &shifted), count);
        for (size_t i = 0; i < n; i++) {
            sum += values[i] - 0.25;
            running[i + 1] = sum / (double)(i + 1);
        }
        for (size_t j = count, i = n; j-- > 0;) {
            koksma_curve_row s = koksma_curve_shifted(row[j], 0.25);

            for (; i >= row[j].n; i--) {
                least = fmin(least, running[i]);
                most = fmax(most, running[i]);
            }
            ck_assert(near(row[j].least, least) && near(row[j].most, most));
            ck_assert_double_eq_tol(s.error, shifted[j].error, 1e-15);
            ck_assert_double_eq_tol(s.tail, shifted[j].tail, 1e-15);
            ck_assert_double_eq_tol(s.least, shifted[j].least, 1e-15);
            ck_assert_double_eq_tol(s.most, shifted[j].most, 1e-15);
        }
        koksma_curve_close(c);
        koksma_curve_close(other);
    }
}
END_TEST

/* 1, -3, 2 about 1/2: deviations 1/2, -7/2, 3/2. */
START_TEST(totals)
{
    koksma_curve *c = open_curve(1, 0.5);
    koksma_curve_total t = koksma_curve_so_far(c);

    ck_assert(t.n == 0 && t.error == 0.0 && t.square == 0.0 && t.largest == 0.0);
    koksma_curve_add(c, (const double[]){1.0, -3.0, 2.0}, 1, 3);
    t = koksma_curve_so_far(c);
    ck_assert(t.n == 3 && t.error == -0.5 && t.largest == 3.0);
    ck_assert_double_eq_tol(t.square, 14.75 / 3.0, 1e-15);
    koksma_curve_close(c);
}
END_TEST

START_TEST(refused)
{
    static const double bad[][4] = {{1e308, 1e308, 0.0, 0.0},
                                    {-1e308, -1e308, -1e308, 1e308},
                                    {1e308, 1e308, -1e308, -1e308},
                                    {(double)NAN, 0.0, 1.0, 2.0},
                                    {1.0, -(double)INFINITY, 1.0, 2.0}};
    const koksma_curve_row *rows = (const koksma_curve_row *)values;
    koksma_curve *c = open_curve(2, 0.0), *none = NULL;
    koksma_error err = {0};
    size_t count = 77;

    for (size_t i = 0; i < 5; i++) {
        koksma_curve_begin(c, 0.0);
        koksma_curve_add(c, bad[i], 1, 4);
        ck_assert_int_eq(koksma_curve_rows(c, &rows, &count, &err), KOKSMA_EDOMAIN);
        ck_assert(err.status == KOKSMA_EDOMAIN && strlen(err.text) > 0);
        ck_assert(count == 77 && (const void *)rows == values);
    }
    koksma_curve_begin(c, 0.0); /* what is just in range */
    koksma_curve_add(c, &(double){DBL_MAX}, 1, 1);
    ck_assert_uint_eq(get_rows(c, &rows), 1);
    ck_assert(rows[0].error == DBL_MAX && rows[0].tail == DBL_MAX);
    koksma_curve_close(c);
    ck_assert_int_eq(koksma_curve_open(&none, 0, &err), KOKSMA_EINVAL);
    ck_assert_int_eq(koksma_curve_open(&none, 65, &err), KOKSMA_EINVAL);
    ck_assert_str_eq(err.text, "65 steps an octave: 1 to 64 make sense");
    ck_assert_int_eq(koksma_curve_open_at(&none, NULL, 0, &err), KOKSMA_EINVAL);
    ck_assert_int_eq(koksma_curve_open_at(&none, (uint64_t[]){0}, 1, &err),
                     KOKSMA_EINVAL);
    ck_assert_int_eq(koksma_curve_open_at(&none, (uint64_t[]){4, 9, 9}, 3, &err),
                     KOKSMA_EINVAL);
    ck_assert_str_eq(err.text, "N = 9 does not follow 9: they have to rise");
    ck_assert_ptr_null(none);
}
END_TEST

/* Half the logarithm of the mean square, without number `left`. */
static long double log_rms(const double *e, size_t count, size_t left)
{
    long double sum = 0.0L;

    for (size_t r = 0; r < count; r++)
        if (r != left) sum += powl((long double)e[r], 2.0L);
    return logl(sum / (long double)(count - (left < count))) / 2.0L;
}

static void check_rms(const double *e, size_t count, double level)
{
    koksma_estimate v = koksma_curve_rms(e, count, level);
    long double mean = 0.0L, spread = 0.0L, reach;

    for (size_t r = 0; r < count; r++)
        mean += log_rms(e, count, r) / (long double)count;
    for (size_t r = 0; r < count; r++)
        spread += powl(log_rms(e, count, r) - mean, 2.0L);
    reach = (long double)ki_student_quantile(level, count - 1) *
            sqrtl(spread * (long double)(count - 1) / (long double)count);
    if (!can_judge()) return;
    ck_assert_double_eq_tol(v.value / (double)expl(log_rms(e, count, count)), 1.0,
                            1e-14);
    ck_assert_double_eq(v.level, level);
    ck_assert_double_eq_tol(log(v.value / v.lower), (double)reach,
                            1e-11 * (double)(1.0L + reach));
    ck_assert_double_eq_tol(log(v.upper / v.value), (double)reach,
                            1e-11 * (double)(1.0L + reach));
}

START_TEST(root_mean_squares)
{
    for (uint64_t round = 0; round < 200; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        size_t count = 2 + oracle_below(&rng, 40);
        double e[50], scale = ldexp(1.0, (int)oracle_below(&rng, 1900) - 950);

        for (size_t r = 0; r < count; r++) {
            e[r] = (oracle_dyadic(&rng, 30) - 0.5) * scale;
            if (round % 4 == 0 && r > 1) e[r] = 0.0;
        }
        check_rms(e, count, round % 3 == 0 ? 0.95 : 0.8);
    }
}
END_TEST

/* One replicate outweighs the rest: what is left without it is still not 0. */
START_TEST(one_large_error)
{
    static const double e[] = {1.0, 1e-4, 2e-4, 1e-4}, f[] = {3e-9, 1.0, 1e-9};

    check_rms(e, 4, 0.95);
    check_rms(f, 3, 0.95);
}
END_TEST

START_TEST(no_interval)
{
    static const double e[] = {-3.0, 0.0, 0.0, 0.0}, zero[] = {0.0, -0.0, 0.0};
    const koksma_estimate none[] = {
        koksma_curve_rms(e, 1, 0.95), koksma_curve_rms(e, 4, 0.95),
        koksma_curve_rms(zero, 3, 0.95), koksma_curve_rms(zero, 1, 0.95)};
    static const double value[] = {3.0, 1.5, 0.0, 0.0};

    for (size_t i = 0; i < 4; i++)
        ck_assert(none[i].value == value[i] && isnan(none[i].lower) &&
                  isnan(none[i].upper) && none[i].level == 0.0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("curve");
    TCase *tc = tcase_create("rows");

    suite_add_tcase(suite, tc);
    tcase_add_test(tc, row_numbers);
    tcase_add_test(tc, constant_values);
    tcase_add_test(tc, random_curves);
    tcase_add_test(tc, pieces);
    tcase_add_test(tc, rows_twice);
    tcase_add_test(tc, a_million_tenths);
    tcase_add_test(tc, given_rows);
    tcase_add_test(tc, extremes);
    tcase_add_test(tc, totals);
    tcase_add_test(tc, no_values);
    tcase_add_test(tc, refused);

    tc = tcase_create("rms");
    suite_add_tcase(suite, tc);
    tcase_add_test(tc, root_mean_squares);
    tcase_add_test(tc, one_large_error);
    tcase_add_test(tc, no_interval);
    return oracle_run(suite);
}
