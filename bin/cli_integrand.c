#include "cli_integrand.h"

#include <string.h>

#include "cli.h"

static const koksma_integrand_row *find_row(const char *name)
{
    const koksma_integrand_row *row = koksma_integrand_find(name);

    return row != NULL ? row : koksma_scene_find(name);
}

void cli_integrand_set(cli_integrand *r, const char *option, const char *name)
{
    if (r->count == CLI_SETTINGS_MOST)
        cli_usage("more than %d parameters", CLI_SETTINGS_MOST);
    r->settings[r->count].option = option;
    r->settings[r->count].name = name;
    r->settings[r->count++].text = optarg;
}

/* Where the row keeps the parameter whose name has that length. */
static double *find_param(cli_integrand *r, const char *name, size_t length)
{
    for (size_t i = 0; i < koksma_integrand_params(r->row); i++)
        if (strlen(r->row->params[i].name) == length &&
            strncmp(r->row->params[i].name, name, length) == 0)
            return &r->param[i];
    cli_usage("%s has no parameter %.*s", r->row->name, (int)length, name);
}

static void apply_settings(cli_integrand *r)
{
    for (size_t i = 0; i < koksma_integrand_params(r->row); i++)
        r->param[i] = r->row->params[i].usual;
    for (size_t i = 0; i < r->count; i++) {
        const char *name = r->settings[i].name, *text = r->settings[i].text;
        const char *sign = name == NULL ? strchr(text, '=') : NULL;
        double *param;

        if (name != NULL)
            param = find_param(r, name, strlen(name));
        else if (sign != NULL)
            param = find_param(r, text, (size_t)(sign - text));
        else if (koksma_integrand_params(r->row) > 0)
            param = &r->param[0];
        else
            cli_usage("%s has no parameters", r->row->name);
        *param = cli_real(r->settings[i].option, sign != NULL ? sign + 1 : text,
                          -1e300, 1e300);
    }
}

static void apply_bounces(cli_integrand *r)
{
    size_t dim;

    if (r->bounces == 0) return;
    if (koksma_scene_find(r->row->name) == NULL)
        cli_usage("%s has no bounces", r->row->name);
    dim = r->row->dim_least + 2 * (r->bounces - 1);
    if (r->dim > 0 && r->dim != dim)
        cli_usage("--bounces %zu of %s is dimension %zu, and -d says %zu",
                  r->bounces, r->row->name, dim, r->dim);
    r->dim = dim;
}

bool cli_integrand_walks(const koksma_integrand_row *row, const char *piece)
{
    return koksma_scene_find(row->name) != NULL &&
           (piece == NULL || piece[0] == 'j');
}

void cli_integrand_about(char text[CLI_ABOUT_SIZE], const koksma_integrand_row *row,
                         const koksma_integrand *f, const char *piece)
{
    FILE *to = fmemopen(text, CLI_ABOUT_SIZE, "w");
    char number[KOKSMA_NUMBER_SIZE];

    if (to == NULL) cli_fail("not enough memory");
    fprintf(to, "integrand=%s dim=%zu", row->name, f->dim);
    if (piece != NULL) fprintf(to, " piece=%s", piece);
    if (cli_integrand_walks(row, piece))
        fprintf(to, " bounces=%zu", koksma_scene_bounces(f));
    for (size_t i = 0; i < koksma_integrand_params(row); i++) {
        koksma_format_number(number, f->param[i]);
        fprintf(to, " %s=%s", row->params[i].name, number);
    }
    fclose(to);
}

const char *cli_integrand_differs(const char *name, const char *one,
                                  const char *other)
{
    const koksma_integrand_row *row = find_row(name);
    double v, w;

    for (size_t i = 0; row != NULL && i < koksma_integrand_params(row); i++) {
        const char *key = row->params[i].name;

        if (koksma_about_number(one, key, &v) &&
            koksma_about_number(other, key, &w) && v != w)
            return key;
    }
    return NULL;
}

bool cli_integrand_exists(const char *name) { return find_row(name) != NULL; }

void cli_integrand_choose(cli_integrand *r, const char *name)
{
    r->row = find_row(name);
    if (r->row == NULL)
        cli_usage("no integrand is called \"%s\"; koksma-eval --list lists them",
                  name);
    apply_settings(r);
    apply_bounces(r);
}
