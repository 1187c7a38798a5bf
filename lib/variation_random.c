/* The variation on a grid that is too large to look at, from random cells.
 *
 * The cells of all faces of one order m, the number of axes, are a stratum of
 * W_m = C(dim,m) k^m cells.  With uniform faces and cells, W_m times the mean of
 * |Delta| is unbiased for its part of V_k.  A first share of the samples, which is
 * not counted, shows the spread s_m; the rest is drawn half evenly, and half in
 * proportion to W_m s_m / sqrt(2^m), which is best where a cell costs 2^m values
 * [Cochran 1977, 5.5]. */
#include <math.h>
#include <stdlib.h>

#include "error.h"
#include "variation_kernels.h"

enum { NONZERO_LEAST = 30 };

/* Of samples: how many, how many are not 0, their mean and sum of squares about
 * it. */
typedef struct moments {
    double n, nonzero, mean, square;
} moments;

typedef struct sampler {
    const koksma_integrand *f;
    size_t k;
    koksma_rng rng;
    ki_variation_watch *watch;
    double x[KOKSMA_VARIATION_DIM_MOST];
    moments *faces; /* 2^dim, or NULL */
} sampler;

static void add(moments *m, double v)
{
    double off = v - m->mean;

    m->n++;
    m->nonzero += v != 0.0;
    m->mean += off / m->n;
    m->square += off * (v - m->mean);
}

static double variance_of_mean(const moments *m)
{
    return m->square / (m->n - 1.0) / m->n;
}

/* order of dim axes, each choice as likely. */
static unsigned draw_face(koksma_rng *rng, size_t dim, size_t order)
{
    unsigned u = 0;

    for (size_t j = 0; j < dim && order > 0; j++)
        if (koksma_rng_below(rng, dim - j) < order) {
            u |= 1u << j;
            order--;
        }
    return u;
}

static koksma_status draw(moments *m, sampler *s, size_t order, double count,
                          koksma_error *err)
{
    size_t low[KOKSMA_VARIATION_DIM_MOST];

    for (double i = 0.0; i < count; i++) {
        unsigned u = draw_face(&s->rng, s->f->dim, order);
        double d;

        for (size_t j = 0; j < s->f->dim; j++) {
            s->x[j] = 1.0;
            low[j] = u >> j & 1 ? koksma_rng_below(&s->rng, s->k) : 0;
        }
        if (ki_variation_told_to_stop(s->watch))
            return ki_variation_stopped(s->watch, err);
        d = ki_variation_cell(s->f, u, low, s->k, s->x, &s->watch->work);
        if (!isfinite(d)) return ki_variation_bad_value(s->f, s->x, err);
        add(m, d);
        if (s->faces != NULL) add(&s->faces[u], d);
    }
    return KOKSMA_OK;
}

static double binomial(size_t n, size_t m)
{
    double b = 1.0;

    for (size_t i = 0; i < m; i++)
        b = b * (double)(n - i) / (double)(i + 1); /* a whole number each time */
    return b;
}

/* How many samples each order gets. */
static koksma_status allot(double *count, sampler *s, double samples,
                           koksma_error *err)
{
    size_t dim = s->f->dim;
    double total = 0.0;

    for (size_t m = 1; m <= dim; m++) {
        moments seen = {0};
        double cells = binomial(dim, m) * pow((double)s->k, (double)m);
        double cost = ldexp(1.0, (int)m);
        koksma_status status =
            draw(&seen, s, m, fmax(2.0, samples / 8.0 / (double)dim / cost), err);

        if (status != KOKSMA_OK) return status;
        count[m] = cells * sqrt(seen.square / (seen.n - 1.0) * cost);
        total += count[m];
    }
    for (size_t m = 1; m <= dim; m++) {
        double share = total > 0.0 ? count[m] / total : 1.0 / (double)dim;

        share = 0.5 * share + 0.5 / (double)dim;
        count[m] = fmax(2.0, floor(0.875 * samples * ldexp(share, -(int)m)));
    }
    return KOKSMA_OK;
}

static koksma_estimate estimate(double value, double variance, bool rare)
{
    double reach = 1.959963984540054 * sqrt(variance);

    if (rare) return (koksma_estimate){value, (double)NAN, (double)NAN, 0.0};
    return (koksma_estimate){value, fmax(value - reach, 0.0), value + reach, 0.95};
}

static void fill_faces(koksma_estimate *faces, const sampler *s)
{
    faces[0] = ki_variation_exact(0.0);
    for (unsigned u = 1; u < 1u << s->f->dim; u++) {
        const moments *m = &s->faces[u];
        double cells = pow((double)s->k, (double)__builtin_popcount(u));

        faces[u] = estimate(m->n > 0.0 ? cells * m->mean : (double)NAN,
                            cells * cells * variance_of_mean(m),
                            m->nonzero < NONZERO_LEAST);
    }
}

static koksma_status run(koksma_variation_level *out, sampler *s, double samples,
                         moments *faces, koksma_error *err)
{
    double count[KOKSMA_VARIATION_DIM_MOST + 1], value = 0.0, variance = 0.0;
    koksma_status status = allot(count, s, samples, err);
    bool rare = false;

    s->faces = faces;
    for (size_t m = 1; m <= s->f->dim && status == KOKSMA_OK; m++) {
        moments seen = {0};
        double cells = binomial(s->f->dim, m) * pow((double)s->k, (double)m);

        status = draw(&seen, s, m, count[m], err);
        value += cells * seen.mean;
        variance += cells * cells * variance_of_mean(&seen);
        rare = rare || seen.nonzero < NONZERO_LEAST;
    }
    if (status == KOKSMA_OK)
        *out = (koksma_variation_level){s->k, estimate(value, variance, rare)};
    return status;
}

koksma_status ki_variation_random(koksma_variation_level *out,
                                  koksma_estimate *faces, const koksma_integrand *f,
                                  size_t k, double samples, uint64_t seed,
                                  ki_variation_watch *w, koksma_error *err)
{
    sampler s = {.f = f, .k = k, .rng = koksma_rng_seed(seed, k), .watch = w};
    moments *sums = NULL;
    koksma_status status;

    if (faces != NULL) {
        sums = calloc((size_t)1 << f->dim, sizeof *sums);
        if (sums == NULL) return ki_fail_memory(err, "faces");
    }
    status = run(out, &s, samples, sums, err);
    if (status == KOKSMA_OK && faces != NULL) fill_faces(faces, &s);
    free(sums);
    return status;
}
