#include <float.h>
#include <math.h>

#include "fit_kernels.h"

/* With u = ln n the two terms are exp 2(s u) and exp 2(b - u + log/2 ln u), and c
 * is the mean of what they leave of y: two unknowns remain.  The sum of squares is
 * smooth in them, but flat where one term is nearly nothing, and has a valley for
 * either order of the terms; hence damped Gauss-Newton steps [Marquardt 1963], a
 * dozen from each of several starts, and then from the best until they end. */

typedef struct sample {
    const double *n, *y;
    size_t stride, rows;
    double log; /* power of ln n in the second term: 0 or 1 */
} sample;

typedef struct trial {
    double s, b, c, squares;
} trial;

static const double B_MOST = 100.0; /* far beyond what N below 2^64 can tell */

/* h1 - h2: by how much the first term's logarithm exceeds the second's. */
static double lead(double u, double s, double b, double power)
{
    return (1.0 + s) * u - b - (power > 0.0 ? power * log(u) / 2.0 : 0.0);
}

/* 1/2 ln of the sum of both terms; *first: the share of the first in it. */
static double log_sum(const sample *p, double u, double s, double b, double *first)
{
    double d = lead(u, s, b, p->log), smaller = exp(-2.0 * fabs(d));

    *first = d > 0.0 ? 1.0 / (1.0 + smaller) : smaller / (1.0 + smaller);
    return s * u - fmin(d, 0.0) + log1p(smaller) / 2.0;
}

static trial evaluate(const sample *p, double s, double b)
{
    trial t = {s, b, 0.0, 0.0};
    double first;

    for (size_t i = 0; i < p->rows; i++)
        t.c += (p->y[i * p->stride] - log_sum(p, log(p->n[i]), s, b, &first)) /
               (double)p->rows;
    for (size_t i = 0; i < p->rows; i++)
        t.squares +=
            pow(p->y[i * p->stride] - t.c - log_sum(p, log(p->n[i]), s, b, &first),
                2.0);
    return t;
}

/* The normal equations of one step: a x = g in (s, b), the mean taken out. */
typedef struct normal {
    double ss, sb, bb, s, b;
} normal;

static normal linearise(const sample *p, trial t)
{
    double mean_s = 0.0, mean_b = 0.0, m = (double)p->rows, first;
    normal a = {0};

    for (size_t i = 0; i < p->rows; i++) {
        double u = log(p->n[i]);

        (void)log_sum(p, u, t.s, t.b, &first);
        mean_s += first * u / m;
        mean_b += (1.0 - first) / m;
    }
    for (size_t i = 0; i < p->rows; i++) {
        double u = log(p->n[i]);
        double rest = p->y[i * p->stride] - t.c - log_sum(p, u, t.s, t.b, &first);
        double ds = first * u - mean_s, db = 1.0 - first - mean_b;

        a.ss += ds * ds;
        a.sb += ds * db;
        a.bb += db * db;
        a.s += ds * rest;
        a.b += db * rest;
    }
    return a;
}

static double clamp(double v, double least, double most)
{
    return fmin(fmax(v, least), most);
}

/* Where a damped step leads.  Along a bound of s the step in b is that which is
 * best there. */
static trial step_from(const sample *p, trial t, normal a, double damping)
{
    double ss = a.ss * (1.0 + damping) + DBL_MIN,
           bb = a.bb * (1.0 + damping) + DBL_MIN, det = ss * bb - a.sb * a.sb;
    double s = clamp(t.s + (det > 0.0 ? (bb * a.s - a.sb * a.b) / det : a.s / ss),
                     -1.0, 0.0);
    double b = t.b + (a.b - a.sb * (s - t.s)) / bb;

    return evaluate(p, s, clamp(b, -B_MOST, B_MOST));
}

static trial descend(const sample *p, trial t, int most)
{
    double damping = 1e-3;

    for (int steps = 0; steps < most && damping < 1e9; steps++) {
        trial next = step_from(p, t, linearise(p, t), damping);

        if (next.squares < t.squares) {
            bool still = next.squares > t.squares * (1.0 - 1e-14);

            t = next;
            if (still) break;
            damping = fmax(damping / 8.0, 1e-12);
        } else {
            damping *= 8.0;
        }
    }
    return t;
}

/* Which terms are there: more than a millionth of the mean square at some n. */
static ki_mixture describe(const sample *p, trial t)
{
    ki_mixture m = {t.s, t.b, t.c, p->log, false, false};

    for (size_t i = 0; i < p->rows; i++) {
        double first;

        (void)log_sum(p, log(p->n[i]), t.s, t.b, &first);
        m.has_first = m.has_first || first > 1e-6;
        m.has_second = m.has_second || first < 1.0 - 1e-6;
    }
    if (!m.has_first) m.s = -1.0;
    return m;
}

ki_mixture ki_mixture_fit(const double *n, const double *y, size_t stride,
                          size_t rows, double power)
{
    static const double exponents[] = {-0.55, -0.7, -0.85};
    static const double places[] = {-0.3, 0.2, 0.5,
                                    0.8}; /* in ln n: of the cross */
    const sample p = {n, y, stride, rows, power};
    double low = log(n[0]), width = log(n[rows - 1]) - low;
    trial best = {.squares = HUGE_VAL};

    for (size_t i = 0; i < 3; i++)
        for (size_t j = 0; j < 4; j++) {
            double u = fmax(low + places[j] * width, 0.5), s = exponents[i];
            trial t = descend(&p, evaluate(&p, s, lead(u, s, 0.0, p.log)), 12);

            if (t.squares < best.squares) best = t;
        }
    return describe(&p, descend(&p, best, 200));
}

/* The lead falls until u = log/(2 + 2s) and rises from there on. */
double ki_mixture_cross(const ki_mixture *m)
{
    double low, high = log(DBL_MAX);

    if (!m->has_second) return 0.0;
    if (!m->has_first || lead(high, m->s, m->b, m->log) <= 0.0) return HUGE_VAL;
    low = fmin(0.5 * m->log / (1.0 + m->s), high);
    if (lead(low, m->s, m->b, m->log) >= 0.0) return 0.0;
    for (int step = 0; step < 200; step++) {
        double mid = low + (high - low) / 2.0;

        if (lead(mid, m->s, m->b, m->log) < 0.0)
            low = mid;
        else
            high = mid;
    }
    return exp(high);
}
