/* Streams that misbehave: they hand out a few bytes at a time, are interrupted by
 * signals, and fail anywhere.  What is read is the same or one failure, and
 * what is said to be written is. */
#define _GNU_SOURCE /* fopencookie */
#include <check.h>
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "io.h"
#include "io_fixture.h"
#include "oracle.h"

/* ---- What is read --------------------------------------------------------- */

static const char plain[] =
    "# koksma: a=1 b=2\n# x y\n0.5 0.25\r\n0x1p-3,1 # here\n"
    "\n\n1 0.1234567890123456789\n0 0";
static const char values[] = "0.5 7\n0.25 -1e300\n\n# more\n1\t5e-324\n";
static const char named[] = "# koksma: dim=2\n# set N error\na 8 0.5\nb 16 0.25\n";

typedef struct input {
    const char *bytes;
    size_t size;
    int content; /* koksma_content; TABLE */
} input;

enum { TABLE = 3, ARRAYS = 4, INPUTS = 3 + 3 * ARRAYS };

/* Two arrays of three by two, one of each order and type. */
static size_t array(char *out, int which)
{
    static const float single[] = {0.5f, 0.25f, 1.0f, 0.0f, 0.75f, 0.125f};
    double twice[6];
    char *s = out;

    for (int a = 0; a < 2; a++) {
        int fortran = (which + a) & 1, wide = which & 2;

        memset(s, ' ', 128);
        memcpy(s, "\x93NUMPY\x01\x00\x76\x00", 10);
        snprintf(s + 10, 117,
                 "{'descr': '<f%d', 'fortran_order': %s, 'shape': (3, 2)}",
                 wide ? 8 : 4, fortran ? "True" : "False");
        s[10 + strlen(s + 10)] = ' ';
        s[127] = '\n';
        s += 128;
        for (int i = 0; i < 6; i++)
            twice[i] = (double)single[i];
        memcpy(s, wide ? (const void *)twice : (const void *)single,
               wide ? 48 : 24);
        s += wide ? 48 : 24;
    }
    return (size_t)(s - out);
}

static input input_of(int which)
{
    static char file[512];

    switch (which) {
    case 0: return (input){plain, sizeof plain - 1, KOKSMA_POINTS};
    case 1: return (input){values, sizeof values - 1, KOKSMA_VALUES};
    case 2: return (input){named, sizeof named - 1, TABLE};
    }
    which -= 3;
    return (input){file, array(file, which % ARRAYS), which / ARRAYS};
}

/* All that a stream holds, as text, or as far as it goes. */
static koksma_status read_all(rendering *to, FILE *in, int content,
                              koksma_error *err)
{
    koksma_table t = {0};
    koksma_status status;

    if (content != TABLE) return render_sets(to, in, (koksma_content)content, err);
    *to = (rendering){.used = 0};
    status = koksma_table_read(&t, in, "N", "error", err);
    for (size_t i = 0; i < t.rows; i++) {
        render(to, i > 0 ? ";" : "", t.x[i]);
        render(to, " ", t.y[i]);
        render(to, " ", (double)t.set[i]);
    }
    koksma_table_free(&t);
    return status;
}

/* ---- A stream that reads or writes badly ---------------------------------- */

typedef struct cookie {
    const char *bytes;
    char *out; /* what was written */
    size_t size, at;
    size_t fails_at; /* from this byte on */
    int fails_with;
    int signals; /* every so many-th time there is one in place of bytes; 0: never
                  */
    size_t most; /* bytes at a time */
    oracle_rng rng;
} cookie;

static bool interrupted(cookie *c)
{
    if (c->signals == 0 || oracle_below(&c->rng, (uint64_t)c->signals) > 0)
        return false;
    errno = EINTR;
    return true;
}

