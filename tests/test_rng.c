/* rng.h against the published recurrence, and plain statistics with fixed seeds:
 * what fails once fails always. */
#include <check.h>
#include <math.h>
#include <stdlib.h>

#include "oracle.h"
#include "rng.h"

/* SplitMix64 as its paper prints it: nextSeed() is seed += GOLDEN_GAMMA, and
 * mix64 in the form "variant 13" [Steele, Lea, Flood 2014, figures 11 and 16]. */
static uint64_t published(uint64_t *state)
{
    uint64_t z = *state += 11400714819323198485u;

    z ^= z >> 30;
    z *= 13787848793156543929u;
    z ^= z >> 27;
    z *= 10723151780598845931u;
    z ^= z >> 31;
    return z;
}

START_TEST(follows_the_recurrence)
{
    static const uint64_t starts[] = {
        0, 1, 1234567, UINT64_MAX, 1u << 31, 0xdeadbeef, (uint64_t)1 << 63};

    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++) {
        koksma_rng r = {starts[i]};
        uint64_t state = starts[i];

        for (int j = 0; j < 1000; j++)
            ck_assert_uint_eq(koksma_rng_next(&r), published(&state));
    }
}
END_TEST

/* Rosetta Code's task "Pseudo-random numbers/Splitmix64", state 1234567; and the
 * first value of state 0, which many ports of SplitMix64 test. */
START_TEST(published_values)
{
    static const uint64_t want[] = {6457827717110365317u, 3203168211198807973u,
                                    9817491932198370423u, 4593380528125082431u,
                                    16408922859458223821u};
    koksma_rng r = {1234567}, zero = {0};

    for (size_t i = 0; i < 5; i++)
        ck_assert_uint_eq(koksma_rng_next(&r), want[i]);
    ck_assert_uint_eq(koksma_rng_next(&zero), 0xe220a8397b1dcdafu);
}
END_TEST

START_TEST(skipping_is_stepping)
{
    for (uint64_t steps = 0; steps < 200; steps++) {
        koksma_rng r = koksma_rng_seed(steps, 3), s = r, there_and_back = r;

        for (uint64_t i = 0; i < steps; i++)
            koksma_rng_next(&r);
        koksma_rng_skip(&s, steps);
        koksma_rng_skip(&there_and_back, UINT64_MAX - steps);
        koksma_rng_skip(&there_and_back, 2 * steps + 1);
        ck_assert_uint_eq(koksma_rng_next(&s), koksma_rng_next(&r));
        ck_assert_uint_eq(s.counter, r.counter);
        koksma_rng_next(&there_and_back);
        ck_assert_uint_eq(there_and_back.counter, r.counter);
    }
}
END_TEST

/* Sum of (seen - mean)^2 / mean: about cells - 1, with spread sqrt(2 cells). */
static double chi_square(const size_t *seen, size_t cells)
{
    double total = 0.0, chi = 0.0, mean;

    for (size_t i = 0; i < cells; i++)
        total += (double)seen[i];
    mean = total / (double)cells;
    for (size_t i = 0; i < cells; i++)
        chi += ((double)seen[i] - mean) * ((double)seen[i] - mean) / mean;
    return chi;
}

/* Within five spreads either way: too even is no better than too uneven. */
static void check_even(const size_t *seen, size_t cells)
{
    double chi = chi_square(seen, cells), spread = sqrt(2.0 * (double)cells);

    ck_assert_double_lt(chi, (double)cells + 5.0 * spread);
    if (cells > 60) ck_assert_double_gt(chi, (double)cells - 5.0 * spread);
}

/* The leading 7 bits, and all 53 one by one. */
START_TEST(units_are_even)
{
    koksma_rng r = koksma_rng_seed(1, 0);
    size_t cell[128] = {0}, bit[53] = {0};
    enum { DRAWS = 100000 };

    for (int i = 0; i < DRAWS; i++) {
        double u = koksma_rng_unit(&r);
        uint64_t k = (uint64_t)ldexp(u, 53);

        ck_assert(u >= 0.0 && u < 1.0 && ldexp((double)k, -53) == u);
        cell[(size_t)(u * 128.0)]++;
        for (int j = 0; j < 53; j++)
            bit[j] += k >> j & 1;
    }
    check_even(cell, 128);
    for (int j = 0; j < 53; j++)
        ck_assert_double_lt(fabs((double)bit[j] - DRAWS / 2.0),
                            5.0 * sqrt(DRAWS) / 2.0);
}
END_TEST

/* All the ones that 53 bits can hold stay below 1. */
START_TEST(unit_is_the_leading_bits)
{
    for (uint64_t seed = 0; seed < 1000; seed++) {
        koksma_rng r = koksma_rng_seed(seed, 0), s = r;
        uint64_t v = koksma_rng_next(&r);

        ck_assert(koksma_rng_unit(&s) == ldexp((double)(v >> 11), -53));
        ck_assert_uint_eq(s.counter, r.counter);
    }
}
END_TEST

