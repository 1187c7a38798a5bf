#include <math.h>
#include <stdlib.h>

#include "cells_report.h"

/* Where the halves of the line differ by more, it is no line. */
static const double BEND_MOST = 0.1;
enum { SCALES_FEW = 4 };

/* What a row says of the discontinuity; NaN where it is not known. */
typedef struct row {
    double lower, upper; /* K */
    double value;        /* K, or the best guess of it */
    double touched;
    koksma_estimate extent, area;
    double jump, jump_rms, axes;
    koksma_cell_slope slope;
} row;

static void column(double v)
{
    putchar('\t');
    cli_number(v);
}

static void columns(koksma_estimate e)
{
    column(e.value);
    column(e.lower);
    column(e.upper);
}

static koksma_estimate known(double v) { return (koksma_estimate){v, v, v, 1.0}; }

const uint32_t *cells_bases(cells_options *o, size_t dim)
{
    if (o->powers == 0) return NULL;
    if (dim > KOKSMA_GRID_BASES_MOST)
        cli_usage("elementary intervals have at most %d coordinates, not %zu",
                  KOKSMA_GRID_BASES_MOST, dim);
    if (!o->primes && o->powers != dim)
        cli_usage("%zu bases for %zu coordinates", o->powers, dim);
    return o->bases;
}

/* ---- Rows -------------------------------------------------------------------- */

uint64_t cells_print_grid(uint64_t n, const uint64_t *cells, size_t dim)
{
    uint64_t total = 1;
    bool cubes = true;

    for (size_t k = 0; k < dim; k++) {
        total *= cells[k];
        cubes = cubes && cells[k] == cells[0];
    }
    printf("%ju", (uintmax_t)n);
    column(cubes ? (double)cells[0] : pow((double)total, 1.0 / (double)dim));
    printf("\t%ju", (uintmax_t)total);
    return total;
}

static const char *fit_of(koksma_cell_slope s)
{
    if (isnan(s.bend)) return "-";
    if (s.scales < SCALES_FEW) return "few";
    return fabs(s.bend) <= BEND_MOST ? "line" : "bent";
}

static void print_header(const cells_options *o)
{
    if (cli_quiet()) return;
    printf("# n\tk\tcells\tK\tK_lower\tK_upper\ttouched\tV\tM\textent\t"
           "extent_lower\textent_upper\tdigital\tarea\tarea_lower\tarea_upper\t"
           "jump\tjump_rms\taxes\tbeta\tbend\tfit%s\n",
           o->powers > 0 ? "\tgrid" : "");
}

static void print_row(const cells_options *o, uint64_t n, const uint64_t *cells,
                      size_t dim, const row *r)
{
    uint64_t total = cells_print_grid(n, cells, dim);
    double share = r->value / (double)total;

    column(r->value);
    column(r->lower);
    column(r->upper);
    column(r->touched);
    column(share);
    column((double)n * share);
    columns(r->extent);
    column(share * pow((double)total, 1.0 / (double)dim));
    columns(r->area);
    column(r->jump);
    column(r->jump_rms);
    column(r->axes);
    column(r->slope.value);
    column(r->slope.bend);
    printf("\t%s", fit_of(r->slope));
    for (size_t k = 0; k < dim && o->powers > 0; k++)
        printf("%c%ju", k > 0 ? 'x' : '\t', (uintmax_t)cells[k]);
    putchar('\n');
    cli_flush();
}

/* ---- Exact ------------------------------------------------------------------- */

static void note_aligned(uint64_t n, const koksma_cell_count *c)
{
    static bool told;

    if (told || c->touched <= c->lower / 10) return;
    told = true;
    cli_note("N = %ju: the discontinuity is aligned with the grid: it meets %ju "
             "cells, and only touches the faces of %ju more",
             (uintmax_t)n, (uintmax_t)c->lower, (uintmax_t)c->touched);
}

/* Returns whether the count was finished; the row is printed all the same. */
static bool exact_row(cells_options *o, const koksma_integrand *f,
                      const koksma_facts *k, uint64_t n, const uint64_t *cells)
{
    koksma_cells_opts opts = {o->ratio, cli_watch_progress, &o->watch};
    const uint32_t *bases = cells_bases(o, f->dim);
    koksma_cell_slope slope = {(double)NAN, (double)NAN, 0};
    koksma_cell_count c;
    koksma_error err;
    koksma_status counted, status;

    cli_watch_start(&o->watch);
    status = counted = koksma_cells_count(&c, f, cells, &opts, &err);
    if (counted == KOKSMA_OK)
        status = koksma_cells_slope(&slope, f, n, bases, &c, &opts, &err);
    cli_watch_stop(&o->watch);
    if (status != KOKSMA_OK && status != KOKSMA_STOPPED) cli_fail_as(&err);

    row r = {.lower = (double)c.lower,
             .upper = (double)c.upper,
             .value = counted == KOKSMA_OK ? (double)c.lower : (double)NAN,
             .touched = counted == KOKSMA_OK ? (double)c.touched : (double)NAN,
             .extent = known(k->extent),
             .area = known(k->area),
             .jump = k->jump,
             .jump_rms = k->jump_rms,
             .axes = k->axes,
             .slope = slope};

    print_row(o, n, cells, f->dim, &r);
    if (counted == KOKSMA_OK) note_aligned(n, &c);
    if (o->verbose)
        cli_note("N = %ju: %.3g boxes, %.2f s", (uintmax_t)n, c.work,
                 cli_seconds(&o->watch));
    if (status == KOKSMA_STOPPED) cli_note("%s", err.text);
    return status == KOKSMA_OK;
}

