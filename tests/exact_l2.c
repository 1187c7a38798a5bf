#include <stdlib.h>

#include "exact_oracle.h"

/* The table of l2.h times 48 S^2, S = 2^bits: with X = x S, |X-Y|, T = |2X - S|,
 * which is 2 t S. */
typedef struct numbers {
    koksma_points p;
    exact_int x[EXACT_NUMBERS], one, square; /* X, S, S^2 */
} numbers;

static exact_int twice_middle(const numbers *s, exact_int x)
{
    return exact_abs(exact_minus(exact_times_of(x, 2), s->one));
}

/* a S^2 + b S u + c v^2 */
static exact_int form(const numbers *s, int64_t a, int64_t b, exact_int u,
                      int64_t c, exact_int v)
{
    exact_int sum = exact_times_of(s->square, a);

    sum = exact_plus(sum, exact_times_of(exact_times(s->one, u), b));
    return exact_plus(sum, exact_times_of(exact_times(v, v), c));
}

static exact_int kernel(const numbers *s, koksma_l2_kind kind, exact_int x,
                        exact_int y)
{
    bool x_is_less = exact_order(x, y) < 0;
    exact_int least = x_is_less ? x : y, most = x_is_less ? y : x;
    exact_int d = exact_minus(most, least), zero = exact_of(0);
    exact_int t = exact_plus(twice_middle(s, x), twice_middle(s, y));

    switch (kind) {
    case KOKSMA_L2_STAR: return form(s, 48, -48, most, 0, zero);
    case KOKSMA_L2_EXTREME:
        return exact_minus(form(s, 0, 48, least, 0, zero),
                           exact_times_of(exact_times(x, y), 48));
    case KOKSMA_L2_PERIODIC: return form(s, 24, -48, d, 48, d);
    case KOKSMA_L2_CENTERED:
        return form(s, 48, 12, exact_minus(t, exact_times_of(d, 2)), 0, zero);
    case KOKSMA_L2_WRAPAROUND: return form(s, 72, -48, d, 48, d);
    case KOKSMA_L2_MIXTURE:
        return form(s, 90, -6, exact_plus(t, exact_times_of(d, 6)), 24, d);
    case KOKSMA_L2_SYMMETRIC: return form(s, 96, -96, d, 0, zero);
    case KOKSMA_L2_KINDS: break;
    }
    abort();
}

static exact_int integral(const numbers *s, koksma_l2_kind kind, exact_int x)
{
    exact_int t = twice_middle(s, x);

    switch (kind) {
    case KOKSMA_L2_STAR: return form(s, 24, 0, x, -24, x);
    case KOKSMA_L2_EXTREME: return form(s, 0, 24, x, -24, x);
    case KOKSMA_L2_PERIODIC: return form(s, 16, 0, x, 0, x);
    case KOKSMA_L2_CENTERED: return form(s, 48, 12, t, -6, t);
    case KOKSMA_L2_WRAPAROUND: return form(s, 64, 0, x, 0, x);
    case KOKSMA_L2_MIXTURE: return form(s, 80, -6, t, -3, t);
    case KOKSMA_L2_SYMMETRIC: return form(s, 48, 96, x, -96, x);
    case KOKSMA_L2_KINDS: break;
    }
    abort();
}

static exact_int sum_of_integrals(const numbers *s, koksma_l2_kind kind)
{
    exact_int sum = exact_of(0);

    for (size_t i = 0; i < s->p.n; i++) {
        exact_int h = exact_of(1);

        for (size_t k = 0; k < s->p.dim; k++)
            h = exact_times(h, integral(s, kind, s->x[i * s->p.dim + k]));
        sum = exact_plus(sum, h);
    }
    return sum;
}

static exact_int sum_of_kernels(const numbers *s, koksma_l2_kind kind)
{
    size_t dim = s->p.dim;
    exact_int sum = exact_of(0);

    for (size_t i = 0; i < s->p.n; i++)
        for (size_t j = 0; j <= i; j++) {
            exact_int v = exact_of(j < i ? 2 : 1);

            for (size_t k = 0; k < dim; k++)
                v = exact_times(
                    v, kernel(s, kind, s->x[i * dim + k], s->x[j * dim + k]));
            sum = exact_plus(sum, v);
        }
    return sum;
}

exact_ratio exact_l2(koksma_points p, koksma_l2_kind kind)
{
    static const int64_t c[KOKSMA_L2_KINDS] = {16, 4, 16, 52, 64, 76, 64};
    numbers s = {.p = p};
    unsigned bits = exact_bits(p.x, p.n * p.dim, 0);
    int64_t n = (int64_t)p.n;
    exact_int sum, constant = exact_of(n * n), unit = constant;

    exact_check(p);
    s.one = exact_shifted(exact_of(1), bits);
    s.square = exact_times(s.one, s.one);
    for (size_t i = 0; i < p.n * p.dim; i++)
        s.x[i] = exact_scaled(p.x[i], bits);
    for (size_t k = 0; k < p.dim; k++) {
        constant = exact_times(constant, exact_times_of(s.square, c[kind]));
        unit = exact_times(unit, exact_times_of(s.square, 48));
    }
    sum = exact_times_of(sum_of_integrals(&s, kind), 2 * n);
    sum = exact_minus(constant, sum);
    return (exact_ratio){exact_plus(sum, sum_of_kernels(&s, kind)), unit};
}
