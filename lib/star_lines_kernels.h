#ifndef KI_STAR_LINES_KERNELS_H
#define KI_STAR_LINES_KERNELS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "star_kernels.h"

/* Kernels that profit from wide vectors come in versions; the one that the machine
 * can run is chosen as the program starts.  They are static, since compilers differ
 * in how other files are to name them. */
#ifdef HAVE_TARGET_CLONES
#define KI_LINES_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define KI_LINES_CLONES
#endif

/* Private: the star discrepancy by filtered lines, in these files:
 *
 *   tree_sort.c          points in the order of a coordinate
 *   star_lines_grid.c    columns and lines
 *   star_lines_climb.c   a first incumbent
 *   star_lines_cell.c    cells of columns, the points and the lines that matter
 *   star_lines_flow.c    points and lines on their way into the parts of a cell
 *   star_lines_thin.c    which lines matter, and why
 *   star_lines_leaf.c    the corners of a small cell
 *   star_lines_finds.c   where a scout saw what may be the best, to look again
 *   star_lines_tasks.c   cells for threads and shares
 *   star_lines.c         the search
 *
 * A corner is a column, its ranks along all axes but the last, and a line, its
 * height along the last.  Ranks run from 0 to n - 1 along the points in the order
 * of a coordinate, tied ones in any order, and rank n stands for the coordinate 1.
 * With the points ranked along the last axis too, and t the product of the
 * column's coordinates times n, the excess of a corner is
 *
 *     open    t y - #{points of lower rank along every axis}
 *     closed  #{points of lower or equal rank along every axis} - t y
 *
 * Tied coordinates need no special case: in a run of equal ones the first rank
 * has the right count for an open box and the last for a closed one, and the
 * others only understate the excess.  (Closed boxes of rank n are real boxes too.)
 */

enum { KI_LINES_AXES = 2, KI_LINES_PARTS = 4, KI_LINES_DEPTH = 72 };

/* A line in a cell of columns [low, high).  The lower half of the tally counts the
 * points that are below the line and inside along every axis whatever the column;
 * the upper half those below it that may be inside or not.  (Below a line of a
 * closed box means below it or on it.) */
typedef struct ki_line {
    double y;
    uint64_t tally;
} ki_line;

static inline uint32_t ki_line_inside(ki_line l) { return (uint32_t)l.tally; }
static inline uint32_t ki_line_unsure(ki_line l)
{
    return (uint32_t)(l.tally >> 32);
}

/* What does not change once it is made. */
typedef struct ki_lines_grid {
    size_t n, axes;              /* axes: all but the last */
    double *side[KI_LINES_AXES]; /* the n + 1 coordinates by rank */
    double *height;              /* n: along the last axis, in order */
    uint32_t *rank; /* rank[p*axes + k]: along axis k, of the p-th in height */
} ki_lines_grid;

koksma_status ki_lines_grid_make(ki_lines_grid *out, koksma_points p,
                                 ki_team *team);
void ki_lines_grid_free(ki_lines_grid *g);

/* Columns low[k] <= rank < high[k], for boxes of one kind.  The grid as a whole has
 * all points, and a line at each height, which are made on the way into its parts.
 * The points and lines of other cells lie in the worker's arrays; of the points
 * those are kept whose ranks are below high and not all below low. */
typedef struct ki_lines_cell {
    uint32_t low[KI_LINES_AXES], high[KI_LINES_AXES];
    bool of_grid, closed;
    size_t point, points;
    size_t line, lines;
    double loss; /* no line dropped on the way was better by more, anywhere */
} ki_lines_cell;

/* The parts that a cell is split in, all of them made at once. */
typedef struct ki_lines_split {
    ki_lines_cell part[KI_LINES_PARTS];
    size_t left; /* parts not searched yet; the last one is next */
} ki_lines_split;

/* The leaves where a scout saw what may tie for the best. */
enum { KI_LINES_FINDS = 64, KI_LINES_CLIMBS = 5 };
typedef struct ki_lines_finds {
    ki_lines_cell leaf[KI_LINES_FINDS];
    double most[KI_LINES_FINDS]; /* no excess in the leaf is above */
    size_t count;
    bool too_many; /* then the list says nothing */
} ki_lines_finds;

/* What the tests make small. */
typedef struct ki_lines_sizes {
    size_t leaf;   /* columns of a cell that is not split any more */
    size_t finds;  /* at most KI_LINES_FINDS */
    size_t dense;  /* lines a point, beyond which the hull is tried */
    size_t climbs; /* of either kind of box, at most KI_LINES_CLIMBS */
} ki_lines_sizes;

/* What one thread works with. */
typedef struct ki_lines_worker {
    const ki_lines_grid *grid;
    ki_run *run;
    ki_lines_split path[KI_LINES_DEPTH];
    uint32_t *point; /* ranks of points, as in the grid */
    size_t room_points;
    ki_line *line;
    size_t room_lines;
    double *y, *c; /* the lines of a leaf, apart */
    size_t room_y, room_c;
    uint32_t *start; /* sizes.leaf: the first line that a column's point is below */
    ki_lines_sizes sizes;
    bool scout; /* drop what is hardly better, and note where: see thin.c */
    ki_lines_finds finds; /* of this scout */
    double work;          /* lines looked at since the last report */
} ki_lines_worker;

koksma_status ki_lines_worker_begin(ki_lines_worker *w, const ki_lines_grid *g,
                                    ki_run *run, ki_lines_sizes sizes);
void ki_lines_worker_rest(ki_lines_worker *w); /* give back room for cells */
void ki_lines_worker_end(ki_lines_worker *w);

