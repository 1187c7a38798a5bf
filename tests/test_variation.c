/* The variation on grids against its definition, closed forms, and refusals. */
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "integrand_fixture.h"
#include "oracle.h"
#include "variation.h"

enum { AXES = 4, LONGEST = 6, ROOM = 1296 };

/* Values on a grid, the last axis fastest. */
typedef struct table {
    size_t dim, nodes[AXES], n;
    double v[ROOM];
} table;

static double at(const table *t, const size_t *node)
{
    size_t i = 0;

    for (size_t j = 0; j < t->dim; j++)
        i = i * t->nodes[j] + node[j];
    return t->v[i];
}

/* Of the nodes that a stride keeps the one with number i. */
static size_t kept(const table *t, size_t j, size_t stride, size_t i)
{
    return i * stride < t->nodes[j] - 1 ? i * stride : t->nodes[j] - 1;
}

/* V(f; u) as it is defined: each cell of the face, each of its corners. */
static double oracle_face(const table *t, unsigned u, size_t stride)
{
    size_t cell[AXES] = {0}, node[AXES];
    double sum = 0.0;

    for (;;) {
        double delta = 0.0;
        size_t j = 0;

        for (unsigned corner = 0; corner < 1u << t->dim; corner++) {
            double sign = 1.0;

            if (corner & ~u) continue;
            for (size_t i = 0; i < t->dim; i++) {
                bool up = corner >> i & 1;

                node[i] =
                    u >> i & 1 ? kept(t, i, stride, cell[i] + up) : t->nodes[i] - 1;
                if ((u >> i & 1) && !up) sign = -sign;
            }
            delta += sign * at(t, node);
        }
        sum += fabs(delta);
        for (; j < t->dim; j++) {
            if (!(u >> j & 1)) continue;
            if (kept(t, j, stride, ++cell[j]) < t->nodes[j] - 1) break;
            cell[j] = 0;
        }
        if (j == t->dim) return sum;
    }
}

static double oracle_all(const table *t, size_t stride)
{
    double sum = 0.0;

    for (unsigned u = 1; u < 1u << t->dim; u++)
        sum += oracle_face(t, u, stride);
    return sum;
}

/* Small whole numbers: nothing below rounds. */
static table random_table(oracle_rng *rng)
{
    table t = {.dim = 1 + oracle_below(rng, AXES), .n = 1};

    for (size_t j = 0; j < t.dim; j++) {
        t.nodes[j] = 2 + oracle_below(rng, LONGEST - 1);
        t.n *= t.nodes[j];
    }
    for (size_t i = 0; i < t.n; i++)
        t.v[i] = (double)oracle_below(rng, 9) - 4.0;
    return t;
}

static koksma_variation_result measure(const table *t, koksma_estimate *faces,
                                       oracle_rng *rng)
{
    koksma_variation_result r;
    koksma_variation_grid *g;
    size_t done = 0;

    ck_assert_int_eq(koksma_variation_open(&g, t->nodes, t->dim, NULL), KOKSMA_OK);
    while (done < t->n) {
        size_t now = oracle_below(rng, 2 * LONGEST * LONGEST);

        if (now > t->n - done) now = t->n - done;
        ck_assert_int_eq(koksma_variation_add(g, t->v + done, now, NULL),
                         KOKSMA_OK);
        done += now;
    }
    ck_assert_int_eq(koksma_variation_finish(&r, faces, g, NULL), KOKSMA_OK);
    koksma_variation_close(g);
    return r;
}

START_TEST(tables_are_as_defined)
{
    for (uint64_t round = 0; round < 400 * oracle_scale(); round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        table t = random_table(&rng);
        koksma_estimate faces[1 << AXES];
        koksma_variation_result r = measure(&t, faces, &rng);
        size_t stride = 1;

        for (unsigned u = 1; u < 1u << t.dim; u++)
            ck_assert_msg(faces[u].value == oracle_face(&t, u, 1) &&
                              faces[u].level == 1.0,
                          "seed %ju, table %ju, face %u", (uintmax_t)oracle_seed(),
                          (uintmax_t)round, u);
        for (size_t i = r.levels; i-- > 0; stride *= 2) {
            ck_assert_msg(r.level[i].value.value == oracle_all(&t, stride),
                          "seed %ju, table %ju, stride %zu",
                          (uintmax_t)oracle_seed(), (uintmax_t)round, stride);
            ck_assert_uint_le(r.level[i].cells, (LONGEST - 2) / stride + 1);
        }
        ck_assert(r.level[0].cells <= 2 && r.work == (double)t.n);
        for (size_t i = 1; i < r.levels; i++) /* nested grids only add */
            ck_assert(r.level[i].value.value >= r.level[i - 1].value.value &&
                      r.level[i].cells > r.level[i - 1].cells);
    }
}
END_TEST

