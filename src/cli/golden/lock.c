#include "cli/golden/lock.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/golden/folder.h"
#include "cli/paths.h"
#include "cli/say.h"

/* ---- Texts in a line ---- */

/* A byte that is written as %XX; blanks only in names. */
static bool is_escaped(unsigned char c, bool blanks) {
    return c < 0x20 || c == 0x7f || c == '%' || (blanks && c == ' ');
}

static void print_escaped(FILE *out, const char *text, bool blanks) {
    for (const char *c = text; *c; c++)
        if (is_escaped((unsigned char)*c, blanks))
            fprintf(out, "%%%02X", (unsigned char)*c);
        else
            putc(*c, out);
}

/* As the first character of a line it would be that of a comment, or of a conflict of a merge. */
static bool begins_no_name(char c) { return c && strchr("#<=>|", c); }

static void print_name(FILE *out, const char *name) {
    if (begins_no_name(*name)) fprintf(out, "%%%02X", (unsigned char)*name++);
    print_escaped(out, name, true);
}

static int digit_of(char c) {
    static const char digits[] = "0123456789ABCDEF";
    const char *at = c ? strchr(digits, c) : NULL;
    return at ? (int)(at - digits) : -1;
}

/* In place. False: it is not as print_name writes it, or print_escaped. */
static bool unescape(char *text, bool is_name) {
    char *to = text;
    for (const char *c = text; *c; c++) {
        if (*c != '%') {
            if (is_escaped((unsigned char)*c, is_name)) return false;
            *to++ = *c;
            continue;
        }
        const int high = digit_of(c[1]), low = high < 0 ? -1 : digit_of(c[2]);
        const char meant = low < 0 ? '\0' : (char)(16 * high + low);
        const bool first = is_name && to == text && begins_no_name(meant);
        if (!meant || !(first || is_escaped((unsigned char)meant, is_name))) return false;
        *to++ = meant;
        c += 2;
    }
    *to = '\0';
    return true;
}

/* ---- One line ---- */

/* Digits at *text, which moves behind them. */
static uint32_t read_whole(const char **text) {
    uint32_t value = 0;
    for (; (unsigned)(**text - '0') < 10 && value < 1u << 24; ++*text)
        value = 10 * value + (uint32_t)(**text - '0');
    return value;
}

static bool read_size(const char *text, struct golden_stamp *stamp) {
    stamp->width = read_whole(&text);
    if (*text++ != 'x') return false;
    stamp->height = read_whole(&text);
    if (*text++ != 'x') return false;
    stamp->bits = read_whole(&text);
    return !*text && stamp->width >= 1 && stamp->width <= MONGE_MAX_SIDE && stamp->height >= 1 &&
           stamp->height <= MONGE_MAX_SIDE && (stamp->bits == 8 || stamp->bits == 16);
}

static bool read_hash(const char *text, char hash[MONGE_HASH_SIZE]) {
    if (*hash || strlen(text) != MONGE_HASH_SIZE - 1 || strspn(text, "0123456789abcdef") != strlen(text))
        return false;
    memcpy(hash, text, MONGE_HASH_SIZE);
    return true;
}

/* KEY=HASH. */
static bool read_field(const char *field, struct golden_stamp *stamp) {
    const char *const keys[] = {"pixels", "scene", "text", "program"};
    char *const hashes[] = {stamp->pixels, stamp->scene, stamp->text, stamp->program};
    const size_t length = strcspn(field, "=");
    for (int i = 0; i < 4 + GOLDEN_LAYERS && field[length]; i++) {
        const char *key = i < 4 ? keys[i] : monge_layer_name(GOLDEN_LAYER[i - 4]);
        if (strlen(key) == length && strncmp(field, key, length) == 0)
            return read_hash(field + length + 1, i < 4 ? hashes[i] : stamp->layers[i - 4]);
    }
    return false;
}

