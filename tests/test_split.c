/* The smooth part of each integrand and the part that jumps: they add up, in values
 * and in integrals, and the smooth part is smooth. */
#include "integrand_fixture.h"
#include "oracle.h"

typedef struct parts {
    koksma_integrand whole, smooth, jump;
    koksma_facts of_whole, of_smooth, of_jump;
} parts;

static parts split(const koksma_integrand_row *row, const double *param)
{
    parts p;

    ck_assert_int_eq(
        koksma_integrand_make(&p.whole, &p.of_whole, row, 0, param, NULL), 0);
    p.smooth = p.jump = p.whole;
    p.of_smooth = p.of_jump = p.of_whole;
    koksma_integrand_split(&p.smooth, &p.of_smooth, row, KOKSMA_PART_SMOOTH);
    koksma_integrand_split(&p.jump, &p.of_jump, row, KOKSMA_PART_JUMP);
    return p;
}

/* What a part returns inside the cube is in what it says of the cube. */
static void check_range(const char *name, const koksma_integrand *f,
                        const double *x)
{
    double lower[64] = {0.0}, upper[64];
    koksma_interval all;
    double v;

    if (f->range == NULL) return;
    for (size_t k = 0; k < f->dim; k++) {
        if (x[k] <= 0.0 || x[k] >= 1.0) return;
        upper[k] = 1.0;
    }
    all = f->range(f, lower, upper).value;
    v = f->value(f, x);
    ck_assert_msg(all.lower <= v && v <= all.upper,
                  "%s: %.17g is not in [%.17g, %.17g]", name, v, all.lower,
                  all.upper);
}

/* Values within a rounding, and the smooth one without a change of piece. */
static void check_values(const char *name, const parts *p)
{
    oracle_rng rng = oracle_rng_start(oracle_seed(), 0);
    double x[64];

    for (int i = 0; i < 500; i++) {
        double v, smooth, jump;

        for (size_t k = 0; k < p->whole.dim; k++)
            x[k] = ldexp((double)oracle_below(&rng, 17), -4); /* on surfaces too */
        v = p->whole.value(&p->whole, x);
        smooth = p->smooth.value(&p->smooth, x);
        jump = p->jump.value(&p->jump, x);
        ck_assert_msg(fabs(smooth + jump - v) <= 0x1p-52 * fabs(v),
                      "%s: %.17g + %.17g, not %.17g", name, smooth, jump, v);
        ck_assert(p->smooth.piece(&p->smooth, x) == 0);
        check_range(name, &p->smooth, x);
        check_range(name, &p->jump, x);
    }
}

static void check_facts(const char *name, const parts *p)
{
    const koksma_facts *w = &p->of_whole, *s = &p->of_smooth, *j = &p->of_jump;

    ck_assert_msg(fabs(s->integral + j->integral - w->integral) <=
                      s->error + j->error + w->error + 1e-15 * fabs(w->integral),
                  "%s: %.17g + %.17g, not %.17g", name, s->integral, j->integral,
                  w->integral);
    ck_assert(s->jump == 0.0 && s->area == 0.0 && s->pieces == 1.0);
    if (w->jump > 0.0) {
        ck_assert(j->jump == w->jump && j->area == w->area);
        ck_assert(s->variation >= 0.0 && s->variation < HUGE_VAL);
    }
}

START_TEST(all_rows)
{
    for (size_t i = 0; koksma_integrands[i] != NULL; i++) {
        parts p = split(koksma_integrands[i], NULL);

        check_values(koksma_integrands[i]->name, &p);
        check_facts(koksma_integrands[i]->name, &p);
    }
    for (size_t i = 0; koksma_scenes[i] != NULL; i++) {
        parts p = split(koksma_scenes[i], NULL);

        check_values(koksma_scenes[i]->name, &p);
        ck_assert(p.of_smooth.integral == 0.0);
        ck_assert(p.of_jump.integral == p.of_whole.integral);
    }
}
END_TEST

/* f2 = a s + (1 - 2a) [s > 1]: the smooth part integrates to a, has the variance
 * a^2/6 and the variation 2a; the other is a step of 1 - 2a over half the square.
 */
START_TEST(parts_of_f2)
{
    for (int i = 0; i <= 8; i++) {
        double a = i / 16.0, step = 1.0 - 2.0 * a;
        parts p = split(koksma_integrand_find("f2"), &a);

        check_values("f2", &p);
        check_facts("f2", &p);
        ck_assert_double_eq_tol(p.of_smooth.integral, a, 1e-16);
        ck_assert_double_eq_tol(p.of_smooth.variance, a * a / 6.0, 1e-16);
        ck_assert_double_eq_tol(p.of_smooth.variation, 2.0 * a, 1e-16);
        ck_assert_double_eq_tol(p.of_jump.integral, step / 2.0, 1e-16);
        ck_assert_double_eq_tol(p.of_jump.variance, step * step / 4.0, 1e-16);
        ck_assert_double_eq_tol(fixture_variation(&p.smooth, 8), 2.0 * a, 1e-14);
    }
}
END_TEST

/* f3: 3a/2 and 3a; and 5/6 of a step of 0.6 - 1.8a. */
START_TEST(parts_of_f3)
{
    double a = 0.125;
    parts p = split(koksma_integrand_find("f3"), &a);

    check_values("f3", &p);
    ck_assert_double_eq_tol(p.of_smooth.integral, 1.5 * a, 1e-15);
    ck_assert_double_eq_tol(p.of_smooth.variation, 3.0 * a, 1e-15);
    ck_assert_double_eq_tol(p.of_jump.integral, (0.6 - 1.8 * a) * 5.0 / 6.0, 1e-15);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("split");
    TCase *tc = tcase_create("parts");

    tcase_add_test(tc, all_rows);
    tcase_add_test(tc, parts_of_f2);
    tcase_add_test(tc, parts_of_f3);
    suite_add_tcase(suite, tc);
    return oracle_run(suite);
}
