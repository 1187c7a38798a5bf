/* koksma-eval: an integrand's values at the points of each set. */

#include <stdlib.h>

#include "cli.h"
#include "integrand.h"

enum { NPY = CLI_LONG, HEX, LIST };

static const cli_option options[] = {
    {'a', "parameter", "A", "the integrand's parameter (default 0)"},
    {NPY, "npy", NULL, "write NumPy arrays"},
    {HEX, "hex", NULL, "write hexadecimal numbers"},
    {LIST, "list", NULL, "list the integrands"},
    {0},
};

static const cli_tool tool = {"koksma-eval", "INTEGRAND [FILE]...",
                              "Append an integrand's value to each point.",
                              options};

enum { BLOCK = 4096 };

static void list_integrands(void)
{
    if (!cli_quiet()) puts("# integrand\tdim\ta_most\tintegral\tsummary");
    for (const koksma_integrand *f = koksma_integrands; f->name != NULL; f++)
        printf("%s\t%zu\t%.17g\t%.17g\t%s\n", f->name, f->dim, f->a_most,
               f->integral, f->summary);
    cli_finish(CLI_DONE);
}

/* What is known of the values: the tools further down need not be told. */
static void print_comment(const koksma_integrand *f, double a, const char *about)
{
    if (cli_quiet()) return;
    printf("# koksma:%s integrand=%s dim=%zu a=", about, f->name, f->dim);
    cli_number(a);
    fputs(" exact=", stdout);
    cli_number(f->integral);
    fputs("\n# ", stdout);
    for (size_t k = 0; k < f->dim; k++)
        printf("x%zu\t", k + 1);
    puts(f->name);
}

/* Write one block of rows: the points, each with its value behind it. */
static void write_block(const koksma_integrand *f, double a, const cli_input *input,
                        const double *x, size_t count, double *rows,
                        koksma_form form)
{
    double values[BLOCK];
    koksma_error err;

    if (koksma_integrand_eval(values, f, a, (koksma_points){x, count, f->dim},
                              &err))
        cli_fail_input(input, &err);
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < f->dim; k++)
            rows[i * (f->dim + 1) + k] = x[i * f->dim + k];
        rows[i * (f->dim + 1) + f->dim] = values[i];
    }
    if (koksma_write_rows(stdout, rows, count, f->dim + 1, form, &err))
        cli_fail_as(&err);
}

/* Text flows through block by block; an array's header wants its length first. */
static void eval_set(const koksma_integrand *f, double a, cli_input *input,
                     koksma_form form, double *x, double *rows)
{
    koksma_set set = {0};
    koksma_error err;
    size_t got = 1;

    if (form == KOKSMA_NPY) {
        if (koksma_set_read(&set, input->reader, &err)) cli_fail_input(input, &err);
        if (koksma_write_npy_header(stdout, set.n, f->dim + 1, &err))
            cli_fail_as(&err);
        for (size_t i = 0; i < set.n; i += got) {
            got = set.n - i < BLOCK ? set.n - i : BLOCK;
            write_block(f, a, input, set.x + i * f->dim, got, rows, form);
        }
        koksma_set_free(&set);
        return;
    }
    while (got > 0) {
        if (koksma_reader_rows(input->reader, x, BLOCK, &got, &err))
            cli_fail_input(input, &err);
        if (got > 0) write_block(f, a, input, x, got, rows, form);
    }
}

int main(int argc, char *argv[])
{
    koksma_form form = KOKSMA_DECIMAL;
    bool started = false;
    size_t columns;
    double a = 0.0;
    int c;

    while ((c = cli_next(&tool, argc, argv)) != -1)
        switch (c) {
        case 'a': a = cli_real("-a", optarg, 0.0, 1.0); break;
        case NPY: form = KOKSMA_NPY; break;
        case HEX: form = KOKSMA_HEX; break;
        case LIST: list_integrands();
        }
    if (optind == argc) cli_usage("name an integrand; --list lists them");

    const koksma_integrand *f = koksma_integrand_find(argv[optind]);

    if (f == NULL)
        cli_usage("no integrand is called \"%s\"; --list lists them", argv[optind]);
    if (a > f->a_most)
        cli_usage("%s has a from 0 to %g, not %g", f->name, f->a_most, a);
    optind++;

    cli_input input = cli_inputs(argc, argv, KOKSMA_POINTS);
    double *x = malloc(BLOCK * f->dim * sizeof *x);
    double *rows = malloc(BLOCK * (f->dim + 1) * sizeof *rows);

    if (x == NULL || rows == NULL) cli_fail("not enough memory");
    for (; cli_next_set(&input, &columns); started = true) {
        if (columns != f->dim)
            cli_fail("set %s has %zu coordinates a point, but %s takes %zu",
                     input.label, columns, f->name, f->dim);
        if (form != KOKSMA_NPY && started) putchar('\n');
        if (form != KOKSMA_NPY && !started)
            print_comment(f, a, koksma_reader_about(input.reader));
        eval_set(f, a, &input, form, x, rows);
    }
    free(x);
    free(rows);
    cli_finish(CLI_DONE);
}
