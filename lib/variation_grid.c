/* The variation of values on a grid, in one pass, with a few layers in memory.
 *
 * Along one axis replace every value but the last by its difference to the next,
 * and leave the last as it is.  After all axes the entry of a node has the Delta of
 * the cell above it, in the axes where the node is not the last, with the others at
 * their last node: every cell of every face, once.  So V(f; u) is the sum of
 * |entry| over the nodes that are not the last in just the axes of u.
 *
 * The first axis is done as layers arrive.  A coarser grid is the same with the
 * nodes that it keeps, and takes the layers that it keeps. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "variation_kernels.h"

typedef struct grid_level {
    size_t stride; /* nodes are multiples of it, or last */
    size_t nodes[KOKSMA_VARIATION_DIM_MOST]; /* of each axis */
    size_t size;                             /* nodes of a layer */
    double *before;                          /* the layer before */
    double top;                              /* the largest |value| in it */
    ki_sum *faces;                           /* 2^dim */
} grid_level;

struct koksma_variation_grid {
    size_t dim, size, levels;
    size_t nodes[KOKSMA_VARIATION_DIM_MOST];
    grid_level level[KOKSMA_VARIATION_LEVELS_MOST];
    double *layer; /* as it arrives */
    double *work;
    size_t filled;     /* of layer */
    size_t layers;     /* done */
    double values;     /* how many there were */
    double *memory;    /* layer, work and all before */
    ki_sum *face_sums; /* of all levels */
};

/* ---- Making one -------------------------------------------------------------- */

koksma_status ki_variation_check_dim(size_t dim, koksma_error *err)
{
    const size_t most = KOKSMA_VARIATION_DIM_MOST;

    if (dim >= 1 && dim <= most) return KOKSMA_OK;
    if (dim == 0)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "dimension 0: there is nothing that varies");
    if (dim < 64)
        return ki_fail(
            err, KOKSMA_EINVAL, 0,
            "%zu axes have %ju faces, and at most %zu, those of %zu axes, "
            "are looked at",
            dim, ((uintmax_t)1 << dim) - 1, ((size_t)1 << most) - 1, most);
    return ki_fail(err, KOKSMA_EINVAL, 0,
                   "%zu axes have 2^%zu - 1 faces, and at most %zu, those of %zu "
                   "axes, are looked at",
                   dim, dim, ((size_t)1 << most) - 1, most);
}

/* Of n nodes those that a stride keeps. */
static size_t kept(size_t n, size_t stride)
{
    return (n - 1 + stride - 1) / stride + 1;
}

static size_t most_cells(const size_t *nodes, size_t dim)
{
    size_t most = 0;

    for (size_t j = 0; j < dim; j++)
        most = nodes[j] - 1 > most ? nodes[j] - 1 : most;
    return most;
}

/* Grids as far as two cells on some axis.  Returns the doubles that all layers
 * take, or 0 when that is too many to count. */
static size_t plan(koksma_variation_grid *g)
{
    size_t total = 0;

    for (size_t stride = 1; stride == 1 || most_cells(g->nodes, g->dim) > stride;
         stride *= 2) {
        grid_level *l = &g->level[g->levels++];

        l->stride = stride;
        l->size = 1;
        for (size_t j = 0; j < g->dim; j++) {
            l->nodes[j] = kept(g->nodes[j], stride);
            if (j > 0 && __builtin_mul_overflow(l->size, l->nodes[j], &l->size))
                return 0;
        }
        if (__builtin_add_overflow(total, l->size, &total)) return 0;
        if (g->levels == KOKSMA_VARIATION_LEVELS_MOST) break;
    }
    g->size = g->level[0].size;
    if (__builtin_add_overflow(total, g->size, &total) ||
        __builtin_add_overflow(total, g->size, &total))
        return 0;
    return total;
}

