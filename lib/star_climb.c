#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "star_climb_kernels.h"

/* Coordinate ascent from many starts.  With all sides but one fixed, the points
 * inside along the other axes are walked in the order of that one, and the best
 * length of it is found exactly, in n steps.
 *
 * A box is kept as cuts: the first cut[k] points along axis k are inside along it.
 * An open side ends at the first point behind its cut, or at 1, and a closed one at
 * the last point before it.  Between two tied points there is no such cut.  A walk
 * that takes the first of equally good places for open boxes, and the last for
 * closed ones, never stops there: in a run of ties the others count more points in
 * an open box, or fewer in a closed one. */

koksma_status ki_climber_begin(ki_climber *c, const ki_ranks *ranks, ki_best *best,
                               uint64_t seed)
{
    size_t n = ranks->n, dim = ranks->dim, row;
    void *memory = NULL;

    /* A row an axis: sides, a corner, and cuts: its own, the elite's, and a turn.
     */
    if (!__builtin_mul_overflow(n + 1, sizeof(double), &row))
        memory = ki_alloc(dim + 1, row + (KI_ELITE + 2) * sizeof(uint32_t));
    if (memory == NULL) return KOKSMA_ENOMEM;
    *c = (ki_climber){.ranks = ranks, .best = best, .memory = memory};
    c->rng = koksma_rng_seed(seed, ranks->closed);
    c->side = memory;
    c->corner = c->side + dim * n;
    c->cut = (uint32_t *)(c->corner + dim);
    c->turn = c->cut + dim;
    for (size_t e = 0; e < KI_ELITE; e++)
        c->elite[e].cut = c->turn + (e + 1) * dim;
    c->outs = c->turn + (KI_ELITE + 1) * dim;
    for (size_t k = 0; k < dim; k++)
        for (size_t j = 0; j < n; j++)
            c->side[k * n + j] =
                ranks->axis[k].value[ranks->rank[k * n + ranks->order[k * n + j]]];
    for (size_t k = 0; k < dim; k++) {
        c->cut[k] = 0;
        c->turn[k] = (uint32_t)k;
    }
    for (size_t i = 0; i < n; i++)
        c->outs[i] = (uint32_t)dim;
    return KOKSMA_OK;
}

void ki_climber_end(ki_climber *c) { free(c->memory); }

/* Where side k ends. */
static double end_of(const ki_climber *c, size_t k)
{
    size_t n = c->ranks->n, cut = c->cut[k];
    const double *side = c->side + k * n;

    if (c->ranks->closed) return cut > 0 ? side[cut - 1] : 0.0;
    return cut < n ? side[cut] : 1.0;
}

static void move_cut(ki_climber *c, size_t k, uint32_t cut)
{
    const uint32_t *order = c->ranks->order + k * c->ranks->n;

    for (uint32_t j = c->cut[k]; j < cut; j++)
        c->outs[order[j]]--;
    for (uint32_t j = cut; j < c->cut[k]; j++)
        c->outs[order[j]]++;
    c->work += fabs((double)cut - (double)c->cut[k]);
    c->cut[k] = cut;
}

/* Move a cut off the middle of a run of ties. */
static uint32_t off_ties(const ki_climber *c, size_t k, uint32_t cut)
{
    const double *side = c->side + k * c->ranks->n;
    uint32_t n = (uint32_t)c->ranks->n;

    if (c->ranks->closed) {
        if (cut == 0) cut = 1;
        while (cut < n && side[cut] == side[cut - 1])
            cut++;
        return cut;
    }
    if (cut == n && side[n - 1] == 1.0) cut--;
    while (cut > 0 && cut < n && side[cut] == side[cut - 1])
        cut--;
    return cut;
}

/* The walk along axis k, in two parts: the points before the cut count when they
 * are out along no axis, and those behind it when they are out along this one
 * only. */
typedef struct walk {
    const double *side;
    const uint32_t *order, *outs;
    double volume; /* n times the product of the other sides */
    double excess; /* the best so far, and where */
    size_t at;
    size_t count; /* points passed that are inside along the other axes */
} walk;

static void walk_open(walk *w, size_t begin, size_t end, uint32_t in)
{
    walk v = *w;

    for (size_t j = begin; j < end; j++) {
        double excess = v.volume * v.side[j] - (double)(int64_t)v.count;

        v.count += v.outs[v.order[j]] == in;
        if (excess > v.excess) {
            v.excess = excess;
            v.at = j;
        }
    }
    *w = v;
}

static void walk_closed(walk *w, size_t begin, size_t end, uint32_t in)
{
    walk v = *w;

    for (size_t j = begin; j < end; j++) {
        v.count += v.outs[v.order[j]] == in;

        double excess = (double)(int64_t)v.count - v.volume * v.side[j];

        if (excess >= v.excess) {
            v.excess = excess;
            v.at = j + 1;
        }
    }
    *w = v;
}

