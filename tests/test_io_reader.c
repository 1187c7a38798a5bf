/* The reader: what a caller may do between rows, sets in memory, what comments say
 * about the data, and reads that the system refuses. */
#include <check.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "io.h"
#include "io_fixture.h"
#include "oracle.h"

#define P KOKSMA_POINTS
#define V KOKSMA_VALUES

/* The reader between rows: what next and rows do in any order. */
START_TEST(next_waits_for_rows)
{
    FILE *in = stream_of_text("0 1\n1 0\n0 0\n\n0.5\n0.25\n\n1 1 1\n");
    koksma_reader *r = reader_of(in, P);
    double rows[8] = {7.0};
    size_t columns = 9, got = 9;

    /* No set yet; then a set of which no row was read stays the next one. */
    ck_assert_int_eq(koksma_reader_rows(r, rows, 4, &got, NULL), KOKSMA_OK);
    ck_assert_uint_eq(got, 0);
    for (int i = 0; i < 3; i++) {
        columns = 9;
        ck_assert_int_eq(koksma_reader_next(r, &columns, NULL), KOKSMA_OK);
        ck_assert_uint_eq(columns, 2);
        ck_assert_int_eq(koksma_reader_rows(r, rows, 0, &got, NULL), KOKSMA_OK);
        ck_assert_uint_eq(got, 0);
    }
    ck_assert_int_eq(koksma_reader_rows(r, rows, 1, &got, NULL), KOKSMA_OK);
    ck_assert_uint_eq(got, 1);
    ck_assert(rows[0] == 0.0 && rows[1] == 1.0);

    /* Past the two rows that nobody asked for. */
    ck_assert_int_eq(koksma_reader_next(r, &columns, NULL), KOKSMA_OK);
    ck_assert_uint_eq(columns, 1);
    ck_assert_int_eq(koksma_reader_rows(r, rows, 2, &got, NULL), KOKSMA_OK);
    ck_assert_uint_eq(got, 2);
    ck_assert(rows[0] == 0.5 && rows[1] == 0.25);
    for (int i = 0; i < 3; i++) {
        ck_assert_int_eq(koksma_reader_rows(r, rows, 2, &got, NULL), KOKSMA_OK);
        ck_assert_uint_eq(got, 0);
    }
    ck_assert_int_eq(koksma_reader_next(r, &columns, NULL), KOKSMA_OK);
    ck_assert_uint_eq(columns, 3);
    ck_assert_int_eq(koksma_reader_rows(r, rows, 2, &got, NULL), KOKSMA_OK);
    ck_assert_uint_eq(got, 1);
    for (int i = 0; i < 3; i++) {
        ck_assert_int_eq(koksma_reader_next(r, &columns, NULL), KOKSMA_OK);
        ck_assert_uint_eq(columns, 0);
        ck_assert_int_eq(koksma_reader_rows(r, rows, 2, &got, NULL), KOKSMA_OK);
        ck_assert_uint_eq(got, 0);
    }
    koksma_reader_close(r);
    koksma_reader_close(NULL);
    ck_assert_int_eq(fclose(in), 0); /* it has stayed the caller's */
}
END_TEST

/* A fault in rows that are skipped is a fault, and outputs stay as they were. */
START_TEST(faults_are_not_skipped)
{
    FILE *in = stream_of_text("0\n0\n2\n\n0");
    koksma_reader *r = reader_of(in, P);
    size_t columns = 9, got = 9;
    koksma_error err = {0};
    double row[1];

    ck_assert_int_eq(koksma_reader_next(r, &columns, NULL), KOKSMA_OK);
    ck_assert_int_eq(koksma_reader_rows(r, row, 1, &got, NULL), KOKSMA_OK);
    columns = 9;
    ck_assert_int_eq(koksma_reader_next(r, &columns, &err), KOKSMA_EDOMAIN);
    ck_assert_uint_eq(columns, 9);
    ck_assert_uint_eq(err.line, 3);
    koksma_reader_close(r);
    fclose(in);
}
END_TEST

