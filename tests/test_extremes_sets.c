/* The discrepancies at the extremes, continued: whole grids and points of a line up
 * to 10^7, also in the mean square, with all points equal in up to 10^4 dimensions,
 * and by properties sets that mix faces, ties, neighbouring and least doubles. */
#include <check.h>

#include "box.h"
#include "edge.h"
#include "extremes_fixture.h"
#include "l2.h"
#include "star.h"

static koksma_interval star(koksma_points p, koksma_star_method method)
{
    koksma_star_opts opts = {.method = method, .threads = 1};
    koksma_star_result r = {.witness = {.corner = NULL}};
    koksma_error err = {0};

    ck_assert_msg(koksma_star(&r, p, &opts, &err) == KOKSMA_OK, "%s", err.text);
    return r.value;
}

static koksma_interval box(koksma_points p, koksma_box_method method)
{
    koksma_box_opts opts = {.method = method, .threads = 1};
    koksma_box_result r = {.witness = {.corners = NULL}};
    koksma_error err = {0};

    ck_assert_msg(koksma_box_discrepancy(&r, p, &opts, &err) == KOKSMA_OK, "%s",
                  err.text);
    return r.value;
}

static koksma_interval edge(koksma_points p, koksma_edge_method method)
{
    koksma_edge_opts opts = {.method = method, .threads = 1};
    koksma_edge_result r;
    koksma_error err = {0};

    ck_assert_msg(koksma_edge(&r, p, &opts, &err) == KOKSMA_OK, "%s", err.text);
    return r.value;
}

static koksma_l2_result l2(koksma_points p, koksma_l2_kind kind,
                           koksma_l2_method method)
{
    koksma_l2_opts opts = {.kind = kind, .method = method, .threads = 1};
    koksma_l2_result r;
    koksma_error err = {0};

    ck_assert_msg(koksma_l2(&r, p, &opts, &err) == KOKSMA_OK, "%s", err.text);
    return r;
}

static void expect(truth t, koksma_interval v, const char *measure, koksma_points p)
{
    ck_assert_msg(truth_inside(t, v) && oracle_narrow(v),
                  "%s of %zu points in %zu dimensions: [%.17g, %.17g], and not "
                  "%.17g, %d",
                  measure, p.n, p.dim, v.lower, v.upper, t.near, t.side);
}

/* ---- Grids ------------------------------------------------------------------- */

/* Of m points an axis the mean of h is c + b e and that of k over all pairs c + g
 * e, e = 1/m^2 and m even, since for x = (j + 1/2)/m the mean of x^2 is 1/3 - e/12,
 * of |x - 1/2| 1/4, of |x - y| 1/3 - e/3, of (x - y)^2 1/6 - e/6. */
static const struct {
    double c, b, g;
} means[KOKSMA_L2_KINDS] = {
    [KOKSMA_L2_STAR] = {1 / 3.0, 1 / 24.0, 1 / 6.0},
    [KOKSMA_L2_EXTREME] = {1 / 12.0, 1 / 24.0, 1 / 6.0},
    [KOKSMA_L2_PERIODIC] = {1 / 3.0, 0, 1 / 6.0},
    [KOKSMA_L2_CENTERED] = {13 / 12.0, 1 / 24.0, 1 / 6.0},
    [KOKSMA_L2_WRAPAROUND] = {4 / 3.0, 0, 1 / 6.0},
    [KOKSMA_L2_MIXTURE] = {19 / 12.0, 1 / 48.0, 1 / 6.0},
    [KOKSMA_L2_SYMMETRIC] = {4 / 3.0, 1 / 6.0, 2 / 3.0},
};

/* c^dim - 2 (c + b e)^dim + (c + g e)^dim by powers of e, of which all terms are
 * above 0. */
static double l2_of_grid(int kind, double e, size_t dim)
{
    double sum = 0.0, choose = 1.0;

    for (size_t j = 1; j <= dim; j++) {
        choose *= (double)(dim - j + 1) / (double)j;
        sum += choose * pow(means[kind].c, (double)(dim - j)) *
               (pow(means[kind].g * e, (double)j) -
                2.0 * pow(means[kind].b * e, (double)j));
    }
    return sum;
}

