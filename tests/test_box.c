/* koksma_box_discrepancy and koksma_box_between against the definition (oracle.h),
 * its two methods against each other, and what must hold of any set. */
#include <check.h>
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "box.h"
#include "gen.h"
#include "oracle.h"
#include "star.h"

enum { DIMS = 6, NUMBERS = 20000 };

typedef struct test_set {
    double x[NUMBERS];
    koksma_points p;
    oracle_rng rng;
    uint64_t round;
} test_set;

typedef struct answer {
    koksma_box_result r;
    double corners[2 * DIMS];
} answer;

static void complain(const char *what, koksma_points p, uint64_t round,
                     const answer *a)
{
    char text[1200] = "";
    size_t used = 0;

    for (size_t i = 0; i < p.n * p.dim && used < sizeof text - 40; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%.17g",
                                 i % p.dim == 0 ? "\n  " : " ", p.x[i]);
    ck_abort_msg("%s: method %d, got [%.17g, %.17g], KOKSMA_TEST_SEED=%llu, set "
                 "%llu, n %zu, dim %zu:%s",
                 what, (int)a->r.method, a->r.value.lower, a->r.value.upper,
                 (unsigned long long)oracle_seed(), (unsigned long long)round, p.n,
                 p.dim, text);
}

static answer solve(koksma_points p, koksma_box_opts opts)
{
    answer a = {0};
    koksma_error err = {0};
    koksma_status status;

    a.r.witness.corners = a.corners;
    status = koksma_box_discrepancy(&a.r, p, &opts, &err);
    ck_assert_msg(status == KOKSMA_OK, "status %d: %s", (int)status, err.text);
    a.r.witness.corners = NULL; /* an answer may move */
    return a;
}

static answer solve_by(koksma_points p, koksma_box_method method)
{
    answer a = solve(p, (koksma_box_opts){.method = method, .threads = 1});

    ck_assert_msg(a.r.method == method, "another method ran");
    return a;
}

/* What must hold of any answer, and what a recount of its witness must show. */
static const char *recount_fault(const answer *a, koksma_points p,
                                 koksma_interval *again)
{
    double corners[2 * DIMS];
    koksma_box_witness w = a->r.witness;

    memcpy(corners, a->corners, sizeof corners);
    w.corners = corners;
    *again = koksma_box_between(&w, p);
    for (size_t k = 0; k < p.dim; k++)
        if (!(corners[k] <= corners[p.dim + k])) return "a crossed box";
    if (w.inside != oracle_count_between(p, corners, w.closed))
        return "witness count";
    if (!(again->lower >= a->r.value.lower)) return "recount below value.lower";
    if (!oracle_narrow(*again)) return "recount too wide";
    if (!(a->r.value.lower > 0.0 && a->r.value.upper <= 1.0)) return "not in (0,1]";
    if (!oracle_narrow(a->r.value)) return "more than two units wide";
    if (!(a->r.work >= 0.0 && a->r.work <= DBL_MAX)) return "work";
    return NULL;
}

/* And what its volume must show, where that fits the oracle's integers. */
static const char *fault(const answer *a, koksma_points p)
{
    koksma_interval again;
    const char *what = recount_fault(a, p, &again);
    oracle_ratio local = oracle_between(p, a->corners, a->r.witness.closed);

    if (what != NULL) return what;
    if (!oracle_at_least(local, a->r.value.lower)) return "witness below the value";
    if (!oracle_contains(again, local)) return "witness outside its recount";
    return NULL;
}

/* Where all is exact in doubles the witness is the least box that reaches E. */
static void check_answer(const answer *a, koksma_points p, uint64_t round,
                         oracle_ratio truth, const double *least)
{
    const char *what = fault(a, p);
    bool fits = (oracle_int)p.n <= ((oracle_int)1 << 53) >> truth.shift;

    if (what == NULL && !oracle_contains(a->r.value, truth)) what = "E not inside";
    if (what == NULL && fits)
        for (size_t k = 0; k < 2 * p.dim; k++)
            if (a->corners[k] != least[k]) what = "not the least box that ties";
    if (what != NULL) complain(what, p, round, a);
}

static void check_same(const answer *a, const answer *b, koksma_points p,
                       uint64_t round)
{
    if (a->r.value.lower != b->r.value.lower ||
        a->r.value.upper != b->r.value.upper ||
        memcmp(a->corners, b->corners, 2 * p.dim * sizeof *a->corners) != 0) {
        char text[200];

        snprintf(text, sizeof text, "another answer: [%.17g, %.17g]",
                 a->r.value.lower, a->r.value.upper);
        complain(text, p, round, b);
    }
}