/* In any order, at coordinates that are not even. */
START_TEST(points_may_come_in_any_order)
{
    for (uint64_t round = 0; round < 100 * oracle_scale(); round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        table t = random_table(&rng);
        static double x[ROOM * AXES], f[ROOM];
        koksma_estimate faces[1 << AXES];
        koksma_variation_result r;

        for (size_t i = 0; i < t.n; i++) {
            size_t rest = i;

            for (size_t j = t.dim; j-- > 0; rest /= t.nodes[j])
                x[i * t.dim + j] = 1.0 / (double)(LONGEST - rest % t.nodes[j]);
            f[i] = t.v[i];
        }
        for (size_t i = t.n; i-- > 1;) {
            size_t k = oracle_below(&rng, i + 1);
            double keep = f[i];

            f[i] = f[k];
            f[k] = keep;
            for (size_t j = 0; j < t.dim; j++) {
                keep = x[i * t.dim + j];
                x[i * t.dim + j] = x[k * t.dim + j];
                x[k * t.dim + j] = keep;
            }
        }
        ck_assert_int_eq(koksma_variation_points(
                             &r, faces, (koksma_points){x, t.n, t.dim}, f, NULL),
                         KOKSMA_OK);
        ck_assert(r.level[r.levels - 1].value.value == oracle_all(&t, 1));
        for (unsigned u = 1; u < 1u << t.dim; u++)
            ck_assert(faces[u].value == oracle_face(&t, u, 1));
    }
}
END_TEST

/* ---- Integrands -------------------------------------------------------------- */

static koksma_variation_result of(const koksma_integrand *f, koksma_estimate *faces,
                                  koksma_variation_method method, size_t cells)
{
    koksma_variation_opts o = {.method = method, .cells = cells, .seed = 1};
    koksma_variation_result r;
    koksma_error err;

    if (koksma_variation(&r, faces, f, &o, &err)) ck_abort_msg("%s", err.text);
    return r;
}

static double finest(const koksma_variation_result *r)
{
    return r->level[r->levels - 1].value.value;
}

/* V_k of f2 is (2k-1)(1-2a) + 2(1-a), and of f3 with a = 0 and 1/3 at k = 8 it is
 * 87 and 1 (where 0.6 - 1.8/3 is not quite 0 in doubles). */
START_TEST(the_papers_functions)
{
    for (int i = 0; i < 8; i++) {
        double a = i / 16.0, third = 1.0 / 3.0, zero = 0.0;

        for (size_t k = 2; k <= 64; k *= 2) {
            koksma_integrand f = fixture_make(NULL, "f2", 2, &a);
            koksma_variation_result r = of(&f, NULL, KOKSMA_VARIATION_GRID, k);
            double want = (double)(2 * k - 1) * (1.0 - 2.0 * a) + 2.0 * (1.0 - a);

            ck_assert_double_eq_tol(finest(&r), want, 1e-14 * want);
            if (k >= 16) ck_assert_int_eq(r.trend, KOKSMA_TREND_DIVERGING);
        }
        koksma_integrand f = fixture_make(NULL, "f3", 3, &zero);
        koksma_variation_result r = of(&f, NULL, KOKSMA_VARIATION_AUTO, 8);

        ck_assert_double_eq_tol(finest(&r), 87.0, 1e-12);
        f = fixture_make(NULL, "f3", 3, &third);
        r = of(&f, NULL, KOKSMA_VARIATION_AUTO, 16);
        ck_assert_double_eq_tol(finest(&r), 1.0, 1e-12);
        ck_assert_int_eq(r.trend, KOKSMA_TREND_CONVERGED);
    }
}
END_TEST

