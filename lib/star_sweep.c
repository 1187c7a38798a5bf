#include <stdint.h>
#include <stdlib.h>

#include "error.h"
#include "star_kernels.h"

/* The nested sweep: every critical corner, any dim.
 *
 * An open box with too few points gets no more of them when a side grows to the
 * next coordinate of a point that is inside in the other axes, or to 1, and its
 * volume rises.  A closed box with too many keeps them when a side shrinks to
 * the last such coordinate, and its volume falls.  An open box with too many, or
 * a closed one with too few, is no worse than the other kind at the same corner.
 * So side k of a corner need only run over the coordinates of the points that
 * the sides before k leave inside, and 1 for open boxes.
 *
 * Level k keeps those points sorted by coordinate k and walks along them; the
 * points passed go, one at a time, into the list of level k + 1, sorted by its
 * coordinate.  The last list holds bare coordinates, and a corner there costs a
 * multiplication and a subtraction.
 *
 * Tied coordinates need no special case.  In a run of equal ones the first
 * position has the right list for an open box and the last for a closed one;
 * the others only understate the deviation. */

typedef struct level {
    size_t *list;  /* the points inside so far, by coordinate k */
    size_t m;      /* how many */
    size_t at;     /* where the walk is */
    double volume; /* the product of the sides before k */
} level;

typedef struct scratch {
    level *levels;    /* dim of them; the last has no list but `last` */
    double *last;     /* m coordinates, and a 1 while it is swept */
    double *rank;     /* rank[j] = j/n */
    double *corner;   /* the corner being visited */
    ki_keyed *sorted; /* room for 2n: all points by coordinate 0 */
} scratch;

/* One walk over all corners of one kind. */
typedef struct sweep {
    ki_best *best;
    scratch *room;
    const koksma_star_opts *opts;
    bool closed;
    double work, next_report;
} sweep;

/* One piece of memory for all of it, or NULL. */
static scratch *make_room(size_t n, size_t dim)
{
    scratch *room;
    size_t per_point, bytes;

    /* This product is more than the sum below it: if one fits, both do. */
    if (__builtin_mul_overflow(dim + 2, sizeof(size_t) + sizeof(level),
                               &per_point) ||
        __builtin_mul_overflow(n + 2, per_point, &bytes))
        return NULL;
    bytes = sizeof *room + dim * (sizeof(level) + sizeof(double)) +
            2 * n * sizeof(ki_keyed) + 2 * (n + 1) * sizeof(double) +
            (dim - 1) * n * sizeof(size_t);
    room = ki_alloc(1, bytes);
    if (room == NULL) return NULL;

    room->levels = (level *)(room + 1);
    room->sorted = (ki_keyed *)(room->levels + dim);
    room->last = (double *)(room->sorted + 2 * n);
    room->rank = room->last + n + 1;
    room->corner = room->rank + n + 1;
    for (size_t k = 0; k + 1 < dim; k++)
        room->levels[k].list = (size_t *)(room->corner + dim) + k * n;
    return room;
}

static void fill_first_level(scratch *room, koksma_points p)
{
    const ki_keyed *sorted = ki_sort_axis(p, 0, room->sorted, room->sorted + p.n);

    for (size_t i = 0; i < p.n; i++)
        if (p.dim > 1)
            room->levels[0].list[i] = sorted[i].i;
        else
            room->last[i] = sorted[i].x;
    for (size_t j = 0; j <= p.n; j++)
        room->rank[j] = (double)j / (double)p.n;
}

/* Put a point into the list of level k. */
static void insert(sweep *s, size_t k, size_t point)
{
    koksma_points p = s->best->p;
    level *to = &s->room->levels[k];
    const double *column = p.x + k;
    double x = column[point * p.dim];
    size_t at = to->m++;

    if (k + 1 == p.dim) {
        double *last = s->room->last;

        for (; at > 0 && last[at - 1] > x; at--)
            last[at] = last[at - 1];
        last[at] = x;
    } else {
        for (; at > 0 && column[to->list[at - 1] * p.dim] > x; at--)
            to->list[at] = to->list[at - 1];
        to->list[at] = point;
    }
}

/* Sweep the last list: all corners whose first dim - 1 sides stand. */
static void sweep_last(sweep *s)
{
    size_t k = s->best->p.dim - 1, m = s->room->levels[k].m;
    double volume = s->room->levels[k].volume, *x = s->room->last;
    const double *inside = s->room->rank + (s->closed ? 1 : 0);
    double sign = s->closed ? -1.0 : 1.0;

    x[m] = 1.0;
    if (!s->closed) m++;
    for (size_t j = 0; j < m; j++)
        if (sign * (volume * x[j] - inside[j]) > s->best->bar) {
            s->room->corner[k] = x[j];
            ki_best_offer(s->best, s->room->corner, s->closed ? j + 1 : j,
                          s->closed);
        }
    s->work += (double)m;
}

/* Take the next step of level k's walk, and say whether corners beyond it can
 * matter: an open box deviates by no more than its volume, a closed one by no
 * more than its share of the points. */
static bool step(sweep *s, size_t k)
{
    koksma_points p = s->best->p;
    level *here = &s->room->levels[k], *next = here + 1;
    size_t at = here->at++;
    double side = at < here->m ? p.x[here->list[at] * p.dim + k] : 1.0;

    if (s->closed)
        insert(s, k + 1, here->list[at]);
    else if (at > 0)
        insert(s, k + 1, here->list[at - 1]);
    s->work += 1.0;
    s->room->corner[k] = side;
    next->volume = here->volume * side;
    return (s->closed ? s->room->rank[next->m] : next->volume) > s->best->bar;
}

static bool told_to_stop(sweep *s, double limit)
{
    const koksma_star_opts *opts = s->opts;

    if (s->work < s->next_report) return false;
    s->next_report = s->work + 0x1p20;
    return s->work > limit ||
           (opts->progress != NULL &&
            opts->progress(opts->state, s->best->value.lower, 1.0, s->work) != 0);
}

/* Returns false when it was stopped. */
static bool walk(sweep *s, double limit)
{
    size_t k = 0, last = s->best->p.dim - 1;
    level *levels = s->room->levels;

    levels[0].m = s->best->p.n;
    levels[0].at = 0;
    levels[0].volume = 1.0;
    for (;;) {
        if (k == last) {
            sweep_last(s);
            if (told_to_stop(s, limit)) return false;
        } else if (levels[k].at < levels[k].m + (s->closed ? 0 : 1)) {
            if (levels[k].at == 0) levels[k + 1].m = 0;
            if (!step(s, k)) continue;
            levels[++k].at = 0;
            continue;
        }
        if (k == 0) return true;
        k--;
    }
}

koksma_status ki_star_sweep(ki_best *b, const koksma_star_opts *opts, double *upper,
                            double *work, bool *stopped)
{
    scratch *room = make_room(b->p.n, b->p.dim);
    sweep s = {.best = b, .room = room, .opts = opts, .next_report = 0x1p20};
    double limit = opts->work > 0.0 ? opts->work : KOKSMA_STAR_WORK;

    if (room == NULL) return KOKSMA_ENOMEM;
    fill_first_level(room, b->p);
    *stopped = !walk(&s, limit);
    s.closed = true;
    if (!*stopped) *stopped = !walk(&s, limit);
    *upper = *stopped ? 1.0 : b->value.upper;
    *work = s.work;
    free(room);
    return KOKSMA_OK;
}
