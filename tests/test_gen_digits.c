/* Radical inverses and Sobol' sequences against integers: digits turned round, long
 * division, the recurrence of the direction numbers, and what sequences promise of
 * their intervals. */
#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gen_fixture.h"
#include "oracle.h"

static double room[ROOM];

/* Where sums of powers of 1/b in doubles return 1, and where integers run out. */
static const struct range {
    uint64_t start, n;
} ranges[] = {
    {0, 2001},
    {((uint64_t)1 << 53) - 500, 1000},
    {((uint64_t)1 << 54) - 20, 40},
    {2384185791015625u - 20, 40},  /* 5^22 */
    {16677181699666569u - 20, 40}, /* 3^34 */
    {4294967291u - 20, 40},        /* and its square: 2^64 - 10*2^32 + 25 */
    {18446744030759878681u - 20, 40},
    {UINT64_MAX - 199, 200},
};

START_TEST(radical_inverses)
{
    const struct range *range = &ranges[_i];
    koksma_gen_opts o = {
        .dim = 8, .n = range->n, .start = range->start, .bases = bases};

    fill_all(room, "halton", o);
    for (uint64_t i = 0; i < o.n; i++)
        for (size_t k = 0; k < 8; k++) {
            double v = room[i * 8 + k], want = inverse(o.start + i, bases[k]);

            if (v != want || v >= 1.0)
                ck_abort_msg("base %ju, index %ju: %a, not %a", (uintmax_t)bases[k],
                             (uintmax_t)(o.start + i), v, want);
        }
}
END_TEST

/* (b^k - 1)/b^k, and by name what loops over doubles get wrong. */
START_TEST(documented_values)
{
    static const uint32_t five[] = {5}, large[] = {257};
    koksma_gen_opts o = {
        .dim = 1, .n = 1, .start = 2384185791015624u, .bases = five};
    double x;

    fill_all(&x, "halton", o);
    ck_assert(x == 0.99999999999999956);
    o.start = 16974847;
    o.bases = large;
    fill_all(&x, "halton", o);
    ck_assert(x == 0.98832684847825514);
    o.start = 0;
    fill_all(&x, "halton", o);
    ck_assert(x == 0.0 && !signbit(x));
}
END_TEST

/* Any prime to 7919 and any index; tagged big, a million of them. */
START_TEST(random_pairs)
{
    static uint32_t prime[1000];
    size_t primes = 0, pairs = _i == 0 ? 5000 : 1000000;
    oracle_rng rng = oracle_rng_start(oracle_seed(), (uint64_t)_i + 5);

    for (uint32_t p = 2; primes < 1000; p++) {
        bool divided = false;

        for (size_t i = 0; i < primes && prime[i] * prime[i] <= p && !divided; i++)
            divided = p % prime[i] == 0;
        if (!divided) prime[primes++] = p;
    }
    for (size_t i = 0; i < pairs; i++) {
        koksma_gen_opts o = {
            .dim = 1, .n = 1, .bases = &prime[oracle_below(&rng, 1000)]};
        double v;

        o.start = oracle_below(&rng, (uint64_t)1 << 32) << 32 |
                  oracle_below(&rng, (uint64_t)1 << 32);
        o.start >>= oracle_below(&rng, 64);
        if (i % 100 == 0) o.start = UINT64_MAX - i;
        fill_all(&v, "halton", o);
        if (v != inverse(o.start, o.bases[0]))
            ck_abort_msg("base %ju, index %ju: %a", (uintmax_t)o.bases[0],
                         (uintmax_t)o.start, v);
    }
}
END_TEST

START_TEST(first_primes)
{
    koksma_gen_opts o = {.dim = 1000, .n = 2};
    uint32_t p = 1;

    fill_all(room, "halton", o);
    for (size_t k = 0; k < o.dim; k++) {
        bool prime = false;

        while (!prime) {
            prime = ++p > 1;
            for (uint32_t d = 2; d * d <= p; d++)
                if (p % d == 0) prime = false;
        }
        ck_assert(room[k] == 0.0 && room[o.dim + k] == truncated(1, p));
    }
    ck_assert_uint_eq(p, 7919);
}
END_TEST

