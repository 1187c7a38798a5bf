/* The half-plane discrepancy: CPU seconds with one thread, the best of three runs.
 */
#include "bench.h"
#include "edge.h"
#include "gen.h"

static const struct {
    const char *family;
    size_t n, start, seeds;
    koksma_edge_method method;
} sets[] = {
    {"halton", 1000, 1, 1, KOKSMA_EDGE_TREE},
    {"halton", 10000, 1, 1, KOKSMA_EDGE_TREE},
    {"halton", 100000, 1, 1, KOKSMA_EDGE_TREE},
    {"random", 1000, 0, 5, KOKSMA_EDGE_TREE},
    {"random", 10000, 0, 5, KOKSMA_EDGE_TREE},
    {"random", 100000, 0, 5, KOKSMA_EDGE_TREE},
    {"sobol", 16384, 0, 1, KOKSMA_EDGE_TREE},
    {"hammersley", 1024, 0, 1, KOKSMA_EDGE_TREE},
    {"centred", 1024, 0, 1, KOKSMA_EDGE_TREE},
    {"halton", 1000, 1, 1, KOKSMA_EDGE_SWEEP},
    {"halton", 5000, 1, 1, KOKSMA_EDGE_SWEEP},
    {"random", 1000, 0, 1, KOKSMA_EDGE_SWEEP},
};

static double *points_of(size_t i, uint64_t seed)
{
    koksma_gen_opts o = {
        .dim = 2, .n = sets[i].n, .start = sets[i].start, .seed = seed};
    double *x = bench_alloc(2 * o.n, sizeof *x);
    koksma_gen *g;

    bench_must(koksma_gen_open(&g, koksma_gen_find(sets[i].family), &o, NULL),
               "open");
    bench_must(koksma_gen_fill(g, x, 0, o.n, NULL), "fill");
    koksma_gen_close(g);
    return x;
}

static void bench(size_t i, uint64_t seed)
{
    koksma_edge_opts o = {.method = sets[i].method, .threads = 1};
    double *x = points_of(i, seed), best = 1e9;
    koksma_edge_result r = {0};

    for (int run = 0; run < 3; run++) {
        double started = bench_now(), seconds;

        bench_must(koksma_edge(&r, (koksma_points){x, sets[i].n, 2}, &o, NULL),
                   "koksma_edge");
        seconds = bench_now() - started;
        if (seconds < best) best = seconds;
    }
    printf("%s\t%zu\t%llu\t%s\t%.4g\t%.17g\t%.3g\n", sets[i].family, sets[i].n,
           (unsigned long long)seed,
           o.method == KOKSMA_EDGE_TREE ? "tree" : "sweep", best, r.value.lower,
           r.work);
    fflush(stdout);
    free(x);
}

int main(void)
{
    puts("# family\tn\tseed\tmethod\tseconds\tvalue\tsteps");
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++)
        for (uint64_t seed = 1; seed <= sets[i].seeds; seed++)
            bench(i, seed);
    return EXIT_SUCCESS;
}
