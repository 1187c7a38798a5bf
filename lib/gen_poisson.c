#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "gen_kernels.h"

/* Poisson disk patterns: random points no two of which are nearer to each other
 * than a radius, by throwing darts.  For a given number of points the radius starts
 * where darts would fill the space for ever, and shrinks slowly until all are in
 * [McCool, Fiume 1992].  A grid over some of the axes, of cells at least as wide as
 * the radius, says which points can be near.  There is no call of libm but for
 * sqrt, so that a seed gives the same points everywhere. */

/* 3^20 cells are more than there can be points. */
enum { AXES_MOST = 20 };

typedef struct disks {
    size_t n, dim, found;
    bool torus;
    double radius;
    size_t axes, cells; /* of the grid, and along each of its axes */
    uint32_t *head;     /* of each cell's list; 0: empty, else 1 + point */
    uint32_t *next;     /* after each point */
    double *x;
} disks;

/* The share that balls of half the radius cover when no more fit, by the fit of
 * [Torquato, Uche, Stillinger 2006], over their volume with radius 1. */
static double full(size_t dim)
{
    static const double PI = 3.14159265358979323846;
    double ball = dim % 2 == 0 ? 1.0 : 2.0,
           share = 0.202048 + 0.973872 * (double)dim;

    for (size_t k = dim % 2 == 0 ? 2 : 3; k <= dim; k += 2)
        ball *= 2.0 * PI / (double)k;
    for (size_t k = 0; k < dim; k++)
        share /= 2.0;
    return share / ball;
}

/* v^(1/dim) for 0 < v, by halving, at most `most`. */
static double root(double v, size_t dim, double most)
{
    double low = 0.0, high = most;

    for (int step = 0; step < 60; step++) {
        double middle = (low + high) / 2.0, power = 1.0;

        for (size_t k = 0; k < dim && power < 1e300; k++)
            power *= middle;
        *(power <= v ? &low : &high) = middle;
    }
    return low;
}

/* Where n balls fill the cube: the torus, or the cube and all within half a radius.
 */
static double first_radius(const disks *d)
{
    double q = root(full(d->dim) / (double)d->n, d->dim, 1.0) * 2.0;
    double most = 0.5 * sqrt((double)d->dim);

    if (!d->torus) q = q < 1.0 ? q / (1.0 - q) : most;
    return q < most ? q : most;
}

/* As many axes as make looking for neighbours cheapest: 3^axes cells, and the
 * points in them. */
static void choose_grid(disks *d)
{
    double least = (double)d->n, boxes = 1.0, points = least;
    size_t cells = d->radius > 1e-9 ? (size_t)(1.0 / d->radius) : 1000000000,
           total = 1;

    d->axes = 0;
    d->cells = cells;
    for (size_t axes = 1; axes <= d->dim && axes <= AXES_MOST && cells > 3;
         axes++) {
        if (__builtin_mul_overflow(total, cells, &total) || total / 8 > d->n + 8)
            break;
        boxes *= 3.0;
        points *= 3.0 / (double)cells;
        if (boxes + points >= least) continue;
        least = boxes + points;
        d->axes = axes;
    }
}

static size_t cell_along(const disks *d, double v)
{
    size_t cell = (size_t)(v * (double)d->cells);

    return cell < d->cells ? cell : d->cells - 1;
}

static bool near(const disks *d, const double *a, const double *b)
{
    double sum = 0.0;

    for (size_t k = 0; k < d->dim; k++) {
        double far = fabs(a[k] - b[k]);

        if (d->torus && far > 0.5) far = 1.0 - far;
        sum += far * far;
    }
    return sum < d->radius * d->radius;
}

static bool is_free_of(const disks *d, const double *dart, size_t cell)
{
    for (uint32_t i = d->head[cell]; i > 0; i = d->next[i - 1])
        if (near(d, dart, d->x + (size_t)(i - 1) * d->dim)) return false;
    return true;
}

/* The dart's own cell along each axis and those next to it, its own first since
 * most darts fail there; the combinations in turn as an odometer counts. */
