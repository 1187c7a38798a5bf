/* koksma-star: the star discrepancy of each point set. */

#include <math.h>
#include <stdlib.h>

#include "cli_search.h"
#include "star.h"

static const cli_option options[] = {
    {'m', "method", "METHOD",
     "auto, sweep, tree, lines, dem or search (default auto)"},
    CLI_SEARCH_LIMITS,
    CLI_SEARCH_SHARES,
    CLI_SEARCH_ROWS,
    {'w', "witness", NULL, "write the box that proves the lower bound"},
    CLI_SEARCH_AUDIT,
    {0},
};

static const cli_tool tool = {"koksma-star", "[FILE]...",
                              "Bound the star discrepancy of each point set.",
                              options};

static const cli_search_method methods[] = {
    [KOKSMA_STAR_AUTO] = {"auto", NULL},
    [KOKSMA_STAR_SWEEP] = {"sweep", "corners"},
    [KOKSMA_STAR_TREE] = {"tree", "list entries"},
    [KOKSMA_STAR_LINES] = {"lines", "lines"},
    [KOKSMA_STAR_DEM] = {"dem", "products"},
    [KOKSMA_STAR_SEARCH] = {"search", "points looked at"},
    {0},
};

static const char *reason(koksma_star_method method, koksma_points p)
{
    if (p.dim == 1) return "one coordinate";
    if (method == KOKSMA_STAR_SWEEP) return "few corners";
    return p.dim <= 3 ? "two or three coordinates" : "more than three coordinates";
}

static void print_witness(const koksma_box *box, koksma_points p)
{
    printf("\t%s\t%zu", box->closed ? "closed" : "open", box->inside);
    for (size_t k = 0; k < p.dim; k++)
        cli_search_column(box->corner[k]);
}

/* Returns whether it was finished. */
static bool measure(koksma_points p, void *state)
{
    cli_search *s = state;
    koksma_star_opts opts = {
        .method = (koksma_star_method)s->method,
        .tolerance = s->tolerance,
        .anytime = s->anytime,
        .threads = s->threads,
        .part = s->part,
        .parts = s->parts,
        /* Who says how long does not mind how much. */
        .work = s->watch.seconds > 0.0 ? HUGE_VAL : 0.0,
        .seed = s->seed,
        .progress = cli_search_progress,
        .state = s,
    };
    koksma_star_result r = {.witness.corner = malloc(p.dim * sizeof(double))};
    koksma_error err;
    koksma_status status;

    if (r.witness.corner == NULL) cli_fail("not enough memory for a witness");
    cli_search_start(s);
    status = koksma_star(&r, p, &opts, &err);
    cli_search_stop(s, status, &err);
    cli_search_row(s, p, r.value, r.work);
    if (s->witness) print_witness(&r.witness, p);
    free(r.witness.corner);
    cli_search_end(s, p, (int)r.method, reason(r.method, p), r.work);
    return status == KOKSMA_OK;
}

int main(int argc, char *argv[])
{
    cli_search s = {
        .methods = methods, .witness_columns = "\tbox\tinside\tcorner", .seed = 1};
    int c;

    while ((c = cli_next(&tool, argc, argv)) != -1)
        cli_search_option(&s, c);
    if (s.parts > 1 && s.method != KOKSMA_STAR_AUTO &&
        s.method != KOKSMA_STAR_TREE && s.method != KOKSMA_STAR_LINES)
        cli_usage("--part takes the tree or the lines: the others cannot be cut");
    cli_search_run(&s, argc, argv, measure);
}
