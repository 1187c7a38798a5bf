/* The discrepancies at the extremes: any number of points from 1 to 10^7 and of
 * dimensions to 10^4, all in one place, at a face, in a line, on a grid, an ulp
 * apart, or of the least coordinates that there are.  What is expected follows from
 * the definition by hand; the table has the derivations. */
#include <check.h>

#include "box.h"
#include "edge.h"
#include "extremes_fixture.h"
#include "star.h"

/* ---- Closed forms ------------------------------------------------------------ */

typedef truth formula(size_t n, size_t dim);

/* Points at s_1, ..., s_n times (1,...,1), increasing.  A corner with the least
 * coordinate c has the points up to c in its box, whose volume is at most c, the
 * others being 1, and at least c^dim.  So D* is the greatest of all s_i - (i-1)/n,
 * 1 - #{s < 1}/n and i/n - s_i^dim. */
static truth one(size_t n, size_t dim)
{
    return (void)n, (void)dim, truth_exact(1.0);
}

/* s against 1 - s^dim <= dim 2^-53. */
static truth star_below_1(size_t n, size_t dim)
{
    return (void)n, (void)dim, truth_exact(BELOW);
}

/* max(2^-1074, 1 - 2^(-1074 dim)) */
static truth star_least(size_t n, size_t dim)
{
    return (void)n, (void)dim, (truth){1.0, -1};
}

/* max(1/2, 1 - 2^-dim) */
static truth star_halves(size_t n, size_t dim)
{
    return (void)n, truth_less_power(1.0, 0.5, dim);
}

/* max(1/2, 1 - (1/2 + 2^-53)^dim); 1 - floor(n/2)/n - 2^-dim is less. */
static truth star_two_doubles(size_t n, size_t dim)
{
    return (void)n,
           truth_max(truth_exact(0.5), truth_less_power(1.0, 0.5 + ULP, dim));
}

/* max(1/4, 3/4 - 4^-dim, 1 - (3/4)^dim) */
static truth star_two_places(size_t n, size_t dim)
{
    return (void)n, truth_max(truth_less_power(0.75, 0.25, dim),
                              truth_less_power(1.0, 0.75, dim));
}

/* max over i of (i+1)/n - (i/n)^dim; s_i - (i-1)/n is 0.  Of boxes anywhere: closed
 * ones that hold j+1 neighbours give the same; an open one without points has at
 * most (1 - i/n)(i+1)/n, which is less than the former for i = n/2 and dim 2. */
static truth on_diagonal(size_t n, size_t dim)
{
    truth best = {0.0, 0};

    for (size_t i = 0; i < n; i++) {
        double s = (double)i / (double)n, a = (double)(i + 1) / (double)n;

        if (a - pow(s, (double)dim) > best.near - 0x1p-40)
            best = truth_max(best, truth_less_power(a, s, dim));
    }
    return best;
}

/* The box with both corners around them has all: 1 - 2^(-53 dim). */
static truth box_two_doubles(size_t n, size_t dim)
{
    return (void)n, dim == 1 ? truth_exact(BELOW) : (truth){1.0, -1};
}

/* Closed boxes: 3/4 - 0 round the one place, 1 - 2^-dim round both.  Open ones: at
 * most (3/4)^2, between the places along two axes. */
static truth box_two_places(size_t n, size_t dim)
{
    return (void)n, truth_max(truth_exact(0.75), truth_less_power(1.0, 0.5, dim));
}

/* In the plane.  A half-plane that contains (s,s) has at least the area 2 r^2, r
 * the lesser of s and 1 - s: the triangle whose long side (s,s) halves. */
static truth edge_tiny(size_t n, size_t dim)
{
    return (void)n, (void)dim, (truth){1.0, -1};
}

/* What contains the centre has at least half of the square, so that all points, in
 * one closed half-plane of half the area, make 1/2.  What does not contain it has a
 * share of at most 1/2: of an ulp apart, the points that are not the centre; on the
 * diagonal, those on one side of it. */
static truth edge_half(size_t n, size_t dim)
{
    return (void)n, (void)dim, truth_exact(0.5);
}

/* 3/4 - 2 (1/4)^2 against 1 - 1/2 */
static truth edge_two_places(size_t n, size_t dim)
{
    return (void)n, (void)dim, truth_exact(0.625);
}

