#include "cli/outputs.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/aov.h"
#include "cli/paths.h"
#include "cli/pattern.h"
#include "cli/say.h"
#include "cli/scene_path.h"

/* ---- Names ---- */

static bool is_stream(const char *path) { return strcmp(path, "-") == 0; }

static char *joined(char *text, const char *more) {
    char *longer = say_text("%s%s", text, more);
    free(text);
    return longer;
}

static bool ends_in_slash(const char *path) { return *path && path[strlen(path) - 1] == '/'; }

static char *usual_file(const struct plan *plan, const struct pattern_values *values) {
    return joined(pattern_usual(plan->sweep, values), ".png");
}

/* The path of a picture; of `frame` 0, as far as it is known without the frame. Of a still, which has no last frame, the
 * usual name is that without a frame. */
static char *picture_path(const struct plan *plan, const struct output *output, unsigned frame,
                          unsigned last) {
    struct pattern_values values = {.name = output->name,
                                    .defines = output->defines,
                                    .define_count = plan->sweep->count,
                                    .frames = plan->frames != NULL,
                                    .frame = frame,
                                    .digits = pattern_digits(last)};
    char *path = plan->wanted ? pattern_expand(plan->wanted, &values) : NULL;
    if (frame > 0 && last == 0) values.frames = false;
    if (!path) return is_stream(output->scene) ? say_text("-") : usual_file(plan, &values);
    const bool slash = ends_in_slash(path);
    if (!slash && !path_is_folder(path)) return path;
    char *name = usual_file(plan, &values);
    path = joined(joined(path, slash ? "" : "/"), name);
    free(name);
    return path;
}

/* ---- Patterns ---- */

/* A pattern like the one that is wanted, in which all is told apart. */
static char *better_pattern(const struct plan *plan) {
    const char *wanted = plan->wanted, *dot = strrchr(wanted, '.');
    const bool extended = dot && dot > wanted + path_folder_length(wanted);
    char *text = say_text("%.*s", (int)(extended ? (size_t)(dot - wanted) : strlen(wanted)), wanted);
    if ((plan->scenes->count > 1 || plan->scenes->several) && !pattern_has(wanted, "name"))
        text = joined(text, "-{name}");
    for (size_t i = 0; i < plan->sweep->count; i++) {
        const struct axis *axis = &plan->sweep->axes[i];
        char *part = say_text("-{%s}", axis->name);
        if (axis->count > 1 && !pattern_has(wanted, axis->name)) text = joined(text, part);
        free(part);
    }
    if (plan->frames && !pattern_has_frame(wanted)) text = joined(text, "-{frame}");
    return joined(text, extended ? dot : ".png");
}

static bool many_frames(const struct plan *plan) {
    return plan->frames && plan->frames->number[0] != plan->frames->number[1];
}

/* What `plan` has too many of for a single file. To be freed. */
static char *many_text(const struct plan *plan, bool no_frame, bool plain) {
    if (no_frame) return say_text("many frames");
    if (plan->count <= 1 || !plain) return say_text("a folder, a pattern or a list of scenes");
    return say_text("%zu %s", plan->count, plan->sweep->total > 1 ? "pictures" : "scenes");
}

/* A single file for many pictures is wrong, but for one that takes them all, as a device does; so it is for what may
 * stand for many scenes, however many there are today. */
static bool check_pattern(const struct plan *plan) {
    const char *wanted = plan->wanted;
    if (!wanted || is_stream(wanted)) return true;
    if (!pattern_check(wanted, plan->sweep, plan->frames != NULL)) return false;
    if (ends_in_slash(wanted) || path_is_folder(wanted) || path_is_special(wanted)) return true;
    const bool no_frame = many_frames(plan) && !pattern_has_frame(wanted);
    const bool plain = pattern_is_plain(wanted, plan->frames != NULL);
    const bool one_file =
        (plan->count > 1 && plain) || (plan->scenes->several && !pattern_has(wanted, "name"));
    if (!no_frame && !one_file) return true;
    char *pattern = better_pattern(plan);
    char *many = many_text(plan, no_frame, plain);
    say_usage(COMMAND_RENDER, "-o %s is one file for %s: end it in / for a folder, or write -o '%s'", wanted,
              many, pattern);
    free(many);
    free(pattern);
    return false;
}

/* What is called like a scene or a picture would write over one, were it another than is rendered. */
static bool check_no_input(const char *option, const char *path, const char *extension) {
    const char *end = path ? path_input_extension(path) : NULL;
    if (!end || path_is_special(path)) return true;
    say_usage(COMMAND_RENDER, "%s %s is called like a %s; did you mean %.*s%s?", option, path,
              scene_extension(path) ? "scene" : "picture", (int)(end - path), path, extension);
    return false;
}

