#include "variation_report.h"

#include <math.h>
#include <stdio.h>

#include "cli.h"

static const char *const trends[] = {"undecided", "converged", "diverging"};

static const koksma_variation_level *finest(const variation_report *r)
{
    return &r->result.level[r->result.levels - 1];
}

/* What a number is to V_HK. */
static const char *kind_of(const variation_report *r, koksma_estimate v)
{
    if (v.level < 1.0) return "estimate";
    return r->sampled && r->dim == 1 ? "exact" : "at-least";
}

static void tab_number(double v)
{
    putchar('\t');
    cli_number(v);
}

static void tab_estimate(koksma_estimate v)
{
    tab_number(v.value);
    tab_number(v.lower);
    tab_number(v.upper);
}

static void print_label(const variation_report *r)
{
    if (r->label != NULL) printf("%s\t", r->label);
}

void variation_print_header(variation_form form, bool several)
{
    static const char *const columns[] = {
        [VARIATION_ROW] = "dim\tk\tvariation\tlower\tupper\tkind\ttrend\trate",
        [VARIATION_LEVELS] = "dim\tk\tvariation\tlower\tupper\tkind\trate",
        [VARIATION_FACES] = "dim\tk\taxes\tvariation\tlower\tupper\tkind",
    };

    if (form == VARIATION_EXPLAIN || cli_quiet()) return;
    printf("# %s%s\n", several ? "input\t" : "", columns[form]);
}

/* For the tools further down, where there is one result. */
static void print_comment(const variation_report *r)
{
    if (cli_quiet() || r->label != NULL) return;
    if (r->about != NULL)
        printf("# koksma: %s vhk=", r->about);
    else
        printf("# koksma: dim=%zu vhk=", r->dim);
    cli_number(finest(r)->value.value);
    printf(" vhk_kind=%s vhk_cells=%zu vhk_trend=%s", kind_of(r, finest(r)->value),
           finest(r)->cells, trends[r->result.trend]);
    if (isfinite(r->result.rate)) {
        fputs(" vhk_rate=", stdout);
        cli_number(r->result.rate);
    }
    putchar('\n');
}

static void print_row(const variation_report *r)
{
    koksma_estimate v = finest(r)->value;

    print_label(r);
    printf("%zu\t%zu", r->dim, finest(r)->cells);
    tab_estimate(v);
    printf("\t%s\t%s", kind_of(r, v), trends[r->result.trend]);
    tab_number(r->result.rate);
    putchar('\n');
}

static void print_levels(const variation_report *r)
{
    for (size_t i = 0; i < r->result.levels; i++) {
        const koksma_variation_level *l = &r->result.level[i];

        print_label(r);
        printf("%zu\t%zu", r->dim, l->cells);
        tab_estimate(l->value);
        printf("\t%s", kind_of(r, l->value));
        tab_number(i > 0 ? log2(l->value.value / l[-1].value.value) : (double)NAN);
        putchar('\n');
    }
}

static void print_faces(const variation_report *r)
{
    for (size_t u = 1; u < (size_t)1 << r->dim; u++) {
        size_t from = 0;

        for (size_t j = 0; j < r->dim; j++)
            if (u >> j & 1) from |= (size_t)1 << (r->reversed ? r->dim - 1 - j : j);
        print_label(r);
        printf("%zu\t%zu", r->dim, finest(r)->cells);
        for (size_t j = 0, listed = 0; j < r->dim; j++)
            if (u >> j & 1) printf("%c%zu", listed++ > 0 ? ',' : '\t', j + 1);
        tab_estimate(r->faces[from]);
        printf("\t%s\n", kind_of(r, r->faces[from]));
    }
}

/* ---- The paragraph ----------------------------------------------------------- */

static void explain_value(const variation_report *r)
{
    const koksma_variation_level *l = finest(r);
    koksma_estimate v = l->value;

    if (r->label != NULL) printf("%s: ", r->label);
    if (v.level == 1.0)
        printf("On a grid of %zu cells an axis the variation is %.6g, over the %zu "
               "faces of\n%zu axes.\n",
               l->cells, v.value, ((size_t)1 << r->dim) - 1, r->dim);
    else if (v.level > 0.0)
        printf("On a grid of %zu cells an axis the variation is about %.4g; the %g "
               "%% interval\nfrom random cells is [%.4g, %.4g].\n",
               l->cells, v.value, 100.0 * v.level, v.lower, v.upper);
    else
        printf("On a grid of %zu cells an axis random cells say %.4g, without an "
               "interval: too\nfew of them differ from 0.\n",
               l->cells, v.value);
    if (r->sampled && r->dim == 1)
        puts("For the values given that is exact.");
    else if (v.level == 1.0)
        puts("A grid's variation is a lower bound of Hardy and Krause's.");
}

static void explain_trend(const variation_report *r)
{
    const koksma_variation_result *v = &r->result;
    size_t k = finest(r)->cells;

    switch (v->trend) {
    case KOKSMA_TREND_CONVERGED:
        puts("It has converged: the last two doublings of the grid changed next to "
             "nothing.");
        break;
    case KOKSMA_TREND_DIVERGING:
        printf("It diverges at rate %.3f: it grows like k^%.3f up to k = %zu",
               v->rate, v->rate, k);
        if (r->dim > 1)
            printf(", where a jump\nwould have %zu%s", r->dim - 1,
                   r->dim > 2 ? " and a kink one less" : "");
        puts(".\nBeyond that a steep ramp would still level off.");
        break;
    default:
        if (isnan(v->rate))
            printf("Whether it converges is undecided at h = 1/%zu.\n", k);
        else
            printf(
                "Whether it converges is undecided at h = 1/%zu; the last rate is "
                "%.3f.\n",
                k, v->rate);
    }
}

static void explain(const variation_report *r)
{
    explain_value(r);
    explain_trend(r);
    if (isinf(r->known))
        puts("That it is infinite is known of this integrand.");
    else if (!isnan(r->known))
        printf("In closed form it is %.10g.\n", r->known);
}

void variation_print(const variation_report *r, variation_form form)
{
    if (form != VARIATION_EXPLAIN) print_comment(r);
    if (form != VARIATION_EXPLAIN && r->label == NULL)
        variation_print_header(form, false);
    switch (form) {
    case VARIATION_ROW: print_row(r); break;
    case VARIATION_LEVELS: print_levels(r); break;
    case VARIATION_FACES: print_faces(r); break;
    case VARIATION_EXPLAIN: explain(r); break;
    }
}
