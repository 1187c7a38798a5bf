/* What scrambling keeps and what it leaves to chance.  Statistics have fixed seeds,
 * so that what passes once passes always; each would fail by chance in fewer than
 * one of 10^5 choices of seeds. */
#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gen_fixture.h"
#include "oracle.h"

static double plain[ROOM], room[ROOM];

static double chi_square(const size_t *cell, size_t cells, size_t draws)
{
    double expected = (double)draws / (double)cells, chi = 0.0;

    for (size_t i = 0; i < cells; i++)
        chi += pow((double)cell[i] - expected, 2.0) / expected;
    return chi;
}

/* What chi-square of so many cells exceeds by chance once in 10^5, by the cube root
 * of Wilson and Hilferty (1931). */
static double most(size_t cells)
{
    double f = (double)cells - 1.0, z = 4.265;

    return f * pow(1.0 - 2.0 / (9.0 * f) + z * sqrt(2.0 / (9.0 * f)), 3.0);
}

/* How many of the first 53 binary places two coordinates have in common. */
static int common(double a, double b)
{
    uint64_t differ = (uint64_t)(a * 0x1p53) ^ (uint64_t)(b * 0x1p53);

    return differ > 0 ? __builtin_clzll(differ) - 11 : 53;
}

static const koksma_scramble digital[] = {
    KOKSMA_SCRAMBLE_DIGITS, KOKSMA_SCRAMBLE_MATRIX, KOKSMA_SCRAMBLE_OWEN};

/* All three keep how many places two points share, which is what makes nets of
 * nets; a shift modulo 1 does not. */
START_TEST(binary_scrambling_keeps_common_places)
{
    static const uint64_t starts[] = {0, 1000, ((uint64_t)1 << 40) - 75, 77777777};

    for (size_t s = 0; s < 4; s++) {
        koksma_gen_opts o = {.dim = 6, .n = 150, .start = starts[s], .seed = s};
        size_t kept = 0;

        fill_all(plain, "sobol", o);
        for (size_t how = 0; how < 3; how++) {
            o.scramble = digital[how];
            fill_all(room, "sobol", o);
            for (size_t i = 0; i < o.n; i++)
                for (size_t j = 0; j < i; j++)
                    for (size_t k = 0; k < o.dim; k++)
                        if (common(room[i * o.dim + k], room[j * o.dim + k]) !=
                            common(plain[i * o.dim + k], plain[j * o.dim + k]))
                            ck_abort_msg("scrambling %zu, points %zu and %zu", how,
                                         i, j);
        }
        o.scramble = KOKSMA_SCRAMBLE_SHIFT;
        fill_all(room, "sobol", o);
        for (size_t i = o.dim; i < o.n * o.dim; i++)
            kept += common(room[i], room[i % o.dim]) ==
                    common(plain[i], plain[i % o.dim]);
        ck_assert_uint_lt(kept, 9 * o.n * o.dim / 10);
    }
}
END_TEST

/* A digital shift adds the same to all points; a matrix adds what depends on the
 * places in front, in the same way whatever they are added to; nesting neither. */
START_TEST(what_the_flips_depend_on)
{
    for (size_t how = 0; how < 3; how++) {
        koksma_gen_opts o = {.dim = 5, .n = 64, .scramble = digital[how]};
        size_t constant = 0, linear = 0, tried = 0;

        fill_all(room, "sobol", o);
        o.scramble = KOKSMA_SCRAMBLE_NONE;
        fill_all(plain, "sobol", o);
        for (size_t k = 0; k < 5; k++)
            for (size_t i = 1; i < 64; i++)
                for (size_t j = 1; j < i; j++) {
                    uint64_t flip[4];
                    size_t at[4] = {0, i, j, 0};

                    /* The point whose plain places are the sum of i's and j's. */
                    while (((uint64_t)(plain[i * 5 + k] * 64) ^
                            (uint64_t)(plain[j * 5 + k] * 64)) !=
                           (uint64_t)(plain[at[3] * 5 + k] * 64))
                        at[3]++;
                    for (size_t a = 0; a < 4; a++)
                        flip[a] = (uint64_t)(plain[at[a] * 5 + k] * 0x1p53) ^
                                  (uint64_t)(room[at[a] * 5 + k] * 0x1p53);
                    tried++;
                    constant += flip[0] == flip[1];
                    linear += (flip[0] ^ flip[1] ^ flip[2] ^ flip[3]) == 0;
                }
        ck_assert_uint_eq(constant == tried,
                          digital[how] == KOKSMA_SCRAMBLE_DIGITS);
        ck_assert_uint_eq(linear == tried, digital[how] != KOKSMA_SCRAMBLE_OWEN);
        if (digital[how] == KOKSMA_SCRAMBLE_OWEN)
            ck_assert_uint_lt(linear, tried / 100);
    }
}
END_TEST

