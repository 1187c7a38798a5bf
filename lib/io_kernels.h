#ifndef KI_IO_KERNELS_H
#define KI_IO_KERNELS_H

#include <stdio.h>

#include "io.h"

/* Private: what the readers of text, of .npy and of tables share. */

/* The number at text as strtod reads it; returns where it ends, or text when
 * there is none.  text[0] is not a blank. */
const char *ki_number_read(const char *text, double *v);

/* Lines of text, without their ends and comments. */
typedef struct ki_lines {
    FILE *in;
    bool table; /* names are wanted */
    char *text; /* the line, cut before its comment, leading blanks still there */
    size_t room, number;
    char about[512];
    char *names; /* the last comment line that is not about, or NULL */
    size_t room_names;
} ki_lines;

/* Read the next line; *more is false at the end of the input. */
koksma_status ki_lines_next(ki_lines *l, bool *more, koksma_error *err);
void ki_lines_free(ki_lines *l);

static inline const char *ki_skip_blanks(const char *s)
{
    while (*s == ' ' || *s == '\t')
        s++;
    return s;
}

/* Where the field at s ends: at a blank, a comma or the line's end. */
static inline const char *ki_field_end(const char *s)
{
    while (*s != '\0' && *s != ' ' && *s != '\t' && *s != ',')
        s++;
    return s;
}

/* Past a field's end and the comma behind it, if there is one; *comma says so. */
const char *ki_next_field(const char *end, bool *comma);

/* getc, and fread of bytes, which go on after a signal that is caught. */
int ki_read_char(FILE *in);
size_t ki_read_bytes(void *out, size_t size, FILE *in);

/* "cannot read: " and why, by errno. */
koksma_status ki_fail_read(koksma_error *err);

/* Enough of a text to find it by, and nothing that a terminal would obey. */
enum { KI_SHOWN = 44 };
void ki_show(char shown[KI_SHOWN], const char *text, size_t length);

/* "column 2 is "0.5x", not a number", and the like, with the line. */
koksma_status ki_fail_field(koksma_error *err, koksma_status status, size_t line,
                            const char *what, size_t number, const char *field,
                            const char *complaint);

struct koksma_reader {
    koksma_content content;
    bool started, npy;
    bool grid;      /* .npy: all numbers are values; content is that of text */
    size_t columns; /* of the current set; 0 between sets */

    ki_lines lines;
    bool pending; /* first_row waits to be handed out */
    double *first_row;
    size_t room_first;

    size_t row, rows; /* of the current array: handed out, and all */
    bool single, swapped;
    koksma_axes axes;   /* where grid, else none */
    double *transposed; /* a Fortran-order array, in C order; else NULL */
};

koksma_status ki_text_next(koksma_reader *r, koksma_error *err);
koksma_status ki_text_rows(koksma_reader *r, double *rows, size_t room, size_t *got,
                           koksma_error *err);
koksma_status ki_npy_next(koksma_reader *r, koksma_error *err);
koksma_status ki_npy_rows(koksma_reader *r, double *rows, size_t room, size_t *got,
                          koksma_error *err);

#endif