/* More rows than are read at a time, and sets that get smaller and wider. */
START_TEST(sets_of_any_size)
{
    static const struct {
        size_t n, columns;
    } shapes[] = {{10000, 2}, {4096, 2}, {4097, 3}, {1, 2}, {8191, 2}, {1, 20000}};
    FILE *io = tmpfile();
    koksma_set set = {0};

    for (size_t s = 0; s < 6; s++) {
        for (size_t i = 0; i < shapes[s].n * shapes[s].columns; i++)
            fprintf(io, "%.17g%s", (double)i / 262144.0,
                    (i + 1) % shapes[s].columns == 0 ? "\n" : " ");
        fputs("\n", io);
    }
    rewind(io);

    koksma_reader *r = reader_of(io, V);

    for (size_t s = 0; s < 6; s++) {
        size_t dim = shapes[s].columns - 1;

        ck_assert_int_eq(koksma_set_read(&set, r, NULL), KOKSMA_OK);
        ck_assert_uint_eq(set.n, shapes[s].n);
        ck_assert_uint_eq(set.dim, dim);

        koksma_points view = koksma_set_view(&set);

        ck_assert(view.x == set.x && view.n == set.n && view.dim == dim);
        for (size_t i = 0; i < set.n; i++) {
            for (size_t k = 0; k < dim; k++)
                ck_assert(view.x[i * dim + k] ==
                          (double)(i * (dim + 1) + k) / 262144.0);
            ck_assert(set.f[i] == (double)(i * (dim + 1) + dim) / 262144.0);
        }
    }
    ck_assert_int_eq(koksma_set_read(&set, r, NULL), KOKSMA_OK);
    ck_assert_uint_eq(set.n, 0);
    ck_assert_int_eq(koksma_set_read(&set, r, NULL), KOKSMA_OK);
    ck_assert_uint_eq(set.n, 0);
    koksma_set_free(&set);
    ck_assert(set.x == NULL && set.f == NULL && set.n == 0 && set.room == 0);
    koksma_set_free(&set);
    koksma_reader_close(r);
    fclose(io);
}
END_TEST

/* One long row takes room for about one row, not for thousands of its length. */
START_TEST(room_for_wide_sets)
{
    enum { COLUMNS = 20000 };
    static char text[2 * COLUMNS + 1];
    koksma_set set = {0};

    for (size_t i = 0; i < COLUMNS; i++)
        memcpy(text + 2 * i, "1 ", 3);

    FILE *in = stream_of_text(text);
    koksma_reader *r = reader_of(in, P);

    ck_assert_int_eq(koksma_set_read(&set, r, NULL), KOKSMA_OK);
    ck_assert_uint_eq(set.n, 1);
    ck_assert_uint_eq(set.dim, COLUMNS);
    ck_assert_uint_le(set.room, 1 << 20);
    koksma_set_free(&set);
    koksma_reader_close(r);
    fclose(in);
}
END_TEST

static koksma_status read_into(koksma_set *set, const char *text,
                               koksma_content content)
{
    FILE *in = stream_of_text(text);
    koksma_reader *r = reader_of(in, content);
    koksma_status status = koksma_set_read(set, r, NULL);

    koksma_reader_close(r);
    fclose(in);
    return status;
}

/* Points have no values, also where values were before; and a failure leaves the
 * set that was there, or none, but never a mixture. */
START_TEST(a_set_is_used_again)
{
    koksma_set set = {0};

    ck_assert_int_eq(read_into(&set, "0 7\n1 8\n", V), KOKSMA_OK);
    ck_assert(set.n == 2 && set.dim == 1 && set.x[1] == 1.0 && set.f[1] == 8.0);
    ck_assert_int_eq(read_into(&set, "0.5 0.25\n", P), KOKSMA_OK);
    ck_assert(set.n == 1 && set.dim == 2 && set.x[1] == 0.25);
    ck_assert_ptr_null(set.f);
    ck_assert_int_eq(read_into(&set, "0.125 9\n", V), KOKSMA_OK);
    ck_assert(set.n == 1 && set.dim == 1 && set.x[0] == 0.125 && set.f[0] == 9.0);
    ck_assert_int_eq(read_into(&set, "0.75 9\n0.75 9\n0.75 word\n", V),
                     KOKSMA_EFORMAT);
    ck_assert(set.n == 0 || (set.n == 1 && set.dim == 1 && set.x[0] == 0.125));
    koksma_set_free(&set);
}
END_TEST

/* What comments say about the data: those alone that start a line with the mark,
 * as far as the reader has come. */
