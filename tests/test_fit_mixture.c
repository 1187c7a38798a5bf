/* fit.h: two terms, from curves of which they are known; and their jackknife. */
#include "fit_fixture.h"
#include "fit_kernels.h"

/* rms = sqrt( A N^2s + B N^-2 (ln N)^log ), the same in every replicate. */
static void mixture(table *t, size_t sets, int octaves, double a, double s,
                    double b, double power)
{
    t->rows = t->sets = 0;
    for (size_t r = 0; r < sets; r++)
        for (int i = 6; i <= 2 * octaves; i++) {
            double n = rint(exp2(i / 2.0));

            add(t, n, r,
                sqrt(a * pow(n, 2.0 * s) + b * pow(log(n), power) / (n * n)));
        }
}

static const koksma_fit_opts both[] = {{.model = KOKSMA_FIT_TWO_POWERS},
                                       {.model = KOKSMA_FIT_TWO_TERMS}};

START_TEST(known_terms)
{
    static const double exponents[] = {-0.5, -0.55, -2.0 / 3.0, -0.75, -0.8};
    static const double ratios[] = {0.5, 4.0, 30.0, 200.0};

    for (int power = 0; power <= 1; power++)
        for (size_t i = 0; i < 5; i++)
            for (size_t j = 0; j < 4; j++) {
                double s = exponents[i], b = ratios[j], n;
                koksma_fit_result f;

                mixture(&data, 2, 20, 0.04, s, 0.04 * b, power);
                f = fit(&data, &both[power]);
                ck_assert_double_eq_tol(f.exponent.value.value, s, 2e-6);
                ck_assert_double_eq_tol(f.constant / 0.2, 1.0, 2e-5);
                ck_assert_double_eq_tol(f.smooth / (0.2 * sqrt(b)), 1.0, 2e-5);
                ck_assert_int_eq(f.model, both[power].model);
                ck_assert_double_lt(f.exponent.se, 1e-5);
                ck_assert_uint_eq(f.exponent.groups, 2);
                n = f.cross;
                if (power == 0)
                    ck_assert_double_eq_tol(n > 0.0 ? n / pow(b, 0.5 / (1.0 + s))
                                                    : b,
                                            b > 1.0 ? 1.0 : b, 1e-3);
                else if (n > 0.0)
                    ck_assert_double_eq_tol(pow(n, 2.0 + 2.0 * s) / (b * log(n)),
                                            1.0, 1e-3);
                else /* the least of N^(2+2s)/ln N is above b */
                    ck_assert_double_ge(exp(1.0) * (2.0 + 2.0 * s), b * 0.999);
            }
}
END_TEST

/* One term alone: a power law, or none. */
START_TEST(one_term)
{
    koksma_fit_result f;

    for (int power = 0; power <= 1; power++) {
        mixture(&data, 2, 17, 0.04, -0.7, 0.0, power);
        f = fit(&data, &both[power]);
        ck_assert_double_eq_tol(f.exponent.value.value, -0.7, 1e-3);
        ck_assert_double_lt(f.smooth, 0.02);
        mixture(&data, 2, 17, 0.0, -0.7, 0.04, power);
        f = fit(&data, &both[power]);
        ck_assert_double_le(f.exponent.value.value, -0.99);
    }
    ck_assert(f.cross == HUGE_VAL || f.exponent.value.value > -1.0);
}
END_TEST

/* The fit of a sixteenth left out in turn, from tables without it; and no sets are
 * too few. */
