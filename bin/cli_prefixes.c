#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"

typedef struct list {
    uint64_t *n;
    size_t count, room;
    const char *option, *text; /* for messages */
} list;

static void append(list *l, uint64_t n)
{
    if (l->count > 0 && n <= l->n[l->count - 1])
        cli_usage("%s takes numbers that rise, not \"%s\"", l->option, l->text);
    if (l->count == l->room) {
        l->room = 2 * l->room + 64;
        l->n = realloc(l->n, l->room * sizeof *l->n);
        if (l->n == NULL) cli_fail("not enough memory for %s", l->option);
    }
    l->n[l->count++] = n;
}

/* first 2^(i/steps) rounded, as far as last, and last. */
static void append_range(list *l, uint64_t first, uint64_t last, unsigned steps)
{
    append(l, first);
    for (unsigned i = 1; l->n[l->count - 1] < last; i++) {
        double n = rint((double)first * exp2((double)i / steps));

        if (n >= (double)last)
            append(l, last);
        else if ((uint64_t)n > l->n[l->count - 1])
            append(l, (uint64_t)n);
    }
}

size_t cli_prefixes(uint64_t **n, const char *option, const char *text,
                    unsigned steps)
{
    list l = {.option = option, .text = text};
    char *copy = strdup(text);

    if (copy == NULL) cli_fail("not enough memory for %s", option);
    for (char *item = copy, *next; item != NULL; item = next) {
        char *colon;

        next = strchr(item, ',');
        if (next != NULL) *next++ = '\0';
        colon = strchr(item, ':');
        if (colon != NULL) *colon++ = '\0';

        uint64_t first = cli_count(option, item, 1, UINT64_MAX);

        if (colon != NULL)
            append_range(&l, first, cli_count(option, colon, first, UINT64_MAX),
                         steps);
        else
            append(&l, first);
    }
    free(copy);
    *n = l.n;
    return l.count;
}

bool cli_each_prefix(const cli_input *input, const koksma_set *set,
                     const uint64_t *n, size_t count, cli_measure *measure,
                     void *state)
{
    koksma_points p = koksma_set_view(set);

    if (count == 0) return measure(p, state);
    if (n[count - 1] > p.n)
        cli_fail("set %s has %zu point%s, and --prefixes asks for %ju",
                 input->label, p.n, cli_plural(p.n), (uintmax_t)n[count - 1]);
    for (size_t i = 0; i < count; i++)
        if (!measure((koksma_points){p.x, (size_t)n[i], p.dim}, state))
            return false;
    return true;
}
