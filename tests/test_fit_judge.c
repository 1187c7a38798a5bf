/* fit.h: candidates and verdicts, in every branch. */
#include <check.h>
#include <math.h>

#include "fit.h"
#include "oracle.h"

/* 32 groups: the interval reaches 2.0395 se to either side, the two one-sided tests
 * at 5 % reach 1.6955 se [tables of Student's t, 31 degrees of freedom]. */
static koksma_fit_result known(double value, double se)
{
    double reach = 2.0395 * se;

    return (koksma_fit_result){
        .model = KOKSMA_FIT_POWER,
        .shape = KOKSMA_STRAIGHT,
        .exponent = {{value, value - reach, value + reach, 0.95}, se, 32},
        .sets = 32,
        .from = 64.0,
        .to = 131072.0};
}

START_TEST(tests_of_one)
{
    static const struct {
        double se, candidate, margin;
        bool rejected, near;
    } cases[] = {
        {0.02, -0.75, 0.05, false, true},
        {0.02, -0.76, 0.0440, false, true}, /* 0.04391 */
        {0.02, -0.76, 0.0438, false, false},
        {0.02, -0.74, 0.0440, false, true},
        {0.02, -0.74, 0.0438, false, false},
        {0.02, -0.7093, 0.05, false, false}, /* 0.04079 */
        {0.02, -0.7091, 0.05, true, false},
        {0.02, -0.7907, 0.05, false, false},
        {0.02, -0.7909, 0.05, true, false},
        {0.001, -0.74, 0.05, true, true},
        {0.0, -0.75, 0.05, false, true},
        {0.0, -0.74, 0.005, true, false},
    };

    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        koksma_fit_result f = known(-0.75, cases[i].se);
        koksma_fit_test t = koksma_fit_try(&f, cases[i].candidate, cases[i].margin);
        double off = -0.75 - cases[i].candidate;

        ck_assert_msg(t.rejected == cases[i].rejected && t.near == cases[i].near,
                      "case %zu: %d %d", i, t.rejected, t.near);
        if (off == 0.0) ck_assert(t.z == 0.0);
        if (cases[i].se > 0.0)
            ck_assert_double_eq_tol(t.z, off / cases[i].se, 1e-12);
    }
}
END_TEST

START_TEST(verdicts)
{
    static const double rivals[] = {-0.5, -1.0, -0.7};
    static const struct {
        double value, se, claim, margin;
        size_t rivals;
        koksma_verdict verdict;
        koksma_doubt doubt;
    } cases[] = {
        {-0.75, 0.02, -0.75, 0.05, 2, KOKSMA_EQUIVALENT, KOKSMA_NO_DOUBT},
        {-0.75, 0.02, -0.75, 0.05, 3, KOKSMA_EQUIVALENT, KOKSMA_NO_DOUBT},
        {-0.75, 0.02, -0.75, 0.03, 2, KOKSMA_UNDECIDED, KOKSMA_DOUBT_WIDE},
        {-0.73, 0.02, -0.75, 0.06, 2, KOKSMA_EQUIVALENT, KOKSMA_NO_DOUBT},
        {-0.73, 0.02, -0.75, 0.06, 3, KOKSMA_UNDECIDED, KOKSMA_DOUBT_RIVAL},
        {-0.75, 0.2, -0.75, 0.05, 2, KOKSMA_UNDECIDED, KOKSMA_DOUBT_WIDE},
        {-0.6, 0.02, -0.75, 0.05, 2, KOKSMA_DIFFERENT, KOKSMA_NO_DOUBT},
        {-0.9, 0.02, -0.75, 0.05, 2, KOKSMA_DIFFERENT, KOKSMA_NO_DOUBT},
        {-0.74, 0.001, -0.75, 0.05, 3, KOKSMA_EQUIVALENT, KOKSMA_NO_DOUBT},
        {-0.71, 0.01, -0.75, 0.1, 3, KOKSMA_DIFFERENT, KOKSMA_NO_DOUBT},
        {-0.5, 0.02, -0.5, 0.05, 3, KOKSMA_EQUIVALENT, KOKSMA_NO_DOUBT},
        {-0.75, 0.02, -0.75, 0.05, 0, KOKSMA_EQUIVALENT, KOKSMA_NO_DOUBT},
    };

    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        koksma_fit_result f = known(cases[i].value, cases[i].se);
        koksma_judgement j = koksma_fit_judge(&f, cases[i].claim, rivals,
                                              cases[i].rivals, cases[i].margin);

        ck_assert_msg(j.verdict == cases[i].verdict && j.doubt == cases[i].doubt,
                      "case %zu: %d %d", i, (int)j.verdict, (int)j.doubt);
    }
}
END_TEST

static void check_doubt(const koksma_fit_result *f, koksma_verdict verdict,
                        koksma_doubt doubt)
{
    koksma_judgement j = koksma_fit_judge(f, -0.75, NULL, 0, 0.05);

    ck_assert_int_eq(j.verdict, verdict);
    ck_assert_int_eq(j.doubt, doubt);
}