static bool is_free(const disks *d, const double *dart)
{
    size_t part[AXES_MOST][3], parts[AXES_MOST], digit[AXES_MOST] = {0}, at = 0,
                                                 stride = 1;

    for (size_t k = 0; k < d->axes; k++, stride *= d->cells) {
        size_t cell = cell_along(d, dart[k]), last = d->cells - 1, count = 0;

        part[k][count++] = cell * stride;
        if (cell > 0 || d->torus)
            part[k][count++] = (cell > 0 ? cell - 1 : last) * stride;
        if (cell < last || d->torus)
            part[k][count++] = (cell < last ? cell + 1 : 0) * stride;
        parts[k] = count;
        at += part[k][0];
    }
    for (;;) {
        size_t k = 0;

        if (!is_free_of(d, dart, at)) return false;
        for (; k < d->axes; k++) {
            at -= part[k][digit[k]];
            if (++digit[k] == parts[k]) digit[k] = 0;
            at += part[k][digit[k]];
            if (digit[k] > 0) break;
        }
        if (k == d->axes) return true;
    }
}

static void keep(disks *d)
{
    const double *dart = d->x + d->found * d->dim;
    size_t at = 0;

    for (size_t k = d->axes; k-- > 0;)
        at = at * d->cells + cell_along(d, dart[k]);
    d->next[d->found] = d->head[at];
    d->head[at] = (uint32_t)++d->found;
}

/* Returns whether all points are in. */
static bool throw_darts(disks *d, koksma_rng r, bool shrink)
{
    static const double SLOWLY = 1.0 - 0x1p-8;
    size_t vain = 0, patience = 1000 + 100 * d->n, thrown = 0;

    while (d->found < d->n && (shrink || vain < patience)) {
        double *dart = d->x + d->found * d->dim;

        for (size_t k = 0; k < d->dim; k++)
            dart[k] = koksma_rng_unit(&r);
        vain++;
        if (is_free(d, dart)) {
            keep(d);
            vain = 0;
        }
        if (shrink && ++thrown % d->n == 0) d->radius *= SLOWLY;
    }
    return d->found == d->n;
}

static koksma_status allocate(disks *d, koksma_error *err)
{
    size_t total = 1, bytes;

    for (size_t k = 0; k < d->axes; k++)
        total *= d->cells;
    d->head = calloc(total, sizeof *d->head);
    d->next = ki_alloc(d->n, sizeof *d->next);
    if (!__builtin_mul_overflow(d->dim, sizeof *d->x, &bytes))
        d->x = ki_alloc(d->n, bytes);
    if (d->head == NULL || d->next == NULL || d->x == NULL)
        return ki_fail_memory(err, "the disks");
    return KOKSMA_OK;
}

static koksma_status prepare(koksma_gen *g, koksma_error *err)
{
    const koksma_gen_opts *o = &g->opts;
    koksma_status status;
    disks *d;

    if (o->n > UINT32_MAX)
        return ki_fail(err, KOKSMA_EINVAL, 0, "%ju points: %s has 2^32 - 1 at most",
                       (uintmax_t)o->n, g->family->name);
    if (!(o->radius >= 0.0 && o->radius <= 1.0))
        return ki_fail(err, KOKSMA_EINVAL, 0, "radius %g: not in [0,1]", o->radius);
    d = calloc(1, sizeof *d);
    if (d == NULL) return ki_fail_memory(err, "the disks");
    g->state = d;
    d->n = (size_t)o->n;
    d->dim = o->dim;
    d->torus = o->torus;
    d->radius = o->radius > 0.0 ? o->radius : first_radius(d);
    choose_grid(d);
    status = allocate(d, err);
    if (status == KOKSMA_OK &&
        !throw_darts(d, ki_gen_stream(g, 0), o->radius == 0.0))
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "only %zu point%s found that are %g apart, not %zu",
                       d->found, ki_plural(d->found), o->radius, d->n);
    return status;
}

static void release(void *state)
{
    disks *d = state;

    if (d == NULL) return;
    free(d->head);
    free(d->next);
    free(d->x);
    free(d);
}

static void fill(const koksma_gen *g, double *x, uint64_t first, size_t count)
{
    const disks *d = g->state;

    memcpy(x, d->x + first * d->dim, count * d->dim * sizeof *x);
}

const ki_gen_kernel ki_gen_poisson = {prepare, fill, release};