START_TEST(below_is_even)
{
    static const uint64_t sizes[] = {2, 3, 5, 6, 7, 10, 64, 100, 101, 127};

    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        koksma_rng r = koksma_rng_seed(2, i);
        size_t seen[127] = {0};

        for (int j = 0; j < 20000; j++) {
            uint64_t v = koksma_rng_below(&r, sizes[i]);

            ck_assert_uint_lt(v, sizes[i]);
            seen[v]++;
        }
        check_even(seen, (size_t)sizes[i]);
    }
}
END_TEST

/* Where 2^64 is no multiple of n, the bias of v % n is largest: values below
 * 2^63 - 1 would come twice as often for n = 2^63 + 1; thirds for 3*2^62. */
START_TEST(below_is_even_for_large_n)
{
    static const uint64_t sizes[] = {((uint64_t)1 << 63) + 1, (uint64_t)3 << 62,
                                     UINT64_MAX, (uint64_t)1 << 63};

    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        koksma_rng r = koksma_rng_seed(3, i);
        size_t seen[64] = {0}, draws = 20000;
        uint64_t before = r.counter;

        for (size_t j = 0; j < draws; j++) {
            uint64_t v = koksma_rng_below(&r, sizes[i]);

            ck_assert_uint_lt(v, sizes[i]);
            seen[(size_t)(ldexp((double)v, 6) / (double)sizes[i]) % 64]++;
        }
        check_even(seen, 64);

        /* Values taken: 2, 4/3, 1 and 1 a draw. */
        double taken = (double)((r.counter - before) * 0xF1DE83E19937733Du);
        static const double each[] = {2.0, 4.0 / 3.0, 1.0, 1.0};

        ck_assert_double_eq_tol(taken / (double)draws, each[i],
                                i < 2 ? 0.06 : 1e-9);
    }
}
END_TEST

/* One place to land, however often, and one value taken each time. */
START_TEST(below_one)
{
    koksma_rng r = koksma_rng_seed(4, 0), s = r;

    for (int i = 0; i < 100; i++)
        ck_assert_uint_eq(koksma_rng_below(&r, 1), 0);
    koksma_rng_skip(&s, 100);
    ck_assert_uint_eq(s.counter, r.counter);
}
END_TEST

static int by_size(const void *a, const void *b)
{
    uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;

    return (p > q) - (p < q);
}

/* 100 by 100 neighbouring seeds and streams, swapped ones among them: 10000
 * starts, all apart by far more than a run; the same pair starts the same. */
START_TEST(streams_are_apart)
{
    static uint64_t place[10000];

    for (uint64_t seed = 0; seed < 100; seed++)
        for (uint64_t stream = 0; stream < 100; stream++) {
            koksma_rng r = koksma_rng_seed(seed, stream);

            /* Steps from counter 0: the odd increment's inverse modulo 2^64. */
            place[seed * 100 + stream] = r.counter * 0xF1DE83E19937733Du;
            ck_assert_uint_eq(koksma_rng_seed(seed, stream).counter, r.counter);
        }
    qsort(place, 10000, sizeof *place, by_size);
    for (size_t i = 1; i < 10000; i++)
        ck_assert_uint_gt(place[i] - place[i - 1], (uint64_t)1 << 32);
    ck_assert_uint_gt(place[0] - place[9999], (uint64_t)1 << 32);
}
END_TEST

/* First values of neighbouring streams and of neighbouring seeds are as even as
 * the values of one. */
START_TEST(neighbours_are_unrelated)
{
    size_t streams[64] = {0}, seeds[64] = {0}, pairs[64] = {0};

    for (uint64_t i = 0; i < 20000; i++) {
        koksma_rng r = koksma_rng_seed(5, i), s = koksma_rng_seed(i, 5);
        koksma_rng t = koksma_rng_seed(5, i + 1);
        uint64_t v = koksma_rng_next(&r);

        streams[v >> 58]++;
        seeds[koksma_rng_next(&s) >> 58]++;
        pairs[v >> 61 << 3 | koksma_rng_next(&t) >> 61]++;
    }
    check_even(streams, 64);
    check_even(seeds, 64);
    check_even(pairs, 64);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("rng");
    TCase *tc = tcase_create("values");

    suite_add_tcase(suite, tc);
    tcase_add_test(tc, follows_the_recurrence);
    tcase_add_test(tc, published_values);
    tcase_add_test(tc, skipping_is_stepping);
    tcase_add_test(tc, unit_is_the_leading_bits);

    tc = tcase_create("statistics");
    suite_add_tcase(suite, tc);
    tcase_add_test(tc, units_are_even);
    tcase_add_test(tc, below_is_even);
    tcase_add_test(tc, below_is_even_for_large_n);
    tcase_add_test(tc, below_one);
    tcase_add_test(tc, streams_are_apart);
    tcase_add_test(tc, neighbours_are_unrelated);
    return oracle_run(suite);
}