/* D* <= E <= 2^dim D*. */
static void check_star(const answer *a, koksma_points p, uint64_t round)
{
    koksma_star_result star = {0};

    ck_assert_int_eq(koksma_star(&star, p, NULL, NULL), KOKSMA_OK);
    if (!(star.value.lower <= a->r.value.upper)) complain("below D*", p, round, a);
    if (!(a->r.value.lower <= ldexp(star.value.upper, (int)p.dim)))
        complain("above 2^dim D*", p, round, a);
}

static void check_set(koksma_points p, uint64_t round)
{
    double least[2 * DIMS];
    oracle_ratio truth = oracle_box(p, least);
    answer a = solve_by(p, KOKSMA_BOX_TREE);

    check_answer(&a, p, round, truth, least);
    check_star(&a, p, round);
    if (p.dim > 2) return;

    answer b = solve_by(p, KOKSMA_BOX_SWEEP);

    check_answer(&b, p, round, truth, least);
    check_same(&a, &b, p, round);
}

/* All ordered sets of n points with coordinates j/(levels-1). */
static void check_every_set(size_t levels, size_t n, size_t dim)
{
    double x[6];
    size_t sets = 1;

    for (size_t i = 0; i < n * dim; i++)
        sets *= levels;
    for (size_t code = 0; code < sets; code++) {
        size_t c = code;

        for (size_t i = 0; i < n * dim; i++, c /= levels)
            x[i] = (double)(c % levels) / (double)(levels - 1);
        check_set((koksma_points){x, n, dim}, code);
    }
}

START_TEST(every_small_set)
{
    for (size_t n = 1; n <= 4; n++)
        check_every_set(5, n, 1);
    check_every_set(5, 1, 2);
    check_every_set(5, 2, 2);
    check_every_set(3, 3, 2);
    check_every_set(3, 1, 3);
}
END_TEST

/* A third of the sets lie on a coarse grid with both ends, a third are on it or
 * next to it by units of the last bit, and a third anywhere. */
static double coordinate(test_set *s, unsigned bits)
{
    size_t kind = (size_t)(s->round % 3);
    double v = (double)oracle_below(&s->rng, 5) / 4.0;

    if (kind == 2 && bits <= 53) return oracle_dyadic(&s->rng, bits);
    if (kind == 2)
        return ldexp(oracle_dyadic(&s->rng, 53),
                     -(int)oracle_below(&s->rng, bits - 52));
    if (kind == 0 || oracle_below(&s->rng, 2) == 0) return v;

    double unit = ldexp((double)oracle_below(&s->rng, 4), -(int)bits);

    return v > 0.0 && oracle_below(&s->rng, 2) == 0 ? v - unit
                                                    : fmin(v + unit, 1.0);
}

static void make_set(test_set *s, size_t most, size_t dim, unsigned bits,
                     uint64_t round)
{
    s->rng = oracle_rng_start(oracle_seed(), round);
    s->round = round;
    s->p = (koksma_points){s->x, 1 + oracle_below(&s->rng, most), dim};
    for (size_t i = 0; i < s->p.n * dim; i++)
        s->x[i] = coordinate(s, bits);
    if (s->p.n > 1 && round / 3 % 2 == 0)
        memcpy(s->x, s->x + (s->p.n - 1) * dim, dim * sizeof *s->x);
}

/* With 56 bits a width need not be a double. */
static const struct shape {
    size_t dim, most, sets;
    unsigned bits;
} shapes[] = {
    {1, 20, 600, 53}, {1, 9, 600, 56}, {2, 7, 600, 50}, {2, 9, 300, 20},
    {2, 13, 20, 56},  {3, 3, 100, 30}, {3, 5, 12, 37},
};

START_TEST(random_sets)
{
    const struct shape *shape = &shapes[_i];
    static test_set s;

    for (uint64_t round = 0; round < shape->sets * oracle_scale(); round++) {
        make_set(&s, shape->most, shape->dim, shape->bits, round);
        check_set(s.p, round);
    }
}
END_TEST

