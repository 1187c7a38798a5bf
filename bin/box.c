/* koksma-box: the box discrepancy of each point set. */

#include <stdlib.h>
#include <string.h>

#include "box.h"
#include "cli.h"

enum { PART = CLI_LONG, PREFIXES, TRACE };

static const cli_option options[] = {
    {'m', "method", "METHOD", "auto, sweep, tree or search (default auto)"},
    {'e', "tolerance", "E", "stop at upper <= (1+E) lower (default 0: exact)"},
    {'t', "time", "SECONDS", "stop then, with the interval so far"},
    {'j', "threads", "THREADS", "how many threads (default 0: one a processor)"},
    {'s', "seed", "SEED", "of the search (default 1)"},
    {PART, "part", "I/M", "do the I-th of M shares of the work"},
    {PREFIXES, "prefixes", "A:B|N,N,...", "a row for so many first points each"},
    {TRACE, "trace", NULL, "write a row at every improvement of the interval"},
    {'w', "witness", NULL, "write the box that proves the lower bound"},
    {'p', "progress", NULL, "a live line on standard error"},
    {'v', "verbose", NULL, "say on standard error what was done"},
    {0},
};

static const cli_tool tool = {"koksma-box", "[FILE]...",
                              "Bound the box discrepancy of each point set.",
                              options};

static const struct {
    const char *name, *steps;
} methods[] = {
    [KOKSMA_BOX_AUTO] = {"auto", NULL},
    [KOKSMA_BOX_SWEEP] = {"sweep", "nodes"},
    [KOKSMA_BOX_TREE] = {"tree", "list entries"},
    [KOKSMA_BOX_SEARCH] = {"search", "points looked at"},
};

typedef struct box_options {
    koksma_box_opts opts;
    cli_watch watch;
    bool witness, verbose, trace, header;
    const cli_input *input;
    uint64_t *prefix; /* NULL: only the whole set */
    size_t prefixes;
    koksma_interval traced; /* what the last row of the trace said */
} box_options;

/* Once, before the first row: what cannot be measured leaves no header behind. */
static void print_header(box_options *o)
{
    const char *input = o->input->several ? "input\t" : "";

    if (cli_quiet() || o->header) return;
    o->header = true;
    if (o->trace)
        printf("# %sseconds\tsteps\tlower\tupper\n", input);
    else
        printf("# %sn\tdim\t%s%s\n", input,
               o->opts.parts > 1 ? "part_lower\tpart_upper" : "lower\tupper",
               o->witness ? "\tbox\tinside\tcorners" : "");
}

static void print_label(const cli_input *input)
{
    if (input->several) printf("%s\t", input->label);
}

static void print_interval(koksma_interval v)
{
    putchar('\t');
    cli_number(v.lower);
    putchar('\t');
    cli_number(v.upper);
}

/* A row of the trace, if the interval has improved. */
static void trace(box_options *o, koksma_interval v, double work)
{
    if (v.lower == o->traced.lower && v.upper == o->traced.upper) return;
    o->traced = v;
    print_header(o);
    print_label(o->input);
    printf("%.3f\t%.0f", cli_seconds(&o->watch), work);
    print_interval(v);
    putchar('\n');
    cli_flush();
}

static int on_progress(void *state, double lower, double upper, double work)
{
    box_options *o = state;

    if (o->trace) trace(o, (koksma_interval){lower, upper}, work);
    return cli_watch_progress(&o->watch, lower, upper, work);
}

static void print_row(box_options *o, koksma_points p, const koksma_box_result *r)
{
    print_header(o);
    print_label(o->input);
    printf("%zu\t%zu", p.n, p.dim);
    print_interval(r->value);
    if (o->witness) {
        printf("\t%s\t%zu", r->witness.closed ? "closed" : "open",
               r->witness.inside);
        for (size_t k = 0; k < 2 * p.dim; k++) {
            putchar('\t');
            cli_number(r->witness.corners[k]);
        }
    }
    putchar('\n');
}

static koksma_box_method read_method(const char *text)
{
    for (int m = KOKSMA_BOX_AUTO; m <= KOKSMA_BOX_SEARCH; m++)
        if (strcmp(text, methods[m].name) == 0) return (koksma_box_method)m;
    cli_usage("-m takes auto, sweep, tree or search, not \"%s\"", text);
}

