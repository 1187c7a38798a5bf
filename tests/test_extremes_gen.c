/* Every family of points at the extremes: one point, 10^7, up to 10^4 dimensions,
 * and n*dim up to 10^8.  What is expected of each is a property that its formula
 * has: how its points fall on every single axis, and that they stand in [0,1). */
#include <check.h>
#include <string.h>

#include "extremes_fixture.h"
#include "gen.h"

/* How the coordinates of n points along an axis are spread. */
typedef enum spread {
    ROUND,  /* at j/n, once each, up to the rounding: nets of n = b^m points,
             * lattices  of one that has no factor in common with n */
    STRATA, /* one in each interval [j/n, (j+1)/n) */
    CELLS,  /* as many in each of m intervals, n = m^dim */
    GAPS,   /* multiples of one number, modulo 1: the gaps between neighbours on the
             * circle have at most three lengths, the greatest the sum of the others
             */
    HOLES,  /* at random: no gap as long as 40/n, but once in e^40/n sets */
    INSIDE  /* in [0,1), which all are */
} spread;

typedef struct sample {
    const char *name;
    uint64_t n;
    size_t dim;
    spread spread;
    uint64_t start;
} sample;

static koksma_gen *open_sample(const sample *s)
{
    static const uint64_t vector[] = {1, 364981, 245389, 97823, 488939},
                          korobov[] = {364981};
    static const double alpha[] = {0.41421356237309503, 0.7320508075688773,
                                   0x1p-20};
    koksma_gen_opts o = {.dim = s->dim, .n = s->n, .start = s->start, .seed = 1};
    koksma_gen *g = NULL;
    koksma_error err = {0};

    if (strcmp(s->name, "lattice") == 0) {
        o.vector = vector;
        o.vector_size = s->dim;
    }
    if (strcmp(s->name, "korobov") == 0) {
        o.vector = korobov;
        o.vector_size = 1;
    }
    if (strcmp(s->name, "kronecker") == 0) {
        o.alpha = alpha;
        o.alpha_size = s->dim;
    }
    ck_assert_msg(koksma_gen_open(&g, koksma_gen_find(s->name), &o, &err) ==
                      KOKSMA_OK,
                  "%s, n %llu, dim %zu: %s", s->name, (unsigned long long)s->n,
                  s->dim, err.text);
    return g;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;

    return (x > y) - (x < y);
}

/* j of j/m if x is next to it, else m. */
static size_t multiple(double x, double m)
{
    double near = floor(x * m + 0.5);

    return fabs(x * m - near) <= 4 * m * ULP ? (size_t)near : (size_t)m;
}

/* floor(x m), exactly. */
static size_t stratum(double x, double m)
{
    double at = floor(x * m);

    return (size_t)(fma(x, m, -at) < 0.0 ? at - 1.0 : at);
}

static const char *uneven(const double *x, size_t n, size_t strata, bool round)
{
    size_t *count = calloc(strata + 1, sizeof *count);
    const char *fault = NULL;

    ck_assert_ptr_nonnull(count);
    for (size_t i = 0; i < n; i++)
        count[round ? multiple(x[i], (double)strata)
                    : stratum(x[i], (double)strata)]++;
    for (size_t j = 0; j < strata; j++)
        if (count[j] != n / strata) fault = "uneven strata";
    free(count);
    return fault;
}

/* x: in increasing order. */
static const char *gaps(const double *x, size_t n, bool random)
{
    double length[4] = {0}, error = 8 * ULP;
    size_t lengths = 0;

    for (size_t i = 0; i < n; i++) {
        double gap = i + 1 < n ? x[i + 1] - x[i] : 1.0 - x[i] + x[0];
        size_t l = 0;

        if (random && gap > 40.0 / (double)n) return "a hole";
        while (!random && l < lengths && fabs(gap - length[l]) > error)
            l++;
        if (!random && l == lengths) {
            if (lengths == 3) return "a fourth gap";
            length[lengths++] = gap;
        }
    }
    return NULL;
}

static const char *axis_fault(double *x, const sample *s)
{
    size_t n = (size_t)s->n, side = n;

    if (s->spread == INSIDE) return NULL;
    if (s->spread <= STRATA) return uneven(x, n, n, s->spread == ROUND);
    if (s->spread == CELLS) {
        side = (size_t)floor(pow((double)n, 1.0 / (double)s->dim) + 0.5);
        return uneven(x, n, side, false);
    }
    qsort(x, n, sizeof *x, compare);
    return gaps(x, n, s->spread == HOLES);
}

/* All points in one block, and the last alone; some axes, the last among them. */
static void check_sample(const sample *s)
{
    size_t n = (size_t)s->n, dim = s->dim;
    double *x = malloc(n * dim * sizeof *x), *axis = malloc(n * sizeof *axis);
    double *last = malloc(dim * sizeof *last);
    koksma_gen *g = open_sample(s);

    ck_assert(x != NULL && axis != NULL && last != NULL);
    ck_assert_int_eq(koksma_gen_fill(g, x, 0, n, NULL), KOKSMA_OK);
    ck_assert_int_eq(koksma_gen_fill(g, last, s->n - 1, 1, NULL), KOKSMA_OK);
    ck_assert_int_eq(koksma_gen_fill(g, last, s->n, 1, NULL), KOKSMA_EINVAL);
    koksma_gen_close(g);
    ck_assert(memcmp(last, x + (n - 1) * dim, dim * sizeof *last) == 0);
    for (size_t i = 0; i < n * dim; i++)
        if (!(x[i] >= 0.0 && x[i] < 1.0)) ck_abort_msg("%s: %g", s->name, x[i]);
    for (size_t k = dim; n > 1 && k-- > 0; k = k > 3 ? k / 2 : k) {
        const char *fault;

        for (size_t i = 0; i < n; i++)
            axis[i] = x[i * dim + k];
        fault = axis_fault(axis, s);
        ck_assert_msg(fault == NULL, "%s, n %zu, dim %zu, axis %zu: %s", s->name, n,
                      dim, k, fault);
    }
    free(x);
    free(axis);
    free(last);
}

