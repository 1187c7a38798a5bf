#ifndef KOKSMA_TESTS_IO_FIXTURE_H
#define KOKSMA_TESTS_IO_FIXTURE_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io.h"

/* What the tests and the fuzz targets of io share. */

/* A stream of these bytes, which must outlive it. */
static inline FILE *stream_of(const void *bytes, size_t size)
{
    FILE *in = size > 0 ? fmemopen((void *)(uintptr_t)bytes, size, "r")
                        : fopen("/dev/null", "r");

    if (in == NULL) abort();
    return in;
}

static inline FILE *stream_of_text(const char *text)
{
    return stream_of(text, strlen(text));
}

static inline koksma_reader *reader_of(FILE *in, koksma_content content)
{
    koksma_reader *r = NULL;

    if (koksma_reader_open(&r, in, content, NULL) != KOKSMA_OK || r == NULL)
        abort();
    return r;
}

static inline uint64_t bits_of(double v)
{
    uint64_t bits;

    memcpy(&bits, &v, sizeof bits);
    return bits;
}

/* Sets as one string, "0.5 0.25;1 0|0.75": rows end at ';' and sets at '|'. */
typedef struct rendering {
    char text[2048];
    size_t used;
} rendering;

static inline void render(rendering *to, const char *mark, double v)
{
    if (to->used >= sizeof to->text - 40) return;
    to->used += (size_t)snprintf(to->text + to->used, sizeof to->text - to->used,
                                 "%s%.17g", mark, v);
}

static inline void render_rows(rendering *to, const double *rows, size_t n,
                               size_t columns, bool first)
{
    for (size_t i = 0; i < n * columns; i++)
        render(to,
               i % columns != 0      ? " "
               : i > 0 || !first     ? ";"
               : to->text[0] == '\0' ? ""
                                     : "|",
               rows[i]);
}

/* Read all sets of a stream, whole; the status is that of the first failure. */
static inline koksma_status render_sets(rendering *to, FILE *in,
                                        koksma_content content, koksma_error *err)
{
    koksma_reader *r = reader_of(in, content);
    koksma_set set = {0};
    koksma_status status;

    *to = (rendering){.used = 0};
    while ((status = koksma_set_read(&set, r, err)) == KOKSMA_OK && set.n > 0)
        for (size_t i = 0; i < set.n; i++) {
            render_rows(to, set.x + i * set.dim, 1, set.dim, i == 0);
            if (content == KOKSMA_VALUES) render(to, " ", set.f[i]);
        }
    koksma_set_free(&set);
    koksma_reader_close(r);
    return status;
}

/* The same by next and rows, at most `room` rows at a time. */
static inline koksma_status render_by_rows(rendering *to, FILE *in,
                                           koksma_content content, size_t room,
                                           koksma_error *err)
{
    koksma_reader *r = reader_of(in, content);
    size_t columns = SIZE_MAX, got;
    koksma_status status;
    double *rows = NULL;

    *to = (rendering){.used = 0};
    while ((status = koksma_reader_next(r, &columns, err)) == KOKSMA_OK &&
           columns > 0) {
        bool first = true;

        rows = malloc(room * columns * sizeof *rows);
        if (rows == NULL) abort();
        for (;; first = false) {
            got = SIZE_MAX;
            status = koksma_reader_rows(r, rows, room, &got, err);
            if (status != KOKSMA_OK || got == 0) break;
            render_rows(to, rows, got, columns, first);
        }
        free(rows);
        if (status != KOKSMA_OK && got != SIZE_MAX) {
            fputs("koksma_reader_rows failed, and changed its output got\n",
                  stderr);
            abort();
        }
        if (status != KOKSMA_OK) break;
        columns = SIZE_MAX;
    }
    koksma_reader_close(r);
    return status;
}

#endif
