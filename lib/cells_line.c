/* Random lines through the cube.  Nothing but square roots is taken, so that a seed
 * gives the same lines on every machine. */
#include <float.h>
#include <math.h>

#include "cells_kernels.h"

void ki_line_along(ki_line *line, size_t dim, size_t axis, koksma_rng *rng)
{
    for (size_t k = 0; k < dim; k++) {
        line->start[k] = koksma_rng_unit(rng);
        line->way[k] = 0.0;
    }
    line->start[axis] = 0.0;
    line->way[axis] = 1.0;
    line->length = 1.0;
}

/* A point of the circle: where one uniform in the disc is seen. */
static void circle(double *c, double radius, koksma_rng *rng)
{
    double a, b, square;

    do {
        a = 2.0 * koksma_rng_unit(rng) - 1.0;
        b = 2.0 * koksma_rng_unit(rng) - 1.0;
        square = a * a + b * b;
    } while (square > 1.0 || square == 0.0);
    c[0] = radius * a / sqrt(square);
    c[1] = radius * b / sqrt(square);
}

static void sort(double *v, size_t n)
{
    for (size_t i = 1; i < n; i++) {
        double one = v[i];
        size_t at = i;

        for (; at > 0 && v[at - 1] > one; at--)
            v[at] = v[at - 1];
        v[at] = one;
    }
}

/* Uniform on the sphere in 2m dimensions: the squared radii of the m planes are
 * distributed like the gaps that m - 1 uniform numbers leave in [0,1], since these
 * are like exponential variables over their sum.  The numbers lie where they are
 * not overwritten before they are read: number i at v[m + i], i < m - 1. */
static void sphere(double *v, size_t m, koksma_rng *rng)
{
    double from = 0.0;

    for (size_t i = 0; i + 1 < m; i++)
        v[m + i] = koksma_rng_unit(rng);
    sort(v + m, m - 1);
    for (size_t i = 0; i < m; i++) {
        double to = i + 1 < m ? v[m + i] : 1.0;

        circle(v + 2 * i, sqrt(to - from), rng);
        from = to;
    }
}

/* Uniform in the ball of dim - 1 dimensions: dim - 1 coordinates of a point of the
 * sphere in dim + 1 (Archimedes).  That of an odd number is one in the next even
 * number with a coordinate left out. */
static void ball(double *v, size_t dim, koksma_rng *rng)
{
    double square;

    sphere(v, (dim + 2) / 2, rng);
    if (dim % 2 == 1) return;
    square = 1.0 - v[dim + 1] * v[dim + 1];
    for (size_t k = 0; k + 1 < dim; k++)
        v[k] /= sqrt(square);
}

/* Lines are uniform when they enter each face uniformly, at a density in proportion
 * to the cosine of their angle with its normal; such directions, seen along the
 * normal, are uniform in a ball. */
void ki_line_across(ki_line *line, size_t dim, double *room, koksma_rng *rng)
{
    size_t axis = (size_t)koksma_rng_below(rng, dim);
    bool upper = koksma_rng_below(rng, 2) == 1;
    double square = 0.0, *v = room;

    for (size_t k = 0; k < dim; k++)
        line->start[k] = koksma_rng_unit(rng);
    line->start[axis] = upper ? 1.0 : 0.0;
    ball(v, dim, rng);
    for (size_t k = 0; k < dim; k++) {
        if (k == axis) continue;
        line->way[k] = *v++;
        square += line->way[k] * line->way[k];
    }
    line->way[axis] = sqrt(fmax(1.0 - square, 0.0)) * (upper ? -1.0 : 1.0);
    line->length = HUGE_VAL;
    for (size_t k = 0; k < dim; k++) {
        double way = line->way[k], room_left;

        if (way == 0.0) continue;
        room_left = way > 0.0 ? 1.0 - line->start[k] : line->start[k];
        line->length = fmin(line->length, room_left / fabs(way));
    }
}
