/* fit.h: laws that are known, a plain jackknife by normal equations, and what must
 * make no difference. */
#include "fit_fixture.h"
#include "num_kernels.h"

/* The coefficient of u^(terms - 1) in the least-squares polynomial through (u, y),
 * by elimination in the normal equations. */
static long double top_coefficient(const long double *u, const long double *y,
                                   size_t count, size_t terms)
{
    long double a[3][4] = {{0.0L}};

    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < terms; j++) {
            for (size_t k = 0; k < terms; k++)
                a[j][k] += powl(u[i], (long double)(j + k));
            a[j][terms] += powl(u[i], (long double)j) * y[i];
        }
    for (size_t j = 0; j < terms; j++)
        for (size_t l = j + 1; l < terms; l++) {
            long double f = a[l][j] / a[j][j];

            for (size_t k = j; k <= terms; k++)
                a[l][k] -= f * a[j][k];
        }
    return a[terms - 1][terms] / a[terms - 1][terms - 1];
}

/* What a fit finds in a full table in the order of random_table, without replicate
 * `left`: the coefficient of u or u^2, or the power of ln N beside 1/N. */
typedef enum quantity { SLOPE = 2, BEND = 3, LOG_POWER = 4 } quantity;

static long double refit(const table *t, size_t left, quantity q)
{
    long double u[LEVELS], y[LEVELS], mean = 0.0L;
    size_t levels = t->rows / t->sets;

    for (size_t i = 0; i < levels; i++) {
        long double sum = 0.0L;

        for (size_t r = 0; r < t->sets; r++)
            if (r != left) sum += powl((long double)t->y[r * levels + i], 2.0L);
        u[i] = logl((long double)t->x[i]);
        y[i] = logl(sum / (long double)(t->sets - (left < t->sets))) / 2.0L;
        if (q == LOG_POWER) {
            y[i] += u[i];
            u[i] = logl(u[i]);
        }
        mean += u[i] / (long double)levels;
    }
    for (size_t i = 0; i < levels; i++)
        u[i] -= mean;
    return top_coefficient(u, y, levels, q == BEND ? 3 : 2);
}

static void check_term(koksma_fit_term found, const table *t, quantity terms,
                       double level)
{
    koksma_estimate e = found.value;
    double se = found.se;
    long double mean = 0.0L, spread = 0.0L, m = (long double)t->sets, want;
    double reach = ki_student_quantile(level, t->sets - 1);

    for (size_t r = 0; r < t->sets; r++)
        mean += refit(t, r, terms) / m;
    for (size_t r = 0; r < t->sets; r++)
        spread += powl(refit(t, r, terms) - mean, 2.0L);
    want = sqrtl((m - 1.0L) / m * spread);
    ck_assert_double_eq_tol(e.value, (double)refit(t, t->sets, terms), 1e-12);
    ck_assert_double_eq_tol(se / (double)want, 1.0, 1e-10);
    ck_assert_double_eq_tol(e.value - e.lower, reach * se, 1e-14 * (1.0 + reach));
    ck_assert_double_eq_tol(e.upper - e.value, reach * se, 1e-14 * (1.0 + reach));
    ck_assert_double_eq(e.level, level);
}

START_TEST(plain_jackknife)
{
    for (uint64_t round = 0; round < 40; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        koksma_fit_opts o = {.level = round % 2 == 0 ? 0.0 : 0.8};
        koksma_fit_result f;
        double level = round % 2 == 0 ? 0.95 : 0.8;

        random_table(&data, &rng, 2 + oracle_below(&rng, 20),
                     3 + oracle_below(&rng, 20), -oracle_dyadic(&rng, 8));
        f = fit(&data, round == 0 ? NULL : &o);
        ck_assert_uint_eq(f.sets, data.sets);
        ck_assert_uint_eq(f.used, data.rows / data.sets);
        ck_assert(f.missing + f.zero + f.below_floor == 0 && f.from == 8.0);
        ck_assert(f.to == data.x[data.rows - 1]);
        ck_assert_uint_eq(f.exponent.groups, data.sets);
        check_term(f.exponent, &data, SLOPE, level);
        check_term(f.slope, &data, SLOPE, level);
        check_term(f.curvature, &data, BEND, level);
        check_term(f.log_power, &data, LOG_POWER, level);
        ck_assert(f.model == KOKSMA_FIT_POWER && isnan(f.cross) && isnan(f.smooth));
    }
}
END_TEST

