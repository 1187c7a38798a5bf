/* The scene by the geometry that its header states, in ways that share nothing with
 * the walk: chords traced to the sphere, angles, sums of single bounces, turned
 * lights, and means over many points against the closed form. */
#include <stdlib.h>
#include <string.h>

#include "integrand_fixture.h"
#include "oracle.h"
#include "scene_kernels.h"

static const ki_walk START = {{0.0, 0.0, -1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* How far the walk's point and directions are from orthonormal. */
static double skew(const ki_walk *w)
{
    const double off[] = {
        dot(w->at, w->at) - 1.0,       dot(w->ahead, w->ahead) - 1.0,
        dot(w->aside, w->aside) - 1.0, dot(w->at, w->ahead),
        dot(w->at, w->aside),          dot(w->ahead, w->aside)};
    double most = 0.0;

    for (int i = 0; i < 6; i++)
        most = fmax(most, fabs(off[i]));
    return most;
}

/* ---- Steps ------------------------------------------------------------------- */

START_TEST(turns)
{
    for (int i = 0; i <= 100000; i++) {
        double v = i / 100000.0, c, s;

        ki_turn(&c, &s, v);
        ck_assert_double_eq_tol(c, cos(8.0 * atan(1.0) * v), 0x1p-48);
        ck_assert_double_eq_tol(s, sin(8.0 * atan(1.0) * v), 0x1p-48);
    }
}
END_TEST

/* The ray of the cosine sqrt(u) and the azimuth 2 pi v, from the frame, meets the
 * sphere where the step ends. */
START_TEST(steps_are_chords)
{
    ki_walk w = START;

    for (uint64_t round = 0; round < 20000; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        double u = oracle_dyadic(&rng, 53), v = oracle_dyadic(&rng, 53);
        double angle = 8.0 * atan(1.0) * v, ray[3], length;
        ki_walk before = w;

        for (int i = 0; i < 3; i++)
            ray[i] = -sqrt(u) * w.at[i] + sqrt(1.0 - u) * (cos(angle) * w.ahead[i] +
                                                           sin(angle) * w.aside[i]);
        length = -2.0 * dot(ray, w.at); /* |at + length ray| = 1 */
        ki_walk_step(&w, u, v);
        for (int i = 0; i < 3; i++)
            ck_assert_double_eq_tol(w.at[i], before.at[i] + length * ray[i], 1e-13);
        if (round % 100 == 99) w = START;
    }
}
END_TEST

/* Where a step ends, ahead is along the great circle that it took, and aside is on
 * the same hand as ever. */
START_TEST(frames_are_transported)
{
    for (uint64_t round = 0; round < 5000; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        double u = 0.01 + 0.98 * oracle_dyadic(&rng, 53), cosine, hand = 0.0;
        ki_walk w = START, before;

        ki_walk_step(&w, oracle_dyadic(&rng, 53), oracle_dyadic(&rng, 53));
        before = w;
        ki_walk_step(&w, u, oracle_dyadic(&rng, 53));
        cosine = dot(before.at, w.at);
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3, k = (i + 2) % 3;
            double way =
                (cosine * w.at[i] - before.at[i]) / sqrt(1.0 - cosine * cosine);

            ck_assert_double_eq_tol(w.ahead[i], way, 1e-12);
            hand += w.at[i] * (w.ahead[j] * w.aside[k] - w.ahead[k] * w.aside[j]);
        }
        ck_assert_double_eq_tol(hand, -1.0, 1e-14);
    }
}
END_TEST

/* After the longest walks that there are, within 1e-15 a step. */
START_TEST(frames_stay_orthonormal)
{
    for (uint64_t round = 0; round < 100; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        ki_walk w = START;

        for (int i = 1; i <= 1000; i++) {
            ki_walk_step(&w, oracle_dyadic(&rng, 53), oracle_dyadic(&rng, 53));
            if (i % 100 == 0) ck_assert_double_le(skew(&w), 1e-15 * i);
        }
    }
}
END_TEST

/* Every step ends uniformly on the sphere, wherever it starts: by the moments of
 * the coordinates, over a grid of midpoints in u and v. */
START_TEST(steps_end_uniformly)
{
    enum { M = 200 };
    ki_walk begin = START;
    double first[3] = {0.0}, second[3] = {0.0}, mixed[3] = {0.0};

    ki_walk_step(&begin, 0.7, 0.1);
    for (int i = 0; i < M * M; i++) {
        ki_walk w = begin;

        ki_walk_step(&w, (i / M + 0.5) / M, (i % M + 0.5) / M);
        for (int k = 0; k < 3; k++) {
            first[k] += w.at[k] / (M * M);
            second[k] += w.at[k] * w.at[k] / (M * M);
            mixed[k] += w.at[k] * w.at[(k + 1) % 3] / (M * M);
        }
    }
    for (int k = 0; k < 3; k++) {
        ck_assert_double_eq_tol(first[k], 0.0, 1e-4);
        ck_assert_double_eq_tol(second[k], 1.0 / 3.0, 1e-4);
        ck_assert_double_eq_tol(mixed[k], 0.0, 1e-4);
    }
}
END_TEST

START_TEST(extreme_steps)
{
    const double ends[] = {0.0, 0x1p-1074, 0x1p-53, 0.5, 1.0 - 0x1p-53, 1.0};

    for (int i = 0; i < 36; i++) {
        ki_walk w = START;

        ki_walk_step(&w, ends[i / 6], ends[i % 6]);
        ck_assert_double_le(skew(&w), 1e-14);
        if (i / 6 == 0) ck_assert(w.at[2] == -1.0); /* stays */
        if (i / 6 == 5) ck_assert(w.at[2] == 1.0);  /* straight across */
    }
}
END_TEST

/* ---- Values ------------------------------------------------------------------ */

/* The mean over n random points. */
static double mean_of(const koksma_integrand *f, size_t n)
{
    double sum = 0.0, x[64];

    for (uint64_t i = 0; i < n; i++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), i);

        for (size_t k = 0; k < f->dim; k++)
            x[k] = oracle_dyadic(&rng, 53);
        sum += f->value(f, x);
    }
    return sum / (double)n;
}

