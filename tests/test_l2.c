/* koksma_l2 against the definitions: integrals of squares over all boxes, exact on
 * grids; both methods against each other; published values; ends of the range. */
#include <check.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gen.h"
#include "l2.h"
#include "num_twice.h"
#include "oracle.h"

/* ---- The definition ---------------------------------------------------------- */

/* Each kind is the mean square, over a space of tests, of the mean of the test over
 * the points less its integral.  A test is a product of one-dimensional ones: boxes
 * that hold x, or not; the constant 1; a sign.  On a grid of step 1/M the space of
 * one dimension falls into cells where no test changes its mind at a point of the
 * grid.  A cell has the integrals over its tests of 1, of the test's integral I,
 * and of I^2, in units of 1/(48 M^4). */
typedef struct cell {
    oracle_int one, i, ii;
    int from, to; /* the test is in_value for grid numbers from, ..., to */
    int in_value, out_value;
} cell;

enum { CELLS = 300 };

typedef struct space {
    cell cell[CELLS];
    int count, m;
    oracle_int unit; /* 48 m^4 */
} space;

static void put(space *s, oracle_int one, oracle_int i, oracle_int ii, int from,
                int to, int in_value, int out_value)
{
    ck_assert_int_lt(s->count, CELLS);
    s->cell[s->count++] = (cell){one, i, ii, from, to, in_value, out_value};
}

/* Tests [0,c) with c in cell j, or [c,1]: I = c or 1 - c.  half: where from and
 * where to the cells go; sign: the test is -1 outside, and I is 2c - 1. */
static void put_anchored(space *s, int j, bool below, oracle_int weight, bool sign)
{
    oracle_int m = s->m, k = below ? j : m - 1 - j;
    oracle_int one = weight * m * m * m * 2, i = weight * (2 * k + 1) * m * m;
    oracle_int ii = weight * 2 * (3 * k * k + 3 * k + 1) * m / 3;

    /* in units of 1/(2 m^4) times weight; weight is 24 or 12 */
    ck_assert(weight * 2 * (3 * k * k + 3 * k + 1) * m % 3 == 0);
    if (sign) {
        ii = 4 * ii - 4 * i + one;
        i = 2 * i - one;
    }
    put(s, one, i, ii, below ? 0 : j + 1, below ? j : s->m, 1, sign ? -1 : 0);
}

/* Tests [a,b) with a in cell p, b in cell q; for a > b what is not in [b,a). */
static void put_intervals(space *s, bool wrap, oracle_int weight)
{
    oracle_int m = s->m;

    for (int p = 0; p < s->m; p++)
        for (int q = 0; q < s->m; q++) {
            oracle_int w = weight / 12, d = abs(q - p);
            oracle_int one = 12 * w * m * m, i = 12 * w * d * m;
            oracle_int ii = w * (12 * d * d + 2);

            if (p < q) put(s, one, i, ii, p + 1, q, 1, 0);
            if (p > q && wrap)
                put(s, one, one - i, one - 2 * i + ii, q + 1, p, 0, 1);
            if (p != q) continue;
            one = 6 * w * m * m;
            i = 2 * w * m;
            ii = w;
            put(s, one, i, ii, 1, 0, 1, 0);
            if (wrap) put(s, one, one - i, one - 2 * i + ii, 1, 0, 0, 1);
        }
}

static space space_of(koksma_l2_kind kind, int m)
{
    space s = {.m = m, .unit = (oracle_int)48 * m * m * m * m};
    oracle_int atom = s.unit;

    if (kind == KOKSMA_L2_CENTERED || kind == KOKSMA_L2_WRAPAROUND ||
        kind == KOKSMA_L2_SYMMETRIC)
        put(&s, atom, atom, atom, 0, m, 1, 0);
    if (kind == KOKSMA_L2_MIXTURE)
        put(&s, atom / 8 * 9, atom / 8 * 9, atom / 8 * 9, 0, m, 1, 0);
    for (int j = 0; j < m; j++) {
        bool left = 2 * j < m;

        if (kind == KOKSMA_L2_STAR) put_anchored(&s, j, true, 24, false);
        if (kind == KOKSMA_L2_SYMMETRIC) put_anchored(&s, j, true, 24, true);
        if (kind == KOKSMA_L2_CENTERED) put_anchored(&s, j, left, 24, false);
        if (kind == KOKSMA_L2_MIXTURE) put_anchored(&s, j, !left, 12, false);
    }
    if (kind == KOKSMA_L2_EXTREME) put_intervals(&s, false, 48);
    if (kind == KOKSMA_L2_PERIODIC || kind == KOKSMA_L2_WRAPAROUND)
        put_intervals(&s, true, 48);
    if (kind == KOKSMA_L2_MIXTURE) put_intervals(&s, true, 24);
    return s;
}

