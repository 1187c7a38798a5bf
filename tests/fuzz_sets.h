#ifndef KOKSMA_TESTS_FUZZ_SETS_H
#define KOKSMA_TESTS_FUZZ_SETS_H

#include <math.h>

#include "io_fixture.h"

/* What the fuzz targets over sets share: reading them ends, twice in the same way;
 * what is read is in its domain, and comes back bit for bit from each form that it
 * can be written in. */

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

/* A header may claim any number of columns, and one row of them is asked for in one
 * piece: no business of a fuzzer that counts memory. */
enum { WIDEST = 4096 };

/* Sets as they were read, one after the other. */
typedef struct sets {
    double *rows;
    size_t used, room; /* doubles */
    size_t shape[64][2], count;
    koksma_status status;
} sets;

static inline void must(bool holds)
{
    if (!holds) abort();
}

static inline double *more_rows(sets *s, size_t numbers)
{
    if (s->room < s->used + numbers) {
        s->room = 2 * (s->used + numbers);
        s->rows = realloc(s->rows, s->room * sizeof *s->rows);
        must(s->rows != NULL);
    }
    return s->rows + s->used;
}

static inline bool another_set(sets *s, koksma_reader *r, size_t *columns,
                               koksma_error *err)
{
    *columns = SIZE_MAX;
    s->status = koksma_reader_next(r, columns, err);
    must((s->status == KOKSMA_OK) == (*columns != SIZE_MAX));
    if (s->status != KOKSMA_OK || *columns == 0) return false;
    return *columns <= WIDEST && s->count < 64;
}

static inline void check_error(const koksma_error *err, koksma_status status)
{
    size_t length = strnlen(err->text, sizeof err->text);

    if (status == KOKSMA_OK) return;
    must(err->status == status && length > 0 && length < sizeof err->text);
    for (size_t i = 0; i < length; i++)
        must(err->text[i] >= ' ' && err->text[i] <= '~');
}

/* By next and rows, `room` rows at a time. */
static inline void read_rows(sets *s, const uint8_t *bytes, size_t size,
                             koksma_content content, size_t room)
{
    FILE *in = stream_of(bytes, size);
    koksma_reader *r = reader_of(in, content);
    koksma_error err;
    size_t columns, got;

    while (another_set(s, r, &columns, &err)) {
        size_t n = 0;

        do {
            double *rows = more_rows(s, room * columns);

            got = SIZE_MAX;
            s->status = koksma_reader_rows(r, rows, room, &got, &err);
            must((s->status == KOKSMA_OK) == (got != SIZE_MAX));
            if (s->status != KOKSMA_OK) break;
            must(got <= room);
            n += got;
            s->used += got * columns;
        } while (got > 0);
        if (s->status != KOKSMA_OK) break;
        must(n > 0);
        s->shape[s->count][0] = n;
        s->shape[s->count++][1] = columns;
    }
    check_error(&err, s->status);
    must(strlen(koksma_reader_about(r)) < 4096);
    koksma_reader_close(r);
    fclose(in);
}

/* By sets; the rows must be those of `want`. */
static inline void read_sets(const sets *want, const uint8_t *bytes, size_t size,
                             koksma_content content)
{
    FILE *in = stream_of(bytes, size);
    koksma_reader *r = reader_of(in, content);
    koksma_set set = {0};
    sets s = {0};
    koksma_error err;
    size_t columns, at = 0;

    while (another_set(&s, r, &columns, &err)) {
        s.status = koksma_set_read(&set, r, &err);
        if (s.status != KOKSMA_OK) break;
        must(s.count < want->count && set.n == want->shape[s.count][0]);
        must(columns == want->shape[s.count++][1]);
        must(set.dim == columns - (content == KOKSMA_VALUES));
        must(koksma_points_check(koksma_set_view(&set), NULL) == KOKSMA_OK);
        for (size_t i = 0; i < set.n; i++)
            for (size_t k = 0; k < columns; k++, at++) {
                double v = k < set.dim ? set.x[i * set.dim + k] : set.f[i];

                must(isfinite(v) && bits_of(v) == bits_of(want->rows[at]));
            }
    }
    /* Of two faults the first counts, however many rows are asked for. */
    must(s.status == want->status && s.count == want->count);
    koksma_set_free(&set);
    koksma_reader_close(r);
    fclose(in);
}

static inline void check_written(const sets *want, koksma_content content,
                                 koksma_form form)
{
    char *bytes = NULL;
    size_t size = 0, at = 0;
    FILE *out = open_memstream(&bytes, &size);
    sets again = {0};

    must(out != NULL);
    for (size_t s = 0; s < want->count; s++) {
        size_t n = want->shape[s][0], columns = want->shape[s][1];

        if (form == KOKSMA_NPY)
            must(koksma_write_npy_header(out, n, columns, NULL) == KOKSMA_OK);
        else if (s > 0)
            fputs("\n", out);
        must(koksma_write_rows(out, want->rows + at, n, columns, form, NULL) ==
             KOKSMA_OK);
        at += n * columns;
    }
    fclose(out);
    read_rows(&again, (const uint8_t *)bytes, size, content, 3);
    must(again.status == KOKSMA_OK && again.count == want->count);
    must(memcmp(again.shape, want->shape, sizeof again.shape) == 0);
    must(at == 0 || memcmp(again.rows, want->rows, at * sizeof *want->rows) == 0);
    free(again.rows);
    free(bytes);
}

/* All of it; rows are asked for `room` at a time. */
static inline void check_sets(const uint8_t *bytes, size_t size,
                              koksma_content content, size_t room)
{
    sets s = {0};

    read_rows(&s, bytes, size, content, room);
    read_sets(&s, bytes, size, content);
    for (koksma_form form = KOKSMA_DECIMAL; form <= KOKSMA_NPY; form++)
        check_written(&s, content, form);
    free(s.rows);
}

#endif
