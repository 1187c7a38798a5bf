#include <math.h>
#include <stdlib.h>

#include "box_sweep_kernels.h"
#include "error.h"
#include "num_kernels.h"

/* Boxes of the line.  Between levels i and j, in points, a closed box has the
 * excess
 *
 *     passed[j+1] - passed[i] - n (y_j - y_i)
 *
 * and an open one n (y_j - y_i) - (passed[j] - passed[i+1]): what j says, and the
 * head of i, n y_i - passed[i] or passed[i+1] - n y_i.  So the best box that ends
 * at j begins at the greatest head among i <= j, or i < j. */

/* A beginning with a head that none so far is surely above. */
typedef struct beginning {
    double hi, lo; /* its head: exact, or off by n 2^-104 at most */
    bool exact;
    size_t level;
} beginning;

typedef struct line {
    ki_run run;
    ki_column column;
    ki_strip_room room;
    beginning *first; /* the best, and what may tie with it */
    size_t firsts;
    size_t levels;
    double n;
} line;

/* n y rounds off e, which counts; so does the sum with a whole number below 2^31,
 * where n y is not tiny; only r + e may round. */
static beginning begin_at(const line *l, bool closed, size_t i)
{
    double y = l->room.level[i], p = l->n * y, e = fma(l->n, y, -p), r, rest;
    double passed = (double)l->room.passed[i + !closed];
    double s = ki_two_sum(p, -passed, &r), t = ki_two_sum(r, e, &rest);
    beginning b = {.exact = rest == 0.0, .level = i};

    b.hi = ki_two_sum(s, t, &b.lo);
    if (!closed) {
        b.hi = -b.hi;
        b.lo = -b.lo;
    }
    return b;
}

/* Of beginnings that tie exactly the first makes the least corners; those that may
 * tie are few, since heads of different levels near 0 differ by whole points. */
static void add(line *l, beginning b)
{
    double slack = l->n * 0x1p-102;

    if (l->firsts > 0) {
        double ahead = (b.hi - l->first[0].hi) + (b.lo - l->first[0].lo);

        if (ahead < -slack) return;
        if (ahead > slack) l->firsts = 0;
    }
    for (size_t f = 0; f < l->firsts; f++)
        if (b.exact && l->first[f].exact && b.hi == l->first[f].hi &&
            b.lo == l->first[f].lo)
            return;
    l->first[l->firsts++] = b;
}

static size_t inside(const line *l, size_t i, size_t j, bool closed)
{
    const size_t *passed = l->room.passed;

    return closed ? passed[j + 1] - passed[i] : passed[j] - passed[i + 1];
}

/* What the best box that ends at j deviates by, but for rounding. */
static double deviation(const line *l, size_t j, bool closed)
{
    size_t i = l->first[0].level;
    double width = l->room.level[j] - l->room.level[i];
    double share = (double)inside(l, i, j, closed) / l->n;

    return closed ? share - width : width - share;
}

static void offer(line *l, size_t j, bool closed)
{
    for (size_t f = 0; f < l->firsts; f++) {
        size_t i = l->first[f].level;
        double corners[] = {l->room.level[i], l->room.level[j]};

        ki_run_offer(&l->run, corners, inside(l, i, j, closed), closed);
    }
}

/* The greatest deviation; offers those boxes that reach `least`. */
static double pass(line *l, bool closed, double least)
{
    double most = 0.0;

    l->firsts = 0;
    for (size_t j = closed ? 0 : 1; j < l->levels; j++) {
        double v;

        add(l, begin_at(l, closed, closed ? j : j - 1));
        v = deviation(l, j, closed);
        if (v >= least) offer(l, j, closed);
        most = fmax(most, v);
    }
    return most;
}

static void search(void *state)
{
    line *l = state;
    double most[2];

    for (int closed = 0; closed < 2; closed++) {
        l->levels = ki_strip_levels(&l->column, 0.0, 1.0, closed, &l->room);
        most[closed] = pass(l, closed, HUGE_VAL);
    }
    for (int closed = 0; closed < 2; closed++) {
        l->levels = ki_strip_levels(&l->column, 0.0, 1.0, closed, &l->room);
        (void)pass(l, closed, fmax(most[0], most[1]) - 2.0 * l->run.best->slack);
    }
    l->run.work += 4.0 * l->n;
}

static koksma_status begin(line *l, double *y)
{
    koksma_points p = l->run.best->p;
    ki_keyed *a = ki_alloc(p.n, 2 * sizeof *a);

    if (a == NULL) return KOKSMA_ENOMEM;

    const ki_keyed *sorted = ki_sort_axis(p, 0, a, a + p.n);

    for (size_t i = 0; i < p.n; i++)
        y[i] = sorted[i].x;
    free(a);
    l->column = (ki_column){p.n, 1, NULL, y};
    l->n = (double)p.n;
    l->room.level = ki_alloc(p.n + 2, sizeof *l->room.level);
    l->room.passed = ki_alloc(p.n + 3, sizeof *l->room.passed);
    l->first = ki_alloc(p.n + 2, sizeof *l->first);
    return l->room.level != NULL && l->room.passed != NULL && l->first != NULL
               ? KOKSMA_OK
               : KOKSMA_ENOMEM;
}

koksma_status ki_box_line(ki_best *b, const ki_run_opts *opts, double *upper,
                          double *work, bool *stopped)
{
    line l = {.firsts = 0};
    koksma_status status = ki_run_begin(&l.run, b, opts);
    double *y = ki_alloc(b->p.n, sizeof *y);

    if (y == NULL) status = KOKSMA_ENOMEM;
    if (status == KOKSMA_OK) status = begin(&l, y);
    if (status == KOKSMA_OK) {
        ki_run_stages(&l.run, search, &l);
        status = ki_run_outcome(&l.run, upper, work, stopped);
    }
    free(y);
    free(l.room.level);
    free(l.room.passed);
    free(l.first);
    ki_run_end(&l.run);
    return status;
}
