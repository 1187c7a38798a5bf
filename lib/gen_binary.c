#include <stdlib.h>

#include "error.h"
#include "gen_kernels.h"
#include "rng_kernels.h"

/* Digital sequences in base 2, 64 binary places wide: coordinate k of point i is
 * the exclusive or of direction numbers v_j of k over the bits j of the Gray code
 * of i [Antonov, Saleev 1979].  Linear scrambling changes the v_j once and for all,
 * a digital shift costs one exclusive or, and nested scrambling is gen_owen.c. */

enum { BITS = KI_BINARY_BITS, RUN = 16 };

typedef struct axis {
    uint64_t v[BITS];
    uint64_t low[RUN]; /* the elements below RUN */
    uint64_t shift;
    ki_owen *owen; /* NULL: not nested */
} axis;

typedef struct binary {
    bool scrambled;
    size_t dim;
    ki_owen *owen;
    axis axis[];
} binary;

static uint64_t element(const uint64_t v[BITS], uint64_t index)
{
    uint64_t bits = 0;

    for (uint64_t gray = index ^ (index >> 1); gray > 0; gray &= gray - 1)
        bits ^= v[__builtin_ctzll(gray)];
    return bits;
}

/* Multiply by a random lower triangular matrix with ones on its diagonal: digit d
 * becomes itself plus some of those before it [Matousek 1998]. */
static void scramble_matrix(uint64_t v[BITS], koksma_rng *r)
{
    uint64_t row[BITS], image[BITS] = {0};

    for (int d = 0; d < BITS; d++) {
        uint64_t one = (uint64_t)1 << (BITS - 1 - d);

        /* The places before d are the bits above `one`. */
        row[d] = (koksma_rng_next(r) & ~(one | (one - 1))) | one;
    }
    for (int j = 0; j < BITS; j++)
        for (int d = 0; d < BITS; d++)
            image[j] |= (uint64_t)__builtin_parityll(row[d] & v[j])
                        << (BITS - 1 - d);
    for (int j = 0; j < BITS; j++)
        v[j] = image[j];
}

static void scramble(binary *b, size_t k, koksma_scramble how, koksma_rng r)
{
    axis *a = &b->axis[k];

    if (how == KOKSMA_SCRAMBLE_MATRIX) scramble_matrix(a->v, &r);
    if (how == KOKSMA_SCRAMBLE_OWEN)
        ki_owen_init(a->owen = &b->owen[k], r);
    else
        a->shift = koksma_rng_next(&r);
}

koksma_status ki_binary_prepare(koksma_gen *g, ki_binary_directions *directions,
                                void *state, koksma_error *err)
{
    koksma_scramble how = g->opts.scramble;
    size_t dim = g->opts.dim;
    binary *b;

    if (ki_check_leap(g->opts.leap, 2, err) != KOKSMA_OK) return KOKSMA_EINVAL;
    b = calloc(1, sizeof *b + dim * sizeof b->axis[0]);
    if (b == NULL) return ki_fail_memory(err, "the direction numbers");
    g->state = b;
    g->net = 2;
    b->dim = dim;
    b->scrambled = how != KOKSMA_SCRAMBLE_NONE && how != KOKSMA_SCRAMBLE_SHIFT;
    if (how == KOKSMA_SCRAMBLE_OWEN &&
        (b->owen = ki_alloc(dim, sizeof *b->owen)) == NULL)
        return ki_fail_memory(err, "the scrambling");
    for (size_t k = 0; k < dim; k++) {
        directions(b->axis[k].v, k, state);
        if (b->scrambled) scramble(b, k, how, ki_gen_stream(g, k));
        for (unsigned i = 0; i < RUN; i++)
            b->axis[k].low[i] = element(b->axis[k].v, i);
    }
    return KOKSMA_OK;
}

void ki_binary_release(void *state)
{
    binary *b = state;

    if (b != NULL) free(b->owen);
    free(b);
}

/* The Gray codes of a multiple of RUN and of a number below it add up to that of
 * their sum, so that a run is one element and a table; and those of i - 1 and i
 * differ in the lowest bit of i. */
KI_GEN_CLONES static void runs(const axis *a, uint64_t *restrict bits,
                               uint64_t first, size_t count)
{
    uint64_t base = element(a->v, first) ^ a->shift;

    for (size_t at = 0;;) {
        for (size_t i = 0; i < RUN; i++)
            bits[at + i] = base ^ a->low[i];
        at += RUN;
        if (at >= count) break;
        base ^= a->low[RUN - 1] ^ a->v[__builtin_ctzll(first + at)];
    }
}

/* bits/2^64, without the bits behind the 53 that a double has. */
static double fraction(uint64_t bits)
{
    int leading = bits != 0 ? __builtin_clzll(bits) : 0;

    if (leading < 11) bits &= UINT64_MAX << (11 - leading);
    return (double)bits * 0x1p-64;
}

static void fill_axis(const binary *b, const axis *a, double *x, uint64_t first,
                      size_t count)
{
    uint64_t room[KI_OWEN_RUN], *bits = room + first % RUN;

    runs(a, room, first - first % RUN, count + (size_t)(first % RUN));
    if (a->owen != NULL) ki_owen_scramble(a->owen, bits, count);
    /* An element below 2^53 has 53 places at most, and a scrambled one is cut off
     * behind them. */
    if (b->scrambled || first + (count - 1) < (uint64_t)1 << 53)
        ki_fractions(x, b->dim, bits, count);
    else
        for (size_t i = 0; i < count; i++)
            x[i * b->dim] = fraction(bits[i]);
}

void ki_binary_fill(const koksma_gen *g, double *x, uint64_t first, size_t count)
{
    const binary *b = g->state;

    while (count > 0) {
        size_t now = KI_OWEN_RUN - (size_t)(first % KI_OWEN_RUN);

        if (now > count) now = count;
        for (size_t k = 0; k < b->dim; k++)
            fill_axis(b, &b->axis[k], x + k, first, now);
        x += now * b->dim;
        first += now;
        count -= now;
    }
}