START_TEST(about_comments)
{
    static const char text[] = "# koksma: f=f2 a=0.5\n"
                               "# koksmaz: a=1\n"
                               "#koksma: a=1\n"
                               "#  koksma: a=1\n"
                               "0 7 # koksma: a=1\n"
                               "  # koksma:d=2\r\n"
                               "\n"
                               "# koksma:e=3\n"
                               "# koksma: a=4,g=word\n"
                               "0 7\n";
    FILE *in = stream_of_text(text);
    koksma_reader *r = reader_of(in, V);
    koksma_set set = {0};
    char word[8];
    size_t columns;
    double v = 9.0;

    ck_assert_str_eq(koksma_reader_about(r), "");
    ck_assert_int_eq(koksma_reader_next(r, &columns, NULL), KOKSMA_OK);
    ck_assert(koksma_about_number(koksma_reader_about(r), "a", &v) && v == 0.5);
    ck_assert(koksma_about_word(koksma_reader_about(r), "f", word, sizeof word));
    ck_assert_str_eq(word, "f2");
    ck_assert(!koksma_about_number(koksma_reader_about(r), "d", &v));
    ck_assert_int_eq(koksma_set_read(&set, r, NULL), KOKSMA_OK);
    ck_assert(koksma_about_number(koksma_reader_about(r), "d", &v) && v == 2.0);
    ck_assert(koksma_about_number(koksma_reader_about(r), "a", &v) && v == 0.5);
    ck_assert_int_eq(koksma_set_read(&set, r, NULL), KOKSMA_OK);
    ck_assert(koksma_about_number(koksma_reader_about(r), "a", &v) && v == 4.0);
    ck_assert(koksma_about_number(koksma_reader_about(r), "d", &v) && v == 2.0);
    ck_assert(koksma_about_number(koksma_reader_about(r), "e", &v) && v == 3.0);
    ck_assert(koksma_about_word(koksma_reader_about(r), "g", word, sizeof word));
    ck_assert_str_eq(word, "word");
    koksma_set_free(&set);
    koksma_reader_close(r);
    fclose(in);
}
END_TEST

/* However much is said, there is room for so much; and what is there is whole. */
START_TEST(about_is_bounded)
{
    static char text[60000];
    size_t used = 0;
    double v;

    for (int i = 0; i < 2000; i++)
        used += (size_t)sprintf(text + used, "# koksma: key%d=12345\n", i);

    FILE *in = stream_of_text(text);
    koksma_reader *r = reader_of(in, P);
    size_t columns = 9;

    ck_assert_int_eq(koksma_reader_next(r, &columns, NULL), KOKSMA_OK);
    ck_assert_uint_eq(columns, 0);

    const char *about = koksma_reader_about(r);

    ck_assert_uint_gt(strlen(about), 256);
    ck_assert_uint_lt(strlen(about), 2048);
    ck_assert(koksma_about_number(about, "key0", &v) && v == 12345.0);
    ck_assert_str_eq(about + strlen(about) - 6, "=12345");
    koksma_reader_close(r);
    fclose(in);
}
END_TEST

/* One comment of each length around that bound: it is kept whole or not at all. */
START_TEST(about_at_its_bound)
{
    char text[600], word[600];

    for (size_t length = 480; length <= 540; length++) {
        koksma_table t = {0};

        strcpy(text, "# koksma: a=");
        memset(text + 12, 'x', length);
        strcpy(text + 12 + length, "\n# word x y\n0 1 2\n");

        FILE *in = stream_of_text(text);

        ck_assert_int_eq(koksma_table_read(&t, in, "x", "y", NULL), KOKSMA_OK);
        ck_assert_ptr_nonnull(memchr(t.about, '\0', sizeof t.about));
        if (koksma_about_word(t.about, "a", word, sizeof word))
            ck_assert_uint_eq(strlen(word), length);
        else
            ck_assert_str_eq(t.about, "");
        koksma_table_free(&t);
        fclose(in);
    }
}
END_TEST

static const struct {
    const char *about, *key, *word; /* word is NULL where there is none */
    double number;                  /* -1 where it is none */
} said[] = {
    {"", "a", NULL, -1.0},           {"a=1", "a", "1", 1.0},
    {" a=1 b=2 ", "b", "2", 2.0},    {"a=1 b=2 a=3", "a", "3", 3.0},
    {"a=1,b=2\ta=3", "b", "2", 2.0}, {"a=1, b=2", "b", "2", 2.0},
    {", ,,a=1", "a", "1", 1.0},      {"aa=1", "a", NULL, -1.0},
    {"a=1", "aa", NULL, -1.0},       {"ba=1", "a", NULL, -1.0},
    {"x=a=1", "a", NULL, -1.0},      {"a b=1", "a", NULL, -1.0},
    {"a =1", "a", NULL, -1.0},       {"A=1", "a", NULL, -1.0},
    {"a=", "a", "", -1.0},           {"a= 1", "a", "", -1.0},
    {"a=1 a=", "a", "", -1.0},       {"a=0x10", "a", "0x10", 16.0},
    {"a=1e3", "a", "1e3", 1000.0},   {"a=.5", "a", ".5", 0.5},
    {"a=1x", "a", "1x", -1.0},       {"a=1.2.3", "a", "1.2.3", -1.0},
    {"a=word", "a", "word", -1.0},   {"a=1 a=word", "a", "word", -1.0},
    {"a=b=1", "a", "b=1", -1.0},
};

