#include "points.h"

#include <stdint.h>

#include "error.h"

koksma_status koksma_points_check(koksma_points p, koksma_error *err)
{
    size_t bytes;

    if (p.x == NULL && p.n > 0 && p.dim > 0)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "no array: the view of the points is NULL");
    if (p.n == 0 || p.dim == 0)
        return ki_fail(
            err, KOKSMA_EINVAL, 0,
            "%zu points of %zu coordinates: a point set has at least one", p.n,
            p.dim);
    if (__builtin_mul_overflow(p.n, p.dim, &bytes) ||
        __builtin_mul_overflow(bytes, sizeof *p.x, &bytes) || bytes > PTRDIFF_MAX)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "%zu points of %zu coordinates: more than memory can hold",
                       p.n, p.dim);

    for (size_t i = 0; i < p.n; i++)
        for (size_t k = 0; k < p.dim; k++) {
            double v = p.x[i * p.dim + k];

            /* Written so that a NaN, which fails every comparison, is caught. */
            if (!(v >= 0.0 && v <= 1.0))
                return ki_fail(err, KOKSMA_EDOMAIN, 0,
                               "coordinate %zu of point %zu is %.*g, not in [0,1]",
                               k + 1, i + 1, v < 1.001 && v > 1.0 ? 17 : 6, v);
        }
    return KOKSMA_OK;
}
