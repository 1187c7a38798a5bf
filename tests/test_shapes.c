/* Indicators of shapes: sides in integers, and ranges against every point of a box
 * that a grid has. */
#include <stdlib.h>
#include <string.h>

#include "integrand_fixture.h"
#include "oracle.h"

/* ---- Ranges ------------------------------------------------------------------ */

/* Boxes whose corners are multiples of 1/GRID, and points in units of 1/FINE. */
enum { GRID = 16, FINE = 4 * GRID };

/* What is asked of f on a box: whether values and pieces of the points inside, on a
 * fine grid, agree with the range. */
typedef struct seen {
    double least, most;
    bool several; /* pieces */
} seen;

static seen look_inside(const koksma_integrand *f, const size_t *low,
                        const size_t *high)
{
    seen s = {HUGE_VAL, -HUGE_VAL, false};
    size_t at[4], first = 0, piece;
    bool begun = false;
    double x[4];

    for (size_t k = 0; k < f->dim; k++)
        at[k] = 4 * low[k] + 1;
    for (;;) {
        size_t k = 0;
        double v;

        for (size_t j = 0; j < f->dim; j++)
            x[j] = (double)at[j] / FINE;
        v = fixture_value(f, &piece, x);
        if (!begun) first = piece;
        begun = true;
        s.several = s.several || piece != first;
        s.least = fmin(s.least, v);
        s.most = fmax(s.most, v);
        for (; k < f->dim && ++at[k] == 4 * high[k]; k++)
            at[k] = 4 * low[k] + 1;
        if (k == f->dim) return s;
    }
}

static koksma_range range_of(const koksma_integrand *f, const size_t *low,
                             const size_t *high)
{
    double lower[4], upper[4];

    for (size_t k = 0; k < f->dim; k++) {
        lower[k] = (double)low[k] / GRID;
        upper[k] = (double)high[k] / GRID;
    }
    return f->range(f, lower, upper);
}

static const struct {
    const char *name;
    double param;  /* on the grid, so that faces and tangents come up */
    bool constant; /* on every piece */
} ranged[] = {
    {"f2", 0.0, true},      {"f2", 0.25, false},      {"f2", 0.5, false},
    {"f3", 0.125, false},   {"halfspace", .5, true},  {"halfspace", .3, true},
    {"simplex", 0, true},   {"mixture", 0.25, false}, {"sum", 0, false},
    {"product", 0, false},  {"box", 0.3125, true},    {"box", 0.3, true},
    {"ball", 0.3125, true}, {"ball", 0.4, true},      {"ball", 0.5, true},
};

static void check_range(const koksma_integrand *f, const char *name,
                        const size_t *low, const size_t *high)
{
    koksma_range r = range_of(f, low, high);
    seen s = look_inside(f, low, high);

    ck_assert_msg(r.value.lower <= s.least && s.most <= r.value.upper,
                  "%s at %zu %zu: [%g,%g] in [%g,%g]", name, low[0], low[1],
                  s.least, s.most, r.value.lower, r.value.upper);
    ck_assert_msg(r.cut || !s.several, "%s at %zu %zu is cut", name, low[0],
                  low[1]);
}

START_TEST(ranges_contain_values)
{
    for (uint64_t round = 0; round < 6000 * oracle_scale(); round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        size_t i = round % (sizeof ranged / sizeof *ranged), low[4], high[4];
        size_t dim = strcmp(ranged[i].name, "f2") == 0 ? 2 : 2 + round % 2;
        koksma_integrand f;

        if (strcmp(ranged[i].name, "f3") == 0) dim = 3;
        f = fixture_make(NULL, ranged[i].name, dim, &ranged[i].param);
        for (size_t k = 0; k < dim; k++) {
            low[k] = oracle_below(&rng, GRID);
            high[k] = low[k] + 1 +
                      oracle_below(&rng, dim == 2 ? GRID - low[k]
                                                  : (GRID - low[k]) / 3 + 1);
        }
        check_range(&f, ranged[i].name, low, high);
    }
}
END_TEST

/* Where the discontinuity misses the box, an indicator's range is one value, and
 * that of a function of slope a has the width of a linear one. */
START_TEST(ranges_are_tight)
{
    for (size_t i = 0; i < sizeof ranged / sizeof *ranged; i++) {
        size_t dim = strcmp(ranged[i].name, "f3") == 0 ? 3 : 2;
        koksma_facts facts;
        koksma_integrand f =
            fixture_make(&facts, ranged[i].name, dim, &ranged[i].param);

        for (size_t cell = 0; cell < GRID * GRID; cell++) {
            size_t low[] = {cell % GRID, cell / GRID, 3};
            size_t high[] = {low[0] + 1, low[1] + 1, 4};
            koksma_range r = range_of(&f, low, high);
            double width = r.value.upper - r.value.lower;

            if (!r.cut && ranged[i].constant) ck_assert(width == 0.0);
            if (r.cut) ck_assert_double_ge(width, facts.jump);
            if (r.cut) ck_assert_double_le(width, facts.jump + 3.0 / GRID);
            if (!r.cut) ck_assert_double_le(width, 3.0 / GRID);
        }
    }
}
END_TEST

