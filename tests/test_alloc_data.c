/* Out of memory at every allocation, as in test_alloc.c: generators of all
 * families, and readers of all that there is to read. */

#define _GNU_SOURCE /* fopencookie */
#include "alloc_fixture.h"

#include "gen.h"
#include "io.h"
#include "oracle.h"

/* ---- Generators ----------------------------------------------------------- */

typedef struct made {
    const koksma_gen_family *family;
    koksma_scramble scramble;
} made;

static koksma_status gen_job(const void *what, koksma_error *err)
{
    static const double alpha[] = {0.1, 0.2};
    static const uint64_t vector[] = {1, 2};
    static const uint32_t bases[] = {3, 5};
    const made *m = what;
    koksma_gen_opts o = {.dim = m->family->max_dim > 1 ? 2 : 1, .n = 4, .seed = 1};
    koksma_gen *g = NULL, *before = NULL;
    double x[8];
    koksma_status status;

    o.scramble = m->scramble;
    if (m->family->takes & KOKSMA_TAKES_ALPHA) o.alpha = alpha, o.alpha_size = 2;
    if (m->family->takes & KOKSMA_TAKES_BASES) o.bases = bases;
    if (m->family->takes & KOKSMA_TAKES_VECTOR)
        o.vector = vector,
        o.vector_size = strcmp(m->family->name, "korobov") ? 2 : 1;
    if (strcmp(m->family->name, "fibonacci") == 0) o.n = 3;
    status =
        kept(koksma_gen_open(&g, m->family, &o, err), &g, &before, sizeof(void *));
    if (status == KOKSMA_OK) status = koksma_gen_fill(g, x, 0, 1, err);
    koksma_gen_close(g);
    return status;
}

/* Whether the family takes it; what it refuses it may refuse without memory. */
static bool takes(const koksma_gen_family *family, koksma_scramble scramble)
{
    switch (scramble) {
    case KOKSMA_SCRAMBLE_DIGITS:
    case KOKSMA_SCRAMBLE_OWEN: return family->takes & KOKSMA_TAKES_DIGITS;
    case KOKSMA_SCRAMBLE_MATRIX: return family->takes & KOKSMA_TAKES_MATRIX;
    case KOKSMA_SCRAMBLE_NONE:
    case KOKSMA_SCRAMBLE_SHIFT: break;
    }
    return true;
}

START_TEST(generators)
{
    size_t jobs = 0;

    for (const koksma_gen_family *f = koksma_gen_families; f->name != NULL; f++)
        for (koksma_scramble s = KOKSMA_SCRAMBLE_NONE; s <= KOKSMA_SCRAMBLE_SHIFT;
             s++) {
            made m = {f, s};

            if (!takes(f, s)) continue;
            ck_assert_msg(exhaust(gen_job, &m, f->name) >= 1, "%s", f->name);
            jobs++;
        }
    ck_assert_uint_ge(jobs, 40);
}
END_TEST

/* ---- Readers -------------------------------------------------------------- */

typedef struct input {
    const char *bytes;
    size_t size;
    koksma_content content;
    size_t signal; /* comes after so many bytes; 0: never */
} input;

#ifdef __GLIBC__ /* where a line goes on after a signal */
enum { SIGNALS = true };

typedef struct rude {
    const input *in;
    size_t at;
    bool interrupted;
} rude;

static ssize_t give(void *state, char *to, size_t room)
{
    rude *r = state;
    size_t end = r->interrupted ? r->in->size : r->in->signal, now = end - r->at;

    if (now == 0 && !r->interrupted) {
        r->interrupted = true;
        errno = EINTR;
        return -1;
    }
    if (now > room) now = room;
    memcpy(to, r->in->bytes + r->at, now);
    r->at += now;
    return (ssize_t)now;
}

/* One at a time. */
static FILE *interrupted(const input *in)
{
    static rude r;

    r = (rude){.in = in};
    return fopencookie(&r, "r", (cookie_io_functions_t){.read = give});
}
#else
enum { SIGNALS = false };

static FILE *interrupted(const input *in) { return (void)in, NULL; }
#endif

/* To open a stream allocates, and is no part of the library. */
static FILE *open_input(const input *in)
{
    long saved = atomic_exchange(&granted, -1);
    FILE *f = in->signal > 0
                  ? interrupted(in)
                  : fmemopen((void *)(uintptr_t)in->bytes, in->size, "r");

    atomic_store(&granted, saved);
    return f;
}

/* All sets, whole. */
static koksma_status sets_job(const void *what, koksma_error *err)
{
    const input *i = what;
    koksma_set set = {0};
    koksma_reader *r = NULL, *before = NULL;
    FILE *in = open_input(i);
    koksma_status status = kept(koksma_reader_open(&r, in, i->content, err), &r,
                                &before, sizeof(void *));

    while (status == KOKSMA_OK) {
        status = koksma_set_read(&set, r, err);
        if (status != KOKSMA_OK && set.n != 0) changed = true;
        if (set.n == 0) break;
    }
    koksma_reader_close(r);
    koksma_set_free(&set);
    fclose(in);
    return status;
}

