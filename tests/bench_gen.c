/* How fast points are made, in blocks that stay in the cache; and beside it what
 * SciPy (by the python3 of the path, or PYTHON in the environment) and GSL take,
 * where they are installed.  value: the mean of some coordinates, about 1/2; for
 * Poisson disks the least distance of neighbours in the list, which is above the
 * radius. */

#include <dlfcn.h>
#include <math.h>
#include <string.h>

#include "bench.h"
#include "gen.h"

enum { ROOM = 1 << 15, ROUNDS = 1000 };

static double x[ROOM];

static void bench_rounds(const char *name, const char *family, koksma_gen_opts o,
                         size_t rounds)
{
    size_t n = ROOM / o.dim, seen = 0;
    double sum = 0.0, started;
    koksma_gen *g;

    o.n = n * rounds;
    bench_must(koksma_gen_open(&g, koksma_gen_find(family), &o, NULL),
               "koksma_gen_open");
    started = bench_now();
    for (size_t round = 0; round < rounds; round++) {
        bench_must(koksma_gen_fill(g, x, round * n, n, NULL), "koksma_gen_fill");
        for (size_t i = round % 64; i < n * o.dim; i += 64, seen++)
            sum += x[i];
    }
    bench_row(name, started, (double)(rounds * n * o.dim), "coordinates",
              sum / (double)seen);
    koksma_gen_close(g);
}

static void bench(const char *name, const char *family, size_t dim,
                  koksma_scramble scramble)
{
    bench_rounds(name, family, (koksma_gen_opts){.dim = dim, .scramble = scramble},
                 ROUNDS);
}

/* With the time to find the points. */
static void bench_disks(const char *name, size_t dim, bool torus)
{
    koksma_gen_opts o = {.dim = dim, .n = 100000, .torus = torus};
    double started = bench_now(), least = 1.0;
    koksma_gen *g;

    bench_must(koksma_gen_open(&g, koksma_gen_find("poisson"), &o, NULL),
               "koksma_gen_open");
    bench_must(koksma_gen_fill(g, x, 0, 1000, NULL), "koksma_gen_fill");
    for (size_t i = 1; i < 1000; i++)
        least = fmin(least, hypot(x[i * dim] - x[(i - 1) * dim],
                                  x[i * dim + 1] - x[(i - 1) * dim + 1]));
    bench_row(name, started, (double)o.n, "points", least);
    koksma_gen_close(g);
}

static void bench_own(void)
{
    static const uint64_t vector[] = {1, 182667, 469891, 498753, 110745};

    bench("halton dim 2", "halton", 2, KOKSMA_SCRAMBLE_NONE);
    bench("halton dim 10", "halton", 10, KOKSMA_SCRAMBLE_NONE);
    bench("halton dim 10 digits", "halton", 10, KOKSMA_SCRAMBLE_DIGITS);
    bench_rounds("halton dim 10 owen", "halton",
                 (koksma_gen_opts){.dim = 10, .scramble = KOKSMA_SCRAMBLE_OWEN},
                 50);
    bench_rounds("faure dim 10", "faure", (koksma_gen_opts){.dim = 10}, 50);
    bench("sobol dim 10", "sobol", 10, KOKSMA_SCRAMBLE_NONE);
    bench("sobol dim 1000", "sobol", 1000, KOKSMA_SCRAMBLE_NONE);
    bench("sobol dim 10 digits", "sobol", 10, KOKSMA_SCRAMBLE_DIGITS);
    bench("sobol dim 10 matrix", "sobol", 10, KOKSMA_SCRAMBLE_MATRIX);
    bench("sobol dim 10 owen", "sobol", 10, KOKSMA_SCRAMBLE_OWEN);
    bench("niederreiter dim 10", "niederreiter", 10, KOKSMA_SCRAMBLE_NONE);
    bench("richtmyer dim 10", "richtmyer", 10, KOKSMA_SCRAMBLE_NONE);
    bench_rounds("lattice dim 5", "lattice",
                 (koksma_gen_opts){.dim = 5, .vector = vector, .vector_size = 5},
                 ROUNDS);
    bench("random dim 10", "random", 10, KOKSMA_SCRAMBLE_NONE);
    bench_rounds("latin dim 10", "latin", (koksma_gen_opts){.dim = 10}, 50);
    bench_disks("poisson dim 2", 2, false);
    bench_disks("poisson dim 2 torus", 2, true);
    bench_disks("poisson dim 3 torus", 3, true);
}

