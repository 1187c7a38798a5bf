/* The kernels under koksma_box_discrepancy, one by one: the linear bounds of
 * volumes hold at every box of a cell, no box that matters is cut off, and the best
 * interval of a widening strip is that of a plain recount. */
#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "box_kernels.h"
#include "box_sweep_kernels.h"
#include "oracle.h"

enum { DIMS = 4, POINTS = 40, DRAWS = 60 };

typedef struct fixture {
    double x[POINTS * DIMS];
    koksma_points p;
    oracle_rng rng;
    uint64_t round;
    ki_ranks ranks;
    ki_worker w;
} fixture;

static void require(const fixture *f, bool holds, const char *what)
{
    if (!holds)
        ck_abort_msg("%s: KOKSMA_TEST_SEED=%llu, set %llu, n %zu, dim %zu", what,
                     (unsigned long long)oracle_seed(),
                     (unsigned long long)f->round, f->p.n, f->p.dim);
}

static void make_set(fixture *f, uint64_t round)
{
    f->rng = oracle_rng_start(oracle_seed(), round);
    f->round = round;
    f->p = (koksma_points){f->x, 1 + oracle_below(&f->rng, POINTS),
                           1 + (size_t)(round % DIMS)};
    for (size_t i = 0; i < f->p.n * f->p.dim; i++)
        f->x[i] = round % 3 == 0 ? (double)oracle_below(&f->rng, 5) / 4.0
                                 : oracle_dyadic(&f->rng, 53);
}

/* ---- Cells ------------------------------------------------------------------- */

static void draw_corner(fixture *f, const ki_cell *c, uint32_t *z)
{
    for (size_t k = 0; k < f->ranks.axes; k++)
        z[k] =
            c->low[k] + (uint32_t)oracle_below(&f->rng, c->high[k] - c->low[k] + 1);
}

static double corner(const fixture *f, const uint32_t *z, size_t k)
{
    return f->ranks.axis[k].value[z[k]];
}

/* The volume, or -1 if the sides cross; and the points inside. */
static double volume(const fixture *f, const uint32_t *z, size_t *inside)
{
    double both[2 * DIMS], v = 1.0;

    for (size_t k = 0; k < 2 * f->p.dim; k++)
        both[k] = corner(f, z, k);
    for (size_t k = 0; k < f->p.dim; k++) {
        if (both[k] > both[f->p.dim + k]) return -1.0;
        v *= both[f->p.dim + k] - both[k];
    }
    *inside = oracle_count_between(f->p, both, f->ranks.closed);
    return v;
}

static double slope_to(const fixture *f, const ki_cell *c, const uint32_t *z)
{
    double sum = 0.0;

    for (size_t k = 0; k < f->ranks.axes; k++) {
        const double *place = f->ranks.axis[k].place;

        sum += f->w.slope[k] * (f->ranks.closed ? place[z[k]] - place[c->low[k]]
                                                : place[c->high[k]] - place[z[k]]);
    }
    return sum;
}

/* 1e-12 is the rounding of this test. */
static void check_line(fixture *f, const ki_cell *c, double target)
{
    double n = (double)f->p.n;
    double inside = (double)c->inside / n, most = (double)c->within / n;
    ki_slopes line;
    uint32_t z[2 * DIMS];
    size_t count;

    (f->ranks.closed ? ki_box_measure.closed
                     : ki_box_measure.open)(&f->w, c, target, 0, &line);
    for (int draw = 0; draw < DRAWS; draw++) {
        double v;

        draw_corner(f, c, z);
        if (draw == 0) memcpy(z, c->low, f->ranks.axes * sizeof *z);
        if (draw == 1) memcpy(z, c->high, f->ranks.axes * sizeof *z);
        v = volume(f, z, &count);
        if (v < 0.0) continue;
        if (f->ranks.closed) {
            require(f, most - v <= line.quick, "quick, closed");
            if (line.quick >= target && v < most - target)
                require(f, v >= line.base + slope_to(f, c, z) - 1e-12,
                        "line, closed");
        } else {
            require(f, v - inside <= line.quick, "quick, open");
            if (line.quick >= target && v >= target + inside)
                require(f, v <= line.base - slope_to(f, c, z) + 1e-12,
                        "line, open");
        }
    }
}

