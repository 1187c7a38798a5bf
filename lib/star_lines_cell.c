#include <math.h>
#include <stdlib.h>

#include "error.h"
#include "star_lines_kernels.h"

koksma_status ki_lines_worker_begin(ki_lines_worker *w, const ki_lines_grid *g,
                                    ki_best *best)
{
    *w = (ki_lines_worker){.grid = g, .best = best, .factor = 1.0};
    w->map = ki_alloc(g->n + 1, sizeof *w->map);
    if (w->map != NULL) return KOKSMA_OK;
    ki_lines_worker_end(w);
    return KOKSMA_ENOMEM;
}

void ki_lines_worker_end(ki_lines_worker *w)
{
    free(w->point);
    free(w->line);
    free(w->map);
    free(w->y);
    free(w->c);
    free(w->start);
}

/* Of m points, copy those that may be inside a column of the cell or not; the map
 * counts, below each, them and (in the lower halves) those surely inside. */
static size_t narrow_slab(uint32_t *restrict out, uint64_t *restrict map,
                          const uint32_t *restrict in, size_t m, uint32_t low,
                          uint32_t high)
{
    uint32_t width = high - low;
    uint64_t sum = 0;
    size_t kept = 0;

    map[0] = 0;
    for (size_t i = 0; i < m; i++) {
        uint32_t rank = in[i];
        uint64_t inside = rank < low, unsure = rank - low < width;

        sum += inside + (unsure << 32);
        map[i + 1] = sum;
        out[kept] = rank;
        kept += unsure;
    }
    return kept;
}

static size_t narrow_cell(uint32_t *restrict out, uint64_t *restrict map,
                          const uint32_t *restrict in, size_t m, const uint32_t *low,
                          const uint32_t *high)
{
    uint64_t sum = 0;
    size_t kept = 0;

    map[0] = 0;
    for (size_t i = 0; i < m; i++) {
        uint32_t p = in[2 * i], q = in[2 * i + 1];
        uint64_t inside = (p < low[0]) & (q < low[1]);
        uint64_t unsure = ((p < high[0]) & (q < high[1])) ^ inside;

        sum += inside + (unsure << 32);
        map[i + 1] = sum;
        out[2 * kept] = p;
        out[2 * kept + 1] = q;
        kept += unsure;
    }
    return kept;
}

static ki_lines_range range_of(const ki_lines_worker *w, const ki_lines_cell *c)
{
    const ki_best *b = w->best;
    double n = (double)w->grid->n;
    uint32_t last[KI_LINES_AXES];

    for (size_t k = 0; k < w->grid->axes; k++)
        last[k] = c->high[k] - 1;
    return (ki_lines_range){ki_lines_slope(w->grid, c->low),
                            ki_lines_slope(w->grid, last),
                            n * (b->proven * w->factor - b->slack), n * b->slack};
}

/* c: its ranges, and where its points and lines are to lie. */
static bool fill(ki_lines_worker *w, ki_lines_cell *c, const uint32_t *point,
                 size_t points, const ki_line *const *line, const size_t *lines)
{
    ki_lines_range range = range_of(w, c);

    if (w->grid->axes == 1)
        c->points = narrow_slab(w->point + c->point, w->map, point, points,
                                c->low[0], c->high[0]);
    else
        c->points = narrow_cell(w->point + c->point, w->map, point, points, c->low,
                                c->high);
    for (int closed = 0; closed < 2; closed++) {
        if (closed) c->line[1] = c->line[0] + c->lines[0];
        c->lines[closed] =
            ki_lines_filter(w->line + c->line[closed], line[closed], lines[closed],
                            w->map, &range, closed);
        w->work += (double)lines[closed];
    }
    return true;
}

static bool make_room(ki_lines_worker *w, size_t points, size_t lines)
{
    return ki_grow((void **)&w->point, &w->room_points, points * w->grid->axes,
                   sizeof *w->point) == 0 &&
           ki_grow((void **)&w->line, &w->room_lines, lines, sizeof *w->line) == 0;
}

bool ki_lines_cell_first(ki_lines_worker *w, const uint32_t *low,
                         const uint32_t *high)
{
    const ki_lines_grid *g = w->grid;
    ki_lines_cell *c = &w->path[0];

    *c = (ki_lines_cell){0};
    for (size_t k = 0; k < g->axes; k++) {
        c->low[k] = low[k];
        c->high[k] = high[k];
    }
    return make_room(w, g->n, g->lines[0] + g->lines[1]) &&
           fill(w, c, g->rank, g->n, (const ki_line *const *)g->line, g->lines);
}

bool ki_lines_cell_enter(ki_lines_worker *w, size_t depth)
{
    ki_lines_cell *whole = &w->path[depth], *c = whole + 1;
    size_t k = whole->axis, axes = w->grid->axes;
    uint64_t width = whole->high[k] - whole->low[k];
    uint32_t part = whole->parts - ++whole->part;

    *c = *whole;
    c->part = c->parts = 0;
    c->low[k] = whole->low[k] + (uint32_t)(width * part / whole->parts);
    c->high[k] = whole->low[k] + (uint32_t)(width * (part + 1) / whole->parts);
    c->point = whole->point + axes * whole->points;
    c->line[0] = whole->line[1] + whole->lines[1];
    if (!make_room(w, (c->point / axes) + whole->points,
                   c->line[0] + whole->lines[0] + whole->lines[1]))
        return false;

    const ki_line *line[2] = {w->line + whole->line[0], w->line + whole->line[1]};

    return fill(w, c, w->point + whole->point, whole->points, line, whole->lines);
}
