#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "tree_climb_kernels.h"

/* Coordinate ascent from many starts.  With all sides but one fixed, the points
 * inside along the other axes are walked in the order of that one, and the best
 * length of it is found exactly, in n steps.  What no such step makes better is a
 * critical box: an open side ends at a point inside along the other axes or at 1,
 * else it would grow, and a closed one at a point inside, else it would shrink.
 *
 * A box is kept as cuts: the first cut[k] points along axis k are inside along it.
 * An open side ends at the first point behind its cut, or at 1, and a closed one at
 * the last point before it, or at 0.  So a cut never stands between tied points,
 * nor behind points at 1 if the box is open. */

/* FEW: sides that make a start.  TIRED: starts in vain after which the elite is
 * that of a lesser mountain, and forgotten.  BLOCK: points counted at once.
 * Measured on sets of 8 to 50 axes: half or twice as many make little difference.
 */
enum { FEW = 6, TIRED = 200, BLOCK = 16 };

/* The coordinate of the j-th point along axis k. */
static double value_at(const ki_ranks *r, size_t k, size_t j)
{
    return r->axis[k].value[r->rank[k * r->n + r->order[k * r->n + j]]];
}

/* A side that ends there; a lower one measures from 1 down. */
static double length(const ki_ranks *r, size_t k, double value)
{
    return r->axes > r->dim && k < r->dim ? 1.0 - value : value;
}

koksma_status ki_climber_begin(ki_climber *c, const ki_ranks *ranks, ki_best *best,
                               uint64_t seed)
{
    size_t n = ranks->n, axes = ranks->axes, row;
    void *memory = NULL;

    /* A row an axis: sides, a corner, and cuts: its own, the elite's, and a turn.
     */
    if (!__builtin_mul_overflow(n + 1, sizeof(double), &row))
        memory = ki_alloc(axes + 2, row + (KI_ELITE + 2) * sizeof(uint32_t));
    if (memory == NULL) return KOKSMA_ENOMEM;
    *c = (ki_climber){.ranks = ranks, .best = best, .memory = memory};
    c->rng = koksma_rng_seed(seed, ranks->closed);
    c->side = memory;
    c->width = c->side + axes * n;
    c->corner = c->width + n;
    c->cut = (uint32_t *)(c->corner + axes);
    c->turn = c->cut + axes;
    for (size_t e = 0; e < KI_ELITE; e++)
        c->elite[e].cut = c->turn + (e + 1) * axes;
    c->outs = c->turn + (KI_ELITE + 1) * axes;
    for (size_t k = 0; k < axes; k++)
        for (size_t j = 0; j < n; j++)
            c->side[k * n + j] = length(ranks, k, value_at(ranks, k, j));
    for (size_t k = 0; k < axes; k++) {
        c->cut[k] = 0;
        c->turn[k] = (uint32_t)k;
    }
    for (size_t i = 0; i < n; i++)
        c->outs[i] = (uint32_t)axes;
    return KOKSMA_OK;
}

void ki_climber_end(ki_climber *c) { free(c->memory); }

/* How long side k is. */
static double end_of(const ki_climber *c, size_t k)
{
    size_t n = c->ranks->n, cut = c->cut[k];
    const double *side = c->side + k * n;

    if (c->ranks->closed) return cut > 0 ? side[cut - 1] : 0.0;
    return cut < n ? side[cut] : 1.0;
}

/* Where it ends. */
static double corner_of(const ki_climber *c, size_t k)
{
    const ki_ranks *r = c->ranks;
    size_t cut = c->cut[k];

    if (r->closed ? cut > 0 : cut < r->n)
        return value_at(r, k, r->closed ? cut - 1 : cut);
    return length(r, k, r->closed ? 0.0 : 1.0);
}

/* The width of a box between sides that long, seen from opposite faces. */
static double width_of(double lower, double upper)
{
    double w = lower + upper - 1.0;

    return w > 0.0 ? w : 0.0;
}

/* Times the product of the widths, but for that of coordinate `but`, if any. */
static double times_widths(const ki_climber *c, double product, size_t but)
{
    const ki_ranks *r = c->ranks;

    for (size_t k = 0; k < r->dim; k++)
        if (k != but)
            product *= r->measure->anchored
                           ? end_of(c, k)
                           : width_of(end_of(c, k), end_of(c, r->dim + k));
    return product;
}

