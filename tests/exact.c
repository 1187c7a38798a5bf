#include "exact.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

__extension__ typedef unsigned __int128 two_words;

static exact_int trimmed(exact_int a)
{
    while (a.used > 0 && a.word[a.used - 1] == 0)
        a.used--;
    if (a.used == 0) a.negative = false;
    return a;
}

static void check_words(size_t words)
{
    if (words <= EXACT_WORDS) return;
    fprintf(stderr, "exact: %zu words do not fit\n", words);
    abort();
}

exact_int exact_of(int64_t v)
{
    exact_int a = {v < 0, 1, {v < 0 ? -(uint64_t)v : (uint64_t)v}};

    return trimmed(a);
}

/* |v| = m 2^*exponent, m below 2^53 and odd unless it is 0. */
static int64_t odd_part(double v, int *exponent)
{
    int64_t m = (int64_t)ldexp(frexp(fabs(v), exponent), 53);

    *exponent -= 53;
    while (m != 0 && m % 2 == 0) {
        m /= 2;
        ++*exponent;
    }
    return m;
}

exact_int exact_scaled(double v, unsigned bits)
{
    int e;
    int64_t m = odd_part(v, &e);

    if (m == 0) return exact_of(0);
    if (e + (int)bits < 0) {
        fprintf(stderr, "exact: %a takes more than %u bits\n", v, bits);
        abort();
    }
    return exact_shifted(exact_of(v < 0.0 ? -m : m), (unsigned)(e + (int)bits));
}

unsigned exact_bits(const double *x, size_t count, unsigned bits)
{
    for (size_t i = 0; i < count; i++) {
        int e;

        if (odd_part(x[i], &e) != 0 && e + (int)bits < 0) bits = (unsigned)-e;
    }
    return bits;
}

/* ---- Absolute values ------------------------------------------------------- */

static int order_abs(const exact_int *a, const exact_int *b)
{
    if (a->used != b->used) return a->used < b->used ? -1 : 1;
    for (unsigned i = a->used; i-- > 0;)
        if (a->word[i] != b->word[i]) return a->word[i] < b->word[i] ? -1 : 1;
    return 0;
}

/* |a| + |b|, and with minus |a| - |b|, |a| >= |b|; with the sign of a. */
static exact_int combined(const exact_int *a, const exact_int *b, bool minus)
{
    exact_int s;
    unsigned long carry = 0;
    unsigned most = a->used > b->used ? a->used : b->used;

    check_words(most + 1);
    s.negative = a->negative;
    s.used = most + 1;
    for (unsigned i = 0; i <= most; i++) {
        uint64_t u = i < a->used ? a->word[i] : 0, v = i < b->used ? b->word[i] : 0;
        two_words w = minus ? (two_words)u - v - carry : (two_words)u + v + carry;

        s.word[i] = (uint64_t)w;
        carry = (w >> 64) != 0;
    }
    return trimmed(s);
}

/* ---- Integers -------------------------------------------------------------- */

int exact_sign(exact_int a) { return a.used == 0 ? 0 : a.negative ? -1 : 1; }

exact_int exact_abs(exact_int a)
{
    a.negative = false;
    return a;
}

static exact_int opposite(exact_int a)
{
    a.negative = a.used > 0 && !a.negative;
    return a;
}

exact_int exact_plus(exact_int a, exact_int b)
{
    if (a.negative == b.negative) return combined(&a, &b, false);
    if (order_abs(&a, &b) >= 0) return combined(&a, &b, true);
    return combined(&b, &a, true);
}

exact_int exact_minus(exact_int a, exact_int b)
{
    return exact_plus(a, opposite(b));
}

int exact_order(exact_int a, exact_int b)
{
    int sign = exact_sign(a), order;

    if (sign != exact_sign(b)) return sign < exact_sign(b) ? -1 : 1;
    order = order_abs(&a, &b);
    return sign < 0 ? -order : order;
}

