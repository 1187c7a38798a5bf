#include "io.h"

#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "io_kernels.h"

enum { BLOCK = 8192 }; /* numbers asked for at a time: sets grow as they are read */

koksma_status koksma_reader_open(koksma_reader **out, FILE *in,
                                 koksma_content content, koksma_error *err)
{
    koksma_reader *r = calloc(1, sizeof *r);

    if (r == NULL) return ki_fail_memory(err, "a reader");
    r->lines.in = in;
    r->grid = content == KOKSMA_GRID;
    r->content = r->grid ? KOKSMA_VALUES : content;
    *out = r;
    return KOKSMA_OK;
}

void koksma_reader_close(koksma_reader *r)
{
    if (r == NULL) return;
    ki_lines_free(&r->lines);
    free(r->first_row);
    free(r->transposed);
    free(r);
}

/* The first byte tells .npy from text: it is no byte of ASCII. */
static koksma_status look_at_first_byte(koksma_reader *r, koksma_error *err)
{
    int c = ki_read_char(r->lines.in);

    if (c == EOF && ferror(r->lines.in)) return ki_fail_read(err);
    r->started = true;
    r->npy = c == 0x93;
    if (c != EOF) ungetc(c, r->lines.in);
    return KOKSMA_OK;
}

koksma_status koksma_reader_rows(koksma_reader *r, double *rows, size_t room,
                                 size_t *got, koksma_error *err)
{
    ki_c_locale l;
    koksma_status status;

    if (r->npy) return ki_npy_rows(r, rows, room, got, err);
    l = ki_c_locale_enter();
    status = ki_text_rows(r, rows, room, got, err);
    ki_c_locale_leave(l);
    return status;
}

/* Read past the rows of the current set that nobody asked for. */
static koksma_status skip_rest(koksma_reader *r, koksma_error *err)
{
    size_t got = 1;
    double *row = ki_alloc(r->columns, sizeof *row);
    koksma_status status = KOKSMA_OK;

    if (row == NULL) return ki_fail_memory(err, "a row");
    while (got > 0 && status == KOKSMA_OK)
        status = koksma_reader_rows(r, row, 1, &got, err);
    free(row);
    return status;
}

koksma_status koksma_reader_next(koksma_reader *r, size_t *columns,
                                 koksma_error *err)
{
    koksma_status status = KOKSMA_OK;

    if (!r->started) status = look_at_first_byte(r, err);
    if (status != KOKSMA_OK) return status;
    if (r->columns > 0 && (r->npy ? r->row == 0 : r->pending)) {
        *columns = r->columns;
        return KOKSMA_OK;
    }
    if (r->columns > 0) status = skip_rest(r, err);
    if (status != KOKSMA_OK) return status;
    if (r->npy) {
        status = ki_npy_next(r, err);
    } else {
        ki_c_locale l = ki_c_locale_enter();

        status = ki_text_next(r, err);
        ki_c_locale_leave(l);
    }
    if (status == KOKSMA_OK) *columns = r->columns;
    return status;
}

koksma_axes koksma_reader_axes(const koksma_reader *r) { return r->axes; }

const char *koksma_reader_about(const koksma_reader *r) { return r->lines.about; }

/* Split the last column off the n rows, in place: x keeps the coordinates. */
static koksma_status split_values(koksma_set *set, size_t n, koksma_error *err)
{
    size_t dim = set->dim;

    if (ki_grow((void **)&set->f, &set->room_f, n, sizeof *set->f) != 0)
        return ki_fail_memory(err, "the values");
    for (size_t i = 0; i < n; i++) {
        set->f[i] = set->x[i * (dim + 1) + dim];
        memmove(set->x + i * dim, set->x + i * (dim + 1), dim * sizeof *set->x);
    }
    return KOKSMA_OK;
}

koksma_status koksma_set_read(koksma_set *set, koksma_reader *r, koksma_error *err)
{
    size_t columns = 0, got = 1, n = 0, need;
    koksma_status status = koksma_reader_next(r, &columns, err);

    set->n = 0;
    if (status != KOKSMA_OK) return status;
    if (r->content == KOKSMA_POINTS) {
        free(set->f);
        set->f = NULL;
        set->room_f = 0;
    }
    while (columns > 0 && got > 0) {
        size_t rows = columns < BLOCK ? BLOCK / columns : 1;

        if (__builtin_mul_overflow(n + rows, columns, &need) ||
            ki_grow((void **)&set->x, &set->room, need, sizeof *set->x) != 0)
            return ki_fail_memory(err, "the points");
        status = koksma_reader_rows(r, set->x + n * columns, rows, &got, err);
        if (status != KOKSMA_OK) return status;
        n += got;
    }
    set->dim = columns;
    if (r->content == KOKSMA_VALUES && n > 0) {
        set->dim--;
        status = split_values(set, n, err);
    }
    if (status == KOKSMA_OK) set->n = n;
    return status;
}

void koksma_set_free(koksma_set *set)
{
    free(set->x);
    free(set->f);
    *set = (koksma_set){0};
}

koksma_points koksma_set_view(const koksma_set *set)
{
    return (koksma_points){set->x, set->n, set->dim};
}
