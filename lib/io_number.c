#include <ctype.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "io_kernels.h"

/* Decimal to double and back: strtod and snprintf, with an exact short cut each
 * for the numbers that point sets are made of.  The short cuts work in 128-bit
 * integers, so that there is one rounding, and that one is seen. */

__extension__ typedef unsigned __int128 u128;

static const uint64_t power[20] = {1u,
                                   10u,
                                   100u,
                                   1000u,
                                   10000u,
                                   100000u,
                                   1000000u,
                                   10000000u,
                                   100000000u,
                                   1000000000u,
                                   10000000000u,
                                   100000000000u,
                                   1000000000000u,
                                   10000000000000u,
                                   100000000000000u,
                                   1000000000000000u,
                                   10000000000000000u,
                                   100000000000000000u,
                                   1000000000000000000u,
                                   10000000000000000000u};

/* digits / 10^decimals, correctly rounded; digits > 0, decimals <= 19.  The
 * quotient of digits, shifted to the top of 128 bits, has 63 bits or more; its
 * top 64, with a last bit that says whether anything follows, round to 53 as
 * the exact value would. */
static double quotient(uint64_t digits, size_t decimals)
{
    int shift = __builtin_clzll(digits) + 64;
    u128 top = (u128)digits << shift;
    u128 q = top / power[decimals];
    bool more = q * power[decimals] != top;
    int extra = 0;

    if ((uint64_t)(q >> 64) != 0) extra = 64 - __builtin_clzll((uint64_t)(q >> 64));
    uint64_t head = (uint64_t)(q >> extra);
    if (more || ((u128)head << extra) != q) head |= 1;
    return ldexp((double)head, extra - shift);
}

/* Plain decimals with at most 19 digits; NULL when text is not one. */
static const char *read_decimal(const char *text, double *v)
{
    const char *s = text;
    uint64_t digits = 0;
    size_t count = 0, decimals = 0; /* which a line of 2^32 digits fits */

    for (; *s >= '0' && *s <= '9'; s++, count++)
        digits = digits * 10 + (uint64_t)(*s - '0');
    if (*s == '.')
        for (s++; *s >= '0' && *s <= '9'; s++, count++, decimals++)
            digits = digits * 10 + (uint64_t)(*s - '0');
    /* 19 digits, leading zeros included, cannot have overflowed. */
    if (count == 0 || count > 19) return NULL;
    if (ki_field_end(s) != s) return NULL;
    *v = digits > 0 ? quotient(digits, decimals) : 0.0;
    return s;
}

const char *ki_number_read(const char *text, double *v)
{
    const char *end = read_decimal(text, v);
    char *stop;

    if (end != NULL) return end;
    if (isspace((unsigned char)*text)) return text; /* which strtod would skip */
    *v = strtod(text, &stop);
    return stop;
}

/* x = m/2^s as a decimal of `digits` digits, the first at 10^q: the integer
 * nearest to x*10^(digits-1-q), 0 when it does not read back as x.  m < 2^53
 * and the power is at most 10^20, so nothing overflows 128 bits. */
static uint64_t decimal(uint64_t m, int s, int q, int digits)
{
    int scale = digits - 1 - q;
    u128 unit = scale < 20 ? power[scale] : (u128)power[19] * 10u;
    u128 exact = m * unit, half = (u128)1 << (s - 1), rest = exact & (2 * half - 1);
    uint64_t d = (uint64_t)(exact >> s);
    bool up = rest > half || (rest == half && d % 2 == 1); /* ties to even */
    u128 off = up ? 2 * half - rest : rest;

    d += up;
    if (d < power[digits - 1] || d >= power[digits]) return 0;
    /* Less than half the distance to the neighbour of x; below a power of two
     * that distance is half of the one above. */
    return (m == (uint64_t)1 << 52 ? 4 : 2) * off < unit ? d : 0;
}

/* v in [1e-4, 1e15); 0 when it is to be left to snprintf. */
static size_t write_decimal(char *text, double v)
{
    int e, q, s;
    uint64_t m = (uint64_t)ldexp(frexp(v, &e), 53), d = 0;
    char reversed[20];
    size_t length = 0;
    int digits, point;

    s = 53 - e;
    if (v >= 1.0)
        for (q = 0; v >= (double)power[q + 1];)
            q++;
    else
        q = v >= 0.1 ? -1 : v >= 0.01 ? -2 : v >= 0.001 ? -3 : -4;
    for (digits = 15; digits <= 17 && d == 0; digits++)
        d = decimal(m, s, q, digits);
    if (d == 0) return 0;

    digits--;
    for (; digits - 1 > q && d % 10 == 0; digits--)
        d /= 10;
    for (int i = 0; i < digits; i++, d /= 10)
        reversed[i] = (char)('0' + d % 10);
    if (q < 0) {
        memcpy(text, "0.0000", 6);
        length = (size_t)(1 - q);
    }
    point = q >= 0 ? digits - 1 - q : -1;
    for (int i = digits - 1; i >= 0; i--) {
        text[length++] = reversed[i];
        if (i == point && i > 0) text[length++] = '.';
    }
    text[length] = '\0';
    return length;
}

/* snprintf's fewest digits. */
static size_t write_any(char *text, double v)
{
    int length = 0;
    ki_c_locale l = ki_c_locale_enter();

    for (int digits = 15; digits <= 17; digits++) {
        length = snprintf(text, KOKSMA_NUMBER_SIZE, "%.*g", digits, v);
        if (strtod(text, NULL) == v) break;
    }
    ki_c_locale_leave(l);
    return (size_t)length;
}

size_t koksma_format_number(char text[KOKSMA_NUMBER_SIZE], double v)
{
    size_t sign = v < 0.0, length = 0;

    if (v == 0.0 && !signbit(v)) return (size_t)(memcpy(text, "0", 2), 1);
    text[0] = '-';
    if (fabs(v) >= 1e-4 && fabs(v) < 1e15)
        length = write_decimal(text + sign, fabs(v));
    return length > 0 ? length + sign : write_any(text, v);
}
