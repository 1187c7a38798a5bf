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

static koksma_integrand make(const char *name, double a, koksma_facts *facts)
{
    koksma_integrand f;
    koksma_error err = {0};
    koksma_status status =
        koksma_integrand_make(&f, facts, koksma_integrand_find(name), 0, &a, &err);

    ck_assert_msg(status == KOKSMA_OK, "%s", err.text);
    return f;
}

static double evaluate(const char *name, const double *x, double a)
{
    koksma_integrand f = make(name, a, NULL);
    double v = 7.0;

    ck_assert_int_eq(
        koksma_integrand_eval(&v, &f, (koksma_points){x, 1, f.dim}, NULL),
        KOKSMA_OK);
    return v;
}

static const char *const jumping[] = {"f2", "f3"};

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
    static double x[3 * 240 * 240], values[240 * 240];

    for (size_t m = 20; m <= 240; m += m < 40 ? 7 : 29)
        for (int i = 0; i <= 9; i++) {
            const koksma_integrand_row *row = koksma_integrand_find(jumping[i / 5]);
            double a = row->params[0].most * (i % 5) / 4.0, mean = 0.0;
            koksma_facts facts;
            koksma_integrand f = make(row->name, a, &facts);
            size_t n = f.dim == 2 ? m * m : m * m * m;

            if (f.dim == 3 && m > 40) continue;
            for (size_t j = 0; j < n; j++)
                for (size_t k = 0, c = j; k < f.dim; k++, c /= m)
                    x[j * f.dim + k] = ((double)(c % m) + 0.5) / (double)m;
            ck_assert_int_eq(koksma_integrand_eval(
                                 values, &f, (koksma_points){x, n, f.dim}, NULL),
                             KOKSMA_OK);
            for (size_t j = 0; j < n; j++)
                mean += values[j] / (double)n;
            ck_assert_double_eq_tol(mean, facts.integral,
                                    1.5 * facts.jump / (double)m + 1e-12);
        }
}
END_TEST

START_TEST(facts_of_f2_and_f3)
{
    koksma_facts k;

    for (int i = 0; i < 10; i++) {
        double most = koksma_integrand_find(jumping[i / 5])->params[0].most;

        make(jumping[i / 5], most * (i % 5) / 4.0, &k);
        ck_assert(k.integral == 0.5 && k.error == 0.0);
        ck_assert((k.jump == 0.0) == (i % 5 == 4));
        ck_assert((k.variation < HUGE_VAL) == (i % 5 == 4));
    }
    make("f2", 0.0, &k);
    ck_assert(k.jump == 1.0 && k.variance == 0.25 && k.extent == 2.0);
    make("f2", 0.125, &k);
    ck_assert(k.jump == 0.75 && k.jump_rms == 0.75 && k.pieces == 2.0);
    make("f2", 0.5, &k);
    ck_assert(k.variation == 1.0 && k.extent == 0.0 && k.pieces == 1.0);
    make("f3", 0.0, &k);
    ck_assert(k.jump == 0.6 && k.extent == 1.5 && k.axes == 3.0 &&
              k.box_dim == 2.0);
    make("f3", 0.25, &k);
    ck_assert_double_eq_tol(k.jump, 0.15, 1e-15);
    make("f3", 1.0 / 3.0, &k);
    ck_assert(k.variation == 1.0 && k.area == 0.0 && k.axes == 0.0);
}
END_TEST

/* The jump is what the value does across the discontinuity, and the pieces are
 * what it separates. */
START_TEST(jumps)
{
    for (int i = 0; i < 18; i++) {
        double a =
            koksma_integrand_find(jumping[i / 9])->params[0].most * (i % 9) / 8.0;
        double on[3] = {0.5, 0.5, 0.0}, above[3] = {0.5, 0.5 + 0x1p-53, 0.0};
        koksma_facts facts;
        koksma_integrand f = make(jumping[i / 9], a, &facts);

        ck_assert_double_eq_tol(f.value(&f, above) - f.value(&f, on), facts.jump,
                                1e-15);
        ck_assert_uint_eq(f.piece(&f, on), 0);
        ck_assert_uint_eq(f.piece(&f, above), facts.jump > 0.0);
    }
}
END_TEST

/* ---- The table and its calls ------------------------------------------------- */

START_TEST(table_of_integrands)
{
    size_t count = 0;

    for (; koksma_integrands[count] != NULL; count++) {
        const koksma_integrand_row *row = koksma_integrands[count];

        ck_assert_ptr_eq(koksma_integrand_find(row->name), row);
        ck_assert_uint_gt(strlen(row->summary), 0);
        ck_assert(row->dim_least <= row->dim && row->dim <= row->dim_most);
        ck_assert_ptr_nonnull(row->functions.value);
        ck_assert_ptr_nonnull(row->functions.piece);
    }
    ck_assert_uint_eq(count, 18);
    ck_assert_ptr_null(koksma_integrand_find(""));
    ck_assert_ptr_null(koksma_integrand_find("f"));
    ck_assert_uint_eq(koksma_integrand_params(koksma_integrand_find("f2")), 1);
    ck_assert_uint_eq(koksma_integrand_params(koksma_integrand_find("sum")), 0);
    ck_assert_uint_eq(koksma_integrand_params(koksma_integrand_find("gaussian")),
                      2);
}
END_TEST

