#ifndef CLI_H
#define CLI_H

#include <getopt.h> /* optarg and optind */
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "io.h"
#include "points.h"

/* What the tools share: options, numbers, inputs, messages, exits.  A tool is one
 * table of options and a main. */

enum { CLI_DONE = 0, CLI_BAD_DATA = 1, CLI_USAGE = 2, CLI_STOPPED = 3 };

/* id is the letter of a short option, or a number from CLI_LONG on for one that
 * has none.  -h, -V and -q are added by themselves; -q sets cli_quiet. */
enum { CLI_LONG = 256 };

typedef struct cli_option {
    int id;
    const char *name;     /* of the long option */
    const char *argument; /* what it takes, for the help; NULL: nothing */
    const char *help;
} cli_option;

typedef struct cli_tool {
    const char *name;     /* koksma-star */
    const char *operands; /* "[FILE]..." */
    const char *summary;
    const cli_option *options; /* ended by {0} */
} cli_tool;

/* The next option's id, its argument in optarg; -1 after the last.  Answers -h
 * and -V, and exits on an unknown option. */
int cli_next(const cli_tool *tool, int argc, char *argv[]);
bool cli_quiet(void);

/* Exit 2, naming it, if one of these options of the tool, ended by 0, was given:
 * "--axes is WHY". */
void cli_refuse(const int *ids, const char *why);

/* Numbers as people write them: 1000000, 1e6, 2^20.  Exit 2, naming the option,
 * unless text is one from least to most. */
uint64_t cli_count(const char *option, const char *text, uint64_t least,
                   uint64_t most);
double cli_real(const char *option, const char *text, double least, double most);

/* The sizes of prefixes: numbers and ranges A:B apart by commas, all rising; a
 * range is A 2^(i/steps) rounded, for i = 0, 1, ..., as far as B, and B.  Returns
 * how many there are; *n is the caller's to free. */
size_t cli_prefixes(uint64_t **n, const char *option, const char *text,
                    unsigned steps);

/* Write v in the fewest digits that read back as v; a NaN as "nan". */
void cli_number(double v);

/* Messages on standard error, each a sentence behind the tool's name. */
_Noreturn void cli_usage(const char *format, ...)
    __attribute__((format(printf, 1, 2)));
_Noreturn void cli_fail(const char *format, ...)
    __attribute__((format(printf, 1, 2)));
_Noreturn void cli_fail_as(const koksma_error *err); /* not about an input */
void cli_note(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* What a noun ends in behind that number. */
static inline const char *cli_plural(size_t n) { return n == 1 ? "" : "s"; }

/* Flush standard output, and leave with 1 when it cannot be written. */
void cli_flush(void);

/* The same, and leave with status. */
_Noreturn void cli_finish(int status);

/* ---- Inputs: the FILEs of the command line, or standard input ---------------- */

typedef struct cli_input {
    char **files; /* ended by NULL */
    koksma_content content;
    const char *name; /* of the open file; NULL: standard input */
    FILE *in;
    koksma_reader *reader;
    size_t ordinal; /* of the current set in its file */
    bool several;   /* whether there is more than one set, once one is read */
    char label[256];
} cli_input;

cli_input cli_inputs(int argc, char *argv[], koksma_content content);

/* Open the next file, or standard input if none was named; false after the last. */
bool cli_next_file(cli_input *input);

/* Go on to the next set of all files: its reader is at its first row, its label
 * names it; false after the last.  A file without a set is an error. */
bool cli_next_set(cli_input *input, size_t *columns);

/* After the rows of a set: settle `several`. */
void cli_settle_several(cli_input *input);

/* Go on to the next set as cli_next_set does, and read it, whole; settles
 * `several`.
 */
bool cli_read_set(cli_input *input, koksma_set *set);

/* measure(p, state) for the prefixes of these sizes, or for the whole set if count
 * is 0, until one returns false, which is then returned. */
typedef bool cli_measure(koksma_points p, void *state);
bool cli_each_prefix(const cli_input *input, const koksma_set *set,
                     const uint64_t *n, size_t count, cli_measure *measure,
                     void *state);

/* Exit 1 with err, naming file and line. */
_Noreturn void cli_fail_input(const cli_input *input, const koksma_error *err);

/* ---- Watching long jobs ------------------------------------------------------ */

typedef struct cli_watch {
    double seconds; /* stop after so many; 0: never */
    bool show;      /* a live line on standard error */
    double started;
} cli_watch;

/* From here on an interrupt stops the job, not the program. */
void cli_watch_start(cli_watch *watch);
void cli_watch_stop(const cli_watch *watch); /* ends the live line */
/* From here on it ends the program again, as does one that came since the last job:
 * not before that job's row is out. */
void cli_watch_release(void);
double cli_seconds(const cli_watch *watch); /* since the start */
koksma_progress cli_watch_progress;         /* its state is the cli_watch */

#endif
