/* Paths of files and folders. */
#ifndef MONGE_CLI_PATHS_H
#define MONGE_CLI_PATHS_H

#include <stdbool.h>
#include <stddef.h>

#include "cli/commands.h"

/* FOLDER/NAME and the extension, ".png". To be freed. */
char *path_below(const char *folder, const char *name, const char *extension);

bool path_is_file(const char *path);   /* a regular one, perhaps by a link */
bool path_is_folder(const char *path); /* the same */
bool path_is_link(const char *path);
bool path_is_special(
    const char *path); /* a pipe or a device: may be written more than once, and is not replaced */

/* Whether both lead to one file or folder, which is there. */
bool path_is_same(const char *a, const char *b);

/* Bytes of the path up to its last slash, that included. */
size_t path_folder_length(const char *path);

/* Whether the file that an option names, perhaps by a pattern, may be a picture: it ends in .png, in any case. False, with
 * the reason told, where it ends otherwise: that would fool whoever looks for it, or write over what is none. */
bool path_check_picture(enum command_id command, const char *option, const char *path);

/* The extension of what is called as scenes, includes and pictures are: .yaml, .yml, .png, in any case. NULL: it is not. */
const char *path_input_extension(const char *path);

/* Makes the folders that the file `path` needs. False, with the reason told. */
bool path_make_folders(const char *path);

#endif
