/* The variation of a function that is constant on most boxes: halve boxes of cells
 * until its range is one number, or one cell is left.
 *
 * The range on a box says nothing of its faces, on which the outer nodes lie.  So
 * the range is asked of a box half a cell wider on each side, inside of which they
 * are.  At the faces of the cube there is nothing wider; there the corners of the
 * box are looked at as well.  A face of the cube is a box half a cell thick. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "variation_kernels.h"

/* Nodes low, ..., high of the k-grid, on each axis of u. */
typedef struct block {
    size_t low[KOKSMA_VARIATION_DIM_MOST], high[KOKSMA_VARIATION_DIM_MOST];
} block;

typedef struct tree {
    const koksma_integrand *f;
    size_t k;
    unsigned u;
    block *stack; /* depth first: two for each halving of each axis */
    size_t depth;
    ki_variation_watch *watch;
    double x[KOKSMA_VARIATION_DIM_MOST];
    size_t leaves;
    ki_sum sum;
} tree;

/* Whether f is v at the corners of the box. */
static bool corners_agree(tree *t, const block *b, double v)
{
    const koksma_integrand *f = t->f;
    unsigned corner = t->u;

    for (;;) {
        for (size_t j = 0; j < f->dim; j++)
            if (t->u >> j & 1)
                t->x[j] = (double)(corner >> j & 1 ? b->high[j] : b->low[j]) /
                          (double)t->k;
        t->watch->work++;
        if (!(f->value(f, t->x) == v)) return false;
        if (corner == 0) return true;
        corner = (corner - 1) & t->u; /* the next smaller subset */
    }
}

static bool is_flat(tree *t, const block *b)
{
    double lower[KOKSMA_VARIATION_DIM_MOST], upper[KOKSMA_VARIATION_DIM_MOST];
    double wide = 2.0 * (double)t->k;
    bool inside = true;
    koksma_range range;

    for (size_t j = 0; j < t->f->dim; j++) {
        bool varies = t->u >> j & 1;
        size_t low = varies ? b->low[j] : t->k, high = varies ? b->high[j] : t->k;

        lower[j] = low > 0 ? (2.0 * (double)low - 1.0) / wide : 0.0;
        upper[j] = high < t->k ? (2.0 * (double)high + 1.0) / wide : 1.0;
        inside = inside && low > 0 && high < t->k;
    }
    range = t->f->range(t->f, lower, upper);
    if (range.cut || !(range.value.lower == range.value.upper)) return false;
    return inside || corners_agree(t, b, range.value.lower);
}

/* Halve b along its longest axis; false where it is one cell. */
static bool halve(const tree *t, block *b, block *other)
{
    size_t longest = t->f->dim, most = 1;

    for (size_t j = 0; j < t->f->dim; j++)
        if ((t->u >> j & 1) && b->high[j] - b->low[j] > most) {
            most = b->high[j] - b->low[j];
            longest = j;
        }
    if (longest == t->f->dim) return false;
    *other = *b;
    b->high[longest] = other->low[longest] = b->low[longest] + most / 2;
    return true;
}

/* All boxes of the face; where `measure` is not set leaves are counted alone. */
static koksma_status descend(tree *t, bool measure, koksma_error *err)
{
    size_t used = 1;

    for (size_t j = 0; j < t->f->dim; j++) {
        t->x[j] = 1.0;
        t->stack[0].low[j] = 0;
        t->stack[0].high[j] = t->k;
    }
    while (used > 0) {
        block *b = &t->stack[used - 1];

        if (ki_variation_told_to_stop(t->watch))
            return ki_variation_stopped(t->watch, err);
        if (is_flat(t, b)) {
            used--;
        } else if (halve(t, b, &t->stack[used])) {
            used++;
        } else {
            double d;

            t->leaves++;
            used--;
            if (!measure) continue;
            d = ki_variation_cell(t->f, t->u, b->low, t->k, t->x, &t->watch->work);
            if (!isfinite(d)) return ki_variation_bad_value(t->f, t->x, err);
            ki_sum_add(&t->sum, d);
        }
    }
    return KOKSMA_OK;
}

/* A box is halved log2 k times an axis, and each time one half waits. */
static bool plant(tree *t, const koksma_integrand *f, size_t k,
                  ki_variation_watch *w)
{
    size_t depth = 2;

    *t = (tree){.f = f, .k = k, .watch = w};
    for (size_t cells = k; cells > 0; cells /= 2)
        depth += f->dim;
    t->stack = ki_alloc(depth, sizeof *t->stack);
    return t->stack != NULL;
}

koksma_status ki_variation_tree(koksma_variation_level *out, koksma_estimate *faces,
                                const koksma_integrand *f, size_t k,
                                ki_variation_watch *w, koksma_error *err)
{
    koksma_status status = KOKSMA_OK;
    ki_sum sum = {0};
    tree t;

    if (!plant(&t, f, k, w)) return ki_fail_memory(err, "boxes of cells");
    if (faces != NULL) faces[0] = ki_variation_exact(0.0);
    for (t.u = 1; t.u < 1u << f->dim && status == KOKSMA_OK; t.u++) {
        t.sum = (ki_sum){0};
        status = descend(&t, true, err);
        ki_sum_add(&sum, ki_sum_value(t.sum));
        if (faces != NULL) faces[t.u] = ki_variation_exact(ki_sum_value(t.sum));
    }
    free(t.stack);
    if (status == KOKSMA_OK)
        *out = (koksma_variation_level){k, ki_variation_exact(ki_sum_value(sum))};
    return status;
}

size_t ki_variation_tree_leaves(const koksma_integrand *f, size_t k)
{
    ki_variation_watch nobody = {0};
    tree t;

    if (!plant(&t, f, k, &nobody)) return SIZE_MAX;
    t.u = (1u << f->dim) - 1;
    (void)descend(&t, false, NULL);
    free(t.stack);
    return t.leaves;
}
