/* How well the fit's intervals keep their word: 100 seeds of the main job, 32
 * digit-permuted Halton replicates to N = 2^17 of f2 and f3 at a = 0.  The rows
 * say how many nominal 95 % intervals hold the theory's exponent, and how wide
 * they are. */

#include <math.h>

#include "bench.h"
#include "curve.h"
#include "fit.h"
#include "gen.h"
#include "integrand.h"

enum { SEEDS = 100, REPLICATES = 32, N = 131072, ROWS_MOST = 64 };

typedef struct tally {
    double inside, equivalent, width, widest, slope;
} tally;

/* Append the curve of one replicate to the fit's data. */
static void add_curve(koksma_fit_data *d, double *xs, double *ys, size_t *sets,
                      const double *f, size_t replicate)
{
    const koksma_curve_row *rows;
    koksma_curve *c;
    size_t count;

    bench_must(koksma_curve_open(&c, 2, NULL), "koksma_curve_open");
    koksma_curve_begin(c, 0.5);
    koksma_curve_add(c, f, 1, N);
    bench_must(koksma_curve_rows(c, &rows, &count, NULL), "koksma_curve_rows");
    for (size_t j = 0; j < count; j++, d->rows++) {
        xs[d->rows] = (double)rows[j].n;
        ys[d->rows] = rows[j].error;
        sets[d->rows] = replicate;
    }
    koksma_curve_close(c);
}

static void fit_seed(tally *t, const koksma_integrand *f, uint64_t seed)
{
    static double xs[REPLICATES * ROWS_MOST], ys[REPLICATES * ROWS_MOST];
    static size_t sets[REPLICATES * ROWS_MOST];
    koksma_fit_data d = {xs, ys, sets, 0, REPLICATES};
    double *x = bench_alloc(N * f->dim, sizeof *x),
           *values = bench_alloc(N, sizeof *values);
    double theory = koksma_fit_theory(f->dim), width;
    koksma_fit_result r;

    for (size_t i = 0; i < REPLICATES; i++) {
        koksma_gen_opts o = {.dim = f->dim,
                             .n = N,
                             .scramble = KOKSMA_SCRAMBLE_DIGITS,
                             .seed = seed,
                             .replicate = i};
        koksma_gen *g;

        bench_must(koksma_gen_open(&g, koksma_gen_find("halton"), &o, NULL),
                   "open");
        bench_must(koksma_gen_fill(g, x, 0, N, NULL), "koksma_gen_fill");
        koksma_gen_close(g);
        bench_must(
            koksma_integrand_eval(values, f, (koksma_points){x, N, f->dim}, NULL),
            "koksma_integrand_eval");
        add_curve(&d, xs, ys, sets, values, i);
    }
    bench_must(koksma_fit(&r, d, NULL, NULL), "koksma_fit");
    width = r.exponent.upper - r.exponent.lower;
    t->inside += r.exponent.lower <= theory && theory <= r.exponent.upper;
    t->equivalent +=
        koksma_fit_compare(&r, theory, 0.05).verdict == KOKSMA_EQUIVALENT;
    t->width += width / SEEDS;
    t->widest = fmax(t->widest, width);
    t->slope += r.exponent.value / SEEDS;
    free(x);
    free(values);
}

int main(void)
{
    static const char *const names[] = {"f2", "f3"};

    puts("# "
         "integrand\tseconds\tseeds\tinside\tequivalent\tmean_width\twidest\tmean_"
         "slope"
         "\ttheory");
    for (size_t i = 0; i < 2; i++) {
        double started = bench_now();
        tally t = {0};
        koksma_integrand f;

        bench_must(koksma_integrand_make(&f, NULL, koksma_integrand_find(names[i]),
                                         0, NULL, NULL),
                   "koksma_integrand_make");
        for (uint64_t seed = 1; seed <= SEEDS; seed++)
            fit_seed(&t, &f, seed);
        printf("%s\t%.3g\t%d\t%g\t%g\t%.4f\t%.4f\t%.4f\t%.4f\n", names[i],
               bench_now() - started, SEEDS, t.inside, t.equivalent, t.width,
               t.widest, t.slope, koksma_fit_theory(f.dim));
    }
    return EXIT_SUCCESS;
}
