/* Rows that are written, the disk that has no room for them, and what has no part
 * in any of it, the locale. */
#include <check.h>
#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "io.h"
#include "io_fixture.h"
#include "oracle.h"

static char *written(const double *rows, size_t n, size_t columns, koksma_form form,
                     size_t *size)
{
    char *bytes = NULL;
    FILE *out = open_memstream(&bytes, size);

    ck_assert_int_eq(koksma_write_rows(out, rows, n, columns, form, NULL),
                     KOKSMA_OK);
    fclose(out);
    return bytes;
}

START_TEST(rows_as_text)
{
    static const double rows[] = {0.5, 0.1, -0.0, 1e300, 0x1p-1074, -7.0};
    size_t size;
    char *text = written(rows, 2, 3, KOKSMA_DECIMAL, &size);

    ck_assert_str_eq(text, "0.5\t0.1\t-0\n1e+300\t4.94065645841247e-324\t-7\n");
    free(text);
    text = written(rows, 3, 2, KOKSMA_HEX, &size);
    ck_assert_str_eq(text, "0x1p-1\t0x1.999999999999ap-4\n-0x0p+0\t"
                           "0x1.7e43c8800759cp+996\n0x0.0000000000001p-1022\t-0x1."
                           "cp+2\n");
    free(text);
    text = written(rows, 6, 1, KOKSMA_DECIMAL, &size);
    ck_assert_str_eq(text, "0.5\n0.1\n-0\n1e+300\n4.94065645841247e-324\n-7\n");
    free(text);
    text = written(rows, 0, 3, KOKSMA_DECIMAL, &size);
    ck_assert_uint_eq(size, 0);
    free(text);
}
END_TEST

/* More rows than any buffer holds, of numbers of all lengths. */
START_TEST(rows_come_back)
{
    enum { N = 3000, COLUMNS = 3 };
    static double rows[N * COLUMNS], back[N * COLUMNS + 1];

    for (size_t i = 0; i < N * COLUMNS; i++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), i);
        int e = (int)oracle_below(&rng, 2000) - 1000;
        double v = ldexp(oracle_dyadic(&rng, 53), i % 2 == 0 ? 0 : e);

        rows[i] = i % COLUMNS == COLUMNS - 1 ? -v : v <= 1.0 ? v : 1.0 / v;
    }
    for (koksma_form form = KOKSMA_DECIMAL; form <= KOKSMA_HEX; form++) {
        size_t size, columns, got;
        char *text = written(rows, N, COLUMNS, form, &size);
        FILE *in = stream_of(text, size);
        koksma_reader *r = reader_of(in, KOKSMA_VALUES);

        ck_assert_int_eq(koksma_reader_next(r, &columns, NULL), KOKSMA_OK);
        ck_assert_uint_eq(columns, COLUMNS);
        ck_assert_int_eq(koksma_reader_rows(r, back, N, &got, NULL), KOKSMA_OK);
        ck_assert_uint_eq(got, N);
        ck_assert_mem_eq(back, rows, sizeof rows);
        koksma_reader_close(r);
        fclose(in);
        free(text);
    }
}
END_TEST

/* A full disk is an error, never silence. */
START_TEST(full_disk)
{
    static const double rows[64] = {0.1, 0.2};
    static char buffer[16];

    for (int form = KOKSMA_DECIMAL; form <= KOKSMA_NPY + 1; form++) {
        FILE *out = fopen("/dev/full", "w");
        koksma_error err = {0};
        koksma_status status;

        if (out == NULL) return;
        ck_assert_int_eq(setvbuf(out, buffer, _IOFBF, sizeof buffer), 0);
        status = form > KOKSMA_NPY
                     ? koksma_write_npy_header(out, 32, 2, &err)
                     : koksma_write_rows(out, rows, 32, 2, (koksma_form)form, &err);
        ck_assert_int_eq(status, KOKSMA_EIO);
        ck_assert_int_eq(err.status, KOKSMA_EIO);
        ck_assert_uint_eq(err.line, 0);
        ck_assert_str_eq(err.text, "cannot write: No space left on device");
        ck_assert_int_eq(koksma_write_rows(out, rows, 32, 2, KOKSMA_DECIMAL, NULL),
                         KOKSMA_EIO);
        fclose(out);
    }
}
END_TEST

