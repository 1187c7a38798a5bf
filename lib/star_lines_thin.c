#include "star_lines_kernels.h"

/* Which lines matter, and why.
 *
 * In a cell, line j of open boxes has the excess
 *
 *     f_j(column) = t y_j - c_j - a_j,    0 <= a_j <= p_j,    first <= t <= last
 *
 * where c_j counts the points below it that are surely inside, p_j those that may
 * be, and a_j those of them that are.  Lines are in the order of their heights, so
 * of k < j the points below k are below j too: 0 <= a_j - a_k <= p_j - p_k.
 *
 *   rise  f_j - f_k <= (last y_j - c_j) - (last y_k - c_k) for k < j: line k beats
 * j everywhere if last y - c does not rise from k to j.  (flow.c) fall  f_k - f_j
 * >= (first y_k - c_k - p_k) - (first y_j - c_j - p_j) for k > j: line k beats j if
 * this does not fall from j to k. hull  of i < j < k with p_i = p_j = p_k the three
 * a are the same, and f_j less a mean of f_i and f_k with the weights that make up
 * y_j does not depend on the column: one of them beats j if (y_j, c_j) is not below
 * the segment between theirs.
 *
 * Closed boxes have f_j = c_j + a_j - t y_j instead; then c + p - first y is to
 * rise, and c - last y to fall.  The filters run one after the other, so that a
 * line which beats another is still there, or a line that beats it in turn.
 *
 * Rounding.  With u = 2^-53, a slope is off by dim-1 roundings, each of at most n
 * u; its product with y and the difference from a count round by n u more each:
 * what the filters compare is off by (dim+1) n u, and a comparison by 2(dim+1) n u.
 * In the hull the differences of heights, the products and their difference each
 * round, relatively, by u: together by less than 6 n u times the length.  The
 * margin is n slack = 4(dim+2) n u.  So a line that is dropped by more than the
 * margin is worse than another, in every column, by something, and no box on it can
 * be the witness: ties are kept.  A line below the cut is worse than the best box
 * by the margin less (dim+2) n u.
 *
 * A scout has a negative margin, and drops lines that are better by up to that: by
 * less than two margins with the rounding.  Lines that the first two filters go by
 * are kept themselves, the cut rises at a line that is kept alone; the hull may
 * drop neighbours one after the other, each for a next one.  So a cell's loss grows
 * by two margins for either filter and for each of the longest run of neighbours.
 * What is above the cut less the loss is noted; so no box that may be the witness
 * is in a leaf that a scout does not note, or whose cell it has dropped. */

#define INLINE static inline __attribute__((always_inline))

INLINE double inside_of(uint64_t tally) { return (double)(int32_t)(uint32_t)tally; }

/* What a column and a line have at least. */
INLINE double least(ki_line l, double slope, bool closed)
{
    return closed ? inside_of(l.tally) - slope * l.y
                  : slope * l.y - inside_of(l.tally + (l.tally >> 32));
}

/* Keep what falls: from the right, and to the right end; returns how many. */
INLINE size_t keep_records_back(ki_line *line, size_t m, double slope,
                                double margin, bool closed)
{
    double cut = -2.0 * (double)UINT32_MAX;
    size_t at = m;

    for (size_t j = m; j-- > 0;) {
        ki_line l = line[j];
        double u = least(l, slope, closed), next = u - margin;

        line[at - 1] = l;
        at -= u > cut;
        cut = next > cut ? next : cut;
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
                   const ki_lines_range *r, size_t *longest, bool closed)
{
    size_t kept = keep_records_back(line, m, slope, r->margin, closed);

    return keep_hull(out, line + (m - kept), kept, r->hull_margin, longest, closed);
}

size_t ki_lines_thin(ki_line *out, ki_line *line, size_t m, const ki_lines_range *r,
                     size_t part, size_t *longest, bool closed)
{
    return closed ? thin(out, line, m, r->last[part], r, longest, true)
                  : thin(out, line, m, r->first[part], r, longest, false);
}
