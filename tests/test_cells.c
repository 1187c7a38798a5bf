/* Boundary cells, against every cell looked at on its own in exact integers; and
 * the grids that they are counted in. */
#include <stdlib.h>
#include <string.h>

#include "cells.h"
#include "integrand_fixture.h"
#include "oracle.h"

enum { DIM_MOST = 4, BITS = 10 };

/* ---- How a cell lies to a discontinuity, by its definition ------------------- */

typedef enum kind { SUM, CORNER, BALL } kind;

/* Where f jumps: at a sum of number/2^BITS of all coordinates, on the corner of
 * such sides in the first `axes` of them, or at that distance from the middle. */
typedef struct surface {
    kind kind;
    size_t dim, axes;
    int64_t number;
} surface;

static oracle_int product(const uint64_t *cells, size_t dim)
{
    oracle_int total = 1;

    for (size_t k = 0; k < dim; k++)
        total *= (oracle_int)cells[k];
    return total;
}

/* Less, equal or more: -1, 0, 1. */
static int compare(oracle_int a, oracle_int b) { return (a > b) - (a < b); }

/* The least and the largest sum of coordinates over the cell, in units of 1 over
 * the number of all cells. */
static koksma_meeting meets_sum(const surface *s, const uint64_t *at,
                                const uint64_t *cells)
{
    oracle_int total = product(cells, s->dim), low = 0, high = 0;
    oracle_int level = total * s->number;

    for (size_t k = 0; k < s->dim; k++) {
        low += (oracle_int)at[k] * (total / (oracle_int)cells[k]);
        high += (oracle_int)(at[k] + 1) * (total / (oracle_int)cells[k]);
    }
    low <<= BITS;
    high <<= BITS;
    if (low > level || high < level) return KOKSMA_APART;
    return low < level && level < high ? KOKSMA_CUTS : KOKSMA_TOUCHES;
}

static koksma_meeting meets_corner(const surface *s, const uint64_t *at,
                                   const uint64_t *cells)
{
    int in = 1, out = -1; /* of the part farthest in, and of that farthest out */

    for (size_t k = 0; k < s->axes; k++) {
        oracle_int c = (oracle_int)cells[k] * s->number;
        int low = compare(c, (oracle_int)at[k] << BITS);
        int high = compare((oracle_int)(at[k] + 1) << BITS, c);

        in = low < in ? low : in;
        out = high > out ? high : out;
    }
    if (in < 0 || out < 0) return KOKSMA_APART;
    return in > 0 && out > 0 ? KOKSMA_CUTS : KOKSMA_TOUCHES;
}

/* Squares of the distances of the nearest and the farthest point, twice as large
 * and in units of 1 over the number of all cells. */
static koksma_meeting meets_ball(const surface *s, const uint64_t *at,
                                 const uint64_t *cells)
{
    oracle_int total = product(cells, s->dim), near = 0, far = 0;
    oracle_int radius = 2 * s->number * total, level = radius * radius;

    for (size_t k = 0; k < s->dim; k++) {
        oracle_int unit = total / (oracle_int)cells[k];
        oracle_int a = (2 * (oracle_int)at[k] - (oracle_int)cells[k]) * unit;
        oracle_int b = a + 2 * unit, m = a > 0 ? a : b < 0 ? -b : 0;
        oracle_int f = a + b > 0 ? b : -a;

        near += m * m;
        far += f * f;
    }
    near <<= 2 * BITS;
    far <<= 2 * BITS;
    if (near > level || far < level) return KOKSMA_APART;
    return near < level && level < far ? KOKSMA_CUTS : KOKSMA_TOUCHES;
}

typedef koksma_meeting definition(const surface *s, const uint64_t *at,
                                  const uint64_t *cells);

static definition *const definitions[] = {meets_sum, meets_corner, meets_ball};

/* ---- Counting ---------------------------------------------------------------- */

static koksma_cell_count count(const koksma_integrand *f, const uint64_t *cells)
{
    koksma_cell_count c;
    koksma_error err;

    if (koksma_cells_count(&c, f, cells, NULL, &err)) ck_abort_msg("%s", err.text);
    ck_assert_uint_eq(c.lower, c.upper);
    return c;
}

/* On to the next cell; false after the last. */
static bool next_cell(uint64_t *at, const uint64_t *cells, size_t dim)
{
    for (size_t k = 0; k < dim; k++) {
        if (++at[k] < cells[k]) return true;
        at[k] = 0;
    }
    return false;
}

