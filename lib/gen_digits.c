#include <string.h>

#include "gen_kernels.h"
#include "rng_kernels.h"

/* A coordinate from all its digits in a base, scrambled or not. */

/* The image of digit a > 0 by the permutation of a node, drawn as Fisher and Yates
 * do: step i exchanges the numbers at places i and i + (a draw below b - i). `zero`
 * is the draw of step 0, which is the image of 0.  Going back from place a after
 * its step, only the places that the number was at matter, and no table is kept. */
static uint32_t image(koksma_rng node, uint32_t b, uint32_t zero, uint32_t a)
{
    uint32_t at = a + (uint32_t)ki_rng_scale(ki_rng_at(node, a), b - a);

    for (uint32_t i = a - 1; i > 0; i--)
        if (at == i + (uint32_t)ki_rng_scale(ki_rng_at(node, i), b - i)) at = i;
    return at == zero ? 0 : at;
}

/* Nested scrambling [Owen 1995]: the permutation of a digit depends on those before
 * it.  A node's owner is the number made of the digits before it up to the last
 * that is not 0.  The images of 0 at the nodes straight on from there are the
 * digits of a random fraction of the owner; the rest of a node's permutation is
 * drawn from its owner and its depth.  An owner is below b^(digits - 1) < 2^64
 * where it matters. */
static void scramble_nested(const ki_radical *r, uint32_t *digit, unsigned digits)
{
    uint64_t owner = 0, weight = 1, straight = ki_rng_at(r->nested, 0);
    uint32_t b = r->base;

    for (unsigned j = 0; j < digits; j++, weight *= b) {
        ki_u128 next = (ki_u128)straight * b;
        uint32_t zero = (uint32_t)(next >> 64), a = digit[j];

        digit[j] = zero;
        straight = (uint64_t)next;
        if (a == 0) continue;
        digit[j] = image(koksma_rng_seed(r->nested.counter + owner, j), b, zero, a);
        owner += a * weight;
        straight = ki_rng_at(r->nested, owner);
    }
}

/* An integer over b^places <= 2^53 from the first places, and a fraction of its
 * unit from the others: neither rounds by more than half an ulp. */
static double join(const uint32_t *digit, unsigned digits, uint32_t b)
{
    uint64_t p = 1, tail_p = 1, head = 0, tail = 0;
    unsigned j = 0;

    for (; j < digits && p <= KI_EXACT / b; j++, p *= b)
        head = head * b + digit[j];
    for (; j < digits; j++, tail_p *= b)
        tail = tail * b + digit[j];
    return ki_radical_join(head, p, tail, tail_p);
}

static double plain(const uint32_t *digit, unsigned digits, uint32_t b)
{
    ki_u128 reversed = 0, p = 1;

    while (digits > 0 && digit[digits - 1] == 0)
        digits--;
    for (unsigned j = 0; j < digits; j++, p *= b)
        reversed = reversed * b + digit[j];
    return digits > 0 ? ki_ratio(reversed, p) : 0.0;
}

double ki_radical_value(const ki_radical *r, const uint32_t *digit, unsigned digits)
{
    uint32_t image_of[KI_DIGITS_MOST];

    switch (r->how) {
    case KOKSMA_SCRAMBLE_OWEN:
        memcpy(image_of, digit, digits * sizeof *digit);
        scramble_nested(r, image_of, digits);
        return join(image_of, digits, r->base);
    case KOKSMA_SCRAMBLE_DIGITS:
        for (unsigned j = 0; j < digits; j++)
            image_of[j] = r->permutation[(size_t)j * r->base + digit[j]];
        return join(image_of, digits, r->base);
    default: return plain(digit, digits, r->base);
    }
}
