/* koksma-error: the running integration error of each set of values. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "curve.h"
#include "error_report.h"

enum { EXACT = CLI_LONG, STEPS, PREFIXES, SUMMARY };

static const cli_option options[] = {
    {'d', "dim", "DIM", "the integrand's dimension, told to koksma-fit"},
    {EXACT, "exact", "VALUE",
     "the exact integral, or mean (default: as input says)"},
    {STEPS, "steps", "K", "N's to the octave (default 2)"},
    {PREFIXES, "prefixes", "A:B|N,N,...",
     "these N alone (default: from 1 to the end)"},
    {SUMMARY, "summary", NULL, "root mean squares over the sets instead"},
    {0},
};

static const cli_tool tool = {
    "koksma-error", "[FILE]...",
    "Write the running integration error of each set of values.", options};

enum { BLOCK = 4096 };

typedef struct error_options {
    bool told, mean, summary; /* told: the integral */
    uint64_t steps;
    const char *prefixes;
} error_options;

/* What all values so far have added up to. */
typedef struct totals {
    uint64_t n;
    double error, square, largest; /* means of deviations and of their squares */
} totals;

static void add_total(totals *t, koksma_curve_total c)
{
    double share = (double)c.n / (double)(t->n + c.n);

    t->n += c.n;
    t->error += share * (c.error - t->error);
    t->square += share * (c.square - t->square);
    t->largest = fmax(t->largest, c.largest);
}

/* What the input says that the values are of; exact and variance: nan if it does
 * not. */
typedef struct subject {
    char integrand[64];
    double exact, variance;
} subject;

static subject subject_of(const char *about)
{
    subject s = {"", nan(""), nan("")};

    koksma_about_word(about, "integrand", s.integrand, sizeof s.integrand);
    koksma_about_number(about, "exact", &s.exact);
    koksma_about_number(about, "variance", &s.variance);
    return s;
}

static bool differ(double x, double y) { return x != y && !(isnan(x) && isnan(y)); }

/* The header speaks of one integrand, and so does its sigma. */
static void check_subject(subject first, const error_header *h, const char *label)
{
    subject s = subject_of(h->about);

    if (strcmp(s.integrand, first.integrand) != 0 || differ(s.exact, first.exact) ||
        differ(s.variance, first.variance))
        cli_fail("set %s is of another integrand than the first; a table is of one",
                 label);
}

/* The integral, if it is the input that says it. */
static void read_exact(error_header *h)
{
    if (!koksma_about_number(h->about, "exact", &h->exact))
        cli_fail("the input does not say the exact integral: give --exact VALUE");
    if (!isfinite(h->exact))
        cli_fail("the input says exact=%g, which is no finite number", h->exact);
}

/* Read the set's values into the curve.  The mean will be measured from the first
 * value there is. */
static void read_curve(koksma_curve *curve, cli_input *input, size_t columns,
                       double *exact, bool unknown)
{
    double *rows = malloc(BLOCK * columns * sizeof *rows);
    koksma_error err;
    size_t got = 1;

    if (rows == NULL) cli_fail("not enough memory for %zu columns", columns);
    for (bool begun = false; got > 0; begun = true) {
        if (koksma_reader_rows(input->reader, rows, BLOCK, &got, &err))
            cli_fail_input(input, &err);
        if (!begun && unknown && got > 0) *exact = rows[columns - 1];
        if (!begun) koksma_curve_begin(curve, *exact);
        koksma_curve_add(curve, rows + columns - 1, columns, got);
    }
    free(rows);
}

/* The standard deviation of one value: what the input says, or else what its values
 * show, about the integral.  Returns the header, completed. */
static error_header complete(error_header h, const totals *t)
{
    double variance;

    h.largest = t->largest;
    h.sigma_from = "variance";
    if (koksma_about_number(h.about, "variance", &variance) && variance >= 0.0) {
        h.sigma = sqrt(variance);
    } else {
        h.sigma_from = "values";
        h.sigma = sqrt(t->square);
    }
    if (!isfinite(h.sigma)) h.sigma = nan("");
    return h;
}

