/* The methods of koksma_star against each other, on sets that the definition as
 * loops cannot reach, and on sets made to tell them apart: many ties, coordinates
 * next to each other, sides so short that volumes vanish.  Two algorithms that have
 * nothing in common but the arithmetic of a box must agree to the last bit. */
#include <check.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "gen_fixture.h"
#include "oracle.h"
#include "star.h"

enum { DIMS = 40, NUMBERS = 20000 };

typedef struct answer {
    koksma_star_result r;
    double corner[DIMS];
} answer;

/* One coordinate of one kind of set: of n points the i-th, along axis k of dim. */
typedef double coordinate(oracle_rng *rng, size_t i, size_t k, size_t n,
                          size_t dim);

static double random_one(oracle_rng *rng, size_t i, size_t k, size_t n, size_t dim)
{
    (void)i, (void)k, (void)n, (void)dim;
    return oracle_dyadic(rng, 53);
}

/* Five values with both ends: runs of ties longer than any range of a cell. */
static double coarse(oracle_rng *rng, size_t i, size_t k, size_t n, size_t dim)
{
    (void)i, (void)k, (void)n, (void)dim;
    return (double)oracle_below(rng, 5) / 4.0;
}

/* Some of the last: neither all ties nor none. */
static double mixed(oracle_rng *rng, size_t i, size_t k, size_t n, size_t dim)
{
    return oracle_below(rng, 3) == 0 ? coarse(rng, i, k, n, dim)
                                     : oracle_dyadic(rng, 53);
}

/* Next to 1/2 or to 1 by a few units of the last place. */
static double crowded(oracle_rng *rng, size_t i, size_t k, size_t n, size_t dim)
{
    double v = (1.0 + (double)oracle_below(rng, 2)) / 2.0;

    (void)i, (void)k, (void)n, (void)dim;
    for (size_t steps = oracle_below(rng, 4); steps > 0; steps--)
        v = nextafter(v, 0.0);
    return v;
}

/* Point i is 2^-j on axis i mod dim, j = i / dim, and 0 on the others: boxes whose
 * sides are powers of 2 tie wherever the exponents have the same sum. */
static double cross(oracle_rng *rng, size_t i, size_t k, size_t n, size_t dim)
{
    (void)rng, (void)n;
    return i % dim == k ? ldexp(1.0, -(int)(i / dim)) : 0.0;
}

/* Half of the points are where boxes have next to no volume, and their errors,
 * not their volumes, tell them apart. */
static double vanishing(oracle_rng *rng, size_t i, size_t k, size_t n, size_t dim)
{
    (void)k, (void)dim;
    return i < n / 2 ? ldexp(1.0, -20 - (int)oracle_below(rng, 500))
                     : oracle_dyadic(rng, 53);
}

/* Denormals too, and 0 and 1. */
static double extreme(oracle_rng *rng, size_t i, size_t k, size_t n, size_t dim)
{
    static const double ends[] = {0.0,  0x1p-1074, 0x1p-1022, 0x1p-540,
                                  1e-9, 0.5,       1.0};
    size_t choice = oracle_below(rng, 8);

    (void)i, (void)k, (void)n, (void)dim;
    return choice < 7 ? ends[choice] : oracle_dyadic(rng, 53);
}

static void solve(answer *a, koksma_points p, koksma_star_method method)
{
    koksma_star_opts opts = {.method = method};
    koksma_error err = {0};

    memset(a, 0, sizeof *a);
    a->r.witness.corner = a->corner;

    koksma_status status = koksma_star(&a->r, p, &opts, &err);

    ck_assert_msg(status == KOKSMA_OK, "status %d: %s", (int)status, err.text);
    ck_assert_int_eq(a->r.method, method);
}

static void check_witness(const koksma_star_result *r, koksma_points p)
{
    const koksma_box *w = &r->witness;

    ck_assert_uint_eq(w->inside, oracle_count(p, w->corner, w->closed));
    ck_assert(koksma_box_local(w, p).lower >= r->value.lower);
    ck_assert(oracle_narrow(r->value));
}

