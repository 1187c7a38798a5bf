/* How wide the intervals of finished answers are at size: of star discrepancies two
 * ulps of 1 at most, of L2 discrepancies 1e-9 of themselves.  That the truth is
 * inside, test_certify.c shows on small sets. */
#include <check.h>
#include <float.h>
#include <stdlib.h>

#include "gen.h"
#include "l2.h"
#include "oracle.h"
#include "star.h"

static const struct source {
    const char *family;
    size_t dim, n;
} stars[] = {
    {"halton", 2, 1000},        {"random", 2, 1000},   {"hammersley", 2, 1000},
    {"halton", 2, 10000},       {"random", 2, 10000},  {"sobol", 2, 16384},
    {"halton", 2, 100000},      {"random", 2, 100000}, {"hammersley", 2, 100000},
    {"niederreiter", 2, 30000}, {"halton", 3, 1000},   {"random", 3, 2000},
    {"sobol", 3, 1024},         {"halton", 4, 400},    {"random", 4, 500},
    {"sobol", 5, 128},          {"random", 5, 200},    {"halton", 6, 100},
    {"random", 6, 100},
};

static const struct source means[] = {{"halton", 2, 30000}, {"random", 3, 4000}};

static const struct source large[] = {
    {"halton", 2, 1000000},
    {"sobol", 2, 1048576},
    {"halton", 3, 1000000},
};

enum {
    STARS = sizeof stars / sizeof stars[0],
    MEANS = sizeof means / sizeof means[0],
    LARGE = sizeof large / sizeof large[0]
};

/* The points go to *x, which is to be freed. */
static koksma_points points_of(double **x, const struct source *s)
{
    koksma_gen_opts o = {.dim = s->dim, .n = s->n, .seed = oracle_seed()};
    koksma_gen *g;

    *x = malloc(s->n * s->dim * sizeof **x);
    ck_assert_ptr_nonnull(*x);
    ck_assert_int_eq(koksma_gen_open(&g, koksma_gen_find(s->family), &o, NULL),
                     KOKSMA_OK);
    ck_assert_int_eq(koksma_gen_fill(g, *x, 0, s->n, NULL), KOKSMA_OK);
    koksma_gen_close(g);
    return (koksma_points){*x, s->n, s->dim};
}

START_TEST(star_discrepancies)
{
    const struct source *s = &stars[_i];
    double *x;
    koksma_points p = points_of(&x, s);
    koksma_star_result r = {.value = {0.0, 0.0}};

    ck_assert_int_eq(koksma_star(&r, p, NULL, NULL), KOKSMA_OK);
    ck_assert_msg(oracle_narrow(r.value) &&
                      r.value.upper - r.value.lower <= 2.0 * DBL_EPSILON,
                  "%s, dim %zu, n %zu: [%a, %a]", s->family, s->dim, s->n,
                  r.value.lower, r.value.upper);
    free(x);
}
END_TEST

static void check_means(const struct source *s, int kind)
{
    double *x;
    koksma_points p = points_of(&x, s);
    koksma_l2_opts o = {.kind = (koksma_l2_kind)kind, .method = KOKSMA_L2_DIVIDE};
    koksma_l2_result r;

    ck_assert_int_eq(koksma_l2(&r, p, &o, NULL), KOKSMA_OK);
    ck_assert_msg(r.value.lower > 0.0 &&
                      r.value.upper - r.value.lower <= 1e-9 * r.value.lower,
                  "%s, %s, dim %zu, n %zu: [%.17g, %.17g]", koksma_l2_names[kind],
                  s->family, s->dim, s->n, r.value.lower, r.value.upper);
    free(x);
}

START_TEST(l2_discrepancies)
{
    check_means(&means[_i / KOKSMA_L2_KINDS], _i % KOKSMA_L2_KINDS);
}
END_TEST

START_TEST(l2_discrepancies_of_a_million_points)
{
    check_means(&large[_i / KOKSMA_L2_KINDS], _i % KOKSMA_L2_KINDS);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("widths");
    TCase *tc = tcase_create("widths"), *big = tcase_create("big");

    tcase_add_loop_test(tc, star_discrepancies, 0, STARS);
    tcase_add_loop_test(tc, l2_discrepancies, 0, MEANS * KOKSMA_L2_KINDS);
    tcase_set_timeout(tc, 300);
    tcase_set_tags(tc, "slow");
    suite_add_tcase(suite, tc);
    tcase_add_loop_test(big, l2_discrepancies_of_a_million_points, 0,
                        LARGE * KOKSMA_L2_KINDS);
    tcase_set_timeout(big, 600);
    tcase_set_tags(big, "big");
    suite_add_tcase(suite, big);
    return oracle_run(suite);
}
