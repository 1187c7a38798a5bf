#include "scene_kernels.h"

#include <math.h>
#include <stddef.h>

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* With theta the angle against the normal -y, the chord 2 cos theta (-cos theta y +
 * sin theta d) ends at y' = -cos 2theta y + sin 2theta d; cos 2theta = 2u - 1 is
 * uniform on [-1,1] when u is on [0,1], and so y' on the sphere (Archimedes).
 *
 * The rotation of y to y' in the plane of y and d takes d to -sin 2theta y -
 * cos 2theta d and leaves the direction e across as it is; s and t have constant
 * components along d and e. */
void ki_walk_step(ki_walk *w, double u, double v)
{
    const double turn = 6.28318530717958647693;
    double cosine = cos(turn * v), sine = sin(turn * v);
    double along = 2.0 * u - 1.0, across = 2.0 * sqrt(u * (1.0 - u));

    for (int i = 0; i < 3; i++) {
        double y = w->at[i], d = cosine * w->s[i] + sine * w->t[i];
        double e = cosine * w->t[i] - sine * w->s[i];
        double ahead = -across * y - along * d;

        w->at[i] = across * d - along * y;
        w->s[i] = cosine * ahead - sine * e;
        w->t[i] = sine * ahead + cosine * e;
    }
}

static void subtract(double *a, const double *b)
{
    double part = dot(a, b);

    for (int i = 0; i < 3; i++)
        a[i] -= part * b[i];
}

/* One step of Newton's method for 1/sqrt: a length off by e becomes off by e^2. */
static void normalise(double *a)
{
    double factor = 1.5 - 0.5 * dot(a, a);

    for (int i = 0; i < 3; i++)
        a[i] *= factor;
}

void ki_walk_tidy(ki_walk *w)
{
    normalise(w->at);
    subtract(w->s, w->at);
    normalise(w->s);
    subtract(w->t, w->at);
    subtract(w->t, w->s);
    normalise(w->t);
}
