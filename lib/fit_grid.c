#include <math.h>
#include <stdlib.h>

#include "error.h"
#include "fit_kernels.h"

typedef struct entry {
    double n, y;
    size_t set;
} entry;

static int by_n_then_set(const void *a, const void *b)
{
    const entry *p = a, *q = b;

    if (p->n != q->n) return p->n < q->n ? -1 : 1;
    return (p->set > q->set) - (p->set < q->set);
}

static koksma_status check(koksma_fit_data d, const koksma_fit_opts *o,
                           koksma_error *err)
{
    if (!(o->level >= 0.0 && o->level < 1.0) || !(o->from >= 0.0) ||
        !(o->to >= 0.0) || !(o->scale >= 0.0 && isfinite(o->scale)))
        return ki_fail(
            err, KOKSMA_EINVAL, 0,
            "the level must be in (0,1), the window and the scale not below 0");
    for (size_t i = 0; i < d.rows; i++) {
        if (!(d.x[i] > 0.0 && isfinite(d.x[i]) && isfinite(d.y[i])))
            return ki_fail(
                err, KOKSMA_EDOMAIN, 0,
                "row %zu has N = %g and error %g: N must be above 0, both finite",
                i + 1, d.x[i], d.y[i]);
        if (d.set[i] >= d.sets)
            return ki_fail(err, KOKSMA_EINVAL, 0,
                           "row %zu is of set %zu, but there are %zu", i + 1,
                           d.set[i] + 1, d.sets);
    }
    return KOKSMA_OK;
}

/* The entries whose N lies in the window, sorted; returns how many. */
static size_t take_window(entry *e, koksma_fit_data d, const koksma_fit_opts *o)
{
    double to = o->to > 0.0 ? o->to : HUGE_VAL;
    size_t count = 0;

    for (size_t i = 0; i < d.rows; i++)
        if (d.x[i] >= o->from && d.x[i] <= to)
            e[count++] = (entry){d.x[i], d.y[i], d.set[i]};
    qsort(e, count, sizeof *e, by_n_then_set);
    return count;
}

/* How many different N there are among sorted entries. */
static size_t count_rows(const entry *e, size_t count)
{
    size_t rows = 0;

    for (size_t i = 0; i < count; i++)
        rows += i == 0 || e[i].n != e[i - 1].n;
    return rows;
}

static koksma_status place(ki_grid *g, const entry *e, size_t count,
                           koksma_error *err)
{
    for (size_t i = 0; i < count; i++)
        g->largest = fmax(g->largest, fabs(e[i].y));
    for (size_t i = 0; i < count; i++) {
        double *row;

        if (i == 0 || e[i].n != e[i - 1].n) {
            row = g->square + g->rows * g->sets;
            for (size_t r = 0; r < g->sets; r++)
                row[r] = nan("");
            g->n[g->rows++] = e[i].n;
        } else if (e[i].set == e[i - 1].set) {
            return ki_fail(
                err, KOKSMA_EDOMAIN, 0,
                "set %zu has two errors at N = %g: replicates need a column `set`",
                e[i].set + 1, e[i].n);
        }
        row = g->square + (g->rows - 1) * g->sets;
        row[e[i].set] = g->largest > 0.0 ? pow(e[i].y / g->largest, 2.0) : 0.0;
    }
    return KOKSMA_OK;
}

/* Whether the row can stand in the fit; if not, it is counted.  At least two
 * errors that are not 0, so that none of the means without one replicate is 0. */
static bool usable(ki_grid *g, const double *row, double floor)
{
    size_t live = 0;
    double sum = 0.0;

    for (size_t r = 0; r < g->sets; r++) {
        if (isnan(row[r])) {
            g->missing++;
            return false;
        }
        live += row[r] > 0.0;
        sum += row[r];
    }
    if (2 * live < g->sets || live < (g->sets > 1 ? 2 : 1)) {
        g->zero++;
        return false;
    }
    if (sqrt(sum / (double)g->sets) * g->largest < floor) {
        g->below_floor++;
        return false;
    }
    return true;
}

static void drop_rows(ki_grid *g, double scale)
{
    double floor = (scale > 0.0 ? scale : g->largest) * 0x1p-50;
    size_t kept = 0;

    for (size_t i = 0; i < g->rows; i++) {
        const double *row = g->square + i * g->sets;

        if (!usable(g, row, floor)) continue;
        for (size_t r = 0; r < g->sets; r++)
            g->square[kept * g->sets + r] = row[r];
        g->n[kept++] = g->n[i];
    }
    g->rows = kept;
}

koksma_status ki_grid_fill(ki_grid *g, koksma_fit_data d, const koksma_fit_opts *o,
                           koksma_error *err)
{
    koksma_status status = check(d, o, err);
    entry *e;

    *g = (ki_grid){.sets = d.sets};
    if (status != KOKSMA_OK) return status;
    e = ki_alloc(d.rows, sizeof *e);
    if (e == NULL) return ki_fail_memory(err, "the fit");

    size_t count = take_window(e, d, o), rows = count_rows(e, count), cells;

    g->n = ki_alloc(rows, sizeof *g->n);
    if (!__builtin_mul_overflow(rows, d.sets, &cells))
        g->square = ki_alloc(cells, sizeof *g->square);
    if (g->n == NULL || g->square == NULL)
        status = ki_fail_memory(err, "the fit");
    else
        status = place(g, e, count, err);
    if (status == KOKSMA_OK) drop_rows(g, o->scale);
    free(e);
    return status;
}

void ki_grid_free(ki_grid *g)
{
    free(g->n);
    free(g->square);
}

/* Sums without one replicate are put together from what is left and right of it:
 * subtracting it from the whole sum would cancel. */
void ki_grid_log_rms(double *log_rms, const ki_grid *g)
{
    size_t sets = g->sets;

    for (size_t i = 0; i < g->rows; i++) {
        const double *row = g->square + i * sets;
        double *y = log_rms + i * (sets + 1), left = 0.0, right = 0.0;

        for (size_t r = 0; r < sets; r++) {
            y[r] = left;
            left += row[r];
        }
        y[sets] = log(left / (double)sets) / 2.0;
        for (size_t r = sets; r-- > 0;) {
            y[r] = log((y[r] + right) / (double)(sets - 1)) / 2.0;
            right += row[r];
        }
    }
}

void ki_grid_log_rms_groups(double *log_rms, const ki_grid *g, size_t groups)
{
    for (size_t i = 0; i < g->rows; i++)
        for (size_t out = 0; out <= groups; out++) {
            const double *row = g->square + i * g->sets;
            double sum = 0.0;
            size_t count = 0;

            for (size_t r = 0; r < g->sets; r++)
                if (r % groups != out) {
                    sum += row[r];
                    count++;
                }
            log_rms[i * (groups + 1) + out] = log(sum / (double)count) / 2.0;
        }
}
