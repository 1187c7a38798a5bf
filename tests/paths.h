#ifndef KOKSMA_TESTS_PATHS_H
#define KOKSMA_TESTS_PATHS_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "curve.h"
#include "fit.h"
#include "gen.h"
#include "integrand.h"
#include "scene.h"

/* Error curves of replicates, made in memory: points, integrand, curve.  For tests
 * and benches; whatever fails ends the program. */

enum { PATH_ROWS = 64, PATH_BLOCK = 4096 };

/* Which experiment; Halton's digits are scrambled. */
typedef struct path_kind {
    const char *family, *integrand;
    double a; /* the parameter; NaN: the usual ones */
    uint64_t seed, n;
    size_t dim; /* 0: the usual one */
} path_kind;

static inline void path_must(int status)
{
    if (status == 0) return;
    fprintf(stderr, "a path cannot be made: status %d\n", status);
    abort();
}

static inline const koksma_integrand_row *path_row(path_kind kind)
{
    const koksma_integrand_row *row = koksma_integrand_find(kind.integrand);

    return row != NULL ? row : koksma_scene_find(kind.integrand);
}

/* Append the errors of one replicate to d, at half octaves from 1 to n. */
static inline void path_add(double *xs, double *ys, size_t *sets,
                            koksma_fit_data *d, path_kind kind, size_t replicate)
{
    const koksma_gen_family *family = koksma_gen_find(kind.family);
    const koksma_integrand_row *integrand = path_row(kind);
    koksma_gen_opts o = {.dim = kind.dim > 0 ? kind.dim : integrand->dim,
                         .n = kind.n,
                         .scramble = family->takes & KOKSMA_TAKES_SEED
                                         ? KOKSMA_SCRAMBLE_NONE
                                         : KOKSMA_SCRAMBLE_DIGITS,
                         .seed = kind.seed,
                         .replicate = replicate};
    double *x = malloc(PATH_BLOCK * o.dim * sizeof *x), values[PATH_BLOCK];
    const koksma_curve_row *row;
    koksma_integrand f;
    koksma_facts facts;
    koksma_curve *c;
    koksma_gen *g;
    size_t count;

    path_must(x == NULL);
    path_must((int)koksma_integrand_make(&f, &facts, integrand, kind.dim,
                                         isnan(kind.a) ? NULL : &kind.a, NULL));
    path_must((int)koksma_gen_open(&g, family, &o, NULL));
    path_must((int)koksma_curve_open(&c, 2, NULL));
    koksma_curve_begin(c, facts.integral);
    for (uint64_t i = 0; i < kind.n; i += count) {
        count = kind.n - i < PATH_BLOCK ? (size_t)(kind.n - i) : PATH_BLOCK;
        path_must((int)koksma_gen_fill(g, x, i, count, NULL));
        path_must((int)koksma_integrand_eval(
            values, &f, (koksma_points){x, count, o.dim}, NULL));
        koksma_curve_add(c, values, 1, count);
    }
    path_must((int)koksma_curve_rows(c, &row, &count, NULL));
    for (size_t j = 0; j < count; j++) {
        xs[d->rows] = (double)row[j].n;
        ys[d->rows] = row[j].error;
        sets[d->rows++] = replicate;
    }
    koksma_curve_close(c);
    koksma_gen_close(g);
    free(x);
}

#endif
