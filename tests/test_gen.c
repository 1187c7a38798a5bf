/* gen.h: the families that count, what all families promise of pieces and seeds,
 * and every refusal.  test_gen_digits.c has the digits of sequences. */
#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gen_fixture.h"
#include "oracle.h"

static double room[ROOM], other[ROOM];

/* Coordinate 0 is i/n, whatever n is; the others are Halton's. */
START_TEST(hammersley)
{
    static const uint64_t sizes[] = {1,         2, 7, 1000, ((uint64_t)1 << 53) + 1,
                                     UINT64_MAX};

    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        koksma_gen_opts o = {.dim = 4, .n = sizes[s]};
        size_t count = o.n < 1000 ? (size_t)o.n : 1000;

        fill_some(room, "hammersley", o, o.n - count, count);
        for (size_t i = 0; i < count; i++) {
            uint64_t index = o.n - count + i;

            ck_assert(room[4 * i] == truncated(index, o.n));
            for (size_t k = 0; k < 3; k++)
                ck_assert(room[4 * i + 1 + k] == inverse(index, bases[k]));
        }
    }
    fill_all(room, "hammersley", (koksma_gen_opts){.dim = 1, .n = 10});
    ck_assert(room[3] == 0x1.3333333333333p-2); /* the double below 3/10 */
}
END_TEST

/* What each family is asked for where all of them are tried. */
static const struct sample {
    const char *name;
    koksma_gen_opts o;
} samples[] = {
    {"halton", {.dim = 5, .n = 700}},
    {"halton", {.dim = 8, .n = 700, .bases = bases}},
    {"halton", {.dim = 5, .n = 700, .scramble = KOKSMA_SCRAMBLE_DIGITS, .seed = 9}},
    {"hammersley", {.dim = 5, .n = 700}},
    {"hammersley",
     {.dim = 5, .n = 700, .scramble = KOKSMA_SCRAMBLE_DIGITS, .replicate = 3}},
    {"halton", {.dim = 5, .n = 700, .scramble = KOKSMA_SCRAMBLE_SHIFT}},
    {"halton", {.dim = 5, .n = 700, .leap = 23, .baker = true}},
    {"sobol", {.dim = 50, .n = 700}},
    {"sobol", {.dim = 50, .n = 700, .leap = 3}},
    {"sobol", {.dim = 9, .n = 700, .scramble = KOKSMA_SCRAMBLE_DIGITS, .seed = 4}},
    {"sobol", {.dim = 9, .n = 700, .scramble = KOKSMA_SCRAMBLE_MATRIX}},
    {"sobol", {.dim = 9, .n = 700, .scramble = KOKSMA_SCRAMBLE_OWEN}},
    {"sobol", {.dim = 9, .n = 700, .scramble = KOKSMA_SCRAMBLE_SHIFT}},
    {"grid", {.dim = 3, .n = 729, .scramble = KOKSMA_SCRAMBLE_SHIFT}},
    {"halton", {.dim = 5, .n = 700, .scramble = KOKSMA_SCRAMBLE_OWEN}},
    {"vandercorput", {.dim = 1, .n = 700}},
    {"faure", {.dim = 5, .n = 700}},
    {"faure", {.dim = 6, .n = 700, .scramble = KOKSMA_SCRAMBLE_DIGITS}},
    {"faure", {.dim = 6, .n = 700, .scramble = KOKSMA_SCRAMBLE_OWEN, .leap = 6}},
    {"niederreiter", {.dim = 20, .n = 700}},
    {"niederreiter", {.dim = 20, .n = 700, .scramble = KOKSMA_SCRAMBLE_OWEN}},
    {"richtmyer", {.dim = 5, .n = 700}},
    {"rsequence", {.dim = 5, .n = 700, .leap = 10}},
    {"kronecker",
     {.dim = 2, .n = 700, .alpha = (const double[]){0.1, 2.7}, .alpha_size = 2}},
    {"lattice",
     {.dim = 2, .n = 700, .vector = (const uint64_t[]){1, 701}, .vector_size = 2}},
    {"korobov",
     {.dim = 9, .n = 700, .vector = (const uint64_t[]){33}, .vector_size = 1}},
    {"fibonacci", {.dim = 2, .n = 610, .baker = true}},
    {"zaremba", {.dim = 2, .n = 512}},
    {"jittered", {.dim = 3, .n = 729}},
    {"latin", {.dim = 3, .n = 700}},
    {"multijittered", {.dim = 3, .n = 729}},
    {"poisson", {.dim = 2, .n = 200, .torus = true}},
    {"random", {.dim = 3, .n = 700, .seed = 5}},
    {"grid", {.dim = 3, .n = 729}},
    {"centred", {.dim = 6, .n = 729}},
};
enum { SAMPLES = sizeof samples / sizeof *samples };

