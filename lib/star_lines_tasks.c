#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "rng.h"
#include "star_lines_kernels.h"

/* Cells that threads and shares take, each with its points and its lines.  The
 * grid is split in rounds, every cell of a round by the thread that comes first;
 * no corner is looked at meanwhile, so that the cells do not depend on the
 * threads. */

enum { ROUNDS = 6 };

static bool take_out(const ki_lines_worker *w, const ki_lines_cell *c,
                     ki_lines_task *t)
{
    size_t lines = c->lines, points = c->points * w->grid->axes;
    ki_line *to =
        ki_alloc(1, lines * sizeof *to + points * sizeof(uint32_t) + sizeof *to);

    if (to == NULL) return false;
    *t = (ki_lines_task){.cell = *c, .memory = to};
    memcpy(to, w->line + c->line, lines * sizeof *to);
    memcpy(to + lines, w->point + c->point, points * sizeof(uint32_t));
    return true;
}

bool ki_lines_bring_in(ki_lines_worker *w, ki_lines_task *t, ki_lines_cell *c)
{
    size_t lines = t->cell.lines;
    size_t points = t->cell.points * w->grid->axes;
    const ki_line *from = t->memory;

    *c = t->cell;
    if (c->of_grid) return true;
    if (ki_grow((void **)&w->line, &w->room_lines, lines + 1, sizeof *w->line) !=
            0 ||
        ki_grow((void **)&w->point, &w->room_points, points + 1,
                sizeof *w->point) != 0)
        return false;
    memcpy(w->line, from, lines * sizeof *from);
    memcpy(w->point, from + lines, points * sizeof *w->point);
    free(t->memory);
    t->memory = NULL;
    c->point = c->line = 0;
    return true;
}

/* Split task `number` into tasks of the next round, in the order of the search: the
 * upper part of a cell first. */
static void split_task(void *state, size_t thread, size_t number)
{
    ki_lines_tasks *tasks = state;
    ki_lines_worker *w = &tasks->worker[thread];
    ki_lines_task *last =
        tasks->next + number * KI_LINES_PARTS + KI_LINES_PARTS - 1;
    ki_lines_cell whole;
    bool done = ki_lines_bring_in(w, &tasks->task[number], &whole) &&
                ki_lines_cell_split(w, &whole, 0);

    for (size_t q = 0; done && q < w->path[0].left; q++) {
        const ki_lines_cell *part = &w->path[0].part[q];

        if (part->lines > 0) done = take_out(w, part, last - q);
    }
    if (!done) ki_run_give_up(w->run);
}

/* The tasks of the next round take the place of those of this one, without gaps. */
static void settle_round(ki_lines_tasks *tasks)
{
    size_t all = tasks->count * KI_LINES_PARTS;
    ki_lines_task *next = tasks->next;

    ki_lines_tasks_free(tasks);
    tasks->task = next;
    for (size_t i = 0; i < all; i++)
        if (next[i].memory != NULL) next[tasks->count++] = next[i];
}

static void next_round(ki_lines_tasks *tasks)
{
    ki_run *run = tasks->worker[0].run;

    tasks->next = calloc(tasks->count * KI_LINES_PARTS, sizeof *tasks->next);
    if (tasks->next == NULL) {
        ki_run_give_up(run);
        return;
    }
    ki_team_run(run->team, tasks->count, split_task, tasks);
    for (size_t i = 0; i < ki_team_threads(run->team); i++)
        ki_lines_worker_rest(&tasks->worker[i]);
    settle_round(tasks);
}

bool ki_lines_make_tasks(ki_lines_tasks *tasks, ki_lines_worker *worker,
                         size_t enough)
{
    ki_team *team = worker[0].run->team;

    *tasks = (ki_lines_tasks){.worker = worker};
    tasks->task = calloc(2, sizeof *tasks->task);
    if (tasks->task == NULL) return false;
    tasks->count = 2;
    for (int closed = 0; closed < 2; closed++)
        tasks->task[closed].cell = ki_lines_cell_whole(worker[0].grid, closed);
    for (int round = 0; round < ROUNDS && tasks->count > 0 &&
                        tasks->count < enough && !ki_team_stopped(team);
         round++)
        next_round(tasks);
    return true;
}

/* They are dealt at random, since neighbours are alike, and the same way for all
 * shares. */
void ki_lines_deal_tasks(ki_lines_tasks *tasks, size_t part, size_t parts)
{
    koksma_rng rng = koksma_rng_seed(0, 0);
    size_t kept = 0;

    for (size_t i = 0; i < tasks->count; i++)
        if (koksma_rng_below(&rng, parts) == part)
            tasks->task[kept++] = tasks->task[i];
        else
            free(tasks->task[i].memory);
    tasks->count = kept;
}

void ki_lines_tasks_free(ki_lines_tasks *tasks)
{
    for (size_t i = 0; i < tasks->count; i++)
        free(tasks->task[i].memory);
    free(tasks->task);
    tasks->task = NULL;
    tasks->count = 0;
}
