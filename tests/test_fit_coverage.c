/* Whether the intervals of the fit keep their word (tag big).
 *
 * The errors of 8192 paths to N = 2^17 are computed for each experiment.  The first
 * 4096 make the truth: the slope of their root mean square, fitted like any other.
 * From the others, 4000 times, R different ones are drawn at random; their interval
 * either holds that truth or not.  So trials share paths, and are independent of
 * the truth. */
#include "fit_fixture.h"
#include "paths.h"

enum { POOL = 4096, TRIALS = 4000, MOST = 64 };

static double xs[2 * POOL * PATH_ROWS], ys[2 * POOL * PATH_ROWS];
static size_t of[2 * POOL * PATH_ROWS], each;

static const koksma_fit_opts window = {.from = 16.0, .scale = 1.0};

static const path_kind kinds[] = {{"halton", "f2", 0.0, 7, 1 << 17, 0},
                                  {"halton", "f3", 0.0, 7, 1 << 17, 0},
                                  {"random", "f2", 0.0, 7, 1 << 17, 0}};

static double fill_pool(path_kind kind)
{
    koksma_fit_data d = {xs, ys, of, 0, 2 * POOL};
    koksma_fit_result f;
    koksma_error err = {0};

    for (size_t r = 0; r < 2 * POOL; r++)
        path_add(xs, ys, of, &d, kind, r);
    each = d.rows / (2 * POOL);
    d.rows /= 2;
    d.sets = POOL;
    ck_assert_msg(koksma_fit(&f, d, &window, &err) == KOKSMA_OK, "%s", err.text);
    return f.slope.value.value;
}

/* Draw R different paths of the second half, and see. */
static bool holds(oracle_rng *rng, size_t replicates, double truth)
{
    static double x[MOST * PATH_ROWS], y[MOST * PATH_ROWS];
    static size_t set[MOST * PATH_ROWS], order[POOL];
    koksma_fit_data d = {x, y, set, 0, replicates};
    koksma_fit_result f;

    for (size_t r = 0; r < POOL; r++)
        order[r] = r;
    for (size_t r = 0; r < replicates; r++) {
        size_t other = r + oracle_below(rng, POOL - r), path = order[other];

        order[other] = order[r];
        for (size_t j = 0; j < each; j++, d.rows++) {
            x[d.rows] = xs[(POOL + path) * each + j];
            y[d.rows] = ys[(POOL + path) * each + j];
            set[d.rows] = r;
        }
    }
    ck_assert_int_eq(koksma_fit(&f, d, &window, NULL), KOKSMA_OK);
    return f.slope.value.lower <= truth && truth <= f.slope.value.upper;
}

START_TEST(coverage)
{
    double truth = fill_pool(kinds[_i]);

    for (size_t replicates = 16; replicates <= MOST; replicates *= 2) {
        size_t held = 0;

        for (uint64_t trial = 0; trial < TRIALS; trial++) {
            oracle_rng rng = oracle_rng_start(oracle_seed() + replicates, trial);

            held += holds(&rng, replicates, truth);
        }
        printf("coverage of %s %s: slope %.4f, R = %zu: %.1f %%\n",
               kinds[_i].family, kinds[_i].integrand, truth, replicates,
               100.0 * (double)held / TRIALS);
        ck_assert_msg(held >= TRIALS * 92 / 100 && held <= TRIALS * 97 / 100,
                      "%s %s: %zu of %d at R = %zu", kinds[_i].family,
                      kinds[_i].integrand, held, TRIALS, replicates);
    }
}
END_TEST

/* The same for paths of a law that is known: stationary walks around it, drawn
 * anew for each trial. */
START_TEST(coverage_of_walks)
{
    size_t held = 0, held_80 = 0, bends = 0, trials = 1000;
    koksma_fit_opts eighty = {.level = 0.8};

    for (uint64_t round = 0; round < trials; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        koksma_fit_result f;

        random_table(&data, &rng, 16, 24, -0.75);
        f = fit(&data, NULL);
        held += f.exponent.value.lower <= -0.75 && f.exponent.value.upper >= -0.75;
        bends += f.curvature.value.lower <= 0.0 && f.curvature.value.upper >= 0.0;
        f = fit(&data, &eighty);
        held_80 +=
            f.exponent.value.lower <= -0.75 && f.exponent.value.upper >= -0.75;
    }
    ck_assert_msg(held > 920 && held < 980, "%zu of 1000 at 95 %%", held);
    ck_assert_msg(bends > 920 && bends < 985, "%zu curvatures", bends);
    ck_assert_msg(held_80 > 750 && held_80 < 850, "%zu of 1000 at 80 %%", held_80);
}
END_TEST

/* The library from end to end: does a jump in the plane cost N^-3/4? */
START_TEST(jump_in_the_plane)
{
    size_t held = 0, trials = 100;
    double widest = 0.0, mean = 0.0;

    for (uint64_t seed = 0; seed < trials; seed++) {
        koksma_fit_data d = {xs, ys, of, 0, 32};
        koksma_fit_result f;

        for (size_t r = 0; r < 32; r++)
            path_add(xs, ys, of, &d,
                     (path_kind){"halton", "f2", 0.0, seed, 1 << 17, 0}, r);
        ck_assert_int_eq(koksma_fit(&f, d, &window, NULL), KOKSMA_OK);
        held += f.slope.value.lower <= -0.75 && f.slope.value.upper >= -0.75;
        widest = fmax(widest, f.slope.value.upper - f.slope.value.lower);
        mean += f.slope.value.value / (double)trials;
    }
    ck_assert_msg(held >= 88 && widest < 0.15 && fabs(mean + 0.75) < 0.01,
                  "%zu of 100, mean %g, widest %g", held, mean, widest);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fit coverage");
    TCase *tc = tcase_create("coverage");

    suite_add_tcase(suite, tc);
    tcase_set_tags(tc, "big");
    tcase_set_timeout(tc, 1200.0);
    tcase_add_loop_test(tc, coverage, 0, sizeof kinds / sizeof *kinds);
    tcase_add_test(tc, coverage_of_walks);
    tcase_add_test(tc, jump_in_the_plane);
    return oracle_run(suite);
}
