/* NumPy's .npy: arrays of every kind that is read, and those that the library
 * writes. */
#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "io.h"
#include "npy_fixture.h"
#include "oracle.h"

/* Every version, type, byte order and order of axes. */
START_TEST(every_kind_of_array)
{
    static const double rows[] = {0.0, 1.0, 0.125, -0.0, 0.5, 0x1p-140};

    for (int version = 1; version <= 3; version++)
        for (size_t type = 0; type < 6; type++)
            for (int fortran = 0; fortran < 2; fortran++) {
                array a;

                begin(&a);
                put_array(&a, version, type_name(type), fortran, rows, 3, 2);
                put_array(&a, version, type_name(type), fortran, rows, 1, 6);
                check_sets(finish(&a), P,
                           "0 1;0.125 -0;0.5 7.1746481373430634e-43|"
                           "0 1 0.125 -0 0.5 7.1746481373430634e-43");
                free(a.bytes);
            }
}
END_TEST

START_TEST(arrays_of_values)
{
    static const double rows[] = {0.0, 7.5, 1.0, -1e300};

    for (int fortran = 0; fortran < 2; fortran++) {
        array a;

        begin(&a);
        put_array(&a, 1, ">f8", fortran, rows, 2, 2);
        put_array(&a, 2, "<f8", fortran, rows + 2, 1, 2);
        check_sets(finish(&a), V,
                   "0 7.5;1 -1.0000000000000001e+300|1 -1.0000000000000001e+300");
        free(a.bytes);
    }
}
END_TEST

/* The same dictionary, written in other ways. */
START_TEST(every_kind_of_header)
{
    static const char *const headers[] = {
        "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 1)}",
        "{'descr':'<f8','fortran_order':False,'shape':(2,1)}",
        "{'shape': (2, 1), 'fortran_order': False, 'descr': '<f8', }",
        "{'fortran_order': False, 'shape': (2, 1,), 'descr': '<f8'}\n",
        "{ 'descr' :  '<f8' , 'fortran_order' : False , 'shape' : ( 2 , 1 ) , }",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 1), }    \n",
    };

    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++) {
        array a;

        begin(&a);
        put_header(&a, 1 + (int)(i % 3), headers[i]);
        put_number(&a, 0.5, '<', '8');
        put_number(&a, 0.1, '<', '8');
        check_sets(finish(&a), P, "0.5;0.10000000000000001");
        free(a.bytes);
    }
}
END_TEST

/* Sizes around those of any block, read in parts of any size. */
START_TEST(large_arrays)
{
    static const struct {
        size_t n, columns;
    } shapes[] = {{4095, 1}, {4096, 1}, {4097, 1}, {8193, 1}, {2731, 3}, {1, 5000}};
    static const size_t rooms[] = {1, 100, 4096, 10000};
    static double rows[10000], back[10000 * 3];

    for (size_t s = 0; s < 6; s++)
        for (size_t kind = 0; kind < 12; kind++) {
            size_t all = shapes[s].n * shapes[s].columns, have = 0, got, columns;
            size_t room = rooms[(s + kind) % 4];
            oracle_rng rng = oracle_rng_start(oracle_seed(), s * 12 + kind);
            array a;

            if (shapes[s].columns > 3) room = 1;
            for (size_t i = 0; i < all; i++)
                rows[i] = oracle_dyadic(&rng, kind / 2 < 3 ? 53 : 24);
            begin(&a);
            put_array(&a, 1, type_name(kind / 2), kind % 2, rows, shapes[s].n,
                      shapes[s].columns);

            FILE *in = finish(&a);
            koksma_reader *r = reader_of(in, P);

            ck_assert_int_eq(koksma_reader_next(r, &columns, NULL), KOKSMA_OK);
            ck_assert_uint_eq(columns, shapes[s].columns);
            do {
                ck_assert_int_eq(koksma_reader_rows(r, back, room, &got, NULL),
                                 KOKSMA_OK);
                ck_assert_uint_le(got, room);
                ck_assert_uint_le(have + got * columns, all);
                ck_assert_mem_eq(back, rows + have, got * columns * sizeof *rows);
                have += got * columns;
            } while (got > 0);
            ck_assert_uint_eq(have, all);
            koksma_reader_close(r);
            fclose(in);
            free(a.bytes);
        }
}
END_TEST