/* No parameters given stand for the usual ones, and dim 0 for the usual one. */
START_TEST(defaults)
{
    for (size_t i = 0; koksma_integrands[i] != NULL; i++) {
        const koksma_integrand_row *row = koksma_integrands[i];
        double usual[KOKSMA_PARAMS_MOST] = {0.0}, x[3] = {0.3, 0.4, 0.1};
        koksma_integrand f, g;
        koksma_facts a, b;

        for (size_t k = 0; k < koksma_integrand_params(row); k++)
            usual[k] = row->params[k].usual;
        ck_assert_int_eq(koksma_integrand_make(&f, &a, row, 0, NULL, NULL),
                         KOKSMA_OK);
        ck_assert_int_eq(koksma_integrand_make(&g, &b, row, row->dim, usual, NULL),
                         KOKSMA_OK);
        ck_assert_uint_eq(f.dim, row->dim);
        ck_assert(f.value(&f, x) == g.value(&g, x) && a.integral == b.integral);
    }
}
END_TEST

static void check_make_refused(const char *name, size_t dim, double first,
                               double second, koksma_status want, const char *text)
{
    koksma_integrand f = {.dim = 77};
    koksma_facts facts = {.integral = 7.0};
    const double param[KOKSMA_PARAMS_MOST] = {first, second};
    koksma_error err = {0};
    const koksma_integrand_row *row = koksma_integrand_find(name);

    ck_assert_int_eq(koksma_integrand_make(&f, &facts, row, dim, param, &err),
                     want);
    ck_assert_int_eq(err.status, want);
    ck_assert_msg(strstr(err.text, text) != NULL, "%s", err.text);
    ck_assert_int_eq(koksma_integrand_make(&f, NULL, row, dim, param, NULL), want);
    ck_assert(f.dim == 77 && facts.integral == 7.0);
}

START_TEST(refused_parameters)
{
    double nan = (double)NAN, inf = (double)INFINITY;

    check_make_refused("f2", 0, nan, 0, KOKSMA_EDOMAIN, "not nan");
    check_make_refused("f2", 0, -0x1p-1074, 0, KOKSMA_EDOMAIN, "from 0 to 0.5");
    check_make_refused("f2", 0, nextafter(0.5, 1.0), 0, KOKSMA_EDOMAIN, "f2 has a");
    check_make_refused("f2", 0, inf, 0, KOKSMA_EDOMAIN, "inf");
    check_make_refused("f3", 0, nextafter(1.0 / 3.0, 1.0), 0, KOKSMA_EDOMAIN, "f3");
    check_make_refused("gaussian", 0, 5.0, 1.5, KOKSMA_EDOMAIN,
                       "has w from 0 to 1");
    check_make_refused("fractal2", 0, 24.0, 1.0, KOKSMA_EDOMAIN, "from 1 to 23");
    check_make_refused("fractal2", 0, 2.5, 1.0, KOKSMA_EDOMAIN, "a whole number");
    check_make_refused("f2", 3, 0, 0, KOKSMA_EINVAL, "but f2 takes 2");
    check_make_refused("ball", 1, 0.3, 0, KOKSMA_EINVAL, "takes from 2 to");
    check_make_refused("ball", 21, 0.3, 0, KOKSMA_EINVAL, "21 coordinates");
}
END_TEST

static double hyperbola(const koksma_integrand *f, const double *x)
{
    return x[0] * x[1] < *(const double *)f->state;
}

/* A function of one's own takes a dim and a value. */
START_TEST(own_integrand)
{
    double level = 0.25, x[] = {0.5, 0.5, 0.125, 1.0, 0.75, 0.25}, v[3];
    koksma_integrand f = {.dim = 2, .value = hyperbola, .state = &level};

    ck_assert_int_eq(koksma_integrand_eval(v, &f, (koksma_points){x, 3, 2}, NULL),
                     KOKSMA_OK);
    ck_assert(v[0] == 0.0 && v[1] == 1.0 && v[2] == 1.0);
}
END_TEST

static void check_refused(const char *name, koksma_points p, koksma_status want,
                          const char *text)
{
    koksma_integrand g = make(name, 0.0, NULL);
    double f[2] = {7.0, 8.0};
    koksma_error err = {0};

    ck_assert_int_eq(koksma_integrand_eval(f, &g, p, &err), want);
    ck_assert_int_eq(err.status, want);
    ck_assert_ptr_nonnull(strstr(err.text, text));
    ck_assert_int_eq(koksma_integrand_eval(f, &g, p, NULL), want);
    ck_assert(f[0] == 7.0 && f[1] == 8.0);
}

START_TEST(refused_points)
{
    double x[6] = {0.0, 1.0, 0.5, 0.5, 0.25, 0.75};
    const koksma_points two = {x, 2, 2}, three = {x, 2, 3};

    check_refused("f2", three, KOKSMA_EINVAL, "3 coordinates a point");
    check_refused("f3", two, KOKSMA_EINVAL, "takes 3");
    check_refused("f3", (koksma_points){x, 2, 1}, KOKSMA_EINVAL, "takes 3");
    check_refused("f2", (koksma_points){x, 0, 2}, KOKSMA_EINVAL, "0 points");
    x[3] = 1.5;
    check_refused("f2", two, KOKSMA_EDOMAIN, "coordinate 2 of point 2 is 1.5");
    x[3] = (double)NAN;
    check_refused("f3", three, KOKSMA_EDOMAIN, "coordinate 1 of point 2");
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
    tcase_add_test(tc, facts_of_f2_and_f3);
    tcase_add_test(tc, jumps);

    tc = tcase_create("calls");
    suite_add_tcase(suite, tc);
    tcase_add_test(tc, table_of_integrands);
    tcase_add_test(tc, defaults);
    tcase_add_test(tc, refused_parameters);
    tcase_add_test(tc, own_integrand);
    tcase_add_test(tc, refused_points);
    return oracle_run(suite);
}
