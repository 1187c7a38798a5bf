#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "tree_kernels.h"

/* A cell narrows along one axis or more; points change their standing, and every
 * change is logged, so that leaving the cell takes it back.  Lists are sorted by
 * rank: what becomes in is a prefix of its axis' list, what becomes out a
 * suffix.  Only when points went out do the lists of the other axes change, and
 * are then copied behind those of the parent; else parent and part share them.
 *
 * Which corners matter: in an optimal one, the side along axis k ends at a point
 * that the other sides leave inside (open boxes: or at 1), since else it could
 * move on to the next such point for the better.  So the ranks in the list of
 * axis k are all that a corner needs, and the list keeps, besides the points
 * that are open along k, those at its end that is still a possible rank: of rank
 * high for open boxes, which are out, and of rank low for closed ones, which are
 * in. */

static const uint32_t OUT = (uint32_t)1 << 31; /* in the log: went out, not in */

static bool went(ki_worker *w, uint32_t change)
{
    if (w->logged == w->room_log &&
        ki_grow((void **)&w->log, &w->room_log, w->logged + 1, sizeof *w->log) != 0)
        return false;
    w->log[w->logged++] = change;
    return true;
}

static bool go_out(ki_worker *w, ki_cell *c, uint32_t point)
{
    if (w->standing[point].outs++ == 0) c->within--;
    return went(w, point | OUT);
}

static bool go_in(ki_worker *w, ki_cell *c, uint32_t point)
{
    ki_standing *s = &w->standing[point];

    if (--s->opens == 0 && s->outs == 0) c->inside++;
    return went(w, point);
}

/* Lower the upper end of axis k's range. */
static bool lower_high(ki_worker *w, ki_cell *c, size_t k, uint32_t high)
{
    const ki_entry *e = w->entry;
    uint32_t shift = w->ranks->shift, before = c->high[k];
    size_t end = c->end[k], begin = c->begin[k];

    for (; end > begin && e[end - 1].rank > high; end--)
        if (e[end - 1].rank + shift <= before && !go_out(w, c, e[end - 1].point))
            return false;
    if (shift > 0)
        for (size_t i = end; i > begin && e[i - 1].rank == high; i--)
            if (!go_out(w, c, e[i - 1].point)) return false;
    c->stale = true;
    c->end[k] = end;
    c->high[k] = high;
    return true;
}

/* Raise the lower end of axis k's range. */
static bool raise_low(ki_worker *w, ki_cell *c, size_t k, uint32_t low)
{
    const ki_entry *e = w->entry;
    uint32_t shift = w->ranks->shift, before = c->low[k];
    size_t end = c->end[k], begin = c->begin[k];

    for (; begin < end && e[begin].rank < low; begin++)
        if (e[begin].rank + shift > before && !go_in(w, c, e[begin].point))
            return false;
    if (shift == 0)
        for (size_t i = begin; i < end && e[i].rank == low; i++)
            if (!go_in(w, c, e[i].point)) return false;
    c->begin[k] = begin;
    c->low[k] = low;
    return true;
}

/* Copy the lists without the points that are out along another axis. */
static bool copy_lists(ki_worker *w, ki_cell *c)
{
    size_t axes = w->ranks->axes, all = c->free_entry;
    ki_entry *to;

    for (size_t k = 0; k < axes; k++)
        all += c->end[k] - c->begin[k];
    /* One more: the copy below writes before it knows whether to keep. */
    if (ki_grow((void **)&w->entry, &w->room_entries, all + 1, sizeof *w->entry) !=
        0)
        return false;
    to = w->entry + c->free_entry;
    for (size_t k = 0; k < axes; k++) {
        const ki_entry *e = w->entry + c->begin[k], *end = w->entry + c->end[k];
        const ki_entry *own = end; /* from here on out along k itself */

        if (w->ranks->shift > 0)
            while (own > e && own[-1].rank == c->high[k])
                own--;
        c->begin[k] = (size_t)(to - w->entry);
        for (; e < own; e++) {
            *to = *e;
            to += w->standing[e->point].outs == 0;
        }
        for (; e < end; e++) {
            *to = *e;
            to += w->standing[e->point].outs == 1;
        }
        c->end[k] = (size_t)(to - w->entry);
    }
    return true;
}

/* Drop from the points open along several axes those that no longer are, or went
 * out. */
