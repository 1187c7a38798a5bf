/* How fast the variation is found.  value: V_k, to be held against the closed form
 * or the formula of the grid. */

#include "bench.h"
#include "variation.h"

static void bench(const char *name, size_t dim, koksma_variation_method method,
                  size_t cells)
{
    static const char *const methods[] = {"auto", "grid", "boundary", "random"};
    koksma_variation_opts o = {.method = method, .cells = cells, .seed = 1};
    koksma_variation_result r;
    koksma_integrand f;
    char text[64];
    double started;

    bench_must((int)koksma_integrand_make(&f, NULL, koksma_integrand_find(name),
                                          dim, NULL, NULL),
               name);
    started = bench_now();
    bench_must((int)koksma_variation(&r, NULL, &f, &o, NULL), name);
    snprintf(text, sizeof text, "%s dim %zu k %zu %s", name, dim,
             r.level[r.levels - 1].cells, methods[method]);
    bench_row(text, started, r.work, "values", r.level[r.levels - 1].value.value);
}

/* Values that are there already, as a file has them. */
static void bench_grid(size_t nodes, size_t dim)
{
    size_t all[KOKSMA_VARIATION_DIM_MOST], count = 1, rows = 4096 / nodes;
    double *block = bench_alloc(rows * nodes, sizeof *block), started;
    koksma_variation_grid *g;
    koksma_variation_result r;
    char text[64];

    for (size_t j = 0; j < dim; j++, count *= nodes)
        all[j] = nodes;
    for (size_t i = 0; i < rows * nodes; i++)
        block[i] = (double)(i * i % 1009);
    started = bench_now();
    bench_must((int)koksma_variation_open(&g, all, dim, NULL), "open");
    for (size_t done = 0; done < count; done += rows * nodes)
        bench_must((int)koksma_variation_add(g, block, rows * nodes, NULL), "add");
    bench_must((int)koksma_variation_finish(&r, NULL, g, NULL), "finish");
    koksma_variation_close(g);
    snprintf(text, sizeof text, "values given, %zu nodes on %zu axes", nodes, dim);
    bench_row(text, started, (double)count, "values",
              r.level[r.levels - 1].value.value);
    free(block);
}

int main(void)
{
    bench_header();
    bench("f2", 2, KOKSMA_VARIATION_GRID, 4096);
    bench("f2", 2, KOKSMA_VARIATION_BOUNDARY, 4096);
    bench("f2", 2, KOKSMA_VARIATION_BOUNDARY, 1 << 18);
    bench("f3", 3, KOKSMA_VARIATION_BOUNDARY, 512);
    bench("gaussian", 1, KOKSMA_VARIATION_GRID, 1 << 20);
    bench("gaussian", 2, KOKSMA_VARIATION_GRID, 4096);
    bench("gaussian", 3, KOKSMA_VARIATION_GRID, 256);
    bench("gaussian", 4, KOKSMA_VARIATION_GRID, 64);
    bench("gaussian", 6, KOKSMA_VARIATION_GRID, 16);
    bench("gaussian", 8, KOKSMA_VARIATION_RANDOM, 16);
    bench_grid(512, 3);
    return EXIT_SUCCESS;
}