static void check_count(const char *name, const koksma_integrand *f,
                        const surface *s, const uint64_t *cells)
{
    uint64_t at[DIM_MOST] = {0}, cut = 0, touched = 0;
    koksma_cell_count c = count(f, cells);

    do {
        koksma_meeting m = definitions[s->kind](s, at, cells);

        cut += m == KOKSMA_CUTS;
        touched += m == KOKSMA_TOUCHES;
    } while (next_cell(at, cells, s->dim));
    ck_assert_msg(c.lower == cut && c.touched == touched,
                  "%s dim %zu, %g, %ju %ju cells: %ju and %ju, not %ju and %ju",
                  name, s->dim, ldexp((double)s->number, -BITS),
                  (uintmax_t)cells[0], (uintmax_t)cells[1], (uintmax_t)c.lower,
                  (uintmax_t)c.touched, (uintmax_t)cut, (uintmax_t)touched);
    ck_assert(c.total == (uint64_t)product(cells, s->dim));
}

/* In cubes of every size, and in cells that are no cubes. */
static void check_grids(const char *name, const koksma_integrand *f,
                        const surface *s)
{
    static const uint64_t most[] = {0, 40, 33, 12, 6};
    static const uint64_t odd[][DIM_MOST] = {{8, 9, 5, 7},  {1, 27, 4, 5},
                                             {16, 3, 1, 1}, {32, 9, 5, 1},
                                             {1, 1, 1, 7},  {8, 1, 1, 1}};
    uint64_t cells[DIM_MOST];

    for (cells[0] = 1; cells[0] <= most[s->dim]; cells[0]++) {
        for (size_t k = 1; k < DIM_MOST; k++)
            cells[k] = cells[0];
        check_count(name, f, s, cells);
    }
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++)
        check_count(name, f, s, odd[i]);
}

/* Thresholds on every grid's lines, between them, and just beside. */
static const int64_t numbers[] = {512, 256, 640, 341, 307, 511, 1, 1023, 717};
enum { NUMBERS = sizeof numbers / sizeof *numbers };

START_TEST(sums)
{
    for (size_t dim = 2; dim <= DIM_MOST; dim++) {
        surface s = {SUM, dim, dim, 0};
        koksma_integrand f;

        for (size_t i = 0; i < NUMBERS; i++) {
            double c = ldexp((double)numbers[i], -BITS);

            s.number = numbers[i] * (int64_t)dim;
            f = fixture_make(NULL, "halfspace", dim, &c);
            check_grids("halfspace", &f, &s);
        }
        s.number = 1 << BITS;
        f = fixture_make(NULL, "simplex", dim, NULL);
        check_grids("simplex", &f, &s);
        s.number = (int64_t)dim << (BITS - 1);
        f = fixture_make(NULL, "mixture", dim, NULL);
        check_grids("mixture", &f, &s);
        if (dim == 4) break;
        s.number = 1 << BITS;
        f = fixture_make(NULL, dim == 2 ? "f2" : "f3", dim, NULL);
        check_grids("f", &f, &s);
    }
}
END_TEST

START_TEST(corners)
{
    for (size_t dim = 1; dim <= DIM_MOST; dim++)
        for (size_t i = 0; i < NUMBERS; i++) {
            double c = ldexp((double)numbers[i], -BITS), param[] = {2.0, c};
            surface s = {CORNER, dim, dim, numbers[i]};
            koksma_integrand f = fixture_make(NULL, "box", dim, &c);

            check_grids("box", &f, &s);
            s.axes = dim < 2 ? dim : 2;
            f = fixture_make(NULL, "discontinuous", dim, param);
            check_grids("discontinuous", &f, &s);
        }
}
END_TEST

START_TEST(balls)
{
    for (size_t dim = 2; dim <= DIM_MOST; dim++)
        for (size_t i = 0; i < NUMBERS; i++) {
            double r = ldexp((double)numbers[i], -BITS);
            surface s = {BALL, dim, dim, numbers[i]};
            koksma_integrand f;

            if (r > 0.5) continue;
            f = fixture_make(NULL, "ball", dim, &r);
            check_grids("ball", &f, &s);
        }
}
END_TEST

