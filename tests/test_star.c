/* koksma_star and koksma_box_local against the definition (oracle.h), formulas for
 * sets where one is known, and properties of D* for sets too large for loops. */
#include <check.h>
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "oracle.h"
#include "star.h"

/* The largest dim of any set here and the most numbers in one. */
enum { DIMS = 24, NUMBERS = 12000 };

/* A set that a seed and a round number make again. */
typedef struct test_set {
    double x[NUMBERS];
    koksma_points p;
    oracle_rng rng;
    uint64_t round;
} test_set;

typedef struct answer {
    koksma_star_result r;
    double corner[DIMS];
} answer;

/* Fails with all that it takes to see the case again. */
static void complain(const char *what, koksma_points p, uint64_t round,
                     koksma_interval got)
{
    char text[1200] = "";
    size_t used = 0;

    for (size_t i = 0; i < p.n * p.dim && used < sizeof text - 40; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%.17g",
                                 i % p.dim == 0 ? "\n  " : " ", p.x[i]);
    ck_abort_msg("%s: got [%.17g, %.17g], KOKSMA_TEST_SEED=%llu, set %llu, "
                 "n %zu, dim %zu:%s",
                 what, got.lower, got.upper, (unsigned long long)oracle_seed(),
                 (unsigned long long)round, p.n, p.dim, text);
}

static void solve_by(answer *a, koksma_points p, koksma_star_method method)
{
    koksma_star_opts opts = {.method = method};
    koksma_error err = {0};

    memset(a, 0, sizeof *a);
    a->r.witness.corner = a->corner;

    koksma_status status = koksma_star(&a->r, p, &opts, &err);

    ck_assert_msg(status == KOKSMA_OK, "status %d: %s", (int)status, err.text);
    ck_assert_msg(a->r.witness.corner == a->corner, "the corner's room has moved");
    ck_assert_msg(a->r.method == method, "another method ran");
}

/* Another method must say the same as a, to the last bit.  (Where an open and a
 * closed box tie at one corner, they may differ in the kind.) */
static void agree(const answer *a, koksma_points p, koksma_star_method method,
                  const char *name)
{
    static answer b;

    solve_by(&b, p, method);
    ck_assert_msg(
        a->r.value.lower == b.r.value.lower && a->r.value.upper == b.r.value.upper,
        "n %zu dim %zu: sweep [%.17g, %.17g], %s [%.17g, %.17g]", p.n, p.dim,
        a->r.value.lower, a->r.value.upper, name, b.r.value.lower, b.r.value.upper);
    for (size_t k = 0; k < p.dim; k++)
        ck_assert_msg(a->corner[k] == b.corner[k],
                      "n %zu dim %zu: sweep and %s part along axis %zu: %a, %a",
                      p.n, p.dim, name, k, a->corner[k], b.corner[k]);
    ck_assert(koksma_box_local(&b.r.witness, p).lower >= b.r.value.lower);
}

/* The one method is held against the definition, and the others against it. */
static void solve(answer *a, koksma_points p)
{
    solve_by(a, p, KOKSMA_STAR_SWEEP);
    agree(a, p, KOKSMA_STAR_TREE, "tree");
    agree(a, p, KOKSMA_STAR_DEM, "dem");
}

/* What a recount of any witness must show, finished or not.  It proves
 * value.lower <= D*, for no box has a larger local discrepancy than D*. */
static const char *witness_fault(const koksma_star_result *r, koksma_points p)
{
    const koksma_box *w = &r->witness;
    oracle_ratio local = oracle_local(p, w->corner, w->closed);
    koksma_interval again = koksma_box_local(w, p);

    if (w->inside != oracle_count(p, w->corner, w->closed)) return "witness count";
    if (!oracle_at_least(local, r->value.lower)) return "witness below value.lower";
    if (!oracle_contains(again, local)) return "witness outside koksma_box_local";
    if (!(again.lower >= r->value.lower)) return "recount below value.lower";
    if (!oracle_narrow(again)) return "koksma_box_local too wide";
    return NULL;
}

/* What must hold of every finished result, besides containing D*. */
static const char *result_fault(const koksma_star_result *r, koksma_points p)
{
    if (!(r->value.lower >= 0.0 && r->value.upper <= 1.0)) return "not in [0,1]";
    if (!oracle_narrow(r->value)) return "more than two units wide";
    if (!(r->value.upper >= 1.0 / (2.0 * (double)p.n))) return "below 1/(2n)";
    if (!(r->work >= 1.0 && r->work <= DBL_MAX)) return "work";
    return witness_fault(r, p);
}

