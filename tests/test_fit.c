/* fit.h: laws that are known, a plain jackknife by normal equations, every rule
 * that leaves an N out, and whether intervals cover. */
#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "curve.h"
#include "fit.h"
#include "gen.h"
#include "integrand.h"
#include "num_kernels.h"
#include "oracle.h"

enum { SETS = 64, LEVELS = 30, ROWS = SETS * LEVELS };

/* A table as koksma-fit reads it, and how to make it again. */
typedef struct table {
    double x[ROWS], y[ROWS];
    size_t set[ROWS], rows, sets;
} table;

static table data;

static void add(table *t, double x, size_t set, double y)
{
    if (t->rows == ROWS) abort();
    t->x[t->rows] = x;
    t->set[t->rows] = set;
    t->y[t->rows++] = y;
    if (set >= t->sets) t->sets = set + 1;
}

static koksma_status try_fit(koksma_fit_result *f, const table *t,
                             const koksma_fit_opts *o, koksma_error *err)
{
    return koksma_fit(f, (koksma_fit_data){t->x, t->y, t->set, t->rows, t->sets}, o,
                      err);
}

static koksma_fit_result fit(const table *t, const koksma_fit_opts *o)
{
    koksma_fit_result f;
    koksma_error err = {0};
    koksma_status status = try_fit(&f, t, o, &err);

    ck_assert_msg(status == KOKSMA_OK, "%s", err.text);
    return f;
}

static double normal(oracle_rng *rng)
{
    double u = 1.0 - oracle_dyadic(rng, 53), v = oracle_dyadic(rng, 53);

    return sqrt(-2.0 * log(u)) * cos(2.0 * acos(-1.0) * v);
}

/* Errors at 2^(i/2) rounded, i from 6 on, of paths that hang together: what is
 * left after N^exponent is a stationary walk in ln N. */
static void random_table(table *t, oracle_rng *rng, size_t sets, size_t levels,
                         double exponent)
{
    t->rows = t->sets = 0;
    for (size_t r = 0; r < sets; r++) {
        double z = normal(rng);

        for (size_t i = 0; i < levels; i++) {
            double n = rint(exp2((double)(i + 6) / 2.0));

            add(t, n, r, pow(n, exponent) * z);
            z = 0.7 * z + sqrt(1.0 - 0.49) * normal(rng);
        }
    }
}

/* The coefficient of u^(terms - 1) in the least-squares polynomial through (u, y),
 * by elimination in the normal equations. */
static long double top_coefficient(const long double *u, const long double *y,
                                   size_t count, size_t terms)
{
    long double a[3][4] = {{0.0L}};

    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < terms; j++) {
            for (size_t k = 0; k < terms; k++)
                a[j][k] += powl(u[i], (long double)(j + k));
            a[j][terms] += powl(u[i], (long double)j) * y[i];
        }
    for (size_t j = 0; j < terms; j++)
        for (size_t l = j + 1; l < terms; l++) {
            long double f = a[l][j] / a[j][j];

            for (size_t k = j; k <= terms; k++)
                a[l][k] -= f * a[j][k];
        }
    return a[terms - 1][terms] / a[terms - 1][terms - 1];
}

/* Of a full table in the order of random_table, without replicate `left`. */
static long double refit(const table *t, size_t left, size_t terms)
{
    long double u[LEVELS], y[LEVELS], mean = 0.0L;
    size_t levels = t->rows / t->sets;

    for (size_t i = 0; i < levels; i++) {
        long double sum = 0.0L;

        for (size_t r = 0; r < t->sets; r++)
            if (r != left) sum += powl((long double)t->y[r * levels + i], 2.0L);
        u[i] = logl((long double)t->x[i]);
        y[i] = logl(sum / (long double)(t->sets - (left < t->sets))) / 2.0L;
        mean += u[i] / (long double)levels;
    }
    for (size_t i = 0; i < levels; i++)
        u[i] -= mean;
    return top_coefficient(u, y, levels, terms);
}

