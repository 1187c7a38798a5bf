#ifndef KI_L2_DIVIDE_KERNELS_H
#define KI_L2_DIVIDE_KERNELS_H

#include <string.h>

#include "l2_kernels.h"

/* Private: lists of points for divide and conquer, and the loops over them. */

typedef struct ki_l2_key {
    uint64_t bits; /* of a number >= 0 */
    uint64_t point;
} ki_l2_key;

/* Sort by bits, stably; spare has room for n.  Returns where the result is. */
ki_l2_key *ki_l2_sort(ki_l2_key *key, ki_l2_key *spare, size_t n);

/* ---- What a kernel of one coordinate is cut into ----------------------------- */

/* k(x,y) = sum over r of sign_r f_r(x) f_r(y)  +  times * core(x,y), of which only
 * the core, for x <= y a product first(x) second(y), minds the order:
 *
 *     core        first(x)              second(y)
 *     STAR        1                     1-y
 *     EXTREME     x                     1-y
 *     CENTERED    1 + max(x-1/2,0)      1 + max(1/2-y,0)
 *     MAX         1                     y
 */
typedef enum ki_l2_core {
    KI_L2_CORE_STAR,
    KI_L2_CORE_EXTREME,
    KI_L2_CORE_CENTERED,
    KI_L2_CORE_MAX,
    KI_L2_CORES
} ki_l2_core;

/* As l2_terms.c has it, without the factors 2^twos of the kind. */
typedef struct ki_l2_terms {
    ki_l2_core core;
    double times;
    int count;
    double sign[3], most[3]; /* |f_r| <= most_r */
} ki_l2_terms;
extern const ki_l2_terms ki_l2_terms_of[KOKSMA_L2_KINDS];

/* A term of the product over the coordinates: of coordinate k either term[k], or
 * the core where that is negative. */
typedef struct ki_l2_call {
    koksma_l2_kind kind;
    size_t dim;
    signed char term[KOKSMA_L2_DIVIDE_DIM];
    double times; /* the product of the signs and times */
    double most;  /* and |times| that of the greatest |f_r f_r| and cores */
} ki_l2_call;

/* The weights of count points: the product of their f. */
void ki_l2_weigh(const ki_l2_call *call, const double *x, const uint32_t *point,
                 size_t count, ki_twice *weight);

/* sum_i K(x_i,x_i). */
ki_twice ki_l2_own(koksma_l2_kind kind, koksma_points p);

/* ---- Lists ------------------------------------------------------------------ */

/* An item is its weight in two slots, then its side and its ranks along axes 1,
 * 2, ..., two in a slot, then its coordinates along axes 0, 1, ....  All ranks
 * along an axis are different. */
typedef union ki_l2_slot {
    double x;
    uint32_t rank[2];
} ki_l2_slot;

enum { KI_L2_RANKS = 2 };

/* Sorted by coordinate 0.  The pairs are all of them, or across: those of an item
 * of side 0 and one of side 1. */
typedef struct ki_l2_list {
    ki_l2_slot *item;
    size_t n, ones;      /* items, and those of side 1 */
    uint32_t begin, end; /* of the ranks along the last axis */
    bool across;
} ki_l2_list;

/* The points of all lists, by l2_items.c. */
typedef struct ki_l2_items {
    koksma_points p;
    size_t levels; /* of cuts with a task each; below, a task a part */
    ki_l2_key *key;
    uint32_t **by;    /* by[k][j]: the point of rank j along axis k */
    uint32_t **rank;  /* and its inverse, of axes from 1 on */
    uint32_t *last;   /* the items' ranks along the last axis */
    uint32_t **order; /* items by level: in parts, each by coordinate 0 */
    ki_l2_slot *item; /* the points, by their first coordinate with a core */
    size_t axes, axis[KOKSMA_L2_DIVIDE_DIM]; /* those with a core */
    size_t stride;                           /* slots of an item */
} ki_l2_items;