/* 5 standard deviations: once in 1.7 million seeds a case is off by more. */
START_TEST(means)
{
    static const double params[][5] = {{0.5, 0.2, 0.3, 1.1, 0.2},
                                       {0.8, 0.05, -0.9, 4.0, 0.3},
                                       {0.99, 0.7, 0.3, 1.1, 0.05},
                                       {0.2, 0.5, 1.0, 0.0, 0.5}};

    for (size_t i = 0; koksma_scenes[i] != NULL; i++)
        for (size_t j = 0; j < 4; j++)
            for (size_t bounces = 1; bounces <= 10;
                 bounces = 3 * bounces - bounces / 3) {
                const koksma_integrand_row *row = koksma_scenes[i];
                size_t n = 20000, dim = row->dim_least + 2 * (bounces - 1);
                koksma_facts k;
                koksma_integrand f = fixture_make(&k, row->name, dim, params[j]);
                double mean = mean_of(&f, n);

                ck_assert_uint_eq(koksma_scene_bounces(&f), bounces);
                ck_assert_msg(fabs(mean - k.integral) <=
                                  5.0 * sqrt(k.variance / (double)n) + 1e-15,
                              "%s, %zu bounces: %g, not %g", row->name, bounces,
                              mean, k.integral);
            }
}
END_TEST

/* Many points and one bounce: the variance is that of the values. */
START_TEST(exact_answers)
{
    koksma_facts k;
    koksma_integrand f = fixture_make(&k, "sphere", 4, NULL);

    ck_assert_double_eq_tol(k.integral, 0.05, 1e-17);
    ck_assert_double_eq_tol(k.variance, 0.0625 * 0.16, 1e-17);
    ck_assert_double_eq_tol(koksma_scene_neumann(&f), 0.2, 1e-16);
    f = fixture_make(&k, "sphere-sum", 6, NULL);
    ck_assert_double_eq_tol(k.integral, 0.2 * 0.875, 1e-16);
    ck_assert(k.pieces == 8.0 && k.jump == 0.5 && isnan(k.jump_rms));
    f = fixture_make(&k, "sphere-shoot", 8, (double[]){0.5, 0.2, 0.3, 1.1, 0.4});
    ck_assert_double_eq_tol(k.integral, 0.025, 1e-17);
    ck_assert_double_eq_tol(k.jump, 0.0625, 1e-17);
    ck_assert_double_eq_tol(k.variance, 0.0625 * 0.0625 * 0.24, 1e-17);
    f = fixture_make(&k, "sphere-shoot-sum", 6,
                     (double[]){0.5, 0.2, 0.3, 1.1, 0.4});
    ck_assert_double_eq_tol(k.integral, 0.2 * 0.75, 1e-16);
    ck_assert_double_eq_tol(k.jump, 0.25, 1e-17);
    ck_assert(k.axes == 6.0 && k.variation == HUGE_VAL);
}
END_TEST

/* The sum over bounces is the sum of single bounces of the shorter walks, and its
 * piece says which of them arrive. */
