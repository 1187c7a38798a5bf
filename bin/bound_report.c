#include "bound_report.h"

#include <math.h>
#include <stdio.h>

#include "cli.h"

static const char *const kinds[] = {"unknown", "proved", "one-sigma", "estimate",
                                    "diverging"};

static void tab_number(double v)
{
    putchar('\t');
    cli_number(v);
}

static void terms_at(koksma_bound_term *term, const bound_report *r, double n)
{
    koksma_error err;

    if (koksma_bound(term, &r->input->facts, n, bound_at(&r->input->star, n), r->z,
                     &err))
        cli_fail_as(&err);
}

/* ---- Rows -------------------------------------------------------------------- */

static void print_key(const char *key, double v)
{
    if (isnan(v)) return;
    printf(" %s=", key);
    cli_number(v);
}

static void print_header(const bound_report *r)
{
    koksma_bound_turns t = koksma_bound_turning(&r->input->facts);

    if (cli_quiet()) return;
    fputs("# koksma:", stdout);
    if (r->integrand != NULL) printf(" integrand=%s", r->integrand);
    printf(" dim=%zu", r->input->facts.dim);
    print_key("n_sat", t.saturation);
    print_key("n_even", t.even);
    print_key("n_cross", t.cross);
    printf("\n# N\tterm\tvalue\tkind\t%snote\n",
           r->input->observed.count > 0 ? "observed\tratio\t" : "");
}

/* What a reader of the row should know besides. */
static void print_note(const bound_report *r, koksma_bound_name name, double n)
{
    const bound_input *b = r->input;
    bool jump = name == KOKSMA_BOUND_JUMP || name == KOKSMA_BOUND_RMS ||
                name == KOKSMA_BOUND_REACH;

    putchar('\t');
    if (name == KOKSMA_BOUND_HLAWKA && b->facts.vhk_from == KOKSMA_VHK_GROWS)
        printf("rate=%.3f,k=%.0f", b->growth, b->cells);
    else if (name == KOKSMA_BOUND_HLAWKA && b->facts.vhk_from == KOKSMA_VHK_GRID)
        printf("variation>=%.6g,k=%.0f", b->facts.vhk, b->cells);
    else if (jump && b->unscrambled)
        fputs("not-scrambled", stdout);
    else if (jump && n < koksma_bound_turning(&b->facts).saturation)
        fputs("saturated", stdout);
    else
        putchar('-');
    putchar('\n');
}

void bound_print(const bound_report *r)
{
    koksma_bound_term first[KOKSMA_BOUND_TERMS];

    terms_at(first, r,
             (double)r->n[0]); /* facts that are none fail before the header */
    print_header(r);
    for (size_t i = 0; i < r->count; i++) {
        koksma_bound_term term[KOKSMA_BOUND_TERMS];
        double n = (double)r->n[i], observed = bound_at(&r->input->observed, n);

        terms_at(term, r, n);
        for (int k = 0; k < KOKSMA_BOUND_TERMS; k++) {
            printf("%ju\t%s", (uintmax_t)r->n[i], koksma_bound_names[k]);
            tab_number(term[k].value);
            printf("\t%s", kinds[term[k].kind]);
            if (r->input->observed.count > 0) {
                tab_number(observed);
                tab_number(observed / term[k].value);
            }
            print_note(r, (koksma_bound_name)k, n);
        }
    }
}

/* ---- The paragraph ----------------------------------------------------------- */

static void explain_hlawka(const bound_report *r, koksma_bound_term term)
{
    const bound_input *b = r->input;

    switch (b->facts.vhk_from) {
    case KOKSMA_VHK_CLOSED:
        if (isinf(b->facts.vhk))
            puts("The Koksma-Hlawka inequality says nothing: the variation is "
                 "infinite.");
        else if (isnan(term.value))
            printf(
                "The variation is %.6g; D* is not given, and so there is no bound "
                "by the\nKoksma-Hlawka inequality.\n",
                b->facts.vhk);
        else
            printf(
                "The Koksma-Hlawka inequality proves an error of %.3g at most.\n",
                term.value);
        break;
    case KOKSMA_VHK_GRID:
        printf("The variation is %.6g or more, as a grid of %.0f cells an axis has "
               "it; with just\nthat the Koksma-Hlawka inequality would have %.3g, "
               "which proves nothing.\n",
               b->facts.vhk, b->cells, term.value);
        break;
    case KOKSMA_VHK_GROWS:
        printf(
            "The variation diverges at rate %.3f up to k = %.0f: the Koksma-Hlawka "
            "inequality\nseems to say nothing.\n",
            b->growth, b->cells);
        break;
    default: puts("The variation is not known.");
    }
}

