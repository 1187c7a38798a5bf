/* How often random lines cross a discontinuity, and by how much f jumps there. */
#include <math.h>
#include <stdlib.h>

#include "cells_kernels.h"
#include "error.h"
#include "num_kernels.h"

enum {
    HALVINGS = 40,
    PILOT = 4096,     /* points that give the range of f first */
    STACK = 64,       /* pieces of a step that wait */
    SCALES_MOST = 20, /* strides 1, 2, 4, ... */
    COARSEST = 4      /* no stride leaves fewer steps */
};

/* Of lines of one kind: sums over lines of the crossings and of their squares. */
typedef struct tally {
    double count, squares;
} tally;

typedef struct crossing {
    const koksma_integrand *f;
    koksma_lines_opts opts;
    ki_line line;
    double *memory;   /* of what follows, but for kind */
    double *x, *room; /* a point; room for directions */
    double *value,
        *sum;    /* at the ends of the steps: f, and the jumps up to there */
    tally *kind; /* those along each axis, and those across */
    double
        change[SCALES_MOST]; /* how often sums differ over a stride, along axes */
    double low, high;        /* the range of f so far */
    double jump, squares[2], jumps[2]; /* the largest; along axes, and across */
    double work;
    bool finite;
} crossing;

/* A piece of a line, and f at its ends. */
typedef struct piece {
    double a, b, fa, fb;
} piece;

/* ---- One line ---------------------------------------------------------------- */

static double value_of(crossing *c)
{
    double v = c->f->value(c->f, c->x);

    c->work += 1.0;
    if (!isfinite(v)) {
        c->finite = false;
        v = 0.0;
    }
    return v;
}

static double value_at(crossing *c, double t)
{
    for (size_t k = 0; k < c->f->dim; k++)
        c->x[k] = fmin(fmax(c->line.start[k] + t * c->line.way[k], 0.0), 1.0);
    return value_of(c);
}

static double see(crossing *c, double v)
{
    c->low = fmin(c->low, v);
    c->high = fmax(c->high, v);
    return v;
}

static double least_jump(const crossing *c)
{
    return c->opts.tolerance * (c->high - c->low);
}

/* Halve the piece into the half with the larger change.  Returns whether what is
 * left still changes by more than least. */
static bool narrow(crossing *c, piece *p, double least)
{
    for (int i = 0; i < HALVINGS; i++) {
        double mid = 0.5 * (p->a + p->b), v = value_at(c, mid);

        if (fabs(v - p->fa) >= fabs(p->fb - v)) {
            p->b = mid;
            p->fb = v;
        } else {
            p->a = mid;
            p->fa = v;
        }
        if (!(fabs(p->fb - p->fa) > least)) return false;
    }
    return true;
}

/* The jumps within a piece: how many; their sum goes to *sum. */
static double jumps_within(crossing *c, piece whole, bool across, double *sum)
{
    double least = least_jump(c), count = 0.0;
    piece stack[STACK];
    size_t waiting = 1;

    stack[0] = whole;
    while (waiting > 0) {
        piece outer = stack[--waiting], p = outer;
        double size;

        if (!(fabs(p.fb - p.fa) > least) || !narrow(c, &p, least)) continue;
        size = fabs(p.fb - p.fa);
        count += 1.0;
        *sum += p.fb - p.fa;
        c->jump = fmax(c->jump, size);
        c->squares[across] += size * size;
        c->jumps[across] += 1.0;
        if (waiting + 2 > STACK) continue;
        stack[waiting++] = (piece){outer.a, p.a, outer.fa, p.fa};
        stack[waiting++] = (piece){p.b, outer.b, p.fb, outer.fb};
    }
    return count;
}

/* Go along the line and count its crossings.  Its ends are left out: what f does on
 * the faces of the cube is not inside. */
