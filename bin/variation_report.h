#ifndef VARIATION_REPORT_H
#define VARIATION_REPORT_H

#include <stdbool.h>
#include <stddef.h>

#include "variation.h"

/* What koksma-variation says of one function. */

typedef enum variation_form {
    VARIATION_ROW,    /* the finest grid */
    VARIATION_LEVELS, /* a row a grid */
    VARIATION_FACES,  /* a row a face */
    VARIATION_EXPLAIN /* a paragraph */
} variation_form;

typedef struct variation_report {
    koksma_variation_result result;
    koksma_estimate *faces; /* by the bits of their axes, counted in reverse where
                             * `reversed` */
    size_t dim;
    bool reversed;
    bool sampled;      /* values on a grid, of which no more is known */
    const char *label; /* NULL: the only one */
    const char *about; /* which integrand, by cli_integrand_about, or NULL */
    double known;      /* V_HK in closed form; NaN: not known */
} variation_report;

void variation_print_header(variation_form form, bool several);
void variation_print(const variation_report *r, variation_form form);

#endif