/* A set filled in pieces of any length, in any order, is the set filled at once;
 * and so is a sequence that starts later or is asked for more. */
START_TEST(pieces)
{
    static const uint64_t starts[] = {0,
                                      1,
                                      63,
                                      65536,
                                      ((uint64_t)1 << 53) - 350,
                                      ((uint64_t)1 << 54) - 350,
                                      UINT64_MAX - 699};
    const struct sample *s = &samples[_i];
    bool sequence = koksma_gen_find(s->name)->takes & KOKSMA_TAKES_START;
    oracle_rng rng = oracle_rng_start(oracle_seed(), (uint64_t)_i);
    koksma_gen_opts o = s->o;

    for (size_t at = 0; at < (sequence ? 7 : 1); at++) {
        koksma_gen *g;

        o.start = starts[at];
        if (o.leap > 1 && o.start > UINT64_MAX - o.n * o.leap)
            o.start = UINT64_MAX - (o.n - 1) * o.leap;
        fill_all(room, s->name, o);
        for (size_t i = 0; i < o.n * o.dim; i++)
            if (!(room[i] >= 0.0 && room[i] < 1.0)) ck_abort_msg("%a", room[i]);
        g = open_family(s->name, &o);
        for (int i = 0; i < 40; i++) {
            uint64_t first = oracle_below(&rng, (size_t)o.n + 1);
            size_t count = oracle_below(&rng, (size_t)(o.n - first) + 1);

            if (i % 2 == 0 && count > 3) count = 3;
            other[count * o.dim] = 7.0;
            ck_assert_int_eq(koksma_gen_fill(g, other, first, count, NULL), 0);
            ck_assert_mem_eq(other, room + first * o.dim,
                             count * o.dim * sizeof *room);
            ck_assert(other[count * o.dim] == 7.0);
        }
        koksma_gen_close(g);
        if (!sequence) continue;
        o.start += 100 * (o.leap > 1 ? o.leap : 1);
        o.n -= 100;
        fill_all(other, s->name, o);
        ck_assert_mem_eq(other, room + 100 * o.dim, o.n * o.dim * sizeof *room);
        o.n = 1;
        fill_all(other, s->name, o);
        ck_assert_mem_eq(other, room + 100 * o.dim, o.dim * sizeof *room);
        o.n = s->o.n;
    }
}
END_TEST

/* A seed and a replicate fix every bit; another of either changes most of them
 * where there is anything random, and none where there is not. */
START_TEST(seeds_and_replicates)
{
    const struct sample *s = &samples[_i];
    bool random =
        (koksma_gen_find(s->name)->takes & KOKSMA_TAKES_SEED) || s->o.scramble != 0;

    for (int other_one = 0; other_one < 3; other_one++) {
        koksma_gen_opts o = s->o;
        size_t same = 0;

        fill_all(room, s->name, o);
        if (other_one == 1) o.seed++;
        if (other_one == 2) o.replicate++;
        fill_all(other, s->name, o);
        for (size_t i = 0; i < o.n * o.dim; i++)
            same += room[i] == other[i];
        if (other_one == 0 || !random)
            ck_assert_uint_eq(same, o.n * o.dim);
        else
            ck_assert_uint_lt(same, o.n + 50); /* Hammersley's i/n stay */
    }
}
END_TEST

