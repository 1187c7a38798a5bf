#include "fit_report.h"

#include <math.h>
#include <stdio.h>

#include "cli.h"

static void add(fit_report *r, const char *name, double exponent)
{
    for (size_t i = 0; i < r->count; i++)
        if (fabs(r->candidates[i].exponent - exponent) < 1e-9) return;
    r->candidates[r->count++] = (candidate){name, exponent};
}

void fit_report_candidates(fit_report *r, double claim, double beta)
{
    size_t dim = (size_t)r->dim;

    r->count = 0;
    if (!isnan(claim)) add(r, "claim", claim);
    if (dim > 0 && !isnan(beta))
        add(r, "beta/2D-1", koksma_fit_theory_box(dim, beta));
    if (dim > 0) add(r, "-(D+1)/2D", koksma_fit_theory(dim));
    r->claimed = r->count > 0;
    add(r, "-1/2", -0.5);
    add(r, "-1", -1.0);
}

static koksma_judgement judge(const fit_report *r)
{
    double rivals[CANDIDATES_MOST];

    for (size_t i = 1; i < r->count; i++)
        rivals[i - 1] = r->candidates[i].exponent;
    if (!r->claimed && r->fit.sets > 1)
        return (koksma_judgement){KOKSMA_NO_VERDICT, KOKSMA_NO_DOUBT};
    return koksma_fit_judge(&r->fit, r->candidates[0].exponent, rivals,
                            r->count - 1, r->margin);
}

static const char *const verdicts[] = {"none", "equivalent", "different",
                                       "undecided"};
static const char *const doubts[] = {"-",    "path",  "bent",     "few",
                                     "wide", "rival", "saturated"};
static const char *const shapes[] = {"none", "straight", "flattens", "steepens"};
static const char *const models[] = {"auto", "power", "two-terms", "two-powers"};

static void tab_number(double v)
{
    putchar('\t');
    cli_number(v);
}

static void tab_term(koksma_fit_term t)
{
    tab_number(t.value.value);
    tab_number(t.value.lower);
    tab_number(t.value.upper);
}

/* name=z of every candidate, then the names of those that are not rejected. */
static void print_candidates(const fit_report *r)
{
    bool open = false;

    for (size_t i = 0; i < r->count; i++) {
        const candidate *c = &r->candidates[i];

        printf("%c%s=", i > 0 ? ';' : '\t', c->name);
        cli_number(koksma_fit_try(&r->fit, c->exponent, r->margin).z);
    }
    for (size_t i = 0; i < r->count; i++) {
        const candidate *c = &r->candidates[i];
        koksma_fit_test t = koksma_fit_try(&r->fit, c->exponent, r->margin);

        if (isnan(t.z) || t.rejected) continue;
        printf("%c%s", open ? ';' : '\t', c->name);
        open = true;
    }
    if (!open) fputs("\t-", stdout);
}

static double break_even(const fit_report *r)
{
    if (r->dim == 0) return nan("");
    return koksma_fit_break_even((size_t)r->dim, r->area, r->jump, r->sigma);
}

void fit_report_header(const fit_report *r)
{
    printf("# koksma:%s\n"
           "# %smodel\texponent\tlower\tupper\tse\tclaim\tverdict\tdoubt\tz\topen\t"
           "curvature\tt\tshape\tk\tk_lower\tk_upper\tslope\tconstant\tsmooth\t"
           "cross\teven\tsets\tused\tdropped\tfrom\tto\n",
           r->about, r->label != NULL ? "file\t" : "");
}

void fit_report_row(const fit_report *r)
{
    const koksma_fit_result *f = &r->fit;
    koksma_judgement j = judge(r);

    if (r->label != NULL) printf("%s\t", r->label);
    fputs(models[f->model], stdout);
    tab_term(f->exponent);
    tab_number(f->exponent.se);
    tab_number(r->claimed ? r->candidates[0].exponent : nan(""));
    printf("\t%s\t%s", verdicts[j.verdict], doubts[j.doubt]);
    print_candidates(r);
    tab_number(f->curvature.value.value);
    tab_number(f->curvature.value.value / f->curvature.se);
    printf("\t%s", shapes[f->shape]);
    tab_term(f->log_power);
    tab_number(f->slope.value.value);
    tab_number(f->constant);
    tab_number(f->smooth);
    tab_number(f->cross);
    tab_number(break_even(r));
    printf("\t%zu\t%zu\t%zu", f->sets, f->used,
           f->missing + f->zero + f->below_floor);
    tab_number(f->from);
    tab_number(f->to);
    putchar('\n');
}

/* ---- The paragraph ----------------------------------------------------------- */

