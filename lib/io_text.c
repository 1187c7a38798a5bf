#include <math.h>
#include <string.h>

#include "error.h"
#include "io_kernels.h"

/* Check one number of a row against what its column may hold. */
static koksma_status check(const koksma_reader *r, double v, size_t column,
                           bool last, const char *field, koksma_error *err)
{
    if (r->content == KOKSMA_VALUES && last) {
        if (isfinite(v)) return KOKSMA_OK;
        return ki_fail_field(err, KOKSMA_EDOMAIN, r->lines.number,
                             "the value in column", column, field,
                             "not a finite number");
    }
    if (v >= 0.0 && v <= 1.0) return KOKSMA_OK;
    return ki_fail_field(err, KOKSMA_EDOMAIN, r->lines.number, "coordinate", column,
                         field, "not in [0,1]");
}

/* Read the numbers of a line that is not blank.  With *count == 0 the line is
 * the first of its set: the row grows as need be and sets *count. */
static koksma_status parse(koksma_reader *r, double **row, size_t *count,
                           koksma_error *err)
{
    const char *s = ki_skip_blanks(r->lines.text);
    size_t expected = *count, have = 0;
    bool comma = false;

    for (; *s != '\0' || comma; have++) {
        double v = 0.0;
        const char *end = ki_number_read(s, &v);
        const char *next = ki_next_field(end, &comma);
        koksma_status status;

        if (end == s || ki_field_end(end) != end)
            return ki_fail_field(err, KOKSMA_EFORMAT, r->lines.number, "column",
                                 have + 1, s, "not a number");
        if (expected > 0 && have >= expected)
            return ki_fail(
                err, KOKSMA_EFORMAT, r->lines.number,
                "more than the %zu column%s of the first line of the set", expected,
                ki_plural(expected));
        status = check(
            r, v, have + 1,
            expected > 0 ? have + 1 == expected : *next == '\0' && !comma, s, err);
        if (status != KOKSMA_OK) return status;
        if (expected == 0 &&
            ki_grow((void **)row, &r->room_first, have + 1, sizeof **row) != 0)
            return ki_fail_memory(err, "a line");
        (*row)[have] = v;
        s = next;
    }
    if (have < expected)
        return ki_fail(err, KOKSMA_EFORMAT, r->lines.number,
                       "%zu column%s, but the first line of the set has %zu", have,
                       ki_plural(have), expected);
    *count = have;
    return KOKSMA_OK;
}

koksma_status ki_text_next(koksma_reader *r, koksma_error *err)
{
    koksma_status status;
    bool more;

    r->columns = 0;
    do {
        status = ki_lines_next(&r->lines, &more, err);
        if (status != KOKSMA_OK || !more) return status;
    } while (r->lines.text[0] == '#' || *ki_skip_blanks(r->lines.text) == '\0');

    status = parse(r, &r->first_row, &r->columns, err);
    if (status != KOKSMA_OK) return status;
    if (r->content == KOKSMA_VALUES && r->columns < 2)
        return ki_fail(err, KOKSMA_EFORMAT, r->lines.number,
                       "1 column, but a point and its value take at least 2");
    r->pending = true;
    return KOKSMA_OK;
}

koksma_status ki_text_rows(koksma_reader *r, double *rows, size_t room, size_t *got,
                           koksma_error *err)
{
    size_t have = 0;

    if (r->pending && room > 0) {
        memcpy(rows, r->first_row, r->columns * sizeof *rows);
        r->pending = false;
        have = 1;
    }
    while (have < room && r->columns > 0) {
        bool more;
        koksma_status status = ki_lines_next(&r->lines, &more, err);
        double *row = rows + have * r->columns;

        if (status != KOKSMA_OK) return status;
        if (more && r->lines.text[0] == '#') continue;
        if (!more || *ki_skip_blanks(r->lines.text) == '\0') {
            r->columns = 0;
            break;
        }
        status = parse(r, &row, &r->columns, err);
        if (status != KOKSMA_OK) return status;
        have++;
    }
    *got = have;
    return KOKSMA_OK;
}
