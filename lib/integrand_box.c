/* The indicator of a box at the origin. */
#include <float.h>
#include <math.h>

#include "integrand_kernels.h"
#include "num_wide.h"

enum { C };

static double value(const koksma_integrand *f, const double *x)
{
    for (size_t k = 0; k < f->dim; k++)
        if (x[k] > f->param[C]) return 0.0;
    return 1.0;
}

static koksma_range range(const koksma_integrand *f, const double *lower,
                          const double *upper)
{
    double c = f->param[C];
    bool meets = true, within = true;

    for (size_t k = 0; k < f->dim; k++) {
        meets = meets && lower[k] < c;
        within = within && upper[k] <= c;
    }
    return (koksma_range){{within ? 1.0 : 0.0, meets ? 1.0 : 0.0},
                          meets && !within};
}

/* The box of cells has points in the corner box and out of it.  Both are so with
 * room to spare where the inside has such points, and for its closure without.  No
 * branch depends on where it lies. */
koksma_meeting ki_meets_corner(double c, size_t axes, const koksma_cell_box *box)
{
    bool in = true, out = false, reaches_in = true, reaches_out = false;

    if (c <= 0.0 || c >= 1.0) return KOKSMA_APART;
    for (size_t k = 0; k < axes; k++) {
        ki_multiple at = ki_times(c, box->cells[k]);
        uint64_t below = (uint64_t)at.floor, lower = box->lower[k],
                 upper = box->upper[k];

        bool under = lower<below, over = upper> below;

        in &= under | ((lower == below) & !at.whole);
        out |= over;
        reaches_in &= lower <= below;
        reaches_out |= over | ((upper == below) & at.whole);
    }
    return (koksma_meeting)((reaches_in & reaches_out) + (in & out));
}

static koksma_meeting meets(const koksma_integrand *f, const koksma_cell_box *box)
{
    return ki_meets_corner(f->param[C], f->dim, box);
}

static void facts(koksma_facts *out, const koksma_integrand *f)
{
    double dim = (double)f->dim, c = f->param[C], sides = pow(c, dim - 1.0);
    double volume = c * sides,
           error = f->dim == 1 ? 0.0 : 2.0 * DBL_EPSILON * volume;

    *out = ki_facts_smooth(volume, error);
    if (c > 0.0 && c < 1.0) {
        *out = ki_facts_indicator(volume, error, dim * sides, dim * sides, f->dim);
        out->axes = 1.0;
    }
    out->variance = volume * (1.0 - volume);
    out->variation = c < 1.0 ? 1.0 : 0.0;
}

const koksma_integrand_row ki_row_box = {
    .name = "box",
    .summary = "1 where every coordinate is at most c",
    .dim = 2,
    .dim_least = 1,
    .dim_most = 50,
    .dim_step = 1,
    .params = {{"c", 0.7, 0.0, 1.0, KOKSMA_CLOSED}},
    .functions = {.value = value,
                  .piece = ki_piece_by_value,
                  .range = range,
                  .meets = meets},
    .facts = facts,
};
