#ifndef KOKSMA_TESTS_FIT_FIXTURE_H
#define KOKSMA_TESTS_FIT_FIXTURE_H

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fit.h"
#include "oracle.h"

/* Tables of errors, and what the tests of the fit share. */

enum { SETS = 64, LEVELS = 40, ROWS = SETS * LEVELS };

/* A table as koksma-fit reads it, and how to make it again. */
typedef struct table {
    double x[ROWS], y[ROWS];
    size_t set[ROWS], rows, sets;
} table;

static table data;

static inline void add(table *t, double x, size_t set, double y)
{
    if (t->rows == ROWS) abort();
    t->x[t->rows] = x;
    t->set[t->rows] = set;
    t->y[t->rows++] = y;
    if (set >= t->sets) t->sets = set + 1;
}

static inline koksma_status try_fit(koksma_fit_result *f, const table *t,
                                    const koksma_fit_opts *o, koksma_error *err)
{
    return koksma_fit(f, (koksma_fit_data){t->x, t->y, t->set, t->rows, t->sets}, o,
                      err);
}

static inline koksma_fit_result fit(const table *t, const koksma_fit_opts *o)
{
    koksma_fit_result f;
    koksma_error err = {0};
    koksma_status status = try_fit(&f, t, o, &err);

    ck_assert_msg(status == KOKSMA_OK, "%s", err.text);
    return f;
}

static inline double normal(oracle_rng *rng)
{
    double u = 1.0 - oracle_dyadic(rng, 53), v = oracle_dyadic(rng, 53);

    return sqrt(-2.0 * log(u)) * cos(2.0 * acos(-1.0) * v);
}

/* Errors at 2^(i/2) rounded, i from 6 on, of paths that hang together: what is
 * left after N^exponent is a stationary walk in ln N. */
static inline void random_table(table *t, oracle_rng *rng, size_t sets,
                                size_t levels, double exponent)
{
    t->rows = t->sets = 0;
    for (size_t r = 0; r < sets; r++) {
        double z = normal(rng);

        for (size_t i = 0; i < levels; i++) {
            double n = rint(exp2((double)(i + 6) / 2.0));

            add(t, n, r, pow(n, exponent) * z);
            z = 0.7 * z + sqrt(1.0 - 0.49) * normal(rng);
        }
    }
}

static inline bool same_term(koksma_fit_term a, koksma_fit_term b)
{
    return a.value.value == b.value.value && a.se == b.se && a.groups == b.groups;
}

/* To the last bit. */
static inline bool same_line(koksma_fit_result a, koksma_fit_result b)
{
    return same_term(a.exponent, b.exponent) && same_term(a.slope, b.slope) &&
           same_term(a.curvature, b.curvature) && a.used == b.used;
}

#endif
