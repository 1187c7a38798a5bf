/* The kernels of the branch and bound, cell by cell: the points of a cell stand as
 * a recount says, no corner that matters gets lost, and none deviates by more than
 * the bound, rounding included.  Every corner of every cell is visited. */
#include <check.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num_kernels.h"
#include "oracle.h"
#include "star_kernels.h"

/* The most axes, points, ranks an axis, corners of a cell, cells on a path. */
enum { DIMS = 16, POINTS = 20, RANKS = POINTS + 2, CORNERS = 4096, DEPTH = 4 };

/* A set that a seed and a round number make again, and a worker for it. */
typedef struct fixture {
    double x[POINTS * DIMS];
    koksma_points p;
    bool exact; /* whether coordinates are multiples of 2^-bits */
    unsigned bits;
    oracle_rng rng;
    uint64_t round;
    ki_ranks kind[2];
    ki_worker w;
    const ki_ranks *ranks;
    ki_standing before[DEPTH][POINTS];  /* the points before each cell */
    bool listed[DIMS][RANKS];           /* ranks that a critical corner can have */
    koksma_interval deviation[CORNERS]; /* as next_corner goes */
    size_t moved;                       /* cells whose weights were moved */
} fixture;

static void require(const fixture *f, bool holds, const char *what)
{
    if (!holds)
        ck_abort_msg(
            "%s: KOKSMA_TEST_SEED=%llu, set %llu, n %zu, dim %zu, closed %d", what,
            (unsigned long long)oracle_seed(), (unsigned long long)f->round, f->p.n,
            f->p.dim, (int)f->ranks->closed);
}

/* ---- Sets -------------------------------------------------------------------- */

/* Coordinates that try the rounding: the least doubles, x^800, nearly 1, and some
 * that share a logarithm. */
static double extreme(oracle_rng *rng, size_t kind)
{
    double v = oracle_dyadic(rng, 53);

    switch (kind) {
    case 2: return (double)(1 + oracle_below(rng, 9)) * 0x1p-1074;
    case 3: return DBL_MIN * (1.0 + v);
    case 4: return pow(v, 800.0);
    case 5: return 1.0 - (double)(1 + oracle_below(rng, 9)) * 0x1p-53;
    case 6: return 1.0 - v * 0x1p-30;
    case 7: return 0.3 + v * 0x1p-51;
    case 8: return 0x1p-200 * (1.0 + v * 0x1p-48);
    default: return v;
    }
}

static double coordinate(fixture *f, size_t kind)
{
    if (kind < 2) return (double)kind;
    if (!f->exact) return extreme(&f->rng, kind);
    if (kind < 6) return oracle_dyadic(&f->rng, f->bits);
    return 1.0 - oracle_dyadic(&f->rng, f->bits - 2) / 4.0;
}

/* Few levels an axis make ties and, with few axes, repeats; the levels of an axis
 * are mostly of a kind. */
static void make_set(fixture *f, size_t dim, uint64_t round, bool exact)
{
    double level[POINTS];
    size_t levels;

    f->rng = oracle_rng_start(oracle_seed() + dim, round);
    f->round = round;
    f->exact = exact;
    f->bits = dim > 4 ? 110 / (unsigned)dim : 3 + (unsigned)round % 20;
    f->p = (koksma_points){f->x, 1 + oracle_below(&f->rng, dim > 4 ? 20 : 12), dim};
    levels = 2 + oracle_below(&f->rng, dim > 4 ? 2 : f->p.n);
    for (size_t k = 0; k < dim; k++) {
        size_t kind = oracle_below(&f->rng, 11);

        for (size_t j = 0; j < levels; j++)
            level[j] = coordinate(
                f, oracle_below(&f->rng, 4) > 0 ? kind : oracle_below(&f->rng, 11));
        for (size_t i = 0; i < f->p.n; i++)
            f->x[i * dim + k] = level[oracle_below(&f->rng, levels)];
    }
}

