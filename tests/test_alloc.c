/* Out of memory at every allocation: each measure that allocates is run with the
 * first, the second, ... allocation refused, until it succeeds.  It must say
 * KOKSMA_ENOMEM and leave its outputs alone; what it leaks, a sanitizer or valgrind
 * finds.  And threads that the system does not start. */

#include "alloc_fixture.h"

#include <math.h>
#include <pthread.h>

#include "box.h"
#include "cells.h"
#include "curve.h"
#include "edge.h"
#include "fit.h"
#include "l2.h"
#include "oracle.h"
#include "star.h"
#include "variation.h"

/* ---- Threads that do not start ----------------------------------------------- */

int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*work)(void *), void *state);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*work)(void *), void *state);

static long starts = -1; /* threads until one is refused; negative: all */

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*work)(void *), void *state)
{
    if (starts >= 0 && starts-- == 0) return EAGAIN;
    return __real_pthread_create(thread, attributes, work, state);
}

/* ---- Discrepancies ----------------------------------------------------------- */

enum { POINTS = 24, PAIRS = 300, CROWD = 70 };

/* Anywhere, and every fourth of them on a coarse grid. */
static koksma_points points(size_t dim)
{
    static double x[POINTS * 3];
    oracle_rng rng = oracle_rng_start(7, dim);

    for (size_t i = 0; i < POINTS * dim; i++)
        x[i] = oracle_dyadic(&rng, i / dim % 4 == 0 ? 2 : 40);
    return (koksma_points){x, POINTS, dim};
}

/* Along a line, and each of them twice: many cells of lines have all of them. */
static koksma_points pairs(void)
{
    static double x[PAIRS * 4];
    oracle_rng rng = oracle_rng_start(7, 2);

    for (size_t i = 0; i < PAIRS * 2; i += 2) {
        x[i] = oracle_dyadic(&rng, 40);
        x[i + 1] = 0.25 + 0.5 * x[i] + ldexp(oracle_dyadic(&rng, 40), -8);
    }
    memcpy(x + PAIRS * 2, x, PAIRS * 2 * sizeof *x);
    return (koksma_points){x, PAIRS * 2, 2};
}

/* In a spot so narrow that no cell of lines parts them. */
static koksma_points crowd(void)
{
    static double x[CROWD * 2];
    oracle_rng rng = oracle_rng_start(7, 0);

    for (size_t i = 0; i < CROWD * 2; i++)
        x[i] = 0.25 + ldexp(oracle_dyadic(&rng, 6), -36);
    return (koksma_points){x, CROWD, 2};
}

/* Of any measure: its method, and what else tells jobs apart. */
typedef struct how {
    int method;
    size_t dim, threads;
    bool anytime; /* l2: not looked at */
    int kind;     /* of l2; of edge: a set */
} how;

/* Sets of edge. */
enum { FEW, IN_PAIRS, CROWDED };

/* Room for the largest result, and for what its witness points to. */
typedef struct output {
    union {
        koksma_star_result star;
        koksma_box_result box;
        koksma_l2_result l2;
        koksma_edge_result edge;
    } r;
    double corner[8];
} output;

static output blank(void)
{
    output o;

    memset(&o, 0x5a, sizeof o);
    return o;
}

static koksma_status star_of(output *out, const how *h, koksma_error *err)
{
    koksma_star_opts opts = {.method = (koksma_star_method)h->method,
                             .anytime = h->anytime,
                             .threads = h->threads};

    return koksma_star(&out->r.star, points(h->dim), &opts, err);
}

static koksma_status star_job(const void *what, koksma_error *err)
{
    output o = blank(), before;

    o.r.star.witness.corner = o.corner;
    memcpy(&before, &o, sizeof o);
    return kept(star_of(&o, what, err), &o, &before, sizeof o);
}

static koksma_status box_of(output *out, const how *h, koksma_error *err)
{
    koksma_box_opts opts = {.method = (koksma_box_method)h->method,
                            .anytime = h->anytime,
                            .threads = h->threads};

    return koksma_box_discrepancy(&out->r.box, points(h->dim), &opts, err);
}

static koksma_status box_job(const void *what, koksma_error *err)
{
    output o = blank(), before;

    o.r.box.witness.corners = o.corner;
    memcpy(&before, &o, sizeof o);
    return kept(box_of(&o, what, err), &o, &before, sizeof o);
}

