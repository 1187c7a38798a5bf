#ifndef KI_TREE_CLIMB_KERNELS_H
#define KI_TREE_CLIMB_KERNELS_H

#include <stddef.h>
#include <stdint.h>

#include "rng.h"
#include "tree_kernels.h"

/* Private: finding good boxes fast.  What is offered to the incumbent is evaluated
 * there, so nothing rests on this search but how soon the rest of it is done. */

/* A box that no longer or shorter side makes better: cut[k] of the points sorted
 * along axis k are inside along it. */
typedef struct ki_summit {
    double excess; /* n times its local discrepancy, in plain doubles */
    uint32_t *cut;
} ki_summit;

enum { KI_ELITE = 8 };

typedef struct ki_climber {
    const ki_ranks *ranks;
    ki_best *best;
    koksma_rng rng;
    double
        *side; /* side[k*n + j]: how far from its low end axis k's j-th point is */
    double
        *width; /* n: the same of the side that is searched, as widths of boxes */
    uint32_t *outs;            /* n: axes along which a point is out */
    uint32_t *cut;             /* axes: the box that the climber is at */
    uint32_t *turn;            /* axes: the axes, in the order of a round */
    double *corner;            /* axes */
    ki_summit elite[KI_ELITE]; /* the best summits, the best first */
    size_t elites, idle;       /* idle: starts since the best of them got better */
    size_t starts;             /* done */
    double work;               /* points looked at */
    void *memory;              /* of all the arrays */
} ki_climber;

/* seed and the kind of box fix all that follows.  Returns KOKSMA_OK or
 * KOKSMA_ENOMEM. */
koksma_status ki_climber_begin(ki_climber *c, const ki_ranks *ranks, ki_best *best,
                               uint64_t seed);
void ki_climber_end(ki_climber *c);

/* Climb from so many more starts. */
void ki_climber_go(ki_climber *c, size_t starts);

/* Climbers for both kinds of boxes take turns, until `patience` starts of each in a
 * row have found nothing better, or told_to_stop, which hears of the points looked
 * at so far, says so.  Returns KOKSMA_OK or KOKSMA_ENOMEM. */
typedef bool ki_climb_stop(void *state, double work);
koksma_status ki_climb(ki_best *best, const ki_ranks ranks[2], uint64_t seed,
                       size_t patience, ki_climb_stop *told_to_stop, void *state);

#endif
