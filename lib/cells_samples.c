/* The extent from one sample a cell: how often neighbours differ. */
#include <math.h>
#include <stdlib.h>

#include "cells_kernels.h"
#include "error.h"

static const double PI = 3.14159265358979323846;

/* E exp(-(y t)^2) for t = U - U', of density 1 - |t| on [-1,1]. */
static double same_cell(double y)
{
    return (sqrt(PI) * erf(y) + expm1(-y * y) / y) / y;
}

/* And for 1 + t, of density s on [0,1] and 2 - s on [1,2]. */
static double next_cell(double y)
{
    double near = -expm1(-y * y), far = -expm1(-4.0 * y * y);

    return (sqrt(PI) * (erf(2.0 * y) - erf(y)) + (near - 0.5 * far) / y) / y;
}

/* E|e_1 + U - U'|.  With v its square, sqrt v = (1/sqrt pi) times the integral of
 * (1 - exp(-v y^2))/y^2 over y > 0; there y = tan a, and the midpoint rule. */
static double mean_distance(size_t dim)
{
    enum { NODES = 400 };
    double sum = 0.0;

    for (int i = 0; i < NODES; i++) {
        double a = 0.5 * PI * (i + 0.5) / NODES, y = tan(a);
        double mean = next_cell(y) * pow(same_cell(y), (double)(dim - 1));

        sum += (1.0 - mean) / (sin(a) * sin(a));
    }
    return sum * 0.5 * PI / NODES / sqrt(PI);
}

/* The number of the first point in each cell, from 1; 0 where there is none. */
static uint64_t fill(size_t *first, koksma_points p, const uint64_t *cells,
                     uint64_t total)
{
    uint64_t empty = total;

    for (uint64_t i = 0; i < total; i++)
        first[i] = 0;
    for (size_t i = 0; i < p.n; i++) {
        size_t *at = &first[ki_cell_of(p.x + i * p.dim, p.dim, cells)];

        empty -= *at == 0;
        if (*at == 0) *at = i + 1;
    }
    return empty;
}

typedef struct neighbours {
    double pairs, changes, squares;
} neighbours;

/* Neighbours along the axis whose cells are `stride` apart. */
static neighbours compare(const size_t *first, const double *f, uint64_t total,
                          uint64_t stride, uint64_t cells, double jump)
{
    neighbours out = {0.0, 0.0, 0.0};

    for (uint64_t i = 0; i + stride < total; i++) {
        double change;

        if (i / stride % cells == cells - 1) continue;
        if (first[i] == 0 || first[i + stride] == 0) continue;
        change = fabs(f[first[i] - 1] - f[first[i + stride] - 1]);
        out.pairs += 1.0;
        if (!(change > jump)) continue;
        out.changes += 1.0;
        out.squares += change * change;
    }
    return out;
}

/* Along axis j a pair is crossed with the probability changes/pairs, and each line
 * of cells_j of them crosses it cells_j times as often. */
static void sum_up(koksma_samples_result *r, const size_t *first, koksma_points p,
                   const double *f, const uint64_t *cells, double jump)
{
    double raw = 0.0, changes = 0.0, pairs = 0.0, squares = 0.0, noise;
    uint64_t stride = 1;

    for (size_t k = p.dim; k-- > 0; stride *= cells[k]) {
        neighbours n = compare(first, f, r->total, stride, cells[k], jump);

        if (n.pairs > 0.0) raw += n.changes / n.pairs * (double)cells[k];
        pairs += n.pairs;
        changes += n.changes;
        squares += n.squares;
    }
    r->pairs = (uint64_t)pairs;
    r->changes = (uint64_t)changes;
    r->jump_rms = changes > 0.0 ? sqrt(squares / changes) : 0.0;
    r->bias = mean_distance(p.dim);
    noise = changes > 0.0 ? 2.0 / sqrt(changes) : 0.0;
    r->extent = (koksma_estimate){
        raw / r->bias,
        fmax(raw * (1.0 - noise), 0.0) / (1.0 + (double)(p.dim - 1) / 3.0),
        changes > 0.0 ? raw * (1.0 + noise) : (double)NAN, 0.0};
}

koksma_status koksma_samples(koksma_samples_result *out, koksma_points p,
                             const double *f, const uint64_t *cells, double jump,
                             koksma_error *err)
{
    koksma_status status = koksma_points_check(p, err);
    koksma_samples_result r = {0};
    size_t *first;

    if (status != KOKSMA_OK) return status;
    r.total = ki_grid_total(cells, p.dim);
    if (r.total == 0 || !(jump >= 0.0))
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       r.total == 0
                           ? "the number of cells is not from 1 to 2^64 - 1"
                           : "a jump is not a number of 0 or more");
    first = ki_alloc((size_t)r.total, sizeof *first);
    if (first == NULL) return ki_fail_memory(err, "the cells");
    r.empty = fill(first, p, cells, r.total);
    sum_up(&r, first, p, f, cells, jump);
    free(first);
    if (r.pairs == 0)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "no two neighbouring cells have samples");
    *out = r;
    return KOKSMA_OK;
}
