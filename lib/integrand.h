#ifndef KOKSMA_INTEGRAND_H
#define KOKSMA_INTEGRAND_H

#include <stddef.h>

#include "points.h"

/* Integrands on [0,1]^dim whose integral is known.  Each is a row of
 * koksma_integrands; a is its one parameter.
 *
 *     f2(x,y)   = a (x+y)   + (1 - 2a)       if x+y > 1     0 <= a <= 1/2
 *     f3(x,y,z) = a (x+y+z) + (0.6 - 1.8 a)  if x+y+z > 1   0 <= a <= 1/3
 *
 * [Szirmay-Kalos, Purgathofer 1998, (13) and (14)].  Both integrate to 1/2
 * whatever a is, which moves weight from the jump to the smooth part.  On which
 * side of the discontinuity a point lies is decided exactly, for the doubles
 * given. */
typedef struct koksma_integrand {
    const char *name;
    const char *summary;
    size_t dim;
    double a_most;   /* a lies in [0, a_most] */
    double integral; /* over [0,1]^dim, correctly rounded */
    double (*value)(const double *x, double a);
    double (*jump)(double a); /* across the discontinuity */
} koksma_integrand;

/* All integrands, ended by a row whose name is NULL. */
extern const koksma_integrand koksma_integrands[];

/* The integrand of that name, or NULL. */
const koksma_integrand *koksma_integrand_find(const char *name);

/* f[i] = the integrand at point i.
 *
 * Returns: KOKSMA_OK; KOKSMA_EINVAL when p.dim is not its dim; KOKSMA_EDOMAIN
 *          when a is out of its range; as koksma_points_check */
koksma_status koksma_integrand_eval(double *f, const koksma_integrand *integrand,
                                    double a, koksma_points p, koksma_error *err);

#endif
