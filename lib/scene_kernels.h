#ifndef KI_SCENE_KERNELS_H
#define KI_SCENE_KERNELS_H

/* Private: walks inside of the unit sphere. */

/* A point of the sphere, and two directions along it; all three are orthonormal. */
typedef struct ki_walk {
    double at[3];
    double s[3], t[3];
} ki_walk;

/* Go to the other end of the chord that starts with a cosine of sqrt(u) against
 * the normal and an azimuth of 2 pi v from s towards t, and carry s and t along. */
void ki_walk_step(ki_walk *w, double u, double v);

/* Make the three orthonormal again, to the last bits. */
void ki_walk_tidy(ki_walk *w);

#endif
