#include "exact_oracle.h"

#include <stdio.h>
#include <stdlib.h>

void exact_check(koksma_points p)
{
    if (p.n <= EXACT_POINTS && p.dim <= EXACT_DIM) return;
    fprintf(stderr, "exact: %zu points in dim %zu are too many\n", p.n, p.dim);
    abort();
}

/* Coordinates as multiples of 2^-bits. */
typedef struct scaled_set {
    koksma_points p;
    unsigned bits;
    exact_int x[EXACT_NUMBERS];
} scaled_set;

static void scale(scaled_set *s, koksma_points p, unsigned bits)
{
    exact_check(p);
    s->p = p;
    s->bits = exact_bits(p.x, p.n * p.dim, bits);
    for (size_t i = 0; i < p.n * p.dim; i++)
        s->x[i] = exact_scaled(p.x[i], s->bits);
}

/* ---- Boxes ----------------------------------------------------------------- */

/* A side of boxes along one axis: its length, and as bits the points strictly
 * between its ends and those between or on them. */
typedef struct side {
    exact_int length;
    uint32_t open, closed;
} side;

enum { SIDES_MOST = (EXACT_POINTS + 2) * (EXACT_POINTS + 3) / 2 };

/* [0,b) and [0,b], where lower is NULL; or (a,b) and [a,b]. */
static side side_of(const scaled_set *s, size_t k, const double *lower, double b)
{
    side r = {exact_scaled(b, s->bits), 0, 0};

    if (lower != NULL)
        r.length = exact_minus(r.length, exact_scaled(*lower, s->bits));
    for (size_t i = 0; i < s->p.n; i++) {
        double x = s->p.x[i * s->p.dim + k];
        uint32_t bit = (uint32_t)1 << i;

        if (x < b && (lower == NULL || x > *lower)) r.open |= bit;
        if (x <= b && (lower == NULL || x >= *lower)) r.closed |= bit;
    }
    return r;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;

    return (x > y) - (x < y);
}

/* All sides along axis k with ends among 0, 1 and the coordinates. */
static size_t list_sides(side *out, const scaled_set *s, size_t k, bool anchored)
{
    double level[EXACT_POINTS + 2] = {0.0, 1.0};
    size_t count = 0, levels = 1, n = s->p.n;

    for (size_t i = 0; i < n; i++)
        level[i + 2] = s->p.x[i * s->p.dim + k];
    qsort(level, n + 2, sizeof *level, by_value);
    for (size_t i = 1; i < n + 2; i++)
        if (level[i] != level[levels - 1]) level[levels++] = level[i];
    for (size_t b = 0; b < levels; b++) {
        if (anchored) out[count++] = side_of(s, k, NULL, level[b]);
        for (size_t a = 0; a <= b && !anchored; a++)
            out[count++] = side_of(s, k, &level[a], level[b]);
    }
    return count;
}

typedef struct search {
    const scaled_set *set;
    side *sides[EXACT_DIM];
    size_t count[EXACT_DIM];
    exact_int n, share, best; /* share: 2^(bits*dim), a point's; best: n times */
} search;

static void take_greater(exact_int *best, exact_int v)
{
    if (exact_order(v, *best) > 0) *best = v;
}

/* n times the two local discrepancies of a box of that volume. */
static void offer(search *s, exact_int vol, uint32_t open, uint32_t closed)
{
    exact_int v = exact_times(vol, s->n);
    exact_int few = exact_times_of(s->share, __builtin_popcount(open));
    exact_int many = exact_times_of(s->share, __builtin_popcount(closed));

    take_greater(&s->best, exact_minus(v, few));
    take_greater(&s->best, exact_minus(many, v));
}

/* Boxes with the given sides along the axes before k. */
static void try_axis(search *s, size_t k, exact_int vol, uint32_t open,
                     uint32_t closed)
{
    if (k == s->set->p.dim) {
        offer(s, vol, open, closed);
        return;
    }
    for (size_t j = 0; j < s->count[k]; j++) {
        const side *t = &s->sides[k][j];

        try_axis(s, k + 1, exact_times(vol, t->length), open & t->open,
                 closed & t->closed);
    }
}

static exact_ratio over_n(const scaled_set *s, exact_int num)
{
    unsigned shift = s->bits * (unsigned)s->p.dim;

    return (exact_ratio){num, exact_shifted(exact_of((int64_t)s->p.n), shift)};
}

static exact_ratio best_box(koksma_points p, bool anchored)
{
    scaled_set set;
    search s = {.set = &set, .best = exact_of(0)};
    uint32_t all = (uint32_t)(((uint64_t)1 << p.n) - 1);

    scale(&set, p, 0);
    s.n = exact_of((int64_t)p.n);
    s.share = exact_shifted(exact_of(1), set.bits * (unsigned)p.dim);
    for (size_t k = 0; k < p.dim; k++) {
        s.sides[k] = calloc(SIDES_MOST, sizeof *s.sides[k]);
        if (s.sides[k] == NULL) abort();
        s.count[k] = list_sides(s.sides[k], &set, k, anchored);
    }
    try_axis(&s, 0, exact_of(1), all, all);
    for (size_t k = 0; k < p.dim; k++)
        free(s.sides[k]);
    return over_n(&set, s.best);
}

exact_ratio exact_star(koksma_points p) { return best_box(p, true); }
exact_ratio exact_box(koksma_points p) { return best_box(p, false); }

