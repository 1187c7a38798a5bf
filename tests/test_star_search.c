/* The heuristic: what it says is true, no side of its boxes could be better, and on
 * sets whose D* is known it finds it. */
#include <check.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "gen.h"
#include "oracle.h"
#include "star_kernels.h"
#include "tree_climb_kernels.h"

enum { DIMS = 24, NUMBERS = 24000 };

typedef struct answer {
    koksma_star_result r;
    double corner[DIMS];
} answer;

typedef struct test_set {
    double x[NUMBERS];
    koksma_points p;
} test_set;

/* A third of the sets are anywhere, a third on a coarse grid with both ends, so
 * that ties, repeats and faces abound, and a third are mixed. */
static koksma_points make_set(test_set *s, size_t n, size_t dim, uint64_t round)
{
    oracle_rng rng = oracle_rng_start(oracle_seed(), round);

    for (size_t i = 0; i < n * dim; i++) {
        bool anywhere =
            round % 3 == 0 || (round % 3 == 1 && oracle_below(&rng, 2) == 0);

        s->x[i] = anywhere ? oracle_dyadic(&rng, dim < 7 ? 16 : 9)
                           : (double)oracle_below(&rng, 5) / 4.0;
    }
    if (n > 1 && round % 2 == 1)
        memcpy(s->x, s->x + (n - 1) * dim, dim * sizeof *s->x);
    return s->p = (koksma_points){s->x, n, dim};
}

static void make_family(test_set *s, const char *family, size_t n, size_t dim)
{
    koksma_gen_opts o = {.dim = dim, .n = n, .seed = 1};
    koksma_gen *g;

    ck_assert_int_eq(koksma_gen_open(&g, koksma_gen_find(family), &o, NULL), 0);
    ck_assert_int_eq(koksma_gen_fill(g, s->x, 0, n, NULL), 0);
    koksma_gen_close(g);
    s->p = (koksma_points){s->x, n, dim};
}

static void solve(answer *a, koksma_points p, koksma_star_method method,
                  uint64_t seed)
{
    koksma_star_opts opts = {.method = method, .seed = seed};

    memset(a, 0, sizeof *a);
    a->r.witness.corner = a->corner;
    ck_assert_int_eq(koksma_star(&a->r, p, &opts, NULL), KOKSMA_OK);
    ck_assert_int_eq(a->r.method, method);
}

/* A recount of the witness proves value.lower <= D*. */
static void check_witness(const koksma_star_result *r, koksma_points p,
                          uint64_t round)
{
    const koksma_box *w = &r->witness;
    const char *fault = NULL;

    if (w->inside != oracle_count(p, w->corner, w->closed)) fault = "witness count";
    if (!oracle_at_least(oracle_local(p, w->corner, w->closed), r->value.lower))
        fault = "witness below value.lower";
    if (!(r->value.lower >= 0.0 && r->value.upper == 1.0)) fault = "not [found, 1]";
    if (!(r->work >= 1.0)) fault = "no work";
    ck_assert_msg(fault == NULL, "%s: KOKSMA_TEST_SEED=%llu, set %llu", fault,
                  (unsigned long long)oracle_seed(), (unsigned long long)round);
}

/* On sets this small it should not miss D* either. */
START_TEST(small_sets)
{
    static test_set s;
    size_t sets = 200 * oracle_scale(), missed = 0;

    for (uint64_t round = 0; round < sets; round++) {
        size_t dim = 1 + (size_t)(round % 5), n = 1 + (size_t)(round / 5 % 20);
        koksma_points p = make_set(&s, n, dim, round);
        answer exact, a;

        solve(&exact, p, KOKSMA_STAR_TREE, 1);
        solve(&a, p, KOKSMA_STAR_SEARCH, round);
        check_witness(&a.r, p, round);
        ck_assert_double_le(a.r.value.lower, exact.r.value.lower);
        missed += a.r.value.lower < exact.r.value.lower;
        if (dim == 1) ck_assert_double_eq(a.r.value.lower, exact.r.value.lower);
    }
    ck_assert_msg(missed <= sets / 100, "%zu missed", missed);
}
END_TEST

START_TEST(easy_sets)
{
    static test_set s;
    int found = 0;

    for (uint64_t round = 0; round < 40; round++) {
        size_t dim = 2 + (size_t)(round % 5), n = 50 + (size_t)(round * 37 % 151);
        koksma_points p = make_set(&s, n, dim, round);
        answer exact, a;

        solve(&exact, p, KOKSMA_STAR_TREE, 1);
        solve(&a, p, KOKSMA_STAR_SEARCH, 1);
        ck_assert_double_le(a.r.value.lower, exact.r.value.lower);
        found += a.r.value.lower == exact.r.value.lower;
    }
    ck_assert_msg(found >= 38, "%d of 40", found);
}
END_TEST

