#include "fit.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "error.h"
#include "num_kernels.h"

/* Errors in a grid: one row an N, in increasing order, one column a replicate. */
typedef struct grid {
    size_t rows, sets;
    double *n;      /* rows */
    double *square; /* rows*sets: e^2 over the largest e^2; NaN: none */
    double largest; /* |e| */
} grid;

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
        !(o->to >= 0.0))
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "the level must be in (0,1), the window not below 0");
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

/* How many different N there are among sorted entries. */
static size_t count_rows(const entry *e, size_t count)
{
    size_t rows = 0;

    for (size_t i = 0; i < count; i++)
        rows += i == 0 || e[i].n != e[i - 1].n;
    return rows;
}

/* Put sorted entries into the grid. */
static koksma_status fill_grid(grid *g, const entry *e, size_t count,
                               koksma_error *err)
{
    double largest = 0.0;

    for (size_t i = 0; i < count; i++)
        largest = fmax(largest, fabs(e[i].y));
    g->rows = 0;
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
        row[e[i].set] = largest > 0.0 ? pow(e[i].y / largest, 2.0) : 0.0;
    }
    g->largest = largest;
    return KOKSMA_OK;
}

/* Whether the row can stand in the fit. */
static bool usable(const double *row, size_t sets)
{
    static const double FLOOR = 0x1p-100; /* of the square */
    size_t live = 0;
    double sum = 0.0;

    for (size_t r = 0; r < sets; r++) {
        if (isnan(row[r])) return false;
        live += row[r] > 0.0;
        sum += row[r];
    }
    return 2 * live >= sets && live >= (sets > 1 ? 2 : 1) &&
           sum / (double)sets >= FLOOR;
}

/* Keep the usable rows; returns how many went. */
static size_t drop_rows(grid *g)
{
    size_t kept = 0, rows = g->rows;

    for (size_t i = 0; i < rows; i++) {
        const double *row = g->square + i * g->sets;

        if (!usable(row, g->sets)) continue;
        for (size_t r = 0; r < g->sets; r++)
            g->square[kept * g->sets + r] = row[r];
        g->n[kept++] = g->n[i];
    }
    g->rows = kept;
    return rows - kept;
}

/* Least squares as fixed weights: slope = sum slope[i]*y[i], and likewise the
 * quadratic coefficient.  u = ln n is centred; the quadratic part is what u^2
 * leaves after its own line in u. */
typedef struct weights {
    double *slope, *bend;
    double centre;
} weights;

/* Returns false when the N's are so close that there is no slope. */
static bool fill_weights(weights *w, const grid *g)
{
    double m = (double)g->rows, u2 = 0.0, u3 = 0.0, p2 = 0.0;

    w->centre = 0.0;
    for (size_t i = 0; i < g->rows; i++)
        w->centre += log(g->n[i]) / m;
    for (size_t i = 0; i < g->rows; i++) {
        double u = log(g->n[i]) - w->centre;

        u2 += u * u;
        u3 += u * u * u;
    }
    for (size_t i = 0; i < g->rows; i++) {
        double u = log(g->n[i]) - w->centre;

        w->slope[i] = u / u2;
        w->bend[i] = u * u - u2 / m - u * (u3 / u2);
        p2 += w->bend[i] * w->bend[i];
    }
    for (size_t i = 0; i < g->rows; i++)
        w->bend[i] /= p2;
    /* Far above what the rounding of the logarithms makes of equal N's. */
    return u2 / m > 1e-12 && p2 > 1e-10 * u2 * u2 / m;
}

/* One line through ln rms, without replicate `left_out` (sets: with all). */
typedef struct line {
    double level, slope, bend;
} line;

static line fit_line(const grid *g, const weights *w, size_t left_out)
{
    double count = (double)(g->sets - (left_out < g->sets));
    line l = {0.0, 0.0, 0.0};

    for (size_t i = 0; i < g->rows; i++) {
        const double *row = g->square + i * g->sets;
        double sum = 0.0, y;

        /* Summed anew each time: subtracting the one left out would cancel. */
        for (size_t r = 0; r < g->sets; r++)
            if (r != left_out) sum += row[r];
        y = log(sum / count) / 2.0;
        l.level += y / (double)g->rows;
        l.slope += w->slope[i] * y;
        l.bend += w->bend[i] * y;
    }
    return l;
}

static koksma_estimate around(double value, double se, double level, size_t sets)
{
    double reach;

    if (isnan(se)) return (koksma_estimate){value, nan(""), nan(""), 0.0};
    reach = se * ki_student_quantile(level, sets - 1);
    return (koksma_estimate){value, value - reach, value + reach, level};
}