/* Cells that are cut, by the definition in integers: units of 1/(2 GRID) for the
 * ball, whose radius 5/16 has tangents and Pythagorean corners on the grid. */
START_TEST(cut_cells_counted)
{
    double r = 0.3125, half = 0.5;
    koksma_integrand ball = fixture_make(NULL, "ball", 2, &r);
    koksma_integrand plane = fixture_make(NULL, "halfspace", 2, &half);

    for (size_t cell = 0; cell < GRID * GRID; cell++) {
        size_t low[] = {cell % GRID, cell / GRID},
               high[] = {low[0] + 1, low[1] + 1};
        long near = 0, far = 0, radius = 2 * 5;

        for (int k = 0; k < 2; k++) {
            long a = 2 * (long)low[k] - GRID, b = 2 * (long)high[k] - GRID;

            near += a >= 0 ? a * a : b <= 0 ? b * b : 0;
            far += labs(a) > labs(b) ? a * a : b * b;
        }
        ck_assert_msg(range_of(&ball, low, high).cut ==
                          (near < radius * radius && far > radius * radius),
                      "ball at %zu %zu", low[0], low[1]);
        ck_assert(range_of(&plane, low, high).cut ==
                  (low[0] + low[1] < GRID && high[0] + high[1] > GRID));
    }
}
END_TEST

/* A box with its corner on the grid cuts what reaches across. */
START_TEST(cut_by_a_box)
{
    double c = 5.0 / GRID;
    koksma_integrand f = fixture_make(NULL, "box", 2, &c);

    for (size_t code = 0; code < 4 * GRID * GRID; code++) {
        size_t low[] = {code % GRID, code / GRID % GRID};
        size_t size = 1 + code / GRID / GRID,
               high[] = {low[0] + size, low[1] + size};

        if (high[0] > GRID || high[1] > GRID) continue;
        ck_assert(range_of(&f, low, high).cut ==
                  (low[0] < 5 && low[1] < 5 && (high[0] > 5 || high[1] > 5)));
    }
}
END_TEST

/* ---- Sides ------------------------------------------------------------------- */

/* Whether m, in units of 2^-30 round the centre, is in the ball, exactly. */
START_TEST(sides_of_the_ball)
{
    for (uint64_t round = 0; round < 20000 * oracle_scale(); round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        size_t dim = 2 + oracle_below(&rng, 5);
        const long unit = 1L << 30,
                   r = (long)oracle_below(&rng, (size_t)unit / 2 - 2) + 1;
        double x[8], radius = (double)r / (double)unit;
        oracle_int sum = 0, want = (oracle_int)r * r;
        koksma_integrand f;

        for (size_t k = 0; k < dim; k++) {
            long m = (long)oracle_below(&rng, (size_t)r + 1);

            /* The last is as far as the others leave, or one more or less. */
            if (k + 1 == dim && sum <= want)
                m = (long)sqrt((double)(want - sum)) + (long)(round % 3) - 1;
            if (m < 0 || m > unit / 2) m = 0;
            sum += (oracle_int)m * m;
            x[k] = 0.5 + (double)(round % 2 ? m : -m) / (double)unit;
        }
        if (radius < 0x1p-20) continue;
        f = fixture_make(NULL, "ball", dim, &radius);
        ck_assert_msg((f.value(&f, x) == 1.0) == (sum <= want), "round %ju dim %zu",
                      (uintmax_t)round, dim);
    }
}
END_TEST

/* 3, 4, 5 in units that make the squares longer than a double. */
START_TEST(touching_the_ball)
{
    for (uint64_t round = 0; round < 200; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        double unit = ldexp(1.0 + (double)oracle_below(&rng, 1 << 26), -30);
        double r = 5.0 * unit, on[] = {0.5 + 3.0 * unit, 0.5 - 4.0 * unit};
        koksma_integrand f;

        if (r > 0.5 || r < 0x1p-20) continue;
        f = fixture_make(NULL, "ball", 2, &r);
        for (int k = 0; k < 2; k++) {
            double x[] = {on[0], on[1]};

            ck_assert(f.value(&f, x) == 1.0);
            x[k] = nextafter(on[k], 0.5);
            ck_assert(f.value(&f, x) == 1.0);
            x[k] = nextafter(on[k], k == 0 ? 1.0 : 0.0);
            ck_assert(f.value(&f, x) == 0.0);
        }
    }
}
END_TEST

