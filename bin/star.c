/* koksma-star: the star discrepancy of each point set. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "star.h"

static const cli_option options[] = {
    {'m', "method", "METHOD", "auto, sweep, tree or lines (default auto)"},
    {'e', "tolerance", "E", "stop at upper <= (1+E) lower (default 0: exact)"},
    {'t', "time", "SECONDS", "stop then, with the interval so far"},
    {'w', "witness", NULL, "write the box that proves the lower bound"},
    {'p', "progress", NULL, "a live line on standard error"},
    {'v', "verbose", NULL, "say on standard error what was done"},
    {0},
};

static const cli_tool tool = {"koksma-star", "[FILE]...",
                              "Bound the star discrepancy of each point set.",
                              options};

typedef struct star_options {
    koksma_star_opts opts;
    cli_watch watch;
    bool witness, verbose;
} star_options;

static void print_header(bool several, bool witness)
{
    if (cli_quiet()) return;
    printf("# %sn\tdim\tlower\tupper%s\n", several ? "input\t" : "",
           witness ? "\tbox\tinside\tcorner" : "");
}

static void print_row(const cli_input *input, const koksma_set *set,
                      const koksma_star_result *r, bool witness)
{
    if (input->several) printf("%s\t", input->label);
    printf("%zu\t%zu", set->n, set->dim);
    putchar('\t');
    cli_number(r->value.lower);
    putchar('\t');
    cli_number(r->value.upper);
    if (witness) {
        printf("\t%s\t%zu", r->witness.closed ? "closed" : "open",
               r->witness.inside);
        for (size_t k = 0; k < set->dim; k++) {
            putchar('\t');
            cli_number(r->witness.corner[k]);
        }
    }
    putchar('\n');
}

static koksma_star_method read_method(const char *text)
{
    if (strcmp(text, "auto") == 0) return KOKSMA_STAR_AUTO;
    if (strcmp(text, "sweep") == 0) return KOKSMA_STAR_SWEEP;
    if (strcmp(text, "tree") == 0) return KOKSMA_STAR_TREE;
    if (strcmp(text, "lines") == 0) return KOKSMA_STAR_LINES;
    cli_usage("-m takes auto, sweep, tree or lines, not \"%s\"", text);
}

/* Returns whether the set was finished. */
static bool measure(cli_input *input, const koksma_set *set, star_options *o)
{
    static const char *const names[][2] = {
        [KOKSMA_STAR_SWEEP] = {"sweep", "corners"},
        [KOKSMA_STAR_TREE] = {"tree", "list entries"},
        [KOKSMA_STAR_LINES] = {"lines", "lines"}};
    koksma_star_result r = {.witness.corner = malloc(set->dim * sizeof(double))};
    koksma_error err;
    koksma_status status;

    if (r.witness.corner == NULL) cli_fail("not enough memory for a witness");
    cli_watch_start(&o->watch);
    o->opts.state = &o->watch;
    status = koksma_star(&r, koksma_set_view(set), &o->opts, &err);
    cli_watch_stop(&o->watch);
    if (status != KOKSMA_OK && status != KOKSMA_STOPPED)
        cli_fail_input(input, &err);
    print_row(input, set, &r, o->witness);
    if (status == KOKSMA_STOPPED) cli_note("%s", err.text);
    if (o->verbose)
        cli_note("%zu points, %zu coordinates: %s, %.3g %s, %.2f s", set->n,
                 set->dim, names[r.method][0], r.work, names[r.method][1],
                 cli_seconds(&o->watch));
    free(r.witness.corner);
    return status == KOKSMA_OK;
}

int main(int argc, char *argv[])
{
    star_options o = {.opts = {.progress = cli_watch_progress}};
    koksma_set set = {0};
    bool header = false, finished = true;
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
            o.opts.work = HUGE_VAL; /* who says how long does not mind how much */
            break;
        case 'w': o.witness = true; break;
        case 'p': o.watch.show = true; break;
        case 'v': o.verbose = true; break;
        }

    cli_input input = cli_inputs(argc, argv, KOKSMA_POINTS);

    while (finished && cli_read_set(&input, &set)) {
        if (!header) print_header(input.several, o.witness);
        header = true;
        finished = measure(&input, &set, &o);
    }
    koksma_set_free(&set);
    cli_finish(finished ? CLI_DONE : CLI_STOPPED);
}
