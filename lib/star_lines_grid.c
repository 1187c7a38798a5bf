#include <stdlib.h>

#include "error.h"
#include "star_lines_kernels.h"

/* Of tied heights the lines of open boxes need the first rank only and those of
 * closed ones the last, where the counts are right.  Open boxes may reach to 1. */
static void make_lines(ki_lines_grid *g)
{
    size_t n = g->n, open = 0, closed = 0;
    const double *y = g->height;

    for (size_t j = 0; j < n; j++) {
        if (j == 0 || y[j] != y[j - 1])
            g->line[0][open++] = (ki_line){y[j], (uint64_t)j << 32};
        if (j + 1 == n || y[j] != y[j + 1])
            g->line[1][closed++] = (ki_line){y[j], (uint64_t)(j + 1) << 32};
    }
    if (y[n - 1] < 1.0) g->line[0][open++] = (ki_line){1.0, (uint64_t)n << 32};
    g->lines[0] = open;
    g->lines[1] = closed;
}

/* a and b have room for n, rank_of too. */
static void rank_axes(ki_lines_grid *g, koksma_points p, ki_keyed *a, ki_keyed *b,
                      uint32_t *rank_of)
{
    size_t n = p.n, axes = g->axes;
    ki_keyed *sorted;

    for (size_t k = 0; k < axes; k++) {
        sorted = ki_sort_axis(p, k, a, b);
        for (size_t i = 0; i < n; i++) {
            g->side[k][i] = sorted[i].x;
            rank_of[k * n + sorted[i].i] = (uint32_t)i;
        }
        g->side[k][n] = 1.0;
    }
    sorted = ki_sort_axis(p, axes, a, b);
    for (size_t i = 0; i < n; i++) {
        g->height[i] = sorted[i].x;
        for (size_t k = 0; k < axes; k++)
            g->rank[i * axes + k] = rank_of[k * n + sorted[i].i];
    }
}

_Static_assert(sizeof(ki_line) <= sizeof(ki_keyed), "the lines take their place");

koksma_status ki_lines_grid_make(ki_lines_grid *out, koksma_points p)
{
    size_t n = p.n, axes = p.dim - 1;
    ki_lines_grid g = {.n = n, .axes = axes};
    ki_keyed *sorted = ki_alloc(2 * n + 1, sizeof *sorted);
    uint32_t *rank_of = ki_alloc(axes * n, sizeof *rank_of);

    g.side[0] = ki_alloc(axes * (n + 1) + n, sizeof(double));
    g.rank = ki_alloc(axes * n, sizeof *g.rank);
    if (sorted != NULL && rank_of != NULL && g.side[0] != NULL && g.rank != NULL) {
        g.side[1] = g.side[0] + n + 1;
        g.height = g.side[0] + axes * (n + 1);
        rank_axes(&g, p, sorted, sorted + n, rank_of);
    }
    free(rank_of);
    g.line[0] = (ki_line *)(void *)sorted; /* which has done its work */
    if (g.height == NULL) {
        ki_lines_grid_free(&g);
        return KOKSMA_ENOMEM;
    }
    g.line[1] = g.line[0] + n + 1;
    make_lines(&g);
    *out = g;
    return KOKSMA_OK;
}

void ki_lines_grid_free(ki_lines_grid *g)
{
    free(g->side[0]);
    free(g->rank);
    free(g->line[0]);
    *g = (ki_lines_grid){0};
}
