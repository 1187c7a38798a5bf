/* What random lines, samples and points in cells say of a discontinuity. */
#include <stdlib.h>
#include <string.h>

#include "cells_kernels.h"
#include "integrand_fixture.h"
#include "oracle.h"

/* ---- Lines ------------------------------------------------------------------- */

static koksma_lines_result cross(const koksma_integrand *f, koksma_estimate *axes,
                                 size_t lines, size_t steps, uint64_t seed)
{
    koksma_lines_opts o = KOKSMA_LINES_DEFAULTS;
    koksma_lines_result r;
    koksma_error err;

    o.lines = lines;
    o.steps = steps;
    o.seed = seed;
    if (koksma_lines(&r, axes, f, &o, &err)) ck_abort_msg("%s", err.text);
    ck_assert(r.lines == lines && r.extent.level == 0.95);
    return r;
}

/* Within four of the estimate's own standard errors, and its exact jumps. */
static void check_lines(const char *name, size_t dim, const double *param)
{
    koksma_facts k;
    koksma_integrand f = fixture_make(&k, name, dim, param);
    koksma_estimate axes[8];
    koksma_lines_result r = cross(&f, axes, 400, 64, oracle_seed());
    double sum = 0.0;

    ck_assert_msg(fabs(r.extent.value - k.extent) <=
                      2.0 * (r.extent.upper - r.extent.lower),
                  "%s dim %zu: %g in [%g,%g], not %g", name, dim, r.extent.value,
                  r.extent.lower, r.extent.upper, k.extent);
    ck_assert_msg(fabs(r.area.value - k.area) <=
                      2.0 * (r.area.upper - r.area.lower),
                  "%s dim %zu: %g in [%g,%g], not %g", name, dim, r.area.value,
                  r.area.lower, r.area.upper, k.area);
    for (size_t j = 0; j < dim; j++)
        sum += axes[j].value;
    ck_assert_double_eq_tol(sum, r.extent.value, 1e-12);
    ck_assert_double_le(r.jump, k.jump * (1.0 + 1e-9));
    ck_assert_double_ge(r.jump, k.jump * 0.6);
    ck_assert_double_eq_tol(r.jump_rms, k.jump_rms, 0.2 * k.jump_rms);
    if (k.jump == k.jump_rms)
        ck_assert_double_eq_tol(r.jump_rms, k.jump, 1e-9 * k.jump);
    ck_assert_uint_eq(r.axes, strcmp(name, "discontinuous") == 0 ? 2 : dim);
    ck_assert_double_eq_tol(r.slope.value, k.box_dim, 0.06);
    ck_assert(r.work >= (double)(dim + 1) * 400.0 * 65.0);
}

START_TEST(extents_by_lines)
{
    const double a = 0.2, c = 0.45, w[] = {0.7, 0.6};

    for (size_t dim = 2; dim <= 6; dim++) {
        check_lines("ball", dim, &c);
        check_lines("halfspace", dim, &c);
        check_lines("mixture", dim, &a);
        check_lines("box", dim, &c);
        check_lines("discontinuous", dim, w);
    }
    check_lines("f2", 2, &a);
    check_lines("f3", 3, &a);
    check_lines("simplex", 3, NULL);
}
END_TEST

/* Lines that are uniform among all enter a face uniformly, along ways that are
 * uniform in the ball of dim - 1 dimensions where the face sees them: there the
 * mean of t_k^2 is 1/(dim+1), and that of t_k^4 is 3/((dim+1)(dim+3)). */
START_TEST(ways_of_lines)
{
    enum { LINES = 40000 };

    for (size_t dim = 1; dim <= 7; dim++) {
        double start[7], way[7], room[9], squares = 0.0, fourths = 0.0, n = 0.0;
        ki_line line = {start, way, 0.0};
        koksma_rng rng = koksma_rng_seed(oracle_seed(), dim);
        size_t entered[7][2] = {{0}};

        for (int i = 0; i < LINES; i++) {
            double norm = 0.0;
            size_t axis = 0;

            ki_line_across(&line, dim, room, &rng);
            while (axis < dim && start[axis] != 0.0 && start[axis] != 1.0)
                axis++;
            ck_assert(axis < dim);
            entered[axis][start[axis] == 1.0]++;
            for (size_t k = 0; k < dim; k++) {
                double end = start[k] + line.length * way[k];

                ck_assert(end > -1e-12 && end < 1.0 + 1e-12);
                norm += way[k] * way[k];
                if (k == axis) continue;
                squares += way[k] * way[k];
                fourths += pow(way[k], 4.0);
                n += 1.0;
            }
            ck_assert_double_eq_tol(norm, 1.0, 1e-12);
        }
        for (size_t k = 0; k < dim; k++)
            for (int side = 0; side < 2; side++)
                ck_assert_double_eq_tol((double)entered[k][side],
                                        LINES / (2.0 * (double)dim),
                                        5.0 * sqrt(LINES / 2.0 / (double)dim));
        if (dim == 1) continue;
        ck_assert_double_eq_tol(squares / n * (double)(dim + 1), 1.0, 0.03);
        ck_assert_double_eq_tol(fourths / n * (double)((dim + 1) * (dim + 3)), 3.0,
                                0.2);
    }
}
END_TEST

