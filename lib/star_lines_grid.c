#include <stdlib.h>

#include "error.h"
#include "star_lines_kernels.h"

/* The axes are sorted side by side where there are threads.  A sort needs room of
 * its own, which a thread keeps for its next axis. */

enum { BLOCK = 1 << 14 };

typedef struct maker {
    ki_lines_grid *grid;
    koksma_points p;
    ki_keyed *room;                   /* 2n a thread */
    uint32_t *rank_of[KI_LINES_AXES]; /* at spread(i): of point i along the axis */
    uint32_t *order;                  /* the points in height */
} maker;

/* Sequences in base 2 come in an order of strides that are powers of 2, which would
 * all fall on the same few lines of a cache: 64 bytes more every 4096 spread them.
 */
static inline size_t spread(size_t i) { return i + (i >> 10 << 4); }

static void sort_axis(void *state, size_t thread, size_t k)
{
    maker *m = state;
    ki_lines_grid *g = m->grid;
    size_t n = g->n;
    ki_keyed *room = m->room + 2 * n * thread;
    const ki_keyed *sorted = ki_sort_axis(m->p, k, room, room + n);

    for (size_t i = 0; i < n; i++)
        if (k == g->axes) {
            g->height[i] = sorted[i].x;
            m->order[i] = sorted[i].i;
        } else {
            g->side[k][i] = sorted[i].x;
            m->rank_of[k][spread(sorted[i].i)] = (uint32_t)i;
        }
    if (k < g->axes) g->side[k][n] = 1.0;
}

static void gather_ranks(void *state, size_t thread, size_t block)
{
    maker *m = state;
    ki_lines_grid *g = m->grid;
    size_t n = g->n, end = (block + 1) * BLOCK < n ? (block + 1) * BLOCK : n;

    (void)thread;
    for (size_t i = block * BLOCK; i < end; i++)
        for (size_t k = 0; k < g->axes; k++)
            g->rank[i * g->axes + k] = m->rank_of[k][spread(m->order[i])];
}

static bool find_room(maker *m, size_t threads)
{
    ki_lines_grid *g = m->grid;
    size_t n = g->n, axes = g->axes;

    m->room =
        ki_alloc(threads < axes + 1 ? threads : axes + 1, 2 * n * sizeof *m->room);
    m->order = ki_alloc(n + axes * spread(n), sizeof *m->order);
    g->side[0] = ki_alloc(axes * (n + 1) + n, sizeof(double));
    g->rank = ki_alloc(axes * n, sizeof *g->rank);
    if (m->room == NULL || m->order == NULL || g->side[0] == NULL ||
        g->rank == NULL)
        return false;
    for (size_t k = 0; k < axes; k++)
        m->rank_of[k] = m->order + n + k * spread(n);
    g->side[1] = g->side[0] + n + 1;
    g->height = g->side[0] + axes * (n + 1);
    return true;
}

koksma_status ki_lines_grid_make(ki_lines_grid *out, koksma_points p, ki_team *team)
{
    ki_lines_grid g = {.n = p.n, .axes = p.dim - 1};
    maker m = {.grid = &g, .p = p};
    bool found = find_room(&m, ki_team_threads(team));

    if (found) {
        ki_team_run(team, p.dim, sort_axis, &m);
        ki_team_run(team, (p.n + BLOCK - 1) / BLOCK, gather_ranks, &m);
        *out = g;
    } else {
        ki_lines_grid_free(&g);
    }
    free(m.room);
    free(m.order);
    return found ? KOKSMA_OK : KOKSMA_ENOMEM;
}

void ki_lines_grid_free(ki_lines_grid *g)
{
    free(g->side[0]);
    free(g->rank);
    *g = (ki_lines_grid){0};
}
