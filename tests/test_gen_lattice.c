/* Lattices and Kronecker sequences against multiplication by additions, and their
 * irrational numbers against their equations in exact integers. */
#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gen_fixture.h"
#include "oracle.h"

static double x[ROOM];

/* ---- Exact integers: LIMBS of 16 bits, the lowest first ---------------------- */

enum { LIMBS = 64 * 8 };
typedef struct whole {
    uint32_t limb[LIMBS];
} whole;

static whole from(ki_u128 v, size_t at)
{
    whole w = {{0}};

    for (; v > 0; v >>= 16)
        w.limb[at++] = (uint32_t)(v & 0xffff);
    return w;
}

static whole times(const whole *a, const whole *b)
{
    whole w = {{0}};

    for (size_t i = 0; i < LIMBS; i++)
        for (size_t j = 0; a->limb[i] > 0 && i + j < LIMBS; j++) {
            uint32_t sum = w.limb[i + j] + a->limb[i] * b->limb[j];

            w.limb[i + j] = sum & 0xffff;
            for (size_t k = i + j + 1; sum >>= 16, sum > 0 && k < LIMBS; k++) {
                sum += w.limb[k];
                w.limb[k] = sum & 0xffff;
            }
        }
    return w;
}

static whole plus(const whole *a, const whole *b)
{
    whole w;
    uint32_t sum = 0;

    for (size_t i = 0; i < LIMBS; i++, sum >>= 16) {
        sum += a->limb[i] + b->limb[i];
        w.limb[i] = sum & 0xffff;
    }
    return w;
}

static bool less(const whole *a, const whole *b)
{
    for (size_t i = LIMBS; i-- > 0;)
        if (a->limb[i] != b->limb[i]) return a->limb[i] < b->limb[i];
    return false;
}

/* (s + f)^2 <= p < (s + f + 2^-128)^2, in units of 2^-256. */
START_TEST(roots)
{
    static const uint32_t primes[] = {2, 3, 5, 97, 7919, 65537, 4294967291u};

    for (size_t i = 0; i < sizeof primes / sizeof *primes; i++) {
        ki_u128 f = ki_root_fraction(primes[i]);
        whole root = from(f, 0), one = from(1, 0), p = from(primes[i], 16), square;

        root.limb[8] = (uint32_t)sqrt((double)primes[i]);
        square = times(&root, &root);
        ck_assert(!less(&p, &square));
        root = plus(&root, &one);
        square = times(&root, &root);
        ck_assert(less(&p, &square));
    }
    /* As FIPS 180-4 prints it for SHA-512. */
    ck_assert_uint_eq((uint64_t)(ki_root_fraction(19) >> 64), 0x5be0cd19137e2179u);
}
END_TEST

/* g^dim (2^128 + g) with g in units of 2^-128 is below 1 for g and above it for the
 * next, and the powers are those of g, cut off. */
START_TEST(golden_ratios)
{
    static const size_t dims[] = {1, 2, 3, 10, 29};
    ki_u128 alpha[29];

    for (size_t i = 0; i < sizeof dims / sizeof *dims; i++) {
        size_t dim = dims[i];
        whole one = from(1, 8 * (dim + 1));

        ki_golden_powers(alpha, dim);
        for (ki_u128 more = 0; more < 2; more++) {
            whole g = from(alpha[0] + more, 0), sum = from(1, 8);

            sum = plus(&sum, &g);
            for (size_t k = 0; k < dim; k++) {
                /* sum is now (1 + g) g^k; g^(k+1) lies between that of g and of the
                 * next number, and so does what is cut off from it. */
                whole power = g, here = from(alpha[k], 8 * k);

                for (size_t j = 0; j < k; j++)
                    power = times(&power, &g);
                if (more == 1) ck_assert(less(&here, &power));
                here = from(alpha[k] + 1, 8 * k);
                if (more == 0) ck_assert(less(&power, &here));
                sum = times(&sum, &g);
            }
            ck_assert(less(&sum, &one) == (more == 0));
        }
    }
    ki_golden_powers(alpha, 1);
    ck_assert_uint_eq((uint64_t)(alpha[0] >> 64), 0x9e3779b97f4a7c15u);
}
END_TEST

/* i times v, modulo m or 2^128. */
static ki_u128 multiple(uint64_t i, ki_u128 v, ki_u128 m)
{
    ki_u128 sum = 0;

    for (; i > 0; i /= 2) {
        if (i % 2 > 0) sum += v;
        v += v;
        if (m > 0) sum %= m, v %= m;
    }
    return sum;
}

static const uint64_t starts[] = {0, 1000003, (uint64_t)1 << 53, UINT64_MAX - 299};