/* Steep and smooth: no jump.  state: a width, or a frequency. */
static double ramp(const koksma_integrand *f, const double *x)
{
    double s = -0.5 * (double)f->dim;

    for (size_t k = 0; k < f->dim; k++)
        s += x[k];
    return tanh(s / *(const double *)f->state);
}

static double wave(const koksma_integrand *f, const double *x)
{
    double s = 0.0;

    for (size_t k = 0; k < f->dim; k++)
        s += x[k];
    return cos(s * *(const double *)f->state);
}

static double peak(const koksma_integrand *f, const double *x)
{
    double s = 0.0;

    for (size_t k = 0; k < f->dim; k++)
        s += (x[k] - 0.5) * (x[k] - 0.5);
    return exp(-s / (*(const double *)f->state * *(const double *)f->state));
}

START_TEST(slopes_are_no_jumps)
{
    static const double widths[] = {0.01, 0.001, 1e-6}, sigma = 0.1, often = 40.0;

    for (size_t dim = 1; dim <= 6; dim += dim == 2 ? 2 : 1) {
        koksma_integrand f = {.dim = dim, .value = ramp};

        for (size_t i = 0; i < 3; i++) {
            f.state = &widths[i];
            ck_assert(cross(&f, NULL, 60, 64, 1).extent.value == 0.0);
        }
        f.value = wave;
        f.state = &often;
        ck_assert(cross(&f, NULL, 60, 64, 1).jump == 0.0);
        f.value = peak;
        f.state = &sigma;
        ck_assert(cross(&f, NULL, 60, 64, 1).area.value == 0.0);
    }
}
END_TEST

/* A staircase with a slope: all of its seven jumps, within a single step too. */
static double stairs(const koksma_integrand *f, const double *x)
{
    (void)f;
    return floor(8.0 * x[0]) + 0.3 * x[0];
}

START_TEST(jumps_within_a_step)
{
    koksma_integrand f = {.dim = 2, .value = stairs};
    koksma_estimate axes[2];

    for (size_t steps = 1; steps <= 5; steps++) {
        koksma_lines_result r = cross(&f, axes, 20, steps, 3);

        ck_assert(axes[0].value == 7.0 && axes[1].value == 0.0);
        ck_assert_double_eq_tol(r.jump, 1.0, 1e-9);
        ck_assert_double_eq_tol(r.jump_rms, 1.0, 1e-9);
        ck_assert_uint_eq(r.axes, 1);
        /* Equal lines leave something unseen, and no less than that. */
        ck_assert_double_eq_tol(r.extent.upper - 7.0, sqrt(1.0) * 2 * 3.6889 / 20,
                                1e-4);
    }
}
END_TEST

/* What happens on the faces of the cube is not inside of it. */
static double face(const koksma_integrand *f, const double *x)
{
    (void)f;
    return x[0] >= 1.0 || x[1] <= 0.0;
}

START_TEST(faces_of_the_cube)
{
    koksma_integrand f = {.dim = 2, .value = face};

    ck_assert(cross(&f, NULL, 50, 16, 1).extent.value == 0.0);
}
END_TEST

/* Lines of one seed are the same, those of another are not. */
START_TEST(seeds)
{
    koksma_integrand f = fixture_make(NULL, "ball", 3, NULL);
    koksma_lines_result a = cross(&f, NULL, 50, 32, 5),
                        b = cross(&f, NULL, 50, 32, 5);

    ck_assert(memcmp(&a, &b, sizeof a) == 0);
    b = cross(&f, NULL, 50, 32, 6);
    ck_assert(a.work != b.work);
}
END_TEST

