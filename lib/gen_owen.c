#include "gen_kernels.h"
#include "rng_kernels.h"

/* Nested scrambling in base 2 [Owen 1995]: whether a binary place is flipped
 * depends on all the places before it.  Nothing of the tree of flips is kept but
 * its top: a node's flip is drawn from a hash of the places that lead to it, so
 * that any point is scrambled by itself.
 *
 * A node is given by its depth d and the number that has the first d places of
 * those below it and zeros behind them, its owner; its flip is the bit of depth d
 * of the owner's 64 random bits.  Nodes on one way have the same owner until the
 * way passes a one, so that a number costs a hash a one.  No two nodes share a bit.
 */

enum { LANES = 16 };

static const uint64_t REST = UINT64_MAX >> KI_OWEN_DEPTH;

static inline uint64_t first_one(uint64_t rest)
{
    return (uint64_t)1 << (63 - __builtin_clzll(rest));
}

static uint64_t flips(koksma_rng r, uint64_t flipped, uint64_t owner, uint64_t rest)
{
    while (rest > 0) {
        uint64_t one = first_one(rest);

        rest ^= one;
        owner |= one;
        flipped ^= (flipped ^ ki_rng_at(r, owner)) & (one - 1);
    }
    return flipped;
}

void ki_owen_init(ki_owen *o, koksma_rng r)
{
    uint64_t root = ki_rng_at(r, 0);

    o->r = r;
    for (uint64_t top = 0; top < (uint64_t)1 << KI_OWEN_DEPTH; top++)
        o->top[top] = flips(r, root, 0, top << (64 - KI_OWEN_DEPTH));
}

KI_GEN_INLINE void flip_lanes(koksma_rng r, uint64_t *flipped, uint64_t *owner,
                              uint64_t one)
{
    for (size_t i = 0; i < LANES; i++) {
        owner[i] |= one;
        flipped[i] ^= (flipped[i] ^ ki_rng_at(r, owner[i])) & (one - 1);
    }
}

/* Numbers whose places agree but for the first KI_OWEN_DEPTH pass their ones
 * together. */
KI_GEN_CLONES static void scramble_alike(const ki_owen *o, uint64_t *y,
                                         size_t count)
{
    uint64_t owner[KI_OWEN_RUN] = {0}, flipped[KI_OWEN_RUN];

    for (size_t i = 0; i < count; i++) {
        owner[i] = y[i] & ~REST;
        flipped[i] = o->top[y[i] >> (64 - KI_OWEN_DEPTH)];
    }
    for (size_t i = count; i % LANES > 0; i++)
        flipped[i] = 0;
    for (uint64_t rest = y[0] & REST; rest > 0; rest ^= first_one(rest))
        for (size_t i = 0; i < count; i += LANES)
            flip_lanes(o->r, flipped + i, owner + i, first_one(rest));
    for (size_t i = 0; i < count; i++)
        y[i] ^= flipped[i];
}

void ki_owen_scramble(const ki_owen *o, uint64_t *y, size_t count)
{
    uint64_t differ = 0;

    for (size_t i = 1; i < count; i++)
        differ |= y[i] ^ y[0];
    if ((differ & REST) == 0) {
        scramble_alike(o, y, count);
        return;
    }
    for (size_t i = 0; i < count; i++)
        y[i] ^= flips(o->r, o->top[y[i] >> (64 - KI_OWEN_DEPTH)], y[i] & ~REST,
                      y[i] & REST);
}
