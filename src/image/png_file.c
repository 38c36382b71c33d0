#include "image/png_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/replace.h"

static void on_error(png_structp png, png_const_charp text) {
    struct png_file *file = png_get_error_ptr(png);
    snprintf(file->reason, sizeof file->reason, "%s", text);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp text) { (void)png, (void)text; }

static void on_write(png_structp png, png_bytep bytes, size_t size) {
    if (fwrite(bytes, 1, size, png_get_io_ptr(png)) != size) png_error(png, strerror(errno));
}

static void on_flush(png_structp png) { (void)png; }

/* libpng's errors come back here. Nothing is changed between, so that nothing is lost. */
static bool put_all(struct png_file *file, void (*put)(struct png_file *file, const void *context),
                    const void *context) {
    if (setjmp(png_jmpbuf(file->png))) return false;
    put(file, context);
    return true;
}

static bool write_stream(struct png_file *file, FILE *stream, size_t row_size,
                         void (*put)(struct png_file *file, const void *context), const void *context) {
    bool written = false;
    file->row = malloc(row_size);
    file->png = png_create_write_struct(PNG_LIBPNG_VER_STRING, file, on_error, on_warning);
    if (file->png) file->info = png_create_info_struct(file->png);
    if (file->row && file->info) {
        png_set_user_limits(file->png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        png_set_write_fn(file->png, stream, on_write, on_flush);
        written = put_all(file, put, context);
    } else {
        snprintf(file->reason, sizeof file->reason, "%s", strerror(ENOMEM));
    }
    png_destroy_write_struct(&file->png, &file->info);
    free(file->row);
    return written;
}

bool png_file_write(struct png_file *file, const char *path, size_t row_size,
                    void (*put)(struct png_file *file, const void *context), const void *context) {
    struct replacement place;
    *file = (struct png_file){.png = NULL};
    if (replace_begin(&place, path) &&
        replace_end(&place, write_stream(file, place.stream, row_size, put, context)))
        return true;
    if (!*file->reason) snprintf(file->reason, sizeof file->reason, "%s", strerror(errno));
    return false;
}
