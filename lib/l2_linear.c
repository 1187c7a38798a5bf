#include "l2_kernels.h"

/* The terms of one point alone. */

/* 1 - x and 1 + x exactly, or with all that matters of a tiny x. */
static ki_twice one_less(double x) { return ki_twice_sum(1.0, -x); }

/* |x - 1/2|, exactly. */
static ki_twice from_middle(double x)
{
    ki_twice t = ki_twice_sum(x, -0.5);

    return t.hi < 0.0 ? ki_twice_negate(t) : t;
}

static ki_twice single(double x) { return (ki_twice){x, 0.0}; }

/* h(x) of one coordinate, off by less than 2^-100 of it: at most six operations,
 * none of which cancels but the last of the mixture, from 5/3 to 5/3 - 3/16. */
static ki_twice factor(koksma_l2_kind kind, double x)
{
    /* 5/3 to within 2^-105. */
    static const ki_twice FIVE_THIRDS = {0x1.aaaaaaaaaaaabp+0,
                                         -0x1.5555555555555p-54};
    ki_twice t;

    switch (kind) {
    case KOKSMA_L2_STAR:
        t = ki_twice_times(one_less(x), ki_twice_sum(1.0, x));
        return ki_twice_scale(t, 0.5);
    case KOKSMA_L2_EXTREME:
        return ki_twice_scale(ki_twice_times(single(x), one_less(x)), 0.5);
    case KOKSMA_L2_CENTERED:
        t = from_middle(x);
        t = ki_twice_times(t, ki_twice_add(single(1.0), ki_twice_negate(t)));
        return ki_twice_add(single(1.0), ki_twice_scale(t, 0.5));
    case KOKSMA_L2_MIXTURE:
        t = from_middle(x);
        t = ki_twice_times(t, ki_twice_add(single(1.0), t));
        return ki_twice_add(FIVE_THIRDS, ki_twice_scale(t, -0.25));
    case KOKSMA_L2_SYMMETRIC:
        t = ki_twice_times(single(x), one_less(x));
        return ki_twice_add(single(1.0), ki_twice_scale(t, 2.0));
    case KOKSMA_L2_PERIODIC:
    case KOKSMA_L2_WRAPAROUND:
    case KOKSMA_L2_KINDS: break;
    }
    return single(1.0);
}

static bool vanishes(koksma_l2_kind kind)
{
    return kind == KOKSMA_L2_EXTREME || kind == KOKSMA_L2_SYMMETRIC;
}

/* A factor, above 0, is no less than 2^-255 and no more than 2, so that the product
 * is made normal long before it leaves the range of doubles. */
static ki_l2_number times(ki_l2_number v, ki_twice f)
{
    v.m = ki_twice_times(v.m, f);
    if (v.m.hi != 0.0 && (v.m.hi < 0x1p-400 || v.m.hi > 0x1p400))
        v = ki_l2_normal(v);
    return v;
}

static double least(koksma_l2_kind kind, double x)
{
    return vanishes(kind) && x > 0.0 && x < KI_L2_LEAST ? KI_L2_LEAST : x;
}

/* Each product is off by its dim factors, 2^-100 each, and dim operations. */
static ki_l2_number point(koksma_l2_kind kind, const double *x, size_t dim)
{
    ki_l2_number v = {{1.0, 0.0}, 0.0, 0};

    for (size_t k = 0; k < dim && v.m.hi != 0.0; k++)
        v = times(v, factor(kind, least(kind, x[k])));
    v.err = (double)dim * 0x1p-99 * v.m.hi;
    return v;
}

ki_l2_number ki_l2_linear(koksma_points p, koksma_l2_kind kind)
{
    ki_l2_number sum = {{0.0, 0.0}, 0.0, 0};

    for (size_t i = 0; i < p.n; i++)
        sum = ki_l2_add(sum, point(kind, p.x + i * p.dim, p.dim));
    return sum;
}

/* numerator / denominator to within 2^-105, dim times. */
ki_l2_number ki_l2_constant(koksma_l2_kind kind, size_t dim)
{
    const ki_l2_row *row = &ki_l2_rows[kind];
    ki_l2_number v = {{1.0, 0.0}, 0.0, 0};
    ki_twice c;

    c.hi = row->numerator / row->denominator;
    c.lo = fma(-c.hi, row->denominator, row->numerator) / row->denominator;
    for (size_t k = 0; k < dim; k++)
        v = times(v, c);
    v.err = (double)dim * 0x1p-99 * v.m.hi;
    v.e += (int64_t)dim * row->twos;
    return v;
}

/* k moves by at most KI_L2_LEAST, h by half of it (symmetric: twice), in each of
 * dim coordinates, where the other factors are at most 1/4, 1/8 (extreme), 2 and
 * 3/2 (symmetric).  The sum and twice the linear term together move by less than
 * four times as much. */
ki_l2_number ki_l2_flushed(koksma_points p, koksma_l2_kind kind)
{
    ki_l2_number v = {{0.0, 0.0}, 0.0, 0};

    if (!vanishes(kind)) return v;
    for (size_t i = 0; i < p.n * p.dim; i++) {
        if (least(kind, p.x[i]) == p.x[i]) continue;
        v.err = 8.0 * KI_L2_LEAST * (double)p.dim;
        v.e = (int64_t)(p.dim - 1) * (kind == KOKSMA_L2_EXTREME ? -2 : 1);
        break;
    }
    return v;
}
