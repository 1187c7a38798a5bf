#include "l2_kernels.h"

#include <string.h>

/* The inner loops of the pairs: four rows against the columns of a panel, two
 * coordinates at a time, in loops that compilers turn into vectors. */

enum { W = KI_L2_PANEL };

static double least(double x)
{
    return x > 0.0 && x < KI_L2_LEAST ? KI_L2_LEAST : x;
}

void ki_l2_prepare(koksma_l2_kind kind, double x, double number[2])
{
    double t = x - 0.5;

    number[0] = x;
    number[1] = 0.0;
    switch (kind) {
    case KOKSMA_L2_STAR: number[0] = 1.0 - x; break;
    case KOKSMA_L2_EXTREME:
    case KOKSMA_L2_SYMMETRIC:
        number[0] = least(x);
        number[1] = 1.0 - x;
        break;
    case KOKSMA_L2_CENTERED:
        number[0] = 1.0 + (t > 0.0 ? t : 0.0);
        number[1] = t < 0.0 ? -t : 0.0;
        break;
    case KOKSMA_L2_MIXTURE: number[1] = 0.9375 - 0.25 * fabs(t); break;
    case KOKSMA_L2_PERIODIC:
    case KOKSMA_L2_WRAPAROUND:
    case KOKSMA_L2_KINDS: break;
    }
}

KI_L2_INLINE double lesser(double a, double b) { return a < b ? a : b; }

/* k of one coordinate; l2_kinds.c counts the roundings. */
KI_L2_INLINE double factor(koksma_l2_kind kind, double a, double a2, double b,
                           double b2)
{
    double s = fabs(a - b), r = s - 0.5;

    switch (kind) {
    case KOKSMA_L2_STAR: return lesser(a, b);
    case KOKSMA_L2_EXTREME: return lesser(a, b) * lesser(a2, b2);
    case KOKSMA_L2_PERIODIC: return 0.25 + r * r;
    case KOKSMA_L2_WRAPAROUND: return 1.25 + r * r;
    case KOKSMA_L2_MIXTURE: return (a2 + b2) + s * (0.5 * s - 0.75);
    case KOKSMA_L2_CENTERED:
    case KOKSMA_L2_SYMMETRIC:
    case KOKSMA_L2_KINDS: break;
    }
    return lesser(a, b) + lesser(a2, b2);
}

/* Products of four rows with each column, and their exponents where scaled. */
typedef struct four {
    double p[4][W];
    int64_t e[4][W];
} four;

/* Where coordinate k of a panel begins. */
KI_L2_INLINE const double *axis(const double *panel, koksma_l2_kind kind, size_t k)
{
    return panel + k * W * (size_t)(ki_l2_rows[kind].arrays);
}

/* Multiply the products by one coordinate: a are four rows of it. */
KI_L2_INLINE void times_one(koksma_l2_kind kind, four *restrict f,
                            const double *restrict a, const double *restrict b,
                            size_t arrays)
{
    const double *a2 = arrays == 2 ? a + W : a, *b2 = arrays == 2 ? b + W : b;

    for (size_t l = 0; l < W; l++) {
        f->p[0][l] *= factor(kind, a[0], a2[0], b[l], b2[l]);
        f->p[1][l] *= factor(kind, a[1], a2[1], b[l], b2[l]);
        f->p[2][l] *= factor(kind, a[2], a2[2], b[l], b2[l]);
        f->p[3][l] *= factor(kind, a[3], a2[3], b[l], b2[l]);
    }
}

/* And by two; c and d are the next coordinate of a and b. */
KI_L2_INLINE void times_two(koksma_l2_kind kind, four *restrict f,
                            const double *restrict a, const double *restrict b,
                            size_t arrays)
{
    const double *a2 = arrays == 2 ? a + W : a, *b2 = arrays == 2 ? b + W : b;
    const double *c = a + W * arrays, *d = b + W * arrays;
    const double *c2 = arrays == 2 ? c + W : c, *d2 = arrays == 2 ? d + W : d;

    for (size_t l = 0; l < W; l++) {
        f->p[0][l] = (f->p[0][l] * factor(kind, a[0], a2[0], b[l], b2[l])) *
                     factor(kind, c[0], c2[0], d[l], d2[l]);
        f->p[1][l] = (f->p[1][l] * factor(kind, a[1], a2[1], b[l], b2[l])) *
                     factor(kind, c[1], c2[1], d[l], d2[l]);
        f->p[2][l] = (f->p[2][l] * factor(kind, a[2], a2[2], b[l], b2[l])) *
                     factor(kind, c[2], c2[2], d[l], d2[l]);
        f->p[3][l] = (f->p[3][l] * factor(kind, a[3], a2[3], b[l], b2[l])) *
                     factor(kind, c[3], c2[3], d[l], d2[l]);
    }
}

/* Coordinates from k to end. */
KI_L2_INLINE void times_range(koksma_l2_kind kind, four *f, const double *a,
                              const double *b, size_t k, size_t end, size_t arrays)
{
    for (; k + 2 <= end; k += 2)
        times_two(kind, f, a + k * W * arrays, b + k * W * arrays, arrays);
    if (k < end) times_one(kind, f, a + k * W * arrays, b + k * W * arrays, arrays);
}