/* Every digit combination in turn, the last coordinate fastest. */
START_TEST(grids)
{
    static const struct {
        uint64_t m;
        size_t dim;
        bool last; /* only the last points, there are too many */
    } tried[] = {
        {1, 1, false},   {1, 7, false},          {2, 10, false},
        {3, 5, false},   {7, 3, false},          {10, 4, false},
        {49, 2, false},  {1000, 1, false},       {3, 40, true},
        {2, 63, true},   {4294967295u, 2, true}, {2642245, 3, true},
        {7131, 5, true}, {UINT64_MAX, 1, true},
    };

    for (size_t t = 0; t < sizeof tried / sizeof *tried; t++) {
        koksma_gen_opts o = {.dim = tried[t].dim, .n = 1};
        ki_u128 m = tried[t].m;
        size_t count;

        for (size_t k = 0; k < o.dim; k++)
            o.n *= tried[t].m;
        count = tried[t].last ? 100 : (size_t)o.n;
        fill_some(room, "grid", o, o.n - count, count);
        fill_some(other, "centred", o, o.n - count, count);
        for (size_t i = 0; i < count; i++) {
            uint64_t index = o.n - count + i;

            for (size_t k = o.dim; k-- > 0; index /= tried[t].m) {
                ki_u128 digit = index % tried[t].m;

                if (room[i * o.dim + k] != truncated(digit, m) ||
                    other[i * o.dim + k] != truncated(2 * digit + 1, 2 * m))
                    ck_abort_msg("grid %zu, point %zu", t, i);
            }
        }
    }
}
END_TEST

/* Even in each axis, and no axis like another: 10 by 10 cells. */
START_TEST(random_points)
{
    koksma_gen_opts o = {.dim = 3, .n = 20000, .seed = oracle_seed()};

    fill_all(room, "random", o);
    for (size_t k = 0; k < 3; k++) {
        size_t cell[100] = {0};
        double chi = 0.0;

        for (size_t i = 0; i < o.n; i++)
            cell[(size_t)(room[3 * i + k] * 10.0) * 10 +
                 (size_t)(room[3 * i + (k + 1) % 3] * 10.0)]++;
        for (size_t i = 0; i < 100; i++)
            chi += pow((double)cell[i] - 200.0, 2.0) / 200.0;
        ck_assert_double_lt(chi, 100.0 + 5.0 * sqrt(200.0));
    }
}
END_TEST

static const uint32_t base_one[] = {3, 1}, base_zero[] = {0}, shared[] = {4, 9, 6},
                      twice[] = {3, 5, 5};

