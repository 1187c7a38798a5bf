/* Numbers as text, both ways, against strtod and printf. */
#include <check.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "io.h"
#include "io_fixture.h"
#include "io_kernels.h"
#include "oracle.h"

/* ---- Reading ------------------------------------------------------------- */

/* text is a field and what follows it. */
static void check_parse(const char *text)
{
    char *want_end;
    double want = strtod(text, &want_end), v = -7.0;
    const char *end = ki_number_read(text, &v);

    ck_assert_msg(end == want_end, "\"%s\": ends after %td, not %td characters",
                  text, end - text, want_end - text);
    if (end == text) return;
    ck_assert_msg(bits_of(v) == bits_of(want), "\"%s\" is %a, not %a", text, v,
                  want);
}

START_TEST(numbers_worth_a_look)
{
    static const char *const texts[] = {
        "0", "1", "00", ".0", "0.", "000000000000000000000000.1", "0.1", ".5", "5.",
        ".", "", "x", "-", "+", "e1", "1e", "1e+", "1e5", "-1", "+1", "0x", "0x1p3",
        "0x.8", "1 2", "1,2", "1\t2", "1#2", "1x", "1.5.5", "--1", "inf", "-inf",
        "1e400", "-1e400", "1e-400", "-1e-400", "-0",
        /* 19 and 20 digits, the largest integers of each */
        "9999999999999999999", "99999999999999999999", "18446744073709551615",
        "18446744073709551616", "18446744073709551617", "1844674407370955161.5",
        "18446744073709551616.0", "0.9999999999999999999", "0.99999999999999999999",
        ".0000000000000000001", "0.0000000000000000001", "0.00000000000000000001",
        /* halfway between doubles, and next to it */
        "9007199254740991", "9007199254740992", "9007199254740993",
        "9007199254740993.0", "9007199254740993.001", "9007199254740992.999",
        "9007199254740994", "9007199254740995", "9007199254740997",
        "4503599627370496.5", "4503599627370497.5", "4503599627370496.499",
        "4503599627370496.501", "0.5000000000000000277555756156289135",
        "0.50000000000000005551115123125782702118158340454101562",
        "0.500000000000000055511151231257827021181583404541015625",
        "0.50000000000000005551115123125782702118158340454101563",
        "0.50000000000000005", "0.50000000000000006", "0.500000000000000055",
        "0.500000000000000056", "0.9999999999999999444", "0.9999999999999999445",
        "2.2250738585072014e-308", "2.2250738585072011e-308", "4.9e-324",
        "2.4e-324", "2.5e-324", "1.7976931348623157e308", "1.7976931348623159e308"};

    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        check_parse(texts[i]);
}
END_TEST

static char digit(oracle_rng *rng) { return (char)('0' + oracle_below(rng, 10)); }

/* Any decimal of up to 25 digits on either side of the point, and what may follow.
 */
static void random_decimal(char *text, oracle_rng *rng)
{
    static const char *const after[] = {"",    " 1",   ",1", "\t1",
                                        "e-5", "E+12", "x",  "."};
    size_t zeros = oracle_below(rng, 3) == 0 ? oracle_below(rng, 20) : 0;
    size_t whole = oracle_below(rng, 26), part = oracle_below(rng, 26);

    if (oracle_below(rng, 2) == 0) whole = oracle_below(rng, 3);
    if (oracle_below(rng, 8) == 0) *text++ = oracle_below(rng, 2) == 0 ? '-' : '+';
    for (; zeros > 0; zeros--)
        *text++ = '0';
    for (; whole > 0; whole--)
        *text++ = digit(rng);
    if (oracle_below(rng, 4) > 0) {
        *text++ = '.';
        zeros = oracle_below(rng, 3) == 0 ? oracle_below(rng, 12) : 0;
        for (; zeros > 0; zeros--)
            *text++ = '0';
        for (; part > 0; part--)
            *text++ = digit(rng);
    }
    strcpy(text, after[oracle_below(rng, 3) == 0 ? oracle_below(rng, 8) : 0]);
}