static bool copy_several(ki_worker *w, ki_cell *c, size_t at)
{
    uint32_t *to;

    if (ki_grow((void **)&w->several, &w->room_several, at + c->severals + 1,
                sizeof *w->several) != 0)
        return false;
    to = w->several + at;
    for (const uint32_t *p = w->several + c->several, *end = p + c->severals;
         p < end; p++) {
        *to = *p;
        to += (w->standing[*p].outs == 0) & (w->standing[*p].opens > 1);
    }
    c->several = at;
    c->severals = (size_t)(to - (w->several + at));
    return true;
}

/* Where the copies of c go: behind what its parent needs.  In c->several the copy
 * may overlap the original, which it only shortens. */
static size_t several_place(const ki_worker *w, const ki_cell *c)
{
    const ki_cell *parent = c > w->cell ? c - 1 : NULL;

    return parent != NULL ? parent->several + parent->severals : 0;
}

/* Make the lists hold what they should. */
static bool compact(ki_worker *w, ki_cell *c)
{
    if (c->compact == w->logged) return true;
    if (c->stale && !copy_lists(w, c)) return false;
    if (!copy_several(w, c, several_place(w, c))) return false;
    c->stale = false;
    c->compact = w->logged;
    return true;
}

bool ki_cell_narrow(ki_worker *w, ki_cell *c)
{
    for (size_t k = 0; k < w->ranks->axes; k++) {
        if (w->new_high[k] < c->high[k] && !lower_high(w, c, k, w->new_high[k]))
            return false;
        if (w->new_low[k] > c->low[k] && !raise_low(w, c, k, w->new_low[k]))
            return false;
    }
    return true;
}

/* Drop from both ends of the list of axis k what is out along another axis.  Own:
 * how often a point that can still be the end of a side is out. */
static void trim(const ki_worker *w, ki_cell *c, size_t k)
{
    const ki_entry *e = w->entry;
    const ki_standing *s = w->standing;
    size_t begin = c->begin[k], end = c->end[k];
    uint32_t last = w->ranks->shift > 0 ? c->high[k] : UINT32_MAX;

    while (begin < end && s[e[begin].point].outs != (e[begin].rank == last))
        begin++;
    while (begin < end && s[e[end - 1].point].outs != (e[end - 1].rank == last))
        end--;
    c->begin[k] = begin;
    c->end[k] = end;
}

bool ki_cell_settle(ki_worker *w, ki_cell *c, bool *empty)
{
    bool changed = true;

    *empty = false;
    while (changed) {
        changed = false;
        for (size_t k = 0; k < w->ranks->axes; k++) {
            /* An open box may reach to 1 without a point there. */
            bool to_one =
                w->ranks->shift > 0 && c->high[k] == w->ranks->axis[k].top;

            if (c->stale) trim(w, c, k);

            const ki_entry *first = w->entry + c->begin[k],
                           *end = w->entry + c->end[k];

            *empty = first == end && !to_one;
            if (*empty) return true;
            w->new_low[k] = first < end ? first->rank : c->high[k];
            w->new_high[k] = to_one ? c->high[k] : end[-1].rank;
            changed |= w->new_low[k] != c->low[k] || w->new_high[k] != c->high[k];
        }
        if (changed && !ki_cell_narrow(w, c)) return false;
    }
    return compact(w, c);
}

void ki_cell_leave(ki_worker *w, const ki_cell *c)
{
    while (w->logged > c->undo) {
        uint32_t change = w->log[--w->logged];

        if (change & OUT)
            w->standing[change & ~OUT].outs--;
        else
            w->standing[change].opens++;
    }
}

/* Room for one more cell on the path; its arrays stay with it. */
static ki_cell *cell_at(ki_worker *w, size_t depth)
{
    size_t axes = w->ranks->axes;

    if (ki_grow((void **)&w->cell, &w->room_cells, depth + 1, sizeof *w->cell) != 0)
        return NULL;
    if (depth == w->cells) {
        ki_cell *c = &w->cell[depth];
        char *memory = ki_alloc(2 * axes, sizeof *c->begin + sizeof *c->low);

        if (memory == NULL) return NULL;
        c->begin = (size_t *)memory;
        c->end = c->begin + axes;
        c->low = (uint32_t *)(c->end + axes);
        c->high = c->low + axes;
        w->cells++;
    }
    return &w->cell[depth];
}

