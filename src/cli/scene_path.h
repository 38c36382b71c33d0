/* Paths of scenes: what they are called, and what is there. */
#ifndef MONGE_CLI_SCENE_PATH_H
#define MONGE_CLI_SCENE_PATH_H

#include "monge.h"

/* Where .yaml or .yml begins at the end of the path, in letters of any case; NULL: it ends otherwise. */
const char *scene_extension(const char *path);

/* The path without its extension, as "gallery/chess". To be freed. */
char *scene_name(const char *path);

/* The path from the root of the machine, its folders without links and dots. NULL: its folder is not there. To be freed. */
char *scene_place(const char *path);

/* The name from `root`, which is such a path; NULL: the file is not below it. Where its folder is not there, `otherwise`. To
 * be freed. */
char *scene_name_below(const char *root, const char *path, const char *otherwise);

/* What the file is; of one that cannot be read, MONGE_TEXT_SCENE: so that its reading is what tells. limits may be NULL. */
enum monge_text_kind scene_kind(const char *path, const struct monge_limits *limits);

/* A folder that was looked into, so that the next scene in it costs nothing; {0}: none yet. */
struct scene_folder {
    char *path;   /* owned; its end is a slash */
    char **names; /* owned: sorted; NULL: it is not there, or */
    bool unknown; /* cannot be read */
    size_t count;
};
void scene_folder_free(struct scene_folder *folder);

/* Whether there is a scene of that path without its extension; true as well where that cannot be known. *last is the folder
 * that was looked into last. limits may be NULL. */
bool scene_is_there(const char *path, struct scene_folder *last, const struct monge_limits *limits);

#endif