START_TEST(groups_left_out)
{
    static table less;

    for (size_t sets = 1; sets <= 40; sets += 13) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), sets);
        size_t groups = sets < 16 ? sets : 16;
        koksma_fit_result f;
        double values[17], mean = 0.0, spread = 0.0;

        random_table(&data, &rng, sets, 24, -0.6);
        for (size_t i = 0; i < data.rows; i++) /* about half and half at 2^8 */
            data.y[i] *= sqrt(1.0 + pow(data.x[i] / 256.0, -0.8));
        f = fit(&data, &both[1]);
        ck_assert_uint_eq(f.exponent.groups, groups);
        ck_assert_uint_eq(f.slope.groups, sets);
        ck_assert(isnan(f.exponent.se) == (sets == 1));
        for (size_t g = 0; g < groups && sets > 1; g++) {
            size_t kept = 0, number = 0;

            less.rows = less.sets = 0;
            for (size_t r = 0; r < sets; r++) {
                if (r % groups == g) continue;
                for (size_t i = 0; i < data.rows; i++)
                    if (data.set[i] == r) add(&less, data.x[i], number, data.y[i]);
                number++;
                kept++;
            }
            ck_assert_uint_eq(less.sets, kept);
            values[g] = fit(&less, &both[1]).exponent.value.value;
            mean += values[g] / (double)groups;
        }
        for (size_t g = 0; g < groups && sets > 1; g++)
            spread += pow(values[g] - mean, 2.0);
        if (sets > 1)
            ck_assert_double_eq_tol(
                f.exponent.se, sqrt(spread * (double)(groups - 1) / (double)groups),
                1e-6);
    }
}
END_TEST

/* Two terms by themselves when it flattens and the data suffice; never else. */
START_TEST(automatic)
{
    static const struct {
        size_t sets;
        int octaves; /* from 2^3 on */
        double b;
        koksma_fit_model model;
    } cases[] = {
        {64, 19, 9.0, KOKSMA_FIT_TWO_TERMS}, {63, 19, 9.0, KOKSMA_FIT_POWER},
        {64, 18, 9.0, KOKSMA_FIT_POWER},     {64, 19, 0.0, KOKSMA_FIT_POWER},
        {1, 19, 9.0, KOKSMA_FIT_POWER},
    };

    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        koksma_fit_result f;

        mixture(&data, cases[c].sets, cases[c].octaves, 0.04, -0.7,
                0.04 * cases[c].b, 1.0);
        f = fit(&data, NULL);
        ck_assert_msg(f.model == cases[c].model, "case %zu", c);
        ck_assert_double_eq_tol(
            f.exponent.value.value, -0.7,
            f.model == KOKSMA_FIT_POWER && cases[c].b > 0.0 ? 0.2 : 1e-5);
        ck_assert(fit(&data, &(koksma_fit_opts){.model = KOKSMA_FIT_POWER}).model ==
                  KOKSMA_FIT_POWER);
    }
}
END_TEST

START_TEST(units)
{
    koksma_fit_result f, g;
    oracle_rng rng = oracle_rng_start(oracle_seed(), 1);

    random_table(&data, &rng, 20, 24, -0.6);
    f = fit(&data, &both[1]);
    for (size_t i = 0; i < data.rows; i++)
        data.y[i] *= -0x1p-30;
    g = fit(&data, &both[1]);
    ck_assert(same_line(f, g) && f.cross == g.cross);
    ck_assert_double_eq_tol(g.constant * 0x1p30, f.constant, 1e-12 * f.constant);
}
END_TEST

START_TEST(refused)
{
    koksma_error err;
    koksma_fit_result f;

    mixture(&data, 2, 4, 1.0, -0.6, 1.0, 1.0); /* 8, 11, 16 */
    ck_assert_int_eq(try_fit(&f, &data, &both[1], &err), KOKSMA_EINVAL);
    ck_assert_str_eq(err.text, "two terms take 4 usable N above 1, not 3 from 8");
    mixture(&data, 2, 6, 1.0, -0.6, 1.0, 1.0);
    ck_assert_int_eq(try_fit(&f, &data, &both[1], &err), KOKSMA_OK);
    data.x[0] = data.x[data.rows / 2] = 1.0;
    ck_assert_int_eq(try_fit(&f, &data, &both[1], &err), KOKSMA_EINVAL);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fit mixture");
    TCase *tc = tcase_create("two terms"), *slow = tcase_create("groups");

    suite_add_tcase(suite, tc);
    tcase_add_test(tc, known_terms);
    tcase_add_test(tc, one_term);
    tcase_add_test(tc, automatic);
    tcase_add_test(tc, units);
    tcase_add_test(tc, refused);
    tcase_set_tags(slow, "slow");
    tcase_add_test(slow, groups_left_out);
    suite_add_tcase(suite, slow);
    return oracle_run(suite);
}
