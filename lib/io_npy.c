#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "io_kernels.h"

/* NumPy's .npy [NumPy Enhancement Proposal 1]: ten or twelve bytes, a Python
 * dictionary in text, then the numbers. */

static const char MAGIC[6] = {'\x93', 'N', 'U', 'M', 'P', 'Y'};
enum { HEADER_MOST = 65536, BLOCK = 4096 };

static koksma_status cut_short(koksma_reader *r, koksma_error *err)
{
    if (ferror(r->lines.in)) return ki_fail_read(err);
    return ki_fail(err, KOKSMA_EFORMAT, 0, "the .npy array is cut short");
}

/* The text behind 'key': in the dictionary, or NULL. */
static const char *entry(const char *header, const char *key)
{
    const char *s = strstr(header, key);

    if (s == NULL) return NULL;
    s = ki_skip_blanks(s + strlen(key));
    return *s == ':' ? ki_skip_blanks(s + 1) : NULL;
}

static koksma_status take_type(koksma_reader *r, const char *header,
                               koksma_error *err)
{
    static const uint16_t probe = 1;
    bool little_host = *(const unsigned char *)&probe == 1;
    const char *type = entry(header, "'descr'");
    char shown[KI_SHOWN];

    if (type == NULL || *type != '\'')
        return ki_fail(err, KOKSMA_EFORMAT, 0,
                       "the .npy array is not one of plain numbers");
    if (strlen(type) < 5 || strchr("<>=", type[1]) == NULL || type[2] != 'f' ||
        (type[3] != '4' && type[3] != '8') || type[4] != '\'') {
        ki_show(shown, type, strcspn(type, ",}"));
        return ki_fail(
            err, KOKSMA_EFORMAT, 0,
            "the .npy array is of type %s: only float64 and float32 are read",
            shown);
    }
    r->single = type[3] == '4';
    r->swapped = type[1] != '=' && (type[1] == '<') != little_host;
    return KOKSMA_OK;
}

/* The lengths in the header's tuple; returns how many there are, of which at most
 * KOKSMA_AXES_MOST are kept, or -1 where it is no tuple. */
static int read_shape(const char *header, uintmax_t length[KOKSMA_AXES_MOST])
{
    const char *s = entry(header, "'shape'");
    int axes = 0;

    if (s == NULL || *s != '(') return -1;
    for (s = ki_skip_blanks(s + 1); *s >= '0' && *s <= '9'; axes++) {
        char *end;
        uintmax_t v = strtoumax(s, &end, 10);

        if (axes < KOKSMA_AXES_MOST) length[axes] = v;
        s = ki_skip_blanks(end);
        if (*s == ',') s = ki_skip_blanks(s + 1);
    }
    return *s == ')' ? axes : -1;
}

/* rows*columns numbers that memory could hold. */
static koksma_status check_size(uintmax_t rows, uintmax_t columns,
                                koksma_error *err)
{
    size_t all;

    if (rows == 0 || columns == 0)
        return ki_fail(err, KOKSMA_EFORMAT, 0, "the .npy array is empty");
    if (rows > SIZE_MAX || columns > SIZE_MAX ||
        __builtin_mul_overflow((size_t)rows, (size_t)columns, &all) ||
        all > PTRDIFF_MAX / sizeof(double))
        return ki_fail(err, KOKSMA_EFORMAT, 0,
                       "the .npy array of %ju by %ju is more than memory can hold",
                       rows, columns);
    return KOKSMA_OK;
}

static koksma_status take_shape(koksma_reader *r, const char *header,
                                koksma_error *err)
{
    uintmax_t length[KOKSMA_AXES_MOST];
    int axes = read_shape(header, length);
    koksma_status status;

    if (axes != 2)
        return ki_fail(
            err, KOKSMA_EFORMAT, 0,
            "the .npy array has %d axes, not the 2 of points and coordinates",
            axes < 0 ? 0 : axes);
    status = check_size(length[0], length[1], err);
    if (status != KOKSMA_OK) return status;
    r->rows = (size_t)length[0];
    r->columns = (size_t)length[1];
    return KOKSMA_OK;
}

