/* What can be traded for the time that D* takes: a second thread, a tolerance, a
 * limit; and what it takes of memory.  A table each.  Seconds are CPU seconds of
 * one thread, but for the two tables that say wall. */

#include <math.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench_star.h"

static koksma_star_result solve(koksma_points p, koksma_star_opts opts)
{
    koksma_star_result r = {0};
    koksma_status status = koksma_star(&r, p, &opts, NULL);

    bench_must(status != KOKSMA_OK && status != KOKSMA_STOPPED, "koksma_star");
    return r;
}

static void print_set(const bench_set *s)
{
    printf("%s\t%zu\t%zu", s->family, s->dim, s->n);
}

static void end_row(void)
{
    putchar('\n');
    fflush(stdout);
}

static void two_threads(void)
{
    static const bench_set sets[] = {
        {"halton", 2, 1000000, 1}, {"random", 2, 1000000, 0},
        {"halton", 3, 50000, 1},   {"halton", 4, 10000, 1},
        {"sobol", 8, 512, 0},      {"sobol", 15, 128, 0}};

    puts("# family\tdim\tn\twall_1\twall_2\tratio\tvalue");
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++) {
        koksma_points p = bench_points(&sets[i]);
        double begun = bench_wall(), one, two;
        koksma_interval v = solve(p, (koksma_star_opts){.threads = 1}).value, w;

        one = bench_wall() - begun;
        begun = bench_wall();
        w = solve(p, (koksma_star_opts){.threads = 2}).value;
        two = bench_wall() - begun;
        bench_must(v.lower != w.lower || v.upper != w.upper, "the same value");
        print_set(&sets[i]);
        printf("\t%.4g\t%.4g\t%.3g\t%.17g", one, two, one / two, v.lower);
        end_row();
        bench_points_free(p);
    }
}

/* The share is of the time of the exact search, which is not in stages. */
static void tolerance(void)
{
    static const bench_set sets[] = {
        {"halton", 3, 20000, 1}, {"sobol", 10, 512, 0}, {"random", 20, 200, 0}};
    static const double eps[] = {0.0, 0.05, 0.1, 0.25, 0.5, 1.0};

    puts("# family\tdim\tn\ttolerance\tseconds\tshare\tlower\tupper");
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++) {
        koksma_points p = bench_points(&sets[i]);
        double exact = 0.0;

        for (size_t j = 0; j < sizeof eps / sizeof eps[0]; j++) {
            double begun = bench_now(), seconds;
            koksma_interval v =
                solve(p, (koksma_star_opts){.threads = 1, .tolerance = eps[j]})
                    .value;

            seconds = bench_now() - begun;
            if (eps[j] == 0.0) exact = seconds;
            print_set(&sets[i]);
            printf("\t%g\t%.4g\t%.3g\t%.17g\t%.17g", eps[j], seconds,
                   seconds / exact, v.lower, v.upper);
            end_row();
        }
        bench_points_free(p);
    }
}

typedef struct limit {
    double begun, seconds;
} limit;

static int is_over(void *state, double lower, double upper, double work)
{
    const limit *l = state;

    (void)lower, (void)upper, (void)work;
    return bench_wall() - l->begun >= l->seconds;
}

/* Kept: taken within a tenth of what was asked, or 0.1 s. */
static void time_limit(void)
{
    static const bench_set sets[] = {{"sobol", 12, 1024, 0},
                                     {"halton", 3, 200000, 1}};
    static const double limits[] = {0.1, 0.5, 1.0, 2.0};

    puts("# family\tdim\tn\tasked\twall\tkept\tlower\tupper");
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++) {
        koksma_points p = bench_points(&sets[i]);

        for (size_t j = 0; j < sizeof limits / sizeof limits[0]; j++) {
            limit l = {bench_wall(), limits[j]};
            koksma_interval v = solve(p, (koksma_star_opts){.threads = 1,
                                                            .anytime = true,
                                                            .progress = is_over,
                                                            .state = &l})
                                    .value;
            double taken = bench_wall() - l.begun;

            print_set(&sets[i]);
            printf("\t%g\t%.3f\t%s\t%.17g\t%.17g", limits[j], taken,
                   taken - limits[j] <= fmax(0.1, 0.1 * limits[j]) ? "yes" : "no",
                   v.lower, v.upper);
            end_row();
        }
        bench_points_free(p);
    }
}

static double peak_bytes(void)
{
    struct rusage u;

    getrusage(RUSAGE_SELF, &u);
    return 1024.0 * (double)u.ru_maxrss;
}

/* A process of its own for each set, whose peak is this set's: what it takes beyond
 * the process itself and the points. */
static void memory_of(const bench_set *s)
{
    koksma_points p = bench_points(s);
    double before = peak_bytes(), bytes, numbers = (double)(s->n * s->dim);

    solve(p, (koksma_star_opts){.threads = 1});
    bytes = peak_bytes() - before;
    print_set(s);
    printf("\t%.0f\t%.0f\t%.4g\t%.4g", numbers, bytes, bytes / numbers,
           bytes / (double)s->n);
    end_row();
    bench_points_free(p);
}

static void memory(void)
{
    static const bench_set sets[] = {
        {"halton", 2, 10000, 1},  {"halton", 2, 1000000, 1},
        {"sobol", 2, 1000000, 0}, {"halton", 3, 2000, 1},
        {"halton", 3, 20000, 1},  {"halton", 4, 1000, 1},
        {"halton", 4, 10000, 1},  {"sobol", 8, 128, 0},
        {"sobol", 8, 512, 0},     {"sobol", 15, 128, 0},
        {"sobol", 15, 256, 0},    {"random", 20, 100, 0},
        {"random", 20, 200, 0},
    };

    puts("# family\tdim\tn\tnumbers\tbytes\tbytes/number\tbytes/point");
    fflush(stdout); /* what is left in the buffer, each child would write again */
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++) {
        int status = EXIT_FAILURE;
        pid_t child = fork();

        if (child == 0) {
            memory_of(&sets[i]);
            _exit(EXIT_SUCCESS);
        }
        bench_must(child < 0 || waitpid(child, &status, 0) != child || status != 0,
                   "a process for a set");
    }
}

int main(void)
{
    memory(); /* first: what this process has had, its children seem to have had */
    two_threads();
    tolerance();
    time_limit();
    return EXIT_SUCCESS;
}
