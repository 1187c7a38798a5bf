#include "edge_kernels.h"

/* All lines of a small cell that may matter: through two of its points, or halved
 * by one.  Whether a point is below a line is first decided in doubles, in favour
 * of the line; where it then may be of interest, by exact signs. */

typedef struct leaf {
    ki_edge_run *run;
    const ki_edge_list *list;
    const ki_edge_cell *cell;
    double share, bar; /* 1/n; ki_edge_bar */
} leaf;

static void place_of(double *at, const ki_edge_list *l, size_t i)
{
    at[0] = l->x[i];
    at[1] = l->y[i];
}

/* The line through a and b, a left of b, with exact counts.  It is named by the
 * outermost points on it, unless there is one alone. */
static void offer_line(const leaf *f, const double *a, const double *b)
{
    const ki_edge_list *l = f->list;
    double under = l->under, on = 0.0, first[2] = {3.0, 0.0}, last[2] = {-3.0, 0.0};

    for (size_t i = 0; i < l->count; i++) {
        double at[2];
        int side;

        place_of(at, l, i);
        side = ki_edge_side(a, b, at);
        if (side < 0) under += ki_edge_weight(l->w, i);
        if (side != 0) continue;
        on += ki_edge_weight(l->w, i);
        if (at[0] < first[0]) place_of(first, l, i);
        if (at[0] > last[0]) place_of(last, l, i);
    }
    if (first[0] < last[0])
        ki_edge_offer(f->run, l->pass, first, last, under, on);
    else
        ki_edge_offer(f->run, l->pass, a, b, under, on);
}

/* The line with the height u at 0, if it may be of interest. */
static bool is_worth(const leaf *f, double u, double slope)
{
    const ki_edge_list *l = f->list;
    double below = l->under, reached = l->under;
    double area = ki_edge_area_below(u, u + slope);

    for (size_t i = 0; i < l->count; i++) {
        double r = l->y[i] - u - slope * l->x[i], weight = ki_edge_weight(l->w, i);

        if (r < -KI_EDGE_NEAR) below += weight;
        if (r <= KI_EDGE_NEAR) reached += weight;
    }
    return reached * f->share - area > f->bar || area - below * f->share > f->bar;
}

static void try_line(leaf *f, const double *a, const double *b)
{
    double dx = b[0] - a[0], dy = b[1] - a[1], slope = dy / dx, u;

    if (fabs(dy) > fabs(dx) * (1.0 + KI_EDGE_NEAR)) return;
    u = a[1] - slope * a[0];
    if (!ki_edge_cell_has(f->cell, u, u + slope) || !is_worth(f, u, slope)) return;
    if (dx > 0.0)
        offer_line(f, a, b);
    else
        offer_line(f, b, a);
    f->bar = ki_edge_bar(f->run);
}

/* The chord that point i halves, unless it is on the line through a and b. */
static void try_chord(leaf *f, size_t i, const double *a, const double *b)
{
    double end[2][2];

    if (!ki_edge_chord(end, f->list->x[i], f->list->y[i])) return;
    if (a != NULL && ki_edge_side(a, b, end[0]) == 0 &&
        ki_edge_side(a, b, end[1]) == 0)
        return;
    try_line(f, end[0], end[1]);
}

static leaf begin(ki_edge_run *r, const ki_edge_list *l, const ki_edge_cell *c)
{
    return (leaf){r, l, c, 1.0 / (double)r->n, ki_edge_bar(r)};
}

void ki_edge_leaf(ki_edge_run *r, const ki_edge_list *l, const ki_edge_cell *c)
{
    leaf f = begin(r, l, c);
    double a[2], b[2];

    for (size_t i = 0; i < l->count; i++) {
        place_of(a, l, i);
        for (size_t j = 0; j < i; j++) {
            place_of(b, l, j);
            try_line(&f, a, b);
        }
        try_chord(&f, i, NULL, NULL);
    }
}

/* ---- Many points that no smaller cell parts ----------------------------- */

/* Points farthest left and right; returns whether all are exactly on the line
 * through them. */
static bool are_in_line(const ki_edge_list *l, double *a, double *b)
{
    size_t first = 0, last = 0;

    for (size_t i = 1; i < l->count; i++) {
        if (l->x[i] < l->x[first]) first = i;
        if (l->x[i] > l->x[last]) last = i;
    }
    place_of(a, l, first);
    place_of(b, l, last);
    if (!(a[0] < b[0])) return false;
    for (size_t i = 0; i < l->count; i++) {
        double at[2];

        place_of(at, l, i);
        if (ki_edge_side(a, b, at) != 0) return false;
    }
    return true;
}

bool ki_edge_leaf_many(ki_edge_sweeper *s, ki_edge_run *r, const ki_edge_list *l,
                       const ki_edge_cell *c, double *work, double *spent)
{
    leaf f = begin(r, l, c);
    double a[2], b[2];

    if (are_in_line(l, a, b)) {
        try_line(&f, a, b);
        for (size_t i = 0; i < l->count; i++)
            try_chord(&f, i, a, b);
        return true;
    }
    if (!ki_edge_sweeper_grow(s, l->count)) return false;
    for (size_t i = 0; i < l->count && !ki_edge_told_to_stop(r, work); i++) {
        ki_edge_sweep_about(s, r, l, i, c);
        *work += (double)l->count;
        *spent += (double)l->count;
    }
    return true;
}