/* Boxes of ranks that a point or a face holds, as critical ones are. */
static bool is_listed(const fixture *f, const ki_cell *c, const uint32_t *z)
{
    for (size_t k = 0; k < f->ranks.axes; k++) {
        bool listed = !f->ranks.closed && z[k] == f->ranks.axis[k].top;

        for (size_t i = c->begin[k]; i < c->end[k]; i++)
            listed = listed || f->w.entry[i].rank == z[k];
        if (!listed) return false;
    }
    return true;
}

static void check_bound(fixture *f, const ki_cell *c, double target)
{
    double bound = ki_cell_bound(&f->w, c, target), n = (double)f->p.n;
    uint32_t z[2 * DIMS];
    size_t count;

    require(f, fabs(bound) < HUGE_VAL, "no bound");
    for (int draw = 0; draw < DRAWS; draw++) {
        double v, deviation;

        draw_corner(f, c, z);
        v = volume(f, z, &count);
        if (v < 0.0 || !is_listed(f, c, z)) continue;
        deviation = f->ranks.closed ? (double)count / n - v : v - (double)count / n;
        if (deviation < target + 1e-12) continue;
        require(f, bound >= deviation - 1e-12, "the bound is too low");
        for (size_t k = 0; k < f->ranks.axes; k++)
            require(f, f->w.new_low[k] <= z[k] && z[k] <= f->w.new_high[k],
                    "a box is cut off");
    }
}

static void check_cell(fixture *f)
{
    ki_cell *c = ki_cell_enter(&f->w, 1);
    uint32_t z[2 * DIMS];
    bool empty = false;

    ck_assert(c != NULL);
    for (int cuts = 0; cuts < 3 && !empty; cuts++) {
        draw_corner(f, c, z);
        for (size_t k = 0; k < f->ranks.axes; k++) {
            bool up = oracle_below(&f->rng, 2) == 0;

            f->w.new_low[k] = up ? z[k] : c->low[k];
            f->w.new_high[k] = up ? c->high[k] : z[k];
        }
        ck_assert(ki_cell_narrow(&f->w, c) && ki_cell_settle(&f->w, c, &empty));
        for (int t = 0; t < 3 && !empty; t++) {
            double target = oracle_dyadic(&f->rng, 20) * oracle_dyadic(&f->rng, 20);

            check_line(f, c, target);
            check_bound(f, c, target);
        }
    }
    ki_cell_leave(&f->w, c);
}

START_TEST(bounds_hold)
{
    static fixture f;

    for (uint64_t round = 0; round < 400 * oracle_scale(); round++) {
        make_set(&f, round);
        for (int closed = 0; closed < 2; closed++) {
            ck_assert(ki_ranks_make(&f.ranks, f.p, closed, &ki_box_measure) ==
                      KOKSMA_OK);
            ck_assert(ki_worker_begin(&f.w, NULL, &f.ranks) == KOKSMA_OK);
            for (int cells = 0; cells < 4; cells++)
                check_cell(&f);
            ki_worker_end(&f.w);
            ki_ranks_free(&f.ranks);
        }
    }
}
END_TEST

/* ---- Strips ------------------------------------------------------------------ */

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;

    return (x > y) - (x < y);
}

/* The greatest excess, or 0, over all pairs of ends. */
static double plain_best(const double *y, const bool *there, size_t n, double W,
                         bool closed)
{
    double best = 0.0;

    for (size_t i = 0; i <= n; i++)
        for (size_t j = i > 0 ? i : 1; j <= n + 1; j++) {
            double low = i == 0 ? 0.0 : y[i - 1], high = j > n ? 1.0 : y[j - 1];
            double count = 0.0;

            for (size_t l = 0; l < n; l++)
                count += there[l] && (closed ? y[l] >= low && y[l] <= high
                                             : y[l] > low && y[l] < high);
            best = fmax(best, closed ? count - W * (high - low)
                                     : W * (high - low) - count);
        }
    return best;
}

