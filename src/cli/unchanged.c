#include "cli/unchanged.h"

#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/aov.h"
#include "cli/paths.h"

/* What the picture says under a key, "" where that is nothing. */
static const char *said(const struct monge_picture *picture, const char *key) {
    const char *text = monge_picture_text(picture, key);
    return text ? text : "";
}

/* What of the program, the way and the files it would be made by is another. */
static const char *find_difference(const struct monge_picture *picture, const char *scene,
                                   const char *options, const struct monge_limits *limits,
                                   struct monge_diagnostics *diag) {
    char now[MONGE_HASH_SIZE];
    if (!monge_picture_text(picture, "monge:program")) return "it does not say what it was made of";
    if (strcmp(said(picture, "monge:program"), monge_program()) != 0) return "the program differs";
    if (strcmp(said(picture, "monge:options"), options) != 0) return "its options differ";
    const bool same = monge_files_hash(scene, said(picture, "monge:files"), limits, diag, now) &&
                      strcmp(said(picture, "monge:text"), now) == 0;
    return same ? NULL : "its text differs";
}

/* Whether its pixels are still those that were written. */
static bool is_whole(struct monge_picture *picture, struct monge_diagnostics *diag) {
    char now[MONGE_HASH_SIZE];
    return monge_picture_hash(picture, diag, now) && strcmp(said(picture, "monge:pixels"), now) == 0;
}

static void take_hash(const struct monge_picture *file, const char *key, char hash[MONGE_HASH_SIZE]) {
    snprintf(hash, MONGE_HASH_SIZE, "%s", said(file, key));
}

/* What the file says of itself. */
static void take_texts(const struct monge_picture *file, struct picture *picture) {
    picture->region.width = monge_picture_width(file);
    picture->region.height = monge_picture_height(file);
    take_hash(file, "monge:scene", picture->scene_hash);
    take_hash(file, "monge:pixels", picture->pixel_hash);
}

const char *unchanged_reason(struct picture *picture, const char *options, unsigned passes,
                             const struct monge_limits *limits) {
    const char *path = picture->output, *scene = picture->scene;
    if (!path_is_file(scene)) return "its scene is no file";
    if (!path_is_file(path)) return access(path, F_OK) != 0 ? "it is not there" : "it is no file";
    struct monge_diagnostics *diag = monge_diagnostics_new(); /* what is in it is not wrong, but new */
    struct monge_picture *file = diag ? monge_picture_read(path, diag) : NULL;
    const char *reason = file ? find_difference(file, scene, options, limits, diag) : "it is damaged";
    if (!reason && !is_whole(file, diag)) reason = "it is damaged";
    if (!reason && !aov_unchanged(file, passes, path)) reason = "its passes are not all whole";
    if (!reason) take_texts(file, picture);
    monge_picture_free(file);
    monge_diagnostics_free(diag);
    return reason;
}
