#include "cli/diff_folders.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "cli/batch.h"
#include "cli/paths.h"
#include "cli/say.h"

enum side { SIDE_A, SIDE_B, SIDES };

/* What becomes of a name; the first ones are verdicts. */
enum outcome { ONLY_IN_A = DIFF_DIFFERENT + 1, ONLY_IN_B, TROUBLE, OUTCOMES };

struct names {
    char **all;
    size_t count;
};

/* A name that one folder has, or both. */
struct entry {
    const char *name;
    bool in[SIDES];
    unsigned outcome;
    char *told; /* owned: for standard output */
    size_t size;
};

struct folders {
    const struct diff *diff;
    const char *folder[SIDES];
    struct names names[SIDES]; /* sorted */
    struct entry *entries;     /* by name */
    size_t count, told;
    size_t outcomes[OUTCOMES];
    unsigned threads; /* for each picture; 0: one for each processor */
    bool unread;      /* a folder */
};

char *diff_path(const char *folder, const char *name) { return path_below(folder, name, ""); }

/* ---- What is there ---- */

static void add_name(struct names *names, const char *name) {
    names->all = realloc(names->all, (names->count + 1) * sizeof *names->all);
    if (!names->all) say_no_memory();
    names->all[names->count++] = say_text("%s", name);
}

static bool is_picture(const char *name) {
    const size_t length = strlen(name);
    return length > 4 && strcasecmp(name + length - 4, ".png") == 0;
}

static void walk(struct folders *folders, enum side side, const char *below);

/* Something in a folder. A link that leads nowhere is a picture that cannot be read. */
static void walk_entry(struct folders *folders, enum side side, const char *name) {
    struct stat link, status;
    char *path = diff_path(folders->folder[side], name), *inner = say_text("%s/", name);
    const bool there = lstat(path, &link) == 0, leads = there && stat(path, &status) == 0;
    if (there && S_ISDIR(link.st_mode))
        walk(folders, side, inner);
    else if (there && is_picture(name) && (!leads || S_ISREG(status.st_mode)))
        add_name(&folders->names[side], name);
    free(inner);
    free(path);
}

/* All PNG files of a folder, but for the hidden; `below` is "" or ends in a slash. */
static void walk(struct folders *folders, enum side side, const char *below) {
    char *path = diff_path(folders->folder[side], below);
    DIR *stream = opendir(path);
    if (!stream) say_error("cannot read %s: %s", path, strerror(errno));
    folders->unread |= !stream;
    for (struct dirent *file; stream && (file = readdir(stream));) {
        char *name = say_text("%s%s", below, file->d_name);
        if (file->d_name[0] != '.') walk_entry(folders, side, name);
        free(name);
    }
    if (stream) closedir(stream);
    free(path);
}