static int stop_fifth(void *state, double lower, double upper, double work)
{
    int *calls = state;

    ck_assert(lower == upper && work > 0.0);
    return ++*calls == 5;
}

static double not_finite(const koksma_integrand *f, const double *x)
{
    (void)f;
    return x[0] < 0.9 ? 0.0 : (double)NAN;
}

START_TEST(stops_and_refusals)
{
    koksma_integrand f = fixture_make(NULL, "ball", 2, NULL);
    koksma_lines_opts o = KOKSMA_LINES_DEFAULTS, bad;
    koksma_lines_result r = {.lines = 77}, same = r;
    int calls = 0;

    o.progress = stop_fifth;
    o.state = &calls;
    ck_assert_int_eq(koksma_lines(&r, NULL, &f, &o, NULL), KOKSMA_STOPPED);
    ck_assert(r.lines == 5 && r.extent.lower < r.extent.upper);
    calls = 4;
    ck_assert_int_eq(koksma_lines(&r, NULL, &f, &o, NULL), KOKSMA_STOPPED);
    ck_assert(r.lines == 1 && isnan(r.extent.lower) && r.extent.level == 0.0);
    o.progress = NULL;
    r = same;
    for (int i = 0; i < 5; i++) {
        bad = o;
        if (i == 0) bad.lines = 1;
        if (i == 1) bad.steps = 0;
        if (i == 2) bad.tolerance = (double)NAN;
        if (i == 3) bad.level = 1.0;
        if (i == 4) f.value = not_finite;
        ck_assert_int_eq(koksma_lines(&r, NULL, &f, &bad, NULL),
                         i == 4 ? KOKSMA_EDOMAIN : KOKSMA_EINVAL);
    }
    ck_assert(r.lines == 77);
}
END_TEST

/* A fractal whose cells at some level are taken as they are: state. */
typedef struct stage {
    koksma_integrand f;
    size_t k;
    bool in[625];
} stage;

static double stage_value(const koksma_integrand *f, const double *x)
{
    const stage *s = f->state;
    size_t i = (size_t)(x[0] * (double)s->k), j = (size_t)(x[1] * (double)s->k);

    i = i < s->k ? i : s->k - 1;
    j = j < s->k ? j : s->k - 1;
    return s->in[i * s->k + j];
}

/* Returns its extent: each face between in and out. */
static double build_stage(stage *s)
{
    size_t faces = 0;

    s->k = 25;
    s->f = fixture_make(NULL, "fractal2", 2, NULL);
    for (size_t i = 0; i < 25; i++)
        for (size_t j = 0; j < 25; j++) {
            double x[] = {((double)i + 0.31) / 25.0, ((double)j + 0.57) / 25.0};

            s->in[i * 25 + j] = s->f.value(&s->f, x) != 0.0;
        }
    for (size_t i = 0; i < 25; i++)
        for (size_t j = 0; j + 1 < 25; j++) {
            faces += s->in[i * 25 + j] != s->in[i * 25 + j + 1];
            faces += s->in[j * 25 + i] != s->in[(j + 1) * 25 + i];
        }
    s->f = (koksma_integrand){.dim = 2, .value = stage_value, .state = s};
    return (double)faces / 25.0;
}

/* How often, out of 1000 times, the intervals hold. */
static void check_coverage(const char *what, const koksma_integrand *f,
                           size_t steps, double extent, double area)
{
    int extents = 0, areas = 0, rounds = 1000;

    for (int i = 0; i < rounds; i++) {
        koksma_lines_result r = cross(f, NULL, 150, steps, (uint64_t)i);

        extents += r.extent.lower <= extent && extent <= r.extent.upper;
        areas += r.area.lower <= area && area <= r.area.upper;
    }
    ck_assert_msg(extents >= 920 && extents <= 970, "%s: l %d", what, extents);
    ck_assert_msg(areas >= 920 && areas <= 970, "%s: S %d", what, areas);
}

START_TEST(coverage)
{
    static stage s;
    const double c = 0.3;
    double extent = build_stage(&s);

    for (size_t dim = 2; dim <= 4; dim++) {
        koksma_facts k;
        koksma_integrand f = fixture_make(&k, "ball", dim, NULL);

        check_coverage("ball", &f, 64, k.extent, k.area);
        f = fixture_make(&k, "halfspace", dim, &c);
        check_coverage("halfspace", &f, 16, k.extent, k.area);
    }
    /* All faces are parallel to the axes: the area is the extent. */
    check_coverage("fractal", &s.f, 250, extent, extent);
}
END_TEST

