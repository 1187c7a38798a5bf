#ifndef ERROR_REPORT_H
#define ERROR_REPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "curve.h"

/* What koksma-error keeps of its sets, and how it prints them. */

typedef struct error_set {
    char *label;
    koksma_curve_row *rows;
    size_t count;
    uint64_t n; /* values */
} error_set;

typedef struct error_sets {
    error_set *set;
    size_t count, room;
} error_sets;

/* What is known of the values: it goes on to koksma-fit. */
typedef struct error_header {
    char about[512];
    double exact, sigma, largest;
    const char *exact_from; /* NULL: the input says it itself */
    const char *sigma_from;
    uint64_t dim; /* 0: not told */
} error_header;

void error_sets_keep(error_sets *s, const char *label, const koksma_curve_row *rows,
                     size_t count, uint64_t n);
void error_sets_free(error_sets *s);

/* Measure the errors from I + shift, and drop the last two octaves of each set,
 * which such an I knows too well; exits where nothing is left. */
void error_sets_shift(error_sets *s, double shift);

void error_print_header(const error_header *h, const char *columns);
void error_print_rows(const char *label, const koksma_curve_row *rows, size_t count,
                      double sigma);

/* Fail unless the sets have equally many values. */
void error_sets_check_equal(const error_sets *s);

/* Root mean squares over the sets, which are equal. */
void error_print_summary(const error_sets *s, double sigma);

#endif