/* Ratios either side of where the kernel may change its method, at 2^53. */
START_TEST(ratios)
{
    oracle_rng rng = oracle_rng_start(oracle_seed(), 0);

    for (int i = 0; i < 20000; i++) {
        ki_u128 p = (ki_u128)1 << (1 + oracle_below(&rng, 126)), r;

        p += oracle_below(&rng, 9);
        if (p > 8) p -= 4;
        if (i % 2 == 0) p -= (p >> 1) / (1 + oracle_below(&rng, 1000));
        r = (ki_u128)oracle_below(&rng, (uint64_t)1 << 53) *
            (p / ((ki_u128)1 << 53));
        r += oracle_below(&rng, (size_t)(p < 1000 ? p : 1000));
        if (i % 4 == 1) r = p - 1 - r % p;
        r %= p;

        double v = ki_ratio(r, p);

        if (v != truncated(r, p)) ck_abort_msg("ratio %d: %a", i, v);
    }
}
END_TEST

/* Each place's table is a permutation, and the value is that of its digits: all
 * that 64 bits have, zeros in front included. */
START_TEST(permuted_digits)
{
    static const uint32_t tried[] = {2, 3, 4, 5, 29, 541, 65537};
    ki_radical r = {.base = tried[_i]};
    unsigned digits = ki_radical_digits(r.base);
    bool *seen = calloc(r.base, sizeof *seen);
    ki_u128 p = 1;

    for (unsigned j = 0; j < digits; j++)
        p *= r.base;
    ck_assert(p > UINT64_MAX && p / r.base <= UINT64_MAX);
    ck_assert_int_eq(ki_radical_scramble(&r, KOKSMA_SCRAMBLE_DIGITS,
                                         koksma_rng_seed(oracle_seed(), 7)),
                     0);
    for (unsigned j = 0; j < digits; j++) {
        memset(seen, 0, r.base * sizeof *seen);
        for (uint32_t d = 0; d < r.base; d++)
            seen[r.permutation[j * r.base + d]] = true;
        ck_assert_ptr_null(memchr(seen, 0, r.base * sizeof *seen));
    }
    for (size_t at = 0; at < sizeof ranges / sizeof *ranges; at++) {
        ki_radical_fill(&r, room, 2, ranges[at].start, (size_t)ranges[at].n);
        for (uint64_t i = 0; i < ranges[at].n; i++) {
            uint64_t index = ranges[at].start + i;
            uint32_t digit[64];
            ki_u128 image = 0;
            double v = room[2 * i], low;

            for (unsigned j = 0; j < digits; j++, index /= r.base) {
                digit[j] = (uint32_t)(index % r.base);
                image = image * r.base + r.permutation[j * r.base + digit[j]];
            }
            if (ki_radical_value(&r, digit, digits) != v)
                ck_abort_msg("%a from digits", ki_radical_value(&r, digit, digits));
            low = truncated(image, p);
            if (!(v < 1.0 && v >= nextafter(nextafter(low, 0.0), 0.0) &&
                  v <= nextafter(nextafter(low, 2.0), 2.0)))
                ck_abort_msg("index %ju: %a, not %a",
                             (uintmax_t)(ranges[at].start + i), v, low);
        }
    }
    /* All digits the highest: the value that rounds up to 1. */
    for (size_t at = 0; at < digits * (size_t)r.base; at++)
        r.permutation[at] = r.base - 1 - (uint32_t)(at % r.base);
    ki_radical_fill(&r, room, 1, 0, 2);
    ck_assert(room[0] == 1.0 - 0x1p-53 && room[1] < 1.0);
    free(seen);
    free(r.permutation);
}
END_TEST

/* One point in each interval [j/b^m, (j+1)/b^m) for every block of b^m indices
 * that starts at a multiple of b^m, permuted or not. */
START_TEST(scrambled_intervals)
{
    static const unsigned places[] = {8, 8, 5};
    static bool taken[6561];

    for (uint64_t round = 0; round < 30; round++)
        for (size_t k = 0; k < 3; k++) {
            koksma_gen_opts o = {.dim = 3,
                                 .n = 1,
                                 .seed = 1,
                                 .replicate = round,
                                 .scramble = round % 2 == 0 ? KOKSMA_SCRAMBLE_DIGITS
                                                            : KOKSMA_SCRAMBLE_OWEN};

            for (unsigned m = 1; m <= places[k]; m++) {
                o.n *= bases[k];
                o.start = (round + 1) * (round + 1) * o.n;
                if (m < places[k] && m % 3 != 2) continue;
                fill_all(room, "halton", o);
                memset(taken, 0, sizeof taken);
                for (uint64_t i = 0; i < o.n; i++) {
                    size_t j = (size_t)(room[i * 3 + k] * (double)o.n);

                    if (taken[j]) ck_abort_msg("interval %zu twice", j);
                    taken[j] = true;
                }
            }
        }
}
END_TEST

