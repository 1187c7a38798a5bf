#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "io_kernels.h"

/* Where the last value of key starts in "key=value key=value", or NULL. */
static const char *find(const char *about, const char *key)
{
    size_t length = strlen(key);
    const char *found = NULL;

    for (const char *s = ki_skip_blanks(about); *s != '\0';
         s = ki_skip_blanks(ki_field_end(s)), s += *s == ',')
        if (strncmp(s, key, length) == 0 && s[length] == '=')
            found = s + length + 1;
    return found;
}

bool koksma_about_word(const char *about, const char *key, char *word, size_t size)
{
    const char *s = find(about, key);
    size_t length;

    if (s == NULL || size == 0) return false;
    length = (size_t)(ki_field_end(s) - s);
    if (length >= size) length = size - 1;
    memcpy(word, s, length);
    word[length] = '\0';
    return true;
}

bool koksma_about_number(const char *about, const char *key, double *value)
{
    const char *s = find(about, key), *end;
    ki_c_locale l;
    double v = 0.0;

    if (s == NULL || ki_field_end(s) == s) return false;
    l = ki_c_locale_enter();
    end = ki_number_read(s, &v);
    ki_c_locale_leave(l);
    if (ki_field_end(s) != end) return false;
    *value = v;
    return true;
}