/* ---- Samples ----------------------------------------------------------------- */

static koksma_samples_result sample(koksma_points p, const double *f, uint64_t k,
                                    double jump)
{
    uint64_t cells[] = {k, k, k, k};
    koksma_samples_result r;
    koksma_error err;

    if (koksma_samples(&r, p, f, cells, jump, &err)) ck_abort_msg("%s", err.text);
    return r;
}

/* E|e_1 + U - U'| by its densities 1 - |t|. */
static double mean_distance(int dim)
{
    enum { M = 400 };
    double sum = 0.0;

    for (int i = 0; i < M; i++)
        for (int j = 0; j < M; j++) {
            double s = (i + 0.5) * 2.0 / M - 1.0, t = (j + 0.5) * 2.0 / M - 1.0;
            double weight = (1.0 - fabs(s)) * (1.0 - fabs(t)) * 4.0 / M / M;

            sum += weight * (dim == 1 ? fabs(1.0 + s) : hypot(1.0 + s, t));
        }
    return sum;
}

START_TEST(biases)
{
    static const double noted[] = {1.089, 1.167, 1.241, 1.309, 1.373};
    double x[] = {0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.9, 0.1, 0.1, 0.1, 0.1, 0.1},
           f[] = {0, 1};
    uint64_t cells[] = {2, 1, 1, 1, 1, 1};

    for (size_t dim = 2; dim <= 6; dim++) {
        koksma_samples_result r;

        x[dim] = 0.9;
        ck_assert_int_eq(
            koksma_samples(&r, (koksma_points){x, 2, dim}, f, cells, 0.5, NULL), 0);
        ck_assert_double_eq_tol(r.bias, noted[dim - 2], 2e-3);
        if (dim == 2) ck_assert_double_eq_tol(r.bias, mean_distance(2), 1e-4);
        ck_assert(r.pairs == 1 && r.changes == 1 && r.empty == 0);
        ck_assert_double_eq_tol(r.extent.value, 2.0 / r.bias, 1e-12);
        x[dim] = 0.1;
    }
    ck_assert_double_eq_tol(
        (koksma_samples((koksma_samples_result[]){{0}}, (koksma_points){x, 2, 1}, f,
                        cells, 0.5, NULL),
         mean_distance(1)),
        1.0, 1e-4);
}
END_TEST

/* One random point in most cells: what is guessed is right within a tenth, and the
 * interval holds. */
START_TEST(extents_by_samples)
{
    enum { K = 40 };
    static double x[2 * K * K], f[K * K];
    const double c = 0.37;
    static const char *const names[] = {"ball", "halfspace", "box"};

    for (size_t g = 0; g < 3; g++) {
        koksma_facts facts;
        koksma_integrand h = fixture_make(&facts, names[g], 2, &c);
        oracle_rng rng = oracle_rng_start(oracle_seed(), g);
        double mean = 0.0;

        for (int round = 0; round < 40; round++) {
            koksma_samples_result r;
            size_t n = 0, empty = 0;

            for (size_t cell = 0; cell < K * K; cell++) {
                if (oracle_below(&rng, 5) == 0) {
                    empty++;
                    continue;
                }
                x[2 * n] = ((double)(cell / K) + oracle_dyadic(&rng, 30)) / K;
                x[2 * n + 1] = ((double)(cell % K) + oracle_dyadic(&rng, 30)) / K;
                f[n] = 3.0 * h.value(&h, x + 2 * n);
                n++;
            }
            r = sample((koksma_points){x, n, 2}, f, K, 1.0);
            ck_assert_uint_eq(r.empty, empty);
            ck_assert(r.extent.lower <= facts.extent &&
                      facts.extent <= r.extent.upper && r.jump_rms == 3.0);
            mean += r.extent.value / 40.0;
        }
        ck_assert_double_eq_tol(mean / facts.extent, 1.0, g == 2 ? 0.3 : 0.1);
    }
}
END_TEST

/* Neighbours by hand: 3 by 3 cells, of which one is empty, and a second sample that
 * is left out.
 *
 *     5 5 .
 *     0 5 5     from (0,0) at the lower left, x to the right
 *     0 0 9 */
