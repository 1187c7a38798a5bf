/* The star discrepancy in the plane: random points by five seeds, as many points as
 * ten million, and sets that are hard in one way each, beside Halton's as many.
 * CPU seconds of one thread. */

#include <math.h>

#include "bench_star.h"
#include "rng.h"

enum { SEEDS = 5, MILLION = 1000000, HARD = 100000 };

static double solve(koksma_points p, double *value)
{
    koksma_star_opts opts = {.threads = 1};
    koksma_star_result r = {0};
    double begun = bench_now();

    bench_must(koksma_star(&r, p, &opts, NULL) != KOKSMA_OK, "koksma_star");
    *value = r.value.lower;
    return bench_now() - begun;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;

    return (x > y) - (x < y);
}

static void random_points(void)
{
    double seconds[SEEDS], value;
    double *x = bench_alloc(2 * MILLION, sizeof *x);

    puts("# family\tn\tseed\tseconds\tvalue");
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        koksma_rng rng = koksma_rng_seed(seed, 0);

        for (size_t i = 0; i < 2 * MILLION; i++)
            x[i] = koksma_rng_unit(&rng);
        seconds[seed - 1] = solve((koksma_points){x, MILLION, 2}, &value);
        printf("random\t%d\t%llu\t%.4g\t%.17g\n", MILLION, (unsigned long long)seed,
               seconds[seed - 1], value);
        fflush(stdout);
    }
    qsort(seconds, SEEDS, sizeof *seconds, by_size);
    printf("# median %.4g\n", seconds[SEEDS / 2]);
    free(x);
}

static void ten_million(void)
{
    static const bench_set sets[] = {{"sobol", 2, 10 * MILLION, 0},
                                     {"random", 2, 10 * MILLION, 0}};

    puts("# family\tn\tseconds\tvalue");
    for (size_t i = 0; i < sizeof sets / sizeof sets[0]; i++) {
        koksma_points p = bench_points(&sets[i]);
        double value, seconds = solve(p, &value);

        printf("%s\t%zu\t%.4g\t%.17g\n", sets[i].family, p.n, seconds, value);
        fflush(stdout);
        bench_points_free(p);
    }
}

/* Point i of HARD of a hard family, from a point (u, v) of Hammersley's, so that u
 * is i/HARD. */
typedef void hard_point(double *out, double u, double v);

static void diagonal(double *out, double u, double v)
{
    (void)v;
    out[0] = out[1] = u;
}

static void antidiagonal(double *out, double u, double v)
{
    (void)v;
    out[0] = u;
    out[1] = 1.0 - u;
}

static void convex(double *out, double u, double v)
{
    (void)v;
    out[0] = u;
    out[1] = u * u;
}

static void concave(double *out, double u, double v)
{
    (void)v;
    out[0] = u;
    out[1] = sqrt(u);
}

static void hyperbola(double *out, double u, double v)
{
    (void)v;
    out[0] = 0.01 + 0.99 * u;
    out[1] = 0.01 / out[0];
}

static void falling_arc(double *out, double u, double v)
{
    (void)v;
    out[0] = u;
    out[1] = sqrt(1.0 - u * u);
}

static void circle(double *out, double u, double v)
{
    (void)v;
    out[0] = 0.5 + 0.5 * cos(6.283185307179586 * u);
    out[1] = 0.5 + 0.5 * sin(6.283185307179586 * u);
}

static void grid(double *out, double u, double v)
{
    (void)v;
    out[0] = floor(u * 316.0) / 316.0;
    out[1] = fmod(u * 316.0, 1.0);
}

static void constant(double *out, double u, double v)
{
    (void)u;
    out[0] = 0.5;
    out[1] = v;
}

static void duplicates(double *out, double u, double v)
{
    out[0] = floor(u * 1000.0) / 1000.0;
    out[1] = floor(v * 10.0) / 10.0;
}

static void clusters(double *out, double u, double v)
{
    out[0] = (floor(u * 8.0) + 1e-3 * fmod(u * 8.0, 1.0)) / 8.0;
    out[1] = (floor(v * 8.0) + 1e-3 * fmod(v * 8.0, 1.0)) / 8.0;
}

static void corner(double *out, double u, double v)
{
    out[0] = pow(u, 8.0);
    out[1] = pow(v, 8.0);
}

static void geometric(double *out, double u, double v)
{
    out[0] = exp2(-300.0 * u);
    out[1] = exp2(-300.0 * v);
}

static void near_diagonal(double *out, double u, double v)
{
    out[0] = u;
    out[1] = fmin(1.0, u + 1e-3 * v);
}

static void hammersley(double *out, double u, double v)
{
    out[0] = u;
    out[1] = v;
}

static void fibonacci(double *out, double u, double v)
{
    (void)v;
    out[0] = u;
    out[1] = fmod(u * HARD * 0.61803398874989485, 1.0);
}

static const struct {
    const char *name;
    hard_point *point;
} hard[] = {
    {"diagonal", diagonal},     {"antidiagonal", antidiagonal},
    {"convex", convex},         {"concave", concave},
    {"hyperbola", hyperbola},   {"falling arc", falling_arc},
    {"circle", circle},         {"grid", grid},
    {"constant", constant},     {"duplicates", duplicates},
    {"clusters", clusters},     {"corner", corner},
    {"geometric", geometric},   {"near diagonal", near_diagonal},
    {"hammersley", hammersley}, {"golden lattice", fibonacci},
};

static void hard_families(void)
{
    static const bench_set reference = {"halton", 2, HARD, 1},
                           source = {"hammersley", 2, HARD, 0};
    koksma_points halton = bench_points(&reference), from = bench_points(&source);
    double *x = bench_alloc(2 * HARD, sizeof *x), value, best;

    solve(halton, &value); /* the first run finds no memory of its own yet */
    best = solve(halton, &value);
    puts("# family\tn\tseconds\tratio to Halton\tvalue");
    printf("halton\t%d\t%.4g\t1\t%.17g\n", HARD, best, value);
    for (size_t f = 0; f < sizeof hard / sizeof hard[0]; f++) {
        double seconds;

        for (size_t i = 0; i < HARD; i++)
            hard[f].point(x + 2 * i, from.x[2 * i], from.x[2 * i + 1]);
        seconds = solve((koksma_points){x, HARD, 2}, &value);
        printf("%s\t%d\t%.4g\t%.3g\t%.17g\n", hard[f].name, HARD, seconds,
               seconds / best, value);
        fflush(stdout);
    }
    free(x);
    bench_points_free(halton);
    bench_points_free(from);
}

int main(void)
{
    random_points();
    hard_families();
    ten_million();
    return EXIT_SUCCESS;
}
