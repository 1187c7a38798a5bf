/* The L2 discrepancies: CPU seconds with one thread, and those of SciPy on the same
 * points where python3 has it.  SciPy's time at 10^6 points is a hundred times that
 * at 10^5, as its cost is n^2. */
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "bench.h"
#include "gen.h"
#include "io.h"
#include "l2.h"

static const struct {
    size_t dim, n, peer_n;
    koksma_l2_kind kind;
    koksma_l2_method method;
    const char *peer;
} sets[] = {
    {2, 10000, 10000, KOKSMA_L2_STAR, KOKSMA_L2_PAIRS, "L2-star"},
    {6, 10000, 10000, KOKSMA_L2_STAR, KOKSMA_L2_PAIRS, "L2-star"},
    {20, 10000, 10000, KOKSMA_L2_STAR, KOKSMA_L2_PAIRS, "L2-star"},
    {2, 10000, 10000, KOKSMA_L2_CENTERED, KOKSMA_L2_PAIRS, "CD"},
    {20, 10000, 10000, KOKSMA_L2_CENTERED, KOKSMA_L2_PAIRS, "CD"},
    {2, 10000, 10000, KOKSMA_L2_WRAPAROUND, KOKSMA_L2_PAIRS, "WD"},
    {20, 10000, 10000, KOKSMA_L2_WRAPAROUND, KOKSMA_L2_PAIRS, "WD"},
    {2, 10000, 10000, KOKSMA_L2_MIXTURE, KOKSMA_L2_PAIRS, "MD"},
    {20, 10000, 10000, KOKSMA_L2_MIXTURE, KOKSMA_L2_PAIRS, "MD"},
    {2, 1000000, 100000, KOKSMA_L2_STAR, KOKSMA_L2_DIVIDE, "L2-star"},
    {2, 1000000, 100000, KOKSMA_L2_CENTERED, KOKSMA_L2_DIVIDE, "CD"},
    {2, 1000000, 100000, KOKSMA_L2_WRAPAROUND, KOKSMA_L2_DIVIDE, "WD"},
    {3, 1000000, 0, KOKSMA_L2_STAR, KOKSMA_L2_DIVIDE, NULL},
};

static double *points_of(size_t dim, size_t n)
{
    koksma_gen_opts o = {.dim = dim, .n = n, .start = 1};
    double *x = bench_alloc(n * dim, sizeof *x);
    koksma_gen *g;

    bench_must(koksma_gen_open(&g, koksma_gen_find("halton"), &o, NULL), "open");
    bench_must(koksma_gen_fill(g, x, 0, n, NULL), "fill");
    koksma_gen_close(g);
    return x;
}

/* SciPy's own process seconds for the first n points, and its value. */
static int run_peer(const double *x, size_t n, size_t dim, const char *kind,
                    double *seconds, double *value)
{
    char name[] = "bench_l2.XXXXXX", command[512];
    int descriptor = mkstemp(name), got = 0;
    FILE *file = descriptor >= 0 ? fdopen(descriptor, "wb") : NULL, *peer;

    if (file == NULL) bench_must(1, "a file for the peer");
    bench_must(fwrite(x, sizeof *x, n * dim, file) != n * dim, "writing");
    fclose(file);
    snprintf(command, sizeof command,
             "python3 -c \"import numpy as np, time; from scipy.stats import qmc; "
             "x = np.fromfile('%s').reshape(-1, %zu); b = time.process_time(); "
             "v = qmc.discrepancy(x, method='%s'); "
             "print(time.process_time() - b, repr(float(v)))\"",
             name, dim, kind);
    peer = popen(command, "r");
    if (peer != NULL) got = fscanf(peer, "%lf %lf", seconds, value);
    if (peer != NULL) pclose(peer);
    unlink(name);
    return got == 2;
}

static void bench(size_t i, int scipy)
{
    koksma_l2_opts o = {
        .kind = sets[i].kind, .method = sets[i].method, .threads = 1};
    size_t n = sets[i].n, dim = sets[i].dim;
    double *x = points_of(dim, n), best = 1e9, peer, value;
    koksma_l2_result r = {0};

    for (int run = 0; run < 3; run++) {
        double started = bench_now(), seconds;

        bench_must(koksma_l2(&r, (koksma_points){x, n, dim}, &o, NULL),
                   "koksma_l2");
        seconds = bench_now() - started;
        if (seconds < best) best = seconds;
    }
    printf("%s\t%zu\t%zu\t%s\t%.4g\t%.17g\t%.2g", koksma_l2_names[o.kind], dim, n,
           o.method == KOKSMA_L2_PAIRS ? "pairs" : "divide", best, r.value.lower,
           1.0 - r.value.lower / r.value.upper);
    if (scipy && sets[i].peer != NULL &&
        run_peer(x, sets[i].peer_n, dim, sets[i].peer, &peer, &value)) {
        double more = (double)n / (double)sets[i].peer_n;

        printf("\t%.4g\t%zu\t%.17g\t%.3g", peer, sets[i].peer_n, value,
               peer * more * more / best);
    }
    putchar('\n');
    fflush(stdout);
    free(x);
}

int main(void)
{
    int scipy = system("python3 -c 'import scipy' 2>/dev/null") == 0;

    if (!scipy) puts("# python3 has no SciPy to compare with");
    printf("# kind\tdim\tn\tmethod\tseconds\tvalue\twidth%s\n",
           scipy ? "\tpeer_seconds\tpeer_n\tpeer_value\tratio" : "");
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++)
        bench(i, scipy);
    return EXIT_SUCCESS;
}