/* next before and between the rows of arrays. */
START_TEST(next_array)
{
    static const double rows[] = {0.0, 1.0, 0.5, 0.25, 0.75, 1.0};

    for (int fortran = 0; fortran < 2; fortran++) {
        array a;
        double row[6] = {7.0};
        size_t columns = 9, got = 9;

        begin(&a);
        put_array(&a, 1, "<f8", fortran, rows, 3, 2);
        put_array(&a, 1, ">f4", fortran, rows, 2, 3);

        FILE *in = finish(&a);
        koksma_reader *r = reader_of(in, P);

        for (int i = 0; i < 3; i++) {
            columns = 9;
            ck_assert_int_eq(koksma_reader_next(r, &columns, NULL), KOKSMA_OK);
            ck_assert_uint_eq(columns, 2);
            ck_assert_int_eq(koksma_reader_rows(r, row, 0, &got, NULL), KOKSMA_OK);
            ck_assert_uint_eq(got, 0);
        }
        ck_assert_int_eq(koksma_reader_rows(r, row, 1, &got, NULL), KOKSMA_OK);
        ck_assert(got == 1 && row[0] == 0.0 && row[1] == 1.0);
        ck_assert_int_eq(koksma_reader_next(r, &columns, NULL), KOKSMA_OK);
        ck_assert_uint_eq(columns, 3);
        ck_assert_int_eq(koksma_reader_rows(r, row, 2, &got, NULL), KOKSMA_OK);
        ck_assert(got == 2 && row[2] == 0.5 && row[5] == 1.0);
        for (int i = 0; i < 2; i++) {
            ck_assert_int_eq(koksma_reader_next(r, &columns, NULL), KOKSMA_OK);
            ck_assert_uint_eq(columns, 0);
            ck_assert_int_eq(koksma_reader_rows(r, row, 2, &got, NULL), KOKSMA_OK);
            ck_assert_uint_eq(got, 0);
        }
        koksma_reader_close(r);
        fclose(in);
        free(a.bytes);
    }
}
END_TEST

/* What the library writes it reads, and NumPy would: magic, version 1, a length
 * that makes the header a multiple of 64 bytes and ends in a newline,
 * little-endian. */
START_TEST(written_and_read)
{
    static double rows[3000], back[3000];
    array a;
    size_t columns, got;

    for (uint64_t i = 0; i < 3000; i++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), i);

        rows[i] =
            ldexp(oracle_dyadic(&rng, 53), i % 3 == 2 ? 900 : -(int)(i % 1070));
    }
    begin(&a);
    ck_assert_int_eq(koksma_write_npy_header(a.out, 1000, 3, NULL), KOKSMA_OK);
    ck_assert_int_eq(koksma_write_rows(a.out, rows, 600, 3, KOKSMA_NPY, NULL),
                     KOKSMA_OK);
    ck_assert_int_eq(
        koksma_write_rows(a.out, rows + 1800, 400, 3, KOKSMA_NPY, NULL), KOKSMA_OK);
    ck_assert_int_eq(koksma_write_npy_header(a.out, 1, 1500, NULL), KOKSMA_OK);
    ck_assert_int_eq(koksma_write_rows(a.out, rows, 1, 1500, KOKSMA_NPY, NULL),
                     KOKSMA_OK);
    fflush(a.out);
    ck_assert_mem_eq(a.bytes, "\x93NUMPY\x01", 8);

    size_t header =
        10 + (unsigned char)a.bytes[8] + 256u * (unsigned char)a.bytes[9];

    ck_assert_uint_eq(header % 64, 0);
    ck_assert_int_eq(a.bytes[header - 1], '\n');
    ck_assert_int_eq(strncmp(a.bytes + 10,
                             "{'descr': '<f8', 'fortran_order': False, "
                             "'shape': (1000, 3), }  ",
                             62),
                     0);
    ck_assert_uint_eq(a.size, 2 * header + (3000 + 1500) * 8);
    for (size_t i = 0; i < 8; i++)
        ck_assert_int_eq((unsigned char)a.bytes[header + 8 + i],
                         (int)(bits_of(rows[1]) >> 8 * i & 255));

    FILE *in = finish(&a);
    koksma_reader *r = reader_of(in, V);

    ck_assert_int_eq(koksma_reader_next(r, &columns, NULL), KOKSMA_OK);
    ck_assert_uint_eq(columns, 3);
    ck_assert_int_eq(koksma_reader_rows(r, back, 1000, &got, NULL), KOKSMA_OK);
    ck_assert_uint_eq(got, 1000);
    ck_assert_mem_eq(back, rows, sizeof rows);
    koksma_reader_close(r);
    fclose(in);
    free(a.bytes);
}
END_TEST

/* The longest dictionary there can be still ends in its newline. */
START_TEST(largest_header)
{
    array a;

    begin(&a);
    ck_assert_int_eq(koksma_write_npy_header(a.out, SIZE_MAX, SIZE_MAX, NULL),
                     KOKSMA_OK);
    fflush(a.out);
    ck_assert_uint_eq(a.size, 128);
    ck_assert_int_eq(a.bytes[127], '\n');
    ck_assert_ptr_nonnull(strstr(a.bytes + 10, "), }"));
    fclose(a.out);
    free(a.bytes);
}
END_TEST

/* Arrays of values have any number of axes, and Fortran's order is said, not
 * undone: 24 numbers in the order of the file. */
