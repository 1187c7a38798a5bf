/* Point sets and values in text: what is read, and what is refused with which
 * words. */
#include <check.h>
#include <stdlib.h>
#include <string.h>

#include "io.h"
#include "io_fixture.h"
#include "oracle.h"

#define P KOKSMA_POINTS
#define V KOKSMA_VALUES

/* Texts and their sets (io_fixture.h says how they are written down). */
static const struct {
    koksma_content content;
    const char *text, *sets;
} good[] = {
    {P, "", ""},
    {P, "\n", ""},
    {P, " \t \n\r\n\n", ""},
    {P, "# nothing\n  # at all", ""},
    {V, "", ""},
    /* Separators and the ends of lines. */
    {P, "0.5", "0.5"},
    {P, "0.5\n", "0.5"},
    {P, "0.5 0.25\n1 0\n", "0.5 0.25;1 0"},
    {P, "0.5\t0.25\n1,0", "0.5 0.25;1 0"},
    {P, "0.5 , 0.25\t,\t1,\t0 ,1\n", "0.5 0.25 1 0 1"},
    {P, " \t0.5   0.25 \t \n\t\t1\t0", "0.5 0.25;1 0"},
    {P, "0.5 0.25\r\n1 0 \r\n", "0.5 0.25;1 0"},
    {P, "0.5\r", "0.5"},
    {P, "0.5\r\n1", "0.5;1"},
    /* Comments. */
    {P, "# c\n0.5 # d\n# e\n1#f\n#", "0.5;1"},
    {P, "0.5\n#\n1\n  # 0\n0", "0.5;1;0"},
    {P, "0.5\r\n#\r\n1 # \r\n", "0.5;1"},
    {P, "0.5 0.25 # 1 # 2, nan\n1 0 ### \n", "0.5 0.25;1 0"},
    {P, "#0.5\n1", "1"},
    /* Sets. */
    {P, "0.5\n\n1", "0.5|1"},
    {P, "\n\n0.5\n\n\n \n\t\n1\n\n", "0.5|1"},
    {P, "0.5\r\n\r\n1\r\n", "0.5|1"},
    {P, "0.5\n \t\r\n1\n", "0.5|1"},
    {P, "0.5\n# c\n\n# d\n\n# e\n1", "0.5|1"},
    {P, "0.5\n\n0 1\n1 0\n\n1 1 1\n\n0", "0.5|0 1;1 0|1 1 1|0"},
    /* Numbers. */
    {P, "0 1 0. 1. .5 00.5 01.0 0.50000", "0 1 0 1 0.5 0.5 1 0.5"},
    {P, "+.5 5.e-1 .5e0 50E-2 0.005e+2 1e0", "0.5 0.5 0.5 0.5 0.5 1"},
    {P, "0x1p-1 0X.8P0 0x0.8 0x1 0x1.fp-9", "0.5 0.5 0.5 1 0.0037841796875"},
    {P, "0x1.fffffffffffffp-1", "0.99999999999999989"},
    {P, "1e-400 4.9e-324 1e-308",
     "0 4.9406564584124654e-324 9.9999999999999991e-309"},
    {P, "-0 -0.0 -1e-400 -0x0p0", "-0 -0 -0 -0"},
    {P, "0.1 0.3 0.99999999999999999", "0.10000000000000001 0.29999999999999999 1"},
    {P, "1.0000000000000000000000000001", "1"},
    /* Values. */
    {V, "0.5 -7\n1 1e300\n", "0.5 -7;1 1.0000000000000001e+300"},
    {V, "0 0 0x10\n1,1,-1e-3\n", "0 0 16;1 1 -0.001"},
    {V, "0.5 7 # 8\n\n0.5 1 -0\n", "0.5 7|0.5 1 -0"},
    {V, "0 1.7976931348623157e308", "0 1.7976931348623157e+308"},
};

static void check_read(koksma_content content, const char *text, const char *sets)
{
    rendering got;
    koksma_error err = {0};

    for (size_t room = 0; room <= 4; room++) {
        FILE *in = stream_of_text(text);
        koksma_status status = room == 0
                                   ? render_sets(&got, in, content, &err)
                                   : render_by_rows(&got, in, content, room, &err);

        ck_assert_msg(status == KOKSMA_OK, "\"%s\": %s", text, err.text);
        ck_assert_msg(strcmp(got.text, sets) == 0, "\"%s\" is read as \"%s\"", text,
                      got.text);
        fclose(in);
    }
}