START_TEST(about_texts)
{
    char word[16] = "before";
    double v = -1.0;
    bool there = koksma_about_word(said[_i].about, said[_i].key, word, sizeof word);

    ck_assert_int_eq(there, said[_i].word != NULL);
    ck_assert_str_eq(word, there ? said[_i].word : "before");
    there = koksma_about_number(said[_i].about, said[_i].key, &v);
    ck_assert_int_eq(there, said[_i].number >= 0.0);
    ck_assert_msg(v == said[_i].number, "\"%s\" says %s is %g", said[_i].about,
                  said[_i].key, v);
}
END_TEST

START_TEST(about_words_are_cut)
{
    char word[8];

    for (size_t size = 1; size <= sizeof word; size++) {
        size_t length = size - 1 < 4 ? size - 1 : 4;

        memset(word, 'x', sizeof word);
        ck_assert(koksma_about_word("a=1234 b=2", "a", word, size));
        ck_assert_uint_eq(strlen(word), length);
        ck_assert_int_eq(strncmp(word, "1234", length), 0);
        for (size_t i = size; i < sizeof word; i++)
            ck_assert_int_eq(word[i], 'x');
    }
}
END_TEST

/* A directory opens, and then cannot be read. */
START_TEST(a_directory_is_no_file)
{
    FILE *in = fopen(".", "r");
    koksma_reader *r;
    koksma_set set = {0};
    koksma_table table = {.rows = 7};
    koksma_error err = {0};

    if (in == NULL) return;
    r = reader_of(in, P);
    ck_assert_int_eq(koksma_set_read(&set, r, &err), KOKSMA_EIO);
    ck_assert_int_eq(err.status, KOKSMA_EIO);
    ck_assert_uint_eq(err.line, 0);
    ck_assert_str_eq(err.text, "cannot read: Is a directory");
    ck_assert_uint_eq(set.n, 0);
    koksma_set_free(&set);
    koksma_reader_close(r);
    fclose(in);

    in = fopen(".", "r");
    err = (koksma_error){0};
    ck_assert_int_eq(koksma_table_read(&table, in, "1", "2", &err), KOKSMA_EIO);
    ck_assert_str_eq(err.text, "cannot read: Is a directory");
    ck_assert_uint_eq(table.rows, 7);
    fclose(in);
}
END_TEST

/* A pipe with this much in it, which fails after that with EAGAIN. */
static FILE *failing_stream(const char *bytes, size_t size, int *writer)
{
    int ends[2];

    ck_assert_int_eq(pipe(ends), 0);
    ck_assert_int_eq(fcntl(ends[0], F_SETFL, O_NONBLOCK), 0);
    ck_assert_int_eq((int)write(ends[1], bytes, size), (int)size);
    *writer = ends[1];
    return fdopen(ends[0], "r");
}

/* The half of a number that came before the failure is no number. */
START_TEST(a_read_fails_later)
{
    static const struct {
        const char *bytes;
        size_t size;
    } cases[] = {{"0.5\n", 4},          {"0.5\n0.25", 8}, {"0.5\n0.2", 7},
                 {"0.5\n0.25 # c", 12}, {"0.5\n\n", 5},   {"\x93NUMPY\x01", 7}};
    rendering got;
    koksma_error err = {0};
    int writer;
    FILE *in = failing_stream(cases[_i].bytes, cases[_i].size, &writer);

    ck_assert_int_eq(render_by_rows(&got, in, P, 8, &err), KOKSMA_EIO);
    ck_assert_int_eq(strncmp(err.text, "cannot read: ", 13), 0);
    close(writer);
    fclose(in);

    in = failing_stream(cases[_i].bytes, cases[_i].size, &writer);
    ck_assert_int_eq(render_by_rows(&got, in, P, 1, &err), KOKSMA_EIO);
    ck_assert_msg(strcmp(got.text, "0.5") == 0 || got.text[0] == '\0',
                  "read \"%s\"", got.text);
    close(writer);
    fclose(in);
}
END_TEST

static Suite *io_suite(void)
{
    Suite *suite = suite_create("io_reader");
    TCase *tc = tcase_create("rows");

    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 20.0);
    tcase_add_test(tc, next_waits_for_rows);
    tcase_add_test(tc, faults_are_not_skipped);
    tcase_add_test(tc, sets_of_any_size);
    tcase_add_test(tc, room_for_wide_sets);
    tcase_add_test(tc, a_set_is_used_again);

    tc = tcase_create("about");
    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 20.0);
    tcase_add_test(tc, about_comments);
    tcase_add_test(tc, about_is_bounded);
    tcase_add_test(tc, about_at_its_bound);
    tcase_add_loop_test(tc, about_texts, 0, sizeof said / sizeof *said);
    tcase_add_test(tc, about_words_are_cut);

    tc = tcase_create("system");
    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 20.0);
    tcase_add_test(tc, a_directory_is_no_file);
    tcase_add_loop_test(tc, a_read_fails_later, 0, 6);
    return suite;
}

int main(void) { return oracle_run(io_suite()); }
