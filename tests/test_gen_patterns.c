/* Patterns: that every stratum has its point, that the rest is chance, and that
 * disks keep their distance.  Seeds are fixed, levels as in test_gen_scramble.c: by
 * chance, one choice of seeds in 10^5 would fail a test. */
#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gen_fixture.h"
#include "oracle.h"

static double x[ROOM];

/* The s with s/m <= v < (s+1)/m, exactly. */
static uint64_t stratum(double v, uint64_t m)
{
    return (uint64_t)((ki_u128)(uint64_t)ldexp(v, 53) * m >> 53);
}

/* Chi-square of counts that should be equal, in spreads above its mean: 5.2 of them
 * for 20 degrees of freedom and more. */
static double excess(const size_t *cell, size_t cells, size_t draws)
{
    double expected = (double)draws / (double)cells, chi = 0.0;

    for (size_t i = 0; i < cells; i++)
        chi += pow((double)cell[i] - expected, 2.0) / expected;
    return (chi - (double)cells) / sqrt(2.0 * (double)cells);
}

static const struct size {
    uint64_t m;
    size_t dim;
} sizes[] = {{1, 3},  {2, 1}, {7, 1},  {3, 2}, {10, 2},
             {49, 2}, {3, 5}, {2, 11}, {5, 4}};

/* Whether each of the m^dim cells has one point, and each of n strata of each axis.
 */
static void check_strata(const char *name, bool cells, bool rows)
{
    static bool taken[ROOM];

    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        koksma_gen_opts o = {.dim = sizes[s].dim, .n = 1, .seed = s};

        for (size_t k = 0; k < o.dim; k++)
            o.n *= sizes[s].m;
        fill_all(x, name, o);
        memset(taken, 0, o.n);
        for (size_t i = 0; cells && i < o.n; i++) {
            uint64_t cell = 0;

            for (size_t k = 0; k < o.dim; k++)
                cell = cell * sizes[s].m + stratum(x[i * o.dim + k], sizes[s].m);
            /* In the order of the grid. */
            if (cell != i)
                ck_abort_msg("%s: point %zu in cell %ju", name, i, (uintmax_t)cell);
        }
        for (size_t k = 0; rows && k < o.dim; k++) {
            memset(taken, 0, o.n);
            for (size_t i = 0; i < o.n; i++) {
                uint64_t row = stratum(x[i * o.dim + k], o.n);

                if (taken[row])
                    ck_abort_msg("%s: row %ju twice", name, (uintmax_t)row);
                taken[row] = true;
            }
        }
    }
}

START_TEST(every_stratum_has_its_point)
{
    check_strata("jittered", true, false);
    check_strata("latin", false, true);
    check_strata("multijittered", true, true);
}
END_TEST

/* Strata of any number, also where 2^53/n is far from whole. */
START_TEST(uneven_strata)
{
    koksma_gen_opts o = {.dim = 1, .n = ((uint64_t)1 << 53) - 1};

    for (uint64_t first = 0; first < o.n; first = first * 3 + 1000) {
        fill_some(x, "jittered", o, first, 3);
        for (uint64_t i = 0; i < 3; i++)
            ck_assert_uint_eq(stratum(x[i], o.n), first + i);
    }
    o.n = (uint64_t)1 << 53;
    fill_some(x, "jittered", o, o.n - 1, 1);
    ck_assert(x[0] == 1.0 - 0x1p-53);
}
END_TEST

/* Where in its cell a point is: 10 by 10 squares of it; and for all points of a set
 * by itself: uniform in the cube. */
START_TEST(chance_inside_strata)
{
    static const char *const names[] = {"jittered", "latin", "multijittered"};
    const char *name = names[_i];
    size_t inside[100] = {0}, anywhere[100] = {0};
    enum { DRAWS = 4000 };

    for (uint64_t seed = 0; seed < DRAWS; seed++) {
        koksma_gen_opts o = {.dim = 2, .n = 9};
        size_t i = seed % 9;

        *(seed % 2 == 0 ? &o.seed : &o.replicate) = seed;
        fill_all(x, name, o);
        inside[(size_t)(fmod(x[2 * i] * 9.0, 1.0) * 10.0) * 10 +
               (size_t)(fmod(x[2 * i + 1] * 9.0, 1.0) * 10.0)]++;
        anywhere[(size_t)(x[2 * i] * 10.0) * 10 + (size_t)(x[2 * i + 1] * 10.0)]++;
    }
    ck_assert_double_lt(excess(inside, 100, DRAWS), 5.2);
    ck_assert_double_lt(excess(anywhere, 100, DRAWS), 5.2);
}
END_TEST

/* All 24 orders of 4 rows, on both axes and together; and of the strata in the
 * first column of multi-jittered points, 3 of 9. */
START_TEST(orders_are_uniform)
{
    size_t first[24] = {0}, second[24] = {0}, pairs[16] = {0}, columns[6 * 6] = {0};
    enum { DRAWS = 7200 };

    for (uint64_t seed = 0; seed < DRAWS; seed++) {
        koksma_gen_opts o = {.dim = 2, .n = 4, .seed = seed};
        size_t order[2] = {0};

        fill_all(x, "latin", o);
        for (size_t k = 0; k < 2; k++) {
            static const size_t weight[] = {6, 2, 1};

            for (size_t i = 0; i < 3; i++)
                for (size_t j = i + 1; j < 4; j++)
                    order[k] += weight[i] * (x[2 * i + k] > x[2 * j + k]);
        }
        first[order[0]]++;
        second[order[1]]++;
        pairs[stratum(x[0], 4) * 4 + stratum(x[1], 4)]++;
        o.n = 9;
        fill_all(x, "multijittered", o);
        for (size_t k = 0; k < 2; k++) {
            /* Cells 0, 1, 2 have the same first digit, and 0, 3, 6 the same second.
             */
            size_t a = k == 0 ? 1 : 3;
            double u = x[k], v = x[2 * a + k], w = x[4 * a + k];

            order[k] = (size_t)(u > v) + 2 * ((size_t)(u > w) + (size_t)(v > w));
        }
        columns[order[0] * 6 + order[1]]++;
    }
    ck_assert_double_lt(excess(first, 24, DRAWS), 5.2);
    ck_assert_double_lt(excess(second, 24, DRAWS), 5.2);
    ck_assert_double_lt(excess(pairs, 16, DRAWS), 5.2);
    ck_assert_double_lt(excess(columns, 36, DRAWS), 5.2);
}
END_TEST

