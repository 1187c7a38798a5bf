#ifndef BOUND_INPUT_H
#define BOUND_INPUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "bound.h"
#include "cli_integrand.h"

/* What koksma-bound reads of the other tools' tables. */

/* A number at some N's, rising. */
typedef struct bound_curve {
    double *n, *value;
    size_t count;
} bound_curve;

typedef struct bound_input {
    koksma_bound_facts facts;
    double cells, growth; /* of V_k: the k as far as it was seen, and its rate */
    bound_curve star;     /* upper ends of D* */
    bound_curve observed; /* root mean square errors */
    bool unscrambled;     /* the points observed are a sequence as it is */
    char about[CLI_ABOUT_SIZE]; /* which integrand, as comments say it, or "" */
} bound_input;

/* Add what a table of koksma-star, koksma-variation or koksma-cells says; what is
 * known already stays.  Exits 1 where it is none of them, or of another integrand. */
void bound_read_table(bound_input *b, const char *file);

/* Read koksma-error's rows, of replicates or with --summary; exits likewise. */
void bound_read_observed(bound_input *b, const char *file);

/* Make it one value at one N. */
void bound_curve_set(bound_curve *c, double n, double value);

/* The value at that N, or NaN. */
double bound_at(const bound_curve *c, double n);

void bound_input_free(bound_input *b);

#endif
