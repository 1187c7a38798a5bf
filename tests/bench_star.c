/* How fast D* is found.  value: the lower end of its interval. */

#include "bench.h"
#include "gen.h"
#include "star.h"

static void bench(const char *family, size_t dim, size_t n)
{
    double *x = bench_alloc(n * dim, sizeof *x), started;
    koksma_gen_opts o = {.dim = dim, .n = n, .seed = 1};
    koksma_star_result r = {0};
    koksma_gen *g;
    char name[64];

    bench_must(koksma_gen_open(&g, koksma_gen_find(family), &o, NULL),
               "koksma_gen_open");
    bench_must(koksma_gen_fill(g, x, 0, n, NULL), "koksma_gen_fill");
    koksma_gen_close(g);
    started = bench_now();
    bench_must(koksma_star(&r, (koksma_points){x, n, dim}, NULL, NULL),
               "koksma_star");
    snprintf(name, sizeof name, "star %s dim %zu n %zu", family, dim, n);
    bench_row(name, started, (double)n, "points", r.value.lower);
    free(x);
}

int main(void)
{
    bench_header();
    bench("halton", 1, 1000000);
    bench("halton", 2, 1000);
    bench("halton", 2, 10000);
    bench("random", 2, 10000);
    bench("sobol", 3, 1024);
    return EXIT_SUCCESS;
}
