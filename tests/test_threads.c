/* Finished answers have the same bits for any number of threads: values, witnesses,
 * and the work where that is promised.  The tree and the lines of the star
 * discrepancy are looked at more closely in test_star_threads.c. */
#include <check.h>
#include <math.h>
#include <string.h>

#include "box.h"
#include "edge.h"
#include "gen.h"
#include "l2.h"
#include "oracle.h"
#include "star.h"

enum { THREADS = 8, NUMBERS = 20000, DIMS = 4, BITS = 2 * DIMS + 6 };

/* All that is compared; 0 where a measure has nothing to say. */
typedef struct answer {
    double bits[BITS];
} answer;

/* levels > 0: moved to a grid of so many steps; < 0: half of the points crowd in a
 * spot of that size round the middle. */
typedef struct solver_row {
    const char *name;
    answer (*solve)(koksma_points p, const struct solver_row *row, size_t threads);
    int method, kind;
    const char *family;
    size_t dim, n;
    double levels;
    bool anytime;
} solver_row;

static answer star(koksma_points p, const solver_row *row, size_t threads)
{
    koksma_star_opts o = {.method = (koksma_star_method)row->method,
                          .threads = threads,
                          .seed = 1,
                          .anytime = row->anytime};
    double corner[DIMS] = {0.0};
    koksma_star_result r = {.witness.corner = corner};
    answer a = {{0.0}};

    ck_assert_int_eq(koksma_star(&r, p, &o, NULL), KOKSMA_OK);
    memcpy(a.bits, corner, sizeof corner);
    a.bits[BITS - 1] = r.value.lower;
    a.bits[BITS - 2] = r.value.upper;
    a.bits[BITS - 3] = (double)r.witness.inside;
    a.bits[BITS - 4] = r.witness.closed;
    return a;
}

static answer box(koksma_points p, const solver_row *row, size_t threads)
{
    koksma_box_opts o = {.method = (koksma_box_method)row->method,
                         .threads = threads,
                         .seed = 1,
                         .anytime = row->anytime};
    double corners[2 * DIMS] = {0.0};
    koksma_box_result r = {.witness.corners = corners};
    answer a = {{0.0}};

    ck_assert_int_eq(koksma_box_discrepancy(&r, p, &o, NULL), KOKSMA_OK);
    memcpy(a.bits, corners, sizeof corners);
    a.bits[BITS - 1] = r.value.lower;
    a.bits[BITS - 2] = r.value.upper;
    a.bits[BITS - 3] = (double)r.witness.inside;
    a.bits[BITS - 4] = r.witness.closed;
    return a;
}

static answer edge(koksma_points p, const solver_row *row, size_t threads)
{
    koksma_edge_opts o = {.method = (koksma_edge_method)row->method,
                          .threads = threads,
                          .anytime = row->anytime};
    koksma_edge_result r;

    ck_assert_int_eq(koksma_edge(&r, p, &o, NULL), KOKSMA_OK);
    return (answer){{r.value.lower, r.value.upper, r.witness.from[0],
                     r.witness.from[1], r.witness.to[0], r.witness.to[1],
                     (double)r.witness.inside}};
}

static answer l2(koksma_points p, const solver_row *row, size_t threads)
{
    koksma_l2_opts o = {.method = (koksma_l2_method)row->method,
                        .kind = (koksma_l2_kind)row->kind,
                        .threads = threads};
    koksma_l2_result r;

    ck_assert_int_eq(koksma_l2(&r, p, &o, NULL), KOKSMA_OK);
    return (answer){{r.value.lower, r.value.upper, r.squared.lower, r.squared.upper,
                     r.log10.lower, r.log10.upper, r.work}};
}

#define L2_ROWS(kind)                                                              \
    {"l2", l2, KOKSMA_L2_PAIRS, (kind), "random", 3, 601, 0.0, false},             \
    {                                                                              \
        "l2", l2, KOKSMA_L2_DIVIDE, (kind), "halton", 2, 5001, 0.0, false          \
    }

