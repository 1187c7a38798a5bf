#include <string.h>

#include "star_lines_kernels.h"

/* All parts of a cell at once, a lane each: a point costs a few subtractions, a
 * line a few more, and what is kept is written without a branch: it is written
 * anyway, and then written over or not. */

enum { BLOCK = 256 };

typedef int64_t marks __attribute__((vector_size(8 * KI_LINES_PARTS)));

/* What the points below add to a line's tally, for one block of points. */
typedef struct map {
    ki_words sum[BLOCK + 1];
} map;

#define INLINE static inline __attribute__((always_inline))

/* 1 where the ranks of a point are below the limits. */
INLINE void mark_below(ki_words *out, const uint32_t *point, size_t axes,
                       const ki_words *limit)
{
    ki_words below = point[0] - limit[0];

    if (axes == 2) below &= point[1] - limit[1];
    *out = below >> 63;
}

INLINE void put_point(uint32_t *to, const uint32_t *point, size_t axes)
{
    to[0] = point[0];
    if (axes == 2) to[1] = point[1];
}

/* Those that are surely inside, and those that may be, which go down. */
INLINE void flow_points(const ki_lines_flow *f, ki_words *kept, map *m, size_t from,
                        size_t to, const ki_lines_range *r, size_t axes)
{
    ki_words sum = m->sum[0], used = *kept;

    for (size_t i = from; i < to; i++) {
        const uint32_t *point = f->point + i * axes;
        ki_words in, unsure;

        mark_below(&in, point, axes, r->low);
        mark_below(&unsure, point, axes, r->high);
        unsure -= in;
        sum += in + (unsure << 32);
        m->sum[i - from + 1] = sum;
        put_point(f->to_point[0] + used[0] * axes, point, axes);
        put_point(f->to_point[1] + used[1] * axes, point, axes);
        put_point(f->to_point[2] + used[2] * axes, point, axes);
        put_point(f->to_point[3] + used[3] * axes, point, axes);
        used += unsure;
    }
    *kept = used;
}

/* Counts, below 2^32, as the lower half of a double's bits with 2^52 above. */
INLINE void count(ki_lanes *out, const ki_words *tally)
{
    ki_words bits = (*tally & 0xffffffff) | 0x4330000000000000;

    *out = (ki_lanes)bits - 0x1p52;
}

INLINE void raise(ki_lanes *a, const ki_lanes *b)
{
    marks which = *b > *a;

    *a = (ki_lanes)(((marks)*b & which) | ((marks)*a & ~which));
}

/* One kind of line on its way. */
typedef struct stream {
    const ki_line *line;
    size_t at, lines;
    char *to[KI_LINES_PARTS];
    ki_words used; /* bytes */
    ki_lanes cut;
} stream;

INLINE void put_line(char *to, double y, uint64_t tally)
{
    ki_line l = {y, tally};

    memcpy(to, &l, sizeof l);
}

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

        count(&most, &inside);
        most = closed ? most - first * l.y : last * l.y - most;
        keep = (ki_words)(most > cut);

        put_line(s->to[0] + used[0], l.y, tally[0]);
        put_line(s->to[1] + used[1], l.y, tally[1]);
        put_line(s->to[2] + used[2], l.y, tally[2]);
        put_line(s->to[3] + used[3], l.y, tally[3]);
        used += keep & sizeof(ki_line);
        most -= margin;
        raise(&cut, &most);
    }
    s->cut = cut;
    s->used = used;
    s->at = at;
}

static stream stream_of(const ki_lines_flow *f, const ki_lines_range *r,
                        bool closed)
{
    stream s = {.line = f->line[closed], .lines = f->lines[closed], .cut = r->cut};

    for (size_t q = 0; q < KI_LINES_PARTS; q++)
        s.to[q] = (char *)f->to_line[closed][q];
    return s;
}

KI_LINES_CLONES
static void flow_down(ki_lines_flow *f, const ki_lines_range *r)
{
    stream open = stream_of(f, r, false), closed = stream_of(f, r, true);
    ki_words kept = {0};
    map m;

    m.sum[0] = kept;
    for (size_t from = 0;;) {
        size_t to = f->points - from < BLOCK ? f->points : from + BLOCK;

        if (f->axes == 1)
            flow_points(f, &kept, &m, from, to, r, 1);
        else
            flow_points(f, &kept, &m, from, to, r, 2);
        flow_lines(&open, &m, from, to, r, false);
        flow_lines(&closed, &m, from, to, r, true);
        if (to == f->points) break;
        m.sum[0] = m.sum[BLOCK];
        from = to;
    }
    for (size_t q = 0; q < KI_LINES_PARTS; q++) {
        f->points_kept[q] = kept[q];
        f->lines_kept[0][q] = open.used[q] / sizeof(ki_line);
        f->lines_kept[1][q] = closed.used[q] / sizeof(ki_line);
    }
}

void ki_lines_flow_down(ki_lines_flow *f, const ki_lines_range *r)
{
    flow_down(f, r);
}