static int compare_names(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* From the sorted names of both. */
static void merge(struct folders *folders) {
    const struct names *a = &folders->names[SIDE_A], *b = &folders->names[SIDE_B];
    folders->entries = calloc(a->count + b->count + 1, sizeof *folders->entries);
    if (!folders->entries) say_no_memory();
    for (size_t i = 0, k = 0; i < a->count || k < b->count;) {
        const int order = i == a->count ? 1 : k == b->count ? -1 : strcmp(a->all[i], b->all[k]);
        struct entry *entry = &folders->entries[folders->count++];
        entry->in[SIDE_A] = order <= 0;
        entry->in[SIDE_B] = order >= 0;
        entry->name = order <= 0 ? a->all[i] : b->all[k];
        i += order <= 0;
        k += order >= 0;
    }
}

static void find(struct folders *folders) {
    for (enum side side = SIDE_A; side < SIDES; side++) {
        struct names *names = &folders->names[side];
        walk(folders, side, "");
        if (names->count > 0) qsort(names->all, names->count, sizeof *names->all, compare_names);
    }
    merge(folders);
}

/* ---- One name ---- */

/* Control characters, which names may have, are made harmless. */
static void print_name(const char *name, FILE *out) {
    for (; *name; name++) fputc((unsigned char)*name < 0x20 || *name == 0x7f ? '?' : *name, out);
}

/* Of a name without two pictures to compare. */
static void tell_none(const struct folders *folders, const struct entry *entry, FILE *out) {
    const bool missing = entry->outcome != TROUBLE;
    if (folders->diff->args->option[OPTION_DIFF_JSON].given) {
        char *path[SIDES] = {NULL};
        for (enum side side = SIDE_A; side < SIDES; side++)
            if (entry->in[side]) path[side] = diff_path(folders->folder[side], entry->name);
        diff_print_json_none(entry->name, missing ? "missing" : "trouble", path[SIDE_A], path[SIDE_B], out);
        for (enum side side = SIDE_A; side < SIDES; side++) free(path[side]);
    } else if (missing) {
        fputs("only in ", out);
        print_name(folders->folder[entry->outcome == ONLY_IN_A ? SIDE_A : SIDE_B], out);
        fputs(": ", out);
        print_name(entry->name, out);
        fputc('\n', out);
    }
}

static void tell_pair(const struct diff_pair *pair, const struct entry *entry, FILE *out) {
    if (pair->diff->args->option[OPTION_DIFF_JSON].given) {
        diff_pair_print_json(pair, entry->name, out);
    } else if (pair->verdict == DIFF_DIFFERENT) {
        fprintf(out, "%s  ", DIFF_VERDICT[pair->verdict]);
        print_name(entry->name, out);
        fputs(": ", out);
        diff_pair_print(pair, "           ", out);
    }
}

/* Of pictures that are not the same, where they can be laid over each other. */
static bool write_heat_map(const struct diff_pair *pair, const struct entry *entry,
                           struct monge_diagnostics *diag) {
    const char *folder = pair->diff->args->option[OPTION_HEAT_MAP].text;
    if (!folder || pair->verdict == DIFF_SAME || pair->difference.unlike == MONGE_UNLIKE_SIZE) return true;
    char *path = diff_path(folder, entry->name);
    const bool written = path_make_folders(path) && diff_pair_write_heat_map(pair, path, diag);
    free(path);
    return written;
}

static void compare(const struct folders *folders, struct entry *entry, FILE *out) {
    struct diff_pair pair;
    struct diff diff = *folders->diff;
    struct monge_diagnostics *diag = monge_diagnostics_new();
    char *a = diff_path(folders->folder[SIDE_A], entry->name),
         *b = diff_path(folders->folder[SIDE_B], entry->name);
    if (!diag) say_no_memory();
    diff.how.threads = folders->threads;
    const bool compared = diff_pair_compare(&pair, &diff, a, b, diag);
    entry->outcome = compared ? pair.verdict : TROUBLE;
    compared ? tell_pair(&pair, entry, out) : tell_none(folders, entry, out);
    if (compared && !write_heat_map(&pair, entry, diag)) entry->outcome = TROUBLE;
    monge_diagnostics_print(diag, say_stream());
    monge_diagnostics_free(diag);
    diff_pair_free(&pair);
    free(a);
    free(b);
}

/* ---- All of them ---- */

static bool run_entry(void *context, size_t index) {
    const struct folders *folders = context;
    struct entry *entry = &folders->entries[index];
    FILE *out = say_text_begin(&entry->told, &entry->size);
    entry->outcome = entry->in[SIDE_A] ? ONLY_IN_A : ONLY_IN_B;
    if (entry->in[SIDE_A] && entry->in[SIDE_B])
        compare(folders, entry, out);
    else
        tell_none(folders, entry, out);
    say_text_end(out);
    return true;
}

static void end_entry(void *context, size_t index, const char *said) {
    struct folders *folders = context;
    const struct option_value *option = folders->diff->args->option;
    struct entry *entry = &folders->entries[index];
    folders->outcomes[entry->outcome]++;
    if (*said) streams_flush();
    fputs(said, stderr);
    if (option[OPTION_DIFF_JSON].given && folders->told++ > 0) fputs(",\n", stdout);
    if (option[OPTION_DIFF_JSON].given || !option[OPTION_QUIET].given) fputs(entry->told, stdout);
    free(entry->told);
    entry->told = NULL;
}

static void summarize(const struct folders *folders) {
    const char *const words[] = {DIFF_VERDICT[0], DIFF_VERDICT[1], DIFF_VERDICT[2],
                                 "only in ",      "only in ",      "cannot be used"};
    const char *before = ": ";
    printf("%zu picture%s", folders->count, folders->count == 1 ? "" : "s");
    for (unsigned o = 0; o < OUTCOMES; o++) {
        if (folders->outcomes[o] == 0) continue;
        printf("%s%zu %s", before, folders->outcomes[o], words[o]);
        if (o == ONLY_IN_A || o == ONLY_IN_B) print_name(folders->folder[o - ONLY_IN_A], stdout);
        before = ", ";
    }
    putchar('\n');
}

/* As many at once as there are processors, which they share. */
static void compare_all(struct folders *folders) {
    const struct option_value *option = folders->diff->args->option;
    const unsigned processors = monge_processors();
    const unsigned jobs = folders->count < processors ? (unsigned)folders->count : processors;
    const struct batch batch = {.count = folders->count,
                                .jobs = jobs,
                                .held = jobs > 1,
                                .context = folders,
                                .run = run_entry,
                                .ended = end_entry};
    folders->threads = option[OPTION_THREADS].given ? option[OPTION_THREADS].number[0] : processors / jobs;
    if (option[OPTION_HEAT_MAP].given) streams_outlive_readers();
    if (option[OPTION_DIFF_JSON].given) puts("[");
    batch_run(&batch);
    if (option[OPTION_DIFF_JSON].given)
        puts("\n]");
    else if (!option[OPTION_QUIET].given)
        summarize(folders);
}

/* ---- Where heat maps go ---- */

/* Whether what is in a folder is found below another one: it is that folder or below it, and nothing between is hidden. */
static bool is_found_below(const char *inner, const char *outer) {
    char *in = realpath(inner, NULL), *out = realpath(outer, NULL);
    const size_t length = out ? strlen(out) - (out[strlen(out) - 1] == '/') : 0;
    const bool within = in && out && strncmp(in, out, length) == 0 && (!in[length] || in[length] == '/');
    const bool found = within && !strstr(in + length, "/.");
    free(in);
    free(out);
    return found;
}

/* Whether the file would be among the pictures of the folder, the next time. The folders that it needs are perhaps not
 * all there: its last one that is there decides. */
static bool would_be_among(const char *path, const char *folder) {
    char *at = say_text("%s", path), *slash;
    while ((slash = strrchr(at, '/')) && slash > at) {
        *slash = '\0';
        if (path_is_folder(at)) break;
    }
    const bool among = is_found_below(slash == at ? "/" : slash ? at : ".", folder);
    free(at);
    return among;
}

/* Where the heat map of a name goes, it must not take the place of a picture, nor be compared the next time. */
static bool check_heat_map(const struct folders *folders, const struct entry *entry) {
    const char *out = folders->diff->args->option[OPTION_HEAT_MAP].text;
    char *path = diff_path(out, entry->name);
    char *pictures[SIDES], *lost = NULL;
    for (enum side side = SIDE_A; side < SIDES; side++) {
        const char *folder = folders->folder[side];
        pictures[side] = diff_path(folder, entry->name);
        if (!lost && would_be_among(path, folder)) lost = say_text("be among the pictures of %s", folder);
    }
    const char *over = diff_overwritten(folders->diff, path, pictures[SIDE_A], pictures[SIDE_B]);
    if (!lost && over) lost = say_text("write over %s", over);
    if (lost) say_usage(COMMAND_DIFF, "--out %s: the heat map %s would %s", out, path, lost);
    for (enum side side = SIDE_A; side < SIDES; side++) free(pictures[side]);
    const bool good = !lost;
    free(lost);
    free(path);
    return good;
}

/* All that there may be are looked at before the first is written. */
static bool check_heat_maps(const struct folders *folders) {
    const char *out = folders->diff->args->option[OPTION_HEAT_MAP].text;
    if (!out) return true;
    char *inside = diff_path(out, "");
    bool good = path_make_folders(inside);
    free(inside);
    for (size_t i = 0; good && i < folders->count; i++) {
        const struct entry *entry = &folders->entries[i];
        if (entry->in[SIDE_A] && entry->in[SIDE_B]) good = check_heat_map(folders, entry);
    }
    return good;
}

static bool check_stream(const struct diff *diff) {
    const char *out = diff->args->option[OPTION_HEAT_MAP].text;
    if (!out || strcmp(out, "-") != 0) return true;
    say_usage(COMMAND_DIFF, "--out -: the heat maps of folders need a folder");
    return false;
}

/* ---- The command ---- */

static enum status find_status(const struct folders *folders) {
    const size_t *n = folders->outcomes;
    if (n[TROUBLE] > 0 || folders->unread || folders->count == 0) return STATUS_TROUBLE;
    return n[DIFF_DIFFERENT] + n[ONLY_IN_A] + n[ONLY_IN_B] > 0 ? STATUS_NO : STATUS_YES;
}

static void folders_free(struct folders *folders) {
    for (enum side side = SIDE_A; side < SIDES; side++) {
        for (size_t i = 0; i < folders->names[side].count; i++) free(folders->names[side].all[i]);
        free(folders->names[side].all);
    }
    free(folders->entries);
}

enum status diff_folders(const struct diff *diff) {
    char *const *operands = diff->args->operands;
    struct folders folders = {.diff = diff, .folder = {operands[0], operands[1]}};
    if (!check_stream(diff)) return STATUS_TROUBLE;
    find(&folders);
    const bool good = check_heat_maps(&folders);
    if (good && folders.count == 0)
        say_error("there is no PNG file below %s or %s", operands[0], operands[1]);
    else if (good)
        compare_all(&folders);
    folders_free(&folders);
    return good ? find_status(&folders) : STATUS_TROUBLE;
}