/* y = (1 + set) N^s: no replicate differs in slope, and no interval has a width. */
START_TEST(power_laws)
{
    static const double exponents[] = {-0.75, -2.0 / 3.0, -0.5, -1.0,
                                       0.0,   1.25,       -7.0};

    for (size_t sets = 1; sets <= 3; sets++)
        for (size_t i = 0; i < sizeof exponents / sizeof *exponents; i++) {
            double s = exponents[i], rms = 0.0;
            koksma_fit_result f;

            data.rows = data.sets = 0;
            for (size_t r = 0; r < sets; r++) {
                rms += pow((double)(r + 1), 2.0) / (double)sets;
                for (double n = 8.0; n <= 1024.0; n = floor(n * 1.5))
                    add(&data, n, r,
                        (r % 2 ? 3.0 : -3.0) * (double)(r + 1) * pow(n, s));
            }
            f = fit(&data, NULL);
            ck_assert_double_eq_tol(f.exponent.value.value, s, 1e-12);
            ck_assert_double_eq_tol(f.curvature.value.value, 0.0, 1e-12);
            ck_assert_double_eq_tol(f.constant / (3.0 * sqrt(rms)), 1.0, 1e-12);
            ck_assert(f.used == data.rows / sets && f.sets == sets);
            if (sets > 1) {
                ck_assert_double_lt(f.exponent.se, 1e-12);
                ck_assert(f.exponent.value.lower <= f.exponent.value.value &&
                          f.exponent.value.upper >= f.exponent.value.value);
                ck_assert_int_eq(f.shape, KOKSMA_STRAIGHT);
                continue;
            }
            ck_assert(isnan(f.exponent.se) && isnan(f.curvature.se));
            ck_assert(isnan(f.exponent.value.lower) &&
                      isnan(f.exponent.value.upper));
            ck_assert(isnan(f.curvature.value.lower) &&
                      isnan(f.curvature.value.upper));
            ck_assert(f.exponent.value.level == 0.0 &&
                      f.curvature.value.level == 0.0);
            ck_assert_int_eq(f.shape, KOKSMA_SHAPE_UNKNOWN);
        }
}
END_TEST

/* ln y = 1 - u/2 + q u^2 with u = ln N less its mean: the line has the slope of
 * the polynomial at the mean, since these N lie evenly about it. */
START_TEST(quadratics)
{
    for (double q = -0.05; q < 0.06; q += 0.025) {
        koksma_fit_result f;

        data.rows = data.sets = 0;
        for (int i = 3; i <= 17; i++) {
            double u = (i - 10) * log(2.0);

            add(&data, exp2(i), 0, exp(1.0 - u / 2.0 + q * u * u));
        }
        f = fit(&data, NULL);
        ck_assert_double_eq_tol(f.curvature.value.value, q, 1e-12);
        ck_assert_double_eq_tol(f.exponent.value.value, -0.5, 1e-12);
    }
}
END_TEST

/* The order of rows, the sign of errors and their unit are nothing, to the bit;
 * which replicate is called 0 moves roundings alone. */
START_TEST(invariances)
{
    static table changed;

    for (uint64_t round = 0; round < 20; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        koksma_fit_result f, g;
        int shift = (int)oracle_below(&rng, 1900) - 950;

        random_table(&data, &rng, 2 + oracle_below(&rng, 9), 12, -0.6);
        f = fit(&data, NULL);
        changed = data;
        for (size_t i = data.rows; i > 1; i--) {
            size_t j = oracle_below(&rng, i);
            table *t = &changed;
            double x = t->x[i - 1], y = t->y[i - 1];
            size_t set = t->set[i - 1];

            t->x[i - 1] = t->x[j], t->y[i - 1] = t->y[j];
            t->set[i - 1] = t->set[j];
            t->x[j] = x, t->y[j] = -y, t->set[j] = set;
        }
        g = fit(&changed, NULL);
        ck_assert(same_line(f, g) && f.constant == g.constant);
        for (size_t i = 0; i < data.rows; i++)
            changed.y[i] = ldexp(changed.y[i], shift);
        g = fit(&changed, NULL);
        ck_assert(same_line(f, g));
        ck_assert_double_eq_tol(ldexp(g.constant, -shift) / f.constant, 1.0, 1e-15);
        changed = data;
        for (size_t i = 0; i < data.rows; i++)
            changed.set[i] = (data.set[i] + 1 + round) % data.sets;
        g = fit(&changed, NULL);
        ck_assert_double_eq_tol(g.exponent.value.value, f.exponent.value.value,
                                1e-13);
        ck_assert_double_eq_tol(g.exponent.se / f.exponent.se, 1.0, 1e-11);
        ck_assert_double_eq_tol(g.curvature.se / f.curvature.se, 1.0, 1e-11);
    }
}
END_TEST

