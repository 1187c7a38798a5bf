#ifndef KI_NUM_TWICE_H
#define KI_NUM_TWICE_H

#include <math.h>

#include "num_kernels.h"

/* Private: numbers of twice the precision of a double, hi + lo with |lo| at most
 * half an ulp of hi.
 *
 * Each of the operations below that is not exact, and says nothing else, is off by
 * less than 2^-103 of its result: 3 u^2 for the sum, 5 u^2 for the product, u =
 * 2^-53 [Joldes, Muller, Popescu 2017, algorithms 6 and 11], unless a product is
 * below 2^-960; what underflow then loses is below 2^-1070. */
/* Into every version of a loop for other processors, fma as one instruction. */
#define KI_TWICE_INLINE static inline __attribute__((always_inline))

typedef struct ki_twice {
    double hi, lo;
} ki_twice;

/* a + b, exactly. */
KI_TWICE_INLINE ki_twice ki_twice_sum(double a, double b)
{
    ki_twice s;

    s.hi = ki_two_sum(a, b, &s.lo);
    return s;
}

/* a + b, exactly, where |a| >= |b| or a is 0. */
KI_TWICE_INLINE ki_twice ki_twice_normal(double a, double b)
{
    double s = a + b;

    return (ki_twice){s, b - (s - a)};
}

/* a * b, exactly: that is what fma is for. */
KI_TWICE_INLINE ki_twice ki_twice_product(double a, double b)
{
    double p = a * b;

    return (ki_twice){p, fma(a, b, -p)};
}

KI_TWICE_INLINE ki_twice ki_twice_add(ki_twice a, ki_twice b)
{
    ki_twice s = ki_twice_sum(a.hi, b.hi), t = ki_twice_sum(a.lo, b.lo);

    s = ki_twice_normal(s.hi, s.lo + t.hi);
    return ki_twice_normal(s.hi, s.lo + t.lo);
}

KI_TWICE_INLINE ki_twice ki_twice_times(ki_twice a, ki_twice b)
{
    ki_twice p = ki_twice_product(a.hi, b.hi);

    return ki_twice_normal(p.hi, p.lo + fma(a.hi, b.lo, a.lo * b.hi));
}

/* By a double: off by 2 u^2 [algorithm 9 there]. */
KI_TWICE_INLINE ki_twice ki_twice_by(ki_twice a, double b)
{
    ki_twice p = ki_twice_product(a.hi, b);

    return ki_twice_normal(p.hi, fma(a.lo, b, p.lo));
}

/* a / b, off by less than 2^-102 of it.  With u = 2^-53 and q the rounded quotient
 * of the high parts, a.hi - q b.hi is at most u |a| and a double, so that fma has
 * it exactly; a.lo - q b.lo is at most 2 u |a| and rounds once, the sum of the two
 * is at most 3 u |a| and rounds once, its quotient is at most 3 u |a/b|, rounds
 * once, and is off by another u for b.lo: together 11 u^2. */
KI_TWICE_INLINE ki_twice ki_twice_divide(ki_twice a, ki_twice b)
{
    double q = a.hi / b.hi;
    double rest = fma(-q, b.hi, a.hi) + fma(-q, b.lo, a.lo);

    return ki_twice_normal(q, rest / b.hi);
}

/* By a power of two, exactly but for underflow. */
KI_TWICE_INLINE ki_twice ki_twice_scale(ki_twice a, double power)
{
    return (ki_twice){a.hi * power, a.lo * power};
}

KI_TWICE_INLINE ki_twice ki_twice_negate(ki_twice a)
{
    return (ki_twice){-a.hi, -a.lo};
}

/* A sum of very many terms t with |t.lo| <= 2^-53 |t.hi|.  Each step rounds rest
 * twice; normalised after at most 32 steps, rest stays below 34 ulps of the sum of
 * the absolute values, A, and a step loses at most 2^-53 (34 + 2) 2^-53 A.  So m
 * steps lose less than 36 m 2^-106 A. */
typedef struct ki_twice_total {
    double sum, rest;
    int steps;
} ki_twice_total;

KI_TWICE_INLINE void ki_twice_total_add(ki_twice_total *s, ki_twice t)
{
    double rest;

    s->sum = ki_two_sum(s->sum, t.hi, &rest);
    s->rest += rest + t.lo;
    if ((++s->steps & 31) == 0) s->sum = ki_two_sum(s->sum, s->rest, &s->rest);
}

KI_TWICE_INLINE ki_twice ki_twice_total_value(const ki_twice_total *s)
{
    return ki_twice_sum(s->sum, s->rest);
}

#endif
