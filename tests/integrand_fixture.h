#ifndef INTEGRAND_FIXTURE_H
#define INTEGRAND_FIXTURE_H

#include <check.h>
#include <math.h>

#include "integrand.h"
#include "scene.h"

/* What the tests of integrands share: making one, and variations on grids. */

static inline koksma_integrand fixture_make(koksma_facts *facts, const char *name,
                                            size_t dim, const double *param)
{
    const koksma_integrand_row *row = koksma_integrand_find(name);
    koksma_integrand f;
    koksma_error err;

    if (row == NULL) row = koksma_scene_find(name);
    if (koksma_integrand_make(&f, facts, row, dim, param, &err))
        ck_abort_msg("%s: %s", name, err.text);
    return f;
}

/* Whether f's discontinuity, piece by piece, changes f as `facts` say. */
static inline double fixture_value(const koksma_integrand *f, size_t *piece,
                                   const double *x)
{
    *piece = f->piece(f, x);
    return f->value(f, x);
}

/* The variation of Vitali of f on the k^|u| grid of the face where the axes not
 * in u are at 1: the definition, corner by corner. */
static inline double fixture_vitali(const koksma_integrand *f, unsigned u, size_t k)
{
    double x[8], sum = 0.0;
    size_t axes[8], order = 0, cells = 1;

    for (size_t j = 0; j < f->dim; j++) {
        x[j] = 1.0;
        if (u >> j & 1) {
            axes[order++] = j;
            cells *= k;
        }
    }
    for (size_t cell = 0; cell < cells; cell++) {
        double alternating = 0.0;

        for (unsigned corner = 0; corner < 1u << order; corner++) {
            size_t c = cell;
            int sign = 1;

            for (size_t j = 0; j < order; j++, c /= k) {
                unsigned up = corner >> j & 1;

                x[axes[j]] = (double)(c % k + up) / (double)k;
                if (!up) sign = -sign;
            }
            alternating += sign * f->value(f, x);
        }
        sum += fabs(alternating);
    }
    return sum;
}

/* Hardy and Krause's: over all faces. */
static inline double fixture_variation(const koksma_integrand *f, size_t k)
{
    double sum = 0.0;

    for (unsigned u = 1; u < 1u << f->dim; u++)
        sum += fixture_vitali(f, u, k);
    return sum;
}

#endif