static double cross(crossing *c, bool across)
{
    size_t steps = c->opts.steps;
    double count = 0.0, end = c->line.length;

    for (size_t i = 0; i <= steps; i++) {
        double share = (double)i / (double)steps;

        share = fmin(fmax(share, 0x1p-41), 1.0 - 0x1p-41);
        c->value[i] = see(c, value_at(c, share * end));
    }
    c->sum[0] = 0.0;
    for (size_t i = 0; i < steps; i++) {
        piece p = {end * (double)i / (double)steps,
                   end * (double)(i + 1) / (double)steps, c->value[i],
                   c->value[i + 1]};

        c->sum[i + 1] = c->sum[i];
        count += jumps_within(c, p, across, &c->sum[i + 1]);
    }
    return count;
}

/* How often the sum of the jumps differs over strides of 1, 2, 4, ... steps. */
static void count_changes(crossing *c)
{
    size_t steps = c->opts.steps, stride = 1;

    for (int scale = 0; scale < SCALES_MOST; scale++, stride *= 2) {
        if (steps % stride != 0 || steps / stride < COARSEST) return;
        for (size_t i = 0; i < steps; i += stride)
            c->change[scale] +=
                fabs(c->sum[i + stride] - c->sum[i]) > least_jump(c);
    }
}

/* One line along each axis, and one across. */
static void cross_all(crossing *c, koksma_rng *rng)
{
    size_t dim = c->f->dim;

    for (size_t kind = 0; kind <= dim; kind++) {
        double count;

        if (kind < dim)
            ki_line_along(&c->line, dim, kind, rng);
        else
            ki_line_across(&c->line, dim, c->room, rng);
        count = cross(c, kind == dim);
        c->kind[kind].count += count;
        c->kind[kind].squares += count * count;
        if (kind < dim) count_changes(c);
    }
}

/* ---- What the lines say ------------------------------------------------------ */

/* factor times the sum of the means of some kinds. */
static koksma_estimate estimate(const crossing *c, const tally *kind, size_t kinds,
                                size_t lines, double factor)
{
    koksma_estimate e = {0.0, (double)NAN, (double)NAN, 0.0};
    double n = (double)lines, variance = 0.0, unseen = 0.0, half;

    for (size_t k = 0; k < kinds; k++) {
        double mean = kind[k].count / n;
        double spread = (kind[k].squares - n * mean * mean) / (n - 1.0);

        e.value += factor * mean;
        if (kind[k].squares * n <= kind[k].count * kind[k].count)
            unseen -= log(0.5 * (1.0 - c->opts.level)) / n;
        else
            variance += spread / n;
    }
    if (lines < 2) return e;
    half = factor * hypot(unseen, sqrt(variance) * ki_student_quantile(
                                                       c->opts.level, lines - 1));
    e.lower = fmax(e.value - half, 0.0);
    e.upper = e.value + half;
    e.level = c->opts.level;
    return e;
}

static koksma_cell_slope slope(const crossing *c)
{
    double k[SCALES_MOST], count[SCALES_MOST];
    koksma_cell_slope s;
    size_t scales = 0;

    for (double steps = (double)c->opts.steps;
         scales < SCALES_MOST && c->change[scales] > 0.0; scales++, steps /= 2.0) {
        k[scales] = steps;
        count[scales] = c->change[scales];
    }
    s = ki_slope(k, count, scales);
    s.value += (double)(c->f->dim - 1);
    return s;
}

static void sum_up(koksma_lines_result *out, koksma_estimate *axes,
                   const crossing *c, size_t lines)
{
    size_t dim = c->f->dim;
    bool across = c->jumps[1] > 0.0;

    *out = (koksma_lines_result){
        .extent = estimate(c, c->kind, dim, lines, 1.0),
        .area = estimate(c, c->kind + dim, 1, lines, (double)dim),
        .jump = c->jump,
        .slope = slope(c),
        .lines = lines,
        .least_jump = least_jump(c),
        .work = c->work};
    if (c->jumps[across] > 0.0)
        out->jump_rms = sqrt(c->squares[across] / c->jumps[across]);
    for (size_t k = 0; k < dim; k++) {
        out->axes += c->kind[k].count > 0.0;
        if (axes != NULL) axes[k] = estimate(c, c->kind + k, 1, lines, 1.0);
    }
}

/* ---- What is public ---------------------------------------------------------- */