/* The sides of the other sums are those of f2, which has tests of its own. */
START_TEST(sides_of_sums)
{
    double half = 0.5, zero = 0.0, one = 1.0;
    koksma_integrand f2 = fixture_make(NULL, "f2", 2, &zero);
    koksma_integrand plane = fixture_make(NULL, "halfspace", 2, &half);
    koksma_integrand simplex = fixture_make(NULL, "simplex", 2, NULL);
    koksma_integrand mixture = fixture_make(NULL, "mixture", 2, &zero);
    koksma_integrand many = fixture_make(NULL, "halfspace", 31, &half);
    koksma_integrand all = fixture_make(NULL, "halfspace", 2, &zero);
    koksma_integrand none = fixture_make(NULL, "halfspace", 2, &one);
    double corner[2] = {1.0, 1.0}, origin[2] = {0.0, 0.0}, x[31],
           tiny[] = {0.0, 0x1p-1074};

    for (uint64_t round = 0; round < 1000; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        double p[] = {oracle_dyadic(&rng, 53), 0.0};

        p[1] = 1.0 - p[0];
        if (round % 3 == 1) p[1] = nextafter(p[1], 0.0);
        if (round % 3 == 2) p[1] = nextafter(p[1], 1.0);
        ck_assert(plane.value(&plane, p) == f2.value(&f2, p));
        ck_assert(simplex.value(&simplex, p) == 1.0 - f2.value(&f2, p));
        ck_assert(mixture.value(&mixture, p) == 2.0 * f2.value(&f2, p));
    }
    for (size_t k = 0; k < 31; k++)
        x[k] = 0.5;
    ck_assert(many.value(&many, x) == 0.0);
    x[30] = nextafter(0.5, 1.0);
    ck_assert(many.value(&many, x) == 1.0);
    ck_assert(all.value(&all, origin) == 0.0 && all.value(&all, tiny) == 1.0);
    ck_assert(none.value(&none, corner) == 0.0);
}
END_TEST

/* Coordinates in units of 2^-53, whose sum is an integer: on the plane, and a unit
 * off it, which a sum of 31 doubles cannot tell. */
START_TEST(sides_in_31_dimensions)
{
    const int64_t unit = INT64_C(1) << 53;
    double half = 0.5, x[31];
    koksma_integrand f = fixture_make(NULL, "halfspace", 31, &half);

    for (uint64_t round = 0; round < 2000 * oracle_scale(); round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        int64_t rest = 31 * (unit / 2), off = (int64_t)(round % 5) - 2;

        for (int k = 0; k < 30; k++) {
            int64_t m = (int64_t)(oracle_dyadic(&rng, 53) * 0x1p53);

            x[k] = (double)m / (double)unit;
            rest -= m;
        }
        if (rest < 2 || rest > unit - 2) continue;
        x[30] = (double)(rest + off) / (double)unit;
        ck_assert_msg((f.value(&f, x) == 1.0) == (off > 0), "round %ju",
                      (uintmax_t)round);
    }
}
END_TEST

START_TEST(sides_of_boxes)
{
    double c = 0.3, w[] = {1.0, 0.3};
    koksma_integrand box = fixture_make(NULL, "box", 3, &c);
    koksma_integrand cut = fixture_make(NULL, "discontinuous", 3, w);

    for (int k = 0; k < 3; k++) {
        double x[3] = {c, c, c};

        ck_assert(box.value(&box, x) == 1.0 && cut.value(&cut, x) > 0.0);
        x[k] = nextafter(c, 1.0);
        ck_assert(box.value(&box, x) == 0.0 && box.piece(&box, x) == 0);
        ck_assert((cut.value(&cut, x) > 0.0) == (k == 2));
        ck_assert(cut.piece(&cut, x) == (k == 2));
    }
}
END_TEST

/* ---- Extremes ---------------------------------------------------------------- */

START_TEST(corners_of_the_cube)
{
    const double ends[] = {0.0, 0x1p-1074, 0x1p-60, 1.0 - 0x1p-53, 1.0};

    for (size_t i = 0; koksma_integrands[i] != NULL; i++) {
        koksma_facts facts;
        koksma_integrand f =
            fixture_make(&facts, koksma_integrands[i]->name, 0, NULL);

        for (size_t code = 0; code < 125; code++) {
            double x[] = {ends[code % 5], ends[code / 5 % 5], ends[code / 25]};
            double v = f.value(&f, x);

            ck_assert(isfinite(v) && f.piece(&f, x) < (size_t)facts.pieces);
        }
        if (strncmp(koksma_integrands[i]->name, "koch", 4) == 0)
            ck_assert(f.value(&f, (double[]){0.0, 1.0}) == 0.0 &&
                      f.value(&f, (double[]){0.5, 0.5}) == 1.0);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("shapes");
    TCase *tc = tcase_create("ranges");

    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 20.0 * (double)oracle_scale());
    tcase_add_test(tc, ranges_contain_values);
    tcase_add_test(tc, ranges_are_tight);
    tcase_add_test(tc, cut_cells_counted);
    tcase_add_test(tc, cut_by_a_box);

    tc = tcase_create("sides");
    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 20.0 * (double)oracle_scale());
    tcase_add_test(tc, sides_of_the_ball);
    tcase_add_test(tc, touching_the_ball);
    tcase_add_test(tc, sides_of_sums);
    tcase_add_test(tc, sides_in_31_dimensions);
    tcase_add_test(tc, sides_of_boxes);
    tcase_add_test(tc, corners_of_the_cube);

    return oracle_run(suite);
}
