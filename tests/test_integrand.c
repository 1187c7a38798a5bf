/* integrand.h by its formulas, sides decided in integers, and integrals on grids.
 */
#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "integrand.h"
#include "oracle.h"

/* Coordinates below are multiples of 2^-UNIT. */
enum { UNIT = 117 };

/* Whether the coordinates sum to more than 1. */
static bool beyond(const double *x, size_t dim)
{
    oracle_int sum = -((oracle_int)1 << UNIT);

    for (size_t k = 0; k < dim; k++) {
        int exp;
        oracle_int m = (oracle_int)ldexp(frexp(x[k], &exp), 53);

        exp += UNIT - 53;
        while (exp < 0 && m != 0) {
            if (m % 2 != 0) abort();
            m /= 2;
            exp++;
        }
        sum += m == 0 ? 0 : m * ((oracle_int)1 << exp);
    }
    return sum > 0;
}

/* f2 and f3 as the header writes them, in more digits than a double has. */
static double formula(const double *x, size_t dim, double a)
{
    long double sum = 0.0L, p = (long double)a;

    for (size_t k = 0; k < dim; k++)
        sum += (long double)x[k];
    if (!beyond(x, dim)) return (double)(p * sum);
    return (double)(p * sum + (dim == 2 ? 1.0L - 2.0L * p : 0.6L - 1.8L * p));
}

static double evaluate(const char *name, const double *x, double a)
{
    const koksma_integrand *f = koksma_integrand_find(name);
    koksma_error err = {0};
    double v = 7.0;
    koksma_status status =
        koksma_integrand_eval(&v, f, a, (koksma_points){x, 1, f->dim}, &err);

    ck_assert_msg(status == KOKSMA_OK, "%s", err.text);
    return v;
}

static void check_point(const double *x, size_t dim, double a)
{
    double v = evaluate(dim == 2 ? "f2" : "f3", x, a), want = formula(x, dim, a);

    if (fabs(v - want) > 0x1p-51)
        ck_abort_msg("f%zu at %a %a %a, a %g: %.17g, not %.17g", dim, x[0], x[1],
                     dim == 3 ? x[2] : 0.0, a, v, want);
}

/* On the line, and off it by as little as doubles can say. */
static const struct side {
    double x, y;
    int above;
} sides[] = {
    {0.0, 1.0, 0},
    {1.0, 0.0, 0},
    {1.0, 0x1p-60, 1},
    {0x1p-60, 1.0, 1},
    {1.0, 0x1p-1074, 1},
    {0x1p-1074, 1.0, 1},
    {1.0, -0.0, 0},
    {0x1p-60, 1.0 - 0x1p-53, 0},
    {0x1p-53, 1.0 - 0x1p-53, 0},
    {0x1.0000000000001p-53, 1.0 - 0x1p-53, 1},
    {0x1.fffffffffffffp-54, 1.0 - 0x1p-53, 0},
    {0.5, 0.5, 0},
    {0.5 + 0x1p-53, 0.5 - 0x1p-53, 0},
    {0.5 + 0x1p-53, 0.5 - 0x1p-54, 1},
    {0.5 + 0x1p-53, 0.5 - 0x1.8p-53, 0},
    {0.5, 0.5 - 0x1p-54, 0},
    {0.1, 0.9, 1}, /* both lie above what they are read from */
    {1.0, 1.0, 1},
    {0.0, 0.0, 0},
};

START_TEST(sides_of_f2)
{
    for (size_t i = 0; i < sizeof sides / sizeof *sides; i++) {
        double x[] = {sides[i].x, sides[i].y}, y[] = {sides[i].y, sides[i].x};

        ck_assert_msg(evaluate("f2", x, 0.0) == sides[i].above, "%a %a", x[0],
                      x[1]);
        ck_assert_msg(evaluate("f2", y, 0.0) == sides[i].above, "%a %a", y[0],
                      y[1]);
    }
}
END_TEST

