/* Nets: how many points of a block fall into each elementary interval, counted in
 * integer digits; scrambled or not, and for the radical inverses a coordinate at a
 * time. */
#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gen_fixture.h"
#include "oracle.h"

enum { DIMS = 5, POINTS = 6561 };

static double x[POINTS * DIMS];
static uint32_t digits[POINTS]
                      [DIMS]; /* the first m of each coordinate, as a number */

static uint32_t power(uint32_t b, unsigned m)
{
    uint32_t p = 1;

    while (m-- > 0)
        p *= b;
    return p;
}

/* Coordinates of unscrambled blocks are multiples of b^-m but for the rounding, if
 * the block starts at 0; otherwise places behind the m-th are cut off. */
static void take_digits(uint32_t b, unsigned m, size_t dim)
{
    double p = power(b, m);

    for (size_t i = 0; i < power(b, m); i++)
        for (size_t k = 0; k < dim; k++)
            digits[i][k] = (uint32_t)floor(x[i * dim + k] * p + 0x1p-30);
}

/* Whether all intervals b^-d_1 ... b^-d_dim have b^t points, where the d_k add up
 * to m - t. */
static bool is_net(uint32_t b, unsigned m, unsigned t, size_t dim)
{
    unsigned d[DIMS] = {0};
    static uint32_t count[POINTS];

    for (d[0] = m - t;;) {
        size_t k = 0;

        memset(count, 0, power(b, m - t) * sizeof *count);
        for (size_t i = 0; i < power(b, m); i++) {
            uint32_t cell = 0;

            for (size_t l = 0; l < dim; l++)
                cell = cell * power(b, d[l]) + digits[i][l] / power(b, m - d[l]);
            if (++count[cell] > power(b, t)) return false;
        }
        /* The next composition: one from the first that has any to its right. */
        while (k < dim && d[k] == 0)
            k++;
        if (k + 1 >= dim) return true;
        d[k + 1]++;
        d[0] = d[k] - 1;
        if (k > 0) d[k] = 0;
    }
}

static unsigned quality(uint32_t b, unsigned m, size_t dim)
{
    unsigned t = 0;

    while (!is_net(b, m, t, dim))
        t++;
    return t;
}

static const struct net {
    const char *name;
    uint32_t b;
    unsigned t[DIMS + 1]; /* at most, by dimension: the degrees less 1 added up */
    size_t dim;
    unsigned most; /* digits */
} nets[] = {
    {"sobol", 2, {0, 0, 0, 1, 3, 5}, 2, 9},
    {"sobol", 2, {0, 0, 0, 1, 3, 5}, 3, 9},
    {"sobol", 2, {0, 0, 0, 1, 3, 5}, 5, 9},
    {"niederreiter", 2, {0, 0, 0, 1, 3, 5}, 2, 9},
    {"niederreiter", 2, {0, 0, 0, 1, 3, 5}, 4, 9},
    {"niederreiter", 2, {0, 0, 0, 1, 3, 5}, 5, 9},
    {"faure", 2, {0}, 2, 9},
    {"faure", 3, {0}, 3, 7},
    {"faure", 5, {0}, 4, 4},
    {"faure", 5, {0}, 5, 4},
    {"vandercorput", 2, {0}, 1, 9},
};

START_TEST(blocks_are_nets)
{
    const struct net *net = &nets[_i];
    koksma_gen_opts o = {.dim = net->dim, .n = 1};
    koksma_gen *g = open_family(net->name, &o);

    if (net->dim > 1) ck_assert_uint_eq(koksma_gen_net(g), net->b);
    koksma_gen_close(g);
    for (unsigned m = 1; m <= net->most; m++)
        for (uint64_t block = 0; block < 3; block++) {
            unsigned plain = 0, worst = net->t[net->dim];

            o.n = power(net->b, m);
            o.start = block * block * 7 * o.n;
            for (int how = KOKSMA_SCRAMBLE_NONE; how <= KOKSMA_SCRAMBLE_MATRIX;
                 how++) {
                unsigned t;

                if (how == KOKSMA_SCRAMBLE_MATRIX &&
                    !(koksma_gen_find(net->name)->takes & KOKSMA_TAKES_MATRIX))
                    continue;
                o.scramble = (koksma_scramble)how;
                fill_all(x, net->name, o);
                take_digits(net->b, m, net->dim);
                t = quality(net->b, m, net->dim);
                if (how == KOKSMA_SCRAMBLE_NONE) plain = t;
                if (t > worst || t != plain)
                    ck_abort_msg("block %ju of %ju, scrambling %d: t is %u",
                                 (uintmax_t)block, (uintmax_t)o.n, how, t);
            }
        }
}
END_TEST

