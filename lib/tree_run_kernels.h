#ifndef KI_TREE_RUN_KERNELS_H
#define KI_TREE_RUN_KERNELS_H

#include "part.h"
#include "tree_best_kernels.h"

/* What the searches need to know of the options of a measure; star.h and box.h say
 * what they mean. */
typedef struct ki_run_opts {
    double tolerance;
    bool anytime;
    size_t threads, part, parts;
    double work;
    uint64_t seed;
    koksma_progress *progress;
    void *state;
} ki_run_opts;

/* Whether they are in range, for n points. */
koksma_status ki_run_opts_check(ki_run_opts opts, size_t n, koksma_error *err);

/* Private: what the threads of a search share, whichever cells it is made of.  The
 * team's lock guards what changes, the incumbent included; the team's peak is what
 * the incumbent has proven. */
typedef struct ki_run {
    ki_run_opts opts;
    ki_team *team;
    ki_best *best;
    double factor; /* boxes below factor * peak are of no interest; 1: exact */
    double upper;  /* proven so far */
    double work;   /* steps, as last reported */
    bool no_memory;
} ki_run;

koksma_status ki_run_begin(ki_run *r, ki_best *b, const ki_run_opts *opts);
void ki_run_end(ki_run *r);

/* What a cell must be able to hold to be of interest. */
double ki_run_target(const ki_run *r);

/* Offer the box at corner to the incumbent. */
void ki_run_offer(ki_run *r, const double *corner, size_t inside, bool closed);

/* Now and then add *work to that of the run, tell the caller and make it 0; returns
 * whether to stop. */
bool ki_run_told_to_stop(ki_run *r, double *work);

/* Without memory: all threads stop. */
void ki_run_give_up(ki_run *r);

/* Search in stages as the options say: as stage(state) returns, no box deviates by
 * more than factor * the incumbent, unless the run was stopped. */
typedef void ki_run_stage(void *state);
void ki_run_stages(ki_run *r, ki_run_stage *stage, void *state);

/* What a kernel returns and leaves behind. */
koksma_status ki_run_outcome(const ki_run *r, double *upper, double *work,
                             bool *stopped);

#endif