static ssize_t give(void *state, char *to, size_t room)
{
    cookie *c = state;
    size_t left = c->size - c->at, now = 1 + oracle_below(&c->rng, c->most);

    if (interrupted(c)) return -1;
    if (c->at >= c->fails_at) return (errno = c->fails_with), -1;
    if (now > c->fails_at - c->at) now = c->fails_at - c->at;
    if (now > left) now = left;
    if (now > room) now = room;
    memcpy(to, c->bytes + c->at, now);
    c->at += now;
    return (ssize_t)now;
}

#ifdef __GLIBC__
enum { REFUSED = 0 };
#else
enum { REFUSED = -1 };
#endif

static ssize_t take(void *state, const char *from, size_t size)
{
    cookie *c = state;

    if (interrupted(c)) return REFUSED;
    if (c->at + size > c->fails_at) return (errno = c->fails_with), REFUSED;
    memcpy(c->out + c->at, from, size);
    c->at += size;
    return (ssize_t)size;
}

static FILE *stream(cookie *c, const char *mode)
{
    FILE *f =
        fopencookie(c, mode, (cookie_io_functions_t){.read = give, .write = take});

    ck_assert_ptr_nonnull(f);
    return f;
}

static cookie reading(input i, uint64_t seed)
{
    return (cookie){.bytes = i.bytes,
                    .size = i.size,
                    .fails_at = SIZE_MAX,
                    .most = 1 + seed % 5,
                    .rng = oracle_rng_start(oracle_seed(), seed)};
}

START_TEST(few_bytes_at_a_time)
{
    input i = input_of(_i);
    rendering want, got;
    FILE *in = stream_of(i.bytes, i.size);

    ck_assert_int_eq(read_all(&want, in, i.content, NULL), KOKSMA_OK);
    ck_assert_uint_gt(want.used, 10);
    fclose(in);
    for (uint64_t seed = 0; seed < 20; seed++) {
        cookie c = reading(i, seed);

#ifdef __GLIBC__
        c.signals = seed % 4 < 3 ? 0 : 2;
#else
        if (i.bytes[0] == '\x93') c.signals = seed % 4 < 3 ? 0 : 2;
#endif
        in = stream(&c, "r");
        ck_assert_int_eq(read_all(&got, in, i.content, NULL), KOKSMA_OK);
        ck_assert_str_eq(got.text, want.text);
        fclose(in);
    }
}
END_TEST

/* Whatever was read before it, a failure is one, with the system's reason. */
START_TEST(failure_anywhere)
{
    input i = input_of(_i);
    char reason[100];

    snprintf(reason, sizeof reason, "cannot read: %s", strerror(EIO));
    for (size_t at = 0; at <= i.size; at += _i < 3 ? 1 : 5) {
        cookie c = reading(i, at);
        koksma_error err = {0};
        rendering got;
        FILE *in;

        c.fails_at = at;
        c.fails_with = EIO;
        in = stream(&c, "r");
        ck_assert_int_eq(read_all(&got, in, i.content, &err), KOKSMA_EIO);
        ck_assert_int_eq(err.status, KOKSMA_EIO);
        ck_assert_str_eq(err.text, reason);
        fclose(in);
    }
}
END_TEST

/* ---- Writing -------------------------------------------------------------- */

enum { ROWS = 700 };

static koksma_status write_all(FILE *out, koksma_form form, koksma_error *err)
{
    static double rows[ROWS * 2];
    koksma_status status = KOKSMA_OK;

    for (size_t i = 0; i < ROWS * 2; i++)
        rows[i] = (double)i / 3.0;
    if (form == KOKSMA_NPY) status = koksma_write_npy_header(out, ROWS, 2, err);
    return status != KOKSMA_OK ? status
                               : koksma_write_rows(out, rows, ROWS, 2, form, err);
}

/* A disk that is full from some byte on, and one that is interrupted: either all
 * arrives, or the library or the last flush says that it did not. */
