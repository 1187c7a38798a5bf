/* What is no .npy array of points or values, and how it is refused. */
#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "io.h"
#include "npy_fixture.h"
#include "oracle.h"

static void check_refused(FILE *in, koksma_content content, koksma_status want,
                          const char *sentence)
{
    for (size_t room = 0; room <= 2; room++) {
        rendering got;
        koksma_error err;

        rewind(in);
        memset(&err, 'x', sizeof err);
        koksma_status status = room == 0
                                   ? render_sets(&got, in, content, &err)
                                   : render_by_rows(&got, in, content, room, &err);

        ck_assert_str_eq(status == KOKSMA_OK ? got.text : err.text, sentence);
        ck_assert_int_eq(status, want);
        ck_assert_int_eq(err.status, want);
        ck_assert_uint_eq(err.line, 0);
        rewind(in);
        ck_assert_int_eq(render_sets(&got, in, content, NULL), want);
    }
    fclose(in);
}

static const char SHORT[] = "the .npy array is cut short";

START_TEST(cut_anywhere)
{
    static const double rows[] = {0.0, 1.0, 0.5, 0.25};

    for (size_t kind = 0; kind < 36; kind++) {
        array a;

        begin(&a);
        put_array(&a, 1 + (int)(kind / 12), type_name(kind % 6), kind / 6 % 2, rows,
                  2, 2);
        fclose(a.out);
        for (size_t size = 1; size < a.size; size++)
            check_refused(stream_of(a.bytes, size), P, KOKSMA_EFORMAT, SHORT);
        check_sets(stream_of(a.bytes, a.size), P, "0 1;0.5 0.25");
        free(a.bytes);
    }
}
END_TEST

/* Bytes after an array are another one, or not: a fault either way. */
START_TEST(stray_bytes)
{
    static const double rows[] = {0.5};
    static const char *const stray[] = {"\n",
                                        "0.5\n",
                                        "\x93NUMPY",
                                        "0.5 0.5 0.5 0.5",
                                        "NUMPY NUMPY NUMPY",
                                        "\x93numpy\x01   "};

    for (size_t i = 0; i < 6; i++) {
        array a;

        begin(&a);
        put_array(&a, 1, "<f8", false, rows, 1, 1);
        fputs(stray[i], a.out);
        check_refused(finish(&a), P, KOKSMA_EFORMAT,
                      i < 3 ? SHORT : "this is not a .npy array of version 1 to 3");
        free(a.bytes);
    }
}
END_TEST

START_TEST(wrong_magic)
{
    static const double rows[] = {0.5};

    for (size_t at = 0; at < 7; at++)
        for (int flip = 1; flip < 256; flip *= 4) {
            array a;

            begin(&a);
            put_array(&a, 1, "<f8", false, rows, 1, 1);
            fclose(a.out);
            a.bytes[at] = (char)(a.bytes[at] ^ (at == 6 ? flip | 4 : flip));

            FILE *in = stream_of(a.bytes, a.size);
            rendering got;

            if (at > 0)
                check_refused(in, P, KOKSMA_EFORMAT,
                              "this is not a .npy array of version 1 to 3");
            else /* this is text, and none to be proud of */
                ck_assert_int_eq(render_sets(&got, in, P, NULL), KOKSMA_EFORMAT);
            if (at == 0) fclose(in);
            free(a.bytes);
        }
}
END_TEST

#define PLAIN "'fortran_order': False, 'shape': (1, 1), }"
#define SHAPE(shape)                                                               \
    "{'descr': '<f8', 'fortran_order': False, 'shape': " shape ", }"
#define TYPE(type)                                                                 \
    "the .npy array is of type " type ": only float64 and float32 are read"
#define AXES(n) "the .npy array has " n " axes, not the 2 of points and coordinates"
#define NOT_PLAIN "the .npy array is not one of plain numbers"
#define EMPTY "the .npy array is empty"

