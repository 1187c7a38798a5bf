/* koksma-fit: the exponent of an error, with an interval, beside the theory's. */

#include <math.h>
#include <string.h>

#include "cli.h"
#include "fit.h"
#include "fit_report.h"

enum {
    FROM = CLI_LONG,
    TO,
    LEVEL,
    MARGIN,
    CLAIM,
    BETA,
    AREA,
    JUMP,
    SIGMA,
    SATURATION,
    PATH,
    EXPLAIN
};

static const cli_option options[] = {
    {'x', "column-x", "COLUMN",
     "name or number of the column of N (default N or n)"},
    {'y', "column-y", "COLUMN", "that of the error (default error, rms or upper)"},
    {'m', "model", "MODEL", "auto, power, two-terms or two-powers (default auto)"},
    {'d', "dim", "DIM", "dimension, for the theory (default: as the input says)"},
    {FROM, "from", "N", "smallest N to use (default: see the manual)"},
    {TO, "to", "N", "largest N to use (default: all)"},
    {LEVEL, "level", "P", "level of the intervals (default 0.95)"},
    {MARGIN, "margin", "M", "what counts as equivalent (default 0.05)"},
    {CLAIM, "claim", "S", "the exponent claimed (default: the theory's)"},
    {BETA, "beta", "B", "box dimension of the discontinuity, for the theory"},
    {AREA, "area", "S", "area of the discontinuity (default: as the input says)"},
    {JUMP, "jump", "J", "root mean square jump (default: as the input says)"},
    {SIGMA, "sigma", "V", "standard deviation (default: as the input says)"},
    {SATURATION, "saturation", "N",
     "where the jump's rate begins (default: as the input says)"},
    {PATH, "path", "K", "fit set K alone, without an interval"},
    {EXPLAIN, "explain", NULL, "write a paragraph for a person instead"},
    {0},
};

static const cli_tool tool = {"koksma-fit", "[FILE]...",
                              "Fit the exponent of an error that falls like N^s.",
                              options};

typedef struct fit_options {
    const char *x, *y; /* NULL: by default */
    koksma_fit_opts fit;
    fit_report report; /* what the command line says of it */
    double claim, beta;
    uint64_t path;
    bool interval;   /* asked for */
    bool saturation; /* told */
    bool explain;
} fit_options;

static koksma_fit_model read_model(const char *text)
{
    if (strcmp(text, "auto") == 0) return KOKSMA_FIT_AUTO;
    if (strcmp(text, "power") == 0) return KOKSMA_FIT_POWER;
    if (strcmp(text, "two-terms") == 0) return KOKSMA_FIT_TWO_TERMS;
    if (strcmp(text, "two-powers") == 0) return KOKSMA_FIT_TWO_POWERS;
    cli_usage("-m takes auto, power, two-terms or two-powers, not \"%s\"", text);
}

static double said(const char *about, const char *key)
{
    double v;

    return koksma_about_number(about, key, &v) ? v : nan("");
}

/* What the comments say, where the command line does not. */
static void complete(fit_report *r, const char *about)
{
    double dim = said(about, "dim");

    r->about = about;
    if (r->dim == 0 && dim >= 1.0 && dim <= 1e9) r->dim = (uint64_t)dim;
    if (isnan(r->area)) r->area = said(about, "area");
    if (isnan(r->jump)) r->jump = said(about, "jump");
    if (isnan(r->sigma)) r->sigma = said(about, "sigma");
    if (isnan(r->sigma)) r->sigma = sqrt(said(about, "variance"));
}

/* l^d, from the extent and the axes that the jump depends on, as comments have
 * them; 0 where they do not. */
static double said_saturation(const char *about)
{
    double extent = said(about, "extent"), axes = said(about, "axes");
    double n = pow(extent, isnan(axes) ? said(about, "dim") : axes);

    return n >= 0.0 ? n : 0.0;
}

/* Errors of replicates from 16 on: below that, chance zeros are many.  Halton's
 * points begin to be even at the product of the bases, where the window reaches
 * far beyond it.  Other tables as a whole. */
static double default_from(const koksma_table *t)
{
    double from = 16.0, product = 1.0, largest = 0.0, dim = said(t->about, "dim");
    char family[16] = "";

    if (!t->labelled) return 0.0;
    for (size_t i = 0; i < t->rows; i++)
        largest = fmax(largest, t->x[i]);
    if (!koksma_about_word(t->about, "points", family, sizeof family) ||
        (strcmp(family, "halton") != 0 && strcmp(family, "hammersley") != 0))
        return from;
    for (double base = 2.0; dim >= 1.0 && product <= largest; base++) {
        bool prime = true;

        for (double d = 2.0; d * d <= base && prime; d++)
            prime = fmod(base, d) > 0.0;
        if (!prime) continue;
        product *= base;
        dim--;
    }
    return product <= largest / 32.0 ? fmax(from, product) : from;
}

