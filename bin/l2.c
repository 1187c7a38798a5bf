/* koksma-l2: the discrepancies in the mean square of each point set. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "l2.h"

enum { SQUARED = CLI_LONG, PREFIXES, LOG10 };

static const cli_option options[] = {
    {'k', "kind", "KIND",
     "star, extreme, periodic, centered, wraparound, mixture or symmetric"},
    {'m', "method", "METHOD", "auto, pairs or divide (default auto)"},
    {SQUARED, "squared", NULL, "write the square"},
    {LOG10, "log10", NULL, "write the decimal logarithm"},
    {PREFIXES, "prefixes", "A:B|N,N,...", "a row for so many first points each"},
    {'t', "time", "SECONDS", "stop then"},
    {'j', "threads", "THREADS", "how many threads (default 0: one a processor)"},
    {'p', "progress", NULL, "a live line on standard error"},
    {'v', "verbose", NULL, "say on standard error what was done"},
    {0},
};

static const cli_tool tool = {"koksma-l2", "[FILE]...",
                              "Bound an L2 discrepancy of each point set.",
                              options};

static const struct {
    const char *name, *steps;
} methods[] = {
    [KOKSMA_L2_AUTO] = {"auto", NULL},
    [KOKSMA_L2_PAIRS] = {"pairs", "pairs of coordinates"},
    [KOKSMA_L2_DIVIDE] = {"divide", "steps"},
};

typedef struct l2_options {
    koksma_l2_opts opts;
    cli_watch watch;
    bool squared, log10, verbose;
    uint64_t *prefix; /* NULL: only the whole set */
    size_t prefixes;
    const cli_input *input;
} l2_options;

static void print_header(const l2_options *o)
{
    const char *what = o->log10 ? "log10_" : "";

    if (cli_quiet()) return;
    printf("# koksma: measure=l2\n# %sn\tdim\t%slower\t%supper\n",
           o->input->several ? "input\t" : "", what, what);
}

static void print_row(const l2_options *o, koksma_points p,
                      const koksma_l2_result *r)
{
    koksma_interval v = o->log10 ? r->log10 : o->squared ? r->squared : r->value;
    double times = o->log10 && o->squared ? 2.0 : 1.0; /* exact */

    if (o->input->several) printf("%s\t", o->input->label);
    printf("%zu\t%zu\t", p.n, p.dim);
    cli_number(times * v.lower);
    putchar('\t');
    cli_number(times * v.upper);
    putchar('\n');
}

static koksma_l2_kind read_kind(const char *text)
{
    for (int k = 0; k < KOKSMA_L2_KINDS; k++)
        if (strcmp(text, koksma_l2_names[k]) == 0) return (koksma_l2_kind)k;
    cli_usage("-k takes star, extreme, periodic, centered, wraparound, mixture or "
              "symmetric, not \"%s\"",
              text);
}

static koksma_l2_method read_method(const char *text)
{
    for (int m = KOKSMA_L2_AUTO; m <= KOKSMA_L2_DIVIDE; m++)
        if (strcmp(text, methods[m].name) == 0) return (koksma_l2_method)m;
    cli_usage("-m takes auto, pairs or divide, not \"%s\"", text);
}

/* Where the value leaves the range of doubles its logarithm does not. */
static bool out_of_range(const l2_options *o, const koksma_l2_result *r)
{
    koksma_interval v = o->squared ? r->squared : r->value;

    return !o->log10 && r->log10.upper > -HUGE_VAL && r->log10.upper < HUGE_VAL &&
           (v.upper < 0x1p-1000 || !(v.upper < HUGE_VAL));
}

/* Returns whether the set was finished. */
static bool measure(koksma_points p, void *state)
{
    l2_options *o = state;
    koksma_l2_result r;
    koksma_error err;
    koksma_status status;

    cli_watch_start(&o->watch);
    status = koksma_l2(&r, p, &o->opts, &err);
    cli_watch_stop(&o->watch);
    if (status != KOKSMA_OK && status != KOKSMA_STOPPED)
        cli_fail_input(o->input, &err);
    print_row(o, p, &r);
    if (status == KOKSMA_STOPPED) cli_note("%s", err.text);
    if (out_of_range(o, &r))
        cli_note("the value is out of the range of doubles: see --log10");
    if (o->verbose)
        cli_note("%zu points, %zu coordinates: %s, %s, %.3g %s, %.2f s", p.n, p.dim,
                 koksma_l2_names[o->opts.kind], methods[r.method].name, r.work,
                 methods[r.method].steps, cli_seconds(&o->watch));
    return status == KOKSMA_OK;
}

int main(int argc, char *argv[])
{
    l2_options o = {.opts = {.progress = cli_watch_progress}};
    koksma_set set = {0};
    bool header = false, finished = true;
    int c;

    while ((c = cli_next(&tool, argc, argv)) != -1)
        switch (c) {
        case 'k': o.opts.kind = read_kind(optarg); break;
        case 'm': o.opts.method = read_method(optarg); break;
        case SQUARED: o.squared = true; break;
        case LOG10: o.log10 = true; break;
        case PREFIXES:
            o.prefixes = cli_prefixes(&o.prefix, "--prefixes", optarg, 1);
            break;
        case 't': o.watch.seconds = cli_real("-t", optarg, 1e-3, 1e9); break;
        case 'j': o.opts.threads = cli_count("-j", optarg, 0, 65536); break;
        case 'p': o.watch.show = true; break;
        case 'v': o.verbose = true; break;
        }

    cli_input input = cli_inputs(argc, argv, KOKSMA_POINTS);

    o.input = &input;
    o.opts.state = &o.watch;
    while (finished && cli_read_set(&input, &set)) {
        if (!header) print_header(&o);
        header = true;
        finished = cli_each_prefix(&input, &set, o.prefix, o.prefixes, measure, &o);
    }
    koksma_set_free(&set);
    free(o.prefix);
    cli_finish(finished ? CLI_DONE : CLI_STOPPED);
}
