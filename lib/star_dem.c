#include <math.h>
#include <stdlib.h>

#include "error.h"
#include "star_dem_kernels.h"

/* The partition, after [Overmars, Yap 1991]: every critical corner is in a cell,
 * and in none is a point open along two axes.
 *
 * Sort the points along axis 0, and cut the list into ranges.  For the corners that
 * end in a range the points before it are in, those behind it are out, and those of
 * it are open.  For each range do the same along axis 1 with the points that are
 * not out, and so on; behind the last axis there is a cell.  A range is as long as
 * it may be with at most sqrt(n) points, none of them open along an axis before.
 *
 * So along an axis at most sqrt(n) ranges end because they are full, and at most
 * sqrt(n) for each axis before because of an open point: O(n^(dim/2)) cells with
 * O(n) products each.  The list of axis k + 1 grows as the ranges of axis k go by,
 * a point at a time, n^2 steps in all.  It does so once for each range of the axes
 * before k, of which there are O(n^(k/2)), k <= dim - 2: again n^(1 + dim/2).
 *
 * As in star_sweep.c, a side need only take the coordinates of points not out along
 * the axes before, and 1 for open boxes.  It is given by a position j of the sorted
 * list: the points before j are in, and the side is the coordinate of point j for
 * an open box, of point j - 1 for a closed one.
 *
 * Tied coordinates need no special case.  In a run of equal ones the first position
 * has the right count for an open box, and the one behind the last for a closed
 * one; the others only understate the deviation.  A range could begin at any, but
 * does not begin within a run, where nothing is to be gained. */

typedef struct keyed {
    double x;
    size_t i;
} keyed;

typedef struct level {
    keyed *list;       /* the points not out, by coordinate k, and behind them 1 */
    size_t m;          /* how many */
    size_t begin, end; /* the range: these are open, those before are in */
    size_t next;       /* where the next range may begin */
    size_t passed;     /* how many went on to the next level, or to the cell */
    double limit;      /* sign times the best sides up to axis k */
} level;

static const size_t NOWHERE = (size_t)-1;

/* One walk over all cells of one kind of box. */
typedef struct walk {
    const koksma_star_opts *opts;
    ki_dem_cell cell;
    level *levels; /* dim */
    size_t *open;  /* the axis along which point i is open, or NOWHERE */
    size_t most;   /* points in a range */
    double work, next_report;
    void *memory;
} walk;

/* One piece of memory for all of it. */
static bool make_room(walk *w, ki_best *b)
{
    size_t n = b->p.n, dim = b->p.dim, per_point, bytes;
    ki_dem_cell *c = &w->cell;

    /* This product is more than the sum of what is below. */
    per_point = sizeof(keyed) + 2 * sizeof(double) + sizeof(size_t) +
                sizeof(level) + sizeof(ki_dem_axis);
    if (__builtin_mul_overflow(dim + 1, per_point, &per_point) ||
        __builtin_mul_overflow(n + 1, per_point, &bytes))
        return false;
    bytes = dim * sizeof(level) + (dim + 1) * sizeof(ki_dem_axis) +
            dim * (n + 1) * sizeof(keyed) + (dim + 1) * (n + 1) * sizeof(double) +
            dim * (w->most + 1) * sizeof(double) + (n + 1 + dim) * sizeof(double) +
            n * sizeof(size_t);
    w->memory = ki_alloc(1, bytes);
    if (w->memory == NULL) return false;

    w->levels = w->memory;
    c->axis = (ki_dem_axis *)(w->levels + dim);

    keyed *lists = (keyed *)(c->axis + dim + 1);
    double *rows = (double *)(lists + dim * (n + 1));
    double *sides = rows + (dim + 1) * (n + 1);

    c->rank = sides + dim * (w->most + 1);
    c->corner = c->rank + n + 1;
    w->open = (size_t *)(c->corner + dim);
    for (size_t k = 0; k <= dim; k++)
        c->axis[k].row = rows + k * (n + 1);
    for (size_t k = 0; k < dim; k++) {
        w->levels[k].list = lists + k * (n + 1);
        c->axis[k].side = sides + k * (w->most + 1);
    }
    for (size_t j = 0; j <= n; j++)
        c->rank[j] = (double)j / (double)n;
    return true;
}

static double coordinate(const walk *w, size_t i, size_t k)
{
    koksma_points p = w->cell.best->p;

    return p.x[i * p.dim + k];
}

/* The side at position j of a list. */
static double side_at(const walk *w, const level *l, size_t j)
{
    return l->list[w->cell.closed ? j - 1 : j].x;
}

/* Of all sides in the range, the longest for open boxes, the shortest for closed.
 */
static double best_side(const walk *w, const level *l)
{
    return side_at(w, l, w->cell.closed ? l->begin : l->end);
}

/* Put a point into the list of level k. */
static void insert(walk *w, size_t k, size_t i)
{
    level *to = &w->levels[k];
    double x = coordinate(w, i, k);
    size_t at = to->m++;

    to->list[to->m].x = 1.0;
    for (; at > 0 && to->list[at - 1].x > x; at--)
        to->list[at] = to->list[at - 1];
    to->list[at] = (keyed){x, i};
}

/* Put a point that is in along the last axis into the cell: in, or a slab.  A slab
 * offers one side more: the best one stays the last. */
