/* fit.h: every rule that leaves an N out, the window, and what is refused. */
#include "fit_fixture.h"
#include "fit_kernels.h"

static void spoil(table *t, double x, size_t sets, double y)
{
    for (size_t i = 0; i < t->rows; i++)
        if (t->x[i] == x && t->set[i] < sets) t->y[i] = y;
}

static void forget(table *t, double x, size_t set)
{
    size_t kept = 0;

    for (size_t i = 0; i < t->rows; i++) {
        if (t->x[i] == x && t->set[i] == set) continue;
        t->x[kept] = t->x[i];
        t->y[kept] = t->y[i];
        t->set[kept++] = t->set[i];
    }
    t->rows = kept;
}

/* Rows at N = 32 of the replicates below `count` become y, or go; is N dropped? */
static const struct drop {
    size_t sets, count;
    double y; /* NaN: no row */
    char why; /* missing, zero, floor; or it stays */
    double scale;
} drops[] = {
    {8, 4, 0.0, ' ', 0.0}, /* half of them have an error that is not 0 */
    {8, 5, 0.0, 'z', 0.0}, /* fewer */
    {7, 3, 0.0, ' ', 0.0},
    {7, 4, 0.0, 'z', 0.0},
    {2, 1, 0.0, 'z', 0.0}, /* all but one are 0 */
    {3, 1, 0.0, ' ', 0.0},
    {3, 2, 0.0, 'z', 0.0},
    {8, 8, 0.0, 'z', 0.0},
    {1, 1, 0.0, 'z', 0.0},
    {8, 1, (double)NAN, 'm', 0.0}, /* a replicate has no error there */
    {8, 7, (double)NAN, 'm', 0.0},
    {8, 8, (double)NAN, ' ', 0.0}, /* then there is no N */
    {8, 8, 0x1.8p-50, ' ', 0.0},
    {8, 8, 0x1.8p-51, 'f', 0.0}, /* where rounding speaks */
    {1, 1, 0x1.8p-50, ' ', 0.0},
    {1, 1, -0x1.8p-51, 'f', 0.0},
    {1, 1, 0x1.8p-50, 'f', 2.0}, /* and of what it speaks */
    {8, 8, 0x1.8p-51, ' ', 0.25},
};

START_TEST(left_out)
{
    const struct drop *d = &drops[_i];
    koksma_fit_opts o = {.scale = d->scale};
    oracle_rng rng = oracle_rng_start(oracle_seed(), 3);
    koksma_fit_result f;
    static table without;
    size_t dropped = d->why != ' ';

    random_table(&data, &rng, d->sets, 12, -0.75);
    spoil(&data, 8.0, d->sets, 1.0); /* the largest error in the data */
    for (size_t i = 0; i < data.rows; i++)
        data.y[i] = fmax(fmin(data.y[i], 1.0), -1.0);
    without = data;
    for (size_t r = 0; r < d->sets; r++)
        forget(&without, 32.0, r);
    if (isnan(d->y))
        for (size_t r = 0; r < d->count; r++)
            forget(&data, 32.0, r);
    else
        spoil(&data, 32.0, d->count, d->y);
    f = fit(&data, &o);
    ck_assert_msg(f.missing == (d->why == 'm') && f.zero == (d->why == 'z') &&
                      f.below_floor == (d->why == 'f'),
                  "case %d", _i);
    ck_assert_uint_eq(f.used, d->count == 8 && isnan(d->y) ? 11 : 12 - dropped);
    if (dropped == 1 && d->sets > 1) ck_assert(same_line(f, fit(&without, &o)));
    o.from = 45.0; /* what is outside the window is not dropped */
    f = fit(&data, &o);
    ck_assert(f.missing + f.zero + f.below_floor == 0 && f.used == 7 &&
              f.from == 45.0 && f.to == 362.0);
}
END_TEST

/* Squares 1, 4, 4: their means without one of them, and without groups. */
START_TEST(means_without)
{
    double n = 8.0, square[] = {1.0, 4.0, 4.0}, y[4];
    ki_grid g = {.rows = 1, .sets = 3, .n = &n, .square = square};
    static const double one_left_out[] = {4.0, 2.5, 2.5, 3.0};
    static const double groups[] = {4.0, 2.5, 3.0}; /* 0 and 2 are the first */

    ki_grid_log_rms(y, &g);
    for (size_t i = 0; i < 4; i++)
        ck_assert_double_eq_tol(y[i], log(one_left_out[i]) / 2.0, 1e-15);
    ki_grid_log_rms_groups(y, &g, 2);
    for (size_t i = 0; i < 3; i++)
        ck_assert_double_eq_tol(y[i], log(groups[i]) / 2.0, 1e-15);
}
END_TEST

