#ifndef KI_STAR_TREE_KERNELS_H
#define KI_STAR_TREE_KERNELS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "star_run_kernels.h"

/* Private: the branch and bound for the star discrepancy, in these files:
 *
 *   star_ranks.c   coordinates as ranks
 *   star_cell.c    cells of corners, and the points that matter in each
 *   star_bound.c   what a cell can hold at most, and why; then, for either kind of
 *                  box, star_bound_open.c and star_bound_closed.c
 *   star_dive.c    the search of one cell, depth first
 *   star_tree.c    the search of all: stages, threads, shares
 *
 * Open and closed boxes are two problems with one incumbent.  In either a corner
 * z is a rank an axis, and a point of rank r is inside along that axis when
 * r + shift <= z, where shift is 1 for open boxes and 0 for closed ones. */

/* Along axis k the distinct coordinates but 0 have the ranks 1, ..., top, in
 * increasing order, and 0 has rank 0.  Open boxes may always reach to 1. */
typedef struct ki_axis {
    uint32_t top;
    double *value; /* value[r], 0 <= r <= top */
    double *log;   /* of the values from rank 1 on */
} ki_axis;

typedef struct ki_ranks {
    size_t n, dim;
    bool closed;
    uint32_t shift;
    ki_axis *axis;   /* dim */
    uint32_t *rank;  /* rank[k*n + i]: of point i along axis k; the points are
                      * numbered so that neighbours mostly follow each other */
    uint32_t *order; /* order[k*n ...]: the points by rank along axis k */
    void *memory;    /* all of the above */
} ki_ranks;

koksma_status ki_ranks_make(ki_ranks *out, koksma_points p, bool closed);
void ki_ranks_free(ki_ranks *r);

/* A point in the list of an axis. */
typedef struct ki_entry {
    uint32_t point, rank;
} ki_entry;

/* Where a point stands with respect to a cell, and what the bound wants to know of
 * it; together, since whoever asks for one of these asks for all. */
typedef struct ki_standing {
    uint32_t outs, opens; /* axes along which it is out; open */
    float reach;          /* how far up its open ranges it stands */
    uint32_t choice;      /* its weight (open boxes) or axis (closed ones) */
} ki_standing;

/* A cell: all corners between two.  Relative to it a point is, along each axis,
 * in (inside whatever the corner), out, or open. */
typedef struct ki_cell {
    uint32_t *low, *high; /* dim ranks each, both included */
    size_t *begin, *end;  /* dim: the list of each axis, in the worker's entries:
                           * points not out along any other axis whose rank lies
                           * in [low, high], by rank (open boxes: at rank high also
                           * some that have gone out along another since) */
    size_t live, lives;   /* in the worker's live: points nowhere out and open
                           * along an axis at least */
    size_t inside;        /* points in along every axis */
    size_t free_entry;    /* where in the entries its own lists go */
    size_t undo;          /* length of the worker's log before this cell */
    size_t compact;       /* and when its lists were last free of other points */
    bool stale;           /* whether points went out since then */
    double bound;
    size_t split; /* the axis to split, at `middle` */
    uint32_t middle;
    int parts; /* parts visited */
} ki_cell;

/* Cells to search, each in 2 * dim + 1 numbers: whether its boxes are closed, the
 * low ranks, the high ranks. */
typedef struct ki_tasks {
    uint32_t *number;
    size_t count, room;
    double most; /* the greatest of their bounds */
} ki_tasks;

/* What one thread works with: the path of cells that it is in, and where each
 * point stands with respect to the last of them. */
typedef struct ki_worker {
    ki_run *run;
    const ki_ranks *ranks;

    ki_cell *cell; /* the path */
    size_t cells, room_cells;
    ki_entry *entry;
    size_t room_entries;
    uint32_t *live;
    size_t room_live;
    uint32_t *log; /* points whose standing changed, to take it back */
    size_t logged, room_log;

    ki_standing *standing; /* n */

    uint32_t *new_low, *new_high; /* dim: the ranges wanted next */
    double *best_term;            /* dim */
    size_t *pillars;     /* dim: entries of points open along other axes too */
    uint32_t *best_rank; /* dim: where the bound finds the best corner */
    /* For each entry of the cell's lists, axis after axis, and one more an axis: */
    double *gap;     /* how far its logarithm is from the end that has none */
    uint16_t *share; /* what it is charged (closed boxes) */
    double *term;    /* its term in the bound */
    size_t room_gaps, room_shares, room_terms;
    double *corner; /* dim */

    double work; /* list entries looked at since the last report */
} ki_worker;

koksma_status ki_worker_begin(ki_worker *w, ki_run *run, const ki_ranks *ranks);
void ki_worker_end(ki_worker *w); /* also of one that is all 0 */

/* Search the cell from low to high.  With tasks, cells whose bound is `most`
 * or less are added to them instead.  Without memory the tree says so, and the team
 * stops. */
void ki_dive(ki_worker *w, const uint32_t *low, const uint32_t *high, double most,
             ki_tasks *tasks);

/* Make cell `depth` of the path a copy of the one before, and return it. */
ki_cell *ki_cell_enter(ki_worker *w, size_t depth);

/* Narrow the cell to [new_low, new_high]; its lists keep points that went out until
 * it is settled.  Returns false without memory. */
bool ki_cell_narrow(ki_worker *w, ki_cell *c);

/* Narrow the cell until the ends of every range are ranks that a corner which
 * matters can have.  *empty: there is none.  Returns false without memory. */
bool ki_cell_settle(ki_worker *w, ki_cell *c, bool *empty);

/* Forget the cell: the points stand as they did before it. */
void ki_cell_leave(ki_worker *w, const ki_cell *c);

/* An upper bound of the deviations of all corners in the cell that are not below
 * the target; new_low and new_high get the ranges that such corners keep to
 * (they may cross: then settling finds the cell empty).
 * Below the target, the bound says that there is none.  The target is 0 or more, so
 * that no digits cancel in the least volume that matters; or -1: all corners. */
double ki_cell_bound(ki_worker *w, const ki_cell *c, double target);

/* ---- What the two halves of the bound share ---------------------------------- */

/* The volumes at the ends of a cell, their logarithms, and A of star_bound.c. */
typedef struct ki_extent {
    double volume_low, volume_high, log_low, log_high, logs;
} ki_extent;

ki_extent ki_cell_extent(const ki_worker *w, const ki_cell *c);

/* What rounding can take from a bound; see star_bound.c. */
double ki_bound_pad(size_t dim, double slope_times_logs);

/* The entries of axis k that are open along it: begin <= i < end. */
typedef struct ki_span {
    size_t begin, end;
} ki_span;

ki_span ki_open_entries(const ki_worker *w, const ki_cell *c, size_t k);

/* 1 over the length of the range of axis k, in logarithms; 0 if it has none. */
double ki_inverse_width(const ki_worker *w, const ki_cell *c, size_t k);

/* Keep of the new ranges what lies between the first and the last rank whose term
 * is within slack of the best: with any other, even the best of all other axes
 * stay below the target.  side: -1 where the least is best, 1 the greatest. */
void ki_tighten(ki_worker *w, const ki_cell *c, double slack, double side);

/* Round `round` of adapting the weights to the corner that the last one found
 * best: whether it is worth its while. */
bool ki_round_pays(const ki_worker *w, uint32_t round, double gap);

double ki_bound_open(ki_worker *w, const ki_cell *c, double target);
double ki_bound_closed(ki_worker *w, const ki_cell *c, double target);

#endif
