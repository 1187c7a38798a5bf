#ifndef KOKSMA_TESTS_ALLOC_FIXTURE_H
#define KOKSMA_TESTS_ALLOC_FIXTURE_H

#include <check.h>
#include <errno.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points.h"

/* A system out of memory: the test is linked with --wrap for these functions, of
 * which the library calls no others that allocate. */

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
char *__real_strndup(const char *s, size_t n);
ssize_t __real_getline(char **line, size_t *room, FILE *in);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
char *__wrap_strndup(const char *s, size_t n);
ssize_t __wrap_getline(char **line, size_t *room, FILE *in);

static atomic_long granted = -1; /* allocations until one is refused; < 0: all */

static inline int refused(void)
{
    return atomic_load(&granted) >= 0 && atomic_fetch_sub(&granted, 1) == 0;
}

void *__wrap_malloc(size_t size) { return refused() ? NULL : __real_malloc(size); }

void *__wrap_calloc(size_t count, size_t size)
{
    return refused() ? NULL : __real_calloc(count, size);
}

void *__wrap_realloc(void *old, size_t size)
{
    return refused() ? NULL : __real_realloc(old, size);
}

char *__wrap_strndup(const char *s, size_t n)
{
    return refused() ? NULL : __real_strndup(s, n);
}

/* Some systems tell the stream too, which then looks like one that cannot be read;
 * that one may fail again. */
ssize_t __wrap_getline(char **line, size_t *room, FILE *in)
{
    if (!refused()) return __real_getline(line, room, in);
    errno = ENOMEM;
    return -1;
}

/* What a job does with memory granted, and then without. */
typedef koksma_status alloc_job(const void *what, koksma_error *err);

static bool changed; /* an output of a call that failed */

/* Whether a failed call left its output, of which `before` is a copy, alone.  One
 * that was stopped has an output. */
static inline koksma_status kept(koksma_status status, const void *out,
                                 const void *before, size_t size)
{
    if (status != KOKSMA_OK && status != KOKSMA_STOPPED &&
        memcmp(out, before, size) != 0)
        changed = true;
    return status;
}

/* Run job with ever more allocations granted until it returns `end`; returns how
 * many it took at last.  With threads that number varies from run to run, which
 * does no harm. */
static inline long exhaust_until(koksma_status end, alloc_job *job,
                                 const void *what, const char *name)
{
    for (long most = 0; most < 4000; most++) {
        koksma_error err = {0};
        koksma_status status;

        changed = false;
        atomic_store(&granted, most);
        status = job(what, &err);
        atomic_store(&granted, -1);
        ck_assert_msg(!changed, "%s: an output changed, %ld allocations granted",
                      name, most);
        if (status == end) return most;
        ck_assert_msg(status == KOKSMA_ENOMEM && err.status == KOKSMA_ENOMEM,
                      "%s: status %d, %d with %ld allocations granted: %s", name,
                      (int)status, (int)err.status, most, err.text);
        ck_assert_msg(strncmp(err.text, "not enough memory for ", 22) == 0,
                      "%s: %s", name, err.text);
    }
    ck_abort_msg("%s: 4000 allocations and no end", name);
    return 0;
}

static inline long exhaust(alloc_job *job, const void *what, const char *name)
{
    return exhaust_until(KOKSMA_OK, job, what, name);
}

#endif
