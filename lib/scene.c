#include "scene.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "integrand_kernels.h"
#include "scene_kernels.h"

enum { ALBEDO, CAP, HEIGHT, AZIMUTH, PATCH }; /* param */

/* derived: the light's centre; 4 times its share and that of the patch, which are
 * the squares of their chords; of the azimuth, and of the latitude. */
enum { LIGHT, LIGHT_CHORD = LIGHT + 3, PATCH_CHORD, COSINE, SINE, LEVEL };

static const double TURN = 6.28318530717958647693;
static const double VIEWED[3] = {0.0, 0.0, -1.0};

const koksma_integrand_row *koksma_scene_find(const char *name)
{
    for (const koksma_integrand_row *const *r = koksma_scenes; *r != NULL; r++)
        if (strcmp((*r)->name, name) == 0) return *r;
    return NULL;
}

/* The chord keeps its digits for the smallest caps; the cosine, next to 1, does
 * not. */
static bool is_within(const double *at, const double *centre, double chord)
{
    double x = at[0] - centre[0], y = at[1] - centre[1], z = at[2] - centre[2];

    return x * x + y * y + z * z < chord;
}

/* What a walk finds: the sum of the weights of the steps that end in the cap, and
 * bit i - 1 for step i. */
typedef struct found {
    double sum;
    size_t steps;
} found;

/* weight is `first`, times albedo at each step; only_last: the others do not count,
 * and the last has bit 0. */
static found follow(ki_walk w, const double *x, size_t steps, double albedo,
                    double first, const double *centre, double chord,
                    bool only_last)
{
    found out = {0.0, 0};
    double weight = first;

    for (size_t i = 0; i < steps; i++) {
        bool counts;

        ki_walk_step(&w, x[2 * i], x[2 * i + 1]);
        weight *= albedo;
        counts = (i + 1 == steps || !only_last) & is_within(w.at, centre, chord);
        out.sum += counts ? weight : 0.0;
        out.steps |= (size_t)counts << (only_last ? 0 : i);
    }
    return out;
}

/* ---- Gathering --------------------------------------------------------------- */