/* gsl/gsl_qrng.h, as far as it is needed. */
static void bench_gsl(const char *name, const char *symbol, unsigned dim)
{
    void *lib = dlopen("libgsl.so", RTLD_LAZY | RTLD_GLOBAL);
    void *(*alloc)(const void *, unsigned), (*release)(void *);
    int (*get)(const void *, double[]);
    void **type, *q;
    double started, sum = 0.0;
    enum { POINTS = 1000000 };

    if (lib == NULL) lib = dlopen("libgsl.so.27", RTLD_LAZY | RTLD_GLOBAL);
    if (lib == NULL) {
        printf("# %s: no GSL\n", name);
        return;
    }
    *(void **)&alloc = dlsym(lib, "gsl_qrng_alloc");
    *(void **)&get = dlsym(lib, "gsl_qrng_get");
    *(void **)&release = dlsym(lib, "gsl_qrng_free");
    type = dlsym(lib, symbol);
    q = alloc(*type, dim);
    started = bench_now();
    for (size_t i = 0; i < POINTS; i++) {
        get(q, x);
        sum += x[0];
    }
    bench_row(name, started, (double)POINTS * dim, "coordinates", sum / POINTS);
    release(q);
    dlclose(lib);
}

static const char *const scipy =
    "try:\n"
    "    from scipy.stats import qmc\n"
    "except ImportError:\n"
    "    raise SystemExit('# scipy: not installed')\n"
    "import numpy, time\n"
    "def row(name, make, unit='coordinates'):\n"
    "    started = time.process_time()\n"
    "    x = make()\n"
    "    t = time.process_time() - started\n"
    "    count = x.size if unit == 'coordinates' else len(x)\n"
    "    print(f'{name}\\t{t:.4g}\\t{count / t:.4g}\\t{unit}/s\\t{x.mean()}')\n"
    "n = 2**20\n"
    "row('scipy halton dim 10', lambda: qmc.Halton(10, scramble=False).random(n))\n"
    "row('scipy halton dim 10 digits', lambda: qmc.Halton(10, seed=1).random(n))\n"
    "row('scipy sobol dim 10', lambda: qmc.Sobol(10, scramble=False).random(n))\n"
    "row('scipy sobol dim 10 matrix', lambda: qmc.Sobol(10, seed=1).random(n))\n"
    "row('numpy random dim 10', "
    "lambda: numpy.random.default_rng(1).random((n, 10)))\n"
    "row('scipy poisson dim 2', "
    "lambda: qmc.PoissonDisk(2, radius=0.023, seed=1).fill_space(), 'points')\n";

static void bench_scipy(void)
{
    const char *python = getenv("PYTHON");
    FILE *to;

    fflush(stdout);
    setenv("KOKSMA_PYTHON", python != NULL ? python : "python3", 1);
    to = popen("$KOKSMA_PYTHON - 2>&1 || true", "w");
    if (to == NULL) return;
    fputs(scipy, to);
    (void)pclose(to);
}

int main(void)
{
    bench_header();
    bench_own();
    bench_gsl("gsl halton dim 10", "gsl_qrng_halton", 10);
    bench_gsl("gsl sobol dim 10", "gsl_qrng_sobol", 10);
    bench_gsl("gsl niederreiter_2 dim 10", "gsl_qrng_niederreiter_2", 10);
    bench_scipy();
    return EXIT_SUCCESS;
}