/* ---- Corners ----------------------------------------------------------------- */

/* An odometer whose last axis turns fastest. */
static bool next_corner(const uint32_t *low, const uint32_t *high, size_t dim,
                        uint32_t *z)
{
    for (size_t k = dim; k-- > 0; z[k] = low[k])
        if (z[k]++ < high[k]) return true;
    return false;
}

static bool within(const uint32_t *low, const uint32_t *high, size_t dim,
                   const uint32_t *z)
{
    for (size_t k = 0; k < dim; k++)
        if (z[k] < low[k] || z[k] > high[k]) return false;
    return true;
}

/* The greatest double that r is at least. */
static double rounded_down(oracle_ratio r)
{
    double d = ldexp((double)r.num / (double)r.n, -(int)r.shift);

    while (!oracle_at_least(r, d))
        d = nextafter(d, -2.0);
    while (oracle_at_least(r, nextafter(d, 2.0)))
        d = nextafter(d, 2.0);
    return d;
}

/* The deviation of corner z: no double lies between the ends of an exact one; else
 * it is at least lower, and nothing is said about upper. */
static koksma_interval deviation(const fixture *f, const uint32_t *z)
{
    double corner[DIMS], sign = f->ranks->closed ? 1.0 : -1.0, lower;
    oracle_int count, volume = (oracle_int)f->p.n;
    size_t inside;

    for (size_t k = 0; k < f->p.dim; k++)
        corner[k] = f->ranks->axis[k].value[z[k]];
    inside = oracle_count(f->p, corner, f->ranks->closed);
    lower = ki_deviation(sign, inside, f->p.n, ki_volume(corner, f->p.dim)).lower;
    if (!f->exact) return (koksma_interval){lower, lower};
    count = (oracle_int)inside << f->bits * f->p.dim;
    for (size_t k = 0; k < f->p.dim; k++)
        volume *= (oracle_int)ldexp(corner[k], (int)f->bits);

    oracle_ratio r = {f->ranks->closed ? count - volume : volume - count, f->p.n,
                      f->bits * (unsigned)f->p.dim};

    lower = rounded_down(r);
    return (koksma_interval){
        lower, oracle_at_most(r, lower) ? lower : nextafter(lower, 2.0)};
}

/* Whether every side of the corner ends at a point that the others leave inside, or
 * an open one at 1: the corners that tree_cell.c promises not to lose.  The point
 * itself is outside along that axis alone if the box is open, and else nowhere. */
static bool is_critical(const fixture *f, const uint32_t *z)
{
    const ki_ranks *r = f->ranks;
    bool held[DIMS] = {false};

    for (size_t i = 0; i < r->n; i++) {
        size_t outside = 0;

        for (size_t k = 0; k < r->dim; k++)
            outside += r->rank[k * r->n + i] + r->shift > z[k];
        for (size_t k = 0; k < r->dim; k++)
            held[k] |= outside == r->shift && r->rank[k * r->n + i] == z[k];
    }
    for (size_t k = 0; k < r->dim; k++)
        if (!held[k] && (r->closed || z[k] != r->axis[k].top)) return false;
    return true;
}

/* ---- The state of a cell ----------------------------------------------------- */

/* The axes along which point i is out, and open, counted anew. */
static ki_standing recount(const fixture *f, const ki_cell *c, size_t i)
{
    ki_standing s = {0};

    for (size_t k = 0; k < f->p.dim; k++) {
        uint32_t needs = f->ranks->rank[k * f->p.n + i] + f->ranks->shift;

        s.outs += needs > c->high[k];
        s.opens += needs > c->low[k] && needs <= c->high[k];
    }
    return s;
}

