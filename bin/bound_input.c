#include "bound_input.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "curve.h"

/* A table is small.  It is read into memory once, and each pair of columns from
 * there. */
typedef struct text {
    const char *file;
    char *bytes;
    size_t size;
} text;

_Noreturn static void fail(const text *t, const koksma_error *err)
{
    cli_input input = {.name = strcmp(t->file, "-") == 0 ? NULL : t->file};

    cli_fail_input(&input, err);
}

static text read_text(const char *file)
{
    bool standard = strcmp(file, "-") == 0;
    FILE *in = standard ? stdin : fopen(file, "rb");
    koksma_error err = {.status = KOKSMA_EIO};
    text t = {.file = file};
    size_t room = 0, got = 1;

    while (in != NULL && got > 0) {
        if (t.size + 4096 > room) {
            room = 2 * room + 8192;
            t.bytes = realloc(t.bytes, room);
            if (t.bytes == NULL)
                cli_fail("not enough memory for %s",
                         standard ? "standard input" : file);
        }
        got = fread(t.bytes + t.size, 1, 4096, in);
        t.size += got;
    }
    if (in == NULL || ferror(in)) {
        snprintf(err.text, sizeof err.text, "%s%s",
                 in != NULL && errno != EISDIR ? "cannot read: " : "",
                 strerror(errno));
        fail(&t, &err);
    }
    if (!standard) fclose(in);
    return t;
}

static koksma_status read_columns(koksma_table *table, const text *t, const char *x,
                                  const char *y, koksma_error *err)
{
    FILE *in = t->size > 0 ? fmemopen(t->bytes, t->size, "r") : NULL;
    koksma_status status = KOKSMA_EINVAL;

    *table = (koksma_table){0};
    if (in == NULL) return status;
    status = koksma_table_read(table, in, x, y, err);
    fclose(in);
    return status == KOKSMA_OK && table->rows == 0 ? KOKSMA_EINVAL : status;
}

/* Two columns; false where there are none of these names. */
static bool columns(koksma_table *table, const text *t, const char *x,
                    const char *y)
{
    koksma_error err;
    koksma_status status = read_columns(table, t, x, y, &err);

    if (status != KOKSMA_OK && status != KOKSMA_EINVAL) fail(t, &err);
    return status == KOKSMA_OK;
}

/* What the last row has in a column; NaN where there is none, or no number. */
static double last_of(const text *t, const char *anchor, const char *name)
{
    koksma_table table;
    double v = (double)NAN;

    if (read_columns(&table, t, anchor, name, NULL) == KOKSMA_OK)
        v = table.y[table.rows - 1];
    koksma_table_free(&table);
    return v;
}

/* ---- Curves ------------------------------------------------------------------ */

typedef struct pair {
    double n, value;
} pair;

static int by_n(const void *a, const void *b)
{
    double u = ((const pair *)a)->n, v = ((const pair *)b)->n;

    return (u > v) - (u < v);
}

/* One value for each N, where there are several: all of one N go to `join`. */
static bound_curve curve_of(const koksma_table *t,
                            double (*join)(const double *v, size_t count))
{
    pair *all = malloc(t->rows * sizeof *all);
    double *same = malloc(t->rows * sizeof *same);
    bound_curve c = {malloc(t->rows * sizeof *c.n),
                     malloc(t->rows * sizeof *c.value), 0};

    if (all == NULL || same == NULL || c.n == NULL || c.value == NULL)
        cli_fail("not enough memory for %zu rows", t->rows);
    for (size_t i = 0; i < t->rows; i++)
        all[i] = (pair){t->x[i], t->y[i]};
    qsort(all, t->rows, sizeof *all, by_n);
    for (size_t i = 0, count; i < t->rows; i += count) {
        for (count = 0; i + count < t->rows && all[i + count].n == all[i].n;
             count++)
            same[count] = all[i + count].value;
        c.n[c.count] = all[i].n;
        c.value[c.count++] = join(same, count);
    }
    free(all);
    free(same);
    return c;
}

