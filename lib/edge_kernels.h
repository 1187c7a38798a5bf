#ifndef KI_EDGE_KERNELS_H
#define KI_EDGE_KERNELS_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "edge.h"
#include "num_kernels.h"
#include "part.h"

/* Private: the half-plane discrepancy, in these files:
 *
 *   edge_line.c    which side of a line a point is on, and the area there, exactly
 *   edge_run.c     the best half-plane so far, and what threads share
 *   edge_about.c   all lines about a point
 *   edge_sweep.c   about all points, or a few to begin with
 *   edge_tree.c    branch and bound over cells of lines
 *   edge_cell.c    the points that matter to a cell
 *   edge_leaf.c    the lines of a small cell
 *
 * Which lines matter.  Let H be a closed half-plane with a point in it.  Shifted
 * inwards until its line meets the first of its points it has less area and no less
 * points.  Turned about that point p, it keeps its points until the line meets
 * another one, which stays inside as the line passes through it.  Meanwhile the
 * area changes with the derivative (r^2 - s^2)/2, r and s being what the line has
 * within the square on both sides of p: it is least at one of the ends, where the
 * line meets two points, or where r = s.  So the supremum is attained at a line
 * through two different points, or at one whose chord a point halves.  With
 * a = min(x, 1-x) and b = min(y, 1-y) the latter cuts off the corner next to p, a
 * triangle with the sides 2a and 2b.  (Where x = 1/2 or y = 1/2 more chords are
 * halved by p, all with the same area; this one is at an end of them.)  Its ends
 * are doubles.  At a corner of the square it has no length, and any line that
 * touches the square there will do.
 *
 * Lines have two passes.  In the first the first coordinate runs across and the
 * second up, in the second the other way round, and in each come the lines whose
 * slope is at most 1 in absolute value.  Such a line is told by its heights u and v
 * at 0 and 1, both in [-1,2].
 *
 * Ordinary doubles decide only what they can.  Heights are off by less than 2^-48,
 * and so are areas; a slope from the differences of coordinates, by 2^-50. */
enum { KI_EDGE_PASSES = 2 };

#define KI_EDGE_SLACK 0x1p-44 /* of a local discrepancy, plainly computed */
#define KI_EDGE_NEAR 0x1p-40  /* a point so near to a line may be on either side */

/* The different points, ascending, in arrays that ki_edge_pad has padded; w: how
 * often each is there, or NULL where each is there once. */
typedef struct ki_edge_points {
    const double *x[2]; /* in pass k, x[k] is across and x[1 - k] up */
    const double *w;
    size_t count; /* different ones */
    size_t n;     /* all */
} ki_edge_points;

/* Points of a cell of lines, as a pass sees them. */
typedef struct ki_edge_list {
    const double *x, *y, *w;
    size_t count;
    int pass;
    double under; /* points surely below all lines of the cell, not in the list */
} ki_edge_list;

/* All points. */
static inline ki_edge_list ki_edge_whole(const ki_edge_points *p, int pass)
{
    return (ki_edge_list){.x = p->x[pass],
                          .y = p->x[1 - pass],
                          .w = p->w,
                          .count = p->count,
                          .pass = pass};
}

static inline double ki_edge_weight(const double *w, size_t i)
{
    return w != NULL ? w[i] : 1.0;
}

/* The lines with heights in [u, u + side] x [v, v + side]. */
typedef struct ki_edge_cell {
    double u, v, side;
} ki_edge_cell;

/* Whether a line, its heights plainly computed, may be in the cell. */
static inline bool ki_edge_cell_has(const ki_edge_cell *c, double u, double v)
{
    double most = c->side + KI_EDGE_NEAR / 8.0;

    return u - c->u >= -KI_EDGE_NEAR / 8.0 && u - c->u <= most &&
           v - c->v >= -KI_EDGE_NEAR / 8.0 && v - c->v <= most;
}

/* The area of the square below the line with the heights u and v; without
 * cancellation, so that it is off by less than 2^-50 of itself or its complement.
 */
static inline double ki_edge_area_below(double u, double v)
{
    double low = u < v ? u : v, high = u < v ? v : u;

    if (low >= 0.0 && high <= 1.0) return 0.5 * (low + high);
    if (high <= 0.0) return 0.0;
    if (low >= 1.0) return 1.0;
    if (low < 0.0 && high > 1.0) return (high - 0.5) / (high - low);
    if (low < 0.0) return 0.5 * high * (high / (high - low));
    return 1.0 - 0.5 * (1.0 - low) * ((1.0 - low) / (high - low));
}

/* ---- Lines -------------------------------------------------------------- */

/* The sign of (b - a) x (p - a): 1 where p is left of the line from a to b, 0 on
 * it. Exact; coordinates in [-1,2]. */
int ki_edge_side(const double *a, const double *b, const double *p);

/* The excess n (count/n - area) of the closed half-plane to the left of a -> b, a
 * in the unit square.  All have the same err, n 2^-99. */
ki_twofold ki_edge_excess(const double *a, const double *b, size_t inside,
                          size_t n);

/* The ends of the chord that p halves and that cuts off the corner next to it:
 * end[0] has the height 0 or 1, end[1] the place across.  Returns false where p is
 * that corner. */
