/* koksma-variation: the variation of Hardy and Krause, as far as grids show it. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "cli_integrand.h"
#include "variation.h"
#include "variation_report.h"
#include "variation_run.h"

enum { RUN = CLI_LONG, CELLS, SAMPLES, BOUNCES, FACES, LEVELS, EXPLAIN };

static const cli_option options[] = {
    {'a', "parameter", "NAME=V", "a parameter of the integrand; V: the first"},
    {'d', "dim", "DIM", "the dimension of the integrand or of the program"},
    {BOUNCES, "bounces", "N", "steps of a walk in the scene, two coordinates each"},
    {RUN, "run", "COMMAND", "a program: points on its input, values on its output"},
    {CELLS, "cells", "K", "cells an axis of the finest grid, a power of 2"},
    {'m', "method", "METHOD", "auto, grid, boundary or random (default auto)"},
    {SAMPLES, "samples", "N", "values for a grid of random cells (default 2^22)"},
    {'s', "seed", "SEED", "of the random cells (default 1)"},
    {'t', "time", "SECONDS", "stop then, with the grids that are done"},
    {FACES, "faces", NULL, "a row for every face"},
    {LEVELS, "levels", NULL, "a row for every grid"},
    {EXPLAIN, "explain", NULL, "write a paragraph for a person instead"},
    {'p', "progress", NULL, "a live line on standard error"},
    {'v', "verbose", NULL, "say on standard error what was done"},
    {0},
};

static const cli_tool tool = {"koksma-variation", "[INTEGRAND | FILE]...",
                              "Find the variation of Hardy and Krause on grids.",
                              options};

static const char *const methods[] = {"auto", "grid", "boundary", "random"};

typedef struct variation_options {
    cli_integrand integrand;
    koksma_variation_opts opts;
    const char *command;
    variation_form form;
    cli_watch watch;
    bool verbose;
} variation_options;

static koksma_variation_method read_method(const char *text)
{
    for (int m = KOKSMA_VARIATION_AUTO; m <= KOKSMA_VARIATION_RANDOM; m++)
        if (strcmp(text, methods[m]) == 0) return (koksma_variation_method)m;
    cli_usage("-m takes auto, grid, boundary or random, not \"%s\"", text);
}

static koksma_estimate *faces_for(size_t dim)
{
    koksma_estimate *faces = malloc(((size_t)1 << dim) * sizeof *faces);

    if (faces == NULL) cli_fail("not enough memory for %zu axes", dim);
    return faces;
}

static void report(const variation_options *o, variation_report *r)
{
    variation_print(r, o->form);
    if (o->verbose)
        cli_note("%zu axes, %zu grids, %.0f values", r->dim, r->result.levels,
                 r->result.work);
    free(r->faces);
}

/* What a search that can be stopped has left; there may be no grid yet, and no faces
 * before the last one. */
static bool report_finished(const variation_options *o, variation_report *r,
                            bool finished)
{
    if (!finished && r->result.levels == 0)
        cli_note("stopped; no grid is done");
    else if (!finished)
        cli_note("stopped; the finest grid that is done has %zu cells an axis",
                 r->result.level[r->result.levels - 1].cells);
    if (finished || (r->result.levels > 0 && o->form != VARIATION_FACES))
        report(o, r);
    else
        free(r->faces);
    return finished;
}

/* ---- Integrands and programs ------------------------------------------------- */

static bool measure_integrand(variation_options *o)
{
    const cli_integrand *i = &o->integrand;
    char about[CLI_ABOUT_SIZE];
    variation_report r = {.about = about};
    koksma_integrand f;
    koksma_facts facts;
    koksma_error err;
    koksma_status status;

    if (koksma_integrand_make(&f, &facts, i->row, i->dim, i->param, &err))
        cli_usage("%s", err.text);
    cli_integrand_about(about, i->row, &f, NULL);
    r.dim = f.dim;
    r.known = facts.variation;
    if (f.dim <= KOKSMA_VARIATION_DIM_MOST) r.faces = faces_for(f.dim);
    cli_watch_start(&o->watch);
    status = koksma_variation(&r.result, r.faces, &f, &o->opts, &err);
    cli_watch_stop(&o->watch);
    if (status != KOKSMA_OK && status != KOKSMA_STOPPED) cli_fail_as(&err);
    return report_finished(o, &r, status == KOKSMA_OK);
}

static bool measure_program(variation_options *o)
{
    variation_report r = {.dim = o->integrand.dim, .known = (double)NAN};
    bool finished;

    r.faces = faces_for(r.dim);
    cli_watch_start(&o->watch);
    finished = variation_run(&r.result, r.faces, o->command, r.dim, o->opts.cells,
                             &o->watch);
    cli_watch_stop(&o->watch);
    return report_finished(o, &r, finished);
}

/* ---- Values in files --------------------------------------------------------- */

