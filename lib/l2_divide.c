#include <math.h>
#include <stdlib.h>

#include "error.h"
#include "l2_divide_kernels.h"

/* The sum over all pairs by divide and conquer, after [Heinrich 1996].
 *
 * k(x,y) is a sum of products f_r(x) f_r(y) and of a core, which for x <= y is a
 * product too, first(x) second(y).  Multiplied out over the coordinates, K is a sum
 * of terms with a core along some axes and f along the others.  The f are weights
 * of the points.
 *
 * For the cores, cut the points in two along the last of their axes, low and high.
 * Pairs inside of either half are the same task again.  For a pair across the cut
 * the factor of that axis is first(low) second(high): the weights take it in, and
 * the task has an axis less, now for pairs of two sides.  And so on; with one axis
 * left, the points are walked in its order with running sums over what was passed.
 *
 * Cuts go by ranks, which are all different, so that ties are cut as well; where
 * x = y, first(x) second(y) and first(y) second(x) are the same.
 *
 * The order of all additions follows from the points alone: for each term the tasks
 * are the nodes of the first levels of cuts along the last axis, whose number n
 * decides, and their sums are added in order.
 *
 * Roundings.  Let a pair's product have an absolute value of at most `most`, for
 * its term.  It has gone through at most four operations a coordinate of either
 * point, off by 2^-103 of it each, and has taken in f, off by 2^-101: with those of
 * the total, less than (dim + 1) 2^-98 in all.  A loop over m items adds products
 * of at most `pairs` pairs, through running sums and one over all, m steps each,
 * which lose at most 36 m 2^-106 pairs most each: w->loss sums (72 m + 128) pairs
 * up, with the 128 for those of the lanes and of short sums.  The sums of the loops
 * are w->added numbers, which lose 36 2^-106 of all pairs of the task for each. */

/* Tasks are 2^(LEVELS+1) - 1 at most, of LEAF points at least; weights come in
 * blocks. */
enum { LEVELS = 6, LEAF = 2048, BLOCK = 256 };

typedef struct divide {
    ki_l2_job *job;
    const ki_l2_terms *terms;
    ki_l2_items items;
    ki_l2_worker *worker;
    ki_twice *sum; /* of each task */
    double *loss;
    ki_l2_call call;
    ki_twice all;
    double error;
} divide;

static size_t tasks_of(const divide *s)
{
    return s->items.axes < 2 ? 1 : ((size_t)2 << s->items.levels) - 1;
}

/* ---- Tasks ------------------------------------------------------------------- */

static void work_on_part(const divide *s, ki_l2_worker *w, size_t task)
{
    const ki_l2_items *t = &s->items;
    size_t n = s->job->p.n, level = 0, parts = 1, first = 0;

    while (task >= first + parts) {
        first += parts;
        parts *= 2;
        level++;
    }

    ki_l2_slot *item = w->spare + n * w->stride;
    ki_l2_list l = ki_l2_items_gather(t, item, level, task - first);

    w->copies = item + l.n * w->stride;
    if (level == t->levels)
        ki_l2_solve(w, t->axes, l);
    else
        ki_l2_apart(
            w, t->axes, l,
            (uint32_t)ki_l2_part_begin(n, parts * 2, 2 * (task - first) + 1));
    w->loss += 36.0 * w->added * 0.5 * (double)l.n * (double)l.n;
}

/* All pairs of all points, with one axis or none. */
static void work_on_line(const divide *s, ki_l2_worker *w)
{
    const ki_l2_items *t = &s->items;
    koksma_points p = s->job->p;
    const uint32_t *by = t->by[t->axes == 0 ? 0 : t->axis[0]];
    ki_twice_total before = {0.0, 0.0, 0};
    ki_twice weight[BLOCK];
    double x[BLOCK];

    for (size_t j = 0; j < p.n; j += BLOCK) {
        size_t count = p.n - j < BLOCK ? p.n - j : BLOCK;

        ki_l2_weigh(&s->call, p.x, by + j, count, weight);
        for (size_t i = 0; t->axes > 0 && i < count; i++)
            x[i] = p.x[by[j + i] * p.dim + t->axis[0]];
        ki_l2_loops_of[w->core].pass(w, &before, t->axes > 0 ? x : NULL, weight,
                                     count);
    }
    ki_l2_count(w, (double)p.n, 0.5 * (double)p.n * (double)p.n);
}

static void work_on(void *state, size_t worker, size_t task)
{
    divide *s = state;
    ki_l2_worker *w = &s->worker[worker];

    w->sum = (ki_twice_total){0.0, 0.0, 0};
    w->added = w->loss = w->steps = 0.0;
    if (s->items.axes < 2)
        work_on_line(s, w);
    else
        work_on_part(s, w, task);
    s->sum[task] = ki_twice_total_value(&w->sum);
    s->loss[task] = w->loss;
    ki_l2_report(s->job, w->steps);
}

/* ---- Terms ------------------------------------------------------------------- */

