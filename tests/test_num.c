/* num_kernels.h: sums, products and Student's t, against long integers of this
 * file's own, in which nothing rounds. */
#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "num_exact.h"
#include "num_kernels.h"
#include "num_twice.h"
#include "oracle.h"

/* Room for a product of 1000 doubles between 2^-30 and 1, or of 70 denormals. */
enum { LIMBS = 3000, DIMS = 1000 };

/* Below every exponent of a double's last bit, with room for a bound's 2^-110. */
static const long LOWEST = -1300;

/* A natural number in base 2^32, the least digit first; those beyond are 0. */
typedef struct nat {
    size_t used;
    uint32_t limb[LIMBS];
} nat;

/* More points than these are not counted. */
enum { N_BITS = SIZE_MAX > UINT32_MAX ? 51 : 31 };
static const size_t N_MOST = (size_t)1 << N_BITS;

/* (pos - neg) * 2^exp */
typedef struct exact {
    long exp;
    nat pos, neg;
} exact;

static void nat_set(nat *a, uint64_t v)
{
    memset(a->limb, 0, a->used * sizeof a->limb[0]);
    for (a->used = 0; v > 0; v >>= 32)
        a->limb[a->used++] = (uint32_t)v;
}

static void nat_times(nat *a, uint64_t m)
{
    oracle_int carry = 0;

    for (size_t i = 0; i < a->used || carry > 0; i++, carry >>= 32) {
        if (i >= LIMBS) abort();
        carry += (oracle_int)a->limb[i] * m;
        a->limb[i] = (uint32_t)carry;
        if (i >= a->used) a->used = i + 1;
    }
}

/* a += b * 2^shift */
static void nat_add(nat *a, const nat *b, size_t shift)
{
    uint64_t carry = 0;

    for (size_t i = 0, at = shift / 32; i < b->used || carry > 0; i++, at++) {
        if (at >= LIMBS) abort();
        carry += a->limb[at];
        if (i < b->used) carry += (uint64_t)b->limb[i] << shift % 32;
        a->limb[at] = (uint32_t)carry;
        carry >>= 32;
        if (at >= a->used) a->used = at + 1;
    }
}

static void exact_clear(exact *e, long exp)
{
    e->exp = exp;
    nat_set(&e->pos, 0);
    nat_set(&e->neg, 0);
}

static void exact_add(exact *e, const nat *b, long exp, bool negative)
{
    if (exp < e->exp) abort();
    nat_add(negative ? &e->neg : &e->pos, b, (size_t)(exp - e->exp));
}

/* |v| = *m * 2^exponent */
static long split(double v, uint64_t *m)
{
    int exp;

    *m = (uint64_t)ldexp(frexp(fabs(v), &exp), 53);
    return exp - 53;
}

/* e += v * times * 2^scale */
static void exact_add_double(exact *e, double v, uint64_t times, long scale)
{
    static nat term;
    uint64_t m;
    long exp = split(v, &m) + scale;

    nat_set(&term, m);
    nat_times(&term, times);
    exact_add(e, &term, exp, v < 0.0);
}

static int exact_sign(const exact *e)
{
    size_t used = e->pos.used > e->neg.used ? e->pos.used : e->neg.used;

    for (size_t i = used; i-- > 0;)
        if (e->pos.limb[i] != e->neg.limb[i])
            return e->pos.limb[i] > e->neg.limb[i] ? 1 : -1;
    return 0;
}

/* A double of any sign and of an exponent from low to low + span - 1. */
static double any_double(oracle_rng *rng, int low, size_t span)
{
    double v = 0.5 + oracle_dyadic(rng, 52) / 2.0;

    if (oracle_below(rng, 2) == 0) v = -v;
    return ldexp(v, low + (int)oracle_below(rng, span));
}

START_TEST(two_sum_is_exact)
{
    static exact e;
    oracle_rng rng = oracle_rng_start(oracle_seed(), 1);

    for (int i = 0; i < 3000; i++) {
        int low = (int)oracle_below(&rng, 2000) - 1073;
        double a = any_double(&rng, low, i % 3 == 0 ? 3 : 70), rest = 7.0;
        double b = any_double(&rng, low, i % 3 == 0 ? 3 : 70);
        double s = ki_two_sum(a, b, &rest);

        exact_clear(&e, LOWEST);
        exact_add_double(&e, a, 1, 0);
        exact_add_double(&e, b, 1, 0);
        exact_add_double(&e, -s, 1, 0);
        exact_add_double(&e, -rest, 1, 0);
        ck_assert_msg(exact_sign(&e) == 0 && s + rest == s, "%a + %a", a, b);
    }
}
END_TEST

