/* Tables: which columns are read, which sets the rows belong to, and what is
 * refused. */
#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "io.h"
#include "io_fixture.h"
#include "oracle.h"

/* A table as one string: "set: x y" rows, joined by ';'. */
static void render_table(rendering *to, const koksma_table *t)
{
    char mark[40];

    *to = (rendering){.used = 0};
    for (size_t i = 0; i < t->rows; i++) {
        snprintf(mark, sizeof mark, "%s%zu: ", i > 0 ? ";" : "", t->set[i]);
        render(to, mark, t->x[i]);
        render(to, " ", t->y[i]);
    }
}

static const struct {
    const char *text, *x, *y, *rows;
    size_t sets;
    bool labelled;
} good[] = {
    {"", "1", "2", "", 0, false},
    {"# x y\n", "x", "y", "", 0, false},
    {"\n \n\t\r\n", "1", "2", "", 0, false},
    /* By number and by name. */
    {"1 2\n", "1", "2", "0: 1 2", 1, false},
    {"1 2 3", "3", "1", "0: 3 1", 1, false},
    {"1 2\n", "2", "2", "0: 2 2", 1, false},
    {"# x y\n1 2\n3 4", "x", "y", "0: 1 2;0: 3 4", 1, false},
    {"#x\ty\n1\t2\n", "y", "x", "0: 2 1", 1, false},
    {"# x, y ,z\n1,2 , 3\n", "z", "y", "0: 3 2", 1, false},
    {"# xx x xy\n1 2 3", "x", "1", "0: 2 1", 1, false},
    {"# xx y\n1 2", "xx", "y", "0: 1 2", 1, false},
    {"# 2 1\n3 4", "1", "2", "0: 3 4", 1, false}, /* numbers are numbers */
    {"# a-b 1st\n3 4", "a-b", "1st", "0: 3 4", 1, false},
    {"1 2 3 4 5 6 7 8 9 10 11 12", "10", "12", "0: 10 12", 1, false},
    /* The first of several names that there is. */
    {"# n N\n1 2", "N|n", "n|N", "0: 2 1", 1, false},
    {"# n b\n1 2", "N|n", "a|b|c", "0: 1 2", 1, false},
    {"# n na\n1 2", "na|n", "nan|n", "0: 2 1", 1, false},
    /* The last comment line before the rows names the columns. */
    {"# b a\n# a b\n1 2", "a", "b", "0: 1 2", 1, false},
    {"# a b\n# koksma: f=f2\n1 2", "a", "b", "0: 1 2", 1, false},
    {"# a b\n1 2\n# b a\n3 4", "a", "b", "0: 1 2;0: 3 4", 1, false},
    {"# a b\r\n1 2 # b a\r\n3 4\r\n", "a", "b", "0: 1 2;0: 3 4", 1, false},
    {"  # a b\n1 2\n", "a", "b", "0: 1 2", 1, false},
    /* Blank lines change nothing, and words elsewhere neither. */
    {"\n# a b\n\n1 2\n \t \n\n3 4\n\n", "a", "b", "0: 1 2;0: 3 4", 1, false},
    {"# n k a b\none nan 1 2\n0x ? 3 4\n", "a", "b", "0: 1 2;0: 3 4", 1, false},
    {"word,,1,2", "3", "4", "0: 1 2", 1, false},
    {"1 2 \"x\n3 4\n5 6 7 8", "1", "2", "0: 1 2;0: 3 4;0: 5 6", 1, false},
    /* Numbers. */
    {"-1e300 0x10\n-0 1e-400", "1", "2", "0: -1.0000000000000001e+300 16;0: -0 0",
     1, false},
    /* Sets: words, numbered as they first appear, in one piece or not. */
    {"# set x y\n0 1 2\n0 3 4\n1 5 6", "x", "y", "0: 1 2;0: 3 4;1: 5 6", 2, true},
    {"# x y set\n1 2 b\n3 4 a\n5 6 b", "x", "y", "0: 1 2;1: 3 4;0: 5 6", 2, true},
    {"# set x y\n7 1 2\n", "x", "y", "0: 1 2", 1, true},
    {"# set x\n3 1\n2 1\n1 1\n2 5", "set", "x", "0: 3 1;1: 2 1;2: 1 1;1: 2 5", 3,
     true},
    {"# set x y\na 1 2\naa 1 2\n1 1 2\n1.0 1 2\na 1 2", "x", "y",
     "0: 1 2;1: 1 2;2: 1 2;3: 1 2;0: 1 2", 4, true},
    {"# sets x y\n1 1 2\n2 1 2", "x", "y", "0: 1 2;0: 1 2", 1, false},
    {"# set x y\n", "x", "y", "", 0, false},
};

