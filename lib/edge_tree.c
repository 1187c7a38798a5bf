#include <stdlib.h>
#include <string.h>

#include "edge_kernels.h"
#include "error.h"

/* Branch and bound over cells of lines.  The half-plane below a line grows with
 * both of its heights.  So in a cell [u, u + s] x [v, v + s], with c points below
 * all of its lines and m more that are not above all of them, no half-plane
 *
 *     below a line, closed, has more than  (c + m)/n - area(u, v)  too many,
 *     below a line, open, has more than    area(u + s, v + s) - c/n  too few
 *
 * and each half-plane is below a line of some pass, or is the complement of one
 * that is.  A cell is dropped when both are below the bar, looked at line by line
 * when m is small, and else cut into four.
 *
 * Points in a narrow cluster stay together in all cells with a line through it, and
 * where such lines have nearly the same area in many directions, as they have next
 * to a corner of the square or to its middle lines, there are as many of these
 * cells as the cluster is narrow.  So a tree that has taken more than the sweep
 * would gives up, and the sweep does all. */

enum { TASKS_ACROSS = 12, DEPTH = 40, LISTS = DEPTH + 1 };

/* Where points on one line, or next to one, keep m from falling. */
static const double SIDE_LEAST = 0x1p-36;

typedef struct part {
    ki_edge_cell cell;
    double bound;
} part;

/* Steps after which a thread gives up: MORE n^2 of them take about as long as the
 * sweep, and even sets of a hundred points and more take less than half. */
static const double STEPS = 0x1p17, MORE = 8.0;

/* A cell that was cut: its points, from `begin` on, and its parts still to visit.
 */
typedef struct node {
    size_t begin, count;
    double under, all; /* below all lines; on the list */
    part part[KI_EDGE_PARTS];
    int left;
} node;

typedef struct worker {
    double *x, *y, *w; /* the lists of the path, each padded, one after the other */
    size_t room_x, room_y, room_w;
    ki_edge_sweeper sweeper;
    node path[DEPTH];
    double work;  /* not yet reported */
    double spent; /* in all */
} worker;

typedef struct tree {
    ki_edge_run *run;
    const ki_edge_points *p;
    worker *worker;
    double most; /* that a thread may spend */
} tree;

/* No line of the cell meets the square with a slope of the pass. */
static bool is_too_steep(const ki_edge_cell *c)
{
    return fabs(c->v - c->u) > 1.0 + c->side + KI_EDGE_NEAR;
}

/* Of local discrepancies, with `under` points below and `open` more on either side.
 */
static double bound_of(const ki_edge_cell *c, double under, double open,
                       double share)
{
    double many = (under + open) * share - ki_edge_area_below(c->u, c->v);
    double few = ki_edge_area_below(c->u + c->side, c->v + c->side) - under * share;

    return many > few ? many : few;
}

static ki_edge_cell part_of(const ki_edge_cell *c, int k)
{
    double d = 0.5 * c->side;

    return (ki_edge_cell){c->u + (k & 1 ? d : 0.0), c->v + (k & 2 ? d : 0.0), d};
}

static ki_edge_list list_of(const tree *t, const worker *w, const node *n, int pass)
{
    return (ki_edge_list){.x = w->x + n->begin,
                          .y = w->y + n->begin,
                          .w = t->p->w != NULL ? w->w + n->begin : NULL,
                          .count = n->count,
                          .pass = pass,
                          .under = n->under};
}

static double total(const ki_edge_list *l)
{
    double sum = 0.0;

    if (l->w == NULL) return (double)l->count;
    for (size_t i = 0; i < l->count; i++)
        sum += l->w[i];
    return sum;
}

static void spend(worker *w, double work)
{
    w->work += work;
    w->spent += work;
}

/* The parts of cell c that may be of interest, the best bound last.  Those of the
 * points of l that are below or above all of c are so of its parts. */
static void cut(tree *t, worker *w, node *n, const ki_edge_cell *c,
                const ki_edge_list *l, double all)
{
    double share = 1.0 / (double)t->run->n, bar = ki_edge_bar(t->run);
    ki_edge_split s;

    ki_edge_cell_split(&s, c, l);
    spend(w, (double)l->count);
    n->left = 0;
    for (int k = 0; k < KI_EDGE_PARTS; k++) {
        part new = {.cell = part_of(c, k)};
        int j = n->left;

        if (is_too_steep(&new.cell)) continue;
        new.bound = bound_of(&new.cell, l->under + s.below[k],
                             all - s.below[k] - s.above[k], share);
        if (!(new.bound > bar)) continue;
        for (; j > 0 && n->part[j - 1].bound > new.bound; j--)
            n->part[j] = n->part[j - 1];
        n->part[j] = new;
        n->left++;
    }
}

