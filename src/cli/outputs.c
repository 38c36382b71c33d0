#include "cli/outputs.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/say.h"

/* ---- Names ---- */

static bool is_stream(const char *path) { return strcmp(path, "-") == 0; }

static bool is_folder(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

/* A pipe or a device: may be written more than once, and is not replaced. */
static bool is_special(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

/* Bytes of the path up to its last slash, that included. */
static size_t folder_length(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

static char *scene_name(const char *scene) {
    if (is_stream(scene)) return say_text("stdin");
    const char *base = scene + folder_length(scene);
    const char *dot = strrchr(base, '.');
    const bool yaml = dot && dot > base && (strcmp(dot, ".yaml") == 0 || strcmp(dot, ".yml") == 0);
    return say_text("%.*s", (int)(yaml ? (size_t)(dot - base) : strlen(base)), base);
}

/* `pattern` with each {name} replaced. NULL, with the reason on stderr, for any other word in braces. */
static char *expand(const char *pattern, const char *name) {
    char *text = say_text("%s", "");
    while (*pattern) {
        const int plain = (int)strcspn(pattern, "{");
        const bool placeholder = strncmp(pattern + plain, "{name}", 6) == 0;
        if (pattern[plain] && !placeholder) {
            say_usage(COMMAND_RENDER, "-o: expected {name}, found `%s`", pattern + plain);
            free(text);
            return NULL;
        }
        char *longer = say_text("%s%.*s%s", text, plain, pattern, placeholder ? name : "");
        free(text);
        text = longer;
        pattern += plain + (placeholder ? 6 : 0);
    }
    return text;
}

/* The path of a picture; NULL, with the reason on stderr, if `wanted` is no pattern. */
static char *output_path(const char *wanted, const char *scene, const char *name) {
    if (!wanted) return is_stream(scene) ? say_text("-") : say_text("%s.png", name);
    char *path = expand(wanted, name);
    if (!path) return NULL;
    const bool slash = *path && path[strlen(path) - 1] == '/';
    if (!slash && !is_folder(path)) return path;
    char *inside = say_text("%s%s%s.png", path, slash ? "" : "/", name);
    free(path);
    return inside;
}

/* ---- Conflicts ---- */

/* A file that is to be read or written. */
struct claim {
    char *place;      /* the same for every name of a file */
    const char *user; /* the scene, or "--stats" */
    bool writes;
};

static char *resolve(const char *path) {
    char real[PATH_MAX];
    if (realpath(path, real)) return say_text("%s", real);
    const size_t length = folder_length(path);
    char *folder = length ? say_text("%.*s", (int)length, path) : say_text(".");
    const bool found = realpath(folder, real);
    free(folder);
    return found ? say_text("%s/%s", real, path + length) : say_text("%s", path);
}

/* Those that write come first among those of one place. */
static int compare_claims(const void *a, const void *b) {
    const struct claim *p = a, *q = b;
    const int order = strcmp(p->place, q->place);
    return order ? order : (int)q->writes - (int)p->writes;
}

static bool check_claims(const struct claim *claims, size_t count) {
    for (size_t i = 0; i + 1 < count; i++) {
        const struct claim *a = &claims[i], *b = &claims[i + 1];
        if (!a->writes || strcmp(a->place, b->place) != 0) continue;
        if (b->writes)
            say_usage(COMMAND_RENDER, "%s and %s would both write %s", a->user, b->user, a->place);
        else
            say_usage(COMMAND_RENDER, "%s would be written over by the output of %s", b->user, a->user);
        return false;
    }
    return true;
}

static void add_claim(struct claim *claims, size_t *count, const char *path, const char *user, bool writes) {
    if (is_stream(path) || is_special(path)) return;
    claims[(*count)++] = (struct claim){resolve(path), user, writes};
}

static bool check_files(const char *stats, const struct output *outputs, size_t count) {
    struct claim *claims = calloc(2 * count + 1, sizeof *claims);
    size_t claimed = 0;
    for (size_t i = 0; claims && i < count; i++) {
        add_claim(claims, &claimed, outputs[i].scene, outputs[i].scene, false);
        add_claim(claims, &claimed, outputs[i].path, outputs[i].scene, true);
    }
    if (claims && stats) add_claim(claims, &claimed, stats, "--stats", true);
    if (claims) qsort(claims, claimed, sizeof *claims, compare_claims);
    const bool good = claims && check_claims(claims, claimed);
    if (!claims) say_error("out of memory");
    for (size_t i = 0; i < claimed; i++) free(claims[i].place);
    free(claims);
    return good;
}

static bool check_streams(const char *stats, const struct output *outputs, size_t count) {
    size_t inputs = 0, pictures = 0;
    for (size_t i = 0; i < count; i++) {
        inputs += is_stream(outputs[i].scene);
        pictures += is_stream(outputs[i].path);
    }
    if (inputs > 1)
        say_usage(COMMAND_RENDER, "standard input can be only one scene");
    else if (pictures > 1)
        say_usage(COMMAND_RENDER, "-o -: standard output can take only one picture");
    else if (pictures && stats && is_stream(stats))
        say_usage(COMMAND_RENDER, "--stats -: standard output takes the picture");
    else if (pictures && isatty(STDOUT_FILENO))
        say_usage(COMMAND_RENDER,
                  "a picture is not for a terminal: give -o FILE, or redirect standard output");
    else
        return true;
    return false;
}

/* ---- Folders ---- */

/* Makes the folder before the last slash of `path`, and those above it. */
static bool make_folder(char *path) {
    for (char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        const int reason = mkdir(path, 0777) == 0 ? 0 : errno;
        const bool there = is_folder(path);
        if (!there) say_error("cannot make the folder %s: %s", path, strerror(reason));
        *slash = '/';
        if (!there) return false;
    }
    return true;
}

/* So that nobody waits for a picture that cannot be kept. */
static bool check_writable(const char *path) {
    if (is_stream(path) || is_special(path)) return true;
    const size_t length = folder_length(path);
    char *folder = length ? say_text("%.*s", (int)length, path) : say_text(".");
    const bool writable =
        access(folder, W_OK | X_OK) == 0 && (access(path, F_OK) != 0 || access(path, W_OK) == 0);
    if (!writable) say_error("cannot write %s: %s", path, strerror(errno));
    free(folder);
    return writable;
}

static bool check_folders(bool make, const struct output *outputs, size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (make && !make_folder(outputs[i].path)) return false;
        if (!check_writable(outputs[i].path)) return false;
    }
    return true;
}

bool outputs_plan(const char *wanted, const char *stats, char **scenes, size_t count,
                  struct output *outputs) {
    for (size_t i = 0; i < count; i++) {
        outputs[i] = (struct output){.scene = scenes[i], .name = scene_name(scenes[i])};
        outputs[i].path = output_path(wanted, scenes[i], outputs[i].name);
        if (!outputs[i].path) return false;
    }
    const bool one_file = wanted && !strstr(wanted, "{name}") && strcmp(outputs[0].path, wanted) == 0;
    if (one_file && count > 1 && !is_stream(wanted) && !is_special(wanted)) {
        say_usage(COMMAND_RENDER,
                  "-o %s is one file for %zu scenes: end it in / for a folder, or put {name} in it", wanted,
                  count);
        return false;
    }
    const bool make = wanted && *wanted && wanted[strlen(wanted) - 1] == '/';
    return check_streams(stats, outputs, count) && check_files(stats, outputs, count) &&
           check_folders(make, outputs, count) && (!stats || check_writable(stats));
}

void outputs_free(struct output *outputs, size_t count) {
    for (size_t i = 0; i < count; i++) {
        free(outputs[i].name);
        free(outputs[i].path);
    }
}