/* 1e-12 covers the roundings of `want`. */
static void expect_square(double want, double width, koksma_l2_result r, int kind,
                          koksma_points p)
{
    koksma_interval v = r.squared;

    ck_assert_msg(v.lower <= want * (1 + 1e-12) && v.upper >= want * (1 - 1e-12) &&
                      v.upper - v.lower <= width * want,
                  "L2 %s by method %d of %zu points in %zu dimensions: [%.17g, "
                  "%.17g], and not %.17g",
                  koksma_l2_names[kind], (int)r.method, p.n, p.dim, v.lower,
                  v.upper, want);
}

typedef struct grid {
    unsigned bits;   /* 2^bits points an axis, */
    size_t dim, r;   /* r times each */
    bool every;      /* by every method */
    bool tree, mean; /* boxes anywhere too; mean squares too */
} grid;

/* Of j/m, j < m, in any box a side of length w holds up to w m + 1 of m points, and
 * of (j + 1/2)/m w m + 1/2 of those from 0 on: closed boxes have share and volume
 * prod (w + 1/m) - prod w at most, which is greatest for the greatest w, (m-1)/m or
 * (m-1/2)/m.  Open ones have the same with the signs reversed, and no more. */
static void check_grid(const grid *g)
{
    double m = ldexp(1.0, (int)g->bits);

    for (int centred = 0; centred < 2; centred++) {
        koksma_points p = points_grid(g->bits, 0.5 * centred, g->dim, g->r);
        truth low = truth_less_power(1.0, 1.0 - 1.0 / m, g->dim);
        truth half = truth_less_power(1.0, 1.0 - 0.5 / m, g->dim);

        expect(centred ? half : low, star(p, KOKSMA_STAR_AUTO), "star", p);
        if (g->every && g->dim > 1)
            expect(centred ? half : low, star(p, KOKSMA_STAR_TREE), "tree", p);
        if (g->every && g->dim > 1)
            expect(centred ? half : low, star(p, KOKSMA_STAR_DEM), "dem", p);
        if (g->tree) expect(low, box(p, KOKSMA_BOX_AUTO), "box", p);
        if (g->every && g->tree) expect(low, box(p, KOKSMA_BOX_TREE), "box", p);
        for (int kind = 0; g->mean && centred && kind < KOKSMA_L2_KINDS; kind++) {
            double want = l2_of_grid(kind, 1.0 / (m * m), g->dim);
            bool divides = g->dim <= KOKSMA_L2_DIVIDE_DIM_TERMS;

            expect_square(want, divides ? p.n > 2000000 ? 1e-7 : 1e-9 : 1e-4,
                          l2(p, (koksma_l2_kind)kind,
                             divides ? KOKSMA_L2_DIVIDE : KOKSMA_L2_PAIRS),
                          kind, p);
        }
        points_free(p);
    }
}

START_TEST(grids)
{
    static const grid g[] = {{1, 1, 1, 1, 1, 1},  {8, 1, 3, 1, 1, 1},
                             {14, 1, 3, 0, 1, 0}, {3, 2, 2, 1, 1, 1},
                             {1, 6, 4, 1, 1, 1},  {2, 3, 1, 1, 1, 1},
                             {5, 2, 1, 1, 1, 1},  {1, 8, 1, 1, 0, 1}};

    for (size_t i = 0; i < sizeof g / sizeof g[0]; i++)
        check_grid(&g[i]);
}
END_TEST

START_TEST(large_grids)
{
    static const grid g[] = {{23, 1, 1, 0, 1, 1}, {10, 2, 1, 0, 0, 1},
                             {10, 2, 8, 0, 0, 0}, {4, 3, 10, 0, 1, 1},
                             {3, 4, 4, 0, 0, 0},  {1, 10, 100, 0, 0, 0}};

    for (size_t i = 0; i < sizeof g / sizeof g[0]; i++)
        check_grid(&g[i]);
}
END_TEST

/* ---- All points in one place, in the mean square ----------------------------- */

/* log10 of |c^dim - 2 h^dim + k^dim| / 2, the greatest power outside. */
static double log_of_place(double c, double h, double k, size_t dim)
{
    double most = fmax(c, fmax(h, k)), d = (double)dim;

    return (d * log10(most) + log10(fabs(pow(c / most, d) - 2.0 * pow(h / most, d) +
                                         pow(k / most, d)))) /
           2.0;
}