static const sample small[] = {
    {"halton", 1024, 1, ROUND, 0},       {"halton", 1000, 1000, INSIDE, 1u << 30},
    {"hammersley", 1000, 1, ROUND, 0},   {"vandercorput", 4096, 1, ROUND, 0},
    {"faure", 23 * 23, 20, ROUND, 0},    {"sobol", 1024, 100, ROUND, 0},
    {"niederreiter", 1024, 1, ROUND, 0}, {"richtmyer", 1000, 100, GAPS, 0},
    {"rsequence", 1000, 20, GAPS, 0},    {"kronecker", 1000, 3, GAPS, 0},
    {"lattice", 1009, 5, ROUND, 0},      {"korobov", 1009, 20, ROUND, 0},
    {"fibonacci", 987, 2, ROUND, 0},     {"zaremba", 1024, 2, ROUND, 0},
    {"random", 1000, 100, HOLES, 0},     {"grid", 1024, 10, CELLS, 0},
    {"centred", 1024, 5, CELLS, 0},      {"jittered", 1024, 2, CELLS, 0},
    {"latin", 1000, 100, STRATA, 0},     {"multijittered", 1024, 2, STRATA, 0},
    {"poisson", 200, 2, HOLES, 0},       {"random", 1, 10000, HOLES, 0},
};

static const sample large[] = {
    {"halton", 1u << 23, 1, ROUND, 0},
    {"halton", 10000000, 10, HOLES, 0},
    {"hammersley", 10000000, 1, ROUND, 0},
    {"vandercorput", 1u << 23, 1, ROUND, 0},
    {"faure", 23 * 23 * 23 * 23, 20, ROUND, 0},
    {"faure", 1009, 1000, ROUND, 0},
    {"faure", 10007, 10000, ROUND, 0},
    {"sobol", 1u << 23, 10, ROUND, 0},
    {"sobol", 1u << 16, 1111, ROUND, 0},
    {"niederreiter", 1u << 23, 1, ROUND, 0},
    {"niederreiter", 1u << 13, 3, HOLES, 0},
    {"richtmyer", 10000000, 2, GAPS, 0},
    {"richtmyer", 10000, 10000, GAPS, 0},
    {"rsequence", 10000000, 2, GAPS, 0},
    {"rsequence", 10000, 10000, GAPS, 0},
    {"kronecker", 10000000, 3, GAPS, 0},
    {"lattice", 9999991, 5, ROUND, 0},
    {"korobov", 10007, 1000, ROUND, 0},
    {"fibonacci", 9227465, 2, ROUND, 0},
    {"zaremba", 1u << 23, 2, ROUND, 0},
    {"random", 10000000, 10, HOLES, 0},
    {"random", 10000, 10000, HOLES, 0},
    {"grid", 10000000, 1, ROUND, 0},
    {"grid", 1u << 20, 20, CELLS, 0},
    {"centred", 10000000, 7, CELLS, 0},
    {"jittered", 10000000, 7, CELLS, 0},
    {"jittered", 1u << 20, 20, CELLS, 0},
    {"latin", 10000000, 2, STRATA, 0},
    {"latin", 10000, 10000, STRATA, 0},
    {"multijittered", 9998244, 2, STRATA, 0},
    {"poisson", 10000, 2, HOLES, 0},
};

START_TEST(small_samples) { check_sample(&small[_i]); }
END_TEST

START_TEST(large_samples) { check_sample(&large[_i]); }
END_TEST

/* One point of every family that needs nothing but a dim, in the most dimensions of
 * 10^4 that it takes; and one dimension more is refused. */
START_TEST(one_point)
{
    for (const koksma_gen_family *f = koksma_gen_families; f->name != NULL; f++) {
        size_t most = f->max_dim < 10000 ? f->max_dim : 10000;
        sample s = {f->name, 1, most, HOLES, 0};
        koksma_gen_opts o = {.dim = f->max_dim + 1, .n = 1};
        koksma_gen *g = NULL;

        if (f->takes & (KOKSMA_TAKES_VECTOR | KOKSMA_TAKES_ALPHA)) s.dim = 1;
        if (strcmp(f->name, "faure") == 0) s.dim = 100; /* permanent: base^2 */
        check_sample(&s);
        if (f->max_dim < SIZE_MAX)
            ck_assert_int_eq(koksma_gen_open(&g, f, &o, NULL), KOKSMA_EINVAL);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("extremes, families");
    TCase *tc = tcase_create("small"), *big = tcase_create("large");

    tcase_set_timeout(tc, 60);
    tcase_add_loop_test(tc, small_samples, 0, sizeof small / sizeof *small);
    tcase_add_test(tc, one_point);
    suite_add_tcase(suite, tc);
    tcase_set_timeout(big, 1200);
    tcase_set_tags(big, "big");
    tcase_add_loop_test(big, large_samples, 0, sizeof large / sizeof *large);
    suite_add_tcase(suite, big);
    return oracle_run(suite);
}