/* No verdict without an interval; none from a line that bends, nor from two terms
 * that the data cannot part, however near or far the exponent seems. */
START_TEST(no_verdict)
{
    for (double value = -0.75; value < -0.5; value += 0.15) {
        koksma_fit_result f = known(value, 0.01);
        koksma_verdict sure = value == -0.75 ? KOKSMA_EQUIVALENT : KOKSMA_DIFFERENT;

        f.shape = KOKSMA_FLATTENS;
        check_doubt(&f, KOKSMA_UNDECIDED, KOKSMA_DOUBT_BENT);
        f.shape = KOKSMA_STEEPENS;
        check_doubt(&f, KOKSMA_UNDECIDED, KOKSMA_DOUBT_BENT);
        f.shape = KOKSMA_FLATTENS;
        f.model = KOKSMA_FIT_TWO_TERMS;
        check_doubt(&f, KOKSMA_UNDECIDED, KOKSMA_DOUBT_FEW);
        f.sets = 64;
        check_doubt(&f, KOKSMA_UNDECIDED, KOKSMA_DOUBT_FEW);
        f.to = 64.0 * 65536.0;
        check_doubt(&f, sure, KOKSMA_NO_DOUBT);
        f.model = KOKSMA_FIT_TWO_POWERS;
        check_doubt(&f, sure, KOKSMA_NO_DOUBT);
        f.sets = 63;
        check_doubt(&f, KOKSMA_UNDECIDED, KOKSMA_DOUBT_FEW);
        f = known(value, (double)NAN);
        f.shape = KOKSMA_SHAPE_UNKNOWN;
        check_doubt(&f, KOKSMA_NO_VERDICT, KOKSMA_DOUBT_PATH);
        ck_assert(isnan(koksma_fit_try(&f, -0.75, 1.0).z));
        ck_assert(!koksma_fit_try(&f, -0.75, 1.0).near &&
                  !koksma_fit_try(&f, -0.75, 1.0).rejected);
    }
}
END_TEST

/* Below the saturation nobody can tell, however near or far the exponent seems; but
 * -1/2 is what holds there. */
START_TEST(saturated)
{
    for (double value = -0.75; value < -0.5; value += 0.15) {
        koksma_fit_result f = known(value, 0.01);
        koksma_verdict sure = value == -0.75 ? KOKSMA_EQUIVALENT : KOKSMA_DIFFERENT;

        f.saturation = nextafter(f.to, HUGE_VAL);
        check_doubt(&f, KOKSMA_UNDECIDED, KOKSMA_DOUBT_SATURATED);
        f.shape = KOKSMA_FLATTENS;
        check_doubt(&f, KOKSMA_UNDECIDED, KOKSMA_DOUBT_SATURATED);
        f.shape = KOKSMA_STRAIGHT;
        f.saturation = f.to;
        check_doubt(&f, sure, KOKSMA_NO_DOUBT);
        f = known(-0.5, 0.01);
        f.saturation = 1e9;
        ck_assert_int_eq(koksma_fit_judge(&f, -0.5, NULL, 0, 0.05).verdict,
                         KOKSMA_EQUIVALENT);
        f = known(value, (double)NAN);
        f.saturation = 1e9;
        check_doubt(&f, KOKSMA_NO_VERDICT, KOKSMA_DOUBT_PATH);
    }
}
END_TEST

START_TEST(theory)
{
    ck_assert(koksma_fit_theory(1) == -1.0 && koksma_fit_theory(2) == -0.75);
    ck_assert_double_eq_tol(koksma_fit_theory(3), -2.0 / 3.0, 1e-16);
    ck_assert(koksma_fit_theory(8) == -0.5625);
    for (size_t dim = 1; dim < 20; dim++) {
        ck_assert_double_eq_tol(koksma_fit_theory_box(dim, (double)dim - 1.0),
                                koksma_fit_theory(dim), 1e-15);
        ck_assert(koksma_fit_theory_box(dim, (double)dim) == -0.5);
    }
    /* Where sqrt(S/6) J N^-(D+1)/2D = sigma N^-1/2. */
    for (size_t dim = 1; dim < 7; dim++) {
        double n = koksma_fit_break_even(dim, 3.0, 0.7, 0.2);

        ck_assert_double_eq_tol(sqrt(0.5) * 0.7 * pow(n, koksma_fit_theory(dim)) /
                                    (0.2 * pow(n, -0.5)),
                                1.0, 1e-12);
    }
    ck_assert(koksma_fit_break_even(1, 6.0, 2.0, 1.0) == 4.0);
    ck_assert(isinf(koksma_fit_break_even(2, 1.0, 1.0, 0.0)));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fit judge");
    TCase *tc = tcase_create("judge");

    suite_add_tcase(suite, tc);
    tcase_add_test(tc, tests_of_one);
    tcase_add_test(tc, verdicts);
    tcase_add_test(tc, no_verdict);
    tcase_add_test(tc, saturated);
    tcase_add_test(tc, theory);
    return oracle_run(suite);
}
