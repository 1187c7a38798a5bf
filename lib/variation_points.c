/* Values at points that are a grid, in any order. */
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "variation_kernels.h"

/* The different coordinates of each axis, rising: axis j has those from at[j] to
 * at[j + 1]. */
typedef struct axes {
    double *coordinate;
    size_t at[KOKSMA_VARIATION_DIM_MOST + 1];
    size_t nodes[KOKSMA_VARIATION_DIM_MOST];
} axes;

static int by_size(const void *a, const void *b)
{
    double u = *(const double *)a, v = *(const double *)b;

    return (u > v) - (u < v);
}

/* Sort the coordinates, and drop repeats. */
static void find_axes(axes *a, koksma_points p)
{
    double *to = a->coordinate;

    for (size_t j = 0; j < p.dim; j++) {
        size_t kept = 0;

        for (size_t i = 0; i < p.n; i++)
            to[i] = p.x[i * p.dim + j];
        qsort(to, p.n, sizeof *to, by_size);
        for (size_t i = 0; i < p.n; i++)
            if (i == 0 || to[i] != to[kept - 1]) to[kept++] = to[i];
        a->nodes[j] = kept;
        a->at[j + 1] = a->at[j] + kept;
        to += kept;
    }
}

static koksma_status check_count(const axes *a, koksma_points p, koksma_error *err)
{
    double nodes = 1.0; /* exact as long as it matters */

    for (size_t j = 0; j < p.dim; j++)
        nodes *= (double)a->nodes[j];
    if (nodes == (double)p.n) return KOKSMA_OK;
    return ki_fail(
        err, KOKSMA_EINVAL, 0,
        "%zu points are no full grid: their coordinates make one of %.0f "
        "nodes",
        p.n, nodes);
}

/* The rank of v among the coordinates of axis j, of which it is one. */
static size_t rank_of(const axes *a, size_t j, double v)
{
    size_t low = a->at[j], high = a->at[j + 1];

    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;

        *(a->coordinate[middle] <= v ? &low : &high) = middle;
    }
    return low - a->at[j];
}

/* As many points as nodes: all are there unless one comes twice. */
static koksma_status arrange(double *values, unsigned char *seen, const axes *a,
                             koksma_points p, const double *f, koksma_error *err)
{
    for (size_t i = 0; i < p.n; i++) {
        size_t node = 0;

        for (size_t j = 0; j < p.dim; j++)
            node = node * a->nodes[j] + rank_of(a, j, p.x[i * p.dim + j]);
        if (seen[node])
            return ki_fail(
                err, KOKSMA_EINVAL, 0,
                "point %zu repeats one before it: the points are no full "
                "grid",
                i + 1);
        seen[node] = 1;
        values[node] = f[i];
    }
    return KOKSMA_OK;
}

static koksma_status measure(koksma_variation_result *out, koksma_estimate *faces,
                             const axes *a, size_t dim, const double *values,
                             size_t n, koksma_error *err)
{
    koksma_variation_grid *g = NULL;
    koksma_status status = koksma_variation_open(&g, a->nodes, dim, err);

    if (status == KOKSMA_OK) status = koksma_variation_add(g, values, n, err);
    if (status == KOKSMA_OK) status = koksma_variation_finish(out, faces, g, err);
    koksma_variation_close(g);
    return status;
}

koksma_status koksma_variation_points(koksma_variation_result *out,
                                      koksma_estimate *faces, koksma_points p,
                                      const double *f, koksma_error *err)
{
    koksma_status status = koksma_points_check(p, err);
    double *values = NULL;
    unsigned char *seen = NULL;
    axes a = {0};

    if (status == KOKSMA_OK) status = ki_variation_check_dim(p.dim, err);
    if (status != KOKSMA_OK) return status;
    a.coordinate = ki_alloc(p.n, p.dim * sizeof *a.coordinate);
    values = ki_alloc(p.n, sizeof *values);
    seen = calloc(p.n, 1);
    if (a.coordinate == NULL || values == NULL || seen == NULL) {
        status = ki_fail_memory(err, "values on a grid");
    } else {
        find_axes(&a, p);
        status = check_count(&a, p, err);
        if (status == KOKSMA_OK) status = arrange(values, seen, &a, p, f, err);
        if (status == KOKSMA_OK)
            status = measure(out, faces, &a, p.dim, values, p.n, err);
    }
    free(a.coordinate);
    free(values);
    free(seen);
    return status;
}
