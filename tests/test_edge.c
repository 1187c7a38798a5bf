/* koksma_edge and koksma_half_plane_local against the definition (edge_fixture.h),
 * the two methods against each other, and sets of which the value is known. */
#include <float.h>
#include <stdio.h>
#include <string.h>

#include "edge_fixture.h"
#include "gen.h"

enum { FEW = 24, MANY = 12000, BITS = 11 };

/* A set, and the same over integers. */
typedef struct test_set {
    double x[2 * FEW];
    long at[FEW][2];
    edge_grid grid;
    koksma_points p;
} test_set;

static void begin(test_set *s, unsigned bits)
{
    s->grid = (edge_grid){(oracle_int)1 << bits, 0, s->at};
}

static void add(test_set *s, long x, long y)
{
    size_t i = s->grid.n++;

    s->at[i][0] = x;
    s->at[i][1] = y;
    s->x[2 * i] = (double)x / (double)s->grid.size;
    s->x[2 * i + 1] = (double)y / (double)s->grid.size;
    s->p = (koksma_points){s->x, s->grid.n, 2};
}

/* Fails with all that it takes to see the case again. */
static void complain(const char *what, const test_set *s, uint64_t round,
                     const koksma_edge_result *r)
{
    char text[1500] = "";
    size_t used = 0;

    for (size_t i = 0; i < s->grid.n; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "\n  %.17g %.17g",
                                 s->x[2 * i], s->x[2 * i + 1]);
    ck_abort_msg("%s: got [%.17g, %.17g] at %.17g %.17g -> %.17g %.17g, "
                 "KOKSMA_TEST_SEED=%llu, set %llu:%s",
                 what, r->value.lower, r->value.upper, r->witness.from[0],
                 r->witness.from[1], r->witness.to[0], r->witness.to[1],
                 (unsigned long long)oracle_seed(), (unsigned long long)round,
                 text);
}

static koksma_edge_result solve(koksma_points p, koksma_edge_method method,
                                size_t threads)
{
    koksma_edge_opts opts = {.method = method, .threads = threads};
    koksma_edge_result r;
    koksma_error err = {0};

    ck_assert_msg(koksma_edge(&r, p, &opts, &err) == KOKSMA_OK, "%s", err.text);
    return r;
}

static bool same(const koksma_edge_result *a, const koksma_edge_result *b)
{
    return a->value.lower == b->value.lower && a->value.upper == b->value.upper &&
           memcmp(&a->witness, &b->witness, sizeof a->witness) == 0;
}

/* What is wrong with the witness, counted over the integers. */
static const char *witness_fault(const test_set *s, const koksma_edge_result *r)
{
    const koksma_half_plane *h = &r->witness;
    double size = (double)s->grid.size;
    long from[2] = {(long)(h->from[0] * size), (long)(h->from[1] * size)};
    long d[2] = {(long)(h->to[0] * size) - from[0],
                 (long)(h->to[1] * size) - from[1]};
    size_t inside;
    edge_ratio local = edge_local(&s->grid, from, d, &inside);
    koksma_interval again = koksma_half_plane_local(h, s->p);

    if (inside != h->inside) return "witness count";
    if (edge_compare(local, r->value.lower) < 0) return "witness below the value";
    if (!edge_contains(again, local)) return "the recount misses";
    if (!oracle_narrow(again)) return "the recount is wide";
    return NULL;
}

static void check_set(const test_set *s, uint64_t round)
{
    edge_ratio truth = edge_oracle(&s->grid);
    koksma_edge_result sweep = solve(s->p, KOKSMA_EDGE_SWEEP, 1);
    koksma_edge_result tree = solve(s->p, KOKSMA_EDGE_TREE, 1);
    const char *what = witness_fault(s, &sweep);

    if (what == NULL && !edge_contains(sweep.value, truth)) what = "D not inside";
    if (what == NULL && !oracle_narrow(sweep.value)) what = "too wide";
    if (what != NULL) complain(what, s, round, &sweep);
    if (!same(&sweep, &tree)) complain("the tree differs", s, round, &tree);
}