START_TEST(tables_that_are_read)
{
    FILE *in = stream_of_text(good[_i].text);
    koksma_table t = {0};
    koksma_error err = {0};
    koksma_status status = koksma_table_read(&t, in, good[_i].x, good[_i].y, &err);
    rendering got;

    ck_assert_msg(status == KOKSMA_OK, "%s", err.text);
    render_table(&got, &t);
    ck_assert_str_eq(got.text, good[_i].rows);
    ck_assert_uint_eq(t.sets, good[_i].sets);
    if (t.rows > 0) ck_assert_int_eq(t.labelled, good[_i].labelled);
    ck_assert_int_eq(getc(in), EOF);
    koksma_table_free(&t);
    ck_assert(t.x == NULL && t.y == NULL && t.set == NULL && t.rows == 0);
    koksma_table_free(&t);
    fclose(in);
}
END_TEST

START_TEST(table_about)
{
    FILE *in = stream_of_text("# koksma: f=f2 exact=0.25\n# x y\n1 2\n"
                              "# koksma: exact=0.5\n");
    koksma_table t = {0};
    double v;

    ck_assert_int_eq(koksma_table_read(&t, in, "x", "y", NULL), KOKSMA_OK);
    ck_assert(koksma_about_number(t.about, "exact", &v) && v == 0.5);
    ck_assert(!koksma_about_number(t.about, "f", &v));
    koksma_table_free(&t);
    fclose(in);
}
END_TEST

#define F KOKSMA_EFORMAT
#define I KOKSMA_EINVAL

static const struct {
    const char *text, *x, *y;
    koksma_status status;
    size_t line;
    const char *sentence;
} bad[] = {
    /* No such column. */
    {"# x y\n1 2", "z", "y", I, 0, "no column is called \"z\""},
    {"# x y\n1 2", "N|n", "y", I, 0, "no column is called N or n"},
    {"# x y\n1 2", "x", "a|b|c", I, 0, "no column is called a, b or c"},
    {"1 2\n", "N|n", "2", I, 0, "no column is called N or n"},
    {"1 2\n", "0", "2", I, 0,
     "no line names the columns: give a number from 1, not \"0\""},
    {"# x y\n1 2", "x", "z", I, 0, "no column is called \"z\""},
    {"# x y\n1 2", "X", "y", I, 0, "no column is called \"X\""},
    {"# x y\n1 2", "1x", "y", I, 0, "no column is called \"1x\""},
    {"# x y\n1 2", "0", "y", I, 0, "no column is called \"0\""},
    {"# x y\n1 2", "-1", "y", I, 0, "no column is called \"-1\""},
    {"# x y\n1 2", "", "y", I, 0, "no column is called \"\""},
    {"#\n1 2", "x", "y", I, 0, "no column is called \"x\""},
    {"1 2\n", "x", "2", I, 0,
     "no line names the columns: give a number from 1, not \"x\""},
    {"# koksma: x=1\n1 2", "1", "x", I, 0,
     "no line names the columns: give a number from 1, not \"x\""},
    {"1 2\n# x y\n", "x", "y", I, 0,
     "no line names the columns: give a number from 1, not \"x\""},
    /* No such field. */
    {"1 2\n", "1", "3", F, 1, "2 columns, but column 3 is wanted"},
    {"1 2\n3\n", "1", "2", F, 2, "1 column, but column 2 is wanted"},
    {"# x y\n\n1 2\n3 # 4", "y", "x", F, 4, "1 column, but column 2 is wanted"},
    {"1,2\n3,", "1", "2", F, 2, "1 column, but column 2 is wanted"},
#if SIZE_MAX > UINT32_MAX
    {"1 2", "18446744073709551615", "2", F, 1,
     "2 columns, but column 18446744073709551615 is wanted"},
#endif
    {"1 2", "99999999999999999999999", "2", F, 1, NULL},
    /* A row that does not say which set it belongs to. */
    {"# x y set\n1 2 a\n3 4\n", "x", "y", F, 3,
     "2 columns, but column 3 is wanted"},
    /* No number. */
    {"1 word", "1", "2", F, 1, "column 2 is word, not a finite number"},
    {"1 2\n\n0.5x 2", "1", "2", F, 3, "column 1 is 0.5x, not a finite number"},
    {"1 nan", "1", "2", F, 1, "column 2 is nan, not a finite number"},
    {"inf 1", "1", "2", F, 1, "column 1 is inf, not a finite number"},
    {"-1e999 1", "1", "2", F, 1, "column 1 is -1e999, not a finite number"},
    {"1,,2", "1", "2", F, 1, "column 2 is empty, not a finite number"},
    {",1", "1", "2", F, 1, "column 1 is empty, not a finite number"},
    {"1 \x07\xFF", "1", "2", F, 1, "column 2 is ??, not a finite number"},
};