START_TEST(the_best_interval_of_a_strip)
{
    for (uint64_t round = 0; round < 150 * oracle_scale(); round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        size_t n = 1 + oracle_below(&rng, 20), places = ki_kinetic_places(n);
        double y[20], gap[64], W = 0.0;
        bool there[20] = {false};
        ki_span_best node[128];
        ki_kinetic t = {
            .closed = round % 2 == 1, .places = places, .gap = gap, .node = node};

        for (size_t i = 0; i < n; i++)
            y[i] = round % 3 == 0 ? (double)oracle_below(&rng, 5) / 4.0
                                  : oracle_dyadic(&rng, 53);
        qsort(y, n, sizeof *y, ascending);
        ki_kinetic_gaps(gap, places, y, n);
        ki_kinetic_start(&t, there, n, W);
        for (size_t step = 0; step < 2 * n; step++) {
            size_t i = oracle_below(&rng, n);

            if (round % 5 > 0) W += oracle_dyadic(&rng, 53);
            if (oracle_below(&rng, 3) > 0 && !there[i]) {
                there[i] = true;
                if (oracle_below(&rng, 9) == 0)
                    ki_kinetic_start(&t, there, n, W);
                else
                    ki_kinetic_insert(&t, i, W);
            }

            double best = ki_kinetic_best(&t, W);
            double truth = plain_best(y, there, n, W, t.closed);

            ck_assert_msg(fabs(best - truth) < 1e-12 * (W + 1.0),
                          "KOKSMA_TEST_SEED=%llu, set %llu: %.17g for %.17g",
                          (unsigned long long)oracle_seed(),
                          (unsigned long long)round, best, truth);
        }
    }
}
END_TEST

/* The sweep without the climbs that otherwise find the best box before it starts.
 */
static void check_sweep(koksma_points p, uint64_t round)
{
    double corners[4] = {0}, tree_corners[4] = {0}, upper, work;
    ki_best best = ki_best_begin_between(p, corners);
    ki_run_opts opts = {.threads = 1};
    koksma_box_opts tree = {.method = KOKSMA_BOX_TREE, .threads = 1};
    koksma_box_result r = {.witness.corners = tree_corners};
    bool stopped;

    ck_assert(ki_box_sweep(&best, &opts, &upper, &work, &stopped) == KOKSMA_OK);
    ck_assert(koksma_box_discrepancy(&r, p, &tree, NULL) == KOKSMA_OK);
    ck_assert_msg(best.value.lower == r.value.lower && upper == r.value.upper &&
                      memcmp(corners, tree_corners, sizeof corners) == 0,
                  "KOKSMA_TEST_SEED=%llu, set %llu, n %zu: sweep [%.17g, %.17g], "
                  "tree [%.17g, %.17g]",
                  (unsigned long long)oracle_seed(), (unsigned long long)round, p.n,
                  best.value.lower, upper, r.value.lower, r.value.upper);
}

START_TEST(the_sweep_alone)
{
    static double x[2 * 300];

    for (uint64_t round = 0; round < 800 * oracle_scale(); round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        size_t n = 1 + oracle_below(&rng, round % 50 == 0 ? 300 : 20);

        for (size_t i = 0; i < 2 * n; i++)
            x[i] = round % 3 == 0 ? (double)oracle_below(&rng, 9) / 8.0
                                  : oracle_dyadic(&rng, 53);
        check_sweep((koksma_points){x, n, 2}, round);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("box_bound");
    TCase *all = tcase_create("all");

    tcase_add_test(all, bounds_hold);
    tcase_add_test(all, the_best_interval_of_a_strip);
    tcase_add_test(all, the_sweep_alone);
    tcase_set_timeout(all, 600);
    suite_add_tcase(suite, all);
    return oracle_run(suite);
}
