/* How fast the box discrepancy is found, in CPU seconds of one thread, and the
 * value. Of random sets the median of five seeds; KOKSMA_BENCH_LONG has the longest
 * too. */

#include "bench.h"
#include "box.h"
#include "gen.h"

static const struct row {
    const char *family;
    size_t dim, n;
    koksma_box_method method;
    bool is_long;
} sets[] = {
    {"halton", 2, 100, KOKSMA_BOX_AUTO, false},
    {"halton", 2, 1000, KOKSMA_BOX_AUTO, false},
    {"halton", 2, 1000, KOKSMA_BOX_SWEEP, false},
    {"halton", 2, 1000, KOKSMA_BOX_TREE, false},
    {"hammersley", 2, 1024, KOKSMA_BOX_AUTO, false},
    {"random", 2, 1000, KOKSMA_BOX_AUTO, false},
    {"random", 2, 10000, KOKSMA_BOX_AUTO, false},
    {"halton", 2, 10000, KOKSMA_BOX_AUTO, true},
    {"halton", 3, 100, KOKSMA_BOX_AUTO, false},
    {"halton", 3, 200, KOKSMA_BOX_AUTO, false},
    {"halton", 3, 1000, KOKSMA_BOX_AUTO, true},
    {"random", 3, 1000, KOKSMA_BOX_AUTO, false},
    {"halton", 4, 100, KOKSMA_BOX_AUTO, false},
    {"random", 4, 200, KOKSMA_BOX_AUTO, false},
};

typedef struct run {
    double seconds;
    koksma_box_result r;
} run;

static run measure(const struct row *s, uint64_t seed)
{
    bool halton = s->family[0] == 'h' && s->family[2] == 'l';
    koksma_gen_opts o = {.dim = s->dim, .n = s->n, .seed = seed, .start = halton};
    koksma_box_opts opts = {.method = s->method, .threads = 1, .seed = 1};
    double *x = bench_alloc(s->n * s->dim, sizeof *x), started;
    koksma_gen *g;
    run result = {0};

    bench_must(koksma_gen_open(&g, koksma_gen_find(s->family), &o, NULL),
               "koksma_gen_open");
    bench_must(koksma_gen_fill(g, x, 0, s->n, NULL), "koksma_gen_fill");
    koksma_gen_close(g);
    started = bench_now();
    bench_must(koksma_box_discrepancy(&result.r, (koksma_points){x, s->n, s->dim},
                                      &opts, NULL),
               "koksma_box_discrepancy");
    result.seconds = bench_now() - started;
    free(x);
    return result;
}

static int by_seconds(const void *a, const void *b)
{
    double x = ((const run *)a)->seconds, y = ((const run *)b)->seconds;

    return (x > y) - (x < y);
}

int main(void)
{
    static const char *const methods[] = {"auto", "sweep", "tree", "search"};

    puts("# family\tdim\tn\tmethod\tseconds\tsteps\tvalue");
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++) {
        const struct row *s = &sets[i];
        size_t seeds = s->family[0] == 'r' ? 5 : 1;
        run runs[5];

        if (s->is_long && getenv("KOKSMA_BENCH_LONG") == NULL) continue;
        for (size_t j = 0; j < seeds; j++)
            runs[j] = measure(s, j + 1);
        qsort(runs, seeds, sizeof *runs, by_seconds);
        printf("%s\t%zu\t%zu\t%s\t%.4g\t%.3g\t%.17g\n", s->family, s->dim, s->n,
               methods[runs[seeds / 2].r.method], runs[seeds / 2].seconds,
               runs[seeds / 2].r.work, runs[seeds / 2].r.value.lower);
        fflush(stdout);
    }
    return EXIT_SUCCESS;
}
