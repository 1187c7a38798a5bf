#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "box_sweep_kernels.h"
#include "error.h"

/* All boxes of the plane, by their left sides, the rows.  For each the right side
 * runs over the coordinates to its right, points come in as it passes them, and a
 * tree of y says how good the best box between the two sides is (box_kinetic.c).
 * Only where that is above the incumbent does anyone look which boxes they are.
 *
 * A closed box begins and ends at coordinates of points, else it could shrink; its
 * points are those between, both ends included.  An open box begins at 0 or at such
 * a coordinate, and ends at one or at 1; its points are strictly between.
 *
 * Most rows can be skipped.  Let M be the greatest excess in the row of x (or 0),
 * and take a row further left, at x' < x: the part of its box from x on (or beyond,
 * if any) is in the row of x.  So a closed box there has at most M more than the
 * points in [x', x), and an open one at most M more than n (x - x').  If x' > x,
 * then the box grown to x is in the row of x: a closed one loses n (x' - x) at
 * most, an open one the points in (x, x'].  Rows are visited from coarse to fine,
 * so that what is near was looked at before. */

/* Left sides of one kind of box. */
typedef struct rows {
    size_t count;
    double *x;      /* count: in increasing order */
    double *excess; /* count: no box of the row has more */
    size_t *passed; /* count + 1: points left of x */
} rows;

/* What one thread works with. */
typedef struct worker {
    ki_kinetic tree;
    ki_strip_room room;
    double work;
} worker;

typedef struct sweep {
    ki_run run;
    ki_column column;
    rows kind[2];           /* of open boxes, of closed ones */
    size_t *rank;           /* n: of y, of the points in the order of x */
    double *x;              /* n: in increasing order */
    double *gap;            /* places */
    ki_span_best *clear[2]; /* the trees without points */
    size_t places;
    size_t *order; /* the rows of both kinds, from coarse to fine */
    size_t tasks, part, parts;
    worker *worker; /* one a thread */
    double *numbers;
    size_t *counts;
} sweep;

/* The greatest excess there may be, in deviations.  Call with the lock held. */
static double most(const sweep *s)
{
    double greatest = 0.0;

    for (int closed = 0; closed < 2; closed++)
        for (size_t r = 0; r < s->kind[closed].count; r++)
            greatest = fmax(greatest, s->kind[closed].excess[r]);
    return fmin(greatest / (double)s->column.n + KI_KINETIC_SLACK, 1.0);
}

/* What the row r's greatest excess says of the others. */
static void learn(rows *k, size_t r, bool closed, double n, double excess)
{
    for (size_t q = 0; q < k->count; q++) {
        double width = n * fabs(k->x[r] - k->x[q]), points, more;

        if (q < r)
            points = (double)(k->passed[r] - k->passed[q]);
        else
            points = (double)(k->passed[q + 1] - k->passed[r + 1]);
        more = closed == (q < r) ? points : width;
        k->excess[q] = fmin(k->excess[q], excess + more);
    }
}

/* One step of a row: the best between x and right; offers what may matter. */
static double look(sweep *s, worker *w, double x, double right, bool closed)
{
    double n = (double)s->column.n, W = n * (right - x);
    double excess = ki_kinetic_best(&w->tree, W);

    if (excess / n + KI_KINETIC_SLACK >= ki_run_target(&s->run))
        ki_strip_offer(&s->run, &s->column, x, right, closed, &w->room);
    return excess;
}

/* Points at s->x[i], and where they end. */
static size_t insert_group(sweep *s, worker *w, size_t i, double x)
{
    double W = (double)s->column.n * (s->x[i] - x);
    size_t end = i;

    for (; end < s->column.n && s->x[end] == s->x[i]; end++)
        ki_kinetic_insert(&w->tree, s->rank[end], W);
    return end;
}