/* ---- Small sets --------------------------------------------------------- */

/* 25 places, so that corners, borders and the middle are there; n of them, in
 * rising order, may be the same. */
START_TEST(every_set_of_few_places)
{
    for (size_t n = 1; n <= 3; n++)
        for (unsigned i = 0; i < 25; i++)
            for (unsigned j = i; j < (n > 1 ? 25 : i + 1); j++)
                for (unsigned k = j; k < (n > 2 ? 25 : j + 1); k++) {
                    unsigned place[] = {i, j, k};
                    test_set s;

                    begin(&s, 2);
                    for (size_t q = 0; q < n; q++)
                        add(&s, place[q] % 5, place[q] / 5);
                    check_set(&s, (i * 25 + j) * 25 + k);
                }
}
END_TEST

/* A coordinate of a grid with 2^levels steps, both borders included. */
static long coordinate(oracle_rng *rng, unsigned levels)
{
    size_t steps = (size_t)1 << levels;

    return (long)(oracle_below(rng, steps + 1) << (BITS - levels));
}

static void random_set(test_set *s, uint64_t round)
{
    oracle_rng rng = oracle_rng_start(oracle_seed(), round);
    size_t n = 1 + oracle_below(&rng, round % 5 == 0 ? FEW : 9);
    unsigned levels = round % 3 == 0 ? BITS : (unsigned)oracle_below(&rng, 5);

    begin(s, BITS);
    while (s->grid.n < n) {
        size_t kind = oracle_below(&rng, 12);
        long x = coordinate(&rng, levels), y = coordinate(&rng, levels);
        long most = 1 << BITS;

        if (kind == 0) x = oracle_below(&rng, 2) ? most : 0;
        if (kind == 1) y = oracle_below(&rng, 2) ? most : 0;
        if (kind == 2) x = y;
        if (kind == 3) x = most - y;
        add(s, x, y);
        if (kind == 4 && s->grid.n < n) add(s, x, y);
    }
}

START_TEST(random_sets)
{
    for (uint64_t round = 0; round < 3000 * oracle_scale(); round++) {
        test_set s;

        random_set(&s, round);
        check_set(&s, round);
    }
}
END_TEST

/* That two points and the chord that one halves suffice, and no other line does
 * better. */
START_TEST(no_line_of_a_dense_scan_is_better)
{
    for (uint64_t round = 0; round < 40 * oracle_scale(); round++) {
        test_set s;
        koksma_edge_result r;
        oracle_rng rng = oracle_rng_start(oracle_seed(), round + 1000000);

        random_set(&s, round);
        r = solve(s.p, KOKSMA_EDGE_AUTO, 1);
        for (size_t i = 0; i < s.grid.n; i++)
            for (int turn = 0; turn < 1000; turn++) {
                long d[2] = {
                    (long)oracle_below(&rng, 1u << (BITS + 1)) - (1 << BITS),
                    (long)oracle_below(&rng, 1u << (BITS + 1)) - (1 << BITS)};

                if (d[0] == 0 && d[1] == 0) continue;
                if (edge_compare(edge_local(&s.grid, s.at[i], d, NULL),
                                 r.value.upper) > 0)
                    complain("a line is better", &s, round, &r);
            }
    }
}
END_TEST

/* ---- Known values ------------------------------------------------------- */

static void check_known(const double *x, size_t n, double value)
{
    for (int m = KOKSMA_EDGE_AUTO; m <= KOKSMA_EDGE_TREE; m++) {
        koksma_edge_result r =
            solve((koksma_points){x, n, 2}, (koksma_edge_method)m, 1);

        ck_assert_msg(r.value.lower <= value && value <= r.value.upper,
                      "method %d: [%.17g, %.17g], not %.17g", m, r.value.lower,
                      r.value.upper, value);
        ck_assert(oracle_narrow(r.value));
    }
}

