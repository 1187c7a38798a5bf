#include <math.h>

#include "star_dem_kernels.h"

/* What a cell holds: a dynamic program over the axes, of which the only state is
 * how many slabs were lost.
 *
 * Slabs of different axes are different points.  So the points in the box of a
 * corner are known from the sum of its losses, and for each sum only the corner
 * with the greatest product of sides matters.  The row of axis k + 1 follows from
 * that of axis k by trying each loss of axis k with each sum before: n products an
 * axis at most, as there are sqrt(n) losses and about as many sums.
 *
 * Sums beyond a budget are left out: those for which even the best side of every
 * axis would not take the deviation above the bar.
 *
 * Products are formed from the first axis to the last.  Rounding is monotone, so
 * the greatest of the rounded products is in the table exactly, and deviations
 * here are the plain ones of tree_best.c, dim + 1 roundings each. */

static size_t smaller(size_t a, size_t b) { return a < b ? a : b; }

static size_t inside_at(const ki_dem_cell *c, size_t sum)
{
    return c->inside + (c->closed ? c->slabs - sum : sum);
}

static double deviation(const ki_dem_cell *c, double product, size_t sum)
{
    return product - c->sign * c->rank[inside_at(c, sum)];
}

/* Make the row behind this axis; returns the products formed. */
static size_t fill_row(const ki_dem_axis *axis, ki_dem_axis *next, size_t budget)
{
    size_t losses = smaller(axis->slabs, budget), products = 0;

    next->top = smaller(axis->top + losses, budget);
    for (size_t sum = 0; sum <= next->top; sum++)
        next->row[sum] = -HUGE_VAL;
    for (size_t loss = 0; loss <= losses; loss++) {
        size_t count = smaller(axis->top, budget - loss) + 1;
        double side = axis->side[loss], *to = next->row + loss;

        for (size_t sum = 0; sum < count; sum++) {
            double product = axis->row[sum] * side;

            to[sum] = product > to[sum] ? product : to[sum];
        }
        products += count;
    }
    return products;
}

/* The greatest deviation of the corners that have this sum, and the losses chosen
 * for axis k and those behind it. */
static double best_with(const ki_dem_cell *c, size_t k, size_t sum)
{
    const ki_dem_axis *axis = &c->axis[k];
    double product = axis->row[axis->left - axis->loss];

    for (size_t dim = c->best->p.dim; k < dim; k++)
        product *= c->axis[k].side[c->axis[k].loss];
    return deviation(c, product, sum);
}

/* Begin with the least loss that the axes before can make up to `left`. */
static void start_axis(ki_dem_axis *axis, size_t left)
{
    axis->left = left;
    axis->loss = left > axis->top ? left - axis->top : 0;
}

/* Offer all corners with this sum that deviate by more than `least`: choose losses
 * from the last axis to the first, and go on as long as the row says that the
 * axes before can do it.  So every choice that is kept leads to a corner. */
static void offer_sum(ki_dem_cell *c, size_t sum, double least)
{
    size_t dim = c->best->p.dim, k = dim - 1;

    start_axis(&c->axis[k], sum);
    for (;;) {
        ki_dem_axis *axis = &c->axis[k];

        if (axis->loss > smaller(axis->left, axis->slabs)) {
            if (++k == dim) return;
        } else if (best_with(c, k, sum) > least) {
            c->corner[k] = axis->side[axis->loss];
            if (k > 0) {
                start_axis(&c->axis[--k], axis->left - axis->loss);
                continue;
            }
            ki_best_offer(c->best, c->corner, inside_at(c, sum), c->closed);
        }
        c->axis[k].loss++;
    }
}

/* All that may tie with the best corner is offered; what is above the bar, but
 * surely below the best corner, is not: while the bar is low that would be most. */
static void offer_best(ki_dem_cell *c)
{
    const ki_dem_axis *end = &c->axis[c->best->p.dim];
    double least = c->best->bar;

    for (size_t sum = 0; sum <= end->top; sum++) {
        double surely = deviation(c, end->row[sum], sum) - c->best->slack;

        if (surely > least) least = surely;
    }
    for (size_t sum = 0; sum <= end->top; sum++)
        if (deviation(c, end->row[sum], sum) > least) offer_sum(c, sum, least);
}

double ki_dem_solve(ki_dem_cell *c)
{
    size_t dim = c->best->p.dim, budget = 0;
    double products = 1.0;

    c->slabs = 0;
    for (size_t k = 0; k < dim; k++)
        c->slabs += c->axis[k].slabs;
    if (!(deviation(c, c->limit, 0) > c->best->bar)) return products;
    while (budget < c->slabs && deviation(c, c->limit, budget + 1) > c->best->bar)
        budget++;
    c->axis[0].row[0] = c->sign;
    c->axis[0].top = 0;
    for (size_t k = 0; k < dim; k++)
        products += (double)fill_row(&c->axis[k], &c->axis[k + 1], budget);
    offer_best(c);
    return products;
}