static void check_estimate(koksma_estimate e, double se, const table *t,
                           size_t terms, double level)
{
    long double mean = 0.0L, spread = 0.0L, m = (long double)t->sets, want;
    double reach = ki_student_quantile(level, t->sets - 1);

    for (size_t r = 0; r < t->sets; r++)
        mean += refit(t, r, terms) / m;
    for (size_t r = 0; r < t->sets; r++)
        spread += powl(refit(t, r, terms) - mean, 2.0L);
    want = sqrtl((m - 1.0L) / m * spread);
    ck_assert_double_eq_tol(e.value, (double)refit(t, t->sets, terms), 1e-12);
    ck_assert_double_eq_tol(se / (double)want, 1.0, 1e-10);
    ck_assert_double_eq_tol(e.value - e.lower, reach * se, 1e-14 * (1.0 + reach));
    ck_assert_double_eq_tol(e.upper - e.value, reach * se, 1e-14 * (1.0 + reach));
    ck_assert_double_eq(e.level, level);
}

START_TEST(plain_jackknife)
{
    for (uint64_t round = 0; round < 40; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        koksma_fit_opts o = {.level = round % 2 == 0 ? 0.0 : 0.8};
        koksma_fit_result f;
        double level = round % 2 == 0 ? 0.95 : 0.8;

        random_table(&data, &rng, 2 + oracle_below(&rng, 20),
                     3 + oracle_below(&rng, 20), -oracle_dyadic(&rng, 8));
        f = fit(&data, round == 0 ? NULL : &o);
        ck_assert_uint_eq(f.sets, data.sets);
        ck_assert_uint_eq(f.used, data.rows / data.sets);
        ck_assert(f.dropped == 0 && f.from == 8.0);
        ck_assert(f.to == data.x[data.rows - 1]);
        check_estimate(f.exponent, f.exponent_se, &data, 2, level);
        check_estimate(f.curvature, f.curvature_se, &data, 3, level);
    }
}
END_TEST

/* y = (1 + set) N^s: no replicate differs in slope, and no interval has a width. */
START_TEST(power_laws)
{
    static const double exponents[] = {-0.75, -2.0 / 3.0, -0.5, -1.0,
                                       0.0,   1.25,       -7.0};

    for (size_t sets = 1; sets <= 3; sets++)
        for (size_t i = 0; i < sizeof exponents / sizeof *exponents; i++) {
            double s = exponents[i], rms = 0.0;
            koksma_fit_result f;

            data.rows = data.sets = 0;
            for (size_t r = 0; r < sets; r++) {
                rms += pow((double)(r + 1), 2.0) / (double)sets;
                for (double n = 8.0; n <= 1024.0; n = floor(n * 1.5))
                    add(&data, n, r,
                        (r % 2 ? 3.0 : -3.0) * (double)(r + 1) * pow(n, s));
            }
            f = fit(&data, NULL);
            ck_assert_double_eq_tol(f.exponent.value, s, 1e-12);
            ck_assert_double_eq_tol(f.curvature.value, 0.0, 1e-12);
            ck_assert_double_eq_tol(f.constant / (3.0 * sqrt(rms)), 1.0, 1e-12);
            ck_assert(f.used == data.rows / sets && f.sets == sets);
            if (sets > 1) {
                ck_assert_double_lt(f.exponent_se, 1e-12);
                ck_assert(f.exponent.lower <= f.exponent.value &&
                          f.exponent.upper >= f.exponent.value);
                continue;
            }
            ck_assert(isnan(f.exponent_se) && isnan(f.curvature_se));
            ck_assert(isnan(f.exponent.lower) && isnan(f.exponent.upper));
            ck_assert(isnan(f.curvature.lower) && isnan(f.curvature.upper));
            ck_assert(f.exponent.level == 0.0 && f.curvature.level == 0.0);
            ck_assert_int_eq(koksma_fit_compare(&f, s, 1.0).verdict,
                             KOKSMA_NO_VERDICT);
            ck_assert(isnan(koksma_fit_compare(&f, s, 1.0).t));
        }
}
END_TEST

/* ln y = 1 - u/2 + q u^2 with u = ln N less its mean: the line has the slope of
 * the polynomial at the mean, since these N lie evenly about it. */
START_TEST(quadratics)
{
    for (double q = -0.05; q < 0.06; q += 0.025) {
        koksma_fit_result f;

        data.rows = data.sets = 0;
        for (int i = 3; i <= 17; i++) {
            double u = (i - 10) * log(2.0);

            add(&data, exp2(i), 0, exp(1.0 - u / 2.0 + q * u * u));
        }
        f = fit(&data, NULL);
        ck_assert_double_eq_tol(f.curvature.value, q, 1e-12);
        ck_assert_double_eq_tol(f.exponent.value, -0.5, 1e-12);
    }
}
END_TEST