static double visit(sweep *s, worker *w, size_t r, bool closed)
{
    const rows *k = &s->kind[closed];
    size_t n = s->column.n, i = closed ? k->passed[r] : k->passed[r + 1];
    double greatest = 0.0, right = k->x[r];

    w->tree.closed = closed;
    memcpy(w->tree.node, s->clear[closed], 2 * s->places * sizeof *w->tree.node);
    while (i < n) {
        right = s->x[i];
        if (!closed) greatest = fmax(greatest, look(s, w, k->x[r], right, closed));
        i = insert_group(s, w, i, k->x[r]);
        if (closed) greatest = fmax(greatest, look(s, w, k->x[r], right, closed));
    }
    if (!closed && right < 1.0)
        greatest = fmax(greatest, look(s, w, k->x[r], 1.0, closed));
    return greatest;
}

static void work_on(void *state, size_t thread, size_t number)
{
    sweep *s = state;
    worker *w = &s->worker[thread];
    size_t r = s->order[number] / 2;
    bool closed = s->order[number] % 2 == 1;
    rows *k = &s->kind[closed];
    double n = (double)s->column.n, excess;

    if (number % s->parts != s->part) return;
    ki_team_lock(s->run.team);
    excess = k->excess[r];
    ki_team_unlock(s->run.team);
    if (excess / n + 2.0 * KI_KINETIC_SLACK < ki_run_target(&s->run)) return;

    excess = visit(s, w, r, closed) + n * KI_KINETIC_SLACK;
    ki_team_lock(s->run.team);
    learn(k, r, closed, n, excess);
    if (s->parts == 1)
        s->run.upper = fmax(fmin(s->run.upper, most(s)), s->run.best->value.upper);
    ki_team_unlock(s->run.team);
    w->work += w->tree.work;
    w->tree.work = 0.0;
    (void)ki_run_told_to_stop(&s->run, &w->work);
}

/* ---- Making it -------------------------------------------------------------- */

/* Distinct coordinates; open boxes may begin at 0. */
static void make_rows(rows *k, const double *x, size_t n, bool closed)
{
    k->count = 0;
    if (!closed && x[0] > 0.0) {
        k->x[k->count] = 0.0;
        k->passed[k->count++] = 0;
    }
    for (size_t i = 0; i < n; i++)
        if (k->count == 0 || k->x[k->count - 1] != x[i]) {
            k->x[k->count] = x[i];
            k->passed[k->count++] = i;
        }
    k->passed[k->count] = n;
    for (size_t r = 0; r < k->count; r++)
        k->excess[r] = (double)n;
}

/* Odd multiples of ever smaller powers of two. */
static void order_rows(sweep *s)
{
    size_t stride = 1, longest = s->kind[0].count;

    if (s->kind[1].count > longest) longest = s->kind[1].count;
    while (stride < longest)
        stride *= 2;
    for (; stride > 0; stride /= 2)
        for (size_t r = stride - 1; r < longest; r += 2 * stride)
            for (size_t closed = 0; closed < 2; closed++)
                if (r < s->kind[closed].count)
                    s->order[s->tasks++] = 2 * r + closed;
}

/* The points by x, and the column by y; column: room for 2 * n. */
static bool sort_points(sweep *s, koksma_points p, double *column)
{
    ki_keyed *a = ki_alloc(p.n, 2 * sizeof *a);
    size_t *place = ki_alloc(p.n, sizeof *place);
    bool ready = a != NULL && place != NULL;

    if (ready) {
        const ki_keyed *by_y = ki_sort_axis(p, p.dim - 1, a, a + p.n);

        for (size_t i = 0; i < p.n; i++) {
            column[i] = p.x[by_y[i].i * p.dim];
            column[p.n + i] = by_y[i].x;
            place[by_y[i].i] = i;
        }
        s->column = (ki_column){p.n, p.dim, column, column + p.n};

        const ki_keyed *by_x = ki_sort_axis(p, 0, a, a + p.n);

        for (size_t i = 0; i < p.n; i++) {
            s->x[i] = by_x[i].x;
            s->rank[i] = place[by_x[i].i];
        }
    }
    free(a);
    free(place);
    return ready;
}

static bool make_worker(worker *w, const sweep *s)
{
    size_t n = s->column.n;

    w->tree = (ki_kinetic){.places = s->places, .gap = s->gap};
    w->tree.node = ki_alloc(s->places, 2 * sizeof *w->tree.node);
    w->room.level = ki_alloc(n + 2, sizeof *w->room.level);
    w->room.passed = ki_alloc(n + 3, sizeof *w->room.passed);
    return w->tree.node != NULL && w->room.level != NULL && w->room.passed != NULL;
}

