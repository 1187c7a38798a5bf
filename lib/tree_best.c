#include <float.h>
#include <math.h>

#include "num_kernels.h"
#include "tree_best_kernels.h"

/* Whether x is in a box.  An anchored one has no lower sides. */
static bool is_inside(const double *x, const double *corner, size_t sides,
                      size_t dim, bool closed)
{
    const double *upper = corner + (sides - dim);
    size_t k = 0;

    while (k < dim && (closed ? x[k] <= upper[k] : x[k] < upper[k]) &&
           (sides == dim || (closed ? x[k] >= corner[k] : x[k] > corner[k])))
        k++;
    return k == dim;
}

size_t ki_box_count(koksma_points p, const double *corner, size_t sides,
                    bool closed)
{
    size_t inside = 0;

    for (size_t i = 0; i < p.n; i++)
        inside += is_inside(p.x + i * p.dim, corner, sides, p.dim, closed);
    return inside;
}

static ki_twofold volume(const double *corner, size_t sides, size_t dim)
{
    return sides == dim ? ki_volume(corner, dim)
                        : ki_volume_between(corner, corner + dim, dim);
}

/* No deviation is above 1, though a rounded one may seem so. */
koksma_interval ki_box_deviation(koksma_points p, const double *corner,
                                 size_t sides, size_t inside, bool closed)
{
    koksma_interval v = ki_deviation(closed ? 1.0 : -1.0, inside, p.n,
                                     volume(corner, sides, p.dim));

    if (v.upper > 1.0) v.upper = 1.0;
    return v;
}

/* Whether a comes before b in lexicographic order. */
static bool precedes(const double *a, const double *b, size_t dim)
{
    size_t k = 0;

    while (k < dim && a[k] == b[k])
        k++;
    return k < dim && a[k] < b[k];
}

/* Whether a box with this excess and corner is to stand before the witness.  The
 * order is one of the boxes alone, so that the witness does not depend on the
 * order in which they are offered; and it is fine enough to tell a box from those
 * that a longer or shorter side makes slightly worse. */
static bool is_better(const ki_best *b, ki_twofold excess, const double *corner)
{
    if (excess.hi != b->excess.hi) return excess.hi > b->excess.hi;
    if (excess.lo != b->excess.lo) return excess.lo > b->excess.lo;
    return precedes(corner, b->witness.corner, b->sides);
}

/* Two boxes whose excesses differ by less than the errors of both: either may be
 * the better one. */
static bool may_tie(ki_twofold a, ki_twofold b)
{
    return fabs((a.hi - b.hi) + (a.lo - b.lo)) <= a.err + b.err;
}

/* Whether side s of a closed box ends at a point in it. */
static bool is_held(const ki_best *b, const double *corner, size_t s)
{
    size_t dim = b->p.dim;

    for (size_t i = 0; i < b->p.n; i++) {
        const double *x = b->p.x + i * dim;

        if (x[s % dim] == corner[s] && is_inside(x, corner, b->sides, dim, true))
            return true;
    }
    return false;
}

/* A closed box with a side that could be shorter is no better than one without,
 * which is offered too.  But where it has next to no volume it may tie within the
 * errors, and so decide how wide the interval is; and not every kernel offers it.
 * Elsewhere an ulp of a side shows: n * vol * 2^-53 is more than all errors. */
static bool is_loose(const ki_best *b, const double *corner, bool closed,
                     double vol)
{
    size_t k = 0;

    if (!closed || vol > 0x1p-40) return false;
    while (k < b->sides && is_held(b, corner, k))
        k++;
    return k < b->sides;
}

static bool is_crossed(const ki_best *b, const double *corner)
{
    size_t k = 0;

    if (b->sides == b->p.dim) return false;
    while (k < b->p.dim && corner[k] <= corner[b->p.dim + k])
        k++;
    return k < b->p.dim;
}

/* The value is that of the witness, with the error of any box that may tie with it:
 * all others are surely below.  So it does not depend on the order either. */
void ki_best_offer(ki_best *b, const double *corner, size_t inside, bool closed)
{
    if (is_crossed(b, corner)) return;

    ki_twofold vol = volume(corner, b->sides, b->p.dim);
    ki_twofold excess = ki_excess(closed ? 1.0 : -1.0, inside, b->p.n, vol);
    bool better = is_better(b, excess, corner), tie = may_tie(excess, b->excess);

    if ((!better && !tie) || is_loose(b, corner, closed, vol.hi)) return;
    if (tie) excess.err = b->excess.err = fmax(excess.err, b->excess.err);
    if (better) {
        for (size_t s = 0; s < b->sides; s++)
            b->witness.corner[s] = corner[s] + 0.0; /* not -0 */
        b->witness.inside = inside;
        b->witness.closed = closed;
        b->excess = excess;
    }
    b->value = ki_divide(b->excess, b->p.n);
    b->value.upper = fmin(b->value.upper, 1.0);
    b->proven = fmax(b->proven, b->value.lower);
    b->bar = b->value.lower - b->slack;
}

/* A plain deviation is off by less than sides + 2 half-ulps of 1: dim - 1 products,
 * the dim widths of a box that is not anchored, two roundings in count * (1/n) or
 * one in count/n, one subtraction, and a margin for second-order terms and
 * underflow. */
static ki_best begin(koksma_points p, size_t sides, double *corner)
{
    double slack = (double)(sides + 2) * 2.0 * DBL_EPSILON;

    return (ki_best){.p = p,
                     .sides = sides,
                     .witness.corner = corner,
                     .slack = slack,
                     .bar = -slack};
}

ki_best ki_best_begin(koksma_points p, double *corner)
{
    return begin(p, p.dim, corner);
}

ki_best ki_best_begin_between(koksma_points p, double *both)
{
    return begin(p, 2 * p.dim, both);
}
