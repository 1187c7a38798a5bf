#include <string.h>

#include "star_lines_kernels.h"

/* All parts of a cell at once, a lane each: a point costs a few subtractions, a
 * line a few more, and what is kept is written without a branch: it is written
 * anyway, and then written over or not. */

enum { BLOCK = 256 };

/* What the points below add to a line's tally, for one block of points. */
typedef struct map {
    ki_words sum[BLOCK + 1];
} map;

#define INLINE KI_LINES_INLINE

/* 1 where the ranks of a point are below the limits. */
INLINE void mark_below(ki_words *out, const uint32_t *point, size_t axes,
                       const ki_words *limit)
{
    ki_words below = point[0] - limit[0];

    if (axes == 2) below &= point[1] - limit[1];
    *out = below >> 63;
}

/* Those that are surely inside, and those that may be, which go down. */
INLINE void flow_points(const ki_lines_flow *f, ki_words *kept, map *m, size_t from,
                        size_t to, const ki_lines_range *r, size_t axes)
{
    ki_words sum = m->sum[0], used = *kept;

    for (size_t i = from; i < to; i++) {
        uint32_t point[2] = {0, 0};
        ki_words in, unsure;

        memcpy(point, f->point + i * axes, axes * sizeof *point);
        mark_below(&in, point, axes, r->low);
        mark_below(&unsure, point, axes, r->high);
        unsure -= in;
        sum += in + (unsure << 32);
        m->sum[i - from + 1] = sum;
        memcpy(f->to_point[0] + used[0] * axes, point, axes * sizeof *point);
        memcpy(f->to_point[1] + used[1] * axes, point, axes * sizeof *point);
        memcpy(f->to_point[2] + used[2] * axes, point, axes * sizeof *point);
        memcpy(f->to_point[3] + used[3] * axes, point, axes * sizeof *point);
        used += unsure;
    }
    *kept = used;
}

INLINE void put_line(char *to, double y, uint64_t tally)
{
    ki_line l = {y, tally};

    memcpy(to, &l, sizeof l);
}

/* The lines on their way. */
typedef struct stream {
    const ki_line *line;
    size_t at, lines;
    char *to[KI_LINES_PARTS];
    ki_words used; /* bytes */
    ki_lanes cut;
} stream;

/* The lines with up to `to` points below them. */
INLINE void flow_lines(stream *s, const map *m, size_t from, size_t to,
                       const ki_lines_range *r, bool closed)
{
    ki_lanes cut = s->cut, first = r->first, last = r->last;
    ki_words used = s->used;
    double margin = r->margin;
    size_t at = s->at;

    for (; at < s->lines && s->line[at].tally >> 32 <= to; at++) {
        ki_line l = s->line[at];
        ki_words tally = m->sum[(l.tally >> 32) - from] + (l.tally & 0xffffffff);
        ki_words inside = closed ? tally + (tally >> 32) : tally, keep;
        ki_lanes most;

        ki_lines_count(&most, &inside);
        most = closed ? most - first * l.y : last * l.y - most;
        keep = (ki_words)(most > cut);

        put_line(s->to[0] + used[0], l.y, tally[0]);
        put_line(s->to[1] + used[1], l.y, tally[1]);
        put_line(s->to[2] + used[2], l.y, tally[2]);
        put_line(s->to[3] + used[3], l.y, tally[3]);
        used += keep & sizeof(ki_line);
        most -= margin;
        ki_lines_raise(&cut, &most);
    }
    s->cut = cut;
    s->used = used;
    s->at = at;
}

/* The grid's lines at the heights of points from <= j < to.  Of tied heights open
 * boxes need the first rank only and closed ones the last, where the counts are
 * right.  Open boxes may reach to 1. */
static size_t make_lines(ki_line *out, const ki_lines_flow *f, size_t from,
                         size_t to)
{
    const double *y = f->height;
    size_t n = f->points, made = 0;

    for (size_t j = from; j < to; j++)
        if (f->closed) {
            if (j + 1 == n || y[j] != y[j + 1])
                out[made++] = (ki_line){y[j], (uint64_t)(j + 1) << 32};
        } else {
            if (j == 0 || y[j] != y[j - 1])
                out[made++] = (ki_line){y[j], (uint64_t)j << 32};
        }
    if (!f->closed && to == n && y[n - 1] < 1.0)
        out[made++] = (ki_line){1.0, (uint64_t)n << 32};
    return made;
}

static stream stream_of(const ki_lines_flow *f, const ki_lines_range *r)
{
    stream s = {.line = f->line, .lines = f->lines, .cut = r->cut};

    for (size_t q = 0; q < KI_LINES_PARTS; q++)
        s.to[q] = (char *)f->to_line[q];
    return s;
}

INLINE void flow(ki_lines_flow *f, const ki_lines_range *r, size_t axes,
                 bool closed)
{
    stream s = stream_of(f, r);
    ki_words kept = {0};
    ki_line made[BLOCK + 1];
    map m;

    m.sum[0] = kept;
    for (size_t from = 0;;) {
        size_t to = f->points - from < BLOCK ? f->points : from + BLOCK;

        flow_points(f, &kept, &m, from, to, r, axes);
        if (f->line == NULL) {
            s.line = made;
            s.at = 0;
            s.lines = make_lines(made, f, from, to);
        }
        flow_lines(&s, &m, from, to, r, closed);
        if (to == f->points) break;
        m.sum[0] = m.sum[BLOCK];
        from = to;
    }
    f->points_kept = kept;
    f->lines_kept = s.used / sizeof(ki_line);
}

KI_LINES_CLONES
static void flow_down(ki_lines_flow *f, const ki_lines_range *r)
{
    if (f->axes == 1)
        f->closed ? flow(f, r, 1, true) : flow(f, r, 1, false);
    else
        f->closed ? flow(f, r, 2, true) : flow(f, r, 2, false);
}

void ki_lines_flow_down(ki_lines_flow *f, const ki_lines_range *r)
{
    flow_down(f, r);
}
