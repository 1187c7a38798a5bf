#include "edge_kernels.h"
#include "num_exact.h"
#include "num_twice.h"

/* The determinant in doubles has the right sign when it is above its rounding,
 * below 4 * 2^-53 of the sum of the two products [Shewchuk 1997], and what
 * underflows. */
int ki_edge_side(const double *a, const double *b, const double *p)
{
    double l = (b[0] - a[0]) * (p[1] - a[1]), r = (b[1] - a[1]) * (p[0] - a[0]);
    double det = l - r;

    if (fabs(det) > 0x1p-51 * (fabs(l) + fabs(r)) + 0x1p-1000)
        return det > 0.0 ? 1 : -1;

    ki_wide sum = {{0}};

    ki_wide_add(&sum, a[0], b[1]);
    ki_wide_add(&sum, -a[1], b[0]);
    ki_wide_add(&sum, b[0], p[1]);
    ki_wide_add(&sum, -b[1], p[0]);
    ki_wide_add(&sum, p[0], a[1]);
    ki_wide_add(&sum, -p[1], a[0]);
    return ki_wide_sign(&sum);
}

/* ---- Areas, with twice the precision ------------------------------------ */

/* The area of { |x| a + |y| b <= t } in the unit square for 0 <= b <= a and t at
 * most half of a + b: a triangle until t reaches b, and then a trapezoid.  t is off
 * by 8 u^2 of itself (below), a quotient by 12 u^2 and a product by 5 u^2, u =
 * 2^-53: the triangle, at most 1/2, by 45 u^2 of itself, the trapezoid, of which t
 * is at most twice the numerator, by less.  Where t is taken for more or less than
 * b by mistake, or for less than half of a + b, the two formulas differ by the
 * square of that.  A triangle below 2^-199 may underflow on the way and is no area.
 */
static ki_twice corner_area(ki_twice a, ki_twice b, ki_twice t)
{
    ki_twice half = ki_twice_scale(b, -0.5);

    if (t.hi > b.hi) return ki_twice_divide(ki_twice_add(t, half), a);
    if (b.hi < 0x1p-200) return (ki_twice){0.0, 0.0};
    return ki_twice_scale(
        ki_twice_times(ki_twice_divide(t, a), ki_twice_divide(t, b)), 0.5);
}

/* v or 1 - v, exactly. */
static ki_twice reflected(double v, bool turn)
{
    return turn ? ki_twice_sum(1.0, -v) : (ki_twice){v, 0.0};
}

static ki_twice size_of(ki_twice v, int down)
{
    double sign = v.hi < 0.0 ? -1.0 : 1.0;

    return (ki_twice){ldexp(sign * v.hi, -down), ldexp(sign * v.lo, -down)};
}

/* With d = b - a the right half-plane is { -d_y x + d_x y <= -d_y a_x + d_x a_y }.
 * Axes turned so that both coefficients are positive, it is { |d_y| x + |d_x| y <=
 * t } with t >= 0; the left one looks the same from the opposite corner.  t is a
 * sum of products >= 0, so nothing cancels.  d is scaled up to lose nothing by
 * underflow.  The smaller one of both areas is computed. */
static ki_twice smaller_area(const double *a, const double *b, bool *left)
{
    ki_twice dx = ki_twice_sum(b[0], -a[0]), dy = ki_twice_sum(b[1], -a[1]), t[2];
    bool turn_x = -dy.hi < 0.0, turn_y = dx.hi < 0.0;
    int e;

    (void)frexp(fmax(fabs(dx.hi), fabs(dy.hi)), &e);
    dx = size_of(dx, e);
    dy = size_of(dy, e);
    for (int side = 0; side < 2; side++) {
        ki_twice x = reflected(a[0], turn_x ^ side);
        ki_twice y = reflected(a[1], turn_y ^ side);

        t[side] = ki_twice_add(ki_twice_times(dy, x), ki_twice_times(dx, y));
    }
    *left = t[1].hi < t[0].hi;
    return dx.hi < dy.hi ? corner_area(dy, dx, t[*left])
                         : corner_area(dx, dy, t[*left]);
}

/* ki_excess adds less than n 2^-102 to what the area is off by. */
ki_twofold ki_edge_excess(const double *a, const double *b, size_t inside, size_t n)
{
    bool left;
    ki_twice area = smaller_area(a, b, &left);
    ki_twofold vol = {area.hi, area.lo, 0x1p-100};
    ki_twofold excess =
        left ? ki_excess(1.0, inside, n, vol) : ki_excess(-1.0, n - inside, n, vol);

    excess.err = (double)n * 0x1p-99;
    return excess;
}

koksma_interval koksma_half_plane_local(const koksma_half_plane *h, koksma_points p)
{
    size_t inside = 0;

    for (size_t i = 0; i < p.n; i++)
        inside += ki_edge_side(h->from, h->to, p.x + 2 * i) >= 0;
    return ki_divide(ki_edge_excess(h->from, h->to, inside, p.n), p.n);
}

/* ---- Chords ------------------------------------------------------------- */

/* 2v and 2v - 1 are exact where they are taken. */
bool ki_edge_chord(double end[2][2], double x, double y)
{
    end[1][0] = x <= 0.5 ? 0.0 : 1.0;
    end[0][1] = y <= 0.5 ? 0.0 : 1.0;
    end[0][0] = x <= 0.5 ? 2.0 * x : 2.0 * x - 1.0;
    end[1][1] = y <= 0.5 ? 2.0 * y : 2.0 * y - 1.0;
    return x != end[1][0] || y != end[0][1];
}