static found gather(const koksma_integrand *f, const double *x, bool only_last)
{
    static const ki_walk start = {
        {0.0, 0.0, -1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};

    return follow(start, x, f->dim / 2, f->param[ALBEDO], 1.0, f->derived + LIGHT,
                  f->derived[LIGHT_CHORD], only_last);
}

static double gather_one(const koksma_integrand *f, const double *x)
{
    return gather(f, x, true).sum;
}

static size_t gather_one_piece(const koksma_integrand *f, const double *x)
{
    return gather(f, x, true).steps;
}

static double gather_sum(const koksma_integrand *f, const double *x)
{
    return gather(f, x, false).sum;
}

static size_t gather_sum_piece(const koksma_integrand *f, const double *x)
{
    return gather(f, x, false).steps;
}

/* ---- Shooting ---------------------------------------------------------------- */

/* The point of the light at the share u of its way from the centre to the rim, and
 * the azimuth 2 pi v: what a step from the point opposite does. */
static ki_walk start_on_light(const koksma_integrand *f, double u, double v)
{
    const double *c = f->derived + LIGHT;
    double h = f->param[HEIGHT], cosine = f->derived[COSINE],
           sine = f->derived[SINE];
    ki_walk w = {{-c[0], -c[1], -c[2]},
                 {-sine, cosine, 0.0},
                 {-h * cosine, -h * sine, f->derived[LEVEL]}};

    ki_walk_step(&w, 1.0 - f->param[CAP] * u, v);
    return w;
}

static found shoot(const koksma_integrand *f, const double *x, bool only_last)
{
    return follow(start_on_light(f, x[0], x[1]), x + 2, f->dim / 2 - 1,
                  f->param[ALBEDO], f->param[CAP] / f->param[PATCH], VIEWED,
                  f->derived[PATCH_CHORD], only_last);
}

static double shoot_one(const koksma_integrand *f, const double *x)
{
    return shoot(f, x, true).sum;
}

static size_t shoot_one_piece(const koksma_integrand *f, const double *x)
{
    return shoot(f, x, true).steps;
}

static double shoot_sum(const koksma_integrand *f, const double *x)
{
    return shoot(f, x, false).sum;
}

static size_t shoot_sum_piece(const koksma_integrand *f, const double *x)
{
    return shoot(f, x, false).steps;
}

/* ---- Facts ------------------------------------------------------------------- */

static bool is_shooting(const koksma_integrand *f)
{
    return f->value == shoot_one || f->value == shoot_sum;
}

size_t koksma_scene_bounces(const koksma_integrand *f)
{
    return f->dim / 2 - is_shooting(f);
}

double koksma_scene_neumann(const koksma_integrand *f)
{
    return f->param[CAP] * f->param[ALBEDO] / (1.0 - f->param[ALBEDO]);
}

static void prepare(koksma_integrand *f)
{
    double h = f->param[HEIGHT], level = sqrt((1.0 - h) * (1.0 + h));
    double cosine, sine;

    ki_turn(&cosine, &sine, f->param[AZIMUTH] / TURN);
    f->derived[COSINE] = cosine;
    f->derived[SINE] = sine;
    f->derived[LEVEL] = level;
    f->derived[LIGHT] = level * cosine;
    f->derived[LIGHT + 1] = level * sine;
    f->derived[LIGHT + 2] = h;
    f->derived[LIGHT_CHORD] = 4.0 * f->param[CAP];
    f->derived[PATCH_CHORD] = 4.0 * f->param[PATCH];
}

/* A step along the axis towards or from a light on it: a jump in one coordinate. */
static void facts_on_axis(koksma_facts *out)
{
    out->area = out->extent = out->axes = 1.0;
    out->variation = out->jump;
}

/* The points of a walk are independent and uniform: step i adds weight^2 q (1 - q),
 * q the share of the cap that counts.  With all coordinates fixed but those of the
 * last step, a set of the square is left whose rim is askew to both, and a function
 * of finite variation has finite variation on every such face. */
static void facts(koksma_facts *out, const koksma_integrand *f)
{
    size_t steps = koksma_scene_bounces(f);
    bool shooting = is_shooting(f), on_axis = fabs(f->param[HEIGHT]) == 1.0;
    bool only_last = f->value == gather_one || f->value == shoot_one;
    double q = f->param[shooting ? PATCH : CAP], albedo = f->param[ALBEDO];
    double weight = f->param[CAP] / q, mean = 0.0, square = 0.0;

    for (size_t i = 1; i <= steps; i++) {
        weight *= albedo;
        if (i < steps && only_last) continue;
        mean += weight;
        square += weight * weight;
    }
    *out = ki_facts_indicator(mean * q, 0.0, (double)NAN, (double)NAN, f->dim);
    out->error = 2.0 * (double)(steps + 2) * DBL_EPSILON * out->integral;
    out->variance = square * q * (1.0 - q);
    out->jump = only_last ? weight : f->param[CAP] / q * albedo;
    out->jump_rms = only_last || steps == 1 ? out->jump : (double)NAN;
    out->axes = (double)(f->dim - on_axis);
    if (!only_last) out->pieces = ldexp(1.0, (int)steps);
    if (on_axis && !shooting && steps == 1) facts_on_axis(out);
}

/* ---- Rows -------------------------------------------------------------------- */

/* A sum has a piece for every set of its bounces, and size_t has the bits. */
enum { BOUNCES_MOST = 1000, TERMS_MOST = 8 * sizeof(size_t) - 1 };

#define LIGHT_PARAMS                                                               \
    {"albedo", 0.5, 0.0, 1.0, KOKSMA_OPEN}, {"cap", 0.2, 0.0, 1.0, KOKSMA_OPEN},   \
        {"height", 0.3, -1.0, 1.0, KOKSMA_CLOSED},                                 \
    {                                                                              \
        "azimuth", 1.1, 0.0, 6.3, KOKSMA_CLOSED                                    \
    }

static const koksma_integrand_row sphere = {
    .name = "sphere",
    .summary = "light that reaches a point after dim/2 bounces",
    .dim = 2,
    .dim_least = 2,
    .dim_most = 2 * BOUNCES_MOST,
    .dim_step = 2,
    .params = {LIGHT_PARAMS},
    .functions = {.value = gather_one, .piece = gather_one_piece},
    .prepare = prepare,
    .facts = facts,
};

static const koksma_integrand_row sphere_sum = {
    .name = "sphere-sum",
    .summary = "the same after 1, ..., dim/2 bounces",
    .dim = 2,
    .dim_least = 2,
    .dim_most = 2 * TERMS_MOST,
    .dim_step = 2,
    .params = {LIGHT_PARAMS},
    .functions = {.value = gather_sum, .piece = gather_sum_piece},
    .prepare = prepare,
    .facts = facts,
};

static const koksma_integrand_row sphere_shoot = {
    .name = "sphere-shoot",
    .summary = "from the light to a patch in dim/2 - 1 bounces",
    .dim = 4,
    .dim_least = 4,
    .dim_most = 2 * BOUNCES_MOST + 2,
    .dim_step = 2,
    .params = {LIGHT_PARAMS, {"patch", 0.2, 0.0, 1.0, KOKSMA_OPEN}},
    .functions = {.value = shoot_one, .piece = shoot_one_piece},
    .prepare = prepare,
    .facts = facts,
};

static const koksma_integrand_row sphere_shoot_sum = {
    .name = "sphere-shoot-sum",
    .summary = "the same after 1, ..., dim/2 - 1 bounces",
    .dim = 4,
    .dim_least = 4,
    .dim_most = 2 * TERMS_MOST + 2,
    .dim_step = 2,
    .params = {LIGHT_PARAMS, {"patch", 0.2, 0.0, 1.0, KOKSMA_OPEN}},
    .functions = {.value = shoot_sum, .piece = shoot_sum_piece},
    .prepare = prepare,
    .facts = facts,
};

const koksma_integrand_row *const koksma_scenes[] = {
    &sphere, &sphere_sum, &sphere_shoot, &sphere_shoot_sum, NULL,
};
