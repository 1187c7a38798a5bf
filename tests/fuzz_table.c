/* libFuzzer target: whatever bytes arrive, reading them as a table ends; what is
 * read is finite, its sets are numbered as they appear, and, written as a table, it
 * is read the same by name and by number.  A fit of it is one, or a refusal. */
#include <math.h>

#include "fit.h"
#include "io_fixture.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

static void must(bool holds)
{
    if (!holds) abort();
}

static void check_table(const koksma_table *t)
{
    size_t sets = 0;

    for (size_t i = 0; i < t->rows; i++) {
        must(isfinite(t->x[i]) && isfinite(t->y[i]));
        must(t->set[i] <= sets); /* the next new one, or one of before */
        sets += t->set[i] == sets;
    }
    must(t->sets == sets);
    must(t->labelled || t->sets <= 1);
    must(memchr(t->about, '\0', sizeof t->about) != NULL);
}

static void check_same(const koksma_table *a, const koksma_table *b)
{
    must(a->rows == b->rows && a->sets == b->sets);
    for (size_t i = 0; i < a->rows; i++)
        must(bits_of(a->x[i]) == bits_of(b->x[i]) &&
             bits_of(a->y[i]) == bits_of(b->y[i]) && a->set[i] == b->set[i]);
}

static void check_written(const koksma_table *t)
{
    char *bytes = NULL, number[KOKSMA_NUMBER_SIZE];
    size_t size = 0;
    FILE *out = open_memstream(&bytes, &size), *in;
    koksma_table again = {0};

    must(out != NULL);
    fputs("# y set word x\n", out);
    for (size_t i = 0; i < t->rows; i++) {
        koksma_format_number(number, t->y[i]);
        fprintf(out, "%s\tset%zu\tword\t%a\n\n", number, t->set[i], t->x[i]);
    }
    fclose(out);
    in = stream_of(bytes, size);
    must(koksma_table_read(&again, in, "x", "y", NULL) == KOKSMA_OK);
    check_same(t, &again);
    rewind(in);
    must(koksma_table_read(&again, in, "4", "1", NULL) == KOKSMA_OK);
    check_same(t, &again);
    koksma_table_free(&again);
    fclose(in);
    free(bytes);
}

static void check_fit(const koksma_table *t)
{
    koksma_fit_data d = {t->x, t->y, t->set, t->rows, t->sets};

    for (koksma_fit_model m = KOKSMA_FIT_AUTO; m <= KOKSMA_FIT_TWO_POWERS; m++) {
        koksma_fit_opts o = {.model = m};
        koksma_fit_result f = {.used = 0};
        koksma_error err = {0};
        koksma_status status = koksma_fit(&f, d, &o, &err);

        must((status == KOKSMA_OK) == (f.used >= 3));
        if (status == KOKSMA_OK) {
            must(f.model != KOKSMA_FIT_AUTO && f.sets == t->sets);
            must(f.from > 0.0 && f.from < f.to && isfinite(f.to));
            must(f.used + f.missing + f.zero + f.below_floor <= t->rows);
        } else {
            must(status == KOKSMA_EINVAL || status == KOKSMA_EDOMAIN);
            must(err.status == status && err.text[0] != '\0');
        }
    }
}

/* A failure says why, and leaves the table of before. */
static void check_failure(const koksma_table *t, koksma_status status,
                          const koksma_error *err)
{
    must(t->rows == 0 && t->x == NULL && t->y == NULL && t->set == NULL);
    must(err->status == status);
    must(memchr(err->text, '\0', sizeof err->text) != NULL && err->text[0] != '\0');
    must(strchr(err->text, '\n') == NULL);
}

/* The first byte says which columns are wanted. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    static const char *const wanted[][2] = {{"1", "2"}, {"x", "y"},   {"2", "1"},
                                            {"y", "3"}, {"set", "x"}, {"2", "2"}};
    koksma_table t = {0};
    koksma_error err = {0};
    double v;
    char word[5];

    if (size == 0) return 0;

    const char *const *columns = wanted[bytes[0] % 6];
    FILE *in = stream_of(bytes + 1, size - 1);
    koksma_status status = koksma_table_read(&t, in, columns[0], columns[1], &err);

    if (status == KOKSMA_OK) {
        check_table(&t);
        check_written(&t);
        if (t.rows <= 1024) check_fit(&t);
        (void)koksma_about_number(t.about, "x", &v);
        if (koksma_about_word(t.about, "x", word, sizeof word))
            must(strlen(word) < sizeof word);
    } else {
        check_failure(&t, status, &err);
    }
    koksma_table_free(&t);
    fclose(in);
    return 0;
}
