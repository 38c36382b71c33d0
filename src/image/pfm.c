#include "image/pfm.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "image/replace.h"

static void put_float(float value, uint8_t bytes[4]) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 4; i++) bytes[i] = (uint8_t)(bits >> (8 * i));
}

static float get_float(const uint8_t bytes[4], bool least_first) {
    uint32_t bits = 0;
    float value;
    for (int i = 0; i < 4; i++) bits |= (uint32_t)bytes[least_first ? i : 3 - i] << (8 * i);
    memcpy(&value, &bits, sizeof value);
    return value;
}

static bool write_rows(FILE *stream, uint32_t width, uint32_t height, const float *values) {
    uint8_t *row = malloc(4 * (size_t)width);
    bool good = row && fprintf(stream, "Pf\n%u %u\n-1.0\n", width, height) > 0;
    for (uint32_t y = height; good && y-- > 0;) {
        for (uint32_t x = 0; x < width; x++) put_float(values[(size_t)y * width + x], row + 4 * (size_t)x);
        good = fwrite(row, 4, width, stream) == width;
    }
    const int reason = errno;
    free(row);
    errno = reason;
    return good;
}

bool pfm_write(const char *path, uint32_t width, uint32_t height, const float *values, char *message,
               size_t size) {
    struct replacement file;
    const bool good =
        replace_begin(&file, path) && replace_end(&file, write_rows(file.stream, width, height, values));
    if (!good) snprintf(message, size, "cannot write %s: %s", path, strerror(errno));
    return good;
}

static bool read_header(FILE *stream, size_t most, uint32_t *width, uint32_t *height, bool *least_first) {
    float scale;
    char kind[3], space;
    if (fscanf(stream, "%2s %9u %9u %20f%c", kind, width, height, &scale, &space) != 5) return false;
    *least_first = scale < 0.0f;
    return strcmp(kind, "Pf") == 0 && (space == '\n' || space == ' ') && *width && *height &&
           *height <= most / *width;
}

static bool read_rows(FILE *stream, uint32_t width, uint32_t height, bool least_first, float *values) {
    for (uint32_t y = height; y-- > 0;) {
        float *row = values + (size_t)y * width;
        if (fread(row, 4, width, stream) != width) return false;
        for (uint32_t x = 0; x < width; x++) row[x] = get_float((const uint8_t *)&row[x], least_first);
    }
    return fgetc(stream) == EOF;
}

bool pfm_read(const char *path, size_t most, uint32_t *width, uint32_t *height, float **values, char *message,
              size_t size) {
    FILE *stream = fopen(path, "rb");
    const char *reason = strerror(errno);
    bool least_first, good = false;
    *values = NULL;
    if (stream) {
        reason = "it is no whole PFM of one channel";
        if (read_header(stream, most, width, height, &least_first)) {
            *values = malloc((size_t)*width * *height * sizeof **values);
            if (!*values) reason = strerror(ENOMEM);
            good = *values && read_rows(stream, *width, *height, least_first, *values);
        }
        fclose(stream);
    }
    if (good) return true;
    free(*values);
    *values = NULL;
    snprintf(message, size, "cannot read %s: %s", path, reason);
    return false;
}