koksma_status koksma_variation_open(koksma_variation_grid **out,
                                    const size_t *nodes, size_t dim,
                                    koksma_error *err)
{
    koksma_status status = ki_variation_check_dim(dim, err);
    koksma_variation_grid *g;
    size_t faces, total;
    double *rest;

    for (size_t j = 0; j < dim && status == KOKSMA_OK; j++)
        if (nodes[j] < 2)
            status = ki_fail(err, KOKSMA_EINVAL, 0,
                             "axis %zu has %zu nodes, and a cell takes 2", j + 1,
                             nodes[j]);
    if (status != KOKSMA_OK) return status;
    g = calloc(1, sizeof *g);
    if (g == NULL) return ki_fail_memory(err, "a grid");
    g->dim = dim;
    memcpy(g->nodes, nodes, dim * sizeof *nodes);
    total = plan(g);
    faces = (size_t)1 << dim;
    g->memory = total > 0 ? calloc(total, sizeof *g->memory) : NULL;
    g->face_sums = calloc(g->levels * faces, sizeof *g->face_sums);
    if (g->memory == NULL || g->face_sums == NULL) {
        koksma_variation_close(g);
        return ki_fail_memory(err, "the layers of a grid");
    }
    g->layer = g->memory;
    g->work = g->layer + g->size;
    rest = g->work + g->size;
    for (size_t i = 0; i < g->levels; i++) {
        g->level[i].before = rest;
        rest += g->level[i].size;
        g->level[i].faces = g->face_sums + i * faces;
    }
    *out = g;
    return KOKSMA_OK;
}

void koksma_variation_close(koksma_variation_grid *g)
{
    if (g == NULL) return;
    free(g->memory);
    free(g->face_sums);
    free(g);
}

/* ---- One layer --------------------------------------------------------------- */

/* What is kept of a row goes to before, and how much that is more than before to
 * out. */
static void keep_row(double *out, double *before, const double *row, size_t cells,
                     size_t stride, size_t last)
{
    for (size_t i = 0; i < cells; i++) {
        double v = row[i * stride];

        out[i] = v - before[i];
        before[i] = v;
    }
    out[cells] = row[last] - before[cells];
    before[cells] = row[last];
}

static void keep(const koksma_variation_grid *g, grid_level *l, double *work,
                 const double *layer)
{
    size_t last = g->dim - 1, at[KOKSMA_VARIATION_DIM_MOST] = {0};
    size_t row = g->dim > 1 ? l->nodes[last] : 1;
    size_t width = g->dim > 1 ? g->nodes[last] : 1;

    for (size_t done = 0; done < l->size; done += row) {
        size_t offset = 0, carry = last;

        for (size_t j = 1; j < last; j++) {
            size_t node = at[j] * l->stride, end = g->nodes[j] - 1;

            offset = offset * g->nodes[j] + (node < end ? node : end);
        }
        keep_row(work + done, l->before + done, layer + offset * width, row - 1,
                 l->stride, width - 1);
        while (carry-- > 1) {
            if (++at[carry] < l->nodes[carry]) break;
            at[carry] = 0;
        }
    }
}

/* Differences along the axes between the first and the last, in place. */
static void difference(const koksma_variation_grid *g, const grid_level *l,
                       double *work)
{
    size_t inner = l->size, outer = 1;

    for (size_t j = 1; j + 1 < g->dim; j++) {
        size_t n = l->nodes[j];

        inner /= n;
        for (size_t a = 0; a < outer; a++) {
            double *block = work + a * n * inner;

            for (size_t i = 0; i < (n - 1) * inner; i++)
                block[i] = block[i + inner] - block[i];
        }
        outer *= n;
    }
}

static double sum_above(const double *row, size_t cells, double least)
{
    double sum = 0.0;

    for (size_t i = 0; i < cells; i++) {
        double d = fabs(row[i + 1] - row[i]);

        sum += d >= least ? d : 0.0;
    }
    return sum;
}

/* The sums of |entry| by face; `first` is the bit of the first axis, or 0 where
 * that is at its last node. */
static void add_faces(const koksma_variation_grid *g, grid_level *l,
                      const double *work, unsigned first, double top)
{
    size_t last = g->dim - 1, at[KOKSMA_VARIATION_DIM_MOST] = {0};
    size_t row = g->dim > 1 ? l->nodes[last] : 1;
    double least[KOKSMA_VARIATION_DIM_MOST + 1];
    unsigned u = first, beyond = 1u << last;

    for (size_t m = 0; m <= g->dim; m++)
        least[m] = ki_variation_floor(top, m);
    for (size_t j = 1; j < last; j++)
        u |= 1u << j;
    for (const double *w = work; w < work + l->size; w += row) {
        size_t order = (size_t)__builtin_popcount(u), carry = last;
        double end = fabs(w[row - 1]);

        if (row > 1)
            ki_sum_add(&l->faces[u | beyond],
                       sum_above(w, row - 1, least[order + 1]));
        ki_sum_add(&l->faces[u], end >= least[order] ? end : 0.0);
        while (carry-- > 1) {
            at[carry]++;
            u |= 1u << carry;
            if (at[carry] + 1 == l->nodes[carry]) u &= ~(1u << carry);
            if (at[carry] < l->nodes[carry]) break;
            at[carry] = 0;
        }
    }
}