static int compare_corners(const double *a, const double *b, size_t dim)
{
    for (size_t k = 0; k < dim; k++)
        if (a[k] != b[k]) return a[k] < b[k] ? -1 : 1;
    return 0;
}

/* Which of the boxes that share the value is the witness?  Where n * vol fits a
 * double, exactly the least corner that reaches D*.  Where it does not, a lesser
 * corner that stays below D* by less than the interval can tell also ties. */
static const char *tie_fault(const answer *a, koksma_points p, oracle_ratio truth,
                             const double *least)
{
    bool reaches =
        oracle_equal(truth, oracle_local(p, a->corner, a->r.witness.closed));
    bool fits = (oracle_int)p.n <= ((oracle_int)1 << 53) >> truth.shift;

    if (!reaches && fits) return "the witness does not reach D*";
    if (least == NULL) return NULL;

    int order = compare_corners(a->corner, least, p.dim);

    return order == 0 || (!reaches && order < 0) ? NULL : "not the least that ties";
}

/* truth is D*; least is the least corner that reaches it, or NULL where no formula
 * says so. */
static void check_value(koksma_points p, uint64_t round, oracle_ratio truth,
                        const double *least)
{
    answer a;

    solve(&a, p);

    const char *what = result_fault(&a.r, p);

    if (what == NULL && !oracle_contains(a.r.value, truth)) what = "D* not inside";
    if (what == NULL) what = tie_fault(&a, p, truth, least);
    if (what != NULL) complain(what, p, round, a.r.value);
}

static void check_set(koksma_points p, uint64_t round)
{
    double least[DIMS];
    oracle_ratio truth = oracle_star(p, least);

    check_value(p, round, truth, least);
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

START_TEST(every_set_on_a_line)
{
    for (size_t n = 1; n <= 5; n++)
        check_every_set(5, n, 1);
}
END_TEST

START_TEST(every_set_in_the_square)
{
    for (size_t n = 1; n <= 3; n++)
        check_every_set(5, n, 2);
}
END_TEST

START_TEST(every_set_in_the_cube)
{
    for (size_t n = 1; n <= 2; n++)
        check_every_set(3, n, 3);
}
END_TEST

/* A third of the sets lie on a coarse grid with both ends, so that ties, repeats
 * and points on faces abound; a third are on it, next to it by a few units of the
 * last bit, so that values nearly tie, or both; and a third are anywhere. */
static double coordinate(test_set *s, unsigned bits)
{
    static const size_t choices[][3] = {{0, 0, 0}, {0, 1, 2}, {2, 2, 2},
                                        {0, 0, 0}, {0, 1, 1}, {2, 2, 2}};
    size_t kind = choices[s->round % 6][oracle_below(&s->rng, 3)];

    if (kind == 2) return oracle_dyadic(&s->rng, bits);

    double v = (double)oracle_below(&s->rng, 5) / 4.0;

    if (kind == 0) return v;

    double unit = ldexp((double)oracle_below(&s->rng, 4), -(int)bits);

    return v > 0.0 && oracle_below(&s->rng, 2) == 0 ? v - unit
                                                    : fmin(v + unit, 1.0);
}

static void make_set(test_set *s, size_t n, size_t dim, unsigned bits,
                     uint64_t round)
{
    s->rng = oracle_rng_start(oracle_seed(), round);
    s->round = round;
    s->p = (koksma_points){s->x, n, dim};
    for (size_t i = 0; i < n * dim; i++)
        s->x[i] = coordinate(s, bits);
    if (n > 1 && round / 6 % 2 == 0) /* a repeat in sets of every kind */
        memcpy(s->x, s->x + (n - 1) * dim, dim * sizeof *s->x);
}

/* Sets by dim: as many as a share of a second allows.  The bits are as many as the
 * oracle can take, so that products of coordinates need more than a double has. */
static const struct shape {
    size_t dim, most, sets;
    unsigned bits;
} shapes[] = {
    {1, 40, 600, 53}, {2, 14, 600, 53}, {2, 40, 12, 30}, {3, 7, 300, 37},
    {3, 13, 9, 20},   {4, 5, 150, 28},  {5, 4, 60, 22},  {6, 3, 30, 19},
};

START_TEST(random_sets)
{
    const struct shape *shape = &shapes[_i];
    static test_set s;

    for (uint64_t round = 0; round < shape->sets * oracle_scale(); round++) {
        make_set(&s, 1, shape->dim, shape->bits, round);

        size_t n = 1 + oracle_below(&s.rng, shape->most);

        make_set(&s, n, shape->dim, shape->bits, round);
        check_set(s.p, round);
    }
}
END_TEST

/* Any box, not only witnesses: corners on the points' grid, off it, on 0, 1. */
START_TEST(any_box_is_recounted)
{
    static test_set s;
    double corner[DIMS];

    for (uint64_t round = 0; round < 3000 * oracle_scale(); round++) {
        size_t dim = 1 + (size_t)(round % 5);

        make_set(&s, 1 + (size_t)(round / 5 % 7), dim, 20, round);
        for (size_t k = 0; k < dim; k++)
            corner[k] = coordinate(&s, 20);

        koksma_box box = {corner, SIZE_MAX, oracle_below(&s.rng, 2) == 1};
        koksma_interval v = koksma_box_local(&box, s.p);

        if (!oracle_contains(v, oracle_local(s.p, corner, box.closed)))
            complain("local discrepancy not inside", s.p, round, v);
        if (!oracle_narrow(v)) complain("local too wide", s.p, round, v);
        ck_assert_uint_eq(box.inside, SIZE_MAX);
    }
}
END_TEST

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;

    return (x > y) - (x < y);
}