static void spoil(table *t, double x, size_t sets, double y)
{
    for (size_t i = 0; i < t->rows; i++)
        if (t->x[i] == x && t->set[i] < sets) t->y[i] = y;
}

static void forget(table *t, double x, size_t set)
{
    size_t kept = 0;

    for (size_t i = 0; i < t->rows; i++) {
        if (t->x[i] == x && t->set[i] == set) continue;
        t->x[kept] = t->x[i];
        t->y[kept] = t->y[i];
        t->set[kept++] = t->set[i];
    }
    t->rows = kept;
}

static bool same_line(koksma_fit_result a, koksma_fit_result b)
{
    return a.exponent.value == b.exponent.value && a.exponent_se == b.exponent_se &&
           a.curvature.value == b.curvature.value &&
           a.curvature_se == b.curvature_se && a.used == b.used;
}

/* Rows at N = 32 of the replicates below `count` become y, or go; is N dropped? */
static const struct drop {
    size_t sets, count;
    double y; /* NaN: no row */
    size_t dropped;
} drops[] =
    {
        {8, 4, 0.0, 0}, /* half of them have an error that is not 0 */
        {8, 5, 0.0, 1}, /* fewer */
        {7, 3, 0.0, 0},         {7, 4, 0.0, 1},
        {2, 1, 0.0, 1}, /* all but one are 0 */
        {3, 1, 0.0, 0},         {3, 2, 0.0, 1},
        {8, 8, 0.0, 1},         {1, 1, 0.0, 1},
        {8, 1, (double)NAN, 1}, /* a replicate has no error there */
        {8, 7, (double)NAN, 1}, {8, 8, (double)NAN, 0}, /* then there is no N */
        {8, 8, 0x1.8p-50, 0},   {8, 8, 0x1.8p-51, 1},   /* where rounding speaks */
        {1, 1, 0x1.8p-50, 0},   {1, 1, -0x1.8p-51, 1},
};

START_TEST(left_out)
{
    const struct drop *d = &drops[_i];
    koksma_fit_opts o = KOKSMA_FIT_DEFAULTS;
    oracle_rng rng = oracle_rng_start(oracle_seed(), 3);
    koksma_fit_result f;
    static table without;

    random_table(&data, &rng, d->sets, 12, -0.75);
    spoil(&data, 8.0, d->sets, 1.0); /* the largest error in the data */
    for (size_t i = 0; i < data.rows; i++)
        data.y[i] = fmax(fmin(data.y[i], 1.0), -1.0);
    without = data;
    for (size_t r = 0; r < d->sets; r++)
        forget(&without, 32.0, r);
    if (isnan(d->y))
        for (size_t r = 0; r < d->count; r++)
            forget(&data, 32.0, r);
    else
        spoil(&data, 32.0, d->count, d->y);
    f = fit(&data, &o);
    ck_assert_msg(f.dropped == d->dropped, "case %d: %zu", _i, f.dropped);
    ck_assert_uint_eq(f.used, d->count == 8 && isnan(d->y) ? 11 : 12 - d->dropped);
    if (d->dropped == 1 && d->sets > 1) ck_assert(same_line(f, fit(&without, &o)));
    o.from = 45.0; /* what is outside the window is not dropped */
    f = fit(&data, &o);
    ck_assert(f.dropped == 0 && f.used == 7 && f.from == 45.0 && f.to == 362.0);
}
END_TEST