bool ki_edge_chord(double end[2][2], double x, double y);

/* ---- The run ------------------------------------------------------------ */

typedef struct ki_edge_run {
    const koksma_edge_opts *opts;
    size_t n;
    ki_team *team;
    koksma_interval value;
    koksma_half_plane witness;
    ki_twofold excess; /* of the witness */
    double factor;     /* lines below factor * peak are of no interest; 1: exact */
    double upper;      /* proven so far */
    double work;       /* as last reported */
    bool no_memory;
} ki_edge_run;

koksma_status ki_edge_run_begin(ki_edge_run *r, size_t n,
                                const koksma_edge_opts *opts);
void ki_edge_run_end(ki_edge_run *r);

/* A local discrepancy or a bound of some, plainly computed, is of interest only
 * above this. */
double ki_edge_bar(const ki_edge_run *r);

/* Offer the line through a and b, points of a pass that differ across: `under`
 * points are strictly below, `on` are on it. */
void ki_edge_offer(ki_edge_run *r, int pass, const double *a, const double *b,
                   double under, double on);

/* Offer the lines that touch the square in a corner where there are points. */
void ki_edge_offer_corners(ki_edge_run *r, const ki_edge_points *p);

/* Now and then add *work to that of the run, tell the caller and make it 0; returns
 * whether to stop. */
bool ki_edge_told_to_stop(ki_edge_run *r, double *work);
void ki_edge_give_up(ki_edge_run *r); /* without memory: all threads stop */

/* Run stage(state) with a factor, or with all that the options ask for; as it
 * returns, no line deviates by more than factor * the incumbent, unless the run was
 * stopped. */
typedef void ki_edge_stage(void *state);
void ki_edge_run_stage(ki_edge_run *r, double factor, ki_edge_stage *stage,
                       void *state);
void ki_edge_run_stages(ki_edge_run *r, ki_edge_stage *stage, void *state);

/* ---- The sweep ---------------------------------------------------------- */

/* A point as the line turns about another one: where it is met. */
typedef struct ki_edge_event {
    double slope;
    uint32_t i; /* its place in the list; its length: the end of the chord */
} ki_edge_event;

/* A point that is met together with others, up to rounding. */
typedef struct ki_edge_near {
    double at[2], about[2];
    uint32_t i;
} ki_edge_near;

/* Scratch of one thread. */
typedef struct ki_edge_sweeper {
    ki_edge_event *event, *spare;
    ki_edge_near *near;
    size_t room;
    double best;    /* the best local discrepancy about the last point, plainly, */
    size_t partner; /* and another point on its line, or the list's length */
} ki_edge_sweeper;

/* Room for lists of count points; false without memory. */
bool ki_edge_sweeper_grow(ki_edge_sweeper *s, size_t count);
void ki_edge_sweeper_free(ki_edge_sweeper *s);

/* Offer all lines about point i of l that the pass has and, where cell is not NULL,
 * that are in it. */
void ki_edge_sweep_about(ki_edge_sweeper *s, ki_edge_run *r, const ki_edge_list *l,
                         size_t i, const ki_edge_cell *cell);

/* Events in the order of their slopes, which are in [-2,2]; in a or in b. */
ki_edge_event *ki_edge_sort(ki_edge_event *a, ki_edge_event *b, size_t count);

/* From a few points, climb to a good line: a first incumbent. */
void ki_edge_climb(ki_edge_run *r, const ki_edge_points *p);

/* All lines about all points: a stage of a run; and a run of that alone. */
void ki_edge_sweep_all(ki_edge_run *r, const ki_edge_points *p);
void ki_edge_sweep(ki_edge_run *r, const ki_edge_points *p);

/* ---- The tree ----------------------------------------------------------- */

void ki_edge_tree(ki_edge_run *r, const ki_edge_points *p);

enum {
    KI_EDGE_PARTS = 4
}; /* part k has the upper half of u if k & 1, of v if k & 2 */

/* What is below all lines of a part of the cell, and what is above all. */
typedef struct ki_edge_split {
    double below[KI_EDGE_PARTS], above[KI_EDGE_PARTS];
} ki_edge_split;

/* The lists of cells are read up to so many points beyond their end: ki_edge_pad
 * puts some there that count as nothing. */
enum { KI_EDGE_LANES = 8 };
void ki_edge_pad(double *x, double *y, double *w, size_t count);

/* Count for all four parts at once. */
void ki_edge_cell_split(ki_edge_split *s, const ki_edge_cell *c,
                        const ki_edge_list *l);

/* The points of l that may be on either side of a line of c go to x, y and, where l
 * has weights, w.  Returns how many, and adds those below to *under. */
size_t ki_edge_cell_keep(double *x, double *y, double *w, double *under,
                         const ki_edge_cell *c, const ki_edge_list *l);

/* Offer all lines of a cell that may matter: for few points, and for any number;
 * *work and *spent count the points that were looked at. */
enum { KI_EDGE_FEW = 6 };
void ki_edge_leaf(ki_edge_run *r, const ki_edge_list *l, const ki_edge_cell *c);
bool ki_edge_leaf_many(ki_edge_sweeper *s, ki_edge_run *r, const ki_edge_list *l,
                       const ki_edge_cell *c, double *work, double *spent);

#endif
