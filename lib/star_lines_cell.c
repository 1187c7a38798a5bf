#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "star_lines_kernels.h"

koksma_status ki_lines_worker_begin(ki_lines_worker *w, const ki_lines_grid *g,
                                    ki_run *run, ki_lines_sizes sizes)
{
    *w = (ki_lines_worker){.grid = g, .run = run, .sizes = sizes};
    w->start = ki_alloc(sizes.leaf, sizeof *w->start);
    return w->start != NULL ? KOKSMA_OK : KOKSMA_ENOMEM;
}

void ki_lines_worker_rest(ki_lines_worker *w)
{
    free(w->point);
    free(w->line);
    w->point = NULL;
    w->line = NULL;
    w->room_points = w->room_lines = 0;
}

void ki_lines_worker_end(ki_lines_worker *w)
{
    ki_lines_worker_rest(w);
    free(w->y);
    free(w->c);
    free(w->start);
}

ki_lines_cell ki_lines_cell_whole(const ki_lines_grid *g, bool closed)
{
    ki_lines_cell c = {.of_grid = true,
                       .closed = closed,
                       .points = g->n,
                       .lines = closed ? g->n : g->n + 1};

    for (size_t k = 0; k < g->axes; k++)
        c.high[k] = (uint32_t)(g->n + 1);
    return c;
}

/* Into how many parts the sides of a cell are split, as powers of 2: of two axes
 * both in two, or the one along which the volume varies far more in four. */
static void choose_parts(const ki_lines_grid *g, const ki_lines_cell *c,
                         unsigned *bits)
{
    double least[KI_LINES_AXES]; /* of the greatest coordinate in the cell */

    bits[0] = 2;
    if (g->axes == 2) {
        for (size_t k = 0; k < 2; k++)
            least[k] = g->side[k][c->low[k]] / g->side[k][c->high[k] - 1];
        bits[0] = bits[1] = 1;
        if (c->high[1] - c->low[1] == 1 || 1.0 - least[0] > 2.0 * (1.0 - least[1]))
            bits[0] = 2, bits[1] = 0;
        if (c->high[0] - c->low[0] == 1 || 1.0 - least[1] > 2.0 * (1.0 - least[0]))
            bits[0] = 0, bits[1] = 2;
    }
    for (size_t k = 0; k < g->axes; k++)
        while (c->high[k] - c->low[k] < 1u << bits[k])
            bits[k]--;
}

static void make_parts(const ki_lines_grid *g, const ki_lines_cell *c,
                       ki_lines_split *s)
{
    unsigned bits[KI_LINES_AXES] = {0, 0};
    uint64_t at[KI_LINES_AXES];

    choose_parts(g, c, bits);
    s->left = (size_t)1 << (bits[0] + bits[1]);
    for (size_t q = 0; q < s->left; q++) {
        ki_lines_cell *part = &s->part[q];

        *part = (ki_lines_cell){.closed = c->closed};
        at[0] = q & ((1u << bits[0]) - 1);
        at[1] = q >> bits[0];
        for (size_t k = 0; k < g->axes; k++) {
            uint64_t width = c->high[k] - c->low[k];

            part->low[k] = c->low[k] + (uint32_t)(width * at[k] >> bits[k]);
            part->high[k] = c->low[k] + (uint32_t)(width * (at[k] + 1) >> bits[k]);
        }
    }
}

static void set_range(const ki_lines_worker *w, const ki_lines_split *s,
                      double loss, ki_lines_range *r)
{
    double margin = (double)w->grid->n * w->run->best->slack;
    double cut = ki_lines_cut(w) - loss;

    memset(r, 0, sizeof *r);
    r->margin = w->scout ? 0.0 : margin;
    r->hull_margin = w->scout ? -margin : margin;
    r->dense = w->sizes.dense;
    for (size_t q = 0; q < KI_LINES_PARTS; q++)
        r->cut[q] = HUGE_VAL;
    for (size_t q = 0; q < s->left; q++) {
        uint32_t last[KI_LINES_AXES];

        for (size_t k = 0; k < w->grid->axes; k++) {
            r->low[k][q] = s->part[q].low[k];
            r->high[k][q] = s->part[q].high[k];
            last[k] = s->part[q].high[k] - 1;
        }
        r->first[q] = ki_lines_slope(w->grid, s->part[q].low);
        r->last[q] = ki_lines_slope(w->grid, last);
        r->cut[q] = cut;
    }
}

