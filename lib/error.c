#define _DEFAULT_SOURCE /* madvise */
#include "error.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>

koksma_status ki_fail(koksma_error *err, koksma_status status, size_t line,
                      const char *format, ...)
{
    if (err != NULL) {
        va_list args;
        ki_c_locale l = ki_c_locale_enter();

        err->status = status;
        err->line = line;
        va_start(args, format);
        vsnprintf(err->text, sizeof err->text, format, args);
        va_end(args);
        ki_c_locale_leave(l);
    }
    return status;
}

koksma_status ki_fail_memory(koksma_error *err, const char *what)
{
    return ki_fail(err, KOKSMA_ENOMEM, 0, "not enough memory for %s", what);
}

/* Large arrays are written and read in no order: pages of 2 MB, where the system
 * has them for those who ask, spare a tenth of the time. */
static void *on_large_pages(void *p, size_t bytes)
{
#ifdef MADV_HUGEPAGE
    const uintptr_t page = (uintptr_t)1 << 21;
    uintptr_t from = ((uintptr_t)p + page - 1) & ~(page - 1);
    uintptr_t to = ((uintptr_t)p + bytes) & ~(page - 1);

    /* It is advice: whether it is taken makes no difference to what follows. */
    if (p != NULL && from < to)
        (void)madvise((void *)from, to - from, MADV_HUGEPAGE);
#else
    (void)bytes;
#endif
    return p;
}

void *ki_alloc(size_t count, size_t size)
{
    size_t bytes;

    if (__builtin_mul_overflow(count, size, &bytes) || bytes > PTRDIFF_MAX)
        return NULL;
    return on_large_pages(malloc(bytes > 0 ? bytes : 1), bytes);
}

int ki_grow(void **array, size_t *room, size_t need, size_t size)
{
    size_t wanted = *room + *room / 2, bytes;
    void *grown;

    if (need <= *room) return 0;
    if (wanted < need) wanted = need;
    if (wanted < 64) wanted = 64;
    if (__builtin_mul_overflow(wanted, size, &bytes) || bytes > PTRDIFF_MAX)
        return -1;
    grown = realloc(*array, bytes);
    if (grown == NULL) return -1;
    *array = on_large_pages(grown, bytes);
    *room = wanted;
    return 0;
}

ki_c_locale ki_c_locale_enter(void)
{
    ki_c_locale l = {newlocale(LC_ALL_MASK, "C", (locale_t)0), (locale_t)0};

    /* newlocale of "C" fails only without memory; the host's locale then stays. */
    if (l.c != (locale_t)0) l.before = uselocale(l.c);
    return l;
}

void ki_c_locale_leave(ki_c_locale l)
{
    if (l.c == (locale_t)0) return;
    uselocale(l.before);
    freelocale(l.c);
}
