#include <math.h>
#include <stdlib.h>

#include "error.h"
#include "star_tree_kernels.h"

typedef struct keyed {
    double x;
    uint32_t i;
} keyed;

static int by_x(const void *a, const void *b)
{
    const keyed *p = a, *q = b;

    if (p->x != q->x) return p->x < q->x ? -1 : 1;
    return (p->i > q->i) - (p->i < q->i);
}

typedef struct placed {
    uint64_t place;
    size_t i;
} placed;

static int by_place(const void *a, const void *b)
{
    const placed *p = a, *q = b;

    if (p->place != q->place) return p->place < q->place ? -1 : 1;
    return (p->i > q->i) - (p->i < q->i);
}

/* The leading bits of the coordinates, interleaved [Morton 1966]: points near each
 * other mostly get places near each other. */
static uint64_t morton_place(const double *x, size_t dim)
{
    uint64_t place = 0;
    size_t used = 0;

    for (int bit = 1; bit <= 52 && used < 64; bit++)
        for (size_t k = 0; k < dim && used < 64; k++, used++)
            place = place << 1 | ((uint64_t)ldexp(x[k], bit) & 1);
    return place;
}

/* Number the points in Morton order, so that those which a small cell holds stand
 * together in memory: number i is the point original[i] of p. */
static void number_points(placed *original, koksma_points p)
{
    for (size_t i = 0; i < p.n; i++)
        original[i] = (placed){morton_place(p.x + i * p.dim, p.dim), i};
    qsort(original, p.n, sizeof *original, by_place);
}

/* Rank the coordinates along axis k; sorted has room for n. */
static void rank_axis(ki_ranks *r, koksma_points p, size_t k,
                      const placed *original, keyed *sorted)
{
    ki_axis *axis = &r->axis[k];
    uint32_t top = 0;

    for (size_t i = 0; i < p.n; i++)
        sorted[i] = (keyed){p.x[original[i].i * p.dim + k], (uint32_t)i};
    qsort(sorted, p.n, sizeof *sorted, by_x);
    axis->value[0] = 0.0;
    for (size_t j = 0; j < p.n; j++) {
        if (sorted[j].x != axis->value[top]) axis->value[++top] = sorted[j].x;
        r->rank[k * p.n + sorted[j].i] = top;
        r->order[k * p.n + j] = sorted[j].i;
    }
    if (!r->closed && axis->value[top] < 1.0) axis->value[++top] = 1.0;
    for (uint32_t j = 1; j <= top; j++)
        axis->log[j] = log(axis->value[j]);
    axis->log[0] = -HUGE_VAL;
    axis->top = top;
}

koksma_status ki_ranks_make(ki_ranks *out, koksma_points p, bool closed)
{
    /* An axis takes values and logarithms of n + 2 ranks, ranks and an order. */
    size_t doubles = 2 * (p.n + 2), words = 2 * p.n, bytes;
    keyed *sorted = ki_alloc(p.n, sizeof *sorted);
    placed *original = ki_alloc(p.n, sizeof *original);
    ki_ranks r = {
        .n = p.n, .dim = p.dim, .closed = closed, .shift = closed ? 0 : 1};

    if (!__builtin_mul_overflow(p.dim,
                                doubles * sizeof(double) +
                                    words * sizeof(uint32_t) + sizeof(ki_axis),
                                &bytes))
        r.memory = ki_alloc(1, bytes);
    if (sorted == NULL || original == NULL || r.memory == NULL) {
        free(sorted);
        free(original);
        free(r.memory);
        return KOKSMA_ENOMEM;
    }
    r.axis = r.memory;
    double *value = (double *)(r.axis + p.dim);
    r.rank = (uint32_t *)(value + p.dim * doubles);
    r.order = r.rank + p.dim * p.n;
    number_points(original, p);
    for (size_t k = 0; k < p.dim; k++) {
        r.axis[k].value = value + k * doubles;
        r.axis[k].log = r.axis[k].value + p.n + 2;
        rank_axis(&r, p, k, original, sorted);
    }
    free(sorted);
    free(original);
    *out = r;
    return KOKSMA_OK;
}

void ki_ranks_free(ki_ranks *r)
{
    free(r->memory);
    r->memory = NULL;
}