START_TEST(by_hand)
{
    static const double corner[] = {1, 0, 1, 0, 1, 0}, border[] = {0, 0, 0, 1};
    static const double centre[] = {0.5, 0.5, 0.5, 0.5}, next[] = {0.25, 0.125};
    static const double diagonal[] = {0, 0, 0.25, 0.25, 0.5, 0.5, 1, 1};
    static const double opposite[] = {0, 0, 1, 1};
    static const double zeros[] = {-0.0, 0.5, 0.0, -0.0, 0.0, 0.5};

    check_known(corner, 3, 1.0); /* nothing but a corner */
    check_known(border, 2, 1.0); /* the points (0,0), (0,1) and no area */
    check_known(centre, 2, 0.5); /* one half */
    check_known(next, 1, 1.0 - 2.0 * 0.25 * 0.125);
    check_known(diagonal, 4, 0.5); /* the diagonal and half of the square */
    check_known(opposite, 2, 0.5);
    check_known(zeros, 3, 1.0);

    koksma_half_plane h =
        solve((koksma_points){zeros, 3, 2}, KOKSMA_EDGE_AUTO, 1).witness;

    for (int k = 0; k < 2; k++) /* no -0 */
        ck_assert(!signbit(h.from[k]) && !signbit(h.to[k]));
}
END_TEST

/* On a line, and next to it by less than arithmetic sees.  The value is nearly the
 * same, but no three points are in line any more, and the bits and the counts show
 * who takes rounded signs. */
START_TEST(almost_in_line)
{
    enum { N = 40 };
    double x[2 * N];
    koksma_points p = {x, N, 2};

    for (int i = 0; i < N; i++) {
        x[2 * i] = (i + 1) / 64.0;
        x[2 * i + 1] = x[2 * i] / 2.0 + 0.25;
    }

    koksma_edge_result line = solve(p, KOKSMA_EDGE_TREE, 1);
    koksma_edge_result swept = solve(p, KOKSMA_EDGE_SWEEP, 1);

    ck_assert(same(&line, &swept));
    ck_assert_uint_eq(line.witness.inside, N);
    for (int i = 0; i < N; i++)
        x[2 * i + 1] = nextafter(x[2 * i + 1], i * i % 3);

    koksma_edge_result bent = solve(p, KOKSMA_EDGE_TREE, 1);

    swept = solve(p, KOKSMA_EDGE_SWEEP, 1);
    ck_assert_msg(same(&bent, &swept), "[%a, %a], [%a, %a]", bent.value.lower,
                  bent.value.upper, swept.value.lower, swept.value.upper);
    ck_assert_double_eq_tol(bent.value.lower, line.value.lower, 1e-15);
    ck_assert(bent.value.lower != line.value.lower);
    ck_assert(koksma_half_plane_local(&bent.witness, p).lower >= bent.value.lower);
}
END_TEST

/* Multiples of a point by powers of two are exactly on a line with the origin,
 * though no difference of two is a double, and no slope the same. */
START_TEST(in_line_but_not_in_doubles)
{
    enum { N = 12, LINE = 7 };

    for (uint64_t round = 0; round < 200 * oracle_scale(); round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        double x[2 * N];
        koksma_points p = {x, N, 2};

        for (size_t i = 0; i < 2 * N; i++)
            x[i] = oracle_dyadic(&rng, 53);
        for (size_t i = 2; i < 2 * LINE; i++)
            x[i] = ldexp(x[i % 2], -3 * (int)(i / 2));

        koksma_edge_result sweep = solve(p, KOKSMA_EDGE_SWEEP, 1);
        koksma_edge_result tree = solve(p, KOKSMA_EDGE_TREE, 1);
        koksma_interval again = koksma_half_plane_local(&sweep.witness, p);
        const double *last = x + 2 * (LINE - 1);

        ck_assert_msg(same(&sweep, &tree), "set %llu: [%a, %a], [%a, %a]",
                      (unsigned long long)round, sweep.value.lower,
                      sweep.value.upper, tree.value.lower, tree.value.upper);
        ck_assert(again.lower == sweep.value.lower);
        for (int turn = 0; turn < 2; turn++) {
            koksma_half_plane h = {{x[0], x[1]}, {last[0], last[1]}, 0};

            if (turn) h = (koksma_half_plane){{last[0], last[1]}, {x[0], x[1]}, 0};
            again = koksma_half_plane_local(&h, p);
            ck_assert(again.lower <= sweep.value.lower);
        }
    }
}
END_TEST

