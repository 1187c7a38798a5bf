#include "gen.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "gen_kernels.h"

/* As many primes are below 2^32, where bases are. */
enum { PRIMES = 203280221 };

const koksma_gen_family koksma_gen_families[] = {
    {"halton", "radical inverses in coprime bases, the first primes by default",
     PRIMES, true, true, false, &ki_gen_halton},
    {"hammersley", "i/n, then halton", PRIMES + 1, false, true, false,
     &ki_gen_hammersley},
    {"sobol", "digital sequence in base 2, Joe and Kuo's direction numbers", 50,
     true, false, false, &ki_gen_sobol},
    {"random", "independent and uniform", SIZE_MAX, true, false, true,
     &ki_gen_random},
    {"grid", "{0,...,m-1}/m in each axis, n = m^dim", SIZE_MAX, false, false, false,
     &ki_gen_grid},
    {"centred", "{1/2,...,m-1/2}/m in each axis, n = m^dim", SIZE_MAX, false, false,
     false, &ki_gen_centred},
    {NULL, NULL, 0, false, false, false, NULL},
};

const koksma_gen_family *koksma_gen_find(const char *name)
{
    for (const koksma_gen_family *f = koksma_gen_families; f->name != NULL; f++)
        if (strcmp(f->name, name) == 0) return f;
    return NULL;
}

static koksma_status check(const koksma_gen_family *f, const koksma_gen_opts *o,
                           koksma_error *err)
{
    if (o->dim < 1 || o->dim > f->max_dim)
        return ki_fail(err, KOKSMA_EINVAL, 0, "dimension %zu: %s has 1 to %zu",
                       o->dim, f->name, f->max_dim);
    if (o->n == 0)
        return ki_fail(err, KOKSMA_EINVAL, 0, "0 points: a set has at least one");
    if (!f->sequence && o->start > 0)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "%s is no sequence: it has no start index", f->name);
    if (o->n - 1 > UINT64_MAX - o->start)
        return ki_fail(err, KOKSMA_EINVAL, 0, "indices reach beyond 2^64 - 1");
    if (!f->bases && o->bases != NULL)
        return ki_fail(err, KOKSMA_EINVAL, 0, "%s has no bases", f->name);
    if (!f->bases && o->scramble != KOKSMA_SCRAMBLE_NONE)
        return ki_fail(err, KOKSMA_EINVAL, 0, "%s has no digits to scramble",
                       f->name);
    return KOKSMA_OK;
}

koksma_status koksma_gen_open(koksma_gen **out, const koksma_gen_family *family,
                              const koksma_gen_opts *opts, koksma_error *err)
{
    koksma_status status = check(family, opts, err);
    koksma_gen *g;

    if (status != KOKSMA_OK) return status;
    g = calloc(1, sizeof *g);
    if (g == NULL) return ki_fail_memory(err, "a generator");
    g->family = family;
    g->opts = *opts;
    if (family->kernel->prepare != NULL) status = family->kernel->prepare(g, err);
    g->opts.bases = NULL;
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

/* The kernels fill a coordinate at a time.  In blocks that stay in the cache the
 * rows are there when the next coordinate comes. */
static void fill_blocks(const koksma_gen *g, double *x, uint64_t first,
                        size_t count)
{
    size_t block = 8192 / g->opts.dim + 16;

    for (size_t i = 0; i < count; i += block) {
        size_t now = count - i < block ? count - i : block;

        g->family->kernel->fill(g, x + i * g->opts.dim, first + i, now);
    }
}

koksma_status koksma_gen_fill(const koksma_gen *g, double *x, uint64_t first,
                              size_t count, koksma_error *err)
{
    if (first > g->opts.n || count > g->opts.n - first)
        return ki_fail(err, KOKSMA_EINVAL, 0, "points from %ju on: the set has %ju",
                       (uintmax_t)first, (uintmax_t)g->opts.n);
    fill_blocks(g, x, g->opts.start + first, count);
    return KOKSMA_OK;
}