/* Returns false without memory; free it then too. */
bool ki_l2_items_make(ki_l2_items *s, koksma_points p, size_t levels);
void ki_l2_items_free(ki_l2_items *s);

void ki_l2_items_rank(ki_l2_items *s);    /* along each axis: once */
void ki_l2_items_arrange(ki_l2_items *s); /* for these axes, two or more */
void ki_l2_items_weigh(ki_l2_items *s, const ki_l2_call *call);

/* Part j of a level with so many parts begins at this rank along the last axis. */
size_t ki_l2_part_begin(size_t n, size_t parts, size_t j);

/* The list of part j of a level, copied to `to`. */
ki_l2_list ki_l2_items_gather(const ki_l2_items *s, ki_l2_slot *to, size_t level,
                              size_t j);

typedef struct ki_l2_worker {
    ki_l2_core core;
    size_t axes, stride; /* of the whole list; slots of an item */
    ki_l2_slot *spare;   /* room for as many items as the longest list has */
    ki_l2_slot *copies;  /* and for axes - 1 times as many */
    ki_twice_total sum;  /* of w_a w_b core(a_0,b_0) ... over the pairs (a,b) */
    double added;        /* numbers added to it */
    double loss;         /* see l2_divide.c */
    double steps;        /* items looked at */
} ki_l2_worker;

/* Add the list's pairs along axes 0, ..., axes - 1 to w->sum.  Its items are in
 * another order when it returns. */
void ki_l2_solve(ki_l2_worker *w, size_t axes, ki_l2_list l);

/* Of those, the pairs on either side of a rank along the last axis. */
void ki_l2_apart(ki_l2_worker *w, size_t axes, ki_l2_list l, uint32_t cut);

/* ---- Loops, of which l2_sweep.c has one for each core ------------------------ */

typedef struct ki_l2_halves {
    ki_l2_list low, high;
} ki_l2_halves;

typedef struct ki_l2_loops {
    /* Bring the items with a rank below cut along axis 1 to the front, both parts
     * in their order, and add the pairs on either side of it: two axes. */
    ki_l2_halves (*sweep)(ki_l2_worker *w, ki_l2_list l, uint32_t cut);
    /* Copy the items to `to` that belong to pairs on either side of a rank along
     * axis: those of low side 0 and high side 1, or with swapped the others.  The
     * weights take the core's factor of that axis in, sides become low and high. */
    ki_l2_list (*lift)(ki_l2_worker *w, ki_l2_slot *to, ki_l2_list l, size_t axis,
                       uint32_t cut, bool swapped);
    /* Few items: every pair. */
    void (*brute)(ki_l2_worker *w, size_t axes, ki_l2_list l);
    /* One axis, with none where x is NULL, and all pairs: x rises. */
    void (*pass)(ki_l2_worker *w, ki_twice_total *before, const double *x,
                 const ki_twice *weight, size_t n);
} ki_l2_loops;
extern const ki_l2_loops ki_l2_loops_of[KI_L2_CORES];

/* So many items with so many pairs at most were added up in one loop. */
KI_L2_INLINE void ki_l2_count(ki_l2_worker *w, double items, double pairs)
{
    w->added += 1.0;
    w->steps += items;
    w->loss += (72.0 * items + 128.0) * pairs;
}

/* Where the rank along an axis and a coordinate stand. */
KI_L2_INLINE uint32_t *ki_l2_rank(ki_l2_slot *item, size_t axis)
{
    return &item[KI_L2_RANKS + axis / 2].rank[axis % 2];
}

KI_L2_INLINE size_t ki_l2_coordinates(size_t axes)
{
    return KI_L2_RANKS + (axes + 1) / 2;
}

/* A loop is faster than a call for so few, and moves of a known number than both.
 */
KI_L2_INLINE void ki_l2_copy(ki_l2_slot *to, const ki_l2_slot *from, size_t count)
{
    if (__builtin_constant_p(count)) {
        memmove(to, from, count * sizeof *to);
        return;
    }
    for (size_t i = 0; i < count; i++)
        to[i] = from[i];
}

#endif