/* Over many seeds: the leading digit's permutation in base 3 is any of six, the
 * first two places in base 2 and in base 3 do not depend on each other or on the
 * other base.  5 spreads of chi-square each. */
START_TEST(permutations_are_uniform)
{
    size_t six[6] = {0}, cell[2 * 2 * 3 * 3] = {0};
    double chi = 0.0, most = 36.0 + 5.0 * sqrt(72.0);
    enum { DRAWS = 7200 };

    for (uint64_t i = 0; i < DRAWS; i++) {
        koksma_gen_opts o = {.dim = 2, .n = 3, .scramble = (koksma_scramble)_i};
        const double *x = room;

        *(i % 2 == 0 ? &o.seed : &o.replicate) = i / 2;
        fill_all(room, "halton", o);
        six[(x[1] > x[3]) + 2 * ((x[1] > x[5]) + (x[3] > x[5]))]++;
        cell[(size_t)(x[0] * 4.0) * 9 + (size_t)(x[1] * 9.0)]++;
    }
    for (size_t i = 0; i < 6; i++)
        chi += pow((double)six[i] - DRAWS / 6.0, 2.0) / (DRAWS / 6.0);
    ck_assert_double_lt(chi, 6.0 + 5.0 * sqrt(12.0));
    chi = 0.0;
    for (size_t i = 0; i < 36; i++)
        chi += pow((double)cell[i] - DRAWS / 36.0, 2.0) / (DRAWS / 36.0);
    ck_assert_double_lt(chi, most);
}
END_TEST

/* Indices that agree in their lowest d digits and no more have images that agree in
 * their first d and no more; a digit goes through all of its images where those
 * before it stay the same, and the images differ where those before it do. */
START_TEST(nested_digits)
{
    static const uint32_t tried[] = {2, 3, 5, 29, 541};
    uint32_t b = tried[_i];
    koksma_gen_opts o = {.dim = 1, .n = b < 100 ? 300 : 3 * b, .bases = &b};
    size_t same = 0, orders = 0, draws = 0;

    o.scramble = KOKSMA_SCRAMBLE_OWEN;
    o.start = (uint64_t)b * b * b * b * 11;
    fill_all(room, "halton", o);
    for (size_t i = 0; i < 300; i++)
        for (size_t j = 0; j < i; j++) {
            double p = 1.0;

            for (size_t q = i - j; q > 0 && q % b == 0; q /= b)
                p *= b;
            if (floor(room[i] * p) != floor(room[j] * p) ||
                floor(room[i] * p * b) == floor(room[j] * p * b))
                ck_abort_msg("points %zu and %zu", i, j);
        }
    /* The place behind the first: whether two digits change their order, by the
     * first digit.  With one permutation for all it would be the same. */
    for (o.seed = 1; o.seed <= 40; o.seed++) {
        double p = b;

        fill_all(room, "halton", o);
        for (uint32_t a = 0; a + 1 < b && a < 3; a++, draws++) {
            double one = fmod(room[a] * p, 1.0) - fmod(room[a + b] * p, 1.0);
            double two =
                fmod(room[a + 1] * p, 1.0) - fmod(room[a + 1 + b] * p, 1.0);

            orders += (one < 0.0) == (two < 0.0);
        }
        for (size_t i = 0; i + 1 < o.n; i++)
            same += room[i] == room[i + 1];
    }
    ck_assert_uint_eq(same, 0);
    /* Five spreads around a half; for b = 2 there is one a a seed. */
    ck_assert(fabs((double)orders - 0.5 * (double)draws) <
              2.5 * sqrt((double)draws));
}
END_TEST

/* Which of the six permutations of the digits behind the point in base 3 the node
 * of some index's lowest `depth` digits has, from the three indices that go on from
 * it. */
static size_t order_at(const double *x, size_t index, unsigned depth)
{
    size_t step = 1;
    double v[3];

    for (unsigned j = 0; j < depth; j++)
        step *= 3;
    for (size_t d = 0; d < 3; d++)
        v[d] = fmod(x[index + d * step] * (double)step, 1.0);
    return (size_t)(v[0] > v[1]) +
           2 * ((size_t)(v[0] > v[2]) + (size_t)(v[1] > v[2]));
}