/* An array of values, rows of its fastest axis as they come. */
static void measure_array(variation_report *r, cli_input *input, size_t columns,
                          const koksma_axes *axes)
{
    size_t room = columns < 4096 ? 4096 / columns : 1, got = 1;
    double *rows = malloc(room * columns * sizeof *rows);
    koksma_variation_grid *g;
    koksma_error err;

    if (rows == NULL) cli_fail("not enough memory for %zu columns", columns);
    r->dim = axes->count;
    r->reversed = axes->reversed;
    if (koksma_variation_open(&g, axes->length, axes->count, &err))
        cli_fail_input(input, &err);
    while (got > 0) {
        if (koksma_reader_rows(input->reader, rows, room, &got, &err) ||
            koksma_variation_add(g, rows, got * columns, &err))
            cli_fail_input(input, &err);
    }
    r->faces = faces_for(r->dim);
    if (koksma_variation_finish(&r->result, r->faces, g, &err))
        cli_fail_input(input, &err);
    koksma_variation_close(g);
    free(rows);
}

static void measure_points(variation_report *r, cli_input *input, koksma_set *set)
{
    koksma_error err;

    if (koksma_set_read(set, input->reader, &err)) cli_fail_input(input, &err);
    r->dim = set->dim;
    if (set->dim <= KOKSMA_VARIATION_DIM_MOST) r->faces = faces_for(set->dim);
    if (koksma_variation_points(&r->result, r->faces, koksma_set_view(set), set->f,
                                &err))
        cli_fail_input(input, &err);
}

static void measure_files(const variation_options *o, cli_input *input)
{
    koksma_set set = {0};
    size_t columns;
    bool header = false;

    while (cli_next_set(input, &columns)) {
        koksma_axes axes = koksma_reader_axes(input->reader);
        variation_report r = {.sampled = true, .known = (double)NAN};

        if (axes.count > 0)
            measure_array(&r, input, columns, &axes);
        else
            measure_points(&r, input, &set);
        cli_settle_several(input);
        if (input->several) r.label = input->label;
        if (input->several && !header) variation_print_header(o->form, true);
        header = true;
        report(o, &r);
    }
    koksma_set_free(&set);
}

/* ---- The tool ---------------------------------------------------------------- */

static void read_options(variation_options *o, int argc, char *argv[])
{
    int c;

    while ((c = cli_next(&tool, argc, argv)) != -1)
        switch (c) {
        case 'a': cli_integrand_set(&o->integrand, "-a", NULL); break;
        case 'd': o->integrand.dim = cli_count("-d", optarg, 1, 10000); break;
        case BOUNCES:
            o->integrand.bounces = cli_count("--bounces", optarg, 1, 1000);
            break;
        case RUN: o->command = optarg; break;
        case CELLS:
            o->opts.cells = cli_count("--cells", optarg, 2, 1 << 24);
            if ((o->opts.cells & (o->opts.cells - 1)) != 0)
                cli_usage("--cells takes a power of 2, not %zu", o->opts.cells);
            break;
        case 'm': o->opts.method = read_method(optarg); break;
        case SAMPLES:
            o->opts.samples =
                (double)cli_count("--samples", optarg, 1000, (uint64_t)1 << 50);
            break;
        case 's': o->opts.seed = cli_count("-s", optarg, 0, UINT64_MAX); break;
        case 't': o->watch.seconds = cli_real("-t", optarg, 1e-3, 1e9); break;
        case FACES: o->form = VARIATION_FACES; break;
        case LEVELS: o->form = VARIATION_LEVELS; break;
        case EXPLAIN: o->form = VARIATION_EXPLAIN; break;
        case 'p': o->watch.show = true; break;
        case 'v': o->verbose = true; break;
        }
}

static bool run_program(variation_options *o, int argc, char *argv[])
{
    static const int strays[] = {'a', BOUNCES, 'm', SAMPLES, 's', 0};
    size_t dim = o->integrand.dim;

    if (optind < argc) cli_usage("--run and %s: one at a time", argv[optind]);
    cli_refuse(strays, "for integrands, not for --run");
    if (dim == 0) cli_usage("--run takes -d, the dimension");
    if (dim > KOKSMA_VARIATION_DIM_MOST)
        cli_fail("%zu axes have 2^%zu - 1 faces, and at most 2^%d - 1 are looked "
                 "at",
                 dim, dim, KOKSMA_VARIATION_DIM_MOST);
    return measure_program(o);
}

static void read_files(const variation_options *o, int argc, char *argv[])
{
    static const int strays[] = {'a', 'd', BOUNCES, 'm', SAMPLES, 's', 0};
    static const int of_programs[] = {CELLS, 't', 0};
    cli_input input;

    cli_refuse(strays, "for integrands, and none is named");
    cli_refuse(of_programs, "for integrands and programs, and none is named");
    input = cli_inputs(argc, argv, KOKSMA_GRID);
    measure_files(o, &input);
}

int main(int argc, char *argv[])
{
    variation_options o = {.opts = KOKSMA_VARIATION_DEFAULTS};
    bool finished = true;

    o.opts.progress = cli_watch_progress;
    o.opts.state = &o.watch;
    read_options(&o, argc, argv);
    if (o.command != NULL) {
        finished = run_program(&o, argc, argv);
    } else if (optind < argc && cli_integrand_exists(argv[optind])) {
        cli_integrand_choose(&o.integrand, argv[optind++]);
        if (optind < argc)
            cli_usage("one integrand at a time, not %s too", argv[optind]);
        finished = measure_integrand(&o);
    } else {
        read_files(&o, argc, argv);
    }
    cli_finish(finished ? CLI_DONE : CLI_STOPPED);
}
