#include "cli_search.h"

#include <stdlib.h>
#include <string.h>

/* ---- Options ------------------------------------------------------------ */

static int read_method(const cli_search *s, const char *text)
{
    const cli_search_method *methods = s->methods;
    char names[128] = "auto";
    size_t length = strlen(names);
    int m = 0;

    while (methods[m].name != NULL && strcmp(text, methods[m].name) != 0)
        m++;
    if (methods[m].name != NULL) return m;
    for (m = 1; methods[m].name != NULL; m++)
        length += (size_t)snprintf(names + length, sizeof names - length, "%s%s",
                                   methods[m + 1].name != NULL ? ", " : " or ",
                                   methods[m].name);
    cli_usage("-m takes %s, not \"%s\"", names, text);
}

/* I/M, as in 2/8. */
static void read_part(cli_search *s, const char *text)
{
    char first[32];
    const char *slash = strchr(text, '/');

    if (slash == NULL || (size_t)(slash - text) >= sizeof first)
        cli_usage("--part takes two numbers like 2/8, not \"%s\"", text);
    memcpy(first, text, (size_t)(slash - text));
    first[slash - text] = '\0';
    s->parts = cli_count("--part", slash + 1, 1, 1000000);
    s->part = cli_count("--part", first, 1, s->parts);
}

void cli_search_option(cli_search *s, int c)
{
    switch (c) {
    case 'm': s->method = read_method(s, optarg); break;
    case 'e':
        s->tolerance = cli_real("-e", optarg, 0.0, 1e9);
        s->anytime = true;
        break;
    case 't':
        s->watch.seconds = cli_real("-t", optarg, 1e-3, 1e9);
        s->anytime = true;
        break;
    case 'j': s->threads = cli_count("-j", optarg, 0, 65536); break;
    case 's': s->seed = cli_count("-s", optarg, 0, UINT64_MAX); break;
    case CLI_SEARCH_PART: read_part(s, optarg); break;
    case CLI_SEARCH_PREFIXES:
        s->prefixes = cli_prefixes(&s->prefix, "--prefixes", optarg, 1);
        break;
    case CLI_SEARCH_TRACE: s->trace = s->anytime = true; break;
    case 'w': s->witness = true; break;
    case 'p': s->watch.show = true; break;
    case 'v': s->verbose = true; break;
    }
}

/* ---- Rows --------------------------------------------------------------- */

/* Once, before the first row: what cannot be measured leaves no header behind. */
static void print_header(cli_search *s)
{
    const char *input = s->input->several ? "input\t" : "";
    const char *interval = s->parts > 1 ? "part_lower\tpart_upper" : "lower\tupper";

    if (cli_quiet() || s->header) return;
    s->header = true;
    if (s->measure != NULL) printf("# koksma: measure=%s\n", s->measure);
    if (s->trace)
        printf("# %sseconds\tsteps\t%s\n", input, interval);
    else
        printf("# %sn\tdim\t%s%s\n", input, interval,
               s->witness ? s->witness_columns : "");
}

static void begin_row(cli_search *s)
{
    print_header(s);
    if (s->input->several) printf("%s\t", s->input->label);
}

void cli_search_column(double v)
{
    putchar('\t');
    cli_number(v);
}

static void print_interval(koksma_interval v)
{
    cli_search_column(v.lower);
    cli_search_column(v.upper);
}

/* A row of the trace, if the interval has improved. */
static void trace(cli_search *s, koksma_interval v, double work)
{
    if (v.lower == s->traced.lower && v.upper == s->traced.upper) return;
    s->traced = v;
    begin_row(s);
    printf("%.3f\t%.0f", cli_seconds(&s->watch), work);
    print_interval(v);
    putchar('\n');
    cli_flush();
}

void cli_search_row(cli_search *s, koksma_points p, koksma_interval value,
                    double work)
{
    if (s->trace) {
        trace(s, value, work);
        return;
    }
    begin_row(s);
    printf("%zu\t%zu", p.n, p.dim);
    print_interval(value);
}

void cli_search_end(const cli_search *s, koksma_points p, int method,
                    const char *reason, double work)
{
    if (!s->trace) putchar('\n');
    if (s->verbose)
        cli_note("%zu points, %zu coordinates: %s (%s), %.3g %s, %.2f s", p.n,
                 p.dim, s->methods[method].name,
                 s->method == method ? "as told" : reason, work,
                 s->methods[method].steps, cli_seconds(&s->watch));
}

/* ---- Searching ---------------------------------------------------------- */

void cli_search_start(cli_search *s)
{
    s->traced = (koksma_interval){-1.0, 2.0};
    cli_watch_start(&s->watch);
}

void cli_search_stop(const cli_search *s, koksma_status status,
                     const koksma_error *err)
{
    cli_watch_stop(&s->watch);
    if (status != KOKSMA_OK && status != KOKSMA_STOPPED)
        cli_fail_input(s->input, err);
    if (status == KOKSMA_STOPPED) cli_note("%s", err->text);
}

int cli_search_progress(void *state, double lower, double upper, double work)
{
    cli_search *s = state;

    if (s->trace) trace(s, (koksma_interval){lower, upper}, work);
    return cli_watch_progress(&s->watch, lower, upper, work);
}

_Noreturn void cli_search_run(cli_search *s, int argc, char *argv[],
                              cli_measure *measure)
{
    cli_input input = cli_inputs(argc, argv, KOKSMA_POINTS);
    koksma_set set = {0};
    bool finished = true;

    if (s->trace && s->witness) cli_usage("--trace has no room for a witness");
    s->input = &input;
    while (finished && cli_read_set(&input, &set))
        finished =
            cli_each_prefix(&input, &set, s->prefix, s->prefixes, measure, s);
    koksma_set_free(&set);
    free(s->prefix);
    cli_finish(finished ? CLI_DONE : CLI_STOPPED);
}
