/* The indicator of a random hierarchical fractal: cells of a 5^dim grid are in, out
 * or divided again, and how many are what is the same in every one. */
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "integrand_kernels.h"
#include "num_wide.h"
#include "rng.h"

enum { M, PATTERN };

/* 5^26 is the last power of 5 below 2^61. */
enum { LEVELS = 26, BITS = 61 };

static const uint64_t UNIT = (uint64_t)1 << BITS;

/* 5^dim, dim 2 or 3. */
static size_t subcells(size_t dim) { return dim == 2 ? 25 : 125; }

/* The share of the set in any cell: in + m A of the subcells' A's. */
static double share(const koksma_integrand *f)
{
    size_t others = subcells(f->dim) - (size_t)f->param[M];

    return (double)(others / 2) / (double)others;
}

/* The number, from 0, of the subcell that x is in; x becomes the place inside it.
 * Multiples of 2^-61 are split exactly. */
static size_t enter(uint64_t *x, size_t dim)
{
    size_t cell = 0;

    for (size_t k = 0; k < dim; k++) {
        cell = 5 * cell + (size_t)(5 * x[k] >> BITS);
        x[k] = 5 * x[k] & (UNIT - 1);
    }
    return cell;
}

/* How many subcells drew less than this one: a random permutation. */
static size_t rank_of(koksma_rng parent, size_t cells, uint64_t drawn)
{
    size_t rank = 0;

    for (size_t i = 0; i < cells; i++)
        rank += koksma_rng_next(&parent) < drawn;
    return rank;
}

/* What a subcell draws is its rank and the seed of its own subcells.  Below the
 * last level a coin decides that lands as the share says, so that not even what
 * cannot be resolved is biased. */
static double value(const koksma_integrand *f, const double *x)
{
    size_t cells = subcells(f->dim), divided = (size_t)f->param[M];
    koksma_rng rng = koksma_rng_seed((uint64_t)f->param[PATTERN], 0);
    uint64_t place[3];

    for (size_t k = 0; k < f->dim; k++)
        place[k] = x[k] < 1.0 ? (uint64_t)(x[k] * 0x1p61) : UNIT - 1;
    for (int level = 0; level < LEVELS; level++) {
        koksma_rng own = rng;
        uint64_t drawn;
        size_t rank;

        koksma_rng_skip(&own, enter(place, f->dim));
        drawn = koksma_rng_next(&own);
        rank = rank_of(rng, cells, drawn);
        if (rank >= divided) return rank < divided + (cells - divided) / 2;
        rng = (koksma_rng){drawn};
    }
    return koksma_rng_unit(&rng) < share(f);
}

/* ---- Boxes ------------------------------------------------------------------- */

enum { OUT = 1, IN = 2, BOTH = OUT | IN, SUBCELLS_MOST = 125 };

/* Part of one cell: in units of 1/cells[k] of its sides, from lower[k] to upper[k].
 * Of a closed part even the neighbourhood counts, inside the cell. */
typedef struct part {
    ki_u128 lower[3], upper[3];
    bool closed;
} part;

/* The subcells that the part meets have digits from first[k] to last[k]. */
static void subcells_met(unsigned *first, unsigned *last, size_t dim,
                         const uint64_t *cells, const part *p)
{
    for (size_t k = 0; k < dim; k++) {
        ki_u128 lower = 5 * p->lower[k], upper = 5 * p->upper[k], at = cells[k];

        first[k] = last[k] = 0;
        for (unsigned digit = 1; digit < 5; digit++, at += cells[k]) {
            first[k] += lower > at || (lower == at && !p->closed);
            last[k] += upper > at || (upper == at && p->closed);
        }
    }
}

/* The part of p that is in the subcell with these digits. */
static part part_within(const part *p, size_t dim, const uint64_t *cells,
                        const unsigned *digit)
{
    part inner = {.closed = p->closed};

    for (size_t k = 0; k < dim; k++) {
        ki_u128 from = (ki_u128)cells[k] * digit[k], to = from + cells[k];
        ki_u128 lower = 5 * p->lower[k], upper = 5 * p->upper[k];

        inner.lower[k] = lower > from ? lower - from : 0;
        inner.upper[k] = upper < to ? upper - from : cells[k];
    }
    return inner;
}

static bool is_whole(const koksma_integrand *f, const uint64_t *cells,
                     const part *p)
{
    for (size_t k = 0; k < f->dim; k++)
        if (p->lower[k] > 0 || p->upper[k] < cells[k]) return false;
    return true;
}

/* From digits to the next of those from first to last; false after the last. */
static bool next_subcell(unsigned *digit, const unsigned *first,
                         const unsigned *last, size_t dim)
{
    for (size_t k = 0; k < dim; k++) {
        if (digit[k]++ < last[k]) return true;
        digit[k] = first[k];
    }
    return false;
}

