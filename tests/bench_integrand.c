/* How fast integrands are evaluated, in memory.  value: the mean over random
 * points, to be held against the exact one. */

#include "bench.h"
#include "gen.h"
#include "integrand.h"
#include "scene.h"

static void bench(const koksma_integrand_row *row, size_t dim)
{
    size_t n = 4000000 / dim;
    double *x = bench_alloc(n * dim, sizeof *x), *v = bench_alloc(n, sizeof *v);
    koksma_gen_opts o = {.dim = dim, .n = n, .seed = 1};
    double started, sum = 0.0;
    koksma_integrand f;
    koksma_gen *g;
    char name[64];

    bench_must((int)koksma_integrand_make(&f, NULL, row, dim, NULL, NULL),
               row->name);
    bench_must((int)koksma_gen_open(&g, koksma_gen_find("random"), &o, NULL),
               "open");
    bench_must((int)koksma_gen_fill(g, x, 0, n, NULL), "koksma_gen_fill");
    koksma_gen_close(g);
    for (size_t i = 0; i < n; i++)
        v[i] = 0.0; /* touch the pages */
    started = bench_now();
    bench_must((int)koksma_integrand_eval(v, &f, (koksma_points){x, n, dim}, NULL),
               row->name);
    for (size_t i = 0; i < n; i++)
        sum += v[i];
    snprintf(name, sizeof name, "%s dim %zu", row->name, dim);
    bench_row(name, started, (double)n, "values", sum / (double)n);
    free(x);
    free(v);
}

int main(void)
{
    bench_header();
    for (size_t i = 0; koksma_integrands[i] != NULL; i++)
        bench(koksma_integrands[i], koksma_integrands[i]->dim);
    for (size_t i = 0; koksma_scenes[i] != NULL; i++)
        bench(koksma_scenes[i], i < 2 ? 20 : 22); /* 10 bounces */
    return EXIT_SUCCESS;
}