/* Coordinates whose products are below the range of doubles. */
START_TEST(tiny_coordinates)
{
    static const double x[] = {0,        0,         0x1p-600, 0x1p-600, 0x1p-599,
                               0x1p-598, 0x1p-1074, 0,        0,        0x1p-1074,
                               0x1p-599, 0x1p-599,  1,        1};
    koksma_points p = {x, 7, 2};
    koksma_edge_result sweep = solve(p, KOKSMA_EDGE_SWEEP, 1);
    koksma_edge_result tree = solve(p, KOKSMA_EDGE_TREE, 1);
    static const koksma_half_plane below = {{0, 0}, {0x1p-599, 0x1p-599}, 0};
    static const koksma_half_plane above = {{0x1p-599, 0x1p-599}, {0, 0}, 0};

    ck_assert(same(&sweep, &tree));
    ck_assert(sweep.value.lower <= 6.0 / 7.0 && sweep.value.upper >= 6.0 / 7.0);
    /* Six are on or left of the diagonal, one is right: but for exact signs all
     * seven would be on it. */
    ck_assert_double_eq_tol(koksma_half_plane_local(&below, p).lower,
                            6.0 / 7.0 - 0.5, 1e-15);
    ck_assert_double_eq_tol(koksma_half_plane_local(&above, p).lower,
                            5.0 / 7.0 - 0.5, 1e-15);
}
END_TEST

/* Points in a spot stay together in all cells of lines through it, and by a corner
 * and the middle lines of the square there are very many of these that seem as good
 * as any: the tree has to see that it is in vain. */
START_TEST(crowded_in_a_spot)
{
    static const double spots[][2] = {
        {0.0, 0.0}, {1.0, 0.0}, {0.5, 0.5}, {0.5, 0.3}};

    for (size_t i = 0; i < 4; i++)
        for (int down = 20; down <= 52; down += 16) {
            double x[2 * FEW];
            koksma_points p = {x, FEW, 2};
            oracle_rng rng = oracle_rng_start(oracle_seed(), i);

            for (size_t j = 0; j < 2 * FEW; j++) {
                double off = ldexp(oracle_dyadic(&rng, 53), -down);
                double spot = spots[i][j % 2];

                x[j] = spot > 0.5 ? spot - off : spot + off;
                if (j >= FEW + 6) x[j] = oracle_dyadic(&rng, 53);
            }

            koksma_edge_result sweep = solve(p, KOKSMA_EDGE_SWEEP, 1);
            koksma_edge_result tree = solve(p, KOKSMA_EDGE_TREE, 1);
            koksma_edge_result two = solve(p, KOKSMA_EDGE_TREE, 2);

            ck_assert(same(&sweep, &tree) && same(&sweep, &two));
            ck_assert_double_le(tree.work, 0x1p19);
        }
}
END_TEST

/* The same where there is nothing else, and the first lines that come to mind are
 * bad. */
START_TEST(nearly_at_one_place)
{
    enum { N = 70 };
    double x[2 * N];
    koksma_points p = {x, N, 2};

    for (uint64_t round = 0; round < 2; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);

        for (size_t i = 0; i < 2 * N; i++)
            x[i] =
                0.25 + (double)oracle_below(&rng, 64) * (round ? 0x1p-53 : 0x1p-36);

        koksma_edge_result sweep = solve(p, KOKSMA_EDGE_SWEEP, 1);
        koksma_edge_result tree = solve(p, KOKSMA_EDGE_TREE, 1);

        ck_assert(same(&sweep, &tree));
        ck_assert_double_le(tree.work, 0x1p19);
    }
}
END_TEST

/* ---- Larger sets -------------------------------------------------------- */