START_TEST(sums_of_bounces)
{
    static const char *const names[][2] = {{"sphere", "sphere-sum"},
                                           {"sphere-shoot", "sphere-shoot-sum"}};

    for (uint64_t round = 0; round < 3000; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        size_t shoot = round % 2, bounces = 1 + oracle_below(&rng, 8), pieces = 0;
        size_t more = 2 * shoot;
        double x[32], sum = 0.0;
        koksma_integrand all =
            fixture_make(NULL, names[shoot][1], 2 * bounces + more, NULL);

        for (size_t k = 0; k < all.dim; k++)
            x[k] = oracle_dyadic(&rng, 53);
        for (size_t i = 1; i <= bounces; i++) {
            koksma_integrand one =
                fixture_make(NULL, names[shoot][0], 2 * i + more, NULL);
            double v = one.value(&one, x);

            ck_assert(one.piece(&one, x) == (v != 0.0));
            ck_assert(v == 0.0 || v == ldexp(1.0, -(int)i));
            pieces |= (size_t)(v != 0.0) << (i - 1);
            sum += v;
        }
        ck_assert(all.value(&all, x) == sum && all.piece(&all, x) == pieces);
    }
}
END_TEST

/* To turn the light round the axis is to turn the first step. */
START_TEST(turned_light)
{
    size_t differ = 0, hits = 0;

    for (uint64_t round = 0; round < 5000; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        double turn = oracle_dyadic(&rng, 53) / 2.0, x[6], full = 8.0 * atan(1.0);
        koksma_integrand f = fixture_make(NULL, "sphere", 6, NULL), g;

        g = fixture_make(NULL, "sphere", 6,
                         (double[]){0.5, 0.2, 0.3, 1.1 + full * turn});
        for (size_t k = 0; k < 6; k++)
            x[k] = oracle_dyadic(&rng, 53);

        double v = f.value(&f, x);

        x[1] += x[1] + turn < 1.0 ? turn : turn - 1.0;
        differ += g.value(&g, x) != v;
        hits += v != 0.0;
    }
    ck_assert_uint_eq(differ, 0);
    ck_assert_uint_gt(hits, 500);
}
END_TEST

/* Directions matter after the first step too: the last two coordinates alone do not
 * decide, as they would in one frame for all points. */
START_TEST(walks_are_remembered)
{
    koksma_integrand f = fixture_make(NULL, "sphere", 6, NULL);
    size_t changed[6] = {0};

    for (uint64_t round = 0; round < 2000; round++)
        for (size_t k = 0; k < 6; k++) {
            oracle_rng rng = oracle_rng_start(oracle_seed(), round);
            double x[6], v;

            for (size_t j = 0; j < 6; j++)
                x[j] = oracle_dyadic(&rng, 53);
            v = f.value(&f, x);
            x[k] = oracle_dyadic(&rng, 53);
            changed[k] += f.value(&f, x) != v;
        }
    for (size_t k = 0; k < 6; k++)
        ck_assert_uint_gt(changed[k], 100);
}
END_TEST

/* Energy: every walk of shooting starts on the light.  With a patch that is the cap
 * and no step between, it would always hit; that is what its chord says. */
START_TEST(starts_on_the_light)
{
    const double p[] = {0.5, 0.2, -1.0, 0.0, 0.2};
    koksma_integrand f = fixture_make(NULL, "sphere-shoot", 4, p);

    /* The light is round the viewed point, and the step of cosine 0 stays. */
    for (int i = 0; i < 100; i++) {
        double x[] = {i / 100.0, (i * 37 % 100) / 100.0, 0.0, 0.3};

        ck_assert(f.value(&f, x) == 0.5);
        x[2] = 1.0; /* across, where no patch is */
        ck_assert(f.value(&f, x) == 0.0);
    }
}
END_TEST

/* A light on the axis is a step of one coordinate: in u alone, and of variation
 * albedo. */
START_TEST(light_on_the_axis)
{
    for (int side = -1; side <= 1; side += 2) {
        const double p[] = {0.5, 0.25, side, 1.0};
        koksma_facts k;
        koksma_integrand f = fixture_make(&k, "sphere", 2, p);

        for (int i = 0; i < 100; i++) {
            double u = (i + 0.5) / 100.0, x[] = {u, (i * 29 % 100) / 100.0};

            ck_assert((f.value(&f, x) == 0.5) == (side > 0 ? u > 0.75 : u < 0.25));
        }
        ck_assert(k.axes == 1.0 && k.extent == 1.0 && k.variation == 0.5);
        ck_assert_double_eq_tol(fixture_variation(&f, 10), 0.5, 1e-15);
        f = fixture_make(&k, "sphere", 4, p);
        ck_assert(k.axes == 3.0 && k.variation == HUGE_VAL);
    }
}
END_TEST

