/* The smooth part of an integrand, and the part that jumps. */
#include "integrand_kernels.h"

static double nothing(const koksma_integrand *f, const double *x)
{
    (void)f;
    (void)x;
    return 0.0;
}

static koksma_range nothing_range(const koksma_integrand *f, const double *lower,
                                  const double *upper)
{
    (void)f;
    (void)lower;
    (void)upper;
    return (koksma_range){{0.0, 0.0}, false};
}

void koksma_integrand_split(koksma_integrand *f, koksma_facts *facts,
                            const koksma_integrand_row *row, koksma_part part)
{
    koksma_part all =
        f->piece == ki_piece_only ? KOKSMA_PART_SMOOTH : KOKSMA_PART_JUMP;

    if (row->split != NULL) {
        row->split(f, facts, part);
        return;
    }
    if (part == all) return;
    f->value = nothing;
    f->piece = ki_piece_only;
    f->range = nothing_range;
    f->meets = ki_meets_nothing;
    *facts = ki_facts_smooth(0.0, 0.0);
    facts->variance = facts->variation = 0.0;
}