/* On a line D* is the largest of i/n - x_i and x_i - (i-1)/n over the sorted points
 * [Niederreiter 1992, thm 2.6]. */
static oracle_ratio line_formula(const double *sorted, size_t n, unsigned bits)
{
    oracle_ratio r = {0, n, bits};
    oracle_int one = (oracle_int)1 << bits;

    for (size_t i = 0; i < n; i++) {
        oracle_int x = (oracle_int)ldexp(sorted[i], (int)bits) * (oracle_int)n;
        oracle_int over = ((oracle_int)i + 1) * one - x,
                   under = x - (oracle_int)i * one;

        if (over > r.num) r.num = over;
        if (under > r.num) r.num = under;
    }
    return r;
}

START_TEST(many_points_on_a_line)
{
    static test_set s;
    static double sorted[NUMBERS];

    for (uint64_t round = 0; round < 12 * oracle_scale(); round++) {
        make_set(&s, 1000 + (size_t)round % 24, 1, 53, round);
        memcpy(sorted, s.x, s.p.n * sizeof *sorted);
        qsort(sorted, s.p.n, sizeof *sorted, ascending);
        check_value(s.p, round, line_formula(sorted, s.p.n, 53), NULL);
    }
}
END_TEST

/* The best set on a line, (2i-1)/(2n): every point is a tie of both kinds. */
START_TEST(centred_points_on_a_line)
{
    double x[1024];

    for (unsigned b = 0; b <= 10; b++) {
        size_t n = (size_t)1 << b;

        for (size_t i = 0; i < n; i++)
            x[i] = (2.0 * (double)i + 1.0) / (2.0 * (double)n);
        check_value((koksma_points){x, n, 1}, b,
                    (oracle_ratio){(oracle_int)n, n, b + 1}, NULL);
    }
}
END_TEST

/* The point (c,..,c) has D* = max(c, 1 - c^dim): the empty box that ends at c on
 * one axis, or the closed box that ends at the point. */
START_TEST(one_point)
{
    double x[8];

    for (size_t dim = 1; dim <= 8; dim++)
        for (int j = 0; j <= 8; j++) {
            unsigned shift = 3 * (unsigned)dim;
            oracle_int one = (oracle_int)1 << shift, vol = 1;

            for (size_t k = 0; k < dim; k++) {
                x[k] = j / 8.0;
                vol *= j;
            }

            oracle_int open = one / 8 * j, closed = one - vol;
            oracle_ratio truth = {open > closed ? open : closed, 1, shift};

            check_value((koksma_points){x, 1, dim}, (uint64_t)j, truth, NULL);
        }
}
END_TEST

/* A coordinate that is 0 throughout, or 1: a closed box of no volume holds all
 * points, or the open unit box none. */
START_TEST(points_on_a_face)
{
    static const double pair[] = {0.0, 0.0, 0.0, 1.0};
    static test_set s;

    check_value((koksma_points){pair, 2, 2}, 0, (oracle_ratio){2, 2, 0}, NULL);
    for (uint64_t round = 0; round < 60; round++) {
        size_t dim = 1 + (size_t)(round % 5), n = 1 + (size_t)(round % 7);

        make_set(&s, n, dim, 20, round);
        for (size_t i = 0; i < n; i++)
            s.x[i * dim + dim / 2] = (double)(round / 30);
        check_value(s.p, round, (oracle_ratio){(oracle_int)n, n, 0}, NULL);
    }
}
END_TEST