/* Every integrand of few dimensions, by every way, is what the definition says. */
START_TEST(integrands_are_as_defined)
{
    static const double shifts[] = {0.0, 0.25, 0.5, 1.0};

    for (size_t i = 0; koksma_integrands[i] != NULL; i++) {
        const koksma_integrand_row *row = koksma_integrands[i];

        for (size_t dim = row->dim_least; dim <= row->dim_most && dim <= 3; dim++)
            for (size_t s = 0; s < 4; s++) {
                double param[KOKSMA_PARAMS_MOST];
                size_t k = dim == 3 ? 8 : 32;
                koksma_integrand f;

                for (size_t j = 0; j < koksma_integrand_params(row); j++) {
                    const koksma_param *p = &row->params[j];

                    param[j] = p->kind == KOKSMA_CLOSED && p->most <= 1.0
                                   ? p->least + shifts[s] * (p->most - p->least)
                                   : p->usual;
                }
                f = fixture_make(NULL, row->name, dim, param);

                koksma_variation_result r = of(&f, NULL, KOKSMA_VARIATION_GRID, k);
                double want = fixture_variation(&f, k);

                ck_assert_double_eq_tol(finest(&r), want, 1e-9 * want + 1e-12);
                ck_assert_double_eq_tol(r.level[0].value.value,
                                        fixture_variation(&f, 2),
                                        1e-9 * want + 1e-12);
                if (f.range == NULL) continue;
                r = of(&f, NULL, KOKSMA_VARIATION_BOUNDARY, k);
                ck_assert_msg(fabs(finest(&r) - want) <= 1e-9 * want + 1e-12,
                              "%s dim %zu, shift %g: %.17g, not %.17g", row->name,
                              dim, shifts[s], finest(&r), want);
            }
    }
}
END_TEST

START_TEST(boundary_cells_find_the_faces)
{
    for (size_t dim = 2; dim <= 4; dim++) {
        double c = 0.37;
        koksma_integrand f = fixture_make(NULL, "halfspace", dim, &c);
        koksma_estimate faces[16], grid[16];
        koksma_variation_result r = of(&f, faces, KOKSMA_VARIATION_BOUNDARY, 16),
                                d = of(&f, grid, KOKSMA_VARIATION_GRID, 16);

        ck_assert_uint_eq(r.levels, d.levels);
        for (size_t i = 0; i < r.levels; i++)
            ck_assert(r.level[i].value.value == d.level[i].value.value &&
                      r.level[i].cells == d.level[i].cells);
        for (unsigned u = 0; u < 1u << dim; u++)
            ck_assert(faces[u].value == grid[u].value);
        if (dim <= 3) /* the cost is that of the boundary */
            ck_assert_double_lt(of(&f, NULL, KOKSMA_VARIATION_AUTO, 128).work,
                                0.5 *
                                    of(&f, NULL, KOKSMA_VARIATION_GRID, 128).work);
    }
}
END_TEST

/* Steps at a node, which is on the upper side of one and on the lower of the other:
 * no range of an open box says so. */
static double step_up(const koksma_integrand *f, const double *x)
{
    return f->param[0] > 0.0 ? x[0] >= 0.5 : x[0] > 0.5;
}

static koksma_range step_range(const koksma_integrand *f, const double *lower,
                               const double *upper)
{
    bool all = lower[0] >= 0.5, some = upper[0] > 0.5;

    (void)f;
    return (koksma_range){{all ? 1.0 : 0.0, some ? 1.0 : 0.0}, some && !all};
}

START_TEST(steps_at_a_node)
{
    for (int closed = 0; closed < 2; closed++) {
        koksma_integrand f = {
            .dim = 1, .value = step_up, .range = step_range, .param = {closed}};
        koksma_variation_result r = of(&f, NULL, KOKSMA_VARIATION_BOUNDARY, 32);

        for (size_t i = 0; i < r.levels; i++)
            ck_assert_double_eq(r.level[i].value.value, 1.0);
    }
}
END_TEST

/* Closed forms where the grid reaches them: exactly, and from below. */
START_TEST(closed_forms)
{
    static const struct {
        const char *name;
        size_t dim;
        double param[2], within;
    } cases[] = {{"product", 3, {0.0, 0.0}, 1e-13},
                 {"sum", 3, {0.0, 0.0}, 1e-13},
                 {"corner-peak", 2, {2.0, 0.0}, 1e-12},
                 {"corner-peak", 3, {2.0, 0.0}, 1e-12},
                 {"box", 3, {0.7, 0.0}, 0.0},
                 {"gaussian", 2, {5.0, 0.3}, 1e-4},
                 {"product-peak", 2, {5.0, 0.3}, 1e-4},
                 {"continuous", 2, {2.0, 0.3}, 2e-3},
                 {"continuous", 2, {2.0, 0.25}, 1e-12},
                 {"discontinuous", 2, {2.0, 0.5}, 0.01}};

    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        koksma_facts k;
        koksma_integrand f =
            fixture_make(&k, cases[i].name, cases[i].dim, cases[i].param);
        koksma_variation_result r =
            of(&f, NULL, KOKSMA_VARIATION_AUTO, cases[i].dim == 2 ? 1024 : 64);
        double off = k.variation - finest(&r);

        ck_assert_msg(fabs(off) <= cases[i].within * k.variation && off >= -1e-10,
                      "%s dim %zu: %.17g, not %.17g", cases[i].name, cases[i].dim,
                      finest(&r), k.variation);
    }
}
END_TEST