/* Both ends are included. */
START_TEST(windows_used)
{
    static const struct {
        double from, to, first, last;
        size_t used;
    } windows[] = {
        {0.0, 0.0, 1.0, 1024.0, 20},    {8.0, 1024.0, 8.0, 1024.0, 15},
        {8.5, 1023.0, 11.0, 724.0, 13}, {1.0, 0.0, 1.0, 1024.0, 20},
        {0.5, 3.5, 1.0, 3.0, 3},        {512.0, 1e300, 512.0, 1024.0, 3},
    };
    koksma_fit_opts o = KOKSMA_FIT_DEFAULTS;

    data.rows = data.sets = 0;
    for (int i = 0; i <= 20; i += i == 0 ? 2 : 1) /* 1, 2, 3, 4, 6, 8, 11, ... */
        add(&data, rint(exp2(i / 2.0)), 0, exp2(-i / 4.0 - 0.001 * i * i));
    for (size_t w = 0; w < sizeof windows / sizeof *windows; w++) {
        o.from = windows[w].from;
        o.to = windows[w].to;

        koksma_fit_result f = fit(&data, &o);

        ck_assert(f.from == windows[w].first && f.to == windows[w].last);
        ck_assert(f.used == windows[w].used && f.missing + f.zero == 0);
    }
}
END_TEST

static void check_refused(const table *t, const koksma_fit_opts *o,
                          koksma_status want, const char *text)
{
    koksma_fit_result f, before;
    koksma_error err = {0};

    memset(&f, 0x5a, sizeof f);
    memcpy(&before, &f, sizeof f);
    ck_assert_int_eq(try_fit(&f, t, o, &err), want);
    ck_assert_int_eq(err.status, want);
    ck_assert_msg(strstr(err.text, text) != NULL, "%s", err.text);
    ck_assert_int_eq(try_fit(&f, t, o, NULL), want);
    ck_assert_mem_eq(&f, &before, sizeof f);
}

START_TEST(refused)
{
    static const koksma_fit_opts bad_opts[] = {
        {.level = 1.0},         {.level = -0.1},
        {.level = (double)NAN}, {.from = -1.0},
        {.to = -1.0},           {.from = (double)NAN},
        {.to = (double)NAN},    {.from = 50, .to = 20},
        {.scale = -1.0},        {.scale = (double)INFINITY},
    };
    static const double bad_x[] = {0.0, -8.0, (double)NAN, (double)INFINITY};
    static const double bad_y[] = {(double)NAN, -(double)INFINITY};
    oracle_rng rng = oracle_rng_start(oracle_seed(), 3);
    table *t = &data;

    random_table(t, &rng, 3, 12, -0.75);
    for (size_t i = 0; i < sizeof bad_opts / sizeof *bad_opts; i++)
        check_refused(t, &bad_opts[i], KOKSMA_EINVAL, "");
    check_refused(t, &(koksma_fit_opts){.from = 8, .to = 12}, KOKSMA_EINVAL,
                  "2 usable N in [8, 12], and a fit takes 3");
    for (size_t i = 0; i < 4; i++) {
        t->x[5] = bad_x[i];
        check_refused(t, NULL, KOKSMA_EDOMAIN, "row 6");
    }
    t->x[5] = t->x[4];
    check_refused(t, NULL, KOKSMA_EDOMAIN, "set 1 has two errors at N = 32");
    random_table(t, &rng, 3, 12, -0.75);
    for (size_t i = 0; i < 2; i++) {
        t->y[7] = bad_y[i];
        check_refused(t, NULL, KOKSMA_EDOMAIN, "row 8");
    }
    t->y[7] = 1.0;
    t->set[9] = 3;
    check_refused(t, NULL, KOKSMA_EINVAL, "row 10 is of set 4, but there are 3");
    t->set[9] = 0;
    fit(t, NULL);
    for (size_t i = 0; i < t->rows; i++)
        t->x[i] = 0x1p52 + t->x[i]; /* of which all logarithms are equal */
    check_refused(t, NULL, KOKSMA_EINVAL, "too close to each other for a slope");
    for (size_t i = 0; i < t->rows; i++)
        t->x[i] -= 0x1p52;
    t->sets = 4; /* one that has no errors at all */
    check_refused(t, NULL, KOKSMA_EINVAL,
                  "left out: 12 incomplete, 0 of zeros, 0 below rounding");
    t->sets = SIZE_MAX;
    check_refused(t, NULL, KOKSMA_ENOMEM, "memory");
    t->sets = 3;
    check_refused(
        t, &(koksma_fit_opts){.scale = 1e300}, KOKSMA_EINVAL,
        "0 usable N in [0, inf], and a fit takes 3; left out: 0 incomplete, "
        "0 of zeros, 12 below rounding");
    for (size_t i = 0; i < t->rows; i++)
        t->y[i] = 0.0;
    check_refused(t, NULL, KOKSMA_EINVAL, "errors of 0 at all 12 N");
    t->rows = 0;
    check_refused(t, NULL, KOKSMA_EINVAL, "0 usable N");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fit rules");
    TCase *tc = tcase_create("rules");

    suite_add_tcase(suite, tc);
    tcase_add_loop_test(tc, left_out, 0, sizeof drops / sizeof *drops);
    tcase_add_test(tc, means_without);
    tcase_add_test(tc, windows_used);
    tcase_add_test(tc, refused);
    return oracle_run(suite);
}
