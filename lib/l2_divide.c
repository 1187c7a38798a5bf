#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "l2_divide_kernels.h"

/* The sum over all pairs by divide and conquer, after [Heinrich 1996].
 *
 * For x <= y, k(x,y) is a sum of few products f_r(x) g_r(y).  Cut the points in two
 * along the last axis, low and high.  Pairs inside of either half are the same task
 * again.  For a pair across the cut, the factor of the last axis is a sum of
 * products f_r(low) g_r(high): these multiply the weights of the points, and the
 * task has an axis less, now with two lists.  There each list is cut at the same
 * place, and so on; with one axis left both lists are walked in their common order,
 * with running sums of w f_r over what was passed.
 *
 * Cuts go by ranks, which are all different, so that ties are cut as well; where
 * x = y, f_r(x) g_r(y) and f_r(y) g_r(x) sum up to the same.
 *
 * The order of all additions follows from the points alone: the tasks are the nodes
 * of the first levels of cuts along the last axis, whose number n decides, and
 * their sums are added in order.
 *
 * Roundings.  Written out, what is computed is a sum over pairs of products w f g
 * ... whose absolute values sum up to at most most^dim a pair.  Each of them has
 * gone through at most 8 operations a coordinate, which are off by less than 2^-103
 * of it (or of 2, where f or g cancels: counted four times), and has been added to
 * running sums with no more steps in all than w->steps: 36 2^-106 each. */

enum {
    LEVELS = 6,
    LEAF = 2048
}; /* tasks: 2^(LEVELS+1) - 1, of LEAF points at least */

typedef struct divide {
    ki_l2_job *job;
    size_t levels; /* of cuts with a task each; below, a task a part */
    size_t stride;
    ki_l2_key *key;   /* twice as many as points */
    double *item;     /* the points, sorted by coordinate 0 */
    uint32_t *place;  /* where in there point i is */
    uint32_t **order; /* items by level: in parts, each by coordinate 0 */
    ki_l2_worker *worker;
    ki_twice *sum; /* of each task */
    double steps;
} divide;

/* The points in the order of coordinate k, ties in that of their indices. */
static const ki_l2_key *sort(ki_l2_key *key, koksma_points p, size_t k)
{
    for (size_t i = 0; i < p.n; i++) {
        double x = p.x[i * p.dim + k] + 0.0; /* -0 is 0 */

        memcpy(&key[i].bits, &x, sizeof x);
        key[i].point = i;
    }
    return ki_l2_sort(key, key + p.n, p.n);
}

/* Part j of a level with `parts` parts begins at this rank along the last axis. */
static size_t begin_of(size_t n, size_t parts, size_t j)
{
    return n / parts * j + n % parts * j / parts;
}

/* One level's order from the one above: parts are cut in two, stably. */
static void refine(divide *s, size_t level)
{
    koksma_points p = s->job->p;
    size_t parts = (size_t)1 << level, at = s->stride - 1; /* of the last rank */

    for (size_t j = 0; j < parts / 2; j++) {
        size_t begin = begin_of(p.n, parts, 2 * j);
        size_t cut = begin_of(p.n, parts, 2 * j + 1);
        size_t end = begin_of(p.n, parts, 2 * j + 2), low = begin, high = cut;

        for (size_t i = begin; i < end; i++) {
            uint32_t point = s->order[level - 1][i];
            bool below = s->item[point * s->stride + at] < (double)cut;

            s->order[level][below ? low++ : high++] = point;
        }
    }
}

static void prepare(divide *s)
{
    koksma_points p = s->job->p;
    const ki_l2_key *sorted = sort(s->key, p, 0);

    for (size_t i = 0; i < p.n; i++) {
        double *item = s->item + i * s->stride;

        item[0] = 1.0;
        item[1] = 0.0;
        memcpy(item + KI_L2_ITEM, p.x + sorted[i].point * p.dim,
               p.dim * sizeof *item);
        s->place[sorted[i].point] = s->order[0][i] = (uint32_t)i;
    }
    for (size_t k = 1; k < p.dim; k++) {
        sorted = sort(s->key, p, k);
        for (size_t i = 0; i < p.n; i++)
            s->item[s->place[sorted[i].point] * s->stride + KI_L2_ITEM + p.dim + k -
                    1] = (double)i;
    }
    for (size_t level = 1; level <= s->levels; level++)
        refine(s, level);
}

/* The list of part j of a level. */
static ki_l2_list gather(const divide *s, double *to, size_t level, size_t j)
{
    size_t n = s->job->p.n, begin = begin_of(n, (size_t)1 << level, j);
    size_t end = begin_of(n, (size_t)1 << level, j + 1);
    ki_l2_list l = {to, end - begin};

    for (size_t i = begin; i < end; i++, to += s->stride)
        ki_l2_copy(to, s->item + s->order[level][i] * s->stride, s->stride);
    return l;
}

/* A worker's room, made when it first has a task: the list, as many items to spare,
 * and copies for each axis but the first two. */
static bool make_room(const divide *s, ki_l2_worker *w, size_t n)
{
    size_t items, size;

    if (__builtin_mul_overflow(n, s->job->p.dim + 1, &items) ||
        __builtin_mul_overflow(items, w->stride, &size))
        return false;
    free(w->spare);
    w->spare = ki_alloc(size, sizeof *w->spare);
    return w->spare != NULL;
}

