#include "star_lines_kernels.h"

static inline __attribute__((always_inline)) double inside_of(uint64_t tally)
{
    return (double)(int32_t)(uint32_t)tally;
}

/* At most, whatever the column: an open box of the last one with the points that
 * are surely inside, a closed one of the first with all that may be. */
static inline __attribute__((always_inline)) double most(double y, uint64_t tally, const ki_lines_range *r,
                          bool closed)
{
    return closed ? inside_of(tally + (tally >> 32)) - r->first * y
                  : r->last * y - inside_of(tally);
}

static inline __attribute__((always_inline)) double least(double y, uint64_t tally, const ki_lines_range *r,
                           bool closed)
{
    return closed ? inside_of(tally) - r->last * y
                  : r->first * y - inside_of(tally + (tally >> 32));
}

static inline __attribute__((always_inline)) size_t keep_records(ki_line *restrict out, const ki_line *restrict in,
                                  size_t m, const uint64_t *restrict map,
                                  const ki_lines_range *r, bool closed)
{
    double cut = r->cut;
    size_t kept = 0;

    for (size_t j = 0; j < m; j++) {
        uint64_t tally = (uint32_t)in[j].tally + map[in[j].tally >> 32];
        double u = most(in[j].y, tally, r, closed), next = u - r->margin;

        out[kept] = (ki_line){in[j].y, tally};
        kept += u > cut;
        cut = next > cut ? next : cut;
    }
    return kept;
}

/* From the right, and to the right end; returns how many. */
static inline __attribute__((always_inline)) size_t keep_records_back(ki_line *line, size_t m,
                                       const ki_lines_range *r, bool closed)
{
    double cut = -2.0 * (double)UINT32_MAX;
    size_t at = m;

    for (size_t j = m; j-- > 0;) {
        ki_line l = line[j];
        double u = least(l.y, l.tally, r, closed), next = u - r->margin;

        line[at - 1] = l;
        at -= u > cut;
        cut = next > cut ? next : cut;
    }
    return m - at;
}

/* How far b is above the segment from a to c, times its length. */
static inline __attribute__((always_inline)) double above(ki_line a, ki_line b, ki_line c, bool closed)
{
    double ab = inside_of(b.tally) - inside_of(a.tally);
    double ac = inside_of(c.tally) - inside_of(a.tally);
    double d = ac * (b.y - a.y) - ab * (c.y - a.y);

    return closed ? -d : d;
}

static inline __attribute__((always_inline)) size_t keep_hull(ki_line *line, size_t from, size_t m,
                               const ki_lines_range *r, bool closed)
{
    ki_line a, b;
    size_t kept = 0;

    if (m == 0) return 0;
    a = line[from];
    line[kept++] = a;
    if (m == 1) return kept;
    b = line[from + 1];
    for (size_t j = 2; j < m; j++) {
        ki_line c = line[from + j];
        bool same = (a.tally >> 32) == (b.tally >> 32) &&
                    (b.tally >> 32) == (c.tally >> 32);
        bool drop = same & (above(a, b, c, closed) < -r->margin * (c.y - a.y));

        line[kept] = b;
        kept += !drop;
        a = drop ? a : b;
        b = c;
    }
    line[kept++] = b;
    return kept;
}

static inline __attribute__((always_inline)) size_t filter(ki_line *out, const ki_line *in, size_t m,
                            const uint64_t *map, const ki_lines_range *r,
                            bool closed)
{
    size_t kept = keep_records(out, in, m, map, r, closed);
    size_t back = keep_records_back(out, kept, r, closed);

    return keep_hull(out, kept - back, back, r, closed);
}

size_t ki_lines_filter(ki_line *out, const ki_line *in, size_t m,
                       const uint64_t *map, const ki_lines_range *r, bool closed)
{
    return closed ? filter(out, in, m, map, r, true)
                  : filter(out, in, m, map, r, false);
}