/* Room for `count` points behind those of the path. */
static bool make_room(const tree *t, worker *w, size_t count)
{
    size_t need = count + KI_EDGE_LANES;

    return ki_grow((void **)&w->x, &w->room_x, need, sizeof *w->x) == 0 &&
           ki_grow((void **)&w->y, &w->room_y, need, sizeof *w->y) == 0 &&
           (t->p->w == NULL ||
            ki_grow((void **)&w->w, &w->room_w, need, sizeof *w->w) == 0);
}

/* Visit cell c with the points of `from`: where a part of it may be of interest,
 * its points go behind those of the path, and its lines are offered, or its parts
 * left in *n.  Returns whether there are any. */
static bool visit(tree *t, worker *w, node *n, const ki_edge_cell *c,
                  const ki_edge_list *from, double all)
{
    double *x = w->x + n->begin, *y = w->y + n->begin;
    double *weight = from->w != NULL ? w->w + n->begin : NULL;
    ki_edge_list l;

    cut(t, w, n, c, from, all);
    if (n->left == 0) return false;
    n->under = from->under;
    n->count = ki_edge_cell_keep(x, y, weight, &n->under, c, from);
    spend(w, (double)from->count);
    l = list_of(t, w, n, from->pass);
    if (n->count > KI_EDGE_FEW && c->side > SIDE_LEAST) {
        ki_edge_pad(x, y, weight, n->count);
        n->all = total(&l);
        return true;
    }
    if (n->count <= KI_EDGE_FEW) {
        ki_edge_leaf(t->run, &l, c);
        return false;
    }
    if (!ki_edge_leaf_many(&w->sweeper, t->run, &l, c, &w->work, &w->spent))
        ki_edge_give_up(t->run);
    return false;
}

/* Depth first: a part is taken only when what is before it has raised the bar. */
static void dive(tree *t, worker *w, int pass)
{
    int depth = 0;

    while (depth >= 0) {
        node *n = &w->path[depth];
        part next;

        if (n->left == 0) {
            depth--;
            continue;
        }
        next = n->part[--n->left];
        if (!(next.bound > ki_edge_bar(t->run))) continue;
        if (w->spent > t->most || ki_edge_told_to_stop(t->run, &w->work)) return;
        n[1].begin = n->begin + n->count + KI_EDGE_LANES;
        if (!make_room(t, w, n[1].begin + n->count)) {
            ki_edge_give_up(t->run);
            return;
        }

        ki_edge_list l = list_of(t, w, n, pass);

        if (visit(t, w, n + 1, &next.cell, &l, n->all)) depth++;
    }
}

static void work_task(void *state, size_t thread, size_t task)
{
    tree *t = state;
    worker *w = &t->worker[thread];
    int pass = (int)(task % KI_EDGE_PASSES);
    size_t place = task / KI_EDGE_PASSES;
    double side = 3.0 / TASKS_ACROSS;
    ki_edge_cell c = {-1.0 + side * (double)(place % TASKS_ACROSS),
                      -1.0 + side * (double)(place / TASKS_ACROSS), side};
    ki_edge_list l = ki_edge_whole(t->p, pass);

    if (is_too_steep(&c) || w->spent > t->most ||
        ki_edge_told_to_stop(t->run, &w->work))
        return;
    if (!make_room(t, w, l.count)) {
        ki_edge_give_up(t->run);
        return;
    }
    w->path[0].begin = 0;
    if (visit(t, w, &w->path[0], &c, &l, (double)t->p->n)) dive(t, w, pass);
}

/* The sweep about all points leaves nothing out, whatever the tree has seen. */
static void stage(void *state)
{
    tree *t = state;
    bool gave_up = false;

    ki_team_run(t->run->team, KI_EDGE_PASSES * TASKS_ACROSS * TASKS_ACROSS,
                work_task, t);
    for (size_t i = 0; i < ki_team_threads(t->run->team); i++)
        gave_up = gave_up || t->worker[i].spent > t->most;
    if (gave_up) ki_edge_sweep_all(t->run, t->p);
}

void ki_edge_tree(ki_edge_run *r, const ki_edge_points *p)
{
    size_t threads = ki_team_threads(r->team);
    double n = (double)p->count;
    tree t = {r, p, calloc(threads, sizeof *t.worker), STEPS + MORE * n * n};

    if (t.worker == NULL) {
        ki_edge_give_up(r);
        return;
    }
    ki_edge_climb(r, p);
    ki_edge_run_stages(r, stage, &t);
    for (size_t i = 0; i < threads; i++) {
        worker *w = &t.worker[i];

        r->work += w->work;
        free(w->x);
        free(w->y);
        free(w->w);
        ki_edge_sweeper_free(&w->sweeper);
    }
    free(t.worker);
}
