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

/* What compares with nothing is neither below nor above. */
void ki_edge_pad(double *x, double *y, double *w, size_t count)
{
    for (size_t i = count; i < count + KI_EDGE_LANES; i++) {
        x[i] = y[i] = (double)NAN;
        if (w != NULL) w[i] = 0.0;
    }
}

/* Where a mask is set: one more, or the weight. */
#define COUNT(sum, is, weight) ((sum) += (lanes)((masks)(is) & (weight)))

INLINE double total(const lanes *sum)
{
    double all = 0.0;

    for (int lane = 0; lane < KI_EDGE_LANES; lane++)
        all += (*sum)[lane];
    return all;
}

/* No loop over the parts: the sums are to stay in registers. */
INLINE void count_points(ki_edge_split *s, const ki_edge_cell *c,
                         const ki_edge_list *l, bool weighted)
{
    double d = 0.5 * c->side, slope = c->v - c->u, near = KI_EDGE_NEAR;
    lanes below[KI_EDGE_PARTS] = {{0}}, above[KI_EDGE_PARTS] = {{0}}, one = {0};

    one += 1.0;
    for (size_t i = 0; i < l->count; i += KI_EDGE_LANES) {
        lanes x = *(const lanes *)(l->x + i), y = *(const lanes *)(l->y + i);
        lanes by_v = d * x, by_u = d - by_v, r = y - c->u - slope * x, high = r - d;
        masks weight = (masks)(weighted ? *(const lanes *)(l->w + i) : one);

        COUNT(below[0], r < -near, weight);
        COUNT(below[1], r < by_u - near, weight);
        COUNT(below[2], r < by_v - near, weight);
        COUNT(below[3], r < d - near, weight);
        COUNT(above[0], high > near, weight);
        COUNT(above[1], high > by_u + near, weight);
        COUNT(above[2], high > by_v + near, weight);
        COUNT(above[3], high > d + near, weight);
    }
    *s = (ki_edge_split){
        {total(&below[0]), total(&below[1]), total(&below[2]), total(&below[3])},
        {total(&above[0]), total(&above[1]), total(&above[2]), total(&above[3])}};
}

CLONES static void count_each(ki_edge_split *s, const ki_edge_cell *c,
                              const ki_edge_list *l)
{
    count_points(s, c, l, false);
}

CLONES static void count_weights(ki_edge_split *s, const ki_edge_cell *c,
                                 const ki_edge_list *l)
{
    count_points(s, c, l, true);
}

void ki_edge_cell_split(ki_edge_split *s, const ki_edge_cell *c,
                        const ki_edge_list *l)
{
    (l->w == NULL ? count_each : count_weights)(s, c, l);
}

/* A point is written anyway, and then written over or not. */
INLINE size_t keep_points(double *x, double *y, double *w, double *under,
                          const ki_edge_cell *c, const ki_edge_list *l)
{
    double u = c->u, slope = c->v - c->u, most = c->side + KI_EDGE_NEAR;
    double below = 0.0;
    size_t kept = 0, n = l->count, passed = 0;
    const double *from_x = l->x, *from_y = l->y;

    for (size_t i = 0; i < n; i++) {
        double across = from_x[i], up = from_y[i], r = up - u - slope * across;
        bool is_below = r<-KI_EDGE_NEAR, is_above = r> most;

        x[kept] = across;
        y[kept] = up;
        if (w != NULL) {
            w[kept] = l->w[i];
            below += is_below ? l->w[i] : 0.0;
        }
        kept += 1 - ((size_t)is_below | (size_t)is_above);
        passed += is_below;
    }
    *under += w != NULL ? below : (double)passed;
    return kept;
}

size_t ki_edge_cell_keep(double *x, double *y, double *w, double *under,
                         const ki_edge_cell *c, const ki_edge_list *l)
{
    if (l->w == NULL) return keep_points(x, y, NULL, under, c, l);
    return keep_points(x, y, w, under, c, l);
}