/* k(x,x), h(x) and c of the kinds at the ends and in the middle. */
static const struct {
    double x;
    double k[KOKSMA_L2_KINDS], h[KOKSMA_L2_KINDS];
} places[] = {
    {0.0,
     {1, 0, 0.5, 1.5, 1.5, 1.625, 2},
     {0.5, 0, 1 / 3.0, 9 / 8.0, 4 / 3.0, 71 / 48.0, 1}},
    {1.0,
     {0, 0, 0.5, 1.5, 1.5, 1.625, 2},
     {0, 0, 1 / 3.0, 9 / 8.0, 4 / 3.0, 71 / 48.0, 1}},
    {0.5,
     {0.5, 0.25, 0.5, 1, 1.5, 1.875, 2},
     {0.375, 0.125, 1 / 3.0, 1, 4 / 3.0, 5 / 3.0, 1.5}},
};

static void check_place(size_t n, size_t dim, double x, int i)
{
    double *numbers = malloc(n * dim * sizeof *numbers);
    koksma_points p = {numbers, n, dim};

    ck_assert_ptr_nonnull(numbers);
    for (size_t j = 0; j < n * dim; j++)
        numbers[j] = x;
    for (int kind = 0; kind < KOKSMA_L2_KINDS; kind++) {
        double want =
            log_of_place(means[kind].c, places[i].h[kind], places[i].k[kind], dim);
        koksma_interval v = l2(p, (koksma_l2_kind)kind, KOKSMA_L2_AUTO).log10;
        double slack = 1e-11 * (1.0 + fabs(want));
        /* Products of such coordinates underflow, and are bounded as such. */
        bool tiny = kind == KOKSMA_L2_EXTREME && x == LEAST && dim > 300;

        ck_assert_msg(v.lower <= want + slack && v.upper >= want - slack &&
                          (tiny || v.upper - v.lower < 1e-9 * (1.0 + fabs(want))),
                      "%s of %zu points at %g in %zu dimensions: 10^[%.17g, "
                      "%.17g], and not 10^%.17g",
                      koksma_l2_names[kind], n, x, dim, v.lower, v.upper, want);
    }
    free(numbers);
}

/* The least doubles and those next to 1 and 1/2 are as good as these to 1e-12 dim.
 */
static void check_places(size_t n, size_t dim)
{
    static const double next[][2] = {{0.0, LEAST}, {1.0, BELOW}, {0.5, 0.5 + ULP}};

    for (int i = 0; i < 3; i++) {
        check_place(n, dim, next[i][0], i);
        /* (1 - x)^dim and the like are far from 0 and from that at 1. */
        if (i != 1) check_place(n, dim, next[i][1], i);
    }
}

START_TEST(one_place)
{
    check_places(1, 1);
    check_places(1000, 1);
    check_places(3, 2);
    check_places(100, 20);
    check_places(3, 100);
    check_places(2, 1000);
    check_places(1, 10000);
}
END_TEST

START_TEST(one_place_large)
{
    check_places(1000000, 1);
    check_places(1000000, 2);
    check_places(10000, 4);
    check_places(3000, 100);
    check_places(1000, 1000);
    check_places(100, 10000);
}
END_TEST

/* ---- The line ---------------------------------------------------------------- */

/* i/2^24, i < n <= 2^24: both are 1 - (n-1)/2^24, by the closed box with all points
 * and the open one, from the last on or from 0, that has none or all. */
static void check_line(size_t n)
{
    double *x = malloc(n * sizeof *x);
    koksma_points p = {x, n, 1};
    truth t = truth_exact(1.0 - (double)(n - 1) * 0x1p-24);

    ck_assert_ptr_nonnull(x);
    for (size_t i = 0; i < n; i++)
        x[(i * 7919) % n] = (double)i * 0x1p-24; /* 7919 is prime */
    expect(t, star(p, KOKSMA_STAR_AUTO), "star", p);
    expect(t, box(p, KOKSMA_BOX_AUTO), "box", p);
    free(x);
}

START_TEST(line)
{
    check_line(1);
    check_line(2);
    check_line(1000);
    check_line(100000);
}
END_TEST

START_TEST(long_line) { check_line(10000000); }
END_TEST

/* ---- Sets of everything ------------------------------------------------------ */

static const double palette[] = {0.0,       LEAST, 0x1p-600,      1e-300,
                                 ULP,       0.25,  0.5 - ULP / 2, 0.5,
                                 0.5 + ULP, 0.75,  BELOW,         1.0};
enum { COLOURS = sizeof palette / sizeof palette[0] };

