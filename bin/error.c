/* koksma-error: the running integration error of each set of values. */

#include <stdlib.h>

#include "cli.h"
#include "curve.h"

enum { EXACT = CLI_LONG, STEPS, SUMMARY };

static const cli_option options[] = {
    {'d', "dim", "DIM", "the integrand's dimension, told to koksma-fit"},
    {EXACT, "exact", "VALUE", "the exact integral (default: as the input says)"},
    {STEPS, "steps", "K", "N's to the octave (default 2)"},
    {SUMMARY, "summary", NULL, "root mean squares over the sets instead"},
    {0},
};

static const cli_tool tool = {
    "koksma-error", "[FILE]...",
    "Write the running integration error of each set of values.", options};

enum { BLOCK = 4096 };

/* What --summary keeps: error[r*count + j] is that of set r at n[j]. */
typedef struct curves {
    double *error;
    uint64_t *n;
    size_t count, sets;
} curves;

/* What is known of the values goes on to koksma-fit, with what was told here. */
typedef struct header {
    char about[512];
    double exact;
    uint64_t dim;
    bool told; /* exact, on the command line */
} header;

static void print_header(const header *h, const char *columns)
{
    if (cli_quiet()) return;
    printf("# koksma:%s", h->about);
    if (h->dim > 0) printf(" dim=%ju", (uintmax_t)h->dim);
    if (h->told) {
        fputs(" exact=", stdout);
        cli_number(h->exact);
    }
    printf("\n# %s\n", columns);
}

static void print_rows(const char *label, const koksma_curve_row *rows,
                       size_t count)
{
    for (size_t j = 0; j < count; j++) {
        printf("%s\t%ju\t", label, (uintmax_t)rows[j].n);
        cli_number(rows[j].error);
        putchar('\t');
        cli_number(rows[j].tail);
        putchar('\n');
    }
}

static void keep_rows(curves *c, const char *label, const koksma_curve_row *rows,
                      size_t count)
{
    size_t room = (c->sets + 1) * count * sizeof *c->error;

    if (c->sets > 0 && (count != c->count || rows[count - 1].n != c->n[count - 1]))
        cli_fail(
            "set %s has %ju values, the first set %ju: --summary takes equal ones",
            label, (uintmax_t)rows[count - 1].n, (uintmax_t)c->n[c->count - 1]);
    c->error = realloc(c->error, room);
    if (c->sets == 0) c->n = malloc(count * sizeof *c->n);
    if (c->error == NULL || c->n == NULL)
        cli_fail("not enough memory for the summary");
    for (size_t j = 0; j < count; j++) {
        c->n[j] = rows[j].n;
        c->error[c->sets * count + j] = rows[j].error;
    }
    c->count = count;
    c->sets++;
}

static void print_summary(const curves *c)
{
    double *column = malloc(c->sets * sizeof *column);

    if (column == NULL) cli_fail("not enough memory for the summary");
    for (size_t j = 0; j < c->count; j++) {
        for (size_t r = 0; r < c->sets; r++)
            column[r] = c->error[r * c->count + j];

        koksma_estimate rms = koksma_curve_rms(column, c->sets, 0.95);

        printf("%ju\t", (uintmax_t)c->n[j]);
        cli_number(rms.value);
        putchar('\t');
        cli_number(rms.lower);
        putchar('\t');
        cli_number(rms.upper);
        printf("\t%zu\n", c->sets);
    }
    free(column);
}

/* Read the set's values into the curve. */
static void read_curve(koksma_curve *curve, cli_input *input, size_t columns,
                       double exact)
{
    double *rows = malloc(BLOCK * columns * sizeof *rows);
    koksma_error err;
    size_t got = 1;

    if (rows == NULL) cli_fail("not enough memory for %zu columns", columns);
    koksma_curve_begin(curve, exact);
    while (got > 0) {
        if (koksma_reader_rows(input->reader, rows, BLOCK, &got, &err))
            cli_fail_input(input, &err);
        koksma_curve_add(curve, rows + columns - 1, columns, got);
    }
    free(rows);
}

int main(int argc, char *argv[])
{
    bool summary = false, first = true;
    header h = {.about = ""};
    uint64_t steps = 2;
    curves all = {0};
    size_t columns;
    int c;

    while ((c = cli_next(&tool, argc, argv)) != -1)
        switch (c) {
        case 'd': h.dim = cli_count("-d", optarg, 1, SIZE_MAX); break;
        case EXACT:
            h.exact = cli_real("--exact", optarg, -1e300, 1e300);
            h.told = true;
            break;
        case STEPS: steps = cli_count("--steps", optarg, 1, 64); break;
        case SUMMARY: summary = true; break;
        }

    cli_input input = cli_inputs(argc, argv, KOKSMA_VALUES);
    koksma_curve *curve;
    koksma_error err;

    if (koksma_curve_open(&curve, (unsigned)steps, &err)) cli_fail_as(&err);
    for (; cli_next_set(&input, &columns); first = false) {
        const koksma_curve_row *rows;
        size_t count;

        snprintf(h.about, sizeof h.about, "%s", koksma_reader_about(input.reader));
        if (!h.told && !koksma_about_number(h.about, "exact", &h.exact))
            cli_fail(
                "the input does not say the exact integral: give --exact VALUE");
        read_curve(curve, &input, columns, h.exact);
        if (koksma_curve_rows(curve, &rows, &count, &err))
            cli_fail_input(&input, &err);
        if (first && !summary) print_header(&h, "set\tN\terror\ttail");
        if (summary)
            keep_rows(&all, input.label, rows, count);
        else
            print_rows(input.label, rows, count);
    }
    if (summary) {
        print_header(&h, "N\trms\tlower\tupper\tsets");
        print_summary(&all);
    }
    free(all.error);
    free(all.n);
    koksma_curve_close(curve);
    cli_finish(CLI_DONE);
}
