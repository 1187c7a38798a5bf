/* The filtered lines of lib/star_lines.c: against the definition and the sweep on
 * small sets full of ties, with leaves so small that every filter has its say;
 * against the tree and formulas on larger ones. */
#include <check.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "gen.h"
#include "oracle.h"
#include "star.h"
#include "star_lines_kernels.h"

enum { NUMBERS = 12000 };

typedef struct answer {
    koksma_interval value;
    double corner[3];
    size_t inside;
    bool closed;
} answer;

static answer solve_with(koksma_points p, ki_lines_sizes sizes)
{
    koksma_star_opts opts = KOKSMA_STAR_DEFAULTS;
    answer a = {0};
    ki_best b = ki_best_begin(p, a.corner);
    double work = 0.0;
    bool stopped = true;

    ck_assert_int_eq(
        ki_star_lines_with(&b, &opts, sizes, &a.value.upper, &work, &stopped),
        KOKSMA_OK);
    ck_assert(!stopped);
    a.value.lower = b.value.lower;
    a.inside = b.witness.inside;
    a.closed = b.witness.closed;
    return a;
}

static answer solve_by(koksma_points p, koksma_star_method method)
{
    koksma_star_opts opts = {.method = method};
    koksma_star_result r = {0};
    koksma_error err = {0};
    answer a = {0};

    r.witness.corner = a.corner;
    ck_assert_msg(koksma_star(&r, p, &opts, &err) == KOKSMA_OK, "%s", err.text);
    ck_assert_int_eq(r.method, method);
    ck_assert(r.work > 0.0);
    a.value = r.value;
    a.inside = r.witness.inside;
    a.closed = r.witness.closed;
    return a;
}

/* The same to the last bit; of an open and a closed box at one corner either may be
 * the witness. */
static void check_same(answer a, answer b, koksma_points p, uint64_t round)
{
    ck_assert_msg(
        a.value.lower == b.value.lower && a.value.upper == b.value.upper,
        "KOKSMA_TEST_SEED=%llu set %llu n %zu dim %zu: [%a, %a], [%a, %a]",
        (unsigned long long)oracle_seed(), (unsigned long long)round, p.n, p.dim,
        a.value.lower, a.value.upper, b.value.lower, b.value.upper);
    for (size_t k = 0; k < p.dim; k++)
        ck_assert_msg(a.corner[k] == b.corner[k],
                      "KOKSMA_TEST_SEED=%llu set %llu n %zu dim %zu: %a, %a",
                      (unsigned long long)oracle_seed(), (unsigned long long)round,
                      p.n, p.dim, a.corner[k], b.corner[k]);
    if (a.closed == b.closed) ck_assert_uint_eq(a.inside, b.inside);
}

/* With no room for finds, a scout is followed by a search of everything. */
static const ki_lines_sizes leaves[] = {
    {1, 64, 0, 0}, {2, 2, 1, 1}, {5, 0, 0, 0}, {64, 64, 2, 5}};

static void check_leaves(koksma_points p, answer truth, uint64_t round)
{
    for (size_t l = 0; l < sizeof leaves / sizeof leaves[0]; l++)
        check_same(truth, solve_with(p, leaves[l]), p, round);
}

/* Coordinates by kind: anywhere; on coarse grids with and without 1; on faces;
 * crowded at 0, at 1 and down to the least doubles; lattices, whose lines are
 * collinear; grids off by a few units of the last bit; and columns so few that many
 * lines lie between the same points of theirs. */
enum { KINDS = 11 };

static double coordinate(oracle_rng *rng, size_t kind, size_t n, size_t i, size_t k)
{
    double u = oracle_dyadic(rng, 53);
    size_t levels = 1 + (n * 7 + kind) % 13;

    switch (kind) {
    case 1: return floor(u * (double)levels) / (double)levels;
    case 2: return floor(u * (double)(levels + 1)) / (double)levels;
    case 3: return oracle_below(rng, 3) > 0 ? u : (double)oracle_below(rng, 2);
    case 4: return floor(u * 16.0) / 16.0;
    case 5: return u * u * u * u * u * u * u * u;
    case 6:
        return k == 0 ? (double)i / (double)n : fmod((double)(i * 5 * k), 8) / 8;
    case 7:
        return k == 0 ? (double)i / (double)n
                      : fmod((double)(i * (levels + k)) / (double)n, 1.0);
    case 8:
        return oracle_below(rng, 4) > 0
                   ? ldexp(u, -(int)oracle_below(rng, 1075))
                   : 1.0 - 0x1p-53 * (double)oracle_below(rng, 5);
    case 9:
        return fmin(1.0, floor(u * 8.0) / 8.0 +
                             ldexp((double)oracle_below(rng, 4), -52));
    case 10: return k == 0 && i % 8 > 0 ? ldexp(u, -30) : u;
    default: return u;
    }
}

