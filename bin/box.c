/* koksma-box: the box discrepancy of each point set. */

#include <stdlib.h>

#include "box.h"
#include "cli_search.h"

static const cli_option options[] = {
    {'m', "method", "METHOD", "auto, sweep, tree or search (default auto)"},
    CLI_SEARCH_LIMITS,
    CLI_SEARCH_SHARES,
    CLI_SEARCH_ROWS,
    {'w', "witness", NULL, "write the box that proves the lower bound"},
    CLI_SEARCH_AUDIT,
    {0},
};

static const cli_tool tool = {"koksma-box", "[FILE]...",
                              "Bound the box discrepancy of each point set.",
                              options};

static const cli_search_method methods[] = {
    [KOKSMA_BOX_AUTO] = {"auto", NULL},
    [KOKSMA_BOX_SWEEP] = {"sweep", "nodes"},
    [KOKSMA_BOX_TREE] = {"tree", "list entries"},
    [KOKSMA_BOX_SEARCH] = {"search", "points looked at"},
    {0},
};

static const char *reason(koksma_box_method method, koksma_points p)
{
    if (method == KOKSMA_BOX_SEARCH) return "stopped before the rest";
    if (p.dim == 1) return "one coordinate";
    if (p.dim > 2) return "more than two coordinates";
    return method == KOKSMA_BOX_SWEEP ? "few points too many"
                                      : "many points too many";
}

static void print_witness(const koksma_box_witness *w, koksma_points p)
{
    printf("\t%s\t%zu", w->closed ? "closed" : "open", w->inside);
    for (size_t k = 0; k < 2 * p.dim; k++)
        cli_search_column(w->corners[k]);
}

/* Returns whether it was finished. */
static bool measure(koksma_points p, void *state)
{
    cli_search *s = state;
    koksma_box_opts opts = {
        .method = (koksma_box_method)s->method,
        .tolerance = s->tolerance,
        .anytime = s->anytime,
        .threads = s->threads,
        .part = s->part,
        .parts = s->parts,
        .seed = s->seed,
        .progress = cli_search_progress,
        .state = s,
    };
    koksma_box_result r = {.witness.corners = malloc(2 * p.dim * sizeof(double))};
    koksma_error err;
    koksma_status status;

    if (r.witness.corners == NULL) cli_fail("not enough memory for a witness");
    cli_search_start(s);
    status = koksma_box_discrepancy(&r, p, &opts, &err);
    cli_search_stop(s, status, &err);
    cli_search_row(s, p, r.value, r.work);
    if (s->witness) print_witness(&r.witness, p);
    free(r.witness.corners);
    cli_search_end(s, p, (int)r.method, reason(r.method, p), r.work);
    return status == KOKSMA_OK;
}

int main(int argc, char *argv[])
{
    cli_search s = {
        .methods = methods, .witness_columns = "\tbox\tinside\tcorners", .seed = 1};
    int c;

    while ((c = cli_next(&tool, argc, argv)) != -1)
        cli_search_option(&s, c);
    if (s.parts > 1 && s.method == KOKSMA_BOX_SEARCH)
        cli_usage("--part takes the sweep or the tree: the search cannot be cut");
    cli_search_run(&s, argc, argv, measure);
}