/* Genz's in four dimensions, where a grid is still within 1 %. */
START_TEST(gaussian_in_four_dimensions)
{
    koksma_facts k;
    koksma_integrand f = fixture_make(&k, "gaussian", 4, NULL);
    koksma_variation_result r = of(&f, NULL, KOKSMA_VARIATION_AUTO, 0);

    ck_assert_uint_eq(r.level[r.levels - 1].cells, 64);
    ck_assert_double_eq_tol(finest(&r), k.variation, 0.01 * k.variation);
    ck_assert_double_lt(finest(&r), k.variation);
}
END_TEST

/* ---- Random cells ------------------------------------------------------------ */

/* How often the intervals hold V_k, and whether the values are right in the mean.
 */
START_TEST(intervals_of_random_cells)
{
    static const double param[] = {3.0, 0.3};

    for (size_t dim = 2; dim <= 3; dim++) {
        enum { RUNS = 300 };
        koksma_integrand f = fixture_make(NULL, "gaussian", dim, param);
        double want = fixture_variation(&f, 16), sum = 0.0, spread = 0.0;
        int held = 0;

        for (uint64_t seed = 0; seed < RUNS; seed++) {
            koksma_variation_opts o = {.method = KOKSMA_VARIATION_RANDOM,
                                       .cells = 16,
                                       .samples = 2000.0,
                                       .seed = seed + 1000 * oracle_seed()};
            koksma_variation_result r;
            koksma_estimate v;

            ck_assert_int_eq(koksma_variation(&r, NULL, &f, &o, NULL), KOKSMA_OK);
            v = r.level[r.levels - 1].value;
            ck_assert(r.levels == 4 && v.level == 0.95);
            held += v.lower <= want && want <= v.upper;
            sum += v.value;
            spread += (v.value - want) * (v.value - want);
        }
        ck_assert_msg(held >= 0.90 * RUNS && held <= 0.99 * RUNS, "dim %zu: %d",
                      dim, held);
        ck_assert_double_le(fabs(sum / RUNS - want),
                            4.0 * sqrt(spread / RUNS / RUNS));
    }
}
END_TEST

/* A single cell of 16^4 has it all: there is no interval that would be honest.  Nor
 * is there one where an order is 0 in all samples. */
START_TEST(rare_cells_have_no_interval)
{
    static const char *const names[] = {"box", "sum"};

    for (size_t i = 0; i < 2; i++) {
        koksma_integrand f = fixture_make(NULL, names[i], 4, NULL);
        koksma_variation_opts o = {.method = KOKSMA_VARIATION_RANDOM,
                                   .cells = 16,
                                   .samples = 10000.0,
                                   .seed = 1};
        koksma_variation_result r;
        koksma_estimate v;

        ck_assert_int_eq(koksma_variation(&r, NULL, &f, &o, NULL), KOKSMA_OK);
        v = r.level[r.levels - 1].value;
        ck_assert(isnan(v.lower) && isnan(v.upper) && v.level == 0.0);
        if (i == 1) ck_assert_double_eq_tol(v.value, 4.0, 1e-10);
    }
}
END_TEST

/* Some were met, but not enough to say how many there are. */
static double sum_and_corner(const koksma_integrand *f, const double *x)
{
    (void)f;
    return x[0] + x[1] + (x[0] <= 0.7 && x[1] <= 0.7 ? 8.0 : 0.0);
}

START_TEST(few_cells_have_no_interval)
{
    koksma_integrand f = {.dim = 2, .value = sum_and_corner};
    int none = 0, met = 0;

    for (uint64_t seed = 0; seed < 20; seed++) {
        koksma_variation_opts o = {.method = KOKSMA_VARIATION_RANDOM,
                                   .cells = 32,
                                   .samples = 20000.0,
                                   .seed = seed};
        koksma_variation_result r;
        koksma_estimate v;

        ck_assert_int_eq(koksma_variation(&r, NULL, &f, &o, NULL), KOKSMA_OK);
        v = r.level[r.levels - 1].value;
        none += isnan(v.lower);
        met += v.value > 2.5;
        ck_assert_double_ge(r.work, 0.9 * 5.0 * 20000.0);
        ck_assert_double_le(r.work, 5.0 * 20000.0 + 100.0);
    }
    ck_assert_int_eq(none, 20);
    ck_assert_int_ge(met, 10);
}
END_TEST

