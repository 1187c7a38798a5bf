#ifndef KI_TREE_KERNELS_H
#define KI_TREE_KERNELS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "tree_run_kernels.h"

/* Private: the branch and bound for the star and the box discrepancy, in these
 * files:
 *
 *   tree_ranks.c   coordinates as ranks
 *   tree_cell.c    cells of corners, and the points that matter in each
 *   tree_bound.c   what a cell can hold at most, and why; then, for either kind of
 *                  box, tree_bound_open.c and tree_bound_closed.c
 *   tree_dive.c    the search of one cell, depth first
 *   tree.c         the search of all: stages, threads, shares
 *
 * What it knows of volumes it asks its measure: star_bound.c, box_bound.c.
 *
 * A box has an axis a side: the upper ends of a star's boxes, dim axes; or, of
 * boxes anywhere, the lower ends and then the upper ones, 2*dim axes.  Along an
 * axis of lower ends everything runs downwards, so that along every axis a greater
 * corner makes a greater box: the box [a,b] in dim coordinates is one with a corner
 * in the origin, at (1-a, b), for the points (1-x, x).
 *
 * Open and closed boxes are two problems with one incumbent.  In either a corner
 * z is a rank an axis, and a point of rank r is inside along that axis when
 * r + shift <= z, where shift is 1 for open boxes and 0 for closed ones. */

/* Along an axis the distinct coordinates have the ranks 1, ..., top: of a star's
 * boxes those but 0, in increasing order, and 0 has rank 0; of lower ends all in
 * decreasing order, and of upper ends all in increasing order.  Open boxes may
 * always reach to the face of the cube. */
typedef struct ki_axis {
    uint32_t top;
    double *value; /* value[r], 0 <= r <= top */
    double *place; /* place[r], from rank 1 on: increasing, where bounds are linear:
                    * the logarithm; of lower ends -value, of upper ends value */
} ki_axis;

typedef struct ki_measure ki_measure;

typedef struct ki_ranks {
    const ki_measure *measure;
    size_t n, dim; /* dim: of the points */
    size_t axes;
    bool closed;
    uint32_t shift;
    ki_axis *axis;   /* axes */
    uint32_t *rank;  /* rank[k*n + i]: of point i along axis k; the points are
                      * numbered so that neighbours mostly follow each other */
    uint32_t *order; /* order[k*n ...]: the points by rank along axis k */
    void *memory;    /* all of the above */
} ki_ranks;

koksma_status ki_ranks_make(ki_ranks *out, koksma_points p, bool closed,
                            const ki_measure *measure);
void ki_ranks_free(ki_ranks *r);

/* A point in the list of an axis. */
typedef struct ki_entry {
    uint32_t point, rank;
} ki_entry;

/* Where a point stands with respect to a cell, and what the bound wants to know of
 * it; together, since whoever asks for one of these asks for all. */
typedef struct ki_standing {
    uint32_t outs, opens; /* axes along which it is out; open */
    uint32_t reach;       /* how far up its open ranges it stands */
    uint32_t choice;      /* its weight (open boxes) or axis (closed ones) */
} ki_standing;

/* A cell: all corners between two.  Relative to it a point is, along each axis,
 * in (inside whatever the corner), out, or open. */
typedef struct ki_cell {
    uint32_t *low, *high; /* axes ranks each, both included */
    size_t *begin, *end;  /* axes: the list of each axis, in the worker's entries:
                           * points not out along any other axis whose rank lies
                           * in [low, high], by rank (open boxes: at rank high also
                           * some that have gone out along another since) */
    size_t several, severals; /* in the worker's several: points open along more
                               * than one axis and nowhere out */
    size_t inside, within;    /* points in along every axis; points nowhere out */
    size_t free_entry;        /* where in the entries its own lists go */
    size_t undo;              /* length of the worker's log before this cell */
    size_t compact; /* and when its lists were last free of other points */
    bool stale;     /* whether points went out since then */
    double bound;
    size_t split; /* the axis to split, at `middle` */
    uint32_t middle;
    int parts; /* parts visited */
} ki_cell;

