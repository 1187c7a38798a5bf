/* What theory says of errors: formulas written out again, refusals, and errors of
 * points that are really made. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bound.h"
#include "fit.h"
#include "gen.h"
#include "integrand_fixture.h"
#include "oracle.h"

/* A jump in three dimensions with everything known. */
static koksma_bound_facts known(void)
{
    return (koksma_bound_facts){.dim = 3,
                                .vhk_from = KOKSMA_VHK_CLOSED,
                                .vhk = 5.0,
                                .smooth_vhk = 2.0,
                                .smooth = (double)NAN,
                                .jump = 0.5,
                                .jump_rms = 0.25,
                                .area = 1.5,
                                .extent = 2.0,
                                .axes = 2.0,
                                .sigma = 0.5};
}

static void terms(koksma_bound_term *t, const koksma_bound_facts *f, double n,
                  double star, double z)
{
    koksma_error err;

    if (koksma_bound(t, f, n, star, z, &err)) ck_abort_msg("%s", err.text);
}

static void check(koksma_bound_term t, double value, koksma_bound_kind kind)
{
    ck_assert_msg(t.kind == kind, "%d, not %d", t.kind, kind);
    if (isnan(value))
        ck_assert(isnan(t.value));
    else if (isinf(value))
        ck_assert(t.value == value);
    else
        ck_assert_double_eq_tol(t.value, value, 1e-14 * value + 1e-300);
}

START_TEST(every_term)
{
    koksma_bound_facts f = known();
    koksma_bound_term t[KOKSMA_BOUND_TERMS];
    double jump = sqrt(1.5 / 6.0) * 0.25 / pow(4096.0, 0.75), rms;

    terms(t, &f, 4096.0, 0.01, 3.0);
    rms = sqrt(jump * jump + 0.02 * 0.02);
    check(t[KOKSMA_BOUND_HLAWKA], 0.05, KOKSMA_BOUND_PROVED);
    check(t[KOKSMA_BOUND_SMOOTH], 0.02, KOKSMA_BOUND_PROVED);
    check(t[KOKSMA_BOUND_PAPER], 0.02 + sqrt(2.0) * 0.5 / 256.0,
          KOKSMA_BOUND_ONE_SIGMA);
    check(t[KOKSMA_BOUND_JUMP], jump, KOKSMA_BOUND_ONE_SIGMA);
    check(t[KOKSMA_BOUND_RMS], rms, KOKSMA_BOUND_ESTIMATE);
    check(t[KOKSMA_BOUND_REACH], 3.0 * rms, KOKSMA_BOUND_ESTIMATE);
    check(t[KOKSMA_BOUND_RANDOM], 0.5 / 64.0, KOKSMA_BOUND_ONE_SIGMA);

    f.smooth = 8.0; /* a mean square in place of a bound */
    terms(t, &f, 4096.0, 0.01, 3.0);
    check(t[KOKSMA_BOUND_SMOOTH], 8.0 / 4096.0, KOKSMA_BOUND_ONE_SIGMA);
    check(t[KOKSMA_BOUND_RMS], hypot(jump, 8.0 / 4096.0), KOKSMA_BOUND_ONE_SIGMA);
    check(t[KOKSMA_BOUND_PAPER], 0.02 + sqrt(2.0) * 0.5 / 256.0,
          KOKSMA_BOUND_ONE_SIGMA);
}
END_TEST

/* Few points are not worse than random ones. */
/* V D* as it is, or a double above: of 53 bits each, the product has 106, and fma
 * says on which side of it the bound is. */