/* ---- Lines ------------------------------------------------------------------- */

static void print_axes(const koksma_estimate *axes, size_t dim)
{
    if (!cli_quiet()) puts("# axis\tarea\tlower\tupper");
    for (size_t k = 0; k < dim; k++) {
        printf("%zu", k + 1);
        columns(axes[k]);
        putchar('\n');
    }
}

/* A projected area A_j holds A_j total/cells_j faces of cells: for cubes this adds
 * up to l k^(dim-1).  There are no more than all. */
static void lines_row(const cells_options *o, const koksma_lines_result *l,
                      const koksma_estimate *axes, uint64_t n,
                      const uint64_t *cells, size_t dim)
{
    double k[3] = {0.0, 0.0, 0.0}, total = 1.0, shrink;

    for (size_t j = 0; j < dim; j++)
        total *= (double)cells[j];
    for (size_t j = 0; j < dim; j++)
        k[0] += axes[j].value * total / (double)cells[j];
    shrink = l->extent.value > 0.0 ? k[0] / l->extent.value
                                   : pow(total, 1.0 - 1.0 / (double)dim);
    k[1] = l->extent.lower * shrink;
    k[2] = l->extent.upper * shrink;
    for (int i = 0; i < 3; i++)
        k[i] = fmin(k[i], total);

    row r = {.value = k[0],
             .lower = k[1],
             .upper = k[2],
             .touched = (double)NAN,
             .extent = l->extent,
             .area = l->area,
             .jump = l->jump,
             .jump_rms = l->jump_rms,
             .axes = (double)l->axes,
             .slope = l->slope};

    print_row(o, n, cells, dim, &r);
}

static bool run_lines(cells_options *o, const koksma_integrand *f,
                      koksma_lines_result *l, koksma_estimate *axes)
{
    koksma_error err;
    koksma_status status;

    o->lines.progress = cli_watch_progress;
    o->lines.state = &o->watch;
    cli_watch_start(&o->watch);
    status = koksma_lines(l, axes, f, &o->lines, &err);
    cli_watch_stop(&o->watch);
    if (status != KOKSMA_OK && status != KOKSMA_STOPPED) cli_fail_as(&err);
    if (o->verbose)
        cli_note("%zu lines of each kind, %.3g values, no jump below %.3g counts, "
                 "%.2f s",
                 l->lines, l->work, l->least_jump, cli_seconds(&o->watch));
    if (status == KOKSMA_STOPPED) cli_note("%s", err.text);
    return status == KOKSMA_OK;
}

/* ---- All rows ---------------------------------------------------------------- */

bool cells_table(cells_options *o, const koksma_integrand *f,
                 const koksma_facts *facts, const char *about)
{
    static const uint64_t usual = 1 << 10;
    const uint64_t *n = o->count > 0 ? o->n : &usual;
    size_t count = o->count > 0 ? o->count : 1;
    bool can = f->meets != NULL || f->range != NULL, finished = true;
    bool lines = o->axes || o->method == CELLS_LINES || !can;
    const uint32_t *bases = cells_bases(o, f->dim);
    uint64_t *cells = malloc(f->dim * sizeof *cells);
    koksma_estimate *axes = malloc(f->dim * sizeof *axes);
    koksma_lines_result l;
    koksma_error err;

    if (o->method == CELLS_EXACT && lines)
        cli_usage(o->axes ? "--axes goes with -m lines"
                          : "that integrand does not say which boxes its "
                            "discontinuity meets: see -m lines");
    if (cells == NULL || axes == NULL) cli_fail("not enough memory");
    if (koksma_grid_choose(cells, n[0], f->dim, bases, &err))
        cli_usage("%s", err.text);
    if (lines) finished = run_lines(o, f, &l, axes);
    if (!cli_quiet()) printf("# koksma: %s\n", about);
    if (o->axes)
        print_axes(axes, f->dim);
    else
        print_header(o);
    for (size_t i = 0; i < count && !o->axes && (finished || lines); i++) {
        if (koksma_grid_choose(cells, n[i], f->dim, bases, &err)) cli_fail_as(&err);
        if (lines)
            lines_row(o, &l, axes, n[i], cells, f->dim);
        else
            finished = exact_row(o, f, facts, n[i], cells);
    }
    free(cells);
    free(axes);
    return finished;
}