static koksma_status l2_of(output *out, const how *h, koksma_error *err)
{
    koksma_l2_opts opts = {.kind = (koksma_l2_kind)h->kind,
                           .method = (koksma_l2_method)h->method,
                           .threads = h->threads};

    return koksma_l2(&out->r.l2, points(h->dim), &opts, err);
}

static koksma_status l2_job(const void *what, koksma_error *err)
{
    output o = blank(), before;

    memcpy(&before, &o, sizeof o);
    return kept(l2_of(&o, what, err), &o, &before, sizeof o);
}

static koksma_points plane(int set)
{
    switch (set) {
    case IN_PAIRS: return pairs();
    case CROWDED: return crowd();
    default: return points(2);
    }
}

static koksma_status edge_of(output *out, const how *h, koksma_error *err)
{
    koksma_edge_opts opts = {.method = (koksma_edge_method)h->method,
                             .anytime = h->anytime,
                             .threads = h->threads};

    return koksma_edge(&out->r.edge, plane(h->kind), &opts, err);
}

static koksma_status edge_job(const void *what, koksma_error *err)
{
    output o = blank(), before;

    memcpy(&before, &o, sizeof o);
    return kept(edge_of(&o, what, err), &o, &before, sizeof o);
}

/* All methods of a measure, and how few allocations would be a surprise: a row that
 * meets less has not done its work. */
typedef struct measure {
    const char *name;
    alloc_job *job;
    koksma_status (*of)(output *out, const how *h, koksma_error *err);
    how h;
    long least;
} measure;

static const measure measures[] = {
    {"star, sweep", star_job, star_of, {KOKSMA_STAR_SWEEP, 3, 1, false, 0}, 2},
    {"star, sweep of a line",
     star_job,
     star_of,
     {KOKSMA_STAR_SWEEP, 1, 1, false, 0},
     2},
    {"star, tree", star_job, star_of, {KOKSMA_STAR_TREE, 3, 1, false, 0}, 20},
    {"star, tree in stages",
     star_job,
     star_of,
     {KOKSMA_STAR_TREE, 3, 1, true, 0},
     20},
    {"star, lines", star_job, star_of, {KOKSMA_STAR_LINES, 2, 1, false, 0}, 8},
    {"star, lines in space",
     star_job,
     star_of,
     {KOKSMA_STAR_LINES, 3, 1, false, 0},
     8},
    {"star, lines in stages",
     star_job,
     star_of,
     {KOKSMA_STAR_LINES, 3, 1, true, 0},
     8},
    {"star, dem", star_job, star_of, {KOKSMA_STAR_DEM, 3, 1, false, 0}, 2},
    {"star, search", star_job, star_of, {KOKSMA_STAR_SEARCH, 3, 1, false, 0}, 7},
    {"box, sweep", box_job, box_of, {KOKSMA_BOX_SWEEP, 2, 1, false, 0}, 8},
    {"box, sweep of a line",
     box_job,
     box_of,
     {KOKSMA_BOX_SWEEP, 1, 1, false, 0},
     3},
    {"box, tree", box_job, box_of, {KOKSMA_BOX_TREE, 2, 1, false, 0}, 8},
    {"box, tree in stages", box_job, box_of, {KOKSMA_BOX_TREE, 2, 1, true, 0}, 8},
    {"box, search", box_job, box_of, {KOKSMA_BOX_SEARCH, 2, 1, false, 0}, 7},
    {"l2, pairs", l2_job, l2_of, {KOKSMA_L2_PAIRS, 3, 1, false, KOKSMA_L2_STAR}, 3},
    {"l2, star", l2_job, l2_of, {KOKSMA_L2_DIVIDE, 3, 1, false, KOKSMA_L2_STAR}, 8},
    {"l2, extreme",
     l2_job,
     l2_of,
     {KOKSMA_L2_DIVIDE, 2, 1, false, KOKSMA_L2_EXTREME},
     8},
    {"l2, centered",
     l2_job,
     l2_of,
     {KOKSMA_L2_DIVIDE, 3, 1, false, KOKSMA_L2_CENTERED},
     8},
    {"l2, periodic",
     l2_job,
     l2_of,
     {KOKSMA_L2_DIVIDE, 3, 1, false, KOKSMA_L2_PERIODIC},
     8},
    {"l2, wraparound",
     l2_job,
     l2_of,
     {KOKSMA_L2_DIVIDE, 2, 1, false, KOKSMA_L2_WRAPAROUND},
     8},
    {"l2, mixture",
     l2_job,
     l2_of,
     {KOKSMA_L2_DIVIDE, 3, 1, false, KOKSMA_L2_MIXTURE},
     8},
    {"l2, symmetric",
     l2_job,
     l2_of,
     {KOKSMA_L2_DIVIDE, 3, 1, false, KOKSMA_L2_SYMMETRIC},
     8},
    {"l2, of a line",
     l2_job,
     l2_of,
     {KOKSMA_L2_DIVIDE, 1, 1, false, KOKSMA_L2_STAR},
     3},
    {"edge, sweep", edge_job, edge_of, {KOKSMA_EDGE_SWEEP, 2, 1, false, 0}, 7},
    {"edge, tree", edge_job, edge_of, {KOKSMA_EDGE_TREE, 2, 1, false, 0}, 9},
    {"edge, tree in stages",
     edge_job,
     edge_of,
     {KOKSMA_EDGE_TREE, 2, 1, true, 0},
     9},
    /* Lists that grow on the way down. */
    {"edge, tree of pairs",
     edge_job,
     edge_of,
     {KOKSMA_EDGE_TREE, 2, 1, false, IN_PAIRS},
     20},
    {"edge, tree of a crowd",
     edge_job,
     edge_of,
     {KOKSMA_EDGE_TREE, 2, 1, false, CROWDED},
     34},
};
enum { MEASURES = sizeof measures / sizeof *measures };

