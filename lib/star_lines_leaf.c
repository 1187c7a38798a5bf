#include <math.h>

#include "error.h"
#include "star_lines_kernels.h"

#define INLINE static inline __attribute__((always_inline))

/* Lines are looked at in blocks, as vectors where the machine has them. */
enum { BLOCK = 8 };
typedef double block __attribute__((vector_size(BLOCK * 8), aligned(8)));
typedef int64_t mask __attribute__((vector_size(BLOCK * 8), aligned(8)));

static size_t whole_blocks(size_t m) { return (m + BLOCK - 1) / BLOCK * BLOCK; }

/* Offer the boxes of one column that are above the bar; returns the most of all. */
static double offer_column(ki_lines_worker *w, const uint32_t *q, double t,
                           size_t m, bool closed)
{
    const ki_lines_grid *g = w->grid;
    double corner[KI_LINES_AXES + 1], most = -HUGE_VAL;

    for (size_t k = 0; k < g->axes; k++)
        corner[k] = g->side[k][q[k]];
    for (size_t j = 0; j < m; j++) {
        double excess = t * w->y[j] - w->c[j];

        if (closed) excess = -excess;
        most = fmax(most, excess);
        if (excess <= ki_lines_bar(w)) continue;
        corner[g->axes] = w->y[j];
        ki_run_offer(w->run, corner, (size_t)w->c[j], closed);
    }
    return most;
}

/* Whether a line of whole blocks is above the cut.  sign is -1 for closed boxes. */
INLINE bool some_above(const double *y, const double *c, size_t m, double t,
                       double sign, double cut)
{
    mask any = {0};
    int64_t all = 0;

    for (size_t j = 0; j < m; j += BLOCK) {
        const block *by = (const block *)(const void *)(y + j);
        const block *bc = (const block *)(const void *)(c + j);

        any |= (t * *by - *bc) * sign > cut;
    }
    for (size_t i = 0; i < BLOCK; i++)
        all |= any[i];
    return all != 0;
}

/* One more point below the lines from `start` on. */
INLINE void add_point(double *c, size_t start, size_t m)
{
    size_t j = start;

    for (; j % BLOCK != 0; j++)
        c[j] += 1.0;
    for (; j < m; j += BLOCK)
        *(block *)(void *)(c + j) += 1.0;
}

/* Take the lines apart, and pad them to whole blocks with lines that no column
 * brings above the cut. */
static bool take_apart(ki_lines_worker *w, const ki_line *line, size_t m,
                       bool closed)
{
    size_t all = whole_blocks(m);

    if (ki_grow((void **)&w->y, &w->room_y, all, sizeof *w->y) != 0 ||
        ki_grow((void **)&w->c, &w->room_c, all, sizeof *w->c) != 0)
        return false;
    for (size_t j = 0; j < m; j++) {
        w->y[j] = line[j].y;
        w->c[j] = (double)ki_line_inside(line[j]);
    }
    for (size_t j = m; j < all; j++) {
        w->y[j] = 0.0;
        w->c[j] = closed ? -HUGE_VAL : HUGE_VAL;
    }
    return true;
}

/* start[q]: the first line above the point of column low + q. */
static void find_starts(ki_lines_worker *w, const ki_lines_cell *c,
                        const ki_line *line, size_t m)
{
    const uint32_t *point = w->point + c->point;
    size_t p = 0;

    for (uint32_t q = 0; q < c->high[0] - c->low[0]; q++)
        w->start[q] = (uint32_t)whole_blocks(m);
    for (size_t j = 0; j < m; j++)
        while (p < ki_line_unsure(line[j]))
            w->start[point[p++] - c->low[0]] = (uint32_t)j;
}

KI_LINES_CLONES
static bool sweep_slab(ki_lines_worker *w, const ki_lines_cell *c)
{
    const ki_lines_grid *g = w->grid;
    const ki_line *line = w->line + c->line;
    size_t m = c->lines, all = whole_blocks(m);
    bool closed = c->closed;
    double sign = closed ? -1.0 : 1.0, most = -HUGE_VAL;

    if (!take_apart(w, line, m, closed)) return false;
    find_starts(w, c, line, m);
    for (uint32_t i = 0; i < c->high[0] - c->low[0]; i++) {
        uint32_t q[KI_LINES_AXES] = {c->low[0] + i};
        double t = ki_lines_slope(g, q), cut = ki_lines_bar(w) - c->loss;

        if (closed) add_point(w->c, w->start[i], all);
        if (some_above(w->y, w->c, all, t, sign, cut))
            most = fmax(most, offer_column(w, q, t, m, closed));
        if (!closed) add_point(w->c, w->start[i], all);
    }
    ki_lines_note(w, c, most);
    w->work += (double)m * (double)(c->high[0] - c->low[0]);
    return true;
}

/* The count of one column at each line, by merging points and lines. */
static void count_column(ki_lines_worker *w, const ki_lines_cell *c,
                         const uint32_t *q)
{
    const uint32_t *point = w->point + c->point;
    const ki_line *line = w->line + c->line;
    uint32_t more = c->closed ? 1 : 0;
    size_t p = 0, inside = 0;

    for (size_t j = 0; j < c->lines; j++) {
        for (; p < ki_line_unsure(line[j]); p++)
            inside +=
                (point[2 * p] < q[0] + more) & (point[2 * p + 1] < q[1] + more);
        w->c[j] = (double)(ki_line_inside(line[j]) + inside);
    }
}

static bool sweep_cell(ki_lines_worker *w, const ki_lines_cell *c)
{
    const ki_lines_grid *g = w->grid;
    size_t m = c->lines;
    uint32_t q[KI_LINES_AXES];

    if (!take_apart(w, w->line + c->line, m, c->closed)) return false;
    for (q[0] = c->low[0]; q[0] < c->high[0]; q[0]++)
        for (q[1] = c->low[1]; q[1] < c->high[1]; q[1]++) {
            count_column(w, c, q);
            ki_lines_note(w, c,
                          offer_column(w, q, ki_lines_slope(g, q), m, c->closed));
            w->work += (double)(m + c->points);
        }
    return true;
}

bool ki_lines_leaf(ki_lines_worker *w, const ki_lines_cell *c)
{
    if (c->lines == 0) return true;
    return w->grid->axes == 2 ? sweep_cell(w, c) : sweep_slab(w, c);
}