static void solve_call(divide *s)
{
    size_t tasks = tasks_of(s);
    double n = (double)s->job->p.n, dim = (double)s->job->p.dim, loss = 0.0;
    ki_twice sum = {0.0, 0.0};

    if (s->items.axes >= 2) ki_l2_items_weigh(&s->items, &s->call);
    ki_team_run(s->job->team, tasks, work_on, s);
    for (size_t i = 0; i < tasks; i++) {
        sum = ki_twice_add(sum, s->sum[i]);
        loss += s->loss[i];
    }

    /* Adding tasks and calls up: less than 8 2^-106 of all pairs each. */
    loss += (256.0 * (dim + 2.0) + 8.0 * (double)tasks) * 0.5 * n * n;
    s->all = ki_twice_add(s->all, ki_twice_by(sum, s->call.times));
    s->error += loss * s->call.most;
}

/* Set the terms of the axes without a core from the digits of a number. */
static void choose_terms(divide *s, size_t digits)
{
    static const double MOST[KI_L2_CORES] = {1.0, 1.0, 1.5, 1.0};
    const ki_l2_terms *t = s->terms;

    s->call.times = s->call.most = 1.0;
    for (size_t k = 0; k < s->call.dim; k++) {
        signed char *r = &s->call.term[k];

        if (*r >= 0) {
            *r = (signed char)(digits % (size_t)t->count);
            digits /= (size_t)t->count;
        }
        s->call.times *= *r < 0 ? t->times : t->sign[(int)*r];
        s->call.most *=
            *r < 0 ? fabs(t->times) * MOST[t->core]
                   : fabs(t->sign[(int)*r]) * t->most[(int)*r] * t->most[(int)*r];
    }
}

/* The terms with cores along the axes whose bits are set. */
static void solve_axes(divide *s, size_t set)
{
    ki_l2_items *t = &s->items;
    size_t choices = 1;

    t->axes = 0;
    for (size_t k = 0; k < s->call.dim; k++) {
        bool core = (set >> k & 1) != 0;

        s->call.term[k] = core ? -1 : 0;
        if (core)
            t->axis[t->axes++] = k;
        else
            choices *= (size_t)s->terms->count;
    }
    if (choices == 0) return;
    if (t->axes >= 2) ki_l2_items_arrange(t);
    for (size_t i = 0; i < ki_team_threads(s->job->team); i++) {
        s->worker[i].axes = t->axes;
        s->worker[i].stride = t->stride;
    }
    for (size_t j = 0; j < choices && !ki_team_stopped(s->job->team); j++) {
        choose_terms(s, j);
        solve_call(s);
    }
}

static ki_l2_number solve(divide *s)
{
    koksma_points p = s->job->p;
    double n = (double)p.n, dim = (double)p.dim;
    ki_twice own = ki_l2_own(s->job->kind, p);

    ki_l2_items_rank(&s->items);
    for (size_t set = (size_t)1 << p.dim; set-- > 0;)
        solve_axes(s, set);

    /* Each k(x,x) is below 2, and off by less than 2^-102 of it. */
    s->error =
        2.0 * s->error + ldexp(n * (36.0 * n + 256.0 * (dim + 2.0)), (int)p.dim);
    s->error = s->error * 0x1p-106 * (1.0 + 0x1p-20) + n * n * 0x1p-900;
    return (ki_l2_number){ki_twice_add(own, ki_twice_scale(s->all, 2.0)), s->error,
                          0};
}

/* ---- Room -------------------------------------------------------------------- */

/* A worker's room: the list, as many items to spare, and copies for each axis but
 * the first two. */
static bool make_room(divide *s, ki_l2_worker *w, size_t n)
{
    size_t dim = s->job->p.dim, items, size;

    if (dim < 2) return true;
    if (__builtin_mul_overflow(n, dim, &items) ||
        __builtin_mul_overflow(items, ki_l2_coordinates(dim) + dim, &size))
        return false;
    w->spare = ki_alloc(size, sizeof *w->spare);
    return w->spare != NULL;
}

static bool make(divide *s)
{
    koksma_points p = s->job->p;
    size_t threads = ki_team_threads(s->job->team), levels = 0, tasks;

    while (p.dim > 1 && levels < LEVELS && p.n >> levels >= 2 * LEAF)
        levels++;
    tasks = ((size_t)2 << levels) - 1;
    s->sum = calloc(tasks, sizeof *s->sum);
    s->loss = calloc(tasks, sizeof *s->loss);
    s->worker = calloc(threads, sizeof *s->worker);
    if (!ki_l2_items_make(&s->items, p, levels) || s->sum == NULL ||
        s->loss == NULL || s->worker == NULL)
        return false;
    for (size_t i = 0; i < threads; i++) {
        s->worker[i].core = s->terms->core;
        if (i < tasks && !make_room(s, &s->worker[i], p.n)) return false;
    }
    return true;
}

koksma_status ki_l2_divide(ki_l2_number *sum, ki_l2_job *job)
{
    divide s = {.job = job,
                .terms = &ki_l2_terms_of[job->kind],
                .call = {.kind = job->kind, .dim = job->p.dim}};
    bool made = make(&s);

    if (made) *sum = solve(&s);
    ki_l2_items_free(&s.items);
    for (size_t i = 0; s.worker != NULL && i < ki_team_threads(job->team); i++)
        free(s.worker[i].spare);
    free(s.worker);
    free(s.sum);
    free(s.loss);
    return made ? KOKSMA_OK : KOKSMA_ENOMEM;
}
