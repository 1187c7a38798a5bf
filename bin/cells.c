/* koksma-cells: the cells that a discontinuity meets, and its extent. */

#include <stdlib.h>
#include <string.h>

#include "cells_report.h"

enum {
    BOUNCES = CLI_LONG,
    ELEMENTARY,
    BASES,
    LINES,
    STEPS,
    RATIO,
    AXES,
    JUMP,
    OCCUPANCY,
    FAMILY,
    START
};

static const cli_option options[] = {
    {'m', "method", "METHOD", "exact, lines or samples (default: exact, or lines)"},
    {'n', "points", "A:B|N,N,...", "a row for the grid of each N (default 2^10)"},
    {'a', "parameter", "NAME=V", "a parameter of the integrand; V: the first"},
    {'d', "dim", "DIM", "the dimension"},
    {BOUNCES, "bounces", "N", "steps of a walk in the scene, two coordinates each"},
    {ELEMENTARY, "elementary", NULL, "elementary intervals in the first primes"},
    {BASES, "bases", "B,B,...", "elementary intervals in these bases"},
    {RATIO, "ratio", "R", "beta over scales R apart (default 2)"},
    {LINES, "lines", "N", "random lines along each axis (default 1000)"},
    {STEPS, "steps", "N", "steps of a line (default 64)"},
    {'e', "tolerance", "V", "least jump, of the range of values (default 1e-3)"},
    {'s', "seed", "SEED", "of the lines (default 1)"},
    {AXES, "axes", NULL, "a row for each axis, by lines"},
    {JUMP, "jump", "V", "samples that differ by more are on two sides"},
    {OCCUPANCY, "occupancy", NULL, "how many points the cells have"},
    {FAMILY, "family", "NAME", "of --occupancy: the digits of halton, no input"},
    {START, "start", "INDEX", "of the first element of that"},
    {'t', "time", "SECONDS", "stop then"},
    {'p', "progress", NULL, "a live line on standard error"},
    {'v', "verbose", NULL, "say on standard error what was done"},
    {0},
};

static const cli_tool tool = {
    "koksma-cells", "INTEGRAND | -m samples [FILE]... | --occupancy [FILE]...",
    "Count the cells that a discontinuity meets.", options};

static cells_method read_method(const char *text)
{
    static const char *const names[] = {"auto", "exact", "lines", "samples"};

    for (int m = CELLS_AUTO; m <= CELLS_SAMPLES; m++)
        if (strcmp(text, names[m]) == 0) return (cells_method)m;
    cli_usage("-m takes auto, exact, lines or samples, not \"%s\"", text);
}

static void read_bases(cells_options *o, char *text)
{
    o->powers = 0;
    o->primes = false;
    for (char *next; text != NULL; text = next) {
        next = strchr(text, ',');
        if (next != NULL) *next++ = '\0';
        if (o->powers == KOKSMA_GRID_BASES_MOST)
            cli_usage("--bases takes at most %d", KOKSMA_GRID_BASES_MOST);
        o->bases[o->powers++] = (uint32_t)cli_count("--bases", text, 2, UINT32_MAX);
    }
}

static void take_primes(cells_options *o)
{
    if (o->powers > 0) return;
    o->powers = KOKSMA_GRID_BASES_MOST;
    o->primes = true;
}

static koksma_integrand choose(cli_integrand *r, koksma_facts *facts,
                               const char *name)
{
    koksma_integrand f;
    koksma_error err;

    cli_integrand_choose(r, name);
    if (koksma_integrand_make(&f, facts, r->row, r->dim, r->param, &err))
        cli_usage("%s", err.text);
    return f;
}