static int true_sign(const double *t, size_t n)
{
    static exact e;

    exact_clear(&e, LOWEST);
    for (size_t i = 0; i < n; i++)
        exact_add_double(&e, t[i], 1, 0);
    return exact_sign(&e);
}

/* Terms that cancel in pairs, all of them, or but for one that may be anywhere in
 * size; the rest of the lists are not special. */
START_TEST(signs_of_sums)
{
    size_t seen[3] = {0, 0, 0};

    ck_assert_int_eq(ki_sum_sign(NULL, 0), 0);
    for (uint64_t round = 0; round < 4000 * oracle_scale(); round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        size_t n = oracle_below(&rng, KI_SIGN_TERMS + 1);
        int low = (int)oracle_below(&rng, 1900) - 1073;
        size_t span = (size_t)1 << oracle_below(&rng, 8);
        double t[KI_SIGN_TERMS];

        for (size_t i = 0; i < n; i++) {
            t[i] = any_double(&rng, low, span);
            if (round % 4 > 0 && i % 2 == 1) t[i] = -t[i - 1];
        }
        if (round % 4 == 1 && n > 0 && n % 2 == 1) t[n - 1] = 0.0;
        if (round % 4 == 2 && n > 0) t[n - 1] += any_double(&rng, low, span);
        for (size_t i = n; i > 1; i--) {
            size_t j = oracle_below(&rng, i);
            double v = t[i - 1];

            t[i - 1] = t[j];
            t[j] = v;
        }

        int want = true_sign(t, n);

        seen[want + 1]++;
        ck_assert_msg(ki_sum_sign(t, n) == want, "KOKSMA_TEST_SEED=%llu, list %llu",
                      (unsigned long long)oracle_seed(), (unsigned long long)round);
    }
    ck_assert(seen[0] > 500 && seen[1] > 500 && seen[2] > 500);
}
END_TEST

/* The bound of the header, with |sum| from the total itself:
 * |total - sum| <= 2^-53 |sum| + m 2^-105 sum|terms|. */
/* Products of 53-bit integers, also far below the range of doubles.  Every other
 * list is taken back but for one unit, so that all digits matter. */
START_TEST(signs_of_sums_of_products)
{
    for (uint64_t round = 0; round < 2000 * oracle_scale(); round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        int down = oracle_below(&rng, 2) ? 53 : 53 + (int)oracle_below(&rng, 1020);
        ki_wide sum = {{0}};
        oracle_int want = 0;
        double a[6], b[6], least = ldexp(1.0, -down);

        for (int i = 0; i < 6; i++) {
            a[i] = ldexp(oracle_dyadic(&rng, 53), 53 - down);
            b[i] = ldexp(oracle_dyadic(&rng, 53) - 0.5, 54 - down);
            ki_wide_add(&sum, a[i], b[i]);
            want += (oracle_int)ldexp(a[i], down) * (oracle_int)ldexp(b[i], down);
        }
        ck_assert_int_eq(ki_wide_sign(&sum), (want > 0) - (want < 0));
        for (int i = 0; i < 6; i++)
            ki_wide_add(&sum, -b[i], a[i]);
        ck_assert_int_eq(ki_wide_sign(&sum), 0);
        ki_wide_add(&sum, least, -least);
        ck_assert_int_eq(ki_wide_sign(&sum), -1);
        ki_wide_add(&sum, -1.0, 1.0);
        ki_wide_add(&sum, least, 2.0 * least);
        ck_assert_int_eq(ki_wide_sign(&sum), -1);
        ki_wide_add(&sum, 1.0, 1.0);
        ck_assert_int_eq(ki_wide_sign(&sum), 1);
    }
}
END_TEST

/* q b = a up to 2^-102 of a, which a product of twice the precision can just about
 * see: it is off by 2^-103 itself, and the difference by as much again. */
START_TEST(quotients)
{
    for (uint64_t round = 0; round < 2000 * oracle_scale(); round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        ki_twice a = ki_twice_sum(0.5 + oracle_dyadic(&rng, 53),
                                  ldexp(oracle_dyadic(&rng, 53), -54));
        ki_twice b = ki_twice_sum(0.5 + oracle_dyadic(&rng, 53),
                                  ldexp(oracle_dyadic(&rng, 53), -54));
        ki_twice back = ki_twice_times(ki_twice_divide(a, b), b);
        ki_twice rest = ki_twice_add(back, ki_twice_negate(a));

        ck_assert(fabs(rest.hi) <= 0x1p-101 * a.hi);
    }
}
END_TEST

