/* What does not depend on how the tree and the lines are worked: on the number of
 * threads, on the shares that it is cut into, on the stages on the way, on when it
 * is stopped. */

#include <check.h>
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

#include "gen.h"
#include "oracle.h"
#include "star.h"

enum { DIMS = 10, NUMBERS = 12000, THREADS = 8 };

/* Sets with many cells to search; levels > 0: moved to a grid of so many steps, for
 * ties in masses. */
static const struct source {
    const char *family;
    size_t dim, n, levels;
    bool lines; /* not the tree */
} sources[] = {
    {"random", 2, 3000, 0, true},     {"halton", 2, 4000, 0, true},
    {"hammersley", 2, 3001, 0, true}, {"random", 2, 2000, 12, true},
    {"random", 3, 1000, 0, true},     {"sobol", 3, 512, 0, true},
    {"halton", 3, 700, 16, true},     {"grid", 3, 343, 0, true},
    {"random", 2, 200, 0, false},     {"random", 4, 100, 0, false},
    {"random", 8, 30, 0, false},      {"random", 2, 300, 8, false},
    {"random", 3, 200, 6, false},     {"random", 5, 60, 4, false},
    {"halton", 3, 300, 0, false},     {"halton", 5, 100, 0, false},
    {"halton", 3, 300, 16, false},    {"sobol", 4, 128, 0, false},
    {"sobol", 8, 40, 0, false},       {"sobol", 3, 128, 0, false},
    {"centred", 2, 225, 0, false},    {"centred", 4, 81, 0, false},
    {"centred", 1, 300, 0, false},    {"grid", 3, 125, 0, false},
    {"hammersley", 4, 99, 0, false},
};

enum { SOURCES = sizeof sources / sizeof sources[0] };

typedef struct answer {
    koksma_star_result r;
    double corner[DIMS];
    koksma_status status;
} answer;

/* The points live until the next call. */
static koksma_points points_of(const struct source *s)
{
    static double x[NUMBERS];
    koksma_gen_opts o = {.dim = s->dim, .n = s->n, .seed = oracle_seed()};
    koksma_error err = {0};
    koksma_gen *g;

    ck_assert_uint_le(s->n * s->dim, NUMBERS);
    ck_assert_msg(koksma_gen_open(&g, koksma_gen_find(s->family), &o, &err) ==
                      KOKSMA_OK,
                  "%s: %s", s->family, err.text);
    ck_assert_int_eq(koksma_gen_fill(g, x, 0, s->n, NULL), KOKSMA_OK);
    koksma_gen_close(g);
    for (size_t i = 0; s->levels > 0 && i < s->n * s->dim; i++)
        x[i] = round(x[i] * (double)s->levels) / (double)s->levels;
    return (koksma_points){x, s->n, s->dim};
}

static answer solve(const struct source *s, koksma_points p, koksma_star_opts opts)
{
    answer a = {0};
    koksma_error err = {0};

    opts.method = s->lines ? KOKSMA_STAR_LINES : KOKSMA_STAR_TREE;
    a.r.witness.corner = a.corner;
    a.status = koksma_star(&a.r, p, &opts, &err);
    ck_assert_msg(a.status == KOKSMA_OK || a.status == KOKSMA_STOPPED, "%s",
                  err.text);
    a.r.witness.corner = NULL; /* an answer may move */
    return a;
}

/* What any answer proves of itself: the box holds so many points, and is as far off
 * as it says. */
static void check_witness(const answer *a, koksma_points p)
{
    koksma_box box = a->r.witness;
    double corner[DIMS];

    memcpy(corner, a->corner, sizeof corner);
    box.corner = corner;
    ck_assert_uint_eq(box.inside, oracle_count(p, corner, box.closed));
    ck_assert(koksma_box_local(&box, p).lower >= a->r.value.lower);
}

static void check_same(const answer *a, const answer *b, const struct source *s,
                       size_t threads)
{
    bool same = a->r.value.lower == b->r.value.lower &&
                a->r.value.upper == b->r.value.upper &&
                a->r.witness.inside == b->r.witness.inside &&
                a->r.witness.closed == b->r.witness.closed;

    for (size_t k = 0; k < s->dim; k++)
        same = same && a->corner[k] == b->corner[k];
    ck_assert_msg(same,
                  "%s, dim %zu, n %zu, levels %zu, KOKSMA_TEST_SEED=%llu: 1 thread "
                  "[%.17g, %.17g] %zu %d, %zu threads [%.17g, %.17g] %zu %d",
                  s->family, s->dim, s->n, s->levels,
                  (unsigned long long)oracle_seed(), a->r.value.lower,
                  a->r.value.upper, a->r.witness.inside, a->r.witness.closed,
                  threads, b->r.value.lower, b->r.value.upper, b->r.witness.inside,
                  b->r.witness.closed);
}

