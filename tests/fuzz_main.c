/* A fuzz target without a fuzzer: it is given each file of the directories that the
 * command line names, once.  A directory without files is a failure. */
#include <dirent.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

static int replay_file(const char *path)
{
    enum { MOST = 1 << 20 };
    FILE *in = fopen(path, "rb");
    uint8_t *bytes = malloc(MOST);
    size_t size = 0;
    int failed = 1;

    if (in != NULL && bytes != NULL) {
        size = fread(bytes, 1, MOST, in);
        failed = ferror(in) || !feof(in);
    }
    if (in != NULL) fclose(in);
    if (failed) {
        fprintf(stderr, "%s: cannot be read whole\n", path);
    } else {
        /* Of its very size, so that a sanitizer sees reads past the end. */
        uint8_t *exact = realloc(bytes, size > 0 ? size : 1);

        if (exact != NULL) bytes = exact;
        (void)LLVMFuzzerTestOneInput(bytes, size);
    }
    free(bytes);
    return failed;
}

static int replay_directory(const char *name)
{
    DIR *directory = opendir(name);
    struct dirent *entry;
    size_t files = 0;
    int failed = 0;

    while (directory != NULL && (entry = readdir(directory)) != NULL) {
        char path[4096];

        if (entry->d_name[0] == '.') continue;
        snprintf(path, sizeof path, "%s/%s", name, entry->d_name);
        /* Said before, so that a crash names its file. */
        printf("%s\n", path);
        fflush(stdout);
        failed |= replay_file(path);
        files++;
    }
    if (directory != NULL) closedir(directory);
    if (files == 0) fprintf(stderr, "%s: no files to replay\n", name);
    return failed || files == 0;
}

int main(int argc, char *argv[])
{
    int failed = argc < 2;

    for (int i = 1; i < argc; i++)
        failed |= replay_directory(argv[i]);
    return failed;
}