static koksma_points make_set(double *x, uint64_t round, size_t dim, size_t most)
{
    oracle_rng rng = oracle_rng_start(oracle_seed(), round);
    size_t n = 1 + oracle_below(&rng, most);

    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < dim; k++)
            x[i * dim + k] = coordinate(&rng, round % KINDS, n, i, k);
    return (koksma_points){x, n, dim};
}

static const struct {
    size_t dim, most, sets;
} shapes[] = {{2, 6, 1000}, {2, 40, 1000}, {2, 200, 30}, {3, 5, 500}, {3, 16, 300}};

START_TEST(as_the_sweep_says)
{
    static double x[NUMBERS];

    for (uint64_t round = 0; round < shapes[_i].sets * oracle_scale(); round++) {
        koksma_points p = make_set(x, round, shapes[_i].dim, shapes[_i].most);

        check_leaves(p, solve_by(p, KOKSMA_STAR_SWEEP), round);
    }
}
END_TEST

START_TEST(as_the_definition_says)
{
    static double x[NUMBERS];

    for (uint64_t round = 0; round < 400 * oracle_scale(); round++) {
        size_t dim = 2 + (size_t)(round % 2);
        koksma_points p =
            make_set(x, round / 2 * KINDS + 4, dim, dim == 2 ? 12 : 6);
        double least[3];
        oracle_ratio truth = oracle_star(p, least);

        for (size_t l = 0; l < sizeof leaves / sizeof leaves[0]; l++) {
            answer a = solve_with(p, leaves[l]);

            ck_assert(oracle_contains(a.value, truth) && oracle_narrow(a.value));
            ck_assert_mem_eq(a.corner, least, dim * sizeof *least);
            ck_assert_uint_eq(a.inside, oracle_count(p, a.corner, a.closed));
        }
    }
}
END_TEST

/* What a generator makes, with room for the caller to free. */
static double *generate(const char *family, size_t dim, size_t n, uint64_t start)
{
    koksma_gen_opts o = {.dim = dim, .n = n, .seed = oracle_seed(), .start = start};
    double *x = malloc(n * dim * sizeof *x);
    koksma_gen *g;

    ck_assert_ptr_nonnull(x);
    ck_assert_int_eq(koksma_gen_open(&g, koksma_gen_find(family), &o, NULL), 0);
    ck_assert_int_eq(koksma_gen_fill(g, x, 0, n, NULL), 0);
    koksma_gen_close(g);
    return x;
}

static const struct {
    const char *family;
    size_t dim, n;
} large[] = {{"halton", 2, 3000},     {"sobol", 2, 3000},    {"random", 2, 4000},
             {"hammersley", 2, 2500}, {"halton", 3, 700},    {"sobol", 3, 700},
             {"random", 3, 2000},     {"hammersley", 3, 700}};

START_TEST(as_the_tree_says)
{
    double *x = generate(large[_i].family, large[_i].dim, large[_i].n, 0);
    koksma_points p = {x, large[_i].n, large[_i].dim};

    check_leaves(p, solve_by(p, KOKSMA_STAR_TREE), (uint64_t)_i);
    check_same(solve_by(p, KOKSMA_STAR_LINES), solve_with(p, leaves[3]), p, 0);
    free(x);
}
END_TEST

/* Hammersley's points (i/2^m, phi_2(i)): 2^m D* = m/3 + 13/9 - (-1)^m 4/(9 2^m) for
 * m >= 2 [Halton, Zaremba 1969; De Clerck 1986].  Over 9*4^m this is an integer. */
