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
 * Most of them can be skipped.  Let M be the greatest excess in the row of x for
 * a right side (or 0), and take a row further left, at x' < x: the part of its box
 * from x on, if any, is in the row of x.  So a closed box there has at most M more
 * than the points in [x', x), and an open one at most M more than n (x - x').  If
 * x' > x, then the box grown to x is in the row of x: a closed one loses n (x' - x)
 * at most, an open one the points in (x, x'].  This holds for every right side; the
 * bounds are kept for blocks of them, and a row is visited in those blocks alone
 * where they leave something to find.  Rows are taken from coarse to fine, so that
 * what is near was looked at before. */

/* Blocks of right sides; half or twice as many make little difference. */
enum { BLOCKS = 32 };

/* Left sides of one kind of box. */
typedef struct rows {
    size_t count;
    double *x;      /* count: in increasing order */
    double *excess; /* count * BLOCKS: no box of the row that ends there has more */
    double *most;   /* count: the greatest of the row's */
    size_t *passed; /* count + 1: points left of x */
} rows;

/* What one thread works with. */
typedef struct worker {
    ki_kinetic tree;
    ki_strip_room room;
    bool *there;   /* n: by rank of y, whether the point has come in */
    size_t joined; /* of the points in the order of x: those in the tree, */
    size_t seen;   /* and those that are there */
    double excess[BLOCKS];
    double work;
} worker;

typedef struct sweep {
    ki_run run;
    ki_column column;
    rows kind[2]; /* of open boxes, of closed ones */
    size_t *rank; /* n: of y, of the points in the order of x */
    double *x;    /* n: in increasing order */
    double *gap;  /* places */
    size_t places;
    size_t *order; /* the rows of both kinds, from coarse to fine */
    size_t tasks, part, parts;
    worker *worker; /* one a thread */
    double *numbers;
    size_t *counts;
} sweep;

/* The block of a right side at the points from s->x[i] on. */
static size_t block_of(const sweep *s, size_t i)
{
    return (size_t)((uint64_t)i * BLOCKS / s->column.n);
}

/* The greatest excess there may be, in deviations.  Call with the lock held. */
static double most(const sweep *s)
{
    double greatest = 0.0;

    for (int closed = 0; closed < 2; closed++)
        for (size_t r = 0; r < s->kind[closed].count; r++)
            greatest = fmax(greatest, s->kind[closed].most[r]);
    return fmin(greatest / (double)s->column.n + KI_KINETIC_SLACK, 1.0);
}

/* No box of row q has more than `more` above one of those. */
static void lower_row(rows *k, size_t q, const double *excess, double more)
{
    double *own = k->excess + q * BLOCKS, greatest = 0.0;

    for (size_t b = 0; b < BLOCKS; b++) {
        double bound = excess[b] + more;

        own[b] = own[b] < bound ? own[b] : bound;
        greatest = greatest > own[b] ? greatest : own[b];
    }
    k->most[q] = greatest;
}

/* What the excesses of row r say of the others. */
static void learn(rows *k, size_t r, bool closed, double n, const double *excess)
{
    for (size_t q = 0; q < k->count; q++) {
        double width = n * fabs(k->x[r] - k->x[q]), points, more;

        if (q < r)
            points = (double)(k->passed[r] - k->passed[q]);
        else
            points = (double)(k->passed[q + 1] - k->passed[r + 1]);
        more = q == r ? 0.0 : closed == (q < r) ? points : width;
        if (more < k->most[q]) lower_row(k, q, excess, more);
    }
}

/* Bring the tree up to date, at W: the points that are there but not in it, one by
 * one or all at once, by what takes less. */
static void catch_up(sweep *s, worker *w, double W)
{
    size_t behind = w->seen - w->joined, depth = 1;

    while ((size_t)1 << depth < s->places)
        depth++;
    if (w->joined == SIZE_MAX || behind > s->places / (2 * depth))
        ki_kinetic_start(&w->tree, w->there, s->column.n, W);
    else
        for (; w->joined < w->seen; w->joined++)
            ki_kinetic_insert(&w->tree, s->rank[w->joined], W);
    w->joined = w->seen;
}

/* One step of a row: the best between x and right; offers what may matter. */
static double look(sweep *s, worker *w, double x, double right, bool closed)
{
    double n = (double)s->column.n, W = n * (right - x), excess;

    catch_up(s, w, W);
    excess = ki_kinetic_best(&w->tree, W);
    if (excess / n + KI_KINETIC_SLACK >= ki_run_target(&s->run))
        ki_strip_offer(&s->run, &s->column, x, right, closed, &w->room);
    return excess;
}

/* The points at s->x[w->seen] come in. */
static void pass_group(const sweep *s, worker *w)
{
    double x = s->x[w->seen];

    for (; w->seen < s->column.n && s->x[w->seen] == x; w->seen++)
        w->there[s->rank[w->seen]] = true;
}

/* Look at the right sides of a block, unless its bound says that there is nothing;
 * else find the bound anew. */
static void visit_block(sweep *s, worker *w, double x, bool closed, size_t b)
{
    size_t n = s->column.n;
    double greatest = 0.0;
    bool needed =
        w->excess[b] / (double)n + 2.0 * KI_KINETIC_SLACK >= ki_run_target(&s->run);

    while (w->seen < n && block_of(s, w->seen) == b) {
        double right = s->x[w->seen];

        if (needed && !closed)
            greatest = fmax(greatest, look(s, w, x, right, false));
        pass_group(s, w);
        if (needed && closed) greatest = fmax(greatest, look(s, w, x, right, true));
    }
    if (needed && !closed && b == BLOCKS - 1)
        greatest = fmax(greatest, look(s, w, x, 1.0, false));
    if (needed) w->excess[b] = greatest + (double)n * KI_KINETIC_SLACK;
}

/* w->excess has the bounds of row r, and gets better ones. */
static void visit(sweep *s, worker *w, size_t r, bool closed)
{
    const rows *k = &s->kind[closed];

    w->seen = closed ? k->passed[r] : k->passed[r + 1];
    w->joined = SIZE_MAX;
    w->tree.closed = closed;
    memset(w->there, 0, s->column.n * sizeof *w->there);
    for (size_t b = 0; b < BLOCKS; b++)
        visit_block(s, w, k->x[r], closed, b);
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
    excess = k->most[r];
    memcpy(w->excess, k->excess + r * BLOCKS, sizeof w->excess);
    ki_team_unlock(s->run.team);
    if (excess / n + 2.0 * KI_KINETIC_SLACK < ki_run_target(&s->run)) return;

    visit(s, w, r, closed);
    ki_team_lock(s->run.team);
    learn(k, r, closed, n, w->excess);
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
    for (size_t r = 0; r < k->count; r++) {
        k->most[r] = (double)n;
        for (size_t b = 0; b < BLOCKS; b++)
            k->excess[r * BLOCKS + b] = (double)n;
    }
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
    w->there = ki_alloc(n, sizeof *w->there);
    return w->tree.node != NULL && w->room.level != NULL &&
           w->room.passed != NULL && w->there != NULL;
}

/* Rows hold x, most and excess, BLOCKS + 2 numbers a row and kind, in numbers, and
 * passed in counts. */
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
    s->numbers = numbers =
        ki_alloc((2 * BLOCKS + 7) * row + s->places, sizeof *numbers);
    s->counts = ki_alloc(row, 5 * sizeof *s->counts);
    if (s->worker == NULL || numbers == NULL || s->counts == NULL)
        return KOKSMA_ENOMEM;
    s->x = numbers + (2 * BLOCKS + 6) * row;
    s->gap = s->x + row;
    s->rank = s->counts + 2 * row;
    s->order = s->counts + 3 * row;
    if (!sort_points(s, b->p, numbers + (2 * BLOCKS + 4) * row))
        return KOKSMA_ENOMEM;
    ki_kinetic_gaps(s->gap, s->places, s->column.y, n);
    for (int closed = 0; closed < 2; closed++) {
        double *own = numbers + (size_t)closed * (BLOCKS + 2) * row;

        s->kind[closed] = (rows){.x = own,
                                 .most = own + row,
                                 .excess = own + 2 * row,
                                 .passed = s->counts + (size_t)closed * row};
        make_rows(&s->kind[closed], s->x, n, closed);
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
            free(s->worker[i].there);
        }
    free(s->worker);
    free(s->numbers);
    free(s->counts);
    ki_run_end(&s->run);
}

static void sweep_rows(void *state)
{
    sweep *s = state;

    ki_team_run(s->run.team, s->tasks, work_on, s);
}

koksma_status ki_box_sweep(ki_best *b, const ki_run_opts *opts, double *upper,
                           double *work, bool *stopped)
{
    sweep s = {0};
    koksma_status status;

    if (b->p.dim == 1) return ki_box_line(b, opts, upper, work, stopped);
    status = begin(&s, b, opts);

    if (status == KOKSMA_OK) {
        ki_run_stages(&s.run, sweep_rows, &s);
        for (size_t i = 0; i < ki_team_threads(s.run.team); i++)
            s.run.work += s.worker[i].work;
        status = ki_run_outcome(&s.run, upper, work, stopped);
    }
    end(&s);
    return status;
}
