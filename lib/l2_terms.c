#include "l2_divide_kernels.h"

/* What each kind is cut into.  As |x-y| = 2 max(x,y) - x - y,
 *
 *     symmetric   1 - s                            B = 1/2 + x             q = 0
 *     periodic    1/2 - s + s^2                    B = 1/4 + x + x^2       q = 2
 *     wraparound  3/2 - s + s^2                    B = 3/4 + x + x^2       q = 2
 *     mixture     15/8 - (t + t' + 3s)/4 + s^2/2   B = 15/16 - t/4 + 3x/4 + x^2/2
 *                                                                          q = 1
 *
 * are B(x) + B(y) - q x y - c max(x,y), and
 *
 *     B(x) + B(y)  =  (B(x)+1)(B(y)+1)/2 - (B(x)-1)(B(y)-1)/2.
 *
 * Each f below is off by less than 2^-101 of its most: at most four operations in
 * twice the precision. */

const ki_l2_terms ki_l2_terms_of[KOKSMA_L2_KINDS] = {
    [KOKSMA_L2_STAR] = {KI_L2_CORE_STAR, 1, 0, {0}, {0}},
    [KOKSMA_L2_EXTREME] = {KI_L2_CORE_EXTREME, 1, 0, {0}, {0}},
    [KOKSMA_L2_PERIODIC] =
        {KI_L2_CORE_MAX, -2, 3, {0.5, -0.5, -2}, {3.25, 1.25, 1}},
    [KOKSMA_L2_CENTERED] = {KI_L2_CORE_CENTERED, 1, 0, {0}, {0}},
    [KOKSMA_L2_WRAPAROUND] =
        {KI_L2_CORE_MAX, -2, 3, {0.5, -0.5, -2}, {3.75, 1.75, 1}},
    [KOKSMA_L2_MIXTURE] =
        {KI_L2_CORE_MAX, -1.5, 3, {0.5, -0.5, -1}, {3.125, 1.125, 1}},
    [KOKSMA_L2_SYMMETRIC] = {KI_L2_CORE_MAX, -2, 2, {0.5, -0.5}, {2.5, 0.5}},
};

/* With terms, (count + 1)^dim sums follow. */
size_t ki_l2_divide_dim(koksma_l2_kind kind)
{
    return ki_l2_terms_of[kind].count == 0 ? KOKSMA_L2_DIVIDE_DIM
                                           : KOKSMA_L2_DIVIDE_DIM_TERMS;
}

/* |x - 1/2|, exactly. */
KI_L2_INLINE ki_twice middle(double x)
{
    return x < 0.5 ? ki_twice_normal(0.5, -x) : ki_twice_normal(x, -0.5);
}

KI_L2_INLINE ki_twice single(double x) { return (ki_twice){x, 0.0}; }

/* B(x) + add */
KI_L2_INLINE ki_twice base(koksma_l2_kind kind, double x, double add)
{
    ki_twice square = ki_twice_product(x, x), b;

    switch (kind) {
    case KOKSMA_L2_PERIODIC:
        return ki_twice_add(ki_twice_sum(0.25 + add, x), square);
    case KOKSMA_L2_WRAPAROUND:
        return ki_twice_add(ki_twice_sum(0.75 + add, x), square);
    case KOKSMA_L2_MIXTURE:
        b = ki_twice_add(ki_twice_sum(0.5 * x, 0.25 * x),
                         ki_twice_scale(middle(x), -0.25));
        b = ki_twice_add(b, ki_twice_scale(square, 0.5));
        return ki_twice_add(b, single(0.9375 + add));
    case KOKSMA_L2_SYMMETRIC:
    case KOKSMA_L2_STAR:
    case KOKSMA_L2_EXTREME:
    case KOKSMA_L2_CENTERED:
    case KOKSMA_L2_KINDS: break;
    }
    return ki_twice_sum(0.5 + add, x);
}

KI_L2_FMA_CLONES static void weigh(const ki_l2_call *call, const double *x,
                                   const uint32_t *point, size_t count,
                                   ki_twice *weight)
{
    for (size_t i = 0; i < count; i++)
        weight[i] = single(1.0);
    for (size_t k = 0; k < call->dim; k++) {
        int r = call->term[k];

        for (size_t i = 0; r >= 0 && i < count; i++) {
            double c = x[(size_t)point[i] * call->dim + k];

            weight[i] = r == 2 ? ki_twice_by(weight[i], c)
                               : ki_twice_times(weight[i], base(call->kind, c,
                                                                r == 0 ? 1 : -1));
        }
    }
}

/* Versions stay in their file, since compilers differ in how others are to name
 * them. */
void ki_l2_weigh(const ki_l2_call *call, const double *x, const uint32_t *point,
                 size_t count, ki_twice *weight)
{
    weigh(call, x, point, count, weight);
}

/* k(x,x), without the factor 2^twos. */
KI_L2_INLINE ki_twice same(koksma_l2_kind kind, double x)
{
    switch (kind) {
    case KOKSMA_L2_STAR: return ki_twice_normal(1.0, -x);
    case KOKSMA_L2_EXTREME: return ki_twice_by(ki_twice_normal(1.0, -x), x);
    case KOKSMA_L2_PERIODIC: return single(0.5);
    case KOKSMA_L2_CENTERED: return ki_twice_add(single(1.0), middle(x));
    case KOKSMA_L2_WRAPAROUND: return single(1.5);
    case KOKSMA_L2_MIXTURE:
        return ki_twice_add(single(1.875), ki_twice_scale(middle(x), -0.5));
    case KOKSMA_L2_SYMMETRIC:
    case KOKSMA_L2_KINDS: break;
    }
    return single(1.0);
}

KI_L2_FMA_CLONES static ki_twice own(koksma_l2_kind kind, koksma_points p)
{
    ki_twice_total sum = {0.0, 0.0, 0};

    for (size_t i = 0; i < p.n; i++) {
        ki_twice v = single(1.0);

        for (size_t k = 0; k < p.dim; k++)
            v = ki_twice_times(v, same(kind, p.x[i * p.dim + k]));
        ki_twice_total_add(&sum, v);
    }
    return ki_twice_total_value(&sum);
}

ki_twice ki_l2_own(koksma_l2_kind kind, koksma_points p) { return own(kind, p); }
