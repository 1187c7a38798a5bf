#ifndef KI_PART_H
#define KI_PART_H

#include <stdbool.h>
#include <stddef.h>

/* Private: threads that work through numbered tasks, and the little that they
 * share: a lock, a number that only rises, and a sign to stop. */
typedef struct ki_team ki_team;

/* threads: 0 for one a processor.  Returns NULL without memory. */
ki_team *ki_team_open(size_t threads);
void ki_team_close(ki_team *t); /* t may be NULL */
size_t ki_team_threads(const ki_team *t);

/* work(state, worker, task) for every task < tasks, each once and in rising order
 * of their beginnings, by workers 0, ..., threads - 1, of which worker 0 is the
 * calling thread.  Returns when all are done, or were begun before a stop.  Where
 * the system starts fewer threads, those do all the work. */
typedef void ki_task_work(void *state, size_t worker, size_t task);
void ki_team_run(ki_team *t, size_t tasks, ki_task_work *work, void *state);

void ki_team_lock(ki_team *t);
void ki_team_unlock(ki_team *t);

/* No further task begins; those that run had better look. */
void ki_team_stop(ki_team *t);
bool ki_team_stopped(const ki_team *t);

/* The greatest number raised to, 0 at first. */
void ki_team_raise(ki_team *t, double v);
double ki_team_peak(const ki_team *t);

#endif