/* I/M, as in 2/8. */
static void read_part(box_options *o, const char *text)
{
    char first[32];
    const char *slash = strchr(text, '/');

    if (slash == NULL || (size_t)(slash - text) >= sizeof first)
        cli_usage("--part takes two numbers like 2/8, not \"%s\"", text);
    memcpy(first, text, (size_t)(slash - text));
    first[slash - text] = '\0';
    o->opts.parts = cli_count("--part", slash + 1, 1, 1000000);
    o->opts.part = cli_count("--part", first, 1, o->opts.parts);
}

static const char *reason(const box_options *o, const koksma_box_result *r,
                          koksma_points p)
{
    if (r->method == KOKSMA_BOX_SEARCH && o->opts.method != KOKSMA_BOX_SEARCH)
        return "stopped before the rest";
    if (o->opts.method != KOKSMA_BOX_AUTO) return "as told";
    if (p.dim == 1) return "one coordinate";
    if (p.dim > 2) return "more than two coordinates";
    return r->method == KOKSMA_BOX_SWEEP ? "few points too many"
                                         : "many points too many";
}

/* Returns whether it was finished. */
static bool measure(koksma_points p, void *state)
{
    box_options *o = state;
    koksma_box_result r = {.witness.corners = malloc(2 * p.dim * sizeof(double))};
    koksma_error err;
    koksma_status status;

    if (r.witness.corners == NULL) cli_fail("not enough memory for a witness");
    o->traced = (koksma_interval){-1.0, 2.0};
    cli_watch_start(&o->watch);
    status = koksma_box_discrepancy(&r, p, &o->opts, &err);
    cli_watch_stop(&o->watch);
    if (status != KOKSMA_OK && status != KOKSMA_STOPPED)
        cli_fail_input(o->input, &err);
    if (o->trace)
        trace(o, r.value, r.work);
    else
        print_row(o, p, &r);
    if (status == KOKSMA_STOPPED) cli_note("%s", err.text);
    if (o->verbose)
        cli_note("%zu points, %zu coordinates: %s (%s), %.3g %s, %.2f s", p.n,
                 p.dim, methods[r.method].name, reason(o, &r, p), r.work,
                 methods[r.method].steps, cli_seconds(&o->watch));
    free(r.witness.corners);
    return status == KOKSMA_OK;
}

int main(int argc, char *argv[])
{
    box_options o = {.opts = {.seed = 1, .progress = on_progress}};
    koksma_set set = {0};
    bool finished = true;
    int c;

    while ((c = cli_next(&tool, argc, argv)) != -1)
        switch (c) {
        case 'm': o.opts.method = read_method(optarg); break;
        case 'e':
            o.opts.tolerance = cli_real("-e", optarg, 0.0, 1e9);
            o.opts.anytime = true;
            break;
        case 't':
            o.watch.seconds = cli_real("-t", optarg, 1e-3, 1e9);
            o.opts.anytime = true;
            break;
        case 'j': o.opts.threads = cli_count("-j", optarg, 0, 65536); break;
        case PART: read_part(&o, optarg); break;
        case PREFIXES:
            o.prefixes = cli_prefixes(&o.prefix, "--prefixes", optarg, 1);
            break;
        case TRACE: o.trace = o.opts.anytime = true; break;
        case 's': o.opts.seed = cli_count("-s", optarg, 0, UINT64_MAX); break;
        case 'w': o.witness = true; break;
        case 'p': o.watch.show = true; break;
        case 'v': o.verbose = true; break;
        }

    if (o.trace && o.witness) cli_usage("--trace has no room for a witness");
    if (o.opts.parts > 1 && o.opts.method == KOKSMA_BOX_SEARCH)
        cli_usage("--part takes the sweep or the tree: the search cannot be cut");

    cli_input input = cli_inputs(argc, argv, KOKSMA_POINTS);

    o.input = &input;
    o.opts.state = &o;
    while (finished && cli_read_set(&input, &set))
        finished = cli_each_prefix(&input, &set, o.prefix, o.prefixes, measure, &o);
    koksma_set_free(&set);
    free(o.prefix);
    cli_finish(finished ? CLI_DONE : CLI_STOPPED);
}