START_TEST(discrepancies)
{
    const measure *m = &measures[_i % MEASURES];
    how h = m->h;

    h.threads = _i < MEASURES ? 1 : 2;
    long took = exhaust(m->job, &h, m->name);
    ck_assert_msg(took >= m->least, "%s: %ld allocations alone", m->name, took);
}
END_TEST

static int stop_at_once(void *state, double lower, double upper, double work)
{
    (void)state, (void)lower, (void)upper, (void)work;
    return 1;
}

static koksma_status stopped_job(const void *what, koksma_error *err)
{
    const how *h = what;
    koksma_star_opts opts = {.method = KOKSMA_STAR_LINES,
                             .threads = h->threads,
                             .progress = stop_at_once};
    output o = blank(), before;

    o.r.star.witness.corner = o.corner;
    memcpy(&before, &o, sizeof o);
    return kept(koksma_star(&o.r.star, points(h->dim), &opts, err), &o, &before,
                sizeof o);
}

/* A search that is cut short has a witness to settle: its last allocation. */
START_TEST(stopped_searches)
{
    static const long least[] = {16, 18};

    for (size_t dim = 2; dim <= 3; dim++) {
        how h = {.dim = dim, .threads = (size_t)_i};
        long took =
            exhaust_until(KOKSMA_STOPPED, stopped_job, &h, "lines, stopped");

        ck_assert_int_ge(took, least[dim - 2]);
    }
}
END_TEST

/* Fewer threads do the work, to the same bits, be it one alone. */
START_TEST(threads_that_do_not_start)
{
    const measure *m = &measures[_i];
    how one = m->h, four = m->h;
    output want = blank(), got = blank();

    four.threads = 4;
    want.r.star.witness.corner = NULL;
    if (m->job == star_job) want.r.star.witness.corner = want.corner;
    if (m->job == box_job) want.r.box.witness.corners = want.corner;
    ck_assert_int_eq(m->of(&want, &one, NULL), KOKSMA_OK);
    for (long most = 0; most < 4; most++) {
        got = blank();
        if (m->job == star_job) got.r.star.witness.corner = got.corner;
        if (m->job == box_job) got.r.box.witness.corners = got.corner;
        starts = most;
        ck_assert_int_eq(m->of(&got, &four, NULL), KOKSMA_OK);
        starts = -1;
        /* The interval comes first in each of the results. */
        ck_assert_msg(memcmp(&want.r, &got.r, sizeof(koksma_interval)) == 0 &&
                          memcmp(want.corner, got.corner, sizeof want.corner) == 0,
                      "%s with %ld more threads of 3", m->name, most);
    }
}
END_TEST

