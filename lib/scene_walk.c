#include "scene_kernels.h"

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void subtract(double *a, const double *b)
{
    double part = dot(a, b);

    for (int i = 0; i < 3; i++)
        a[i] -= part * b[i];
}

/* One step of Newton's method for 1/sqrt: a length off by e becomes off by some
 * e^2. */
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