static const struct refusal {
    const char *family;
    koksma_gen_opts o;
    const char *text;
} refusals[] = {
    {"sobol", {.dim = 0, .n = 1}, "dimension 0: sobol has 1 to 1111"},
    {"sobol", {.dim = 1112, .n = 1}, "dimension 1112: sobol has 1 to 1111"},
    {"halton", {.dim = 0, .n = 1}, NULL},
    {"grid", {.dim = 0, .n = 1}, NULL},
    {"random", {.dim = 2, .n = 0}, "0 points: a set has at least one"},
    {"grid", {.dim = 2, .n = 0}, "0 points: a set has at least one"},
    {"grid",
     {.dim = 2, .n = 4, .start = 1},
     "grid is no sequence: it has no start index"},
    {"hammersley",
     {.dim = 2, .n = 4, .start = 1},
     "hammersley is no sequence: it has no start index"},
    {"halton",
     {.dim = 1, .n = 2, .start = UINT64_MAX},
     "indices reach beyond 2^64 - 1"},
    {"random",
     {.dim = 1, .n = UINT64_MAX, .start = 2},
     "indices reach beyond 2^64 - 1"},
    {"sobol", {.dim = 1, .n = 1, .bases = bases}, "sobol has no bases"},
    {"centred", {.dim = 1, .n = 1, .bases = bases}, "centred has no bases"},
    {"random",
     {.dim = 1, .n = 1, .scramble = KOKSMA_SCRAMBLE_DIGITS},
     "random has no digits to scramble"},
    {"grid",
     {.dim = 1, .n = 1, .scramble = KOKSMA_SCRAMBLE_OWEN},
     "grid has no digits to scramble"},
    {"halton",
     {.dim = 1, .n = 1, .scramble = KOKSMA_SCRAMBLE_MATRIX},
     "halton has no matrices to scramble"},
    {"random", {.dim = 1, .n = 1, .scramble = (koksma_scramble)9}, NULL},
    {"hammersley",
     {.dim = 2, .n = 4, .leap = 2},
     "hammersley is no sequence: it has no leap"},
    {"random",
     {.dim = 1, .n = 3, .leap = (uint64_t)1 << 63},
     "indices reach beyond 2^64 - 1"},
    {"random",
     {.dim = 1, .n = 2, .leap = UINT64_MAX, .start = 1},
     "indices reach beyond 2^64 - 1"},
    {"halton", {.dim = 1, .n = UINT64_MAX, .leap = UINT64_MAX}, NULL},
    {"halton",
     {.dim = 1, .n = 1, .leap = 6, .bases = shared},
     "leap 6 and base 4 have a common factor"},
    {"sobol",
     {.dim = 1, .n = 1, .leap = 6},
     "leap 6 and base 2 have a common factor"},
    {"halton",
     {.dim = 4, .n = 1, .leap = 77},
     "leap 77 and base 7 have a common factor"},
    {"halton",
     {.dim = 2, .n = 1, .bases = base_one},
     "base 1: a base is at least 2"},
    {"halton",
     {.dim = 1, .n = 1, .bases = base_zero},
     "base 0: a base is at least 2"},
    {"halton",
     {.dim = 3, .n = 1, .bases = shared},
     "bases 4 and 6 have a common factor"},
    {"halton",
     {.dim = 3, .n = 1, .bases = twice},
     "bases 5 and 5 have a common factor"},
    {"hammersley",
     {.dim = 4, .n = 1, .bases = shared},
     "bases 4 and 6 have a common factor"},
    {"faure",
     {.dim = 6, .n = 1, .leap = 14},
     "leap 14 and base 7 have a common factor"},
    {"faure", {.dim = 65522, .n = 1}, "dimension 65522: faure has 1 to 65521"},
    {"niederreiter",
     {.dim = 1378, .n = 1},
     "dimension 1378: niederreiter has 1 to 1377"},
    {"vandercorput", {.dim = 2, .n = 1}, NULL},
    {"lattice",
     {.dim = 2, .n = 7},
     "lattice in dimension 2 takes a vector of 2, not of 0"},
    {"korobov",
     {.dim = 2, .n = 7, .vector = (const uint64_t[]){1, 2}, .vector_size = 2},
     "korobov in dimension 2 takes a vector of 1, not of 2"},
    {"kronecker",
     {.dim = 3, .n = 7, .alpha = (const double[]){1, 2}, .alpha_size = 2},
     "kronecker in dimension 3 takes a vector of 3, not of 2"},
    {"kronecker",
     {.dim = 1, .n = 7, .alpha = (const double[]){-0.5}, .alpha_size = 1},
     "multiplier 1 is -0.5, not in [0, 2^53]"},
    {"kronecker",
     {.dim = 1, .n = 7, .alpha = (const double[]){(double)NAN}, .alpha_size = 1},
     NULL},
    {"sobol",
     {.dim = 1, .n = 7, .vector = (const uint64_t[]){1}, .vector_size = 1},
     "sobol takes no vector"},
    {"lattice",
     {.dim = 1, .n = 7, .alpha = (const double[]){1}, .alpha_size = 1},
     "lattice takes no such vector"},
    {"zaremba", {.dim = 2, .n = 48}, "48 points are no power of 2"},
    {"zaremba", {.dim = 1, .n = 8}, "dimension 1: zaremba is plane"},
    {"jittered",
     {.dim = 3, .n = 9},
     "9 points make no grid in 3 dimensions: no m^3"},
    {"multijittered",
     {.dim = 2, .n = 8},
     "8 points make no grid in 2 dimensions: no m^2"},
    {"jittered",
     {.dim = 1, .n = ((uint64_t)1 << 53) + 1},
     "9007199254740993 strata: jittered has 2^53 at most"},
    {"latin",
     {.dim = 1, .n = (uint64_t)1 << 32},
     "4294967296 points: latin has 2^32 - 1 at most"},
    {"poisson",
     {.dim = 1, .n = (uint64_t)1 << 32},
     "4294967296 points: poisson has 2^32 - 1 at most"},
    {"poisson", {.dim = 2, .n = 7, .radius = -0.5}, "radius -0.5: not in [0,1]"},
    {"poisson", {.dim = 2, .n = 7, .radius = (double)NAN}, NULL},
    {"poisson", {.dim = 1, .n = 9, .radius = 0.5}, NULL},
    {"sobol", {.dim = 2, .n = 8, .radius = 0.1}, "sobol keeps no radius"},
    {"random", {.dim = 2, .n = 8, .torus = true}, "random keeps no radius"},
    {"latin",
     {.dim = 1, .n = 8, .scramble = KOKSMA_SCRAMBLE_OWEN},
     "latin has no digits to scramble"},
    {"fibonacci",
     {.dim = 2, .n = 100},
     "100 points: 89 and 144 are Fibonacci numbers"},
    {"fibonacci",
     {.dim = 2, .n = UINT64_MAX},
     "18446744073709551615 points: no Fibonacci number"},
    {"fibonacci", {.dim = 1, .n = 5}, "dimension 1: Fibonacci lattices are plane"},
    {"grid", {.dim = 2, .n = 5}, "5 points make no grid in 2 dimensions: no m^2"},
    {"centred",
     {.dim = 3, .n = 9},
     "9 points make no grid in 3 dimensions: no m^3"},
    {"grid", {.dim = 64, .n = UINT64_MAX}, NULL},
    {"grid", {.dim = 2, .n = UINT64_MAX}, NULL},
    {"grid", {.dim = SIZE_MAX, .n = 2}, NULL},
};