/* Both ends are included; from is 8 unless told. */
START_TEST(windows_used)
{
    static const struct {
        double from, to, first, last;
        size_t used;
    } windows[] = {
        {0.0, 0.0, 8.0, 1024.0, 15},    {8.0, 1024.0, 8.0, 1024.0, 15},
        {8.5, 1023.0, 11.0, 724.0, 13}, {1.0, 0.0, 1.0, 1024.0, 20},
        {0.5, 3.5, 1.0, 3.0, 3},        {512.0, 1e300, 512.0, 1024.0, 3},
    };
    koksma_fit_opts o = KOKSMA_FIT_DEFAULTS;

    data.rows = data.sets = 0;
    for (int i = 0; i <= 20; i += i == 0 ? 2 : 1) /* 1, 2, 3, 4, 6, 8, 11, ... */
        add(&data, rint(exp2(i / 2.0)), 0, exp2(-i / 4.0 - 0.001 * i * i));
    for (size_t w = 0; w < sizeof windows / sizeof *windows; w++) {
        o.from = windows[w].from;
        o.to = windows[w].to;

        koksma_fit_result f = fit(&data, &o);

        ck_assert(f.from == windows[w].first && f.to == windows[w].last);
        ck_assert(f.used == windows[w].used && f.dropped == 0);
    }
}
END_TEST

/* The order of rows, the sign of errors and their unit are nothing, to the bit;
 * which replicate is called 0 moves roundings alone. */
START_TEST(invariances)
{
    static table changed;

    for (uint64_t round = 0; round < 20; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        koksma_fit_result f, g;
        int shift = (int)oracle_below(&rng, 1900) - 950;

        random_table(&data, &rng, 2 + oracle_below(&rng, 9), 12, -0.6);
        f = fit(&data, NULL);
        changed = data;
        for (size_t i = data.rows; i > 1; i--) {
            size_t j = oracle_below(&rng, i);
            table *t = &changed;
            double x = t->x[i - 1], y = t->y[i - 1];
            size_t set = t->set[i - 1];

            t->x[i - 1] = t->x[j], t->y[i - 1] = t->y[j];
            t->set[i - 1] = t->set[j];
            t->x[j] = x, t->y[j] = -y, t->set[j] = set;
        }
        g = fit(&changed, NULL);
        ck_assert(same_line(f, g) && f.constant == g.constant);
        for (size_t i = 0; i < data.rows; i++)
            changed.y[i] = ldexp(changed.y[i], shift);
        g = fit(&changed, NULL);
        ck_assert(same_line(f, g));
        ck_assert_double_eq_tol(ldexp(g.constant, -shift) / f.constant, 1.0, 1e-15);
        changed = data;
        for (size_t i = 0; i < data.rows; i++)
            changed.set[i] = (data.set[i] + 1 + round) % data.sets;
        g = fit(&changed, NULL);
        ck_assert_double_eq_tol(g.exponent.value, f.exponent.value, 1e-13);
        ck_assert_double_eq_tol(g.exponent_se / f.exponent_se, 1.0, 1e-11);
        ck_assert_double_eq_tol(g.curvature_se / f.curvature_se, 1.0, 1e-11);
    }
}
END_TEST

static void check_refused(const table *t, const koksma_fit_opts *o,
                          koksma_status want, const char *text)
{
    koksma_fit_result f, before;
    koksma_error err = {0};

    memset(&f, 0x5a, sizeof f);
    memcpy(&before, &f, sizeof f);
    ck_assert_int_eq(try_fit(&f, t, o, &err), want);
    ck_assert_int_eq(err.status, want);
    ck_assert_msg(strstr(err.text, text) != NULL, "%s", err.text);
    ck_assert_int_eq(try_fit(&f, t, o, NULL), want);
    ck_assert_mem_eq(&f, &before, sizeof f);
}

