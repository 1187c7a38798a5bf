#include <stdlib.h>

#include "error.h"
#include "gen_kernels.h"
#include "rng_kernels.h"

/* Stratified random points: each coordinate is uniform in an interval [s/m,
 * (s+1)/m) that the pattern chooses.  In multiples of 2^-53 the interval is [a, b)
 * with a = ceil(2^53 s/m) and b = ceil(2^53 (s+1)/m), so that no rounding moves a
 * point out of it. */

/* Not inline: clang for 32 bits would take two such divisions for one of vectors,
 * which its run-time library lacks. */
__attribute__((noinline)) static uint64_t first_in(uint64_t s, uint64_t m)
{
    return (uint64_t)(((ki_u128)s * KI_EXACT + (m - 1)) / m);
}

static double in_stratum(uint64_t s, uint64_t m, uint64_t bits)
{
    uint64_t a = first_in(s, m), b = first_in(s + 1, m);

    return (double)(a + ki_rng_scale(bits, b - a)) * 0x1p-53;
}

/* Every stratum has to have a multiple of 2^-53. */
static koksma_status check_strata(const koksma_gen *g, uint64_t m,
                                  koksma_error *err)
{
    if (m <= KI_EXACT) return KOKSMA_OK;
    return ki_fail(err, KOKSMA_EINVAL, 0, "%ju strata: %s has 2^53 at most",
                   (uintmax_t)m, g->family->name);
}

/* ---- Jittered: a point in each cell of a grid [Cook 1986] -------------------- */

static koksma_status prepare_jittered(koksma_gen *g, koksma_error *err)
{
    koksma_status status = ki_grid_check(g, err);

    return status == KOKSMA_OK ? check_strata(g, ki_grid_side(g), err) : status;
}

static void fill_jittered(const koksma_gen *g, double *x, uint64_t first,
                          size_t count)
{
    koksma_rng r = ki_gen_stream(g, 0);
    uint64_t m = ki_grid_side(g);
    size_t dim = g->opts.dim;

    for (size_t i = 0; i < count; i++) {
        uint64_t cell = first + i;

        for (size_t k = dim; k-- > 0; cell /= m)
            x[i * dim + k] =
                in_stratum(cell % m, m, ki_rng_at(r, (first + i) * dim + k));
    }
}

/* ---- One point in each of n strata of each axis ------------------------------ */

/* Strata are kept in 32 bits. */
typedef struct strata {
    uint32_t *of; /* of coordinate k of point i: k*n + i */
} strata;

static koksma_status start_table(koksma_gen *g, koksma_error *err)
{
    strata *s;
    size_t bytes;

    if (g->opts.n > UINT32_MAX)
        return ki_fail(err, KOKSMA_EINVAL, 0, "%ju points: %s has 2^32 - 1 at most",
                       (uintmax_t)g->opts.n, g->family->name);
    s = calloc(1, sizeof *s);
    g->state = s;
    if (s == NULL || __builtin_mul_overflow(g->opts.dim, sizeof *s->of, &bytes) ||
        (s->of = ki_alloc((size_t)g->opts.n, bytes)) == NULL)
        return ki_fail_memory(err, "the strata");
    return KOKSMA_OK;
}

static void release_table(void *state)
{
    strata *s = state;

    if (s != NULL) free(s->of);
    free(s);
}

/* 0, ..., n-1 in random order to p[0], p[step], ..., each plus `base`. */
static void permute(uint32_t *p, size_t step, size_t n, uint32_t base,
                    koksma_rng *r)
{
    for (size_t i = 0; i < n; i++) {
        size_t at = (size_t)koksma_rng_below(r, i + 1);

        p[i * step] = p[at * step];
        p[at * step] = base + (uint32_t)i;
    }
}

/* Any strata of different axes together [McKay, Beckman, Conover 1979]. */
static koksma_status prepare_latin(koksma_gen *g, koksma_error *err)
{
    koksma_status status = start_table(g, err);
    const strata *s = g->state;
    size_t n = (size_t)g->opts.n;

    for (size_t k = 0; status == KOKSMA_OK && k < g->opts.dim; k++) {
        koksma_rng r = ki_gen_stream(g, k + 1);

        permute(s->of + k * n, 1, n, 0, &r);
    }
    return status;
}

/* And a point in each cell of a grid of n = m^dim [Chiu, Shirley, Wang 1994]: the
 * cells with digit c of coordinate k, which are runs of m^(dim-1-k) cells, share
 * the strata c n/m, ..., (c+1) n/m - 1 of this axis in random order. */
static koksma_status prepare_multijittered(koksma_gen *g, koksma_error *err)
{
    koksma_status status = ki_grid_check(g, err);
    size_t n = (size_t)g->opts.n, m, run = 1;
    uint32_t *slab;
    const strata *s;

    if (status == KOKSMA_OK) status = start_table(g, err);
    if (status != KOKSMA_OK) return status;
    s = g->state;
    m = (size_t)ki_grid_side(g);
    slab = ki_alloc(n / m, sizeof *slab);
    if (slab == NULL) return ki_fail_memory(err, "the strata");
    for (size_t k = g->opts.dim; k-- > 0; run *= m) {
        koksma_rng r = ki_gen_stream(g, k + 1);

        for (size_t c = 0; c < m; c++) {
            permute(slab, 1, n / m, (uint32_t)(c * (n / m)), &r);
            for (size_t j = 0; j < n / m; j++)
                s->of[k * n + (j / run * m + c) * run + j % run] = slab[j];
        }
    }
    free(slab);
    return KOKSMA_OK;
}

static void fill_table(const koksma_gen *g, double *x, uint64_t first, size_t count)
{
    const strata *s = g->state;
    koksma_rng r = ki_gen_stream(g, 0);
    uint64_t n = g->opts.n;
    size_t dim = g->opts.dim;

    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < dim; k++)
            x[i * dim + k] = in_stratum(s->of[k * n + first + i], n,
                                        ki_rng_at(r, (first + i) * dim + k));
}

const ki_gen_kernel ki_gen_jittered = {prepare_jittered, fill_jittered, NULL};
const ki_gen_kernel ki_gen_latin = {prepare_latin, fill_table, release_table};
const ki_gen_kernel ki_gen_multijittered = {prepare_multijittered, fill_table,
                                            release_table};
