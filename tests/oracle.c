#include "oracle.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A sign and this many bits stay clear of overflow in every sum below. */
enum { ORACLE_BITS = 120 };

static void *room(size_t count, size_t size)
{
    void *r = calloc(count, size);

    if (r == NULL) {
        perror("oracle");
        abort();
    }
    return r;
}

/* The least b, no less than the one given, for which x * 2^b is an integer.
 * Scaling by a power of two is exact. */
static unsigned bits_of(const double *x, size_t count, unsigned b)
{
    for (size_t i = 0; i < count; i++)
        while (b <= ORACLE_BITS &&
               ldexp(x[i], (int)b) != floor(ldexp(x[i], (int)b)))
            b++;
    return b;
}

/* Room for n * 2^(b*dim), or the caller asks for more than integers can say. */
static void check_range(size_t n, size_t dim, unsigned b)
{
    unsigned log2n = 0;

    while (n >> log2n != 0)
        log2n++;
    if (b > ORACLE_BITS || dim > ORACLE_BITS || b * dim + log2n > ORACLE_BITS) {
        fprintf(stderr, "oracle: %u bits in dim %zu do not fit\n", b, dim);
        abort();
    }
}

size_t oracle_count(koksma_points p, const double *corner, bool closed)
{
    size_t count = 0;

    for (size_t i = 0; i < p.n; i++) {
        bool inside = true;

        for (size_t k = 0; k < p.dim; k++) {
            double v = p.x[i * p.dim + k];

            if (closed ? v > corner[k] : v >= corner[k]) inside = false;
        }
        if (inside) count++;
    }
    return count;
}

/* n * 2^(b*dim) times the local discrepancy. */
static oracle_int local_num(koksma_points p, const double *corner, bool closed,
                            unsigned b)
{
    oracle_int share = (oracle_int)oracle_count(p, corner, closed);
    oracle_int vol = (oracle_int)p.n;

    for (size_t k = 0; k < p.dim; k++) {
        vol *= (oracle_int)ldexp(corner[k], (int)b);
        share *= (oracle_int)1 << b;
    }
    return closed ? share - vol : vol - share;
}

oracle_ratio oracle_local(koksma_points p, const double *corner, bool closed)
{
    unsigned b = bits_of(corner, p.dim, bits_of(p.x, p.n * p.dim, 0));

    check_range(p.n, p.dim, b);
    return (oracle_ratio){local_num(p, corner, closed, b), p.n,
                          b * (unsigned)p.dim};
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;

    return (x > y) - (x < y);
}

/* 0, 1 and the coordinates k of all points, ascending, each once. */
static size_t axis_levels(double *level, koksma_points p, size_t k)
{
    size_t count = 1;

    for (size_t i = 0; i < p.n; i++)
        level[i] = p.x[i * p.dim + k];
    level[p.n] = 0.0;
    level[p.n + 1] = 1.0;
    qsort(level, p.n + 2, sizeof *level, by_value);
    for (size_t i = 1; i < p.n + 2; i++)
        if (level[i] != level[count - 1]) level[count++] = level[i];
    return count;
}

/* An odometer whose last axis turns fastest comes by the corners in lexicographic
 * order, so the first corner that reaches the maximum is the least. */
oracle_ratio oracle_star(koksma_points p, double *corner)
{
    unsigned b = bits_of(p.x, p.n * p.dim, 0);
    double *level = room(p.dim * (p.n + 2), sizeof *level);
    double *c = room(p.dim, sizeof *c);
    size_t *size = room(p.dim, sizeof *size);
    size_t *digit = room(p.dim, sizeof *digit);
    oracle_int best = -1;
    size_t turned = 0;

    check_range(p.n, p.dim, b);
    for (size_t k = 0; k < p.dim; k++)
        size[k] = axis_levels(level + k * (p.n + 2), p, k);
    do {
        for (size_t k = 0; k < p.dim; k++)
            c[k] = level[k * (p.n + 2) + digit[k]];
        for (int closed = 0; closed < 2; closed++) {
            oracle_int num = local_num(p, c, closed, b);

            if (num <= best) continue;
            best = num;
            if (corner != NULL) memcpy(corner, c, p.dim * sizeof *c);
        }
        for (turned = p.dim; turned > 0; turned--) {
            if (++digit[turned - 1] < size[turned - 1]) break;
            digit[turned - 1] = 0;
        }
    } while (turned > 0);
    free(level);
    free(c);
    free(size);
    free(digit);
    return (oracle_ratio){best, p.n, b * (unsigned)p.dim};
}

