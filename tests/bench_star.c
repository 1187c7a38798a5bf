/* How fast D* is found: CPU seconds and the value.  With PEER_DEM in the
 * environment, a program that takes dim, n and a file as M. Wahlstroem's dem_discr
 * does, the same sets are given to it, and the last columns have its seconds, what
 * it printed, and the ratio.  PEER_DEM_SECONDS (default 100) limits each run. */

#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "bench.h"
#include "gen.h"
#include "io.h"
#include "star.h"

typedef struct bench_set {
    const char *family;
    size_t dim, n;
    uint64_t start;
    bool peer; /* within the peer's reach */
} bench_set;

static const bench_set sets[] = {
    {"halton", 1, 1000000, 1, false}, {"halton", 2, 1000, 1, true},
    {"halton", 2, 10000, 1, true},    {"halton", 2, 100000, 1, false},
    {"random", 2, 100000, 0, false},  {"halton", 2, 1000000, 1, false},
    {"sobol", 2, 1000000, 0, false},  {"hammersley", 2, 1000000, 0, false},
    {"random", 2, 1000000, 0, false}, {"halton", 3, 5000, 1, true},
    {"halton", 3, 20000, 1, false},   {"random", 3, 20000, 0, false},
    {"halton", 3, 50000, 1, false},   {"halton", 4, 2000, 1, true},
    {"halton", 5, 1000, 1, true},     {"halton", 6, 500, 1, true},
    {"sobol", 8, 128, 0, true},       {"sobol", 8, 1024, 0, false},
    {"sobol", 10, 50, 0, true},       {"sobol", 10, 256, 0, false},
    {"sobol", 15, 128, 0, false},     {"random", 20, 100, 0, false},
    {"random", 20, 200, 0, false},
};

static double *points_of(const bench_set *s)
{
    double *x = bench_alloc(s->n * s->dim, sizeof *x);
    koksma_gen_opts o = {.dim = s->dim, .n = s->n, .seed = 1, .start = s->start};
    koksma_gen *g;

    bench_must(koksma_gen_open(&g, koksma_gen_find(s->family), &o, NULL),
               "koksma_gen_open");
    bench_must(koksma_gen_fill(g, x, 0, s->n, NULL), "koksma_gen_fill");
    koksma_gen_close(g);
    return x;
}

static double children_now(void)
{
    struct rusage u;

    getrusage(RUSAGE_CHILDREN, &u);
    return (double)u.ru_utime.tv_sec + 1e-6 * (double)u.ru_utime.tv_usec;
}

/* Run the peer on the set; returns its seconds and fills what it printed. */
static double run_peer(const char *program, const bench_set *s, const double *x,
                       char *printed, size_t size)
{
    char name[] = "bench_star.XXXXXX", command[4096];
    const char *seconds = getenv("PEER_DEM_SECONDS");
    int descriptor = mkstemp(name);
    FILE *file = descriptor >= 0 ? fdopen(descriptor, "w") : NULL, *peer;
    double started = children_now();

    if (file == NULL) bench_must(1, "a file for the peer");
    bench_must(koksma_write_rows(file, x, s->n, s->dim, KOKSMA_DECIMAL, NULL),
               "writing");
    fclose(file);
    snprintf(command, sizeof command, "timeout %s %s %zu %zu %s 2>/dev/null",
             seconds != NULL ? seconds : "100", program, s->dim, s->n, name);
    peer = popen(command, "r");
    if (peer == NULL || fgets(printed, (int)size, peer) == NULL)
        snprintf(printed, size, "unfinished");
    if (peer != NULL) pclose(peer);
    unlink(name);
    printed[strcspn(printed, "\n")] = '\0';
    return children_now() - started;
}

static void bench(const bench_set *s, const char *program)
{
    double *x = points_of(s), started = bench_now(), seconds;
    koksma_star_result r = {0};
    static const char *const methods[] = {"auto", "sweep", "tree", "lines"};
    char printed[64];

    bench_must(koksma_star(&r, (koksma_points){x, s->n, s->dim}, NULL, NULL),
               "koksma_star");
    seconds = bench_now() - started;
    printf("%s\t%zu\t%zu\t%s\t%.4g\t%.17g", s->family, s->dim, s->n,
           methods[r.method], seconds, r.value.lower);
    if (program != NULL && s->peer) {
        double peer = run_peer(program, s, x, printed, sizeof printed);

        printf("\t%.4g\t%s\t%.3g", peer, printed, peer / seconds);
    }
    putchar('\n');
    fflush(stdout);
    free(x);
}

int main(void)
{
    const char *program = getenv("PEER_DEM");

    printf("# family\tdim\tn\tmethod\tseconds\tvalue%s\n",
           program != NULL ? "\tpeer_seconds\tpeer_value\tratio" : "");
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++)
        bench(&sets[i], program);
    return EXIT_SUCCESS;
}