/* Each in all six orders: sums in doubles round differently. */
START_TEST(sides_of_f3)
{
    static const struct {
        double x[3];
        int above;
    } cases[] = {
        {{1.0, 0.0, 0.0}, 0},
        {{1.0, 0x1p-1074, 0.0}, 1},
        {{1.0, 0x1p-60, 0x1p-60}, 1},
        {{0.5, 0.25, 0.25}, 0},
        {{0.5, 0.5, 0x1p-60}, 1},
        {{0.5, 0.5 - 0x1p-54, 0x1p-54}, 0},
        {{0.5, 0.5 - 0x1p-54, 0x1.0000000000001p-54}, 1},
        {{0.5, 0.5 - 0x1p-54, 0x1.fffffffffffffp-55}, 0},
        {{1.0 - 0x1p-53, 0x1p-54, 0x1p-54}, 0},
        {{1.0 - 0x1p-53, 0x1p-54, 0x1.0000000000001p-54}, 1},
        {{1.0 - 0x1p-53, 0x1p-54, 0x1.fffffffffffffp-55}, 0},
        {{0x1.5555555555555p-2, 0x1.5555555555555p-2, 0x1.5555555555555p-2}, 0},
        {{0x1.5555555555555p-2, 0x1.5555555555555p-2, 0x1.5555555555556p-2}, 0},
        {{0x1.5555555555555p-2, 0x1.5555555555556p-2, 0x1.5555555555556p-2}, 1},
    };
    static const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                    {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};

    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int j = 0; j < 6; j++) {
            double x[3];

            for (int k = 0; k < 3; k++)
                x[k] = cases[i].x[order[j][k]];
            ck_assert_msg(evaluate("f3", x, 0.0) == (cases[i].above ? 0.6 : 0.0),
                          "%a %a %a", x[0], x[1], x[2]);
        }
}
END_TEST

/* The last coordinate is what is missing to 1, or a few units of the last bit
 * more or less, for most of the points: those a sum in doubles may misjudge. */
START_TEST(random_points)
{
    for (uint64_t round = 0; round < 20000 * oracle_scale(); round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        size_t dim = 2 + round % 2, last = dim - 1;
        double x[3] = {0.0, 0.0, 0.0}, rest = 1.0;
        double most = dim == 2 ? 0.5 : 1.0 / 3.0;

        for (size_t k = 0; k < last; k++) {
            x[k] = ldexp(0.5 + oracle_dyadic(&rng, 52) / 2.0,
                         -(int)oracle_below(&rng, round % 5 == 0 ? 60 : 3));
            rest -= x[k];
        }
        if (round % 10 < 8) x[last] = fmin(fmax(rest, 0.0), 1.0);
        for (size_t steps = oracle_below(&rng, 4); steps > 0 && round % 10 < 6;
             steps--)
            x[last] = nextafter(x[last], round % 3 == 0 ? 0.0 : 1.0);
        if (x[last] < 0x1p-60) x[last] = 0.0;
        if (round % 10 == 9) x[last] = oracle_dyadic(&rng, 53);
        check_point(x, dim, 0.0);
        check_point(x, dim, most * oracle_dyadic(&rng, 53));
        check_point(x, dim, most);
    }
}
END_TEST

/* The mean over the centres of m^dim cells is off by no more than the jump times
 * the share of cells that the discontinuity meets; linear pieces are integrated
 * exactly by midpoints, so nothing is off where there is no jump. */
START_TEST(integrals)
{
    static double x[3 * 40 * 40 * 40], f[40 * 40 * 40];

    for (const koksma_integrand *g = koksma_integrands; g->name != NULL; g++)
        for (size_t m = g->dim == 2 ? 39 : 20; m <= (g->dim == 2 ? 240 : 40);
             m += 7)
            for (int i = 0; i <= 4; i++) {
                double a = g->a_most * i / 4.0, mean = 0.0;
                size_t n = 1;

                for (size_t k = 0; k < g->dim; k++)
                    n *= m;
                for (size_t j = 0; j < n; j++)
                    for (size_t k = 0, c = j; k < g->dim; k++, c /= m)
                        x[j * g->dim + k] = ((double)(c % m) + 0.5) / (double)m;
                ck_assert_int_eq(koksma_integrand_eval(
                                     f, g, a, (koksma_points){x, n, g->dim}, NULL),
                                 KOKSMA_OK);
                for (size_t j = 0; j < n; j++)
                    mean += f[j] / (double)n;
                ck_assert_double_eq_tol(mean, g->integral,
                                        1.5 * g->jump(a) / (double)m + 1e-12);
            }
}
END_TEST