typedef struct fraction {
    oracle_int num, den;
} fraction;

static int test_at(const cell *c, int x)
{
    return x >= c->from && x <= c->to ? c->in_value : c->out_value;
}

/* Add up over all products of cells; x are grid numbers. */
static oracle_int add_cells(const space *s, const int *x, size_t n, size_t dim,
                            size_t k, const int *value, fraction one_i,
                            oracle_int ii)
{
    oracle_int sum = 0, inside = 0;
    int next[64];

    if (k == dim) {
        for (size_t i = 0; i < n; i++)
            inside += value[i];
        return inside * inside * one_i.num -
               2 * (oracle_int)n * inside * one_i.den +
               (oracle_int)n * (oracle_int)n * ii;
    }
    for (int j = 0; j < s->count; j++) {
        const cell *c = &s->cell[j];
        fraction f = {one_i.num * c->one, one_i.den * c->i};

        for (size_t i = 0; i < n; i++)
            next[i] = value[i] * test_at(c, x[i * dim + k]);
        sum += add_cells(s, x, n, dim, k + 1, next, f, ii * c->ii);
    }
    return sum;
}

static fraction oracle_l2(koksma_points p, koksma_l2_kind kind, int m)
{
    space s = space_of(kind, m);
    fraction f = {0, (oracle_int)p.n * (oracle_int)p.n};
    int x[192], value[64];

    ck_assert(p.n <= 64 && p.n * p.dim <= 192);
    for (size_t i = 0; i < p.n; i++)
        value[i] = 1;
    for (size_t i = 0; i < p.n * p.dim; i++)
        x[i] = (int)(p.x[i] * m);
    for (size_t k = 0; k < p.dim; k++)
        f.den *= s.unit;
    f.num = add_cells(&s, x, p.n, p.dim, 0, value, (fraction){1, 1}, 1);
    return f;
}

/* -1, 0 or 1 as f < v, f = v, f > v; 0 <= f < 2^10. */
static int compare(fraction f, double v)
{
    int e;
    oracle_int m = (oracle_int)ldexp(frexp(v, &e), 53), whole, rest;

    if (v <= 0.0) return f.num > 0 || v < 0.0;
    if (v > 0x1p20) return -1;
    if (e < -60) return f.num > 0 ? 1 : -1;
    whole = f.num / f.den;
    rest = f.num % f.den;
    for (int bit = e; bit < 53; bit++) {
        rest *= 2;
        whole = 2 * whole + (rest >= f.den);
        if (rest >= f.den) rest -= f.den;
    }
    if (whole != m) return whole > m ? 1 : -1;
    return rest > 0;
}

/* ---- What must hold ---------------------------------------------------------- */

static koksma_l2_result solve(koksma_points p, koksma_l2_kind kind,
                              koksma_l2_method method)
{
    koksma_l2_opts opts = {.kind = kind, .method = method, .threads = 1};
    koksma_l2_result r;
    koksma_error err = {0};
    koksma_status status = koksma_l2(&r, p, &opts, &err);

    ck_assert_msg(status == KOKSMA_OK, "status %d: %s", (int)status, err.text);
    ck_assert_int_eq(r.method, method);
    ck_assert(r.squared.lower <= r.squared.upper && r.squared.lower >= 0.0);
    if (r.squared.lower >= DBL_MIN && r.squared.upper <= DBL_MAX) {
        ck_assert(r.value.lower <= sqrt(r.squared.lower));
        ck_assert(r.value.upper >= sqrt(r.squared.upper));
    }
    ck_assert(r.log10.lower <= log10(r.value.upper) + 1e-12 * fabs(r.log10.lower));
    ck_assert(r.log10.upper >= log10(r.value.lower) - 1e-12 * fabs(r.log10.upper));
    return r;
}

