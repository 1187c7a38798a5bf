#ifndef KOKSMA_TESTS_CERTIFY_FIXTURE_H
#define KOKSMA_TESTS_CERTIFY_FIXTURE_H

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "exact_oracle.h"
#include "oracle.h"

/* Small sets that are hard on rounding.  Set number `round` of a seed can be made
 * again without those before it. */
typedef struct hard_set {
    double x[EXACT_NUMBERS];
    koksma_points p;
    uint64_t round;
    const char *family;
    oracle_rng rng;
} hard_set;

static inline double hard_grid(oracle_rng *rng, unsigned bits)
{
    return ldexp((double)oracle_below(rng, ((size_t)1 << bits) + 1), -(int)bits);
}

/* Any number of bits: short products are exact, long ones are not. */
static inline double hard_any(oracle_rng *rng)
{
    return oracle_dyadic(rng, 1 + (unsigned)oracle_below(rng, 53));
}

/* Ties in masses, faces included. */
static inline double hard_coarse(oracle_rng *rng)
{
    return hard_grid(rng, 1 + (unsigned)oracle_below(rng, 3));
}

/* The same and a few units in the last place beside it: near ties. */
static inline double hard_beside(oracle_rng *rng)
{
    double v = hard_grid(rng, 2);
    double unit = ldexp((double)oracle_below(rng, 3), -53);

    return v > 0.0 && (v == 1.0 || oracle_below(rng, 2) == 0) ? v - unit : v + unit;
}

/* 0, 1, 1/2, 2^-k, 1 - 2^-k: volumes next to short numbers. */
static inline double hard_ends(oracle_rng *rng)
{
    double small = ldexp(1.0, -1 - (int)oracle_below(rng, 53));

    switch (oracle_below(rng, 6)) {
    case 0: return 0.0;
    case 1: return 1.0;
    case 2: return 0.5;
    case 3: return small;
    case 4: return small < 0.5 ? 0.5 + small : 0.5;
    default: return 1.0 - small;
    }
}

static inline double hard_tiny(oracle_rng *rng)
{
    return ldexp(oracle_dyadic(rng, 53), -40);
}

static inline double hard_scales(oracle_rng *rng)
{
    double v = ldexp(oracle_dyadic(rng, 53), -(int)oracle_below(rng, 60));

    return oracle_below(rng, 4) == 0 ? 1.0 - ldexp(floor(v * 0x1p53), -53) : v;
}

static inline double hard_mixed(oracle_rng *rng)
{
    switch (oracle_below(rng, 4)) {
    case 0: return hard_coarse(rng);
    case 1: return hard_ends(rng);
    case 2: return hard_scales(rng);
    default: return hard_any(rng);
    }
}

/* On a line with the origin exactly, though no difference of two is a double. */
static inline void hard_ray(hard_set *s)
{
    const koksma_points *p = &s->p;

    for (size_t i = 0; i < p->n; i++) {
        int down = (int)oracle_below(&s->rng, 12);

        for (size_t k = 0; k < p->dim; k++) {
            double v = i == 0 ? oracle_dyadic(&s->rng, 53) : ldexp(s->x[k], -down);

            if (i > 2 && oracle_below(&s->rng, 8) == 0) v = nextafter(v, 0.0);
            s->x[i * p->dim + k] = v;
        }
    }
}

/* All on a line through the square and, off it by a unit in the last place, now and
 * then one. */
static inline void hard_line(hard_set *s)
{
    const koksma_points *p = &s->p;
    long from[EXACT_DIM], by[EXACT_DIM];

    for (size_t k = 0; k < p->dim; k++) {
        from[k] = (long)oracle_below(&s->rng, 1u << 20);
        by[k] = (long)oracle_below(&s->rng, 1u << 17) - (1 << 16);
    }
    for (size_t i = 0; i < p->n; i++) {
        long t = (long)oracle_below(&s->rng, 17) - 8;
        double off = oracle_below(&s->rng, 8) == 0 ? 0x1p-53 : 0.0;

        for (size_t k = 0; k < p->dim; k++) {
            double v =
                ldexp((double)(from[k] + t * by[k]), -20) + (k > 0 ? off : 0);

            s->x[i * p->dim + k] = v < 0.0 ? 0.0 : v > 1.0 ? 1.0 : v;
        }
    }
}