START_TEST(the_proved_one_is_not_below)
{
    oracle_rng rng = oracle_rng_start(oracle_seed(), 0);
    size_t exact = 0;

    for (size_t i = 0; i < 1000; i++) {
        koksma_bound_facts f = known();
        koksma_bound_term t[KOKSMA_BOUND_TERMS];
        double star = oracle_dyadic(&rng, i % 4 == 0 ? 8 : 53) / 2 + 0x1p-10, low;

        f.vhk = 1.0 + oracle_dyadic(&rng, i % 4 == 0 ? 8 : 53);
        terms(t, &f, 4096.0, star, 3.0);
        low = nextafter(t[KOKSMA_BOUND_HLAWKA].value, 0.0);
        ck_assert(fma(f.vhk, star, -t[KOKSMA_BOUND_HLAWKA].value) <= 0.0);
        ck_assert(fma(f.vhk, star, -low) > 0.0);
        exact += fma(f.vhk, star, -t[KOKSMA_BOUND_HLAWKA].value) == 0.0;
    }
    ck_assert_uint_ge(exact, 250);
}
END_TEST

START_TEST(clamped_by_random_points)
{
    koksma_bound_facts f = known();
    koksma_bound_term t[KOKSMA_BOUND_TERMS];

    f.area = 1e6;
    terms(t, &f, 4096.0, 0.01, 3.0);
    check(t[KOKSMA_BOUND_JUMP], 0.5 / 64.0, KOKSMA_BOUND_ONE_SIGMA);
    f.sigma = (double)NAN;
    terms(t, &f, 4096.0, 0.01, 3.0);
    check(t[KOKSMA_BOUND_JUMP], sqrt(1e6 / 6.0) * 0.25 / pow(4096.0, 0.75),
          KOKSMA_BOUND_ONE_SIGMA);
    check(t[KOKSMA_BOUND_RANDOM], (double)NAN, KOKSMA_BOUND_UNKNOWN);
}
END_TEST

/* Proved is only what a closed form and D* prove. */
START_TEST(what_is_proved)
{
    koksma_bound_facts f = known();
    koksma_bound_term t[KOKSMA_BOUND_TERMS];

    f.vhk = (double)INFINITY;
    terms(t, &f, 64.0, (double)NAN, 2.0);
    check(t[KOKSMA_BOUND_HLAWKA], (double)INFINITY, KOKSMA_BOUND_PROVED);
    check(t[KOKSMA_BOUND_SMOOTH], (double)NAN, KOKSMA_BOUND_UNKNOWN);
    check(t[KOKSMA_BOUND_PAPER], (double)NAN, KOKSMA_BOUND_UNKNOWN);
    check(t[KOKSMA_BOUND_RMS], (double)NAN, KOKSMA_BOUND_UNKNOWN);
    check(t[KOKSMA_BOUND_REACH], (double)NAN, KOKSMA_BOUND_UNKNOWN);
    f.smooth_vhk = 0.0; /* whatever D* is */
    terms(t, &f, 64.0, (double)NAN, 2.0);
    check(t[KOKSMA_BOUND_SMOOTH], 0.0, KOKSMA_BOUND_PROVED);
    ck_assert_int_eq(t[KOKSMA_BOUND_RMS].kind, KOKSMA_BOUND_ONE_SIGMA);
    ck_assert(t[KOKSMA_BOUND_RMS].value == t[KOKSMA_BOUND_JUMP].value);
    check(t[KOKSMA_BOUND_PAPER], sqrt(2.0) * 0.5 / 16.0, KOKSMA_BOUND_ONE_SIGMA);
    f.vhk_from = KOKSMA_VHK_GRID;
    f.vhk = 5.0;
    terms(t, &f, 64.0, 0.1, 2.0);
    check(t[KOKSMA_BOUND_HLAWKA], 0.5, KOKSMA_BOUND_ESTIMATE);
    f.vhk_from = KOKSMA_VHK_GROWS;
    terms(t, &f, 64.0, 0.1, 2.0);
    check(t[KOKSMA_BOUND_HLAWKA], (double)NAN, KOKSMA_BOUND_DIVERGING);
    f = koksma_bound_no_facts(2);
    terms(t, &f, 64.0, 0.1, 2.0);
    for (int i = 0; i < KOKSMA_BOUND_TERMS; i++)
        check(t[i], (double)NAN, KOKSMA_BOUND_UNKNOWN);
}
END_TEST

