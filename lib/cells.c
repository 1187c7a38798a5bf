/* Counting boundary cells: boxes of cells are halved until they are cells. */
#include "cells.h"

#include <math.h>
#include <stdlib.h>

#include "cells_kernels.h"
#include "error.h"

enum { BETWEEN_PROGRESS = 1 << 14, FEW_CELLS = 8 };

/* Boxes that meet the discontinuity, the last one first.  Halving a box leaves one
 * of its halves here and goes on with the other, so that no more lie here at a time
 * than it takes halvings from all cells to one: 64 + dim. */
typedef struct tree {
    const koksma_integrand *f;
    const uint64_t *cells;
    void *memory;
    uint64_t *box;  /* lower and upper, dim each, a box */
    uint64_t *cell; /* likewise, of one */
    double *side;   /* of a cell */
    double *corner; /* lower and upper, for range */
    size_t boxes;
} tree;

/* The corners as doubles, for a range. */
static koksma_meeting meet_range(const tree *t, const uint64_t *lower)
{
    size_t dim = t->f->dim;

    for (size_t k = 0; k < dim; k++) {
        t->corner[k] = (double)lower[k] / (double)t->cells[k];
        t->corner[dim + k] = (double)lower[dim + k] / (double)t->cells[k];
    }
    return t->f->range(t->f, t->corner, t->corner + dim).cut ? KOKSMA_CUTS
                                                             : KOKSMA_APART;
}

static inline koksma_meeting meet(const tree *t, const uint64_t *lower)
{
    koksma_cell_box box = {lower, lower + t->f->dim, t->cells};

    return t->f->meets != NULL ? t->f->meets(t->f, &box) : meet_range(t, lower);
}

static koksma_status tree_open(tree *t, const koksma_integrand *f,
                               const uint64_t *cells, koksma_error *err)
{
    size_t row = 2 * f->dim, most = 64 + f->dim + 1;

    *t = (tree){.f = f, .cells = cells};
    t->memory = ki_alloc(most + 3, row * sizeof(uint64_t));
    if (t->memory == NULL) return ki_fail_memory(err, "boxes of cells");
    t->box = t->memory;
    t->corner = (double *)t->memory + most * row;
    t->side = t->corner + row;
    t->cell = t->box + (most + 2) * row;
    for (size_t k = 0; k < f->dim; k++) {
        t->box[k] = 0;
        t->box[f->dim + k] = cells[k];
        t->side[k] = 1.0 / (double)cells[k];
    }
    t->boxes = meet(t, t->box) != KOKSMA_APART;
    return KOKSMA_OK;
}

/* The axis along which the box, of several cells, is longest, of those along which
 * it has several. */
static size_t longest(const tree *t, const uint64_t *lower)
{
    size_t dim = t->f->dim, axis = dim;
    double length = 0.0;

    for (size_t k = 0; k < dim; k++) {
        uint64_t many = lower[dim + k] - lower[k];
        double l = (double)many * t->side[k];

        if (many < 2 || l <= length) continue;
        axis = k;
        length = l;
    }
    return axis;
}

static uint64_t cells_in(const uint64_t *box, size_t dim)
{
    uint64_t product = 1;

    for (size_t k = 0; k < dim; k++)
        product *= box[dim + k] - box[k];
    return product;
}

/* Count the last box cell by cell: no outcome is waited for, so that this is sooner
 * done than halving a few cells. */
static void count_each(tree *t, koksma_cell_count *c)
{
    size_t dim = t->f->dim, k;
    const uint64_t *box = t->box + 2 * dim * (t->boxes - 1);
    uint64_t *at = t->cell;

    for (k = 0; k < dim; k++) {
        at[k] = box[k];
        at[dim + k] = box[k] + 1;
    }
    do {
        koksma_meeting m = meet(t, at);

        c->lower += m == KOKSMA_CUTS;
        c->touched += m == KOKSMA_TOUCHES;
        c->work += 1.0;
        for (k = 0; k < dim && at[dim + k] == box[dim + k]; k++) {
            at[k] = box[k];
            at[dim + k] = box[k] + 1;
        }
        if (k < dim) {
            at[k]++;
            at[dim + k]++;
        }
    } while (k < dim);
    t->boxes--;
}

/* The last box leaves those of its halves that meet the discontinuity.  When one is
 * apart from it, then so is the face between them, and the other half meets it as
 * the whole did. */
static void halve(tree *t, koksma_cell_count *c)
{
    size_t dim = t->f->dim, row = 2 * dim, axis;
    uint64_t *box = t->box + row * (t->boxes - 1), low, mid, high;
    koksma_meeting one, other;

    axis = longest(t, box);
    low = box[axis];
    high = box[dim + axis];
    mid = low + (high - low) / 2;
    box[dim + axis] = mid;
    one = meet(t, box);
    box[dim + axis] = high;
    box[axis] = mid;
    c->work += 1.0;
    if (one == KOKSMA_APART) return;
    other = meet(t, box);
    c->work += 1.0;
    if (other != KOKSMA_APART) {
        for (size_t k = 0; k < row; k++)
            box[row + k] = box[k];
        box += row;
        t->boxes++;
    }
    box[axis] = low;
    box[dim + axis] = mid;
}

static void look(tree *t, koksma_cell_count *c)
{
    size_t dim = t->f->dim;

    if (cells_in(t->box + 2 * dim * (t->boxes - 1), dim) <= FEW_CELLS)
        count_each(t, c);
    else
        halve(t, c);
}

/* Cells in boxes that were not halved. */
static uint64_t left(const tree *t)
{
    size_t dim = t->f->dim;
    uint64_t cells = 0;

    for (size_t i = 0; i < t->boxes; i++)
        cells += cells_in(t->box + 2 * dim * i, dim);
    return cells;
}

koksma_status koksma_cells_count(koksma_cell_count *out, const koksma_integrand *f,
                                 const uint64_t *cells,
                                 const koksma_cells_opts *opts, koksma_error *err)
{
    koksma_cell_count c = {.total = ki_grid_total(cells, f->dim), .work = 1.0};
    koksma_progress *progress = opts != NULL ? opts->progress : NULL;
    koksma_status status;
    bool stopped = false;
    tree t;

    if (c.total == 0)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "the number of cells is not from 1 to 2^64 - 1");
    if (f->meets == NULL && f->range == NULL)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "the integrand does not say which boxes its "
                       "discontinuity meets");
    status = tree_open(&t, f, cells, err);
    if (status != KOKSMA_OK) return status;
    while (t.boxes > 0 && !stopped) {
        for (int i = 0; i < BETWEEN_PROGRESS && t.boxes > 0; i++)
            look(&t, &c);
        stopped = progress != NULL && t.boxes > 0 &&
                  progress(opts->state, (double)c.lower,
                           (double)(c.lower + left(&t)), c.work) != 0;
    }
    c.upper = c.lower + left(&t);
    free(t.memory);
    *out = c;
    if (!stopped) return KOKSMA_OK;
    return ki_fail(err, KOKSMA_STOPPED, 0, "stopped before all cells were counted");
}
