/* What the table says of integrands, by other routes: quadrature of the values,
 * counts of exact integers, closed forms in more digits, crossings of lines, and
 * sums over grids. */
#include <complex.h>
#include <stdlib.h>
#include <string.h>

#include "integrand_fixture.h"
#include "oracle.h"

/* ---- Integral and variance by nested quadrature ------------------------------ */

enum { NODES = 12, BREAKS_MOST = 16 };

/* Gauss and Legendre's rule on [-1,1]: exact up to degree 23. */
static double node[NODES], weight[NODES];

static void find_nodes(void)
{
    for (int i = 0; i < NODES; i++) {
        double x = cos(acos(-1.0) * (i + 0.75) / (NODES + 0.5)), slope = 0.0;

        for (int round = 0; round < 50; round++) {
            double p = 1.0, before = 0.0;

            for (int n = 1; n <= NODES; n++) {
                double next = ((2 * n - 1) * x * p - (n - 1) * before) / n;

                before = p;
                p = next;
            }
            slope = NODES * (x * p - before) / (x * x - 1.0);
            x -= p / slope;
        }
        node[i] = x;
        weight[i] = 2.0 / ((1.0 - x * x) * slope * slope);
    }
}

/* Where f is not smooth along axis k, the coordinates before being given. */
typedef size_t find_breaks(const koksma_integrand *f, double *at, const double *x,
                           size_t k);

/* The sums bend where what is left can no longer reach the threshold. */
static double threshold;

static size_t breaks_of_sum(const koksma_integrand *f, double *at, const double *x,
                            size_t k)
{
    double rest = threshold;

    for (size_t j = 0; j < k; j++)
        rest -= x[j];
    for (size_t j = 0; j < f->dim - k; j++)
        at[j] = rest - (double)j;
    return f->dim - k;
}

/* At the last parameter, with quarters and peaks besides. */
static size_t breaks_of_peak(const koksma_integrand *f, double *at, const double *x,
                             size_t k)
{
    const double fixed[] = {0.25, 0.5, 0.75};

    (void)x;
    (void)k;
    memcpy(at, fixed, sizeof fixed);
    at[3] = f->param[1];
    at[4] = f->param[1] - 0.1;
    at[5] = f->param[1] + 0.1;
    at[6] = f->param[0];
    return 7;
}

static int by_size(const void *a, const void *b)
{
    double u = *(const double *)a, v = *(const double *)b;

    return (u > v) - (u < v);
}

/* The means of f and f^2 over axes k, ..., dim - 1. */
static void integrate(const koksma_integrand *f, find_breaks *breaks, double *x,
                      size_t k, double mean[2])
{
    double at[BREAKS_MOST + 2] = {0.0}, from = 0.0;
    size_t count = breaks(f, at, x, k);

    mean[0] = mean[1] = 0.0;
    at[count++] = 1.0;
    qsort(at, count, sizeof *at, by_size);
    for (size_t j = 0; j < count && from < 1.0; j++) {
        double to = fmin(at[j], 1.0);

        if (to <= from) continue;
        for (int i = 0; i < NODES; i++) {
            double inner[2], share = 0.5 * (to - from) * weight[i];

            x[k] = 0.5 * ((to - from) * node[i] + (to + from));
            if (k + 1 == f->dim) {
                inner[0] = f->value(f, x);
                inner[1] = inner[0] * inner[0];
            } else
                integrate(f, breaks, x, k + 1, inner);
            mean[0] += share * inner[0];
            mean[1] += share * inner[1];
        }
        from = to;
    }
}

static void check_moments(const char *name, size_t dim, const double *param,
                          find_breaks *breaks)
{
    koksma_facts k;
    koksma_integrand f = fixture_make(&k, name, dim, param);
    double x[8], mean[2], scale;

    integrate(&f, breaks, x, 0, mean);
    scale = sqrt(mean[1]);
    ck_assert_msg(fabs(mean[0] - k.integral) <= k.error + 1e-12 * scale,
                  "%s dim %zu: %.17g, not %.17g", name, dim, k.integral, mean[0]);
    ck_assert_msg(fabs(mean[1] - mean[0] * mean[0] - k.variance) <= 1e-11 * mean[1],
                  "%s dim %zu: variance %.17g, not %.17g", name, dim, k.variance,
                  mean[1] - mean[0] * mean[0]);
    ck_assert(k.error <= 1e-12 * scale);
}