/* The point (c,..,c) for c so small that its volume is lost beside 1, or vanishes:
 * D* is below 1, and an interval that starts at 1 would not contain it. */
START_TEST(volumes_too_small_for_doubles)
{
    static const double tiny[] = {0.001,    0x1p-54, 1e-20,
                                  0x1p-540, DBL_MIN, 0x1p-1074};
    double x[DIMS];

    for (size_t i = 0; i < sizeof tiny / sizeof *tiny; i++)
        for (size_t dim = 1; dim <= DIMS; dim++) {
            koksma_points p = {x, 1, dim};
            answer a;

            if (pow(tiny[i], (double)dim) > 0x1p-54) continue;
            for (size_t k = 0; k < dim; k++)
                x[k] = tiny[i];
            solve(&a, p);
            if (!(a.r.value.lower < 1.0 && a.r.value.upper == 1.0 &&
                  oracle_narrow(a.r.value)))
                complain("just below 1", p, dim, a.r.value);
            ck_assert_uint_eq(a.r.witness.inside, 1);
            ck_assert(a.r.witness.closed);
            ck_assert_double_ge(koksma_box_local(&a.r.witness, p).lower,
                                a.r.value.lower);
            ck_assert_double_lt(koksma_box_local(&a.r.witness, p).lower, 1.0);
            for (size_t k = 0; k < dim; k++)
                ck_assert_double_eq(a.corner[k], tiny[i]);
        }
}
END_TEST

/* dim points, the k-th with 1-u on axis k and 0 on the others, u = 2^-53: the open
 * box that ends at 1-u on every axis holds none of them and has volume (1-u)^dim,
 * which lies between 1 - dim*u and the next double. */
START_TEST(volumes_just_below_one)
{
    for (size_t dim = 1; dim <= 6; dim++) {
        const double u = 0x1p-53, d = (double)dim;
        double x[36] = {0.0};
        koksma_points p = {x, dim, dim};
        answer a;

        for (size_t k = 0; k < dim; k++)
            x[k * dim + k] = 1.0 - u;
        solve(&a, p);
        if (!(a.r.value.lower <= 1.0 - d * u && oracle_narrow(a.r.value) &&
              a.r.value.upper >= 1.0 - (dim == 1 ? d : d - 1.0) * u))
            complain("(1-u)^dim not inside", p, dim, a.r.value);
        ck_assert_uint_eq(a.r.witness.inside, 0);
        ck_assert(!a.r.witness.closed);
        if (dim <= 2) check_set(p, dim);
    }
}
END_TEST

/* -0 is 0 in every way that counts. */
START_TEST(negative_zero)
{
    static const double minus[] = {-0.0, 0.5, 0.75, -0.0, -0.0, 1.0};
    static const double plus[] = {0.0, 0.5, 0.75, 0.0, 0.0, 1.0};
    answer a, b;

    for (size_t dim = 1; dim <= 3; dim++) {
        solve(&a, (koksma_points){minus, 6 / dim, dim});
        solve(&b, (koksma_points){plus, 6 / dim, dim});
        ck_assert_double_eq(a.r.value.lower, b.r.value.lower);
        ck_assert_double_eq(a.r.value.upper, b.r.value.upper);
        check_set((koksma_points){minus, 6 / dim, dim}, dim);
    }
}
END_TEST

/* Sets for the properties, too large for the oracle. */
static void make_large(test_set *s, uint64_t round)
{
    static const size_t most[] = {300, 120, 30, 14, 9};
    size_t dim = 1 + (size_t)(round % 5);

    make_set(s, most[dim - 1] - (size_t)(round / 5 % 5), dim, 20, round);
}

static bool overlap(koksma_interval a, koksma_interval b)
{
    return a.lower <= b.upper && b.lower <= a.upper;
}

static void checked_solve(answer *a, const test_set *s)
{
    solve(a, s->p);

    const char *what = result_fault(&a->r, s->p);

    if (what != NULL) complain(what, s->p, s->round, a->r.value);
}

static void swap(double *a, double *b)
{
    double keep = *a;

    *a = *b;
    *b = keep;
}