START_TEST(neighbours)
{
    const double x[] = {.1, .1, .5, .1, .9, .1, .1, .5, .5,
                        .5, .9, .5, .1, .9, .5, .9, .5, .5};
    const double f[] = {0, 0, 9, 0, 5, 5, 5, 5, 20};
    koksma_samples_result r = sample((koksma_points){x, 9, 2}, f, 3, 2.0);

    /* Along x 5 pairs, of which 2 differ; along y 5, of which 3 do. */
    ck_assert(r.total == 9 && r.empty == 1 && r.pairs == 10 && r.changes == 5);
    ck_assert_double_eq_tol(r.extent.value * r.bias, 3.0 * (2.0 / 5.0 + 3.0 / 5.0),
                            1e-12);
    ck_assert_double_eq_tol(r.jump_rms, sqrt((81.0 + 3 * 25.0 + 16.0) / 5.0),
                            1e-12);
    r = sample((koksma_points){x, 9, 2}, f, 3, 4.0); /* 4 is not above 4 */
    ck_assert(r.changes == 4);
    r = sample((koksma_points){x, 9, 2}, f, 3, 9.0);
    ck_assert(r.changes == 0 && r.extent.value == 0.0 && isnan(r.extent.upper));
}
END_TEST

START_TEST(refusals_of_samples)
{
    const double x[] = {0.1, 0.1, 0.9, 0.9}, f[] = {0, 1}, out[] = {0.1, 1.5};
    const uint64_t cells[] = {2, 2}, none[] = {2, 0};
    koksma_samples_result r = {.total = 7};
    koksma_points p = {x, 2, 2};

    ck_assert_int_eq(koksma_samples(&r, p, f, none, 0, NULL), KOKSMA_EINVAL);
    ck_assert_int_eq(koksma_samples(&r, p, f, cells, -1, NULL), KOKSMA_EINVAL);
    ck_assert_int_eq(koksma_samples(&r, p, f, cells, (double)NAN, NULL),
                     KOKSMA_EINVAL);
    ck_assert_int_eq(koksma_samples(&r, p, f, cells, 0.5, NULL), KOKSMA_EINVAL);
    ck_assert_int_eq(
        koksma_samples(&r, (koksma_points){out, 1, 2}, f, cells, 0.5, NULL),
        KOKSMA_EDOMAIN);
    ck_assert_uint_eq(r.total, 7);
}
END_TEST

/* ---- Occupancy --------------------------------------------------------------- */

/* Multiples of 2^-20, cell by cell in integers. */
START_TEST(points_in_cells)
{
    enum { N = 300, CELLS = 7 * 12 * 5 };
    static const uint64_t cells[] = {7, 12, 5};

    for (uint64_t round = 0; round < 50; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        unsigned count[CELLS] = {0}, least = N, most = 0, empty = 0;
        koksma_occupancy o;
        double x[3 * N];

        for (size_t i = 0; i < N; i++) {
            size_t cell = 0;

            for (size_t k = 0; k < 3; k++) {
                uint64_t at = oracle_below(&rng, (1u << 20) + 1);

                if (round % 3 == 0) at = at >> 18 << 18; /* faces of cells */
                if (oracle_below(&rng, 8) == 0) at = 1u << 20;
                x[3 * i + k] = ldexp((double)at, -20);
                at = at * cells[k] >> 20;
                cell = cell * cells[k] + (at < cells[k] ? at : cells[k] - 1);
            }
            count[cell]++;
        }
        for (size_t i = 0; i < CELLS; i++) {
            least = count[i] < least ? count[i] : least;
            most = count[i] > most ? count[i] : most;
            empty += count[i] == 0;
        }
        ck_assert_int_eq(
            koksma_cells_occupancy(&o, (koksma_points){x, N, 3}, cells, NULL), 0);
        ck_assert(o.total == CELLS && o.least == least && o.most == most &&
                  o.empty == empty);
    }
}
END_TEST

/* Next to a face of a cell, one double below and above. */
START_TEST(beside_faces)
{
    for (uint64_t k = 2; k < 200; k++) {
        double third = 1.0 / (double)k, x[] = {third};
        bool below = fma(third, (double)k, -1.0) < 0.0;
        koksma_occupancy o;

        ck_assert_int_eq(
            koksma_cells_occupancy(&o, (koksma_points){x, 1, 1}, &k, NULL), 0);
        ck_assert(o.empty == k - 1 && o.most == 1);
        /* The second point is in the first cell: both are if the first is below. */
        double y[] = {third, 0.0};
        ck_assert_int_eq(
            koksma_cells_occupancy(&o, (koksma_points){y, 2, 1}, &k, NULL), 0);
        ck_assert_uint_eq(o.most, below ? 2 : 1);
    }
}
END_TEST