START_TEST(texts_that_are_read)
{
    check_read(good[_i].content, good[_i].text, good[_i].sets);
}
END_TEST

/* Numbers longer than any buffer, on lines longer than any buffer. */
START_TEST(long_numbers_and_lines)
{
    static char text[40000], sets[2000];
    size_t used = 0;

    for (int i = 0; i < 40; i++) {
        used += (size_t)sprintf(text + used, "%s0.5", i > 0 ? " " : "");
        memset(text + used, '0', 400);
        used += 400;
        used += (size_t)sprintf(text + used, "%d", i);
        sprintf(sets + strlen(sets), "%s0.5", i > 0 ? " " : "");
    }
    check_read(P, text, sets);

    memset(text, '0', 400);
    strcpy(text + 400, "1.25");
    memcpy(text, "1 ", 2);
    check_read(V, text, "1 1.25");
    memset(text, '3', 400);
    memcpy(text, "0.", 2);
    text[400] = '\0';
    check_read(P, text, "0.33333333333333331");
}
END_TEST

#define F KOKSMA_EFORMAT
#define D KOKSMA_EDOMAIN

static const struct {
    koksma_content content;
    const char *text;
    koksma_status status;
    size_t line;
    const char *sentence;
} bad[] = {
    {P, "0.5 nan\n", D, 1, "coordinate 2 is nan, not in [0,1]"},
    {P, "NaN", D, 1, "coordinate 1 is NaN, not in [0,1]"},
    {P, "0 -nan(1)", D, 1, "coordinate 2 is -nan(1), not in [0,1]"},
    {P, "0 0\n0 inf", D, 2, "coordinate 2 is inf, not in [0,1]"},
    {P, "0\n-INFINITY 0", D, 2, "coordinate 1 is -INFINITY, not in [0,1]"},
    {P, "1.5", D, 1, "coordinate 1 is 1.5, not in [0,1]"},
    {P, "\r\n# c\r\n0.5 1\r\n # d\r\n0 -0.1\r\n", D, 5,
     "coordinate 2 is -0.1, not in [0,1]"},
    {P, "0\n\n\n\n1,2", D, 5, "coordinate 2 is 2, not in [0,1]"},
    {P, "1.0000000000000003", D, 1,
     "coordinate 1 is 1.0000000000000003, not in [0,1]"},
    {P, "1e400", D, 1, "coordinate 1 is 1e400, not in [0,1]"},
    {P, "-4.9e-324", D, 1, "coordinate 1 is -4.9e-324, not in [0,1]"},
    {P, "0x1.0000000000001p0", D, 1,
     "coordinate 1 is 0x1.0000000000001p0, not in [0,1]"},
    /* Not numbers. */
    {P, "0.5 word 0.5", F, 1, "column 2 is word, not a number"},
    {P, "0 0\n0.5x 0", F, 2, "column 1 is 0.5x, not a number"},
    {P, "0 0.5x", F, 1, "column 2 is 0.5x, not a number"},
    {P, "1e", F, 1, "column 1 is 1e, not a number"},
    {P, "0x", F, 1, "column 1 is 0x, not a number"},
    {P, "0.5.5", F, 1, "column 1 is 0.5.5, not a number"},
    {P, ".", F, 1, "column 1 is ., not a number"},
    {P, "0;1", F, 1, "column 1 is 0;1, not a number"},
    {P, "- 1", F, 1, "column 1 is -, not a number"},
    {P,
     "\xEF\xBB\xBF"
     "0.5",
     F, 1, "column 1 is ???0.5, not a number"},
    {P, "0 \x1B[2J", F, 1, "column 2 is ?[2J, not a number"},
    {P, "abcdefghijabcdefghijabcdefghijabcdefghij", F, 1,
     "column 1 is abcdefghijabcdefghijabcdefghijabcdefghij, not a number"},
    {P, "abcdefghijabcdefghijabcdefghijabcdefghijk", F, 1,
     "column 1 is abcdefghijabcdefghijabcdefghijabcdefghij..., not a number"},
    /* Other blanks than those that the format has. */
    {P, "0 \v1", F, 1, "column 2 is ?1, not a number"},
    {P, "0 1 \r0 1\n", F, 1, "column 3 is ?0, not a number"},
    {P, "\f0", F, 1, "column 1 is ?0, not a number"},
    {P, "0\n\f\n", F, 2, "column 1 is ?, not a number"},
    /* Empty fields. */
    {P, "0,,1", F, 1, "column 2 is empty, not a number"},
    {P, "0 , , 1", F, 1, "column 2 is empty, not a number"},
    {P, "0,1,\n", F, 1, "column 3 is empty, not a number"},
    {P, "0,1\n0,1 , \r\n", F, 2, "column 3 is empty, not a number"},
    {P, "0,1, # 2", F, 1, "column 3 is empty, not a number"},
    {P, ",1", F, 1, "column 1 is empty, not a number"},
    {P, " ,", F, 1, "column 1 is empty, not a number"},
    /* Rows of different lengths. */
    {P, "0 1\n0\n", F, 2, "1 column, but the first line of the set has 2"},
    {P, "0 1 1\n0 1 1\n0 1#1\n", F, 3,
     "2 columns, but the first line of the set has 3"},
    {P, "0\n\n0 1\n0 1 1", F, 4,
     "more than the 2 columns of the first line of the set"},
    {P, "0\n0 1", F, 2, "more than the 1 column of the first line of the set"},
    {P, "0 1\n0 1 1.5", F, 2,
     "more than the 2 columns of the first line of the set"},
    /* Values. */
    {V, "0.5 nan", D, 1, "the value in column 2 is nan, not a finite number"},
    {V, "0 1 7\n0 1 -inf", D, 2,
     "the value in column 3 is -inf, not a finite number"},
    {V, "0 1e999", D, 1, "the value in column 2 is 1e999, not a finite number"},
    {V, "0 2 7", D, 1, "coordinate 2 is 2, not in [0,1]"},
    {V, "0 1 7\n0 7\n", D, 2, "coordinate 2 is 7, not in [0,1]"},
    {V, "0 7\n-1 7", D, 2, "coordinate 1 is -1, not in [0,1]"},
    {V, "0 1 7\n0 1\n", F, 2, "2 columns, but the first line of the set has 3"},
    {V, "0 7\n0 7 7", F, 2, "more than the 2 columns of the first line of the set"},
    {V, "7,", D, 1, "coordinate 1 is 7, not in [0,1]"},
    {V, "1,", F, 1, "column 2 is empty, not a number"},
    {V, "7\n", F, 1, "1 column, but a point and its value take at least 2"},
    {V, "0 7\n\n0\n", F, 3, "1 column, but a point and its value take at least 2"},
    {V, "0 7x", F, 1, "column 2 is 7x, not a number"},
};