/* All normals alike: |n|_1 is 4/pi on the circle, 3/2 on the sphere, 16/(3 pi) in
 * four dimensions; so a ball's area follows from its extent. */
START_TEST(area_from_the_extent)
{
    static const double mean[] = {1.0, 4.0 / 3.14159265358979323846, 1.5,
                                  16.0 / 3.0 / 3.14159265358979323846};

    for (size_t dim = 1; dim <= 4; dim++) {
        koksma_bound_facts f = known();
        koksma_bound_term t[KOKSMA_BOUND_TERMS];

        f.dim = dim;
        f.axes = f.area = (double)NAN;
        f.extent = 6.0 * mean[dim - 1];
        terms(t, &f, 1024.0, 0.1, 2.0);
        check(t[KOKSMA_BOUND_JUMP],
              0.25 * pow(1024.0, -((double)dim + 1.0) / 2.0 / (double)dim),
              KOKSMA_BOUND_ESTIMATE);
    }
}
END_TEST

START_TEST(turns)
{
    koksma_bound_facts f = known();
    koksma_bound_turns t;
    koksma_bound_term at[KOKSMA_BOUND_TERMS];

    f.smooth = 3.0;
    t = koksma_bound_turning(&f);
    ck_assert_double_eq_tol(t.saturation, 4.0, 1e-14);
    ck_assert_double_eq_tol(t.even, koksma_fit_break_even(2, 1.5, 0.25, 0.5),
                            1e-14);
    terms(at, &f, t.cross, 0.1, 2.0);
    ck_assert_double_eq_tol(at[KOKSMA_BOUND_JUMP].value,
                            at[KOKSMA_BOUND_SMOOTH].value, 1e-12);
    f.jump = 0.0;
    t = koksma_bound_turning(&f);
    ck_assert(isnan(t.saturation) && isnan(t.even) && isnan(t.cross));
    f = known();
    f.axes = 1.0;
    f.smooth = 3.0;
    ck_assert(isnan(koksma_bound_turning(&f).cross));
}
END_TEST

START_TEST(whether_it_pays)
{
    koksma_bound_facts f = known();

    f.jump_rms = 2.0;
    f.extent = 10.0; /* saturation 100, even 16 */
    ck_assert_int_eq(koksma_bound_pays(&f, 99.0), KOKSMA_PAY_SATURATED);
    ck_assert_int_eq(koksma_bound_pays(&f, 101.0), KOKSMA_PAY_JUMP);
    f.extent = 2.0;
    ck_assert_int_eq(koksma_bound_pays(&f, 15.0), KOKSMA_PAY_NOT_YET);
    ck_assert_int_eq(koksma_bound_pays(&f, 17.0), KOKSMA_PAY_JUMP);
    f.sigma = (double)NAN;
    ck_assert_int_eq(koksma_bound_pays(&f, 17.0), KOKSMA_PAY_UNKNOWN);
    f.jump = 0.0;
    ck_assert_int_eq(koksma_bound_pays(&f, 17.0), KOKSMA_PAY_SMOOTH);
    f.vhk_from = KOKSMA_VHK_GRID;
    ck_assert_int_eq(koksma_bound_pays(&f, 17.0), KOKSMA_PAY_UNKNOWN);
    f.vhk_from = KOKSMA_VHK_CLOSED;
    f.vhk = (double)INFINITY;
    ck_assert_int_eq(koksma_bound_pays(&f, 17.0), KOKSMA_PAY_UNKNOWN);
}
END_TEST