/* A point that is out need not be counted along every further axis. */
static void check_standing(const fixture *f, const ki_cell *c)
{
    size_t inside = 0, within = 0;

    for (size_t i = 0; i < f->p.n; i++) {
        ki_standing is = f->w.standing[i], truth = recount(f, c, i);

        require(f, is.outs <= truth.outs && (is.outs > 0) == (truth.outs > 0),
                "outs");
        require(f, truth.outs > 0 || is.opens == truth.opens, "opens");
        inside += truth.outs == 0 && truth.opens == 0;
        within += truth.outs == 0;
    }
    require(f, c->inside == inside, "inside");
    require(f, c->within == within, "within");
}

static void check_several(const fixture *f, const ki_cell *c)
{
    const uint32_t *several = f->w.several + c->several;
    bool seen[POINTS] = {false};

    for (size_t j = 0; j < c->severals; j++) {
        require(f, !seen[several[j]], "a point is there twice");
        seen[several[j]] = true;
    }
    for (size_t i = 0; i < f->p.n; i++) {
        ki_standing s = recount(f, c, i);

        require(f, seen[i] == (s.outs == 0 && s.opens > 1),
                "points open along several axes");
    }
}

/* The list of axis k, and the ranks in it.  At the end of a list an open box may
 * keep points, out along its axis, that have gone out along another since. */
static void check_list(fixture *f, const ki_cell *c, size_t k)
{
    const ki_ranks *r = f->ranks;
    const ki_entry *e = f->w.entry + c->begin[k], *end = f->w.entry + c->end[k];
    bool seen[POINTS] = {false};

    memset(f->listed[k], 0, sizeof f->listed[k]);
    if (!r->closed) f->listed[k][r->axis[k].top] = true;
    for (; e < end; e++) {
        require(f, !seen[e->point], "a point is listed twice");
        require(f, e->rank == r->rank[k * r->n + e->point], "rank");
        require(f, e + 1 == end || e->rank <= e[1].rank, "a list is not sorted");
        seen[e->point] = f->listed[k][e->rank] = true;
    }
    for (size_t i = 0; i < r->n; i++) {
        uint32_t rank = r->rank[k * r->n + i], own = rank + r->shift > c->high[k];
        bool ranges = rank >= c->low[k] && rank <= c->high[k],
             belongs = ranges && recount(f, c, i).outs == own;

        require(f, seen[i] || !belongs, "a list lacks a point");
        require(f, belongs || !seen[i] || (ranges && own),
                "a point is out elsewhere");
    }
}

static void check_state(fixture *f, const ki_cell *c)
{
    check_standing(f, c);
    check_several(f, c);
    for (size_t k = 0; k < f->p.dim; k++)
        check_list(f, c, k);
}

/* Narrow the cell to new_low, new_high and settle it; whether it is not empty.  The
 * bound may have left no rank of an axis: new_low above new_high. */
static bool narrow(fixture *f, ki_cell *c)
{
    size_t dim = f->p.dim, size = dim * sizeof *c->low;
    uint32_t low[DIMS], high[DIMS], z[DIMS];
    bool empty;

    memcpy(low, f->w.new_low, size);
    memcpy(high, f->w.new_high, size);
    memcpy(z, low, size);
    require(f, ki_cell_narrow(&f->w, c), "memory");
    check_standing(f, c);
    require(f, ki_cell_settle(&f->w, c, &empty), "memory");
    do
        if (within(low, high, dim, z) &&
            (empty || !within(c->low, c->high, dim, z)))
            require(f, !is_critical(f, z), "settling loses a corner");
    while (next_corner(low, high, dim, z));
    require(f, empty || within(low, high, dim, c->low), "more than was asked");
    if (empty) return false;
    check_state(f, c);
    for (size_t k = 0; k < dim; k++)
        require(f, f->listed[k][c->low[k]] && f->listed[k][c->high[k]], "ends");
    return true;
}

/* ---- The bound --------------------------------------------------------------- */

/* The units of tree_bound_closed.c and tree_bound_open.c. */
enum { CHARGE = 1 << 15, WEIGHT = 256 };

/* The weight of every point that is open is one of 0 to 1 (open boxes), or its
 * shares sum to a whole or more over the axes where it is open. */