START_TEST(faces_of_random_cells)
{
    koksma_integrand f = fixture_make(NULL, "product", 5, NULL);
    koksma_variation_opts o = {.method = KOKSMA_VARIATION_RANDOM,
                               .cells = 4,
                               .samples = 200000.0,
                               .seed = 3};
    koksma_estimate faces[32];
    koksma_variation_result r;

    ck_assert_int_eq(koksma_variation(&r, faces, &f, &o, NULL), KOKSMA_OK);
    ck_assert_double_eq_tol(finest(&r), 31.0, 1e-10);
    for (unsigned u = 1; u < 32; u++) /* every cell of every face is alike */
        ck_assert_double_eq_tol(faces[u].value, 1.0, 1e-12);
}
END_TEST

/* Grids first, random cells beyond, and the trend of both. */
START_TEST(many_axes)
{
    koksma_integrand f = fixture_make(NULL, "product", 6, NULL);
    koksma_variation_opts o = {.samples = 1e5, .seed = 1};
    koksma_variation_result r;

    ck_assert_int_eq(koksma_variation(&r, NULL, &f, &o, NULL), KOKSMA_OK);
    ck_assert(r.level[0].value.level == 1.0);
    ck_assert(r.level[r.levels - 1].value.level == 0.95);
    ck_assert_uint_eq(r.level[r.levels - 1].cells, 64);
    ck_assert_double_eq_tol(finest(&r), 63.0, 1e-9);
    ck_assert_int_eq(r.trend, KOKSMA_TREND_CONVERGED);
}
END_TEST

/* ---- Stopping ---------------------------------------------------------------- */

typedef struct patience {
    int calls, most;
    double value, work; /* as last told */
} patience;

static int lose_patience(void *state, double lower, double upper, double work)
{
    patience *p = state;

    ck_assert(lower == upper && lower >= 0.0 && work > p->work);
    p->value = lower;
    p->work = work;
    return ++p->calls >= p->most;
}

/* Whenever it is stopped, the grids that are done are those of the whole. */
START_TEST(stopped_at_any_time)
{
    static const koksma_variation_opts ways[] = {
        {.method = KOKSMA_VARIATION_GRID, .cells = 256},
        {.method = KOKSMA_VARIATION_BOUNDARY, .cells = 1024},
        {.method = KOKSMA_VARIATION_RANDOM, .cells = 64, .samples = 1e4},
    };
    koksma_variation_opts o = ways[_i];
    koksma_integrand f = fixture_make(NULL, "f2", 2, NULL);
    koksma_variation_result whole, r = {0};
    koksma_status status = KOKSMA_STOPPED;
    size_t some = 0;

    ck_assert_int_eq(koksma_variation(&whole, NULL, &f, &o, NULL), KOKSMA_OK);
    o.progress = lose_patience;
    for (int most = 1; status == KOKSMA_STOPPED; most++) {
        patience p = {.most = most};
        koksma_error err = {0};

        o.state = &p;
        status = koksma_variation(&r, NULL, &f, &o, &err);
        ck_assert_int_eq(p.calls, most - (status == KOKSMA_OK));
        ck_assert_int_eq(err.status, status);
        some += r.levels > 0 && r.levels < whole.levels;
        for (size_t i = 0; i < r.levels; i++) {
            ck_assert_uint_eq(r.level[i].cells, whole.level[i].cells);
            ck_assert(r.level[i].value.value == whole.level[i].value.value);
        }
        if (status == KOKSMA_STOPPED)
            ck_assert(p.value == (r.levels > 0 ? finest(&r) : 0.0));
    }
    ck_assert_uint_gt(some, 0);
    ck_assert_uint_eq(r.levels, whole.levels);
}
END_TEST

/* ---- The trend --------------------------------------------------------------- */

static koksma_variation_result judged(const double *v, size_t count, double half)
{
    koksma_variation_result r = {.levels = count};

    for (size_t i = 0; i < count; i++) {
        double h = half * v[i];

        r.level[i].value =
            (koksma_estimate){v[i], v[i] - h, v[i] + h, half > 0.0 ? 0.95 : 1.0};
    }
    koksma_variation_judge(&r);
    return r;
}