/* An array of values: rows along the axis that is fastest in the file. */
static koksma_status take_axes(koksma_reader *r, const char *header, bool fortran,
                               koksma_error *err)
{
    uintmax_t length[KOKSMA_AXES_MOST], rows = 1;
    int axes = read_shape(header, length);
    koksma_axes a = {.count = (size_t)axes, .reversed = fortran};
    koksma_status status = KOKSMA_OK;

    if (axes < 1 || axes > KOKSMA_AXES_MOST)
        return ki_fail(err, KOKSMA_EFORMAT, 0,
                       "the .npy array has %d axes, not from 1 to %d",
                       axes < 0 ? 0 : axes, KOKSMA_AXES_MOST);
    for (size_t j = 0; j < a.count && status == KOKSMA_OK; j++) {
        size_t from = fortran ? a.count - 1 - j : j;

        status = check_size(rows, length[from], err);
        if (status != KOKSMA_OK) return status;
        a.length[j] = (size_t)length[from];
        if (j + 1 < a.count || a.count == 1) rows *= length[from];
    }
    r->axes = a;
    r->rows = (size_t)rows;
    r->columns = a.count > 1 ? a.length[a.count - 1] : 1;
    return KOKSMA_OK;
}

static void swap_bytes(double *x, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint64_t bits;

        memcpy(&bits, &x[i], sizeof bits);
        bits = __builtin_bswap64(bits);
        memcpy(&x[i], &bits, sizeof bits);
    }
}

/* Read up to `count` float32 as doubles; returns how many there were. */
static size_t read_singles(koksma_reader *r, double *out, size_t count)
{
    float block[BLOCK];
    size_t done = 0, got = BLOCK;

    for (; done < count && got == BLOCK; done += got) {
        size_t now = count - done < BLOCK ? count - done : BLOCK;

        got =
            ki_read_bytes(block, now * sizeof *block, r->lines.in) / sizeof *block;
        for (size_t i = 0; i < got; i++) {
            uint32_t bits;

            memcpy(&bits, &block[i], sizeof bits);
            if (r->swapped) bits = __builtin_bswap32(bits);
            memcpy(&block[i], &bits, sizeof bits);
            out[done + i] = (double)block[i];
        }
    }
    return done;
}

/* The same for items of either size. */
static size_t read_items(koksma_reader *r, double *out, size_t count)
{
    size_t got;

    if (r->single) return read_singles(r, out, count);
    got = ki_read_bytes(out, count * sizeof *out, r->lines.in) / sizeof *out;
    if (r->swapped) swap_bytes(out, got);
    return got;
}

/* A Fortran-order array is read whole, and turned. */
static koksma_status read_columns(koksma_reader *r, koksma_error *err)
{
    size_t all = r->rows * r->columns, have = 0, room = 0;
    double *by_column = NULL, *turned;
    koksma_status status = KOKSMA_OK;

    /* Grown as it is read, so that a false header cannot ask for the world. */
    while (have < all && status == KOKSMA_OK) {
        size_t now = all - have < BLOCK ? all - have : BLOCK;

        if (ki_grow((void **)&by_column, &room, have + now, sizeof *by_column) != 0)
            status = ki_fail_memory(err, "a .npy array");
        else if (read_items(r, by_column + have, now) != now)
            status = cut_short(r, err);
        have += now;
    }
    turned = status == KOKSMA_OK ? ki_alloc(all, sizeof *turned) : NULL;
    if (status == KOKSMA_OK && turned == NULL)
        status = ki_fail_memory(err, "a .npy array");
    if (status == KOKSMA_OK)
        for (size_t k = 0; k < r->columns; k++)
            for (size_t i = 0; i < r->rows; i++)
                turned[i * r->columns + k] = by_column[k * r->rows + i];
    free(by_column);
    r->transposed = turned;
    return status;
}

