#include "variation_run.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli.h"

enum { NODES_USUAL = 1 << 16, NODES_MOST = 1 << 28, TEXT = 1 << 14 };

/* One run: a process writes the nodes, another is the program, and this one reads,
 * so that none waits for one that waits for it. */
typedef struct run {
    const char *command;
    size_t dim, k;
    double nodes;
    double value, values; /* V of the last grid that is done; how many were read */
    cli_watch *watch;
    pid_t writer, program;
    int in;                  /* the program's output, */
    char *text;              /* what of it was read, */
    size_t begin, end, room; /* and what of that is still to be looked at */
} run;

/* ---- Two processes ----------------------------------------------------------- */

static int write_nodes(FILE *out, size_t dim, size_t k)
{
    size_t at[KOKSMA_VARIATION_DIM_MOST] = {0}, j;
    double x[KOKSMA_VARIATION_DIM_MOST] = {0.0};

    do {
        if (koksma_write_rows(out, x, 1, dim, KOKSMA_DECIMAL, NULL)) return 1;
        for (j = dim; j > 0 && at[j - 1] == k; j--) {
            at[j - 1] = 0;
            x[j - 1] = 0.0;
        }
        if (j > 0) x[j - 1] = (double)++at[j - 1] / (double)k;
    } while (j > 0);
    return fflush(out) != 0;
}

static pid_t fork_or_fail(void)
{
    pid_t id = fork();

    if (id < 0) cli_fail("cannot start a process: %s", strerror(errno));
    return id;
}

/* A pipe whose ends are none of the standard streams, of which some may be closed.
 */
static void make_pipe(int ends[2])
{
    if (pipe(ends) != 0) cli_fail("cannot make a pipe: %s", strerror(errno));
    for (int i = 0; i < 2; i++) {
        int old = ends[i];

        if (old > STDERR_FILENO) continue;
        ends[i] = fcntl(old, F_DUPFD, STDERR_FILENO + 1);
        if (ends[i] < 0) cli_fail("cannot make a pipe: %s", strerror(errno));
        close(old);
    }
}

static void start(run *r)
{
    int nodes[2], values[2];

    make_pipe(nodes);
    make_pipe(values);
    r->program = fork_or_fail();
    if (r->program == 0) {
        dup2(nodes[0], STDIN_FILENO);
        dup2(values[1], STDOUT_FILENO);
        close(nodes[0]);
        close(nodes[1]);
        close(values[0]);
        close(values[1]);
        execl("/bin/sh", "sh", "-c", r->command, (char *)NULL);
        _exit(127);
    }
    close(nodes[0]);
    close(values[1]);
    r->writer = fork_or_fail();
    if (r->writer == 0) {
        FILE *out = fdopen(nodes[1], "w");

        signal(SIGPIPE, SIG_DFL); /* a program need not read them all */
        close(values[0]);
        _exit(out == NULL || write_nodes(out, r->dim, r->k));
    }
    close(nodes[1]);
    r->in = values[0];
    r->begin = r->end = 0;
}

/* Wait for both. */
static void finish(run *r)
{
    int status;

    close(r->in);
    waitpid(r->writer, NULL, 0);
    waitpid(r->program, &status, 0);
    if (WIFSIGNALED(status))
        cli_fail("the program was killed by signal %d at k = %zu", WTERMSIG(status),
                 r->k);
    if (WEXITSTATUS(status) != 0)
        cli_fail("the program left with status %d at k = %zu", WEXITSTATUS(status),
                 r->k);
}

static void abandon(run *r)
{
    kill(r->program, SIGTERM);
    kill(r->writer, SIGTERM);
    close(r->in);
    waitpid(r->writer, NULL, 0);
    waitpid(r->program, NULL, 0);
}

/* ---- What it prints ---------------------------------------------------------- */

/* The last field of a line, a finite number. */
static double read_value(const run *r, char *line, double number)
{
    size_t length = strlen(line);
    char *field, *end;
    double v;

    while (length > 0 && strchr(" \t\r\n,", line[length - 1]) != NULL)
        line[--length] = '\0';
    field = line + length;
    while (field > line && strchr(" \t,", field[-1]) == NULL)
        field--;
    v = strtod(field, &end);
    if (end == field || *end != '\0' || !isfinite(v))
        cli_fail(
            "value %.0f of the program at k = %zu is %.40s, not a finite number",
            number, r->k, field);
    return v;
}

static bool told_to_stop(const run *r)
{
    return cli_watch_progress(r->watch, r->value, r->value, r->values) != 0;
}

