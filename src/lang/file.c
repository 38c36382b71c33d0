#include "lang/file.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

const struct source *file_from_memory(struct arena *arena, const char *name, const char *text, size_t size) {
    const bool marked = size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0;
    struct source *source = arena_alloc(arena, sizeof *source);
    *source = (struct source){arena_text(arena, name, strlen(name)), marked ? text + 3 : text,
                              marked ? size - 3 : size};
    return source;
}

/* Reads to the end into a text that doubles as it fills; `size` says how much there should be, or 0.
 * NULL with errno on an error of the stream. One byte past the limit is enough to know. */
static char *read_all(struct arena *arena, FILE *in, size_t size, size_t limit, size_t *out) {
    size_t room = size ? size + 1 : 64 * 1024, used = 0;
    char *text = arena_room(arena, room);
    for (;;) {
        const size_t got = fread(text + used, 1, room - used, in);
        used += got;
        if (ferror(in)) return NULL;
        if (feof(in) || used > limit) break;
        if (used == room) {
            char *larger = arena_room(arena, 2 * room);
            memcpy(larger, text, used);
            text = larger;
            room *= 2;
        }
    }
    *out = used;
    return text;
}

static const struct source *read_stream(struct arena *arena, struct diagnostics *diag, const char *name,
                                        FILE *in, size_t limit) {
    struct stat info;
    const bool regular = fstat(fileno(in), &info) == 0 && S_ISREG(info.st_mode) && info.st_size > 0;
    size_t size = regular ? (size_t)info.st_size : 0;
    char *text = size > limit ? NULL : read_all(arena, in, size, limit, &size);
    if (text && size <= limit) {
        struct source *source = arena_alloc(arena, sizeof *source);
        *source = (struct source){arena_text(arena, name, strlen(name)), text, size};
        return source;
    }
    if (size > limit)
        diag_failure(diag, "limit-file-bytes", "%s: longer than %zu bytes (the limit `file_bytes`)", name,
                     limit);
    else
        diag_failure(diag, "cannot-read", "cannot read %s: %s", name, strerror(errno));
    return NULL;
}

const struct source *file_read_bytes(struct arena *arena, struct diagnostics *diag, const char *path,
                                     size_t limit) {
    if (strcmp(path, "-") == 0) return read_stream(arena, diag, "<stdin>", stdin, limit);
    FILE *in = fopen(path, "rb");
    if (!in) {
        diag_failure(diag, "cannot-read", "cannot read %s: %s", path, strerror(errno));
        return NULL;
    }
    /* The arena leaves by longjmp when it is full; the file must be closed on that way as well. */
    jmp_buf full, *const outer = arena_catch(arena, &full);
    const struct source *volatile source = NULL;
    const bool is_full = setjmp(full) != 0;
    if (!is_full) source = read_stream(arena, diag, path, in, limit);
    fclose(in);
    arena_catch(arena, outer);
    if (is_full && outer) longjmp(*outer, 1);
    return source;
}

const struct source *file_read(struct arena *arena, struct diagnostics *diag, const char *path,
                               size_t limit) {
    const struct source *source = file_read_bytes(arena, diag, path, limit);
    return source ? file_from_memory(arena, source->name, source->text, source->size) : NULL;
}