/* What has no jump is met nowhere, and neither is one on the faces of the cube. */
START_TEST(nothing_to_meet)
{
    static const char *const names[] = {"sum",         "product",     "gaussian",
                                        "continuous",  "oscillatory", "corner-peak",
                                        "product-peak"};
    static const struct {
        const char *name;
        double param[2];
    } without[] = {{"f2", {0.5, 0}},         {"mixture", {1.0, 0}},
                   {"halfspace", {0.0, 0}},  {"halfspace", {1.0, 0}},
                   {"box", {0.0, 0}},        {"box", {1.0, 0}},
                   {"discontinuous", {2, 1}}};
    const uint64_t cells[] = {6, 6};

    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        koksma_integrand f = fixture_make(NULL, names[i], 2, NULL);
        koksma_cell_count c = count(&f, cells);

        ck_assert(c.lower == 0 && c.touched == 0 && c.total == 36);
    }
    for (size_t i = 0; i < sizeof without / sizeof *without; i++) {
        koksma_integrand f =
            fixture_make(NULL, without[i].name, 2, without[i].param);
        koksma_cell_count c = count(&f, cells);

        ck_assert_msg(c.lower == 0 && c.touched == 0, "%s", without[i].name);
    }
}
END_TEST

/* Grids too fine to be walked through: K in closed form.  A line x+y = c meets a
 * cell in each row and column that it passes, less one for the corners. */
START_TEST(fine_grids)
{
    uint64_t k = ((uint64_t)1 << 20) + 1, cells[] = {k, k};
    koksma_integrand f = fixture_make(NULL, "f2", 2, NULL);
    koksma_cell_count c = count(&f, cells);
    double half = 0.5, some = 0.3;

    ck_assert(c.lower == k && c.touched == 2 * (k - 1));
    f = fixture_make(NULL, "box", 2, &half);
    c = count(&f, cells);
    ck_assert(c.lower == k && c.touched == 0); /* k is odd */
    f = fixture_make(NULL, "halfspace", 2, &some);
    c = count(&f, cells);
    ck_assert(c.lower == 2 * (uint64_t)(0.6 * (double)k) + 1 && c.touched == 0);
}
END_TEST

/* Far from doubles: 0.1 is no multiple of 1/10, and by integers that is seen. */
START_TEST(no_rounding)
{
    uint64_t cells[] = {10, 10}, fine[] = {(uint64_t)1 << 32, 3};
    double c = 0.1, above = nextafter(0.5, 1.0);
    koksma_integrand f = fixture_make(NULL, "box", 2, &c);
    koksma_cell_count n = count(&f, cells);

    ck_assert(n.lower == 3 && n.touched == 0); /* 0.1 is above 1/10 */
    f = fixture_make(NULL, "box", 1, &above);
    n = count(&f, fine);
    ck_assert(n.lower == 1 && n.touched == 0);
    f = fixture_make(NULL, "halfspace", 2, &above);
    cells[0] = cells[1] = 101;
    n = count(&f, cells);
    ck_assert(n.lower == 201 && n.touched == 0);
    fine[0] = UINT64_MAX;
    above = 0.5;
    f = fixture_make(NULL, "box", 1, &above);
    n = count(&f, fine);
    ck_assert(n.lower == 1 && n.upper == 1 && n.total == UINT64_MAX);
}
END_TEST

/* Where squares need more than 64 bits: tangents to faces of cells, and cells on
 * both sides of them. */
START_TEST(no_rounding_of_squares)
{
    const uint64_t eighth = ((uint64_t)1 << 32) + 1, cells[] = {8 * eighth, 2};
    const koksma_meeting want[] = {KOKSMA_APART, KOKSMA_TOUCHES, KOKSMA_CUTS};
    double r = 0.375;
    koksma_integrand f = fixture_make(NULL, "ball", 2, &r);

    for (uint64_t i = 0; i < 3; i++) {
        uint64_t lower[] = {eighth - 2 + i, 0}, upper[] = {eighth - 1 + i, 1};

        ck_assert_int_eq(f.meets(&f, &(koksma_cell_box){lower, upper, cells}),
                         want[i]);
        lower[0] = 7 * eighth + 1 - i;
        upper[0] = lower[0] + 1;
        ck_assert_int_eq(f.meets(&f, &(koksma_cell_box){lower, upper, cells}),
                         want[i]);
    }
}
END_TEST

/* A function of the caller's own, with a range and nothing else. */
static double disc(const koksma_integrand *f, const double *x)
{
    (void)f;
    return hypot(x[0], x[1]) < 0.75;
}

