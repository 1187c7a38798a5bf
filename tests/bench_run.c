/* bench_run FILE COMMAND ARGUMENT...: run the command as it is, and write to FILE
 * what it took, all its processes together: CPU seconds, seconds by the clock, and
 * the peak of the largest one's memory in MiB.  Returns what the command returned,
 * or 128 and its signal as a shell does. */

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench.h"

static double wall(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double seconds(struct timeval t)
{
    return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

static int run(char **command)
{
    int status = 0;
    pid_t child = fork();

    if (child == 0) {
        execvp(command[0], command);
        perror(command[0]);
        _exit(127);
    }
    bench_must(child < 0 || waitpid(child, &status, 0) != child, "a process");
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

int main(int argc, char **argv)
{
    double started = wall();
    struct rusage u;
    FILE *file;
    int status = 0;

    bench_must(argc < 3, "a file and a command");
    status = run(argv + 2);
    getrusage(RUSAGE_CHILDREN, &u);
    file = fopen(argv[1], "w");
    bench_must(file == NULL, argv[1]);
    fprintf(file, "%.4g %.4g %.4g\n", seconds(u.ru_utime) + seconds(u.ru_stime),
            wall() - started, (double)u.ru_maxrss / 1024.0);
    bench_must(fclose(file) != 0, argv[1]);
    return status;
}
