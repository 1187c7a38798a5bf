/* koksma-eval: an integrand's values at the points of each set. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "cli_integrand.h"

enum { NPY = CLI_LONG, HEX, LIST, BOUNCES, ALBEDO, CAP, PIECE };

static const cli_option options[] = {
    {'a', "parameter", "NAME=V", "a parameter of the integrand; V: the first"},
    {'d', "dim", "DIM", "the dimension (default: the points')"},
    {BOUNCES, "bounces", "N", "steps of a walk in the scene, two coordinates each"},
    {ALBEDO, "albedo", "V", "as -a albedo=V: the share that a bounce keeps"},
    {CAP, "cap", "V", "as -a cap=V: the light's share of the sphere"},
    {PIECE, "piece", "PART", "of the integrand alone: smooth or jump"},
    {NPY, "npy", NULL, "write NumPy arrays"},
    {HEX, "hex", NULL, "write hexadecimal numbers"},
    {LIST, "list", NULL, "list what is known of the integrand, or of all"},
    {0},
};

static const cli_tool tool = {"koksma-eval", "INTEGRAND [FILE]...",
                              "Append an integrand's value to each point.",
                              options};

enum { BLOCK = 4096, HITS_LEAST = 10 };

/* An integrand and where its values go. */
typedef struct job {
    const koksma_integrand_row *row;
    koksma_integrand f;
    koksma_facts facts;
    const char *part; /* NULL: the whole integrand */
    koksma_form form;
    double *x, *rows, *values;
    size_t walks, hits; /* of the current set */
    size_t sets, poor;  /* sets, and those with less than HITS_LEAST hits */
    size_t worst_hits, worst_walks;
} job;

/* The part of f that is called so; all of it if part is NULL. */
static void take_part(koksma_integrand *f, koksma_facts *facts,
                      const koksma_integrand_row *row, const char *part)
{
    if (part == NULL) return;
    koksma_integrand_split(f, facts, row,
                           part[0] == 's' ? KOKSMA_PART_SMOOTH : KOKSMA_PART_JUMP);
}

static const char *read_part(const char *text)
{
    if (strcmp(text, "smooth") != 0 && strcmp(text, "jump") != 0)
        cli_usage("--piece takes smooth or jump, not \"%s\"", text);
    return text;
}

/* ---- --list ------------------------------------------------------------------ */

static void list_row(const koksma_integrand_row *row, size_t dim,
                     const double *param, const char *part)
{
    koksma_integrand f;
    koksma_facts k;

    if (koksma_integrand_make(&f, &k, row, dim, param, NULL)) return;
    take_part(&f, &k, row, part);

    const double known[] = {k.integral, k.error,  k.variance, k.jump,
                            k.jump_rms, k.area,   k.extent,   k.axes,
                            k.box_dim,  k.pieces, k.variation};

    printf("%s\t%zu\t", row->name, f.dim);
    if (koksma_integrand_params(row) == 0) putchar('-');
    for (size_t i = 0; i < koksma_integrand_params(row); i++) {
        printf("%s%s=", i > 0 ? "," : "", row->params[i].name);
        cli_number(f.param[i]);
    }
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        putchar('\t');
        cli_number(known[i]);
    }
    printf("\t%s\n", row->summary);
}

_Noreturn static void list_integrands(const cli_integrand *r, const char *part)
{
    if (!cli_quiet())
        puts("# integrand\tdim\tparameters\tintegral\terror\tvariance\tjump\t"
             "jump_rms\tarea\textent\taxes\tbox_dim\tpieces\tvariation\tsummary");
    if (r->row != NULL) {
        list_row(r->row, r->dim, r->param, part);
        cli_finish(CLI_DONE);
    }
    for (size_t i = 0; koksma_integrands[i] != NULL; i++)
        list_row(koksma_integrands[i], r->dim, NULL, part);
    for (size_t i = 0; koksma_scenes[i] != NULL; i++)
        list_row(koksma_scenes[i], r->dim, NULL, part);
    cli_finish(CLI_DONE);
}

/* ---- Values ------------------------------------------------------------------ */

static void print_key(const char *key, double v)
{
    if (!isfinite(v)) return;
    printf(" %s=", key);
    cli_number(v);
}

/* What is known of the values: the tools further down need not be told. */
static void print_comment(const job *j, const char *about)
{
    char which[CLI_ABOUT_SIZE];

    if (cli_quiet()) return;
    cli_integrand_about(which, j->row, &j->f, j->part);
    printf("# koksma:%s %s", about, which);
    print_key("exact", j->facts.integral);
    if (cli_integrand_walks(j->row, j->part))
        print_key("neumann", koksma_scene_neumann(&j->f));
    print_key("variance", j->facts.variance);
    if (j->facts.jump > 0.0) {
        print_key("area", j->facts.area);
        print_key("jump", j->facts.jump_rms);
        print_key("extent", j->facts.extent);
        if (j->facts.axes != (double)j->f.dim) print_key("axes", j->facts.axes);
    }
    fputs("\n# ", stdout);
    for (size_t k = 0; k < j->f.dim; k++)
        printf("x%zu\t", k + 1);
    puts(j->row->name);
}

/* Write one block of rows: the points, each with its value behind it. */
static void write_block(job *j, const cli_input *input, const double *x,
                        size_t count)
{
    size_t dim = j->f.dim;
    koksma_error err;

    if (koksma_integrand_eval(j->values, &j->f, (koksma_points){x, count, dim},
                              &err))
        cli_fail_input(input, &err);
    for (size_t i = 0; i < count; i++) {
        memcpy(j->rows + i * (dim + 1), x + i * dim, dim * sizeof *x);
        j->rows[i * (dim + 1) + dim] = j->values[i];
        j->hits += j->values[i] != 0.0;
    }
    j->walks += count;
    if (koksma_write_rows(stdout, j->rows, count, dim + 1, j->form, &err))
        cli_fail_as(&err);
}