static koksma_range disc_range(const koksma_integrand *f, const double *lower,
                               const double *upper)
{
    (void)f;
    return (koksma_range){{0.0, 1.0},
                          hypot(lower[0], lower[1]) < 0.75 &&
                              hypot(upper[0], upper[1]) > 0.75};
}

START_TEST(a_range_is_enough)
{
    koksma_integrand f = {.dim = 2, .value = disc, .range = disc_range};
    uint64_t cells[] = {32, 32}, at[2] = {0}, cut = 0;

    do {
        uint64_t a = at[0], b = at[1];

        cut += a * a + b * b < 576 && (a + 1) * (a + 1) + (b + 1) * (b + 1) > 576;
    } while (next_cell(at, cells, 2));
    ck_assert_uint_eq(count(&f, cells).lower, cut);
}
END_TEST

/* ---- Fractals ---------------------------------------------------------------- */

/* At their own scales all divided cells are met, and no other; at others, cells in
 * which points differ are. */
START_TEST(divided_cells)
{
    for (size_t dim = 2; dim <= 3; dim++) {
        const double params[][2] = {{9, 1}, {20, 2}, {41, 1}, {100, 5}};
        uint64_t k = 1, most = 1;

        for (size_t level = 0; level <= (dim == 2 ? 4 : 2); level++, k *= 5) {
            const double *p = params[2 * (dim - 2) + level % 2];
            uint64_t cells[] = {k, k, k};
            koksma_integrand f =
                fixture_make(NULL, dim == 2 ? "fractal2" : "fractal3", dim, p);

            most = (uint64_t)(pow(p[0], (double)level) + 0.5);
            ck_assert_uint_eq(count(&f, cells).lower, most);
        }
    }
}
END_TEST

/* Cells that are not divided are touched where a neighbour, at a corner too, has
 * the other value, and are not where all neighbours are as they are. */
START_TEST(touched_cells)
{
    for (int pattern = 1; pattern < 20; pattern++) {
        const double param[] = {5, pattern};
        const uint64_t cells[] = {5, 5};
        koksma_integrand f = fixture_make(NULL, "fractal2", 2, param);
        int state[7][7]; /* 0 and 1: out and in; 2: divided; 3: beyond the square */

        for (uint64_t i = 0; i < 49; i++) {
            uint64_t lower[] = {i / 7 - 1, i % 7 - 1}, upper[] = {i / 7, i % 7};
            koksma_cell_box box = {lower, upper, cells};
            double x[] = {((double)(i / 7) - 0.5) / 5, ((double)(i % 7) - 0.5) / 5};
            bool beyond = i / 7 % 6 == 0 || i % 7 % 6 == 0;

            state[i / 7][i % 7] = beyond ? 3
                                  : f.meets(&f, &box) == KOKSMA_CUTS
                                      ? 2
                                      : f.value(&f, x) > 0;
        }
        for (uint64_t i = 1; i < 6; i++)
            for (uint64_t j = 1; j < 6; j++) {
                uint64_t lower[] = {i - 1, j - 1}, upper[] = {i, j};
                koksma_cell_box box = {lower, upper, cells};
                int own = state[i][j], other = 0, divided = 0;

                for (uint64_t n = 0; n < 9; n++) {
                    int s = state[i + n / 3 - 1][j + n % 3 - 1];

                    other += s < 2 && s != own;
                    divided += s == 2;
                }
                if (own == 2) continue;
                if (other > 0) ck_assert(f.meets(&f, &box) == KOKSMA_TOUCHES);
                if (other + divided == 0)
                    ck_assert(f.meets(&f, &box) == KOKSMA_APART);
            }
    }
}
END_TEST

static bool values_differ(const koksma_integrand *f, const uint64_t *at,
                          const uint64_t *cells, size_t points, oracle_rng *rng)
{
    double x[3], first = 0.0;

    for (size_t i = 0; i < points; i++) {
        double v;

        for (size_t k = 0; k < f->dim; k++)
            x[k] = ((double)at[k] + 0.0078125 + 0.984375 * oracle_dyadic(rng, 30)) /
                   (double)cells[k];
        v = f->value(f, x);
        if (i > 0 && v != first) return true;
        first = v;
    }
    return false;
}