START_TEST(refusals)
{
    koksma_bound_facts f = known();
    koksma_bound_term t[KOKSMA_BOUND_TERMS];
    koksma_error err;

    ck_assert_int_eq(koksma_bound(t, &f, 0.5, 0.1, 2.0, &err), KOKSMA_EINVAL);
    ck_assert_str_eq(err.text, "N is 0.5, below 1");
    ck_assert_int_eq(koksma_bound(t, &f, 4.0, -0.1, 2.0, &err), KOKSMA_EINVAL);
    ck_assert_str_eq(err.text, "D* is -0.1, below 0");
    ck_assert_int_eq(koksma_bound(t, &f, 4.0, 0.1, (double)NAN, &err),
                     KOKSMA_EINVAL);
    f.area = -1.0;
    ck_assert_int_eq(koksma_bound(t, &f, 4.0, 0.1, 2.0, &err), KOKSMA_EINVAL);
    ck_assert_str_eq(err.text, "the area is -1, below 0");
    f = known();
    f.axes = 4.0;
    ck_assert_int_eq(koksma_bound(t, &f, 4.0, 0.1, 2.0, &err), KOKSMA_EINVAL);
    ck_assert_str_eq(err.text, "the surface depends on 4 axes, and there are 3");
    f.axes = 0.5;
    ck_assert_int_eq(koksma_bound(t, &f, 4.0, 0.1, 2.0, &err), KOKSMA_EINVAL);
    f = koksma_bound_no_facts(0);
    ck_assert_int_eq(koksma_bound(t, &f, 4.0, 0.1, 2.0, &err), KOKSMA_EINVAL);
}
END_TEST

/* ---- Errors of points that are made ------------------------------------------ */

enum { PATHS = 64, LARGEST = 1 << 14, STEPS = 17, DIM_MOST = 6 };

/* [n x > t] with all n_j > 0: the share of the cube and the density of n x at t are
 * alternating sums of powers [Barrow, Smith 1979]. */
typedef struct plane {
    double normal[DIM_MOST], t;
} plane;

static double beyond(const koksma_integrand *f, const double *x)
{
    const plane *p = f->state;
    double s = 0.0;

    for (size_t j = 0; j < f->dim; j++)
        s += p->normal[j] * x[j];
    return s > p->t;
}

static double power_sum(const plane *p, size_t dim, size_t power)
{
    double sum = 0.0, scale = 1.0;

    for (size_t j = 0; j < dim; j++)
        scale *= p->normal[j];
    for (size_t j = 2; j <= power; j++)
        scale *= (double)j;
    for (unsigned v = 0; v < 1u << dim; v++) {
        double s = p->t;

        for (size_t j = 0; j < dim; j++)
            s -= v >> j & 1 ? p->normal[j] : 0.0;
        if (s > 0.0)
            sum += (__builtin_popcount(v) % 2 ? -1.0 : 1.0) * pow(s, (double)power);
    }
    return sum / scale;
}

static int by_size(const void *a, const void *b)
{
    double u = *(const double *)a, v = *(const double *)b;

    return (u > v) - (u < v);
}

/* The median over N of root mean square error / jump term, and the share of errors
 * that are more than three of those. */