/* n times the product of the coordinates of a column. */
static inline double ki_lines_slope(const ki_lines_grid *g, const uint32_t *q)
{
    double t = (double)g->n * g->side[0][q[0]];

    return g->axes == 1 ? t : t * g->side[1][q[1]];
}

/* The cell of all columns. */
ki_lines_cell ki_lines_cell_whole(const ki_lines_grid *g, bool closed);

/* Split `whole`, which may lie in path[depth - 1], into path[depth].  Returns false
 * without memory. */
bool ki_lines_cell_split(ki_lines_worker *w, const ki_lines_cell *whole,
                         size_t depth);

/* The same into the parts that path[depth] names by their columns. */
bool ki_lines_cell_fill(ki_lines_worker *w, const ki_lines_cell *whole,
                        size_t depth);

/* Numbers of all parts, side by side; a part that is not there is empty. */
typedef double ki_lanes __attribute__((vector_size(8 * KI_LINES_PARTS)));
typedef uint64_t ki_words __attribute__((vector_size(8 * KI_LINES_PARTS)));

#define KI_LINES_INLINE static inline __attribute__((always_inline))

/* Counts, below 2^32, as the lower half of a double's bits with 2^52 above. */
KI_LINES_INLINE void ki_lines_count(ki_lanes *out, const ki_words *tally)
{
    ki_words bits = (*tally & 0xffffffff) | 0x4330000000000000;

    *out = (ki_lanes)bits - 0x1p52;
}

KI_LINES_INLINE void ki_lines_raise(ki_lanes *a, const ki_lanes *b)
{
    ki_words which = (ki_words)(*b > *a);

    *a = (ki_lanes)(((ki_words)*b & which) | ((ki_words)*a & ~which));
}

/* What the filters go by.  A line below the cut does not matter; rounding takes
 * less than the margins from a difference of excesses. */
typedef struct ki_lines_range {
    ki_words low[KI_LINES_AXES], high[KI_LINES_AXES];
    ki_lanes first, last; /* slopes at a part's first and last column */
    ki_lanes cut;
    double margin, hull_margin;
    size_t dense;
} ki_lines_range;

/* The points and lines of a cell, and where those of its parts go: each part has
 * room for all of them, one more point, and one more line at either end. */
typedef struct ki_lines_flow {
    bool closed;
    size_t axes, points, lines;
    const uint32_t *point;
    const ki_line *line;  /* NULL: one at each height */
    const double *height; /* of the points, then */
    uint32_t *to_point[KI_LINES_PARTS];
    ki_line *to_line[KI_LINES_PARTS];
    ki_words points_kept, lines_kept;
} ki_lines_flow;

/* Hand down the points, and of the lines those that rise: the first filter. */
void ki_lines_flow_down(ki_lines_flow *f, const ki_lines_range *r);

/* Thin the lines of the parts by the other filters: to_line moves on to those that
 * are left.  longest[part]: the longest run of neighbours that the hull drops. */
void ki_lines_thin(ki_lines_flow *f, const ki_lines_range *r, size_t *longest);

/* The excess that a box must have to matter, and to be offered. */
static inline double ki_lines_cut(const ki_lines_worker *w)
{
    return (double)w->grid->n * (ki_run_target(w->run) - w->run->best->slack);
}

static inline double ki_lines_bar(const ki_lines_worker *w)
{
    return (double)w->grid->n * (ki_team_peak(w->run->team) - w->run->best->slack);
}

/* Note a leaf: no excess in it is above `most`, as of what the scout has kept. */
void ki_lines_note(ki_lines_worker *w, const ki_lines_cell *c, double most);

/* Put the finds of several workers together. */
void ki_lines_gather(ki_lines_finds *all, ki_lines_worker *worker, size_t workers);

/* Look again at the finds from the first one on, as many as a cell has parts, each
 * straight from the grid.  Returns false without memory. */
bool ki_lines_revisit(ki_lines_worker *w, const ki_lines_finds *f, size_t first);

/* Offer all corners of the cell that may matter.  Returns false without memory. */
bool ki_lines_leaf(ki_lines_worker *w, const ki_lines_cell *c);

/* A cell with its points and lines apart from any worker's: first the lines.  The
 * grid as a whole has no memory. */
typedef struct ki_lines_task {
    ki_lines_cell cell;
    void *memory;
} ki_lines_task;

typedef struct ki_lines_tasks {
    ki_lines_worker *worker;
    ki_lines_task *task, *next; /* next: of the round after this one */
    size_t count;
} ki_lines_tasks;

/* Split the grid into about so many tasks, or more.  Returns false without
 * memory, where it may also have made the run give up. */
bool ki_lines_make_tasks(ki_lines_tasks *tasks, ki_lines_worker *worker,
                         size_t enough);
void ki_lines_deal_tasks(ki_lines_tasks *tasks, size_t part, size_t parts);
void ki_lines_tasks_free(ki_lines_tasks *tasks);

/* Make a task's cell the worker's own, and free the task's memory.  Returns false
 * without memory. */
bool ki_lines_bring_in(ki_lines_worker *w, ki_lines_task *t, ki_lines_cell *c);

/* Offer a few corners that no step along an axis improves, of each kind of box. */
koksma_status ki_lines_climb(const ki_lines_grid *g, ki_run *run, size_t climbs);

/* The points in a box, counted anew. */
size_t ki_lines_inside(koksma_points p, const double *corner, bool closed);

/* What ki_star_lines does, with such sizes. */
koksma_status ki_star_lines_with(ki_best *b, const koksma_star_opts *opts,
                                 ki_lines_sizes sizes, double *upper, double *work,
                                 bool *stopped);

#endif