static const char *const names[] = {[KOKSMA_STAR_SWEEP] = "sweep",
                                    [KOKSMA_STAR_TREE] = "tree",
                                    [KOKSMA_STAR_DEM] = "dem"};

static void agree(koksma_points p, koksma_star_method one, koksma_star_method other,
                  const char *kind, uint64_t round)
{
    static answer a, b;

    solve(&a, p, one);
    solve(&b, p, other);
    check_witness(&a.r, p);
    check_witness(&b.r, p);

    bool same =
        a.r.value.lower == b.r.value.lower && a.r.value.upper == b.r.value.upper;

    for (size_t k = 0; k < p.dim; k++)
        same = same && a.corner[k] == b.corner[k];
    ck_assert_msg(
        same,
        "%s, KOKSMA_TEST_SEED=%llu, set %llu, n %zu, dim %zu: %s [%a, %a] "
        "%zu inside, %s [%a, %a] %zu inside, or another witness",
        kind, (unsigned long long)oracle_seed(), (unsigned long long)round, p.n,
        p.dim, names[one], a.r.value.lower, a.r.value.upper, a.r.witness.inside,
        names[other], b.r.value.lower, b.r.value.upper, b.r.witness.inside);
}

static koksma_points make(double *x, coordinate *one, size_t n, size_t dim,
                          uint64_t round)
{
    oracle_rng rng = oracle_rng_start(oracle_seed(), round);

    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < dim; k++)
            x[i * dim + k] = one(&rng, i, k, n, dim);
    return (koksma_points){x, n, dim};
}

/* Kinds of sets with what they are called. */
static const struct kind {
    const char *name;
    coordinate *one;
} kinds[] = {
    {"random", random_one}, {"coarse", coarse}, {"mixed", mixed},
    {"crowded", crowded},   {"cross", cross},   {"vanishing", vanishing},
    {"extreme", extreme},
};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

static const struct shape {
    size_t dim, n;
} shapes[] = {{1, 10000}, {2, 3000}, {3, 1000}, {4, 500}, {6, 100}, {8, 50}};

enum { SHAPES = sizeof shapes / sizeof shapes[0] };

/* Sets of some size: what one or two cells or a table of a few rows do not show. */
START_TEST(large_sets)
{
    static double x[NUMBERS];
    const struct shape *s = &shapes[_i % SHAPES];
    const struct kind *kind = &kinds[_i / SHAPES];

    for (uint64_t round = 0; round < oracle_scale(); round++)
        agree(make(x, kind->one, s->n, s->dim, round), KOKSMA_STAR_TREE,
              KOKSMA_STAR_DEM, kind->name, round);
}
END_TEST

/* Many sets of a few points, where every n, also those that are no squares, and
 * every way of tying comes up; also with more axes than points. */
START_TEST(small_sets)
{
    static double x[NUMBERS];
    const struct kind *kind = &kinds[_i];

    for (uint64_t round = 0; round < 600 * oracle_scale(); round++) {
        size_t dim = 1 + (size_t)(round % 6), n = 1 + (size_t)(round / 6 % 20);
        koksma_points p = make(x, kind->one, n, dim, round);

        agree(p, KOKSMA_STAR_TREE, KOKSMA_STAR_DEM, kind->name, round);
        if (dim <= 4)
            agree(p, KOKSMA_STAR_SWEEP, KOKSMA_STAR_DEM, kind->name, round);
    }
}
END_TEST

/* Boxes that tie within the errors of their volumes, though none can be seen. */
START_TEST(vanishing_volumes)
{
    double x[32];

    for (uint64_t round = 0; round < 2000 * oracle_scale(); round++) {
        size_t dim = 2 + (size_t)(round % 3);
        koksma_points p = make(x, vanishing, 2 + (size_t)(round % 7), dim, round);

        agree(p, KOKSMA_STAR_TREE, KOKSMA_STAR_SWEEP, "vanishing", round);
        agree(p, KOKSMA_STAR_TREE, KOKSMA_STAR_DEM, "vanishing", round);
    }
}
END_TEST