/* Each is followed by the bytes of one number; sentences of NULL are not fixed. */
static const struct {
    const char *header, *sentence;
} bad[] = {
    {"", NOT_PLAIN},
    {"{}", NOT_PLAIN},
    {"{" PLAIN, NOT_PLAIN},
    {"{'descr': [('x', '<f8')], " PLAIN, NOT_PLAIN},
    {"{'descr' '<f8', " PLAIN, NOT_PLAIN},
    {"{'descr': '<i8', " PLAIN, TYPE("'<i8'")},
    {"{'descr': '|u1', " PLAIN, TYPE("'|u1'")},
    {"{'descr': '|b1', " PLAIN, TYPE("'|b1'")},
    {"{'descr': '<f2', " PLAIN, TYPE("'<f2'")},
    {"{'descr': '<f16', " PLAIN, TYPE("'<f16'")},
    {"{'descr': '<c16', " PLAIN, TYPE("'<c16'")},
    {"{'descr': '<U10', " PLAIN, TYPE("'<U10'")},
    {"{'descr': '\n\x1B[2J', " PLAIN, NULL},
    /* a dictionary that ends in the midst of its type */
    {"{" PLAIN "'descr': '", NULL},
    {"{" PLAIN "'descr': '<", NULL},
    {"{" PLAIN "'descr': '<f", NULL},
    {"{" PLAIN "'descr': '<f8", NULL},
    {"{" PLAIN "'descr':", NULL},
    {"{" PLAIN "'descr'", NULL},
    {SHAPE("()"), AXES("0")},
    {SHAPE("(1,)"), AXES("1")},
    {SHAPE("(1, 1, 1)"), AXES("3")},
    {SHAPE("(1, 1, 1, 1)"), AXES("4")},
    {SHAPE("(-1, 1)"), NULL},
    {SHAPE("(1, 1"), NULL},
    {SHAPE("(1.5, 1)"), NULL},
    {SHAPE("1"), NULL},
    {"{'descr': '<f8', 'fortran_order': False}", NULL},
    {SHAPE("(0, 2)"), EMPTY},
    {SHAPE("(2, 0)"), EMPTY},
    {SHAPE("(0, 0)"), EMPTY},
    {"{'descr': '<f8', 'fortran_order': True, 'shape': (0, 1), }", EMPTY},
    {SHAPE("(4294967296, 4294967296)"),
     "the .npy array of 4294967296 by 4294967296 is more than memory can hold"},
    {SHAPE("(9223372036854775808, 2)"),
     "the .npy array of 9223372036854775808 by 2 is more than memory can hold"},
    {SHAPE("(1152921504606846976, 1)"),
     "the .npy array of 1152921504606846976 by 1 is more than memory can hold"},
    {SHAPE("(1, 1152921504606846976)"),
     "the .npy array of 1 by 1152921504606846976 is more than memory can hold"},
    {SHAPE("(99999999999999999999999, 1)"), NULL},
    {SHAPE("(1, 18446744073709551617)"), NULL},
    {"{'descr': '<f8', 'shape': (1, 1), }", "the .npy header names no order"},
#if SIZE_MAX > UINT32_MAX
    /* Far fewer numbers than these follow. */
    {SHAPE("(1152921504606846975, 1)"), SHORT},
    {SHAPE("(1000000000000, 3)"), SHORT},
    {"{'descr': '>f4', 'fortran_order': False, 'shape': (1000000000000000, 2), }",
     SHORT},
    {"{'descr': '<f8', 'fortran_order': True, 'shape': (576460752303423488, 2), }",
     NULL},
    {"{'descr': '<f8', 'fortran_order': True, 'shape': (3, 100000000000000000), }",
     SHORT},
#endif
};

