#ifndef KOKSMA_TESTS_NPY_FIXTURE_H
#define KOKSMA_TESTS_NPY_FIXTURE_H

#include <check.h>

#include "io_fixture.h"

/* NumPy's arrays, written byte by byte and on any machine alike. */

/* An array under construction; finish() makes bytes and size of it. */
typedef struct array {
    FILE *out;
    char *bytes;
    size_t size;
} array;

static inline void begin(array *a)
{
    *a = (array){0};
    a->out = open_memstream(&a->bytes, &a->size);
    if (a->out == NULL) abort();
}

static inline FILE *finish(array *a)
{
    fclose(a->out);
    return stream_of(a->bytes, a->size);
}

static inline void put_magic(array *a, int version, size_t length)
{
    fputs("\x93NUMPY", a->out);
    fputc(version, a->out);
    fputc(0, a->out);
    for (int i = 0; i < (version == 1 ? 2 : 4); i++, length >>= 8)
        fputc((int)(length & 255), a->out);
}

static inline void put_header(array *a, int version, const char *dictionary)
{
    put_magic(a, version, strlen(dictionary));
    fputs(dictionary, a->out);
}

static inline bool little_host(void)
{
    const uint16_t probe = 1;
    unsigned char first;

    memcpy(&first, &probe, 1);
    return first == 1;
}

/* v as a float64 or float32 in the order '<', '>' or '='. */
static inline void put_number(array *a, double v, char order, char size)
{
    bool little = order == '=' ? little_host() : order == '<';
    uint64_t bits = bits_of(v);
    int bytes = size - '0';

    if (size == '4') {
        float single = (float)v;
        uint32_t bits32;

        memcpy(&bits32, &single, sizeof bits32);
        bits = bits32;
    }
    for (int i = 0; i < bytes; i++)
        fputc((int)(bits >> 8 * (little ? i : bytes - 1 - i) & 255), a->out);
}

static inline void put_array(array *a, int version, const char *type, bool fortran,
                             const double *rows, size_t n, size_t columns)
{
    char dictionary[160];

    snprintf(dictionary, sizeof dictionary,
             "{'descr': '%s', 'fortran_order': %s, 'shape': (%zu, %zu), }    \n",
             type, fortran ? "True" : "False", n, columns);
    put_header(a, version, dictionary);
    for (size_t i = 0; i < n * columns; i++)
        put_number(a, rows[fortran ? i % n * columns + i / n : i], type[0],
                   type[2]);
}

/* Every type that is read. */
enum { TYPES = 6 };
static inline const char *type_name(size_t type)
{
    static const char *const names[TYPES] = {"<f8", ">f8", "=f8",
                                             "<f4", ">f4", "=f4"};

    return names[type % TYPES];
}

#define P KOKSMA_POINTS
#define V KOKSMA_VALUES

/* Read whole or by any number of rows, the sets are these. */
static inline void check_sets(FILE *in, koksma_content content, const char *sets)
{
    for (size_t room = 0; room <= 4; room++) {
        rendering got;
        koksma_error err = {0};

        rewind(in);
        koksma_status status = room == 0
                                   ? render_sets(&got, in, content, &err)
                                   : render_by_rows(&got, in, content, room, &err);

        ck_assert_msg(status == KOKSMA_OK, "%s", err.text);
        ck_assert_str_eq(got.text, sets);
    }
    fclose(in);
}

#endif