/* Wait until the program prints, or ends, looking now and then whether to stop. */
static bool wait_for_output(const run *r)
{
    enum { PATIENCE = 50 }; /* milliseconds */
    struct pollfd in = {.fd = r->in, .events = POLLIN};

    while (!told_to_stop(r))
        if (poll(&in, 1, PATIENCE) > 0) return true;
    return false;
}

static void grow_text(run *r)
{
    r->room += r->room + TEXT;
    r->text = realloc(r->text, r->room);
    if (r->text == NULL) cli_fail("not enough memory");
}

/* Read more behind what is left of the text.  Returns false at its end. */
static bool read_more(run *r)
{
    ssize_t got;

    r->end -= r->begin;
    memmove(r->text, r->text + r->begin, r->end);
    r->begin = 0;
    if (r->room - r->end < TEXT / 2) grow_text(r);
    do { /* the last byte stays free, for the end of the last line */
        if (!wait_for_output(r)) return false;
        got = read(r->in, r->text + r->end, r->room - r->end - 1);
    } while (got < 0 && errno == EINTR);
    if (got > 0) r->end += (size_t)got;
    return got > 0;
}

/* The next line, or NULL at the end or when told to stop.  Not by stdio, which would
 * wait for a silent program without looking up. */
static char *next_line(run *r)
{
    char *line, *newline;

    while ((newline = memchr(r->text + r->begin, '\n', r->end - r->begin)) == NULL)
        if (!read_more(r)) break;
    if (newline == NULL && (r->begin == r->end || told_to_stop(r))) return NULL;
    if (newline == NULL) newline = r->text + r->end++;
    *newline = '\0';
    line = r->text + r->begin;
    r->begin = (size_t)(newline + 1 - r->text);
    return line;
}

/* Comments and blank lines are no values.  Returns whether all were read. */
static bool read_values(run *r, koksma_variation_grid *g)
{
    char *line;
    double count = 0.0;
    koksma_error err;

    while ((line = next_line(r)) != NULL) {
        double v;

        if (line[0] == '#' || line[strspn(line, " \t\r\n")] == '\0') continue;
        r->values++;
        if (++count > r->nodes || told_to_stop(r)) break;
        v = read_value(r, line, count);
        if (koksma_variation_add(g, &v, 1, &err)) cli_fail_as(&err);
    }
    if (told_to_stop(r)) { /* an interrupt may have ended the program too */
        abandon(r);
        return false;
    }
    if (count > r->nodes)
        cli_fail("the program printed more than %.0f values for as many points at "
                 "k = %zu",
                 r->nodes, r->k);
    finish(r);
    if (count < r->nodes)
        cli_fail("the program printed %.0f values for %.0f points at k = %zu",
                 count, r->nodes, r->k);
    return true;
}

/* ---- Rounds ------------------------------------------------------------------ */

static bool one_round(koksma_variation_result *out, koksma_estimate *faces, run *r)
{
    bool done;
    size_t nodes[KOKSMA_VARIATION_DIM_MOST];
    koksma_variation_grid *g;
    koksma_error err;

    for (size_t j = 0; j < r->dim; j++)
        nodes[j] = r->k + 1;
    if (koksma_variation_open(&g, nodes, r->dim, &err)) cli_fail_as(&err);
    start(r);
    done = read_values(r, g);
    if (done && koksma_variation_finish(out, faces, g, &err)) cli_fail_as(&err);
    koksma_variation_close(g);
    if (done) r->value = out->level[out->levels - 1].value.value;
    return done;
}

static double nodes_of(size_t k, size_t dim)
{
    return pow((double)k + 1.0, (double)dim);
}

bool variation_run(koksma_variation_result *out, koksma_estimate *faces,
                   const char *command, size_t dim, size_t cells, cli_watch *watch)
{
    run r = {.command = command, .dim = dim, .watch = watch};
    double most = cells > 0 ? NODES_MOST : NODES_USUAL;
    size_t first = cells == 2 || nodes_of(4, dim) > most ? 2 : 4;
    bool done = false;

    if (nodes_of(cells > 0 ? cells : 2, dim) > NODES_MOST)
        cli_fail("%zu cells on each of %zu axes have %.3g nodes, and a program is "
                 "asked for 2^28 at most",
                 cells > 0 ? cells : 2, dim, nodes_of(cells > 0 ? cells : 2, dim));
    grow_text(&r);
    for (r.k = first; r.k == first || nodes_of(r.k, dim) <= most; r.k *= 2) {
        r.nodes = nodes_of(r.k, dim);
        done = one_round(out, faces, &r);
        if (!done || out->trend == KOKSMA_TREND_CONVERGED || r.k == cells) break;
    }
    free(r.text);
    return done;
}
