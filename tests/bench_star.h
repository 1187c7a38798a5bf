#ifndef KOKSMA_TESTS_BENCH_STAR_H
#define KOKSMA_TESTS_BENCH_STAR_H

#include <time.h>

#include "bench.h"
#include "gen.h"
#include "star.h"

/* What the benches of the star discrepancy share: sets that a row of a table names,
 * and the clock on the wall. */

typedef struct bench_set {
    const char *family;
    size_t dim, n;
    uint64_t start;
} bench_set;

static inline koksma_points bench_points(const bench_set *s)
{
    double *x = bench_alloc(s->n * s->dim, sizeof *x);
    koksma_gen_opts o = {.dim = s->dim, .n = s->n, .seed = 1, .start = s->start};
    koksma_gen *g;

    bench_must(koksma_gen_open(&g, koksma_gen_find(s->family), &o, NULL),
               "koksma_gen_open");
    bench_must(koksma_gen_fill(g, x, 0, s->n, NULL), "koksma_gen_fill");
    koksma_gen_close(g);
    return (koksma_points){x, s->n, s->dim};
}

static inline void bench_points_free(koksma_points p)
{
    free((void *)(uintptr_t)p.x);
}

static inline double bench_wall(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#endif
