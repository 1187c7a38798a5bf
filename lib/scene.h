#ifndef KOKSMA_SCENE_H
#define KOKSMA_SCENE_H

#include "integrand.h"

/* The reference scene: the inside of a diffuse sphere of radius 1, of which a cap
 * emits the radiance 1.
 *
 * The surface reflects the share `albedo` of what arrives, equally into all
 * directions.  The light is the cap of all points closer than 2 sqrt(cap) to the
 * point at `height` above the equator and `azimuth` round the axis; it has the
 * share `cap` of the surface.  The viewed point is the pole at height -1.  With
 * the light off the axis the discontinuity is askew to the first coordinates;
 * with height 1 or -1 it is not, and one bounce is a step in one coordinate.
 *
 * A walk goes from point to point in directions drawn in proportion to their
 * cosine.  Two coordinates (u, v) make a step: its cosine squared is u and its
 * azimuth 2 pi v against the direction in which the walk has come, which parallel
 * transport carries along; the next point is then uniform on the sphere wherever
 * the last was.  One frame for all points would make every step forget the walk
 * before it, and a walk of any length as easy as two dimensions; a frame that is
 * computed from the point is discontinuous somewhere.
 *
 *     sphere            gathering, n bounces, dim 2n: from the viewed point;
 *                       albedo^n where step n ends on the light
 *     sphere-sum        the sum over bounces 1, ..., n of the same walk
 *     sphere-shoot      shooting, n bounces, dim 2n + 2: from a point uniform on
 *                       the light, which takes the first two coordinates;
 *                       albedo^n cap/patch where step n ends on the patch, the cap
 *                       of that share of the surface round the viewed point
 *     sphere-shoot-sum  the sum over bounces 1, ..., n
 *
 * By uniformity the answer to n bounces is albedo^n cap, to the sum
 * cap (albedo + ... + albedo^n), and to all bounces cap albedo/(1 - albedo).
 * Gathering finds the radiance of the viewed point, and shooting its mean over the
 * patch, which is the same.  Bounce 0, what is seen of the light itself, is
 * nowhere counted.
 *
 * On which side of the light's rim a walk ends is decided in doubles, up to some
 * 1e-15 a step, and the same way on every machine.  Where albedo^n is below 1e-308
 * everything is 0.  All rows, ended by NULL: */
extern const koksma_integrand_row *const koksma_scenes[];

/* The row of that name, or NULL. */
const koksma_integrand_row *koksma_scene_find(const char *name);

/* Steps, and bounces, of a walk of f, an integrand of such a row. */
size_t koksma_scene_bounces(const koksma_integrand *f);

/* The answer to all bounces, 1 to infinity. */
double koksma_scene_neumann(const koksma_integrand *f);

#endif