static void complain(const char *what, koksma_points p, koksma_l2_kind kind,
                     int method, koksma_interval v, double want)
{
    ck_abort_msg(
        "%s: %s, method %d, n %zu, dim %zu, seed %llu: [%.17g, %.17g], want "
        "%.17g; first point %g %g",
        what, koksma_l2_names[kind], method, p.n, p.dim,
        (unsigned long long)oracle_seed(), v.lower, v.upper, want, p.x[0],
        p.x[p.dim > 1]);
}

/* Exactly: the truth is inside, and the interval is narrow. */
static void check_exact(koksma_points p, koksma_l2_kind kind, int m)
{
    fraction f = oracle_l2(p, kind, m);

    for (int method = KOKSMA_L2_PAIRS; method <= KOKSMA_L2_DIVIDE; method++) {
        koksma_l2_result r = solve(p, kind, (koksma_l2_method)method);
        double width = method == KOKSMA_L2_PAIRS ? 0x1p-46 : 0x1p-80;
        double want = (double)f.num / (double)f.den;

        if (compare(f, r.squared.lower) < 0 || compare(f, r.squared.upper) > 0)
            complain("outside", p, kind, method, r.squared, want);
        if (r.squared.upper - r.squared.lower >
            width * (double)p.dim * 64.0 + 0x1p-50 * r.squared.upper)
            complain("wide", p, kind, method, r.squared, want);
    }
}

START_TEST(every_pair_of_points_on_a_small_grid)
{
    double x[4];

    for (int code = 0; code < 625; code++) {
        for (int k = 0, c = code; k < 4; k++, c /= 5)
            x[k] = (c % 5) / 4.0;
        for (int kind = 0; kind < KOKSMA_L2_KINDS; kind++) {
            check_exact((koksma_points){x, 2, 2}, (koksma_l2_kind)kind, 4);
            check_exact((koksma_points){x, 4, 1}, (koksma_l2_kind)kind, 4);
        }
    }
}
END_TEST

START_TEST(random_sets_on_grids)
{
    for (size_t round = 0; round < 12 * oracle_scale(); round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        size_t dim = 1 + round % 3, n = 1 + oracle_below(&rng, dim < 3 ? 40 : 9);
        int m = dim < 3 ? 8 : 4;
        double x[192];

        for (size_t i = 0; i < n * dim; i++)
            x[i] = (double)oracle_below(&rng, (size_t)m + 1) / m;
        for (int kind = 0; kind < KOKSMA_L2_KINDS; kind++)
            check_exact((koksma_points){x, n, dim}, (koksma_l2_kind)kind, m);
    }
}
END_TEST

static double *random_set(size_t n, size_t dim, uint64_t round, unsigned bits)
{
    double *x = malloc(n * dim * sizeof *x);
    oracle_rng rng = oracle_rng_start(oracle_seed(), round);

    ck_assert_ptr_nonnull(x);
    for (size_t i = 0; i < n * dim; i++)
        x[i] = oracle_dyadic(&rng, bits);
    return x;
}

static bool overlap(koksma_interval a, koksma_interval b)
{
    return a.lower <= b.upper && b.lower <= a.upper;
}

/* Lists long enough to be cut, with ties and without; and points on a diagonal. */
START_TEST(both_methods_agree)
{
    for (uint64_t round = 0; round < 10; round++) {
        size_t dim = 1 + round % 5, n = dim < 4 ? 1500 : 400;
        double *x = random_set(n, dim, 100 + round, round < 5 ? 53 : 4);
        koksma_points p = {x, n, dim};

        for (size_t i = 0; round % 4 == 3 && i < n * dim; i++)
            x[i] = x[i - i % dim];
        for (int kind = 0; kind < KOKSMA_L2_KINDS; kind++) {
            koksma_l2_result a = solve(p, (koksma_l2_kind)kind, KOKSMA_L2_PAIRS);
            koksma_l2_result b = solve(p, (koksma_l2_kind)kind, KOKSMA_L2_DIVIDE);

            if (!overlap(a.squared, b.squared))
                complain("the methods part", p, (koksma_l2_kind)kind, 0, a.squared,
                         b.squared.lower);
            ck_assert(b.squared.upper - b.squared.lower <=
                      1e-15 * b.squared.upper + 1e-20);
        }
        free(x);
    }
}
END_TEST