/* Few different points, and few different coordinates. */
static inline void hard_repeats(hard_set *s)
{
    const koksma_points *p = &s->p;

    for (size_t i = 0; i < p->n * p->dim; i++) {
        size_t other = oracle_below(&s->rng, p->n);

        s->x[i] = i >= p->dim && i % p->dim == 0 && oracle_below(&s->rng, 2) == 0
                      ? s->x[oracle_below(&s->rng, i / p->dim) * p->dim]
                      : hard_mixed(&s->rng);
        if (i % p->dim != p->dim - 1 || other >= i / p->dim) continue;
        memcpy(s->x + i + 1 - p->dim, s->x + other * p->dim, p->dim * sizeof *s->x);
    }
}

/* A set and its images under the exchange of two axes and a mirror: many boxes
 * have the same local discrepancy, or nearly. */
static inline void hard_images(hard_set *s)
{
    const koksma_points *p = &s->p;

    for (size_t i = 0; i < p->n; i++) {
        double *x = s->x + i * p->dim, *before = i > 0 ? x - p->dim : x;

        for (size_t k = 0; k < p->dim; k++)
            x[k] = i % 2 == 0 ? hard_mixed(&s->rng) : before[p->dim - 1 - k];
        for (size_t k = 0; k < p->dim && i % 4 == 3; k++)
            x[k] = 1.0 - x[k];
    }
}

/* Points (2i + 1)/2n or i/n against a van der Corput sequence: even, so that all
 * local discrepancies are small, and no multiples of a power of two. */
static inline void hard_even(hard_set *s)
{
    const koksma_points *p = &s->p;
    size_t odd = oracle_below(&s->rng, 2);

    for (size_t i = 0; i < p->n; i++) {
        double v = 0.0;

        for (size_t j = i, k = 2; j > 0; j /= 2, k *= 2)
            v += (double)(j % 2) / (double)k;
        for (size_t k = 0; k < p->dim; k++)
            s->x[i * p->dim + k] = k == 0
                                       ? (double)(2 * i + odd) / (double)(2 * p->n)
                                   : k == 1 ? v
                                            : hard_any(&s->rng);
    }
}

static inline void hard_make(hard_set *s, size_t dim, size_t most, uint64_t round)
{
    static const struct {
        const char *name;
        double (*coordinate)(oracle_rng *rng);
        void (*points)(hard_set *s);
    } families[] = {
        {"any", hard_any, NULL},       {"coarse", hard_coarse, NULL},
        {"beside", hard_beside, NULL}, {"ends", hard_ends, NULL},
        {"tiny", hard_tiny, NULL},     {"scales", hard_scales, NULL},
        {"mixed", hard_mixed, NULL},   {"line", NULL, hard_line},
        {"ray", NULL, hard_ray},       {"repeats", NULL, hard_repeats},
        {"images", NULL, hard_images}, {"even", NULL, hard_even},
    };
    size_t which = (size_t)(round % (sizeof families / sizeof families[0]));

    s->rng = oracle_rng_start(oracle_seed(), round);
    s->round = round;
    s->family = families[which].name;
    s->p = (koksma_points){s->x, 1 + oracle_below(&s->rng, most), dim};
    for (size_t i = 0; families[which].points == NULL && i < s->p.n * dim; i++)
        s->x[i] = families[which].coordinate(&s->rng);
    if (families[which].points != NULL) families[which].points(s);
}

/* Fails with all that it takes to see the case again. */
static inline void hard_complain(const hard_set *s, const char *what, int how,
                                 koksma_interval v, exact_ratio truth)
{
    char text[1500] = "";
    size_t used = 0;

    for (size_t i = 0; i < s->p.n * s->p.dim && used < sizeof text - 40; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%a",
                                 i % s->p.dim == 0 ? "\n  " : " ", s->x[i]);
    ck_abort_msg("%s, %d: [%a, %a], truth about %.17g, KOKSMA_TEST_SEED=%llu, set "
                 "%llu (%s):%s",
                 what, how, v.lower, v.upper, (double)exact_value(truth),
                 (unsigned long long)oracle_seed(), (unsigned long long)s->round,
                 s->family, text);
}

#endif