/* One row of each set: the reader goes past the others by itself. */
static koksma_status rows_job(const void *what, koksma_error *err)
{
    const input *i = what;
    koksma_reader *r = NULL;
    FILE *in = open_input(i);
    koksma_status status = koksma_reader_open(&r, in, i->content, err);
    double row[8];
    size_t columns = 1, got;

    while (status == KOKSMA_OK && columns > 0) {
        size_t before = columns;

        status = kept(koksma_reader_next(r, &columns, err), &columns, &before,
                      sizeof before);
        if (status != KOKSMA_OK || columns == 0) break;
        got = before = 77;
        status = kept(koksma_reader_rows(r, row, 1, &got, err), &got, &before,
                      sizeof got);
    }
    koksma_reader_close(r);
    fclose(in);
    return status;
}

#define TEXT(text, content)                                                        \
    (input) { text, sizeof(text) - 1, content, 0 }

START_TEST(text)
{
    input points = TEXT("# a comment\n0.5 1\n0.25 1\n0 0\n\n0.5 0.5\n", 0);
    input values = TEXT("# koksma: a=1\n0.5 7\n1 8\n\n0.5 0.5 7\n", KOKSMA_VALUES);
    input grid = TEXT("0 1\n1 2", KOKSMA_GRID);

    ck_assert_int_ge(exhaust(sets_job, &points, "points"), 8);
    ck_assert_int_ge(exhaust(rows_job, &points, "rows"), 8);
    ck_assert_int_ge(exhaust(sets_job, &values, "values"), 8);
    ck_assert_int_ge(exhaust(sets_job, &grid, "grid"), 6);
}
END_TEST

/* A signal cuts a line in two: what goes on has more to say than the room that the
 * first half took. */
START_TEST(interrupted_text)
{
    static char line[4000];
    input i = {line, sizeof line, KOKSMA_POINTS, 20};

    memset(line, ' ', sizeof line);
    memcpy(line, "0.5 0.25", 8);
    memcpy(line + sizeof line - 6, "0.125\n", 6);
    ck_assert_int_ge(exhaust(sets_job, &i, "a line and a signal"), 6);
    ck_assert_int_ge(exhaust(rows_job, &i, "a line and a signal"), 6);
}
END_TEST

/* Two arrays of two by two. */
static input npy(char file[320], const char *order, koksma_content content)
{
    static const double rows[] = {0.5, 0.25, 1.0, 0.0};

    for (char *s = file; s < file + 320; s += 160) {
        memset(s, ' ', 128);
        memcpy(s, "\x93NUMPY\x01\x00\x76\x00", 10);
        snprintf(s + 10, 117,
                 "{'descr': '<f8', 'fortran_order': %s, 'shape': (2, 2), }", order);
        s[10 + strlen(s + 10)] = ' ';
        s[127] = '\n';
        memcpy(s + 128, rows, sizeof rows);
    }
    return (input){file, 320, content, 0};
}

START_TEST(arrays)
{
    static const char *const orders[] = {"False", "True"};
    static const koksma_content contents[] = {KOKSMA_POINTS, KOKSMA_VALUES,
                                              KOKSMA_GRID};
    char file[320];

    for (size_t o = 0; o < 2; o++)
        for (size_t c = 0; c < 3; c++) {
            input i = npy(file, orders[o], contents[c]);

            ck_assert_int_ge(exhaust(sets_job, &i, orders[o]),
                             o == 1 && c < 2 ? 7 : 4);
            ck_assert_int_ge(exhaust(rows_job, &i, orders[o]),
                             o == 1 && c < 2 ? 7 : 4);
        }
}
END_TEST

static koksma_status table_job(const void *what, koksma_error *err)
{
    koksma_table table, before;
    FILE *in = open_input(what);
    koksma_status status;

    memset(&table, 0, sizeof table);
    memcpy(&before, &table, sizeof table);
    status = kept(koksma_table_read(&table, in, "N", "error", err), &table, &before,
                  sizeof table);
    koksma_table_free(&table);
    fclose(in);
    return status;
}

START_TEST(tables)
{
    input labels = TEXT("# set N error\na 8 0.5\na 9 1\n\nb 8 0.25\n", 0);
    input plain = TEXT("# koksma: dim=2\n# N error\n8 0.5\n", 0);

    ck_assert_int_ge(exhaust(table_job, &labels, "labels"), 12);
    ck_assert_int_ge(exhaust(table_job, &plain, "table"), 7);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("alloc_data");
    TCase *tc = tcase_create("memory");

    tcase_add_test(tc, generators);
    tcase_add_test(tc, text);
    if (SIGNALS) tcase_add_test(tc, interrupted_text);
    tcase_add_test(tc, arrays);
    tcase_add_test(tc, tables);
    suite_add_tcase(suite, tc);
    return oracle_run(suite);
}
