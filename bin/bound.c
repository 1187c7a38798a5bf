/* koksma-bound: what theory says of the error of N points. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bound_input.h"
#include "bound_report.h"
#include "cli.h"
#include "cli_integrand.h"

enum {
    BOUNCES = CLI_LONG,
    STAR,
    VHK,
    SMOOTH_VHK,
    SMOOTH,
    JUMP,
    AREA,
    EXTENT,
    AXES,
    SIGMA,
    REACH,
    OBSERVE,
    EXPLAIN
};

static const cli_option options[] = {
    {'a', "parameter", "NAME=V", "a parameter of the integrand; V: the first"},
    {'d', "dim", "DIM", "the dimension"},
    {BOUNCES, "bounces", "N", "steps of a walk in the scene, two coordinates each"},
    {'n', "points", "A:B|N,N,...", "these N (default: those read, or 2^4:2^20)"},
    {STAR, "star", "D", "an upper bound of D*, for one N"},
    {VHK, "vhk", "V", "the variation, in closed form"},
    {SMOOTH_VHK, "smooth-vhk", "V", "that of the smooth part"},
    {SMOOTH, "smooth", "B", "the smooth part's error is B/N, as koksma-fit says"},
    {JUMP, "jump", "J", "the jump"},
    {AREA, "area", "S", "area of the discontinuity"},
    {EXTENT, "extent", "L", "its extent"},
    {AXES, "axes", "D", "coordinates that it depends on (default: all)"},
    {SIGMA, "sigma", "V", "standard deviation of the integrand"},
    {REACH, "reach", "Z", "how many sigma the reach is (default 2)"},
    {OBSERVE, "observe", "FILE", "koksma-error's table, set beside"},
    {EXPLAIN, "explain", NULL, "write a paragraph about the last N instead"},
    {0},
};

static const cli_tool tool = {"koksma-bound", "[INTEGRAND] [FILE]...",
                              "Write what theory says of the error of N points.",
                              options};

typedef struct bound_options {
    cli_integrand integrand;
    bound_input input;
    const char *list, *observe;
    double star, z;
    bool explain;
} bound_options;

static double real(const char *option)
{
    return cli_real(option, optarg, 0.0, 1e300);
}

static void read_options(bound_options *o, int argc, char *argv[])
{
    koksma_bound_facts *f = &o->input.facts;
    int c;

    while ((c = cli_next(&tool, argc, argv)) != -1)
        switch (c) {
        case 'a': cli_integrand_set(&o->integrand, "-a", NULL); break;
        case 'd': o->integrand.dim = cli_count("-d", optarg, 1, 1000000000); break;
        case BOUNCES:
            o->integrand.bounces = cli_count("--bounces", optarg, 1, 1000);
            break;
        case 'n': o->list = optarg; break;
        case STAR: o->star = cli_real("--star", optarg, 0.0, 1.0); break;
        case VHK:
            f->vhk = real("--vhk");
            f->vhk_from = KOKSMA_VHK_CLOSED;
            break;
        case SMOOTH_VHK: f->smooth_vhk = real("--smooth-vhk"); break;
        case SMOOTH: f->smooth = real("--smooth"); break;
        case JUMP: f->jump = f->jump_rms = real("--jump"); break;
        case AREA: f->area = real("--area"); break;
        case EXTENT: f->extent = real("--extent"); break;
        case AXES: f->axes = cli_real("--axes", optarg, 1.0, 1e9); break;
        case SIGMA: f->sigma = real("--sigma"); break;
        case REACH: o->z = real("--reach"); break;
        case OBSERVE: o->observe = optarg; break;
        case EXPLAIN: o->explain = true; break;
        }
}

static void settle(double *to, double v)
{
    if (isnan(*to)) *to = v;
}

/* What is known of the integrand, where the command line does not say it. */
static void add_integrand(bound_options *o, const char *name)
{
    koksma_bound_facts *to = &o->input.facts;
    cli_integrand *i = &o->integrand;
    koksma_facts whole, rest;
    koksma_integrand f;
    koksma_error err;

    cli_integrand_choose(i, name);
    if (koksma_integrand_make(&f, &whole, i->row, i->dim, i->param, &err))
        cli_usage("%s", err.text);
    cli_integrand_about(o->input.about, i->row, &f, NULL);
    to->dim = f.dim;
    rest = whole;
    koksma_integrand_split(&f, &rest, i->row, KOKSMA_PART_SMOOTH);
    if (to->vhk_from == KOKSMA_VHK_UNKNOWN && !isnan(whole.variation)) {
        to->vhk = whole.variation;
        to->vhk_from = KOKSMA_VHK_CLOSED;
    }
    settle(&to->smooth_vhk, rest.variation);
    settle(&to->jump, whole.jump);
    settle(&to->jump_rms, whole.jump_rms);
    settle(&to->area, whole.area);
    settle(&to->extent, whole.extent);
    settle(&to->axes, whole.axes);
    settle(&to->sigma, sqrt(whole.variance));
}

/* The N's of the curve, where there are any. */
static size_t take_points(uint64_t **n, const bound_curve *c)
{
    size_t count = 0;

    if (c->count == 0) return 0;
    *n = malloc(c->count * sizeof **n);
    if (*n == NULL) cli_fail("not enough memory for %zu N", c->count);
    for (size_t i = 0; i < c->count; i++)
        if (c->n[i] >= 1.0 && c->n[i] <= 0x1p53 && c->n[i] == floor(c->n[i]))
            (*n)[count++] = (uint64_t)c->n[i];
    return count;
}

static size_t choose_points(uint64_t **n, bound_options *o)
{
    bound_input *b = &o->input;
    size_t count = 0;

    if (o->list != NULL)
        count = cli_prefixes(n, "-n", o->list, 1);
    else if ((count = take_points(n, &b->star)) == 0 &&
             (count = take_points(n, &b->observed)) == 0)
        count = cli_prefixes(n, "-n", "2^4:2^20", 1);
    if (isnan(o->star)) return count;
    if (o->list == NULL || count != 1)
        cli_usage("--star takes -n with the one N that it is D* of");
    bound_curve_set(&b->star, (double)(*n)[0], o->star);
    return count;
}

int main(int argc, char *argv[])
{
    bound_options o = {.star = (double)NAN, .z = 2.0};
    bound_report r = {.input = &o.input};
    uint64_t *n = NULL;

    o.input.facts = koksma_bound_no_facts(0);
    o.input.cells = o.input.growth = (double)NAN;
    read_options(&o, argc, argv);
    if (optind < argc && cli_integrand_exists(argv[optind])) {
        add_integrand(&o, argv[optind++]);
        r.integrand = o.integrand.row->name;
    } else {
        if (o.integrand.count + o.integrand.bounces > 0)
            cli_usage("-a and --bounces are for integrands, and none is named");
        o.input.facts.dim = o.integrand.dim;
    }
    for (; optind < argc; optind++)
        bound_read_table(&o.input, argv[optind]);
    if (o.observe != NULL) bound_read_observed(&o.input, o.observe);
    if (o.input.facts.dim == 0)
        cli_usage("name an integrand, or say the dimension by -d");
    r.z = o.z;
    r.count = choose_points(&n, &o);
    r.n = n;
    (o.explain ? bound_explain : bound_print)(&r);
    bound_input_free(&o.input);
    free(n);
    cli_finish(CLI_DONE);
}
