#ifndef KOKSMA_BOUND_H
#define KOKSMA_BOUND_H

#include <stddef.h>

#include "num.h"
#include "points.h"

/* What theory says of the error of N quasi-random points before there are any: the
 * Koksma-Hlawka inequality, and the estimates for integrands that jump.
 *
 * Let f = f~ + a jump of size J across a surface of area S and extent l, with f~ of
 * finite variation and independent of N, and let the surface depend on d of the
 * dim coordinates.  Then
 *
 *     koksma-hlawka  V_HK(f) D*
 *     smooth         V_HK(f~) D*, or B/N where a fit has found B
 *     paper          V_HK(f~) D* + sqrt(l) J N^(-(dim+1)/2dim)
 *     jump           sqrt(S/6) J N^(-(d+1)/2d), but at most sigma/sqrt(N)
 *     rms            sqrt(jump^2 + smooth^2)
 *     reach          z times that
 *     random         sigma/sqrt(N)
 *
 * The first is a theorem.  The third is (12) of [Szirmay-Kalos, Purgathofer 1998],
 * to the letter, which is no bound: its second term is the standard deviation of a
 * sum over cells as if their errors were independent, with (J/2)^2 < J^2 for the
 * variance in a cell.  The fourth is that standard deviation for a uniform point in
 * each of N cubes: a cell that the surface cuts into shares p and 1 - p has the
 * variance J^2 p (1 - p), and summed over the cells that is
 *
 *     J^2 S N^((d-1)/d) E|n (U - U')|/2,    U, U' uniform in the cube,
 *
 * where for a normal n of any direction E(n (U - U'))^2 = 1/6, and half the mean of
 * |n (U - U')| is between 0.1629 and 0.1667.  It holds, about, for points that are
 * scrambled or whose digits are permuted, from some l^d points on; of one sequence
 * as it is nobody knows it. */

/* ---- What is known of an integrand ------------------------------------------- */

/* How V_HK is known. */
typedef enum koksma_vhk_from {
    KOKSMA_VHK_UNKNOWN,
    KOKSMA_VHK_CLOSED, /* proved; infinity too */
    KOKSMA_VHK_GRID,   /* V_k of a grid: at least that */
    KOKSMA_VHK_GROWS   /* V_k of grids, which diverges as far as it was seen */
} koksma_vhk_from;

/* NaN stands for what is not known, where nothing else is said. */
typedef struct koksma_bound_facts {
    size_t dim;
    koksma_vhk_from vhk_from;
    double vhk;        /* V_HK(f) */
    double smooth_vhk; /* V_HK(f~), in closed form */
    double smooth;     /* B: the root mean square error of f~ is B/N */
    double jump;       /* the largest J; 0: there is none */
    double jump_rms;   /* its root mean square over the surface; NaN: jump */
    double area;       /* S; NaN: what the extent makes of surfaces whose normals
                          have all directions alike */
    double extent;     /* l */
    double axes;       /* d; NaN: dim */
    double sigma;      /* the standard deviation of f at a uniform point */
} koksma_bound_facts;

/* Everything unknown. */
koksma_bound_facts koksma_bound_no_facts(size_t dim);

/* ---- The terms --------------------------------------------------------------- */

typedef enum koksma_bound_name {
    KOKSMA_BOUND_HLAWKA,
    KOKSMA_BOUND_SMOOTH,
    KOKSMA_BOUND_PAPER,
    KOKSMA_BOUND_JUMP,
    KOKSMA_BOUND_RMS,
    KOKSMA_BOUND_REACH,
    KOKSMA_BOUND_RANDOM,
    KOKSMA_BOUND_TERMS /* how many */
} koksma_bound_name;

/* "koksma-hlawka", ... as above. */
extern const char *const koksma_bound_names[KOKSMA_BOUND_TERMS];

typedef enum koksma_bound_kind {
    KOKSMA_BOUND_UNKNOWN,   /* what it takes is not known: the value is NaN */
    KOKSMA_BOUND_PROVED,    /* no error is larger */
    KOKSMA_BOUND_ONE_SIGMA, /* about what the root mean square error is */
    KOKSMA_BOUND_ESTIMATE,  /* rests on numbers that are estimates themselves */
    KOKSMA_BOUND_DIVERGING  /* no number: V_k grows as far as it was seen */
} koksma_bound_kind;

typedef struct koksma_bound_term {
    double value;
    koksma_bound_kind kind;
} koksma_bound_term;

/* All terms at N.
 *
 * Out:     term  KOKSMA_BOUND_TERMS of them
 * In:      n     N >= 1
 *          star  an upper bound of D* of the N points; NaN: not known
 *          z     >= 0, of reach
 * Returns: KOKSMA_OK; KOKSMA_EINVAL: dim is 0, axes are not from 1 to dim, or
 *          anything else is below its range */
koksma_status koksma_bound(koksma_bound_term *term, const koksma_bound_facts *facts,
                           double n, double star, double z, koksma_error *err);

/* ---- Where things turn ------------------------------------------------------- */

/* NaN where it is not known or never happens; infinite where it is beyond doubles.
 *
 *     saturation  l^d: with fewer cells nearly all meet the surface, and the points
 *                 do as random ones do
 *     even        (S J^2/(6 sigma^2))^d: from here on the jump costs less than with
 *                 random points; koksma_fit_break_even
 *     cross       (B/(sqrt(S/6) J))^(2d/(d-1)): from here on the jump costs more
 *                 than the smooth part */
typedef struct koksma_bound_turns {
    double saturation, even, cross;
} koksma_bound_turns;

koksma_bound_turns koksma_bound_turning(const koksma_bound_facts *facts);

/* Can the points pay at N: do they promise less than random ones? */
typedef enum koksma_pay {
    KOKSMA_PAY_UNKNOWN,
    KOKSMA_PAY_SATURATED, /* no: N is below the saturation */
    KOKSMA_PAY_NOT_YET,   /* no: N is below even */
    KOKSMA_PAY_JUMP,      /* yes: across the jump they are better */
    KOKSMA_PAY_SMOOTH     /* yes: there is no jump, and V_HK is finite */
} koksma_pay;

koksma_pay koksma_bound_pays(const koksma_bound_facts *facts, double n);

#endif