static const struct source {
    const char *family;
    size_t n;
    double levels; /* > 0: moved to a grid of so many steps; -1, -2, -3, -4:
                 * crowded at the left, at the bottom, at the right, at the top */
} sources[] =
    {
        {"random", 300, 0},  {"halton", 300, 0},     {"hammersley", 257, 0},
        {"random", 500, 9},  {"random", 400, 10},    {"centred", 225, 0},
        {"sobol", 256, 0},   {"grid", 121, 0},       {"random", 200, 1},
        {"random", 600, 20}, {"halton", 700, 24},    {"random", 300, -1},
        {"random", 300, -2}, {"random", 300, -3},    {"random", 300, -4},
        {"halton", 1000, 0}, {"hammersley", 999, 0},
},
  larger[] = {
      {"random", 1000, 0},   {"halton", 1000, 0},  {"hammersley", 1024, 0},
      {"random", 1000, 9},   {"random", 5000, 0},  {"halton", 5000, 0},
      {"centred", 1024, 0},  {"sobol", 4096, 0},   {"grid", 1024, 0},
      {"random", 3000, 100}, {"random", 10000, 0}, {"halton", 10000, 0},
};

/* The points live until the next call. */
static koksma_points points_of(const struct source *s)
{
    static double x[2 * MANY];
    koksma_gen_opts o = {.dim = 2, .n = s->n, .seed = oracle_seed()};
    koksma_gen *g;

    ck_assert_int_eq(koksma_gen_open(&g, koksma_gen_find(s->family), &o, NULL),
                     KOKSMA_OK);
    ck_assert_int_eq(koksma_gen_fill(g, x, 0, s->n, NULL), KOKSMA_OK);
    koksma_gen_close(g);
    for (size_t i = 0; i < 2 * s->n; i++) {
        if (s->levels > 0.0) x[i] = round(x[i] * s->levels) / s->levels;
        if (s->levels < 0.0 && (int)-s->levels % 2 == (int)(i + 1) % 2) {
            double near = 0.05 * pow(x[i], 4.0);

            x[i] = s->levels < -2.0 ? 1.0 - near : near;
        }
    }
    return (koksma_points){x, s->n, 2};
}

static void check_agreement(const struct source *s, size_t threads)
{
    koksma_points p = points_of(s);
    koksma_edge_result sweep = solve(p, KOKSMA_EDGE_SWEEP, threads);
    koksma_edge_result tree = solve(p, KOKSMA_EDGE_TREE, threads);
    koksma_interval again = koksma_half_plane_local(&tree.witness, p);

    ck_assert_msg(same(&sweep, &tree), "%s %zu %g: [%.17g, %.17g], [%.17g, %.17g]",
                  s->family, s->n, s->levels, sweep.value.lower, sweep.value.upper,
                  tree.value.lower, tree.value.upper);
    ck_assert(oracle_narrow(tree.value));
    ck_assert(again.lower == tree.value.lower);
}

START_TEST(methods_agree)
{
    for (size_t i = 0; i < sizeof sources / sizeof sources[0]; i++)
        check_agreement(&sources[i], 1);
}
END_TEST

START_TEST(methods_agree_on_larger_sets)
{
    for (size_t i = 0; i < sizeof larger / sizeof larger[0]; i++)
        check_agreement(&larger[i], 0);
}
END_TEST

START_TEST(threads_do_not_matter)
{
    for (size_t i = 0; i < sizeof sources / sizeof sources[0]; i++) {
        koksma_points p = points_of(&sources[i]);
        koksma_edge_result one = solve(p, KOKSMA_EDGE_TREE, 1);

        for (size_t threads = 2; threads <= 5; threads += 3)
            for (int m = KOKSMA_EDGE_SWEEP; m <= KOKSMA_EDGE_TREE; m++) {
                koksma_edge_result other = solve(p, (koksma_edge_method)m, threads);

                ck_assert_msg(same(&one, &other), "%s, method %d, %zu threads",
                              sources[i].family, m, threads);
            }
    }
}
END_TEST

