#ifndef KOKSMA_NUM_H
#define KOKSMA_NUM_H

/* What a number in Koksma claims to be.
 *
 * A measure is a koksma_interval: the true value, for the doubles given and
 * with every rounding counted, lies between its ends, both included.  What
 * rests on samples is a koksma_estimate and says at which level. */

typedef struct koksma_interval {
    double lower;
    double upper;
} koksma_interval;

/* A statistical estimate: intervals made this way contain the truth in a share
 * `level` of all repetitions.  lower and upper are NaN, and level is 0, where
 * the data allow no interval. */
typedef struct koksma_estimate {
    double value;
    double lower;
    double upper;
    double level; /* 0.95, say */
} koksma_estimate;

#endif