/* Give side k its best length; returns n times the deviation. */
static double line_search(ki_climber *c, size_t k)
{
    const ki_ranks *r = c->ranks;
    size_t n = r->n;
    walk w = {c->side + k * n, r->order + k * n, c->outs, (double)n,
              -HUGE_VAL,       c->cut[k],        0};

    for (size_t l = 0; l < r->dim; l++)
        if (l != k) w.volume *= end_of(c, l);
    if (r->closed) {
        walk_closed(&w, 0, c->cut[k], 0);
        walk_closed(&w, c->cut[k], n, 1);
    } else {
        walk_open(&w, 0, c->cut[k], 0);
        walk_open(&w, c->cut[k], n, 1);
        if (w.volume - (double)w.count > w.excess) {
            w.excess = w.volume - (double)w.count;
            w.at = n;
        }
    }
    c->work += (double)n;
    move_cut(c, k, (uint32_t)w.at);
    return w.excess;
}

static void shuffle(ki_climber *c)
{
    for (size_t k = c->ranks->dim; k > 1; k--) {
        size_t l = koksma_rng_below(&c->rng, k);
        uint32_t keep = c->turn[k - 1];

        c->turn[k - 1] = c->turn[l];
        c->turn[l] = keep;
    }
}

/* Turn from axis to axis until none makes the box better. */
static double climb(ki_climber *c)
{
    size_t dim = c->ranks->dim, idle = 0;
    double excess = -HUGE_VAL;

    shuffle(c);
    for (size_t t = 0; idle < dim; t = (t + 1) % dim) {
        double better = line_search(c, c->turn[t]);

        /* More than what rounding can do, so that it ends. */
        idle = better > excess + 1e-12 * (double)c->ranks->n ? 1 : idle + 1;
        excess = better;
    }
    return excess;
}

static void offer(ki_climber *c)
{
    size_t inside = 0;

    for (size_t k = 0; k < c->ranks->dim; k++)
        c->corner[k] = end_of(c, k);
    for (size_t i = 0; i < c->ranks->n; i++)
        inside += c->outs[i] == 0;
    ki_best_offer(c->best, c->corner, inside, c->ranks->closed);
}

/* Put the box among the elite, unless it is there or not good enough. */
static void keep(ki_climber *c, double excess)
{
    size_t bytes = c->ranks->dim * sizeof *c->cut, at = 0;

    while (at < c->elites && c->elite[at].excess >= excess) {
        if (memcmp(c->elite[at].cut, c->cut, bytes) == 0) return;
        at++;
    }
    if (at == KI_ELITE) return;
    if (c->elites < KI_ELITE) c->elites++;

    ki_summit last = c->elite[c->elites - 1];

    for (size_t e = c->elites - 1; e > at; e--)
        c->elite[e] = c->elite[e - 1];
    last.excess = excess;
    memcpy(last.cut, c->cut, bytes);
    c->elite[at] = last;
}

/* A random place along axis k, such that volumes are about uniform. */
static uint32_t random_cut(ki_climber *c, size_t k)
{
    double u = pow(koksma_rng_unit(&c->rng), 1.0 / (double)c->ranks->dim);
    const double *side = c->side + k * c->ranks->n;
    size_t low = 0, high = c->ranks->n;

    while (low < high) {
        size_t middle = low + (high - low) / 2;

        if (side[middle] < u)
            low = middle + 1;
        else
            high = middle;
    }
    return off_ties(c, k, (uint32_t)low);
}

/* A third of the starts are anywhere, the others near one of the elite. */
static void choose_start(ki_climber *c)
{
    size_t dim = c->ranks->dim;

    if (c->elites == 0 || c->starts % 3 == 0) {
        for (size_t k = 0; k < dim; k++)
            move_cut(c, k, random_cut(c, k));
        return;
    }

    const ki_summit *from = &c->elite[koksma_rng_below(&c->rng, c->elites)];

    for (size_t k = 0; k < dim; k++)
        move_cut(c, k, from->cut[k]);
    for (size_t moves = 1 + koksma_rng_below(&c->rng, 3); moves > 0; moves--) {
        size_t k = koksma_rng_below(&c->rng, dim);

        move_cut(c, k, random_cut(c, k));
    }
}

void ki_climber_go(ki_climber *c, size_t starts)
{
    for (; starts > 0; starts--, c->starts++) {
        double excess;

        choose_start(c);
        excess = climb(c);
        keep(c, excess);
        if (excess / (double)c->ranks->n > c->best->bar) offer(c);
    }
}

koksma_status ki_climb(ki_best *best, const ki_ranks *ranks, size_t starts,
                       uint64_t seed, double *work)
{
    ki_climber c;

    if (ki_climber_begin(&c, ranks, best, seed) != KOKSMA_OK) return KOKSMA_ENOMEM;
    ki_climber_go(&c, starts);
    *work += c.work;
    ki_climber_end(&c);
    return KOKSMA_OK;
}