static size_t number_of(const unsigned *digit, size_t dim)
{
    size_t subcell = 0;

    for (size_t k = 0; k < dim; k++)
        subcell = 5 * subcell + digit[k];
    return subcell;
}

/* Which of in and out the part has some volume of; the cell at that level is
 * divided and its subcells draw from rng.  A divided cell has both.  Subcells that
 * are not divided come first, since they may answer at once. */
static unsigned sides_of(const koksma_integrand *f, const uint64_t *cells,
                         const part *p, koksma_rng rng, int level)
{
    size_t count = subcells(f->dim), divided = (size_t)f->param[M], dim = f->dim;
    unsigned first[3], last[3], digit[3], sides = 0;
    uint64_t drawn[SUBCELLS_MOST];
    bool again[SUBCELLS_MOST];
    koksma_rng own = rng;

    if (is_whole(f, cells, p)) return BOTH;
    if (level == LEVELS) return koksma_rng_unit(&rng) < share(f) ? IN : OUT;
    for (size_t i = 0; i < count; i++)
        drawn[i] = koksma_rng_next(&own);
    subcells_met(first, last, dim, cells, p);
    memcpy(digit, first, sizeof digit);
    do {
        size_t rank = 0, subcell = number_of(digit, dim);

        for (size_t j = 0; j < count; j++)
            rank += drawn[j] < drawn[subcell];
        if (rank >= divided)
            sides |= rank < divided + (count - divided) / 2 ? IN : OUT;
        again[subcell] = rank < divided;
    } while (sides != BOTH && next_subcell(digit, first, last, dim));
    if (sides == BOTH) return BOTH;
    do {
        size_t subcell = number_of(digit, dim);
        part inner;

        if (!again[subcell]) continue;
        inner = part_within(p, dim, cells, digit);
        sides |=
            sides_of(f, cells, &inner, (koksma_rng){drawn[subcell]}, level + 1);
    } while (sides != BOTH && next_subcell(digit, first, last, dim));
    return sides;
}

/* A box is connected: where it has both, it has what is between. */
static koksma_meeting meets(const koksma_integrand *f, const koksma_cell_box *box)
{
    koksma_rng rng = koksma_rng_seed((uint64_t)f->param[PATTERN], 0);
    part p = {.closed = false};

    for (size_t k = 0; k < f->dim; k++) {
        p.lower[k] = box->lower[k];
        p.upper[k] = box->upper[k];
    }
    if (sides_of(f, box->cells, &p, rng, 0) == BOTH) return KOKSMA_CUTS;
    p.closed = true;
    return sides_of(f, box->cells, &p, rng, 0) == BOTH ? KOKSMA_TOUCHES
                                                       : KOKSMA_APART;
}

/* ---- Rows -------------------------------------------------------------------- */

/* Every divided cell has some of the set and some of its complement, so its inside
 * holds boundary in proportion to its face; above 5^(dim-1) of them, that adds up
 * to infinity, and an indicator of infinite perimeter is not of bounded
 * variation. */
static void facts(koksma_facts *out, const koksma_integrand *f)
{
    double dim = (double)f->dim, faces = f->dim == 2 ? 5.0 : 25.0;
    double length = f->param[M] > faces ? (double)INFINITY : (double)NAN;
    double in = share(f);

    *out = ki_facts_indicator(in, 0.5 * DBL_EPSILON * in, length, length, f->dim);
    out->axes = (double)NAN;
    out->box_dim = fmax(dim - 1.0, log(f->param[M]) / log(5.0));
    out->variation = length;
}

const koksma_integrand_row ki_row_fractal2 = {
    .name = "fractal2",
    .summary = "1 in a random fractal, m of 25 cells divided",
    .dim = 2,
    .dim_least = 2,
    .dim_most = 2,
    .dim_step = 1,
    .params = {{"m", 9.0, 1.0, 23.0, KOKSMA_WHOLE},
               {"pattern", 1.0, 0.0, 0x1p53, KOKSMA_WHOLE}},
    .functions = {.value = value, .piece = ki_piece_by_value, .meets = meets},
    .facts = facts,
};

const koksma_integrand_row ki_row_fractal3 = {
    .name = "fractal3",
    .summary = "1 in a random fractal, m of 125 cells divided",
    .dim = 3,
    .dim_least = 3,
    .dim_most = 3,
    .dim_step = 1,
    .params = {{"m", 41.0, 1.0, 123.0, KOKSMA_WHOLE},
               {"pattern", 1.0, 0.0, 0x1p53, KOKSMA_WHOLE}},
    .functions = {.value = value, .piece = ki_piece_by_value, .meets = meets},
    .facts = facts,
};
