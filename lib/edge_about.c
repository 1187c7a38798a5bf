#include <stdlib.h>

#include "edge_kernels.h"
#include "error.h"

/* Turn a line about a point p, from the slope -1 to 1.  A point q right of p is
 * above it before they meet and below afterwards, a point left of p the other way
 * round, and a steep one, with a slope beyond the range, stays where it is.  The
 * end of the chord that p halves is met like a point, but does not count.
 *
 * Slopes that differ by less than 2^-48 may be equal or in another order: such
 * points are first taken together, as if all of them were on the best side, and
 * told apart by exact signs where even that might be of interest. */

static const double TOGETHER = 0x1p-48;

bool ki_edge_sweeper_grow(ki_edge_sweeper *s, size_t count)
{
    if (count < s->room) return true;
    ki_edge_sweeper_free(s);
    s->event = ki_alloc(count + 1, sizeof *s->event);
    s->spare = ki_alloc(count + 1, sizeof *s->spare);
    s->near = ki_alloc(count + 1, sizeof *s->near);
    s->room = count + 1;
    if (s->event != NULL && s->spare != NULL && s->near != NULL) return true;
    ki_edge_sweeper_free(s);
    return false;
}

void ki_edge_sweeper_free(ki_edge_sweeper *s)
{
    free(s->event);
    free(s->spare);
    free(s->near);
    *s = (ki_edge_sweeper){0};
}

/* What is the same for all lines about the point. */
typedef struct sweep {
    ki_edge_sweeper *scratch;
    ki_edge_run *run;
    const ki_edge_list *list;
    const ki_edge_cell *cell;
    size_t about;
    double p[2], weight, end[2][2];
    ki_edge_event *event;
    size_t events;
    double share, under, bar; /* 1/n; below the line; ki_edge_bar */
} sweep;

static void place_of(double *at, const sweep *w, uint32_t i)
{
    at[0] = i < w->list->count ? w->list->x[i] : w->end[0][0];
    at[1] = i < w->list->count ? w->list->y[i] : w->end[0][1];
}

static double weight_of(const sweep *w, uint32_t i)
{
    return i < w->list->count ? ki_edge_weight(w->list->w, i) : 0.0;
}

/* With a margin: whoever is met at 1 or -1 but for rounding is met. */
static bool is_steep(double dx, double dy)
{
    return fabs(dy) > fabs(dx) * (1.0 + 0x1p-40);
}

static void collect(sweep *w)
{
    const ki_edge_list *l = w->list;
    ki_edge_event *e = w->scratch->event;

    w->under = l->under;
    for (size_t i = 0; i < l->count; i++) {
        double dx = l->x[i] - w->p[0], dy = l->y[i] - w->p[1];

        if (i == w->about) continue;
        if (is_steep(dx, dy)) {
            if (dy < 0.0) w->under += ki_edge_weight(l->w, i);
            continue;
        }
        *e++ = (ki_edge_event){dy / dx, (uint32_t)i};
        if (dx < 0.0) w->under += ki_edge_weight(l->w, i);
    }
    if (ki_edge_chord(w->end, w->p[0], w->p[1])) {
        double dx = w->end[0][0] - w->p[0], dy = w->end[0][1] - w->p[1];

        if (!is_steep(dx, dy)) *e++ = (ki_edge_event){dy / dx, (uint32_t)l->count};
    }
    w->events = (size_t)(e - w->scratch->event);
    w->event = ki_edge_sort(w->scratch->event, w->scratch->spare, w->events);
}

/* The points that the line meets at once: how many come from above and from below.
 */
typedef struct meeting {
    double rising, falling;
} meeting;

static void meet(meeting *m, const sweep *w, const double *at, uint32_t i)
{
    if (at[0] > w->p[0])
        m->falling += weight_of(w, i);
    else
        m->rising += weight_of(w, i);
}

/* The better one of closed below with too many and open below with too few, as on
 * paper. */
static double deviation(const sweep *w, meeting m, double area)
{
    double many = (w->under + w->weight + m.falling) * w->share - area;
    double few = area - (w->under - m.rising) * w->share;

    return many > few ? many : few;
}

static bool in_cell(const sweep *w, double slope, double spread, double *area)
{
    double u = w->p[1] - slope * w->p[0], v = u + slope;
    ki_edge_cell wider;

    *area = ki_edge_area_below(u, v);
    if (w->cell == NULL) return true;
    wider = *w->cell;
    wider.u -= spread;
    wider.v -= spread;
    wider.side += 2.0 * spread;
    return ki_edge_cell_has(&wider, u, v);
}

