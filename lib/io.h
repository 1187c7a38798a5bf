#ifndef KOKSMA_IO_H
#define KOKSMA_IO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "points.h"

/* Point sets, values and tables in files: koksma_points(5), koksma_values(5).
 *
 * Text: a point a line; blanks, tabs or a comma between C numbers (hexadecimal
 * ones too); `#` starts a comment; CRLF is tolerated; a blank line ends a set, so
 * one stream can hold many.  Or NumPy's .npy, told by its first byte: float64 or
 * float32, either byte order, C or Fortran order, two axes; arrays one after the
 * other are sets.  Nothing is read twice and nothing depends on the locale.
 *
 * A signal that is caught without SA_RESTART does not end the reading where the C
 * library is glibc, and of .npy anywhere; else it may, as KOKSMA_EIO.  It does end
 * the writing, as KOKSMA_EIO: stdio drops what a failed write leaves. */

/* ---- Reading --------------------------------------------------------------- */

typedef struct koksma_reader koksma_reader;

typedef enum koksma_content {
    KOKSMA_POINTS, /* every column is a coordinate, in [0,1] */
    KOKSMA_VALUES, /* the last column is a value, any finite number */
    KOKSMA_GRID    /* text: as KOKSMA_VALUES; .npy: an array of values with any
                    * number of axes, and what they are is not looked at */
} koksma_content;

/* Start to read sets from `in`, which stays the caller's to close.
 *
 * Returns: KOKSMA_OK; KOKSMA_ENOMEM */
koksma_status koksma_reader_open(koksma_reader **out, FILE *in,
                                 koksma_content content, koksma_error *err);
void koksma_reader_close(koksma_reader *r); /* r may be NULL */

/* Go on to the next set, past what is left of this one; a set of which no row was
 * read yet stays the next one.
 *
 * Out:     columns  numbers a row; 0 when the input has ended
 * Returns: KOKSMA_OK; KOKSMA_EFORMAT or KOKSMA_EDOMAIN naming line and column;
 *          KOKSMA_EIO; KOKSMA_ENOMEM.  After a failure only close r. */
koksma_status koksma_reader_next(koksma_reader *r, size_t *columns,
                                 koksma_error *err);

/* Read rows of the current set, as many as there are up to room.
 *
 * Out:     rows     room*columns numbers, row after row; also written to on failure
 *          got      rows read; 0 when the set has ended
 * Returns: as koksma_reader_next */
koksma_status koksma_reader_rows(koksma_reader *r, double *rows, size_t room,
                                 size_t *got, koksma_error *err);

enum { KOKSMA_AXES_MOST = 32 };

/* How the values of an array follow each other.  Fortran's order is that of C with
 * the axes in reverse, which is then said, and not undone. */
typedef struct koksma_axes {
    size_t count;                    /* 0: no array, or not read as KOKSMA_GRID */
    size_t length[KOKSMA_AXES_MOST]; /* the fastest last */
    bool reversed;
} koksma_axes;

/* The axes of the current set.  Its rows are along the fastest; of one axis a row
 * has one value. */
koksma_axes koksma_reader_axes(const koksma_reader *r);

/* What `# koksma: key=value ...` comments have said so far, joined by blanks; ""
 * when they said nothing.  The later of two equal keys counts. */
const char *koksma_reader_about(const koksma_reader *r);

/* Look key up in such a text.  Returns whether it is there (and a number); the
 * word is cut to size - 1 bytes. */
bool koksma_about_number(const char *about, const char *key, double *value);
bool koksma_about_word(const char *about, const char *key, char *word, size_t size);

/* ---- A set in memory --------------------------------------------------------- */

/* Owner of n points and, when read as KOKSMA_VALUES, of their values.  Start
 * with {0}; reading again reuses the memory. */
typedef struct koksma_set {
    double *x; /* n*dim coordinates */
    double *f; /* n values; NULL for points */
    size_t n, dim;
    size_t room, room_f; /* doubles there is room for */
} koksma_set;

/* Read the next set, whole; n is 0 when there is none, and after a failure. */
koksma_status koksma_set_read(koksma_set *set, koksma_reader *r, koksma_error *err);
void koksma_set_free(koksma_set *set);
koksma_points koksma_set_view(const koksma_set *set);

/* ---- Tables ------------------------------------------------------------------ */

/* Two columns of a table, and the sets that its rows belong to.  Start with {0}. */
typedef struct koksma_table {
    double *x, *y; /* rows numbers each */
    size_t *set;   /* 0, 1, ...: equal where the column `set` is */
    size_t rows, sets;
    bool labelled; /* whether there is a column `set` */
    char about[512];
    size_t room_x, room_y, room_set;
} koksma_table;

/* Read a table: rows of fields as above, under a `#` line that names them.
 * x and y are numbers from 1, or names; of several names, apart by |, the first
 * that there is.  Fields of other columns may be any
 * words.  A blank line changes nothing.
 *
 * Returns: as koksma_reader_next; KOKSMA_EINVAL when there is no such column */
koksma_status koksma_table_read(koksma_table *table, FILE *in, const char *x,
                                const char *y, koksma_error *err);
void koksma_table_free(koksma_table *table);

/* ---- Writing ----------------------------------------------------------------- */

typedef enum koksma_form {
    KOKSMA_DECIMAL, /* tab-separated, as koksma_format_number has it */
    KOKSMA_HEX,     /* tab-separated, C's %a */
    KOKSMA_NPY      /* NumPy's bytes, after koksma_write_npy_header */
} koksma_form;

/* Write n rows of numbers.  What they mean is not checked.
 *
 * Returns: KOKSMA_OK; KOKSMA_EIO */
koksma_status koksma_write_rows(FILE *out, const double *rows, size_t n,
                                size_t columns, koksma_form form,
                                koksma_error *err);

/* The header of an array of n rows: write it before the rows of KOKSMA_NPY. */
koksma_status koksma_write_npy_header(FILE *out, size_t n, size_t columns,
                                      koksma_error *err);

/* Room for any double as text, the final NUL included. */
#define KOKSMA_NUMBER_SIZE 32

/* v as the first of %.15g, %.16g and %.17g that strtod reads back as v, in the C
 * locale; returns the length. */
size_t koksma_format_number(char text[KOKSMA_NUMBER_SIZE], double v);

#endif
