/* How fast boundary cells are counted: CPU seconds, cells a second, K.  The last
 * rows are lines: values a second, and the extent that they find. */

#include <math.h>

#include "bench.h"
#include "cells.h"

static koksma_integrand make(const char *name, size_t dim, const double *param)
{
    koksma_integrand f;

    bench_must((int)koksma_integrand_make(&f, NULL, koksma_integrand_find(name),
                                          dim, param, NULL),
               name);
    return f;
}

static void bench_count(const char *name, size_t dim, const double *param,
                        int log2n)
{
    koksma_integrand f = make(name, dim, param);
    koksma_cell_count c;
    uint64_t cells[8];
    char title[64];
    double started;

    bench_must(
        (int)koksma_grid_choose(cells, (uint64_t)1 << log2n, dim, NULL, NULL),
        "grid");
    started = bench_now();
    bench_must((int)koksma_cells_count(&c, &f, cells, NULL, NULL), name);
    snprintf(title, sizeof title, "%s dim %zu N 2^%d%s", name, dim, log2n,
             c.touched > c.lower ? ", aligned" : "");
    bench_row(title, started, (double)c.lower, "cells", (double)c.lower);
}

static void bench_lines(const char *name, size_t dim)
{
    koksma_integrand f = make(name, dim, NULL);
    koksma_lines_result r;
    char title[64];
    double started = bench_now();

    bench_must((int)koksma_lines(&r, NULL, &f, NULL, NULL), name);
    snprintf(title, sizeof title, "%s dim %zu, lines", name, dim);
    bench_row(title, started, r.work, "values", r.extent.value);
}

static void bench_grid(size_t dim, uint64_t n)
{
    const uint32_t bases[] = {2,  3,  5,  7,  11, 13, 17, 19,
                              23, 29, 31, 37, 41, 43, 47};
    uint64_t cells[KOKSMA_GRID_BASES_MOST], total = 1;
    double started = bench_now();
    char title[64];

    bench_must((int)koksma_grid_choose(cells, n, dim, bases, NULL), "grid");
    for (size_t k = 0; k < dim; k++)
        total *= cells[k];
    snprintf(title, sizeof title, "elementary intervals, dim %zu", dim);
    bench_row(title, started, 1.0, "grids", (double)total);
}

int main(void)
{
    const double c = 0.3;

    bench_header();
    for (size_t dim = 2; dim <= 4; dim++) {
        int log2n = dim == 2 ? 40 : dim == 3 ? 30 : 26;

        bench_count("halfspace", dim, &c, log2n);
        bench_count("ball", dim, NULL, log2n);
        bench_count("box", dim, NULL, log2n);
        bench_count("simplex", dim, NULL, log2n);
    }
    bench_count("koch", 2, NULL, 22);
    bench_count("fractal2", 2, NULL, 20);
    bench_count("fractal3", 3, NULL, 18);
    for (size_t dim = 2; dim <= 6; dim += 2)
        bench_lines("ball", dim);
    bench_grid(6, (uint64_t)1 << 40);
    bench_grid(15, (uint64_t)1 << 40);
    return EXIT_SUCCESS;
}
