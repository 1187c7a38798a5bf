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

void ki_lines_worker_end(ki_lines_worker *w)
{
    free(w->point);
    free(w->line);
    free(w->y);
    free(w->c);
    free(w->start);
}

ki_lines_cell ki_lines_cell_whole(const ki_lines_grid *g)
{
    ki_lines_cell c = {.of_grid = true,
                       .points = g->n,
                       .line[1] = (size_t)(g->line[1] - g->line[0]),
                       .lines = {g->lines[0], g->lines[1]}};

    for (size_t k = 0; k < g->axes; k++)
        c.high[k] = (uint32_t)(g->n + 1);
    return c;
}

/* How many parts the sides of a cell are split in: of two axes both in two, or the
 * one along which the volume varies far more in four. */
static void choose_parts(const ki_lines_grid *g, const ki_lines_cell *c,
                         uint32_t *parts)
{
    double ratio[KI_LINES_AXES];
    uint32_t width[KI_LINES_AXES];

    for (size_t k = 0; k < g->axes; k++) {
        width[k] = c->high[k] - c->low[k];
        ratio[k] = 1.0 - g->side[k][c->low[k]] / g->side[k][c->high[k] - 1];
    }
    parts[0] = 4;
    if (g->axes == 2) {
        parts[0] = parts[1] = 2;
        if (width[1] == 1 || ratio[0] > 2.0 * ratio[1]) parts[0] = 4, parts[1] = 1;
        if (width[0] == 1 || ratio[1] > 2.0 * ratio[0]) parts[0] = 1, parts[1] = 4;
    }
    for (size_t k = 0; k < g->axes; k++)
        if (parts[k] > width[k]) parts[k] = width[k];
}

static void make_parts(const ki_lines_grid *g, const ki_lines_cell *c,
                       ki_lines_split *s)
{
    uint32_t parts[KI_LINES_AXES] = {1, 1}, at[KI_LINES_AXES];

    choose_parts(g, c, parts);
    s->left = parts[0] * parts[1];
    for (size_t q = 0; q < s->left; q++) {
        ki_lines_cell *part = &s->part[q];

        *part = (ki_lines_cell){0};
        at[0] = (uint32_t)q % parts[0];
        at[1] = (uint32_t)q / parts[0];
        for (size_t k = 0; k < g->axes; k++) {
            uint64_t width = c->high[k] - c->low[k];

            part->low[k] = c->low[k] + (uint32_t)(width * at[k] / parts[k]);
            part->high[k] = c->low[k] + (uint32_t)(width * (at[k] + 1) / parts[k]);
        }
    }
}

static void set_range(const ki_lines_worker *w, const ki_lines_split *s,
                      double loss, ki_lines_range *r)
{
    double margin = (double)w->grid->n * w->run->best->slack;

    memset(r, 0, sizeof *r);
    r->margin = w->scout ? 0.0 : margin;
    r->hull_margin = w->scout ? -margin : margin;
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
        r->cut[q] = ki_lines_cut(w) - loss;
    }
}

/* Room for all of whole's points and lines in each part, from `point` and `line`
 * on: with a place to spare, as what is not kept is written too. */
static bool make_room(ki_lines_worker *w, const ki_lines_cell *whole, size_t point,
                      size_t line)
{
    size_t points = KI_LINES_PARTS * (whole->points + 1) * w->grid->axes;
    size_t lines = KI_LINES_PARTS * (whole->lines[0] + whole->lines[1] + 2);

    return ki_grow((void **)&w->point, &w->room_points, point + points,
                   sizeof *w->point) == 0 &&
           ki_grow((void **)&w->line, &w->room_lines, line + lines,
                   sizeof *w->line) == 0;
}

static void set_flow(const ki_lines_worker *w, const ki_lines_cell *whole,
                     size_t point, size_t line, ki_lines_flow *f)
{
    const ki_lines_grid *g = w->grid;

    f->axes = g->axes;
    f->points = whole->points;
    f->point = whole->of_grid ? g->rank : w->point + whole->point;
    for (size_t q = 0; q < KI_LINES_PARTS; q++)
        f->to_point[q] = w->point + point + q * (whole->points + 1) * g->axes;
    for (int closed = 0; closed < 2; closed++) {
        size_t room = whole->lines[closed] + 1;

        f->line[closed] =
            (whole->of_grid ? g->line[0] : w->line) + whole->line[closed];
        f->lines[closed] = whole->lines[closed];
        for (size_t q = 0; q < KI_LINES_PARTS; q++, line += room)
            f->to_line[closed][q] = w->line + line;
    }
}

/* Close the gaps between the parts, from `point` and `line` on. */
static void settle_parts(ki_lines_worker *w, const ki_lines_flow *f,
                         const ki_lines_range *r, ki_lines_split *s, size_t point,
                         size_t line, double loss)
{
    size_t longest[KI_LINES_PARTS] = {0};

    for (size_t q = 0; q < s->left; q++) {
        s->part[q].point = point;
        s->part[q].points = f->points_kept[q];
        memmove(w->point + point, f->to_point[q],
                f->points_kept[q] * f->axes * sizeof *w->point);
        point += f->points_kept[q] * f->axes;
    }
    for (int closed = 0; closed < 2; closed++)
        for (size_t q = 0; q < s->left; q++) {
            s->part[q].line[closed] = line;
            s->part[q].lines[closed] =
                ki_lines_thin(w->line + line, f->to_line[closed][q],
                              f->lines_kept[closed][q], r, q, &longest[q], closed);
            line += s->part[q].lines[closed];
        }
    for (size_t q = 0; q < s->left && w->scout; q++)
        s->part[q].loss = loss - 2.0 * r->hull_margin * (double)(2 + longest[q]);
}

bool ki_lines_cell_split(ki_lines_worker *w, const ki_lines_cell *whole,
                         size_t depth)
{
    ki_lines_split *s = &w->path[depth];
    ki_lines_range r;
    ki_lines_flow f;
    size_t point = 0, line = 0;

    if (!whole->of_grid) { /* behind the last part of the split that it is in */
        point = whole->point + whole->points * w->grid->axes;
        line = whole->line[1] + whole->lines[1];
    }
    make_parts(w->grid, whole, s);
    if (!make_room(w, whole, point, line)) return false;
    set_range(w, s, whole->loss, &r);
    set_flow(w, whole, point, line, &f);
    ki_lines_flow_down(&f, &r);
    settle_parts(w, &f, &r, s, point, line, whole->loss);
    w->work += (double)s->left * (double)(whole->lines[0] + whole->lines[1]);
    return true;
}