static void check_hammersley(unsigned m)
{
    size_t n = (size_t)1 << m;
    double *x = malloc(2 * n * sizeof *x);
    long double value;
    answer a;

    ck_assert_ptr_nonnull(x);
    for (size_t i = 0; i < n; i++) {
        double y = 0.0, digit = 0.5;

        for (size_t rest = i; rest > 0; rest >>= 1, digit /= 2)
            if (rest & 1) y += digit;
        x[2 * i] = (double)i / (double)n;
        x[2 * i + 1] = y;
    }
    a = solve_by((koksma_points){x, n, 2}, KOKSMA_STAR_LINES);
    value = (m * 3.0L + 13.0L) * (long double)n + (m % 2 == 0 ? -4.0L : 4.0L);
    value /= 9.0L * (long double)n * (long double)n;
    ck_assert_msg(fabsl((long double)a.value.lower - value) <= 2e-16L * value,
                  "m = %u", m);
    ck_assert(a.value.upper - a.value.lower <= 3e-16 * a.value.upper);
    free(x);
}

START_TEST(hammersley)
{
    for (unsigned m = 2; m <= 14; m++)
        check_hammersley(m);
    check_hammersley(17); /* ranks beyond 16 bits */
}
END_TEST

START_TEST(hammersley_large)
{
    check_hammersley(19);
    check_hammersley(20);
}
END_TEST

/* Lattices (i/F, {i G/F}) of Fibonacci numbers: values by the algorithm of [Dobkin,
 * Eppstein, Mitchell 1996], another program. */
static const struct {
    size_t f, g;
    double value;
} fibonacci[] = {{55, 34, 0.0449586777},
                 {144, 89, 0.0200617284},
                 {610, 377, 0.0055173340},
                 {1597, 987, 0.0022623822},
                 {2584, 1597, 0.0014208358}};

START_TEST(fibonacci_lattices)
{
    static double x[NUMBERS];

    for (size_t i = 0; i < fibonacci[_i].f; i++) {
        x[2 * i] = (double)i / (double)fibonacci[_i].f;
        x[2 * i + 1] = (double)(i * fibonacci[_i].g % fibonacci[_i].f) /
                       (double)fibonacci[_i].f;
    }

    koksma_points p = {x, fibonacci[_i].f, 2};
    answer a = solve_by(p, KOKSMA_STAR_LINES);

    ck_assert(fabs(a.value.lower - fibonacci[_i].value) <= 5.1e-11);
    check_leaves(p, a, 0);
}
END_TEST

/* The m^dim points with coordinates (j + shift)/m have 1 - (1 - (1 - shift)/m)^dim
 * for shift 0 and 1/2: the closed box that the last of them spans misses 1 by that.
 */
START_TEST(grids)
{
    static double x[NUMBERS];

    for (size_t dim = 2; dim <= 3; dim++)
        for (size_t m = 1; m <= (dim == 2 ? 64 : 12); m += 1 + m / 8)
            for (int half = 0; half < 2; half++) {
                size_t n = dim == 2 ? m * m : m * m * m;
                double shift = 0.5 * half;
                long double side = 1.0L - (1.0L - (long double)shift) / m, value;

                for (size_t i = 0; i < n; i++)
                    for (size_t k = 0, rest = i; k < dim; k++, rest /= m)
                        x[i * dim + k] = ((double)(rest % m) + shift) / (double)m;

                answer a = solve_by((koksma_points){x, n, dim}, KOKSMA_STAR_LINES);

                value = 1.0L - side * side * (dim == 2 ? 1.0L : side);
                ck_assert_msg(fabsl((long double)a.value.lower - value) <= 4e-16L,
                              "m %zu dim %zu", m, dim);
            }
}
END_TEST

/* On a line, where the sweep sorts and no more, the first N points of van der
 * Corput have N D* = sum over r >= 1 of the distance of N/2^r to the nearest
 * integer. Crowded into [0, 2^-40) they go the other way through the sort; the
 * empty rest then has D* = 1 - x for the last of them, x. */