START_TEST(any_decimals)
{
    char text[120];

    for (uint64_t round = 0; round < 20000 * oracle_scale(); round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);

        random_decimal(text, &rng);
        if (text[0] != ' ' && text[0] != '\t') check_parse(text);
    }
}
END_TEST

/* An odd number of 54 bits over 2^j lies halfway between two doubles, and has 19
 * digits or fewer; one unit in the last of them decides. */
START_TEST(halfway_decimals)
{
    char text[40];

    for (uint64_t round = 0; round < 3000 * oracle_scale(); round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        double any = oracle_dyadic(&rng, 52);
        uint64_t odd = (1ull << 53) + 2 * (uint64_t)ldexp(any, 52) + 1;
        unsigned decimals = (unsigned)oracle_below(&rng, 4);
        uint64_t unit = 1;

        for (unsigned i = 0; i < decimals; i++, unit *= 10)
            odd *= 5;
        for (int step = -1; step <= 1; step++) {
            uint64_t v = odd + (uint64_t)(int64_t)step;

            snprintf(text, sizeof text, "%llu.%0*llu",
                     (unsigned long long)(v / unit), (int)decimals,
                     (unsigned long long)(v % unit));
            if (decimals == 0) *strchr(text, '.') = '\0';
            check_parse(text);
        }
    }
    /* The same above 2^54, with up to 10 bits that do not fit. */
    for (uint64_t round = 0; round < 3000 * oracle_scale(); round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);
        unsigned more = 1 + (unsigned)oracle_below(&rng, 10);
        uint64_t head = (1ull << 52) + (uint64_t)ldexp(oracle_dyadic(&rng, 52), 52);
        uint64_t half = (head << more) + (1ull << (more - 1));

        for (int step = -1; step <= 1; step++) {
            snprintf(text, sizeof text, "%llu",
                     (unsigned long long)(half + (uint64_t)(int64_t)step));
            check_parse(text);
        }
    }
}
END_TEST

/* ---- Writing ------------------------------------------------------------- */

static void check_format(double v)
{
    char text[KOKSMA_NUMBER_SIZE + 1], want[40];

    memset(text, '!', sizeof text);

    size_t length = koksma_format_number(text, v);

    for (int digits = 15; digits <= 17; digits++) {
        snprintf(want, sizeof want, "%.*g", digits, v);
        if (bits_of(strtod(want, NULL)) == bits_of(v)) break;
    }
    ck_assert_msg(strcmp(text, want) == 0, "%a is written %s, not %s", v, text,
                  want);
    ck_assert_uint_eq(length, strlen(text));
    ck_assert(text[KOKSMA_NUMBER_SIZE] == '!');
    ck_assert_msg(bits_of(strtod(text, NULL)) == bits_of(v), "%s is not %a", text,
                  v);

    double back;

    ck_assert(*ki_number_read(text, &back) == '\0');
    ck_assert_msg(bits_of(back) == bits_of(v), "%s is read as %a, not %a", text,
                  back, v);
}

static void check_both_signs(double v)
{
    check_format(v);
    check_format(-v);
}

static void check_neighbours(double v)
{
    double down = v, up = v;

    check_both_signs(v);
    for (int i = 0; i < 2; i++) {
        down = nextafter(down, 0.0);
        up = nextafter(up, (double)INFINITY);
        check_both_signs(down);
        if (up <= DBL_MAX) check_both_signs(up);
    }
}

START_TEST(numbers_near_powers)
{
    for (int e = -1074; e <= 1023; e++)
        check_neighbours(ldexp(1.0, e));
    for (int e = -323; e <= 308; e++) {
        char text[16];

        snprintf(text, sizeof text, "1e%d", e);
        check_neighbours(strtod(text, NULL));
    }
}
END_TEST

