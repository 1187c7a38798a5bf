#include <math.h>

#include "box_sweep_kernels.h"

/* The interval of y with the greatest excess is the best run of consecutive numbers
 * in a row: of each point's weight, 1 or -1, and each gap's length times W.  Such a
 * run is found by halves [Bentley 1984]: it is in one, or ends the lower one and
 * begins the upper one.  A point that comes into the strip changes the nodes above
 * it.
 *
 * W grows with every step, though, and changes all excesses.  But a node only has
 * to know which of two candidates is the better one, and with W the difference of
 * two amounts changes its sign once at most: at that W, `until`, the node is found
 * anew, and the nodes above it; all others stay [Basch, Guibas, Hershberger 1999].
 *
 * Ties in y need no care: between them are gaps of 0, and a run that takes some of
 * the tied points only has no more excess than one that takes all or none.
 *
 * Rounding.  Weights are integers.  A length is a sum along a path of the tree, so
 * it takes 32 roundings at most, and the gaps one each: together it is off by less
 * than 2^-47.  A choice between two candidates is wrong by no more than 2^-50 W
 * when it is made, and by as much when `until` is late; and a path has 32 of them
 * for each end of an interval.  With W <= n, the excess found is below the true one
 * by less than n (2^-47 + 128 * 2^-50 + 2^-51) < n KI_KINETIC_SLACK / 2. */

size_t ki_kinetic_places(size_t n)
{
    size_t places = 2;

    while (places < n + 1)
        places *= 2;
    return places;
}

/* Place 0 is the face y = 0, place i + 1 the i-th point. */
void ki_kinetic_gaps(double *gap, size_t places, const double *y, size_t n)
{
    double below = 0.0;

    for (size_t i = 0; i < n; i++) {
        gap[i] = y[i] - below;
        below = y[i];
    }
    gap[n] = 1.0 - below;
    for (size_t i = n + 1; i < places; i++)
        gap[i] = 0.0;
}

static inline double least(double a, double b) { return a < b ? a : b; }
static inline double positive(double a) { return a > 0.0 ? a : 0.0; }

/* The better of two at W and, if they tie, above it; lowers *until to where that
 * changes.  Without branches, for no one could predict them. */
static inline ki_amount better(ki_amount a, ki_amount b, double W, double *until)
{
    ki_amount ahead = b - a;
    double excess = ahead[0] + W * ahead[1];
    int64_t second =
        -(int64_t)((excess > 0.0) | ((excess == 0.0) & (ahead[1] > 0.0)));
    ki_mask mask = {second, second};
    ki_amount behind =
        (ki_amount)(((ki_mask)-ahead & mask) | ((ki_mask)ahead & ~mask));

    /* An infinity or, if the other never catches up, a NaN, which is not less. */
    *until = least(positive(-behind[0]) / positive(behind[1]), *until);
    return (ki_amount)(((ki_mask)b & mask) | ((ki_mask)a & ~mask));
}

static void join(ki_kinetic *t, size_t k, double W)
{
    const ki_span_best *a = &t->node[2 * k], *b = a + 1;
    ki_span_best *to = &t->node[k];
    double until = least(a->until, b->until);

    to->all = a->all + b->all;
    to->first = better(a->first, a->all + b->first, W, &until);
    to->last = better(b->last, b->all + a->last, W, &until);
    to->any =
        better(better(a->any, b->any, W, &until), a->last + b->first, W, &until);
    to->until = until;
    t->work++;
}

/* A place: its point, if it is there, then its gap.  An interval may be empty. */
static void set_place(ki_kinetic *t, size_t i, bool there, double W)
{
    ki_span_best *to = &t->node[t->places + i];
    double sign = t->closed ? 1.0 : -1.0;
    ki_amount point = {there ? sign : 0.0, 0.0}, gap = {0.0, -sign * t->gap[i]};
    ki_amount nothing = {0.0, 0.0};

    to->until = HUGE_VAL;
    to->all = point + gap;
    if (t->closed) {
        to->first = to->any = point;
        to->last = better(to->all, nothing, W, &to->until);
    } else {
        to->first = better(to->all, nothing, W, &to->until);
        to->last = to->any = gap;
    }
}

void ki_kinetic_start(ki_kinetic *t, const bool *there, size_t n, double W)
{
    for (size_t i = 0; i < t->places; i++)
        set_place(t, i, i > 0 && i <= n && there[i - 1], W);
    for (size_t k = t->places - 1; k > 0; k--)
        join(t, k, W);
}

/* Find node k anew, if it is out of date; the depth is that of the tree, 32. */
static void repair(ki_kinetic *t, size_t k, double W)
{
    if (t->node[k].until > W) return;
    if (k >= t->places) {
        set_place(t, k - t->places, t->node[k].all[0] != 0.0, W);
        return;
    }
    repair(t, 2 * k, W);
    repair(t, 2 * k + 1, W);
    join(t, k, W);
}

/* The nodes above are found anew when they are asked for, once for all points that
 * have come in. */
void ki_kinetic_insert(ki_kinetic *t, size_t i, double W)
{
    size_t k = t->places + i + 1;

    set_place(t, i + 1, true, W);
    while ((k /= 2) > 0 && t->node[k].until >= 0.0)
        t->node[k].until = -1.0;
}

double ki_kinetic_best(ki_kinetic *t, double W)
{
    ki_amount any;

    repair(t, 1, W);
    any = t->node[1].any;
    return any[0] + W * any[1];
}