static bool check_kinds(const struct plan *plan) {
    const char *wanted = plan->wanted;
    return (!wanted || is_stream(wanted) || path_check_picture(COMMAND_RENDER, "-o", wanted)) &&
           check_no_input("--stats", plan->stats, ".json") && check_no_input("--log", plan->log, ".log");
}

/* ---- Conflicts ---- */

/* A file that is to be read or written. */
struct claim {
    char *place;      /* the same for every name of a file */
    const char *user; /* the scene with its values, or "--stats" */
    bool writes;
};

static char *resolve(const char *path) {
    char real[PATH_MAX];
    if (realpath(path, real)) return say_text("%s", real);
    const size_t length = path_folder_length(path);
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

static bool is_namesake(const char *a, const char *b) {
    return strcmp(a, b) != 0 && strcmp(a + path_folder_length(a), b + path_folder_length(b)) == 0;
}

static void report_collision(const struct plan *plan, const struct claim *a, const struct claim *b) {
    const bool sweep = plan->wanted && plan->sweep->total > 1;
    char *pattern = sweep ? better_pattern(plan) : NULL;
    if (!b->writes)
        say_usage(COMMAND_RENDER, "%s would be written over by the output of %s", b->user, a->user);
    else if (pattern && strcmp(pattern, plan->wanted) != 0)
        say_usage(COMMAND_RENDER, "%s and %s would both write %s; write -o '%s'", a->user, b->user, a->place,
                  pattern);
    else
        say_usage(COMMAND_RENDER, "%s and %s would both write %s%s", a->user, b->user, a->place,
                  is_namesake(a->user, b->user) ? "; with --root DIR they keep their folders" : "");
    free(pattern);
}

static bool check_claims(struct plan *plan) {
    qsort(plan->claims, plan->claim_count, sizeof *plan->claims, compare_claims);
    for (size_t i = 0; i + 1 < plan->claim_count; i++) {
        const struct claim *a = &plan->claims[i], *b = &plan->claims[i + 1];
        if (!a->writes || strcmp(a->place, b->place) != 0) continue;
        report_collision(plan, a, b);
        return false;
    }
    return true;
}

/* There is room for it. */
static void add_claim(struct plan *plan, const char *path, const char *user, bool writes) {
    if (is_stream(path) || path_is_special(path)) return;
    plan->claims[plan->claim_count++] = (struct claim){resolve(path), user, writes};
}

/* A picture with the files of its passes. */
static void add_picture_claims(struct plan *plan, const char *picture, const char *user) {
    add_claim(plan, picture, user, true);
    for (enum monge_layer layer = 0; layer < MONGE_LAYERS; layer++) {
        if (!(plan->passes >> layer & 1)) continue;
        char *path = aov_path(layer, picture);
        add_claim(plan, path, user, true);
        free(path);
    }
}

static bool make_room(struct plan *plan, size_t more) {
    struct claim *claims = realloc(plan->claims, (plan->claim_count + more) * sizeof *claims);
    if (claims)
        plan->claims = claims;
    else
        say_error("out of memory");
    return claims != NULL;
}

static bool spares(const char *option, const char *path, const char *read) {
    const char *file = is_stream(read) ? "/dev/stdin" : read;
    if (!path || path_is_special(path) || !path_is_same(path, file)) return true;
    say_usage(COMMAND_RENDER, "%s would be written over by the output of %s", is_stream(read) ? path : read,
              option);
    return false;
}

/* By whatever names: a log grows in place, in all of them. */
static bool check_inputs(const struct plan *plan) {
    const struct scenes *scenes = plan->scenes;
    bool good = true;
    for (size_t i = 0; good && i < scenes->list_count; i++)
        good =
            spares("--stats", plan->stats, scenes->lists[i]) && spares("--log", plan->log, scenes->lists[i]);
    for (size_t i = 0; good && i < scenes->count; i++)
        good = spares("--stats", plan->stats, scenes->all[i].path) &&
               spares("--log", plan->log, scenes->all[i].path);
    return good;
}

static bool check_files(struct plan *plan) {
    const struct scenes *scenes = plan->scenes;
    if (!make_room(plan, plan->count * (2 + MONGE_LAYERS) + scenes->list_count + 2)) return false;
    for (size_t i = 0; i < scenes->list_count; i++)
        add_claim(plan, scenes->lists[i], scenes->lists[i], false);
    for (size_t i = 0; i < plan->count; i += plan->sweep->total)
        add_claim(plan, plan->outputs[i].scene, plan->outputs[i].scene, false);
    for (size_t i = 0; i < plan->count; i++)
        add_picture_claims(plan, plan->outputs[i].path, plan->outputs[i].title);
    if (plan->stats) add_claim(plan, plan->stats, "--stats", true);
    if (plan->log) add_claim(plan, plan->log, "--log", true);
    return check_inputs(plan) && check_claims(plan);
}

static bool check_streams(const struct plan *plan) {
    const bool stats = plan->stats && is_stream(plan->stats), log = plan->log && is_stream(plan->log);
    size_t pictures = 0, devices = 0;
    for (size_t i = 0; i < plan->count; i++) {
        pictures += is_stream(plan->outputs[i].path);
        devices += path_is_special(plan->outputs[i].path);
    }
    if (pictures > 1 || (pictures && (many_frames(plan) || plan->scenes->several)))
        say_usage(COMMAND_RENDER, "-o -: standard output can take only one picture");
    else if (plan->passes && pictures)
        say_usage(COMMAND_RENDER, "--aov: passes are files beside the picture; give -o FILE");
    else if (plan->passes && devices)
        say_usage(COMMAND_RENDER, "--aov: passes are files beside the picture, which %s is not",
                  plan->wanted);
    else if (pictures && (stats || log))
        say_usage(COMMAND_RENDER, "%s -: standard output takes the picture", stats ? "--stats" : "--log");
    else if (stats && log)
        say_usage(COMMAND_RENDER, "--stats - and --log -: standard output can take only one of them");
    else if (pictures && isatty(STDOUT_FILENO))
        say_usage(COMMAND_RENDER,
                  "a picture is not for a terminal: give -o FILE, or redirect standard output");
    else
        return true;
    return false;
}

/* ---- Folders ---- */

/* Once, however many pictures there are for it. */
static void tell_lost(struct plan *plan, const char *folder, int reason) {
    pthread_mutex_lock(&plan->lock);
    const bool told = plan->lost && strcmp(plan->lost, folder) == 0;
    if (!told) {
        free(plan->lost);
        plan->lost = say_text("%s", folder);
    }
    pthread_mutex_unlock(&plan->lock);
    if (!told)
        report_failure(plan->report, "cannot-make-folder", "cannot make the folder %s: %s", folder,
                       access(folder, F_OK) == 0 ? "it is a file" : strerror(reason));
}

/* Makes the folder before the last slash of `path`, and those above it. */
static bool make_folder(struct plan *plan, char *path) {
    for (char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        const int reason = mkdir(path, 0777) == 0 ? 0 : errno;
        const bool there = path_is_folder(path);
        if (!there) tell_lost(plan, path, reason);
        *slash = '/';
        if (!there) return false;
    }
    return true;
}

/* So that nobody waits for a picture that cannot be kept. */
static bool check_writable(const struct report *report, const char *path) {
    if (is_stream(path) || path_is_special(path)) return true;
    const size_t length = path_folder_length(path);
    char *folder = length ? say_text("%.*s", (int)length, path) : say_text(".");
    const bool writable =
        access(folder, W_OK | X_OK) == 0 && (access(path, F_OK) != 0 || access(path, W_OK) == 0);
    if (!writable) report_failure(report, "cannot-write", "cannot write %s: %s", path, strerror(errno));
    free(folder);
    return writable;
}

/* The folder of `path`, up to the first of its parts that is a file; NULL: none is. To be freed. */
static char *file_in_way(const char *path) {
    for (const char *slash = strchr(path, '/'); slash; slash = strchr(slash + 1, '/')) {
        char *part = say_text("%.*s", (int)(slash - path), path);
        if (*part && access(part, F_OK) == 0 && !path_is_folder(part)) return part;
        free(part);
    }
    return NULL;
}

/* A FILE of -o has its folder already. */
static bool check_folder(const struct plan *plan, const char *path) {
    const struct report *report = plan->report;
    const size_t length = path_folder_length(path);
    char *folder = say_text("%.*s", (int)length, path);
    const bool there = length == 0 || access(folder, F_OK) == 0;
    const int reason = errno;
    char *file = there ? NULL : file_in_way(path), *pattern = pattern_of(folder, plan->frames != NULL);
    if (file)
        report_failure(report, "cannot-write", "cannot write %s: %s is a file", path, file);
    else if (!there)
        report_failure(report, "cannot-write", "cannot write %s: %s; -o %s would make the folder", path,
                       strerror(reason), pattern);
    free(pattern);
    free(file);
    free(folder);
    return there;
}

/* Whether folders are made: a FILE of -o asks for none, so that a slip of the pen makes none. */
static bool makes_folders(const struct plan *plan) {
    const char *wanted = plan->wanted;
    return !wanted || ends_in_slash(wanted) || path_is_folder(wanted) ||
           !pattern_is_plain(wanted, plan->frames != NULL);
}

static bool check_passes_writable(const struct plan *plan, const char *picture) {
    bool writable = true;
    for (enum monge_layer layer = 0; layer < MONGE_LAYERS && writable; layer++) {
        char *path = plan->passes >> layer & 1 ? aov_path(layer, picture) : NULL;
        writable = !path || check_writable(plan->report, path);
        free(path);
    }
    return writable;
}

bool plan_reach(struct plan *plan, const char *path) {
    char *copy = say_text("%s", path);
    const bool good = (makes_folders(plan) ? make_folder(plan, copy) : check_folder(plan, path)) &&
                      check_writable(plan->report, path) && check_passes_writable(plan, path);
    free(copy);
    return good;
}

bool plan_is_serial(const struct plan *plan) {
    for (size_t i = 0; i < plan->count; i++)
        if (is_stream(plan->outputs[i].path) || path_is_special(plan->outputs[i].path)) return true;
    return false;
}

/* ---- The plan ---- */

static bool make_output(struct plan *plan, const struct scene_file *scene, size_t combination,
                        struct output *output) {
    *output = (struct output){.scene = scene->path,
                              .name = scene->name,
                              .defines = calloc(plan->sweep->count + 1, sizeof *output->defines)};
    if (!output->defines) return false;
    sweep_combination(plan->sweep, combination, output->defines);
    char *with = sweep_describe(plan->sweep, output->defines);
    output->title = say_text("%s%s%s", scene->path, *with ? " with " : "", with);
    free(with);
    output->path = picture_path(plan, output, 0, 0);
    return true;
}

static bool make_outputs(struct plan *plan) {
    bool good = (plan->outputs = calloc(plan->count + 1, sizeof *plan->outputs)) != NULL;
    for (size_t i = 0; good && i < plan->count; i++)
        good = make_output(plan, &plan->scenes->all[i / plan->sweep->total], i % plan->sweep->total,
                           &plan->outputs[i]);
    if (!good) say_error("out of memory");
    return good;
}

bool plan_begin(struct plan *plan, const struct arguments *args, const struct scenes *scenes,
                const struct sweep *sweep, const struct report *report) {
    const struct option_value *frames = &args->option[OPTION_FRAMES];
    *plan = (struct plan){
        .wanted = args->option[OPTION_OUTPUT].text,
        .stats = args->option[OPTION_STATS].text,
        .log = args->option[OPTION_LOG].text,
        .lock = PTHREAD_MUTEX_INITIALIZER,
        .report = report,
        .sweep = sweep,
        .frames = frames->given ? frames : NULL,
        .passes = args->option[OPTION_AOV].choices,
        .scenes = scenes,
        .count = scenes->count * sweep->total,
    };
    return check_pattern(plan) && check_kinds(plan) && make_outputs(plan) && check_streams(plan) &&
           check_files(plan) && (!plan->stats || check_writable(report, plan->stats));
}

void plan_free(struct plan *plan) {
    for (size_t i = 0; plan->outputs && i < plan->count; i++) {
        free(plan->outputs[i].defines);
        free(plan->outputs[i].title);
        free(plan->outputs[i].path);
    }
    for (size_t i = 0; i < plan->claim_count; i++) free(plan->claims[i].place);
    free(plan->claims);
    free(plan->lost);
    free(plan->outputs);
}

static bool check_paths(struct plan *plan, const struct output *output, char **paths, size_t count) {
    pthread_mutex_lock(&plan->lock);
    const bool room = make_room(plan, count * (1 + MONGE_LAYERS));
    for (size_t i = 0; room && i < count; i++) add_picture_claims(plan, paths[i], output->title);
    const bool good = room && check_claims(plan);
    pthread_mutex_unlock(&plan->lock);
    return good;
}

char **plan_frames(struct plan *plan, const struct output *output, const unsigned *frames, size_t count,
                   unsigned last) {
    char **paths = calloc(count + 1, sizeof *paths);
    if (!paths) say_error("out of memory");
    for (size_t i = 0; paths && i < count; i++) paths[i] = picture_path(plan, output, frames[i], last);
    if (!paths || strcmp(paths[0], output->path) == 0 || check_paths(plan, output, paths, count))
        return paths;
    paths_free(paths, count);
    return NULL;
}

void paths_free(char **paths, size_t count) {
    for (size_t i = 0; paths && i < count; i++) free(paths[i]);
    free(paths);
}