START_TEST(numbers_at_the_ends)
{
    static const double v[] = {0.0,
                               0x1p-1074,
                               0x1.8p-1073,
                               0x1.fffffffffffffp-1023,
                               DBL_MIN,
                               DBL_MAX,
                               1.0 - 0x1p-53,
                               1.0 + DBL_EPSILON,
                               0x1p53,
                               0x1p53 - 1.0,
                               0x1p53 + 2.0,
                               123456789.125,
                               999999999999999.9,
                               1234567890123456.0,
                               1e22,
                               1e23,
                               5e-324,
                               0.1 + 0.2,
                               1.0 / 3.0,
                               2.0 / 3.0,
                               1e-5,
                               1e-4};

    for (size_t i = 0; i < sizeof v / sizeof *v; i++)
        check_both_signs(v[i]);
    for (int i = 0; i < 2000; i++)
        check_both_signs(i);
}
END_TEST

/* What point sets are made of, k/2^j, k/3^j, k/10^j and any number in [0,1), and
 * doubles of all magnitudes.  A dyadic with few bits is often just between two
 * decimals. */
static double random_number(oracle_rng *rng, uint64_t kind)
{
    uint64_t bits = (uint64_t)ldexp(oracle_dyadic(rng, 53), 53);
    double v;

    switch (kind) {
    case 0: return oracle_dyadic(rng, 53);
    case 1: return oracle_dyadic(rng, 1 + (unsigned)oracle_below(rng, 53));
    case 2: return (double)oracle_below(rng, 59049) / 59049.0;
    case 3: return (double)oracle_below(rng, 1000000) / 1000000.0;
    case 4: return (double)bits;
    case 5: return ldexp((double)bits, -(int)oracle_below(rng, 110));
    case 6: return ldexp(oracle_dyadic(rng, 53), -1022);
    default:
        bits ^= (uint64_t)oracle_below(rng, 1 << 20) << 43;
        memcpy(&v, &bits, sizeof v);
        return isfinite(v) ? v : 0.0;
    }
}

static void check_random_numbers(uint64_t rounds)
{
    for (uint64_t round = 0; round < rounds; round++) {
        oracle_rng rng = oracle_rng_start(oracle_seed(), round);

        check_format(random_number(&rng, round % 8));
        check_format(-random_number(&rng, round % 8));
    }
}

START_TEST(any_numbers) { check_random_numbers(8000 * oracle_scale()); }
END_TEST

START_TEST(many_numbers) { check_random_numbers(100000 * oracle_scale()); }
END_TEST

START_TEST(no_numbers)
{
    char text[KOKSMA_NUMBER_SIZE];

    ck_assert_uint_eq(koksma_format_number(text, (double)INFINITY), 3);
    ck_assert_str_eq(text, "inf");
    ck_assert_uint_eq(koksma_format_number(text, -(double)INFINITY), 4);
    ck_assert_str_eq(text, "-inf");
    koksma_format_number(text, (double)NAN);
    ck_assert_ptr_nonnull(strstr(text, "nan"));
}
END_TEST

static Suite *io_suite(void)
{
    Suite *suite = suite_create("io_number");
    TCase *tc = tcase_create("reading");

    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 20.0 * (double)oracle_scale());
    tcase_add_test(tc, numbers_worth_a_look);
    tcase_add_test(tc, any_decimals);
    tcase_add_test(tc, halfway_decimals);

    tc = tcase_create("writing");
    suite_add_tcase(suite, tc);
    tcase_set_timeout(tc, 20.0 * (double)oracle_scale());
    tcase_add_test(tc, numbers_near_powers);
    tcase_add_test(tc, numbers_at_the_ends);
    tcase_add_test(tc, any_numbers);
    tcase_add_test(tc, no_numbers);

    tc = tcase_create("many");
    suite_add_tcase(suite, tc);
    tcase_set_tags(tc, "big");
    tcase_set_timeout(tc, 60.0 * (double)oracle_scale());
    tcase_add_test(tc, many_numbers);
    return suite;
}

int main(void) { return oracle_run(io_suite()); }