START_TEST(any_box_is_recounted)
{
    static test_set s;

    for (uint64_t round = 0; round < 2000 * oracle_scale(); round++) {
        size_t dim = 1 + (size_t)(round % 3);
        double corners[2 * DIMS];
        koksma_box_witness w = {corners, SIZE_MAX, round % 2 == 1};
        koksma_interval v;

        unsigned bits = dim > 2 ? 37 : 56; /* 56: not every width is a double */

        make_set(&s, 9, dim, bits, round);
        for (size_t k = 0; k < dim; k++) {
            double u = coordinate(&s, bits), v2 = coordinate(&s, bits);

            corners[k] = fmin(u, v2);
            corners[dim + k] = fmax(u, v2);
        }
        v = koksma_box_between(&w, s.p);
        ck_assert(oracle_contains(v, oracle_between(s.p, corners, w.closed)));
        ck_assert(oracle_narrow(v) || v.upper - v.lower < 0x1p-100);
        ck_assert_uint_eq(w.inside, SIZE_MAX);
    }
}
END_TEST

/* ---- Sets too large for loops ------------------------------------------------ */

/* levels > 0: moved to a grid of so many steps, for ties in masses. */
static const struct source {
    const char *family;
    size_t dim, n, levels;
} sources[] = {
    {"halton", 2, 1000, 0}, {"random", 2, 1000, 0}, {"hammersley", 2, 200, 0},
    {"random", 2, 300, 16}, {"halton", 2, 200, 30}, {"grid", 2, 225, 0},
    {"centred", 2, 225, 0}, {"random", 2, 400, 3},  {"sobol", 2, 256, 0},
    {"random", 1, 3000, 0}, {"centred", 1, 100, 0}, {"random", 1, 900, 40},
    {"halton", 3, 50, 0},   {"random", 3, 100, 0},  {"random", 3, 100, 4},
    {"grid", 3, 27, 0},     {"random", 4, 40, 0},   {"random", 5, 20, 0},
};

enum { SOURCES = sizeof sources / sizeof sources[0], PLANE = 12 };

static koksma_points points_of(const struct source *s)
{
    static double x[NUMBERS];
    koksma_gen_opts o = {.dim = s->dim, .n = s->n, .seed = oracle_seed()};
    koksma_gen *g;

    ck_assert_uint_le(s->n * s->dim, NUMBERS);
    ck_assert_int_eq(koksma_gen_open(&g, koksma_gen_find(s->family), &o, NULL),
                     KOKSMA_OK);
    ck_assert_int_eq(koksma_gen_fill(g, x, 0, s->n, NULL), KOKSMA_OK);
    koksma_gen_close(g);
    for (size_t i = 0; s->levels > 0 && i < s->n * s->dim; i++)
        x[i] = round(x[i] * (double)s->levels) / (double)s->levels;
    return (koksma_points){x, s->n, s->dim};
}

START_TEST(sweep_and_tree_agree)
{
    koksma_points p = points_of(&sources[_i]);
    answer a = solve_by(p, KOKSMA_BOX_SWEEP), b = solve_by(p, KOKSMA_BOX_TREE);

    check_same(&a, &b, p, 0);
    check_star(&a, p, 0);
}
END_TEST

static const struct source larger[] = {
    {"random", 2, 10000, 0},  {"halton", 2, 3000, 0}, {"hammersley", 2, 4096, 0},
    {"random", 2, 3000, 100}, {"grid", 2, 4096, 0},
};

enum { LARGER = sizeof larger / sizeof larger[0] };

/* By as many threads as there are processors, which makes no difference. */
START_TEST(methods_agree_on_larger_sets)
{
    koksma_points p = points_of(&larger[_i]);
    answer a = solve(p, (koksma_box_opts){.method = KOKSMA_BOX_SWEEP});
    answer b = solve(p, (koksma_box_opts){.method = KOKSMA_BOX_TREE});
    koksma_interval again;
    const char *what = recount_fault(&a, p, &again);

    ck_assert(a.r.method == KOKSMA_BOX_SWEEP && b.r.method == KOKSMA_BOX_TREE);
    if (what != NULL) complain(what, p, 0, &a);
    check_same(&a, &b, p, 0);
    check_star(&a, p, 0);
}
END_TEST

START_TEST(same_bits_for_any_threads)
{
    koksma_points p = points_of(&sources[_i]);
    int last = p.dim > 2 ? KOKSMA_BOX_TREE : KOKSMA_BOX_SWEEP;

    for (int m = KOKSMA_BOX_TREE; m >= last; m--) {
        koksma_box_opts opts = {.method = (koksma_box_method)m, .threads = 1};
        answer one = solve(p, opts), more;

        check_star(&one, p, 0);
        for (size_t threads = 2; threads <= 5; threads += 3) {
            opts.threads = threads;
            more = solve(p, opts);
            check_same(&one, &more, p, threads);
        }
    }
}
END_TEST