START_TEST(refused)
{
    const struct refusal *r = &refusals[_i];
    koksma_gen *g = (koksma_gen *)room;
    koksma_error err = {0};

    ck_assert_int_eq(koksma_gen_open(&g, koksma_gen_find(r->family), &r->o, &err),
                     KOKSMA_EINVAL);
    ck_assert_int_eq(err.status, KOKSMA_EINVAL);
    ck_assert_uint_gt(strlen(err.text), 0);
    if (r->text != NULL) ck_assert_str_eq(err.text, r->text);
    ck_assert_int_eq(koksma_gen_open(&g, koksma_gen_find(r->family), &r->o, NULL),
                     KOKSMA_EINVAL);
    ck_assert_ptr_eq(g, room);
}
END_TEST

/* What is next to a refusal, and legal: the last index, the fewest bases. */
START_TEST(just_legal)
{
    koksma_gen_opts o = {.dim = 1, .n = 1, .start = UINT64_MAX};

    koksma_gen_close(open_family("halton", &o));
    o = (koksma_gen_opts){.dim = 1, .n = UINT64_MAX, .start = 1};
    koksma_gen_close(open_family("random", &o));
    o = (koksma_gen_opts){.dim = 2, .n = 2, .leap = UINT64_MAX};
    o.bases =
        (const uint32_t[]){2, 7}; /* 2^64 - 1 = 3 5 17 257 641 65537 6700417 */
    koksma_gen_close(open_family("halton", &o));
    o = (koksma_gen_opts){.dim = 2, .n = 3, .bases = shared};
    koksma_gen_close(open_family("halton", &o));
    o.dim = 3;
    koksma_gen_close(open_family("hammersley", &o));
    o = (koksma_gen_opts){.dim = SIZE_MAX, .n = 1};
    koksma_gen_close(open_family("grid", &o));
    koksma_gen_close(NULL);
}
END_TEST

/* With a leap, the elements that are so far apart. */
START_TEST(leaps)
{
    static const struct {
        const char *name;
        koksma_gen_opts o;
    } tried[] = {
        {"halton", {.dim = 4, .leap = 409}},
        {"halton", {.dim = 3, .leap = 7, .scramble = KOKSMA_SCRAMBLE_DIGITS}},
        {"sobol", {.dim = 7, .leap = 15}},
        {"sobol", {.dim = 7, .leap = 301, .scramble = KOKSMA_SCRAMBLE_OWEN}},
        {"random", {.dim = 2, .leap = 10}},
    };

    for (size_t t = 0; t < sizeof tried / sizeof *tried; t++) {
        koksma_gen_opts o = tried[t].o, all = o;

        o.n = 20;
        o.start = 11;
        fill_all(room, tried[t].name, o);
        all.leap = 1;
        all.n = 11 + 20 * o.leap;
        fill_all(other, tried[t].name, all);
        for (size_t i = 0; i < 20; i++)
            ck_assert_mem_eq(room + i * o.dim, other + (11 + i * o.leap) * o.dim,
                             o.dim * sizeof *room);
    }
}
END_TEST