/* The jackknife: what is left when each replicate in turn is not there. */
static void jackknife(koksma_fit_result *out, const grid *g, const weights *w)
{
    double m = (double)g->sets, slope = 0.0, bend = 0.0, slope2 = 0.0, bend2 = 0.0;

    out->exponent_se = out->curvature_se = nan("");
    if (g->sets < 2) return;
    /* Deviations from the first one: the mean's own rounding does not matter. */
    line first = fit_line(g, w, 0);
    for (size_t r = 1; r < g->sets; r++) {
        line l = fit_line(g, w, r);
        double ds = l.slope - first.slope, db = l.bend - first.bend;

        slope += ds;
        bend += db;
        slope2 += ds * ds;
        bend2 += db * db;
    }
    out->exponent_se = sqrt(fmax(slope2 - slope * slope / m, 0.0) * (m - 1.0) / m);
    out->curvature_se = sqrt(fmax(bend2 - bend * bend / m, 0.0) * (m - 1.0) / m);
}

static koksma_status fit_grid(koksma_fit_result *out, grid *g, weights *w,
                              double level, koksma_error *err)
{
    koksma_fit_result f = {.sets = g->sets, .dropped = drop_rows(g)};
    line l;

    f.used = g->rows;
    if (g->rows < 3)
        return ki_fail(err, KOKSMA_EINVAL, 0,
                       "%zu usable N in the window, %zu dropped: a fit takes 3",
                       g->rows, f.dropped);
    f.from = g->n[0];
    f.to = g->n[g->rows - 1];
    if (!fill_weights(w, g))
        return ki_fail(
            err, KOKSMA_EINVAL, 0,
            "the N from %g to %g are too close to each other for a slope", f.from,
            f.to);
    l = fit_line(g, w, g->sets);
    jackknife(&f, g, w);
    f.exponent = around(l.slope, f.exponent_se, level, f.sets);
    f.curvature = around(l.bend, f.curvature_se, level, f.sets);
    f.constant = g->largest * exp(l.level - l.slope * w->centre);
    *out = f;
    return KOKSMA_OK;
}

/* The entries whose N lies in the window, sorted; returns how many. */
static size_t take_window(entry *e, koksma_fit_data d, const koksma_fit_opts *o)
{
    double from = o->from > 0.0 ? o->from : 8.0,
           to = o->to > 0.0 ? o->to : HUGE_VAL;
    size_t count = 0;

    for (size_t i = 0; i < d.rows; i++)
        if (d.x[i] >= from && d.x[i] <= to)
            e[count++] = (entry){d.x[i], d.y[i], d.set[i]};
    qsort(e, count, sizeof *e, by_n_then_set);
    return count;
}

koksma_status koksma_fit(koksma_fit_result *out, koksma_fit_data data,
                         const koksma_fit_opts *opts, koksma_error *err)
{
    static const koksma_fit_opts defaults = KOKSMA_FIT_DEFAULTS;
    const koksma_fit_opts *o = opts != NULL ? opts : &defaults;
    koksma_status status = check(data, o, err);
    entry *e;

    if (status != KOKSMA_OK) return status;
    e = ki_alloc(data.rows, sizeof *e);
    if (e == NULL) return ki_fail_memory(err, "the fit");

    size_t count = take_window(e, data, o), rows = count_rows(e, count), cells;
    bool fits = !__builtin_mul_overflow(rows, data.sets, &cells);
    grid g = {.sets = data.sets,
              .n = ki_alloc(rows, 3 * sizeof *g.n),
              .square = fits ? ki_alloc(cells, sizeof *g.square) : NULL};

    if (g.n == NULL || g.square == NULL) {
        status = ki_fail_memory(err, "the fit");
    } else {
        weights w = {.slope = g.n + rows, .bend = g.n + 2 * rows};

        status = fill_grid(&g, e, count, err);
        if (status == KOKSMA_OK)
            status = fit_grid(out, &g, &w, o->level > 0.0 ? o->level : 0.95, err);
    }
    free(e);
    free(g.n);
    free(g.square);
    return status;
}

koksma_comparison koksma_fit_compare(const koksma_fit_result *fit, double candidate,
                                     double margin)
{
    double se = fit->exponent_se, off = fit->exponent.value - candidate, reach;

    if (isnan(se)) return (koksma_comparison){nan(""), KOKSMA_NO_VERDICT};
    if (off == 0.0) se = fmax(se, DBL_MIN); /* t is 0 then, whatever se */
    /* Two tests at 5 % each: the interval at 90 %. */
    reach = se * ki_student_quantile(0.90, fit->sets - 1);
    if (fabs(off) + reach < margin)
        return (koksma_comparison){off / se, KOKSMA_EQUIVALENT};
    if (candidate < fit->exponent.lower || candidate > fit->exponent.upper)
        return (koksma_comparison){off / se, KOKSMA_DIFFERENT};
    return (koksma_comparison){off / se, KOKSMA_UNDECIDED};
}

double koksma_fit_theory(size_t dim)
{
    return -((double)dim + 1.0) / (2.0 * (double)dim);
}