/* Move the exponents of the products, which are normal or 0, to e. */
static void make_normal(four *f)
{
    for (size_t r = 0; r < 4; r++)
        for (size_t l = 0; l < W; l++) {
            uint64_t bits;

            memcpy(&bits, &f->p[r][l], sizeof bits);
            if (bits == 0) continue;
            f->e[r][l] += (int64_t)(bits >> 52) - 1023;
            bits = (bits & 0xfffffffffffffu) | ((uint64_t)1023 << 52);
            memcpy(&f->p[r][l], &bits, sizeof bits);
        }
}

/* And back, in units of 2^unit.  What is below 2^-900 of that counts as 0. */
static void make_plain(four *f, int64_t unit)
{
    make_normal(f);
    for (size_t r = 0; r < 4; r++)
        for (size_t l = 0; l < W; l++) {
            int64_t e = f->e[r][l] - unit;

            f->p[r][l] = e < -900 ? 0.0 : ldexp(f->p[r][l], e > 60 ? 60 : (int)e);
        }
}

KI_L2_INLINE void start(four *f, bool scaled)
{
    for (size_t l = 0; l < W; l++)
        f->p[0][l] = f->p[1][l] = f->p[2][l] = f->p[3][l] = 1.0;
    if (scaled) memset(f->e, 0, sizeof f->e);
}

KI_L2_INLINE void multiply(koksma_l2_kind kind, four *f, const double *a,
                           const ki_l2_tile *t, size_t arrays)
{
    size_t chunk = t->scaled ? (size_t)ki_l2_rows[kind].chunk : t->dim;

    start(f, t->scaled);
    for (size_t k = 0; k < t->dim; k += chunk) {
        size_t end = t->dim - k < chunk ? t->dim : k + chunk;

        times_range(kind, f, a, t->columns, k, end, arrays);
        if (t->scaled) make_normal(f);
    }
    if (t->scaled) make_plain(f, t->e);
}

/* A sum for each column: hi + lo. */
typedef struct sums {
    double hi[W], lo[W];
} sums;

/* lo stays below 64 ulps of hi, and so loses less than 2^-92 of it. */
KI_L2_INLINE void add_rows(sums *restrict s, const four *restrict f)
{
    for (size_t l = 0; l < W; l++) {
        double x = (f->p[0][l] + f->p[1][l]) + (f->p[2][l] + f->p[3][l]);
        double sum = s->hi[l] + x, b = sum - s->hi[l];

        s->lo[l] += (s->hi[l] - (sum - b)) + (x - b);
        s->hi[l] = sum;
    }
}

KI_L2_INLINE ki_twice tile_sum(koksma_l2_kind kind, const ki_l2_tile *t,
                               size_t arrays)
{
    sums s = {0};
    ki_twice all = {0.0, 0.0};
    four f;

    for (size_t i = 0; i < t->row_count; i += 4) {
        size_t in_panel = i % W;
        const double *panel = t->rows + (i - in_panel) * t->dim * arrays;

        multiply(kind, &f, panel + in_panel, t, arrays);
        for (size_t r = t->row_count - i; r < 4; r++)
            memset(f.p[r], 0, sizeof f.p[r]);
        add_rows(&s, &f);
    }
    for (size_t l = 0; l < t->column_count; l++)
        all = ki_twice_add(all, ki_twice_sum(s.hi[l], s.lo[l]));
    return all;
}

#define TILE_SUM(name, kind, arrays)                                               \
    KI_L2_CLONES static ki_twice name(const ki_l2_tile *t)                         \
    {                                                                              \
        return tile_sum(kind, t, arrays);                                          \
    }

TILE_SUM(star, KOKSMA_L2_STAR, 1)
TILE_SUM(extreme, KOKSMA_L2_EXTREME, 2)
TILE_SUM(periodic, KOKSMA_L2_PERIODIC, 1)
TILE_SUM(centered, KOKSMA_L2_CENTERED, 2)
TILE_SUM(wraparound, KOKSMA_L2_WRAPAROUND, 1)
TILE_SUM(mixture, KOKSMA_L2_MIXTURE, 2)
TILE_SUM(symmetric, KOKSMA_L2_SYMMETRIC, 2)

ki_l2_tile_sum *const ki_l2_tile_sums[KOKSMA_L2_KINDS] = {
    star, extreme, periodic, centered, wraparound, mixture, symmetric};

ki_l2_number ki_l2_diagonal(koksma_l2_kind kind, const double *panel, size_t i,
                            size_t dim)
{
    ki_l2_number v = {{1.0, 0.0}, 0.0, 0};

    for (size_t k = 0; k < dim && v.m.hi != 0.0; k++) {
        double a = axis(panel, kind, k)[i];
        double a2 = ki_l2_rows[kind].arrays == 2 ? axis(panel, kind, k)[W + i] : a;

        v.m.hi *= factor(kind, a, a2, a, a2);
        v = ki_l2_normal(v);
    }
    return v;
}