static void explain_window(const fit_report *r)
{
    const koksma_fit_result *f = &r->fit;
    char word[40];

    if (r->label != NULL) printf("%s: ", r->label);
    printf("From N = %g to %g (%zu of them) ", f->from, f->to, f->used);
    if (r->column == NULL)
        fputs("the error", stdout);
    else
        printf("column %s", r->column);
    if (f->model != KOKSMA_FIT_POWER)
        printf("\ngoes like %.3g N^s beside %.3g N^-1%s, with s = %.4f.\n",
               f->constant, f->smooth,
               f->model == KOKSMA_FIT_TWO_TERMS ? " (ln N)^1/2" : "",
               f->exponent.value.value);
    else
        printf(" goes like %.3g N^s with s = %.4f.\n", f->constant,
               f->exponent.value.value);
    if (koksma_about_word(r->about, "points", word, sizeof word)) {
        printf("Points: %s", word);
        if (koksma_about_word(r->about, "scramble", word, sizeof word))
            printf(", scramble %s", word);
        if (koksma_about_word(r->about, "start", word, sizeof word))
            printf(", from index %s", word);
        puts(".");
    }
    if (f->missing + f->zero + f->below_floor > 0)
        printf(
            "Left out are %zu N that are incomplete, %zu of zeros and %zu below\n"
            "rounding.\n",
            f->missing, f->zero, f->below_floor);
}

static void explain_path(const fit_report *r)
{
    if (r->path > 0) printf("It is set %zu alone.  ", r->path);
    puts("This is one path: its errors hang together, and no honest interval can "
         "be\n"
         "had from it.");
    if (r->labelled)
        puts("Replicates give one: koksma-points --scramble digits --replicates "
             "32.");
}

static void explain_candidate(const fit_report *r, const candidate *c)
{
    koksma_fit_test t = koksma_fit_try(&r->fit, c->exponent, r->margin);

    printf("%s = %.4g is %s (z = %.1f)%s.\n", c->name, c->exponent,
           t.rejected ? "rejected" : "not rejected", t.z,
           t.near ? ", and within the margin" : "");
}

static void explain_verdict(const fit_report *r)
{
    static const char *const reasons[] = {
        "",
        "",
        "the line bends, so that its slope is nobody's exponent",
        "two terms are parted reliably from 64 replicates and 16 octaves on",
        "the interval is too wide for the margin",
        "it is within the margin, but not the only candidate left",
        "below the saturation points do as random ones"};
    koksma_judgement j = judge(r);
    const char *name = r->candidates[0].name;
    double claim = r->candidates[0].exponent;

    switch (j.verdict) {
    case KOKSMA_EQUIVALENT:
        printf("Verdict: equivalent to %s = %.4g, within %g.\n", name, claim,
               r->margin);
        break;
    case KOKSMA_DIFFERENT:
        printf("Verdict: different from %s = %.4g.\n", name, claim);
        break;
    case KOKSMA_UNDECIDED:
        printf("Verdict on %s = %.4g: undecided; %s.\n", name, claim,
               reasons[j.doubt]);
        break;
    case KOKSMA_NO_VERDICT: break;
    }
    if (j.doubt == KOKSMA_DOUBT_SATURATED)
        printf(
            "Saturated: nearly every cell meets the jump up to about N = %.2g.\n",
            r->fit.saturation);
}

static void explain_shape(const fit_report *r)
{
    const koksma_fit_result *f = &r->fit;
    koksma_estimate k = f->log_power.value;

    if (f->shape == KOKSMA_FLATTENS)
        puts("The curve flattens towards large N, as a jump beside a smooth part "
             "does.");
    if (f->shape == KOKSMA_FLATTENS && f->model == KOKSMA_FIT_POWER)
        puts("-m two-terms and -m two-powers part them.");
    if (f->model != KOKSMA_FIT_POWER)
        printf(
            "One power would have the slope %.4f; N^s is the larger term %s%.3g.\n",
            f->slope.value.value, f->cross > 0.0 ? "from N = " : "always, from ",
            f->cross);
    if (f->shape != KOKSMA_STEEPENS) return;
    puts("The curve steepens towards large N, as logarithms beside N^-1 do.");
    if (k.value >= 0.0 && (r->dim == 0 || k.value <= (double)r->dim))
        printf("N^-1 (ln N)^k fits with k = %.2f, in [%.2f, %.2f].\n", k.value,
               k.lower, k.upper);
}

static void explain_break_even(const fit_report *r)
{
    double even = break_even(r);

    if (!isnan(even))
        printf("Across the jump these points beat random ones from about N = %.2g "
               "on.\n",
               even);
}

void fit_report_explain(const fit_report *r)
{
    const koksma_fit_term *s = &r->fit.exponent;

    explain_window(r);
    if (r->fit.sets == 1) {
        explain_path(r);
    } else {
        printf("The %g %% interval from %zu replicates is [%.4f, %.4f].\n",
               100.0 * s->value.level, r->fit.sets, s->value.lower, s->value.upper);
        for (size_t i = 0; i < r->count; i++)
            explain_candidate(r, &r->candidates[i]);
        explain_shape(r);
        explain_verdict(r);
    }
    explain_break_even(r);
}