size_t oracle_count_between(koksma_points p, const double *corners, bool closed)
{
    const double *a = corners, *b = corners + p.dim;
    size_t count = 0;

    for (size_t i = 0; i < p.n; i++) {
        bool inside = true;

        for (size_t k = 0; k < p.dim; k++) {
            double v = p.x[i * p.dim + k];

            if (closed ? v < a[k] || v > b[k] : v <= a[k] || v >= b[k])
                inside = false;
        }
        if (inside) count++;
    }
    return count;
}

static oracle_int between_num(koksma_points p, const double *corners, bool closed,
                              unsigned b)
{
    oracle_int share = (oracle_int)oracle_count_between(p, corners, closed);
    oracle_int vol = (oracle_int)p.n;

    for (size_t k = 0; k < p.dim; k++) {
        vol *= (oracle_int)ldexp(corners[p.dim + k], (int)b) -
               (oracle_int)ldexp(corners[k], (int)b);
        share *= (oracle_int)1 << b;
    }
    return closed ? share - vol : vol - share;
}

oracle_ratio oracle_between(koksma_points p, const double *corners, bool closed)
{
    unsigned b = bits_of(corners, 2 * p.dim, bits_of(p.x, p.n * p.dim, 0));

    check_range(p.n, p.dim, b);
    return (oracle_ratio){between_num(p, corners, closed, b), p.n,
                          b * (unsigned)p.dim};
}

/* Numbers that the odometer of 2*dim axes shows, and whether they are a box. */
static bool read_corners(double *c, const double *level, size_t stride,
                         const size_t *digit, size_t dim)
{
    bool is_box = true;

    for (size_t k = 0; k < 2 * dim; k++)
        c[k] = level[k % dim * stride + digit[k]];
    for (size_t k = 0; k < dim; k++)
        is_box = is_box && c[k] <= c[dim + k];
    return is_box;
}

/* Whether every side of a closed box has a point of the box on it. */
static bool is_tight(koksma_points p, const double *corners)
{
    const double *a = corners, *b = corners + p.dim;

    for (size_t side = 0; side < 2 * p.dim; side++) {
        bool held = false;

        for (size_t i = 0; i < p.n; i++) {
            const double *x = p.x + i * p.dim;
            bool here = x[side % p.dim] == corners[side];

            for (size_t k = 0; k < p.dim; k++)
                here = here && a[k] <= x[k] && x[k] <= b[k];
            held = held || here;
        }
        if (!held) return false;
    }
    return true;
}

oracle_ratio oracle_box(koksma_points p, double *corners)
{
    unsigned b = bits_of(p.x, p.n * p.dim, 0);
    double *level = room(p.dim * (p.n + 2), sizeof *level);
    double *c = room(2 * p.dim, sizeof *c);
    size_t *size = room(p.dim, sizeof *size);
    size_t *digit = room(2 * p.dim, sizeof *digit);
    oracle_int best = -1, shown = -1;
    size_t turned = 0;

    check_range(p.n, p.dim, b);
    for (size_t k = 0; k < p.dim; k++)
        size[k] = axis_levels(level + k * (p.n + 2), p, k);
    do {
        bool is_box = read_corners(c, level, p.n + 2, digit, p.dim);

        for (int closed = 0; is_box && closed < 2; closed++) {
            oracle_int num = between_num(p, c, closed, b);

            if (num > best) best = num;
            if (num <= shown || (closed && !is_tight(p, c))) continue;
            shown = num;
            memcpy(corners, c, 2 * p.dim * sizeof *c);
        }
        for (turned = 2 * p.dim; turned > 0; turned--) {
            if (++digit[turned - 1] < size[(turned - 1) % p.dim]) break;
            digit[turned - 1] = 0;
        }
    } while (turned > 0);
    free(level);
    free(c);
    free(size);
    free(digit);
    return (oracle_ratio){best, p.n, b * (unsigned)p.dim};
}