START_TEST(more_axes_than_bits_in_a_word)
{
    double x[6 * DIMS];

    for (uint64_t round = 0; round < 8 * oracle_scale(); round++)
        for (size_t n = 1; n <= 3; n++)
            agree(make(x, kinds[round % KINDS].one, n, DIMS, round),
                  KOKSMA_STAR_TREE, KOKSMA_STAR_DEM, kinds[round % KINDS].name,
                  round);
}
END_TEST

/* 20 points: 16 at (1/4,1/4,1/4), one more along the first axis at 1/2, two along
 * the second at 1, one along the third at 1/2.  The closed boxes that end at
 * (1/4,1,1/4) and (1/2,1/4,1/2) tie for the best, with 18 points and volume 1/16.
 * To dem they are in the same cell, in which it comes upon the second one first. */
START_TEST(tie_in_a_cell)
{
    static const double best[] = {0.25, 1.0, 0.25};
    static answer a;
    double x[60];

    for (size_t i = 0; i < 60; i++)
        x[i] = 0.25;
    x[16 * 3] = 0.5;
    x[17 * 3 + 1] = x[18 * 3 + 1] = 1.0;
    x[19 * 3 + 2] = 0.5;
    for (int m = KOKSMA_STAR_SWEEP; m <= KOKSMA_STAR_DEM; m++) {
        solve(&a, (koksma_points){x, 20, 3}, (koksma_star_method)m);
        check_witness(&a.r, (koksma_points){x, 20, 3});
        ck_assert(a.r.value.lower <= 0.8375 && a.r.value.upper >= 0.8375);
        ck_assert_uint_eq(a.r.witness.inside, 18);
        for (size_t k = 0; k < 3; k++)
            ck_assert(a.corner[k] == best[k]);
    }
}
END_TEST

/* Families of low discrepancy, where little can be dropped; and full grids. */
static const struct family {
    const char *name;
    size_t dim, n;
    uint64_t start;
} families[] = {
    {"halton", 2, 4000, 1}, {"halton", 3, 1000, 1},    {"halton", 4, 500, 1},
    {"halton", 6, 100, 1},  {"halton", 8, 50, 1},      {"sobol", 3, 1024, 0},
    {"sobol", 5, 128, 0},   {"hammersley", 4, 343, 0}, {"grid", 3, 1000, 0},
    {"grid", 5, 1024, 0},   {"centred", 4, 625, 0},    {"centred", 6, 729, 0},
};

START_TEST(low_discrepancy)
{
    static double x[ROOM];
    const struct family *f = &families[_i];

    fill_all(x, f->name,
             (koksma_gen_opts){.dim = f->dim, .n = f->n, .start = f->start});
    agree((koksma_points){x, f->n, f->dim}, KOKSMA_STAR_TREE, KOKSMA_STAR_DEM,
          f->name, 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("star_methods");
    TCase *quick = tcase_create("quick"), *slow = tcase_create("slow");

    tcase_add_loop_test(quick, small_sets, 0, KINDS);
    tcase_add_test(quick, vanishing_volumes);
    tcase_add_test(quick, tie_in_a_cell);
    tcase_add_test(quick, more_axes_than_bits_in_a_word);
    tcase_add_loop_test(slow, large_sets, 0, KINDS * SHAPES);
    tcase_add_loop_test(slow, low_discrepancy, 0,
                        sizeof families / sizeof families[0]);
    tcase_set_tags(slow, "slow");
    tcase_set_timeout(quick, 20.0 * (double)oracle_scale());
    tcase_set_timeout(slow, 20.0 * (double)oracle_scale());
    suite_add_tcase(suite, quick);
    suite_add_tcase(suite, slow);
    return oracle_run(suite);
}