/* Sets whose extremes are hard to find, with the values that the tree proves. */
START_TEST(hard_sets)
{
    static const struct {
        const char *family;
        size_t n, dim;
        double exact;
    } sets[] = {{"sobol", 512, 10, 0.0721635130},
                {"random", 200, 20, 0.2825099656}};
    static test_set s;
    answer a;

    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++) {
        make_family(&s, sets[i].family, sets[i].n, sets[i].dim);
        solve(&a, s.p, KOKSMA_STAR_SEARCH, 1);
        ck_assert_msg(a.r.value.lower >= sets[i].exact - 1e-10, "%s %zu: %.17g",
                      sets[i].family, sets[i].dim, a.r.value.lower);
    }
}
END_TEST

/* Climb from so many starts; returns the points looked at. */
static double climb(ki_best *best, const ki_ranks *ranks, size_t starts,
                    uint64_t seed)
{
    ki_climber c;
    double work;

    ck_assert_int_eq(ki_climber_begin(&c, ranks, best, seed), KOKSMA_OK);
    ki_climber_go(&c, starts);
    work = c.work;
    ki_climber_end(&c);
    return work;
}

/* One start's box, if it was worth an offer: no other coordinate of a point, nor 1,
 * makes a side better. */
static void check_summit(koksma_points p, bool closed, uint64_t seed)
{
    double corner[DIMS] = {0.0};
    ki_best best = ki_best_begin(p, corner);
    ki_ranks ranks;

    ck_assert_int_eq(ki_ranks_make(&ranks, p, closed, &ki_star_measure), KOKSMA_OK);
    ck_assert_double_ge(climb(&best, &ranks, 1, seed), (double)(p.n * p.dim));
    ki_ranks_free(&ranks);
    if (best.value.lower == 0.0) return; /* a summit below the plain */
    ck_assert(best.witness.closed == closed);

    oracle_ratio summit = oracle_local(p, corner, closed);

    ck_assert(oracle_at_least(summit, best.value.lower));
    ck_assert_uint_eq(best.witness.inside, oracle_count(p, corner, closed));
    for (size_t k = 0; k < p.dim; k++)
        for (size_t i = 0; i <= p.n; i++) {
            double keep = corner[k];

            corner[k] = i < p.n ? p.x[i * p.dim + k] : 1.0;

            oracle_int more = oracle_local(p, corner, closed).num - summit.num;

            ck_assert_msg(ldexp((double)more, -(int)summit.shift) <= 1e-12,
                          "%s, n %zu, dim %zu, seed %llu: axis %zu at %a, not %a",
                          closed ? "closed" : "open", p.n, p.dim,
                          (unsigned long long)seed, k, corner[k], keep);
            corner[k] = keep;
        }
}

START_TEST(summits)
{
    static test_set s;

    for (uint64_t round = 0; round < 600 * oracle_scale(); round++) {
        size_t dim = 1 + (size_t)(round % 6), n = 1 + (size_t)(round * 7 % 40);
        koksma_points p = make_set(&s, n, dim, round);

        check_summit(p, false, round);
        check_summit(p, true, round);
    }
}
END_TEST

/* The elite are distinct and in order, and do not stay for ever. */
START_TEST(elite)
{
    static test_set s;
    double corner[DIMS] = {0.0};
    koksma_points p = make_set(&s, 40, 3, 0);
    ki_best best = ki_best_begin(p, corner);
    ki_ranks ranks;
    ki_climber c;
    bool renewed = false;

    ck_assert_int_eq(ki_ranks_make(&ranks, p, true, &ki_star_measure), KOKSMA_OK);
    ck_assert_int_eq(ki_climber_begin(&c, &ranks, &best, 1), KOKSMA_OK);
    for (size_t starts = 1; starts <= 1000; starts++) {
        size_t before = c.elites;

        ki_climber_go(&c, 1);
        ck_assert_uint_eq(c.starts, starts);
        ck_assert(c.elites >= 1 && c.elites <= KI_ELITE);
        renewed = renewed || c.elites < before;
        for (size_t e = 1; e < c.elites; e++) {
            ck_assert(c.elite[e].excess <= c.elite[e - 1].excess);
            for (size_t other = 0; other < e; other++)
                ck_assert_mem_ne(c.elite[e].cut, c.elite[other].cut,
                                 p.dim * sizeof *c.cut);
        }
    }
    ck_assert(renewed);
    ki_climber_end(&c);
    ki_ranks_free(&ranks);
}
END_TEST

/* How many of some seeds lead a climber, with so many starts, to the best box that
 * any of them finds.  It is a matter of luck with one start, and none with many. */