/* Two nodes' permutations have nothing to do with each other: the root and a node
 * behind it, two of one depth, and two that differ in the first digit of two. */
START_TEST(nodes_are_independent)
{
    static const struct {
        size_t index;
        unsigned depth;
    } nodes[][2] = {{{0, 0}, {0, 1}}, {{0, 1}, {1, 1}}, {{0, 0}, {1, 1}},
                    {{3, 2}, {4, 2}}, {{1, 1}, {1, 2}}, {{0, 1}, {2, 2}}};
    size_t cell[6][36] = {{0}};
    enum { DRAWS = 3600 };

    for (uint64_t seed = 0; seed < DRAWS; seed++) {
        static const uint32_t three[] = {3};
        koksma_gen_opts o = {.dim = 1, .n = 27, .bases = three, .seed = seed};

        o.scramble = KOKSMA_SCRAMBLE_OWEN;
        fill_all(room, "halton", o);
        for (size_t p = 0; p < 6; p++)
            cell[p][order_at(room, nodes[p][0].index, nodes[p][0].depth) * 6 +
                    order_at(room, nodes[p][1].index, nodes[p][1].depth)]++;
    }
    for (size_t p = 0; p < 6; p++) {
        double chi = 0.0;

        for (size_t i = 0; i < 36; i++)
            chi += pow((double)cell[p][i] - DRAWS / 36.0, 2.0) / (DRAWS / 36.0);
        ck_assert_msg(chi < 36.0 + 5.0 * sqrt(72.0), "pair %zu: chi-square %g", p,
                      chi);
    }
}
END_TEST

/* Rows of [Joe, Kuo 2008]'s table: dimension, degree, coefficients, m_1 ... m_s. */
static const struct row {
    size_t k;
    unsigned s, a;
    uint64_t m[13];
} rows[] = {
    {1, 1, 0, {1}},
    {2, 2, 1, {1, 3}},
    {3, 3, 1, {1, 3, 1}},
    {4, 3, 2, {1, 1, 1}},
    {5, 4, 1, {1, 1, 3, 3}},
    {6, 4, 4, {1, 3, 5, 13}},
    {19, 7, 1, {1, 3, 7, 11, 23, 15, 103}},
    {37, 8, 14, {1, 3, 1, 15, 31, 13, 49, 245}},
    {49, 8, 97, {1, 1, 1, 3, 23, 43, 57, 177}},
    {50, 8, 103, {1, 3, 7, 7, 17, 17, 37, 71}},
    {500, 13, 148, {1, 3, 5, 1, 13, 41, 19, 143, 293, 391, 2023, 1791, 4399}},
    {999, 13, 3396, {1, 1, 3, 9, 3, 3, 105, 201, 373, 877, 919, 1263, 6649}},
    {1110, 13, 4094, {1, 1, 5, 15, 19, 1, 7, 211, 157, 603, 403, 1387, 1583}},
};

/* m_j = 2 a_1 m_(j-1) ^ ... ^ 2^(s-1) a_(s-1) m_(j-s+1) ^ 2^s m_(j-s) ^ m_(j-s),
 * and the point is the exclusive or of the m_j/2^j over the bits of the index's
 * Gray code, all bits kept until the end. */
static double sobol(const struct row *row, uint64_t index)
{
    uint64_t m[65], gray = index ^ index >> 1, bits = 0;

    for (unsigned j = 1; j <= 64; j++) {
        if (j <= row->s) {
            m[j] = row->m[j - 1];
        } else {
            m[j] = m[j - row->s] ^ m[j - row->s] << row->s;
            for (unsigned i = 1; i < row->s; i++)
                if (row->a >> (row->s - 1 - i) & 1) m[j] ^= m[j - i] << i;
        }
        if (gray >> (j - 1) & 1) bits ^= m[j] << (64 - j);
    }
    return truncated(bits, (ki_u128)1 << 64);
}

