#ifndef KI_ERROR_H
#define KI_ERROR_H

#include <locale.h>

#include "points.h"

/* Private: how the library reports failures, asks for memory, and keeps the
 * host program's locale out of its numbers. */

/* Fill err, if it is wanted, with a sentence; returns status. */
koksma_status ki_fail(koksma_error *err, koksma_status status, size_t line,
                      const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* "not enough memory for WHAT" */
koksma_status ki_fail_memory(koksma_error *err, const char *what);

/* What a noun ends in behind that number. */
static inline const char *ki_plural(size_t n) { return n == 1 ? "" : "s"; }

/* Room for count*size bytes, or NULL: also when the product overflows. */
void *ki_alloc(size_t count, size_t size);

/* Make room for `need` items of `size` bytes in *array, which has room for
 * *room; grows by at least half so that appending costs a constant each.
 * Returns 0, or -1 with everything as it was.  *array may start as NULL. */
int ki_grow(void **array, size_t *room, size_t need, size_t size);

/* Numbers are read and written under the C locale whatever the host program
 * did.  ki_c_locale_leave undoes ki_c_locale_enter. */
typedef struct ki_c_locale {
    locale_t c, before;
} ki_c_locale;
ki_c_locale ki_c_locale_enter(void);
void ki_c_locale_leave(ki_c_locale l);

#endif