START_TEST(van_der_corput_sorted)
{
    static double x[40000];

    for (size_t n = 1; n <= 40000; n = n * 3 + 1) {
        long double sum = 0.0L, last = 0.0L;

        for (size_t i = 0; i < n; i++) {
            x[i] = 0.0;
            for (size_t rest = i, bit = 1; rest > 0; rest >>= 1, bit++)
                x[i] += ldexp((double)(rest & 1), -(int)bit);
            last = fmaxl(last, (long double)x[i]);
        }
        for (int r = 1; r < 64; r++) {
            long double part = ldexpl((long double)n, -r);

            sum += fabsl(part - roundl(part));
        }

        answer a = solve_by((koksma_points){x, n, 1}, KOKSMA_STAR_SWEEP);

        ck_assert(fabsl((long double)a.value.lower - sum / n) <= 2e-16L);
        for (size_t i = 0; i < n; i++)
            x[i] = ldexp(x[i], -40);
        a = solve_by((koksma_points){x, n, 1}, KOKSMA_STAR_SWEEP);
        ck_assert(fabsl((long double)a.value.lower - (1.0L - ldexpl(last, -40))) <=
                  2e-16L);
    }
}
END_TEST

/* Halton's points in a thousandth of the square, and spread over 300 powers of 2.
 */
START_TEST(crowded_and_geometric)
{
    size_t n = 2000;
    double *x = generate("halton", 2, n, 1);

    for (size_t i = 0; i < 2 * n; i++)
        x[i] = 0.5 + ldexp(x[i], -30);
    check_leaves((koksma_points){x, n, 2},
                 solve_by((koksma_points){x, n, 2}, KOKSMA_STAR_SWEEP), 0);
    for (size_t i = 0; i < 2 * n; i++)
        x[i] = ldexp(1.0, -(int)(i * 7919 % 300)) * (x[i] - 0.25);
    check_leaves((koksma_points){x, n, 2},
                 solve_by((koksma_points){x, n, 2}, KOKSMA_STAR_SWEEP), 1);
    free(x);
}
END_TEST

static void swap(double *a, double *b)
{
    double keep = *a;

    *a = *b;
    *b = keep;
}

START_TEST(order_is_nothing)
{
    for (size_t dim = 2; dim <= 3; dim++) {
        size_t n = dim == 2 ? 5000 : 700;
        double *x = generate("halton", dim, n, 1);
        koksma_points p = {x, n, dim};
        oracle_rng rng = oracle_rng_start(oracle_seed(), dim);
        answer a = solve_by(p, KOKSMA_STAR_LINES), b;

        for (size_t i = n; i > 1; i--) {
            size_t j = oracle_below(&rng, i);

            for (size_t k = 0; k < dim; k++)
                swap(&x[(i - 1) * dim + k], &x[j * dim + k]);
        }
        check_same(a, solve_by(p, KOKSMA_STAR_LINES), p, 0);
        for (size_t turn = 1; turn < dim; turn++) {
            for (size_t i = 0; i < n; i++)
                for (size_t k = 1; k < dim; k++)
                    swap(&x[i * dim], &x[i * dim + k]);
            b = solve_by(p, KOKSMA_STAR_LINES);
            ck_assert(fabs(a.value.lower - b.value.lower) <= 3e-16);
        }
        free(x);
    }
}
END_TEST

typedef struct watch {
    size_t calls, stop_at;
    double lower, upper;
    bool fair;
} watch;

static int look(void *state, double lower, double upper, double work)
{
    watch *w = state;

    if (!(lower >= w->lower && upper <= w->upper && lower <= upper && work > 0.0))
        w->fair = false;
    w->lower = lower;
    w->upper = upper;
    return ++w->calls == w->stop_at;
}

