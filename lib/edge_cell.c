#include "edge_kernels.h"

/* The points that matter to a cell of lines.
 *
 * The heights of a line at x are u (1 - x) + v x.  In a cell of side s they rise
 * from the lowest line of the cell to its highest by s, whatever x: so with r the
 * height of a point above the lowest line, it is surely below all lines where r <
 * 0, and above all where r > s.  The parts of the cell have the side d = s/2; their
 * lowest lines are higher by d (1 - x) where u has its upper half, and by d x where
 * v has. All this is off by less than 2^-48, and a margin of 2^-40 is left. */

#ifdef HAVE_TARGET_CLONES
#define CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define CLONES
#endif
#define INLINE static inline __attribute__((always_inline))

typedef double lanes __attribute__((vector_size(KI_EDGE_LANES * sizeof(double)),
                                    aligned(sizeof(double)), may_alias));
typedef int64_t masks __attribute__((vector_size(KI_EDGE_LANES * sizeof(double))));

/* What is counted: points below or above, of a part that has an upper half. */
enum { BELOW_U, BELOW_V, BELOW_BOTH, ABOVE_NONE, ABOVE_U, ABOVE_V, COUNTS };

/* A point that is above all lines of all parts, and below none. */
void ki_edge_pad(double *x, double *y, double *w, size_t count)
{
    for (size_t i = count; i < count + KI_EDGE_LANES; i++) {
        x[i] = 0.0;
        y[i] = 0x1p10;
        if (w != NULL) w[i] = 0.0;
    }
}

INLINE void classify(masks *is, const double *x, const double *y,
                     const ki_edge_cell *c)
{
    double d = 0.5 * c->side;
    lanes across = *(const lanes *)x, r = *(const lanes *)y;
    lanes by_v = d * across, by_u = d - by_v;

    r = r - c->u - (c->v - c->u) * across;
    is[BELOW_U] = r < by_u - KI_EDGE_NEAR;
    is[BELOW_V] = r < by_v - KI_EDGE_NEAR;
    is[BELOW_BOTH] = r < d - KI_EDGE_NEAR;
    r = r - d;
    is[ABOVE_NONE] = r > KI_EDGE_NEAR;
    is[ABOVE_U] = r > by_u + KI_EDGE_NEAR;
    is[ABOVE_V] = r > by_v + KI_EDGE_NEAR;
}

CLONES static void count_points(double *sum, const ki_edge_cell *c,
                                const ki_edge_list *l)
{
    masks total[COUNTS] = {{0}}, is[COUNTS];

    for (size_t i = 0; i < l->count; i += KI_EDGE_LANES) {
        classify(is, l->x + i, l->y + i, c);
        for (int k = 0; k < COUNTS; k++)
            total[k] -= is[k];
    }
    for (int k = 0; k < COUNTS; k++) {
        sum[k] = 0.0;
        for (int lane = 0; lane < KI_EDGE_LANES; lane++)
            sum[k] += (double)total[k][lane];
    }
}

CLONES static void weigh_points(double *sum, const ki_edge_cell *c,
                                const ki_edge_list *l)
{
    lanes total[COUNTS] = {{0}};
    masks is[COUNTS];

    for (size_t i = 0; i < l->count; i += KI_EDGE_LANES) {
        masks weight = (masks) * (const lanes *)(l->w + i);

        classify(is, l->x + i, l->y + i, c);
        for (int k = 0; k < COUNTS; k++)
            total[k] += (lanes)(is[k] & weight);
    }
    for (int k = 0; k < COUNTS; k++) {
        sum[k] = 0.0;
        for (int lane = 0; lane < KI_EDGE_LANES; lane++)
            sum[k] += total[k][lane];
    }
}

void ki_edge_cell_split(ki_edge_split *s, const ki_edge_cell *c,
                        const ki_edge_list *l)
{
    double sum[COUNTS], pads = 0.0;

    if (l->w == NULL) {
        count_points(sum, c, l);
        pads = (double)((KI_EDGE_LANES - l->count % KI_EDGE_LANES) % KI_EDGE_LANES);
    } else {
        weigh_points(sum, c, l);
    }
    *s = (ki_edge_split){
        {0.0, sum[BELOW_U], sum[BELOW_V], sum[BELOW_BOTH]},
        {sum[ABOVE_NONE] - pads, sum[ABOVE_U] - pads, sum[ABOVE_V] - pads, 0.0}};
}

/* A point is written anyway, and then written over or not. */
CLONES static size_t keep_points(double *x, double *y, double *w, double *under,
                                 const ki_edge_cell *c, const ki_edge_list *l)
{
    double u = c->u, slope = c->v - c->u, most = c->side + KI_EDGE_NEAR;
    double below = 0.0;
    size_t kept = 0, passed = 0;

    for (size_t i = 0; i < l->count; i++) {
        double across = l->x[i], up = l->y[i], r = up - u - slope * across;
        bool is_below = r < -KI_EDGE_NEAR;

        x[kept] = across;
        y[kept] = up;
        if (l->w != NULL) {
            w[kept] = l->w[i];
            below += is_below ? l->w[i] : 0.0;
        }
        kept += !is_below & (r <= most);
        passed += is_below;
    }
    *under += l->w != NULL ? below : (double)passed;
    return kept;
}

size_t ki_edge_cell_keep(double *x, double *y, double *w, double *under,
                         const ki_edge_cell *c, const ki_edge_list *l)
{
    return keep_points(x, y, w, under, c, l);
}
