/* The indicator of Koch's snowflake. */
#include <float.h>
#include <math.h>

#include "integrand_kernels.h"

enum { SIDE, TURN };   /* param */
enum { COSINE, SINE }; /* derived */

static const double ROOT3 = 1.73205080756887729353;

/* Whether (u, h), h above the segment from (0,0) to (1,0), is under Koch's curve
 * over it.  The curve is four copies of itself, each a third as large and under a
 * triangle with angles of 30 degrees; these do not overlap, and what is under
 * none of them is decided.  It is its own mirror image, so two copies are enough.
 * The bound of 40 is never met by a point farther than 3^-40 from the curve. */
static bool is_under(double u, double h)
{
    for (int level = 0; level < 40; level++) {
        if (h <= 0.0) return true;
        if (u > 0.5) u = 1.0 - u;
        if (ROOT3 * h >= u) return false;
        if (h <= ROOT3 * (u - 1.0 / 3.0)) return true; /* in the middle triangle */
        if (u > 1.0 / 3.0) { /* on its side: turn that down to the segment */
            double along = u - 1.0 / 3.0, up = h;

            u = 0.5 * along + ROOT3 / 2.0 * up;
            h = 0.5 * up - ROOT3 / 2.0 * along;
        }
        u *= 3.0;
        h *= 3.0;
    }
    return false;
}

/* The triangle's sides face the angles -90, 30 and 150 degrees; a point that is
 * not inside can only be under the curve on the side that it is farthest out of. */
static double value(const koksma_integrand *f, const double *x)
{
    double dx = (x[0] - 0.5) / f->param[SIDE], dy = (x[1] - 0.5) / f->param[SIDE];
    double p = f->derived[COSINE] * dx + f->derived[SINE] * dy;
    double q = f->derived[COSINE] * dy - f->derived[SINE] * dx;
    double out[] = {-q, 0.5 * (ROOT3 * p + q), 0.5 * (q - ROOT3 * p)};
    double along[] = {p, 0.5 * (ROOT3 * q - p), -0.5 * (ROOT3 * q + p)};
    int far = out[1] > out[0];

    if (out[2] > out[far]) far = 2;
    return is_under(along[far] + 0.5, out[far] - ROOT3 / 6.0);
}

/* Whether Koch's curve from p to q, on its right, has a point inside of the box.
 * It stays in the triangle whose tip is that of its first bump, and passes through
 * both ends; what 30 divisions leave is shorter than any double could tell. */
static bool passes(const double *p, const double *q, const double *lower,
                   const double *upper, int level)
{
    double way[2], end[5][2];

    for (int k = 0; k < 2; k++)
        way[k] = q[k] - p[k];
    for (int k = 0; k < 2; k++) {
        end[0][k] = p[k];
        end[1][k] = p[k] + way[k] / 3.0;
        end[2][k] = p[k] + 0.5 * way[k] + ROOT3 / 6.0 * (k == 0 ? way[1] : -way[0]);
        end[3][k] = q[k] - way[k] / 3.0;
        end[4][k] = q[k];
        if (fmax(fmax(p[k], q[k]), end[2][k]) <= lower[k] ||
            fmin(fmin(p[k], q[k]), end[2][k]) >= upper[k])
            return false;
    }
    for (int i = 0; i < 5; i += 2)
        if (end[i][0] > lower[0] && end[i][0] < upper[0] && end[i][1] > lower[1] &&
            end[i][1] < upper[1])
            return true;
    for (int i = 0; i < 4 && level < 30; i++)
        if (passes(end[i], end[i + 1], lower, upper, level + 1)) return true;
    return false;
}

/* The corners of the triangle that all starts from, counterclockwise. */
static koksma_meeting meets(const koksma_integrand *f, const koksma_cell_box *box)
{
    static const double p[] = {-0.5, 0.5, 0.0}, q[] = {-1.0, -1.0, 2.0};
    double lower[2], upper[2], corner[3][2];

    for (int k = 0; k < 2; k++) {
        lower[k] = (double)box->lower[k] / (double)box->cells[k];
        upper[k] = (double)box->upper[k] / (double)box->cells[k];
    }
    for (int i = 0; i < 3; i++) {
        double u = f->param[SIDE] * p[i], v = f->param[SIDE] * ROOT3 / 6.0 * q[i];

        corner[i][0] = 0.5 + (f->derived[COSINE] * u - f->derived[SINE] * v);
        corner[i][1] = 0.5 + (f->derived[SINE] * u + f->derived[COSINE] * v);
    }
    for (int i = 0; i < 3; i++)
        if (passes(corner[i], corner[(i + 1) % 3], lower, upper, 0))
            return KOKSMA_CUTS;
    return KOKSMA_APART;
}

static void prepare(koksma_integrand *f)
{
    f->derived[COSINE] = cos(f->param[TURN]);
    f->derived[SINE] = sin(f->param[TURN]);
}

/* 8/5 of the triangle.  The boundary has positive density on both sides
 * everywhere and infinite length, so that the indicator is not of bounded
 * variation. */
static void facts(koksma_facts *out, const koksma_integrand *f)
{
    double side = f->param[SIDE], area = 0.4 * ROOT3 * side * side;

    *out = ki_facts_indicator(area, 4.0 * DBL_EPSILON * area, (double)INFINITY,
                              (double)INFINITY, 2);
    out->box_dim = log(4.0) / log(3.0);
}

const koksma_integrand_row ki_row_koch = {
    .name = "koch",
    .summary = "1 inside of a Koch snowflake",
    .dim = 2,
    .dim_least = 2,
    .dim_most = 2,
    .dim_step = 1,
    .params = {{"side", 0.7, 0x1p-20, 0.86, KOKSMA_CLOSED},
               {"turn", 0.3, 0.0, 6.3, KOKSMA_CLOSED}},
    .functions = {.value = value, .piece = ki_piece_by_value, .meets = meets},
    .prepare = prepare,
    .facts = facts,
};