/* Repeating every point changes nothing, and neither do mirrors. */
START_TEST(symmetries)
{
    for (size_t i = 0; i < 3; i++) {
        koksma_points p = points_of(&sources[i]);
        koksma_edge_result r = solve(p, KOKSMA_EDGE_AUTO, 1);
        double *x = calloc(4 * p.n, sizeof *x);

        ck_assert(x != NULL);
        for (size_t j = 0; j < 2 * p.n; j++)
            x[j] = x[2 * p.n + j] = p.x[j];

        koksma_edge_result twice =
            solve((koksma_points){x, 2 * p.n, 2}, KOKSMA_EDGE_AUTO, 1);

        for (size_t j = 0; j < p.n; j++) {
            x[2 * j] = p.x[2 * j + 1];
            x[2 * j + 1] = p.x[2 * j];
        }

        koksma_edge_result swapped =
            solve((koksma_points){x, p.n, 2}, KOKSMA_EDGE_AUTO, 1);

        ck_assert_double_eq_tol(twice.value.lower, r.value.lower, 1e-17);
        ck_assert_uint_eq(twice.witness.inside, 2 * r.witness.inside);
        ck_assert_double_eq_tol(swapped.value.lower, r.value.lower, 1e-17);
        free(x);
    }
}
END_TEST

/* ---- Options, stops, refusals ------------------------------------------- */

START_TEST(tolerance_and_stages)
{
    koksma_points p = points_of(&larger[1]);
    koksma_edge_result exact = solve(p, KOKSMA_EDGE_TREE, 1), r;
    koksma_edge_opts opts = {
        .method = KOKSMA_EDGE_TREE, .anytime = true, .threads = 1};

    ck_assert_int_eq(koksma_edge(&r, p, &opts, NULL), KOKSMA_OK);
    ck_assert(same(&exact, &r));
    opts.tolerance = 0.2;
    opts.anytime = false;
    ck_assert_int_eq(koksma_edge(&r, p, &opts, NULL), KOKSMA_OK);
    ck_assert(r.value.lower <= exact.value.upper);
    ck_assert(r.value.upper >= exact.value.lower);
    ck_assert(r.value.upper <= 1.2 * r.value.lower * (1.0 + 1e-12));
    ck_assert(r.work < exact.work);
}
END_TEST

typedef struct watch {
    int calls, stop_at;
    double lower, upper, work;
} watch;

static int on_progress(void *state, double lower, double upper, double work)
{
    watch *w = state;

    ck_assert(lower >= w->lower && upper <= w->upper && work >= w->work);
    w->lower = lower;
    w->upper = upper;
    w->work = work;
    return ++w->calls >= w->stop_at;
}

START_TEST(stopped_results_are_true)
{
    koksma_points p = points_of(&larger[0]);
    koksma_edge_result exact = solve(p, KOKSMA_EDGE_TREE, 1);

    for (int stop = 1; stop < 12; stop += 2)
        for (int m = KOKSMA_EDGE_SWEEP; m <= KOKSMA_EDGE_TREE; m++) {
            watch w = {.stop_at = stop, .upper = 1.0};
            koksma_edge_opts opts = {.method = (koksma_edge_method)m,
                                     .anytime = true,
                                     .progress = on_progress,
                                     .state = &w};
            koksma_edge_result r = {0};
            koksma_status status = koksma_edge(&r, p, &opts, NULL);

            if (w.calls < stop)
                ck_assert_int_eq(status, KOKSMA_OK);
            else
                ck_assert_int_eq(status, KOKSMA_STOPPED);
            ck_assert(r.value.lower <= exact.value.upper);
            ck_assert(r.value.upper >= exact.value.lower);
            ck_assert(koksma_half_plane_local(&r.witness, p).lower >=
                      r.value.lower);
        }
}
END_TEST

/* A long search reports on the way, so that it can be stopped. */
static int note_gap(void *state, double lower, double upper, double work)
{
    watch *w = state;

    (void)lower;
    (void)upper;
    w->upper = fmax(w->upper, work - w->work); /* the longest silence */
    w->work = work;
    return 0;
}