/* Parts: the greatest of their ends are those of the whole. */
START_TEST(parts_make_the_whole)
{
    koksma_points p = points_of(&sources[_i]);
    answer whole = solve(p, (koksma_box_opts){.threads = 1});
    koksma_interval v = {0.0, 0.0};

    for (size_t part = 1; part <= 3; part++) {
        answer a =
            solve(p, (koksma_box_opts){.threads = 1, .part = part, .parts = 3});

        v.lower = fmax(v.lower, a.r.value.lower);
        v.upper = fmax(v.upper, a.r.value.upper);
    }
    ck_assert_msg(v.lower == whole.r.value.lower && v.upper == whole.r.value.upper,
                  "%s, dim %zu: [%.17g, %.17g] but [%.17g, %.17g]",
                  sources[_i].family, p.dim, v.lower, v.upper, whole.r.value.lower,
                  whole.r.value.upper);
}
END_TEST

START_TEST(tolerance_is_kept)
{
    koksma_points p = points_of(&sources[_i]);
    answer exact = solve(p, (koksma_box_opts){.threads = 1});
    int last = p.dim > 2 ? KOKSMA_BOX_TREE : KOKSMA_BOX_SWEEP;

    for (int m = KOKSMA_BOX_TREE; m >= last; m--) {
        koksma_box_opts opts = {.method = (koksma_box_method)m,
                                .threads = 1,
                                .tolerance = 0.2,
                                .anytime = true};
        answer a = solve(p, opts);

        ck_assert(a.r.value.lower <= exact.r.value.upper);
        ck_assert(a.r.value.upper >= exact.r.value.lower);
        ck_assert(a.r.value.upper <= 1.2 * a.r.value.lower * (1.0 + 1e-9));
    }
}
END_TEST

static int stop_at_once(void *state, double lower, double upper, double work)
{
    size_t *calls = state;

    ck_assert(lower >= 0.0 && lower <= upper && upper <= 1.0 && work >= 0.0);
    return ++*calls >= 3;
}

START_TEST(stopped_is_true_but_wider)
{
    koksma_points p = points_of(&sources[_i]);
    answer exact = solve(p, (koksma_box_opts){.threads = 1});
    int last = p.dim > 2 ? KOKSMA_BOX_TREE : KOKSMA_BOX_SWEEP;

    for (int m = KOKSMA_BOX_SEARCH; m >= last; m--) {
        size_t calls = 0;
        koksma_box_opts opts = {.method = (koksma_box_method)m,
                                .threads = 1,
                                .progress = stop_at_once,
                                .state = &calls,
                                .work = 1000.0};
        koksma_box_result r = {0};
        koksma_status status = koksma_box_discrepancy(&r, p, &opts, NULL);

        ck_assert(status == KOKSMA_OK || status == KOKSMA_STOPPED);
        ck_assert(r.value.lower <= exact.r.value.upper);
        ck_assert(r.value.upper >= exact.r.value.lower);
    }
}
END_TEST

/* Many points take long before there is a method at all: that can be stopped. */
START_TEST(the_choice_can_be_stopped)
{
    const struct source many = {"halton", 2, 6000, 0};
    koksma_points p = points_of(&many);

    for (int m = KOKSMA_BOX_AUTO; m <= KOKSMA_BOX_TREE; m++) {
        size_t calls = 2;
        koksma_box_opts opts = {.method = (koksma_box_method)m,
                                .progress = stop_at_once,
                                .state = &calls};
        koksma_box_result r = {0};

        ck_assert_int_eq(koksma_box_discrepancy(&r, p, &opts, NULL),
                         KOKSMA_STOPPED);
        ck_assert_uint_eq(calls, 3);
        ck_assert_int_eq(r.method, KOKSMA_BOX_SEARCH);
        ck_assert(r.value.lower > 0.0 && r.value.upper == 1.0 && r.work > 0.0);
    }
}
END_TEST

START_TEST(search_finds_boxes_that_are_there)
{
    koksma_points p = points_of(&sources[_i]);
    koksma_box_opts opts = {.method = KOKSMA_BOX_SEARCH, .seed = 7};
    answer exact = solve(p, (koksma_box_opts){.threads = 1}), found;

    found = solve(p, opts);
    ck_assert(found.r.value.upper == 1.0);
    ck_assert(found.r.value.lower <= exact.r.value.upper);
    ck_assert(found.r.value.lower >= 0.9 * exact.r.value.lower);
}
END_TEST

/* ---- Sets where E is known --------------------------------------------------- */

