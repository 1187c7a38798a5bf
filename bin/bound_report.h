#ifndef BOUND_REPORT_H
#define BOUND_REPORT_H

#include <stddef.h>
#include <stdint.h>

#include "bound_input.h"

/* What koksma-bound says: rows, or a paragraph about one N. */

typedef struct bound_report {
    const bound_input *input;
    const char *integrand; /* its name, or NULL */
    const uint64_t *n;
    size_t count;
    double z;
} bound_report;

void bound_print(const bound_report *r);
void bound_explain(const bound_report *r);

#endif