START_TEST(order_of_points_is_nothing)
{
    static test_set s;
    answer a, b;

    for (uint64_t round = 0; round < 40 * oracle_scale(); round++) {
        make_large(&s, round);
        checked_solve(&a, &s);
        for (size_t i = s.p.n; i > 1; i--) {
            size_t j = oracle_below(&s.rng, i);

            for (size_t k = 0; k < s.p.dim; k++)
                swap(&s.x[(i - 1) * s.p.dim + k], &s.x[j * s.p.dim + k]);
        }
        checked_solve(&b, &s);
        if (!overlap(a.r.value, b.r.value) ||
            compare_corners(a.corner, b.corner, s.p.dim) != 0)
            complain("points permuted", s.p, round, b.r.value);
    }
}
END_TEST

START_TEST(order_of_axes_is_nothing)
{
    static test_set s;
    answer a, b;

    for (uint64_t round = 0; round < 40 * oracle_scale(); round++) {
        make_large(&s, round);
        checked_solve(&a, &s);
        for (size_t k = s.p.dim; k > 1; k--) {
            size_t j = oracle_below(&s.rng, k);

            for (size_t i = 0; i < s.p.n; i++)
                swap(&s.x[i * s.p.dim + k - 1], &s.x[i * s.p.dim + j]);
        }
        checked_solve(&b, &s);
        if (!overlap(a.r.value, b.r.value))
            complain("axes permuted", s.p, round, b.r.value);
    }
}
END_TEST

START_TEST(every_point_twice)
{
    static test_set s;
    answer a, b;

    for (uint64_t round = 0; round < 40 * oracle_scale(); round++) {
        make_large(&s, round);
        s.p.n /= 2;
        checked_solve(&a, &s);
        memcpy(s.x + s.p.n * s.p.dim, s.x, s.p.n * s.p.dim * sizeof *s.x);
        s.p.n *= 2;
        checked_solve(&b, &s);
        if (!overlap(a.r.value, b.r.value) ||
            compare_corners(a.corner, b.corner, s.p.dim) != 0)
            complain("points repeated", s.p, round, b.r.value);
    }
}
END_TEST

/* The last point added moves every share by at most 1/n, so D* too.  The sum and
 * the quotient here round, by less than the slack. */
START_TEST(one_point_more)
{
    static test_set s;
    answer a, b;

    for (uint64_t round = 0; round < 40 * oracle_scale(); round++) {
        make_large(&s, round);
        checked_solve(&b, &s);

        double step = 1.0 / (double)s.p.n + 2.0 * DBL_EPSILON;

        s.p.n--;
        checked_solve(&a, &s);
        if (b.r.value.lower > a.r.value.upper + step ||
            a.r.value.lower > b.r.value.upper + step)
            complain("one point more", s.p, round, a.r.value);
    }
}
END_TEST

/* Boxes that reach 1 on the last axis see the other axes alone, but for the points
 * that lie at 1 there, which open boxes miss: D* can only fall. */
START_TEST(one_axis_less)
{
    static test_set s;
    answer a, b;

    for (uint64_t round = 0; round < 40 * oracle_scale(); round++) {
        make_large(&s, round);
        if (s.p.dim == 1) continue;
        checked_solve(&a, &s);

        size_t less = s.p.dim - 1;

        for (size_t i = 0; i < s.p.n; i++)
            memmove(s.x + i * less, s.x + i * s.p.dim, less * sizeof *s.x);
        s.p.dim = less;
        checked_solve(&b, &s);
        if (b.r.value.lower > a.r.value.upper)
            complain("a projection has more", s.p, round, b.r.value);
    }
}
END_TEST

/* What the callback has seen, and the call at which it says stop (0: none). */
typedef struct watch {
    size_t calls, stop_at;
    double lower, work;
    bool fair;
} watch;

static int look(void *state, double lower, double upper, double work)
{
    watch *w = state;

    if (!(lower >= w->lower && lower <= upper && upper <= 1.0)) w->fair = false;
    if (!(work >= w->work)) w->fair = false;
    w->lower = lower;
    w->work = work;
    return ++w->calls == w->stop_at;
}

