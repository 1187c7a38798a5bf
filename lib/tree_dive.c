#include <math.h>
#include <string.h>

#include "error.h"
#include "tree_kernels.h"

/* Depth first, the upper part of a cell first: large boxes hold the extremes. */

/* Whether one corner is left; it is then offered. */
static bool is_corner(ki_worker *w, const ki_cell *c)
{
    const ki_ranks *r = w->ranks;

    for (size_t k = 0; k < r->axes; k++)
        if (c->low[k] != c->high[k]) return false;
    for (size_t k = 0; k < r->axes; k++)
        w->corner[k] = r->axis[k].value[c->low[k]];
    ki_run_offer(w->run, w->corner, c->inside, r->closed);
    return true;
}

static size_t entries(const ki_worker *w, const ki_cell *c)
{
    size_t sum = 0;

    for (size_t k = 0; k < w->ranks->axes; k++)
        sum += c->end[k] - c->begin[k];
    return sum;
}

/* Split where most points are open along other axes too, over the longest range if
 * places are logarithms, at the middle of the list.  Measured. */
static void choose_split(ki_worker *w, ki_cell *c)
{
    double best = -1.0;

    for (size_t k = 0; k < w->ranks->axes; k++) {
        const double *place = w->ranks->axis[k].place;
        size_t count = c->end[k] - c->begin[k];
        double range = place[c->high[k]] - place[c->low[k]];
        double weight = ((double)w->pillars[k] + 0.1 * (double)count) *
                        (w->ranks->measure->anchored ? range : 1.0);

        if (c->low[k] == c->high[k] || weight <= best) continue;
        best = weight;
        c->split = k;
    }

    const ki_entry *e = w->entry + c->begin[c->split],
                   *end = w->entry + c->end[c->split];

    /* The upper part begins there, so it must not be `low`. */
    e += (end - e) / 2;
    while (e < end && e->rank == c->low[c->split])
        e++;
    c->middle = e < end ? e->rank : c->high[c->split];
}

/* Settle the cell; whether there is more of it than a corner. */
static bool settle(ki_worker *w, ki_cell *c)
{
    bool empty = false;

    if (!ki_cell_settle(w, c, &empty)) {
        ki_run_give_up(w->run);
        return false;
    }
    return !empty && !is_corner(w, c);
}

/* Bound the cell, tighten it while that pays, and settle how to split it.
 * Returns whether there is anything left to split. */
static bool examine(ki_worker *w, ki_cell *c)
{
    size_t before;

    if (!settle(w, c)) return false;
    do {
        before = entries(w, c);
        c->bound = ki_cell_bound(w, c, ki_run_target(w->run));
        if (c->bound < ki_run_target(w->run)) return false;
        if (c->bound == HUGE_VAL || !ki_cell_narrow(w, c)) {
            ki_run_give_up(w->run);
            return false;
        }
        if (!settle(w, c)) return false;
    } while ((double)entries(w, c) <= 0.95 * (double)before);
    choose_split(w, c);
    return true;
}

/* Whether both parts of a cell were visited, or what is left does not matter. */
static bool is_done(const ki_worker *w, const ki_cell *c)
{
    return c->parts == 2 || c->bound < ki_run_target(w->run);
}

/* Enter, below cell `depth` of the path, the cell of new_low and new_high. */
static bool enter(ki_worker *w, size_t depth)
{
    ki_cell *c = ki_cell_enter(w, depth + 1);

    if (c != NULL && ki_cell_narrow(w, c)) return true;
    ki_run_give_up(w->run);
    return false;
}

/* Enter the next part of cell `depth`: its upper one, then its lower one. */
static bool enter_part(ki_worker *w, size_t depth)
{
    ki_cell *whole = &w->cell[depth];

    memcpy(w->new_low, whole->low, w->ranks->axes * sizeof *whole->low);
    memcpy(w->new_high, whole->high, w->ranks->axes * sizeof *whole->high);
    if (whole->parts++ == 0)
        w->new_low[whole->split] = whole->middle;
    else
        w->new_high[whole->split] = whole->middle - 1;
    return enter(w, depth);
}

static bool add_task(ki_tasks *tasks, const ki_worker *w, const ki_cell *c)
{
    size_t axes = w->ranks->axes, size = 2 * axes + 1;
    uint32_t *to;

    if (ki_grow((void **)&tasks->number, &tasks->room, (tasks->count + 1) * size,
                sizeof *tasks->number) != 0)
        return false;
    tasks->most = fmax(tasks->most, c->bound);
    to = tasks->number + tasks->count++ * size;
    *to++ = w->ranks->closed;
    memcpy(to, c->low, axes * sizeof *to);
    memcpy(to + axes, c->high, axes * sizeof *to);
    return true;
}

/* Search the cell `depth` of the path; say whether it is to be split. */
static bool open_up(ki_worker *w, size_t depth, double most, ki_tasks *tasks)
{
    ki_cell *c = &w->cell[depth];

    if (!examine(w, c)) return false;
    if (tasks == NULL || c->bound > most) return true;
    if (!add_task(tasks, w, c)) ki_run_give_up(w->run);
    return false;
}

void ki_dive(ki_worker *w, const uint32_t *low, const uint32_t *high, double most,
             ki_tasks *tasks)
{
    size_t depth =
        0; /* of the cell whose parts are visited; 0: none, but the root */

    memcpy(w->new_low, low, w->ranks->axes * sizeof *low);
    memcpy(w->new_high, high, w->ranks->axes * sizeof *high);
    if (!enter(w, 0)) return;
    do {
        if (open_up(w, depth + 1, most, tasks))
            depth++;
        else
            ki_cell_leave(w, &w->cell[depth + 1]);
        while (depth > 0 && is_done(w, &w->cell[depth]))
            ki_cell_leave(w, &w->cell[depth--]);
    } while (depth > 0 && !ki_run_told_to_stop(w->run, &w->work) &&
             enter_part(w, depth));
}