/* Measure what was kept from the mean of all values. */
static void take_mean(error_sets *all, error_header *h, totals *t)
{
    if (all->count < 2)
        cli_fail("--exact mean takes replicates: the error of one set from its own "
                 "mean ends at 0");
    error_sets_shift(all, t->error);
    h->exact += t->error;
    t->square = fmax(t->square - t->error * t->error, 0.0);
}

static koksma_curve *open_curve(const error_options *o, uint64_t *last)
{
    koksma_curve *curve = NULL;
    koksma_error err;
    uint64_t *n;
    size_t count;

    *last = 0;
    if (o->prefixes == NULL) {
        if (koksma_curve_open(&curve, (unsigned)o->steps, &err)) cli_fail_as(&err);
        return curve;
    }
    count = cli_prefixes(&n, "--prefixes", o->prefixes, (unsigned)o->steps);
    if (koksma_curve_open_at(&curve, n, count, &err)) cli_fail_as(&err);
    *last = n[count - 1];
    free(n);
    return curve;
}

static void run(cli_input *input, const error_options *o, error_header h)
{
    static const char columns_of_rows[] = "set\tN\terror\ttail\tmc";
    error_sets all = {0};
    totals t = {0};
    subject of = {0};
    uint64_t last;
    koksma_curve *curve = open_curve(o, &last);
    bool keep = o->summary || o->mean;
    size_t columns;

    for (bool first = true; cli_next_set(input, &columns); first = false) {
        const koksma_curve_row *rows;
        koksma_error err;
        size_t count;

        snprintf(h.about, sizeof h.about, "%s", koksma_reader_about(input->reader));
        if (first) of = subject_of(h.about);
        check_subject(of, &h, input->label);
        if (!o->told && !o->mean) read_exact(&h);
        read_curve(curve, input, columns, &h.exact, o->mean && first);
        if (koksma_curve_rows(curve, &rows, &count, &err))
            cli_fail_input(input, &err);

        koksma_curve_total total = koksma_curve_so_far(curve);

        if (total.n < last)
            cli_fail("set %s has %ju values, and --prefixes asks for %ju",
                     input->label, (uintmax_t)total.n, (uintmax_t)last);
        if (first || keep) add_total(&t, total);
        if (first && !keep) {
            h = complete(h, &t);
            error_print_header(&h, columns_of_rows);
        }
        if (keep)
            error_sets_keep(&all, input->label, rows, count, total.n);
        else
            error_print_rows(input->label, rows, count, h.sigma);
    }
    if (o->mean) take_mean(&all, &h, &t);
    if (o->summary) error_sets_check_equal(&all);
    if (keep) h = complete(h, &t);
    if (keep)
        error_print_header(&h, o->summary ? "N\trms\tlower\tupper\tsets\tmc"
                                          : columns_of_rows);
    if (o->summary) error_print_summary(&all, h.sigma);
    for (size_t r = 0; r < all.count && !o->summary; r++)
        error_print_rows(all.set[r].label, all.set[r].rows, all.set[r].count,
                         h.sigma);
    error_sets_free(&all);
    koksma_curve_close(curve);
}

int main(int argc, char *argv[])
{
    error_options o = {.steps = 2};
    error_header h = {.about = ""};
    int c;

    while ((c = cli_next(&tool, argc, argv)) != -1)
        switch (c) {
        case 'd': h.dim = cli_count("-d", optarg, 1, SIZE_MAX); break;
        case EXACT:
            o.mean = strcmp(optarg, "mean") == 0;
            o.told = !o.mean;
            if (o.told) h.exact = cli_real("--exact", optarg, -1e300, 1e300);
            h.exact_from = o.mean ? "mean" : "told";
            break;
        case STEPS: o.steps = cli_count("--steps", optarg, 1, 64); break;
        case PREFIXES: o.prefixes = optarg; break;
        case SUMMARY: o.summary = true; break;
        }

    cli_input input = cli_inputs(argc, argv, KOKSMA_VALUES);

    run(&input, &o, h);
    cli_finish(CLI_DONE);
}
