/* koksma-points: point sets of the families that people use. */

#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "gen.h"

enum {
    START = CLI_LONG,
    LEAP,
    BASES,
    VECTOR,
    RADIUS,
    TORUS,
    SCRAMBLE,
    BAKER,
    REPLICATES,
    NPY,
    HEX,
    LIST
};

static const cli_option options[] = {
    {'d', "dim", "DIM", "coordinates a point (default 2)"},
    {'n', "points", "N", "points a set (default 1024)"},
    {'s', "seed", "SEED", "fixes every random bit (default 1)"},
    {START, "start", "INDEX", "first index of a sequence (default 0)"},
    {LEAP, "leap", "STEP", "from one index to the next (default 1)"},
    {BASES, "bases", "B,B,...", "coprime bases instead of the first primes"},
    {VECTOR, "vector", "Z,Z,...",
     "what a lattice or Kronecker sequence is made of"},
    {RADIUS, "radius", "R",
     "the least distance of poisson (default: the most found)"},
    {TORUS, "torus", NULL, "distances of poisson go across the faces"},
    {SCRAMBLE, "scramble", "HOW",
     "none, digits, owen, matrix or shift (default none)"},
    {BAKER, "baker", NULL, "fold every coordinate in the middle"},
    {REPLICATES, "replicates", "R", "so many independent sets (default 1)"},
    {NPY, "npy", NULL, "write NumPy arrays"},
    {HEX, "hex", NULL, "write hexadecimal numbers"},
    {LIST, "list", NULL, "list the families, or the one named"},
    {0},
};

static const cli_tool tool = {"koksma-points", "FAMILY",
                              "Write point sets of a family.", options};

enum { BLOCK = 4096, WORDS_MOST = 10000 };

static const koksma_gen_family *family_called(const char *name)
{
    const koksma_gen_family *family = koksma_gen_find(name);

    if (family == NULL)
        cli_usage("no family is called \"%s\"; --list lists them", name);
    return family;
}

static void list_row(const koksma_gen_family *f)
{
    printf("%s\t", f->name);
    if (f->max_dim > 1000000)
        fputs("any", stdout);
    else
        printf(f->max_dim > 1 ? "1-%zu" : "%zu", f->max_dim);
    printf("\t%s\t%s\n", f->needs, f->summary);
}

/* All families, or the one of that name. */
_Noreturn static void list_families(const char *name)
{
    const koksma_gen_family *one = name != NULL ? family_called(name) : NULL;

    if (!cli_quiet()) puts("# family\tdimensions\tneeds\tsummary");
    for (const koksma_gen_family *f = koksma_gen_families; f->name != NULL; f++)
        if (one == NULL || f == one) list_row(f);
    cli_finish(CLI_DONE);
}

/* Since lists are taken apart, and the command line is still to be written. */
static char *copy_of(const char *text)
{
    char *copy = strdup(text);

    if (copy == NULL) cli_fail("not enough memory");
    return copy;
}

/* "2,3,5" apart, in place; returns how many there are. */
static size_t split(const char *option, char **word, char *text)
{
    size_t count = 0;

    for (char *next; text != NULL; text = next) {
        next = strchr(text, ',');
        if (next != NULL) *next++ = '\0';
        if (count == WORDS_MOST)
            cli_usage("%s takes at most %d numbers", option, WORDS_MOST);
        word[count++] = text;
    }
    return count;
}

/* What is made of such lists, as far as the family takes it. */
typedef struct lists {
    char *bases, *vector; /* as given, taken apart, or NULL */
    uint32_t base[WORDS_MOST];
    uint64_t z[WORDS_MOST];
    double alpha[WORDS_MOST];
} lists;

