/* How fast numbers are written and read, to and from a temporary file.  value:
 * numbers that came back different, 0. */

#include <string.h>

#include "bench.h"
#include "gen.h"
#include "io.h"

enum { N = 1000000, DIM = 2 };

static void write_points(FILE *file, const double *x, koksma_form form)
{
    if (form == KOKSMA_NPY)
        bench_must(koksma_write_npy_header(file, N, DIM, NULL),
                   "koksma_write_npy_header");
    bench_must(koksma_write_rows(file, x, N, DIM, form, NULL), "koksma_write_rows");
    fflush(file);
}

static void bench(const char *name, const double *x, koksma_form form)
{
    FILE *file = tmpfile();
    koksma_reader *reader;
    koksma_set set = {0};
    char label[64];
    double started = bench_now(), bytes, wrong = 0.0;

    if (file == NULL) bench_must(1, "tmpfile");
    write_points(file, x, form);
    bytes = (double)ftell(file);
    snprintf(label, sizeof label, "write %s", name);
    bench_row(label, started, N * DIM, "numbers", 0.0);

    rewind(file);
    started = bench_now();
    bench_must(koksma_reader_open(&reader, file, KOKSMA_POINTS, NULL),
               "koksma_reader_open");
    bench_must(koksma_set_read(&set, reader, NULL), "koksma_set_read");
    for (size_t i = 0; i < N * DIM; i++)
        wrong += set.x[i] != x[i];
    snprintf(label, sizeof label, "read %s", name);
    bench_row(label, started, N * DIM, "numbers", wrong);
    snprintf(label, sizeof label, "read %s again", name);
    koksma_reader_close(reader);
    rewind(file);
    started = bench_now();
    bench_must(koksma_reader_open(&reader, file, KOKSMA_POINTS, NULL),
               "koksma_reader_open");
    bench_must(koksma_set_read(&set, reader, NULL), "koksma_set_read");
    bench_row(label, started, bytes / 1e6, "MB", wrong);
    koksma_reader_close(reader);
    koksma_set_free(&set);
    fclose(file);
}

int main(void)
{
    double *x = bench_alloc(N * DIM, sizeof *x);
    koksma_gen_opts o = {.dim = DIM, .n = N, .seed = 1};
    koksma_gen *g;

    bench_must(koksma_gen_open(&g, koksma_gen_find("random"), &o, NULL),
               "koksma_gen_open");
    bench_must(koksma_gen_fill(g, x, 0, N, NULL), "koksma_gen_fill");
    koksma_gen_close(g);
    bench_header();
    bench("text", x, KOKSMA_DECIMAL);
    bench("hex", x, KOKSMA_HEX);
    bench("npy", x, KOKSMA_NPY);
    free(x);
    return EXIT_SUCCESS;
}
