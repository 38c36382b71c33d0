/* Folders of goldens and of runs: names of goldens as paths, and the pictures that are there. */
#ifndef MONGE_CLI_GOLDEN_FOLDER_H
#define MONGE_CLI_GOLDEN_FOLDER_H

#include "cli/golden/golden.h"

/* Whether a name can be a path below a folder, and of nothing else: "gallery/chess", not "../x" or "/x". */
bool golden_name_is_safe(const char *name);

bool golden_is_there(const char *path); /* whatever it is: a folder, a link that leads nowhere */

/* The same as path_is_file of what is there: a pipe or a device would be read without end. False: told. */
bool golden_check_file(const char *path);

/* What --golden is given must be a folder, as soon as it is there. False: told. */
bool golden_check_folder(const char *folder);

/* Whether a folder can be there, of which this option says where: no file is, nor on the way. False: told. */
bool golden_check_output(const char *option, const char *path);

/* Waits until no other process holds the folder, up to the end of this one: of two that read, change and write its lock the
 * later would undo what the earlier has done. Where there is no such folder, or no such thing as a lock, it goes on. */
void golden_hold(const char *folder);

/* The path from the root, without links and dots; of what is not there (yet), too. To be freed. */
char *golden_real_path(const char *path);

/* The file, complete or not at all, in folders that are made. False, with the reason told. */
bool golden_write(const char *path, const struct monge_text *text);

/* The same of goldens, which are left alone where they have these bytes already. */
bool golden_update(const char *path, const struct monge_text *text);
bool golden_copy(const char *from, const char *to);

/* Whether a path below the folder stays there: false, with the reason told, where a part of it is a symbolic link. */
bool golden_check_inside(const char *folder, const char *path);

/* Removes a file, and those folders above it up to `folder` that have become empty; NULL: none, where others may be about to
 * write into them. False, with the reason told; one that is not there is no trouble. */
bool golden_remove(const char *folder, const char *path);

/* Whether the picture, there or not, has passes beside it: by its depth, as that is no picture and so no golden of its own. */
bool golden_has_passes(const char *picture);

/* The same as golden_remove of a picture and of the layers beside it. */
bool golden_remove_picture(const char *folder, const char *path);

/* Removes what a run has left of a case in its folder: the new picture and the old one, with their passes. */
bool golden_clear(const char *output, const char *name);

/* The names of all pictures below a folder but for layers of others, sorted, up to a NULL; a folder that is not
 * there has none. To be freed, with its texts. */
char **golden_names(const char *folder);
void golden_names_free(char **names);

#endif
