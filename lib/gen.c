#include "gen.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "gen_kernels.h"

/* As many primes are below 2^32, where bases are. */
enum { PRIMES = 203280221 };

enum {
    START = KOKSMA_TAKES_START,
    BASES = KOKSMA_TAKES_BASES,
    DIGITS = KOKSMA_TAKES_DIGITS,
    MATRIX = KOKSMA_TAKES_MATRIX,
    SEED = KOKSMA_TAKES_SEED,
    VECTOR = KOKSMA_TAKES_VECTOR,
    ALPHA = KOKSMA_TAKES_ALPHA,
    RADIUS = KOKSMA_TAKES_RADIUS
};

const koksma_gen_family koksma_gen_families[] = {
    {"halton", "radical inverses in coprime bases, the first primes by default",
     "-", PRIMES, START | BASES | DIGITS, &ki_gen_halton},
    {"hammersley", "i/n, then halton", "-", PRIMES + 1, BASES | DIGITS,
     &ki_gen_hammersley},
    {"vandercorput", "the radical inverse in base 2, or in another", "-", 1,
     START | BASES | DIGITS, &ki_gen_halton},
    {"faure", "powers of Pascal's matrix in the least prime base >= dim", "-",
     65521, START | DIGITS, &ki_gen_faure},
    {"sobol", "digital sequence in base 2, Joe and Kuo's direction numbers", "-",
     KI_SOBOL_DIMS, START | DIGITS | MATRIX, &ki_gen_sobol},
    {"niederreiter", "digital sequence in base 2, irreducible polynomials", "-",
     KI_NIEDERREITER_DIMS, START | DIGITS | MATRIX, &ki_gen_niederreiter},
    {"richtmyer", "multiples of the square roots of primes, mod 1", "-", 1000000,
     START, &ki_gen_richtmyer},
    {"rsequence", "multiples of powers of a generalised golden ratio, mod 1", "-",
     10000, START, &ki_gen_rsequence},
    {"kronecker", "multiples of given numbers, mod 1", "vector of dim numbers",
     SIZE_MAX, START | ALPHA, &ki_gen_kronecker},
    {"lattice", "{i z/n} for a given vector z", "vector of dim whole numbers",
     SIZE_MAX, VECTOR, &ki_gen_lattice},
    {"korobov", "the lattice of 1, a, a^2, ... for a given a",
     "vector of 1 whole number", SIZE_MAX, VECTOR, &ki_gen_korobov},
    {"fibonacci", "the plane lattice of 1, F_(m-1)", "dim = 2, n = F_m", 2, 0,
     &ki_gen_fibonacci},
    {"zaremba", "hammersley with every other digit turned round",
     "dim = 2, n = 2^m", 2, 0, &ki_gen_zaremba},
    {"random", "independent and uniform", "-", SIZE_MAX, START | SEED,
     &ki_gen_random},
    {"grid", "{0,...,m-1}/m in each axis", "n = m^dim", SIZE_MAX, 0, &ki_gen_grid},
    {"centred", "{1/2,...,m-1/2}/m in each axis", "n = m^dim", SIZE_MAX, 0,
     &ki_gen_centred},
    {"jittered", "a random point in each cell of a grid", "n = m^dim", SIZE_MAX,
     SEED, &ki_gen_jittered},
    {"latin", "a random point in each of n strata of each axis (N-rooks)", "-",
     SIZE_MAX, SEED, &ki_gen_latin},
    {"multijittered", "jittered and latin", "n = m^dim", SIZE_MAX, SEED,
     &ki_gen_multijittered},
    {"poisson", "random points that keep a distance", "-", SIZE_MAX, SEED | RADIUS,
     &ki_gen_poisson},
    {NULL, NULL, NULL, 0, 0, NULL},
};

const koksma_gen_family *koksma_gen_find(const char *name)
{
    for (const koksma_gen_family *f = koksma_gen_families; f->name != NULL; f++)
        if (strcmp(f->name, name) == 0) return f;
    return NULL;
}

koksma_status koksma_gen_open(koksma_gen **out, const koksma_gen_family *family,
                              const koksma_gen_opts *opts, koksma_error *err)
{
    koksma_status status = ki_gen_check(family, opts, err);
    koksma_gen *g;

    if (status != KOKSMA_OK) return status;
    g = calloc(1, sizeof *g);
    if (g == NULL) return ki_fail_memory(err, "a generator");
    g->family = family;
    g->opts = *opts;
    if (family->kernel->prepare != NULL) status = family->kernel->prepare(g, err);
    g->opts.bases = NULL;
    g->opts.vector = NULL;
    g->opts.alpha = NULL;
    if (status != KOKSMA_OK) {
        koksma_gen_close(g);
        return status;
    }
    *out = g;
    return KOKSMA_OK;
}

void koksma_gen_close(koksma_gen *g)
{
    if (g == NULL) return;
    if (g->family->kernel->release != NULL)
        g->family->kernel->release(g->state);
    else
        free(g->state);
    free(g);
}

koksma_rng ki_gen_stream(const koksma_gen *g, uint64_t k)
{
    koksma_rng streams = koksma_rng_seed(g->opts.seed, g->opts.replicate);

    return koksma_rng_seed(koksma_rng_next(&streams), k);
}

uint32_t koksma_gen_net(const koksma_gen *g) { return g->net; }

static void fill_some(const koksma_gen *g, double *x, uint64_t first, size_t count)
{
    const koksma_gen_opts *o = &g->opts;
    size_t leaps = o->leap > 1 ? count : 0;

    for (size_t i = 0; i < leaps; i++)
        g->family->kernel->fill(g, x + i * o->dim, o->start + o->leap * (first + i),
                                1);
    if (leaps == 0) g->family->kernel->fill(g, x, o->start + first, count);
    if (o->scramble == KOKSMA_SCRAMBLE_SHIFT) ki_gen_shift(g, x, count);
    if (o->baker) ki_gen_fold(x, count * o->dim);
}

koksma_status koksma_gen_fill(const koksma_gen *g, double *x, uint64_t first,
                              size_t count, koksma_error *err)
{
    /* The kernels fill a coordinate at a time.  In blocks that stay in the cache
     * the rows are there when the next coordinate comes. */
    size_t block = 4096 / g->opts.dim + 16;

    if (first > g->opts.n || count > g->opts.n - first)
        return ki_fail(err, KOKSMA_EINVAL, 0, "points from %ju on: the set has %ju",
                       (uintmax_t)first, (uintmax_t)g->opts.n);
    for (size_t i = 0; i < count; i += block)
        fill_some(g, x + i * g->opts.dim, first + i,
                  count - i < block ? count - i : block);
    return KOKSMA_OK;
}