START_TEST(fractals_by_points)
{
    static const char *const names[] = {"fractal2", "koch", "fractal3"};
    static const uint64_t grids[][3] = {{8, 8, 8}, {13, 13, 4}, {25, 8, 3}};
    oracle_rng rng = oracle_rng_start(oracle_seed(), 0);

    for (size_t i = 0; i < 3; i++)
        for (size_t g = 0; g < 3; g++) {
            koksma_integrand f = fixture_make(NULL, names[i], 0, NULL);
            uint64_t at[3] = {0}, seen = 0;
            koksma_cell_count c = count(&f, grids[g]);

            do {
                uint64_t upper[] = {at[0] + 1, at[1] + 1, at[2] + 1};
                koksma_cell_box box = {at, upper, grids[g]};
                bool differ = values_differ(&f, at, grids[g], 300, &rng);

                seen += differ;
                if (differ) ck_assert_int_eq(f.meets(&f, &box), KOKSMA_CUTS);
            } while (next_cell(at, grids[g], f.dim));
            /* Little of the boundary hides from so many points. */
            ck_assert_msg(c.lower >= seen && (double)c.lower <= 1.12 * (double)seen,
                          "%s: %ju cells, %ju seen", names[i], (uintmax_t)c.lower,
                          (uintmax_t)seen);
        }
}
END_TEST

/* Over k = 31, 15, 7, 3, by hand. */
START_TEST(slope)
{
    koksma_integrand f = fixture_make(NULL, "ball", 2, NULL);
    double x[4], y[4], mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0;
    koksma_cell_slope s;
    koksma_cell_count first;

    for (int i = 0; i < 4; i++) {
        uint64_t k = ((uint64_t)32 >> i) - 1, cells[] = {k, k};
        koksma_cell_count c = count(&f, cells);

        if (i == 0) first = c;
        x[i] = log((double)k);
        y[i] = log((double)c.lower);
        mean_x += x[i] / 4;
        mean_y += y[i] / 4;
    }
    for (int i = 0; i < 4; i++) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
    }
    for (int known = 0; known < 2; known++) {
        ck_assert_int_eq(koksma_cells_slope(&s, &f, 1023, NULL,
                                            known ? &first : NULL, NULL, NULL),
                         0);
        ck_assert_double_eq_tol(s.value, xy / xx, 1e-12);
        ck_assert_double_eq_tol(
            s.bend, (y[0] - y[1]) / (x[0] - x[1]) - (y[2] - y[3]) / (x[2] - x[3]),
            1e-12);
        ck_assert_uint_eq(s.scales, 4);
    }
}
END_TEST

START_TEST(dimensions)
{
    const double params[][2] = {{9, 1}, {15, 2}, {20, 3}, {7, 4}};
    koksma_cells_opts by_five = {.ratio = 5};
    koksma_cell_slope s;
    koksma_facts k;

    for (size_t i = 0; i < 4; i++) {
        koksma_integrand f = fixture_make(&k, "fractal2", 2, params[i]);

        ck_assert_int_eq(
            koksma_cells_slope(&s, &f, 15625, NULL, NULL, &by_five, NULL), 0);
        ck_assert_double_eq_tol(s.value, k.box_dim, 1e-12);
        ck_assert(fabs(s.bend) < 1e-12 && s.scales == 3);
    }
    koksma_integrand f = fixture_make(&k, "koch", 2, NULL);

    ck_assert_int_eq(koksma_cells_slope(&s, &f, 1 << 18, NULL, NULL, NULL, NULL),
                     0);
    ck_assert_double_eq_tol(s.value, k.box_dim, 0.03);
    ck_assert(s.scales == KOKSMA_SLOPE_SCALES);

    /* In five dimensions all of these cells are large, and there are few grids. */
    f = fixture_make(&k, "ball", 5, NULL);
    ck_assert_int_eq(koksma_cells_slope(&s, &f, 1 << 20, NULL, NULL, NULL, NULL),
                     0);
    ck_assert(s.value < 3.9 && s.scales == 3);

    /* And nothing is said of what is not met, or at too few scales. */
    f = fixture_make(&k, "sum", 2, NULL);
    ck_assert_int_eq(koksma_cells_slope(&s, &f, 1 << 20, NULL, NULL, NULL, NULL),
                     0);
    ck_assert(isnan(s.value) && isnan(s.bend) && s.scales == 0);
}
END_TEST

/* ---- Extents ----------------------------------------------------------------- */