/* A smooth part of which only a bound is known makes the sum one too. */
static void explain_sigma(const bound_report *r, const koksma_bound_term *term)
{
    const koksma_bound_facts *f = &r->input->facts;
    bool at_most = isnan(f->smooth) && f->smooth_vhk > 0.0;
    double rms = term[KOKSMA_BOUND_RMS].value;

    if (f->jump > 0.0 && !isnan(term[KOKSMA_BOUND_PAPER].value))
        printf("The estimate (12) of the paper is %.3g.\n",
               term[KOKSMA_BOUND_PAPER].value);
    if (!isnan(rms) && (f->jump > 0.0 || !at_most))
        printf("Scrambled points should have a root mean square error of %.3g%s,\n"
               "and seldom an error above %.3g.\n",
               rms, at_most ? " or less" : "", r->z * rms);
    if (!isnan(term[KOKSMA_BOUND_RANDOM].value))
        printf("Random points have %.3g.\n", term[KOKSMA_BOUND_RANDOM].value);
}

static void explain_turns(const bound_report *r)
{
    koksma_bound_turns t = koksma_bound_turning(&r->input->facts);

    if (!isnan(t.saturation))
        printf("Below N = %.2g nearly every cell meets the jump.\n", t.saturation);
    if (!isnan(t.even))
        printf(
            "From about N = %.2g on the jump costs less than with random points.\n",
            t.even);
    if (!isnan(t.cross))
        printf("From about N = %.2g on the jump costs more than the smooth part.\n",
               t.cross);
}

static void explain_pay(const bound_report *r, double n,
                        const koksma_bound_term *term)
{
    double gain = term[KOKSMA_BOUND_RANDOM].value / term[KOKSMA_BOUND_RMS].value;

    switch (koksma_bound_pays(&r->input->facts, n)) {
    case KOKSMA_PAY_SATURATED:
        printf(
            "At N = %.4g quasi-Monte Carlo cannot pay: it is no better than random "
            "points.\n",
            n);
        break;
    case KOKSMA_PAY_NOT_YET:
        printf("At N = %.4g quasi-Monte Carlo does not pay yet.\n", n);
        break;
    case KOKSMA_PAY_JUMP:
        if (isnan(gain) || gain < 1.0)
            printf("At N = %.4g quasi-Monte Carlo can pay across the jump.\n", n);
        else
            printf("At N = %.4g quasi-Monte Carlo can pay: its error is %.2g times "
                   "smaller.\n",
                   n, gain);
        break;
    case KOKSMA_PAY_SMOOTH:
        printf("At N = %.4g quasi-Monte Carlo pays: there is no jump, and the "
               "variation is finite.\n",
               n);
        break;
    default:
        printf("Whether quasi-Monte Carlo can pay at N = %.4g is not known from "
               "this.\n",
               n);
    }
}

void bound_explain(const bound_report *r)
{
    double n = (double)r->n[r->count - 1];
    double observed = bound_at(&r->input->observed, n);
    koksma_bound_term term[KOKSMA_BOUND_TERMS];

    terms_at(term, r, n);
    explain_hlawka(r, term[KOKSMA_BOUND_HLAWKA]);
    explain_sigma(r, term);
    if (!isnan(observed)) printf("Observed was %.3g.\n", observed);
    if (r->input->unscrambled)
        puts("The points observed are not scrambled: of them the estimates promise "
             "nothing.");
    explain_turns(r);
    explain_pay(r, n, term);
}
