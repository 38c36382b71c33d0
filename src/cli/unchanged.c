#include "cli/unchanged.h"

#include <string.h>
#include <sys/stat.h>

static bool is_file(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 && S_ISREG(status.st_mode);
}

/* What the picture says under a key, "" where that is nothing. */
static const char *said(const struct monge_picture *picture, const char *key) {
    const char *text = monge_picture_text(picture, key);
    return text ? text : "";
}

/* Whether it would be made of the same files, by the same program, in the same way. */
static bool is_asked_for(const struct monge_picture *picture, const char *scene, const char *options,
                         const struct monge_limits *limits, struct monge_diagnostics *diag) {
    char now[MONGE_HASH_SIZE];
    return strcmp(said(picture, "monge:program"), monge_program()) == 0 &&
           strcmp(said(picture, "monge:options"), options) == 0 &&
           monge_files_hash(scene, said(picture, "monge:files"), limits, diag, now) &&
           strcmp(said(picture, "monge:text"), now) == 0;
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

bool unchanged_picture(struct picture *picture, const char *options, const struct monge_limits *limits) {
    if (!is_file(picture->output) || !is_file(picture->scene)) return false;
    struct monge_diagnostics *diag = monge_diagnostics_new(); /* what is in it is not wrong, but new */
    struct monge_picture *file = diag ? monge_picture_read(picture->output, diag) : NULL;
    const bool same =
        file && is_asked_for(file, picture->scene, options, limits, diag) && is_whole(file, diag);
    if (same) take_texts(file, picture);
    monge_picture_free(file);
    monge_diagnostics_free(diag);
    return same;
}
