#ifndef KOKSMA_TESTS_ORACLE_H
#define KOKSMA_TESTS_ORACLE_H

#include <check.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "num.h"
#include "points.h"

/* The star discrepancy as its definition says, in plain loops over integers, and
 * what the test programs share.  Written from the headers; nothing here comes
 * from or links to a kernel.
 *
 * Coordinates must be multiples of 2^-b with b*dim + log2(n) <= 120 (the oracle
 * finds b itself and aborts when there is none): every local discrepancy is then
 * an integer over n*2^(b*dim), and no comparison below rounds. */
#ifdef __SIZEOF_INT128__
__extension__ typedef __int128 oracle_int;
#else
__extension__ typedef _BitInt(128) oracle_int;
#endif

/* The number num / (n * 2^shift), which lies in [-1,1]. */
typedef struct oracle_ratio {
    oracle_int num;
    size_t n;
    unsigned shift;
} oracle_ratio;

/* D* of p, and in corner (dim numbers, or NULL) the lexicographically least of
 * the corners where it is reached.  Cost: (n+2)^dim * n * dim. */
oracle_ratio oracle_star(koksma_points p, double *corner);

/* The points in the box [0,corner) or [0,corner]. */
size_t oracle_count(koksma_points p, const double *corner, bool closed);

/* vol - open/n or closed/n - vol of that box.  corner need not be on p's grid. */
oracle_ratio oracle_local(koksma_points p, const double *corner, bool closed);

/* The same for boxes anywhere, (a,b) or [a,b], as box.h says: corners has dim
 * numbers a and then dim numbers b.  Cost: (n+2)^(2 dim) * n * dim. */
oracle_ratio oracle_box(koksma_points p, double *corners);
size_t oracle_count_between(koksma_points p, const double *corners, bool closed);
oracle_ratio oracle_between(koksma_points p, const double *corners, bool closed);

/* Exact comparisons with a double, which may be any but a NaN (no NaN compares). */
bool oracle_at_least(oracle_ratio r, double v);
bool oracle_at_most(oracle_ratio r, double v);
bool oracle_contains(koksma_interval v, oracle_ratio r);

/* Whether a == b; both must have the same n. */
bool oracle_equal(oracle_ratio a, oracle_ratio b);

/* Whether v is an interval and at most two doubles up lead from end to end. */
bool oracle_narrow(koksma_interval v);

/* KOKSMA_TEST_SEED and KOKSMA_TEST_SCALE, 1 where they are unset or no number
 * above 0.  A scale of s makes a test run s times as many random sets. */
uint64_t oracle_seed(void);
size_t oracle_scale(void);

/* Random numbers that owe nothing to lib/: the 64-bit xorshift of Marsaglia
 * ("Xorshift RNGs", 2003, shifts 13, 7, 17). */
typedef struct oracle_rng {
    uint64_t state;
} oracle_rng;

/* The generator for set number `round` of a seed, so that one failing set can be
 * made again without those before it. */
oracle_rng oracle_rng_start(uint64_t seed, uint64_t round);
uint64_t oracle_below(oracle_rng *rng, uint64_t n);

/* A multiple of 2^-bits in [0,1), bits <= 53. */
double oracle_dyadic(oracle_rng *rng, unsigned bits);

/* Whether long double has more digits and a wider range than double where the test
 * runs: valgrind's has neither, whatever <float.h> says. */
bool oracle_long_doubles(void);

/* Run the suite as CK_ENV says, free it, and return what main returns. */
int oracle_run(Suite *suite);

#endif
