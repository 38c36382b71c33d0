/* monge diff of two folders: all PNG files below both, by their names.
 *
 *     different  sub/x.png: 124 of 345600 pixels (0.0359 %), largest difference 0.2157 at 212,80
 *     only in old/: y.png
 *     12 pictures: 10 same, 1 different, 1 only in old/ */
#ifndef MONGE_CLI_DIFF_FOLDERS_H
#define MONGE_CLI_DIFF_FOLDERS_H

#include "cli/diff_pair.h"

char *diff_path(const char *folder, const char *name); /* to be freed */

/* Compares the two operands; the mask of `diff` is decoded. */
enum status diff_folders(const struct diff *diff);

#endif