static void work_on(void *state, size_t worker, size_t task)
{
    divide *s = state;
    ki_l2_worker *w = &s->worker[worker];
    size_t n = s->job->p.n, level = 0, parts = 1, first = 0;

    while (task >= first + parts) {
        first += parts;
        parts *= 2;
        level++;
    }

    double before = w->steps;
    double *item = w->spare + n * w->stride;
    ki_l2_list l = gather(s, item, level, task - first);

    w->sum = (ki_twice_total){0.0, 0.0, 0};
    w->copies = item + l.n * w->stride;
    if (level == s->levels)
        ki_l2_within(w, l);
    else
        ki_l2_apart(w, l, (double)begin_of(n, parts * 2, 2 * (task - first) + 1));
    s->sum[task] = ki_twice_total_value(&w->sum);
    ki_l2_report(s->job, w->steps - before);
}

/* The pairs of a point with itself. */
static ki_twice diagonal(divide *s, ki_l2_worker *w)
{
    double item[KI_L2_ITEM + KOKSMA_L2_DIVIDE_DIM] = {1.0, 0.0};
    koksma_points p = s->job->p;

    w->sum = (ki_twice_total){0.0, 0.0, 0};
    for (size_t i = 0; i < p.n; i++) {
        for (size_t k = 0; k < p.dim; k++)
            item[KI_L2_ITEM + k] = p.x[i * p.dim + k];
        ki_l2_brute(w, p.dim, (ki_l2_list){item, 1}, (ki_l2_list){item, 1});
    }
    return ki_twice_total_value(&w->sum);
}

static uint32_t **tables(size_t count, size_t n)
{
    uint32_t **t = calloc(count, sizeof *t);

    for (size_t i = 0; t != NULL && i < count; i++) {
        t[i] = ki_alloc(n, sizeof **t);
        if (t[i] != NULL) continue;
        while (i-- > 0)
            free(t[i]);
        free(t);
        return NULL;
    }
    return t;
}

static void free_tables(uint32_t **t, size_t count)
{
    for (size_t i = 0; t != NULL && i < count; i++)
        free(t[i]);
    free(t);
}

static bool make(divide *s)
{
    koksma_points p = s->job->p;
    size_t threads = ki_team_threads(s->job->team), tasks;

    while (p.dim > 1 && s->levels < LEVELS && p.n >> s->levels >= 2 * LEAF)
        s->levels++;
    tasks = ((size_t)2 << s->levels) - 1;
    s->stride = KI_L2_ITEM + 2 * p.dim - 1;
    s->key = ki_alloc(p.n, 2 * sizeof *s->key);
    s->item = ki_alloc(p.n, s->stride * sizeof *s->item);
    s->place = ki_alloc(p.n, sizeof *s->place);
    s->order = tables(s->levels + 1, p.n);
    s->sum = calloc(tasks, sizeof *s->sum);
    s->worker = calloc(threads, sizeof *s->worker);
    if (s->key == NULL || s->item == NULL || s->place == NULL || s->order == NULL ||
        s->sum == NULL || s->worker == NULL)
        return false;
    for (size_t i = 0; i < threads && i < tasks; i++) {
        ki_l2_worker *w = &s->worker[i];

        w->kind = s->job->kind;
        w->dim = p.dim;
        w->stride = s->stride;
        if (!make_room(s, w, p.n)) return false;
    }
    return true;
}

/* See above.  The sums of the tasks, twice, and the diagonal are 300 more. */
static double error_of(const divide *s)
{
    double n = (double)s->job->p.n, all = n * n * 0x1p-106;
    double dim = (double)s->job->p.dim;

    for (size_t k = 0; k < s->job->p.dim; k++)
        all *= s->job->row->most;
    return all * (36.0 * (s->steps + 300.0) + 8.0 * 4.0 * 8.0 * (dim + 1.0)) *
               (1.0 + 0x1p-20) +
           n * n * 0x1p-900;
}

static ki_l2_number solve(divide *s)
{
    size_t tasks = ((size_t)2 << s->levels) - 1;
    ki_twice all = {0.0, 0.0}, own = diagonal(s, &s->worker[0]);

    ki_team_run(s->job->team, tasks, work_on, s);
    for (size_t i = 0; i < tasks; i++)
        all = ki_twice_add(all, s->sum[i]);
    all = ki_twice_add(own, ki_twice_scale(all, 2.0));
    for (size_t i = 0; i < ki_team_threads(s->job->team); i++)
        s->steps += s->worker[i].steps;
    return (ki_l2_number){all, error_of(s), 0};
}

koksma_status ki_l2_divide(ki_l2_number *sum, ki_l2_job *job)
{
    divide s = {.job = job};
    bool made = make(&s);

    if (made) {
        prepare(&s);
        *sum = solve(&s);
    }
    free(s.key);
    free(s.item);
    free(s.place);
    free_tables(s.order, s.levels + 1);
    for (size_t i = 0; s.worker != NULL && i < ki_team_threads(job->team); i++)
        free(s.worker[i].spare);
    free(s.worker);
    free(s.sum);
    return made ? KOKSMA_OK : KOKSMA_ENOMEM;
}
