#include <string.h>

#include "l2_divide_kernels.h"

/* The loops of divide and conquer, each compiled for each core.  What depends on
 * the side of an item, which no processor foresees, is selected and not branched
 * on. */

/* c ? a : b */
KI_L2_INLINE double pick(bool c, double a, double b)
{
    uint64_t mask = -(uint64_t)c, p, q;

    memcpy(&p, &a, sizeof p);
    memcpy(&q, &b, sizeof q);
    q ^= (p ^ q) & mask;
    memcpy(&b, &q, sizeof b);
    return b;
}

/* second(x) where high, else first(x), exactly: a sum of two numbers of which the
 * first is no less than the absolute value of the second. */
KI_L2_INLINE ki_twice factor(ki_l2_core core, bool high, double x)
{
    switch (core) {
    case KI_L2_CORE_STAR: return ki_twice_normal(1.0, -pick(high, x, 0.0));
    case KI_L2_CORE_EXTREME:
        return ki_twice_normal(pick(high, 1.0, x), -pick(high, x, 0.0));
    case KI_L2_CORE_CENTERED: {
        bool far = high ? x < 0.5 : x > 0.5;

        return ki_twice_normal(pick(far, pick(high, 1.5, x), 1.0),
                               pick(far, pick(high, -x, 0.5), 0.0));
    }
    case KI_L2_CORE_MAX:
    case KI_L2_CORES: break;
    }
    return (ki_twice){pick(high, x, 1.0), 0.0};
}

KI_L2_INLINE ki_twice times(ki_l2_core core, ki_twice w, bool high, double x)
{
    if (core == KI_L2_CORE_MAX) return ki_twice_by(w, pick(high, x, 1.0));
    return ki_twice_times(w, factor(core, high, x));
}

KI_L2_INLINE ki_twice times_first(ki_l2_core core, ki_twice w, double x)
{
    if (core == KI_L2_CORE_MAX || core == KI_L2_CORE_STAR) return w;
    if (core == KI_L2_CORE_EXTREME) return ki_twice_by(w, x);
    return times(core, w, false, x);
}

/* core(x,y) */
KI_L2_INLINE ki_twice times_core(ki_l2_core core, ki_twice w, double x, double y)
{
    double low = x < y ? x : y, high = x < y ? y : x;

    switch (core) {
    case KI_L2_CORE_MAX: return ki_twice_by(w, high);
    case KI_L2_CORE_STAR: return ki_twice_times(w, ki_twice_normal(1.0, -high));
    case KI_L2_CORE_EXTREME:
        return ki_twice_times(ki_twice_by(w, low), ki_twice_normal(1.0, -high));
    case KI_L2_CORE_CENTERED:
    case KI_L2_CORES: break;
    }

    /* One of the factors is 1. */
    double a = low > 0.5 ? low : high < 0.5 ? 1.5 : 1.0;
    double b = low > 0.5 ? 0.5 : high < 0.5 ? -high : 0.0;

    return ki_twice_times(w, ki_twice_normal(a, b));
}

KI_L2_INLINE ki_twice weight(const ki_l2_slot *item)
{
    return (ki_twice){item[0].x, item[1].x};
}

/* ---- Two axes ---------------------------------------------------------------- */

/* An item meets those before it on the other side of the cut.  At each tie along
 * axis 0 either order gives the same product. */
