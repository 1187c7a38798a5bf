/* Grids for n points. */
#include <math.h>

#include "cells_kernels.h"
#include "error.h"

/* ---- Cubes ------------------------------------------------------------------- */

static bool power_fits(uint64_t k, size_t dim, uint64_t n)
{
    uint64_t power = 1;

    for (size_t j = 0; j < dim && power > 0 && k > 1; j++) {
        if (power > n / k) return false;
        power *= k;
    }
    return true;
}

/* pow is off by no more than one; integers decide. */
static uint64_t root(uint64_t n, size_t dim)
{
    double guess = floor(pow((double)n, 1.0 / (double)dim));
    uint64_t k;

    if (dim == 1) return n;
    k = guess < 1.0 ? 1 : (uint64_t)guess;
    while (k > 1 && !power_fits(k, dim, n))
        k--;
    while (power_fits(k + 1, dim, n))
        k++;
    return k;
}

/* ---- Elementary intervals ---------------------------------------------------- */

/* What is minimised: the mean of the sides times product^exponent, that is but for
 * a constant their mean over their geometric mean, times product^-(dim-1)/2dim. */
typedef struct search {
    uint64_t n;
    size_t dim;
    const uint32_t *bases;
    double exponent;
    double least;
    uint64_t best[KOKSMA_GRID_BASES_MOST], cells[KOKSMA_GRID_BASES_MOST];
} search;

static void offer(search *s, double sides, uint64_t product)
{
    double cost = sides * pow((double)product, s->exponent);

    if (cost >= s->least) return;
    s->least = cost;
    for (size_t k = 0; k < s->dim; k++)
        s->best[k] = s->cells[k];
}

/* No completion costs less: the sides that are left have a mean above the geometric
 * one, and a product of cells of at most n/product. */
static double cost_at_least(const search *s, double sides, uint64_t product,
                            size_t left)
{
    double rest = (double)s->n / (double)product;
    double most = s->exponent > 0.0 ? (double)product : (double)s->n;

    return (sides + (double)left * pow(rest, -1.0 / (double)left)) *
           pow(most, s->exponent) * (1.0 - 1e-12);
}

static void try_axis(search *s, size_t axis, double sides, uint64_t product)
{
    uint32_t base = s->bases[axis];

    for (uint64_t power = 1;; power *= base) {
        double with = sides + 1.0 / (double)power;
        size_t left = s->dim - 1 - axis;

        s->cells[axis] = power;
        if (left == 0)
            offer(s, with, product * power);
        else if (cost_at_least(s, with, product * power, left) < s->least)
            try_axis(s, axis + 1, with, product * power);
        if (power > s->n / product / base) return;
    }
}

/* Divide the widest cells while any can be: a cost to be beaten. */
static void divide_widest(search *s)
{
    uint64_t product = 1;
    double sides = 0.0;

    for (size_t k = 0; k < s->dim; k++)
        s->cells[k] = 1;
    for (;;) {
        size_t widest = s->dim;

        for (size_t k = 0; k < s->dim; k++)
            if (s->bases[k] <= s->n / product &&
                (widest == s->dim || s->cells[k] < s->cells[widest]))
                widest = k;
        if (widest == s->dim) break;
        s->cells[widest] *= s->bases[widest];
        product *= s->bases[widest];
    }
    for (size_t k = 0; k < s->dim; k++)
        sides += 1.0 / (double)s->cells[k];
    offer(s, sides, product);
}

void ki_grid_powers(uint64_t *cells, uint64_t n, size_t dim, const uint32_t *bases)
{
    double d = (double)dim;
    search s = {.n = n, .dim = dim, .bases = bases, .least = HUGE_VAL};

    s.exponent = (3.0 - d) / (2.0 * d);
    divide_widest(&s);
    /* In one dimension all costs are equal, and the finest grid is taken. */
    if (dim > 1) try_axis(&s, 0, 0.0, 1);
    for (size_t k = 0; k < dim; k++)
        cells[k] = s.best[k];
}

/* ---- What is public ---------------------------------------------------------- */

static uint32_t common_factor(uint32_t a, uint32_t b)
{
    while (b > 0) {
        uint32_t rest = a % b;

        a = b;
        b = rest;
    }
    return a;
}

static koksma_status check_bases(size_t dim, const uint32_t *bases,
                                 koksma_error *err)
{
    if (dim > KOKSMA_GRID_BASES_MOST)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "elementary intervals have at most %d coordinates, not %zu",
                       KOKSMA_GRID_BASES_MOST, dim);
    for (size_t k = 0; k < dim; k++) {
        if (bases[k] < 2)
            return ki_fail(err, KOKSMA_EINVAL, 0, "base %u is below 2", bases[k]);
        for (size_t j = 0; j < k; j++)
            if (common_factor(bases[j], bases[k]) > 1)
                return ki_fail(err, KOKSMA_EINVAL, 0,
                               "bases %u and %u have a common factor", bases[j],
                               bases[k]);
    }
    return KOKSMA_OK;
}

koksma_status koksma_grid_choose(uint64_t *cells, uint64_t n, size_t dim,
                                 const uint32_t *bases, koksma_error *err)
{
    if (n == 0 || dim == 0)
        return ki_fail(err, KOKSMA_EINVAL, 0, "a grid of no %s",
                       n == 0 ? "points" : "coordinates");
    if (bases != NULL) {
        koksma_status status = check_bases(dim, bases, err);

        if (status == KOKSMA_OK) ki_grid_powers(cells, n, dim, bases);
        return status;
    }
    cells[0] = root(n, dim);
    for (size_t k = 1; k < dim; k++)
        cells[k] = cells[0];
    return KOKSMA_OK;
}

uint64_t ki_grid_total(const uint64_t *cells, size_t dim)
{
    uint64_t total = 1;

    for (size_t k = 0; k < dim; k++)
        if (__builtin_mul_overflow(total, cells[k], &total)) return 0;
    return total;
}
