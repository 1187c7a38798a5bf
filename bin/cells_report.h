#ifndef CELLS_REPORT_H
#define CELLS_REPORT_H

#include "cells.h"
#include "cli.h"
#include "cli_integrand.h"

/* What koksma-cells was asked for, and its tables. */

typedef enum cells_method {
    CELLS_AUTO,
    CELLS_EXACT,
    CELLS_LINES,
    CELLS_SAMPLES
} cells_method;

typedef struct cells_options {
    cells_method method;
    bool occupancy, halton, axes, verbose;
    uint64_t *n; /* NULL: the number of points, or 2^10 */
    size_t count;
    uint32_t bases[KOKSMA_GRID_BASES_MOST]; /* the first primes unless told */
    size_t powers;                          /* how many were told; 0: cubes */
    bool primes;                            /* whether they are the first primes */
    uint64_t start, ratio;
    double jump; /* negative: not told */
    koksma_lines_opts lines;
    cli_watch watch;
} cells_options;

/* The bases for that dimension, NULL for cubes; exits where there are none. */
const uint32_t *cells_bases(cells_options *o, size_t dim);

/* The columns n, k, cells of a grid, the last one being its product. */
uint64_t cells_print_grid(uint64_t n, const uint64_t *cells, size_t dim);

/* A row for each n, of the integrand that cli_integrand_about calls so.  Returns
 * whether all were finished. */
bool cells_table(cells_options *o, const koksma_integrand *f,
                 const koksma_facts *facts, const char *about);

/* Rows for points on standard input or in files. */
void cells_sets(cells_options *o, cli_input *input);

/* Rows for the first elements of the Halton sequence. */
void cells_halton(cells_options *o, size_t dim);

#endif
