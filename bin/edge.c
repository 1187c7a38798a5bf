/* koksma-edge: the half-plane discrepancy of each point set. */

#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "edge.h"

enum { PREFIXES = CLI_LONG };

static const cli_option options[] = {
    {'m', "method", "METHOD", "auto, sweep or tree (default auto)"},
    {'e', "tolerance", "E", "stop at upper <= (1+E) lower (default 0: exact)"},
    {'t', "time", "SECONDS", "stop then, with the interval so far"},
    {'j', "threads", "THREADS", "how many threads (default 0: one a processor)"},
    {PREFIXES, "prefixes", "A:B|N,N,...", "a row for so many first points each"},
    {'w', "witness", NULL, "write the half-plane that proves the lower bound"},
    {'p', "progress", NULL, "a live line on standard error"},
    {'v', "verbose", NULL, "say on standard error what was done"},
    {0},
};

static const cli_tool tool = {"koksma-edge", "[FILE]...",
                              "Bound the half-plane discrepancy of each point set.",
                              options};

static const char *const methods[] = {
    [KOKSMA_EDGE_AUTO] = "auto",
    [KOKSMA_EDGE_SWEEP] = "sweep",
    [KOKSMA_EDGE_TREE] = "tree",
};

typedef struct edge_options {
    koksma_edge_opts opts;
    cli_watch watch;
    bool witness, verbose, header;
    const cli_input *input;
    uint64_t *prefix; /* NULL: only the whole set */
    size_t prefixes;
} edge_options;

static koksma_edge_method read_method(const char *text)
{
    for (int m = KOKSMA_EDGE_AUTO; m <= KOKSMA_EDGE_TREE; m++)
        if (strcmp(text, methods[m]) == 0) return (koksma_edge_method)m;
    cli_usage("-m takes auto, sweep or tree, not \"%s\"", text);
}

/* Once, before the first row: what cannot be measured leaves no header behind. */
static void print_header(edge_options *o)
{
    if (cli_quiet() || o->header) return;
    o->header = true;
    printf("# %sn\tdim\tlower\tupper%s\n", o->input->several ? "input\t" : "",
           o->witness ? "\tinside\tfrom_x\tfrom_y\tto_x\tto_y" : "");
}

static void print_column(double v)
{
    putchar('\t');
    cli_number(v);
}

static void print_row(edge_options *o, koksma_points p, const koksma_edge_result *r)
{
    print_header(o);
    if (o->input->several) printf("%s\t", o->input->label);
    printf("%zu\t%zu", p.n, p.dim);
    print_column(r->value.lower);
    print_column(r->value.upper);
    if (o->witness) {
        printf("\t%zu", r->witness.inside);
        print_column(r->witness.from[0]);
        print_column(r->witness.from[1]);
        print_column(r->witness.to[0]);
        print_column(r->witness.to[1]);
    }
    putchar('\n');
}

/* Returns whether it was finished. */
static bool measure(koksma_points p, void *state)
{
    edge_options *o = state;
    koksma_edge_result r;
    koksma_error err;
    koksma_status status;

    cli_watch_start(&o->watch);
    status = koksma_edge(&r, p, &o->opts, &err);
    cli_watch_stop(&o->watch);
    if (status != KOKSMA_OK && status != KOKSMA_STOPPED)
        cli_fail_input(o->input, &err);
    print_row(o, p, &r);
    if (status == KOKSMA_STOPPED) cli_note("%s", err.text);
    if (o->verbose)
        cli_note("%zu points: %s (%s), %.3g points looked at, %.2f s", p.n,
                 methods[r.method],
                 o->opts.method != KOKSMA_EDGE_AUTO ? "as told"
                 : r.method == KOKSMA_EDGE_SWEEP    ? "few points"
                                                    : "many points",
                 r.work, cli_seconds(&o->watch));
    return status == KOKSMA_OK;
}

int main(int argc, char *argv[])
{
    edge_options o = {.opts = {.progress = cli_watch_progress}};
    koksma_set set = {0};
    bool finished = true;
    int c;

    while ((c = cli_next(&tool, argc, argv)) != -1)
        switch (c) {
        case 'm': o.opts.method = read_method(optarg); break;
        case 'e': o.opts.tolerance = cli_real("-e", optarg, 0.0, 1e9); break;
        case 't':
            o.watch.seconds = cli_real("-t", optarg, 1e-3, 1e9);
            o.opts.anytime = true;
            break;
        case 'j': o.opts.threads = cli_count("-j", optarg, 0, 65536); break;
        case PREFIXES:
            o.prefixes = cli_prefixes(&o.prefix, "--prefixes", optarg, 1);
            break;
        case 'w': o.witness = true; break;
        case 'p': o.watch.show = true; break;
        case 'v': o.verbose = true; break;
        }

    cli_input input = cli_inputs(argc, argv, KOKSMA_POINTS);

    o.input = &input;
    o.opts.state = &o.watch;
    while (finished && cli_read_set(&input, &set))
        finished = cli_each_prefix(&input, &set, o.prefix, o.prefixes, measure, &o);
    koksma_set_free(&set);
    free(o.prefix);
    cli_finish(finished ? CLI_DONE : CLI_STOPPED);
}