START_TEST(trends)
{
    static const struct {
        double v[4];
        size_t count;
        double half;
        koksma_trend trend;
    } cases[] = {
        {{1, 2, 4, 8}, 4, 0.0, KOKSMA_TREND_DIVERGING},
        {{1, 2, 4}, 2, 0.0, KOKSMA_TREND_UNDECIDED},      /* one doubling */
        {{1, 2, 4, 7.7}, 4, 0.0, KOKSMA_TREND_UNDECIDED}, /* q < p - 0.05 */
        {{1, 2, 4, 7.8}, 4, 0.0, KOKSMA_TREND_DIVERGING},
        {{1, 1.18, 1.41, 1.7}, 4, 0.0, KOKSMA_TREND_DIVERGING},
        {{1, 1.1, 1.3, 1.545}, 4, 0.0, KOKSMA_TREND_UNDECIDED}, /* p < 1/4 */
        {{1, 3, 3, 3}, 4, 0.0, KOKSMA_TREND_CONVERGED},
        {{1, 2, 3, 3}, 4, 0.0, KOKSMA_TREND_UNDECIDED}, /* a peak off the nodes */
        {{3, 3, 3.018, 3.036}, 4, 0.0, KOKSMA_TREND_CONVERGED},
        {{3, 3, 3.025, 3.04}, 4, 0.0, KOKSMA_TREND_UNDECIDED},
        {{0, 0, 0}, 3, 0.0, KOKSMA_TREND_CONVERGED},
        {{0, 0, 0, 1}, 4, 0.0, KOKSMA_TREND_UNDECIDED},
        {{0, 0, 1, 2}, 4, 0.0, KOKSMA_TREND_UNDECIDED},
        {{3, 3, 3.02, 3}, 4, 0.01, KOKSMA_TREND_CONVERGED},
        {{3, 3, 3.02, 3}, 4, 0.03, KOKSMA_TREND_UNDECIDED},
        {{1, 2, 4, 8}, 4, 0.05, KOKSMA_TREND_DIVERGING},
        {{1, 1.3, 1.69, 2.2}, 4, 0.1, KOKSMA_TREND_UNDECIDED},
    };

    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        koksma_variation_result r =
            judged(cases[i].v, cases[i].count, cases[i].half);

        ck_assert_msg(r.trend == cases[i].trend, "case %zu: %d", i, r.trend);
        if (i == 0) ck_assert_double_eq_tol(r.rate, 1.0, 1e-15);
    }
}
END_TEST

static double ramp(const koksma_integrand *f, const double *x)
{
    double s = (x[0] + x[1] - 1.0) / f->param[0];

    return s < -30.0 ? 0.0 : s > 30.0 ? 1.0 : 1.0 / (1.0 + exp(-s));
}

/* A steep ramp looks like a jump until a cell is narrower than it is; a kink is
 * finite in the plane, and not in space. */
static double kink(const koksma_integrand *f, const double *x)
{
    double s = -0.5 * (double)f->dim;

    for (size_t j = 0; j < f->dim; j++)
        s += x[j];
    return s > 0.0 ? s : 0.0;
}

START_TEST(ramps_and_kinks)
{
    koksma_integrand f = {.dim = 2, .value = ramp, .param = {0.01}};

    ck_assert_int_eq(of(&f, NULL, KOKSMA_VARIATION_AUTO, 16).trend,
                     KOKSMA_TREND_DIVERGING);
    ck_assert_int_eq(of(&f, NULL, KOKSMA_VARIATION_AUTO, 128).trend,
                     KOKSMA_TREND_UNDECIDED);
    ck_assert_int_eq(of(&f, NULL, KOKSMA_VARIATION_AUTO, 2048).trend,
                     KOKSMA_TREND_CONVERGED);
    f = (koksma_integrand){.dim = 2, .value = kink};
    ck_assert_int_eq(of(&f, NULL, KOKSMA_VARIATION_AUTO, 64).trend,
                     KOKSMA_TREND_CONVERGED);
    f.dim = 3;

    koksma_variation_result r = of(&f, NULL, KOKSMA_VARIATION_AUTO, 64);

    ck_assert_int_eq(r.trend, KOKSMA_TREND_DIVERGING);
    ck_assert_double_eq_tol(r.rate, 1.0, 0.1);
}
END_TEST

/* ---- Rounding ---------------------------------------------------------------- */

/* A sum of two functions of one coordinate each has no mixed difference, but
 * rounding makes some. */
