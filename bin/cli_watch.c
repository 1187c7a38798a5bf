#include <signal.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "cli.h"

static volatile sig_atomic_t interrupted;

/* The third one ends the program, should the job not listen.  Not the second: some
 * programs send an interrupt to the process and to its group. */
static void on_interrupt(int number)
{
    interrupted = interrupted + 1;
    if (interrupted < 3) return;
    signal(number, SIG_DFL);
    raise(number);
}

static double now(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void cli_watch_start(cli_watch *watch)
{
    struct sigaction action = {.sa_handler = on_interrupt, .sa_flags = SA_RESTART};

    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    watch->started = now();
}

void cli_watch_stop(const cli_watch *watch)
{
    if (watch->show && isatty(STDERR_FILENO)) putc('\n', stderr);
}

void cli_watch_release(void)
{
    struct sigaction action;

    sigaction(SIGINT, NULL, &action);
    if (action.sa_handler != on_interrupt) return;
    signal(SIGINT, SIG_DFL);
    if (interrupted) raise(SIGINT);
}

double cli_seconds(const cli_watch *watch) { return now() - watch->started; }

int cli_watch_progress(void *state, double lower, double upper, double work)
{
    const cli_watch *watch = state;

    if (watch->show && isatty(STDERR_FILENO))
        fprintf(stderr, "\r[%.6g, %.6g] after %.3g steps, %.0f s ", lower, upper,
                work, cli_seconds(watch));
    return interrupted ||
           (watch->seconds > 0.0 && cli_seconds(watch) >= watch->seconds);
}