/* Room for all of whole's points and lines in each part, from `point` and `line`
 * on: with places to spare, as what is not kept is written too. */
static bool make_room(ki_lines_worker *w, const ki_lines_cell *whole, size_t point,
                      size_t line)
{
    size_t points = KI_LINES_PARTS * (whole->points + 1) * w->grid->axes;
    size_t lines = KI_LINES_PARTS * (whole->lines + 2);

    return ki_grow((void **)&w->point, &w->room_points, point + points,
                   sizeof *w->point) == 0 &&
           ki_grow((void **)&w->line, &w->room_lines, line + lines,
                   sizeof *w->line) == 0;
}

/* Where the parts' points and lines go, and where the whole's are. */
static void set_flow(const ki_lines_worker *w, const ki_lines_cell *whole,
                     ki_lines_split *s, size_t point, size_t line, ki_lines_flow *f)
{
    const ki_lines_grid *g = w->grid;

    *f = (ki_lines_flow){.closed = whole->closed,
                         .axes = g->axes,
                         .points = whole->points,
                         .lines = whole->lines,
                         .point = g->rank,
                         .height = g->height};
    if (!whole->of_grid) {
        f->point = w->point + whole->point;
        f->line = w->line + whole->line;
    }
    for (size_t q = 0; q < KI_LINES_PARTS; q++) {
        s->part[q].point = point + q * (whole->points + 1) * g->axes;
        f->to_point[q] = w->point + s->part[q].point;
        f->to_line[q] = w->line + line + q * (whole->lines + 2) + 1;
    }
}

/* The lines of the whole grid take the most room by far: what is left of them moves
 * together, and the next cells take the place of the others. */
static void close_gaps(ki_lines_worker *w, ki_lines_split *s)
{
    size_t at = 0;

    for (size_t q = 0; q < s->left; q++) {
        ki_lines_cell *part = &s->part[q];

        memmove(w->line + at, w->line + part->line, part->lines * sizeof *w->line);
        part->line = at;
        at += part->lines;
    }
}

bool ki_lines_cell_fill(ki_lines_worker *w, const ki_lines_cell *whole,
                        size_t depth)
{
    ki_lines_split *s = &w->path[depth];
    ki_lines_range r;
    ki_lines_flow f;
    size_t point = 0, line = 0, longest[KI_LINES_PARTS];

    if (!whole->of_grid) { /* behind the last part of the split that it is in */
        point = whole->point + whole->points * w->grid->axes;
        line = whole->line + whole->lines;
    }
    if (!make_room(w, whole, point, line)) return false;
    set_range(w, s, whole->loss, &r);
    set_flow(w, whole, s, point, line, &f);
    ki_lines_flow_down(&f, &r);
    ki_lines_thin(&f, &r, longest);
    for (size_t q = 0; q < s->left; q++) {
        ki_lines_cell *part = &s->part[q];

        part->line = (size_t)(f.to_line[q] - w->line);
        part->lines = f.lines_kept[q];
        if (part->lines > 0) /* points above the last line do not matter */
            part->points = ki_line_unsure(w->line[part->line + part->lines - 1]);
        part->loss = 0.0;
        if (w->scout)
            part->loss =
                whole->loss - 2.0 * r.hull_margin * (double)(2 + longest[q]);
    }
    if (whole->of_grid) close_gaps(w, s);
    w->work += (double)s->left * (double)whole->lines;
    return true;
}

bool ki_lines_cell_split(ki_lines_worker *w, const ki_lines_cell *whole,
                         size_t depth)
{
    make_parts(w->grid, whole, &w->path[depth]);
    return ki_lines_cell_fill(w, whole, depth);
}
