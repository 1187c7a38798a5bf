#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "io_kernels.h"

/* Tables: two columns of numbers, picked by name or number, and the column
 * `set`, whose words are numbered in the order of their first appearance. */

typedef struct columns {
    size_t x, y, set; /* from 1; 0: not known, or for set: none */
} columns;

typedef struct labels {
    char **word;
    size_t room, count;
} labels;

/* The column called name in the comment that names them, or 0. */
static size_t column_named(const char *names, const char *name, size_t length)
{
    size_t column = 1;
    bool comma;

    for (const char *s = ki_skip_blanks(names); *s != '\0'; column++) {
        const char *end = ki_field_end(s);

        if ((size_t)(end - s) == length && strncmp(s, name, length) == 0)
            return column;
        s = ki_next_field(end, &comma);
    }
    return 0;
}

/* The same for the first of several names, apart by |, that there is. */
static size_t column_of_names(const char *names, const char *wanted)
{
    size_t column = 0;

    if (names == NULL) return 0;
    while (column == 0) {
        size_t length = strcspn(wanted, "|");

        column = column_named(names, wanted, length);
        if (wanted[length] == '\0') break;
        wanted += length + 1;
    }
    return column;
}

/* "N|n" as "N or n", and "a|b|c" as "a, b or c", as far as there is room. */
static void say_names(char *said, size_t room, const char *wanted)
{
    const char *last = strrchr(wanted, '|'), *end = said + room - sizeof " or ";

    for (const char *s = wanted; *s != '\0' && said < end; s++)
        if (*s != '|')
            *said++ = *s;
        else
            said = stpcpy(said, s == last ? " or " : ", ");
    *said = '\0';
}

static koksma_status fail_column(const char *names, const char *wanted,
                                 koksma_error *err)
{
    char said[80];

    if (strchr(wanted, '|') != NULL) {
        say_names(said, sizeof said, wanted);
        return ki_fail(err, KOKSMA_EINVAL, 0, "no column is called %s", said);
    }
    return ki_fail(
        err, KOKSMA_EINVAL, 0,
        names == NULL
            ? "no line names the columns: give a number from 1, not \"%.40s\""
            : "no column is called \"%.40s\"",
        wanted);
}

static koksma_status find_column(size_t *column, const char *names,
                                 const char *wanted, koksma_error *err)
{
    char *end;
    unsigned long number = strtoul(wanted, &end, 10);

    *column = *wanted >= '1' && *wanted <= '9' && *end == '\0'
                  ? number
                  : column_of_names(names, wanted);
    if (*column > 0) return KOKSMA_OK;
    return fail_column(names, wanted, err);
}

/* The number of a word among the labels, a new one if need be.  The rows of a
 * set mostly follow each other, so the search starts at the last. */
static koksma_status label_of(labels *l, const char *s, size_t *label,
                              koksma_error *err)
{
    size_t length = (size_t)(ki_field_end(s) - s);

    for (size_t i = l->count; i-- > 0;)
        if (strlen(l->word[i]) == length && strncmp(l->word[i], s, length) == 0) {
            *label = i;
            return KOKSMA_OK;
        }
    if (ki_grow((void **)&l->word, &l->room, l->count + 1, sizeof *l->word) != 0 ||
        (l->word[l->count] = strndup(s, length)) == NULL)
        return ki_fail_memory(err, "the names of the sets");
    *label = l->count++;
    return KOKSMA_OK;
}

static koksma_status read_number(const ki_lines *lines, const char *s,
                                 size_t column, double *v, koksma_error *err)
{
    const char *end = ki_number_read(s, v);

    if (end != s && ki_field_end(end) == end && isfinite(*v)) return KOKSMA_OK;
    return ki_fail_field(err, KOKSMA_EFORMAT, lines->number, "column", column, s,
                         "not a finite number");
}

static size_t last_of(columns at)
{
    size_t last = at.x > at.y ? at.x : at.y;

    return last > at.set ? last : at.set;
}

static koksma_status add_row(koksma_table *t, const ki_lines *lines, columns at,
                             labels *l, koksma_error *err)
{
    size_t need = t->rows + 1, column = 1, found = 0;
    koksma_status status = KOKSMA_OK;
    bool comma;

    if (ki_grow((void **)&t->x, &t->room_x, need, sizeof *t->x) != 0 ||
        ki_grow((void **)&t->y, &t->room_y, need, sizeof *t->y) != 0 ||
        ki_grow((void **)&t->set, &t->room_set, need, sizeof *t->set) != 0)
        return ki_fail_memory(err, "the table");
    t->set[t->rows] = 0;
    for (const char *s = ki_skip_blanks(lines->text);
         *s != '\0' && status == KOKSMA_OK; column++) {
        if (column == at.x)
            status = read_number(lines, s, column, &t->x[t->rows], err);
        if (column == at.y && status == KOKSMA_OK)
            status = read_number(lines, s, column, &t->y[t->rows], err);
        if (column == at.set && status == KOKSMA_OK)
            status = label_of(l, s, &t->set[t->rows], err);
        found += (size_t)(at.set > 0 && column == at.set);
        found += (size_t)(column == at.x) + (size_t)(column == at.y);
        s = ki_next_field(ki_field_end(s), &comma);
    }
    if (status == KOKSMA_OK && found < (at.set > 0 ? 3 : 2))
        status = ki_fail(err, KOKSMA_EFORMAT, lines->number,
                         "%zu column%s, but column %zu is wanted", column - 1,
                         ki_plural(column - 1), last_of(at));
    if (status == KOKSMA_OK) t->rows++;
    return status;
}

static koksma_status read_rows(koksma_table *t, ki_lines *lines, labels *l,
                               const char *x, const char *y, koksma_error *err)
{
    columns at = {0, 0, 0};
    bool more;

    for (;;) {
        koksma_status status = ki_lines_next(lines, &more, err);

        if (status != KOKSMA_OK || !more) return status;
        if (lines->text[0] == '#' || *ki_skip_blanks(lines->text) == '\0') continue;
        if (at.x == 0) {
            status = find_column(&at.x, lines->names, x, err);
            if (status == KOKSMA_OK)
                status = find_column(&at.y, lines->names, y, err);
            at.set = column_of_names(lines->names, "set");
        }
        if (status == KOKSMA_OK) status = add_row(t, lines, at, l, err);
        if (status != KOKSMA_OK) return status;
        t->labelled = at.set > 0;
    }
}

koksma_status koksma_table_read(koksma_table *table, FILE *in, const char *x,
                                const char *y, koksma_error *err)
{
    koksma_table t = {0};
    ki_lines lines = {.in = in, .table = true};
    labels l = {0};
    ki_c_locale locale = ki_c_locale_enter();
    koksma_status status = read_rows(&t, &lines, &l, x, y, err);

    ki_c_locale_leave(locale);
    memcpy(t.about, lines.about, sizeof t.about);
    t.sets = l.count > 0 ? l.count : t.rows > 0;
    for (size_t i = 0; i < l.count; i++)
        free(l.word[i]);
    free(l.word);
    ki_lines_free(&lines);
    if (status != KOKSMA_OK) {
        koksma_table_free(&t);
        return status;
    }
    koksma_table_free(table);
    *table = t;
    return KOKSMA_OK;
}

void koksma_table_free(koksma_table *table)
{
    free(table->x);
    free(table->y);
    free(table->set);
    *table = (koksma_table){0};
}