static void take(const koksma_variation_grid *g, grid_level *l, double *work,
                 const double *layer, double top)
{
    bool first = g->layers == 0, last = g->layers + 1 == g->nodes[0];

    keep(g, l, work, layer);
    if (!first) {
        difference(g, l, work);
        add_faces(g, l, work, 1, fmax(top, l->top));
    }
    l->top = top;
    if (!last) return;
    memcpy(work, l->before, l->size * sizeof *work);
    difference(g, l, work);
    add_faces(g, l, work, 0, top);
}

static koksma_status fail_at(const koksma_variation_grid *g, double v, size_t i,
                             koksma_error *err)
{
    char place[100] = "";
    size_t node[KOKSMA_VARIATION_DIM_MOST], used = 0;

    for (size_t j = g->dim; j-- > 1; i /= g->nodes[j])
        node[j] = i % g->nodes[j];
    node[0] = g->layers;
    for (size_t j = 0; j < g->dim && used < sizeof place - 24; j++)
        used += (size_t)snprintf(place + used, sizeof place - used, "%s%zu",
                                 j > 0 ? ", " : "", node[j]);
    return ki_fail(err, KOKSMA_EDOMAIN, 0,
                   "the value at node (%s), counted from 0, is %g, not finite",
                   place, v);
}

static koksma_status take_layer(koksma_variation_grid *g, const double *layer,
                                koksma_error *err)
{
    double top = 0.0;
    bool finite = true;

    for (size_t i = 0; i < g->size; i++) {
        double a = fabs(layer[i]);

        finite = finite && a <= DBL_MAX;
        top = a > top ? a : top;
    }
    for (size_t i = 0; !finite; i++)
        if (!isfinite(layer[i])) return fail_at(g, layer[i], i, err);
    /* What one level passes over, the coarser ones do too, but for the last. */
    for (size_t i = 0; i < g->levels; i++)
        if (g->layers % g->level[i].stride == 0 || g->layers + 1 == g->nodes[0])
            take(g, &g->level[i], g->work, layer, top);
        else
            break;
    g->layers++;
    return KOKSMA_OK;
}

koksma_status koksma_variation_add(koksma_variation_grid *g, const double *values,
                                   size_t count, koksma_error *err)
{
    koksma_status status = KOKSMA_OK;

    g->values += (double)count;
    while (count > 0 && status == KOKSMA_OK) {
        size_t now = g->size - g->filled < count ? g->size - g->filled : count;

        if (g->layers == g->nodes[0])
            return ki_fail(err, KOKSMA_EINVAL, 0, "more values than nodes");
        if (now == g->size) {
            status = take_layer(g, values, err);
        } else {
            memcpy(g->layer + g->filled, values, now * sizeof *values);
            g->filled += now;
            if (g->filled == g->size) {
                status = take_layer(g, g->layer, err);
                g->filled = 0;
            }
        }
        values += now;
        count -= now;
    }
    return status;
}

/* ---- The result -------------------------------------------------------------- */

koksma_status koksma_variation_finish(koksma_variation_result *out,
                                      koksma_estimate *faces,
                                      const koksma_variation_grid *g,
                                      koksma_error *err)
{
    koksma_variation_result r = {.levels = g->levels, .work = g->values};
    size_t count = (size_t)1 << g->dim;

    if (g->layers < g->nodes[0])
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "%.0f values, but the grid has %.0f nodes", g->values,
                       (double)g->size * (double)g->nodes[0]);
    for (size_t i = 0; i < g->levels; i++) {
        const grid_level *l = &g->level[i];
        koksma_variation_level *to = &r.level[g->levels - 1 - i];
        ki_sum sum = {0};

        for (size_t u = 1; u < count; u++)
            ki_sum_add(&sum, ki_sum_value(l->faces[u]));
        to->cells = most_cells(l->nodes, g->dim);
        to->value = ki_variation_exact(ki_sum_value(sum));
        if (!isfinite(to->value.value)) return ki_variation_too_large(err);
    }
    koksma_variation_judge(&r);
    *out = r;
    if (faces == NULL) return KOKSMA_OK;
    faces[0] = ki_variation_exact(0.0);
    for (size_t u = 1; u < count; u++)
        faces[u] = ki_variation_exact(ki_sum_value(g->level[0].faces[u]));
    return KOKSMA_OK;
}