static int agreeing(koksma_points p, size_t starts)
{
    enum { SEEDS = 6 };
    double found[SEEDS], most = 0.0;
    int count = 0;
    ki_ranks ranks;

    ck_assert_int_eq(ki_ranks_make(&ranks, p, true, &ki_star_measure), KOKSMA_OK);
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        double corner[DIMS] = {0.0};
        ki_best best = ki_best_begin(p, corner);

        climb(&best, &ranks, starts, seed);
        found[seed] = best.value.lower;
        if (found[seed] > most) most = found[seed];
    }
    ki_ranks_free(&ranks);
    for (int seed = 0; seed < SEEDS; seed++)
        count += found[seed] == most;
    return count;
}

START_TEST(seeds_are_luck)
{
    static test_set s;

    make_family(&s, "halton", 200, 8);
    ck_assert_int_lt(agreeing(s.p, 1), 6);
    ck_assert_int_eq(agreeing(s.p, 300), 6);
}
END_TEST

/* The elite and its renewal find what as many fresh starts do not. */
START_TEST(the_elite_pays)
{
    static test_set s;

    make_family(&s, "sobol", 512, 10);
    ck_assert_int_le(agreeing(s.p, 30), 3);
    ck_assert_int_ge(agreeing(s.p, 1000), 5);
}
END_TEST

START_TEST(same_seed_same_bits)
{
    static test_set s;
    int differ = 0;

    for (uint64_t round = 0; round < 8; round++) {
        koksma_points p = make_set(&s, 60, 2 + round, round);
        answer a, b;

        solve(&a, p, KOKSMA_STAR_SEARCH, round);
        solve(&b, p, KOKSMA_STAR_SEARCH, round);
        ck_assert_mem_eq(a.corner, b.corner, sizeof a.corner);
        ck_assert_mem_eq(&a.r.value, &b.r.value, sizeof a.r.value);
        ck_assert_double_eq(a.r.work, b.r.work);
        solve(&b, p, KOKSMA_STAR_SEARCH, round + 1);
        differ += a.r.work != b.r.work;
    }
    ck_assert_int_gt(differ, 0);
}
END_TEST

typedef struct watch {
    size_t calls, stop_at;
    double lower, work;
} watch;

static int look(void *state, double lower, double upper, double work)
{
    watch *w = state;

    ck_assert(lower >= w->lower && lower <= upper && upper == 1.0);
    ck_assert(work > w->work);
    w->lower = lower;
    w->work = work;
    return ++w->calls == w->stop_at;
}

START_TEST(stopped_early)
{
    static const struct {
        double work;
        size_t stop_at;
    } stops[] = {{0.0, 1}, {0.0, 3}, {1.0, 0}, {4e6, 0}};
    static test_set s;

    make_set(&s, 2000, 10, 0);
    for (size_t i = 0; i < sizeof stops / sizeof stops[0]; i++) {
        watch seen = {.stop_at = stops[i].stop_at};
        koksma_star_opts opts = {.method = KOKSMA_STAR_SEARCH,
                                 .work = stops[i].work,
                                 .progress = look,
                                 .state = &seen};
        answer a = {.r.witness.corner = a.corner};

        ck_assert_int_eq(koksma_star(&a.r, s.p, &opts, NULL), KOKSMA_STOPPED);
        if (stops[i].stop_at > 0) ck_assert_uint_eq(seen.calls, stops[i].stop_at);
        if (stops[i].work > 0.0)
            ck_assert_double_le(a.r.work, stops[i].work + 0x1p22);
        ck_assert_double_ge(a.r.value.lower, seen.lower);
        ck_assert_double_gt(a.r.value.lower, 0.0);
        check_witness(&a.r, s.p, i);
    }
}
END_TEST

static TCase *tests_named(Suite *suite, const char *name)
{
    TCase *tc = tcase_create(name);

    tcase_set_timeout(tc, 20.0 * (double)oracle_scale());
    suite_add_tcase(suite, tc);
    return tc;
}

int main(void)
{
    Suite *suite = suite_create("star_search");
    TCase *tc = tests_named(suite, "truth");

    tcase_add_test(tc, small_sets);
    tcase_add_test(tc, summits);
    tcase_add_test(tc, elite);
    tcase_add_test(tc, same_seed_same_bits);
    tcase_add_test(tc, stopped_early);

    tc = tests_named(suite, "luck");
    tcase_set_tags(tc, "slow");
    tcase_add_test(tc, easy_sets);
    tcase_add_test(tc, hard_sets);
    tcase_add_test(tc, seeds_are_luck);
    tcase_add_test(tc, the_elite_pays);
    return oracle_run(suite);
}