/* x + u modulo 1 with one u for all points, in steps of 2^-53; 1 - |2x - 1|. */
START_TEST(shifts_and_folds)
{
    koksma_gen_opts o = {.dim = 3, .n = 1024}, shifted = o, folded = o;

    shifted.scramble = KOKSMA_SCRAMBLE_SHIFT;
    folded.baker = true;
    fill_all(room, "sobol", o);
    fill_all(other, "sobol", shifted);
    for (size_t i = 0; i < 3 * o.n; i++) {
        double v = room[i] + other[i % 3]; /* point 0 is the origin */

        ck_assert(fabs(other[i] - (v < 1.0 ? v : v - 1.0)) <= 0x1p-53);
        ck_assert(ldexp(other[i], 53) == floor(ldexp(other[i], 53)));
    }
    ck_assert(other[0] != other[1] && other[1] != other[2]);
    fill_all(other, "sobol", folded);
    for (size_t i = 0; i < 3 * o.n; i++)
        ck_assert(other[i] == (room[i] == 0.5 ? 1.0 - 0x1p-53
                                              : 1.0 - fabs(2.0 * room[i] - 1.0)));
}
END_TEST

START_TEST(refused_fills)
{
    static const uint64_t bad[][2] = {{0, 11},         {10, 1},
                                      {11, 0},         {5, SIZE_MAX},
                                      {UINT64_MAX, 2}, {UINT64_MAX - 1, 1}};
    koksma_gen_opts o = {.dim = 2, .n = 10, .start = 3};
    koksma_gen *g = open_family("halton", &o), *none = NULL;
    double x[2] = {7.0, 7.0};
    koksma_error err;

    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        memset(&err, 0, sizeof err);
        ck_assert_int_eq(koksma_gen_fill(g, x, bad[i][0], (size_t)bad[i][1], &err),
                         KOKSMA_EINVAL);
        ck_assert(err.status == KOKSMA_EINVAL && strstr(err.text, "10") != NULL);
        ck_assert(x[0] == 7.0 && x[1] == 7.0);
    }
    ck_assert_int_eq(koksma_gen_fill(g, x, 10, 0, NULL), KOKSMA_OK);
    koksma_gen_close(g);
    o.dim = 203280222; /* one more than there are primes for */
    ck_assert_int_eq(koksma_gen_open(&none, koksma_gen_find("halton"), &o, &err),
                     KOKSMA_EINVAL);
    ck_assert_ptr_null(none);
}
END_TEST

START_TEST(table_of_families)
{
    size_t count = 0;

    for (const koksma_gen_family *f = koksma_gen_families; f->name != NULL; f++) {
        ck_assert_ptr_eq(koksma_gen_find(f->name), f); /* so no name comes twice */
        ck_assert_uint_gt(strlen(f->summary), 0);
        ck_assert_uint_gt(strlen(f->needs), 0);
        ck_assert_uint_ge(f->max_dim, 1);
        count++;
    }
    ck_assert_uint_eq(count, 20);
    ck_assert_ptr_null(koksma_gen_find(""));
    ck_assert_ptr_null(koksma_gen_find("Halton"));
    ck_assert_ptr_null(koksma_gen_find("halto"));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("gen");
    TCase *tc = tcase_create("families");

    suite_add_tcase(suite, tc);
    tcase_add_test(tc, hammersley);
    tcase_add_test(tc, grids);
    tcase_add_test(tc, random_points);
    tcase_add_test(tc, table_of_families);

    tc = tcase_create("calls");
    suite_add_tcase(suite, tc);
    tcase_add_loop_test(tc, pieces, 0, SAMPLES);
    tcase_add_loop_test(tc, seeds_and_replicates, 0, SAMPLES);
    tcase_add_loop_test(tc, refused, 0, sizeof refusals / sizeof *refusals);
    tcase_add_test(tc, leaps);
    tcase_add_test(tc, shifts_and_folds);
    tcase_add_test(tc, just_legal);
    tcase_add_test(tc, refused_fills);
    return oracle_run(suite);
}