/* ---- Cells ------------------------------------------------------------------- */

/* Nothing is asserted in jobs: Check allocates. */
static koksma_integrand integrand(const char *name, size_t dim)
{
    koksma_integrand f = {0};

    (void)koksma_integrand_make(&f, NULL, koksma_integrand_find(name), dim, NULL,
                                NULL);
    return f;
}

static koksma_status count_job(const void *what, koksma_error *err)
{
    static const uint64_t cells[] = {8, 8, 8};
    koksma_integrand f = integrand(what, 3);
    koksma_cell_count r, before;

    memset(&r, 0x5a, sizeof r);
    memcpy(&before, &r, sizeof r);
    return kept(koksma_cells_count(&r, &f, cells, NULL, err), &r, &before,
                sizeof r);
}

static koksma_status slope_job(const void *what, koksma_error *err)
{
    koksma_integrand f = integrand(what, 2);
    koksma_cell_slope r, before;

    memset(&r, 0x5a, sizeof r);
    memcpy(&before, &r, sizeof r);
    return kept(koksma_cells_slope(&r, &f, 64, NULL, NULL, NULL, err), &r, &before,
                sizeof r);
}

static koksma_status lines_job(const void *what, koksma_error *err)
{
    koksma_lines_opts o = KOKSMA_LINES_DEFAULTS;
    koksma_integrand f = integrand(what, 2);
    struct {
        koksma_lines_result r;
        koksma_estimate axes[2];
    } out, before;

    o.lines = 2;
    memset(&out, 0x5a, sizeof out);
    memcpy(&before, &out, sizeof out);
    return kept(koksma_lines(&out.r, out.axes, &f, &o, err), &out, &before,
                sizeof out);
}

static koksma_status occupancy_job(const void *what, koksma_error *err)
{
    static const uint64_t cells[] = {2};
    koksma_occupancy r, before;

    memset(&r, 0x5a, sizeof r);
    memcpy(&before, &r, sizeof r);
    if (what == NULL)
        return kept(koksma_cells_occupancy(&r, points(1), cells, err), &r, &before,
                    sizeof r);
    return kept(
        koksma_cells_occupancy_halton(&r, 0, 2, 1, (uint32_t[]){2}, cells, err), &r,
        &before, sizeof r);
}

static koksma_status samples_job(const void *what, koksma_error *err)
{
    static const uint64_t cells[] = {2};
    static const double f[POINTS] = {0.0, 1.0};
    koksma_samples_result r, before;

    (void)what;
    memset(&r, 0x5a, sizeof r);
    memcpy(&before, &r, sizeof r);
    return kept(koksma_samples(&r, points(1), f, cells, 0.5, err), &r, &before,
                sizeof r);
}

START_TEST(cells)
{
    ck_assert_int_ge(exhaust(count_job, "ball", "cells"), 1);
    ck_assert_int_ge(exhaust(slope_job, "ball", "slope"), 3);
    ck_assert_int_ge(exhaust(lines_job, "ball", "lines"), 2);
    ck_assert_int_ge(exhaust(occupancy_job, NULL, "occupancy"), 1);
    ck_assert_int_ge(exhaust(occupancy_job, "halton", "occupancy of halton"), 1);
    ck_assert_int_ge(exhaust(samples_job, NULL, "samples"), 1);
}
END_TEST

/* ---- Variation --------------------------------------------------------------- */

typedef struct varied {
    koksma_variation_result r;
    koksma_estimate faces[4];
} varied;

static koksma_status variation_job(const void *what, koksma_error *err)
{
    koksma_variation_opts o = {.method = *(const koksma_variation_method *)what,
                               .cells = 4,
                               .samples = 1000.0,
                               .seed = 1};
    koksma_integrand f = integrand("f2", 2);
    varied out, before;

    memset(&out, 0x5a, sizeof out);
    memcpy(&before, &out, sizeof out);
    return kept(koksma_variation(&out.r, out.faces, &f, &o, err), &out, &before,
                sizeof out);
}

static const double corners[] = {0, 0, 0, 1, 1, 0, 1, 1}, values[] = {0, 1, 2, 3};

