/* Ways to compute radical inverses, of 2^20 indices from 2^32 on: how fast, and how
 * far off.  A double q for the truth r/p is off by |q p - r| / (p ulp), which one
 * fma gives; above: how many are above the truth, where they may have left their
 * elementary interval.  value: the mean.
 *
 *     powers    the sum of digits times powers of 1/b, as most programs have it
 *     horner    from the last digit on: add a digit, divide
 *     integers  digits reversed in integers, one division, for each index anew
 *     koksma    the library: digits are kept from one index to the next, and the
 *               division is rounded down, exactly
 *     digits    the library, digits permuted: no truth is known to this program */

#include <float.h>
#include <math.h>
#include <string.h>

#include "bench.h"
#include "gen.h"

enum { N = 1 << 20 };
static const uint64_t FIRST = (uint64_t)1 << 32;

static double powers(uint32_t b, uint64_t index)
{
    double x = 0.0, f = 1.0 / b;

    for (; index > 0; index /= b, f /= b)
        x += f * (double)(index % b);
    return x;
}

static double horner(uint32_t b, uint64_t index)
{
    double x = 0.0;
    uint32_t digit[64];
    int digits = 0;

    for (; index > 0; index /= b)
        digit[digits++] = (uint32_t)(index % b);
    while (digits > 0)
        x = (x + digit[--digits]) / b;
    return x;
}

static void reverse(uint32_t b, uint64_t index, double *r, double *p)
{
    uint64_t reversed = 0, power = 1;

    for (; index > 0; index /= b, power *= b)
        reversed = reversed * b + index % b;
    *r = (double)reversed;
    *p = (double)power;
}

static double integers(uint32_t b, uint64_t index)
{
    double r, p;

    reverse(b, index, &r, &p);
    return r / p;
}

static void fill_each(double *x, double (*inverse)(uint32_t, uint64_t), uint32_t b)
{
    for (size_t i = 0; i < N; i++)
        x[i] = inverse(b, FIRST + i);
}

static void fill_library(double *x, koksma_scramble how, uint32_t b)
{
    koksma_gen_opts o = {.dim = 1, .n = N, .start = FIRST, .scramble = how};
    koksma_gen *g;

    o.bases = &b;
    bench_must((int)koksma_gen_open(&g, koksma_gen_find("halton"), &o, NULL),
               "koksma_gen_open");
    bench_must((int)koksma_gen_fill(g, x, 0, N, NULL), "koksma_gen_fill");
    koksma_gen_close(g);
}

static void row(const char *method, uint32_t b, const double *x, double seconds)
{
    double worst = 0.0, sum = 0.0;
    size_t above = 0;

    for (size_t i = 0; i < N; i++) {
        double r, p, beyond, ulp;

        reverse(b, FIRST + i, &r, &p);
        beyond = fma(x[i], p, -r) / p;
        ulp = ldexp(DBL_EPSILON, ilogb(r / p));
        worst = fmax(worst, fabs(beyond) / ulp);
        above += beyond > 0.0;
        sum += x[i];
    }
    printf("%s\t%u\t%d\t%.4g\t%.4g\t", method, b, N, seconds, 1e9 * seconds / N);
    if (strcmp(method, "digits") == 0)
        printf("nan\tnan");
    else
        printf("%.3g\t%zu", worst, above);
    printf("\t%.17g\n", sum / N);
    fflush(stdout);
}

int main(void)
{
    static const uint32_t bases[] = {2, 3, 10, 29, 541};
    static const struct {
        const char *name;
        double (*inverse)(uint32_t, uint64_t);
    } ways[] = {{"powers", powers}, {"horner", horner}, {"integers", integers}};
    double *x = bench_alloc(N, sizeof *x), started;

    puts("# method\tbase\tpoints\tseconds\tns_per_point\tulps\tabove\tvalue");
    memset(x, 0, N * sizeof *x);
    for (size_t k = 0; k < sizeof bases / sizeof bases[0]; k++) {
        for (size_t w = 0; w < sizeof ways / sizeof ways[0]; w++) {
            started = bench_now();
            fill_each(x, ways[w].inverse, bases[k]);
            row(ways[w].name, bases[k], x, bench_now() - started);
        }
        started = bench_now();
        fill_library(x, KOKSMA_SCRAMBLE_NONE, bases[k]);
        row("koksma", bases[k], x, bench_now() - started);
        started = bench_now();
        fill_library(x, KOKSMA_SCRAMBLE_DIGITS, bases[k]);
        row("digits", bases[k], x, bench_now() - started);
    }
    free(x);
    return EXIT_SUCCESS;
}
