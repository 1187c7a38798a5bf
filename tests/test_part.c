/* The team of lib/part.h: what its threads, its tasks, its lock, its peak and its
 * stop promise, with any number of threads. */

#include <check.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdint.h>
#include <string.h>

#include "oracle.h"
#include "part.h"

enum { THREADS = 8, TASKS = 4000 };

/* What the tasks of a run leave behind. */
typedef struct run {
    ki_team *team;
    pthread_t caller;
    atomic_int done[TASKS];
    size_t next[THREADS]; /* a worker's last task, and one more */
    size_t stop_at;       /* the task that says stop */
    atomic_size_t begun;
    atomic_bool fair;
    size_t locked; /* changed under the lock alone */
} run;

static run *fresh_run(size_t threads)
{
    static run r;

    memset(&r, 0, sizeof r);
    r.team = ki_team_open(threads);
    ck_assert_ptr_nonnull(r.team);
    r.caller = pthread_self();
    r.stop_at = SIZE_MAX;
    atomic_store(&r.fair, true);
    return &r;
}

static void note_task(void *state, size_t worker, size_t task)
{
    run *r = state;

    /* A worker is one thread, so its row needs no lock. */
    if (worker >= ki_team_threads(r->team) || task < r->next[worker] ||
        (worker == 0) != (pthread_equal(pthread_self(), r->caller) != 0)) {
        atomic_store(&r->fair, false);
        return;
    }
    r->next[worker] = task + 1;
    atomic_fetch_add(&r->done[task], 1);
}

START_TEST(every_task_once)
{
    static const size_t counts[] = {0, 1, 2, 7, 8, 9, TASKS};

    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        run *r = fresh_run((size_t)_i);

        ck_assert_uint_eq(ki_team_threads(r->team), (size_t)_i);
        for (int again = 1; again <= 2; again++) { /* a team runs more than once */
            memset(r->next, 0, sizeof r->next);
            ki_team_run(r->team, counts[i], note_task, r);
            ck_assert(atomic_load(&r->fair));
            for (size_t task = 0; task < TASKS; task++)
                ck_assert_int_eq(atomic_load(&r->done[task]),
                                 task < counts[i] ? again : 0);
        }
        ck_assert(!ki_team_stopped(r->team));
        ki_team_close(r->team);
    }
}
END_TEST

/* From the task that says stop on, all wait for it. */
static void stop_or_wait(void *state, size_t worker, size_t task)
{
    run *r = state;

    (void)worker;
    atomic_fetch_add(&r->begun, 1);
    if (task == r->stop_at) ki_team_stop(r->team);
    while (task > r->stop_at && !ki_team_stopped(r->team))
        sched_yield();
}

/* Tasks that the others had begun by then are all that comes after the stop. */
START_TEST(stop_ends_early)
{
    static const size_t stops[] = {0, 1, 100, TASKS - 1};

    for (size_t i = 0; i < sizeof stops / sizeof stops[0]; i++) {
        run *r = fresh_run((size_t)_i);
        size_t most = stops[i] + (size_t)_i, before;

        r->stop_at = stops[i];
        ki_team_run(r->team, TASKS, stop_or_wait, r);
        before = atomic_load(&r->begun);
        ck_assert(ki_team_stopped(r->team));
        ck_assert_uint_gt(before, stops[i]);
        ck_assert_uint_le(before, most);
        ki_team_run(r->team, TASKS, stop_or_wait, r);
        ck_assert_uint_eq(atomic_load(&r->begun), before);
        ki_team_close(r->team);
    }
}
END_TEST

/* 1, ..., TASKS in another order: 1237 has no factor in common with TASKS. */
static double height(size_t task) { return (double)(task * 1237 % TASKS + 1); }

static void raise_peak(void *state, size_t worker, size_t task)
{
    run *r = state;
    double before = ki_team_peak(r->team), own = height(task), after;

    (void)worker;
    ki_team_raise(r->team, own);
    after = ki_team_peak(r->team);
    if (after < own || after < before) atomic_store(&r->fair, false);
}

START_TEST(peak_is_the_greatest)
{
    for (int round = 0; round < 20; round++) {
        run *r = fresh_run((size_t)_i);

        ck_assert_double_eq(ki_team_peak(r->team), 0.0);
        ki_team_raise(r->team, -1.0);
        ck_assert_double_eq(ki_team_peak(r->team), 0.0);
        ki_team_run(r->team, TASKS, raise_peak, r);
        ck_assert(atomic_load(&r->fair));
        ck_assert_double_eq(ki_team_peak(r->team), TASKS);
        ki_team_raise(r->team, 1.0);
        ck_assert_double_eq(ki_team_peak(r->team), TASKS);
        ki_team_close(r->team);
    }
}
END_TEST

static void change_under_lock(void *state, size_t worker, size_t task)
{
    run *r = state;
    volatile size_t *locked = &r->locked;

    (void)worker;
    for (int i = 0; i < 10; i++) {
        ki_team_lock(r->team);

        size_t before = *locked;

        if (task % 64 == 0) sched_yield(); /* room for whoever does not wait */
        *locked = before + 1;
        ki_team_unlock(r->team);
    }
}

START_TEST(lock_excludes)
{
    run *r = fresh_run((size_t)_i);

    ki_team_run(r->team, TASKS, change_under_lock, r);
    ck_assert_uint_eq(r->locked, 10 * TASKS);
    ki_team_close(r->team);
}
END_TEST

START_TEST(numbers_of_threads)
{
    ki_team *t = ki_team_open(0);

    ck_assert_ptr_nonnull(t);
    ck_assert_uint_ge(ki_team_threads(t), 1);
    ki_team_close(t);
    ki_team_close(NULL);
    ck_assert_ptr_null(ki_team_open(SIZE_MAX));
    ck_assert_ptr_null(ki_team_open(SIZE_MAX / 8));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("part");
    TCase *tc = tcase_create("team");

    tcase_add_loop_test(tc, every_task_once, 1, THREADS + 1);
    tcase_add_loop_test(tc, stop_ends_early, 1, THREADS + 1);
    tcase_add_loop_test(tc, peak_is_the_greatest, 1, THREADS + 1);
    tcase_add_loop_test(tc, lock_excludes, 1, THREADS + 1);
    tcase_add_test(tc, numbers_of_threads);
    tcase_set_timeout(tc, 60);
    suite_add_tcase(suite, tc);
    return oracle_run(suite);
}
