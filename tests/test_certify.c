/* Every measure that prints an interval, on small sets that are hard on rounding
 * (certify_fixture.h), against truths that do not round (exact_oracle.h): the truth
 * is inside, always, and the interval is no wider than
 *
 *     star, box, edge      two doubles up from end to end, so two ulps of 1
 *     with a tolerance     what that says
 *     recounts             two doubles, or dim 2^-97 near 0; of lines 2^-93
 *     l2^2 by divide       three doubles
 *     l2^2 by pairs        three doubles and (10 dim + 4) 2^-53 of the greatest K
 *     l2                   half as many times itself, and three doubles
 *     log10 of l2          1e-13 of itself more, and of 1
 *     variation, dim 1     two doubles on either side of what is told
 *
 * That of counts of cells is 0, which test_cells.c decides in integers.
 *
 * There are more than 10^4 such cases in make check, and 10^6 in make check-big. */
#include <check.h>
#include <limits.h>

#include "box.h"
#include "certify_fixture.h"
#include "edge.h"
#include "star.h"
#include "variation.h"

/* How many doubles up lead from lower to upper, at most `most`. */
static int steps_of(koksma_interval v, int most)
{
    int steps = 0;

    if (most == INT_MAX) return v.lower <= v.upper ? 0 : 1;
    for (; steps < most && v.lower < v.upper; steps++)
        v.lower = nextafter(v.lower, HUGE_VAL);
    return v.lower == v.upper ? steps : most + 1;
}

static size_t checked; /* intervals, since the case began */

static void check(const hard_set *s, const char *what, int how, koksma_interval v,
                  exact_ratio truth, int most)
{
    checked++;
    if (!exact_contains(v, truth)) hard_complain(s, what, how, v, truth);
    if (steps_of(v, most) > most) {
        char text[60];

        snprintf(text, sizeof text, "%s: more than %d doubles", what, most);
        hard_complain(s, text, how, v, truth);
    }
}

/* ---- Star and box ---------------------------------------------------------- */

enum { ANY = INT_MAX }; /* of a width */

/* A tolerance of 0, and of some size, in stages or not. */
static double tolerance_of(const hard_set *s)
{
    static const double tolerances[] = {0x1p-50, 1e-9, 0.01, 0.5};

    return tolerances[s->round / 16 % 4];
}

static bool is_close(koksma_interval v, double tolerance)
{
    return v.upper <= v.lower * (1.0 + tolerance) * (1.0 + 0x1p-50);
}

static koksma_interval star_by(const hard_set *s, int method, double tolerance)
{
    koksma_star_opts o = {.method = (koksma_star_method)method,
                          .tolerance = tolerance,
                          .anytime = s->round % 2 == 1,
                          .threads = 1,
                          .seed = 1};
    koksma_star_result r = {.value = {0.0, 0.0}};
    koksma_error err = {0};

    ck_assert_msg(koksma_star(&r, s->p, &o, &err) == KOKSMA_OK, "%s", err.text);
    return r.value;
}

static void certify_star(const hard_set *s)
{
    exact_ratio truth = exact_star(s->p);
    double tolerance = tolerance_of(s);

    for (int m = KOKSMA_STAR_SWEEP; m <= KOKSMA_STAR_SEARCH; m++) {
        bool search = m == KOKSMA_STAR_SEARCH;

        if (m == KOKSMA_STAR_LINES && (s->p.dim < 2 || s->p.dim > 3)) continue;
        check(s, "star", m, star_by(s, m, 0.0), truth, search ? ANY : 2);
        if (m != KOKSMA_STAR_TREE && m != KOKSMA_STAR_LINES) continue;

        koksma_interval v = star_by(s, m, tolerance);

        check(s, "star with a tolerance", m, v, truth, ANY);
        ck_assert(is_close(v, tolerance));
    }
}

static koksma_interval box_by(const hard_set *s, int method, double tolerance)
{
    koksma_box_opts o = {.method = (koksma_box_method)method,
                         .tolerance = tolerance,
                         .anytime = s->round % 2 == 1,
                         .threads = 1,
                         .seed = 1};
    koksma_box_result r = {.value = {0.0, 0.0}};
    koksma_error err = {0};

    ck_assert_msg(koksma_box_discrepancy(&r, s->p, &o, &err) == KOKSMA_OK, "%s",
                  err.text);
    return r.value;
}

