/* How fast points are made, in blocks that stay in the cache.  value: the mean of
 * all coordinates, about 1/2. */

#include "bench.h"
#include "gen.h"

enum { ROOM = 1 << 15, ROUNDS = 1000 };

static void bench(const char *name, const char *family, size_t dim,
                  koksma_scramble scramble)
{
    static double x[ROOM];
    size_t n = ROOM / dim;
    double sum = 0.0, started;
    koksma_gen_opts o = {.dim = dim, .n = n * ROUNDS, .scramble = scramble};
    koksma_gen *g;

    bench_must(koksma_gen_open(&g, koksma_gen_find(family), &o, NULL),
               "koksma_gen_open");
    started = bench_now();
    for (size_t round = 0; round < ROUNDS; round++) {
        bench_must(koksma_gen_fill(g, x, round * n, n, NULL), "koksma_gen_fill");
        for (size_t i = 0; i < n * dim; i += 64)
            sum += x[i];
    }
    bench_row(name, started, (double)(ROUNDS * n * dim), "coordinates",
              sum / (double)(ROUNDS * ((n * dim + 63) / 64)));
    koksma_gen_close(g);
}

int main(void)
{
    bench_header();
    bench("halton dim 2", "halton", 2, KOKSMA_SCRAMBLE_NONE);
    bench("halton dim 10", "halton", 10, KOKSMA_SCRAMBLE_NONE);
    bench("halton dim 2 digits", "halton", 2, KOKSMA_SCRAMBLE_DIGITS);
    bench("halton dim 10 digits", "halton", 10, KOKSMA_SCRAMBLE_DIGITS);
    bench("sobol dim 2", "sobol", 2, KOKSMA_SCRAMBLE_NONE);
    bench("sobol dim 10", "sobol", 10, KOKSMA_SCRAMBLE_NONE);
    bench("sobol dim 1000", "sobol", 1000, KOKSMA_SCRAMBLE_NONE);
    bench("sobol dim 10 matrix", "sobol", 10, KOKSMA_SCRAMBLE_MATRIX);
    bench("sobol dim 2 owen", "sobol", 2, KOKSMA_SCRAMBLE_OWEN);
    bench("sobol dim 10 owen", "sobol", 10, KOKSMA_SCRAMBLE_OWEN);
    bench("random dim 10", "random", 10, KOKSMA_SCRAMBLE_NONE);
    return EXIT_SUCCESS;
}