START_TEST(compensated_sums)
{
    static exact off, bound;

    for (uint64_t round = 0; round < 300; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        size_t m = 1 + oracle_below(&rng, 60), span = 1 + oracle_below(&rng, 90);
        ki_sum s = {0.0, 0.0};
        double total;

        exact_clear(&off, LOWEST);
        exact_clear(&bound, LOWEST);
        for (size_t i = 0; i < m; i++) {
            double t = any_double(&rng, -40, span);

            if (i == m - 1 && round % 2 == 0) t = -ki_sum_value(s);
            ki_sum_add(&s, t);
            exact_add_double(&off, t, 1, 0);
            exact_add_double(&bound, fabs(t), m, -105);
        }
        total = ki_sum_value(s);
        exact_add_double(&off, -total, 1, 0);
        exact_add_double(&bound, fabs(total), 1025, -63);
        if (exact_sign(&off) > 0)
            nat_add(&bound.neg, &off.pos, 0), nat_add(&bound.pos, &off.neg, 0);
        else
            nat_add(&bound.neg, &off.neg, 0), nat_add(&bound.pos, &off.pos, 0);
        ck_assert_msg(exact_sign(&bound) >= 0, "list %d", (int)round);
    }
}
END_TEST

typedef struct case_of {
    double corner[DIMS];
    size_t dim, inside, n;
    nat vol; /* times 2^exp: the product */
    long exp;
} case_of;

static void multiply(case_of *c)
{
    c->exp = 0;
    nat_set(&c->vol, 1);
    for (size_t k = 0; k < c->dim; k++) {
        uint64_t m;

        c->exp += split(c->corner[k], &m);
        while (m > 0 && m % 2 == 0)
            m /= 2, c->exp++;
        nat_times(&c->vol, m);
    }
}

/* The sign of sign*(inside/n - vol) - q, times n. */
static int against(const case_of *c, double sign, double q)
{
    static exact e;
    static nat scaled;

    exact_clear(&e, c->exp < LOWEST ? c->exp : LOWEST);
    exact_add_double(&e, sign * (double)c->inside, 1, 0);
    exact_add_double(&e, -q, c->n, 0);
    nat_set(&scaled, 0);
    nat_add(&scaled, &c->vol, 0);
    nat_times(&scaled, c->n);
    exact_add(&e, &scaled, c->exp, sign > 0.0);
    return exact_sign(&e);
}

/* Two doubles up from end to end, except where nearly everything cancels and the
 * product's own uncertainty is no longer small against a double's spacing. */
static bool narrow(koksma_interval v, double err)
{
    double least = fmin(fabs(v.lower), fabs(v.upper));
    double spacing = nextafter(least, 2.0) - least;

    err += 0x1p-103;
    if (spacing > 8.0 * err) return oracle_narrow(v);
    return v.lower <= v.upper && v.upper - v.lower <= 8.0 * err + 4.0 * spacing;
}

/* |hi + lo - product| <= err */
static void check_volume(const case_of *c, ki_twofold vol)
{
    static exact e;

    for (int side = 0; side < 2; side++) {
        exact_clear(&e, c->exp < LOWEST ? c->exp : LOWEST);
        exact_add(&e, &c->vol, c->exp, side == 0);
        exact_add_double(&e, side == 0 ? vol.hi : -vol.hi, 1, 0);
        exact_add_double(&e, side == 0 ? vol.lo : -vol.lo, 1, 0);
        exact_add_double(&e, vol.err, 1, 0);
        ck_assert_msg(exact_sign(&e) >= 0,
                      "product of %zu, %a ...: %a + %a, off by %a", c->dim,
                      c->corner[0], vol.hi, vol.lo, vol.err);
    }
}