/* What is wrong with it; NULL: nothing. Takes the line apart. */
static const char *read_line(char *text, struct golden_line *line) {
    static const char conflict[][8] = {"<<<<<<<", "=======", ">>>>>>>", "|||||||"};
    for (size_t i = 0; i < 4; i++)
        if (strncmp(text, conflict[i], 7) == 0) return "a conflict of a merge that is not resolved";
    char *options = strstr(text, " options="), *rest = text;
    if (options) *options = '\0';
    char *name = strsep(&rest, " "), *size = strsep(&rest, " ");
    if (!unescape(name, true) || !golden_name_is_safe(name)) return "no name of a golden";
    if (!size || !read_size(size, &line->stamp)) return "after the name a size is expected, as 640x480x8";
    for (char *field; (field = strsep(&rest, " "));)
        if (!read_field(field, &line->stamp))
            return "expected pixels=, scene=, text=, program= and the like, each once and with a hash";
    if (!*line->stamp.pixels) return "it has no pixels=";
    if (options && !unescape(options + 9, false))
        return "options with a character that must be written as %XX";
    line->stamp.options = say_text("%s", options ? options + 9 : "");
    line->name = say_text("%s", name);
    return NULL;
}

static void print_hash(FILE *out, const char *key, const char *hash) {
    if (*hash) fprintf(out, " %s=%s", key, hash);
}

static void print_line(FILE *out, const char *name, const struct golden_stamp *s) {
    print_name(out, name);
    fprintf(out, " %ux%ux%u", s->width, s->height, s->bits);
    print_hash(out, "pixels", s->pixels);
    print_hash(out, "scene", s->scene);
    print_hash(out, "text", s->text);
    print_hash(out, "program", s->program);
    for (int i = 0; i < GOLDEN_LAYERS; i++) print_hash(out, monge_layer_name(GOLDEN_LAYER[i]), s->layers[i]);
    if (s->options && *s->options) {
        fputs(" options=", out);
        print_escaped(out, s->options, false);
    }
}

char *golden_lock_text(const char *name, const struct golden_stamp *stamp) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = say_text_begin(&text, &size);
    print_line(out, name, stamp);
    say_text_end(out);
    return text;
}

char *golden_lock_line(const char *name, const struct golden_stamp *stamp) {
    struct golden_stamp begin = {.width = stamp->width, .height = stamp->height, .bits = stamp->bits};
    memcpy(begin.pixels, stamp->pixels, sizeof begin.pixels);
    return golden_lock_text(name, &begin);
}

/* ---- The file ---- */

static int compare_lines(const void *a, const void *b) {
    return strcmp(((const struct golden_line *)a)->name, ((const struct golden_line *)b)->name);
}

/* Those of one name by their order in the file. */
static int compare_places(const void *a, const void *b) {
    const unsigned p = ((const struct golden_line *)a)->number, q = ((const struct golden_line *)b)->number;
    const int order = compare_lines(a, b);
    return order ? order : (p > q) - (p < q);
}

static struct golden_line *add_line(struct golden_lock *lock, unsigned number) {
    lock->lines = realloc(lock->lines, (lock->count + 1) * sizeof *lock->lines);
    if (!lock->lines) say_no_memory();
    lock->lines[lock->count] = (struct golden_line){.number = number};
    return &lock->lines[lock->count++];
}

static void free_line(struct golden_line *line) {
    free(line->name);
    golden_stamp_free(&line->stamp);
}

static bool read_lines(struct golden_lock *lock, const struct monge_text *text) {
    char *at = text->bytes, *const end = text->bytes + text->size;
    for (unsigned number = 1; at < end; number++) {
        char *stop = memchr(at, '\n', (size_t)(end - at));
        const char *wrong = NULL;
        if (stop) *stop = '\0';
        if (!stop || strlen(at) != (size_t)(stop - at))
            wrong = stop ? "a NUL character" : "the line is cut off";
        else if (*at && *at != '#')
            wrong = read_line(at, add_line(lock, number));
        if (wrong) {
            say_error("%s:%u: %s", lock->path, number, wrong);
            if (lock->count > 0 && !lock->lines[lock->count - 1].name) free_line(&lock->lines[--lock->count]);
            return false;
        }
        at = stop + 1;
    }
    return true;
}