ki_cell *ki_cell_enter(ki_worker *w, size_t depth)
{
    size_t axes = w->ranks->axes;
    ki_cell *c = cell_at(w, depth);
    const ki_cell *from;

    if (c == NULL) return NULL;
    from = c - 1;
    memcpy(c->low, from->low, axes * sizeof *c->low);
    memcpy(c->high, from->high, axes * sizeof *c->high);
    memcpy(c->begin, from->begin, axes * sizeof *c->begin);
    memcpy(c->end, from->end, axes * sizeof *c->end);
    c->several = from->several;
    c->severals = from->severals;
    c->inside = from->inside;
    c->within = from->within;
    c->free_entry = from->begin[0];
    for (size_t k = 0; k < axes; k++)
        if (from->end[k] > c->free_entry) c->free_entry = from->end[k];
    if (from->free_entry > c->free_entry) c->free_entry = from->free_entry;
    c->undo = c->compact = w->logged;
    c->stale = false;
    c->parts = 0;
    return c;
}

/* The whole of the corners: cell 0 of the path. */
static bool enter_root(ki_worker *w)
{
    const ki_ranks *r = w->ranks;
    ki_cell *c = cell_at(w, 0);
    size_t at = 0, all;

    if (c == NULL || __builtin_mul_overflow(r->n, r->axes, &all) ||
        ki_grow((void **)&w->entry, &w->room_entries, all + 1, sizeof *w->entry) !=
            0 ||
        ki_grow((void **)&w->several, &w->room_several, r->n + 1,
                sizeof *w->several) != 0)
        return false;
    for (size_t k = 0; k < r->axes; k++) {
        const uint32_t *rank = r->rank + k * r->n;

        c->low[k] = 1;
        c->high[k] = r->axis[k].top;
        for (size_t i = 0; i < r->n; i++) {
            w->standing[i].outs += rank[i] + r->shift > c->high[k];
            w->standing[i].opens +=
                rank[i] + r->shift > 1 && rank[i] + r->shift <= c->high[k];
        }
    }
    for (size_t k = 0; k < r->axes; k++) {
        c->begin[k] = at;
        for (size_t j = 0; j < r->n; j++) {
            uint32_t i = r->order[k * r->n + j], rank = r->rank[k * r->n + i];

            w->entry[at] = (ki_entry){i, rank};
            at += rank > 0 && w->standing[i].outs == (rank + r->shift > c->high[k]);
        }
        c->end[k] = at;
    }
    c->several = c->severals = c->inside = c->within = c->undo = c->compact = 0;
    c->stale = false;
    c->free_entry = at;
    c->parts = 0;
    for (size_t i = 0; i < r->n; i++) {
        if (w->standing[i].outs > 0) continue;
        c->within++;
        c->inside += w->standing[i].opens == 0;
        if (w->standing[i].opens > 1) w->several[c->severals++] = (uint32_t)i;
    }
    return true;
}

koksma_status ki_worker_begin(ki_worker *w, ki_run *run, const ki_ranks *ranks)
{
    size_t n = ranks->n, axes = ranks->axes;

    *w = (ki_worker){.run = run, .ranks = ranks};
    w->standing = calloc(n, sizeof *w->standing);
    w->new_low = ki_alloc(axes, sizeof *w->new_low);
    w->new_high = ki_alloc(axes, sizeof *w->new_high);
    w->best_term = ki_alloc(axes, 2 * sizeof *w->best_term);
    w->pillars = ki_alloc(axes, sizeof *w->pillars);
    w->best_rank = ki_alloc(axes, sizeof *w->best_rank);
    w->corner = ki_alloc(axes, sizeof *w->corner);
    if (w->standing != NULL && w->new_low != NULL && w->new_high != NULL &&
        w->best_term != NULL && w->pillars != NULL && w->best_rank != NULL &&
        w->corner != NULL) {
        w->slope = w->best_term + axes;
        if (enter_root(w)) return KOKSMA_OK;
    }
    ki_worker_end(w);
    return KOKSMA_ENOMEM;
}

void ki_worker_end(ki_worker *w)
{
    for (size_t i = 0; i < w->cells; i++)
        free(w->cell[i].begin);
    free(w->cell);
    free(w->entry);
    free(w->several);
    free(w->log);
    free(w->standing);
    free(w->new_low);
    free(w->new_high);
    free(w->best_term);
    free(w->pillars);
    free(w->best_rank);
    free(w->gap);
    free(w->term);
    free(w->share);
    free(w->corner);
    *w = (ki_worker){0};
}
