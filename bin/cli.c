#include "cli.h"

#include <ctype.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

static const cli_tool *this_tool;
static bool quiet;

static const cli_option common[] = {
    {'q', "quiet", NULL, "write no comment and no header lines"},
    {'h', "help", NULL, "print this help"},
    {'V', "version", NULL, "print the version"},
    {0},
};

enum { OPTIONS_MOST = 32 };

static bool given[CLI_LONG + OPTIONS_MOST]; /* of each id */

/* ---- Messages ---------------------------------------------------------------- */

static void message(const char *format, va_list args)
{
    fprintf(stderr, "%s: ", this_tool->name);
    vfprintf(stderr, format, args);
    putc('\n', stderr);
}

void cli_note(const char *format, ...)
{
    va_list args;

    va_start(args, format);
    message(format, args);
    va_end(args);
}

_Noreturn void cli_usage(const char *format, ...)
{
    va_list args;

    va_start(args, format);
    message(format, args);
    va_end(args);
    fprintf(stderr, "Try '%s -h'.\n", this_tool->name);
    exit(CLI_USAGE);
}

/* What was printed before the failure is whole lines of true results. */
_Noreturn static void leave_in_failure(void)
{
    fflush(stdout);
    exit(CLI_BAD_DATA);
}

_Noreturn void cli_fail(const char *format, ...)
{
    va_list args;

    va_start(args, format);
    message(format, args);
    va_end(args);
    leave_in_failure();
}

_Noreturn void cli_fail_as(const koksma_error *err)
{
    if (err->status == KOKSMA_EIO && ferror(stdout))
        cli_fail("standard output: %s", err->text);
    cli_fail("%s", err->text);
}

void cli_flush(void)
{
    errno = 0;
    if (fflush(stdout) == 0 && !ferror(stdout)) return;
    /* What failed may have been an earlier write, which left nothing to flush. */
    cli_fail("standard output: cannot write%s%s", errno != 0 ? ": " : "",
             errno != 0 ? strerror(errno) : "");
}

_Noreturn void cli_finish(int status)
{
    cli_flush();
    exit(status);
}

/* ---- Options ----------------------------------------------------------------- */

static void print_options(const cli_option *o)
{
    for (; o->name != NULL; o++) {
        char left[64];

        snprintf(left, sizeof left, "%s--%s%s%s", o->id < CLI_LONG ? ", " : "",
                 o->name, o->argument != NULL ? " " : "",
                 o->argument != NULL ? o->argument : "");
        if (o->id < CLI_LONG)
            printf("  -%c%-26s %s\n", o->id, left, o->help);
        else
            printf("      %-24s %s\n", left, o->help);
    }
}

static void print_help(void)
{
    printf("usage: %s [OPTION]... %s\n%s\n\n", this_tool->name, this_tool->operands,
           this_tool->summary);
    print_options(this_tool->options);
    print_options(common);
    printf("\nman %s says more.\n", this_tool->name);
}

/* Append the options of one table to those of getopt_long. */
static size_t add_options(struct option *longs, size_t count, char **letter,
                          const cli_option *o)
{
    for (; o->name != NULL && count < OPTIONS_MOST; o++) {
        longs[count++] = (struct option){
            o->name, o->argument != NULL ? required_argument : no_argument, NULL,
            o->id};
        if (o->id >= CLI_LONG) continue;
        *(*letter)++ = (char)o->id;
        if (o->argument != NULL) *(*letter)++ = ':';
    }
    return count;
}

int cli_next(const cli_tool *tool, int argc, char *argv[])
{
    struct option longs[OPTIONS_MOST + 1];
    char letters[2 * OPTIONS_MOST + 1], *letter = letters;
    size_t count;
    int c;

    this_tool = tool;
    count = add_options(longs, 0, &letter, tool->options);
    count = add_options(longs, count, &letter, common);
    longs[count] = (struct option){0};
    *letter = '\0';
    argv[0] = (char *)(uintptr_t)tool->name; /* for getopt's own messages */
    for (;;) {
        c = getopt_long(argc, argv, letters, longs, NULL);
        switch (c) {
        case 'q': quiet = true; break;
        case 'h': print_help(); cli_finish(CLI_DONE);
        case 'V':
            printf("%s (%s) %s\n", tool->name, PACKAGE_NAME, PACKAGE_VERSION);
            cli_finish(CLI_DONE);
        case '?': fprintf(stderr, "Try '%s -h'.\n", tool->name); exit(CLI_USAGE);
        default:
            if (c != -1) given[c] = true;
            return c;
        }
    }
}

void cli_refuse(const int *ids, const char *why)
{
    for (; *ids != 0; ids++) {
        const cli_option *o = this_tool->options;

        if (!given[*ids]) continue;
        while (o->id != *ids)
            o++;
        if (*ids < CLI_LONG) cli_usage("-%c is %s", *ids, why);
        cli_usage("--%s is %s", o->name, why);
    }
}

bool cli_quiet(void) { return quiet; }

/* ---- Numbers ----------------------------------------------------------------- */

static bool read_count(const char *text, uint64_t *value)
{
    char *end;
    uintmax_t v;
    double d;

    if (!isdigit((unsigned char)text[0])) return false;
    errno = 0;
    v = strtoumax(text, &end, 10);
    if (errno != 0) return false;
    if (*end == '^' && isdigit((unsigned char)end[1])) {
        uintmax_t exponent = strtoumax(end + 1, &end, 10), base = v;

        if (errno != 0 || *end != '\0') return false;
        if (base < 2 && exponent > 1) exponent = 1; /* it is what it is */
        for (v = 1; exponent > 0; exponent--)
            if (__builtin_mul_overflow(v, base, &v)) return false;
    } else if (*end == '.' || *end == 'e' || *end == 'E') {
        d = strtod(text, &end);
        if (!(d <= 0x1p53) || d != floor(d)) return false;
        v = (uintmax_t)d;
    }
    *value = v;
    return *end == '\0';
}

uint64_t cli_count(const char *option, const char *text, uint64_t least,
                   uint64_t most)
{
    uint64_t v = 0;

    if (!read_count(text, &v) || v < least || v > most)
        cli_usage("%s takes a whole number from %" PRIu64 " to %" PRIu64
                  ", not \"%s\"",
                  option, least, most, text);
    return v;
}

double cli_real(const char *option, const char *text, double least, double most)
{
    char *end;
    double v = strtod(text, &end);
    uint64_t power;

    if (*end == '^' && read_count(text, &power)) {
        v = (double)power;
        end = strchr(text, '\0');
    }
    if (end == text || *end != '\0' || !(v >= least && v <= most))
        cli_usage("%s takes a number from %g to %g, not \"%s\"", option, least,
                  most, text);
    return v;
}

void cli_number(double v)
{
    char text[KOKSMA_NUMBER_SIZE] = "nan";

    if (!isnan(v)) koksma_format_number(text, v);
    fputs(text, stdout);
}