static void read_lists(lists *l, koksma_gen_opts *o,
                       const koksma_gen_family *family)
{
    static char *word[WORDS_MOST];

    if (l->bases != NULL) {
        size_t count = split("--bases", word, l->bases);
        size_t wanted = o->dim - (family == koksma_gen_find("hammersley"));

        for (size_t i = 0; i < count; i++)
            l->base[i] = (uint32_t)cli_count("--bases", word[i], 2, UINT32_MAX);
        if (family->takes & KOKSMA_TAKES_BASES && count != wanted)
            cli_usage("%zu base%s, but %s in dimension %zu takes %zu", count,
                      cli_plural(count), family->name, o->dim, wanted);
        o->bases = l->base;
    }
    if (l->vector == NULL) return;
    o->vector_size = o->alpha_size = split("--vector", word, l->vector);
    for (size_t i = 0; i < o->vector_size; i++)
        if (family->takes & KOKSMA_TAKES_ALPHA)
            l->alpha[i] = cli_real("--vector", word[i], 0.0, 0x1p53);
        else
            l->z[i] = cli_count("--vector", word[i], 0, UINT64_MAX);
    if (family->takes & KOKSMA_TAKES_ALPHA)
        o->alpha = l->alpha;
    else
        o->vector = l->z;
}

static const char *const scrambles[] = {
    [KOKSMA_SCRAMBLE_NONE] = "none",   [KOKSMA_SCRAMBLE_DIGITS] = "digits",
    [KOKSMA_SCRAMBLE_OWEN] = "owen",   [KOKSMA_SCRAMBLE_MATRIX] = "matrix",
    [KOKSMA_SCRAMBLE_SHIFT] = "shift",
};

static koksma_scramble read_scramble(const char *text)
{
    for (size_t i = 0; i < sizeof scrambles / sizeof *scrambles; i++)
        if (strcmp(text, scrambles[i]) == 0) return (koksma_scramble)i;
    cli_usage("--scramble takes none, digits, owen, matrix or shift, not \"%s\"",
              text);
}

/* The command line, and what it means to the tools further down the pipe. */
static void print_comment(int argc, char *argv[], const koksma_gen_opts *o,
                          const char *family)
{
    if (cli_quiet()) return;
    printf("# %s", tool.name);
    for (int i = 1; i < argc; i++) {
        putchar(' ');
        for (const char *s = argv[i]; *s != '\0'; s++)
            putchar(*s == '\n' ? '?' : *s);
    }
    printf("\n# koksma: points=%s scramble=%s", family, scrambles[o->scramble]);
    if (o->start > 0) printf(" start=%ju", (uintmax_t)o->start);
    if (o->leap > 1) printf(" leap=%ju", (uintmax_t)o->leap);
    if (o->baker) fputs(" baker=1", stdout);
    putchar('\n');
}

/* Options that the family refuses are a misuse of the command line. */
static koksma_gen *open_set(const koksma_gen_family *family,
                            const koksma_gen_opts *o)
{
    koksma_error err;
    koksma_gen *g = NULL;
    koksma_status status = koksma_gen_open(&g, family, o, &err);

    if (status == KOKSMA_EINVAL) cli_usage("%s", err.text);
    if (status != KOKSMA_OK) cli_fail_as(&err);
    return g;
}

/* Nets have powers of their base; the larger one may not fit. */
static void warn_of_sizes(const koksma_gen *g, const char *family, uint64_t n)
{
    uint64_t b = koksma_gen_net(g), power = 1;

    if (b == 0) return;
    while (power <= n / b)
        power *= b;
    if (power < n && power <= UINT64_MAX / b)
        cli_note("%ju points of %s are no net: %ju or %ju would be", (uintmax_t)n,
                 family, (uintmax_t)power, (uintmax_t)(power * b));
    else if (power < n)
        cli_note("%ju points of %s are no net: %ju would be", (uintmax_t)n, family,
                 (uintmax_t)power);
}