/* Keep the rows of one set. */
static void keep_path(koksma_table *t, uint64_t path)
{
    size_t kept = 0;

    if (path > t->sets)
        cli_fail("--path %ju: the table has %zu set%s", (uintmax_t)path, t->sets,
                 cli_plural(t->sets));
    for (size_t i = 0; i < t->rows; i++)
        if (t->set[i] == path - 1) {
            t->x[kept] = t->x[i];
            t->y[kept] = t->y[i];
            t->set[kept++] = 0;
        }
    t->rows = kept;
    t->sets = 1;
}

/* A discontinuity has at least the dimension of a surface, at most that of all. */
static void check_beta(double beta, uint64_t dim)
{
    if (dim > 0 && (beta < (double)(dim - 1) || beta > (double)dim))
        cli_usage("--beta lies between %ju and %ju in dimension %ju, not at %g",
                  (uintmax_t)(dim - 1), (uintmax_t)dim, (uintmax_t)dim, beta);
}

/* The names of a column where none is told. */
static const char names_x[] = "N|n", names_y[] = "error|rms|upper";

/* Read the table; where none of those names is there, an option says the column. */
static void read_table(koksma_table *t, const cli_input *input,
                       const fit_options *o)
{
    const char *x = o->x != NULL ? o->x : names_x;
    const char *y = o->y != NULL ? o->y : names_y;
    koksma_error err;

    if (koksma_table_read(t, input->in, x, y, &err) == KOKSMA_OK) {
        if (t->rows > 0) return;
        err = (koksma_error){.text = "no rows in it"};
    }
    if (strcmp(err.text, "no column is called N or n") == 0)
        strcat(err.text, "; say which by -x");
    if (strcmp(err.text, "no column is called error, rms or upper") == 0)
        strcat(err.text, "; say which by -y");
    cli_fail_input(input, &err);
}

static void fit_file(const cli_input *input, const fit_options *o, bool header)
{
    koksma_table t = {0};
    koksma_fit_opts opts = o->fit;
    fit_report r = o->report;
    koksma_error err;

    if (input->several) r.label = input->name != NULL ? input->name : "-";
    read_table(&t, input, o);
    r.labelled = t.labelled;
    complete(&r, t.about);
    check_beta(o->beta, r.dim);
    fit_report_candidates(&r, o->claim, o->beta);
    if (opts.from == 0.0) opts.from = default_from(&t);
    if (!koksma_about_number(t.about, "largest", &opts.scale) || opts.scale < 0.0)
        opts.scale = 0.0;
    if (!o->saturation) opts.saturation = said_saturation(t.about);
    if (o->path > 0) keep_path(&t, o->path);
    r.path = (size_t)o->path;
    if (t.sets == 1 && o->interval)
        cli_fail("one path has no interval: --level and --margin take replicates");
    if (koksma_fit(&r.fit, (koksma_fit_data){t.x, t.y, t.set, t.rows, t.sets},
                   &opts, &err))
        cli_fail_input(input, &err);
    if (o->explain) {
        fit_report_explain(&r);
    } else {
        if (header && !cli_quiet()) fit_report_header(&r);
        fit_report_row(&r);
    }
    koksma_table_free(&t);
}

int main(int argc, char *argv[])
{
    fit_options o = {.claim = nan(""), .beta = nan("")};
    fit_report *r = &o.report;
    bool header = true;
    int c;

    *r = (fit_report){
        .margin = 0.05, .area = nan(""), .jump = nan(""), .sigma = nan("")};
    while ((c = cli_next(&tool, argc, argv)) != -1)
        switch (c) {
        case 'x': o.x = optarg; break;
        case 'y': o.y = r->column = optarg; break;
        case 'm': o.fit.model = read_model(optarg); break;
        case 'd': r->dim = cli_count("-d", optarg, 1, 1000000000); break;
        case FROM: o.fit.from = cli_real("--from", optarg, 1e-300, 1e300); break;
        case TO: o.fit.to = cli_real("--to", optarg, 1e-300, 1e300); break;
        case LEVEL:
            o.fit.level = cli_real("--level", optarg, 0.5, 0.999999);
            o.interval = true;
            break;
        case MARGIN:
            r->margin = cli_real("--margin", optarg, 1e-9, 10.0);
            o.interval = true;
            break;
        case CLAIM: o.claim = cli_real("--claim", optarg, -100.0, 100.0); break;
        case BETA: o.beta = cli_real("--beta", optarg, 0.0, 1e9); break;
        case AREA: r->area = cli_real("--area", optarg, 0.0, 1e300); break;
        case JUMP: r->jump = cli_real("--jump", optarg, 0.0, 1e300); break;
        case SIGMA: r->sigma = cli_real("--sigma", optarg, 1e-300, 1e300); break;
        case SATURATION:
            o.fit.saturation = cli_real("--saturation", optarg, 0.0, 1e300);
            o.saturation = true;
            break;
        case PATH: o.path = cli_count("--path", optarg, 1, SIZE_MAX); break;
        case EXPLAIN: o.explain = true; break;
        }
    check_beta(o.beta, r->dim);

    cli_input input = cli_inputs(argc, argv, KOKSMA_VALUES);

    for (; cli_next_file(&input); header = false)
        fit_file(&input, &o, header);
    cli_finish(CLI_DONE);
}