KI_L2_INLINE ki_l2_halves sweep(ki_l2_core core, ki_l2_worker *w, ki_l2_list l,
                                uint32_t cut, size_t stride)
{
    size_t at = ki_l2_coordinates(w->axes), ones[2] = {0, 0};
    ki_l2_slot *to[2] = {l.item, w->spare};
    const ki_l2_slot *item = l.item;
    double sum[4] = {0.0}, rest[4] = {0.0}; /* of items before: by half and side */
    ki_twice_total all = {0.0, 0.0, 0};

    for (size_t left = l.n; left > 0;) {
        size_t block = left < 32 ? left : 32;

        left -= block;
        for (; block > 0; block--, item += stride) {
            bool high = item[KI_L2_RANKS].rank[1] >= cut;
            size_t side = item[KI_L2_RANKS].rank[0], own = 2 * high + side;
            size_t other = own ^ (l.across ? 3 : 2);
            double x = item[at].x, r;
            ki_twice v = times(core, weight(item), high, item[at + 1].x);
            ki_twice g = ki_twice_times(times(core, v, true, x),
                                        (ki_twice){sum[other], rest[other]});
            ki_twice f = times_first(core, v, x);

            all.sum = ki_two_sum(all.sum, g.hi, &r);
            all.rest += r + g.lo;
            sum[own] = ki_two_sum(sum[own], f.hi, &r);
            rest[own] += r + f.lo;
            ki_l2_copy(to[high], item, stride);
            to[high] += stride;
            ones[high] += side;
        }
        all.sum = ki_two_sum(all.sum, all.rest, &all.rest);
        for (int s = 0; s < 4; s++)
            sum[s] = ki_two_sum(sum[s], rest[s], &rest[s]);
    }
    ki_twice_total_add(&w->sum, ki_twice_total_value(&all));

    size_t high = (size_t)(to[1] - w->spare) / stride, low = l.n - high;

    memcpy(to[0], w->spare, high * stride * sizeof *to[0]);
    ki_l2_count(w, (double)l.n, (double)low * (double)high);
    return (ki_l2_halves){
        {l.item, low, ones[0], l.begin, cut, l.across},
        {to[0], high, ones[1], cut, l.end, l.across},
    };
}

/* ---- More axes --------------------------------------------------------------- */

KI_L2_INLINE ki_l2_list lift(ki_l2_core core, ki_l2_worker *w, ki_l2_slot *to,
                             ki_l2_list l, size_t axis, uint32_t cut, bool swapped)
{
    size_t stride = w->stride, at = ki_l2_coordinates(w->axes) + axis;
    ki_l2_list s = {.item = to, .begin = UINT32_MAX, .end = 0, .across = true};
    ki_l2_slot *item = l.item;

    for (size_t i = 0; i < l.n; i++, item += stride) {
        bool high = *ki_l2_rank(item, axis) >= cut,
             side = item[KI_L2_RANKS].rank[0];
        uint32_t rank = *ki_l2_rank(item, axis - 1);
        ki_twice v = times(core, weight(item), high, item[at].x);

        /* Written always, and overwritten where it does not belong. */
        ki_l2_copy(to, item, stride);
        to[0].x = v.hi;
        to[1].x = v.lo;
        to[KI_L2_RANKS].rank[0] = high;
        if (l.across && (side ^ swapped) != high) continue;
        to += stride;
        s.ones += high;
        if (rank < s.begin) s.begin = rank;
        if (rank >= s.end) s.end = rank + 1;
    }
    s.n = (size_t)(to - s.item) / stride;
    w->steps += (double)l.n;
    return s;
}

/* ---- Few items --------------------------------------------------------------- */

/* Items in columns, for vectors of them. */
enum { COLUMN = 64, LANES = 8 };

typedef struct columns {
    double hi[COLUMN], lo[COLUMN], x[KOKSMA_L2_DIVIDE_DIM][COLUMN];
} columns;

/* A weight of 0 in the lanes behind. */
KI_L2_INLINE void put(columns *c, size_t i, const ki_l2_slot *item, size_t at,
                      size_t axes)
{
    for (size_t j = i; i % LANES == 0 && j < i + LANES; j++) {
        c->hi[j] = c->lo[j] = 0.0;
        for (size_t k = 0; k < axes; k++)
            c->x[k][j] = 0.0;
    }
    c->hi[i] = item[0].x;
    c->lo[i] = item[1].x;
    for (size_t k = 0; k < axes; k++)
        c->x[k][i] = item[at + k].x;
}

typedef struct lanes {
    double sum[LANES], rest[LANES];
} lanes;

/* Add the pairs of an item and the first n of the columns, up to a multiple of
 * LANES, where the weights behind them are 0. */
KI_L2_INLINE void meet(ki_l2_core core, lanes *all, const columns *c, size_t n,
                       const ki_l2_slot *item, size_t at, size_t axes)
{
    double sum[LANES] = {0.0}, rest[LANES] = {0.0};
    ki_twice own = weight(item);

    for (size_t i = 0; i < n; i += LANES)
        for (size_t j = 0; j < LANES; j++) {
            ki_twice v = {c->hi[i + j], c->lo[i + j]};
            double r;

            for (size_t k = 0; k < axes; k++)
                v = times_core(core, v, c->x[k][i + j], item[at + k].x);
            sum[j] = ki_two_sum(sum[j], v.hi, &r);
            rest[j] += r + v.lo;
        }
    for (size_t j = 0; j < LANES; j++) {
        ki_twice v = ki_twice_times(ki_twice_sum(sum[j], rest[j]), own);
        double r, total = ki_two_sum(all->sum[j], v.hi, &r);

        all->sum[j] = ki_two_sum(total, all->rest[j] + (r + v.lo), &all->rest[j]);
    }
}