static const struct stop {
    koksma_star_method method;
    size_t n, dim;
    double work;
    size_t stop_at;
} stops[] = {
    {KOKSMA_STAR_SWEEP, 5000, 2, 0.0, 1}, {KOKSMA_STAR_SWEEP, 5000, 2, 0.0, 3},
    {KOKSMA_STAR_SWEEP, 5000, 2, 2e6, 0}, {KOKSMA_STAR_SWEEP, 5000, 2, 1.0, 0},
    {KOKSMA_STAR_SWEEP, 300, 4, 0.0, 1},  {KOKSMA_STAR_SWEEP, 300, 4, 0.0, 3},
    {KOKSMA_STAR_SWEEP, 300, 4, 2e6, 0},  {KOKSMA_STAR_SWEEP, 300, 4, 1.0, 0},
    {KOKSMA_STAR_DEM, 3000, 4, 0.0, 1},   {KOKSMA_STAR_DEM, 3000, 4, 0.0, 3},
    {KOKSMA_STAR_DEM, 3000, 4, 5e6, 0},   {KOKSMA_STAR_DEM, 3000, 4, 1.0, 0},
    {KOKSMA_STAR_TREE, 3000, 4, 0.0, 1},  {KOKSMA_STAR_TREE, 3000, 4, 0.0, 3},
    {KOKSMA_STAR_TREE, 3000, 4, 5e5, 0},  {KOKSMA_STAR_TREE, 3000, 4, 1.0, 0},
};

/* Stopped by the callback or by the work allowed: the witness proves what was found
 * and 1 is above everything.  Round 5 is of the sets that are anywhere. */
START_TEST(stopped_early)
{
    const struct stop *c = &stops[_i];
    static test_set s;
    watch seen = {0, c->stop_at, 0.0, 0.0, true};
    koksma_star_opts opts = {.method = c->method,
                             .threads = 1, /* whose work adds up */
                             .work = c->work,
                             .progress = c->stop_at > 0 ? look : NULL,
                             .state = &seen};
    koksma_error err = {0};
    answer a;

    make_set(&s, c->n, c->dim, 20, 5);
    memset(&a, 0, sizeof a);
    a.r.witness.corner = a.corner;
    ck_assert_int_eq(koksma_star(&a.r, s.p, &opts, &err), KOKSMA_STOPPED);
    ck_assert_int_eq(err.status, KOKSMA_STOPPED);
    ck_assert_uint_gt(strlen(err.text), 0);
    ck_assert(seen.fair);
    ck_assert_uint_eq(seen.calls, c->stop_at);

    const char *what = witness_fault(&a.r, s.p);

    if (!(a.r.value.lower >= 0.0 && a.r.value.upper == 1.0))
        what = "not [found, 1]";
    if (!(a.r.value.lower >= seen.lower)) what = "less than was found";
    if (c->work > 0.0 && a.r.work > c->work + 0x1p22) what = "too much work";
    if (what != NULL) complain(what, s.p, s.round, a.r.value);
}
END_TEST

/* With a tolerance the interval holds D* and is as narrow as asked; in stages, what
 * is reported on the way shrinks towards it. */
typedef struct stages {
    double lower, upper;
    size_t calls;
    bool shrinks;
} stages;

static int watch_stages(void *state, double lower, double upper, double work)
{
    stages *s = state;

    (void)work;
    if (!(lower >= s->lower && upper <= s->upper && lower <= upper))
        s->shrinks = false;
    s->lower = lower;
    s->upper = upper;
    s->calls++;
    return 0;
}

START_TEST(tolerance_is_kept)
{
    static const double tolerances[] = {0.0, 0.02, 0.3, 2.0};
    static test_set s;

    for (uint64_t round = 0; round < 12 * oracle_scale(); round++) {
        answer exact, a;

        make_set(&s, 100, 2 + round % 3, 20, round);
        solve_by(&exact, s.p, KOKSMA_STAR_TREE);
        for (int i = 0; i < 8; i++) {
            double tolerance = tolerances[i / 2];
            stages seen = {0.0, 1.0, 0, true};
            koksma_star_opts opts = {.method = KOKSMA_STAR_TREE,
                                     .tolerance = tolerance,
                                     .anytime = i % 2 == 1,
                                     .progress = watch_stages,
                                     .state = &seen};

            a.r.witness.corner = a.corner;
            ck_assert_int_eq(koksma_star(&a.r, s.p, &opts, NULL), KOKSMA_OK);
            ck_assert(a.r.value.lower <= exact.r.value.lower);
            ck_assert(a.r.value.upper >= exact.r.value.upper);
            ck_assert(tolerance > 0.0 ? a.r.value.upper <= (1.0 + tolerance) *
                                                               a.r.value.lower ||
                                            a.r.value.upper <= exact.r.value.upper
                                      : a.r.value.upper == exact.r.value.upper);
            ck_assert(witness_fault(&a.r, s.p) == NULL);
            ck_assert(seen.shrinks && a.r.value.upper <= seen.upper);
        }
    }
}
END_TEST

