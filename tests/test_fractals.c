/* The fractals among the integrands: Koch's snowflake as a polygon, and the cells
 * of the random ones counted. */
#include <stdlib.h>
#include <string.h>

#include "integrand_fixture.h"
#include "oracle.h"

/* ---- Koch's snowflake as a polygon ------------------------------------------- */

enum { EDGES_MOST = 3 << 14 };

typedef struct polygon {
    double x[EDGES_MOST], y[EDGES_MOST];
    size_t n;
} polygon;

/* The triangle of that side whose lower side is turned by `turn`. */
static void start_polygon(polygon *p, double side, double turn)
{
    p->n = 3;
    for (size_t i = 0; i < 3; i++) {
        double angle = turn + acos(-1.0) * ((double)i * 2.0 / 3.0 + 0.5);

        p->x[i] = 0.5 + side / sqrt(3.0) * cos(angle);
        p->y[i] = 0.5 + side / sqrt(3.0) * sin(angle);
    }
}

/* Every edge as four, with a triangle on the middle third, outwards (the right of
 * an edge that goes round counterclockwise). */
static void grow(polygon *p)
{
    static polygon old;

    memcpy(&old, p, sizeof old);
    p->n = 4 * old.n;
    for (size_t i = 0; i < old.n; i++) {
        size_t j = (i + 1) % old.n;
        double dx = (old.x[j] - old.x[i]) / 3.0, dy = (old.y[j] - old.y[i]) / 3.0;
        const double x[] = {0.0, dx, 1.5 * dx + sqrt(0.75) * dy, 2.0 * dx};
        const double y[] = {0.0, dy, 1.5 * dy - sqrt(0.75) * dx, 2.0 * dy};

        for (size_t k = 0; k < 4; k++) {
            p->x[4 * i + k] = old.x[i] + x[k];
            p->y[4 * i + k] = old.y[i] + y[k];
        }
    }
}

/* The same with the triangle of 30 degrees over each edge: what is to grow stays
 * inside of it. */
static void cover(polygon *out, const polygon *p)
{
    out->n = 2 * p->n;
    for (size_t i = 0; i < p->n; i++) {
        size_t j = (i + 1) % p->n;
        double dx = p->x[j] - p->x[i], dy = p->y[j] - p->y[i];

        out->x[2 * i] = p->x[i];
        out->y[2 * i] = p->y[i];
        out->x[2 * i + 1] = p->x[i] + 0.5 * dx + dy / sqrt(12.0);
        out->y[2 * i + 1] = p->y[i] + 0.5 * dy - dx / sqrt(12.0);
    }
}

static double area_of(const polygon *p)
{
    double twice = 0.0;

    for (size_t i = 0; i < p->n; i++) {
        size_t j = (i + 1) % p->n;

        twice +=
            (p->x[i] - 0.5) * (p->y[j] - 0.5) - (p->x[j] - 0.5) * (p->y[i] - 0.5);
    }
    return 0.5 * twice;
}

static bool is_inside(const polygon *p, double x, double y)
{
    bool inside = false;

    for (size_t i = 0; i < p->n; i++) {
        size_t j = (i + 1) % p->n;

        if ((p->y[i] > y) != (p->y[j] > y) &&
            x < p->x[i] + (p->x[j] - p->x[i]) * (y - p->y[i]) / (p->y[j] - p->y[i]))
            inside = !inside;
    }
    return inside;
}

START_TEST(koch_is_between_polygons)
{
    static polygon inner, outer;
    static const double params[][2] = {{0.7, 0.3}, {0.86, 0.0}, {0.31, 5.0}};

    for (size_t i = 0; i < 3; i++) {
        koksma_facts facts;
        koksma_integrand f = fixture_make(&facts, "koch", 2, params[i]);
        size_t undecided = 0;

        start_polygon(&inner, params[i][0], params[i][1]);
        for (int level = 0; level < 5; level++)
            grow(&inner);
        cover(&outer, &inner);
        for (uint64_t j = 0; j < 1500; j++) {
            oracle_rng rng = oracle_rng_start(oracle_seed(), j);
            double x[] = {oracle_dyadic(&rng, 53), oracle_dyadic(&rng, 53)};
            bool in = is_inside(&inner, x[0], x[1]),
                 out = !is_inside(&outer, x[0], x[1]);

            if (in) ck_assert(f.value(&f, x) == 1.0);
            if (out) ck_assert(f.value(&f, x) == 0.0);
            undecided += !in && !out;
        }
        ck_assert_uint_lt(undecided, 30);
    }
}
END_TEST

/* Each level adds 4/9 of what the level before added. */
START_TEST(area_of_koch)
{
    static polygon p;
    double side = 0.7, before, after;
    koksma_facts facts;

    fixture_make(&facts, "koch", 2, (double[]){side, 0.3});
    start_polygon(&p, side, 0.3);
    for (int level = 0; level < 6; level++)
        grow(&p);
    before = area_of(&p);
    grow(&p);
    after = area_of(&p);
    ck_assert_double_eq_tol(before + (after - before) / (1.0 - 4.0 / 9.0),
                            facts.integral, 1e-12);
    ck_assert_double_eq_tol(facts.box_dim, 1.2618595071429148, 1e-15);
}
END_TEST

