/* koksma-fit: the exponent of an error, with an interval, beside the theory's. */

#include <math.h>
#include <string.h>

#include "cli.h"
#include "fit.h"

enum { FROM = CLI_LONG, TO, LEVEL, MARGIN, EXPLAIN };

static const cli_option options[] = {
    {'x', "column-x", "COLUMN", "name or number of the column of N (default N)"},
    {'y', "column-y", "COLUMN",
     "name or number of the error's column (default error)"},
    {'d', "dim", "DIM", "dimension, for the theory (default: as the input says)"},
    {FROM, "from", "N", "smallest N to use (default 8)"},
    {TO, "to", "N", "largest N to use (default: all)"},
    {LEVEL, "level", "P", "level of the intervals (default 0.95)"},
    {MARGIN, "margin", "M", "what counts as equivalent (default 0.05)"},
    {EXPLAIN, "explain", NULL, "write a paragraph for a person instead"},
    {0},
};

static const cli_tool tool = {"koksma-fit", "[FILE]...",
                              "Fit the exponent of an error that falls like N^s.",
                              options};

typedef struct fit_options {
    const char *x, *y;
    uint64_t dim; /* 0: as the input says */
    koksma_fit_opts fit;
    double margin;
    bool explain;
} fit_options;

/* The exponents that a fit is held against. */
typedef struct candidate {
    const char *name;
    double exponent;
} candidate;

enum { CANDIDATES_MOST = 3 };

static size_t list_candidates(candidate *c, uint64_t dim)
{
    size_t count = 0;

    if (dim > 0)
        c[count++] = (candidate){"-(D+1)/2D", koksma_fit_theory((size_t)dim)};
    c[count++] = (candidate){"-1/2", -0.5};
    if (dim != 1) c[count++] = (candidate){"-1", -1.0};
    return count;
}

static const char *verdict_word(koksma_verdict verdict)
{
    switch (verdict) {
    case KOKSMA_EQUIVALENT: return "equivalent";
    case KOKSMA_DIFFERENT: return "different";
    case KOKSMA_UNDECIDED: return "undecided";
    case KOKSMA_NO_VERDICT: break;
    }
    return "none";
}

static void print_row(const char *label, const char *name, double value,
                      double lower, double upper, double t, const char *verdict)
{
    if (label != NULL) printf("%s\t", label);
    printf("%s\t", name);
    cli_number(value);
    putchar('\t');
    cli_number(lower);
    putchar('\t');
    cli_number(upper);
    putchar('\t');
    cli_number(t);
    printf("\t%s\n", verdict);
}

/* A bend shows when its t exceeds 2.6: about one power law in a hundred. */
static const char *bend_word(const koksma_fit_result *f)
{
    double t = f->curvature.value / f->curvature_se;

    if (isnan(t)) return "none";
    return fabs(t) <= 2.6 ? "straight" : t > 0.0 ? "flattens" : "steepens";
}

static void print_table(const koksma_fit_result *f, const fit_options *o,
                        const char *label, uint64_t dim)
{
    candidate c[CANDIDATES_MOST];
    size_t count = list_candidates(c, dim);
    koksma_estimate s = f->exponent, q = f->curvature;

    print_row(label, "exponent", s.value, s.lower, s.upper, nan(""), "measured");
    for (size_t i = 0; i < count; i++) {
        koksma_comparison v = koksma_fit_compare(f, c[i].exponent, o->margin);

        print_row(label, c[i].name, c[i].exponent, c[i].exponent - o->margin,
                  c[i].exponent + o->margin, v.t, verdict_word(v.verdict));
    }
    print_row(label, "curvature", q.value, q.lower, q.upper,
              q.value / f->curvature_se, bend_word(f));
}