static bool check_names(const struct golden_lock *lock) {
    for (size_t i = 1; i < lock->count; i++) {
        const struct golden_line *line = &lock->lines[i];
        if (strcmp(line[-1].name, line->name) != 0) continue;
        say_error("%s:%u: a second line for %s, as line %u is: keep one of them", lock->path, line->number,
                  line->name, line[-1].number);
        return false;
    }
    return true;
}

bool golden_lock_read(struct golden_lock *lock, const char *folder) {
    *lock = (struct golden_lock){.path = path_below(folder, "golden.lock", "")};
    if (access(lock->path, F_OK) != 0 && errno == ENOENT) return true;
    if (!golden_check_file(lock->path)) return false;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_text text = {NULL, 0};
    bool good = diag && monge_text_read(lock->path, NULL, &text, diag);
    if (diag && !good) monge_diagnostics_print(diag, say_stream());
    good = good && read_lines(lock, &text);
    if (lock->count > 0) qsort(lock->lines, lock->count, sizeof *lock->lines, compare_places);
    monge_text_free(&text);
    monge_diagnostics_free(diag);
    return good && check_names(lock);
}

void golden_lock_free(struct golden_lock *lock) {
    for (size_t i = 0; i < lock->count; i++) free_line(&lock->lines[i]);
    free(lock->lines);
    free(lock->path);
}

/* One that is gone too. */
static struct golden_line *find_line(const struct golden_lock *lock, const char *name) {
    const struct golden_line key = {.name = (char *)name};
    return lock->count ? bsearch(&key, lock->lines, lock->count, sizeof key, compare_lines) : NULL;
}

const struct golden_line *golden_lock_find(const struct golden_lock *lock, const char *name) {
    const struct golden_line *line = find_line(lock, name);
    return line && !line->gone ? line : NULL;
}

/* A line without a name, at the place of one of that name. */
static struct golden_line *insert_line(struct golden_lock *lock, const char *name) {
    struct golden_line *line = add_line(lock, 0);
    for (; line > lock->lines && strcmp(line[-1].name, name) > 0; line--) *line = line[-1];
    return line;
}

void golden_lock_put(struct golden_lock *lock, const char *name, const struct golden_stamp *stamp) {
    struct golden_line *line = find_line(lock, name);
    if (line)
        free_line(line);
    else
        line = insert_line(lock, name);
    *line = (struct golden_line){.name = say_text("%s", name), .stamp = *stamp};
    line->stamp.options = say_text("%s", stamp->options ? stamp->options : "");
}

void golden_lock_remove(struct golden_lock *lock, const char *name) {
    struct golden_line *line = find_line(lock, name);
    if (line) line->gone = true;
}

static bool is_empty(const struct golden_lock *lock) {
    for (size_t i = 0; i < lock->count; i++)
        if (!lock->lines[i].gone) return false;
    return true;
}

bool golden_lock_write(const struct golden_lock *lock) {
    struct monge_text text = {NULL, 0};
    if (is_empty(lock)) return unlink(lock->path) == 0 || errno == ENOENT;
    FILE *out = open_memstream(&text.bytes, &text.size);
    if (out) fputs("# Goldens of `monge test`, a line each; `monge accept` writes them.\n", out);
    for (size_t i = 0; out && i < lock->count; i++)
        if (!lock->lines[i].gone) {
            print_line(out, lock->lines[i].name, &lock->lines[i].stamp);
            putc('\n', out);
        }
    const bool good = out && fclose(out) == 0 && golden_update(lock->path, &text);
    free(text.bytes);
    return good;
}