/* The rim, by bisection along u: the light has its share to the last digits. */
START_TEST(rim_on_the_axis)
{
    const double caps[] = {0.25, 1e-3, 1e-9, 0.9};

    for (int i = 0; i < 4; i++) {
        koksma_integrand f =
            fixture_make(NULL, "sphere", 2, (double[]){0.5, caps[i], 1.0, 0.0});
        double dark = 0.0, lit = 1.0;

        for (int j = 0; j < 60; j++) {
            double x[] = {0.5 * (dark + lit), 0.3};

            *(f.value(&f, x) > 0.0 ? &lit : &dark) = x[0];
        }
        ck_assert_double_eq_tol(1.0 - lit, caps[i], 4e-16);
    }
}
END_TEST

START_TEST(variation_diverges)
{
    koksma_facts k;
    koksma_integrand f = fixture_make(&k, "sphere", 2, NULL);

    ck_assert(k.variation == HUGE_VAL);
    ck_assert_double_ge(fixture_variation(&f, 250),
                        1.8 * fixture_variation(&f, 125));
}
END_TEST

/* A cap so small that 1 - 2 cap is 1, met head on and missed by little. */
START_TEST(tiny_cap)
{
    const double p[] = {0.5, 1e-18, 1.0, 0.0};
    koksma_integrand f = fixture_make(NULL, "sphere", 2, p);
    double x[] = {1.0, 0.0};

    ck_assert(f.value(&f, x) == 0.5);
    x[0] = 1.0 - 0x1p-53;
    ck_assert(f.value(&f, x) == 0.0);
}
END_TEST

START_TEST(extreme_points)
{
    const double ends[] = {0.0, 0x1p-1074, 1.0 - 0x1p-53, 1.0};

    for (size_t i = 0; koksma_scenes[i] != NULL; i++) {
        koksma_integrand f = fixture_make(NULL, koksma_scenes[i]->name, 4, NULL);

        for (size_t code = 0; code < 256; code++) {
            double x[] = {ends[code % 4], ends[code / 4 % 4], ends[code / 16 % 4],
                          ends[code / 64]};
            double v = f.value(&f, x);

            ck_assert(v >= 0.0 && v <= 0.75);
        }
    }
}
END_TEST

static void check_refused(const char *name, size_t dim, double albedo, double cap,
                          koksma_status want, const char *text)
{
    const double p[] = {albedo, cap, 0.3, 1.1, 0.2};
    koksma_integrand f;
    koksma_error err = {0};

    ck_assert_int_eq(
        koksma_integrand_make(&f, NULL, koksma_scene_find(name), dim, p, &err),
        want);
    ck_assert_msg(strstr(err.text, text) != NULL, "%s", err.text);
}

START_TEST(refused)
{
    check_refused("sphere", 2, 1.0, 0.2, KOKSMA_EDOMAIN,
                  "albedo between 0 and 1, both excluded, not 1");
    check_refused("sphere", 2, 1.5, 0.2, KOKSMA_EDOMAIN, "albedo");
    check_refused("sphere-sum", 2, 0.0, 0.2, KOKSMA_EDOMAIN, "albedo");
    check_refused("sphere", 2, 0.5, 0.0, KOKSMA_EDOMAIN, "cap between 0 and 1");
    check_refused("sphere-shoot", 4, 0.5, 1.0, KOKSMA_EDOMAIN, "cap");
    check_refused("sphere", 2, 0.5, (double)NAN, KOKSMA_EDOMAIN, "nan");
    check_refused("sphere", 3, 0.5, 0.2, KOKSMA_EINVAL, "an even number");
    check_refused("sphere-shoot", 2, 0.5, 0.2, KOKSMA_EINVAL, "from 4 to");
    check_refused("sphere-sum", 128, 0.5, 0.2, KOKSMA_EINVAL, "from 2 to");
    ck_assert_ptr_null(koksma_scene_find("cube"));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("scene");
    TCase *tc = tcase_create("steps");

    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 30.0);
    tcase_add_test(tc, turns);
    tcase_add_test(tc, steps_are_chords);
    tcase_add_test(tc, frames_are_transported);
    tcase_add_test(tc, frames_stay_orthonormal);
    tcase_add_test(tc, steps_end_uniformly);
    tcase_add_test(tc, extreme_steps);

    tc = tcase_create("values");
    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 30.0);
    tcase_add_test(tc, means);
    tcase_add_test(tc, exact_answers);
    tcase_add_test(tc, sums_of_bounces);
    tcase_add_test(tc, turned_light);
    tcase_add_test(tc, walks_are_remembered);
    tcase_add_test(tc, starts_on_the_light);
    tcase_add_test(tc, light_on_the_axis);
    tcase_add_test(tc, rim_on_the_axis);
    tcase_add_test(tc, variation_diverges);
    tcase_add_test(tc, tiny_cap);
    tcase_add_test(tc, extreme_points);
    tcase_add_test(tc, refused);
    return oracle_run(suite);
}
