/* What the fit finds where the theory is known, and what it costs: 128 replicates
 * to N = 2^17 or 2^20, fitted from 16 on, for the seeds 1 to 5; then the main job,
 * 32 replicates of f2, in memory.  All seeds are shown. */

#include <string.h>

#include "bench.h"
#include "paths.h"

enum { SEEDS = 5, REPLICATES = 128, ROWS = REPLICATES * PATH_ROWS };

static double xs[ROWS], ys[ROWS];
static size_t sets[ROWS];

static const char *const verdicts[] = {"none", "equivalent", "different",
                                       "undecided"};
static const char *const models[] = {"auto", "power", "two-terms", "two-powers"};
static const char *const shapes[] = {"none", "straight", "flattens", "steepens"};

static koksma_fit_result fit(path_kind kind, size_t replicates,
                             koksma_fit_model model)
{
    koksma_fit_data d = {xs, ys, sets, 0, replicates};
    koksma_fit_opts o = {.from = 16.0, .scale = 1.0, .model = model};
    koksma_fit_result r;

    for (size_t i = 0; i < replicates; i++)
        path_add(xs, ys, sets, &d, kind, i);
    bench_must((int)koksma_fit(&r, d, &o, NULL), "koksma_fit");
    return r;
}

static void bench_exponent(path_kind kind, koksma_fit_model model)
{
    size_t dim = kind.dim > 0 ? kind.dim : path_row(kind)->dim;
    double claim = koksma_fit_theory(dim);
    static const double rivals[] = {-0.5, -1.0};

    for (kind.seed = 1; kind.seed <= SEEDS; kind.seed++) {
        double started = bench_now();
        koksma_fit_result r = fit(kind, REPLICATES, model);

        printf(
            "%s\t%s\t%zu\t%g\t%ju\t%ju\t%s\t%.4f\t%.4f\t%.4f\t%s\t%s\t%.4g\t%.3g\n",
            kind.family, kind.integrand, dim, kind.a, (uintmax_t)kind.n,
            (uintmax_t)kind.seed, models[r.model], r.exponent.value.value,
            r.exponent.se, claim,
            verdicts[koksma_fit_judge(&r, claim, rivals, 2, 0.05).verdict],
            shapes[r.shape], r.cross, bench_now() - started);
        fflush(stdout);
    }
}

int main(void)
{
    puts("# points\tintegrand\tdim\ta\tN\tseed\tmodel\texponent\tse\ttheory"
         "\tverdict\tshape\tcross\tseconds");
    bench_exponent((path_kind){"halton", "f2", 0.0, 0, 1 << 17, 0},
                   KOKSMA_FIT_AUTO);
    bench_exponent((path_kind){"halton", "f3", 0.0, 0, 1 << 17, 0},
                   KOKSMA_FIT_AUTO);
    for (size_t dim = 2; dim <= 4; dim++)
        bench_exponent((path_kind){"halton", "ball", (double)NAN, 0, 1 << 17, dim},
                       KOKSMA_FIT_AUTO);
    bench_exponent((path_kind){"halton", "sphere", (double)NAN, 0, 1 << 17, 2},
                   KOKSMA_FIT_AUTO);
    bench_exponent((path_kind){"halton", "f2", 0.45, 0, 1 << 17, 0},
                   KOKSMA_FIT_TWO_TERMS);
    bench_exponent((path_kind){"halton", "f2", 0.45, 0, 1 << 17, 0},
                   KOKSMA_FIT_TWO_POWERS);
    bench_exponent((path_kind){"halton", "f2", 0.45, 0, 1 << 20, 0},
                   KOKSMA_FIT_TWO_TERMS);
    bench_exponent((path_kind){"halton", "f2", 0.45, 0, 1 << 20, 0},
                   KOKSMA_FIT_TWO_POWERS);
    bench_header();

    double started = bench_now();
    koksma_fit_result r =
        fit((path_kind){"halton", "f2", 0.0, 1, 1 << 17, 0}, 32, KOKSMA_FIT_AUTO);

    bench_row("f2, 32 replicates", started, 32.0 * (1 << 17), "points",
              r.exponent.value.value);
    return EXIT_SUCCESS;
}
