/* The indicator of a ball round the centre of the cube. */
#include <float.h>
#include <math.h>

#include "integrand_kernels.h"
#include "num_kernels.h"

enum { R };

/* 6 dim + 24 terms are added exactly. */
enum { DIM_MOST = 20 };

/* x^2 as two terms.  fma gives the rest without error unless it underflows. */
static void square(double *term, double x)
{
    term[0] = x * x;
    term[1] = fma(x, x, -term[0]);
}

/* The sign of |x - (1/2,...,1/2)|^2 - r^2 = sum (x^2 - x) + dim/4 - r^2, exactly.
 * Distances in doubles decide where they are further apart than they can be
 * wrong: dim + 2 roundings of what is below 5. */
static int side_of(const koksma_integrand *f, const double *x)
{
    double r = f->param[R], apart = -r * r, term[KI_SIGN_TERMS];
    size_t dim = f->dim, count = 0;

    for (size_t k = 0; k < dim; k++)
        apart += (x[k] - 0.5) * (x[k] - 0.5);
    if (fabs(apart) > 0x1p-44) return apart > 0.0 ? 1 : -1;
    for (size_t k = 0; k < dim; k++, count += 3) {
        square(term + count, x[k]);
        term[count + 2] = -x[k];
    }
    square(term + count, r);
    term[count] = -term[count];
    term[count + 1] = -term[count + 1];
    term[count + 2] = (double)dim / 4.0;
    return ki_sum_sign(term, count + 3);
}

static double value(const koksma_integrand *f, const double *x)
{
    return side_of(f, x) <= 0;
}

/* Whether upper is at least as far from 1/2 as lower, exactly. */
static bool upper_is_far(double lower, double upper)
{
    const double term[] = {lower, upper, -1.0};

    return ki_sum_sign(term, 3) >= 0;
}

/* The nearest and the farthest point of the box decide. */
static koksma_range range(const koksma_integrand *f, const double *lower,
                          const double *upper)
{
    double near[DIM_MOST], far[DIM_MOST];
    bool meets, within;

    for (size_t k = 0; k < f->dim; k++) {
        near[k] = fmin(fmax(0.5, lower[k]), upper[k]);
        far[k] = upper_is_far(lower[k], upper[k]) ? upper[k] : lower[k];
    }
    meets = side_of(f, near) < 0;
    within = side_of(f, far) <= 0;
    return (koksma_range){{within ? 1.0 : 0.0, meets ? 1.0 : 0.0},
                          meets && !within};
}

/* |2i - k| for i <= k: twice the distance from the middle, in units. */
static uint64_t twice_off(uint64_t i, uint64_t k)
{
    return i > k - i ? i - (k - i) : k - i - i;
}

/* factor a b as two terms, the factor being 1, -1 or 2. */
static size_t add_product(double *term, double factor, double a, double b)
{
    term[0] = factor * a * b;
    term[1] = fma(factor * a, b, -term[0]);
    return 2;
}

/* The sign of sum (v_k/cells_k)^2 - (2r)^2, exactly: of sum (v_k unit/cells_k)^2 -
 * (2r)^2 unit^2.  Halves of 32 bits make all products of two exact; of r^2 and
 * unit^2 there are two terms each, and six. */
static int side_of_units(const koksma_integrand *f, const koksma_cell_box *box,
                         const uint64_t *v)
{
    uint64_t unit = ki_common_unit(box, f->dim);
    double term[KI_SIGN_TERMS], part[6], r2[2], high, low;
    size_t count = 0;

    for (size_t k = 0; k < f->dim; k++) {
        uint64_t w = v[k] * (unit / box->cells[k]);

        high = (double)(w >> 32) * 0x1p32;
        low = (double)(w & UINT32_MAX);
        count += add_product(term + count, 1.0, high, high);
        count += add_product(term + count, 2.0, high, low);
        count += add_product(term + count, 1.0, low, low);
    }
    high = (double)(unit >> 32) * 0x1p32;
    low = (double)(unit & UINT32_MAX);
    square(r2, 2.0 * f->param[R]);
    add_product(part, 1.0, high, high);
    add_product(part + 2, 2.0, high, low);
    add_product(part + 4, 1.0, low, low);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 2; j++)
            count += add_product(term + count, -1.0, part[i], r2[j]);
    return ki_sum_sign(term, count);
}

/* The distances of the inside from the middle of the cube are all those between the
 * nearest and the farthest.  In doubles each v is off by 3 half-ulps at most, each
 * square by 8, and sums of up to 20 of them, below 2^5, by far less than 2^-43.
 * Beyond that they decide, and no branch depends on where the box lies. */
static koksma_meeting meets(const koksma_integrand *f, const koksma_cell_box *box)
{
    double level = 4.0 * f->param[R] * f->param[R], nearest = -level,
           farthest = -level, side = 0.0;
    uint64_t near[DIM_MOST], far[DIM_MOST], cells = 0;
    int n, m;

    for (size_t k = 0; k < f->dim; k++) {
        uint64_t lower = box->lower[k], upper = box->upper[k], a, b;
        double v, w;

        if (cells != box->cells[k]) side = 1.0 / (double)box->cells[k];
        cells = box->cells[k];
        a = twice_off(lower, cells);
        b = twice_off(upper, cells);
        far[k] = a > b ? a : b;
        near[k] = a < b ? a : b;
        if ((lower < cells - lower) & (upper > cells - upper)) near[k] = 0;
        v = (double)near[k] * side;
        w = (double)far[k] * side;
        nearest += v * v;
        farthest += w * w;
    }
    n = (nearest > 0.0) - (nearest < 0.0);
    m = (farthest > 0.0) - (farthest < 0.0);
    if (fmin(fabs(nearest), fabs(farthest)) < 0x1p-43) {
        n = side_of_units(f, box, near);
        m = side_of_units(f, box, far);
    }
    return (koksma_meeting)(((n <= 0) & (m >= 0)) + ((n < 0) & (m > 0)));
}

/* Balls of radius 1: V_dim = 2 pi/dim V_(dim-2). */
static double unit_ball(size_t dim)
{
    const double pi = 3.14159265358979323846;
    double v = dim % 2 == 0 ? 1.0 : 2.0;

    for (size_t k = dim % 2 + 2; k <= dim; k += 2)
        v *= 2.0 * pi / (double)k;
    return v;
}

/* The sphere is the derivative of the ball by r, and covers its shadow twice. */
static void facts(koksma_facts *out, const koksma_integrand *f)
{
    double dim = (double)f->dim, r = f->param[R], face = pow(r, dim - 1.0);
    double volume = unit_ball(f->dim) * face * r;

    *out = ki_facts_indicator(volume, 2.0 * (dim + 2.0) * DBL_EPSILON * volume,
                              dim * unit_ball(f->dim) * face,
                              2.0 * dim * unit_ball(f->dim - 1) * face, f->dim);
}

const koksma_integrand_row ki_row_ball = {
    .name = "ball",
    .summary = "1 within r of the centre of the cube",
    .dim = 2,
    .dim_least = 2,
    .dim_most = DIM_MOST,
    .dim_step = 1,
    .params = {{"r", 0.4, 0x1p-20, 0.5, KOKSMA_CLOSED}},
    .functions = {.value = value,
                  .piece = ki_piece_by_value,
                  .range = range,
                  .meets = meets},
    .facts = facts,
};
