/* Out of memory at every allocation: each public function that allocates is run
 * with the first, the second, ... allocation refused, until it succeeds.  It must
 * say KOKSMA_ENOMEM; what it leaks, a sanitizer or valgrind finds.  Linked with
 * --wrap for the three functions below. */

#include <check.h>
#include <stdlib.h>
#include <string.h>

#include "box.h"
#include "cells.h"
#include "curve.h"
#include "edge.h"
#include "fit.h"
#include "gen.h"
#include "io.h"
#include "l2.h"
#include "oracle.h"
#include "star.h"
#include "variation.h"

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);

static long granted = -1; /* allocations until one is refused; negative: all */

static int refused(void) { return granted >= 0 && granted-- == 0; }

void *__wrap_malloc(size_t size) { return refused() ? NULL : __real_malloc(size); }

void *__wrap_calloc(size_t count, size_t size)
{
    return refused() ? NULL : __real_calloc(count, size);
}

void *__wrap_realloc(void *old, size_t size)
{
    return refused() ? NULL : __real_realloc(old, size);
}

/* Run job with ever more allocations granted; returns how many it took. */
static long exhaust(koksma_status (*job)(koksma_error *err))
{
    for (long most = 0; most < 1000; most++) {
        koksma_error err = {0};
        koksma_status status;

        granted = most;
        status = job(&err);
        granted = -1;
        if (status == KOKSMA_OK) return most;
        ck_assert_int_eq(status, KOKSMA_ENOMEM);
        ck_assert_int_eq(err.status, KOKSMA_ENOMEM);
        ck_assert_msg(strncmp(err.text, "not enough memory for ", 22) == 0, "%s",
                      err.text);
    }
    ck_abort_msg("1000 allocations and no end");
    return 0;
}