static void check_case(case_of *c, const char *what)
{
    ki_twofold vol = ki_volume(c->corner, c->dim);

    multiply(c);
    check_volume(c, vol);
    ck_assert(vol.err >= 0.0 && vol.err <= (double)c->dim * 0x1p-103);
    ck_assert(vol.hi + vol.lo == vol.hi);
    for (double sign = -1.0; sign <= 1.0; sign += 2.0) {
        koksma_interval v = ki_deviation(sign, c->inside, c->n, vol);
        int low = against(c, sign, v.lower), high = against(c, sign, v.upper);

        ck_assert_msg(
            low >= 0 && high <= 0 && narrow(v, vol.err),
            "%s: %g*(%zu/%zu - product of %zu, %a ...) in [%a, %a]: %d %d", what,
            sign, c->inside, c->n, c->dim, c->corner[0], v.lower, v.upper, low,
            high);
    }
}

/* Coordinates anywhere, next to 1, small, down to denormals, and such that two make
 * a product whose error is nearly denormal; 0 and 1 among them. */
static double coordinate(oracle_rng *rng, size_t kind)
{
    size_t chance = oracle_below(rng, 40);

    if (chance == 0) return 1.0;
    if (chance == 1 && kind == 3) return 0.0;
    if (kind == 0) return oracle_dyadic(rng, 53);
    if (kind == 1) return 1.0 - (double)oracle_below(rng, 1000) * 0x1p-53;
    if (kind == 2)
        return ldexp(oracle_dyadic(rng, 53), -(int)oracle_below(rng, 30));
    return ldexp(oracle_dyadic(rng, 53), -(int)oracle_below(rng, 1074));
}

static void random_case(case_of *c, uint64_t round, size_t most)
{
    oracle_rng rng = oracle_rng_start(oracle_seed(), round);
    size_t kind = round % 5;
    double vol = 1.0;

    c->dim = 1 + oracle_below(&rng, most);
    if (kind >= 3 && c->dim > 60) c->dim = 60;
    c->n =
        1 + oracle_below(&rng, (uint64_t)1 << (1 + oracle_below(&rng, N_BITS - 1)));
    if (kind == 0 && round % 2 == 0) {
        c->dim = 2;
        c->n = N_MOST - 1 - oracle_below(&rng, N_MOST / 4);
    }
    for (size_t k = 0; k < c->dim; k++)
        vol *= c->corner[k] = coordinate(&rng, kind);
    /* Next to n*vol, where nearly everything cancels, or anywhere. */
    c->inside = (size_t)(vol * (double)c->n);
    if (oracle_below(&rng, 2) == 0) c->inside = oracle_below(&rng, c->n);
}

START_TEST(deviations)
{
    static case_of c;
    size_t scale = oracle_scale();

    for (uint64_t round = 0; round < 6000 * scale; round++) {
        random_case(&c, round, 6);
        check_case(&c, "few");
    }
    for (uint64_t round = 0; round < 24 * scale; round++) {
        random_case(&c, round, DIMS);
        check_case(&c, "many");
    }
    for (c.dim = 1; c.dim <= DIMS; c.dim += 333)
        for (int kind = 0; kind < 5; kind++) {
            static const double same[] = {1.0 - 0x1p-53, 1.0, 0.0, 0.5, 1.0 / 3.0};

            for (size_t k = 0; k < c.dim; k++)
                c.corner[k] = same[kind];
            c.n = N_MOST - c.dim;
            c.inside = kind % 2 == 0 ? c.n : 0;
            check_case(&c, "same");
        }
}
END_TEST

/* All on a grid of 2^-bits, so that __int128 holds everything; what a double can
 * say comes out as one number. */
START_TEST(short_dyadic_deviations)
{
    for (uint64_t round = 0; round < 4000; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        size_t dim = 1 + oracle_below(&rng, 4);
        unsigned bits = 1 + (unsigned)oracle_below(&rng, 12);
        size_t n = (size_t)1 << oracle_below(&rng, 5);
        size_t inside = oracle_below(&rng, n + 1);
        oracle_ratio want = {(oracle_int)inside << bits * dim, n,
                             bits * (unsigned)dim};
        oracle_int vol = (oracle_int)n;
        double corner[4];

        for (size_t k = 0; k < dim; k++) {
            corner[k] = oracle_dyadic(&rng, bits);
            vol *= (oracle_int)ldexp(corner[k], (int)bits);
        }
        want.num -= vol;

        koksma_interval v = ki_deviation(1.0, inside, n, ki_volume(corner, dim));

        ck_assert(oracle_contains(v, want) && v.lower == v.upper);
        v = ki_deviation(-1.0, inside, n, ki_volume(corner, dim));
        want.num = -want.num;
        ck_assert(oracle_contains(v, want) && v.lower == v.upper);
    }
}
END_TEST

