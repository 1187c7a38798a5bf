/* How fast points are made.  value: the mean of all coordinates, about 1/2. */

#include "bench.h"
#include "gen.h"

static void bench(const char *name, const char *family, size_t dim,
                  koksma_scramble scramble)
{
    size_t n = 4000000 / dim;
    double *x = bench_alloc(n * dim, sizeof *x), sum = 0.0, started;
    koksma_gen_opts o = {.dim = dim, .n = n, .scramble = scramble, .seed = 1};
    koksma_gen *g;

    bench_must(koksma_gen_open(&g, koksma_gen_find(family), &o, NULL),
               "koksma_gen_open");
    bench_must(koksma_gen_fill(g, x, 0, n, NULL),
               "koksma_gen_fill"); /* touch the pages */
    started = bench_now();
    for (int round = 0; round < 10; round++)
        bench_must(koksma_gen_fill(g, x, 0, n, NULL), "koksma_gen_fill");
    for (size_t i = 0; i < n * dim; i++)
        sum += x[i]; /* a tenth of a round or so */
    bench_row(name, started, 10.0 * (double)(n * dim), "coordinates",
              sum / (double)(n * dim));
    koksma_gen_close(g);
    free(x);
}

int main(void)
{
    bench_header();
    bench("halton dim 2", "halton", 2, KOKSMA_SCRAMBLE_NONE);
    bench("halton dim 10", "halton", 10, KOKSMA_SCRAMBLE_NONE);
    bench("halton dim 2 digits", "halton", 2, KOKSMA_SCRAMBLE_DIGITS);
    bench("halton dim 10 digits", "halton", 10, KOKSMA_SCRAMBLE_DIGITS);
    bench("sobol dim 10", "sobol", 10, KOKSMA_SCRAMBLE_NONE);
    bench("random dim 10", "random", 10, KOKSMA_SCRAMBLE_NONE);
    return EXIT_SUCCESS;
}