/* Ties everywhere: the count of the witness is right all the same. */
START_TEST(stopped_early)
{
    size_t dim = 2 + (size_t)_i % 2, n = dim == 2 ? 200000 : 6000;
    double *x = generate("halton", dim, n, 1);
    koksma_points p = {x, n, dim};
    watch seen = {0, 1, 0.0, 1.0, true};
    koksma_star_opts opts = {.method = KOKSMA_STAR_LINES,
                             .anytime = _i >= 2,
                             .progress = look,
                             .state = &seen};
    double corner[3];
    koksma_star_result r = {.witness.corner = corner};

    for (size_t i = 0; i < n * dim; i += 2)
        x[i] = floor(x[i] * 4096.0) / 4096.0;
    ck_assert_int_eq(koksma_star(&r, p, &opts, NULL), KOKSMA_STOPPED);
    ck_assert_uint_eq(seen.calls, 1);
    ck_assert(seen.fair && r.value.lower >= seen.lower);
    ck_assert(r.value.upper <= seen.upper);
    ck_assert_uint_eq(r.witness.inside, oracle_count(p, corner, r.witness.closed));
    ck_assert(koksma_box_local(&r.witness, p).lower >= r.value.lower);
    opts.progress = NULL;
    opts.work = 1.0;
    ck_assert_int_eq(koksma_star(&r, p, &opts, NULL), KOKSMA_STOPPED);
    free(x);
}
END_TEST

START_TEST(tolerance_is_kept)
{
    static const double tolerances[] = {0.0, 0.02, 0.3, 2.0};
    static double x[NUMBERS];

    for (uint64_t round = 0; round < 60 * oracle_scale(); round++) {
        koksma_points p = make_set(x, round, 2 + (round / KINDS) % 2, 200);
        answer exact = solve_with(p, leaves[2]);

        for (int i = 0; i < 8; i++) {
            double e = tolerances[i / 2], corner[3];
            koksma_star_result r = {.witness.corner = corner};
            koksma_star_opts opts = {
                .method = KOKSMA_STAR_LINES, .tolerance = e, .anytime = i % 2 == 1};

            ck_assert_int_eq(koksma_star(&r, p, &opts, NULL), KOKSMA_OK);
            ck_assert(r.value.lower <= exact.value.lower);
            ck_assert(r.value.upper >= exact.value.upper);
            ck_assert(r.value.upper <= (1.0 + e) * r.value.lower ||
                      r.value.upper <= exact.value.upper);
            ck_assert(koksma_box_local(&r.witness, p).lower >= r.value.lower);
            if (e == 0.0) ck_assert_mem_eq(corner, exact.corner, p.dim * 8);
        }
    }
}
END_TEST

START_TEST(refused_dims)
{
    static const double x[] = {0.1, 0.2, 0.3, 0.4};
    koksma_star_opts opts = {.method = KOKSMA_STAR_LINES};

    for (size_t dim = 1; dim <= 4; dim += 3) {
        koksma_star_result r = {.witness.corner = NULL};
        koksma_error err = {0};

        ck_assert_int_eq(koksma_star(&r, (koksma_points){x, 1, dim}, &opts, &err),
                         KOKSMA_EINVAL);
        ck_assert_ptr_nonnull(strstr(err.text, "2 or 3 coordinates"));
    }
}
END_TEST

static TCase *tests_named(Suite *suite, const char *name)
{
    TCase *tc = tcase_create(name);

    tcase_set_timeout(tc, 20.0 * (double)oracle_scale());
    suite_add_tcase(suite, tc);
    return tc;
}

int main(void)
{
    Suite *suite = suite_create("star_lines");
    TCase *tc = tests_named(suite, "many");

    tcase_set_tags(tc, "slow");
    tcase_add_loop_test(tc, as_the_sweep_says, 0, sizeof shapes / sizeof *shapes);
    tc = tests_named(suite, "small");
    tcase_add_test(tc, as_the_definition_says);
    tc = tests_named(suite, "large");
    tcase_add_loop_test(tc, as_the_tree_says, 0, sizeof large / sizeof *large);
    tcase_add_test(tc, hammersley);
    tcase_add_loop_test(tc, fibonacci_lattices, 0,
                        sizeof fibonacci / sizeof *fibonacci);
    tcase_add_test(tc, grids);
    tcase_add_test(tc, van_der_corput_sorted);
    tcase_add_test(tc, crowded_and_geometric);
    tcase_add_test(tc, order_is_nothing);
    tc = tests_named(suite, "calls");
    tcase_add_loop_test(tc, stopped_early, 0, 4);
    tcase_add_test(tc, tolerance_is_kept);
    tcase_add_test(tc, refused_dims);
    tc = tests_named(suite, "beyond");
    tcase_set_tags(tc, "big");
    tcase_add_test(tc, hammersley_large);
    return oracle_run(suite);
}