START_TEST(rounding_counts_as_zero)
{
    table t = {.dim = 2, .nodes = {6, 6}, .n = 36};
    koksma_estimate faces[4];
    oracle_rng rng = oracle_rng_start(1, 1);

    for (size_t i = 0; i < t.n; i++)
        t.v[i] = 0.1 * (double)(i / 6) + 0.7 / (1.0 + (double)(i % 6));
    measure(&t, faces, &rng);
    ck_assert_double_eq(faces[3].value, 0.0);
    ck_assert_double_eq_tol(faces[1].value, 0.5, 1e-15);
    for (int above = 0; above < 2; above++) {
        for (size_t i = 0; i < t.n; i++)
            t.v[i] = 1.0;
        t.v[0] = 1.0 + (above ? 0x1p-49 : 0x1p-51);
        measure(&t, faces, &rng);
        ck_assert_double_eq(faces[3].value, above ? 0x1p-49 : 0.0);
    }
    /* What is large may be in either of two layers. */
    t = (table){.dim = 2, .nodes = {3, 6}, .n = 18};
    for (size_t i = 0; i < t.n; i++)
        t.v[i] = (i / 6 == 1 ? 1000.1 : 0.0) + 0.7 / (1.0 + (double)(i % 6));
    t.v[8] = nextafter(t.v[8], 2000.0);
    measure(&t, faces, &rng);
    ck_assert_double_eq(faces[3].value, 0.0);
    /* Along one axis a difference is what it is. */
    t = (table){
        .dim = 1, .nodes = {4}, .n = 4, .v = {1.0, 1.0 + 0x1p-52, 1.0, 1.0}};
    ck_assert_double_eq(measure(&t, faces, &rng).level[1].value.value, 0x1p-51);
}
END_TEST

/* ---- Refusals ---------------------------------------------------------------- */

static void check_refused(koksma_status got, koksma_status want,
                          const koksma_error *err, const char *text)
{
    ck_assert_int_eq(got, want);
    ck_assert_str_eq(err->text, text);
}

static koksma_status tell(const size_t *nodes, size_t dim, const double *v,
                          size_t count, koksma_error *err)
{
    koksma_variation_grid *g = NULL;
    koksma_variation_result r;
    koksma_status status = koksma_variation_open(&g, nodes, dim, err);

    if (status == KOKSMA_OK) status = koksma_variation_add(g, v, count, err);
    if (status == KOKSMA_OK) status = koksma_variation_finish(&r, NULL, g, err);
    koksma_variation_close(g);
    return status;
}

START_TEST(grids_that_are_none)
{
    static const size_t nodes[] = {2, 3}, flat[] = {3, 1};
    double v[7] = {0, 1, 2, 3, 4, 5, 6};
    size_t many[70];
    koksma_error err;

    for (size_t i = 0; i < 70; i++)
        many[i] = 2;
    check_refused(tell(nodes, 0, v, 0, &err), KOKSMA_EINVAL, &err,
                  "dimension 0: there is nothing that varies");
    check_refused(tell(many, 17, v, 0, &err), KOKSMA_EINVAL, &err,
                  "17 axes have 131071 faces, and at most 65535, those of 16 axes, "
                  "are looked at");
    check_refused(
        tell(many, 70, v, 0, &err), KOKSMA_EINVAL, &err,
        "70 axes have 2^70 - 1 faces, and at most 65535, those of 16 axes, "
        "are looked at");
    check_refused(tell(flat, 2, v, 3, &err), KOKSMA_EINVAL, &err,
                  "axis 2 has 1 nodes, and a cell takes 2");
    check_refused(tell(nodes, 2, v, 5, &err), KOKSMA_EINVAL, &err,
                  "5 values, but the grid has 6 nodes");
    check_refused(tell(nodes, 2, v, 7, &err), KOKSMA_EINVAL, &err,
                  "more values than nodes");
    v[5] = (double)NAN;
    check_refused(tell(nodes, 2, v, 6, &err), KOKSMA_EDOMAIN, &err,
                  "the value at node (1, 2), counted from 0, is nan, not finite");
    v[5] = -(double)INFINITY;
    check_refused(tell(nodes, 2, v, 6, &err), KOKSMA_EDOMAIN, &err,
                  "the value at node (1, 2), counted from 0, is -inf, not finite");
    v[5] = DBL_MAX;
    v[4] = -DBL_MAX;
    check_refused(tell(nodes, 2, v, 6, &err), KOKSMA_EDOMAIN, &err,
                  "differences of the values leave the range of a double");
}
END_TEST

START_TEST(points_that_are_no_grid)
{
    double x[] = {0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 1.0};
    const double f[] = {0.0, 1.0, 2.0, 3.0};
    koksma_variation_result r;
    koksma_error err;

    check_refused(
        koksma_variation_points(&r, NULL, (koksma_points){x, 3, 2}, f, &err),
        KOKSMA_EINVAL, &err,
        "3 points are no full grid: their coordinates make one of 4 nodes");
    x[6] = 0.0;
    check_refused(
        koksma_variation_points(&r, NULL, (koksma_points){x, 4, 2}, f, &err),
        KOKSMA_EINVAL, &err,
        "point 4 repeats one before it: the points are no full grid");
    x[7] = 2.0;
    ck_assert_int_eq(
        koksma_variation_points(&r, NULL, (koksma_points){x, 4, 2}, f, &err),
        KOKSMA_EDOMAIN);
    check_refused(
        koksma_variation_points(&r, NULL, (koksma_points){x, 1, 2}, f, &err),
        KOKSMA_EINVAL, &err, "axis 1 has 1 nodes, and a cell takes 2");
}
END_TEST

