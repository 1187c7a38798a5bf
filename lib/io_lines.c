#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "io_kernels.h"

/* Lines of text for the readers of sets and of tables, and how they complain. */

static const char MARK[] = " koksma:";

/* Keep what a `# koksma:` comment says.  What does not fit is left out, whole. */
static void remember(ki_lines *l, const char *words)
{
    size_t used = strlen(l->about), length = strlen(words);

    if (used + length + 1 >= sizeof l->about) return;
    memcpy(l->about + used, words, length + 1);
}

/* A comment is about the data, or it may name the columns of a table. */
static koksma_status keep_comment(ki_lines *l, const char *comment,
                                  koksma_error *err)
{
    size_t length = strlen(comment);

    if (strncmp(comment, MARK, sizeof MARK - 1) == 0) {
        remember(l, comment + sizeof MARK - 1);
        return KOKSMA_OK;
    }
    if (ki_grow((void **)&l->names, &l->room_names, length + 1, 1) != 0)
        return ki_fail_memory(err, "a comment");
    memcpy(l->names, comment, length + 1);
    return KOKSMA_OK;
}

koksma_status ki_lines_next(ki_lines *l, bool *more, koksma_error *err)
{
    ssize_t length;
    char *comment;

    errno = 0;
    length = getline(&l->text, &l->room, l->in);
    *more = length >= 0;
    if (length < 0) {
        if (ferror(l->in))
            return ki_fail(err, KOKSMA_EIO, 0, "cannot read: %s", strerror(errno));
        if (!feof(l->in)) return ki_fail_memory(err, "a line");
        return KOKSMA_OK;
    }
    l->number++;
    if (strlen(l->text) != (size_t)length)
        return ki_fail(err, KOKSMA_EFORMAT, l->number,
                       "a NUL byte: this is not text");
    if (length > 0 && l->text[length - 1] == '\n') l->text[--length] = '\0';
    if (length > 0 && l->text[length - 1] == '\r') l->text[--length] = '\0';
    comment = strchr(l->text, '#');
    if (comment == NULL) return KOKSMA_OK;
    *comment = '\0';
    if (*ki_skip_blanks(l->text) != '\0') return KOKSMA_OK;
    /* A line that is all comment leaves "#", so that it is not taken for blank. */
    koksma_status status = keep_comment(l, comment + 1, err);
    l->text[0] = '#';
    l->text[1] = '\0';
    return status;
}

void ki_lines_free(ki_lines *l)
{
    free(l->text);
    free(l->names);
}

const char *ki_next_field(const char *end, bool *comma)
{
    end = ki_skip_blanks(end);
    *comma = *end == ',';
    return *comma ? ki_skip_blanks(end + 1) : end;
}

koksma_status ki_fail_field(koksma_error *err, koksma_status status, size_t line,
                            const char *what, size_t number, const char *field,
                            const char *complaint)
{
    int length = (int)(ki_field_end(field) - field);
    char shown[44];
    int i = 0;

    /* Enough of the field to find it by, and nothing that a terminal would obey. */
    for (; i < length && i < 40; i++)
        shown[i] = isprint((unsigned char)field[i]) ? field[i] : '?';
    memcpy(shown + i, i < length ? "..." : "", i < length ? 4 : 1);
    return ki_fail(err, status, line, "%s %zu is %s, %s", what, number,
                   length > 0 ? shown : "empty", complaint);
}