/* Text flows through block by block; an array's header wants its length first. */
static void eval_set(job *j, cli_input *input)
{
    koksma_set set = {0};
    koksma_error err;
    size_t got = 1;

    if (j->form == KOKSMA_NPY) {
        if (koksma_set_read(&set, input->reader, &err)) cli_fail_input(input, &err);
        if (koksma_write_npy_header(stdout, set.n, j->f.dim + 1, &err))
            cli_fail_as(&err);
        for (size_t i = 0; i < set.n; i += got) {
            got = set.n - i < BLOCK ? set.n - i : BLOCK;
            write_block(j, input, set.x + i * j->f.dim, got);
        }
        koksma_set_free(&set);
        return;
    }
    while (got > 0) {
        if (koksma_reader_rows(input->reader, j->x, BLOCK, &got, &err))
            cli_fail_input(input, &err);
        if (got > 0) write_block(j, input, j->x, got);
    }
}

/* ---- Scenes of which too little is seen -------------------------------------- */

static void count_hits(job *j)
{
    if (j->hits < HITS_LEAST && (j->poor == 0 || j->hits < j->worst_hits)) {
        j->worst_hits = j->hits;
        j->worst_walks = j->walks;
    }
    j->poor += j->hits < HITS_LEAST;
    j->sets++;
    j->hits = j->walks = 0;
}

static void note_poor_sets(const job *j)
{
    if (j->poor == 0 || !cli_integrand_walks(j->row, j->part)) return;
    if (j->sets == 1)
        cli_note("under-resolved: %zu of %zu walks hit", j->worst_hits,
                 j->worst_walks);
    else
        cli_note(
            "under-resolved: %zu of %zu sets have fewer than %d hits; in one of "
            "them %zu of %zu walks hit",
            j->poor, j->sets, HITS_LEAST, j->worst_hits, j->worst_walks);
}

/* ---- The tool ---------------------------------------------------------------- */

/* The points say the dimension, unless it was told. */
static void begin(job *j, const cli_integrand *r, const cli_input *input,
                  size_t columns)
{
    size_t dim = r->dim > 0 ? r->dim : columns;
    koksma_error err;

    if (dim != columns)
        cli_fail("set %s has %zu coordinate%s a point, but %s takes %zu",
                 input->label, columns, cli_plural(columns), r->row->name, dim);
    if (koksma_integrand_make(&j->f, &j->facts, r->row, dim, r->param, &err))
        cli_fail("set %s has %s", input->label, err.text);
    take_part(&j->f, &j->facts, r->row, j->part);
    j->row = r->row;
    j->x = malloc(BLOCK * dim * sizeof *j->x);
    j->rows = malloc(BLOCK * (dim + 1) * sizeof *j->rows);
    j->values = malloc(BLOCK * sizeof *j->values);
    if (j->x == NULL || j->rows == NULL || j->values == NULL)
        cli_fail("not enough memory");
}

static void eval_inputs(const cli_integrand *r, const char *part, cli_input *input,
                        koksma_form form)
{
    job j = {.form = form, .part = part};
    size_t columns;

    while (cli_next_set(input, &columns)) {
        if (j.sets == 0) {
            begin(&j, r, input, columns);
            if (form != KOKSMA_NPY)
                print_comment(&j, koksma_reader_about(input->reader));
        } else if (columns != j.f.dim) {
            cli_fail("set %s has %zu coordinate%s a point, but the first set %zu",
                     input->label, columns, cli_plural(columns), j.f.dim);
        } else if (form != KOKSMA_NPY) {
            putchar('\n');
        }
        eval_set(&j, input);
        count_hits(&j);
    }
    free(j.x);
    free(j.rows);
    free(j.values);
    note_poor_sets(&j);
}

int main(int argc, char *argv[])
{
    koksma_form form = KOKSMA_DECIMAL;
    cli_integrand r = {0};
    const char *part = NULL;
    bool list = false;
    koksma_integrand f;
    koksma_error err;
    int c;

    while ((c = cli_next(&tool, argc, argv)) != -1)
        switch (c) {
        case 'a': cli_integrand_set(&r, "-a", NULL); break;
        case 'd': r.dim = cli_count("-d", optarg, 1, 10000); break;
        case BOUNCES: r.bounces = cli_count("--bounces", optarg, 1, 1000); break;
        case ALBEDO: cli_integrand_set(&r, "--albedo", "albedo"); break;
        case CAP: cli_integrand_set(&r, "--cap", "cap"); break;
        case PIECE: part = read_part(optarg); break;
        case NPY: form = KOKSMA_NPY; break;
        case HEX: form = KOKSMA_HEX; break;
        case LIST: list = true; break;
        }
    if (optind < argc) {
        cli_integrand_choose(&r, argv[optind++]);
        if (koksma_integrand_make(&f, NULL, r.row, r.dim, r.param, &err))
            cli_usage("%s", err.text);
    } else if (!list || r.count > 0) {
        cli_usage("name an integrand; --list lists them");
    }
    if (list) list_integrands(&r, part);

    cli_input input = cli_inputs(argc, argv, KOKSMA_POINTS);

    eval_inputs(&r, part, &input, form);
    cli_finish(CLI_DONE);
}
