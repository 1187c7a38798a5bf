#include <math.h>
#include <stdlib.h>

#include "cells_report.h"

/* Tables of points: what their cells have, and how samples in them differ. */

typedef struct sets {
    cells_options *o;
    const cli_input *input; /* NULL: a family */
    const double *f;        /* the values, where there are any */
    uint64_t *cells;
    bool told; /* how little samples say */
} sets;

static void column(double v)
{
    putchar('\t');
    cli_number(v);
}

static void choose_grid(sets *s, uint64_t n, size_t dim)
{
    const uint32_t *bases = cells_bases(s->o, dim);
    koksma_error err;

    free(s->cells);
    s->cells = malloc(dim * sizeof *s->cells);
    if (s->cells == NULL) cli_fail("not enough memory");
    if (koksma_grid_choose(s->cells, n, dim, bases, &err))
        cli_usage("%s", err.text);
}

static void print_label(const sets *s)
{
    if (s->input != NULL && s->input->several) printf("%s\t", s->input->label);
}

static void print_header(const sets *s)
{
    if (cli_quiet()) return;
    printf("# %sn\tk\tcells\t",
           s->input != NULL && s->input->several ? "input\t" : "");
    puts(s->o->occupancy ? "least\tmost\tempty\tempty_share"
                         : "empty\tpairs\tchanges\tK\tV\tM\textent\textent_lower\t"
                           "extent_upper\tjump_rms\tbias");
}

/* ---- Occupancy --------------------------------------------------------------- */

static void print_occupancy(const sets *s, uint64_t n, size_t dim,
                            koksma_occupancy r)
{
    print_label(s);
    cells_print_grid(n, s->cells, dim);
    printf("\t%ju\t%ju\t%ju", (uintmax_t)r.least, (uintmax_t)r.most,
           (uintmax_t)r.empty);
    column((double)r.empty / (double)r.total);
    putchar('\n');
}

static void occupy(sets *s, koksma_points p)
{
    koksma_occupancy r;
    koksma_error err;

    choose_grid(s, p.n, p.dim);
    if (koksma_cells_occupancy(&r, p, s->cells, &err))
        cli_fail_input(s->input, &err);
    print_occupancy(s, p.n, p.dim, r);
}

void cells_halton(cells_options *o, size_t dim)
{
    static const uint64_t usual = 1 << 10;
    const uint64_t *n = o->count > 0 ? o->n : &usual;
    sets s = {.o = o};
    koksma_error err;

    if (dim > KOKSMA_GRID_BASES_MOST)
        cli_usage("--family takes at most %d coordinates", KOKSMA_GRID_BASES_MOST);
    print_header(&s);
    for (size_t i = 0; i < (o->count > 0 ? o->count : 1); i++) {
        koksma_occupancy r;

        choose_grid(&s, n[i], dim);
        if (koksma_cells_occupancy_halton(&r, o->start, n[i], dim, o->bases,
                                          s.cells, &err))
            cli_fail_as(&err);
        print_occupancy(&s, n[i], dim, r);
    }
    free(s.cells);
}

/* ---- Samples ----------------------------------------------------------------- */

/* What differences count, unless it was told: where there are two values, any.
 * With more, nothing but the user can tell a jump from a slope. */
static double least_change(const sets *s, size_t n)
{
    double one = s->f[0], other = one;

    if (s->o->jump >= 0.0) return s->o->jump;
    for (size_t i = 0; i < n; i++) {
        if (s->f[i] == one || s->f[i] == other) continue;
        if (other != one)
            cli_fail("set %s has more than two values; --jump says which "
                     "differences are jumps",
                     s->input->label);
        other = s->f[i];
    }
    return 0.5 * fabs(other - one);
}

static void sample(sets *s, koksma_points p)
{
    koksma_samples_result r;
    koksma_error err;
    double k, share;
    uint64_t total;

    choose_grid(s, p.n, p.dim);
    if (koksma_samples(&r, p, s->f, s->cells, least_change(s, p.n), &err))
        cli_fail_input(s->input, &err);
    print_label(s);
    total = cells_print_grid(p.n, s->cells, p.dim);
    k = pow((double)total, 1.0 / (double)p.dim);
    share = fmin(r.extent.value / k, 1.0);
    printf("\t%ju\t%ju\t%ju", (uintmax_t)r.empty, (uintmax_t)r.pairs,
           (uintmax_t)r.changes);
    column(share * (double)total);
    column(share);
    column(share * (double)p.n);
    column(r.extent.value);
    column(r.extent.lower);
    column(r.extent.upper);
    column(r.jump_rms);
    column(r.bias);
    putchar('\n');
    if (!s->told)
        cli_note("from samples alone: whatever is smaller than some cells is not "
                 "seen, and a steep slope counts as a jump");
    s->told = true;
}

/* ---- Sets -------------------------------------------------------------------- */

/* The whole set, or its first n points for each n. */
static void measure(sets *s, const koksma_set *set)
{
    koksma_points p = koksma_set_view(set);
    size_t count = s->o->count > 0 ? s->o->count : 1;

    for (size_t i = 0; i < count; i++) {
        if (s->o->count > 0 && s->o->n[i] > set->n)
            cli_fail("set %s has %zu point%s, and -n asks for %ju", s->input->label,
                     set->n, cli_plural(set->n), (uintmax_t)s->o->n[i]);
        if (s->o->count > 0) p.n = (size_t)s->o->n[i];
        if (s->o->occupancy)
            occupy(s, p);
        else
            sample(s, p);
    }
}

void cells_sets(cells_options *o, cli_input *input)
{
    sets s = {.o = o, .input = input};
    koksma_set set = {0};
    bool header = false;

    while (cli_read_set(input, &set)) {
        if (!header) print_header(&s);
        header = true;
        s.f = set.f;
        measure(&s, &set);
    }
    koksma_set_free(&set);
    free(s.cells);
}