/* Stopped in stages: the bound of the last stage stands. */
START_TEST(stages_bound_early)
{
    static test_set s;
    koksma_star_opts opts = {
        .method = KOKSMA_STAR_TREE, .anytime = true, .threads = 1};
    answer a;

    make_set(&s, 3000, 4, 20, 5);
    memset(&a, 0, sizeof a);
    a.r.witness.corner = a.corner;
    ck_assert_int_eq(koksma_star(&a.r, s.p, &opts, NULL), KOKSMA_OK);
    opts.work = 0.5 * a.r.work;
    ck_assert_int_eq(koksma_star(&a.r, s.p, &opts, NULL), KOKSMA_STOPPED);
    ck_assert(a.r.value.upper < 1.0);
    ck_assert(a.r.value.upper <= 2.0 * a.r.value.lower);
    ck_assert(witness_fault(&a.r, s.p) == NULL);
}
END_TEST

/* What the proof in lib/star_bound.c takes from the mathematics library: log is
 * within 2^-51 of itself.  (Where long double is no longer, this says less.) */
START_TEST(logarithm_is_good_enough)
{
    oracle_rng rng = oracle_rng_start(oracle_seed(), 77);

    for (uint64_t i = 0; i < 100000 * oracle_scale(); i++) {
        double u = oracle_dyadic(&rng, 53), x = u;

        if (i % 4 == 1) x = 1.0 - u * 0x1p-30;
        if (i % 4 == 2) x = ldexp(u, -(int)(i % 1070));
        if (i % 4 == 3) x = u * u * u;
        if (x == 0.0) continue;

        long double exact = logl((long double)x);

        ck_assert_msg(fabsl((long double)log(x) - exact) <= 0x1p-51L * -exact,
                      "log(%a)", x);
    }
}
END_TEST

START_TEST(refused_options)
{
    static const double x[] = {0.5};
    koksma_star_opts bad[] = {{.work = -1.0},
                              {.work = (double)NAN},
                              {.tolerance = -1e-3},
                              {.tolerance = (double)NAN},
                              {.method = (koksma_star_method)99},
                              {.method = KOKSMA_STAR_SWEEP, .part = 1, .parts = 2},
                              {.method = KOKSMA_STAR_DEM, .part = 1, .parts = 2}};

    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        koksma_star_result r = {.witness.corner = NULL};
        koksma_error err = {0};

        ck_assert_int_eq(koksma_star(&r, (koksma_points){x, 1, 1}, &bad[i], &err),
                         KOKSMA_EINVAL);
        ck_assert_uint_gt(strlen(err.text), 0);
    }
}
END_TEST

/* Being watched changes nothing; nor do options that ask for what is the default,
 * nor not wanting the corner or the error. */
START_TEST(options_and_nulls)
{
    static test_set s;
    watch seen = {0, 0, 0.0, 0.0, true};
    koksma_star_opts watched = {
        .method = KOKSMA_STAR_SWEEP, .progress = look, .state = &seen};
    koksma_star_opts defaults = KOKSMA_STAR_DEFAULTS;
    koksma_star_result r = {.witness.corner = NULL};
    answer a;

    make_set(&s, 3000, 2, 20, 5);
    checked_solve(&a, &s);
    ck_assert_int_eq(koksma_star(&r, s.p, &watched, NULL), KOKSMA_OK);
    ck_assert(seen.fair);
    ck_assert_uint_ge(seen.calls, 1);
    ck_assert_double_le(seen.lower, a.r.value.upper);
    for (int i = 0; i < 2; i++) {
        ck_assert_ptr_null(r.witness.corner);
        ck_assert_double_eq(r.value.lower, a.r.value.lower);
        ck_assert_double_eq(r.value.upper, a.r.value.upper);
        ck_assert_uint_eq(r.witness.inside, a.r.witness.inside);
        ck_assert_int_eq(r.witness.closed, a.r.witness.closed);
        r = (koksma_star_result){.witness.corner = NULL};
        ck_assert_int_eq(koksma_star(&r, s.p, &defaults, NULL), KOKSMA_OK);
    }
}
END_TEST