START_TEST(kronecker_sequences)
{
    static const double given[] = {0.6180339887498949, 3.14159265358979, 0x1p53,
                                   0x1p-60, 0.0};

    for (size_t s = 0; s < 4; s++) {
        koksma_gen_opts o = {.dim = 5, .n = 300, .start = starts[s]}, own = o;
        ki_u128 alpha[3][5];
        static const uint32_t prime[] = {2, 3, 5, 7, 11};
        static const char *const names[] = {"richtmyer", "rsequence", "kronecker"};

        own.alpha = given;
        own.alpha_size = 5;
        ki_golden_powers(alpha[1], 5);
        for (size_t k = 0; k < 5; k++) {
            double places = fmod(given[k], 1.0);

            alpha[0][k] = ki_root_fraction(prime[k]);
            alpha[2][k] = 0;
            for (int bit = 127; bit >= 0; bit--) {
                places *= 2.0;
                if (places >= 1.0) alpha[2][k] |= (ki_u128)1 << bit;
                places = fmod(places, 1.0);
            }
        }
        for (size_t f = 0; f < 3; f++) {
            fill_all(x, names[f], f < 2 ? o : own);
            for (size_t i = 0; i < o.n; i++)
                for (size_t k = 0; k < 5; k++) {
                    ki_u128 product = multiple(o.start + i, alpha[f][k], 0);

                    if (!(x[i * 5 + k] ==
                          (double)(uint64_t)(product >> 75) * 0x1p-53))
                        ck_abort_msg("point %zu", i);
                }
        }
    }
}
END_TEST

START_TEST(lattices)
{
    static const uint64_t sizes[] = {1,         2, 5, 1000, ((uint64_t)1 << 53) + 5,
                                     UINT64_MAX};
    static const uint64_t vector[] = {1, 3, 182667, UINT64_MAX, 0};

    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        koksma_gen_opts o = {
            .dim = 5, .n = sizes[s], .vector = vector, .vector_size = 5};
        size_t count = o.n < 300 ? (size_t)o.n : 300;
        ki_u128 a = 1;

        for (uint64_t first = 0;; first = o.n - count) {
            fill_some(x, "lattice", o, first, count);
            for (size_t i = 0; i < count * 5; i++)
                ck_assert(
                    x[i] ==
                    truncated(multiple(first + i / 5, vector[i % 5], o.n), o.n));
            if (first == o.n - count) break;
        }
        o.vector = vector + 2;
        o.vector_size = 1;
        fill_some(x, "korobov", o, o.n - count, count);
        for (size_t k = 0; k < 5; k++, a = a * vector[2] % o.n)
            for (size_t i = 0; i < count; i++)
                if (!(x[i * 5 + k] ==
                      truncated(multiple(o.n - count + i, a, o.n), o.n)))
                    ck_abort_msg("point %zu", i);
    }
}
END_TEST

START_TEST(fibonacci)
{
    uint64_t before = 1, n = 1;

    for (int m = 2; m < 93; m++) {
        koksma_gen_opts o = {.dim = 2, .n = n};
        size_t count = n < 50 ? (size_t)n : 50;
        uint64_t sum = before + n;

        fill_some(x, "fibonacci", o, n - count, count);
        for (size_t i = 0; i < count; i++) {
            uint64_t index = n - count + i;

            ck_assert(x[2 * i] == truncated(index, n));
            ck_assert(x[2 * i + 1] == truncated(multiple(index, before, n), n));
        }
        before = n;
        n = sum;
    }
}
END_TEST

/* Random shifts keep the differences of a lattice's points, modulo 1. */
START_TEST(shifted_lattice)
{
    koksma_gen_opts o = {.dim = 2, .n = 89, .scramble = KOKSMA_SCRAMBLE_SHIFT};

    fill_all(x, "fibonacci", o);
    for (size_t i = 0; i < 89; i++) {
        double want = fmod((double)(i * 55 % 89) / 89.0, 1.0);
        double got = fmod(x[2 * i + 1] - x[1] + 1.0, 1.0);

        ck_assert(fabs(got - want) < 1e-15 || fabs(fabs(got - want) - 1.0) < 1e-15);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("gen_lattice");
    TCase *tc = tcase_create("irrational numbers");

    suite_add_tcase(suite, tc);
    tcase_add_test(tc, roots);
    tcase_add_test(tc, golden_ratios);

    tc = tcase_create("points");
    suite_add_tcase(suite, tc);
    tcase_add_test(tc, kronecker_sequences);
    tcase_add_test(tc, lattices);
    tcase_add_test(tc, fibonacci);
    tcase_add_test(tc, shifted_lattice);
    return oracle_run(suite);
}
