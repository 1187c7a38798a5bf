#ifndef KI_STAR_RUN_KERNELS_H
#define KI_STAR_RUN_KERNELS_H

#include "part.h"
#include "star_kernels.h"

/* Private: what the threads of a search share, whichever cells it is made of.  The
 * team's lock guards what changes, the incumbent included; the team's peak is what
 * the incumbent has proven. */
typedef struct ki_run {
    const koksma_star_opts *opts;
    ki_team *team;
    ki_best *best;
    double factor; /* boxes below factor * peak are of no interest; 1: exact */
    double upper;  /* proven so far */
    double work;   /* steps, as last reported */
    bool no_memory;
} ki_run;

koksma_status ki_run_begin(ki_run *r, ki_best *b, const koksma_star_opts *opts);
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