static void write_set(const koksma_gen *g, const koksma_gen_opts *o,
                      koksma_form form)
{
    double *x = malloc(BLOCK * o->dim * sizeof *x);
    koksma_status status = KOKSMA_OK;
    koksma_error err;

    if (x == NULL)
        cli_fail("not enough memory for points of %zu coordinates", o->dim);
    if (form == KOKSMA_NPY && (size_t)o->n != o->n)
        cli_fail("an array of %ju points is more than 32 bits can count",
                 (uintmax_t)o->n);
    if (form == KOKSMA_NPY)
        status = koksma_write_npy_header(stdout, (size_t)o->n, o->dim, &err);
    for (uint64_t i = 0; i < o->n && status == KOKSMA_OK; i += BLOCK) {
        size_t count = o->n - i < BLOCK ? (size_t)(o->n - i) : BLOCK;

        status = koksma_gen_fill(g, x, i, count, &err);
        if (status == KOKSMA_OK)
            status = koksma_write_rows(stdout, x, count, o->dim, form, &err);
        if (o->n - i <= BLOCK) break;
    }
    if (status != KOKSMA_OK) cli_fail_as(&err);
    free(x);
}

typedef struct job {
    koksma_gen_opts o;
    koksma_form form;
    uint64_t replicates;
    lists given;
} job;

static void read_options(job *j, int argc, char *argv[])
{
    koksma_gen_opts *o = &j->o;
    bool list = false;
    int c;

    while ((c = cli_next(&tool, argc, argv)) != -1)
        switch (c) {
        case 'd':
            o->dim = (size_t)cli_count("-d", optarg, 1, SIZE_MAX / 65536);
            break;
        case 'n': o->n = cli_count("-n", optarg, 1, UINT64_MAX); break;
        case 's': o->seed = cli_count("-s", optarg, 0, UINT64_MAX); break;
        case START: o->start = cli_count("--start", optarg, 0, UINT64_MAX); break;
        case LEAP: o->leap = cli_count("--leap", optarg, 1, UINT64_MAX); break;
        case BASES: j->given.bases = copy_of(optarg); break;
        case VECTOR: j->given.vector = copy_of(optarg); break;
        case RADIUS: o->radius = cli_real("--radius", optarg, 1e-9, 1.0); break;
        case TORUS: o->torus = true; break;
        case SCRAMBLE: o->scramble = read_scramble(optarg); break;
        case BAKER: o->baker = true; break;
        case REPLICATES:
            j->replicates = cli_count("--replicates", optarg, 1, 1000000);
            break;
        case NPY: j->form = KOKSMA_NPY; break;
        case HEX: j->form = KOKSMA_HEX; break;
        case LIST: list = true; break;
        }
    if (list && argc - optind <= 1) list_families(argv[optind]);
    if (argc - optind != 1) cli_usage("name one family; --list lists them");
}

static const koksma_gen_family *find_family(job *j, const char *name)
{
    const koksma_gen_family *family = family_called(name);

    if (j->o.dim == 0) j->o.dim = family->max_dim > 1 ? 2 : 1;
    if (j->replicates > 1 && j->o.scramble == KOKSMA_SCRAMBLE_NONE &&
        !(family->takes & KOKSMA_TAKES_SEED))
        cli_usage("replicates of %s would be equal: --scramble makes them differ",
                  family->name);
    read_lists(&j->given, &j->o, family);
    return family;
}

int main(int argc, char *argv[])
{
    static job j = {
        .o = {.n = 1024, .seed = 1}, .form = KOKSMA_DECIMAL, .replicates = 1};
    const koksma_gen_family *family;
    /* getopt reorders argv */
    char **words = malloc(((size_t)argc + 1) * sizeof *words);

    if (words == NULL) cli_fail("not enough memory");
    memcpy(words, argv, ((size_t)argc + 1) * sizeof *words);
    read_options(&j, argc, argv);
    family = find_family(&j, argv[optind]);
    for (; j.o.replicate < j.replicates; j.o.replicate++) {
        koksma_gen *g = open_set(family, &j.o);

        if (j.o.replicate == 0) warn_of_sizes(g, family->name, j.o.n);
        if (j.form != KOKSMA_NPY && j.o.replicate == 0)
            print_comment(argc, words, &j.o, family->name);
        if (j.form != KOKSMA_NPY && j.o.replicate > 0) putchar('\n');
        write_set(g, &j.o, j.form);
        koksma_gen_close(g);
    }
    free(j.given.bases);
    free(j.given.vector);
    free(words);
    cli_finish(CLI_DONE);
}