/* A shift modulo 1 leaves no net, of no quality worth the name. */
START_TEST(shifted_blocks_are_none)
{
    koksma_gen_opts o = {.dim = 2, .n = 256, .scramble = KOKSMA_SCRAMBLE_SHIFT};
    size_t nets_left = 0;

    for (o.seed = 0; o.seed < 50; o.seed++) {
        fill_all(x, "sobol", o);
        take_digits(2, 8, 2);
        nets_left += is_net(2, 8, 0, 2);
    }
    ck_assert_uint_le(nets_left, 2);
}
END_TEST

/* In a row as the first points of Faure's sequence in base 3 come in the
 * literature: 0, then thirds, then ninths. */
START_TEST(faure_as_published)
{
    static const uint32_t want[9][3] = {{0, 0, 0}, {3, 3, 3}, {6, 6, 6},
                                        {1, 4, 7}, {4, 7, 1}, {7, 1, 4},
                                        {2, 8, 5}, {5, 2, 8}, {8, 5, 2}};

    fill_all(x, "faure", (koksma_gen_opts){.dim = 3, .n = 9});
    for (size_t i = 0; i < 27; i++)
        ck_assert(x[i] == truncated(want[i / 3][i % 3], 9));
}
END_TEST

/* Digits as the definition has them, binomial coefficients by additions: at the end
 * of the sequence, and with as many dimensions as there are. */
START_TEST(faure_by_definition)
{
    static const struct {
        size_t dim;
        uint64_t start;
    } tried[] = {
        {7, 0}, {7, UINT64_MAX - 19}, {50, 123456789012345u}, {1000, 5000}};

    for (size_t at = 0; at < 4; at++) {
        koksma_gen_opts o = {
            .dim = tried[at].dim, .n = 20, .start = tried[at].start};
        uint32_t b = (uint32_t)o.dim;
        bool prime = false;

        for (; !prime; b += !prime) {
            prime = true;
            for (uint32_t d = 2; d < b; d++)
                if (b % d == 0) prime = false;
        }
        fill_all(x, "faure", o);
        for (size_t i = 0; i < o.n; i++)
            for (size_t k = 0; k < o.dim; k += 1 + k / 7) {
                uint64_t c[64] = {1}, y[64] = {0}, index = o.start + i;
                ki_u128 r = 0, p = 1;

                /* c: C(s,j) k^(s-j) for j = 0, ..., s, from row s to row s + 1. */
                for (unsigned s = 0; index > 0; s++, index /= b, p *= b) {
                    for (unsigned j = 0; j <= s; j++)
                        y[j] = (y[j] + c[j] * (index % b)) % b;
                    for (unsigned j = s + 1; j > 0; j--)
                        c[j] = (c[j - 1] + (j <= s ? k * c[j] : 0)) % b;
                    c[0] = c[0] * k % b;
                }
                for (ki_u128 q = 1, j = 0; q < p; q *= b, j++)
                    r = r * b + y[j];
                if (x[i * o.dim + k] != truncated(r, p))
                    ck_abort_msg("dim %zu, point %zu, coordinate %zu: %a", o.dim, i,
                                 k, x[i * o.dim + k]);
            }
    }
}
END_TEST

/* The first points of GSL's and of TOMS 738's Niederreiter sequence. */
START_TEST(niederreiter_as_published)
{
    static const double want[6][5] = {
        {0, 0, 0, 0, 0},
        {0.5, 0.5, 0.75, 0.875, 0.875},
        {0.75, 0.25, 0.3125, 0.140625, 0.140625},
        {0.25, 0.75, 0.5625, 0.765625, 0.765625},
    };

    fill_all(x, "niederreiter", (koksma_gen_opts){.dim = 5, .n = 4});
    for (size_t i = 0; i < 20; i++)
        ck_assert(x[i] == want[i / 5][i % 5]);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("gen_nets");
    TCase *tc = tcase_create("nets");

    suite_add_tcase(suite, tc);
    tcase_add_loop_test(tc, blocks_are_nets, 0, sizeof nets / sizeof *nets);
    tcase_add_test(tc, shifted_blocks_are_none);

    tc = tcase_create("values");
    suite_add_tcase(suite, tc);
    tcase_add_test(tc, faure_as_published);
    tcase_add_test(tc, faure_by_definition);
    tcase_add_test(tc, niederreiter_as_published);
    return oracle_run(suite);
}
