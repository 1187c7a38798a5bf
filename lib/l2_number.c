#include "l2_kernels.h"

/* Numbers whose exponents know no end: products over 10^4 coordinates. */

/* What is added to an error for the roundings of itself. */
static const double UP = 1.0 + 0x1p-40;

ki_l2_number ki_l2_normal(ki_l2_number x)
{
    int e;

    if (x.m.hi == 0.0 || !isfinite(x.m.hi)) return x;
    x.m.hi = frexp(x.m.hi, &e);
    x.m.lo = ldexp(x.m.lo, -e);
    x.err = ldexp(x.err, -e);
    x.e += e;
    return x;
}

/* x in units of 2^e, which is no less than its own.  What underflows is below
 * 2^-1000, in lo as in err. */
static ki_l2_number align(ki_l2_number x, int64_t e)
{
    int down = e - x.e > 3000 ? -3000 : (int)(x.e - e);

    x.m.hi = ldexp(x.m.hi, down);
    x.m.lo = ldexp(x.m.lo, down);
    x.err = ldexp(x.err, down) + (down < 0 ? 0x1p-1000 : 0.0);
    x.e = e;
    return x;
}

ki_l2_number ki_l2_add(ki_l2_number a, ki_l2_number b)
{
    ki_l2_number s;

    if (a.m.hi == 0.0 && a.err == 0.0) return b;
    if (b.m.hi == 0.0 && b.err == 0.0) return a;
    s.e = a.e > b.e ? a.e : b.e;
    a = align(a, s.e);
    b = align(b, s.e);
    s.m = ki_twice_add(a.m, b.m);
    s.err = (a.err + b.err + fabs(s.m.hi) * 0x1p-103) * UP;
    return s;
}

ki_l2_number ki_l2_scale(ki_l2_number a, int64_t e)
{
    a.e += e;
    return a;
}

/* hi = q n + r exactly, q being rounded; (r + lo)/n is off by two roundings of
 * itself, below 2^-104 of the quotient, and normal once x is. */
ki_l2_number ki_l2_divide_by(ki_l2_number x, double n)
{
    double q, r;

    x = ki_l2_normal(x);
    q = x.m.hi / n;
    r = fma(-q, n, x.m.hi);
    x.m = ki_twice_normal(q, (r + x.m.lo) / n);
    x.err = (x.err / n + fabs(q) * 0x1p-103) * UP;
    return x;
}