static bool make_clear(sweep *s, int closed)
{
    ki_kinetic t = {.closed = closed, .places = s->places, .gap = s->gap};

    t.node = s->clear[closed] = ki_alloc(s->places, 2 * sizeof *t.node);
    if (t.node != NULL) ki_kinetic_clear(&t);
    return t.node != NULL;
}

/* Rows hold x and excess, n + 1 each a kind, in numbers, and passed in counts. */
static koksma_status begin(sweep *s, ki_best *b, const ki_run_opts *opts)
{
    size_t n = b->p.n, row = n + 2;
    double *numbers;

    *s = (sweep){.part = opts->parts > 1 ? opts->part - 1 : 0,
                 .parts = opts->parts > 1 ? opts->parts : 1,
                 .places = ki_kinetic_places(n)};
    if (ki_run_begin(&s->run, b, opts) != KOKSMA_OK) return KOKSMA_ENOMEM;
    s->run.opts.anytime = false; /* there is an upper bound all the time */
    s->worker = calloc(ki_team_threads(s->run.team), sizeof *s->worker);
    s->numbers = numbers = ki_alloc(7 * row + s->places, sizeof *numbers);
    s->counts = ki_alloc(row, 5 * sizeof *s->counts);
    if (s->worker == NULL || numbers == NULL || s->counts == NULL)
        return KOKSMA_ENOMEM;
    s->x = numbers + 6 * row;
    s->gap = s->x + row;
    s->rank = s->counts + 2 * row;
    s->order = s->counts + 3 * row;
    if (!sort_points(s, b->p, numbers + 4 * row)) return KOKSMA_ENOMEM;
    ki_kinetic_gaps(s->gap, s->places, s->column.y, n);
    for (int closed = 0; closed < 2; closed++) {
        s->kind[closed] = (rows){.x = numbers + 2 * (size_t)closed * row,
                                 .excess = numbers + (2 * (size_t)closed + 1) * row,
                                 .passed = s->counts + (size_t)closed * row};
        make_rows(&s->kind[closed], s->x, n, closed);
        if (!make_clear(s, closed)) return KOKSMA_ENOMEM;
    }
    order_rows(s);
    for (size_t i = 0; i < ki_team_threads(s->run.team); i++)
        if (!make_worker(&s->worker[i], s)) return KOKSMA_ENOMEM;
    return KOKSMA_OK;
}

static void end(sweep *s)
{
    if (s->worker != NULL)
        for (size_t i = 0; i < ki_team_threads(s->run.team); i++) {
            free(s->worker[i].tree.node);
            free(s->worker[i].room.level);
            free(s->worker[i].room.passed);
        }
    free(s->worker);
    free(s->clear[0]);
    free(s->clear[1]);
    free(s->numbers);
    free(s->counts);
    ki_run_end(&s->run);
}

static void sweep_rows(void *state)
{
    sweep *s = state;

    ki_team_run(s->run.team, s->tasks, work_on, s);
}

/* On the line there is one strip: all of it. */
static void sweep_line(void *state)
{
    sweep *s = state;

    for (int closed = 0; closed < 2; closed++)
        ki_strip_offer(&s->run, &s->column, 0.0, 1.0, closed, &s->worker[0].room);
    s->worker[0].work += 2.0 * (double)s->column.n;
}

koksma_status ki_box_sweep(ki_best *b, const ki_run_opts *opts, double *upper,
                           double *work, bool *stopped)
{
    sweep s = {0};
    koksma_status status = begin(&s, b, opts);

    if (status == KOKSMA_OK) {
        ki_run_stages(&s.run, b->p.dim == 1 ? sweep_line : sweep_rows, &s);
        for (size_t i = 0; i < ki_team_threads(s.run.team); i++)
            s.run.work += s.worker[i].work;
        status = ki_run_outcome(&s.run, upper, work, stopped);
    }
    end(&s);
    return status;
}
