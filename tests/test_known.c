/* Published values and formulas of the star discrepancy: data/known_star.tsv, and
 * families whose D* is known for every n. */

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gen.h"
#include "oracle.h"
#include "star.h"

/* A row that takes more steps than this is bounded from below alone. */
static const double WORK = 4e7, BIG_WORK = 2e10;

typedef struct known {
    char family[16];
    size_t dim;
    uint64_t n, start;
    double dstar;
    int digits;
} known;

static double *points_of(const known *k)
{
    double *x = malloc(k->n * k->dim * sizeof *x);
    koksma_gen_opts o = {.dim = k->dim, .n = k->n, .start = k->start};
    koksma_error err = {0};
    koksma_gen *g;

    ck_assert_ptr_nonnull(x);
    if (strcmp(k->family, "lattice") == 0) {
        for (uint64_t i = 0; i < k->n; i++) {
            x[2 * i] = (double)i / (double)k->n;
            x[2 * i + 1] = (double)(i * k->start % k->n) / (double)k->n;
        }
        return x;
    }
    ck_assert_int_eq(koksma_gen_open(&g, koksma_gen_find(k->family), &o, &err),
                     KOKSMA_OK);
    ck_assert_int_eq(koksma_gen_fill(g, x, 0, (size_t)k->n, &err), KOKSMA_OK);
    koksma_gen_close(g);
    return x;
}

/* Returns whether the set was finished. */
static bool check_known(const known *k, double work)
{
    double *x = points_of(k), slack = pow(10.0, -k->digits) + 4e-16;
    koksma_star_opts opts = {.work = work, .threads = 1};
    koksma_star_result r = {0};
    koksma_status status =
        koksma_star(&r, (koksma_points){x, (size_t)k->n, k->dim}, &opts, NULL);

    free(x);
    ck_assert(status == KOKSMA_OK || status == KOKSMA_STOPPED);
    ck_assert_msg(r.value.lower <= k->dstar + slack &&
                      r.value.upper >= k->dstar - slack,
                  "%s dim %zu n %zu: [%.17g, %.17g] is not %.17g", k->family,
                  k->dim, (size_t)k->n, r.value.lower, r.value.upper, k->dstar);
    return status == KOKSMA_OK;
}

static void check_table(double work, int finished_least)
{
    const char *top = getenv("top_srcdir");
    char name[4096], line[512];
    int finished = 0;
    FILE *in;

    snprintf(name, sizeof name, "%s/data/known_star.tsv", top != NULL ? top : ".");
    in = fopen(name, "r");
    ck_assert_msg(in != NULL, "%s cannot be read", name);
    while (fgets(line, sizeof line, in) != NULL) {
        known k;
        unsigned long long n, start;

        if (line[0] == '#') continue;
        ck_assert_msg(sscanf(line, "%15s %zu %llu %llu %lf %d", k.family, &k.dim,
                             &n, &start, &k.dstar, &k.digits) == 6,
                      "%s", line);
        k.n = n;
        k.start = start;
        finished += check_known(&k, work);
    }
    fclose(in);
    /* Were the sweep to give up at once, every row would pass. */
    ck_assert_int_ge(finished, finished_least);
}

START_TEST(published_values) { check_table(WORK, 10); }
END_TEST

START_TEST(published_values_with_patience) { check_table(BIG_WORK, 23); }
END_TEST

/* (i/2^m, phi_2(i)): 2^m D* = m/3 + 13/9 - (-1)^m 4/(9 2^m) [Halton, Zaremba 1969;
 * De Clerck 1986], and 3/4 for m = 1. */
START_TEST(hammersley)
{
    ck_assert(check_known(&(known){"hammersley", 2, 2, 0, 0.75, 15}, WORK));
    for (int m = 2; m <= 12; m++) {
        double n = ldexp(1.0, m), sign = m % 2 ? -1.0 : 1.0;
        double dstar = (m / 3.0 + 13.0 / 9.0 - sign * 4.0 / (9.0 * n)) / n;

        ck_assert(check_known(
            &(known){"hammersley", 2, (uint64_t)1 << m, 0, dstar, 15}, WORK));
    }
}
END_TEST

/* The first N of van der Corput in base 2: N D* = sum over r >= 1 of the distance
 * of N/2^r from the nearest integer. */
START_TEST(van_der_corput)
{
    for (uint64_t n = 1; n <= 2000; n += 1 + n / 40) {
        double sum = 0.0;

        for (int r = 1; r <= 70; r++) {
            double q = ldexp((double)n, -r);

            sum += fabs(q - rint(q));
        }
        ck_assert(
            check_known(&(known){"halton", 1, n, 0, sum / (double)n, 15}, WORK));
    }
}
END_TEST

/* {0,...,m-1}/m: 1-(1-1/m)^dim; midpoints: 1-(1-1/(2m))^dim. */
START_TEST(grids)
{
    for (size_t dim = 1; dim <= 4; dim++)
        for (uint64_t m = 1; m <= (dim < 3 ? 20 : 7 - dim); m++) {
            uint64_t n = (uint64_t)llround(pow((double)m, (double)dim));
            double plain = 1.0 - pow(1.0 - 1.0 / (double)m, (double)dim);
            double centred = 1.0 - pow(1.0 - 0.5 / (double)m, (double)dim);

            ck_assert(
                check_known(&(known){"grid", dim, n, 0, plain, 15}, BIG_WORK));
            ck_assert(
                check_known(&(known){"centred", dim, n, 0, centred, 15}, BIG_WORK));
        }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("known");
    TCase *quick = tcase_create("quick"), *slow = tcase_create("slow");
    TCase *big = tcase_create("big");

    tcase_add_test(quick, hammersley);
    tcase_add_test(quick, van_der_corput);
    tcase_set_timeout(quick, 60);
    tcase_add_test(slow, published_values);
    tcase_add_test(slow, grids);
    tcase_set_tags(slow, "slow");
    tcase_set_timeout(slow, 120);
    tcase_add_test(big, published_values_with_patience);
    tcase_set_tags(big, "big");
    tcase_set_timeout(big, 1200);
    suite_add_tcase(suite, quick);
    suite_add_tcase(suite, slow);
    suite_add_tcase(suite, big);
    return oracle_run(suite);
}