START_TEST(sobol_by_recurrence)
{
    static const struct range ranges_of[] = {
        {0, 100},
        {65500, 100},
        {((uint64_t)1 << 53) - 50, 100},
        {((uint64_t)1 << 63) - 50, 100},
        {UINT64_MAX - 99, 100},
    };

    for (size_t at = 0; at < sizeof ranges_of / sizeof *ranges_of; at++) {
        koksma_gen_opts o = {
            .dim = 1111, .n = ranges_of[at].n, .start = ranges_of[at].start};

        fill_all(room, "sobol", o);
        for (uint64_t i = 0; i < o.n; i++)
            for (size_t j = 0; j < sizeof rows / sizeof *rows; j++) {
                double v = room[i * o.dim + rows[j].k];

                if (v != sobol(&rows[j], o.start + i))
                    ck_abort_msg("dimension %zu, index %ju: %a", rows[j].k + 1,
                                 (uintmax_t)(o.start + i), v);
            }
    }
}
END_TEST

/* The first points in three dimensions on the page of Joe and Kuo's program. */
START_TEST(sobol_as_published)
{
    static const double want[] = {
        0,     0,     0,     0.5,   0.5,    0.5,    0.75,   0.25,   0.25,   0.25,
        0.75,  0.75,  0.375, 0.375, 0.625,  0.875,  0.875,  0.125,  0.625,  0.125,
        0.875, 0.125, 0.625, 0.375, 0.1875, 0.3125, 0.9375, 0.6875, 0.8125, 0.4375,
    };

    fill_all(room, "sobol", (koksma_gen_opts){.dim = 3, .n = 10});
    for (size_t i = 0; i < 30; i++)
        ck_assert(room[i] == want[i]);
}
END_TEST

/* The first 2^6 points of every coordinate are the j/2^6, each once; and any 2^m
 * points from a multiple of 2^m on are a net in dimensions 1 and 2. */
START_TEST(sobol_nets)
{
    static bool taken[1024];

    koksma_gen_opts o = {.dim = 1111, .n = 64};

    fill_all(room, "sobol", o);
    for (size_t k = 0; k < o.dim; k++) {
        memset(taken, 0, sizeof taken);
        for (size_t i = 0; i < o.n; i++) {
            double j = room[i * o.dim + k] * 64.0;

            if (j != floor(j) || taken[(size_t)j])
                ck_abort_msg("dimension %zu", k + 1);
            taken[(size_t)j] = true;
        }
    }
    for (unsigned m = 0; m <= 10; m++)
        for (uint64_t block = 0; block < 4; block++) {
            uint64_t n = (uint64_t)1 << m, at = block < 3 ? block : 12345;

            fill_all(room, "sobol",
                     (koksma_gen_opts){.dim = 2, .n = n, .start = at * n});
            for (unsigned a = 0; a <= m; a++) {
                memset(taken, 0, sizeof taken);
                for (uint64_t i = 0; i < n; i++)
                    taken[(size_t)ldexp(room[2 * i], (int)a) << (m - a) |
                          (size_t)ldexp(room[2 * i + 1], (int)(m - a))] = true;
                ck_assert_ptr_null(memchr(taken, 0, n));
            }
        }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("gen_digits");
    TCase *tc = tcase_create("radical inverses");

    suite_add_tcase(suite, tc);
    tcase_add_loop_test(tc, radical_inverses, 0, sizeof ranges / sizeof *ranges);
    tcase_add_test(tc, documented_values);
    tcase_add_test(tc, first_primes);
    tcase_add_loop_test(tc, random_pairs, 0, 1);
    tcase_add_test(tc, ratios);

    tc = tcase_create("permuted digits");
    suite_add_tcase(suite, tc);
    tcase_add_loop_test(tc, permuted_digits, 0, 7);
    tcase_add_test(tc, scrambled_intervals);
    tcase_add_loop_test(tc, permutations_are_uniform, KOKSMA_SCRAMBLE_DIGITS,
                        KOKSMA_SCRAMBLE_OWEN + 1);
    tcase_add_loop_test(tc, nested_digits, 0, 5);
    tcase_add_test(tc, nodes_are_independent);

    tc = tcase_create("sobol");
    suite_add_tcase(suite, tc);
    tcase_add_test(tc, sobol_by_recurrence);
    tcase_add_test(tc, sobol_as_published);
    tcase_add_test(tc, sobol_nets);

    tc = tcase_create("a million pairs");
    suite_add_tcase(suite, tc);
    tcase_set_tags(tc, "big");
    tcase_set_timeout(tc, 120);
    tcase_add_loop_test(tc, random_pairs, 1, 2);
    return oracle_run(suite);
}
