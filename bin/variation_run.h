#ifndef VARIATION_RUN_H
#define VARIATION_RUN_H

#include "cli.h"
#include "variation.h"

/* The variation of what a program computes: `sh -c command` gets the nodes of a
 * grid, a line each, then the end of its input, and prints a line for each with the
 * value last.  It is run for k = 4, 8, ..., until V_k has converged, k is `cells`,
 * or cells is 0 and the next grid has more than 2^16 nodes.  Exits 1 with a
 * sentence where the program fails.  Returns whether it was finished: when the watch
 * stops it, out has the last grid that was, or out->levels is 0. */
bool variation_run(koksma_variation_result *out, koksma_estimate *faces,
                   const char *command, size_t dim, size_t cells, cli_watch *watch);

#endif
