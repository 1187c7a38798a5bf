#ifndef KOKSMA_TESTS_EDGE_FIXTURE_H
#define KOKSMA_TESTS_EDGE_FIXTURE_H

#include <math.h>
#include <stdlib.h>

#include "edge.h"
#include "oracle.h"

/* The half-plane discrepancy as its definition says, over integers: coordinates are
 * multiples of 1/size, size = 2^bits.  Lines are taken through every two points,
 * and through every point so that it halves the chord; that these suffice is
 * checked apart, by lines in many directions. */

/* The number num / den, den > 0. */
typedef struct edge_ratio {
    oracle_int num, den;
} edge_ratio;

static inline bool edge_less(edge_ratio a, edge_ratio b)
{
    return a.num * b.den < b.num * a.den;
}

typedef struct edge_grid {
    oracle_int size;
    size_t n;
    long (*at)[2];
} edge_grid;

static inline oracle_int edge_square(oracle_int t) { return t > 0 ? t * t : 0; }

/* The share of [0,size]^2 with a x + b y <= t, by inclusion and exclusion of what
 * lies beyond the sides. */
static inline edge_ratio edge_area(oracle_int a, oracle_int b, oracle_int t,
                                   oracle_int size)
{
    oracle_int c, wa, wb;

    if (a < 0) t -= a * size;
    if (b < 0) t -= b * size;
    a = a < 0 ? -a : a;
    b = b < 0 ? -b : b;
    if (a == 0 || b == 0) {
        c = (a + b) * size;
        return (edge_ratio){t < 0 ? 0 : t > c ? c : t, c};
    }
    wa = a * size;
    wb = b * size;
    return (edge_ratio){edge_square(t) - edge_square(t - wa) - edge_square(t - wb) +
                            edge_square(t - wa - wb),
                        2 * wa * wb};
}

/* count/n - area of the closed half-plane left of p -> p + d. */
static inline edge_ratio edge_local(const edge_grid *g, const long *p,
                                    const long *d, size_t *inside)
{
    oracle_int a = d[1], b = -d[0], t = a * p[0] + b * p[1], count = 0;
    edge_ratio area = edge_area(a, b, t, g->size);

    for (size_t i = 0; i < g->n; i++)
        count += a * g->at[i][0] + b * g->at[i][1] <= t;
    if (inside != NULL) *inside = (size_t)count;
    return (edge_ratio){count * area.den - (oracle_int)g->n * area.num,
                        (oracle_int)g->n * area.den};
}

static inline void edge_try(edge_ratio *best, const edge_grid *g, const long *p,
                            long dx, long dy)
{
    for (long sign = -1; sign <= 1; sign += 2) {
        edge_ratio v = edge_local(g, p, (long[]){sign * dx, sign * dy}, NULL);

        if (edge_less(*best, v)) *best = v;
    }
}

static inline edge_ratio edge_oracle(const edge_grid *g)
{
    edge_ratio best = {-1, 1};

    for (size_t i = 0; i < g->n; i++) {
        const long *p = g->at[i];
        long size = (long)g->size;
        long a = 2 * p[0] <= size ? p[0] : p[0] - size;
        long b = 2 * p[1] <= size ? p[1] : p[1] - size;

        for (size_t j = 0; j < i; j++)
            if (p[0] != g->at[j][0] || p[1] != g->at[j][1])
                edge_try(&best, g, p, g->at[j][0] - p[0], g->at[j][1] - p[1]);
        if (a != 0 || b != 0) edge_try(&best, g, p, a, -b);
        /* All lines that touch a corner. */
        edge_try(&best, g, p, 1, 1);
        edge_try(&best, g, p, 1, -1);
    }
    return best;
}

/* The sign of r - v, exactly, for 2^-16 <= v <= 1 and r.num, r.den below 2^54. */
static inline int edge_compare(edge_ratio r, double v)
{
    int e;
    oracle_int m = (oracle_int)ldexp(frexp(v, &e), 53) * r.den;
    oracle_int scaled = r.num * ((oracle_int)1 << (53 - e));

    return (scaled > m) - (scaled < m);
}

static inline bool edge_contains(koksma_interval v, edge_ratio r)
{
    return edge_compare(r, v.lower) >= 0 && edge_compare(r, v.upper) <= 0;
}

#endif