/* Of several point sets the worst counts: what is proved is proved for all. */
static double largest(const double *v, size_t count)
{
    double most = v[0];

    for (size_t i = 1; i < count; i++)
        most = fmax(most, v[i]);
    return most;
}

static double root_mean_square(const double *v, size_t count)
{
    return koksma_curve_rms(v, count, 0.95).value;
}

double bound_at(const bound_curve *c, double n)
{
    for (size_t i = 0; i < c->count; i++)
        if (c->n[i] == n) return c->value[i];
    return (double)NAN;
}

static void free_curve(bound_curve *c)
{
    free(c->n);
    free(c->value);
    *c = (bound_curve){0};
}

void bound_curve_set(bound_curve *c, double n, double value)
{
    koksma_table one = {.x = &n, .y = &value, .rows = 1};

    free_curve(c);
    *c = curve_of(&one, largest);
}

void bound_input_free(bound_input *b)
{
    free_curve(&b->star);
    free_curve(&b->observed);
}

/* ---- The tools' tables ------------------------------------------------------- */

static void settle(double *to, double v)
{
    if (isnan(*to) && isfinite(v)) *to = v;
}

static void settle_dim(bound_input *b, const text *t, double dim)
{
    koksma_error err = {.status = KOKSMA_EINVAL};

    if (!(dim >= 1.0)) return;
    if (b->facts.dim == 0) b->facts.dim = (size_t)dim;
    if ((double)b->facts.dim == dim) return;
    snprintf(err.text, sizeof err.text,
             "%.0f coordinates, but the integrand has %zu", dim, b->facts.dim);
    fail(t, &err);
}

/* A word of a comment, safe to print. */
static bool said(const char *about, const char *key, char *word, size_t size)
{
    bool found = koksma_about_word(about, key, word, size);

    for (char *c = word; found && *c != '\0'; c++)
        if (!isgraph((unsigned char)*c)) *c = '?';
    return found;
}

_Noreturn static void fail_parameter(const text *t, const char *key,
                                     const char *about, const char *known)
{
    koksma_error err = {.status = KOKSMA_EINVAL};
    char here[KOKSMA_NUMBER_SIZE], there[KOKSMA_NUMBER_SIZE];

    koksma_about_word(about, key, here, sizeof here);
    koksma_about_word(known, key, there, sizeof there);
    snprintf(err.text, sizeof err.text, "%s is %s, but the integrand has %s", key,
             here, there);
    fail(t, &err);
}

/* The integrand is the one that was named, or the first that a comment names. */
static void check_integrand(bound_input *b, const text *t, const char *about)
{
    koksma_error err = {.status = KOKSMA_EINVAL};
    char name[32], known[32], piece[16], part[16] = "";
    const char *key;

    if (!said(about, "integrand", name, sizeof name)) return;
    if (b->about[0] == '\0') snprintf(b->about, sizeof b->about, "%s", about);
    said(b->about, "integrand", known, sizeof known);
    said(b->about, "piece", part, sizeof part);
    if (strcmp(name, known) != 0) {
        snprintf(err.text, sizeof err.text, "of %s, not of %s", name, known);
        fail(t, &err);
    }
    if (said(about, "piece", piece, sizeof piece) && strcmp(piece, part) != 0) {
        snprintf(err.text, sizeof err.text, "of the %s piece of %s alone", piece,
                 name);
        fail(t, &err);
    }
    key = cli_integrand_differs(name, about, b->about);
    if (key != NULL) fail_parameter(t, key, about, b->about);
}

/* What a comment says of it. */
static void read_about(bound_input *b, const text *t, const char *about)
{
    double dim;

    check_integrand(b, t, about);
    if (koksma_about_number(about, "dim", &dim)) settle_dim(b, t, dim);
}

/* koksma-l2 and koksma-edge write the columns of koksma-star, and say what of. */
static void check_measure(const text *t, const char *about)
{
    koksma_error err = {.status = KOKSMA_EINVAL};
    char measure[32];

    if (!said(about, "measure", measure, sizeof measure)) return;
    snprintf(err.text, sizeof err.text,
             "a table of koksma-%s, which does not bound D*", measure);
    fail(t, &err);
}