static oracle_int floor_scaled(oracle_int m, int down)
{
    if (down >= 126) return m < 0 ? -1 : 0;

    oracle_int unit = (oracle_int)1 << down;
    oracle_int q = m / unit;

    return q * unit > m ? q - 1 : q;
}

/* The floor of v * n * 2^shift for v in [-1,1].  A double is an integer m of 53
 * bits and a power of two, and m * n fits, so the floor alone discards anything. */
static oracle_int floor_over(double v, oracle_ratio r)
{
    int e;
    oracle_int m = (oracle_int)ldexp(frexp(v, &e), 53) * (oracle_int)r.n;
    int up = e - 53 + (int)r.shift;

    return up >= 0 ? m * ((oracle_int)1 << up) : floor_scaled(m, -up);
}

/* An integer is at least a number when it is at least its ceiling, and at most a
 * number when it is at most its floor. */
bool oracle_at_least(oracle_ratio r, double v)
{
    if (!(v >= -1.0 && v <= 1.0)) return v < -1.0;
    return r.num >= -floor_over(-v, r);
}

bool oracle_at_most(oracle_ratio r, double v)
{
    if (!(v >= -1.0 && v <= 1.0)) return v > 1.0;
    return r.num <= floor_over(v, r);
}

bool oracle_contains(koksma_interval v, oracle_ratio r)
{
    return oracle_at_least(r, v.lower) && oracle_at_most(r, v.upper);
}

bool oracle_equal(oracle_ratio a, oracle_ratio b)
{
    if (a.n != b.n) abort();
    while (a.shift < b.shift) {
        a.num *= 2;
        a.shift++;
    }
    while (b.shift < a.shift) {
        b.num *= 2;
        b.shift++;
    }
    return a.num == b.num;
}

bool oracle_narrow(koksma_interval v)
{
    return v.lower <= v.upper && nextafter(nextafter(v.lower, 2.0), 2.0) >= v.upper;
}

static uint64_t number_from(const char *name)
{
    const char *text = getenv(name);
    char *end;

    if (text == NULL || *text < '0' || *text > '9') return 1;
    errno = 0;

    unsigned long long v = strtoull(text, &end, 10);

    return errno == 0 && *end == '\0' && v > 0 ? (uint64_t)v : 1;
}

uint64_t oracle_seed(void) { return number_from("KOKSMA_TEST_SEED"); }

size_t oracle_scale(void) { return (size_t)number_from("KOKSMA_TEST_SCALE"); }

static uint64_t next(oracle_rng *rng)
{
    rng->state ^= rng->state << 13;
    rng->state ^= rng->state >> 7;
    rng->state ^= rng->state << 17;
    return rng->state;
}

/* Xorshift stays at 0 when started there, and small states take some steps to
 * fill with ones: hence the odd multipliers and the steps thrown away. */
oracle_rng oracle_rng_start(uint64_t seed, uint64_t round)
{
    oracle_rng rng = {seed * 6364136223846793005u + round * 1442695040888963407u};

    if (rng.state == 0) rng.state = 1;
    for (int i = 0; i < 16; i++)
        next(&rng);
    return rng;
}

uint64_t oracle_below(oracle_rng *rng, uint64_t n) { return (next(rng) >> 11) % n; }

double oracle_dyadic(oracle_rng *rng, unsigned bits)
{
    return bits == 0 ? 0.0 : ldexp((double)(next(rng) >> (64 - bits)), -(int)bits);
}

bool oracle_long_doubles(void)
{
    volatile long double one = 1.0L, tiny = 0x1p-1000L;
    volatile long double more = one + 0x1p-60L, less = tiny * tiny;

    return more > one && less > 0.0L;
}

int oracle_run(Suite *suite)
{
    SRunner *runner = srunner_create(suite);
    int failed;

    srunner_run_all(runner, CK_ENV);
    failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
