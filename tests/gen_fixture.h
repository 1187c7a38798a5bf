#ifndef KOKSMA_TESTS_GEN_FIXTURE_H
#define KOKSMA_TESTS_GEN_FIXTURE_H

#include <check.h>
#include <stdlib.h>

#include "gen.h"
#include "gen_kernels.h"

/* What the tests of the generators share: exact radical inverses that owe nothing
 * to lib/, and points into a room of ROOM numbers. */

enum { ROOM = 1 << 17 };

/* r/p < 1 without the bits behind the first 53 that count: a long division, in
 * which every sum of powers of 1/2 is exact. */
static inline double truncated(ki_u128 r, ki_u128 p)
{
    double v = 0.0, unit = 0.5;

    for (int bits = 0; r > 0 && bits<53; bits += v> 0.0, unit /= 2.0) {
        r *= 2;
        if (r < p) continue;
        r -= p;
        v += unit;
    }
    return v;
}

static inline double inverse(uint64_t index, uint32_t base)
{
    ki_u128 r = 0, p = 1;

    for (; index > 0; index /= base, p *= base)
        r = r * base + index % base;
    return truncated(r, p);
}

static inline koksma_gen *open_family(const char *name, const koksma_gen_opts *o)
{
    koksma_gen *g = NULL;
    koksma_error err = {0};
    koksma_status status = koksma_gen_open(&g, koksma_gen_find(name), o, &err);

    ck_assert_msg(status == KOKSMA_OK, "%s: %s", name, err.text);
    return g;
}

/* Points first, ..., first + count - 1 of o's. */
static inline void fill_some(double *x, const char *name, koksma_gen_opts o,
                             uint64_t first, size_t count)
{
    koksma_gen *g = open_family(name, &o);

    if (count * o.dim > ROOM) abort();
    ck_assert_int_eq(koksma_gen_fill(g, x, first, count, NULL), KOKSMA_OK);
    koksma_gen_close(g);
}

static inline void fill_all(double *x, const char *name, koksma_gen_opts o)
{
    fill_some(x, name, o, 0, (size_t)o.n);
}

static const uint32_t bases[] = {2, 3, 5, 7, 29, 541, 7919, 4294967291u};

#endif
