#include <float.h>
#include <string.h>

#include "num_kernels.h"
#include "star_kernels.h"

/* No deviation is above 1, though a rounded one may seem so. */
koksma_interval ki_box_deviation(koksma_points p, const double *corner,
                                 size_t inside, bool closed)
{
    koksma_interval v =
        ki_deviation(closed ? 1.0 : -1.0, inside, p.n, ki_volume(corner, p.dim));

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

void ki_best_offer(ki_best *b, const double *corner, size_t inside, bool closed)
{
    size_t dim = b->p.dim;
    koksma_interval v = ki_box_deviation(b->p, corner, inside, closed);

    if (v.upper > b->value.upper) b->value.upper = v.upper;
    if (v.lower < b->value.lower ||
        (v.lower == b->value.lower && !precedes(corner, b->witness.corner, dim)))
        return;
    memcpy(b->witness.corner, corner, dim * sizeof *corner);
    b->witness.inside = inside;
    b->witness.closed = closed;
    b->value.lower = v.lower;
    b->bar = v.lower - b->slack;
}

/* A plain deviation is off by less than dim + 2 half-ulps of 1: dim - 1 products,
 * two roundings in count * (1/n) or one in count/n, one subtraction, and a
 * margin for second-order terms and underflow. */
ki_best ki_best_begin(koksma_points p, double *corner)
{
    double slack = (double)(p.dim + 2) * 2.0 * DBL_EPSILON;

    return (ki_best){
        .p = p, .witness.corner = corner, .slack = slack, .bar = -slack};
}