static void certify_box(const hard_set *s)
{
    exact_ratio truth = exact_box(s->p);
    double tolerance = tolerance_of(s);

    for (int m = KOKSMA_BOX_SWEEP; m <= KOKSMA_BOX_SEARCH; m++) {
        bool search = m == KOKSMA_BOX_SEARCH;

        if (m == KOKSMA_BOX_SWEEP && s->p.dim > 2) continue;
        check(s, "box", m, box_by(s, m, 0.0), truth, search ? ANY : 2);
        if (search) continue;

        koksma_interval v = box_by(s, m, tolerance);

        check(s, "box with a tolerance", m, v, truth, ANY);
        ck_assert(is_close(v, tolerance));
    }
}

static void check_recount(const hard_set *s, const char *what, koksma_interval v,
                          exact_ratio truth, double width)
{
    check(s, what, 0, v, truth, v.upper - v.lower <= width ? ANY : 2);
}

/* Some box, its ends on the points' coordinates or not. */
static void certify_recounts(const hard_set *s)
{
    hard_set at = *s;
    double corners[2 * EXACT_DIM], *upper = corners + s->p.dim;
    double width = (double)s->p.dim * 0x1p-97;

    for (int closed = 0; closed < 2; closed++) {
        koksma_box box = {.corner = upper, .closed = closed != 0};
        koksma_box_witness w = {.corners = corners, .closed = closed != 0};

        for (size_t k = 0; k < s->p.dim; k++) {
            size_t i = oracle_below(&at.rng, s->p.n);
            double a = hard_mixed(&at.rng), b = s->x[i * s->p.dim + k];

            if (oracle_below(&at.rng, 2) == 0) b = hard_mixed(&at.rng);
            corners[k] = fmin(a, b);
            upper[k] = fmax(a, b);
        }
        check_recount(s, "a box", koksma_box_local(&box, s->p),
                      exact_local(s->p, NULL, upper, box.closed), width);
        check_recount(s, "a box between", koksma_box_between(&w, s->p),
                      exact_local(s->p, corners, upper, w.closed), width);
    }
}

/* A box whose volume is its share of the points but for a rounding, where all that
 * the product of its sides has lost shows: j points in it, and n - j above it along
 * the last axis. */
static void certify_balanced(const hard_set *s)
{
    hard_set at = *s;
    size_t dim = s->p.dim, last = dim - 1, n = s->p.n;
    size_t j = 1 + oracle_below(&at.rng, n);
    double corners[2 * EXACT_DIM] = {0.0}, *upper = corners + dim;
    double share = (double)j / (double)n, width = (double)dim * 0x1p-97;
    bool anchored = s->round % 3 == 0;

    at.p.x = at.x;
    for (size_t k = 0; k < dim; k++) {
        if (!anchored) corners[k] = 0.125 * hard_any(&at.rng);
        upper[k] = 1.0 - 0.25 * oracle_dyadic(&at.rng, 53);
        if (k < last) share /= upper[k] - corners[k];
    }
    upper[last] = fmin(corners[last] + share, 1.0);
    for (size_t i = 0; i < n * dim; i++)
        at.x[i] = i % dim == last && i / dim >= j ? 1.0 : 0.125;

    koksma_box box = {.corner = upper, .closed = s->round % 2 == 1};
    koksma_box_witness w = {.corners = corners, .closed = box.closed};

    if (anchored)
        check_recount(&at, "a balanced box", koksma_box_local(&box, at.p),
                      exact_local(at.p, NULL, upper, box.closed), width);
    check_recount(&at, "a balanced box between", koksma_box_between(&w, at.p),
                  exact_local(at.p, corners, upper, w.closed), width);
}

/* ---- Edge ------------------------------------------------------------------ */

static koksma_interval edge_by(const hard_set *s, int method, double tolerance)
{
    koksma_edge_opts o = {.method = (koksma_edge_method)method,
                          .tolerance = tolerance,
                          .anytime = s->round % 2 == 1,
                          .threads = 1};
    koksma_edge_result r;
    koksma_error err = {0};

    ck_assert_msg(koksma_edge(&r, s->p, &o, &err) == KOKSMA_OK, "%s", err.text);
    return r.value;
}

static void certify_edge(const hard_set *s)
{
    exact_ratio truth = exact_edge(s->p);
    double tolerance = tolerance_of(s);

    for (int m = KOKSMA_EDGE_SWEEP; m <= KOKSMA_EDGE_TREE; m++) {
        koksma_interval v;

        check(s, "edge", m, edge_by(s, m, 0.0), truth, 2);
        if (m != KOKSMA_EDGE_TREE) continue;
        v = edge_by(s, m, tolerance);
        check(s, "edge with a tolerance", m, v, truth, ANY);
        ck_assert(is_close(v, tolerance));
    }
}