static const struct {
    const char *name;
    place_of *place;
    formula *star, *box, *edge;
    size_t least, multiple; /* of n */
} shapes[] = {
    /* A closed box round all points has any small volume: E = 1 where they are
     * equal. */
    {"at 0", at_0, one, one, one, 1, 1},
    {"at 1", at_1, one, one, one, 1, 1},
    {"below 1", below_1, star_below_1, one, edge_tiny, 1, 1},
    {"least", least, star_least, one, edge_tiny, 1, 1},
    {"halves", halves, star_halves, one, edge_half, 1, 1},
    {"an ulp apart", two_doubles, star_two_doubles, box_two_doubles, edge_half, 2,
     1},
    {"two places", two_places, star_two_places, box_two_places, edge_two_places, 4,
     4},
    {"diagonal", diagonal, on_diagonal, on_diagonal, edge_half, 2, 0},
};
enum { SHAPES = sizeof shapes / sizeof shapes[0] };

/* 0: a power of two. */
static bool fits(int shape, size_t n)
{
    size_t multiple = shapes[shape].multiple;

    if (n < shapes[shape].least) return false;
    return multiple > 0 ? n % multiple == 0 : (n & (n - 1)) == 0;
}

/* ---- What must hold of a result ------------------------------------------ */

static void expect(truth t, koksma_interval v, const char *measure, int method,
                   const char *shape, koksma_points p)
{
    ck_assert_msg(truth_inside(t, v) && oracle_narrow(v),
                  "%s by method %d of %zu points %s in %zu dimensions: [%.17g, "
                  "%.17g], and not %.17g, %d",
                  measure, method, p.n, shape, p.dim, v.lower, v.upper, t.near,
                  t.side);
}

static koksma_star_result star(koksma_points p, koksma_star_method method)
{
    double *corner = calloc(p.dim, sizeof *corner);
    koksma_star_opts opts = {.method = method, .threads = 1};
    koksma_star_result r = {.witness = {.corner = corner}};
    koksma_error err = {0};

    ck_assert_ptr_nonnull(corner);
    ck_assert_msg(koksma_star(&r, p, &opts, &err) == KOKSMA_OK, "%s", err.text);
    ck_assert(koksma_box_local(&r.witness, p).lower >= r.value.lower);
    ck_assert_uint_eq(r.witness.inside, oracle_count(p, corner, r.witness.closed));
    free(corner);
    return r;
}

static koksma_box_result box(koksma_points p, koksma_box_method method)
{
    double *corners = calloc(2 * p.dim, sizeof *corners);
    koksma_box_opts opts = {.method = method, .threads = 1};
    koksma_box_result r = {.witness = {.corners = corners}};
    koksma_error err = {0};

    ck_assert_ptr_nonnull(corners);
    ck_assert_msg(koksma_box_discrepancy(&r, p, &opts, &err) == KOKSMA_OK, "%s",
                  err.text);
    ck_assert(koksma_box_between(&r.witness, p).lower >= r.value.lower);
    ck_assert_uint_eq(r.witness.inside,
                      oracle_count_between(p, corners, r.witness.closed));
    free(corners);
    return r;
}

static koksma_edge_result edge(koksma_points p, koksma_edge_method method)
{
    koksma_edge_opts opts = {.method = method, .threads = 1};
    koksma_edge_result r;
    koksma_error err = {0};

    ck_assert_msg(koksma_edge(&r, p, &opts, &err) == KOKSMA_OK, "%s", err.text);
    ck_assert(koksma_half_plane_local(&r.witness, p).lower >= r.value.lower);
    return r;
}

/* A search proves no upper bound; what it finds must be there. */
static void expect_found(truth t, koksma_interval v, const char *shape)
{
    ck_assert_msg(truth_inside(t, v) && v.upper == 1.0,
                  "search, %s: [%.17g, %.17g]", shape, v.lower, v.upper);
}

static bool takes_lines(koksma_points p) { return p.dim == 2 || p.dim == 3; }

static void check_star(truth t, koksma_points p, const char *name, bool every)
{
    expect(t, star(p, KOKSMA_STAR_AUTO).value, "star", 0, name, p);
    for (int m = KOKSMA_STAR_SWEEP; every && m <= KOKSMA_STAR_DEM; m++)
        if (m != KOKSMA_STAR_LINES || takes_lines(p))
            expect(t, star(p, (koksma_star_method)m).value, "star", m, name, p);
    if (every) expect_found(t, star(p, KOKSMA_STAR_SEARCH).value, name);
}