/* What the polygons leave open, a fine grid settles well enough. */
START_TEST(share_of_koch)
{
    koksma_facts facts;
    koksma_integrand f = fixture_make(&facts, "koch", 2, NULL);
    size_t m = 600, inside = 0;

    for (size_t i = 0; i < m * m; i++) {
        double x[] = {((double)(i % m) + 0.5) / (double)m,
                      ((double)(i / m) + 0.5) / (double)m};

        inside += f.value(&f, x) == 1.0;
    }
    ck_assert_double_eq_tol((double)inside / (double)(m * m), facts.integral, 2e-4);
}
END_TEST

/* ---- Fractals, counted ------------------------------------------------------- */

/* The subcells' centres of cell c of the 5^level grid: how many are in. */
static size_t centres_inside(const koksma_integrand *f, size_t c, size_t level,
                             size_t subcells)
{
    size_t inside = 0, side = 1;

    for (size_t i = 0; i < level; i++)
        side *= 5;
    for (size_t s = 0; s < subcells; s++) {
        double x[3];
        size_t cell = c, sub = s;

        for (size_t k = 0; k < f->dim; k++, cell /= side, sub /= 5)
            x[k] =
                ((double)(5 * (cell % side) + sub % 5) + 0.5) / (double)(5 * side);
        inside += f->value(f, x) == 1.0;
    }
    return inside;
}

/* A divided cell has subcells that are in and such that are out, and no other has
 * both: so m^level cells are mixed, and the share of those that are in adds up. */
static void check_fractal(const char *name, double m, double pattern, size_t level)
{
    const double param[] = {m, pattern};
    koksma_facts facts;
    koksma_integrand f = fixture_make(&facts, name, 0, param);
    size_t subcells = f.dim == 2 ? 25 : 125, cells = 1, divided = 1, mixed = 0,
           full = 0;
    double in = 0.0;

    for (size_t i = 0; i < level; i++) {
        in += floor(((double)subcells - m) / 2.0) * (double)divided /
              (double)cells / (double)subcells;
        cells *= subcells;
        divided *= (size_t)m;
    }
    for (size_t c = 0; c < cells; c++) {
        size_t inside = centres_inside(&f, c, level, subcells);

        mixed += inside > 0 && inside < subcells;
        full += inside == subcells;
    }
    ck_assert_msg(mixed == divided, "%s m %g: %zu mixed cells of %zu", name, m,
                  mixed, divided);
    ck_assert_uint_eq(full, (size_t)lround(in * (double)cells));
    ck_assert_double_eq_tol(in + (double)divided / (double)cells * facts.integral,
                            facts.integral, 1e-15);
    ck_assert(facts.box_dim >= (double)f.dim - 1.0);
    if (m > pow(5.0, (double)f.dim - 1.0))
        ck_assert_double_eq_tol(pow(5.0, facts.box_dim), m, 1e-12);
}

START_TEST(cells_of_fractals)
{
    for (size_t level = 0; level <= 2; level++) {
        check_fractal("fractal2", 5.0, 1.0, level);
        check_fractal("fractal2", 9.0, 2.0, level);
        check_fractal("fractal2", 20.0, 3.0, level);
        check_fractal("fractal2", 23.0, 4.0, level);
    }
    check_fractal("fractal2", 11.0, 5.0, 3);
    check_fractal("fractal3", 25.0, 1.0, 1);
    check_fractal("fractal3", 91.0, 2.0, 1);
}
END_TEST

/* Patterns differ, and the mean over random points is the integral: below the last
 * level too, which half of 23/25 of the points to the power of 26 reach. */
START_TEST(patterns_of_fractals)
{
    const double one[] = {23.0, 1.0}, two[] = {23.0, 2.0};
    koksma_facts facts;
    koksma_integrand f = fixture_make(&facts, "fractal2", 2, one);
    koksma_integrand g = fixture_make(NULL, "fractal2", 2, two);
    size_t n = 20000, inside = 0, differ = 0;

    for (uint64_t i = 0; i < n; i++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), i);
        double x[] = {oracle_dyadic(&rng, 53), oracle_dyadic(&rng, 53)};

        inside += f.value(&f, x) == 1.0;
        differ += f.value(&f, x) != g.value(&g, x);
    }
    ck_assert_double_eq_tol((double)inside / (double)n, facts.integral,
                            5.0 * sqrt(facts.variance / (double)n));
    ck_assert_uint_gt(differ, n / 4);
}
END_TEST

/* The far faces belong to the last cells. */
START_TEST(faces_of_fractals)
{
    koksma_integrand f = fixture_make(NULL, "fractal2", 2, NULL);

    for (int i = 0; i <= 400; i++) {
        double y = i / 400.0, on[] = {1.0, y}, near[] = {1.0 - 0x1p-53, y};

        ck_assert(f.value(&f, on) == f.value(&f, near));
        on[0] = near[0] = y;
        on[1] = 1.0;
        near[1] = 1.0 - 0x1p-53;
        ck_assert(f.value(&f, on) == f.value(&f, near));
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fractals");
    TCase *tc = tcase_create("fractals");

    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 30.0);
    tcase_add_test(tc, koch_is_between_polygons);
    tcase_add_test(tc, area_of_koch);
    tcase_add_test(tc, share_of_koch);
    tcase_add_test(tc, cells_of_fractals);
    tcase_add_test(tc, patterns_of_fractals);
    tcase_add_test(tc, faces_of_fractals);
    return oracle_run(suite);
}