/* Where every cut is one through ties; and a point alone. */
START_TEST(equal_points)
{
    static const double at[] = {0.0, 0.25, 0.5, 1.0};
    size_t n = 3000;
    double *x = malloc(n * 3 * sizeof *x);

    ck_assert_ptr_nonnull(x);
    for (size_t i = 0; i < 4; i++)
        for (int kind = 0; kind < KOKSMA_L2_KINDS; kind++) {
            koksma_l2_kind k = (koksma_l2_kind)kind;
            koksma_interval one, all;

            for (size_t j = 0; j < n * 3; j++)
                x[j] = at[i];
            for (size_t dim = 1; dim <= 3; dim++) {
                check_exact((koksma_points){x, 1, dim}, k, 4);
                one = solve((koksma_points){x, 1, dim}, k, KOKSMA_L2_PAIRS).squared;
                all =
                    solve((koksma_points){x, n, dim}, k, KOKSMA_L2_DIVIDE).squared;
                if (!overlap(one, all))
                    complain("equal", (koksma_points){x, n, dim}, k, 2, all,
                             one.lower);
            }
        }
    free(x);
}
END_TEST

/* More than a task, and an odd number of points in each. */
START_TEST(threads_change_no_bit)
{
    size_t n = 9001;
    double *x = random_set(n, 2, 7, 53);
    koksma_points p = {x, n, 2};

    for (int method = KOKSMA_L2_PAIRS; method <= KOKSMA_L2_DIVIDE; method++) {
        koksma_l2_result r = solve(p, KOKSMA_L2_STAR, (koksma_l2_method)method);

        for (size_t threads = 2; threads < 6; threads++) {
            koksma_l2_opts opts = {.method = (koksma_l2_method)method,
                                   .threads = threads};
            koksma_l2_result again;

            ck_assert_int_eq(koksma_l2(&again, p, &opts, NULL), KOKSMA_OK);
            ck_assert(again.squared.lower == r.squared.lower);
            ck_assert(again.squared.upper == r.squared.upper);
            ck_assert(again.work == r.work);
        }
    }
    ck_assert(overlap(solve(p, KOKSMA_L2_STAR, KOKSMA_L2_PAIRS).squared,
                      solve(p, KOKSMA_L2_STAR, KOKSMA_L2_DIVIDE).squared));
    free(x);
}
END_TEST

/* A million terms, against the sum in integers of 128 bits: 2^-106 each. */
START_TEST(long_totals)
{
    enum { TERMS = 1000000 };
    oracle_rng rng = oracle_rng_start(oracle_seed(), 77);
    ki_twice_total total = {0.0, 0.0, 0};
    oracle_int want = 0, got, most = (oracle_int)36 * TERMS * TERMS;
    ki_twice v;

    for (int i = 0; i < TERMS; i++) {
        double hi = 1.0 + oracle_dyadic(&rng, 50);
        double lo = ldexp(oracle_dyadic(&rng, 40) - 0.5, -53);

        want += (oracle_int)ldexp(hi, 53) * ((oracle_int)1 << 53);
        want += (oracle_int)ldexp(lo, 106);
        ki_twice_total_add(&total, (ki_twice){hi, lo});
    }
    v = ki_twice_total_value(&total);
    got = (oracle_int)ldexp(v.hi, 53) * ((oracle_int)1 << 53);
    got += (oracle_int)ldexp(v.lo, 106);
    ck_assert(got - want <= 2 * most && want - got <= 2 * most);
}
END_TEST

/* ---- Known values ------------------------------------------------------------ */

static double *halton(size_t n, size_t dim, uint64_t start)
{
    koksma_gen_opts o = {.dim = dim, .n = n, .start = start};
    double *x = malloc(n * dim * sizeof *x);
    koksma_gen *g;

    ck_assert_ptr_nonnull(x);
    ck_assert_int_eq(koksma_gen_open(&g, koksma_gen_find("halton"), &o, NULL),
                     KOKSMA_OK);
    ck_assert_int_eq(koksma_gen_fill(g, x, 0, n, NULL), KOKSMA_OK);
    koksma_gen_close(g);
    return x;
}