static double *mixed_set(oracle_rng *rng, size_t n, size_t dim)
{
    double *x = malloc(2 * n * dim * sizeof *x);
    size_t colours = 1 + oracle_below(rng, COLOURS),
           from = oracle_below(rng, COLOURS);

    ck_assert_ptr_nonnull(x);
    for (size_t i = 0; i < n * dim; i++)
        x[i] = palette[(from + oracle_below(rng, colours)) % COLOURS];
    return x;
}

static bool overlap(koksma_interval a, koksma_interval b)
{
    return a.lower <= b.upper && b.lower <= a.upper;
}

/* Whether a value in `a` can be at most one in `b`. */
static bool may_be_less(koksma_interval a, koksma_interval b)
{
    return a.lower <= b.upper;
}

/* Every measure, by all methods the same; and of the points reversed, and of all
 * twice, what it was. */
static void check_alike(double *x, size_t n, size_t dim)
{
    koksma_points p = {x, n, dim}, back = {x + n * dim, n, dim},
                  twice = {x, 2 * n, dim};
    koksma_interval s = star(p, KOKSMA_STAR_SWEEP), e = box(p, KOKSMA_BOX_TREE);
    koksma_interval mean = l2(p, KOKSMA_L2_STAR, KOKSMA_L2_PAIRS).value;

    for (size_t i = 0; i < n * dim; i++)
        x[n * dim + i] = x[(n - 1 - i / dim) * dim + i % dim];
    ck_assert(oracle_narrow(s) && oracle_narrow(e));
    ck_assert(may_be_less(mean, s) && may_be_less(s, e));
    ck_assert(e.lower <= ldexp(s.upper, (int)dim));
    for (int m = KOKSMA_STAR_SWEEP; m <= KOKSMA_STAR_DEM; m++)
        if (m != KOKSMA_STAR_LINES || dim == 2 || dim == 3) {
            koksma_interval same = star(back, (koksma_star_method)m);

            ck_assert_msg(same.lower == s.lower && same.upper == s.upper,
                          "method %d", m);
            ck_assert(overlap(s, star(twice, (koksma_star_method)m)));
        }
    if (dim <= 2) ck_assert(overlap(e, box(back, KOKSMA_BOX_SWEEP)));
    ck_assert(overlap(e, box(back, KOKSMA_BOX_TREE)));
    ck_assert(overlap(e, box(twice, KOKSMA_BOX_AUTO)));
    for (int kind = 0; kind < KOKSMA_L2_KINDS; kind++) {
        koksma_interval v = l2(p, (koksma_l2_kind)kind, KOKSMA_L2_PAIRS).squared;

        ck_assert(
            overlap(v, l2(back, (koksma_l2_kind)kind, KOKSMA_L2_DIVIDE).squared));
        ck_assert(
            overlap(v, l2(twice, (koksma_l2_kind)kind, KOKSMA_L2_DIVIDE).squared));
    }
    if (dim == 2) {
        koksma_interval v = edge(p, KOKSMA_EDGE_SWEEP);

        ck_assert(overlap(v, edge(back, KOKSMA_EDGE_TREE)));
        ck_assert(overlap(v, edge(twice, KOKSMA_EDGE_AUTO)));
    }
}

static void check_mixed(size_t rounds, size_t most)
{
    for (uint64_t round = 0; round < rounds; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round + 123);
        size_t dim = 1 + oracle_below(&rng, 4), n = 1 + oracle_below(&rng, most);
        double *x = mixed_set(&rng, n, dim);

        mark_point();
        check_alike(x, n, dim);
        free(x);
    }
}

START_TEST(mixed_sets) { check_mixed(60 * oracle_scale(), 12); }
END_TEST

int main(void)
{
    Suite *suite = suite_create("extremes, sets");
    TCase *tc = tcase_create("small"), *big = tcase_create("large"),
          *slow = tcase_create("grids");

    tcase_set_timeout(tc, 60);
    tcase_add_test(tc, one_place);
    tcase_add_test(tc, line);
    tcase_add_test(tc, mixed_sets);
    suite_add_tcase(suite, tc);
    tcase_set_tags(slow, "slow");
    tcase_add_test(slow, grids);
    suite_add_tcase(suite, slow);
    tcase_set_timeout(big, 1200);
    tcase_set_tags(big, "big");
    tcase_add_test(big, large_grids);
    tcase_add_test(big, one_place_large);
    tcase_add_test(big, long_line);
    suite_add_tcase(suite, big);
    return oracle_run(suite);
}
