#include <stdlib.h>

#include "error.h"
#include "gen_kernels.h"

/* Faure's sequences [Faure 1982]: in the least prime base b >= dim, digit j of
 * coordinate k is the sum over r >= j of C(r,j) k^(r-j) a_r modulo b, where the a_r
 * are the digits of the index and the coordinates count from 0. */

typedef struct faure {
    size_t dim;
    uint32_t base;
    unsigned digits;
    ki_radical *radical; /* of each coordinate */
    uint32_t *matrix; /* entry (j,r) of coordinate k: (k*digits + j)*digits + r */
} faure;

/* C(r,j) k^(r-j) = C(r-1,j-1) k^(r-j) + k C(r-1,j) k^(r-1-j), row by row. */
static void pascal(uint32_t *c, uint32_t b, unsigned digits, uint64_t k)
{
    for (unsigned j = 0; j < digits; j++)
        for (unsigned r = 0; r < digits; r++) {
            uint64_t left = r > j ? c[j * digits + r - 1] : 0;
            uint64_t above = j > 0 && r > 0 ? c[(j - 1) * digits + r - 1] : r == j;

            c[j * digits + r] = (uint32_t)((above + k * left) % b);
        }
}

static koksma_status scramble(koksma_gen *g, faure *f, koksma_error *err)
{
    for (size_t k = 0; k < f->dim; k++) {
        f->radical[k].base = f->base;
        if (ki_radical_scramble(&f->radical[k], g->opts.scramble,
                                ki_gen_stream(g, k)) != 0)
            return ki_fail_memory(err, "the digit permutations");
    }
    return KOKSMA_OK;
}

static koksma_status prepare(koksma_gen *g, koksma_error *err)
{
    faure *f = calloc(1, sizeof *f);
    size_t entries;

    if (f == NULL) return ki_fail_memory(err, "the matrices");
    g->state = f;
    f->dim = g->opts.dim;
    f->base = g->net = ki_next_prime(f->dim > 2 ? (uint32_t)f->dim : 2);
    f->digits = ki_radical_digits(f->base);
    if (ki_check_leap(g->opts.leap, f->base, err) != KOKSMA_OK)
        return KOKSMA_EINVAL;
    entries = (size_t)f->digits * f->digits;
    f->radical = calloc(f->dim, sizeof *f->radical);
    f->matrix = ki_alloc(f->dim, entries * sizeof *f->matrix);
    if (f->radical == NULL || f->matrix == NULL)
        return ki_fail_memory(err, "the matrices");
    for (size_t k = 0; k < f->dim; k++)
        pascal(f->matrix + k * entries, f->base, f->digits, k);
    return scramble(g, f, err);
}

static void release(void *state)
{
    faure *f = state;

    if (f == NULL) return;
    for (size_t k = 0; f->radical != NULL && k < f->dim; k++)
        free(f->radical[k].permutation);
    free(f->radical);
    free(f->matrix);
    free(f);
}

/* Entries and digits are below 2^16 and at most 64, so that no sum overflows. */
static void fill(const koksma_gen *g, double *x, uint64_t first, size_t count)
{
    const faure *f = g->state;
    uint32_t a[KI_DIGITS_MOST], y[KI_DIGITS_MOST] = {0};

    for (size_t i = 0; i < count; i++) {
        unsigned length = 0;

        for (uint64_t index = first + i; index > 0; index /= f->base)
            a[length++] = (uint32_t)(index % f->base);
        for (size_t k = 0; k < f->dim; k++) {
            const uint32_t *row = f->matrix + k * f->digits * f->digits;

            for (unsigned j = 0; j < f->digits; j++, row += f->digits) {
                uint64_t sum = 0;

                for (unsigned r = j; r < length; r++)
                    sum += (uint64_t)row[r] * a[r];
                y[j] = (uint32_t)(sum % f->base);
            }
            x[i * f->dim + k] = ki_radical_value(&f->radical[k], y, f->digits);
        }
    }
}

const ki_gen_kernel ki_gen_faure = {prepare, fill, release};