/* Computed in quadruple precision elsewhere; star with integers of any size. */
static const struct {
    size_t n, dim;
    koksma_l2_kind kind;
    double squared;
} known[] = {
    {1000, 2, KOKSMA_L2_CENTERED, 5.13146532492144e-6},
    {1000, 2, KOKSMA_L2_WRAPAROUND, 3.51648342880932e-6},
    {1000, 2, KOKSMA_L2_MIXTURE, 5.53871238046973e-6},
    {1000, 2, KOKSMA_L2_EXTREME, 5.21220389700710e-7},
    {1000, 3, KOKSMA_L2_CENTERED, 1.09148427125483e-5},
    {1000, 3, KOKSMA_L2_WRAPAROUND, 1.47159292211397e-5},
    {1000, 3, KOKSMA_L2_MIXTURE, 1.87006971977627e-5},
    {1000, 3, KOKSMA_L2_EXTREME, 3.79935456659403e-7},
    {1000, 2, KOKSMA_L2_STAR, 2.334872702424530806e-6},
    {10000, 2, KOKSMA_L2_STAR, 5.350979261650484280e-8},
    {10000, 2, KOKSMA_L2_CENTERED, 1.15031827223103e-7},
    {10000, 2, KOKSMA_L2_WRAPAROUND, 5.91114758069122e-8},
};

START_TEST(known_values_of_halton_points)
{
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        double *x = halton(known[i].n, known[i].dim, 1);
        koksma_points p = {x, known[i].n, known[i].dim};
        koksma_interval v = solve(p, known[i].kind, KOKSMA_L2_DIVIDE).squared;

        if (fabs(v.lower - known[i].squared) > 1e-12 * known[i].squared)
            complain("known", p, known[i].kind, 0, v, known[i].squared);
        ck_assert(overlap(v, solve(p, known[i].kind, KOKSMA_L2_PAIRS).squared));
        free(x);
    }
}
END_TEST

/* (i+1/2)/n: 1/(12 n^2), 1/(6 n^2), 1/(8 n^2); rounded coordinates do not show. */
START_TEST(midpoints)
{
    static const double times[KOKSMA_L2_KINDS] = {
        [KOKSMA_L2_STAR] = 12,      [KOKSMA_L2_EXTREME] = 12,
        [KOKSMA_L2_PERIODIC] = 6,   [KOKSMA_L2_CENTERED] = 12,
        [KOKSMA_L2_WRAPAROUND] = 6, [KOKSMA_L2_MIXTURE] = 8,
        [KOKSMA_L2_SYMMETRIC] = 3};
    size_t n = 100000;
    double *x = malloc(n * sizeof *x);

    ck_assert_ptr_nonnull(x);
    for (size_t i = 0; i < n; i++)
        x[i] = ((double)i + 0.5) / (double)n;
    for (int kind = 0; kind < KOKSMA_L2_KINDS; kind++) {
        koksma_l2_opts opts = {.kind = (koksma_l2_kind)kind};
        koksma_points p = {x, n, 1};
        double want = 1.0 / (times[kind] * (double)n * (double)n);
        koksma_l2_result r;

        ck_assert_int_eq(koksma_l2(&r, p, &opts, NULL), KOKSMA_OK);
        if (fabs(r.squared.lower / want - 1.0) > 1e-10 ||
            r.squared.upper - r.squared.lower > 1e-12 * want)
            complain("midpoints", p, (koksma_l2_kind)kind, 0, r.squared, want);
    }
    free(x);
}
END_TEST

/* ---- The ends of the range --------------------------------------------------- */

/* k, h and c as the header has them, in long doubles. */
static long double naive_k(koksma_l2_kind kind, long double x, long double y)
{
    long double s = fabsl(x - y), t = fabsl(x - 0.5L) + fabsl(y - 0.5L);

    switch (kind) {
    case KOKSMA_L2_STAR: return 1 - (x > y ? x : y);
    case KOKSMA_L2_EXTREME: return (x < y ? x : y) - x * y;
    case KOKSMA_L2_PERIODIC: return 0.5L - s + s * s;
    case KOKSMA_L2_CENTERED: return 1 + (t - s) / 2;
    case KOKSMA_L2_WRAPAROUND: return 1.5L - s + s * s;
    case KOKSMA_L2_MIXTURE: return 15 / 8.0L - (t + 3 * s) / 4 + s * s / 2;
    default: return 2 * (1 - s);
    }
}

static long double naive_h(koksma_l2_kind kind, long double x)
{
    long double t = fabsl(x - 0.5L);

    switch (kind) {
    case KOKSMA_L2_STAR: return (1 - x * x) / 2;
    case KOKSMA_L2_EXTREME: return x * (1 - x) / 2;
    case KOKSMA_L2_PERIODIC: return 1 / 3.0L;
    case KOKSMA_L2_CENTERED: return 1 + (t - t * t) / 2;
    case KOKSMA_L2_WRAPAROUND: return 4 / 3.0L;
    case KOKSMA_L2_MIXTURE: return 5 / 3.0L - (t + t * t) / 4;
    default: return 1 + 2 * x - 2 * x * x;
    }
}

