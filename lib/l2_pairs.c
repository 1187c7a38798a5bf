#include <stdlib.h>

#include "error.h"
#include "l2_kernels.h"

/* Every pair of points, by symmetry every second one: blocks of rows, each against
 * the panels of columns from its own on.  Those of the block itself see every pair
 * of it, the later ones count twice. */

enum { BLOCK = KI_L2_PANEL * KI_L2_BLOCK };

/* Above so many coordinates products may leave the range of doubles. */
enum { PLAIN_DIM = 200 };

typedef struct pairs {
    ki_l2_job *job;
    double *panels;
    size_t panel_size;    /* numbers in one */
    ki_twice *sum;        /* of each block */
    bool scaled, nothing; /* nothing: K is 0 everywhere */
    int64_t e;
} pairs;

static void fill_panels(pairs *s)
{
    koksma_points p = s->job->p;
    size_t arrays = (size_t)s->job->row->arrays;

    for (size_t i = 0; i < p.n; i++) {
        double *panel = s->panels + i / KI_L2_PANEL * s->panel_size;

        for (size_t k = 0; k < p.dim; k++) {
            double number[2];

            ki_l2_prepare(s->job->kind, p.x[i * p.dim + k], number);
            for (size_t j = 0; j < arrays; j++)
                panel[(k * arrays + j) * KI_L2_PANEL + i % KI_L2_PANEL] = number[j];
        }
    }
}

/* K is positive definite, so that none of its values at two points is above the
 * greatest at one. */
static void find_unit(pairs *s)
{
    koksma_points p = s->job->p;
    bool any = false;

    s->scaled = p.dim > PLAIN_DIM;
    for (size_t i = 0; s->scaled && i < p.n; i++) {
        ki_l2_number v = ki_l2_diagonal(s->job->kind,
                                        s->panels + i / KI_L2_PANEL * s->panel_size,
                                        i % KI_L2_PANEL, p.dim);

        if (v.m.hi == 0.0 || (any && v.e <= s->e)) continue;
        s->e = v.e;
        any = true;
    }
    s->nothing = s->scaled && !any;
}

static void work_on(void *state, size_t worker, size_t task)
{
    pairs *s = state;
    koksma_points p = s->job->p;
    size_t first = task * BLOCK, rows = p.n - first < BLOCK ? p.n - first : BLOCK;
    ki_l2_tile t = {.rows = s->panels + task * KI_L2_BLOCK * s->panel_size,
                    .row_count = rows,
                    .dim = p.dim,
                    .e = s->e,
                    .scaled = s->scaled};
    ki_twice sum = {0.0, 0.0};

    (void)worker;
    for (size_t j = first; j < p.n && !ki_team_stopped(s->job->team);
         j += KI_L2_PANEL) {
        ki_twice v;

        t.columns = s->panels + j / KI_L2_PANEL * s->panel_size;
        t.column_count = p.n - j < KI_L2_PANEL ? p.n - j : KI_L2_PANEL;
        v = ki_l2_tile_sums[s->job->kind](&t);
        sum = ki_twice_add(sum, ki_twice_scale(v, j < first + BLOCK ? 1.0 : 2.0));
    }
    s->sum[task] = sum;
    ki_l2_report(s->job, (double)rows * (double)(p.n - first) * (double)p.dim);
}

/* All terms are >= 0, so relative errors remain what they are.  A product is off by
 * ulps * dim + dim - 1 roundings, 2^-53 each, and a sum of four by two more; then
 * each sum of a column by 2^-92, and what remains is at most n/32 + 100 additions
 * in twice the precision.  2^-30 of all this covers the second-order terms of dim
 * up to 2^20, and 2^-20 those up to 2^30.  Products that underflow lose less than
 * 2^-800, as no factor is above 2 and no more than 200 are multiplied plainly;
 * scaled ones below 2^-900 are dropped, and the terms that are not above 2. */
static double error_of(const pairs *s, double sum)
{
    double n = (double)s->job->p.n, dim = (double)s->job->p.dim;
    double ulps = (s->job->row->ulps + 1.0) * dim + 2.0;

    if (s->nothing) return 0.0;
    return sum * (ulps * 0x1p-53 * (1.0 + 0x1p-20) + 0x1p-91 +
                  (n / 32.0 + 100.0) * 0x1p-102) +
           n * n * 0x1p-800;
}

koksma_status ki_l2_pairs(ki_l2_number *sum, ki_l2_job *job)
{
    koksma_points p = job->p;
    size_t blocks = (p.n - 1) / BLOCK + 1;
    pairs s = {.job = job};
    ki_twice all = {0.0, 0.0};
    size_t total;

    s.panel_size = p.dim * (size_t)job->row->arrays;
    if (__builtin_mul_overflow(s.panel_size, KI_L2_PANEL, &s.panel_size) ||
        __builtin_mul_overflow(s.panel_size, blocks * KI_L2_BLOCK, &total))
        return KOKSMA_ENOMEM;
    s.panels = calloc(total, sizeof *s.panels);
    s.sum = calloc(blocks, sizeof *s.sum);
    if (s.panels == NULL || s.sum == NULL) {
        free(s.panels);
        free(s.sum);
        return KOKSMA_ENOMEM;
    }
    fill_panels(&s);
    find_unit(&s);
    ki_team_run(job->team, blocks, work_on, &s);
    for (size_t i = 0; i < blocks; i++)
        all = ki_twice_add(all, s.sum[i]);
    *sum = (ki_l2_number){all, error_of(&s, all.hi), s.e};
    free(s.panels);
    free(s.sum);
    return KOKSMA_OK;
}