START_TEST(refused)
{
    static const koksma_fit_opts bad_opts[] = {
        {.level = 1.0},      {.level = -0.1},        {.level = (double)NAN},
        {.from = -1.0},      {.to = -1.0},           {.from = (double)NAN},
        {.to = (double)NAN}, {.from = 50, .to = 20},
    };
    static const double bad_x[] = {0.0, -8.0, (double)NAN, (double)INFINITY};
    static const double bad_y[] = {(double)NAN, -(double)INFINITY};
    oracle_rng rng = oracle_rng_start(oracle_seed(), 3);
    table *t = &data;

    random_table(t, &rng, 3, 12, -0.75);
    for (size_t i = 0; i < sizeof bad_opts / sizeof *bad_opts; i++)
        check_refused(t, &bad_opts[i], KOKSMA_EINVAL, "");
    check_refused(t, &(koksma_fit_opts){.from = 8, .to = 12}, KOKSMA_EINVAL,
                  "2 usable N in the window, 0 dropped: a fit takes 3");
    for (size_t i = 0; i < 4; i++) {
        t->x[5] = bad_x[i];
        check_refused(t, NULL, KOKSMA_EDOMAIN, "row 6");
    }
    t->x[5] = t->x[4];
    check_refused(t, NULL, KOKSMA_EDOMAIN, "set 1 has two errors at N = 32");
    random_table(t, &rng, 3, 12, -0.75);
    for (size_t i = 0; i < 2; i++) {
        t->y[7] = bad_y[i];
        check_refused(t, NULL, KOKSMA_EDOMAIN, "row 8");
    }
    t->y[7] = 1.0;
    t->set[9] = 3;
    check_refused(t, NULL, KOKSMA_EINVAL, "row 10 is of set 4, but there are 3");
    t->set[9] = 0;
    fit(t, NULL);
    for (size_t i = 0; i < t->rows; i++)
        t->x[i] = 0x1p52 + t->x[i]; /* of which all logarithms are equal */
    check_refused(t, NULL, KOKSMA_EINVAL, "too close to each other for a slope");
    for (size_t i = 0; i < t->rows; i++)
        t->x[i] -= 0x1p52;
    t->sets = 4; /* one that has no errors at all */
    check_refused(t, NULL, KOKSMA_EINVAL, "12 dropped");
    t->sets = SIZE_MAX;
    check_refused(t, NULL, KOKSMA_ENOMEM, "memory");
    t->sets = 3;
    for (size_t i = 0; i < t->rows; i++)
        t->y[i] = 0.0;
    check_refused(t, NULL, KOKSMA_EINVAL, "0 usable N");
    t->rows = 0;
    check_refused(t, NULL, KOKSMA_EINVAL, "0 usable N");
}
END_TEST

/* sets 32: the two one-sided tests at 5 % reach 1.6955 se to either side. */
START_TEST(verdicts)
{
    static const struct {
        double value, se, reach, candidate, margin;
        koksma_verdict want;
    } cases[] = {
        {-0.75, 0.02, 0.041, -0.75, 0.05, KOKSMA_EQUIVALENT},
        {-0.75, 0.02, 0.041, -0.76, 0.0440, KOKSMA_EQUIVALENT}, /* 0.04391 */
        {-0.75, 0.02, 0.041, -0.76, 0.0438, KOKSMA_UNDECIDED},
        {-0.75, 0.02, 0.041, -0.74, 0.0440, KOKSMA_EQUIVALENT},
        {-0.75, 0.02, 0.041, -0.74, 0.0438, KOKSMA_UNDECIDED},
        {-0.75, 0.02, 0.041, -0.70, 0.05, KOKSMA_DIFFERENT},
        {-0.75, 0.02, 0.041, -0.80, 0.05, KOKSMA_DIFFERENT},
        {-0.75, 0.02, 0.041, -0.7091, 0.05, KOKSMA_UNDECIDED},
        {-0.75, 0.02, 0.041, -0.7909, 0.05, KOKSMA_UNDECIDED},
        {-0.75, 0.02, 0.041, -0.7089, 0.05, KOKSMA_DIFFERENT},
        {-0.75, 0.2, 0.41, -0.5, 0.05, KOKSMA_UNDECIDED},
        {-0.75, 0.001, 0.002, -0.74, 0.05, KOKSMA_EQUIVALENT}, /* both hold */
        {-0.75, 0.001, 0.002, -0.5, 0.05, KOKSMA_DIFFERENT},
    };

    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double v = cases[i].value, reach = cases[i].reach;
        koksma_fit_result f = {.exponent = {v, v - reach, v + reach, 0.95},
                               .exponent_se = cases[i].se,
                               .sets = 32};
        koksma_comparison c =
            koksma_fit_compare(&f, cases[i].candidate, cases[i].margin);

        ck_assert_msg(c.verdict == cases[i].want, "case %zu: %d", i,
                      (int)c.verdict);
        ck_assert_double_eq_tol(c.t, (v - cases[i].candidate) / cases[i].se, 1e-12);
    }
    ck_assert(koksma_fit_theory(1) == -1.0 && koksma_fit_theory(2) == -0.75);
    ck_assert_double_eq_tol(koksma_fit_theory(3), -2.0 / 3.0, 1e-16);
    ck_assert(koksma_fit_theory(8) == -0.5625);
}
END_TEST