static koksma_status star_by(koksma_star_method method, koksma_error *err)
{
    static const double x[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
    koksma_star_opts opts = {.method = method, .threads = 1};
    koksma_star_result r = {0};

    return koksma_star(&r, (koksma_points){x, 2, 3}, &opts, err);
}

static koksma_status sweep_job(koksma_error *err)
{
    return star_by(KOKSMA_STAR_SWEEP, err);
}

static koksma_status tree_job(koksma_error *err)
{
    return star_by(KOKSMA_STAR_TREE, err);
}

static koksma_status dem_job(koksma_error *err)
{
    return star_by(KOKSMA_STAR_DEM, err);
}

static koksma_status search_job(koksma_error *err)
{
    return star_by(KOKSMA_STAR_SEARCH, err);
}

static koksma_status lines_job(koksma_error *err)
{
    static const double x[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
    koksma_star_opts opts = {.method = KOKSMA_STAR_LINES, .threads = 1};
    koksma_star_result r = {0};

    return koksma_star(&r, (koksma_points){x, 3, 2}, &opts, err);
}

static koksma_status box_by(koksma_box_method method, koksma_error *err)
{
    static const double x[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
    koksma_box_opts opts = {.method = method, .threads = 1};
    koksma_box_result r = {0};

    return koksma_box_discrepancy(&r, (koksma_points){x, 3, 2}, &opts, err);
}

static koksma_status box_sweep_job(koksma_error *err)
{
    return box_by(KOKSMA_BOX_SWEEP, err);
}

static koksma_status box_tree_job(koksma_error *err)
{
    return box_by(KOKSMA_BOX_TREE, err);
}

static koksma_status l2_by(koksma_l2_method method, koksma_error *err)
{
    static const double x[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
    koksma_l2_opts opts = {.method = method, .threads = 1};
    koksma_l2_result r;

    return koksma_l2(&r, (koksma_points){x, 2, 3}, &opts, err);
}

static koksma_status pairs_job(koksma_error *err)
{
    return l2_by(KOKSMA_L2_PAIRS, err);
}

static koksma_status divide_job(koksma_error *err)
{
    return l2_by(KOKSMA_L2_DIVIDE, err);
}

static koksma_status edge_by(koksma_edge_method method, koksma_error *err)
{
    static const double x[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.1, 0.2};
    koksma_edge_opts opts = {.method = method, .threads = 1};
    koksma_edge_result r;

    return koksma_edge(&r, (koksma_points){x, 4, 2}, &opts, err);
}

static koksma_status edge_sweep_job(koksma_error *err)
{
    return edge_by(KOKSMA_EDGE_SWEEP, err);
}

static koksma_status edge_tree_job(koksma_error *err)
{
    return edge_by(KOKSMA_EDGE_TREE, err);
}

static koksma_status open_by(const char *name, koksma_scramble scramble,
                             koksma_error *err)
{
    static const double alpha[] = {0.1, 0.2, 0.3};
    koksma_gen_opts o = {.dim = 3, .n = 8, .scramble = scramble};
    koksma_gen *g;
    koksma_status status;

    if (strcmp(name, "kronecker") == 0) {
        o.alpha = alpha;
        o.alpha_size = 3;
    }
    status = koksma_gen_open(&g, koksma_gen_find(name), &o, err);
    if (status == KOKSMA_OK) koksma_gen_close(g);
    return status;
}

static koksma_status gen_job(koksma_error *err)
{
    return open_by("halton", KOKSMA_SCRAMBLE_DIGITS, err);
}

static koksma_status sobol_job(koksma_error *err)
{
    return open_by("sobol", KOKSMA_SCRAMBLE_OWEN, err);
}

static koksma_status faure_job(koksma_error *err)
{
    return open_by("faure", KOKSMA_SCRAMBLE_DIGITS, err);
}

static koksma_status kronecker_job(koksma_error *err)
{
    return open_by("kronecker", KOKSMA_SCRAMBLE_NONE, err);
}

static koksma_status latin_job(koksma_error *err)
{
    return open_by("latin", KOKSMA_SCRAMBLE_NONE, err);
}

static koksma_status multijittered_job(koksma_error *err)
{
    return open_by("multijittered", KOKSMA_SCRAMBLE_NONE, err);
}

static koksma_status poisson_job(koksma_error *err)
{
    return open_by("poisson", KOKSMA_SCRAMBLE_NONE, err);
}

static koksma_status read_job(const char *text, size_t size, koksma_error *err)
{
    char copy[512];
    koksma_set set = {0};
    koksma_reader *r = NULL;
    koksma_status status;
    long saved = granted;
    FILE *in;

    memcpy(copy, text, size);
    granted = -1;
    in = fmemopen(copy, size, "r");
    granted = saved;
    status = koksma_reader_open(&r, in, KOKSMA_VALUES, err);
    while (status == KOKSMA_OK) {
        status = koksma_set_read(&set, r, err);
        if (set.n == 0) break;
    }
    koksma_reader_close(r);
    koksma_set_free(&set);
    fclose(in);
    return status;
}

static koksma_status text_job(koksma_error *err)
{
    static const char text[] =
        "# a comment\n# koksma: a=1\n0.5 1\n0.25 2\n\n0.5 0.5 7\n";

    return read_job(text, sizeof text - 1, err);
}

static koksma_status npy_job(koksma_error *err)
{
    static const double rows[] = {0.5, 0.25, 3.0, 4.0}; /* column by column */
    char text[160];

    memset(text, ' ', 128);
    memcpy(text, "\x93NUMPY\x01\x00\x76\x00", 10);
    memcpy(text + 10, "{'descr': '<f8', 'fortran_order': True, 'shape': (2, 2), }",
           58);
    text[127] = '\n';
    memcpy(text + 128, rows, sizeof rows);
    return read_job(text, sizeof text, err);
}

static koksma_status table_job(koksma_error *err)
{
    char text[] = "# set N error\n1 8 0.5\n2 8 0.25\n";
    koksma_table table = {0};
    koksma_status status;
    long saved = granted;
    FILE *in;

    granted = -1;
    in = fmemopen(text, sizeof text - 1, "r");
    granted = saved;
    status = koksma_table_read(&table, in, "N", "error", err);
    koksma_table_free(&table);
    fclose(in);
    return status;
}

static koksma_status curve_job(koksma_error *err)
{
    koksma_curve *c;
    koksma_status status = koksma_curve_open(&c, 2, err);

    if (status == KOKSMA_OK) koksma_curve_close(c);
    return status;
}

static koksma_status fit_job(koksma_error *err)
{
    static const double x[] = {8, 16, 32}, y[] = {4, 2, 1};
    static const size_t set[] = {0, 0, 0};
    koksma_fit_result f;

    return koksma_fit(&f, (koksma_fit_data){x, y, set, 3, 1}, NULL, err);
}

static koksma_status grid_job(koksma_error *err)
{
    static const double x[] = {0, 0, 0, 1, 1, 0, 1, 1}, f[] = {0, 1, 2, 3};
    koksma_variation_result r;

    return koksma_variation_points(&r, NULL, (koksma_points){x, 4, 2}, f, err);
}

static koksma_status variation_by(koksma_variation_method method, koksma_error *err)
{
    koksma_variation_opts o = {
        .method = method, .cells = 4, .samples = 1000.0, .seed = 1};
    koksma_variation_result r;
    koksma_estimate faces[4];
    koksma_integrand f;
    koksma_status status =
        koksma_integrand_make(&f, NULL, koksma_integrand_find("f2"), 2, NULL, err);

    return status != KOKSMA_OK ? status : koksma_variation(&r, faces, &f, &o, err);
}

static koksma_status dense_job(koksma_error *err)
{
    return variation_by(KOKSMA_VARIATION_GRID, err);
}

static koksma_status boundary_job(koksma_error *err)
{
    return variation_by(KOKSMA_VARIATION_BOUNDARY, err);
}

static koksma_status random_job(koksma_error *err)
{
    return variation_by(KOKSMA_VARIATION_RANDOM, err);
}

/* Nothing is asserted here: Check allocates. */
static koksma_integrand ball(void)
{
    koksma_integrand f;

    (void)koksma_integrand_make(&f, NULL, koksma_integrand_find("ball"), 2, NULL,
                                NULL);
    return f;
}

static koksma_status cells_job(koksma_error *err)
{
    koksma_integrand f = ball();
    koksma_cell_slope s;

    return koksma_cells_slope(&s, &f, 64, NULL, NULL, NULL, err);
}

static koksma_status cross_job(koksma_error *err)
{
    koksma_lines_opts o = KOKSMA_LINES_DEFAULTS;
    koksma_integrand f = ball();
    koksma_lines_result r;

    o.lines = 2;
    return koksma_lines(&r, NULL, &f, &o, err);
}

static koksma_status occupancy_job(koksma_error *err)
{
    const double x[] = {0.1, 0.9}, v[] = {0.0, 1.0};
    const uint64_t cells[] = {2};
    koksma_points p = {x, 2, 1};
    koksma_samples_result r;
    koksma_occupancy o;
    koksma_status status = koksma_cells_occupancy(&o, p, cells, err);

    if (status == KOKSMA_OK)
        status =
            koksma_cells_occupancy_halton(&o, 0, 2, 1, (uint32_t[]){2}, cells, err);
    return status != KOKSMA_OK ? status : koksma_samples(&r, p, v, cells, 0.5, err);
}

START_TEST(every_allocation_may_fail)
{
    ck_assert_int_ge(exhaust(cells_job), 3);
    ck_assert_int_ge(exhaust(cross_job), 2);
    ck_assert_int_ge(exhaust(occupancy_job), 3);
    ck_assert_int_ge(exhaust(sweep_job), 2);
    ck_assert_int_ge(exhaust(tree_job), 20);
    ck_assert_int_ge(exhaust(lines_job), 8);
    ck_assert_int_ge(exhaust(box_sweep_job), 8);
    ck_assert_int_ge(exhaust(box_tree_job), 8);
    ck_assert_int_ge(exhaust(dem_job), 2);
    ck_assert_int_ge(exhaust(search_job), 7);
    ck_assert_int_ge(exhaust(pairs_job), 3);
    ck_assert_int_ge(exhaust(divide_job), 8);
    ck_assert_int_ge(exhaust(edge_sweep_job), 7);
    ck_assert_int_ge(exhaust(edge_tree_job), 9);
    ck_assert_int_ge(exhaust(gen_job), 5);
    ck_assert_int_ge(exhaust(sobol_job), 3);
    ck_assert_int_ge(exhaust(faure_job), 4);
    ck_assert_int_ge(exhaust(kronecker_job), 2);
    ck_assert_int_ge(exhaust(latin_job), 3);
    ck_assert_int_ge(exhaust(multijittered_job), 4);
    ck_assert_int_ge(exhaust(poisson_job), 5);
    ck_assert_int_ge(exhaust(text_job), 4);
    ck_assert_int_ge(exhaust(npy_job), 5);
    ck_assert_int_ge(exhaust(table_job), 4);
    ck_assert_int_ge(exhaust(curve_job), 1);
    ck_assert_int_ge(exhaust(fit_job), 6);
    ck_assert_int_ge(exhaust(grid_job), 6);
    ck_assert_int_ge(exhaust(dense_job), 4);
    ck_assert_int_ge(exhaust(boundary_job), 2);
    ck_assert_int_ge(exhaust(random_job), 1);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("alloc");
    TCase *tc = tcase_create("alloc");

    tcase_add_test(tc, every_allocation_may_fail);
    suite_add_tcase(suite, tc);
    return oracle_run(suite);
}
