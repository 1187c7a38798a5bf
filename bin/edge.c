/* koksma-edge: the half-plane discrepancy of each point set. */

#include "edge.h"
#include "cli_search.h"

static const cli_option options[] = {
    {'m', "method", "METHOD", "auto, sweep or tree (default auto)"},
    CLI_SEARCH_LIMITS,
    CLI_SEARCH_ROWS,
    {'w', "witness", NULL, "write the half-plane that proves the lower bound"},
    CLI_SEARCH_AUDIT,
    {0},
};

static const cli_tool tool = {"koksma-edge", "[FILE]...",
                              "Bound the half-plane discrepancy of each point set.",
                              options};

static const cli_search_method methods[] = {
    [KOKSMA_EDGE_AUTO] = {"auto", NULL},
    [KOKSMA_EDGE_SWEEP] = {"sweep", "points looked at"},
    [KOKSMA_EDGE_TREE] = {"tree", "points looked at"},
    {0},
};

static void print_witness(const koksma_half_plane *h)
{
    printf("\t%zu", h->inside);
    cli_search_column(h->from[0]);
    cli_search_column(h->from[1]);
    cli_search_column(h->to[0]);
    cli_search_column(h->to[1]);
}

/* Returns whether it was finished. */
static bool measure(koksma_points p, void *state)
{
    cli_search *s = state;
    koksma_edge_opts opts = {
        .method = (koksma_edge_method)s->method,
        .tolerance = s->tolerance,
        .anytime = s->anytime,
        .threads = s->threads,
        .progress = cli_search_progress,
        .state = s,
    };
    koksma_edge_result r;
    koksma_error err;
    koksma_status status;

    cli_search_start(s);
    status = koksma_edge(&r, p, &opts, &err);
    cli_search_stop(s, status, &err);
    cli_search_row(s, p, r.value, r.work);
    if (s->witness) print_witness(&r.witness);
    cli_search_end(s, p, (int)r.method,
                   r.method == KOKSMA_EDGE_SWEEP ? "few points" : "many points",
                   r.work);
    return status == KOKSMA_OK;
}

int main(int argc, char *argv[])
{
    cli_search s = {.methods = methods,
                    .witness_columns = "\tinside\tfrom_x\tfrom_y\tto_x\tto_y",
                    .measure = "edge"};
    int c;

    while ((c = cli_next(&tool, argc, argv)) != -1)
        cli_search_option(&s, c);
    cli_search_run(&s, argc, argv, measure);
}
