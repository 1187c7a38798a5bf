#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "l2_divide_kernels.h"

/* The points as items: ranked along each axis once, and for each choice of axes in
 * the order of the first, cut into the parts of each level along the last. */

enum { BLOCK = 256, AHEAD = 16 }; /* weights; prefetches */

static void rank_points(ki_l2_items *s, size_t k)
{
    koksma_points p = s->p;
    const ki_l2_key *sorted;

    for (size_t i = 0; i < p.n; i++) {
        double x = p.x[i * p.dim + k] + 0.0; /* -0 is 0 */

        memcpy(&s->key[i].bits, &x, sizeof x);
        s->key[i].point = i;
    }
    sorted = ki_l2_sort(s->key, s->key + p.n, p.n);
    for (size_t j = 0; j < p.n; j++) {
        s->by[k][j] = (uint32_t)sorted[j].point;
        if (k > 0) s->rank[k][sorted[j].point] = (uint32_t)j;
    }
}

void ki_l2_items_rank(ki_l2_items *s)
{
    for (size_t k = 0; k < s->p.dim; k++)
        rank_points(s, k);
}

size_t ki_l2_part_begin(size_t n, size_t parts, size_t j)
{
    return n / parts * j + n % parts * j / parts;
}

/* One level's order from the one above: parts are cut in two, stably. */
static void refine(const ki_l2_items *s, size_t level)
{
    size_t n = s->p.n, parts = (size_t)1 << level;

    for (size_t j = 0; j < parts / 2; j++) {
        size_t begin = ki_l2_part_begin(n, parts, 2 * j);
        size_t cut = ki_l2_part_begin(n, parts, 2 * j + 1);
        size_t end = ki_l2_part_begin(n, parts, 2 * j + 2), to[2] = {begin, cut};

        for (size_t i = begin; i < end; i++) {
            uint32_t item = s->order[level - 1][i];

            s->order[level][to[s->last[item] >= cut]++] = item;
        }
    }
}

void ki_l2_items_arrange(ki_l2_items *s)
{
    koksma_points p = s->p;
    size_t stride = ki_l2_coordinates(s->axes) + s->axes;

    s->stride = stride;
    for (size_t j = 0; j < p.n; j++) {
        const uint32_t *by = s->by[s->axis[0]];
        size_t point = by[j], ahead = by[j + AHEAD < p.n ? j + AHEAD : j];
        ki_l2_slot *item = s->item + j * stride;

        __builtin_prefetch(p.x + ahead * p.dim);
        __builtin_prefetch(s->rank[s->axis[1]] + ahead);
        item[KI_L2_RANKS].rank[0] = 0;
        for (size_t k = 1; k < s->axes; k++)
            *ki_l2_rank(item, k) = s->last[j] = s->rank[s->axis[k]][point];
        item += ki_l2_coordinates(s->axes);
        for (size_t k = 0; k < s->axes; k++)
            item[k].x = p.x[point * p.dim + s->axis[k]];
        s->order[0][j] = (uint32_t)j;
    }
    for (size_t level = 1; level <= s->levels; level++)
        refine(s, level);
}

void ki_l2_items_weigh(ki_l2_items *s, const ki_l2_call *call)
{
    size_t n = s->p.n, stride = s->stride;
    ki_twice weight[BLOCK];

    for (size_t j = 0; j < n; j += BLOCK) {
        size_t count = n - j < BLOCK ? n - j : BLOCK;

        ki_l2_weigh(call, s->p.x, s->by[s->axis[0]] + j, count, weight);
        for (size_t i = 0; i < count; i++) {
            s->item[(j + i) * stride].x = weight[i].hi;
            s->item[(j + i) * stride + 1].x = weight[i].lo;
        }
    }
}

ki_l2_list ki_l2_items_gather(const ki_l2_items *s, ki_l2_slot *to, size_t level,
                              size_t j)
{
    size_t n = s->p.n, begin = ki_l2_part_begin(n, (size_t)1 << level, j);
    size_t end = ki_l2_part_begin(n, (size_t)1 << level, j + 1), stride = s->stride;
    ki_l2_list l = {to, end - begin, 0, (uint32_t)begin, (uint32_t)end, false};

    for (size_t i = begin; i < end; i++, to += stride) {
        size_t ahead = i + AHEAD < end ? i + AHEAD : i;

        __builtin_prefetch(s->item + s->order[level][ahead] * stride);
        ki_l2_copy(to, s->item + s->order[level][i] * stride, stride);
    }
    return l;
}

/* ---- Room -------------------------------------------------------------------- */

static uint32_t **tables(size_t count, size_t n)
{
    uint32_t **t = calloc(count, sizeof *t);

    for (size_t i = 0; t != NULL && i < count; i++) {
        t[i] = ki_alloc(n, sizeof **t);
        if (t[i] != NULL) continue;
        while (i-- > 0)
            free(t[i]);
        free(t);
        return NULL;
    }
    return t;
}

static void free_tables(uint32_t **t, size_t count)
{
    for (size_t i = 0; t != NULL && i < count; i++)
        free(t[i]);
    free(t);
}

bool ki_l2_items_make(ki_l2_items *s, koksma_points p, size_t levels)
{
    *s = (ki_l2_items){.p = p, .levels = levels};
    s->key = ki_alloc(p.n, 2 * sizeof *s->key);
    s->item = ki_alloc(p.n, (ki_l2_coordinates(p.dim) + p.dim) * sizeof *s->item);
    s->by = tables(p.dim, p.n);
    s->rank = tables(p.dim, p.n);
    s->order = tables(levels + 1, p.n);
    s->last = ki_alloc(p.n, sizeof *s->last);
    return s->key != NULL && s->item != NULL && s->by != NULL && s->rank != NULL &&
           s->order != NULL && s->last != NULL;
}

void ki_l2_items_free(ki_l2_items *s)
{
    free(s->key);
    free(s->item);
    free_tables(s->by, s->p.dim);
    free_tables(s->rank, s->p.dim);
    free_tables(s->order, s->levels + 1);
    free(s->last);
}