static koksma_status points_job(const void *what, koksma_error *err)
{
    varied out, before;

    (void)what;
    memset(&out, 0x5a, sizeof out);
    memcpy(&before, &out, sizeof out);
    return kept(koksma_variation_points(
                    &out.r, out.faces, (koksma_points){corners, 4, 2}, values, err),
                &out, &before, sizeof out);
}

static koksma_status nodes_job(const void *what, koksma_error *err)
{
    static const size_t nodes[] = {2, 2};
    koksma_variation_grid *g = NULL, *before = NULL;
    koksma_variation_result r;
    koksma_status status =
        kept(koksma_variation_open(&g, nodes, 2, err), &g, &before, sizeof(void *));

    (void)what;
    if (status == KOKSMA_OK) status = koksma_variation_add(g, values, 4, err);
    if (status == KOKSMA_OK) status = koksma_variation_finish(&r, NULL, g, err);
    koksma_variation_close(g);
    return status;
}

START_TEST(variation)
{
    static const koksma_variation_method methods[] = {
        KOKSMA_VARIATION_GRID, KOKSMA_VARIATION_BOUNDARY, KOKSMA_VARIATION_RANDOM};

    ck_assert_int_ge(exhaust(variation_job, &methods[0], "grid"), 4);
    ck_assert_int_ge(exhaust(variation_job, &methods[1], "boundary"), 2);
    ck_assert_int_ge(exhaust(variation_job, &methods[2], "random"), 1);
    ck_assert_int_ge(exhaust(points_job, NULL, "points of a grid"), 6);
    ck_assert_int_ge(exhaust(nodes_job, NULL, "nodes"), 3);
}
END_TEST

/* ---- Curves and fits --------------------------------------------------------- */

static koksma_status curve_job(const void *what, koksma_error *err)
{
    static const uint64_t n[] = {1, 3, 9};
    koksma_curve *c = NULL, *before = NULL;
    koksma_status status = kept(what == NULL ? koksma_curve_open(&c, 2, err)
                                             : koksma_curve_open_at(&c, n, 3, err),
                                &c, &before, sizeof(void *));

    koksma_curve_close(c);
    return status;
}

static koksma_status fit_job(const void *what, koksma_error *err)
{
    enum { ROWS = 64, SETS = 4 };
    double x[ROWS], y[ROWS];
    size_t set[ROWS];
    koksma_fit_opts o = {.model = *(const koksma_fit_model *)what};
    koksma_fit_result r, before;

    for (size_t i = 0; i < ROWS; i++) {
        x[i] = (double)(2u << i / SETS);
        y[i] = (1.0 + 0.1 * (double)(i % 3)) / x[i] + 1e-3;
        set[i] = i % SETS;
    }
    memset(&r, 0x5a, sizeof r);
    memcpy(&before, &r, sizeof r);
    return kept(koksma_fit(&r, (koksma_fit_data){x, y, set, ROWS, SETS}, &o, err),
                &r, &before, sizeof r);
}

START_TEST(curves_and_fits)
{
    static const koksma_fit_model models[] = {
        KOKSMA_FIT_POWER, KOKSMA_FIT_TWO_TERMS, KOKSMA_FIT_TWO_POWERS};

    ck_assert_int_ge(exhaust(curve_job, NULL, "curve"), 1);
    ck_assert_int_ge(exhaust(curve_job, "at", "curve at"), 1);
    for (size_t i = 0; i < 3; i++)
        ck_assert_int_ge(exhaust(fit_job, &models[i], "fit"), 6);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("alloc");
    TCase *tc = tcase_create("memory"), *threads = tcase_create("threads");

    tcase_add_loop_test(tc, discrepancies, 0, MEASURES);
    tcase_add_loop_test(tc, stopped_searches, 1, 2);
    tcase_add_test(tc, cells);
    tcase_add_test(tc, variation);
    tcase_add_test(tc, curves_and_fits);
    suite_add_tcase(suite, tc);
    tcase_set_tags(threads, "threads");
    tcase_add_loop_test(threads, discrepancies, MEASURES, 2 * MEASURES);
    tcase_add_loop_test(threads, stopped_searches, 2, 3);
    tcase_add_loop_test(threads, threads_that_do_not_start, 0, MEASURES);
    suite_add_tcase(suite, threads);
    return oracle_run(suite);
}