static void check_weights(fixture *f, const ki_cell *c)
{
    const uint16_t *share = f->w.share;
    size_t sum[POINTS] = {0};
    bool moved = false;

    for (size_t k = 0; k < f->p.dim && f->ranks->closed; k++)
        for (size_t i = c->begin[k]; i < c->end[k]; i++, share++) {
            if (f->w.entry[i].rank == c->low[k]) continue;
            sum[f->w.entry[i].point] += *share;
            moved |= *share > 0 && *share < CHARGE;
        }
    for (size_t i = 0; i < f->p.n; i++) {
        ki_standing truth = recount(f, c, i);
        uint32_t weight = f->w.standing[i].choice;

        if (truth.outs > 0 || truth.opens == 0) continue;
        require(f, f->ranks->closed ? sum[i] >= CHARGE : weight <= WEIGHT,
                "weights");
        moved |= !f->ranks->closed && weight > 0 && weight < WEIGHT;
    }
    f->moved += moved;
}

/* No corner of listed ranks, as critical ones are, that reaches the target is cut
 * off. */
static void check_ranges(const fixture *f, const ki_cell *c, double target)
{
    size_t dim = f->p.dim, at = 0;
    uint32_t z[DIMS];

    memcpy(z, c->low, dim * sizeof *z);
    do {
        bool matters = f->deviation[at++].lower >= target;

        for (size_t k = 0; k < dim && matters; k++)
            matters = f->listed[k][z[k]];
        require(f, !matters || within(f->w.new_low, f->w.new_high, dim, z),
                "a corner is cut off");
    } while (next_corner(c->low, c->high, dim, z));
}

/* Returns whether the cell is still of interest. */
static bool check_bound(fixture *f, const ki_cell *c, double target,
                        koksma_interval most)
{
    bool single = memcmp(c->low, c->high, f->p.dim * sizeof *c->low) == 0;
    double bound;

    /* Shares that are left alone, since the cell is dismissed at once, pass. */
    if (f->w.share != NULL)
        memset(f->w.share, 0xff, f->w.room_shares * sizeof *f->w.share);
    bound = ki_cell_bound(&f->w, c, target);
    require(f, fabs(bound) < HUGE_VAL, "no bound");
    require(f, most.lower < target || bound >= most.upper, "the bound is too low");
    require(f, !single || bound <= most.lower + 1e-9, "the bound of one corner");
    check_weights(f, c);
    if (bound < target) return false;
    check_ranges(f, c, target);
    return true;
}

/* Bound the cell with several targets; whether the last leaves anything of it. */
static bool check_bounds(fixture *f, const ki_cell *c)
{
    koksma_interval most = {-1.0, -1.0};
    size_t dim = f->p.dim, at = 0;
    uint32_t z[DIMS];

    memcpy(z, c->low, dim * sizeof *z);
    do {
        koksma_interval v = f->deviation[at++] = deviation(f, z);

        most.lower = fmax(most.lower, v.lower);
        most.upper = fmax(most.upper, v.upper);
    } while (next_corner(c->low, c->high, dim, z));

    double peak = fmax(most.lower, 0.0), part = oracle_dyadic(&f->rng, 10);

    check_bound(f, c, -1.0, most); /* all corners; it makes room for shares */
    check_bound(f, c, 0.0, most);
    check_bound(f, c, nextafter(peak, 2.0), most);
    check_bound(f, c, peak + 0.01 * part, most);
    check_bound(f, c, peak, most);
    return check_bound(f, c, peak * (1.0 - part * part), most);
}

/* ---- Paths of cells ---------------------------------------------------------- */