START_TEST(moments_of_sums)
{
    for (size_t dim = 2; dim <= 4; dim++) {
        double n = (double)dim;

        for (int i = 0; i <= 8; i += dim == 4 ? 4 : 1) {
            double a = i / 8.0;

            threshold = a * n;
            check_moments("halfspace", dim, &a, breaks_of_sum);
            threshold = n / 2.0;
            check_moments("mixture", dim, &a, breaks_of_sum);
        }
        threshold = 1.0;
        check_moments("simplex", dim, NULL, breaks_of_sum);
        check_moments("sum", dim, NULL, breaks_of_sum);
        for (int i = 0; i <= 4 && dim < 4; i++) {
            double a = i / (dim == 2 ? 8.0 : 12.0);

            check_moments(dim == 2 ? "f2" : "f3", dim, &a, breaks_of_sum);
        }
    }
}
END_TEST

START_TEST(moments_of_products)
{
    static const char *const names[] = {"product-peak", "gaussian",
                                        "continuous",   "discontinuous",
                                        "oscillatory",  "corner-peak"};
    static const double params[][2] = {
        {5.0, 0.3}, {1.0, 0.0}, {3.0, 1.0}, {0.125, 0.7}, {2.0, 0.5}};
    double c = 0.7, none = 0.0, all = 1.0;

    for (size_t dim = 1; dim <= 2; dim++) {
        for (size_t i = 0; i < 6; i++)
            for (size_t j = 0; j < 5; j++)
                check_moments(names[i], dim, params[j], breaks_of_peak);
        check_moments("product", dim, NULL, breaks_of_peak);
        check_moments("box", dim, &c, breaks_of_peak);
        check_moments("box", dim, &none, breaks_of_peak);
        check_moments("box", dim, &all, breaks_of_peak);
    }
    for (size_t i = 0; i < 6; i++)
        check_moments(names[i], 3, NULL, breaks_of_peak);
}
END_TEST

/* ---- Errors by exact integers and long doubles ------------------------------- */

static void check_error(const koksma_facts *k, const char *name, size_t dim,
                        long double exact)
{
    long double off = fabsl((long double)k->integral - exact);

    ck_assert_msg(off <= (long double)k->error + 1e-18L * fabsl(exact),
                  "%s dim %zu is off by %Lg, more than %g", name, dim, off,
                  k->error);
}

/* dim! P(s > t) counts in integers for whole t [Laplace's formula]. */
START_TEST(halfspaces_in_integers)
{
    for (size_t dim = 2; dim <= 20; dim++)
        for (size_t t = 1; t < dim; t++) {
            double c = (double)t / (double)dim;
            oracle_int below = 0, choose = 1, factorial = 1;
            koksma_facts k;

            for (size_t j = 0; j < t; j++) {
                oracle_int power = j % 2 == 0 ? 1 : -1;

                for (size_t i = 0; i < dim; i++)
                    power *= (oracle_int)(t - j);
                below += choose * power;
                choose = choose * (oracle_int)(dim - j) / (oracle_int)(j + 1);
            }
            for (size_t j = 2; j <= dim; j++)
                factorial *= (oracle_int)j;
            if (c * (double)dim != (double)t) continue;
            fixture_make(&k, "halfspace", dim, &c);
            check_error(&k, "halfspace", dim,
                        (long double)(factorial - below) / (long double)factorial);
        }
}
END_TEST