exact_ratio exact_local(koksma_points p, const double *lower, const double *upper,
                        bool closed)
{
    scaled_set set;
    unsigned bits = exact_bits(upper, p.dim, 0);
    exact_int vol = exact_of((int64_t)p.n), share;
    uint32_t inside = ~(uint32_t)0;

    if (lower != NULL) bits = exact_bits(lower, p.dim, bits);
    scale(&set, p, bits);
    for (size_t k = 0; k < p.dim; k++) {
        side t = side_of(&set, k, lower != NULL ? lower + k : NULL, upper[k]);

        vol = exact_times(vol, t.length);
        inside &= closed ? t.closed : t.open;
    }
    share = exact_shifted(exact_of(__builtin_popcount(inside)),
                          set.bits * (unsigned)p.dim);
    return over_n(&set, closed ? exact_minus(share, vol) : exact_minus(vol, share));
}

/* ---- Half-planes ----------------------------------------------------------- */

typedef struct place {
    exact_int x, y;
} place;

static exact_int square_above(exact_int t)
{
    return exact_sign(t) > 0 ? exact_times(t, t) : exact_of(0);
}

/* The share of the square [0,one]^2 with a x + b y <= t: as if a, b >= 0 by a
 * mirror, and then the triangle below the line less what is beyond the sides. */
static exact_ratio area_of(exact_int a, exact_int b, exact_int t, exact_int one)
{
    exact_int wa, wb, sum;

    if (exact_sign(a) < 0) t = exact_minus(t, exact_times(a, one));
    if (exact_sign(b) < 0) t = exact_minus(t, exact_times(b, one));
    wa = exact_times(exact_abs(a), one);
    wb = exact_times(exact_abs(b), one);
    if (exact_sign(wa) == 0 || exact_sign(wb) == 0) {
        exact_int w = exact_plus(wa, wb);

        if (exact_sign(t) < 0) t = exact_of(0);
        if (exact_order(t, w) > 0) t = w;
        return (exact_ratio){t, w};
    }
    sum = exact_minus(square_above(t), square_above(exact_minus(t, wa)));
    sum = exact_minus(sum, square_above(exact_minus(t, wb)));
    t = exact_minus(exact_minus(t, wa), wb);
    sum = exact_plus(sum, square_above(t));
    return (exact_ratio){sum, exact_times_of(exact_times(wa, wb), 2)};
}

/* count/n - area of the closed half-plane left of p -> p + d: that is d_x (y - p_y)
 * - d_y (x - p_x) >= 0. */
static exact_ratio left_of(const scaled_set *s, place p, place d)
{
    exact_int a = d.y, b = exact_minus(exact_of(0), d.x);
    exact_int t = exact_plus(exact_times(a, p.x), exact_times(b, p.y));
    exact_ratio area = area_of(a, b, t, exact_shifted(exact_of(1), s->bits));
    int64_t count = 0, n = (int64_t)s->p.n;

    for (size_t i = 0; i < s->p.n; i++) {
        exact_int u = exact_plus(exact_times(a, s->x[2 * i]),
                                 exact_times(b, s->x[2 * i + 1]));

        count += exact_order(u, t) <= 0;
    }
    return (exact_ratio){
        exact_minus(exact_times_of(area.den, count), exact_times_of(area.num, n)),
        exact_times_of(area.den, n)};
}

static place difference(place a, place b)
{
    return (place){exact_minus(a.x, b.x), exact_minus(a.y, b.y)};
}

static void try_line(exact_ratio *best, const scaled_set *s, place p, place d)
{
    for (int sign = 1; sign >= -1; sign -= 2) {
        place to = {exact_times_of(d.x, sign), exact_times_of(d.y, sign)};
        exact_ratio v = left_of(s, p, to);

        if (exact_ratio_order(v, *best) > 0) *best = v;
    }
}

/* Which lines: a half-plane whose line meets none of its points can be shifted
 * until it does, and loses area only.  Turned about such a point p its area changes
 * with the difference of the squares of the two parts of the chord: the least is
 * where the line meets a second point, or where p halves the chord, which then cuts
 * off the corner next to p at twice the distances of p from the two sides there.
 * With p = (a, b) from the nearest corner the chord has the direction (a, -b). */
exact_ratio exact_edge(koksma_points p)
{
    scaled_set s;
    exact_ratio best = {exact_of(-1), exact_of(1)};
    exact_int one;

    scale(&s, p, 1);
    one = exact_shifted(exact_of(1), s.bits);
    for (size_t i = 0; i < p.n; i++) {
        place at = {s.x[2 * i], s.x[2 * i + 1]}, chord = at;
        exact_int half = exact_shifted(exact_of(1), s.bits - 1);

        for (size_t j = 0; j < i; j++) {
            place d = difference((place){s.x[2 * j], s.x[2 * j + 1]}, at);

            if (exact_sign(d.x) != 0 || exact_sign(d.y) != 0)
                try_line(&best, &s, at, d);
        }
        if (exact_order(chord.x, half) > 0) chord.x = exact_minus(chord.x, one);
        if (exact_order(chord.y, half) > 0) chord.y = exact_minus(chord.y, one);
        chord.y = exact_times_of(chord.y, -1);
        if (exact_sign(chord.x) != 0 || exact_sign(chord.y) != 0) {
            try_line(&best, &s, at, chord);
            continue;
        }
        /* In a corner: one of these has no area. */
        try_line(&best, &s, at, (place){exact_of(1), exact_of(1)});
        try_line(&best, &s, at, (place){exact_of(1), exact_of(-1)});
    }
    return best;
}

exact_ratio exact_half_plane(koksma_points p, const double *from, const double *to)
{
    scaled_set s;
    place a, b;

    scale(&s, p, exact_bits(to, 2, exact_bits(from, 2, 1)));
    a = (place){exact_scaled(from[0], s.bits), exact_scaled(from[1], s.bits)};
    b = (place){exact_scaled(to[0], s.bits), exact_scaled(to[1], s.bits)};
    return left_of(&s, a, difference(b, a));
}