/* A failure leaves the table of before. */
START_TEST(tables_that_are_refused)
{
    FILE *in = stream_of_text(bad[_i].text), *before = stream_of_text("5 6\n");
    koksma_table t = {0}, copy;
    koksma_error err;

    ck_assert_int_eq(koksma_table_read(&t, before, "1", "2", NULL), KOKSMA_OK);
    memcpy(&copy, &t, sizeof t);
    memset(&err, 'x', sizeof err);
    koksma_status status = koksma_table_read(&t, in, bad[_i].x, bad[_i].y, &err);

    ck_assert_msg(status != KOKSMA_OK, "read \"%s\"", bad[_i].text);
    if (bad[_i].sentence != NULL) ck_assert_str_eq(err.text, bad[_i].sentence);
    ck_assert_int_eq(status, bad[_i].status);
    ck_assert_int_eq(err.status, bad[_i].status);
    ck_assert_uint_eq(err.line, bad[_i].line);
    ck_assert_mem_eq(&t, &copy, sizeof t);
    ck_assert(t.rows == 1 && t.x[0] == 5.0 && t.y[0] == 6.0 && t.set[0] == 0);
    rewind(in);
    ck_assert_int_eq(koksma_table_read(&t, in, bad[_i].x, bad[_i].y, NULL),
                     bad[_i].status);
    koksma_table_free(&t);
    fclose(before);
    fclose(in);
}
END_TEST

START_TEST(a_nul_byte_in_a_table)
{
    FILE *in = stream_of("1 2\n1 2 \0\n", 10);
    koksma_table t = {0};
    koksma_error err = {0};

    ck_assert_int_eq(koksma_table_read(&t, in, "1", "2", &err), F);
    ck_assert_uint_eq(err.line, 2);
    ck_assert_str_eq(err.text, "a NUL byte: this is not text");
    fclose(in);
}
END_TEST

/* A long table with many sets, read over a short one. */
START_TEST(a_long_table)
{
    enum { ROWS = 20000, SETS = 37 };
    FILE *io = tmpfile();
    koksma_table t = {0};

    fputs("# k set x\n1 2 3\n", io);
    rewind(io);
    ck_assert_int_eq(koksma_table_read(&t, io, "k", "x", NULL), KOKSMA_OK);
    ck_assert_uint_eq(t.rows, 1);

    rewind(io);
    fputs("# y\tset x\n", io);
    for (int i = 0; i < ROWS; i++)
        fprintf(io, "%d set%d %d.25\n", i, i * i % SETS, -i);
    rewind(io);
    ck_assert_int_eq(koksma_table_read(&t, io, "x", "y", NULL), KOKSMA_OK);
    ck_assert_uint_eq(t.rows, ROWS);
    ck_assert(t.labelled);
    ck_assert_uint_eq(t.sets, (SETS + 1) / 2); /* squares modulo a prime */
    for (size_t i = 0; i < ROWS; i++) {
        ck_assert(t.y[i] == (double)i);
        ck_assert(t.x[i] == (i > 0 ? -(double)i - 0.25 : 0.25));
        ck_assert_uint_lt(t.set[i], t.sets);
        ck_assert_uint_eq(t.set[i], t.set[(SETS - i % SETS) % SETS]);
        if (i < SETS / 2) ck_assert_uint_eq(t.set[i], i);
    }
    koksma_table_free(&t);
    fclose(io);
}
END_TEST

static Suite *io_suite(void)
{
    Suite *suite = suite_create("io_table");
    TCase *tc = tcase_create("tables");

    suite_add_tcase(suite, tc);
    tcase_add_loop_test(tc, tables_that_are_read, 0, sizeof good / sizeof *good);
    tcase_add_test(tc, table_about);
    tcase_add_loop_test(tc, tables_that_are_refused, 0, sizeof bad / sizeof *bad);
    tcase_add_test(tc, a_nul_byte_in_a_table);
    tcase_add_test(tc, a_long_table);
    return suite;
}

int main(void) { return oracle_run(io_suite()); }