exact_int exact_times(exact_int a, exact_int b)
{
    exact_int p;

    if (a.used == 0 || b.used == 0) return exact_of(0);
    p.negative = a.negative != b.negative;
    p.used = a.used + b.used;
    check_words(p.used);
    for (unsigned i = 0; i < p.used; i++)
        p.word[i] = 0;
    for (unsigned i = 0; i < a.used; i++) {
        uint64_t carry = 0;

        for (unsigned j = 0; j < b.used; j++) {
            two_words w = (two_words)a.word[i] * b.word[j] + p.word[i + j] + carry;

            p.word[i + j] = (uint64_t)w;
            carry = (uint64_t)(w >> 64);
        }
        p.word[i + b.used] = carry;
    }
    return trimmed(p);
}

exact_int exact_times_of(exact_int a, int64_t b)
{
    return exact_times(a, exact_of(b));
}

exact_int exact_shifted(exact_int a, unsigned bits)
{
    unsigned words = bits / 64, rest = bits % 64;
    exact_int s;

    if (a.used == 0) return a;
    s.negative = a.negative;
    s.used = a.used + words + 1;
    check_words(s.used);
    for (unsigned i = 0; i < words; i++)
        s.word[i] = 0;
    for (unsigned i = 0; i <= a.used; i++) {
        uint64_t low = i > 0 && rest > 0 ? a.word[i - 1] >> (64 - rest) : 0;

        s.word[words + i] = low | (i < a.used ? a.word[i] << rest : 0);
    }
    return trimmed(s);
}

/* ---- Ratios ---------------------------------------------------------------- */

int exact_ratio_order(exact_ratio r, exact_ratio s)
{
    return exact_order(exact_times(r.num, s.den), exact_times(s.num, r.den));
}

/* The sign of r - m 2^e. */
static int against_power(exact_ratio r, exact_int m, int e)
{
    int sign = exact_sign(r.num);

    if (m.used == 0 || sign != exact_sign(m)) return sign - exact_sign(m);
    if (e > 300) return -sign; /* no ratio of a test is as large */

    /* An integer is further from 0 than what is below 1. */
    if (e < -64 * (int)(m.used + r.den.used)) return sign;
    if (e >= 0)
        return exact_order(r.num,
                           exact_times(exact_shifted(m, (unsigned)e), r.den));
    return exact_order(exact_shifted(r.num, (unsigned)-e), exact_times(m, r.den));
}

int exact_against(exact_ratio r, double v)
{
    int e;
    int64_t m;

    if (isinf(v)) return v > 0.0 ? -1 : 1;
    m = odd_part(v, &e);
    return against_power(r, exact_of(v < 0.0 ? -m : m), e);
}

bool exact_contains(koksma_interval v, exact_ratio r)
{
    return exact_against(r, v.lower) >= 0 && exact_against(r, v.upper) <= 0;
}

/* The sign of r - v^2. */
static int against_square(exact_ratio r, double v)
{
    int e;
    exact_int m;

    if (isinf(v)) return -1;
    m = exact_of(odd_part(v, &e));
    return against_power(r, exact_times(m, m), 2 * e);
}

bool exact_contains_root(koksma_interval v, exact_ratio r)
{
    return (v.lower <= 0.0 || against_square(r, v.lower) >= 0) && v.upper >= 0.0 &&
           against_square(r, v.upper) <= 0;
}

/* The two upper words of a, and how many there are below. */
static long double leading(exact_int a, int *below)
{
    long double high = a.used > 0 ? (long double)a.word[a.used - 1] : 0.0L;
    long double low = a.used > 1 ? (long double)a.word[a.used - 2] : 0.0L;

    *below = (int)a.used - 1;
    return (a.negative ? -1.0L : 1.0L) * (high + ldexpl(low, -64));
}

long double exact_value(exact_ratio r)
{
    int a, b;
    long double num = leading(r.num, &a), den = leading(r.den, &b);

    return ldexpl(num / den, 64 * (a - b));
}