/* The length of the dictionary, by the version in bytes 6 and 7. */
static koksma_status header_length(koksma_reader *r, size_t *length,
                                   koksma_error *err)
{
    unsigned char b[12];
    FILE *in = r->lines.in;

    if (ki_read_bytes(b, 10, in) != 10) return cut_short(r, err);
    if (memcmp(b, MAGIC, sizeof MAGIC) != 0 || b[6] < 1 || b[6] > 3)
        return ki_fail(err, KOKSMA_EFORMAT, 0,
                       "this is not a .npy array of version 1 to 3");
    *length = b[8] + 256u * b[9];
    if (b[6] > 1) {
        if (ki_read_bytes(b + 10, 2, in) != 2) return cut_short(r, err);
        *length += 65536u * b[10] + 16777216u * b[11];
    }
    if (*length > HEADER_MOST)
        return ki_fail(err, KOKSMA_EFORMAT, 0, "the .npy header claims %zu bytes",
                       *length);
    return KOKSMA_OK;
}

static koksma_status take_header(koksma_reader *r, const char *header,
                                 koksma_error *err)
{
    const char *order = entry(header, "'fortran_order'");
    bool fortran = order != NULL && strncmp(order, "True", 4) == 0;
    koksma_status status = take_type(r, header, err);

    if (status == KOKSMA_OK)
        status = r->grid ? take_axes(r, header, fortran, err)
                         : take_shape(r, header, err);
    if (status == KOKSMA_OK && order == NULL)
        status = ki_fail(err, KOKSMA_EFORMAT, 0, "the .npy header names no order");
    if (status != KOKSMA_OK || r->grid) return status;
    if (r->content == KOKSMA_VALUES && r->columns < 2)
        return ki_fail(err, KOKSMA_EFORMAT, 0,
                       "1 column, but a point and its value take at least 2");
    return fortran ? read_columns(r, err) : KOKSMA_OK;
}

koksma_status ki_npy_next(koksma_reader *r, koksma_error *err)
{
    size_t length = 0;
    koksma_status status;
    char *header;
    int c = ki_read_char(r->lines.in);

    free(r->transposed);
    r->transposed = NULL;
    r->columns = r->rows = r->row = 0;
    r->axes.count = 0;
    if (c == EOF && !ferror(r->lines.in)) return KOKSMA_OK;
    ungetc(c, r->lines.in);
    status = header_length(r, &length, err);
    if (status != KOKSMA_OK) return status;
    header = ki_alloc(length + 1, 1);
    if (header == NULL) return ki_fail_memory(err, "a .npy header");
    if (ki_read_bytes(header, length, r->lines.in) != length) {
        free(header);
        return cut_short(r, err);
    }
    header[length] = '\0';

    status = take_header(r, header, err);
    free(header);
    if (status != KOKSMA_OK) r->columns = 0;
    return status;
}

static koksma_status check_row(const koksma_reader *r, const double *row,
                               size_t number, koksma_error *err)
{
    size_t coordinates = r->content == KOKSMA_VALUES ? r->columns - 1 : r->columns;

    for (size_t k = 0; k < coordinates; k++)
        if (!(row[k] >= 0.0 && row[k] <= 1.0))
            return ki_fail(err, KOKSMA_EDOMAIN, 0,
                           "coordinate %zu of point %zu is %.17g, not in [0,1]",
                           k + 1, number, row[k]);
    if (coordinates < r->columns && !isfinite(row[coordinates]))
        return ki_fail(err, KOKSMA_EDOMAIN, 0,
                       "the value of point %zu is %g, not a finite number", number,
                       row[coordinates]);
    return KOKSMA_OK;
}

koksma_status ki_npy_rows(koksma_reader *r, double *rows, size_t room, size_t *got,
                          koksma_error *err)
{
    size_t left = r->rows - r->row, now = left < room ? left : room;
    size_t items = now * r->columns, have = items;
    koksma_status status = KOKSMA_OK;

    if (now == 0) {
        *got = 0;
        return KOKSMA_OK;
    }
    if (r->transposed != NULL)
        memcpy(rows, r->transposed + r->row * r->columns, items * sizeof *rows);
    else
        have = read_items(r, rows, items);
    /* What did arrive is looked at first, whatever the block. */
    for (size_t i = 0; !r->grid && i < have / r->columns && status == KOKSMA_OK;
         i++)
        status = check_row(r, rows + i * r->columns, r->row + i + 1, err);
    if (status == KOKSMA_OK && have < items) status = cut_short(r, err);
    if (status != KOKSMA_OK) return status;
    r->row += now;
    *got = now;
    return KOKSMA_OK;
}