START_TEST(reports_on_the_way)
{
    enum { N = 8000 };
    static double x[2 * N];
    oracle_rng rng = oracle_rng_start(oracle_seed(), 77);
    watch w = {0};
    koksma_edge_opts opts = {.method = KOKSMA_EDGE_TREE,
                             .threads = 1,
                             .progress = note_gap,
                             .state = &w};
    koksma_edge_result r;

    for (size_t i = 0; i < 2 * (size_t)N; i++)
        x[i] = oracle_dyadic(&rng, 53);
    ck_assert_int_eq(koksma_edge(&r, (koksma_points){x, N, 2}, &opts, NULL),
                     KOKSMA_OK);
    ck_assert_double_gt(r.work, 0x1p23);
    ck_assert_double_le(fmax(w.upper, r.work - w.work), 0x1.4p22);
}
END_TEST

START_TEST(refusals)
{
    static const double x[] = {0.5, 0.5, 0.5, 1.5, 0.5, 0.5};
    koksma_edge_result r = {.work = 7.0};
    koksma_edge_opts bad = {.tolerance = -1.0};
    koksma_error err;

    ck_assert_int_eq(koksma_edge(&r, (koksma_points){x, 1, 3}, NULL, &err),
                     KOKSMA_EINVAL);
    ck_assert_int_eq(koksma_edge(&r, (koksma_points){x, 3, 2}, NULL, &err),
                     KOKSMA_EDOMAIN);
    ck_assert_int_eq(koksma_edge(&r, (koksma_points){x, 1, 1}, NULL, &err),
                     KOKSMA_EINVAL);
    ck_assert_str_eq(err.text, "half-planes take 2 coordinates, not 1");
    ck_assert_int_eq(koksma_edge(&r, (koksma_points){x, 0, 2}, NULL, &err),
                     KOKSMA_EINVAL);
    ck_assert_int_eq(koksma_edge(&r, (koksma_points){x, 1, 2}, &bad, &err),
                     KOKSMA_EINVAL);
    bad.tolerance = (double)NAN;
    ck_assert_int_eq(koksma_edge(&r, (koksma_points){x, 1, 2}, &bad, &err),
                     KOKSMA_EINVAL);
    bad = (koksma_edge_opts){.method = (koksma_edge_method)3};
    ck_assert_int_eq(koksma_edge(&r, (koksma_points){x, 1, 2}, &bad, &err),
                     KOKSMA_EINVAL);
    ck_assert_double_eq(r.work, 7.0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("edge");
    TCase *tc = tcase_create("edge"), *big = tcase_create("big");
    TCase *threads = tcase_create("threads");

    tcase_add_test(tc, every_set_of_few_places);
    tcase_add_test(tc, random_sets);
    tcase_add_test(tc, no_line_of_a_dense_scan_is_better);
    tcase_add_test(tc, by_hand);
    tcase_add_test(tc, almost_in_line);
    tcase_add_test(tc, in_line_but_not_in_doubles);
    tcase_add_test(tc, tiny_coordinates);
    tcase_add_test(tc, crowded_in_a_spot);
    tcase_add_test(tc, nearly_at_one_place);
    tcase_add_test(tc, methods_agree);
    tcase_add_test(tc, symmetries);
    tcase_add_test(tc, tolerance_and_stages);
    tcase_add_test(tc, stopped_results_are_true);
    tcase_add_test(tc, reports_on_the_way);
    tcase_add_test(tc, refusals);
    tcase_set_timeout(tc, 600);
    suite_add_tcase(suite, tc);
    tcase_add_test(threads, threads_do_not_matter);
    tcase_set_tags(threads, "threads");
    tcase_set_timeout(threads, 600);
    suite_add_tcase(suite, threads);
    tcase_add_test(big, methods_agree_on_larger_sets);
    tcase_set_tags(big, "big");
    tcase_set_timeout(big, 600);
    suite_add_tcase(suite, big);
    return oracle_run(suite);
}
