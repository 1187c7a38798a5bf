/* Point sets that other programs wrote, and their exact D*, in the folder that
 * KOKSMA_EXTRA_SETS names: known_star.tsv and sets/.  Skipped without it. */

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io.h"
#include "oracle.h"
#include "star.h"

/* Sets that take more steps than this are bounded from below alone; those of up to
 * 8 coordinates must not, and none where the case is tagged big (0: no limit). */
static const double work[] = {4e7, 0.0};

static void check_file(const char *folder, const char *file, size_t dim, size_t n,
                       double dstar, double most)
{
    char name[4096];
    koksma_set set = {0};
    koksma_star_opts opts = {.work = most, .threads = 1};
    koksma_star_result r = {0};
    koksma_error err = {0};
    koksma_reader *reader;
    koksma_status status;
    FILE *in;

    snprintf(name, sizeof name, "%s/sets/%s", folder, file);
    in = fopen(name, "r");
    ck_assert_msg(in != NULL, "%s cannot be read", name);
    ck_assert_int_eq(koksma_reader_open(&reader, in, KOKSMA_POINTS, &err),
                     KOKSMA_OK);
    status = koksma_set_read(&set, reader, &err);
    ck_assert_msg(status == KOKSMA_OK, "%s:%zu: %s", file, err.line, err.text);
    ck_assert_uint_eq(set.n, n);
    ck_assert_uint_eq(set.dim, dim);
    status = koksma_star(&r, koksma_set_view(&set), &opts, &err);
    ck_assert_msg((dim > 8 && most > 0.0) || status == KOKSMA_OK, "%s: %s", file,
                  err.text);
    ck_assert_msg(r.value.lower <= dstar + 1e-9 && r.value.upper >= dstar - 1e-9,
                  "%s: [%.17g, %.17g] is not %.17g", file, r.value.lower,
                  r.value.upper, dstar);
    koksma_set_free(&set);
    koksma_reader_close(reader);
    fclose(in);
}

START_TEST(sets_of_other_programs)
{
    const char *folder = getenv("KOKSMA_EXTRA_SETS");
    char name[4096], line[512], file[256];
    int rows = 0;
    FILE *in;

    snprintf(name, sizeof name, "%s/known_star.tsv", folder);
    in = fopen(name, "r");
    ck_assert_msg(in != NULL, "%s cannot be read", name);
    while (fgets(line, sizeof line, in) != NULL) {
        size_t dim, n;
        double dstar;

        if (line[0] == '#') continue;
        ck_assert_msg(sscanf(line, "%255s %zu %zu %lf", file, &dim, &n, &dstar) ==
                          4,
                      "%s", line);
        check_file(folder, file, dim, n, dstar, work[_i]);
        rows++;
    }
    fclose(in);
    ck_assert_int_gt(rows, 0);
}
END_TEST

int main(void)
{
    const char *folder = getenv("KOKSMA_EXTRA_SETS");
    Suite *suite;
    TCase *tc;

    if (folder == NULL || *folder == '\0') {
        puts("skipped: KOKSMA_EXTRA_SETS names no folder of point sets");
        return 77;
    }
    suite = suite_create("extra");
    tc = tcase_create("sets");
    tcase_add_loop_test(tc, sets_of_other_programs, 0, 1);
    tcase_set_timeout(tc, 600);
    suite_add_tcase(suite, tc);
    tc = tcase_create("to the end");
    tcase_add_loop_test(tc, sets_of_other_programs, 1, 2);
    tcase_set_timeout(tc, 7200);
    tcase_set_tags(tc, "big");
    suite_add_tcase(suite, tc);
    return oracle_run(suite);
}
