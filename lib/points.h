#ifndef KOKSMA_POINTS_H
#define KOKSMA_POINTS_H

#include <stddef.h>

/* Argument order throughout Koksma: outputs, inputs, options, koksma_error last.
 * A function that can fail returns a koksma_status and, when it is not
 * KOKSMA_OK, leaves its outputs as they were (KOKSMA_STOPPED alone fills them:
 * it means less was done than asked, and what was done is true). */
typedef enum koksma_status {
    KOKSMA_OK = 0,
    KOKSMA_EINVAL,  /* an argument or option makes no sense: sizes, ranges */
    KOKSMA_EDOMAIN, /* a number is outside its domain: NaN, or not in [0,1] */
    KOKSMA_EFORMAT, /* input is not in the format that it should be in */
    KOKSMA_EIO,     /* the system refused a read or a write */
    KOKSMA_ENOMEM,  /* not enough memory */
    KOKSMA_STOPPED  /* stopped before the end: by the caller, time or work */
} koksma_status;

/* Why a call failed, in words for a person.  No pointer inside: a caller may
 * keep it, copy it or let it go out of scope. */
typedef struct koksma_error {
    koksma_status status;
    size_t line;    /* 1-based input line, or 0 when there is none */
    char text[160]; /* one sentence, no newline */
} koksma_error;

/* A read-only view of n points in [0,1]^dim.  The view owns nothing: whoever
 * made the array keeps it alive, and unchanged, while the view is in use. */
typedef struct koksma_points {
    const double *x; /* n*dim numbers; x[i*dim + k] is coordinate k of point i */
    size_t n;
    size_t dim;
} koksma_points;

/* A long job calls this now and then.  Whatever it returns but 0 stops the job,
 * which then returns KOKSMA_STOPPED and its result so far.
 *   state         what the caller gave with the function
 *   lower, upper  the interval so far
 *   work          elementary steps done, as the measure's header counts them */
typedef int koksma_progress(void *state, double lower, double upper, double work);

/* Check that p is a point set: n >= 1, dim >= 1, n*dim doubles fit in memory,
 * and every coordinate lies in [0,1] (0, 1, ties and repeats are legal).
 *
 * Returns: KOKSMA_OK; KOKSMA_EINVAL for the sizes; KOKSMA_EDOMAIN naming the
 *          first coordinate that is a NaN, an infinity or outside [0,1]
 * Cost:    n*dim */
koksma_status koksma_points_check(koksma_points p, koksma_error *err);

#endif