START_TEST(same_bits_for_any_threads)
{
    const struct source *s = &sources[_i];
    koksma_points p = points_of(s);
    answer one = solve(s, p, (koksma_star_opts){.threads = 1});

    ck_assert_int_eq(one.status, KOKSMA_OK);
    check_witness(&one, p);
    for (size_t threads = 0; threads <= THREADS; threads++) {
        answer a = solve(
            s, p,
            (koksma_star_opts){.threads = threads, .anytime = threads % 4 == 2});

        ck_assert_int_eq(a.status, KOKSMA_OK);
        check_same(&one, &a, s, threads);
    }
}
END_TEST

/* The shares of a search, whose greatest ends are the whole's. */
static void check_parts(const struct source *s, koksma_points p,
                        koksma_star_opts opts, size_t parts, koksma_interval whole)
{
    koksma_interval sum = {0.0, 0.0};

    opts.parts = parts;
    for (opts.part = 1; opts.part <= parts; opts.part++) {
        answer a = solve(s, p, opts);

        ck_assert_int_eq(a.status, KOKSMA_OK);
        ck_assert_double_le(a.r.value.lower, whole.lower);
        check_witness(&a, p);
        sum.lower = fmax(sum.lower, a.r.value.lower);
        sum.upper = fmax(sum.upper, a.r.value.upper);
    }
    ck_assert_msg(sum.lower == whole.lower && sum.upper == whole.upper,
                  "n %zu, dim %zu: %zu parts, %zu threads, %s: [%.17g, %.17g], the "
                  "whole [%.17g, %.17g]",
                  p.n, p.dim, parts, opts.threads,
                  opts.anytime ? "in stages" : "at once", sum.lower, sum.upper,
                  whole.lower, whole.upper);
}

START_TEST(parts_make_the_whole)
{
    static const size_t counts[] = {1, 2, 3, 5};
    const struct source *s = &sources[_i];
    koksma_points p = points_of(s);
    koksma_interval whole = solve(s, p, (koksma_star_opts){.threads = 1}).r.value;

    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++)
        check_parts(s, p, (koksma_star_opts){.threads = 1 + i % 3}, counts[i],
                    whole);
    check_parts(s, p, (koksma_star_opts){.threads = 1, .anytime = true}, 3, whole);
}
END_TEST

/* With a tolerance the shares together still hold D*, and no box found is above. */
START_TEST(parts_with_a_tolerance)
{
    static const double tolerances[] = {0.02, 0.1, 0.6};
    const struct source *s = &sources[_i];
    koksma_points p = points_of(s);
    koksma_interval whole = solve(s, p, (koksma_star_opts){.threads = 1}).r.value;

    for (size_t i = 0; i < 3; i++) {
        koksma_star_opts opts = {.threads = 1,
                                 .tolerance = tolerances[i],
                                 .anytime = i == 1,
                                 .parts = 2};
        double upper = 0.0;

        for (opts.part = 1; opts.part <= 2; opts.part++) {
            answer a = solve(s, p, opts);

            ck_assert_int_eq(a.status, KOKSMA_OK);
            ck_assert_double_le(a.r.value.lower, whole.lower);
            upper = fmax(upper, a.r.value.upper);
        }
        ck_assert_double_ge(upper, whole.upper);
    }
}
END_TEST

START_TEST(refused_parts)
{
    static const double x[] = {0.5, 0.25};
    static const koksma_star_opts bad[] = {
        {.part = 0, .parts = 2},
        {.part = 3, .parts = 2},
        {.part = SIZE_MAX, .parts = 4},
        {.method = KOKSMA_STAR_TREE, .part = 6, .parts = 5},
        {.method = KOKSMA_STAR_SWEEP, .part = 1, .parts = 2},
        {.method = KOKSMA_STAR_DEM, .part = 1, .parts = 2},
        {.method = KOKSMA_STAR_SEARCH, .part = 1, .parts = 2},
    };

    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        koksma_star_result r = {0};
        koksma_error err = {0};

        ck_assert_int_eq(koksma_star(&r, (koksma_points){x, 1, 2}, &bad[i], &err),
                         KOKSMA_EINVAL);
        ck_assert_int_eq(err.status, KOKSMA_EINVAL);
        ck_assert_uint_gt(strlen(err.text), 0);
        ck_assert_double_eq(r.value.upper, 0.0);
    }
}
END_TEST

/* One part of one is the whole, which the sweep may do too; and what the parts are
 * counted by is not looked at where there are none. */
START_TEST(one_part_is_the_whole)
{
    static const double x[] = {0.5, 0.25};
    static const koksma_star_opts good[] = {
        {.method = KOKSMA_STAR_SWEEP, .part = 1, .parts = 1},
        {.method = KOKSMA_STAR_SWEEP, .part = 0, .parts = 0},
        {.method = KOKSMA_STAR_AUTO, .part = 2, .parts = 2},
        {.method = KOKSMA_STAR_TREE, .part = 1, .parts = 1},
    };

    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        koksma_star_result r = {0};

        ck_assert_int_eq(koksma_star(&r, (koksma_points){x, 1, 2}, &good[i], NULL),
                         KOKSMA_OK);
        ck_assert_int_eq(r.method, good[i].method == KOKSMA_STAR_AUTO
                                       ? KOKSMA_STAR_LINES
                                       : good[i].method);
    }
}
END_TEST

