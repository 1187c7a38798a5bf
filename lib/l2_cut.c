#include <string.h>

#include "l2_divide_kernels.h"

/* Divide and conquer over one axis after the other. */

/* Where every pair is cheaper than to divide, about. */
enum { FEW = 32, FEW_AXIS = 24 };

static bool few(size_t axes, ki_l2_list l)
{
    size_t most = axes == 2 ? FEW : FEW_AXIS * axes;

    if (!l.across) return l.n <= most;
    return l.ones * (l.n - l.ones) <= most / 2 * l.n;
}

/* As sweep does, and without a sum. */
static ki_l2_halves partition(const ki_l2_worker *w, ki_l2_list l, size_t axis,
                              uint32_t cut)
{
    ki_l2_slot *to[2] = {l.item, w->spare}, *item = l.item;
    size_t ones[2] = {0, 0}, stride = w->stride;

    for (size_t i = 0; i < l.n; i++, item += stride) {
        bool high = *ki_l2_rank(item, axis) >= cut;

        ones[high] += item[KI_L2_RANKS].rank[0];
        ki_l2_copy(to[high], item, stride);
        to[high] += stride;
    }

    size_t high = (size_t)(to[1] - w->spare) / stride;

    memcpy(to[0], w->spare, high * stride * sizeof *to[0]);
    return (ki_l2_halves){
        {l.item, l.n - high, ones[0], l.begin, cut, l.across},
        {to[0], high, ones[1], cut, l.end, l.across},
    };
}

void ki_l2_apart(ki_l2_worker *w, size_t axes, ki_l2_list l, uint32_t cut)
{
    const ki_l2_loops *loops = &ki_l2_loops_of[w->core];
    ki_l2_slot *kept = w->copies;

    if (axes == 2) {
        loops->sweep(w, l, cut);
        return;
    }
    for (int swapped = 0; swapped <= (int)l.across; swapped++) {
        ki_l2_list s = loops->lift(w, kept, l, axes - 1, cut, swapped != 0);

        w->copies = kept + s.n * w->stride;
        ki_l2_solve(w, axes - 1, s);
    }
    w->copies = kept;
}

void ki_l2_solve(ki_l2_worker *w, size_t axes, ki_l2_list l)
{
    const ki_l2_loops *loops = &ki_l2_loops_of[w->core];
    ki_l2_halves h;
    uint32_t cut = l.begin + (l.end - l.begin) / 2;

    if (l.n < 2 || (l.across && (l.ones == 0 || l.ones == l.n))) return;
    if (few(axes, l)) {
        loops->brute(w, axes, l);
        return;
    }
    if (axes == 2) {
        h = loops->sweep(w, l, cut);
    } else {
        ki_l2_apart(w, axes, l, cut);
        h = partition(w, l, axes - 1, cut);
    }
    ki_l2_solve(w, axes, h.low);
    ki_l2_solve(w, axes, h.high);
}