/* Digits by the formula; and in one block of places the sum over j that its authors
 * write: n y_i = sum of ((a_j + j) mod 2) 2^(m-1-j). */
START_TEST(zaremba)
{
    for (int m = 0; m < 64; m += m < 12 ? 1 : 17) {
        koksma_gen_opts o = {.dim = 2, .n = (uint64_t)1 << m};
        size_t count = o.n < 4096 ? (size_t)o.n : 4096;

        fill_some(x, "zaremba", o, o.n - count, count);
        for (size_t i = 0; i < count; i++) {
            uint64_t index = o.n - count + i;
            ki_u128 y = 0;

            for (int j = 0; j < m; j++)
                y += (ki_u128)(((index >> j & 1) + (uint64_t)j) % 2) << (m - 1 - j);
            if (x[2 * i] != truncated(index, o.n) ||
                x[2 * i + 1] != truncated(y, o.n))
                ck_abort_msg("m = %d, point %zu", m, i);
        }
    }
}
END_TEST

static double distance(const double *a, const double *b, size_t dim, bool torus)
{
    double sum = 0.0;

    for (size_t k = 0; k < dim; k++) {
        double far = fabs(a[k] - b[k]);

        if (torus && far > 0.5) far = 1.0 - far;
        sum += far * far;
    }
    return sqrt(sum);
}

static double nearest(const koksma_gen_opts *o)
{
    double least = HUGE_VAL;

    for (size_t i = 0; i < o->n; i++)
        for (size_t j = 0; j < i; j++) {
            double d = distance(x + i * o->dim, x + j * o->dim, o->dim, o->torus);

            if (d < least) least = d;
        }
    return least;
}

/* In units of n^(-1/dim); the densest pattern of the plane has 1.0746, and darts
 * that never stop 0.83. */
START_TEST(disks_keep_their_distance)
{
    static const struct {
        size_t dim;
        uint64_t n;
        double least;
    } tried[] = {{1, 100, 0.55}, {1, 7, 0.5},    {2, 2, 0.5},    {2, 50, 0.65},
                 {2, 1500, 0.7}, {3, 1500, 0.7}, {4, 1000, 0.7}, {6, 500, 0.7},
                 {12, 100, 0.7}, {2, 1, 0.0}};

    for (size_t t = 0; t < sizeof tried / sizeof *tried; t++)
        for (int torus = 0; torus < 2; torus++) {
            koksma_gen_opts o = {.dim = tried[t].dim, .n = tried[t].n, .seed = t};
            double got;

            o.torus = torus == 1;
            fill_all(x, "poisson", o);
            got = nearest(&o) * pow((double)o.n, 1.0 / (double)o.dim);
            if (got < tried[t].least)
                ck_abort_msg("%zu points, dim %zu: %g", (size_t)o.n, o.dim, got);
        }
}
END_TEST

/* With a given radius it is kept, across the faces on the torus alone. */
START_TEST(given_radius)
{
    size_t across = 0;

    for (uint64_t seed = 0; seed < 20; seed++) {
        koksma_gen_opts o = {.dim = 2, .n = 60, .radius = 0.09, .seed = seed};

        fill_all(x, "poisson", o);
        ck_assert_double_ge(nearest(&o), 0.09);
        o.torus = true;
        across += nearest(&o) < 0.09;
        fill_all(x, "poisson", o);
        ck_assert_double_ge(nearest(&o), 0.09);
    }
    ck_assert_uint_ge(across, 15);
}
END_TEST

/* On the torus no place is better than another: the first and the last of 20 points
 * in 10 by 10 squares. */
START_TEST(disks_are_anywhere)
{
    size_t first[100] = {0}, last[100] = {0};
    enum { DRAWS = 4000 };

    for (uint64_t seed = 0; seed < DRAWS; seed++) {
        koksma_gen_opts o = {.dim = 2, .n = 20, .seed = seed, .torus = true};

        fill_all(x, "poisson", o);
        first[(size_t)(x[0] * 10.0) * 10 + (size_t)(x[1] * 10.0)]++;
        last[(size_t)(x[38] * 10.0) * 10 + (size_t)(x[39] * 10.0)]++;
    }
    ck_assert_double_lt(excess(first, 100, DRAWS), 5.2);
    ck_assert_double_lt(excess(last, 100, DRAWS), 5.2);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("gen_patterns");
    TCase *tc = tcase_create("strata");

    suite_add_tcase(suite, tc);
    tcase_add_test(tc, every_stratum_has_its_point);
    tcase_add_test(tc, uneven_strata);
    tcase_add_loop_test(tc, chance_inside_strata, 0, 3);
    tcase_add_test(tc, orders_are_uniform);
    tcase_add_test(tc, zaremba);

    tc = tcase_create("disks");
    suite_add_tcase(suite, tc);
    tcase_add_test(tc, disks_keep_their_distance);
    tcase_add_test(tc, given_radius);
    tcase_add_test(tc, disks_are_anywhere);
    return oracle_run(suite);
}
