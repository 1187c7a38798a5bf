#include <string.h>

#include "l2_divide_kernels.h"

/* Divide and conquer over one axis after the other. */

/* Where every pair is cheaper than to divide, about. */
static const size_t brute[] = {0, 12, 12, 24}; /* by rank */

static ki_twice weight(const double *item) { return (ki_twice){item[0], item[1]}; }

static double *item_at(const ki_l2_worker *w, ki_l2_list l, size_t i)
{
    return l.item + i * w->stride;
}

/* Where the rank along an axis stands. */
static size_t rank_of(const ki_l2_worker *w, size_t axis)
{
    return KI_L2_ITEM + w->dim + axis - 1;
}

/* Bring the items with a rank below `rank` to the front; both parts keep their
 * order.  Returns how many they are. */
static size_t partition(ki_l2_worker *w, ki_l2_list l, size_t axis, double rank)
{
    size_t at = rank_of(w, axis);
    double *front = l.item, *back = w->spare;

    for (size_t i = 0; i < l.n; i++) {
        const double *item = item_at(w, l, i);

        if (item[at] < rank) {
            if (front != item) ki_l2_copy(front, item, w->stride);
            front += w->stride;
        } else {
            ki_l2_copy(back, item, w->stride);
            back += w->stride;
        }
    }
    memcpy(front, w->spare, (size_t)(back - w->spare) * sizeof *back);
    return (size_t)(front - l.item) / w->stride;
}

/* The lists with a part each below and above. */
typedef struct halves {
    ki_l2_list low, high;
} halves;

static halves split(ki_l2_worker *w, ki_l2_list l, size_t axis, double rank)
{
    size_t n = partition(w, l, axis, rank);

    return (halves){{l.item, n}, {item_at(w, l, n), l.n - n}};
}

/* A copy of the list at `to`, weights times f_r or g_r of a coordinate. */
static ki_l2_list copy(const ki_l2_worker *w, double *to, ki_l2_list l, size_t axis,
                       int r, bool second)
{
    memcpy(to, l.item, l.n * w->stride * sizeof *to);
    for (size_t i = 0; i < l.n; i++) {
        double *item = to + i * w->stride, x = item[KI_L2_ITEM + axis];
        ki_twice f =
            second ? ki_l2_second(w->kind, r, x) : ki_l2_first(w->kind, r, x);

        f = ki_twice_times(weight(item), f);
        item[0] = f.hi;
        item[1] = f.lo;
    }
    return (ki_l2_list){to, l.n};
}

/* Every a in low is below every b in high along `axis`: of that factor of K only
 * products remain, f_r(a) g_r(b), and the weights take them in. */
static void cross_apart(ki_l2_worker *w, size_t axis, ki_l2_list low,
                        ki_l2_list high)
{
    double *kept = w->copies;

    if (low.n == 0 || high.n == 0) return;
    for (int r = 0; r < ki_l2_rows[w->kind].rank; r++) {
        if (axis == 1) {
            ki_l2_merge(w, low, high, r);
            continue;
        }

        ki_l2_list a = copy(w, kept, low, axis, r, false);
        ki_l2_list b = copy(w, kept + low.n * w->stride, high, axis, r, true);

        w->copies = kept + (low.n + high.n) * w->stride;
        ki_l2_cross(w, axis, a, b);
    }
    w->copies = kept;
}

/* The mean of the least and the greatest rank in two lists, rounded up: both halves
 * have items, and a range of ranks is halved, so that 31 times are enough. */
static double middle_rank(const ki_l2_worker *w, size_t axis, ki_l2_list a,
                          ki_l2_list b)
{
    double least = HUGE_VAL, most = -HUGE_VAL;
    size_t at = rank_of(w, axis);

    for (size_t i = 0; i < a.n + b.n; i++) {
        double rank = i < a.n ? item_at(w, a, i)[at] : item_at(w, b, i - a.n)[at];

        if (rank < least) least = rank;
        if (rank > most) most = rank;
    }
    return floor((least + most) / 2.0) + 1.0;
}

void ki_l2_cross(ki_l2_worker *w, size_t axes, ki_l2_list a, ki_l2_list b)
{
    size_t axis = axes - 1;

    if (a.n == 0 || b.n == 0) return;
    if (axes == 1) {
        ki_l2_merge(w, a, b, -1);
        return;
    }
    if (a.n * b.n <= brute[ki_l2_rows[w->kind].rank] * (a.n + b.n)) {
        ki_l2_brute(w, axes, a, b);
        return;
    }

    double rank = middle_rank(w, axis, a, b);
    halves p = split(w, a, axis, rank), q = split(w, b, axis, rank);

    cross_apart(w, axis, p.low, q.high);
    cross_apart(w, axis, q.low, p.high);
    ki_l2_cross(w, axes, p.low, q.low);
    ki_l2_cross(w, axes, p.high, q.high);
}

void ki_l2_apart(ki_l2_worker *w, ki_l2_list a, double rank)
{
    halves p = split(w, a, w->dim - 1, rank);

    cross_apart(w, w->dim - 1, p.low, p.high);
}

/* One axis alone: an item meets those before it. */
static void within_one(ki_l2_worker *w, ki_l2_list a)
{
    for (int r = 0; r < ki_l2_rows[w->kind].rank; r++) {
        ki_twice_total before = {0.0, 0.0, 0};

        for (size_t i = 0; i < a.n; i++) {
            double x = item_at(w, a, i)[KI_L2_ITEM];

            ki_twice_total_add(&w->sum,
                               ki_twice_times(ki_l2_second(w->kind, r, x),
                                              ki_twice_total_value(&before)));
            ki_twice_total_add(&before, ki_l2_first(w->kind, r, x));
        }
        w->steps += 2.0 * (double)a.n;
    }
}

void ki_l2_within(ki_l2_worker *w, ki_l2_list a)
{
    size_t axis = w->dim - 1;

    if (a.n < 2) return;
    if (axis == 0) {
        within_one(w, a);
        return;
    }
    if (a.n <= 2 * brute[ki_l2_rows[w->kind].rank]) {
        for (size_t i = 1; i < a.n; i++)
            ki_l2_brute(w, w->dim, (ki_l2_list){a.item, i},
                        (ki_l2_list){item_at(w, a, i), 1});
        return;
    }

    halves p = split(w, a, axis, middle_rank(w, axis, a, (ki_l2_list){a.item, 0}));

    cross_apart(w, axis, p.low, p.high);
    ki_l2_within(w, p.low);
    ki_l2_within(w, p.high);
}