/* The closed forms once more, in long doubles, for random parameters. */
START_TEST(errors_of_closed_forms)
{
    long double pi = acosl(-1.0L);

    if (!oracle_long_doubles()) return;
    for (uint64_t round = 0; round < 500 * oracle_scale(); round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        double p[2] = {
            ldexp(1.0 + oracle_dyadic(&rng, 53), (int)oracle_below(&rng, 9) - 6),
            oracle_dyadic(&rng, 53)};
        size_t dim = 2 + oracle_below(&rng, 9);
        long double c = (long double)p[0], w = (long double)p[1], corner = 1.0L;
        long double n = (long double)dim, factor = 1.0L;
        long double complex wave = cexpl(2.0iL * pi * w);
        double r = 0.5 * oracle_dyadic(&rng, 53) + 0x1p-20;
        koksma_facts k;

        for (size_t j = 1; j <= dim; j++) {
            corner /= 1.0L + c * (long double)j;
            wave *= (cexpl(1.0iL * c) - 1.0L) / (1.0iL * c);
            factor *= (long double)j;
        }
        fixture_make(&k, "product-peak", dim, p);
        check_error(&k, "product-peak", dim,
                    powl(c * (atanl(c * w) + atanl(c * (1.0L - w))), n));
        fixture_make(&k, "gaussian", dim, p);
        check_error(
            &k, "gaussian", dim,
            powl(sqrtl(pi) / (2.0L * c) * (erfl(c * w) + erfl(c * (1.0L - w))), n));
        fixture_make(&k, "continuous", dim, p);
        check_error(&k, "continuous", dim,
                    powl(-(expm1l(-c * w) + expm1l(-c * (1.0L - w))) / c, n));
        fixture_make(&k, "corner-peak", dim, p);
        check_error(&k, "corner-peak", dim, corner);
        fixture_make(&k, "oscillatory", dim, p);
        check_error(&k, "oscillatory", dim, creall(wave));
        fixture_make(&k, "box", dim, p + 1);
        check_error(&k, "box", dim, powl(w, n));
        fixture_make(&k, "simplex", dim, NULL);
        check_error(&k, "simplex", dim, 1.0L / factor);
        fixture_make(&k, "ball", dim, &r);
        check_error(&k, "ball", dim,
                    powl(sqrtl(pi) * (long double)r, n) / tgammal(n / 2.0L + 1.0L));
        if (p[0] > 8.0) continue;
        fixture_make(&k, "discontinuous", dim, p);
        check_error(&k, "discontinuous", dim,
                    powl(expm1l(c * w) / c, 2.0L) * powl(expm1l(c) / c, n - 2.0L));
    }
}
END_TEST

/* ---- Area, extent and jumps -------------------------------------------------- */

/* Areas are derivatives: of a ball's volume by r, and of a half-space's by c, which
 * moves its face sqrt(dim) times as far. */
START_TEST(areas_are_derivatives)
{
    for (size_t dim = 2; dim <= 6; dim++)
        for (int i = 1; i < 8; i++) {
            double h = 1e-4, n = (double)dim, scale[] = {1.0, 1.0, sqrt(n)};
            const char *const names[] = {"ball", "box", "halfspace"};

            for (int j = 0; j < 3; j++) {
                double mid = j == 0 ? 0.06 * i : 0.121 * i;
                double low = mid - h, high = mid + h;
                koksma_facts a, b, k;

                fixture_make(&a, names[j], dim, &low);
                fixture_make(&b, names[j], dim, &high);
                fixture_make(&k, names[j], dim, &mid);
                ck_assert_double_eq_tol(
                    k.area, fabs(b.integral - a.integral) / (2.0 * h) / scale[j],
                    2e-6);
            }
        }
}
END_TEST

/* Surfaces that are the same have the same area. */
START_TEST(areas_are_shared)
{
    double half = 0.5;
    koksma_facts k, same;

    for (size_t dim = 2; dim <= 8; dim++) {
        double c = 1.0 / (double)dim;

        fixture_make(&k, "simplex", dim, NULL);
        fixture_make(&same, "halfspace", dim, &c);
        ck_assert_double_eq_tol(k.area, same.area, 1e-12);
        ck_assert_double_eq_tol(k.extent, same.extent, 1e-12);
        ck_assert_double_eq_tol(k.integral + same.integral, 1.0, 1e-14);
        fixture_make(&k, "mixture", dim, &half);
        fixture_make(&same, "halfspace", dim, &half);
        ck_assert(k.area == same.area && k.extent == same.extent);
    }
}
END_TEST

