#include "star_lines_kernels.h"

#define INLINE static inline __attribute__((always_inline))

INLINE double inside_of(uint64_t tally)
{
    return (double)(int32_t)(uint32_t)tally;
}

/* What a column and a line have at least. */
INLINE double least(ki_line l, double slope, bool closed)
{
    return closed ? inside_of(l.tally) - slope * l.y
                  : slope * l.y - inside_of(l.tally + (l.tally >> 32));
}

/* From the right, and to the right end; returns how many. */
INLINE size_t keep_records_back(ki_line *line, size_t m, double slope,
                                double margin, bool closed)
{
    double cut = -2.0 * (double)UINT32_MAX;
    size_t at = m;

    for (size_t j = m; j-- > 0;) {
        ki_line l = line[j];
        double u = least(l, slope, closed), next = u - margin;
        bool keep = u > cut;

        line[at - 1] = l;
        at -= keep;
        cut = keep & (next > cut) ? next : cut;
    }
    return m - at;
}

/* How far b is above the segment from a to c, times its length. */
INLINE double above(ki_line a, ki_line b, ki_line c, bool closed)
{
    double ab = inside_of(b.tally) - inside_of(a.tally);
    double ac = inside_of(c.tally) - inside_of(a.tally);
    double d = ac * (b.y - a.y) - ab * (c.y - a.y);

    return closed ? -d : d;
}

INLINE size_t keep_hull(ki_line *out, const ki_line *line, size_t m, double margin,
                        size_t *longest, bool closed)
{
    ki_line a, b;
    size_t kept = 0, run = 0;

    if (m == 0) return 0;
    a = line[0];
    out[kept++] = a;
    if (m == 1) return kept;
    b = line[1];
    for (size_t j = 2; j < m; j++) {
        ki_line c = line[j];
        bool same = (a.tally >> 32) == (b.tally >> 32) &&
                    (b.tally >> 32) == (c.tally >> 32);
        bool drop = same & (above(a, b, c, closed) < -margin * (c.y - a.y));

        out[kept] = b;
        kept += !drop;
        run = drop ? run + 1 : 0;
        *longest = run > *longest ? run : *longest;
        a = drop ? a : b;
        b = c;
    }
    out[kept++] = b;
    return kept;
}

INLINE size_t thin(ki_line *out, ki_line *line, size_t m, double slope,
                   double margin, size_t *longest, bool closed)
{
    size_t kept = keep_records_back(line, m, slope, margin, closed);

    return keep_hull(out, line + (m - kept), kept, margin, longest, closed);
}

size_t ki_lines_thin(ki_line *out, ki_line *line, size_t m, const ki_lines_range *r,
                     size_t part, size_t *longest, bool closed)
{
    return closed ? thin(out, line, m, r->last[part], r->margin, longest, true)
                  : thin(out, line, m, r->first[part], r->margin, longest, false);
}
