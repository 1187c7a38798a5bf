#ifndef KI_L2_DIVIDE_KERNELS_H
#define KI_L2_DIVIDE_KERNELS_H

#include "l2_kernels.h"

/* Private: lists of points for divide and conquer.  An item is KI_L2_ITEM + 2 dim -
 * 1 doubles: its weight, its coordinates, and its ranks along coordinates 1, ...,
 * dim - 1, all of them different. */
enum { KI_L2_ITEM = 2 };

typedef struct ki_l2_key {
    uint64_t bits; /* of a number >= 0 */
    uint64_t point;
} ki_l2_key;

/* Sort by bits, stably; spare has room for n.  Returns where the result is. */
ki_l2_key *ki_l2_sort(ki_l2_key *key, ki_l2_key *spare, size_t n);

typedef struct ki_l2_list {
    double *item;
    size_t n;
} ki_l2_list;

typedef struct ki_l2_worker {
    koksma_l2_kind kind;
    size_t dim, stride;
    double *spare;  /* room for as many items as the longest list has: partitions */
    double *copies; /* and for dim times as many */
    ki_twice_total sum;
    double steps; /* terms added to sum and to the sums that they hold */
} ki_l2_worker;

/* Add to w->sum the sum of w_a w_b k(a_0,b_0) ... k(a_(axes-1),b_(axes-1)) over a
 * in the one list and b in the other.  Both are sorted by coordinate 0, and are not
 * when it returns. */
void ki_l2_cross(ki_l2_worker *w, size_t axes, ki_l2_list a, ki_l2_list b);

/* The same over all pairs in one list, each once, in all dim coordinates. */
void ki_l2_within(ki_l2_worker *w, ki_l2_list a);

/* The part of that of pairs on either side of a rank along the last axis. */
void ki_l2_apart(ki_l2_worker *w, ki_l2_list a, double rank);

/* ki_l2_cross with one axis.  With a role r >= 0 the weights are also multiplied by
 * f_r (a) and g_r (b) of coordinate 1: the last level without copies. */
void ki_l2_merge(ki_l2_worker *w, ki_l2_list a, ki_l2_list b, int role);

/* Few items: every pair. */
void ki_l2_brute(ki_l2_worker *w, size_t axes, ki_l2_list a, ki_l2_list b);

/* Faster than memcpy for so few. */
KI_L2_INLINE void ki_l2_copy(double *to, const double *from, size_t count)
{
    for (size_t i = 0; i < count; i++)
        to[i] = from[i];
}

/* f_r(x) and g_r(y) of the kind: for x <= y,  k(x,y) = sum over r of f_r(x) g_r(y).
 *
 *     star        1 (1-y)
 *     extreme     x (1-y)
 *     centered    (1 + max(x-1/2,0)) (1 + max(1/2-y,0))
 *     symmetric   x 1 + 1 (1-y)                             (without its factor 2)
 *     periodic    1 (1/2 - y + y^2) + x (1-2y) + x^2 1
 *     wraparound  the same with 3/2
 *     mixture     (-|x-1/2|/4 + 3x/4 + x^2/2) 1 + x (-y)
 *                 + 1 (15/8 - |y-1/2|/4 - 3y/4 + y^2/2)
 *
 * x, 1-x, 1-2x and x-1/2 are exact in twice the precision, x^2 too unless it
 * underflows, which loses less than 2^-1070; the rest takes at most four operations
 * on numbers of at most 2, off by 2^-103 of that each. */
KI_L2_INLINE ki_twice ki_l2_small(double x) { return (ki_twice){x, 0.0}; }

KI_L2_INLINE ki_twice ki_l2_middle(double x)
{
    ki_twice t = ki_twice_sum(x, -0.5);

    return t.hi < 0.0 ? ki_twice_negate(t) : t;
}

/* -|x-1/2|/4 + x^2/2 */
KI_L2_INLINE ki_twice ki_l2_bow(double x)
{
    return ki_twice_add(ki_twice_scale(ki_l2_middle(x), -0.25),
                        ki_twice_scale(ki_twice_product(x, x), 0.5));
}

/* 3/4 x, exactly. */
KI_L2_INLINE ki_twice ki_l2_three(double x)
{
    return ki_twice_sum(0.5 * x, 0.25 * x);
}

KI_L2_INLINE ki_twice ki_l2_first(koksma_l2_kind kind, int r, double x)
{
    switch (kind) {
    case KOKSMA_L2_EXTREME: return ki_l2_small(x);
    case KOKSMA_L2_CENTERED:
        return x > 0.5 ? ki_twice_sum(x, 0.5) : ki_l2_small(1.0);
    case KOKSMA_L2_SYMMETRIC: return ki_l2_small(r == 0 ? x : 1.0);
    case KOKSMA_L2_PERIODIC:
    case KOKSMA_L2_WRAPAROUND:
        return r == 0   ? ki_l2_small(1.0)
               : r == 1 ? ki_l2_small(x)
                        : ki_twice_product(x, x);
    case KOKSMA_L2_MIXTURE:
        return r == 0   ? ki_twice_add(ki_l2_bow(x), ki_l2_three(x))
               : r == 1 ? ki_l2_small(x)
                        : ki_l2_small(1.0);
    case KOKSMA_L2_STAR:
    case KOKSMA_L2_KINDS: break;
    }
    return ki_l2_small(1.0);
}

KI_L2_INLINE ki_twice ki_l2_second(koksma_l2_kind kind, int r, double y)
{
    switch (kind) {
    case KOKSMA_L2_CENTERED:
        return y < 0.5 ? ki_twice_sum(1.5, -y) : ki_l2_small(1.0);
    case KOKSMA_L2_SYMMETRIC:
        return r == 0 ? ki_l2_small(1.0) : ki_twice_sum(1.0, -y);
    case KOKSMA_L2_PERIODIC:
    case KOKSMA_L2_WRAPAROUND:
        return r == 0
                   ? ki_twice_add(
                         ki_twice_sum(kind == KOKSMA_L2_PERIODIC ? 0.5 : 1.5, -y),
                         ki_twice_product(y, y))
               : r == 1 ? ki_twice_sum(1.0, -2.0 * y)
                        : ki_l2_small(1.0);
    case KOKSMA_L2_MIXTURE:
        return r == 0 ? ki_l2_small(1.0)
               : r == 1
                   ? ki_l2_small(-y)
                   : ki_twice_add(ki_twice_add(ki_l2_small(1.875), ki_l2_bow(y)),
                                  ki_twice_negate(ki_l2_three(y)));
    case KOKSMA_L2_STAR:
    case KOKSMA_L2_EXTREME:
    case KOKSMA_L2_KINDS: break;
    }
    return ki_twice_sum(1.0, -y);
}

#endif
