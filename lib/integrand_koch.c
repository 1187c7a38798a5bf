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
    .functions = {.value = value, .piece = ki_piece_by_value},
    .prepare = prepare,
    .facts = facts,
};