static void move_cut(ki_climber *c, size_t k, uint32_t cut)
{
    const uint32_t *order = c->ranks->order + k * c->ranks->n;

    c->work += cut < c->cut[k] ? c->cut[k] - cut : cut - c->cut[k];
    for (uint32_t j = c->cut[k]; j < cut; j++)
        c->outs[order[j]]--;
    for (uint32_t j = cut; j < c->cut[k]; j++)
        c->outs[order[j]]++;
    c->cut[k] = cut;
}

/* The cut of a side that reaches to 1. */
static uint32_t full_cut(const ki_climber *c, size_t k)
{
    const double *side = c->side + k * c->ranks->n;
    uint32_t cut = (uint32_t)c->ranks->n;

    while (!c->ranks->closed && cut > 0 && side[cut - 1] == 1.0)
        cut--;
    return cut;
}

/* A walk along axis k, in two parts: the points before the cut count when they are
 * out along no axis, and those behind it when they are out along this one only. */
typedef struct walk {
    const double *side;
    const uint32_t *order, *outs;
    bool closed;
    double volume;  /* n times the product of the other widths */
    double excess;  /* to be exceeded, */
    size_t at;      /* and where the best cut so far is */
    uint32_t count; /* points passed that are inside along the other axes */
} walk;

static uint32_t count_inside(const walk *w, size_t begin, size_t end, uint32_t outs)
{
    uint32_t count = 0;

    for (size_t j = begin; j < end; j++)
        count += w->outs[w->order[j]] == outs;
    return count;
}

/* Of equally good cuts an open box takes the first, and a closed one the last: in a
 * run of ties the others count more points, or fewer, and are never taken. */
static void look_closely(walk *w, size_t begin, size_t end, uint32_t outs)
{
    uint32_t count = w->count;

    for (size_t j = begin; j < end; j++) {
        double volume = w->volume * w->side[j], excess;

        if (w->closed) {
            count += w->outs[w->order[j]] == outs;
            excess = (double)count - volume;
            if (excess < w->excess) continue;
            w->at = j + 1;
        } else {
            excess = volume - (double)count;
            count += w->outs[w->order[j]] == outs;
            if (excess <= w->excess) continue;
            w->at = j;
        }
        w->excess = excess;
    }
}

/* In a block no open box has more volume than at its end nor fewer points than at
 * its beginning, and no closed box the opposite.  Few blocks can hold the best. */
static void walk_along(walk *w, size_t begin, size_t end, uint32_t outs)
{
    for (size_t next; begin < end; begin = next) {
        next = end - begin > BLOCK ? begin + BLOCK : end;

        uint32_t count = w->count + count_inside(w, begin, next, outs);

        if (w->closed
                ? (double)count - w->volume * w->side[begin] >= w->excess
                : w->volume * w->side[next - 1] - (double)w->count > w->excess)
            look_closely(w, begin, next, outs);
        w->count = count;
    }
}

/* The widths of the box for every end of side k; *whole: when it has no end. */
static const double *widths(ki_climber *c, size_t k, double *whole)
{
    const ki_ranks *r = c->ranks;
    const double *side = c->side + k * r->n;
    double across;

    *whole = 1.0;
    if (r->measure->anchored) return side;
    across = end_of(c, k < r->dim ? k + r->dim : k - r->dim);
    for (size_t j = 0; j < r->n; j++)
        c->width[j] = width_of(side[j], across);
    *whole = across;
    return c->width;
}

/* Give side k its best length.  Returns whether that exceeds *excess, n times the
 * deviation of the box, by more than rounding may do; it is then updated. */
static bool line_search(ki_climber *c, size_t k, double *excess)
{
    const ki_ranks *r = c->ranks;
    size_t n = r->n;
    double whole;
    walk w = {.side = widths(c, k, &whole),
              .order = r->order + k * n,
              .outs = c->outs,
              .closed = r->closed,
              .volume = times_widths(c, (double)n, k % r->dim),
              .excess = *excess + c->best->slack * (double)n,
              .at = SIZE_MAX};

    walk_along(&w, 0, c->cut[k], 0);
    walk_along(&w, c->cut[k], n, 1);
    whole *= w.volume;
    if (!r->closed && whole - (double)w.count > w.excess) {
        w.excess = whole - (double)w.count;
        w.at = n;
    }
    c->work += (double)n;
    if (w.at == SIZE_MAX) return false;
    move_cut(c, k, (uint32_t)w.at);
    *excess = w.excess;
    return true;
}

static void shuffle(ki_climber *c)
{
    for (size_t k = c->ranks->axes; k > 1; k--) {
        size_t l = koksma_rng_below(&c->rng, k);
        uint32_t keep = c->turn[k - 1];

        c->turn[k - 1] = c->turn[l];
        c->turn[l] = keep;
    }
}

