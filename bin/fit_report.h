#ifndef FIT_REPORT_H
#define FIT_REPORT_H

#include <stdbool.h>
#include <stdint.h>

#include "fit.h"

/* What koksma-fit says of one fit: a row, or a paragraph. */

/* An exponent that a fit is held against. */
typedef struct candidate {
    const char *name;
    double exponent;
} candidate;

enum { CANDIDATES_MOST = 5 };

typedef struct fit_report {
    koksma_fit_result fit;
    const char *label;  /* of the file; NULL where there is but one */
    const char *column; /* of the errors, as the user named it, or NULL */
    const char *about;  /* the input's comments */
    bool labelled;      /* a column names the sets, as koksma-error's tables have */
    size_t path;        /* the one set that was picked, from 1; 0: all */
    candidate candidates[CANDIDATES_MOST]; /* the claim first, if there is one */
    size_t count;
    bool claimed;
    double margin;
    uint64_t dim;             /* 0: not known */
    double area, jump, sigma; /* NaN: not known */
} fit_report;

/* Fill in candidates: the claim is `claim`, or what beta makes of dim, or the
 * theory of jumps; NaN and 0 are not known. */
void fit_report_candidates(fit_report *r, double claim, double beta);

void fit_report_header(const fit_report *r);
void fit_report_row(const fit_report *r);
void fit_report_explain(const fit_report *r);

#endif
