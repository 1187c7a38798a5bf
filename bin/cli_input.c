#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli.h"

cli_input cli_inputs(int argc, char *argv[], koksma_content content)
{
    static char dash[] = "-", *standard[] = {dash, NULL};

    return (cli_input){.files = optind < argc ? argv + optind : standard,
                       .content = content,
                       .several = argc - optind > 1};
}

/* A name on one line, safe to print and to put into a column. */
static void printable(char *out, size_t size, const char *name)
{
    size_t i = 0;

    for (; name[i] != '\0' && i + 1 < size; i++)
        out[i] = isprint((unsigned char)name[i]) && name[i] != ' ' ? name[i] : '?';
    out[i] = '\0';
}

_Noreturn void cli_fail_input(const cli_input *input, const koksma_error *err)
{
    char name[200];

    printable(name, sizeof name, input->name != NULL ? input->name : "");
    if (err->line > 0 && input->name != NULL)
        cli_fail("%s:%zu: %s", name, err->line, err->text);
    if (err->line > 0) cli_fail("line %zu: %s", err->line, err->text);
    cli_fail("%s: %s", input->name != NULL ? name : "standard input", err->text);
}

static void close_file(cli_input *input)
{
    koksma_reader_close(input->reader);
    input->reader = NULL;
    if (input->in != NULL && input->in != stdin) fclose(input->in);
    input->in = NULL;
}

bool cli_next_file(cli_input *input)
{
    koksma_error err = {.status = KOKSMA_EIO};
    const char *name = *input->files;
    struct stat about;

    close_file(input);
    if (name == NULL) return false;
    input->files++;
    input->ordinal = 0;
    input->name = strcmp(name, "-") == 0 ? NULL : name;
    input->in = input->name != NULL ? fopen(name, "rb") : stdin;
    if (input->in == NULL) {
        snprintf(err.text, sizeof err.text, "%s", strerror(errno));
        cli_fail_input(input, &err);
    }
    /* Reading a directory fails too, but only after a while and on some systems. */
    if (fstat(fileno(input->in), &about) == 0 && S_ISDIR(about.st_mode)) {
        snprintf(err.text, sizeof err.text, "%s", strerror(EISDIR));
        cli_fail_input(input, &err);
    }
    if (koksma_reader_open(&input->reader, input->in, input->content, &err) !=
        KOKSMA_OK)
        cli_fail_as(&err);
    return true;
}

static void make_label(cli_input *input)
{
    char name[200];

    printable(name, sizeof name, input->name != NULL ? input->name : "");
    if (input->name != NULL)
        snprintf(input->label, sizeof input->label, "%s:%zu", name, input->ordinal);
    else
        snprintf(input->label, sizeof input->label, "%zu", input->ordinal);
}

bool cli_next_set(cli_input *input, size_t *columns)
{
    koksma_error err;

    for (;;) {
        if (input->reader == NULL && !cli_next_file(input)) return false;
        if (koksma_reader_next(input->reader, columns, &err) != KOKSMA_OK)
            cli_fail_input(input, &err);
        if (*columns > 0) break;
        if (input->ordinal == 0) {
            err = (koksma_error){KOKSMA_EFORMAT, 0, "no point set in it"};
            cli_fail_input(input, &err);
        }
        close_file(input);
    }
    input->ordinal++;
    make_label(input);
    return true;
}

void cli_settle_several(cli_input *input)
{
    koksma_error err;
    size_t columns;

    if (input->several) return;
    if (koksma_reader_next(input->reader, &columns, &err) != KOKSMA_OK)
        cli_fail_input(input, &err);
    input->several = columns > 0;
}

bool cli_read_set(cli_input *input, koksma_set *set)
{
    koksma_error err;
    size_t columns;

    cli_flush(); /* an interrupt while it reads must not take the rows before */
    cli_watch_release();
    if (!cli_next_set(input, &columns)) return false;
    if (koksma_set_read(set, input->reader, &err) != KOKSMA_OK)
        cli_fail_input(input, &err);
    cli_settle_several(input);
    return true;
}