/* Numbers that first differ in place d have the flips of places 0, ..., d in
 * common, and those behind with a chance of a half each: all 64 places, and every
 * d. */
START_TEST(nested_flips)
{
    oracle_rng rng = oracle_rng_start(oracle_seed(), 0);
    ki_owen *o = malloc(sizeof *o);

    ck_assert_ptr_nonnull(o);
    for (unsigned d = 0; d<64; d += d> 10 && d < 55 ? 7 : 1) {
        size_t equal[64] = {0}, ones[64] = {0};

        for (uint64_t round = 0; round < 400; round++) {
            uint64_t high = oracle_below(&rng, (uint64_t)1 << 32), y[2], flip[2];

            ki_owen_init(o, koksma_rng_seed(d, round));
            y[0] = high << 32 | oracle_below(&rng, (uint64_t)1 << 32);
            y[1] = y[0] ^ (uint64_t)1 << (63 - d);
            memcpy(flip, y, sizeof y);
            ki_owen_scramble(o, flip, 2);
            flip[0] ^= y[0];
            flip[1] ^= y[1];
            for (unsigned place = 0; place < 64; place++) {
                equal[place] += !((flip[0] ^ flip[1]) >> (63 - place) & 1);
                ones[place] += flip[0] >> (63 - place) & 1;
            }
        }
        /* 5.8 spreads of 10: some 4000 looks, and 1 in 10^5. */
        for (unsigned place = 0; place < 64; place++) {
            if (place <= d)
                ck_assert_uint_eq(equal[place], 400);
            else
                ck_assert(fabs((double)equal[place] - 200.0) < 58.0);
            ck_assert(fabs((double)ones[place] - 200.0) < 58.0);
        }
    }
    free(o);
}
END_TEST

/* Numbers side by side become what they become one at a time. */
START_TEST(nested_blocks)
{
    oracle_rng rng = oracle_rng_start(oracle_seed(), 1);
    uint64_t y[KI_OWEN_RUN + 1], one;
    ki_owen *o = malloc(sizeof *o);

    ck_assert_ptr_nonnull(o);
    ki_owen_init(o, koksma_rng_seed(oracle_seed(), 3));
    for (size_t round = 0; round < 300; round++) {
        size_t count = round < 20 ? 256 - round : 1 + oracle_below(&rng, 256);
        uint64_t rest = oracle_below(&rng, (uint64_t)1 << 56), was[KI_OWEN_RUN];

        if (round % 3 == 0) rest &= -rest;
        for (size_t i = 0; i < count; i++)
            was[i] = y[i] = oracle_below(&rng, 256) << 56 | rest;
        if (round % 2 == 0) was[count / 2] = y[count / 2] ^= oracle_below(&rng, 9);
        y[count] = 77;
        ki_owen_scramble(o, y, count);
        ck_assert_uint_eq(y[count], 77);
        for (size_t i = 0; i < count; i++) {
            one = was[i];
            ki_owen_scramble(o, &one, 1);
            ck_assert_uint_eq(one, y[i]);
        }
    }
    free(o);
}
END_TEST

static const struct how {
    const char *name;
    koksma_scramble scramble;
    uint64_t start;
} hows[] = {
    {"sobol", KOKSMA_SCRAMBLE_DIGITS, 0},
    {"sobol", KOKSMA_SCRAMBLE_DIGITS, 12345},
    {"sobol", KOKSMA_SCRAMBLE_MATRIX, 0},
    {"sobol", KOKSMA_SCRAMBLE_MATRIX, 12345},
    {"sobol", KOKSMA_SCRAMBLE_OWEN, 0},
    {"sobol", KOKSMA_SCRAMBLE_OWEN, 12345},
    {"sobol", KOKSMA_SCRAMBLE_SHIFT, 0},
    {"halton", KOKSMA_SCRAMBLE_DIGITS, 12345},
    {"halton", KOKSMA_SCRAMBLE_OWEN, 0},
    {"halton", KOKSMA_SCRAMBLE_OWEN, 12345},
    {"halton", KOKSMA_SCRAMBLE_SHIFT, 99},
    {"faure", KOKSMA_SCRAMBLE_DIGITS, 7},
    {"faure", KOKSMA_SCRAMBLE_OWEN, 12345},
    {"niederreiter", KOKSMA_SCRAMBLE_OWEN, 12345},
    {"richtmyer", KOKSMA_SCRAMBLE_SHIFT, 3},
    {"grid", KOKSMA_SCRAMBLE_SHIFT, 0},
};

