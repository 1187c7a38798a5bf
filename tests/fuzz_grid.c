/* libFuzzer target: whatever bytes arrive as values on a grid, an array or a table,
 * their variation is a number from 0 on or a refusal; it is the same however many
 * values come at a time, and for the array's nodes as points in any order. */
#include <math.h>

#include "fuzz_npy.h"
#include "io_fixture.h"
#include "variation.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

enum { NODES_MOST = 4096 }; /* a header may claim any number of them */

static void must(bool holds)
{
    if (!holds) abort();
}

static void check_result(const koksma_variation_result *r, size_t dim,
                         const koksma_estimate *faces)
{
    double sum = 0.0, whole = r->level[r->levels - 1].value.value;

    must(r->levels >= 1 && r->levels <= KOKSMA_VARIATION_LEVELS_MOST);
    for (size_t i = 0; i < r->levels; i++)
        must(r->level[i].value.value >= 0.0 && isfinite(r->level[i].value.value));
    must(isnan(r->rate) || r->levels > 1);
    for (size_t u = 1; u < (size_t)1 << dim; u++) {
        must(faces[u].value >= 0.0);
        sum += faces[u].value;
    }
    must(fabs(sum - whole) <= 1e-9 * whole);
}

static void check_same(const koksma_variation_result *a,
                       const koksma_variation_result *b)
{
    must(a->levels == b->levels && a->trend == b->trend);
    for (size_t i = 0; i < a->levels; i++)
        must(bits_of(a->level[i].value.value) == bits_of(b->level[i].value.value));
}

/* Values as a reader hands them out, `step` at a time. */
static koksma_status vary(koksma_variation_result *r, koksma_estimate *faces,
                          const koksma_axes *axes, const double *v, size_t count,
                          size_t step)
{
    koksma_variation_grid *g = NULL;
    koksma_error err = {0};
    koksma_status status =
        koksma_variation_open(&g, axes->length, axes->count, &err);

    for (size_t i = 0; i < count && status == KOKSMA_OK; i += step)
        status = koksma_variation_add(g, v + i, count - i < step ? count - i : step,
                                      &err);
    if (status == KOKSMA_OK) status = koksma_variation_finish(r, faces, g, &err);
    must(status == KOKSMA_OK || (err.status == status && err.text[0] != '\0'));
    koksma_variation_close(g);
    return status;
}

/* The nodes at i/(nodes - 1), the last one first. */
static void check_points(const koksma_variation_result *want,
                         const koksma_axes *axes, const double *v, size_t count)
{
    double *x = malloc(count * axes->count * sizeof *x);
    double *f = malloc(count * sizeof *f);
    koksma_variation_result r;

    must(x != NULL && f != NULL);
    for (size_t i = 0; i < count; i++) {
        size_t node = count - 1 - i;

        f[i] = v[node];
        for (size_t j = axes->count; j-- > 0; node /= axes->length[j])
            x[i * axes->count + j] =
                (double)(node % axes->length[j]) / (double)(axes->length[j] - 1);
    }
    must(koksma_variation_points(&r, NULL, (koksma_points){x, count, axes->count},
                                 f, NULL) == KOKSMA_OK);
    check_same(want, &r);
    free(x);
    free(f);
}

/* Returns whether the reader can go on. */
static bool check_array(koksma_reader *r, size_t columns, const koksma_axes *axes)
{
    static double v[NODES_MOST + 1];
    koksma_estimate *faces = NULL;
    koksma_variation_result whole, single;
    size_t nodes = 1, count = 0, got = 1;
    koksma_status status;

    must(axes->count <= KOKSMA_AXES_MOST);
    for (size_t j = 0; j < axes->count; j++)
        if (axes->length[j] > NODES_MOST || (nodes *= axes->length[j]) > NODES_MOST)
            return false;
    must(columns == (axes->count > 1 ? axes->length[axes->count - 1] : 1));
    for (; got > 0; count += got * columns)
        if (koksma_reader_rows(r, v + count, nodes / columns + 1 - count / columns,
                               &got, NULL) != KOKSMA_OK)
            return false;
    must(count == nodes);
    if (axes->count <= KOKSMA_VARIATION_DIM_MOST) {
        faces = malloc(((size_t)1 << axes->count) * sizeof *faces);
        must(faces != NULL);
    }
    status = vary(&whole, faces, axes, v, count, count);
    must(vary(&single, NULL, axes, v, count, 1) == status);
    if (status == KOKSMA_OK) {
        check_result(&whole, axes->count, faces);
        check_same(&whole, &single);
        check_points(&whole, axes, v, count);
    }
    free(faces);
    return true;
}

static bool check_table(koksma_reader *r)
{
    static koksma_estimate faces[1 << KOKSMA_VARIATION_DIM_MOST];
    koksma_variation_result result;
    koksma_set set = {0};
    bool more = koksma_set_read(&set, r, NULL) == KOKSMA_OK && set.n > 0;

    if (more && koksma_variation_points(&result, faces, koksma_set_view(&set),
                                        set.f, NULL) == KOKSMA_OK)
        check_result(&result, set.dim, faces);
    koksma_set_free(&set);
    return more;
}

/* With `a` first the others are arrays, framed as in fuzz_npy.h. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    char *file = NULL;
    koksma_reader *r;
    size_t columns;
    FILE *in;
    bool more = true;

    if (size == 0) return 0;
    if (bytes[0] == 'a') {
        size_t length = npy_of(&file, bytes + 1, size - 1, 1);

        in = stream_of(file, length);
    } else {
        in = stream_of(bytes + 1, size - 1);
    }
    r = reader_of(in, KOKSMA_GRID);
    while (more && koksma_reader_next(r, &columns, NULL) == KOKSMA_OK &&
           columns > 0) {
        koksma_axes axes = koksma_reader_axes(r);

        more = axes.count > 0 ? check_array(r, columns, &axes) : check_table(r);
    }
    koksma_reader_close(r);
    fclose(in);
    free(file);
    return 0;
}
