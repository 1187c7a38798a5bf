/* For 32 bits clang calls functions to turn integers of 128 bits into doubles and
 * back that its run-time library lacks: here they are, under the names it calls.
 * lib/ needs none of them. */
#include "oracle.h"

#ifndef __SIZEOF_INT128__
#include <math.h>

/* Passed as four words on the stack, which clang does not do with _BitInt. */
typedef struct words {
    uint64_t low;
    int64_t high;
} words;

oracle_int __fixdfti(double v);
double __floattidf(words w);
long double __floattixf(words w);

oracle_int __fixdfti(double v)
{
    int e;
    oracle_int m = (int64_t)ldexp(frexp(v, &e), 53);

    if (e >= 53) return m * ((oracle_int)1 << (e - 53));
    return e > 0 ? m / ((oracle_int)1 << (53 - e)) : 0; /* towards 0 */
}

/* The leading 63 bits, the last of them set where anything follows, round as all
 * of them would. */
double __floattidf(words w)
{
    oracle_int v = (oracle_int)w.high * ((oracle_int)1 << 64) + w.low;
    oracle_int left = v < 0 ? -v : v;
    int shift = 0;
    bool more = false;

    for (; left >> 63 != 0; left >>= 1, shift++)
        more |= (left & 1) != 0;
    double d = ldexp((double)((int64_t)left | more), shift);

    return v < 0 ? -d : d;
}

/* Either half fits into the 64 bits of x87's format, so that one sum rounds. */
long double __floattixf(words w)
{
    return ldexpl((long double)w.high, 64) + (long double)w.low;
}
#endif