static bool read_star(bound_input *b, const text *t)
{
    koksma_table table;
    bool found = columns(&table, t, "n", "upper");

    if (found) {
        check_measure(t, table.about);
        read_about(b, t, table.about);
        free_curve(&b->star);
        b->star = curve_of(&table, largest);
        settle_dim(b, t, last_of(t, "n", "dim"));
    }
    koksma_table_free(&table);
    return found;
}

static bool read_variation(bound_input *b, const text *t)
{
    koksma_table table;
    bool found = columns(&table, t, "k", "variation");
    char trend[16] = "";

    if (found) read_about(b, t, table.about);
    if (found && koksma_about_word(table.about, "vhk_trend", trend, sizeof trend) &&
        b->facts.vhk_from == KOKSMA_VHK_UNKNOWN) {
        double cells = (double)NAN, growth = (double)NAN;

        b->facts.vhk_from =
            strcmp(trend, "diverging") == 0 ? KOKSMA_VHK_GROWS : KOKSMA_VHK_GRID;
        koksma_about_number(table.about, "vhk", &b->facts.vhk);
        koksma_about_number(table.about, "vhk_cells", &cells);
        koksma_about_number(table.about, "vhk_rate", &growth);
        b->cells = cells;
        b->growth = growth;
    }
    if (found) settle_dim(b, t, last_of(t, "k", "dim"));
    koksma_table_free(&table);
    return found;
}

/* The finest grid's row, which is the last. */
static bool read_cells(bound_input *b, const text *t)
{
    koksma_table table;
    bool found = columns(&table, t, "n", "K");

    if (found) {
        read_about(b, t, table.about);
        settle(&b->facts.extent, last_of(t, "n", "extent"));
        settle(&b->facts.area, last_of(t, "n", "area"));
        settle(&b->facts.jump, last_of(t, "n", "jump"));
        settle(&b->facts.jump_rms, last_of(t, "n", "jump_rms"));
        settle(&b->facts.axes, last_of(t, "n", "axes"));
    }
    koksma_table_free(&table);
    return found;
}

void bound_read_table(bound_input *b, const char *file)
{
    text t = read_text(file);
    koksma_error err = {
        KOKSMA_EFORMAT, 0,
        "no table of koksma-star, koksma-variation or koksma-cells, under the line "
        "that names its columns"};

    if (!read_variation(b, &t) && !read_cells(b, &t) && !read_star(b, &t))
        fail(&t, &err);
    free(t.bytes);
}

void bound_read_observed(bound_input *b, const char *file)
{
    text t = read_text(file);
    koksma_error err = {KOKSMA_EFORMAT, 0,
                        "no table of koksma-error, under the line that names its "
                        "columns"};
    koksma_table table;
    char word[16] = "";
    double v;

    if (!columns(&table, &t, "N", "error|rms")) fail(&t, &err);
    read_about(b, &t, table.about);
    b->observed = curve_of(&table, root_mean_square);
    b->unscrambled =
        koksma_about_word(table.about, "scramble", word, sizeof word) &&
        strcmp(word, "none") == 0 &&
        koksma_about_word(table.about, "points", word, sizeof word) &&
        strcmp(word, "random") != 0;
    if (koksma_about_number(table.about, "sigma", &v)) settle(&b->facts.sigma, v);
    if (koksma_about_number(table.about, "area", &v)) settle(&b->facts.area, v);
    if (koksma_about_number(table.about, "jump", &v)) {
        settle(&b->facts.jump, v);
        settle(&b->facts.jump_rms, v);
    }
    if (koksma_about_number(table.about, "extent", &v)) settle(&b->facts.extent, v);
    if (koksma_about_number(table.about, "axes", &v)) settle(&b->facts.axes, v);
    koksma_table_free(&table);
    free(t.bytes);
}