/* Cells to search, each in 2 * axes + 1 numbers: whether its boxes are closed, the
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
    uint32_t *several;
    size_t room_several;
    uint32_t *log; /* points whose standing changed, to take it back */
    size_t logged, room_log;

    ki_standing *standing; /* n */

    uint32_t *new_low, *new_high; /* axes: the ranges wanted next */
    double *best_term;            /* axes */
    double *slope;                /* axes: of a ki_slopes */
    size_t *pillars;     /* axes: entries of points open along other axes too */
    uint32_t *best_rank; /* axes: where the bound finds the best corner */
    /* For each entry of the cell's lists, axis after axis, and one more an axis: */
    double *gap;     /* how far its place is from the end that has none */
    uint16_t *share; /* what it is charged (closed boxes) */
    double *term;    /* its term in the bound */
    size_t room_gaps, room_shares, room_terms;
    double *corner; /* axes */

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

/* ---- What the bound asks of a measure ---------------------------------------- */

/* A linear bound of the volumes in a cell, for those corners z that are not below
 * the target.  With places, and slopes in the worker:
 *
 *     open boxes      vol <= base - sum_k slope[k] (place(high_k) - place(z_k))
 *     closed boxes    vol >= base + sum_k slope[k] (place(z_k) - place(low_k))
 *
 * margin covers what rounding can take from the bound made of it, sum over the axes
 * and counts included.  quick is a bound of the deviations, margin included, that
 * needs no slopes: where it is below the target the rest is left alone. */
typedef struct ki_slopes {
    double quick, base, margin;
    double at; /* round 0 leaves something to the next here */
} ki_slopes;

/* Round 0 makes the first line; round 1, 2, ... may adapt it to the corner that the
 * last one found best, best_rank. */
typedef void ki_volume_line(ki_worker *w, const ki_cell *c, double target,
                            uint32_t round, ki_slopes *line);

struct ki_measure {
    bool anchored; /* boxes with a corner in the origin */
    ki_volume_line *open, *closed;
};

/* ---- What the two halves of the bound share ---------------------------------- */

/* The entries of axis k that are open along it: begin <= i < end. */
typedef struct ki_span {
    size_t begin, end;
} ki_span;

ki_span ki_open_entries(const ki_worker *w, const ki_cell *c, size_t k);

/* KI_REACH over the length of the range of axis k, in places; 0 if it has none.  The
 * unit of reach: a whole range. */
enum { KI_REACH = 1 << 16 };
double ki_reach_scale(const ki_worker *w, const ki_cell *c, size_t k);

/* Keep of the new ranges what lies between the first and the last rank whose term
 * is within slack of the best: with any other, even the best of all other axes
 * stay below the target.  side: -1 where the least is best, 1 the greatest. */
void ki_tighten(ki_worker *w, const ki_cell *c, double slack, double side);

/* Round `round` of adapting the weights to the corner that the last one found
 * best: whether it is worth its while. */
bool ki_round_pays(const ki_worker *w, uint32_t round, double gap);

double ki_bound_open(ki_worker *w, const ki_cell *c, double target);
double ki_bound_closed(ki_worker *w, const ki_cell *c, double target);

/* ---- The whole --------------------------------------------------------------- */

/* Offer boxes to b until none in the measure's ranks is better.  before(run,
 * corner) offers what the ranks leave out, with room for a corner; or NULL. */
typedef void ki_tree_before(ki_run *run, double *corner);
koksma_status ki_tree(ki_best *b, const ki_run_opts *opts,
                      const ki_measure *measure, ki_tree_before *before,
                      double *upper, double *work, bool *stopped);

/* The same by climbing alone, until so many starts a kind and axis have made
 * nothing better: *upper is 1.  KI_PATIENCE finds the best box where that is known,
 * but for one set in many. */
enum { KI_PATIENCE = 100 };
koksma_status ki_tree_search(ki_best *b, const ki_run_opts *opts,
                             const ki_measure *measure, size_t patience,
                             double *upper, double *work, bool *stopped);

#endif