static koksma_status check_opts(const koksma_lines_opts *o, koksma_error *err)
{
    if (o->lines < 2 || o->lines > UINT32_MAX)
        return ki_fail(err, KOKSMA_EINVAL, 0, "%zu lines, not from 2 to 2^32 - 1",
                       o->lines);
    if (o->steps < 1 || o->steps > 1u << 20)
        return ki_fail(err, KOKSMA_EINVAL, 0, "%zu steps, not from 1 to 2^20",
                       o->steps);
    if (!(o->tolerance > 0.0 && o->tolerance < 1.0))
        return ki_fail(err, KOKSMA_EINVAL, 0, "a tolerance of %g, not in (0,1)",
                       o->tolerance);
    if (!(o->level > 0.0 && o->level < 1.0))
        return ki_fail(err, KOKSMA_EINVAL, 0, "a level of %g, not in (0,1)",
                       o->level);
    return KOKSMA_OK;
}

/* All of the memory in one piece: start, way, x, room, value, sum, tallies. */
static koksma_status open_crossing(crossing *c, const koksma_integrand *f,
                                   const koksma_lines_opts *o, koksma_error *err)
{
    size_t dim = f->dim, ends = o->steps + 1;
    double *at = ki_alloc(6 * dim + 4 + 2 * ends, sizeof *at);

    *c = (crossing){
        .f = f, .opts = *o, .low = HUGE_VAL, .high = -HUGE_VAL, .finite = true};
    c->kind = ki_alloc(dim + 1, sizeof *c->kind);
    if (at == NULL || c->kind == NULL) {
        free(at);
        free(c->kind);
        return ki_fail_memory(err, "lines");
    }
    c->memory = at;
    c->line.start = at;
    c->line.way = at + dim;
    c->x = at + 2 * dim;
    c->room = at + 3 * dim;
    c->value = at + 4 * dim + 4;
    c->sum = c->value + ends;
    for (size_t k = 0; k <= dim; k++)
        c->kind[k] = (tally){0.0, 0.0};
    return KOKSMA_OK;
}

static void see_range(crossing *c, koksma_rng *rng)
{
    for (int i = 0; i < PILOT; i++) {
        for (size_t k = 0; k < c->f->dim; k++)
            c->x[k] = koksma_rng_unit(rng);
        see(c, value_of(c));
    }
}

/* Returns how many lines of each kind were crossed. */
static size_t cross_lines(crossing *c, koksma_rng *rng)
{
    size_t lines = 0;

    while (lines < c->opts.lines && c->finite) {
        double extent = 0.0;

        cross_all(c, rng);
        lines++;
        for (size_t k = 0; k < c->f->dim; k++)
            extent += c->kind[k].count / (double)lines;
        if (c->opts.progress != NULL && lines < c->opts.lines &&
            c->opts.progress(c->opts.state, extent, extent, c->work) != 0)
            break;
    }
    return lines;
}

koksma_status koksma_lines(koksma_lines_result *out, koksma_estimate *axes,
                           const koksma_integrand *f, const koksma_lines_opts *opts,
                           koksma_error *err)
{
    koksma_lines_opts o = KOKSMA_LINES_DEFAULTS;
    koksma_rng rng;
    koksma_status status;
    crossing c = {0};
    size_t lines;

    if (opts != NULL) o = *opts;
    status = check_opts(&o, err);
    if (status == KOKSMA_OK) status = open_crossing(&c, f, &o, err);
    if (status != KOKSMA_OK) return status;
    rng = koksma_rng_seed(o.seed, 0);
    see_range(&c, &rng);
    lines = cross_lines(&c, &rng);
    if (!c.finite)
        status = ki_fail(err, KOKSMA_EDOMAIN, 0, "a value is not finite");
    else
        sum_up(out, axes, &c, lines);
    free(c.kind);
    free(c.memory);
    if (status == KOKSMA_OK && lines < o.lines)
        return ki_fail(err, KOKSMA_STOPPED, 0, "stopped after %zu lines of %zu",
                       lines, o.lines);
    return status;
}
