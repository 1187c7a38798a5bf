#ifndef BENCH_H
#define BENCH_H

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* What the benches share: CPU seconds of this process, and one table, whose
 * value column shows that what was timed is right. */

static inline double bench_now(void)
{
    struct timespec t;

    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static inline void bench_header(void)
{
    puts("# bench\tseconds\trate\tunit\tvalue");
}

/* work units done since `started`; value: what came out. */
static inline void bench_row(const char *name, double started, double work,
                             const char *unit, double value)
{
    double seconds = bench_now() - started;

    printf("%s\t%.4g\t%.4g\t%s/s\t%.17g\n", name, seconds, work / seconds, unit,
           value);
    fflush(stdout);
}

static inline void *bench_alloc(size_t count, size_t size)
{
    void *p = malloc(count * size);

    if (p == NULL) {
        fputs("bench: not enough memory\n", stderr);
        exit(EXIT_FAILURE);
    }
    return p;
}

static inline void bench_must(long status, const char *what)
{
    if (status == 0) return;
    fprintf(stderr, "bench: %s failed with status %ld\n", what, status);
    exit(EXIT_FAILURE);
}

#endif
