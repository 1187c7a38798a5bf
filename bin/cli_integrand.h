#ifndef CLI_INTEGRAND_H
#define CLI_INTEGRAND_H

#include <stdbool.h>
#include <stddef.h>

#include "integrand.h"
#include "scene.h"

/* What the tools over integrands share: one of the table, its dimension and its
 * parameters, from the command line. */

enum { CLI_SETTINGS_MOST = 16 };

/* What the command line asks for.  Start with {0}. */
typedef struct cli_integrand {
    const koksma_integrand_row *row;
    size_t dim, bounces; /* 0: the usual one */
    double param[KOKSMA_PARAMS_MOST];
    struct {
        const char *option, *name,
            *text; /* name NULL: part of text, or the first */
    } settings[CLI_SETTINGS_MOST];
    size_t count;
} cli_integrand;

/* Note the argument of such an option, until the integrand is known. */
void cli_integrand_set(cli_integrand *r, const char *option, const char *name);

/* Whether there is one of that name. */
bool cli_integrand_exists(const char *name);

/* Take the one of that name, with its parameters.  Exits 2 where the command line
 * makes no sense for it. */
void cli_integrand_choose(cli_integrand *r, const char *name);

/* Whether the values of that piece, NULL for all, are those of walks in the scene. */
bool cli_integrand_walks(const koksma_integrand_row *row, const char *piece);

enum { CLI_ABOUT_SIZE = 512 };

/* Which integrand it is, as a "# koksma:" comment says it: integrand, dim, piece
 * where that is not NULL, bounces of a walk, and the parameters. */
void cli_integrand_about(char text[CLI_ABOUT_SIZE], const koksma_integrand_row *row,
                         const koksma_integrand *f, const char *piece);

/* The first parameter of which two such comments say different numbers; NULL where
 * there is none.  Both are of the integrand called name. */
const char *cli_integrand_differs(const char *name, const char *one,
                                  const char *other);

#endif
