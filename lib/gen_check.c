#include "error.h"
#include "gen_kernels.h"

/* The options against what a family takes. */

static koksma_status check_indices(const koksma_gen_family *f,
                                   const koksma_gen_opts *o, koksma_error *err)
{
    ki_u128 leap = o->leap > 0 ? o->leap : 1;

    if (o->n == 0)
        return ki_fail(err, KOKSMA_EINVAL, 0, "0 points: a set has at least one");
    if (!(f->takes & KOKSMA_TAKES_START) && o->start > 0)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "%s is no sequence: it has no start index", f->name);
    if (!(f->takes & KOKSMA_TAKES_START) && leap > 1)
        return ki_fail(err, KOKSMA_EINVAL, 0, "%s is no sequence: it has no leap",
                       f->name);
    if (leap * (o->n - 1) > UINT64_MAX - o->start)
        return ki_fail(err, KOKSMA_EINVAL, 0, "indices reach beyond 2^64 - 1");
    return KOKSMA_OK;
}

static koksma_status check_scramble(const koksma_gen_family *f,
                                    const koksma_gen_opts *o, koksma_error *err)
{
    bool digits = f->takes & KOKSMA_TAKES_DIGITS;

    switch (o->scramble) {
    case KOKSMA_SCRAMBLE_DIGITS:
    case KOKSMA_SCRAMBLE_OWEN:
        if (digits) return KOKSMA_OK;
        return ki_fail(err, KOKSMA_EINVAL, 0, "%s has no digits to scramble",
                       f->name);
    case KOKSMA_SCRAMBLE_MATRIX:
        if (f->takes & KOKSMA_TAKES_MATRIX) return KOKSMA_OK;
        return ki_fail(err, KOKSMA_EINVAL, 0, "%s has no matrices to scramble",
                       f->name);
    case KOKSMA_SCRAMBLE_NONE:
    case KOKSMA_SCRAMBLE_SHIFT: return KOKSMA_OK;
    }
    return ki_fail(err, KOKSMA_EINVAL, 0, "there is no scrambling %d",
                   (int)o->scramble);
}

koksma_status ki_gen_check(const koksma_gen_family *f, const koksma_gen_opts *o,
                           koksma_error *err)
{
    koksma_status status;

    if (o->dim < 1 || o->dim > f->max_dim)
        return ki_fail(err, KOKSMA_EINVAL, 0, "dimension %zu: %s has 1 to %zu",
                       o->dim, f->name, f->max_dim);
    status = check_indices(f, o, err);
    if (status == KOKSMA_OK && !(f->takes & KOKSMA_TAKES_BASES) && o->bases != NULL)
        return ki_fail(err, KOKSMA_EINVAL, 0, "%s has no bases", f->name);
    if (status == KOKSMA_OK &&
        ((!(f->takes & KOKSMA_TAKES_VECTOR) && o->vector != NULL) ||
         (!(f->takes & KOKSMA_TAKES_ALPHA) && o->alpha != NULL)))
        return ki_fail(
            err, KOKSMA_EINVAL, 0, "%s takes no %svector", f->name,
            f->takes & (KOKSMA_TAKES_VECTOR | KOKSMA_TAKES_ALPHA) ? "such " : "");
    if (status == KOKSMA_OK && !(f->takes & KOKSMA_TAKES_RADIUS) &&
        (o->radius != 0.0 || o->torus))
        return ki_fail(err, KOKSMA_EINVAL, 0, "%s keeps no radius", f->name);
    if (status == KOKSMA_OK) status = check_scramble(f, o, err);
    return status;
}