START_TEST(arrays_of_any_number_of_axes)
{
    static const struct {
        const char *shape;
        size_t axes, length[4], columns;
    } cases[] = {
        {"(24,)", 1, {24}, 1},
        {"(4, 6)", 2, {4, 6}, 6},
        {"(2, 3, 4)", 3, {2, 3, 4}, 4},
        {"(2, 3, 1, 4)", 4, {2, 3, 1, 4}, 4},
    };

    for (size_t i = 0; i < 8; i++) {
        bool fortran = i % 2 == 1;
        size_t axes = cases[i / 2].axes, columns = 0, got = 1, seen = 0;
        char dictionary[160];
        koksma_reader *r;
        koksma_axes a;
        array made;
        FILE *in;

        snprintf(dictionary, sizeof dictionary,
                 "{'descr': '<f4', 'fortran_order': %s, 'shape': %s}",
                 fortran ? "True" : "False", cases[i / 2].shape);
        begin(&made);
        put_header(&made, 1, dictionary);
        for (int v = 0; v < 24; v++)
            put_number(&made, v == 7 ? (double)NAN : v * 3.0, '<', '4');
        in = finish(&made);
        ck_assert_int_eq(koksma_reader_open(&r, in, KOKSMA_GRID, NULL), KOKSMA_OK);
        ck_assert_int_eq(koksma_reader_next(r, &columns, NULL), KOKSMA_OK);
        a = koksma_reader_axes(r);
        ck_assert_uint_eq(a.count, axes);
        ck_assert(a.reversed == fortran);
        for (size_t j = 0; j < axes; j++)
            ck_assert_uint_eq(a.length[fortran ? axes - 1 - j : j],
                              cases[i / 2].length[j]);
        ck_assert_uint_eq(columns, axes == 1 ? 1 : a.length[axes - 1]);
        while (got > 0) {
            double rows[24];

            ck_assert_int_eq(koksma_reader_rows(r, rows, 1 + i % 2, &got, NULL),
                             KOKSMA_OK);
            for (size_t v = 0; v < got * columns; v++, seen++)
                ck_assert(seen == 7 ? isnan(rows[v])
                                    : rows[v] == 3.0 * (double)seen);
        }
        ck_assert_uint_eq(seen, 24);
        koksma_reader_close(r);
        fclose(in);
        free(made.bytes);
    }
}
END_TEST

/* Text read so is points and values; it has no axes. */
START_TEST(grids_in_text)
{
    char text[] = "0.5 7\n";
    FILE *in = stream_of_text(text);
    koksma_reader *r;
    koksma_set set = {0};

    ck_assert_int_eq(koksma_reader_open(&r, in, KOKSMA_GRID, NULL), KOKSMA_OK);
    ck_assert_int_eq(koksma_set_read(&set, r, NULL), KOKSMA_OK);
    ck_assert_uint_eq(koksma_reader_axes(r).count, 0);
    ck_assert(set.n == 1 && set.dim == 1 && set.x[0] == 0.5 && set.f[0] == 7.0);
    koksma_reader_close(r);
    koksma_set_free(&set);
    fclose(in);
}
END_TEST

static void check_no_grid(const char *shape, const char *text)
{
    char dictionary[400];
    size_t columns;
    koksma_reader *r;
    koksma_error err;
    array a;
    FILE *in;

    snprintf(dictionary, sizeof dictionary,
             "{'descr': '<f8', 'fortran_order': False, 'shape': %s}", shape);
    begin(&a);
    put_header(&a, 1, dictionary);
    in = finish(&a);
    ck_assert_int_eq(koksma_reader_open(&r, in, KOKSMA_GRID, NULL), KOKSMA_OK);
    ck_assert_int_eq(koksma_reader_next(r, &columns, &err), KOKSMA_EFORMAT);
    ck_assert_str_eq(err.text, text);
    koksma_reader_close(r);
    fclose(in);
    free(a.bytes);
}

START_TEST(arrays_that_are_no_grid)
{
    check_no_grid("()", "the .npy array has 0 axes, not from 1 to 32");
    check_no_grid(
        "(2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, "
        "2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2)",
        "the .npy array has 33 axes, not from 1 to 32");
    check_no_grid("(2, 0, 2)", "the .npy array is empty");
    check_no_grid("[2, 2]", "the .npy array has 0 axes, not from 1 to 32");
    if (SIZE_MAX > UINT32_MAX)
        check_no_grid(
            "(2, 4294967296, 4294967296)",
            "the .npy array of 8589934592 by 4294967296 is more than memory can "
            "hold");
}
END_TEST

static Suite *io_suite(void)
{
    Suite *suite = suite_create("io_npy");
    TCase *tc = tcase_create("arrays");

    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 20.0);
    tcase_add_test(tc, every_kind_of_array);
    tcase_add_test(tc, arrays_of_any_number_of_axes);
    tcase_add_test(tc, grids_in_text);
    tcase_add_test(tc, arrays_that_are_no_grid);
    tcase_add_test(tc, arrays_of_values);
    tcase_add_test(tc, every_kind_of_header);
    tcase_add_test(tc, large_arrays);
    tcase_add_test(tc, next_array);
    tcase_add_test(tc, written_and_read);
    tcase_add_test(tc, largest_header);
    return suite;
}

int main(void) { return oracle_run(io_suite()); }