/* A refusal names its reason and leaves every byte of the outputs alone. */
static void check_refused(koksma_points p, koksma_status want, const char *text)
{
    koksma_star_result out, before;
    double corner[3] = {7.0, 8.0, 9.0};
    koksma_error err = {0};

    memset(&out, 0x5a, sizeof out);
    out.witness.corner = corner;
    memcpy(&before, &out, sizeof out);
    ck_assert_int_eq(koksma_star(&out, p, NULL, &err), want);
    ck_assert_int_eq(err.status, want);
    ck_assert_uint_eq(err.line, 0);
    if (text != NULL)
        ck_assert_str_eq(err.text, text);
    else
        ck_assert_uint_gt(strlen(err.text), 0);
    ck_assert_int_eq(koksma_star(&out, p, NULL, NULL), want);
    ck_assert_mem_eq(&out, &before, sizeof out);
    ck_assert(corner[0] == 7.0 && corner[1] == 8.0 && corner[2] == 9.0);
}

START_TEST(refused_coordinates)
{
    static const struct {
        double v;
        const char *text;
    } bad[] = {
        {(double)NAN, "nan"},
        {-0.1, "-0.1"},
        {1.1, "1.1"},
        {1.5, "1.5"},
        {(double)INFINITY, "inf"},
        {-(double)INFINITY, "-inf"},
    };

    for (size_t dim = 1; dim <= 3; dim++)
        for (size_t at = 0; at < 6; at++) {
            double x[6] = {0.0, 1.0, 0.5, 0.5, 0.25, 0.75};
            char text[160];

            x[at] = bad[_i].v;
            snprintf(text, sizeof text,
                     "coordinate %zu of point %zu is %s, not in [0,1]",
                     at % dim + 1, at / dim + 1, bad[_i].text);
            check_refused((koksma_points){x, 6 / dim, dim}, KOKSMA_EDOMAIN, text);
        }
}
END_TEST

START_TEST(refused_sizes)
{
    static const double x[] = {0.5};

    check_refused((koksma_points){x, 0, 1}, KOKSMA_EINVAL, NULL);
    check_refused((koksma_points){x, 1, 0}, KOKSMA_EINVAL, NULL);
    check_refused((koksma_points){NULL, 1, 1}, KOKSMA_EINVAL, NULL);
    check_refused((koksma_points){x, SIZE_MAX, SIZE_MAX}, KOKSMA_EINVAL, NULL);
    check_refused((koksma_points){x, SIZE_MAX / 2 + 1, 2}, KOKSMA_EINVAL, NULL);
    check_refused((koksma_points){x, SIZE_MAX / 8 + 2, 1}, KOKSMA_EINVAL, NULL);
}
END_TEST

static TCase *tests_named(Suite *suite, const char *name)
{
    TCase *tc = tcase_create(name);

    tcase_set_timeout(tc, 20.0 * (double)oracle_scale());
    suite_add_tcase(suite, tc);
    return tc;
}

static Suite *star_suite(void)
{
    Suite *suite = suite_create("star");
    TCase *tc = tests_named(suite, "definition");

    tcase_add_test(tc, every_set_on_a_line);
    tcase_add_test(tc, every_set_in_the_square);
    tcase_add_test(tc, every_set_in_the_cube);
    tcase_add_loop_test(tc, random_sets, 0, sizeof shapes / sizeof *shapes);
    tcase_add_test(tc, any_box_is_recounted);

    tc = tests_named(suite, "formulas");
    tcase_add_test(tc, many_points_on_a_line);
    tcase_add_test(tc, centred_points_on_a_line);
    tcase_add_test(tc, one_point);
    tcase_add_test(tc, points_on_a_face);
    tcase_add_test(tc, volumes_too_small_for_doubles);
    tcase_add_test(tc, volumes_just_below_one);
    tcase_add_test(tc, negative_zero);

    tc = tests_named(suite, "properties");
    tcase_add_test(tc, order_of_points_is_nothing);
    tcase_add_test(tc, order_of_axes_is_nothing);
    tcase_add_test(tc, every_point_twice);
    tcase_add_test(tc, one_point_more);
    tcase_add_test(tc, one_axis_less);

    tc = tests_named(suite, "calls");
    tcase_add_loop_test(tc, stopped_early, 0, sizeof stops / sizeof *stops);
    tcase_add_test(tc, options_and_nulls);
    tcase_add_test(tc, tolerance_is_kept);
    tcase_add_test(tc, stages_bound_early);
    tcase_add_test(tc, refused_options);
    tcase_add_test(tc, logarithm_is_good_enough);
    tcase_add_loop_test(tc, refused_coordinates, 0, 6);
    tcase_add_test(tc, refused_sizes);
    return suite;
}

int main(void) { return oracle_run(star_suite()); }