static void check_refused(FILE *in, koksma_content content, koksma_status want,
                          size_t line, const char *sentence)
{
    rendering got;

    for (size_t room = 0; room <= 3; room++) {
        koksma_error err;

        rewind(in);
        memset(&err, 'x', sizeof err);
        koksma_status status = room == 0
                                   ? render_sets(&got, in, content, &err)
                                   : render_by_rows(&got, in, content, room, &err);

        ck_assert_str_eq(status == KOKSMA_OK ? got.text : err.text, sentence);
        ck_assert_int_eq(status, want);
        ck_assert_int_eq(err.status, want);
        ck_assert_uint_eq(err.line, line);
        rewind(in);
        ck_assert_int_eq(render_sets(&got, in, content, NULL), want);
    }
    fclose(in);
}

START_TEST(texts_that_are_refused)
{
    check_refused(stream_of_text(bad[_i].text), bad[_i].content, bad[_i].status,
                  bad[_i].line, bad[_i].sentence);
}
END_TEST

START_TEST(nul_bytes)
{
    static const char text[] = "0.5\n0.5\0", comment[] = "0 # \0\n",
                      line[] = "0\n\n\0\n0", second[] = "0\0 0.25\n";
    const char *words = "a NUL byte: this is not text";

    check_refused(stream_of(text, sizeof text - 1), P, F, 2, words);
    check_refused(stream_of(comment, sizeof comment - 1), P, F, 1, words);
    check_refused(stream_of(line, sizeof line - 1), P, F, 3, words);
    check_refused(stream_of(second, sizeof second - 1), P, F, 1, words);
    check_refused(stream_of("", 1), P, F, 1, words);
}
END_TEST

static Suite *io_suite(void)
{
    Suite *suite = suite_create("io");
    TCase *tc = tcase_create("text");

    suite_add_tcase(suite, tc);
    tcase_add_loop_test(tc, texts_that_are_read, 0, sizeof good / sizeof *good);
    tcase_add_test(tc, long_numbers_and_lines);
    tcase_add_loop_test(tc, texts_that_are_refused, 0, sizeof bad / sizeof *bad);
    tcase_add_test(tc, nul_bytes);
    return suite;
}

int main(void) { return oracle_run(io_suite()); }