/* Items of side 0 in columns against those of side 1, or all of a block of items
 * against all before. */
KI_L2_INLINE void brute(ki_l2_core core, ki_l2_worker *w, size_t axes, ki_l2_list l)
{
    size_t at = ki_l2_coordinates(w->axes), stride = w->stride;
    lanes all = {{0.0}, {0.0}};
    columns c;

    for (size_t begin = 0, end; begin < l.n; begin = end) {
        size_t n = 0;

        for (end = begin; end < l.n && n < COLUMN; end++) {
            const ki_l2_slot *item = l.item + end * stride;

            if (l.across && item[KI_L2_RANKS].rank[0] != 0) continue;
            if (!l.across && n > 0) meet(core, &all, &c, n, item, at, axes);
            put(&c, n++, item, at, axes);
        }
        for (size_t i = l.across ? 0 : end; n > 0 && i < l.n; i++) {
            const ki_l2_slot *item = l.item + i * stride;

            if (l.across && item[KI_L2_RANKS].rank[0] == 0) continue;
            meet(core, &all, &c, n, item, at, axes);
        }
    }
    for (size_t j = 0; j < LANES; j++)
        ki_twice_total_add(&w->sum, ki_twice_sum(all.sum[j], all.rest[j]));
    w->added += LANES;
    ki_l2_count(w, (double)l.n + (double)(l.n / COLUMN) * (double)l.n,
                l.across ? (double)l.ones * (double)(l.n - l.ones)
                         : 0.5 * (double)l.n * (double)l.n);
}

/* ---- One axis ---------------------------------------------------------------- */

KI_L2_INLINE void pass(ki_l2_core core, ki_l2_worker *w, ki_twice_total *before,
                       const double *x, const ki_twice *v, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        ki_twice f = v[i], g = v[i];

        if (x != NULL) {
            f = times_first(core, v[i], x[i]);
            g = times(core, v[i], true, x[i]);
        }
        ki_twice_total_add(&w->sum,
                           ki_twice_times(g, ki_twice_total_value(before)));
        ki_twice_total_add(before, f);
    }
    w->steps += (double)n;
}

#define CORE(name, core)                                                           \
    KI_L2_FMA_CLONES static ki_l2_halves sweep_##name(ki_l2_worker *w,             \
                                                      ki_l2_list l, uint32_t cut)  \
    {                                                                              \
        if (w->stride == 5) return sweep(core, w, l, cut, 5); /* two axes */       \
        if (w->stride == 7) return sweep(core, w, l, cut, 7); /* three */          \
        return sweep(core, w, l, cut, w->stride);                                  \
    }                                                                              \
    KI_L2_FMA_CLONES static ki_l2_list lift_##name(                                \
        ki_l2_worker *w, ki_l2_slot *to, ki_l2_list l, size_t axis, uint32_t cut,  \
        bool swapped)                                                              \
    {                                                                              \
        return lift(core, w, to, l, axis, cut, swapped);                           \
    }                                                                              \
    KI_L2_FMA_CLONES static void brute_##name(ki_l2_worker *w, size_t axes,        \
                                              ki_l2_list l)                        \
    {                                                                              \
        if (axes == 2)                                                             \
            brute(core, w, 2, l);                                                  \
        else                                                                       \
            brute(core, w, axes, l);                                               \
    }                                                                              \
    KI_L2_FMA_CLONES static void pass_##name(                                      \
        ki_l2_worker *w, ki_twice_total *before, const double *x,                  \
        const ki_twice *v, size_t n)                                               \
    {                                                                              \
        pass(core, w, before, x, v, n);                                            \
    }

CORE(star, KI_L2_CORE_STAR)
CORE(extreme, KI_L2_CORE_EXTREME)
CORE(centered, KI_L2_CORE_CENTERED)
CORE(max, KI_L2_CORE_MAX)

#define ROW(name)                                                                  \
    {                                                                              \
        sweep_##name, lift_##name, brute_##name, pass_##name                       \
    }

const ki_l2_loops ki_l2_loops_of[KI_L2_CORES] = {ROW(star), ROW(extreme),
                                                 ROW(centered), ROW(max)};