static long double naive(koksma_points p, koksma_l2_kind kind)
{
    static const long double c[KOKSMA_L2_KINDS] = {
        1 / 3.0L, 1 / 12.0L, 1 / 3.0L, 13 / 12.0L, 4 / 3.0L, 19 / 12.0L, 4 / 3.0L};
    long double n = (long double)p.n, sum = powl(c[kind], (long double)p.dim);

    for (size_t i = 0; i < p.n; i++) {
        long double h = -2 / n;

        for (size_t k = 0; k < p.dim; k++)
            h *= naive_h(kind, (long double)p.x[i * p.dim + k]);
        sum += h;
        for (size_t j = 0; j < p.n; j++) {
            long double v = 1 / (n * n);

            for (size_t k = 0; k < p.dim; k++)
                v *= naive_k(kind, (long double)p.x[i * p.dim + k],
                             (long double)p.x[j * p.dim + k]);
            sum += v;
        }
    }
    return sum;
}

/* On both sides of where exponents are kept apart, and of a panel of points. */
START_TEST(many_dimensions)
{
    static const size_t dims[] = {20, 200, 201, 400, 1000};

    if (!oracle_long_doubles()) return;
    for (size_t i = 0; i < sizeof dims / sizeof dims[0]; i++) {
        size_t n = i == 2 ? 67 : 20;
        double *x = random_set(n, dims[i], 40 + i, 53);
        koksma_points p = {x, n, dims[i]};

        for (int kind = 0; kind < KOKSMA_L2_KINDS; kind++) {
            koksma_interval v =
                solve(p, (koksma_l2_kind)kind, KOKSMA_L2_PAIRS).log10;
            double want = (double)(log10l(naive(p, (koksma_l2_kind)kind)) / 2);

            if (!(v.lower <= want + 1e-11 && v.upper >= want - 1e-11 &&
                  v.upper - v.lower < 1e-10))
                complain("log10", p, (koksma_l2_kind)kind, 0, v, want);
        }
        free(x);
    }
}
END_TEST

static void check_log10(koksma_points p, koksma_l2_kind kind, double want)
{
    koksma_interval v = solve(p, kind, KOKSMA_L2_PAIRS).log10;

    if (!(v.lower <= want * (1 + 1e-15) + 1e-9 && v.upper >= want - 1e-9 &&
          v.upper - v.lower < 1e-8))
        complain("log10", p, kind, 0, v, want);
}

/* All points equal, at 0, 1/2 or 1, in ten thousand dimensions: one term rules. */
START_TEST(ten_thousand_dimensions)
{
    size_t dim = 10000, n = 3;
    double *x = malloc(n * dim * sizeof *x), d = (double)dim / 2.0;
    koksma_points p = {x, n, dim};

    ck_assert_ptr_nonnull(x);
    for (size_t i = 0; i < n * dim; i++)
        x[i] = 0.0;
    check_log10(p, KOKSMA_L2_STAR, 0.0);
    check_log10(p, KOKSMA_L2_EXTREME, -d * log10(12.0));
    check_log10(p, KOKSMA_L2_PERIODIC, -d * log10(2.0));
    check_log10(p, KOKSMA_L2_CENTERED, d * log10(1.5));
    check_log10(p, KOKSMA_L2_MIXTURE, d * log10(1.625));
    check_log10(p, KOKSMA_L2_SYMMETRIC, d * log10(2.0));
    for (size_t i = 0; i < n * dim; i++)
        x[i] = 1.0;
    check_log10(p, KOKSMA_L2_STAR, -d * log10(3.0));
    for (size_t i = 0; i < n * dim; i++)
        x[i] = 0.5;
    check_log10(p, KOKSMA_L2_STAR, -d * log10(2.0));
    check_log10(p, KOKSMA_L2_EXTREME, -d * log10(4.0));
    ck_assert(solve(p, KOKSMA_L2_STAR, KOKSMA_L2_PAIRS).value.lower == 0.0);
    ck_assert(solve(p, KOKSMA_L2_SYMMETRIC, KOKSMA_L2_PAIRS).value.lower ==
              DBL_MAX);
    free(x);
}
END_TEST

