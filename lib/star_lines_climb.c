#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "star_lines_kernels.h"

/* Coordinate ascent: the best height for a column, then the best rank along each
 * axis for the rest, until no step gains. */
typedef struct climb {
    const ki_lines_grid *grid;
    const uint32_t *at; /* at[k*n + r]: which in height has rank r along axis k */
    bool closed;
    uint32_t q[KI_LINES_AXES];
    size_t j; /* rank in height; n: the coordinate 1 */
    double excess;
    double corner[KI_LINES_AXES + 1]; /* where it ends */
    size_t inside;
} climb;

/* Whether a rank is inside a side that ends at rank q. */
static bool below(const climb *c, uint32_t rank, uint32_t q)
{
    return c->closed ? rank <= q : rank < q;
}

/* Best end of a side of slope t * x[r], r <= n, where the points come in the order
 * of inside[]: whether the other sides hold them. */
static double excess_at(const climb *c, double volume, size_t inside)
{
    double e = volume - (double)inside;

    return c->closed ? -e : e;
}

static bool best_height(climb *c)
{
    const ki_lines_grid *g = c->grid;
    double t = ki_lines_slope(g, c->q), best = c->excess;
    size_t inside = 0, from = c->j;

    for (size_t p = 0; p < g->n; p++) {
        bool in = true;
        double e;

        for (size_t k = 0; k < g->axes; k++)
            in = in & below(c, g->rank[p * g->axes + k], c->q[k]);
        e = excess_at(c, t * g->height[p], inside + (c->closed & in));
        inside += in;
        if (e > best) {
            best = e;
            c->j = p;
        }
    }
    if (excess_at(c, t, inside) > best) {
        best = excess_at(c, t, inside);
        c->j = g->n;
    }
    c->excess = best;
    return c->j != from;
}

static bool best_rank(climb *c, size_t k)
{
    const ki_lines_grid *g = c->grid;
    double y = c->j < g->n ? g->height[c->j] : 1.0;
    double t = (double)g->n * y, best = c->excess;
    uint32_t from = c->q[k];
    size_t inside = 0, other = g->axes - 1 - k;

    if (g->axes == 2) t *= g->side[other][c->q[other]];
    for (size_t r = 0; r < g->n; r++) {
        size_t p = c->at[k * g->n + r];
        bool in = below(c, (uint32_t)p, (uint32_t)c->j);
        double e;

        if (g->axes == 2) in = in & below(c, g->rank[p * 2 + other], c->q[other]);
        e = excess_at(c, t * g->side[k][r], inside + (c->closed & in));
        inside += in;
        if (e > best) {
            best = e;
            c->q[k] = (uint32_t)r;
        }
    }
    if (excess_at(c, t, inside) > best) {
        best = excess_at(c, t, inside);
        c->q[k] = (uint32_t)g->n;
    }
    c->excess = best;
    return c->q[k] != from;
}

static void go_up(climb *c)
{
    bool gains = best_height(c);

    for (int round = 0; round < 20 && gains; round++) {
        gains = false;
        for (size_t k = 0; k < c->grid->axes; k++)
            gains |= best_rank(c, k);
        if (gains) gains = best_height(c);
    }
}

size_t ki_lines_inside(koksma_points p, const double *corner, bool closed)
{
    size_t inside = 0;

    for (size_t i = 0; i < p.n; i++) {
        bool in = true;

        for (size_t k = 0; k < p.dim; k++) {
            double x = p.x[i * p.dim + k];

            in = in & (closed ? x <= corner[k] : x < corner[k]);
        }
        inside += in;
    }
    return inside;
}

static void find_corner(climb *c, koksma_points p)
{
    const ki_lines_grid *g = c->grid;

    for (size_t k = 0; k < g->axes; k++)
        c->corner[k] = g->side[k][c->q[k]];
    c->corner[g->axes] = c->j < g->n ? g->height[c->j] : 1.0;
    c->inside = ki_lines_inside(p, c->corner, c->closed);
}

/* From how far up all sides. */
static const double starts[KI_LINES_CLIMBS] = {1.0, 0.5, 0.75, 0.25, 0.9};

typedef struct all_climbs {
    const ki_lines_grid *grid;
    koksma_points p;
    const uint32_t *at;
    climb climb[2 * KI_LINES_CLIMBS];
} all_climbs;

static void climb_from(void *state, size_t thread, size_t number)
{
    all_climbs *all = state;
    size_t n = all->grid->n;
    climb *c = &all->climb[number];

    (void)thread;
    *c = (climb){.grid = all->grid,
                 .at = all->at,
                 .closed = number % 2 == 1,
                 .j = SIZE_MAX,
                 .excess = -2.0 * (double)n};
    for (size_t k = 0; k < c->grid->axes; k++)
        c->q[k] = (uint32_t)((double)n * starts[number / 2]);
    go_up(c);
    find_corner(c, all->p);
}

koksma_status ki_lines_climb(const ki_lines_grid *g, ki_run *run, size_t climbs)
{
    size_t n = g->n, count = 2 * climbs;
    uint32_t *at = ki_alloc(g->axes * n, sizeof *at);
    ki_best *b = run->best;
    all_climbs all = {.grid = g, .p = b->p, .at = at};

    if (at == NULL) return KOKSMA_ENOMEM;
    for (size_t p = 0; p < n; p++)
        for (size_t k = 0; k < g->axes; k++)
            at[k * n + g->rank[p * g->axes + k]] = (uint32_t)p;
    ki_team_run(run->team, count, climb_from, &all);
    for (size_t i = 0; i < count; i++)
        ki_best_offer(b, all.climb[i].corner, all.climb[i].inside,
                      all.climb[i].closed);
    ki_team_raise(run->team, b->proven);
    free(at);
    return KOKSMA_OK;
}
