#ifndef CLI_SEARCH_H
#define CLI_SEARCH_H

#include "cli.h"
#include "num.h"

/* What the tools share that search for the worst of many boxes or half-planes:
 * koksma-star, koksma-box, koksma-edge.  They differ in their methods and in what
 * they find. */

enum {
    CLI_SEARCH_PART = CLI_LONG,
    CLI_SEARCH_PREFIXES,
    CLI_SEARCH_TRACE,
};

/* Rows of a table of options, in the order in which they are to stand. */
#define CLI_SEARCH_LIMITS                                                          \
    {'e', "tolerance", "E", "stop at upper <= (1+E) lower (default 0: exact)"},    \
        {'t', "time", "SECONDS", "stop then, with the interval so far"},           \
    {                                                                              \
        'j', "threads", "THREADS", "how many threads (default 0: one a processor)" \
    }
#define CLI_SEARCH_SHARES                                                          \
    {'s', "seed", "SEED", "of the search (default 1)"},                            \
    {                                                                              \
        CLI_SEARCH_PART, "part", "I/M", "do the I-th of M shares of the work"      \
    }
#define CLI_SEARCH_ROWS                                                            \
    {CLI_SEARCH_PREFIXES, "prefixes", "A:B|N,N,...",                               \
     "a row for so many first points each"},                                       \
    {                                                                              \
        CLI_SEARCH_TRACE, "trace", NULL,                                           \
            "write a row at every improvement of the interval"                     \
    }
#define CLI_SEARCH_AUDIT                                                           \
    {'p', "progress", NULL, "a live line on standard error"},                      \
    {                                                                              \
        'v', "verbose", NULL, "say on standard error what was done"                \
    }

/* A method, at the place of its number in the library; the first is "auto". */
typedef struct cli_search_method {
    const char *name, *steps; /* what its steps are */
} cli_search_method;

typedef struct cli_search {
    const cli_search_method *methods; /* ended by {0} */
    const char *witness_columns;      /* a tab before each */
    const char *measure; /* said in a comment; NULL: one that bounds D* */
    /* What was asked for; the headers of the library say what it means. */
    int method;
    double tolerance;
    bool anytime;
    size_t threads, part, parts;
    uint64_t seed;
    bool witness, trace, verbose;
    cli_watch watch;
    /* What is at hand. */
    const cli_input *input;
    uint64_t *prefix; /* NULL: only the whole set */
    size_t prefixes;
    bool header;            /* whether it is written */
    koksma_interval traced; /* what the last row of the trace said */
} cli_search;

/* Take option c, its argument in optarg; -m too. */
void cli_search_option(cli_search *s, int c);

/* measure(p, s) for all sets and their prefixes, until one returns false; then
 * leave, with CLI_DONE or CLI_STOPPED. */
_Noreturn void cli_search_run(cli_search *s, int argc, char *argv[],
                              cli_measure *measure);

/* Around a call of the library, which reports to cli_search_progress with s as its
 * state.  An error ends the program; that it was stopped is said. */
void cli_search_start(cli_search *s);
void cli_search_stop(const cli_search *s, koksma_status status,
                     const koksma_error *err);
koksma_progress cli_search_progress;

/* Begin the row of a set, or end the trace; columns of a witness may follow. */
void cli_search_row(cli_search *s, koksma_points p, koksma_interval value,
                    double work);
void cli_search_column(double v);

/* End it, and say on standard error which method ran, and why, if asked. */
void cli_search_end(const cli_search *s, koksma_points p, int method,
                    const char *reason, double work);

#endif
