#include "box_sweep_kernels.h"

size_t ki_strip_levels(const ki_column *c, double left, double right, bool closed,
                       const ki_strip_room *room)
{
    double *level = room->level;
    size_t *passed = room->passed, levels = 0, count = 0;

    if (!closed) {
        level[levels] = 0.0;
        passed[levels++] = 0;
    }
    for (size_t i = 0; i < c->n; i++) {
        if (c->dim == 2 && (closed ? c->x[i] < left || c->x[i] > right
                                   : c->x[i] <= left || c->x[i] >= right))
            continue;
        if (levels == 0 || level[levels - 1] != c->y[i]) {
            level[levels] = c->y[i];
            passed[levels++] = count;
        }
        count++;
    }
    if (!closed && level[levels - 1] != 1.0) {
        level[levels] = 1.0;
        passed[levels++] = count;
    }
    passed[levels] = count;
    return levels;
}

/* The excess per point of the box between levels i and j. */
static double deviation(const ki_strip_room *room, size_t i, size_t j, double n,
                        double width, bool closed, size_t *inside)
{
    double volume = width * (room->level[j] - room->level[i]);

    *inside = closed ? room->passed[j + 1] - room->passed[i]
                     : room->passed[j] - room->passed[i + 1];
    return closed ? (double)*inside / n - volume : volume - (double)*inside / n;
}

static void offer(ki_run *run, double left, double right, double low, double high,
                  size_t inside, bool closed)
{
    double corners[] = {left, low, right, high};

    ki_run_offer(run, corners, inside, closed);
}

/* Of all boxes that end at level j, only if the best of them is worth it. */
static void offer_below(ki_run *run, const ki_column *c, double left, double right,
                        bool closed, const ki_strip_room *room, size_t j)
{
    double width = right - left, n = (double)c->n;
    size_t inside;

    for (size_t i = 0; i < j + closed; i++)
        if (deviation(room, i, j, n, width, closed, &inside) >=
            ki_team_peak(run->team) - run->best->slack)
            offer(run, left, right, room->level[i], room->level[j], inside, closed);
}

/* What a box that begins at level i has ahead of those that begin elsewhere,
 * wherever it ends. */
static double head_start(const ki_strip_room *room, size_t i, double n,
                         double width, bool closed)
{
    return closed ? width * room->level[i] - (double)room->passed[i] / n
                  : (double)room->passed[i + 1] / n - width * room->level[i];
}

void ki_strip_offer(ki_run *run, const ki_column *c, double left, double right,
                    bool closed, const ki_strip_room *room)
{
    size_t levels = ki_strip_levels(c, left, right, closed, room), lowest = 0,
           inside;
    double width = right - left, n = (double)c->n;
    double lead = -2.0;

    /* `lowest`: where the best box that ends at level j begins. */
    for (size_t j = closed ? 0 : 1; j < levels; j++) {
        size_t next = closed ? j : j - 1;
        double next_lead = head_start(room, next, n, width, closed);

        if (next_lead >= lead) {
            lowest = next;
            lead = next_lead;
        }
        /* Another start may be better by roundings that are below the slack. */
        if (deviation(room, lowest, j, n, width, closed, &inside) >=
            ki_team_peak(run->team) - 2.0 * run->best->slack)
            offer_below(run, c, left, right, closed, room, j);
    }
}
