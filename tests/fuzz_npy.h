#ifndef KOKSMA_TESTS_FUZZ_NPY_H
#define KOKSMA_TESTS_FUZZ_NPY_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

/* What a line of bytes says of an array: a letter for its type, one for its order,
 * then its shape, as in "fC(3, 2)"; the bytes behind are its numbers.  A type that
 * is not in the list stands as it is. */
static inline void put_header(FILE *out, const char *line, int length)
{
    static const char *const types[][2] = {
        {"d", "<f8"}, {"D", ">f8"}, {"f", "<f4"}, {"F", ">f4"}, {"i", "<i8"}};
    const char *type = NULL;
    char text[512];
    int used;

    for (size_t t = 0; t < sizeof types / sizeof *types && length > 0; t++)
        if (types[t][0][0] == line[0]) type = types[t][1];
    used = snprintf(text, sizeof text,
                    "{'descr': '%s%.*s', 'fortran_order': %s, 'shape': %.*s, }\n",
                    type != NULL ? type : "", type != NULL ? 0 : length > 0, line,
                    length > 1 && line[1] == 'F' ? "True" : "False",
                    length > 2 ? length - 2 : 0, line + (length > 2 ? 2 : 0));
    if (used >= (int)sizeof text) used = (int)sizeof text - 1;
    fwrite("\x93NUMPY\x01\x00", 1, 8, out);
    putc(used & 255, out);
    putc(used >> 8, out);
    fwrite(text, 1, (size_t)used, out);
}

/* The bytes as so many arrays, of the same length each; returns the length of
 * *file, which is the caller's to free. */
static inline size_t npy_of(char **file, const uint8_t *bytes, size_t size,
                            size_t arrays)
{
    size_t length = 0;
    FILE *out = open_memstream(file, &length);

    if (out == NULL) abort();
    for (size_t a = 0; a < arrays; a++) {
        const char *from = (const char *)bytes + size * a / arrays;
        size_t all = size * (a + 1) / arrays - size * a / arrays, line = 0;

        while (line < all && line < 300 && from[line] != '\n')
            line++;
        put_header(out, from, (int)line);
        if (line < all) line++;
        fwrite(from + line, 1, all - line, out);
    }
    fclose(out);
    return length;
}

#endif
