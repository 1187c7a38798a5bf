/* How fast D* is found, in CPU seconds of one thread, and the value.
 *
 * First, sets within the reach of M. Wahlstroem's dem_discr.  With PEER_DEM in the
 * environment, a program that takes dim, n and a file as that does, the same sets
 * are given to it, and the last columns have its seconds, what it printed, and the
 * ratio.  PEER_DEM_SECONDS (default 100) limits each run.
 *
 * Then sets beyond its reach; with KOKSMA_EXTRA_SETS (see test_extra.c) those of
 * others too, and with KOKSMA_BENCH_LONG the longest of them. */

#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "bench_star.h"
#include "io.h"

static const bench_set near[] = {
    {"halton", 2, 100000, 1}, {"halton", 3, 5000, 1}, {"halton", 4, 2000, 1},
    {"halton", 5, 1000, 1},   {"halton", 6, 500, 1},  {"sobol", 8, 128, 0},
    {"sobol", 10, 50, 0},
};

static const bench_set far[] = {
    {"halton", 1, 1000000, 1},     {"halton", 2, 10000, 1},
    {"halton", 2, 1000000, 1},     {"sobol", 2, 1000000, 0},
    {"hammersley", 2, 1000000, 0}, {"random", 2, 1000000, 0},
    {"halton", 3, 20000, 1},       {"random", 3, 20000, 0},
    {"halton", 3, 50000, 1},       {"halton", 3, 60000, 1},
    {"sobol", 8, 1024, 0},         {"sobol", 10, 512, 0},
    {"sobol", 15, 256, 0},         {"random", 20, 100, 0},
    {"random", 20, 200, 0},
};

static const struct {
    const char *file;
    bool is_long;
} others[] = {
    {"gww_sobol_d20_n128.txt", false},
    {"gww_sobol_d20_n256.txt", false},
    {"gww_sobol_d20_n512.txt", true},
};

static double children_now(void)
{
    struct rusage u;

    getrusage(RUSAGE_CHILDREN, &u);
    return (double)u.ru_utime.tv_sec + 1e-6 * (double)u.ru_utime.tv_usec;
}

/* Run the peer on the set; returns its seconds and fills what it printed. */
static double run_peer(const char *program, koksma_points p, char *printed,
                       size_t size)
{
    char name[] = "bench_star.XXXXXX", command[4096];
    const char *seconds = getenv("PEER_DEM_SECONDS");
    int descriptor = mkstemp(name);
    FILE *file = descriptor >= 0 ? fdopen(descriptor, "w") : NULL, *peer;
    double started = children_now();

    if (file == NULL) bench_must(1, "a file for the peer");
    bench_must(koksma_write_rows(file, p.x, p.n, p.dim, KOKSMA_DECIMAL, NULL),
               "writing");
    fclose(file);
    snprintf(command, sizeof command, "timeout %s %s %zu %zu %s 2>/dev/null",
             seconds != NULL ? seconds : "100", program, p.dim, p.n, name);
    peer = popen(command, "r");
    if (peer == NULL || fgets(printed, (int)size, peer) == NULL)
        snprintf(printed, size, "unfinished");
    if (peer != NULL) pclose(peer);
    unlink(name);
    printed[strcspn(printed, "\n")] = '\0';
    return children_now() - started;
}

/* The first columns of a row; returns the seconds. */
static double bench(const char *name, koksma_points p)
{
    static const char *const methods[] = {"auto", "sweep", "tree", "lines"};
    koksma_star_opts opts = {.threads = 1};
    koksma_star_result r = {0};
    double started = bench_now(), seconds;

    bench_must(koksma_star(&r, p, &opts, NULL), "koksma_star");
    seconds = bench_now() - started;
    printf("%s\t%zu\t%zu\t%s\t%.4g\t%.17g", name, p.dim, p.n, methods[r.method],
           seconds, r.value.lower);
    return seconds;
}

static void against_the_peer(void)
{
    const char *program = getenv("PEER_DEM");

    printf("# family\tdim\tn\tmethod\tseconds\tvalue%s\n",
           program != NULL ? "\tpeer_seconds\tpeer_value\tratio" : "");
    for (size_t i = 0; i < sizeof near / sizeof near[0]; i++) {
        koksma_points p = bench_points(&near[i]);
        double seconds = bench(near[i].family, p), peer;
        char printed[64];

        if (program != NULL) {
            peer = run_peer(program, p, printed, sizeof printed);
            printf("\t%.4g\t%s\t%.3g", peer, printed, peer / seconds);
        }
        putchar('\n');
        fflush(stdout);
        bench_points_free(p);
    }
}

static void bench_file(const char *folder, const char *file)
{
    char name[4096];
    koksma_set set = {0};
    koksma_reader *reader;
    FILE *in;

    snprintf(name, sizeof name, "%s/sets/%s", folder, file);
    in = fopen(name, "r");
    bench_must(in == NULL, name);
    bench_must(koksma_reader_open(&reader, in, KOKSMA_POINTS, NULL), name);
    bench_must(koksma_set_read(&set, reader, NULL), name);
    bench(file, koksma_set_view(&set));
    putchar('\n');
    fflush(stdout);
    koksma_set_free(&set);
    koksma_reader_close(reader);
    fclose(in);
}

static void beyond_the_peer(void)
{
    const char *folder = getenv("KOKSMA_EXTRA_SETS");

    puts("# family\tdim\tn\tmethod\tseconds\tvalue");
    for (size_t i = 0; i < sizeof far / sizeof far[0]; i++) {
        koksma_points p = bench_points(&far[i]);

        bench(far[i].family, p);
        putchar('\n');
        fflush(stdout);
        bench_points_free(p);
    }
    if (folder == NULL || *folder == '\0') return;
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (!others[i].is_long || getenv("KOKSMA_BENCH_LONG") != NULL)
            bench_file(folder, others[i].file);
}

int main(void)
{
    against_the_peer();
    beyond_the_peer();
    return EXIT_SUCCESS;
}
