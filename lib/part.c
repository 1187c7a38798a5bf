#include "part.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <unistd.h>

/* All of Koksma's threads and atomics are here. */

typedef struct member {
    ki_team *team;
    size_t worker;
    pthread_t thread;
} member;

struct ki_team {
    size_t threads;
    pthread_mutex_t lock;
    _Atomic double peak;
    atomic_bool stopped;

    atomic_size_t next; /* task to begin */
    size_t tasks;
    ki_task_work *work;
    void *state;
    member member[]; /* threads */
};

static size_t processors(void)
{
    long count = sysconf(_SC_NPROCESSORS_ONLN);

    return count > 0 ? (size_t)count : 1;
}

ki_team *ki_team_open(size_t threads)
{
    ki_team *t;

    if (threads == 0) threads = processors();
    if (threads > (SIZE_MAX - sizeof *t) / sizeof t->member[0]) return NULL;
    t = malloc(sizeof *t + threads * sizeof t->member[0]);
    if (t == NULL) return NULL;
    t->threads = threads;
    atomic_init(&t->peak, 0.0);
    atomic_init(&t->stopped, false);
    atomic_init(&t->next, 0);
    for (size_t i = 0; i < threads; i++)
        t->member[i] = (member){.team = t, .worker = i};
    if (pthread_mutex_init(&t->lock, NULL) == 0) return t;
    free(t);
    return NULL;
}

void ki_team_close(ki_team *t)
{
    if (t == NULL) return;
    pthread_mutex_destroy(&t->lock);
    free(t);
}

size_t ki_team_threads(const ki_team *t) { return t->threads; }

static void *work_through(void *argument)
{
    const member *m = argument;
    ki_team *t = m->team;

    while (!ki_team_stopped(t)) {
        size_t task = atomic_fetch_add(&t->next, 1);

        if (task >= t->tasks) break;
        t->work(t->state, m->worker, task);
    }
    return NULL;
}

void ki_team_run(ki_team *t, size_t tasks, ki_task_work *work, void *state)
{
    size_t wanted = tasks < t->threads ? tasks : t->threads, started = 1;

    atomic_store(&t->next, 0);
    t->tasks = tasks;
    t->work = work;
    t->state = state;
    while (started < wanted &&
           pthread_create(&t->member[started].thread, NULL, work_through,
                          &t->member[started]) == 0)
        started++;
    work_through(&t->member[0]);
    while (--started > 0)
        pthread_join(t->member[started].thread, NULL);
}

void ki_team_lock(ki_team *t) { pthread_mutex_lock(&t->lock); }
void ki_team_unlock(ki_team *t) { pthread_mutex_unlock(&t->lock); }

void ki_team_stop(ki_team *t) { atomic_store(&t->stopped, true); }
bool ki_team_stopped(const ki_team *t) { return atomic_load(&t->stopped); }

void ki_team_raise(ki_team *t, double v)
{
    double peak = atomic_load(&t->peak);

    /* A failed exchange brings the peak of the thread that came first. */
    while (peak < v && !atomic_compare_exchange_weak(&t->peak, &peak, v))
        ;
}

double ki_team_peak(const ki_team *t) { return atomic_load(&t->peak); }