/* y = C N^-1 (ln N)^k.  With k above 0 it steepens, with k below it flattens. */
START_TEST(logarithms)
{
    for (double k = -1.0; k <= 3.0; k += 0.5) {
        koksma_fit_result f;

        data.rows = data.sets = 0;
        for (size_t r = 0; r < 2; r++)
            for (double n = 3.0; n <= 1e6; n = rint(n * 1.7))
                add(&data, n, r, (r == 0 ? 2.0 : -7.0) * pow(log(n), k) / n);
        f = fit(&data, NULL);
        ck_assert_double_eq_tol(f.log_power.value.value, k, 1e-11);
        ck_assert_int_eq(f.shape, k > 0.0   ? KOKSMA_STEEPENS
                                  : k < 0.0 ? KOKSMA_FLATTENS
                                            : KOKSMA_STRAIGHT);
        add(&data, 2.9, 0, 1.0), add(&data, 2.9, 1, 1.0);
        ck_assert(isnan(fit(&data, NULL).log_power.value.value));
    }
}
END_TEST

/* A bend counts from 2.6 standard errors on. */
START_TEST(shapes)
{
    size_t seen[4] = {0};

    for (uint64_t round = 0; round < 300; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        koksma_fit_result f;
        double t, bend = (double)(round % 3) * 0.03 - 0.03;

        random_table(&data, &rng, 8, 20, -0.6);
        for (size_t i = 0; i < data.rows; i++)
            data.y[i] *= exp(bend * pow(log(data.x[i]), 2.0));
        f = fit(&data, NULL);
        t = f.curvature.value.value / f.curvature.se;
        ck_assert_int_eq(f.shape, t > 2.6    ? KOKSMA_FLATTENS
                                  : t < -2.6 ? KOKSMA_STEEPENS
                                             : KOKSMA_STRAIGHT);
        seen[f.shape]++;
    }
    ck_assert(seen[KOKSMA_STRAIGHT] > 50 && seen[KOKSMA_FLATTENS] > 10 &&
              seen[KOKSMA_STEEPENS] > 10);
}
END_TEST

/* N times 2^j: the exponent and the curvature stay, and the constant follows. */
START_TEST(stretched)
{
    for (uint64_t round = 0; round < 20; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        int shift = (int)oracle_below(&rng, 400) - 200;
        koksma_fit_result f, g;

        random_table(&data, &rng, 5, 12, -0.6);
        f = fit(&data, NULL);
        for (size_t i = 0; i < data.rows; i++)
            data.x[i] = ldexp(data.x[i], shift);
        g = fit(&data, NULL);
        ck_assert_double_eq_tol(g.slope.value.value, f.slope.value.value, 1e-11);
        ck_assert_double_eq_tol(g.slope.se / f.slope.se, 1.0, 1e-9);
        ck_assert_double_eq_tol(g.curvature.value.value, f.curvature.value.value,
                                1e-10);
        ck_assert_double_eq_tol(g.curvature.se / f.curvature.se, 1.0, 1e-8);
        ck_assert_double_eq_tol(g.constant * pow(exp2(shift), g.slope.value.value) /
                                    f.constant,
                                1.0, 1e-8);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fit");
    TCase *tc = tcase_create("lines");

    suite_add_tcase(suite, tc);
    tcase_add_test(tc, power_laws);
    tcase_add_test(tc, quadratics);
    tcase_add_test(tc, logarithms);
    tcase_add_test(tc, shapes);
    tcase_add_test(tc, plain_jackknife);
    tcase_add_test(tc, invariances);
    tcase_add_test(tc, stretched);
    return oracle_run(suite);
}