/* Also where a buffer of the library has
 * been written just before the end. */
START_TEST(full_disk_at_any_row)
{
    static double rows[4200];
    static char buffer[16];

    for (size_t i = 0; i < 4200; i++)
        rows[i] = 1.0;
    for (size_t n = 4000; n <= 4200; n++) {
        FILE *out = fopen("/dev/full", "w");

        if (out == NULL) return;
        ck_assert_int_eq(setvbuf(out, buffer, _IOFBF, sizeof buffer), 0);
        ck_assert_int_eq(koksma_write_rows(out, rows, n, 1, KOKSMA_DECIMAL, NULL),
                         KOKSMA_EIO);
        fclose(out);
    }
}
END_TEST

/* ---- The locale ---------------------------------------------------------- */

static bool comma_locale(void)
{
    static const char *const names[] = {
        "de_DE.UTF-8", "de_DE.utf8",  "fr_FR.UTF-8", "fr_FR.utf8", "es_ES.UTF-8",
        "de_DE",       "nl_NL.UTF-8", "pl_PL.UTF-8", "ru_RU.UTF-8"};

    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (setlocale(LC_ALL, names[i]) != NULL &&
            strcmp(localeconv()->decimal_point, ",") == 0)
            return true;
    setlocale(LC_ALL, "C");
    return false;
}

START_TEST(any_locale)
{
    static const double rows[] = {0.1, 1e-300, 0.25, -1234.5};
    const char *decimal = "0.1\t1e-300\n0.25\t-1234.5\n";
    const char *hex = "0x1.999999999999ap-4\t0x1.56e1fc2f8f359p-997\n"
                      "0x1p-2\t-0x1.34ap+10\n";
    const char *line = "1e-1,0.25,1 0x1.8p-1 0.1250000000000000000000000\n";
    char number[KOKSMA_NUMBER_SIZE];
    size_t size;
    double v;

    if (!comma_locale()) return;
    koksma_format_number(number, 1.5e-300);
    ck_assert_str_eq(number, "1.5e-300");

    char *text = written(rows, 2, 2, KOKSMA_DECIMAL, &size);

    ck_assert_str_eq(text, decimal);
    free(text);
    text = written(rows, 2, 2, KOKSMA_HEX, &size);
    ck_assert_str_eq(text, hex);
    free(text);

    FILE *in = stream_of_text(line);
    koksma_reader *r = reader_of(in, KOKSMA_POINTS);
    koksma_set set = {0};
    koksma_table table = {0};

    ck_assert_int_eq(koksma_set_read(&set, r, NULL), KOKSMA_OK);
    ck_assert(set.dim == 5 && set.x[0] == 0.1 && set.x[1] == 0.25 &&
              set.x[3] == 0.75 && set.x[4] == 0.125);
    ck_assert_int_eq(koksma_set_read(&set, r, NULL), KOKSMA_OK);
    rewind(in);
    ck_assert_int_eq(koksma_table_read(&table, in, "1", "4", NULL), KOKSMA_OK);
    ck_assert(table.rows == 1 && table.x[0] == 0.1 && table.y[0] == 0.75);
    ck_assert(koksma_about_number("a=1.5e0", "a", &v) && v == 1.5);
    ck_assert(!koksma_about_number("a=1;5", "a", &v));

    /* And the host program's locale is as it was. */
    ck_assert_str_eq(localeconv()->decimal_point, ",");
    ck_assert(uselocale((locale_t)0) == LC_GLOBAL_LOCALE);
    koksma_set_free(&set);
    koksma_table_free(&table);
    koksma_reader_close(r);
    fclose(in);
    setlocale(LC_ALL, "C");
}
END_TEST

static Suite *io_suite(void)
{
    Suite *suite = suite_create("io_write");
    TCase *tc = tcase_create("rows");

    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 20.0);
    tcase_add_test(tc, rows_as_text);
    tcase_add_test(tc, rows_come_back);
    tcase_add_test(tc, full_disk);
    tcase_add_test(tc, full_disk_at_any_row);
    tcase_add_test(tc, any_locale);
    return suite;
}

int main(void) { return oracle_run(io_suite()); }
