#include "l2_divide_kernels.h"

/* The two ends of the recursion: one axis left, and few points left. */

enum { RANK = 3 }; /* the most terms of k */

typedef struct side {
    const double *item, *end;
    ki_twice_total before[RANK]; /* sums of w f_s(x) over the items passed */
} side;

/* The weight of an item, times f_r or g_r of coordinate 1 where there is a role. */
KI_L2_INLINE ki_twice weight(koksma_l2_kind kind, const double *item, int role,
                             bool second)
{
    ki_twice w = {item[0], item[1]};
    double x = item[KI_L2_ITEM + 1];

    if (role < 0) return w;
    if (second) return ki_twice_times(w, ki_l2_second(kind, role, x));
    if (kind == KOKSMA_L2_STAR) return w; /* times 1 */
    return ki_twice_times(w, ki_l2_first(kind, role, x));
}

/* Pass the next item of one side: it meets the items of the other that were passed
 * before, which are below it or tied, and a tie may be taken either way. */
KI_L2_INLINE void pass(koksma_l2_kind kind, int rank, ki_twice_total *sum,
                       side *own, const side *other, ki_twice w, size_t stride)
{
    double x = own->item[KI_L2_ITEM];

    for (int s = 0; s < rank; s++) {
        ki_twice g = ki_twice_times(w, ki_l2_second(kind, s, x));
        ki_twice f =
            kind == KOKSMA_L2_STAR ? w : ki_twice_times(w, ki_l2_first(kind, s, x));

        ki_twice_total_add(
            sum, ki_twice_times(g, ki_twice_total_value(&other->before[s])));
        ki_twice_total_add(&own->before[s], f);
    }
    own->item += stride;
}

KI_L2_INLINE void merge(koksma_l2_kind kind, int rank, ki_l2_worker *w,
                        ki_l2_list a, ki_l2_list b, int role)
{
    size_t stride = w->stride;
    side p = {.item = a.item, .end = a.item + a.n * stride};
    side q = {.item = b.item, .end = b.item + b.n * stride};
    ki_twice_total sum = {0.0, 0.0, 0};

    while (p.item != p.end && q.item != q.end) {
        if (p.item[KI_L2_ITEM] < q.item[KI_L2_ITEM])
            pass(kind, rank, &sum, &p, &q, weight(kind, p.item, role, false),
                 stride);
        else
            pass(kind, rank, &sum, &q, &p, weight(kind, q.item, role, true),
                 stride);
    }
    while (p.item != p.end)
        pass(kind, rank, &sum, &p, &q, weight(kind, p.item, role, false), stride);
    while (q.item != q.end)
        pass(kind, rank, &sum, &q, &p, weight(kind, q.item, role, true), stride);
    ki_twice_total_add(&w->sum, ki_twice_total_value(&sum));
}

/* k of one coordinate. */
KI_L2_INLINE ki_twice factor(koksma_l2_kind kind, int rank, double x, double y)
{
    double low = x < y ? x : y, high = x < y ? y : x;
    ki_twice k;

    if (kind == KOKSMA_L2_STAR) return ki_l2_second(kind, 0, high);
    if (kind == KOKSMA_L2_PERIODIC || kind == KOKSMA_L2_WRAPAROUND) {
        ki_twice s = ki_twice_sum(high, -low);

        k = ki_twice_add(ki_l2_small(-1.0), s);
        k = ki_twice_times(k, s); /* s^2 - s */
        return ki_twice_add(ki_l2_small(kind == KOKSMA_L2_PERIODIC ? 0.5 : 1.5), k);
    }
    k = ki_twice_times(ki_l2_first(kind, 0, low), ki_l2_second(kind, 0, high));
    for (int r = 1; r < rank; r++)
        k = ki_twice_add(k, ki_twice_times(ki_l2_first(kind, r, low),
                                           ki_l2_second(kind, r, high)));
    return k;
}

KI_L2_INLINE void brute(koksma_l2_kind kind, int rank, ki_l2_worker *w, size_t axes,
                        ki_l2_list a, ki_l2_list b)
{
    ki_twice_total sum = {0.0, 0.0, 0};

    for (size_t i = 0; i < a.n; i++)
        for (size_t j = 0; j < b.n; j++) {
            const double *x = a.item + i * w->stride, *y = b.item + j * w->stride;
            ki_twice v =
                ki_twice_times((ki_twice){x[0], x[1]}, (ki_twice){y[0], y[1]});

            for (size_t k = 0; k < axes; k++)
                v = ki_twice_times(
                    v, factor(kind, rank, x[KI_L2_ITEM + k], y[KI_L2_ITEM + k]));
            ki_twice_total_add(&sum, v);
        }
    ki_twice_total_add(&w->sum, ki_twice_total_value(&sum));
}

typedef void merge_work(ki_l2_worker *w, ki_l2_list a, ki_l2_list b, int role);
typedef void brute_work(ki_l2_worker *w, size_t axes, ki_l2_list a, ki_l2_list b);

#define KIND(name, kind, rank)                                                     \
    KI_L2_FMA_CLONES static void merge_##name(ki_l2_worker *w, ki_l2_list a,       \
                                              ki_l2_list b, int role)              \
    {                                                                              \
        merge(kind, rank, w, a, b, role);                                          \
    }                                                                              \
    KI_L2_FMA_CLONES static void brute_##name(ki_l2_worker *w, size_t axes,        \
                                              ki_l2_list a, ki_l2_list b)          \
    {                                                                              \
        brute(kind, rank, w, axes, a, b);                                          \
    }

KIND(star, KOKSMA_L2_STAR, 1)
KIND(extreme, KOKSMA_L2_EXTREME, 1)
KIND(periodic, KOKSMA_L2_PERIODIC, 3)
KIND(centered, KOKSMA_L2_CENTERED, 1)
KIND(wraparound, KOKSMA_L2_WRAPAROUND, 3)
KIND(mixture, KOKSMA_L2_MIXTURE, 3)
KIND(symmetric, KOKSMA_L2_SYMMETRIC, 2)

static merge_work *const merges[KOKSMA_L2_KINDS] = {
    merge_star,       merge_extreme, merge_periodic, merge_centered,
    merge_wraparound, merge_mixture, merge_symmetric};
static brute_work *const brutes[KOKSMA_L2_KINDS] = {
    brute_star,       brute_extreme, brute_periodic, brute_centered,
    brute_wraparound, brute_mixture, brute_symmetric};

void ki_l2_merge(ki_l2_worker *w, ki_l2_list a, ki_l2_list b, int role)
{
    w->steps += 2.0 * (double)(a.n + b.n) * ki_l2_rows[w->kind].rank + 1.0;
    merges[w->kind](w, a, b, role);
}

void ki_l2_brute(ki_l2_worker *w, size_t axes, ki_l2_list a, ki_l2_list b)
{
    w->steps += (double)a.n * (double)b.n + 1.0;
    brutes[w->kind](w, axes, a, b);
}
