#include <errno.h>
#include <inttypes.h>
#include <stdint.h>
#include <string.h>

#include "error.h"
#include "io_kernels.h"

static koksma_status refused(koksma_error *err)
{
    return ki_fail(err, KOKSMA_EIO, 0, "cannot write: %s", strerror(errno));
}

static koksma_status write_npy(FILE *out, const double *rows, size_t count,
                               koksma_error *err)
{
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    return fwrite(rows, sizeof *rows, count, out) == count ? KOKSMA_OK
                                                           : refused(err);
#else
    for (size_t i = 0; i < count; i++) {
        uint64_t bits;

        memcpy(&bits, rows + i, sizeof bits);
        bits = __builtin_bswap64(bits);
        if (fwrite(&bits, sizeof bits, 1, out) != 1) return refused(err);
    }
    return KOKSMA_OK;
#endif
}

koksma_status koksma_write_rows(FILE *out, const double *rows, size_t n,
                                size_t columns, koksma_form form, koksma_error *err)
{
    char text[8192];
    size_t used = 0;
    ki_c_locale l;

    if (form == KOKSMA_NPY) return write_npy(out, rows, n * columns, err);
    l = ki_c_locale_enter();
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < columns; k++) {
            double v = rows[i * columns + k];

            if (form == KOKSMA_HEX)
                used += (size_t)snprintf(text + used, KOKSMA_NUMBER_SIZE, "%a", v);
            else
                used += koksma_format_number(text + used, v);
            text[used++] = k + 1 < columns ? '\t' : '\n';
            if (used + KOKSMA_NUMBER_SIZE < sizeof text) continue;
            if (fwrite(text, 1, used, out) != used) goto failed;
            used = 0;
        }
    if (fwrite(text, 1, used, out) != used) goto failed;
    ki_c_locale_leave(l);
    return KOKSMA_OK;

failed:
    refused(err); /* before anything else changes errno */
    ki_c_locale_leave(l);
    return KOKSMA_EIO;
}

koksma_status koksma_write_npy_header(FILE *out, size_t n, size_t columns,
                                      koksma_error *err)
{
    /* 10 bytes and 118 of dictionary: NumPy wants a multiple of 64. */
    char header[128];
    int length;

    memset(header, ' ', sizeof header);
    memcpy(header, "\x93NUMPY\x01\x00\x76\x00", 10);
    length =
        snprintf(header + 10, sizeof header - 11,
                 "{'descr': '<f8', 'fortran_order': False, 'shape': (%zu, %zu), }",
                 n, columns);
    header[10 + length] = ' ';
    header[sizeof header - 1] = '\n';
    return fwrite(header, 1, sizeof header, out) == sizeof header ? KOKSMA_OK
                                                                  : refused(err);
}