/* Lines through points, or anywhere. */
static void certify_half_planes(const hard_set *s)
{
    hard_set at = *s;

    for (int turn = 0; turn < 4; turn++) {
        const double *a = s->x + 2 * oracle_below(&at.rng, s->p.n);
        const double *b = s->x + 2 * oracle_below(&at.rng, s->p.n);
        koksma_half_plane h;

        for (int k = 0; k < 2; k++) {
            h.from[k] = a[k];
            h.to[k] = b[k];
            if (turn > 1) h.from[k] = hard_mixed(&at.rng);
            if (turn % 2 == 1)
                h.to[k] =
                    hard_mixed(&at.rng) + (double)oracle_below(&at.rng, 3) - 1;
        }
        if (h.from[0] == h.to[0] && h.from[1] == h.to[1]) continue;
        check_recount(s, "a half-plane", koksma_half_plane_local(&h, s->p),
                      exact_half_plane(s->p, h.from, h.to), 0x1p-93);
    }
}

/* A half-plane above a line of a given direction through (across, up). */
static koksma_half_plane above(double across, double up, double slope)
{
    return (koksma_half_plane){
        .from = {across, up}, .to = {across + 0.5, up + 0.5 * slope}, .inside = 0};
}

/* A line that is shifted until the area is the share of the points in a corner but
 * for a rounding, where all that the area has lost shows; the others are in the
 * opposite corner. */
static void certify_balanced_lines(const hard_set *s)
{
    hard_set at = *s;
    size_t n = s->p.n, j = 1 + oracle_below(&at.rng, n);
    double across = oracle_dyadic(&at.rng, 53), low = 0.0, high = 1.0;
    double slope = 4.0 * oracle_dyadic(&at.rng, 53) - 2.0;

    at.p.x = at.x;
    for (size_t i = 0; i < n; i++) {
        bool inside = i < j;

        at.x[2 * i] = inside == (slope < 0.0) ? 1.0 : 0.0;
        at.x[2 * i + 1] = inside ? 1.0 : 0.0;
    }
    for (int step = 0; step < 60; step++) {
        koksma_half_plane h = above(across, 0.5 * (low + high), slope);
        koksma_interval v = koksma_half_plane_local(&h, at.p);

        check_recount(&at, "a balanced half-plane", v,
                      exact_half_plane(at.p, h.from, h.to), 0x1p-93);
        if (v.lower > 0.0)
            high = h.from[1];
        else
            low = h.from[1];
    }
}

/* ---- L2 -------------------------------------------------------------------- */

/* The greatest k. */
static const double most_of[KOKSMA_L2_KINDS] = {1.0, 0.25,  0.5, 1.5,
                                                1.5, 1.875, 2.0};

static double width_of(koksma_interval v) { return v.upper - v.lower; }

static bool is_wide(const koksma_l2_result *r, int kind, double dim)
{
    double ulp = 0x1p-52, most = 3.0 * ulp * r->squared.upper, share;

    if (r->method == KOKSMA_L2_PAIRS)
        most += (10.0 * dim + 4.0) * 0x1p-53 * pow(most_of[kind], dim);
    share = 0.5 * width_of(r->squared) / r->squared.lower;
    return width_of(r->squared) > most ||
           width_of(r->value) > (share + 3.0 * ulp) * r->value.upper ||
           width_of(r->log10) > 0.5 * share + 2e-13 * (1.0 - r->log10.lower);
}

/* Where a long double has no more digits than a double, up to some of its units. */
static bool contains_log10(koksma_interval v, exact_ratio r)
{
    long double want = 0.5L * log10l(exact_value(r));
    long double off = oracle_long_doubles() ? 1e-18L : 1e-15L;

    off *= 1.0L - want;
    return (long double)v.lower <= want + off && (long double)v.upper >= want - off;
}

static void certify_l2(const hard_set *s)
{
    for (int kind = 0; kind < KOKSMA_L2_KINDS; kind++) {
        exact_ratio truth = exact_l2(s->p, (koksma_l2_kind)kind);

        for (int m = KOKSMA_L2_PAIRS; m <= KOKSMA_L2_DIVIDE; m++) {
            koksma_l2_opts o = {.kind = (koksma_l2_kind)kind,
                                .method = (koksma_l2_method)m,
                                .threads = 1};
            koksma_l2_result r;

            ck_assert_int_eq(koksma_l2(&r, s->p, &o, NULL), KOKSMA_OK);
            check(s, koksma_l2_names[kind], m, r.squared, truth, ANY);
            if (!exact_contains_root(r.value, truth))
                hard_complain(s, "the root is outside", m, r.value, truth);
            if (!contains_log10(r.log10, truth))
                hard_complain(s, "the logarithm is outside", m, r.log10, truth);
            if (is_wide(&r, kind, (double)s->p.dim))
                hard_complain(s, koksma_l2_names[kind], m, r.squared, truth);
        }
    }
}