static double pole(const koksma_integrand *f, const double *x)
{
    (void)f;
    return 1.0 / (x[0] - 0.5);
}

static double cliff(const koksma_integrand *f, const double *x)
{
    (void)f;
    return x[0] > 0.5 ? DBL_MAX : -DBL_MAX;
}

START_TEST(integrands_that_are_none)
{
    koksma_integrand f = {.dim = 2, .value = pole};
    koksma_variation_result r;
    koksma_error err;
    koksma_variation_opts o = {.method = KOKSMA_VARIATION_RANDOM,
                               .cells = 4,
                               .samples = 10000.0,
                               .seed = 1};

    check_refused(koksma_variation(&r, NULL, &f, NULL, &err), KOKSMA_EDOMAIN, &err,
                  "the value at (0.5, 0) is inf, not finite");
    ck_assert_int_eq(koksma_variation(&r, NULL, &f, &o, &err), KOKSMA_EDOMAIN);
    ck_assert_ptr_nonnull(strstr(err.text, "is inf, not finite"));
    f.value = cliff;
    check_refused(koksma_variation(&r, NULL, &f, &o, &err), KOKSMA_EDOMAIN, &err,
                  "differences of the values leave the range of a double");
    f.dim = 0;
    ck_assert_int_eq(koksma_variation(&r, NULL, &f, NULL, &err), KOKSMA_EINVAL);
    f.dim = 17;
    ck_assert_int_eq(koksma_variation(&r, NULL, &f, NULL, &err), KOKSMA_EINVAL);
    f.dim = 2;
    o.cells = 12;
    check_refused(koksma_variation(&r, NULL, &f, &o, &err), KOKSMA_EINVAL, &err,
                  "12 cells an axis, which is no power of 2 from 2 to 2^24");
    o = (koksma_variation_opts){
        .method = KOKSMA_VARIATION_RANDOM, .cells = 4, .samples = -1.0, .seed = 1};
    check_refused(koksma_variation(&r, NULL, &f, &o, &err), KOKSMA_EINVAL, &err,
                  "-1 samples, and there may be 2^50");
    o = (koksma_variation_opts){
        .method = KOKSMA_VARIATION_BOUNDARY, .cells = 4, .seed = 1};
    check_refused(koksma_variation(&r, NULL, &f, &o, &err), KOKSMA_EINVAL, &err,
                  "boundary cells take an integrand whose range is known");
    o = (koksma_variation_opts){
        .method = KOKSMA_VARIATION_GRID, .cells = 1 << 24, .seed = 1};
    check_refused(koksma_variation(&r, NULL, &f, &o, &err), KOKSMA_EINVAL, &err,
                  "16777216 cells on each of 2 axes have 2.81e+14 nodes: too many");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("variation");
    TCase *c = tcase_create("variation"), *big = tcase_create("big");

    tcase_set_timeout(c, 120.0);
    tcase_add_test(c, tables_are_as_defined);
    tcase_add_test(c, points_may_come_in_any_order);
    tcase_add_test(c, the_papers_functions);
    tcase_add_test(c, integrands_are_as_defined);
    tcase_add_test(c, boundary_cells_find_the_faces);
    tcase_add_test(c, closed_forms);
    tcase_add_test(c, intervals_of_random_cells);
    tcase_add_test(c, rare_cells_have_no_interval);
    tcase_add_test(c, faces_of_random_cells);
    tcase_add_test(c, few_cells_have_no_interval);
    tcase_add_test(c, steps_at_a_node);
    tcase_add_test(c, many_axes);
    tcase_add_loop_test(c, stopped_at_any_time, 0, 3);
    tcase_add_test(c, trends);
    tcase_add_test(c, ramps_and_kinks);
    tcase_add_test(c, rounding_counts_as_zero);
    tcase_add_test(c, grids_that_are_none);
    tcase_add_test(c, points_that_are_no_grid);
    tcase_add_test(c, integrands_that_are_none);
    suite_add_tcase(suite, c);
    tcase_set_tags(big, "big");
    tcase_set_timeout(big, 120.0);
    tcase_add_test(big, gaussian_in_four_dimensions);
    suite_add_tcase(suite, big);
    return oracle_run(suite);
}