/* Turn from axis to axis until none makes the box better. */
static void climb(ki_climber *c)
{
    size_t axes = c->ranks->axes;
    double excess = -(double)c->ranks->n; /* below that of any box */

    for (size_t t = 0, idle = 0; idle < axes; t = (t + 1) % axes, idle++)
        if (line_search(c, c->turn[t], &excess)) idle = 0;
}

/* Offer the box, and return n times its deviation: the same for the same box,
 * whichever way led there. */
static double offer(ki_climber *c)
{
    double n = (double)c->ranks->n, excess;
    uint32_t inside = 0;

    for (size_t k = 0; k < c->ranks->axes; k++)
        c->corner[k] = corner_of(c, k);
    for (size_t i = 0; i < c->ranks->n; i++)
        inside += c->outs[i] == 0;
    excess = n * times_widths(c, 1.0, SIZE_MAX) - (double)inside;
    if (c->ranks->closed) excess = -excess;
    if (excess / n > c->best->bar)
        ki_best_offer(c->best, c->corner, inside, c->ranks->closed);
    return excess;
}

/* Put the box among the elite, unless it is there or not good enough. */
static void keep(ki_climber *c, double excess)
{
    size_t bytes = c->ranks->axes * sizeof *c->cut, at = 0;

    while (at < c->elites && c->elite[at].excess >= excess) {
        if (memcmp(c->elite[at].cut, c->cut, bytes) == 0) return;
        at++;
    }
    if (at == KI_ELITE) return;
    if (c->elites < KI_ELITE) c->elites++;
    if (at == 0) c->idle = 0;

    ki_summit last = c->elite[c->elites - 1];

    for (size_t e = c->elites - 1; e > at; e--)
        c->elite[e] = c->elite[e - 1];
    last.excess = excess;
    memcpy(last.cut, c->cut, bytes);
    c->elite[at] = last;
}

/* A random place along axis k: the largest of some random numbers, so that the
 * product of as many sides is about uniform. */
static uint32_t random_cut(ki_climber *c, size_t k, size_t numbers)
{
    const double *side = c->side + k * c->ranks->n;
    size_t low = 0, high = c->ranks->n;
    double largest = 0.0;

    for (; numbers > 0; numbers--) {
        double u = koksma_rng_unit(&c->rng);

        if (u > largest) largest = u;
    }
    while (low < high) {
        size_t middle = low + (high - low) / 2;

        if (side[middle] < largest)
            low = middle + 1;
        else
            high = middle;
    }
    return (uint32_t)low;
}

/* A third of the starts are boxes with a few short sides, for the extremes of
 * structured sets have few; the others differ in a few sides from one of the elite.
 * Those sides take their turn last, else they would go straight back. */
static void choose_start(ki_climber *c)
{
    size_t axes = c->ranks->axes,
           few = 1 + koksma_rng_below(&c->rng, axes < FEW ? axes : FEW);
    bool fresh = c->elites == 0 || c->starts % 3 == 0;
    const uint32_t *from =
        fresh ? NULL : c->elite[koksma_rng_below(&c->rng, c->elites)].cut;

    shuffle(c);
    for (size_t t = 0; t < axes; t++) {
        size_t k = c->turn[t];
        bool is_short = t + few >= axes;

        if (is_short)
            move_cut(c, k, random_cut(c, k, fresh ? few : axes));
        else
            move_cut(c, k, fresh ? full_cut(c, k) : from[k]);
    }
}

void ki_climber_go(ki_climber *c, size_t starts)
{
    for (; starts > 0; starts--, c->starts++) {
        if (c->idle++ == TIRED) c->elites = c->idle = 0;
        choose_start(c);
        climb(c);
        keep(c, offer(c));
    }
}

koksma_status ki_climb(ki_best *best, const ki_ranks ranks[2], uint64_t seed,
                       size_t patience, ki_climb_stop *told_to_stop, void *state)
{
    ki_climber c[2] = {{0}};
    bool ready = ki_climber_begin(&c[0], &ranks[0], best, seed) == KOKSMA_OK &&
                 ki_climber_begin(&c[1], &ranks[1], best, seed) == KOKSMA_OK;

    for (size_t idle = 0; ready && idle < patience; idle++) {
        double before = best->proven;

        ki_climber_go(&c[0], 1);
        ki_climber_go(&c[1], 1);
        if (best->proven > before) idle = 0;
        if (told_to_stop(state, c[0].work + c[1].work)) break;
    }
    ki_climber_end(&c[0]);
    ki_climber_end(&c[1]);
    return ready ? KOKSMA_OK : KOKSMA_ENOMEM;
}
