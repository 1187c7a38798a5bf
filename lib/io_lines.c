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
    size_t used = strlen(l->about), length;

    words = ki_skip_blanks(words);
    length = strlen(words);
    if (used + length + 2 >= sizeof l->about) return;
    l->about[used] = ' ';
    memcpy(l->about + used + 1, words, length + 1);
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
    if (!l->table) return KOKSMA_OK;
    if (ki_grow((void **)&l->names, &l->room_names, length + 1, 1) != 0)
        return ki_fail_memory(err, "a comment");
    memcpy(l->names, comment, length + 1);
    return KOKSMA_OK;
}

/* ---- Reads that a signal ends: the next one goes on -------------------------- */

static bool read_again(FILE *in)
{
    if (!ferror(in) || errno != EINTR) return false;
    clearerr(in);
    return true;
}

int ki_read_char(FILE *in)
{
    int c;

    do
        c = getc(in);
    while (c == EOF && read_again(in));
    return c;
}

size_t ki_read_bytes(void *out, size_t size, FILE *in)
{
    size_t have = 0;

    do
        have += fread((char *)out + have, 1, size - have, in);
    while (have < size && read_again(in));
    return have;
}

#ifdef __GLIBC__
enum {
    KEEPS_PART = true
}; /* getline returns what came before a read that failed */
#else
enum { KEEPS_PART = false }; /* or that may be lost */
#endif

/* getline, and through signals where that loses nothing. */
static ssize_t read_line(ki_lines *l)
{
    ssize_t length = getline(&l->text, &l->room, l->in);
    size_t have = length > 0 ? (size_t)length : 0;
    int c = 0;

    if (!KEEPS_PART || !read_again(l->in)) return length;
    while (c != '\n' && (c = ki_read_char(l->in)) != EOF) {
        if (ki_grow((void **)&l->text, &l->room, have + 2, 1) != 0) {
            errno = ENOMEM;
            return -1;
        }
        l->text[have++] = (char)c;
        l->text[have] = '\0';
    }
    return have > 0 ? (ssize_t)have : -1;
}

/* ---- Lines ---------------------------------------------------------------- */

koksma_status ki_lines_next(ki_lines *l, bool *more, koksma_error *err)
{
    ssize_t length;
    char *comment;

    errno = 0;
    length = read_line(l);
    *more = length >= 0;
    /* Some systems' getline tells the stream, too, that memory is out. */
    if (length < 0 && errno == ENOMEM) return ki_fail_memory(err, "a line");
    /* Also behind half a line: what came before the failure is no line. */
    if (ferror(l->in)) return ki_fail_read(err);
    if (length < 0) return feof(l->in) ? KOKSMA_OK : ki_fail_memory(err, "a line");
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

koksma_status ki_fail_read(koksma_error *err)
{
    return ki_fail(err, KOKSMA_EIO, 0, "cannot read: %s", strerror(errno));
}

void ki_show(char shown[KI_SHOWN], const char *text, size_t length)
{
    size_t i = 0;

    for (; i < length && i < KI_SHOWN - 4; i++)
        shown[i] = isprint((unsigned char)text[i]) ? text[i] : '?';
    memcpy(shown + i, i < length ? "..." : "", i < length ? 4 : 1);
}

koksma_status ki_fail_field(koksma_error *err, koksma_status status, size_t line,
                            const char *what, size_t number, const char *field,
                            const char *complaint)
{
    size_t length = (size_t)(ki_field_end(field) - field);
    char shown[KI_SHOWN];

    ki_show(shown, field, length);
    return ki_fail(err, status, line, "%s %zu is %s, %s", what, number,
                   length > 0 ? shown : "empty", complaint);
}