START_TEST(written_or_told)
{
    koksma_form form = (koksma_form)(_i % 3);
    char *want, out[40000], buffer[512];
    size_t size;
    FILE *all = open_memstream(&want, &size);

    ck_assert_int_eq(write_all(all, form, NULL), KOKSMA_OK);
    fclose(all);
    ck_assert_uint_lt(size, sizeof out);
    for (size_t step = 0; step < 60; step++) {
        cookie c = {.out = out,
                    .fails_at = _i < 3 ? size * step / 50 : SIZE_MAX,
                    .fails_with = ENOSPC,
                    .signals = _i < 3 ? 0 : 1 + (int)step,
                    .rng = oracle_rng_start(oracle_seed(), step)};
        koksma_error err = {0};
        FILE *to = stream(&c, "w");
        koksma_status status;

        setvbuf(to, buffer, _IOFBF, 1 + step * 8);
        status = write_all(to, form, &err);
        if (status == KOKSMA_OK && fflush(to) == 0) {
            ck_assert_uint_eq(c.at, size);
            ck_assert_mem_eq(out, want, size);
        } else if (status != KOKSMA_OK) {
            ck_assert_int_eq(status, KOKSMA_EIO);
            ck_assert_msg(strncmp(err.text, "cannot write: ", 14) == 0, "%s",
                          err.text);
        } else {
            ck_assert(c.at < size);
        }
        fclose(to);
    }
    free(want);
}
END_TEST

/* ---- A pipe whose writer interrupts ----------------------------------------- */

static volatile sig_atomic_t interrupts;

static void on_interrupt(int number)
{
    (void)number;
    interrupts = interrupts + 1;
}

/* No SA_RESTART, so that a read that waits fails with EINTR; and for good, since a
 * signal may come late.  Not SIGALRM, which Check has for itself: without a fork its
 * handler kills the group of the whole test run. */
static void let_interrupts_come(void)
{
    struct sigaction action = {.sa_handler = on_interrupt};

    sigemptyset(&action.sa_mask);
    sigaction(SIGUSR1, &action, NULL);
    interrupts = 0;
}

/* A process that writes slowly, and interrupts its reader while that waits. */
static FILE *rude_pipe(input i, pid_t *writer)
{
    pid_t reader = getpid();
    int ends[2];

    ck_assert_int_eq(pipe(ends), 0);
    *writer = fork();
    ck_assert_int_ge(*writer, 0);
    if (*writer == 0) {
        struct timespec pause = {0, 1000000};

        close(ends[0]);
        for (size_t at = 0; at < i.size; at += 7) {
            size_t now = i.size - at < 7 ? i.size - at : 7;

            nanosleep(&pause, NULL);
            kill(reader, SIGUSR1);
            nanosleep(&pause, NULL);
            if (write(ends[1], i.bytes + at, now) != (ssize_t)now) _exit(1);
        }
        _exit(0);
    }
    close(ends[1]);
    return fdopen(ends[0], "r");
}

START_TEST(slow_and_interrupted)
{
    input i = input_of(_i);
    rendering want, got;
    pid_t writer;
    int left;
    FILE *in = stream_of(i.bytes, i.size);

    ck_assert_int_eq(read_all(&want, in, i.content, NULL), KOKSMA_OK);
    fclose(in);
    let_interrupts_come();
    in = rude_pipe(i, &writer);

    koksma_status status = read_all(&got, in, i.content, NULL);

    fclose(in);
    while (waitpid(writer, &left, 0) < 0)
        ck_assert_int_eq(errno, EINTR);
    ck_assert_int_eq(left, 0);
    ck_assert_int_gt(interrupts, 0);
    ck_assert_int_eq(status, KOKSMA_OK);
    ck_assert_str_eq(got.text, want.text);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("io_faults");
    TCase *tc = tcase_create("streams"), *pipes = tcase_create("pipes");

    tcase_add_loop_test(tc, few_bytes_at_a_time, 0, INPUTS);
    tcase_add_loop_test(tc, failure_anywhere, 0, INPUTS);
    tcase_add_loop_test(tc, written_or_told, 0, 6);
    suite_add_tcase(suite, tc);
#ifdef __GLIBC__
    tcase_add_loop_test(pipes, slow_and_interrupted, 0, 6);
#endif
    suite_add_tcase(suite, pipes);
    return oracle_run(suite);
}
