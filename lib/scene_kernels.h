#ifndef KI_SCENE_KERNELS_H
#define KI_SCENE_KERNELS_H

#include <math.h>

/* Private: walks inside of the unit sphere. */

/* A point of the sphere, the direction in which it was reached, carried on to the
 * tangent plane, and the one across; all three are orthonormal. */
typedef struct ki_walk {
    double at[3];
    double ahead[3], aside[3];
} ki_walk;

/* The cosine and the sine of 2 pi v, 0 <= v <= 1, within 2^-49, and the same on
 * every machine.  A quarter of the angle of v - 1/2 is within pi/4 and off by some
 * 2^-53; there the first terms that Taylor's series leave out are below 2^-54;
 * doubling the angle twice makes four errors of one.  Branches on v, which no
 * processor could foretell, would cost more than that. */
static inline void ki_turn(double *cosine, double *sine, double v)
{
    static const double c[] = {
        1 / 2.,       -1 / 24.,        1 / 720.,         -1 / 40320.,
        1 / 3628800., -1 / 479001600., 1 / 87178291200., -1 / 20922789888000.};
    static const double s[] = {
        1 / 6.,        -1 / 120.,        1 / 5040.,         -1 / 362880.,
        1 / 39916800., -1 / 6227020800., 1 / 1307674368000.};
    double a = 1.57079632679489661923 * (v - 0.5), b = a * a, d = b * b;
    double versed =
        b *
        ((c[0] + b * c[1]) +
         d * ((c[2] + b * c[3]) + d * ((c[4] + b * c[5]) + d * (c[6] + b * c[7]))));
    double si =
        a - a * b *
                ((s[0] + b * s[1]) +
                 d * ((s[2] + b * s[3]) + d * ((s[4] + b * s[5]) + d * s[6])));
    double co = 1.0 - versed;
    double co2 = 1.0 - 2.0 * si * si, si2 = 2.0 * si * co;

    *cosine = 2.0 * si2 * si2 - 1.0; /* half a turn off */
    *sine = -2.0 * si2 * co2;
}

/* Go to the other end of the chord that starts with a cosine of sqrt(u) against
 * the normal and an azimuth of 2 pi v from `ahead` towards `aside`.
 *
 * With theta the angle against the normal -y, the chord 2 cos theta (-cos theta y +
 * sin theta d) ends at y' = -cos 2theta y + sin 2theta d; cos 2theta = 2u - 1 is
 * uniform on [-1,1] when u is on [0,1], and so y' on the sphere (Archimedes).
 *
 * The rotation of y to y' in the plane of y and d takes d, the new way ahead, to
 * -sin 2theta y - cos 2theta d, and leaves what is across as it is.
 *
 * Rounding makes the three less orthonormal, by less than 1e-15 a step. */
static inline void ki_walk_step(ki_walk *w, double u, double v)
{
    double along = 2.0 * u - 1.0, across = 2.0 * sqrt(u * (1.0 - u)), cosine, sine;

    ki_turn(&cosine, &sine, v);
    for (int i = 0; i < 3; i++) {
        double y = w->at[i], d = cosine * w->ahead[i] + sine * w->aside[i];

        w->aside[i] = cosine * w->aside[i] - sine * w->ahead[i];
        w->ahead[i] = -across * y - along * d;
        w->at[i] = across * d - along * y;
    }
}

#endif
