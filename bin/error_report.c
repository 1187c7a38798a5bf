#include "error_report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"

void error_sets_keep(error_sets *s, const char *label, const koksma_curve_row *rows,
                     size_t count, uint64_t n)
{
    error_set kept = {strdup(label), malloc((count + 1) * sizeof *rows), count, n};

    if (s->count == s->room) {
        s->room = 2 * s->room + 64;
        s->set = realloc(s->set, s->room * sizeof *s->set);
    }
    if (kept.label == NULL || kept.rows == NULL || s->set == NULL)
        cli_fail("not enough memory for the errors of %zu sets", s->count + 1);
    memcpy(kept.rows, rows, count * sizeof *rows);
    s->set[s->count++] = kept;
}

void error_sets_free(error_sets *s)
{
    for (size_t r = 0; r < s->count; r++) {
        free(s->set[r].label);
        free(s->set[r].rows);
    }
    free(s->set);
}

void error_sets_shift(error_sets *s, double shift)
{
    uint64_t longest = 0;
    bool any = false;

    for (size_t r = 0; r < s->count; r++) {
        error_set *set = &s->set[r];
        size_t kept = 0;

        for (size_t j = 0; j < set->count && set->rows[j].n <= set->n / 4; j++)
            set->rows[kept++] = koksma_curve_shifted(set->rows[j], shift);
        set->count = kept;
        any = any || kept > 0;
        if (set->n > longest) longest = set->n;
    }
    if (!any)
        cli_fail("--exact mean writes N up to %ju of sets of %ju",
                 (uintmax_t)(longest / 4), (uintmax_t)longest);
}

static void print_key(const char *key, double value)
{
    printf(" %s=", key);
    cli_number(value);
}

void error_print_header(const error_header *h, const char *columns)
{
    if (cli_quiet()) return;
    printf("# koksma:%s", h->about);
    if (h->dim > 0) printf(" dim=%ju", (uintmax_t)h->dim);
    if (h->exact_from != NULL) {
        print_key("exact", h->exact);
        printf(" exact_from=%s", h->exact_from);
    }
    print_key("sigma", h->sigma);
    printf(" sigma_from=%s", h->sigma_from);
    print_key("largest", h->largest);
    printf("\n# %s\n", columns);
}

static void print_end(uint64_t n, double sigma)
{
    putchar('\t');
    cli_number(sigma / sqrt((double)n));
    putchar('\n');
}

void error_print_rows(const char *label, const koksma_curve_row *rows, size_t count,
                      double sigma)
{
    for (size_t j = 0; j < count; j++) {
        printf("%s\t%ju\t", label, (uintmax_t)rows[j].n);
        cli_number(rows[j].error);
        putchar('\t');
        cli_number(rows[j].tail);
        print_end(rows[j].n, sigma);
    }
}

/* Sets that differ in N would give means of few errors that look like those of
 * many. */
void error_sets_check_equal(const error_sets *s)
{
    const error_set *first = &s->set[0];

    for (size_t r = 1; r < s->count; r++)
        if (s->set[r].n != first->n)
            cli_fail("set %s has %ju values, the first set %ju: --summary takes "
                     "equal ones",
                     s->set[r].label, (uintmax_t)s->set[r].n, (uintmax_t)first->n);
}

void error_print_summary(const error_sets *s, double sigma)
{
    double *column = malloc((s->count + 1) * sizeof *column);

    if (column == NULL) cli_fail("not enough memory for the summary");
    for (size_t j = 0; j < s->set[0].count; j++) {
        uint64_t n = s->set[0].rows[j].n;

        for (size_t r = 0; r < s->count; r++)
            column[r] = s->set[r].rows[j].error;

        koksma_estimate rms = koksma_curve_rms(column, s->count, 0.95);

        printf("%ju\t", (uintmax_t)n);
        cli_number(rms.value);
        putchar('\t');
        cli_number(rms.lower);
        putchar('\t');
        cli_number(rms.upper);
        printf("\t%zu", s->count);
        print_end(n, sigma);
    }
    free(column);
}