/* What lines parallel to an axis meet. */
typedef struct crossings {
    double extent;
    double squares; /* of the jumps, mean over the crossings */
    double largest;
} crossings;

/* Bisect the change of piece between x[k] = a and b; returns the jump. */
static double jump_between(const koksma_integrand *f, double *x, size_t k, double a,
                           double b)
{
    size_t at_a, at_mid;
    double low, high;

    x[k] = b;
    high = f->value(f, x);
    x[k] = a;
    low = fixture_value(f, &at_a, x);
    for (int i = 0; i < 50; i++) {
        double mid = 0.5 * (a + b), v;

        x[k] = mid;
        v = fixture_value(f, &at_mid, x);
        if (at_mid == at_a) {
            a = mid;
            low = v;
        } else {
            b = mid;
            high = v;
        }
    }
    return fabs(high - low);
}

/* m lines to the axis through cell centres, in 37 steps each. */
static crossings cross(const koksma_integrand *f, size_t m)
{
    crossings out = {0.0, 0.0, 0.0};
    double count = 0.0, lines = pow((double)m, (double)f->dim - 1.0);

    for (size_t k = 0; k < f->dim; k++)
        for (size_t line = 0; (double)line < lines; line++) {
            double x[8];
            size_t c = line, before, after;

            for (size_t j = 0; j < f->dim; j++)
                if (j != k) {
                    x[j] = ((double)(c % m) + 0.5) / (double)m;
                    c /= m;
                }
            x[k] = 0.0;
            fixture_value(f, &before, x);
            for (int i = 1; i <= 37; i++, before = after) {
                double jump;

                x[k] = i / 37.0;
                fixture_value(f, &after, x);
                if (after == before) continue;
                jump = jump_between(f, x, k, (i - 1) / 37.0, i / 37.0);
                out.squares += jump * jump;
                out.largest = fmax(out.largest, jump);
                count += 1.0;
            }
        }
    out.extent = count / lines;
    if (count > 0.0) out.squares /= count;
    return out;
}

static void check_crossings(const char *name, size_t dim, const double *param)
{
    koksma_facts k;
    koksma_integrand f = fixture_make(&k, name, dim, param);
    size_t m = dim == 2 ? 701 : 83;
    crossings c = cross(&f, m);

    ck_assert_msg(fabs(c.extent - k.extent) <= (dim == 2 ? 0.01 : 0.04) * k.extent,
                  "%s dim %zu: extent %g, not %g", name, dim, k.extent, c.extent);
    ck_assert_double_eq_tol(sqrt(c.squares), k.jump_rms, 0.01 * k.jump);
    ck_assert_double_le(c.largest, k.jump * (1.0 + 1e-12));
    ck_assert_double_ge(c.largest, k.jump * 0.95);
    ck_assert(k.area <= k.extent * (1.0 + 1e-15));
    ck_assert(k.extent <= sqrt((double)dim) * k.area * (1.0 + 1e-15));
}

START_TEST(extents_and_jumps)
{
    for (size_t dim = 2; dim <= 3; dim++) {
        double a = 0.2, c = 0.4, w[] = {1.5, 0.6};

        check_crossings(dim == 2 ? "f2" : "f3", dim, &a);
        check_crossings("halfspace", dim, &c);
        check_crossings("simplex", dim, NULL);
        check_crossings("mixture", dim, &a);
        check_crossings("box", dim, &c);
        check_crossings("ball", dim, &c);
        check_crossings("discontinuous", dim, w);
    }
}
END_TEST

/* Smooth ones say so, and neither does their piece change. */
START_TEST(no_jumps)
{
    static const char *const names[] = {
        "sum",         "product",  "oscillatory", "product-peak",
        "corner-peak", "gaussian", "continuous"};
    for (size_t i = 0; i < 7; i++) {
        koksma_facts k;
        koksma_integrand f = fixture_make(&k, names[i], 2, NULL);

        ck_assert(cross(&f, 101).extent == 0.0 && k.pieces == 1.0);
        ck_assert(k.jump == 0.0 && k.jump_rms == 0.0 && k.area == 0.0);
        ck_assert(k.extent == 0.0 && k.axes == 0.0 && isnan(k.box_dim));
    }
}
END_TEST

