/* The kernels of koksma_edge's tree, against plain loops.  Coordinates are
 * multiples of 2^-20 and cells of 2^-7, so that heights are exact, and equal or
 * farther apart than the kernels' margins. */
#include <stdlib.h>

#include "edge_kernels.h"
#include "oracle.h"

enum { MOST = 40, ROOM = MOST + KI_EDGE_LANES };

typedef struct cell_case {
    double x[ROOM], y[ROOM], w[ROOM];
    ki_edge_cell cell;
    ki_edge_list list;
} cell_case;

static void make(cell_case *s, uint64_t round)
{
    oracle_rng rng = oracle_rng_start(oracle_seed(), round);
    size_t n = oracle_below(&rng, MOST + 1);

    for (size_t i = 0; i < n; i++) {
        s->x[i] = oracle_below(&rng, 8) ? oracle_dyadic(&rng, 20) : 1.0;
        s->y[i] = oracle_below(&rng, 8) ? oracle_dyadic(&rng, 20)
                                        : oracle_dyadic(&rng, 5);
        s->w[i] = 1.0 + (double)oracle_below(&rng, 9);
    }
    ki_edge_pad(s->x, s->y, s->w, n);
    s->cell = (ki_edge_cell){ldexp((double)oracle_below(&rng, 256) - 64.0, -7),
                             ldexp((double)oracle_below(&rng, 256) - 64.0, -7),
                             ldexp(1.0, -(int)oracle_below(&rng, 7))};
    s->list = (ki_edge_list){.x = s->x,
                             .y = s->y,
                             .w = round % 2 ? s->w : NULL,
                             .count = n,
                             .under = 7.0};
}

static double height(double u, double v, double x) { return u + (v - u) * x; }

static bool is_below(const ki_edge_cell *c, double x, double y)
{
    return y < height(c->u, c->v, x);
}

static bool is_above(const ki_edge_cell *c, double x, double y)
{
    return y > height(c->u + c->side, c->v + c->side, x);
}

START_TEST(splits)
{
    for (uint64_t round = 0; round < 2000 * oracle_scale(); round++) {
        cell_case s;
        ki_edge_split split;

        make(&s, round);
        ki_edge_cell_split(&split, &s.cell, &s.list);
        for (int k = 0; k < KI_EDGE_PARTS; k++) {
            double d = 0.5 * s.cell.side, below = 0.0, above = 0.0;
            ki_edge_cell part = {s.cell.u + d * (k % 2), s.cell.v + d * (k / 2), d};

            for (size_t i = 0; i < s.list.count; i++) {
                double w = s.list.w != NULL ? s.w[i] : 1.0;

                if (is_below(&part, s.x[i], s.y[i])) below += w;
                if (is_above(&part, s.x[i], s.y[i])) above += w;
            }
            ck_assert_msg(split.below[k] == below && split.above[k] == above,
                          "KOKSMA_TEST_SEED=%llu, case %llu, part %d",
                          (unsigned long long)oracle_seed(),
                          (unsigned long long)round, k);
        }
    }
}
END_TEST

START_TEST(kept_points)
{
    for (uint64_t round = 0; round < 2000 * oracle_scale(); round++) {
        cell_case s;
        double x[ROOM], y[ROOM], w[ROOM], under = 3.0, below = 3.0;
        size_t kept, k = 0;

        make(&s, round);
        kept = ki_edge_cell_keep(x, y, s.list.w != NULL ? w : NULL, &under, &s.cell,
                                 &s.list);
        for (size_t i = 0; i < s.list.count; i++) {
            double weight = s.list.w != NULL ? s.w[i] : 1.0;

            if (is_below(&s.cell, s.x[i], s.y[i])) below += weight;
            if (is_below(&s.cell, s.x[i], s.y[i]) ||
                is_above(&s.cell, s.x[i], s.y[i]))
                continue;
            ck_assert(k < kept && x[k] == s.x[i] && y[k] == s.y[i]);
            ck_assert(s.list.w == NULL || w[k] == weight);
            k++;
        }
        ck_assert_uint_eq(kept, k);
        ck_assert(under == below);
    }
}
END_TEST

/* The area below a line, as the mean of its height where that is cut at 0 and 1. */
START_TEST(areas)
{
    enum { STEPS = 20000 };

    for (uint64_t round = 0; round < 200; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        double u = 3.0 * oracle_dyadic(&rng, 20) - 1.0;
        double v = 3.0 * oracle_dyadic(&rng, 20) - 1.0, sum = 0.0;

        for (int i = 0; i < STEPS; i++)
            sum += fmin(fmax(height(u, v, (i + 0.5) / STEPS), 0.0), 1.0);
        ck_assert_double_eq_tol(ki_edge_area_below(u, v), sum / STEPS, 1e-7);
    }
    ck_assert(ki_edge_area_below(1.0, 1.0) == 1.0);
    ck_assert(ki_edge_area_below(1.5, 1.25) == 1.0);
    ck_assert(ki_edge_area_below(0.0, 0.0) == 0.0);
    ck_assert(ki_edge_area_below(-1.0, 0.0) == 0.0);
}
END_TEST

START_TEST(sorted_slopes)
{
    enum { N = 500 };

    for (uint64_t round = 0; round < 200; round++) {
        static ki_edge_event a[N], b[N];
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        size_t n = oracle_below(&rng, N + 1);
        double width = ldexp(2.0, -(int)(oracle_below(&rng, 3) * 20)), sum = 0.0;
        ki_edge_event *e;

        for (size_t i = 0; i < n; i++) {
            double slope = width * (oracle_dyadic(&rng, 30) - 0.5);

            a[i] = (ki_edge_event){slope, (uint32_t)i};
            sum += slope * (double)i;
        }
        e = ki_edge_sort(a, b, n);
        for (size_t i = 0; i < n; i++) {
            ck_assert(i == 0 || e[i - 1].slope <= e[i].slope);
            sum -= e[i].slope * (double)e[i].i;
        }
        ck_assert_double_eq_tol(sum, 0.0, 1e-9);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("edge cells");
    TCase *tc = tcase_create("edge cells");

    tcase_add_test(tc, splits);
    tcase_add_test(tc, kept_points);
    tcase_add_test(tc, areas);
    tcase_add_test(tc, sorted_slopes);
    suite_add_tcase(suite, tc);
    return oracle_run(suite);
}