static void offer(sweep *w, meeting m, double *a, double *b)
{
    double on = w->weight + m.rising + m.falling;

    ki_edge_offer(w->run, w->list->pass, a, b, w->under - m.rising, on);
    w->bar = ki_edge_bar(w->run);
}

/* A line that meets one event.  p and the point of it, or the ends of the chord. */
static void offer_one(sweep *w, meeting m, uint32_t i)
{
    double at[2];

    place_of(at, w, i);
    if (i == w->list->count)
        offer(w, m, w->end[0], w->end[1]);
    else
        offer(w, m, w->p, at);
}

/* ---- Several at once ---------------------------------------------------- */

/* Which one is met first, exactly.  Going over to the other side of p turns the
 * sign. */
static int by_meeting(const void *a, const void *b)
{
    const ki_edge_near *e = a, *f = b;
    int side = ki_edge_side(e->about, e->at, f->at);

    return (e->at[0] < e->about[0]) == (f->at[0] < f->about[0]) ? -side : side;
}

/* Whether the line that meets near is in the cell and may be of interest. */
static bool is_worth(const sweep *w, meeting m, const ki_edge_near *near)
{
    double slope = (near->at[1] - w->p[1]) / (near->at[0] - w->p[0]), area;

    return in_cell(w, slope, 0.0, &area) && deviation(w, m, area) > w->bar;
}

/* Those that are met exactly at once.  The line is named by the outermost of its
 * points. */
static void offer_group(sweep *w, ki_edge_near *near, size_t count)
{
    double *first = w->p, *last = w->p;
    meeting m = {0.0, 0.0};

    for (size_t j = 0; j < count; j++) {
        meet(&m, w, near[j].at, near[j].i);
        if (near[j].i == w->list->count) continue;
        if (near[j].at[0] < first[0]) first = near[j].at;
        if (near[j].at[0] > last[0]) last = near[j].at;
    }
    if (is_worth(w, m, near) && first != last)
        offer(w, m, first, last);
    else if (is_worth(w, m, near))
        offer_one(w, m, near[0].i);
    w->under += m.falling - m.rising;
}

static void tell_apart(sweep *w, const ki_edge_event *e, size_t count)
{
    ki_edge_near *near = w->scratch->near;
    double under = w->under;

    for (size_t j = 0; j < count; j++) {
        near[j] = (ki_edge_near){.about = {w->p[0], w->p[1]}, .i = e[j].i};
        place_of(near[j].at, w, e[j].i);
    }
    qsort(near, count, sizeof *near, by_meeting);
    for (size_t j = 0, k; j < count; j = k) {
        for (k = j + 1; k < count && by_meeting(&near[j], &near[k]) == 0; k++)
            ;
        offer_group(w, near + j, k - j);
    }
    w->under = under;
}

static void note_best(sweep *w, double value, uint32_t i)
{
    if (!(value > w->scratch->best)) return;
    w->scratch->best = value;
    w->scratch->partner = i;
}

static void meet_together(sweep *w, const ki_edge_event *e, size_t count)
{
    double spread = e[count - 1].slope - e[0].slope, area, value;
    meeting m = {0.0, 0.0};

    for (size_t j = 0; j < count; j++) {
        double at[2];

        place_of(at, w, e[j].i);
        meet(&m, w, at, e[j].i);
    }
    if (in_cell(w, e[0].slope, spread, &area)) {
        value = deviation(w, m, area) + spread;
        note_best(w, value, e[0].i);
        if (value > w->bar) {
            if (count == 1)
                offer_one(w, m, e[0].i);
            else
                tell_apart(w, e, count);
        }
    }
    w->under += m.falling - m.rising;
}

void ki_edge_sweep_about(ki_edge_sweeper *s, ki_edge_run *r, const ki_edge_list *l,
                         size_t i, const ki_edge_cell *cell)
{
    sweep w = {.scratch = s,
               .run = r,
               .list = l,
               .cell = cell,
               .about = i,
               .p = {l->x[i], l->y[i]},
               .weight = ki_edge_weight(l->w, i),
               .share = 1.0 / (double)r->n,
               .bar = ki_edge_bar(r)};

    collect(&w);
    for (size_t j = 0, k; j < w.events; j = k) {
        for (k = j + 1; k < w.events; k++)
            if (w.event[k].slope - w.event[k - 1].slope > TOGETHER) break;
        meet_together(&w, w.event + j, k - j);
    }
}