/* What the callback has seen, and the call at which it says stop (0: none). */
typedef struct watch {
    atomic_flag busy; /* a call is under way */
    bool alone, fair; /* never two at once; the intervals shrink, the work grows */
    koksma_interval last;
    double work;
    size_t calls, stop_at;
} watch;

static int look(void *state, double lower, double upper, double work)
{
    watch *w = state;
    int stop;

    if (atomic_flag_test_and_set(&w->busy)) w->alone = false;
    if (!(lower >= w->last.lower && upper <= w->last.upper && lower <= upper &&
          work >= w->work))
        w->fair = false;
    w->last = (koksma_interval){lower, upper};
    w->work = work;
    stop = ++w->calls == w->stop_at;
    atomic_flag_clear(&w->busy);
    return stop;
}

static answer watched(const struct source *s, koksma_points p, size_t threads,
                      watch *w, size_t stop_at)
{
    *w = (watch){.busy = ATOMIC_FLAG_INIT,
                 .alone = true,
                 .fair = true,
                 .last = {0.0, 1.0},
                 .stop_at = stop_at};

    answer a = solve(
        s, p,
        (koksma_star_opts){
            .threads = threads, .anytime = true, .progress = look, .state = w});

    ck_assert_msg(w->alone, "two calls of progress at once");
    ck_assert_msg(w->fair, "the intervals told do not shrink");
    ck_assert(w->last.lower <= a.r.value.lower && w->last.upper >= a.r.value.upper);
    return a;
}

START_TEST(intervals_shrink)
{
    const struct source *s = &sources[_i];
    koksma_points p = points_of(s);
    answer one = solve(s, p, (koksma_star_opts){.threads = 1});

    for (size_t threads = 1; threads <= 4; threads += 3) {
        watch w;
        answer a = watched(s, p, threads, &w, 0);

        ck_assert_int_eq(a.status, KOKSMA_OK);
        ck_assert_uint_ge(w.calls, 2);
        check_same(&one, &a, s, threads);
    }
}
END_TEST

/* Stopped wherever: the interval holds D*, the box proves its lower end, progress
 * is not asked again, and each thread has done little since: it looks up every 2^18
 * steps, and a look at one cell of these sets takes the tree fewer than that; a
 * leaf of 64 columns may have all lines of both kinds. */
static void check_stop(const struct source *s, koksma_points p, size_t threads,
                       size_t stop_at, koksma_interval truth)
{
    watch w;
    answer a = watched(s, p, threads, &w, stop_at);

    if (a.status == KOKSMA_OK) { /* this time there were fewer calls */
        ck_assert_uint_gt(threads, 1);
        ck_assert_uint_lt(w.calls, stop_at);
    } else {
        double leaf = s->lines ? 128.0 * (double)(s->n + 1) : 0.0;

        ck_assert_uint_eq(w.calls, stop_at);
        ck_assert_double_le(a.r.work, w.work + (double)threads * (0x1p19 + leaf));
    }
    ck_assert(a.r.value.lower <= truth.lower && a.r.value.upper >= truth.upper);
    check_witness(&a, p);
}

START_TEST(stopped_anywhere)
{
    const struct source *s = &sources[_i];
    koksma_points p = points_of(s);
    oracle_rng rng = oracle_rng_start(oracle_seed(), (uint64_t)_i);
    watch all;
    koksma_interval truth = watched(s, p, 1, &all, 0).r.value;

    for (size_t round = 0; round < 4 * oracle_scale(); round++)
        for (size_t threads = 1; threads <= 4; threads += 3)
            check_stop(s, p, threads, 1 + oracle_below(&rng, all.calls), truth);
}
END_TEST

static TCase *add_tests(Suite *suite, const char *name, const TTest *test)
{
    TCase *tc = tcase_create(name);

    tcase_add_loop_test(tc, test, 0, SOURCES);
    tcase_set_timeout(tc, 60.0 * (double)oracle_scale());
    suite_add_tcase(suite, tc);
    return tc;
}

int main(void)
{
    Suite *suite = suite_create("star_threads");
    TCase *tc = tcase_create("options");

    tcase_set_tags(add_tests(suite, "threads", same_bits_for_any_threads),
                   "threads");
    tcase_set_tags(add_tests(suite, "shrinking", intervals_shrink), "threads");
    tcase_set_tags(add_tests(suite, "stopping", stopped_anywhere), "threads");
    tcase_set_tags(add_tests(suite, "parts", parts_make_the_whole), "slow");
    tcase_set_tags(add_tests(suite, "tolerance", parts_with_a_tolerance), "slow");
    tcase_add_test(tc, refused_parts);
    tcase_add_test(tc, one_part_is_the_whole);
    suite_add_tcase(suite, tc);
    return oracle_run(suite);
}