/* What would make no difference is a misunderstanding. */
static void refuse_strays(const cells_options *o)
{
    static const int of_integrands[] = {'a',   BOUNCES, AXES, LINES, STEPS,
                                        RATIO, 'e',     's',  't',   0};
    static const int of_samples[] = {JUMP, 0}, of_occupancy[] = {FAMILY, START, 0};
    static const int of_dim[] = {'d', 0}, of_method[] = {'m', 0};
    bool samples = !o->occupancy && o->method == CELLS_SAMPLES;

    if (o->occupancy) cli_refuse(of_method, "not for --occupancy");
    if (!o->occupancy) cli_refuse(of_occupancy, "for --occupancy");
    if (!samples) cli_refuse(of_samples, "for -m samples");
    if (!o->occupancy && !samples) return;
    cli_refuse(of_integrands, "for an integrand, which is not looked at here");
    if (!o->halton) cli_refuse(of_dim, "not for points, which say the dimension");
}

/* Points come from the input, or are the first of a family. */
static void run_sets(cells_options *o, const cli_integrand *r, int argc,
                     char *argv[])
{
    cli_input input;

    if (o->occupancy && o->halton) {
        if (optind < argc) cli_usage("--family reads no input");
        cells_halton(o, r->dim > 0 ? r->dim : 2);
        return;
    }
    input = cli_inputs(argc, argv, o->occupancy ? KOKSMA_POINTS : KOKSMA_VALUES);
    cells_sets(o, &input);
}

int main(int argc, char *argv[])
{
    cells_options o = {
        .lines = KOKSMA_LINES_DEFAULTS,
        .jump = -1.0,
        .bases = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47}};
    cli_integrand r = {0};
    koksma_facts facts;
    koksma_integrand f;
    char about[CLI_ABOUT_SIZE];
    bool finished = true;
    int c;

    while ((c = cli_next(&tool, argc, argv)) != -1)
        switch (c) {
        case 'm': o.method = read_method(optarg); break;
        case 'n': o.count = cli_prefixes(&o.n, "-n", optarg, 1); break;
        case 'a': cli_integrand_set(&r, "-a", NULL); break;
        case 'd': r.dim = cli_count("-d", optarg, 1, 10000); break;
        case BOUNCES: r.bounces = cli_count("--bounces", optarg, 1, 1000); break;
        case ELEMENTARY: take_primes(&o); break;
        case BASES: read_bases(&o, optarg); break;
        case RATIO: o.ratio = cli_count("--ratio", optarg, 2, 1u << 16); break;
        case LINES:
            o.lines.lines = cli_count("--lines", optarg, 2, 1u << 30);
            break;
        case STEPS:
            o.lines.steps = cli_count("--steps", optarg, 1, 1u << 20);
            break;
        case 'e': o.lines.tolerance = cli_real("-e", optarg, 1e-12, 0.5); break;
        case 's': o.lines.seed = cli_count("-s", optarg, 0, UINT64_MAX); break;
        case AXES: o.axes = true; break;
        case JUMP: o.jump = cli_real("--jump", optarg, 0.0, 1e300); break;
        case OCCUPANCY: o.occupancy = true; break;
        case FAMILY:
            if (strcmp(optarg, "halton") != 0)
                cli_usage("--family takes halton, not \"%s\"", optarg);
            o.halton = true;
            break;
        case START: o.start = cli_count("--start", optarg, 0, UINT64_MAX); break;
        case 't': o.watch.seconds = cli_real("-t", optarg, 1e-3, 1e9); break;
        case 'p': o.watch.show = true; break;
        case 'v': o.verbose = true; break;
        }
    refuse_strays(&o);
    if (o.start > 0 && !o.halton) cli_usage("--start goes with --family halton");
    if (o.occupancy || o.method == CELLS_SAMPLES)
        run_sets(&o, &r, argc, argv);
    else if (argc - optind != 1)
        cli_usage("name one integrand; koksma-eval --list lists them");
    else {
        f = choose(&r, &facts, argv[optind]);
        cli_integrand_about(about, r.row, &f, NULL);
        finished = cells_table(&o, &f, &facts, about);
    }
    free(o.n);
    cli_finish(finished ? CLI_DONE : CLI_STOPPED);
}