static void check_box(truth t, koksma_points p, const char *name, bool every)
{
    expect(t, box(p, KOKSMA_BOX_AUTO).value, "box", 0, name, p);
    if (!every) return;
    if (p.dim <= 2) expect(t, box(p, KOKSMA_BOX_SWEEP).value, "box", 1, name, p);
    expect(t, box(p, KOKSMA_BOX_TREE).value, "box", 2, name, p);
    expect_found(t, box(p, KOKSMA_BOX_SEARCH).value, name);
}

static void check_edge(truth t, koksma_points p, const char *name, bool every)
{
    for (int m = KOKSMA_EDGE_AUTO; m <= KOKSMA_EDGE_TREE; m++)
        if (every || m == KOKSMA_EDGE_AUTO)
            expect(t, edge(p, (koksma_edge_method)m).value, "edge", m, name, p);
}

/* ---- The shapes -------------------------------------------------------------- */

typedef struct size_of {
    size_t n, dim;
    bool every; /* whether to try every method */
    bool box;   /* and boxes anywhere */
} size_of;

static void check_sizes(const size_of *size, size_t count, int shape)
{
    for (size_t s = 0; s < count; s++)
        if (fits(shape, size[s].n)) {
            size_t n = size[s].n, dim = size[s].dim;
            koksma_points p = points_at(shapes[shape].place, n, dim);
            const char *name = shapes[shape].name;

            check_star(shapes[shape].star(n, dim), p, name, size[s].every);
            if (size[s].box)
                check_box(shapes[shape].box(n, dim), p, name, size[s].every);
            if (dim == 2)
                check_edge(shapes[shape].edge(n, dim), p, name, size[s].every);
            points_free(p);
        }
}

START_TEST(small_sets)
{
    static const size_of size[] = {
        {1, 1, 1, 1},   {1, 2, 1, 1},    {1, 3, 1, 1},    {1, 20, 1, 1},
        {3, 2, 1, 1},   {4, 1, 1, 1},    {4, 2, 1, 1},    {4, 3, 1, 1},
        {4, 20, 0, 1},  {64, 2, 1, 1},   {64, 3, 1, 1},   {64, 1, 1, 1},
        {1, 100, 0, 1}, {1, 1000, 0, 0}, {4096, 1, 0, 1}, {4096, 2, 0, 0}};

    check_sizes(size, sizeof size / sizeof size[0], _i);
}
END_TEST

/* As many points as there may be, and dimensions. */
START_TEST(large_sets)
{
    static const size_of size[] = {
        {10000000, 1, 0, 1}, {8388608, 1, 0, 1}, {1000000, 2, 0, 0},
        {100000, 2, 0, 1},   {65536, 2, 0, 0},   {1000000, 3, 0, 0},
        {1000000, 4, 0, 0},  {10000, 4, 0, 1},   {10000, 20, 0, 1},
        {4, 100, 0, 1},      {1000, 100, 0, 0},  {1, 10000, 0, 0}};

    check_sizes(size, sizeof size / sizeof size[0], _i);
}
END_TEST

/* A search in a thousand dimensions, stopped: wide perhaps, but true. */
START_TEST(stopped_sets)
{
    static const size_t n[] = {4, 100};

    for (size_t i = 0; i < 2; i++)
        if (fits(_i, n[i])) {
            koksma_points p = points_at(shapes[_i].place, n[i], 1000);
            koksma_star_opts opts = {
                .method = KOKSMA_STAR_TREE, .threads = 1, .work = 1e4};
            koksma_star_result r = {.witness = {.corner = NULL}};
            koksma_status status = koksma_star(&r, p, &opts, NULL);

            ck_assert(status == KOKSMA_OK || status == KOKSMA_STOPPED);
            ck_assert(truth_inside(shapes[_i].star(n[i], 1000), r.value));
            points_free(p);
        }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("extremes");
    TCase *tc = tcase_create("small"), *big = tcase_create("large");

    tcase_set_timeout(tc, 60);
    tcase_add_loop_test(tc, small_sets, 0, SHAPES);
    suite_add_tcase(suite, tc);
    tcase_set_timeout(big, 1200);
    tcase_set_tags(big, "big");
    tcase_add_loop_test(big, large_sets, 0, SHAPES);
    tcase_add_loop_test(big, stopped_sets, 0, SHAPES);
    suite_add_tcase(suite, big);
    return oracle_run(suite);
}
