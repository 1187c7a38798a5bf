#include <math.h>

#include "star_lines_kernels.h"

/* Forget the finds that others have since surpassed. */
static void sift(ki_lines_worker *w)
{
    ki_lines_finds *f = &w->finds;
    size_t kept = 0;

    for (size_t i = 0; i < f->count; i++)
        if (f->most[i] > ki_lines_cut(w)) {
            f->most[kept] = f->most[i];
            f->leaf[kept++] = f->leaf[i];
        }
    f->count = kept;
}

/* A scout has dropped lines that are better by up to the cell's loss. */
void ki_lines_note(ki_lines_worker *w, const ki_lines_cell *c, double most)
{
    ki_lines_finds *f = &w->finds;

    most += c->loss;
    if (!w->scout || f->too_many || most <= ki_lines_cut(w)) return;
    if (f->count == w->sizes.finds) sift(w);
    f->too_many = f->count == w->sizes.finds;
    if (f->too_many) return;
    f->leaf[f->count] = *c;
    f->most[f->count++] = most;
}

void ki_lines_gather(ki_lines_finds *all, ki_lines_worker *worker, size_t workers)
{
    all->count = 0;
    all->too_many = false;
    for (size_t i = 0; i < workers; i++) {
        const ki_lines_finds *f = &worker[i].finds;

        sift(&worker[i]);
        all->too_many |= f->too_many || f->count > KI_LINES_FINDS - all->count;
        for (size_t j = 0; j < f->count && !all->too_many; j++) {
            all->leaf[all->count] = f->leaf[j];
            all->most[all->count++] = f->most[j];
        }
    }
}

static bool found_in(const ki_lines_worker *w, const ki_lines_cell *c)
{
    const ki_lines_finds *f = w->known;

    for (size_t i = 0; i < f->count; i++) {
        bool overlap = f->most[i] > ki_lines_cut(w);

        for (size_t k = 0; k < w->grid->axes; k++)
            overlap = overlap && c->low[k] < f->leaf[i].high[k] &&
                      f->leaf[i].low[k] < c->high[k];
        if (overlap) return true;
    }
    return f->too_many;
}

bool ki_lines_matters(const ki_lines_worker *w, const ki_lines_cell *c)
{
    return c->lines[0] + c->lines[1] > 0 && (w->scout || found_in(w, c));
}
