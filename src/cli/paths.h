/* Paths of files and folders. */
#ifndef MONGE_CLI_PATHS_H
#define MONGE_CLI_PATHS_H

#include <stdbool.h>

/* FOLDER/NAME and the extension, ".png". To be freed. */
char *path_below(const char *folder, const char *name, const char *extension);

bool path_is_file(const char *path);   /* a regular one, perhaps by a link */
bool path_is_folder(const char *path); /* the same */
bool path_is_link(const char *path);

/* Makes the folders that the file `path` needs. False, with the reason told. */
bool path_make_folders(const char *path);

#endif