START_TEST(headers_that_are_refused)
{
    array a;
    koksma_error err = {0};
    koksma_set set = {0};

    begin(&a);
    put_header(&a, 1 + _i % 3, bad[_i].header);
    put_number(&a, 0.5, '<', '8');

    FILE *in = finish(&a);
    koksma_reader *r = reader_of(in, P);

    ck_assert_int_eq(koksma_set_read(&set, r, &err), KOKSMA_EFORMAT);
    ck_assert_uint_le(set.room, 1 << 20);
    ck_assert_uint_gt(strlen(err.text), 0);
    for (const char *s = err.text; *s != '\0'; s++)
        ck_assert_msg(*s >= ' ' && *s <= '~', "\"%s\"", err.text);
    koksma_set_free(&set);
    koksma_reader_close(r);
    if (bad[_i].sentence != NULL) {
        check_refused(in, P, KOKSMA_EFORMAT, bad[_i].sentence);
    } else {
        fclose(in);
    }
    free(a.bytes);
}
END_TEST

START_TEST(long_headers)
{
    array a;

    begin(&a);
    put_magic(&a, 2, 0xFFFFFFFF);
    check_refused(finish(&a), P, KOKSMA_EFORMAT,
                  "the .npy header claims 4294967295 bytes");
    free(a.bytes);

    /* 65535 bytes are the most that version 1 can have, and are read. */
    begin(&a);
    put_magic(&a, 1, 65535);
    fprintf(a.out, "%-65535s", SHAPE("(1, 1)"));
    put_number(&a, 0.5, '<', '8');
    check_sets(finish(&a), P, "0.5");
    free(a.bytes);
}
END_TEST

/* Numbers outside their domain, in an array of any kind, by point and coordinate.
 */
START_TEST(numbers_that_are_refused)
{
    static const struct {
        koksma_content content;
        size_t at;
        double v;
        const char *sentence;
    } cases[] = {
        {P, 0, 1.5, "coordinate 1 of point 1 is 1.5, not in [0,1]"},
        {P, 5, -0.125, "coordinate 2 of point 3 is -0.125, not in [0,1]"},
        {P, 2, (double)NAN, "coordinate 1 of point 2 is nan, not in [0,1]"},
        {P, 3, (double)INFINITY, "coordinate 2 of point 2 is inf, not in [0,1]"},
        {V, 4, 2.0, "coordinate 1 of point 3 is 2, not in [0,1]"},
        {V, 1, (double)NAN, "the value of point 1 is nan, not a finite number"},
        {V, 5, -(double)INFINITY,
         "the value of point 3 is -inf, not a finite number"},
    };

    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (size_t kind = 0; kind < 12; kind++) {
            double rows[] = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
            array a;

            rows[cases[i].at] = cases[i].v;
            begin(&a);
            put_array(&a, 1, type_name(kind / 2), kind % 2, rows, 3, 2);
            check_refused(finish(&a), cases[i].content, KOKSMA_EDOMAIN,
                          cases[i].sentence);
            free(a.bytes);
        }
}
END_TEST

START_TEST(one_column_has_no_values)
{
    static const double rows[] = {0.5, 0.25};

    for (int fortran = 0; fortran < 2; fortran++) {
        array a;

        begin(&a);
        put_array(&a, 1, "<f8", fortran, rows, 2, 1);
        check_refused(finish(&a), V, KOKSMA_EFORMAT,
                      "1 column, but a point and its value take at least 2");
        free(a.bytes);
    }
}
END_TEST

static Suite *io_suite(void)
{
    Suite *suite = suite_create("io_npy_bad");
    TCase *tc = tcase_create("arrays");

    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 20.0);
    tcase_add_test(tc, cut_anywhere);
    tcase_add_test(tc, stray_bytes);
    tcase_add_test(tc, wrong_magic);
    tcase_add_loop_test(tc, headers_that_are_refused, 0, sizeof bad / sizeof *bad);
    tcase_add_test(tc, long_headers);
    tcase_add_test(tc, numbers_that_are_refused);
    tcase_add_test(tc, one_column_has_no_values);
    return suite;
}

int main(void) { return oracle_run(io_suite()); }