/* A block of prod b_j^k_j consecutive elements has one in each elementary interval,
 * and any n fewer have none or one: by digits, from any start. */
START_TEST(halton_by_digits)
{
    const uint32_t bases[] = {7, 5, 3};
    const uint64_t cells[] = {49, 25, 9}, starts[] = {0, 12345, UINT64_MAX - 20000};
    koksma_occupancy o;

    for (size_t i = 0; i < 3; i++) {
        ck_assert_int_eq(koksma_cells_occupancy_halton(&o, starts[i], 11025, 3,
                                                       bases, cells, NULL),
                         0);
        ck_assert(o.total == 11025 && o.least == 1 && o.most == 1 && o.empty == 0);
        ck_assert_int_eq(koksma_cells_occupancy_halton(&o, starts[i], 11000, 3,
                                                       bases, cells, NULL),
                         0);
        ck_assert(o.least == 0 && o.most == 1 && o.empty == 25);
    }
}
END_TEST

/* In cells that are no elementary intervals, 0.1 0.01 0.11 ... are where they are.
 */
START_TEST(halton_in_cubes)
{
    const uint32_t bases[] = {2};
    const uint64_t cells[] = {3};
    koksma_occupancy o;

    /* 0, 1/2, 1/4, 3/4, 1/8: cells 0 1 0 2 0. */
    ck_assert_int_eq(koksma_cells_occupancy_halton(&o, 0, 5, 1, bases, cells, NULL),
                     0);
    ck_assert(o.most == 3 && o.least == 1);
    ck_assert_int_eq(koksma_cells_occupancy_halton(&o, 1, 2, 1, bases, cells, NULL),
                     0);
    ck_assert(o.most == 1 && o.empty == 1);
}
END_TEST

START_TEST(refusals_of_occupancy)
{
    const uint64_t many[] = {1u << 16, 1u << 16}, cells[] = {2, 2};
    const uint32_t bases[] = {2, 1};
    const double x[] = {0.5, -0.5};
    koksma_occupancy o = {.total = 7};
    koksma_points p = {x, 1, 2};

    ck_assert_int_eq(koksma_cells_occupancy(&o, p, cells, NULL), KOKSMA_EDOMAIN);
    p.dim = 1;
    ck_assert_int_eq(koksma_cells_occupancy_halton(&o, 0, 5, 2, bases, cells, NULL),
                     KOKSMA_EINVAL);
    ck_assert_int_eq(koksma_cells_occupancy_halton(&o, 0, 0, 1, bases, cells, NULL),
                     KOKSMA_EINVAL);
    ck_assert_int_eq(
        koksma_cells_occupancy_halton(&o, UINT64_MAX, 2, 1, bases, cells, NULL),
        KOKSMA_EINVAL);
    ck_assert_int_eq(
        koksma_cells_occupancy_halton(&o, 0, 2, 2, (uint32_t[]){2, 3}, many, NULL),
        KOKSMA_EINVAL);
    ck_assert_uint_eq(o.total, 7);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("cells_lines");
    TCase *lines = tcase_create("lines"), *big = tcase_create("coverage");
    TCase *points = tcase_create("points"), *ways = tcase_create("ways");

    tcase_add_test(lines, extents_by_lines);
    tcase_add_test(lines, slopes_are_no_jumps);
    tcase_add_test(lines, jumps_within_a_step);
    tcase_add_test(lines, faces_of_the_cube);
    tcase_add_test(lines, seeds);
    tcase_add_test(lines, stops_and_refusals);
    tcase_set_timeout(lines, 60);
    tcase_set_tags(ways, "slow");
    tcase_add_test(ways, ways_of_lines);
    tcase_set_tags(big, "big");
    tcase_set_timeout(big, 600);
    tcase_add_test(big, coverage);
    tcase_add_test(points, biases);
    tcase_add_test(points, extents_by_samples);
    tcase_add_test(points, neighbours);
    tcase_add_test(points, refusals_of_samples);
    tcase_add_test(points, points_in_cells);
    tcase_add_test(points, beside_faces);
    tcase_add_test(points, halton_by_digits);
    tcase_add_test(points, halton_in_cubes);
    tcase_add_test(points, refusals_of_occupancy);
    suite_add_tcase(suite, lines);
    suite_add_tcase(suite, ways);
    suite_add_tcase(suite, big);
    suite_add_tcase(suite, points);
    return oracle_run(suite);
}