static void check_known(const double *x, size_t n, size_t dim, double value)
{
    koksma_points p = {x, n, dim};
    int last = dim > 2 ? KOKSMA_BOX_TREE : KOKSMA_BOX_SWEEP;

    for (int m = KOKSMA_BOX_TREE; m >= last; m--) {
        answer a = solve_by(p, (koksma_box_method)m);

        ck_assert_msg(a.r.value.lower <= value && value <= a.r.value.upper,
                      "method %d, n %zu, dim %zu: %.17g in [%.17g, %.17g]", m, n,
                      dim, value, a.r.value.lower, a.r.value.upper);
    }
}

START_TEST(known_values)
{
    double x[4 * 100], grid[2 * 16];

    for (size_t dim = 1; dim <= 4; dim++)
        for (int v = 0; v <= 2; v++) {
            for (size_t i = 0; i < 400; i++)
                x[i] = v / 2.0;
            check_known(x, 1, dim, 1.0); /* the closed box that is the point */
            check_known(x, 100, dim, 1.0);
        }
    /* On the line, (2i-1)/(2n): 1/n, by each point. */
    for (size_t i = 0; i < 64; i++)
        x[i] = (2.0 * (double)i + 1.0) / 128.0;
    check_known(x, 64, 1, 1.0 / 64.0);
    /* The centres of a 4 by 4 grid: [1/8,7/8]^2 holds all, 1 - 9/16; the strip
     * between two columns is less. */
    for (size_t i = 0; i < 16; i++) {
        grid[2 * i] = (2.0 * (double)(i / 4) + 1.0) / 8.0;
        grid[2 * i + 1] = (2.0 * (double)(i % 4) + 1.0) / 8.0;
    }
    check_known(grid, 16, 2, 7.0 / 16.0);
    /* Both points are in the closed box [0,0] x [0,1]. */
    check_known((double[]){0.0, 0.0, 0.0, 1.0}, 2, 2, 1.0);
    /* A point at a corner of the square is on the face of the open box. */
    check_known((double[]){0.0, 0.0, 1.0, 1.0}, 2, 2, 1.0);
}
END_TEST

START_TEST(refusals)
{
    double x[] = {0.5, 0.5, 0.5};
    koksma_points p = {x, 1, 3};
    koksma_box_result r = {0};
    koksma_error err;
    koksma_box_opts bad[] = {
        {.method = (koksma_box_method)9},
        {.method = KOKSMA_BOX_SWEEP},
        {.tolerance = -1.0},
        {.work = -1.0},
        {.part = 3, .parts = 2},
        {.part = 0, .parts = 2},
        {.method = KOKSMA_BOX_SEARCH, .part = 1, .parts = 2},
        {.tolerance = (double)NAN},
    };

    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        ck_assert_int_eq(koksma_box_discrepancy(&r, p, &bad[i], &err),
                         KOKSMA_EINVAL);
    x[1] = 1.5;
    ck_assert_int_eq(koksma_box_discrepancy(&r, p, NULL, &err), KOKSMA_EDOMAIN);
    ck_assert_str_eq(err.text, "coordinate 2 of point 1 is 1.5, not in [0,1]");
    ck_assert(r.value.lower == 0.0 && r.value.upper == 0.0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("box");
    TCase *small = tcase_create("small"), *large = tcase_create("large");
    TCase *big = tcase_create("big");

    tcase_add_test(small, every_small_set);
    tcase_add_loop_test(small, random_sets, 0, sizeof shapes / sizeof shapes[0]);
    tcase_add_test(small, any_box_is_recounted);
    tcase_add_test(small, known_values);
    tcase_add_test(small, refusals);
    tcase_add_loop_test(large, sweep_and_tree_agree, 0, PLANE);
    tcase_add_loop_test(large, same_bits_for_any_threads, 2, SOURCES);
    tcase_add_loop_test(large, parts_make_the_whole, 2, SOURCES);
    tcase_add_loop_test(large, tolerance_is_kept, 2, SOURCES);
    tcase_add_loop_test(large, stopped_is_true_but_wider, 2, SOURCES);
    tcase_add_test(large, the_choice_can_be_stopped);
    tcase_add_loop_test(large, search_finds_boxes_that_are_there, 2, SOURCES);
    tcase_set_timeout(small, 600);
    tcase_set_timeout(large, 600);
    suite_add_tcase(suite, small);
    suite_add_tcase(suite, large);
    tcase_add_loop_test(big, methods_agree_on_larger_sets, 0, LARGER);
    tcase_set_tags(big, "big");
    tcase_set_timeout(big, 600);
    suite_add_tcase(suite, big);
    return oracle_run(suite);
}