/* Tiny coordinates are as good as 0. */
START_TEST(tiny_coordinates)
{
    double x[] = {1e-300, 0.5, 0x1p-1074, 0.25, 0.75, 1e-100};
    double y[] = {0.0, 0.5, 0.0, 0.25, 0.75, 0.0};

    for (int kind = 0; kind < KOKSMA_L2_KINDS; kind++)
        for (int method = KOKSMA_L2_PAIRS; method <= KOKSMA_L2_DIVIDE; method++) {
            koksma_points p = {x, 3, 2}, q = {y, 3, 2};

            ck_assert(overlap(
                solve(p, (koksma_l2_kind)kind, (koksma_l2_method)method).squared,
                solve(q, (koksma_l2_kind)kind, (koksma_l2_method)method).squared));
        }
}
END_TEST

/* ---- Refusals ---------------------------------------------------------------- */

static int stop(void *state, double lower, double upper, double work)
{
    ck_assert(lower == 0.0 && upper == HUGE_VAL && work > 0.0);
    ++*(int *)state;
    return 1;
}

START_TEST(refusals)
{
    double x[KOKSMA_L2_DIVIDE_DIM + 1] = {0.5}, bad[] = {0.5, (double)NAN};
    koksma_l2_opts opts = KOKSMA_L2_DEFAULTS;
    koksma_l2_result r = {.work = 42.0};
    koksma_error err;
    int calls = 0;

    ck_assert_int_eq(koksma_l2(&r, (koksma_points){bad, 2, 1}, NULL, &err),
                     KOKSMA_EDOMAIN);
    ck_assert_int_eq(koksma_l2(&r, (koksma_points){x, 0, 1}, NULL, &err),
                     KOKSMA_EINVAL);
    opts.kind = KOKSMA_L2_KINDS;
    ck_assert_int_eq(koksma_l2(&r, (koksma_points){x, 1, 1}, &opts, &err),
                     KOKSMA_EINVAL);
    opts = (koksma_l2_opts){.method = (koksma_l2_method)3};
    ck_assert_int_eq(koksma_l2(&r, (koksma_points){x, 1, 1}, &opts, &err),
                     KOKSMA_EINVAL);
    ck_assert_str_eq(err.text, "there is no method 3");
    opts = (koksma_l2_opts){.method = KOKSMA_L2_DIVIDE};
    ck_assert_int_eq(
        koksma_l2(&r, (koksma_points){x, 1, KOKSMA_L2_DIVIDE_DIM + 1}, &opts, &err),
        KOKSMA_EINVAL);
    ck_assert(r.work == 42.0);
    ck_assert_int_eq(
        koksma_l2(&r, (koksma_points){x, 1, KOKSMA_L2_DIVIDE_DIM}, &opts, &err),
        KOKSMA_OK);
    opts.kind = KOKSMA_L2_MIXTURE;
    ck_assert_int_eq(
        koksma_l2(&r, (koksma_points){x, 1, KOKSMA_L2_DIVIDE_DIM_TERMS + 1}, &opts,
                  &err),
        KOKSMA_EINVAL);
    ck_assert_int_eq(koksma_l2(&r,
                               (koksma_points){x, 1, KOKSMA_L2_DIVIDE_DIM_TERMS},
                               &opts, &err),
                     KOKSMA_OK);
    opts.kind = KOKSMA_L2_STAR;
    opts.progress = stop;
    opts.state = &calls;
    ck_assert_int_eq(koksma_l2(&r, (koksma_points){x, 2, 1}, &opts, &err),
                     KOKSMA_STOPPED);
    ck_assert(r.value.lower == 0.0 && r.value.upper == HUGE_VAL && calls == 1);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("l2");
    TCase *c = tcase_create("l2");

    tcase_set_timeout(c, 300);
    tcase_add_test(c, every_pair_of_points_on_a_small_grid);
    tcase_add_test(c, random_sets_on_grids);
    tcase_add_test(c, both_methods_agree);
    tcase_add_test(c, equal_points);
    tcase_add_test(c, long_totals);
    tcase_add_test(c, threads_change_no_bit);
    tcase_add_test(c, known_values_of_halton_points);
    tcase_add_test(c, midpoints);
    tcase_add_test(c, many_dimensions);
    tcase_add_test(c, ten_thousand_dimensions);
    tcase_add_test(c, tiny_coordinates);
    tcase_add_test(c, refusals);
    suite_add_tcase(suite, c);
    return oracle_run(suite);
}