static double median_ratio(const koksma_integrand *f, double exact,
                           const koksma_bound_facts *facts, double *far)
{
    static double x[LARGEST * DIM_MOST];
    double square[STEPS] = {0.0}, ratio[STEPS], predicted[STEPS];
    size_t n[STEPS], above = 0;

    for (int i = 0; i < STEPS; i++) {
        koksma_bound_term t[KOKSMA_BOUND_TERMS];

        n[i] = (size_t)rint(exp2(6.0 + i / 2.0));
        terms(t, facts, (double)n[i], (double)NAN, 2.0);
        predicted[i] = t[KOKSMA_BOUND_RMS].value;
    }
    for (uint64_t r = 0; r < PATHS; r++) {
        koksma_gen_opts o = {.dim = f->dim,
                             .n = LARGEST,
                             .scramble = KOKSMA_SCRAMBLE_DIGITS,
                             .seed = 1,
                             .replicate = r};
        koksma_gen *g;
        double sum = 0.0;
        size_t done = 0;

        ck_assert_int_eq(koksma_gen_open(&g, koksma_gen_find("halton"), &o, NULL),
                         KOKSMA_OK);
        ck_assert_int_eq(koksma_gen_fill(g, x, 0, LARGEST, NULL), KOKSMA_OK);
        koksma_gen_close(g);
        for (int i = 0; i < STEPS; i++) {
            double error;

            for (; done < n[i]; done++)
                sum += f->value(f, x + done * f->dim) - exact;
            error = sum / (double)done;
            square[i] += error * error;
            above += fabs(error) > 3.0 * predicted[i];
        }
    }
    for (int i = 0; i < STEPS; i++)
        ratio[i] = sqrt(square[i] / PATHS) / predicted[i];
    qsort(ratio, STEPS, sizeof *ratio, by_size);
    *far = (double)above / PATHS / STEPS;
    return ratio[STEPS / 2];
}

static void check_ratio(const char *what, const koksma_integrand *f, double exact,
                        const koksma_bound_facts *facts)
{
    double far, ratio = median_ratio(f, exact, facts, &far);

    ck_assert_msg(ratio >= 0.65 && ratio <= 1.25 && far <= 0.02,
                  "%s dim %zu: ratio %g, %g beyond", what, f->dim, ratio, far);
}

static koksma_bound_facts indicator(size_t dim, double share, double area)
{
    koksma_bound_facts f = koksma_bound_no_facts(dim);

    f.smooth_vhk = 0.0;
    f.jump = 1.0;
    f.area = area;
    f.sigma = sqrt(share * (1.0 - share));
    return f;
}

START_TEST(errors_across_planes)
{
    for (size_t dim = 2; dim <= DIM_MOST; dim++)
        for (uint64_t round = 0; round < 4; round++) {
            oracle_rng rng = oracle_rng_start(1, round);
            koksma_integrand f = {.dim = dim, .value = beyond};
            double length = 0.0, share;
            koksma_bound_facts facts;
            plane p = {.t = 0.0};

            for (size_t j = 0; j < dim; j++) {
                p.normal[j] = 0.25 + 0.75 * oracle_dyadic(&rng, 53);
                p.t += p.normal[j] * (0.4 + 0.2 * oracle_dyadic(&rng, 53));
                length += p.normal[j] * p.normal[j];
            }
            f.state = &p;
            share = 1.0 - power_sum(&p, dim, dim);
            facts =
                indicator(dim, share, sqrt(length) * power_sum(&p, dim, dim - 1));
            check_ratio("plane", &f, share, &facts);
        }
}
END_TEST

START_TEST(errors_across_balls)
{
    for (size_t dim = 2; dim <= DIM_MOST; dim++)
        for (double r = 0.3; r <= 0.5; r += 0.1) {
            koksma_facts k;
            koksma_integrand f = fixture_make(&k, "ball", dim, &r);
            koksma_bound_facts facts = indicator(dim, k.integral, k.area);

            check_ratio("ball", &f, k.integral, &facts);
        }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("bound");
    TCase *c = tcase_create("bound"), *big = tcase_create("big");

    tcase_add_test(c, every_term);
    tcase_add_test(c, the_proved_one_is_not_below);
    tcase_add_test(c, clamped_by_random_points);
    tcase_add_test(c, what_is_proved);
    tcase_add_test(c, area_from_the_extent);
    tcase_add_test(c, turns);
    tcase_add_test(c, whether_it_pays);
    tcase_add_test(c, refusals);
    suite_add_tcase(suite, c);
    tcase_set_tags(big, "big");
    tcase_set_timeout(big, 300.0);
    tcase_add_test(big, errors_across_planes);
    tcase_add_test(big, errors_across_balls);
    suite_add_tcase(suite, big);
    return oracle_run(suite);
}