/* K/k^(dim-1) tends to the extent, except where the grid is aligned. */
START_TEST(extents)
{
    const double c = 0.43, w[] = {1.5, 0.61};
    static const char *const names[] = {"ball", "box", "halfspace",
                                        "discontinuous"};

    for (size_t dim = 2; dim <= 3; dim++)
        for (size_t i = 0; i < 4; i++) {
            uint64_t k = dim == 2 ? 5003 : 211, cells[] = {k, k, k};
            koksma_facts facts;
            koksma_integrand f =
                fixture_make(&facts, names[i], dim, i == 3 ? w : &c);
            double digital =
                (double)count(&f, cells).lower / pow((double)k, (double)dim - 1.0);

            ck_assert_msg(
                fabs(digital / facts.extent - 1.0) < (dim == 2 ? 0.001 : 0.02),
                "%s dim %zu: %g, not %g", names[i], dim, digital, facts.extent);
        }
    /* x+y+z = 1 has 3/2 and meets as many cells as if it had 1. */
    uint64_t cells[] = {200, 200, 200};
    koksma_integrand f = fixture_make(NULL, "f3", 3, NULL);

    ck_assert_uint_eq(count(&f, cells).lower, 200 * 200);
}
END_TEST

/* ---- Grids ------------------------------------------------------------------- */

/* k^dim <= n, without overflow. */
static bool power_fits(uint64_t k, size_t dim, uint64_t n)
{
    oracle_int power = 1;

    for (size_t j = 0; j < dim; j++) {
        power *= (oracle_int)k;
        if (power > (oracle_int)n) return false;
    }
    return true;
}

START_TEST(roots)
{
    for (size_t dim = 1; dim <= 70; dim++)
        for (uint64_t round = 0; round < 200; round++) {
            oracle_rng rng = oracle_rng_start(oracle_seed(), round);
            uint64_t n =
                (uint64_t)oracle_below(&rng, SIZE_MAX) >> oracle_below(&rng, 64);
            uint64_t cells[70], root = 2 + oracle_below(&rng, 3000);

            if (round < 3) n = UINT64_MAX - round;
            if (round >= 100) { /* a power, and its neighbours */
                n = 1;
                for (size_t j = 0; j < dim && n < UINT64_MAX / root; j++)
                    n *= root;
                n += round % 3 - 1;
            }
            if (n == 0) continue;
            ck_assert_int_eq(koksma_grid_choose(cells, n, dim, NULL, NULL), 0);
            ck_assert(power_fits(cells[0], dim, n));
            ck_assert(cells[0] == UINT64_MAX || !power_fits(cells[0] + 1, dim, n));
            ck_assert(cells[0] == cells[dim - 1]);
        }
}
END_TEST

/* (mean of the sides / their geometric mean) (n/product)^((dim-1)/2dim). */
static double cost_of(const uint64_t *cells, size_t dim, uint64_t n)
{
    double sides = 0.0, total = 1.0, d = (double)dim;

    for (size_t k = 0; k < dim; k++) {
        sides += 1.0 / (double)cells[k] / d;
        total *= (double)cells[k];
    }
    return sides * pow(total, 1.0 / d) *
           pow((double)n / total, (d - 1.0) / (2.0 * d));
}

static double least_cost(uint64_t *cells, size_t k, size_t dim, uint64_t n,
                         uint64_t room, const uint32_t *bases)
{
    double least = HUGE_VAL;

    if (k == dim) return cost_of(cells, dim, n);
    for (cells[k] = 1; cells[k] <= room; cells[k] *= bases[k])
        least =
            fmin(least, least_cost(cells, k + 1, dim, n, room / cells[k], bases));
    return least;
}

START_TEST(elementary_intervals)
{
    const uint32_t primes[] = {2, 3, 5, 7}, others[] = {9, 4, 35, 11};

    for (size_t dim = 1; dim <= 4; dim++)
        for (uint64_t n = 1; n < 60000; n = n * 5 / 4 + 1)
            for (int i = 0; i < 2; i++) {
                const uint32_t *bases = i == 0 ? primes : others;
                uint64_t cells[4], tried[4], total = 1;

                ck_assert_int_eq(koksma_grid_choose(cells, n, dim, bases, NULL), 0);
                for (size_t k = 0; k < dim; k++) {
                    uint64_t rest = cells[k];

                    total *= cells[k];
                    while (rest % bases[k] == 0)
                        rest /= bases[k];
                    ck_assert(rest == 1);
                }
                ck_assert(total <= n);
                ck_assert_double_le(cost_of(cells, dim, n),
                                    least_cost(tried, 0, dim, n, n, bases) *
                                        (1.0 + 1e-12));
            }
}
END_TEST