/* -x and x, whatever n is: exact numbers, though n*x takes two doubles. */
START_TEST(exact_numbers_stay_single)
{
    oracle_rng rng = oracle_rng_start(oracle_seed(), 4);

    for (int i = 0; i < 1000; i++) {
        double x = i == 0 ? 1.0 - 0x1p-53 : oracle_dyadic(&rng, 53);
        size_t n =
            i == 0 ? 3
                   : 1 + oracle_below(&rng, (uint64_t)1 << (1 + i % (N_BITS - 1)));
        koksma_interval v = ki_deviation(-1.0, 0, n, ki_volume(&x, 1));

        ck_assert_msg(v.lower == x && v.upper == x, "%a, n %zu: [%a, %a]", x, n,
                      v.lower, v.upper);
        v = ki_deviation(1.0, 0, n, ki_volume(&x, 1));
        ck_assert(v.lower == -x && v.upper == -x);
    }
}
END_TEST

/* Percentage points that tables print with fewer places; these are from
 * mpmath 1.3, the incomplete beta function inverted at 30 digits. */
static const struct quantile {
    double level;
    size_t nu;
    double t;
} quantiles[] = {
    {0.90, 1, 6.313751514675},     {0.90, 2, 2.9199855803537},
    {0.90, 5, 2.015048373333},     {0.90, 10, 1.8124611228117},
    {0.90, 31, 1.6955187825459},   {0.95, 1, 12.706204736175},
    {0.95, 2, 4.3026527297495},    {0.95, 3, 3.1824463052837},
    {0.95, 4, 2.7764451051978},    {0.95, 5, 2.5705818356363},
    {0.95, 7, 2.3646242515928},    {0.95, 10, 2.2281388519863},
    {0.95, 20, 2.0859634472659},   {0.95, 30, 2.0422724563012},
    {0.95, 31, 2.0395134463964},   {0.95, 60, 2.0002978220143},
    {0.95, 120, 1.9799304050824},  {0.95, 127, 1.9788195347029},
    {0.99, 1, 63.656741162872},    {0.99, 2, 9.9248432009183},
    {0.99, 5, 4.0321429835552},    {0.99, 10, 3.169272672617},
    {0.99, 30, 2.7499956535672},   {0.999, 1, 636.61924876872},
    {0.999, 3, 12.923978636687},   {0.999, 10, 4.5868938587026},
    {0.999, 127, 3.3687852985743}, {0.95, 20000, 1.9600826051581},
};

START_TEST(student_tables)
{
    for (size_t i = 0; i < sizeof quantiles / sizeof *quantiles; i++) {
        const struct quantile *q = &quantiles[i];

        ck_assert_double_eq_tol(ki_student_quantile(q->level, q->nu) / q->t, 1.0,
                                2e-12);
    }
}
END_TEST

static double closed_form(double level, size_t nu)
{
    if (nu == 1) return tan(acos(-1.0) / 2.0 * level);
    return level * sqrt(2.0 / ((1.0 - level) * (1.0 + level)));
}

START_TEST(student_by_formulas)
{
    for (double level = 0.001; level < 1.0; level += 0.001)
        for (size_t nu = 1; nu <= 2; nu++)
            ck_assert_double_eq_tol(ki_student_quantile(level, nu) /
                                        closed_form(level, nu),
                                    1.0, 1e-14 / (1.0 - level));
    for (size_t nu = 1; nu <= 40; nu++)
        for (double level = 0.02; level < 0.97; level += 0.02) {
            double t = ki_student_quantile(level, nu);

            ck_assert_double_lt(t, ki_student_quantile(level + 0.02, nu));
            ck_assert_double_gt(t, ki_student_quantile(level, nu + 1));
        }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("num");
    TCase *tc = tcase_create("exact");

    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 20.0 * (double)oracle_scale());
    tcase_add_test(tc, two_sum_is_exact);
    tcase_add_test(tc, signs_of_sums);
    tcase_add_test(tc, signs_of_sums_of_products);
    tcase_add_test(tc, quotients);
    tcase_add_test(tc, compensated_sums);
    tcase_add_test(tc, deviations);
    tcase_add_test(tc, short_dyadic_deviations);
    tcase_add_test(tc, exact_numbers_stay_single);

    tc = tcase_create("student");
    suite_add_tcase(suite, tc);
    tcase_add_test(tc, student_tables);
    tcase_add_test(tc, student_by_formulas);
    return oracle_run(suite);
}
