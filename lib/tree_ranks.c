#include <math.h>
#include <stdlib.h>

#include "error.h"
#include "tree_kernels.h"

/* The leading bits of the coordinates, interleaved [Morton 1966], as a number below
 * 1: points near each other mostly get places near each other. */
static double morton_place(const double *x, size_t dim)
{
    uint64_t place = 0;
    int used = 0;

    for (int bit = 1; used < 52; bit++)
        for (size_t k = 0; k < dim && used < 52; k++, used++)
            place = place << 1 | ((uint64_t)ldexp(x[k], bit) & 1);
    return (double)place * 0x1p-52;
}

/* What the ranks are made with: room for n each. */
typedef struct bench {
    double *place;
    uint32_t *number; /* of each point */
    ki_keyed *a, *b;
} bench;

/* Number the points in Morton order, so that those which a small cell holds stand
 * together in memory. */
static void number_points(bench *w, koksma_points p)
{
    const ki_keyed *sorted;

    for (size_t i = 0; i < p.n; i++)
        w->place[i] = morton_place(p.x + i * p.dim, p.dim);
    sorted = ki_sort_axis((koksma_points){w->place, p.n, 1}, 0, w->a, w->b);
    for (size_t i = 0; i < p.n; i++)
        w->number[sorted[i].i] = (uint32_t)i;
}

/* Whether axis k is one of lower ends. */
static bool is_lower(const ki_ranks *r, size_t k)
{
    return r->axes > r->dim && k < r->dim;
}

static double place_of(const ki_ranks *r, size_t k, double value)
{
    if (r->measure->anchored) return log(value);
    return is_lower(r, k) ? -value : value;
}

/* Rank the coordinates along axis k.  In a star's closed boxes, a side of length 0
 * has rank 0; elsewhere nothing has, so no coordinate equals its value. */
static void rank_axis(ki_ranks *r, koksma_points p, size_t k, bench *w)
{
    const ki_keyed *sorted = ki_sort_axis(p, k % p.dim, w->a, w->b);
    ki_axis *axis = &r->axis[k];
    double face = is_lower(r, k) ? 0.0 : 1.0;
    uint32_t top = 0;

    axis->value[0] = r->measure->anchored ? 0.0 : -1.0;
    for (size_t j = 0; j < p.n; j++) {
        ki_keyed s = sorted[is_lower(r, k) ? p.n - 1 - j : j];

        if (s.x != axis->value[top]) axis->value[++top] = s.x;
        r->order[k * p.n + j] = w->number[s.i];
        r->rank[k * p.n + r->order[k * p.n + j]] = top;
    }
    if (!r->closed && axis->value[top] != face) axis->value[++top] = face;
    axis->place[0] = -HUGE_VAL;
    /* A logarithm that is off by less than its bound need not grow with its value;
     * the running maximum does, and is no further off. */
    for (uint32_t j = 1; j <= top; j++)
        axis->place[j] = fmax(place_of(r, k, axis->value[j]), axis->place[j - 1]);
    axis->top = top;
}

/* An axis takes values and places of n + 2 ranks, ranks and an order. */
static void fill(ki_ranks *r, koksma_points p, bench *w)
{
    double *value;

    r->axis = r->memory;
    value = (double *)(r->axis + r->axes);
    r->rank = (uint32_t *)(value + r->axes * 2 * (p.n + 2));
    r->order = r->rank + r->axes * p.n;
    number_points(w, p);
    for (size_t k = 0; k < r->axes; k++, value += 2 * (p.n + 2)) {
        r->axis[k].value = value;
        r->axis[k].place = value + p.n + 2;
        rank_axis(r, p, k, w);
    }
}

koksma_status ki_ranks_make(ki_ranks *out, koksma_points p, bool closed,
                            const ki_measure *measure)
{
    size_t doubles = 2 * (p.n + 2), words = 2 * p.n, bytes;
    bench w = {.place = ki_alloc(p.n, sizeof *w.place),
               .number = ki_alloc(p.n, sizeof *w.number),
               .a = ki_alloc(p.n, 2 * sizeof *w.a)};
    koksma_status status = KOKSMA_ENOMEM;
    ki_ranks r = {.measure = measure,
                  .n = p.n,
                  .dim = p.dim,
                  .axes = measure->anchored ? p.dim : 2 * p.dim,
                  .closed = closed,
                  .shift = closed ? 0 : 1};

    if (!__builtin_mul_overflow(r.axes,
                                doubles * sizeof(double) +
                                    words * sizeof(uint32_t) + sizeof(ki_axis),
                                &bytes))
        r.memory = ki_alloc(1, bytes);
    if (w.place != NULL && w.number != NULL && w.a != NULL && r.memory != NULL) {
        w.b = w.a + p.n;
        fill(&r, p, &w);
        *out = r;
        status = KOKSMA_OK;
    } else {
        free(r.memory);
    }
    free(w.place);
    free(w.number);
    free(w.a);
    return status;
}

void ki_ranks_free(ki_ranks *r)
{
    free(r->memory);
    r->memory = NULL;
}