START_TEST(table_of_integrands)
{
    const koksma_integrand *f2 = koksma_integrand_find("f2");
    const koksma_integrand *f3 = koksma_integrand_find("f3");
    size_t count = 0;

    for (const koksma_integrand *f = koksma_integrands; f->name != NULL; f++) {
        ck_assert_ptr_eq(koksma_integrand_find(f->name), f);
        ck_assert_uint_gt(strlen(f->summary), 0);
        ck_assert(f->integral == 0.5);
        count++;
    }
    ck_assert_uint_eq(count, 2);
    ck_assert_ptr_null(koksma_integrand_find(""));
    ck_assert_ptr_null(koksma_integrand_find("f"));
    ck_assert(f2->dim == 2 && f2->a_most == 0.5);
    ck_assert(f3->dim == 3 && f3->a_most == 1.0 / 3.0);
    ck_assert(f2->jump(0.0) == 1.0 && f2->jump(0.125) == 0.75);
    ck_assert(f2->jump(0.5) == 0.0 && f3->jump(0.0) == 0.6);
    ck_assert_double_eq_tol(f3->jump(0.25), 0.15, 1e-15);
    ck_assert(f3->jump(f3->a_most) >= 0.0 && f3->jump(f3->a_most) < 1e-15);
}
END_TEST

/* The jump is what the value does across the discontinuity. */
START_TEST(jumps)
{
    for (const koksma_integrand *f = koksma_integrands; f->name != NULL; f++)
        for (int i = 0; i <= 8; i++) {
            double a = f->a_most * i / 8.0;
            double on[3] = {0.5, 0.5, 0.0}, above[3] = {0.5, 0.5 + 0x1p-53, 0.0};

            ck_assert_double_eq_tol(f->value(above, a) - f->value(on, a),
                                    f->jump(a), 1e-15);
        }
}
END_TEST

static void check_refused(const char *name, double a, koksma_points p,
                          koksma_status want, const char *text)
{
    double f[2] = {7.0, 8.0};
    koksma_error err = {0};

    ck_assert_int_eq(
        koksma_integrand_eval(f, koksma_integrand_find(name), a, p, &err), want);
    ck_assert_int_eq(err.status, want);
    ck_assert_ptr_nonnull(strstr(err.text, text));
    ck_assert_int_eq(
        koksma_integrand_eval(f, koksma_integrand_find(name), a, p, NULL), want);
    ck_assert(f[0] == 7.0 && f[1] == 8.0);
}

START_TEST(refused)
{
    double x[6] = {0.0, 1.0, 0.5, 0.5, 0.25, 0.75};
    const koksma_points two = {x, 2, 2}, three = {x, 2, 3};

    check_refused("f2", 0.0, three, KOKSMA_EINVAL, "f2 takes 2");
    check_refused("f3", 0.0, two, KOKSMA_EINVAL, "f3 takes 3");
    check_refused("f3", 0.0, (koksma_points){x, 2, 1}, KOKSMA_EINVAL, "f3 takes 3");
    check_refused("f2", (double)NAN, two, KOKSMA_EDOMAIN, "nan");
    check_refused("f2", -0x1p-1074, two, KOKSMA_EDOMAIN, "[0,0.5]");
    check_refused("f2", nextafter(0.5, 1.0), two, KOKSMA_EDOMAIN, "[0,0.5]");
    check_refused("f2", (double)INFINITY, two, KOKSMA_EDOMAIN, "inf");
    check_refused("f3", nextafter(1.0 / 3.0, 1.0), three, KOKSMA_EDOMAIN, "f3");
    check_refused("f3", 0.5, three, KOKSMA_EDOMAIN, "a is 0.5");
    check_refused("f2", 0.0, (koksma_points){x, 0, 2}, KOKSMA_EINVAL, "0 points");
    x[3] = 1.5;
    check_refused("f2", 0.0, two, KOKSMA_EDOMAIN, "coordinate 2 of point 2 is 1.5");
    x[3] = (double)NAN;
    check_refused("f3", 0.0, three, KOKSMA_EDOMAIN, "coordinate 1 of point 2");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("integrand");
    TCase *tc = tcase_create("values");

    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 20.0 * (double)oracle_scale());
    tcase_add_test(tc, sides_of_f2);
    tcase_add_test(tc, sides_of_f3);
    tcase_add_test(tc, random_points);
    tcase_add_test(tc, integrals);
    tcase_add_test(tc, jumps);

    tc = tcase_create("calls");
    suite_add_tcase(suite, tc);
    tcase_add_test(tc, table_of_integrands);
    tcase_add_test(tc, refused);
    return oracle_run(suite);
}
