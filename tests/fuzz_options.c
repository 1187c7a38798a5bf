/* libFuzzer target: whatever words a command line has, reading them as numbers, as
 * prefixes or as an integrand with its parameters gives what was asked for, or
 * leaves with one sentence and status 2. */
#include <math.h>
#include <setjmp.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The tools' own code, which leaves to here and not to the system. */
static FILE *said;
static jmp_buf back;

_Noreturn static void leave(int status)
{
    fflush(said);
    longjmp(back, status + 1);
}

#define exit leave
#undef stderr
#define stderr said
#include "../bin/cli.c"
#include "../bin/cli_integrand.c"
#include "../bin/cli_prefixes.c"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

static const cli_tool fuzzed = {"koksma-fuzz", "", "", common};

static void must(bool holds)
{
    if (!holds) abort();
}

/* The number that the digits of text are, or that a^b is; false where text is
 * neither, or beyond 2^64 - 1. */
static bool plain_count(const char *text, uint64_t *v)
{
    size_t digits = strspn(text, "0123456789");
    uint64_t part[2] = {0, 0};
    bool power = text[digits] == '^';
    const char *s = text;

    for (int i = 0; i <= power; i++, s++) {
        if (*s < '0' || *s > '9') return false;
        for (; *s >= '0' && *s <= '9'; s++)
            if (__builtin_mul_overflow(part[i], 10, &part[i]) ||
                __builtin_add_overflow(part[i], (uint64_t)(*s - '0'), &part[i]))
                return false;
    }
    if (s[-1] != '\0') return false;
    *v = power ? 1 : part[0];
    if (power && part[0] < 2)
        *v = part[0] == 1 || part[1] == 0;
    else
        for (; power && part[1] > 0; part[1]--)
            if (__builtin_mul_overflow(*v, part[0], v)) return false;
    return true;
}

static void check_count(const char *text)
{
    uint64_t v = cli_count("-n", text, 1, UINT64_MAX), plain;

    must(v >= 1);
    if (strspn(text, "0123456789^") == strlen(text))
        must(plain_count(text, &plain) && plain == v);
    else
        must((double)v == strtod(text, NULL) && v <= (uint64_t)1 << 53);
}

static void check_real(const char *text)
{
    double v = cli_real("-e", text, -1e300, 1e300);
    char again[KOKSMA_NUMBER_SIZE];
    uint64_t plain;

    must(v >= -1e300 && v <= 1e300);
    koksma_format_number(again, v);
    must(cli_real("-e", again, -1e300, 1e300) == v);
    if (strchr(text, '^') != NULL)
        must(plain_count(text, &plain) && v == (double)plain);
}

static void check_prefixes(const char *text, unsigned steps)
{
    uint64_t *n;
    size_t count = cli_prefixes(&n, "--prefixes", text, steps);

    must(count > 0 && n[0] > 0);
    for (size_t i = 1; i < count; i++)
        must(n[i] > n[i - 1]);
    free(n);
}

/* "NAME SETTING SETTING...", as the tools take them. */
static void check_integrand(char *text)
{
    cli_integrand r = {0};
    char *name = strtok(text, " "), *word;
    koksma_integrand f;

    while ((word = strtok(NULL, " ")) != NULL) {
        optarg = word;
        if (strncmp(word, "d=", 2) == 0)
            r.dim = cli_count("-d", word + 2, 1, 10000);
        else if (strncmp(word, "bounces=", 8) == 0)
            r.bounces = cli_count("--bounces", word + 8, 1, 1000);
        else if (strncmp(word, "cap=", 4) == 0)
            cli_integrand_set(&r, "--cap", (optarg += 4, "cap"));
        else
            cli_integrand_set(&r, "-a", NULL);
    }
    if (name == NULL) return;
    must((koksma_integrand_find(name) != NULL || koksma_scene_find(name) != NULL) ==
         cli_integrand_exists(name));
    cli_integrand_choose(&r, name);
    must(r.row != NULL && strcmp(r.row->name, name) == 0);
    for (size_t i = 0; i < koksma_integrand_params(r.row); i++)
        must(r.param[i] >= -1e300 && r.param[i] <= 1e300);
    if (koksma_integrand_make(&f, NULL, r.row, r.dim, r.param, NULL) == KOKSMA_OK)
        must(f.dim >= 1 && (r.dim == 0 || f.dim == r.dim));
}

static void read_words(char kind, char *text)
{
    switch (kind) {
    case 'r': check_real(text); break;
    case 'p': check_prefixes(text, 1); break;
    case 'P': check_prefixes(text, 16); break;
    case 'i': check_integrand(text); break;
    default: check_count(text);
    }
}

/* A refusal: the tool's name, a sentence, a line that says where to look. */
static void check_said(const char *text, size_t size)
{
    static const char head[] = "koksma-fuzz: ",
                      tail[] = "\nTry 'koksma-fuzz -h'.\n";

    must(size > sizeof head + sizeof tail);
    must(strncmp(text, head, sizeof head - 1) == 0);
    must(strcmp(text + size - (sizeof tail - 1), tail) == 0);
}

/* Memory of before the refusal goes with the program. */
void __lsan_disable(void) __attribute__((weak));
void __lsan_enable(void) __attribute__((weak));

/* The first byte says what the others are. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    char *text, *sentence = NULL;
    size_t length = 0;
    int left;

    if (size == 0 || memchr(bytes, '\0', size) != NULL) return 0;
    text = strndup((const char *)bytes + 1, size - 1);
    said = open_memstream(&sentence, &length);
    must(text != NULL && said != NULL);
    this_tool = &fuzzed;
    if (__lsan_disable != NULL) __lsan_disable();
    left = setjmp(back);
    if (left == 0) read_words((char)bytes[0], text);
    if (__lsan_enable != NULL) __lsan_enable();
    fclose(said);
    must(left == 0 || left == CLI_USAGE + 1);
    if (left != 0)
        check_said(sentence, length);
    else
        must(length == 0);
    free(sentence);
    free(text);
    return 0;
}
