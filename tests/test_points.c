/* koksma_points_check: what is a point set, and what the refusals say. */
#include <check.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "oracle.h"
#include "points.h"

/* What any failure must leave in err: the status, no line (nothing was read), and
 * one sentence, which ends inside the array and holds no newline. */
static void check_failed(koksma_status want, koksma_points p, koksma_error *err)
{
    memset(err, 'x', sizeof *err);
    ck_assert_int_eq(koksma_points_check(p, err), want);
    ck_assert_int_eq(err->status, want);
    ck_assert_uint_eq(err->line, 0);
    ck_assert_ptr_nonnull(memchr(err->text, '\0', sizeof err->text));
    ck_assert_uint_gt(strlen(err->text), 0);
    ck_assert_ptr_null(strchr(err->text, '\n'));
    ck_assert_int_eq(koksma_points_check(p, NULL), want);
}

/* Both ends, ties, repeats, a zero with a sign, and the doubles next to the ends.
 */
START_TEST(legal_sets)
{
    static const double x[] = {0.0, 1.0,     0.0, 1.0,       -0.0,          0.5,
                               0.5, 0x1p-53, 1.0, 0x1p-1074, 1.0 - 0x1p-53, 1.0};

    for (size_t dim = 1; dim <= 12; dim++) {
        koksma_points p = {x, 12 / dim, dim};
        koksma_error err;

        ck_assert_int_eq(koksma_points_check(p, &err), KOKSMA_OK);
        ck_assert_int_eq(koksma_points_check(p, NULL), KOKSMA_OK);
    }
}
END_TEST

static const struct refusal {
    size_t n, dim,
        at; /* at: which of the n*dim numbers is v, the others are 0.25 */
    double v;
    const char *text;
} refusals[] = {
    {1, 2, 1, 1.5, "coordinate 2 of point 1 is 1.5, not in [0,1]"},
    {1, 1, 0, 1.1, "coordinate 1 of point 1 is 1.1, not in [0,1]"},
    {3, 2, 4, -0.1, "coordinate 1 of point 3 is -0.1, not in [0,1]"},
    {3, 2, 5, 2.0, "coordinate 2 of point 3 is 2, not in [0,1]"},
    {2, 3, 3, (double)NAN, "coordinate 1 of point 2 is nan, not in [0,1]"},
    {6, 1, 5, (double)INFINITY, "coordinate 1 of point 6 is inf, not in [0,1]"},
    {1, 6, 5, -(double)INFINITY, "coordinate 6 of point 1 is -inf, not in [0,1]"},
};

START_TEST(refused_coordinates)
{
    const struct refusal *c = &refusals[_i];
    double x[6] = {0.25, 0.25, 0.25, 0.25, 0.25, 0.25};
    koksma_error err;

    x[c->at] = c->v;
    check_failed(KOKSMA_EDOMAIN, (koksma_points){x, c->n, c->dim}, &err);
    ck_assert_str_eq(err.text, c->text);
}
END_TEST

/* The doubles next to [0,1] are outside it, and in a sentence that can be true. */
START_TEST(refused_by_one_unit)
{
    double above = 1.0 + 0x1p-52, below = -0x1p-1074;
    koksma_error err;

    check_failed(KOKSMA_EDOMAIN, (koksma_points){&above, 1, 1}, &err);
    ck_assert_ptr_null(strstr(err.text, "is 1,"));
    check_failed(KOKSMA_EDOMAIN, (koksma_points){&below, 1, 1}, &err);
    ck_assert_ptr_null(strstr(err.text, "is 0,"));
    ck_assert_ptr_null(strstr(err.text, "is -0,"));
}
END_TEST

/* Points first, then coordinates: the order in which a person reads them. */
START_TEST(first_offender_is_named)
{
    double x[6] = {0.0, 0.5, 1.0, 0.5, 7.0, (double)NAN};
    koksma_error err;

    check_failed(KOKSMA_EDOMAIN, (koksma_points){x, 2, 3}, &err);
    ck_assert_str_eq(err.text, "coordinate 2 of point 2 is 7, not in [0,1]");
    check_failed(KOKSMA_EDOMAIN, (koksma_points){x, 3, 2}, &err);
    ck_assert_str_eq(err.text, "coordinate 1 of point 3 is 7, not in [0,1]");
    ck_assert_int_eq(koksma_points_check((koksma_points){x, 2, 2}, NULL),
                     KOKSMA_OK);
}
END_TEST

/* One number is all that may be read here; whoever trusts a product that wrapped
 * round reads on, or finds nothing wrong. */
START_TEST(refused_sizes)
{
    static const double x[] = {0.5};
    static const size_t half = (size_t)1 << (sizeof half * 4);
    const koksma_points sets[] = {
        {x, 0, 1},
        {x, 1, 0},
        {x, 0, 0},
        {NULL, 0, 0},
        {NULL, 1, 1},
        {x, SIZE_MAX, 1},
        {x, 1, SIZE_MAX},
        {x, SIZE_MAX, SIZE_MAX}, /* the product wraps round to 1 */
        {x, half, half},         /* to 0 */
        {x, SIZE_MAX / 2 + 1, 2},
        {x, SIZE_MAX / sizeof *x + 1, 1}, /* 0 bytes */
        {x, 1, SIZE_MAX / sizeof *x + 2}, /* 8 bytes */
    };
    koksma_error err;

    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
        check_failed(KOKSMA_EINVAL, sets[i], &err);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("points");
    TCase *tc = tcase_create("check");

    suite_add_tcase(suite, tc);
    tcase_add_test(tc, legal_sets);
    tcase_add_loop_test(tc, refused_coordinates, 0,
                        sizeof refusals / sizeof *refusals);
    tcase_add_test(tc, refused_by_one_unit);
    tcase_add_test(tc, first_offender_is_named);
    tcase_add_test(tc, refused_sizes);
    return oracle_run(suite);
}