/* ---- Variation ------------------------------------------------------------- */

/* Of the numbers as values of one coordinate: the sum of |f_(i+1) - f_i|. */
static void certify_variation(const hard_set *s)
{
    exact_ratio truth = {exact_of(0), exact_of(1)};
    size_t n = s->p.n;
    unsigned bits = exact_bits(s->x, n, 0);
    koksma_variation_grid *g;
    koksma_variation_result r;
    double v;

    if (n < 2) return;
    for (size_t i = 1; i < n; i++) {
        exact_int d = exact_minus(exact_scaled(s->x[i], bits),
                                  exact_scaled(s->x[i - 1], bits));

        truth.num = exact_plus(truth.num, exact_abs(d));
    }
    truth.den = exact_shifted(truth.den, bits);
    ck_assert_int_eq(koksma_variation_open(&g, &n, 1, NULL), KOKSMA_OK);
    ck_assert_int_eq(koksma_variation_add(g, s->x, n, NULL), KOKSMA_OK);
    ck_assert_int_eq(koksma_variation_finish(&r, NULL, g, NULL), KOKSMA_OK);
    koksma_variation_close(g);
    v = r.level[r.levels - 1].value.value;
    check(s, "variation", 0,
          (koksma_interval){nextafter(nextafter(v, -1.0), -1.0),
                            nextafter(nextafter(v, HUGE_VAL), HUGE_VAL)},
          truth, 4);
}

/* ---- Sets ------------------------------------------------------------------ */

static const struct shape {
    const char *name;
    void (*certify)(const hard_set *s);
    size_t dim, most, rounds; /* of points, of sets */
} shapes[] = {
    {"star", certify_star, 1, 20, 200},
    {"star", certify_star, 2, 12, 300},
    {"star", certify_star, 3, 5, 150},
    {"star", certify_star, 4, 3, 60},
    {"box", certify_box, 1, 12, 100},
    {"box", certify_box, 2, 5, 150},
    {"box", certify_box, 3, 2, 60},
    {"recounts", certify_recounts, 1, 9, 100},
    {"recounts", certify_recounts, 2, 9, 150},
    {"recounts", certify_recounts, 3, 9, 150},
    {"recounts", certify_recounts, 4, 9, 150},
    {"balanced", certify_balanced, 2, 9, 100},
    {"balanced", certify_balanced, 3, 9, 300},
    {"balanced", certify_balanced, 4, 9, 300},
    {"edge", certify_edge, 2, 9, 300},
    {"half-planes", certify_half_planes, 2, 9, 200},
    {"balanced lines", certify_balanced_lines, 2, 9, 60},
    {"l2", certify_l2, 1, 12, 40},
    {"l2", certify_l2, 2, 12, 60},
    {"l2", certify_l2, 3, 9, 40},
    {"l2", certify_l2, 4, 6, 40},
    {"variation", certify_variation, 1, EXACT_POINTS, 500},
};

enum { SHAPES = sizeof shapes / sizeof shapes[0] };

static void certify(const struct shape *shape, uint64_t first, uint64_t count)
{
    static hard_set s;

    for (uint64_t round = first; round < first + count; round++) {
        hard_make(&s, shape->dim, shape->most, round);
        shape->certify(&s);
    }
}

/* All shapes in one case: Check runs each in a process of its own, and it takes all
 * to say how many intervals there were. */
static void certify_all(uint64_t first, size_t times, size_t least)
{
    checked = 0;
    for (size_t i = 0; i < SHAPES; i++)
        certify(&shapes[i], first, shapes[i].rounds * times);
    ck_assert_msg(checked >= least, "%zu intervals alone, of %zu", checked, least);
}

START_TEST(hard_sets) { certify_all(0, oracle_scale(), 10000 * oracle_scale()); }
END_TEST

/* With those above a hundred times as many sets where the scale is 20: these are
 * the 10^6. */
START_TEST(more_hard_sets)
{
    certify_all(1000000000, 4 * oracle_scale(), 50000 * oracle_scale());
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("certify");
    TCase *tc = tcase_create("certify"), *big = tcase_create("big");

    tcase_add_test(tc, hard_sets);
    tcase_set_timeout(tc, 120.0 * (double)oracle_scale());
    suite_add_tcase(suite, tc);
    tcase_add_test(big, more_hard_sets);
    tcase_set_tags(big, "big");
    tcase_set_timeout(big, 480.0 * (double)oracle_scale());
    suite_add_tcase(suite, big);
    return oracle_run(suite);
}