/* The first of the looks at DRAWS points of three coordinates that finds them not
 * uniform: in 64 intervals of each coordinate, in 100 squares of each pair, in
 * places 20 to 26; or NULL. */
enum { DRAWS = 3200 };

static const char *not_uniform(const double *x)
{
    for (size_t k = 0; k < 3; k++) {
        size_t one[64] = {0}, two[100] = {0}, deep[64] = {0};

        for (size_t i = 0; i < DRAWS; i++) {
            double a = x[3 * i + k], b = x[3 * i + (k + 1) % 3];

            one[(size_t)(a * 64.0)]++;
            two[(size_t)(a * 10.0) * 10 + (size_t)(b * 10.0)]++;
            deep[(size_t)ldexp(a, 26) % 64]++;
        }
        if (!(chi_square(one, 64, DRAWS) < most(64))) return "intervals";
        if (!(chi_square(two, 100, DRAWS) < most(100))) return "squares";
        if (!(chi_square(deep, 64, DRAWS) < most(64))) return "places";
    }
    return NULL;
}

/* A point by itself is uniform in the cube over the seeds. */
START_TEST(single_points_are_uniform)
{
    const struct how *how = &hows[_i];
    const char *found;

    for (uint64_t seed = 0; seed < DRAWS; seed++) {
        koksma_gen_opts o = {
            .dim = 3, .n = 1, .start = how->start, .scramble = how->scramble};

        *(seed % 2 == 0 ? &o.seed : &o.replicate) = 1 + seed / 2;
        fill_all(room + 3 * seed, how->name, o);
    }
    found = not_uniform(room);
    ck_assert_msg(found == NULL, "%s, scrambling %d: not uniform in %s", how->name,
                  (int)how->scramble, found);
}
END_TEST

/* What the looks would find of it: a digit that is not permuted, one draw for two
 * coordinates, permutations of the first places alone, and a 0 and a 1 that change
 * places a little too rarely. */
START_TEST(defects_are_found)
{
    static const char *const by[] = {NULL, "intervals", "squares", "places",
                                     "intervals"};
    double *bad = room;

    for (int defect = 0; defect < 5; defect++) {
        koksma_gen_opts o = {.dim = 3, .n = DRAWS, .seed = 8};
        const char *found;

        fill_all(bad, "random", o);
        for (size_t i = 0; i < DRAWS; i++) {
            double *x = bad + 3 * i;

            if (defect == 1) x[0] /= 2.0;
            if (defect == 2) x[1] = x[0];
            if (defect == 3) x[0] = ldexp(floor(ldexp(x[0], 22)), -22);
            if (defect == 4 && x[0] >= 0.5 && i % 4 == 0) x[0] -= 0.5;
        }
        found = not_uniform(bad);
        ck_assert_msg(found == by[defect] || (found != NULL && by[defect] != NULL &&
                                              strcmp(found, by[defect]) == 0),
                      "defect %d found by %s", defect,
                      found != NULL ? found : "none");
    }
}
END_TEST

/* Where Sobol's points 0 and 1 go, places 2 and 3 of each: together with a digital
 * shift, and independently of each other with a matrix and when nested. */
START_TEST(pairs_of_points)
{
    static const size_t reached[] = {4, 16, 16};

    for (size_t how = 0; how < 3; how++) {
        size_t cell[16] = {0}, seen = 0;

        for (uint64_t seed = 0; seed < DRAWS; seed++) {
            koksma_gen_opts o = {
                .dim = 2, .n = 2, .seed = seed, .scramble = digital[how]};

            fill_all(room, "sobol", o);
            cell[((size_t)(room[1] * 8.0) & 3) * 4 +
                 ((size_t)(room[3] * 8.0) & 3)]++;
        }
        for (size_t i = 0; i < 16; i++)
            seen += cell[i] > 0;
        ck_assert_uint_eq(seen, reached[how]);
        if (seen == 16) ck_assert_double_lt(chi_square(cell, 16, DRAWS), most(16));
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("gen_scramble");
    TCase *tc = tcase_create("structure");

    suite_add_tcase(suite, tc);
    tcase_add_test(tc, binary_scrambling_keeps_common_places);
    tcase_add_test(tc, what_the_flips_depend_on);
    tcase_add_test(tc, nested_flips);
    tcase_add_test(tc, nested_blocks);

    tc = tcase_create("chance");
    suite_add_tcase(suite, tc);
    tcase_set_tags(tc, "slow");
    tcase_add_loop_test(tc, single_points_are_uniform, 0,
                        sizeof hows / sizeof *hows);

    tc = tcase_create("pairs");
    suite_add_tcase(suite, tc);
    tcase_add_test(tc, defects_are_found);
    tcase_add_test(tc, pairs_of_points);
    return oracle_run(suite);
}