/* ---- Stops and refusals ------------------------------------------------------ */

static int stop_later(void *state, double lower, double upper, double work)
{
    int *calls = state;

    ck_assert(lower <= upper && work > 0.0);
    return ++*calls == 3;
}

START_TEST(stopped)
{
    uint64_t cells[] = {1 << 15, 1 << 15};
    koksma_integrand f = fixture_make(NULL, "ball", 2, NULL);
    uint64_t all = count(&f, cells).lower;
    int calls = 0;
    koksma_cells_opts opts = {.progress = stop_later, .state = &calls};
    koksma_cell_count c;
    koksma_error err;

    ck_assert_int_eq(koksma_cells_count(&c, &f, cells, &opts, &err),
                     KOKSMA_STOPPED);
    ck_assert(c.lower > 0 && c.lower < all && all < c.upper && c.upper < c.total);
    ck_assert_int_eq(err.status, KOKSMA_STOPPED);
}
END_TEST

START_TEST(refusals)
{
    koksma_integrand f = fixture_make(NULL, "ball", 2, NULL);
    const uint64_t none[] = {4, 0}, many[] = {(uint64_t)1 << 32, (uint64_t)1 << 32};
    const uint32_t bad[] = {4, 6}, one[] = {2, 1};
    koksma_cells_opts same = {.ratio = 1};
    koksma_cell_count c = {.total = 7};
    koksma_cell_slope s = {.scales = 7};
    uint64_t cells[20] = {7, 7};
    koksma_error err;
    uint32_t primes[20] = {2};

    ck_assert_int_eq(koksma_cells_count(&c, &f, none, NULL, NULL), KOKSMA_EINVAL);
    ck_assert_int_eq(koksma_cells_count(&c, &f, many, NULL, NULL), KOKSMA_EINVAL);
    f.meets = NULL;
    f.range = NULL;
    ck_assert_int_eq(koksma_cells_count(&c, &f, cells, NULL, &err), KOKSMA_EINVAL);
    ck_assert_str_eq(err.text, "the integrand does not say which boxes its "
                               "discontinuity meets");
    ck_assert_int_eq(koksma_cells_slope(&s, &f, 64, NULL, NULL, &same, NULL),
                     KOKSMA_EINVAL);
    ck_assert_int_eq(koksma_grid_choose(cells, 0, 2, NULL, NULL), KOKSMA_EINVAL);
    ck_assert_int_eq(koksma_grid_choose(cells, 9, 0, NULL, NULL), KOKSMA_EINVAL);
    ck_assert_int_eq(koksma_grid_choose(cells, 9, 2, bad, NULL), KOKSMA_EINVAL);
    ck_assert_int_eq(koksma_grid_choose(cells, 9, 2, one, NULL), KOKSMA_EINVAL);
    ck_assert_int_eq(koksma_grid_choose(cells, 9, 16, primes, NULL), KOKSMA_EINVAL);
    ck_assert(c.total == 7 && s.scales == 7 && cells[0] == 7);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("cells");
    TCase *counts = tcase_create("counts"), *grids = tcase_create("grids");

    tcase_add_test(counts, sums);
    tcase_add_test(counts, corners);
    tcase_add_test(counts, balls);
    tcase_add_test(counts, nothing_to_meet);
    tcase_add_test(counts, fine_grids);
    tcase_add_test(counts, no_rounding);
    tcase_add_test(counts, no_rounding_of_squares);
    tcase_add_test(counts, touched_cells);
    tcase_add_test(counts, slope);
    tcase_add_test(counts, a_range_is_enough);
    tcase_add_test(counts, divided_cells);
    tcase_add_test(counts, fractals_by_points);
    tcase_add_test(counts, dimensions);
    tcase_add_test(counts, extents);
    tcase_add_test(counts, stopped);
    tcase_add_test(grids, roots);
    tcase_add_test(grids, elementary_intervals);
    tcase_add_test(grids, refusals);
    tcase_set_timeout(counts, 60);
    suite_add_tcase(suite, counts);
    suite_add_tcase(suite, grids);
    return oracle_run(suite);
}
