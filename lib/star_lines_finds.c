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

bool ki_lines_revisit(ki_lines_worker *w, const ki_lines_finds *f, size_t first)
{
    for (int closed = 0; closed < 2; closed++) {
        ki_lines_cell whole = ki_lines_cell_whole(w->grid, closed);
        ki_lines_split *s = &w->path[0];

        s->left = 0;
        for (size_t i = first; i < first + KI_LINES_PARTS && i < f->count; i++)
            if (f->leaf[i].closed == closed && f->most[i] > ki_lines_cut(w))
                s->part[s->left++] = f->leaf[i];
        if (s->left > 0 && !ki_lines_cell_fill(w, &whole, 0)) return false;
        while (s->left-- > 0)
            if (!ki_lines_leaf(w, &s->part[s->left])) return false;
    }
    return true;
}