/* ---- Variation --------------------------------------------------------------- */

static void check_variation(const char *name, size_t dim, const double *param,
                            size_t k)
{
    koksma_facts facts;
    koksma_integrand f = fixture_make(&facts, name, dim, param);
    double grid = fixture_variation(&f, k);

    ck_assert_msg(fabs(grid - facts.variation) <= 1e-12 * (1.0 + grid),
                  "%s dim %zu: %.17g, not %.17g", name, dim, facts.variation, grid);
}

/* A grid that has the peaks and jumps among its lines sees all of the variation. */
START_TEST(variations_on_grids)
{
    static const char *const peaks[] = {"product-peak", "gaussian", "continuous",
                                        "discontinuous"};
    static const double params[][2] = {
        {5.0, 0.25}, {2.0, 0.0}, {3.0, 1.0}, {1.0, 0.75}};

    for (size_t dim = 1; dim <= 3; dim++) {
        for (size_t i = 0; i < 4; i++) {
            for (size_t j = 0; j < 4; j++)
                check_variation(peaks[i], dim, params[j], 8);
            check_variation("corner-peak", dim, params[i], 3);
            check_variation("box", dim, &params[i][1], 4);
        }
        check_variation("sum", dim, NULL, 5);
        check_variation("product", dim, NULL, 5);
    }
}
END_TEST

START_TEST(variations_of_the_smooth_ends)
{
    double half = 0.5, third = 1.0 / 3.0, one = 1.0;

    check_variation("f2", 2, &half, 16);
    check_variation("f3", 3, &third, 8);
    for (size_t dim = 2; dim <= 3; dim++)
        check_variation("mixture", dim, &one, 8);
}
END_TEST

/* Where it is infinite, each halving of the cells doubles it, or nearly so. */
START_TEST(variations_that_diverge)
{
    static const char *const names[] = {"f2",   "halfspace", "simplex", "mixture",
                                        "ball", "koch",      "fractal2"};

    for (size_t i = 0; i < 7; i++) {
        koksma_facts facts;
        koksma_integrand f = fixture_make(&facts, names[i], 2, NULL);

        ck_assert(facts.variation == HUGE_VAL);
        ck_assert_double_ge(fixture_variation(&f, 250),
                            1.8 * fixture_variation(&f, 125));
    }
    for (int i = 0; i < 4; i++) { /* counted by hand */
        double a = i / 8.0, want = 31.0 * (1.0 - 2.0 * a) + 2.0 * (1.0 - a);
        koksma_integrand f = fixture_make(NULL, "f2", 2, &a);

        ck_assert_double_eq_tol(fixture_variation(&f, 16), want, 1e-12);
    }
}
END_TEST

START_TEST(unknown_is_nan)
{
    koksma_facts k;
    double few[] = {5.0, 1.0};

    fixture_make(&k, "oscillatory", 2, NULL);
    ck_assert(isnan(k.variation));
    fixture_make(&k, "fractal2", 2, few);
    ck_assert(isnan(k.variation) && isnan(k.area) && isnan(k.axes) &&
              k.box_dim == 1.0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("facts");
    TCase *tc = tcase_create("moments");

    find_nodes();
    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 30.0 * (double)oracle_scale());
    tcase_add_test(tc, moments_of_sums);
    tcase_add_test(tc, moments_of_products);
    tcase_add_test(tc, halfspaces_in_integers);
    tcase_add_test(tc, errors_of_closed_forms);

    tc = tcase_create("discontinuities");
    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 30.0);
    tcase_add_test(tc, areas_are_derivatives);
    tcase_add_test(tc, areas_are_shared);
    tcase_add_test(tc, extents_and_jumps);
    tcase_add_test(tc, no_jumps);

    tc = tcase_create("variation");
    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 30.0);
    tcase_add_test(tc, variations_on_grids);
    tcase_add_test(tc, variations_of_the_smooth_ends);
    tcase_add_test(tc, variations_that_diverge);
    tcase_add_test(tc, unknown_is_nan);
    return oracle_run(suite);
}