/* A part of the cell, with few enough corners, to new_low and new_high. */
static void draw_part(fixture *f, const ki_cell *c)
{
    uint32_t *low = f->w.new_low, *high = f->w.new_high;
    size_t dim = f->p.dim;
    double corners = 1.0;

    for (size_t k = 0; k < dim; k++) {
        low[k] = c->low[k];
        high[k] = c->high[k];
        corners *= high[k] - low[k] + 1.0;
    }
    for (size_t cuts = oracle_below(&f->rng, 6); cuts > 0 || corners > CORNERS;) {
        size_t k = oracle_below(&f->rng, dim);

        cuts -= cuts > 0;
        if (low[k] == high[k]) continue;
        corners /= high[k] - low[k] + 1.0;
        if (oracle_below(&f->rng, 3) > 0)
            low[k] += 1 + (uint32_t)oracle_below(&f->rng, high[k] - low[k]);
        else
            high[k] -= 1 + (uint32_t)oracle_below(&f->rng, high[k] - low[k]);
        corners *= high[k] - low[k] + 1.0;
    }
}

/* Enter a part of the last cell, bound it, and narrow it by what the bound says;
 * whether any of it is left. */
static bool enter(fixture *f, size_t depth)
{
    ki_cell *c = ki_cell_enter(&f->w, depth);

    require(f, c != NULL, "memory");
    memcpy(f->before[depth - 1], f->w.standing, f->p.n * sizeof *f->w.standing);
    draw_part(f, c);
    for (int i = 0; i < 2; i++) {
        if (!narrow(f, c)) return false;
        if (!check_bounds(f, c)) break;
    }
    return true;
}

static void leave(fixture *f, size_t depth)
{
    ki_cell_leave(&f->w, &f->w.cell[depth]);
    for (size_t i = 0; i < f->p.n; i++) {
        ki_standing now = f->w.standing[i], before = f->before[depth - 1][i];

        require(f, now.outs == before.outs && now.opens == before.opens, "leave");
    }
    check_state(f, &f->w.cell[depth - 1]);
}

/* Paths down and back up, unless no box has a volume. */
static void check_paths(fixture *f)
{
    size_t depth = 0;

    for (size_t k = 0; k < f->p.dim; k++)
        if (f->ranks->axis[k].top == 0) return;
    ck_assert(ki_worker_begin(&f->w, NULL, f->ranks) == KOKSMA_OK);
    check_state(f, f->w.cell);
    for (int step = 0; step < 8; step++)
        if (depth == DEPTH || (depth > 0 && oracle_below(&f->rng, 3) == 0))
            leave(f, depth--);
        else if (!enter(f, ++depth))
            leave(f, depth--);
    while (depth > 0)
        leave(f, depth--);
    ki_worker_end(&f->w);
}

static const struct shape {
    size_t dim, sets;
    bool exact;
} shapes[] = {{1, 500, true},  {2, 500, true},  {3, 300, true},  {4, 200, true},
              {9, 20, true},   {12, 20, true},  {15, 10, true},  {1, 500, false},
              {2, 500, false}, {3, 300, false}, {4, 200, false}, {10, 20, false}};

/* From 9 axes on the weights move, and the test would be in vain if none did. */
START_TEST(cells_are_bounded)
{
    static fixture f;
    const struct shape *s = &shapes[_i];

    f.moved = 0;
    for (uint64_t round = 0; round < s->sets * oracle_scale(); round++) {
        make_set(&f, s->dim, round, s->exact);
        for (int closed = 0; closed < 2; closed++) {
            ki_ranks *r = &f.kind[closed];

            ck_assert(ki_ranks_make(r, f.p, closed, &ki_star_measure) == KOKSMA_OK);
            f.ranks = r;
            check_paths(&f);
            ki_ranks_free(r);
        }
    }
    ck_assert(s->dim < 9 ? f.moved == 0 : f.moved > 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("star_bound");
    TCase *tc = tcase_create("cells");

    tcase_set_timeout(tc, 20.0 * (double)oracle_scale());
    tcase_add_loop_test(tc, cells_are_bounded, 0, sizeof shapes / sizeof *shapes);
    suite_add_tcase(suite, tc);
    return oracle_run(suite);
}