/* How many of the intervals hold the exponent that made the data. */
START_TEST(coverage)
{
    size_t held = 0, held_80 = 0, bends = 0, trials = 1000;
    koksma_fit_opts eighty = {.level = 0.8};

    for (uint64_t round = 0; round < trials; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        koksma_fit_result f;

        random_table(&data, &rng, 16, 24, -0.75);
        f = fit(&data, NULL);
        held += f.exponent.lower <= -0.75 && f.exponent.upper >= -0.75;
        bends += f.curvature.lower <= 0.0 && f.curvature.upper >= 0.0;
        f = fit(&data, &eighty);
        held_80 += f.exponent.lower <= -0.75 && f.exponent.upper >= -0.75;
    }
    ck_assert_msg(held > 920 && held < 980, "%zu of 1000 at 95 %%", held);
    ck_assert_msg(bends > 920 && bends < 985, "%zu curvatures", bends);
    ck_assert_msg(held_80 > 750 && held_80 < 850, "%zu of 1000 at 80 %%", held_80);
}
END_TEST

/* One replicate's errors for f2 with a = 0. */
static void add_path(table *t, koksma_curve *c, uint64_t seed, size_t replicate)
{
    static double x[2 << 17], f[1 << 17];
    const koksma_gen_opts o = {.dim = 2,
                               .n = 1 << 17,
                               .seed = seed,
                               .scramble = KOKSMA_SCRAMBLE_DIGITS,
                               .replicate = replicate};
    const koksma_curve_row *row;
    size_t count;
    koksma_integrand f2;
    koksma_gen *g;

    ck_assert_int_eq(koksma_gen_open(&g, koksma_gen_find("halton"), &o, NULL), 0);
    ck_assert_int_eq(koksma_gen_fill(g, x, 0, 1 << 17, NULL), 0);
    koksma_gen_close(g);
    ck_assert_int_eq(koksma_integrand_make(&f2, NULL, koksma_integrand_find("f2"),
                                           0, NULL, NULL),
                     0);
    ck_assert_int_eq(
        koksma_integrand_eval(f, &f2, (koksma_points){x, 1 << 17, 2}, NULL), 0);
    koksma_curve_begin(c, 0.5);
    koksma_curve_add(c, f, 1, 1 << 17);
    ck_assert_int_eq(koksma_curve_rows(c, &row, &count, NULL), 0);
    for (size_t j = 0; j < count; j++)
        add(t, (double)row[j].n, replicate, row[j].error);
}

/* The library from end to end: does a jump in the plane cost N^-3/4? */
START_TEST(jump_in_the_plane)
{
    size_t held = 0, trials = 100;
    double widest = 0.0, mean = 0.0;
    koksma_curve *c;

    ck_assert_int_eq(koksma_curve_open(&c, 2, NULL), KOKSMA_OK);
    for (uint64_t seed = 0; seed < trials; seed++) {
        koksma_fit_result f;

        data.rows = data.sets = 0;
        for (size_t r = 0; r < 32; r++)
            add_path(&data, c, seed, r);
        f = fit(&data, NULL);
        held += f.exponent.lower <= -0.75 && f.exponent.upper >= -0.75;
        widest = fmax(widest, f.exponent.upper - f.exponent.lower);
        mean += f.exponent.value / (double)trials;
    }
    koksma_curve_close(c);
    ck_assert_msg(held >= 88 && widest < 0.1 && fabs(mean + 0.75) < 0.01,
                  "%zu of 100, mean %g, widest %g", held, mean, widest);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fit");
    TCase *tc = tcase_create("lines");

    suite_add_tcase(suite, tc);
    tcase_add_test(tc, power_laws);
    tcase_add_test(tc, quadratics);
    tcase_add_test(tc, plain_jackknife);
    tcase_add_loop_test(tc, left_out, 0, sizeof drops / sizeof *drops);
    tcase_add_test(tc, windows_used);
    tcase_add_test(tc, invariances);
    tcase_add_test(tc, refused);
    tcase_add_test(tc, verdicts);

    tc = tcase_create("coverage");
    suite_add_tcase(suite, tc);
    tcase_set_tags(tc, "big");
    tcase_set_timeout(tc, 600.0);
    tcase_add_test(tc, coverage);
    tcase_add_test(tc, jump_in_the_plane);
    return oracle_run(suite);
}
