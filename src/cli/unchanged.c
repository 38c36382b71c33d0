#include "cli/unchanged.h"

#include <string.h>
#include <sys/stat.h>

#include "cli/aov.h"

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

bool unchanged_picture(const char *path, const char *scene, const char *options, unsigned passes,
                       const struct monge_limits *limits) {
    if (!is_file(path) || !is_file(scene)) return false;
    struct monge_diagnostics *diag = monge_diagnostics_new(); /* what is in it is not wrong, but new */
    struct monge_picture *picture = diag ? monge_picture_read(path, diag) : NULL;
    const bool same = picture && is_asked_for(picture, scene, options, limits, diag) &&
                      is_whole(picture, diag) && aov_unchanged(picture, passes, path);
    monge_picture_free(picture);
    monge_diagnostics_free(diag);
    return same;
}
