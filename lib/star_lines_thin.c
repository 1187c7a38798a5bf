#include <string.h>

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
 * Rise: f_j - f_k <= (last y_j - c_j) - (last y_k - c_k) for k < j, so that line k
 * beats j everywhere if last y - c does not rise from k to j.  (In flow.c.)
 *
 * Fall: f_k - f_j >= (first y_k - c_k - p_k) - (first y_j - c_j - p_j) for k > j,
 * so that line k beats j if this does not fall from j to k.
 *
 * Hull: of i < j < k with p_i = p_j = p_k the three a are the same, and f_j less a
 * mean of f_i and f_k with the weights that make up y_j does not depend on the
 * column: one of them beats j if (y_j, c_j) is not below the segment between
 * theirs. Few lines go that way but where many heights are collinear, so that it is
 * tried only where the other two leave many lines a point.
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

#define INLINE KI_LINES_INLINE

/* All parts side by side, since a step of a filter waits for the one before: a part
 * whose lines are at their end goes idle. */

typedef int64_t marks __attribute__((vector_size(8 * KI_LINES_PARTS)));

typedef struct lines {
    ki_lanes y;
    ki_words tally;
} lines;

/* Where in memory they are, in bytes from the beginnings of the parts' lines. */
INLINE lines load(char *const *line, const marks *at)
{
    const ki_line *a = (const ki_line *)(const void *)(line[0] + (*at)[0]);
    const ki_line *b = (const ki_line *)(const void *)(line[1] + (*at)[1]);
    const ki_line *c = (const ki_line *)(const void *)(line[2] + (*at)[2]);
    const ki_line *d = (const ki_line *)(const void *)(line[3] + (*at)[3]);

    return (lines){{a->y, b->y, c->y, d->y},
                   {a->tally, b->tally, c->tally, d->tally}};
}

INLINE void move(char *const *line, const marks *to, const marks *from)
{
    memcpy(line[0] + (*to)[0], line[0] + (*from)[0], sizeof(ki_line));
    memcpy(line[1] + (*to)[1], line[1] + (*from)[1], sizeof(ki_line));
    memcpy(line[2] + (*to)[2], line[2] + (*from)[2], sizeof(ki_line));
    memcpy(line[3] + (*to)[3], line[3] + (*from)[3], sizeof(ki_line));
}

INLINE int64_t greatest(const marks *m)
{
    int64_t most = (*m)[0];

    for (int q = 1; q < KI_LINES_PARTS; q++)
        most = (*m)[q] > most ? (*m)[q] : most;
    return most;
}

/* Keep what falls: from the right, and to the right end.  first: of those kept. */
INLINE void keep_records_back(char *const *line, const marks *end,
                              const ki_lanes *slope, double margin, marks *first,
                              bool closed)
{
    const int64_t size = sizeof(ki_line);
    ki_lanes cut = (ki_lanes){0} - 2.0 * (double)UINT32_MAX;
    marks at = *end - size, before = *end - size;

    for (int64_t left = greatest(end); left > 0; left -= size, before -= size) {
        marks live = ~(before >> 63), from = before & live;
        lines l = load(line, &from);
        ki_words inside;
        ki_lanes u;

        inside = closed ? l.tally : l.tally + (l.tally >> 32);
        ki_lines_count(&u, &inside);
        u = closed ? u - *slope * l.y : *slope * l.y - u;
        move(line, &at, &from);
        at -= live & (u > cut) & size;
        u -= margin;
        ki_lines_raise(&cut, &u);
    }
    *first = at + size;
}

INLINE double inside_of(ki_line l) { return (double)(int32_t)(uint32_t)l.tally; }

/* How far b is above the segment from a to c, times its length. */
INLINE double above(ki_line a, ki_line b, ki_line c, bool closed)
{
    double ab = inside_of(b) - inside_of(a), ac = inside_of(c) - inside_of(a);
    double d = ac * (b.y - a.y) - ab * (c.y - a.y);

    return closed ? -d : d;
}

/* From the right, and to the right end: b waits for its left neighbour a.  Returns
 * how many are kept. */
INLINE size_t keep_hull(ki_line *line, size_t m, double margin, size_t *longest,
                        bool closed)
{
    ki_line b = line[m - 1], c = b;
    size_t at = m, run = 0;

    for (size_t j = m - 1; j-- > 0;) {
        ki_line a = line[j];
        bool same = ((a.tally ^ b.tally) | (b.tally ^ c.tally)) >> 32 == 0;
        bool below = above(a, b, c, closed) < -margin * (c.y - a.y);
        bool drop = (at < m) & same & below;

        line[at - 1] = b;
        at -= !drop;
        run = drop ? run + 1 : 0;
        *longest = run > *longest ? run : *longest;
        c = drop ? c : b;
        b = a;
    }
    line[--at] = b;
    return m - at;
}

INLINE void thin_kind(ki_lines_flow *f, const ki_lines_range *r, size_t *longest,
                      bool closed)
{
    char *line[KI_LINES_PARTS];
    marks end = (marks)(f->lines_kept * sizeof(ki_line)), first;

    for (int q = 0; q < KI_LINES_PARTS; q++)
        line[q] = (char *)f->to_line[q];
    keep_records_back(line, &end, closed ? &r->last : &r->first, r->margin, &first,
                      closed);
    for (int q = 0; q < KI_LINES_PARTS; q++) {
        size_t before = f->lines_kept[q], kept = (size_t)(end[q] - first[q]);

        kept /= sizeof(ki_line);
        longest[q] = 0;
        if (kept > r->dense * f->points_kept[q] && kept > 2)
            kept = keep_hull(f->to_line[q] + (before - kept), kept, r->hull_margin,
                             &longest[q], closed);
        f->to_line[q] += before - kept;
        f->lines_kept[q] = kept;
    }
}

KI_LINES_CLONES
static void thin(ki_lines_flow *f, const ki_lines_range *r, size_t *longest)
{
    if (f->closed)
        thin_kind(f, r, longest, true);
    else
        thin_kind(f, r, longest, false);
}

void ki_lines_thin(ki_lines_flow *f, const ki_lines_range *r, size_t *longest)
{
    thin(f, r, longest);
}