static const solver_row rows[] = {
    {"star", star, KOKSMA_STAR_SWEEP, 0, "random", 2, 300, 0.0, false},
    {"star", star, KOKSMA_STAR_DEM, 0, "random", 3, 100, 0.0, false},
    {"star", star, KOKSMA_STAR_SEARCH, 0, "random", 4, 100, 0.0, false},
    {"box", box, KOKSMA_BOX_SWEEP, 0, "halton", 2, 300, 0.0, true},
    {"box", box, KOKSMA_BOX_SWEEP, 0, "random", 2, 400, 8.0, false},
    {"box", box, KOKSMA_BOX_SWEEP, 0, "random", 1, 3000, 0.0, false},
    {"box", box, KOKSMA_BOX_TREE, 0, "halton", 2, 100, 0.0, true},
    {"box", box, KOKSMA_BOX_TREE, 0, "random", 3, 60, 4.0, true},
    {"box", box, KOKSMA_BOX_TREE, 0, "random", 4, 30, 0.0, false},
    {"box", box, KOKSMA_BOX_SEARCH, 0, "random", 3, 60, 0.0, false},
    {"edge", edge, KOKSMA_EDGE_SWEEP, 0, "halton", 2, 400, 0.0, true},
    {"edge", edge, KOKSMA_EDGE_TREE, 0, "halton", 2, 900, 0.0, true},
    {"edge", edge, KOKSMA_EDGE_TREE, 0, "random", 2, 500, 20.0, true},
    {"edge", edge, KOKSMA_EDGE_TREE, 0, "random", 2, 40, -0x1p-40, false},
    {"edge", edge, KOKSMA_EDGE_TREE, 0, "random", 2, 40, -0x1p-40, true},
    L2_ROWS(KOKSMA_L2_STAR),
    L2_ROWS(KOKSMA_L2_EXTREME),
    L2_ROWS(KOKSMA_L2_PERIODIC),
    L2_ROWS(KOKSMA_L2_CENTERED),
    L2_ROWS(KOKSMA_L2_WRAPAROUND),
    L2_ROWS(KOKSMA_L2_MIXTURE),
    L2_ROWS(KOKSMA_L2_SYMMETRIC),
    {"l2", l2, KOKSMA_L2_PAIRS, KOKSMA_L2_EXTREME, "random", 2, 1025, 9.0, false},
    {"l2", l2, KOKSMA_L2_DIVIDE, KOKSMA_L2_CENTERED, "random", 3, 4100, 7.0, false},
};

enum { ROWS = sizeof rows / sizeof rows[0] };

/* The points live until the next call. */
static koksma_points points_of(const solver_row *r)
{
    static double x[NUMBERS];
    koksma_gen_opts o = {.dim = r->dim, .n = r->n, .seed = oracle_seed()};
    koksma_gen *g;

    ck_assert_uint_le(r->n * r->dim, NUMBERS);
    ck_assert_int_eq(koksma_gen_open(&g, koksma_gen_find(r->family), &o, NULL),
                     KOKSMA_OK);
    ck_assert_int_eq(koksma_gen_fill(g, x, 0, r->n, NULL), KOKSMA_OK);
    koksma_gen_close(g);
    for (size_t i = 0; i < r->n * r->dim; i++) {
        if (r->levels > 0.0) x[i] = round(x[i] * r->levels) / r->levels;
        if (r->levels < 0.0 && i % (2 * r->dim) < r->dim)
            x[i] = 0.5 + (x[i] - 0.5) * r->levels;
    }
    return (koksma_points){x, r->n, r->dim};
}

START_TEST(same_bits_for_any_threads)
{
    const solver_row *r = &rows[_i];
    koksma_points p = points_of(r);
    answer one = r->solve(p, r, 1);

    for (size_t threads = 2; threads <= THREADS; threads++) {
        answer a = r->solve(p, r, threads);

        for (size_t i = 0; i < BITS; i++)
            ck_assert_msg(
                a.bits[i] == one.bits[i],
                "%s, method %d, kind %d, %s, dim %zu, n %zu, %zu threads: "
                "number %zu is %.17g, not %.17g, KOKSMA_TEST_SEED=%llu",
                r->name, r->method, r->kind, r->family, r->dim, r->n, threads, i,
                a.bits[i], one.bits[i], (unsigned long long)oracle_seed());
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("threads");
    TCase *tc = tcase_create("threads");

    tcase_add_loop_test(tc, same_bits_for_any_threads, 0, ROWS);
    tcase_set_tags(tc, "threads");
    tcase_set_timeout(tc, 120);
    suite_add_tcase(suite, tc);
    return oracle_run(suite);
}