static void insert_in_cell(walk *w, size_t i)
{
    size_t k = w->open[i];

    if (k == NOWHERE) {
        w->cell.inside++;
        return;
    }

    double x = coordinate(w, i, k), *side = w->cell.axis[k].side;
    size_t at = ++w->cell.axis[k].slabs;

    for (; at > 0 && w->cell.sign * side[at - 1] > w->cell.sign * x; at--)
        side[at] = side[at - 1];
    side[at] = x;
}

/* Start to cut level k, with nothing in the level behind it or in the cell. */
static void enter(walk *w, size_t k)
{
    level *l = &w->levels[k];

    l->begin = l->end = l->passed = 0;
    l->next = w->cell.closed ? 1 : 0;
    if (k + 1 < w->cell.best->p.dim) {
        l[1].m = 0;
        l[1].list[0].x = 1.0;
        return;
    }
    w->cell.inside = 0;
    for (size_t j = 0; j < k; j++) {
        w->cell.axis[j].slabs = 0;
        w->cell.axis[j].side[0] = best_side(w, &w->levels[j]);
    }
}

/* Find the next range of level k; returns false when there is none. */
static bool next_range(walk *w, size_t k)
{
    level *l = &w->levels[k];
    const keyed *list = l->list;
    size_t end;

    for (size_t at = l->begin; at < l->end; at++)
        w->open[list[at].i] = NOWHERE;
    l->begin = l->end = l->next;
    if (l->begin > l->m) return false;
    while (l->begin > 0 && l->begin < l->m &&
           list[l->begin].x == list[l->begin - 1].x)
        l->begin++;
    for (end = l->begin;
         end < l->m && end - l->begin < w->most && w->open[list[end].i] == NOWHERE;
         end++)
        w->open[list[end].i] = k;
    l->end = end;
    l->next = end + 1;
    l->limit = (k > 0 ? l[-1].limit : w->cell.sign) * best_side(w, l);
    return true;
}

/* What is not out along axis k is in the list of the next. */
static void fill_next_level(walk *w, size_t k)
{
    level *l = &w->levels[k];

    w->work += (double)(l->end - l->passed);
    for (; l->passed < l->end; l->passed++)
        insert(w, k + 1, l->list[l->passed].i);
}

/* What is in along the last axis is in the cell; what is open are its slabs. */
static void fill_cell(walk *w, size_t last)
{
    level *l = &w->levels[last];
    ki_dem_axis *axis = &w->cell.axis[last];

    for (; l->passed < l->begin; l->passed++)
        insert_in_cell(w, l->list[l->passed].i);
    axis->slabs = l->end - l->begin;
    for (size_t loss = 0; loss <= axis->slabs; loss++)
        axis->side[loss] =
            side_at(w, l, w->cell.closed ? l->end - loss : l->begin + loss);
    w->cell.limit = l->limit;
}

/* Whether cells behind this range can matter: an open box deviates by no more than
 * its volume, a closed one by no more than its share of the points. */
static bool can_matter(const walk *w, size_t k)
{
    const level *l = &w->levels[k];

    return (w->cell.closed ? w->cell.rank[l->end] : l->limit) > w->cell.best->bar;
}

static bool told_to_stop(walk *w)
{
    const koksma_star_opts *opts = w->opts;
    double lower = w->cell.best->value.lower;

    if (w->work < w->next_report) return false;
    w->next_report = w->work + 0x1p20;
    return (opts->work > 0.0 && w->work > opts->work) ||
           (opts->progress != NULL &&
            opts->progress(opts->state, lower, 1.0, w->work) != 0);
}

/* Returns false when it was stopped. */
static bool visit_cells(walk *w)
{
    size_t k = 0, last = w->cell.best->p.dim - 1;

    enter(w, 0);
    for (;;) {
        if (!next_range(w, k)) {
            if (k-- == 0) return true;
        } else if (k == last) {
            fill_cell(w, last);
            w->work += ki_dem_solve(&w->cell);
        } else {
            fill_next_level(w, k);
            if (can_matter(w, k)) enter(w, ++k);
        }
        if (told_to_stop(w)) return false;
    }
}

static int by_x(const void *a, const void *b)
{
    double x = ((const keyed *)a)->x, y = ((const keyed *)b)->x;

    return (x > y) - (x < y);
}

static bool visit_kind(walk *w, bool closed)
{
    level *first = &w->levels[0];
    size_t n = w->cell.best->p.n;

    w->cell.closed = closed;
    w->cell.sign = closed ? -1.0 : 1.0;
    for (size_t i = 0; i < n; i++) {
        w->open[i] = NOWHERE;
        first->list[i] = (keyed){coordinate(w, i, 0), i};
    }
    qsort(first->list, n, sizeof *first->list, by_x);
    first->list[n].x = 1.0;
    first->m = n;
    return visit_cells(w);
}

/* Closed boxes first: of most sets they hold the extreme, and a high bar early
 * saves work on the others. */
koksma_status ki_star_dem(ki_best *b, const koksma_star_opts *opts, double *upper,
                          double *work, bool *stopped)
{
    walk w = {.opts = opts,
              .cell.best = b,
              .most = (size_t)sqrt((double)b->p.n),
              .next_report = 0x1p20};

    if (!make_room(&w, b)) return KOKSMA_ENOMEM;
    *stopped = !visit_kind(&w, true) || !visit_kind(&w, false);
    *upper = *stopped ? 1.0 : b->value.upper;
    *work = w.work;
    free(w.memory);
    return KOKSMA_OK;
}
