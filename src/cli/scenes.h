/* From the operands of a command to scenes:
 *
 *     king.yaml       a file; it need not be there: reading it tells
 *     scenes/         a folder: all *.yaml and *.yml below it that are scenes, sorted by name; what is hidden, and
 *                     links to folders, are passed by
 *     'k[1-3]*.yaml'  a pattern that the shell has left alone; `**` in it, as the name of a folder, stands for any
 *                     folders, or none; empty files, pipes and devices are left out, as in folders
 *     @list, @-       a file, or standard input, with one of these a line; # begins a comment. Where it has a NUL,
 *                     what is between NULs is a name as it stands; UTF-16 is refused
 *     -               standard input: a list where each entry is a path, else a scene
 *
 * A scene is called by its file name without .yaml or .yml; with the folders between, as "gallery/chess", from a folder
 * that was asked for, from the fixed beginning of a pattern, and from the folder of --root, which goes before these. */
#ifndef MONGE_CLI_SCENES_H
#define MONGE_CLI_SCENES_H

#include "cli/options.h"
#include "cli/report.h"
#include "monge.h"

struct scene_file {
    char *path; /* owned; "-": the scene on standard input */
    char *name; /* owned; of the scene on standard input "stdin" */
};

struct scenes {
    struct scene_file
        *all; /* in the order of the operands; a file that would have the same name twice, once */
    size_t count;
    struct monge_text input; /* the scene on standard input; without bytes where there is none */
    enum status status;      /* STATUS_TROUBLE: some operand stands for nothing; the reason has been told */
    char **lists;            /* owned: the files that lists of scenes were read from, */
    size_t list_count;       /* so many */
    char **lost;             /* owned: such operands, lines of lists and folders, */
    size_t missing;          /* so many */
    bool several;            /* some operand may stand for several: a folder, a pattern, a list */
};

/* What is taken of the files below folders. */
enum scenes_wish { SCENES_ALONE, SCENES_AND_DEFINITIONS };

/* Finds them all, with what is wrong told to the report, to stderr where it is not about files. limits may be
 * NULL. To be freed. False, with the reason told and nothing read, when standard input is to be read twice. */
bool scenes_find(struct scenes *scenes, const struct arguments *args, enum scenes_wish wish,
                 const struct monge_limits *limits, struct report *report);
void scenes_free(struct scenes *scenes);

#endif