static void explain_verdict(const koksma_fit_result *f, const candidate *c,
                            double margin)
{
    switch (koksma_fit_compare(f, c->exponent, margin).verdict) {
    case KOKSMA_EQUIVALENT:
        printf("It is equivalent to %s = %.4g: within %g of it, at 5 %%.\n",
               c->name, c->exponent, margin);
        break;
    case KOKSMA_DIFFERENT:
        printf("It differs from %s = %.4g, which the interval excludes.\n", c->name,
               c->exponent);
        break;
    case KOKSMA_UNDECIDED:
        printf("It agrees with %s = %.4g, but is too wide to be called equivalent\n"
               "within %g.\n",
               c->name, c->exponent, margin);
        break;
    case KOKSMA_NO_VERDICT: break;
    }
}

static void explain(const koksma_fit_result *f, const fit_options *o,
                    const char *label, uint64_t dim)
{
    candidate c[CANDIDATES_MOST];
    size_t count = list_candidates(c, dim);
    const char *bend = bend_word(f);

    if (label != NULL) printf("%s: ", label);
    printf("From N = %g to %g %s %s goes like %.3g N^s with s = %.4f.\n", f->from,
           f->to, strcmp(o->y, "error") == 0 ? "the" : "column", o->y, f->constant,
           f->exponent.value);
    if (f->sets == 1) {
        puts("This is one path: its errors hang together, and no honest interval "
             "can be had\n"
             "from it.  Replicates give one: koksma-points --scramble digits "
             "--replicates 32.");
        return;
    }
    printf("The %g %% interval from %zu replicates is [%.4f, %.4f].\n",
           100.0 * f->exponent.level, f->sets, f->exponent.lower,
           f->exponent.upper);
    for (size_t i = 0; i < count; i++)
        explain_verdict(f, &c[i], o->margin);
    if (strcmp(bend, "straight") != 0)
        printf("The line is not straight: it %s towards large N, so that one\n"
               "exponent does not say all.\n",
               bend);
}

static void fit_file(const cli_input *input, const fit_options *o, bool header)
{
    koksma_table table = {0};
    koksma_fit_result f;
    koksma_error err;
    uint64_t dim = o->dim;
    double said = 0.0;
    const char *label =
        input->several ? input->name != NULL ? input->name : "-" : NULL;

    if (koksma_table_read(&table, input->in, o->x, o->y, &err))
        cli_fail_input(input, &err);
    if (dim == 0 && koksma_about_number(table.about, "dim", &said) && said >= 1.0 &&
        said <= 1e9)
        dim = (uint64_t)said;
    if (koksma_fit(
            &f,
            (koksma_fit_data){table.x, table.y, table.set, table.rows, table.sets},
            &o->fit, &err))
        cli_fail_input(input, &err);
    if (o->explain) {
        explain(&f, o, label, dim);
    } else {
        if (header && !cli_quiet())
            printf("# koksma:%s sets=%zu used=%zu dropped=%zu from=%g to=%g "
                   "constant=%g\n"
                   "# %squantity\tvalue\tlower\tupper\tt\tverdict\n",
                   table.about, f.sets, f.used, f.dropped, f.from, f.to, f.constant,
                   label != NULL ? "file\t" : "");
        print_table(&f, o, label, dim);
    }
    koksma_table_free(&table);
}

int main(int argc, char *argv[])
{
    fit_options o = {.x = "N", .y = "error", .margin = 0.05};
    bool header = true;
    int c;

    while ((c = cli_next(&tool, argc, argv)) != -1)
        switch (c) {
        case 'x': o.x = optarg; break;
        case 'y': o.y = optarg; break;
        case 'd': o.dim = cli_count("-d", optarg, 1, 1000000000); break;
        case FROM: o.fit.from = cli_real("--from", optarg, 1e-300, 1e300); break;
        case TO: o.fit.to = cli_real("--to", optarg, 1e-300, 1e300); break;
        case LEVEL: o.fit.level = cli_real("--level", optarg, 0.5, 0.999999); break;
        case MARGIN: o.margin = cli_real("--margin", optarg, 1e-9, 10.0); break;
        case EXPLAIN: o.explain = true; break;
        }

    cli_input input = cli_inputs(argc, argv, KOKSMA_VALUES);

    for (; cli_next_file(&input); header = false)
        fit_file(&input, &o, header);
    cli_finish(CLI_DONE);
}
