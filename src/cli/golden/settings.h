/* How scenes are tested: DIR/golden.yaml. */
#ifndef MONGE_CLI_GOLDEN_SETTINGS_H
#define MONGE_CLI_GOLDEN_SETTINGS_H

#include "cli/golden/golden.h"
#include "cli/load.h"

/* A rule, with its options as `monge render` has them. */
struct golden_rule {
    const struct monge_golden_rule *rule;
    char *text, **words; /* owned: its options, and the words of them */
    struct arguments args;
    struct loader loader; /* of its -D, and of the limits of the command */
};

struct golden_settings {
    char *path, *root;              /* owned; root: NULL where there is none, else without links or dots */
    bool other_root;                /* it is not that of the file, which has one */
    struct monge_goldens *file;     /* NULL: there is none */
    struct monge_golden_rule other; /* where no rule matches */
    struct golden_rule *rules;      /* of the file, and `other` last */
    size_t count;
};

/* Reads FOLDER/golden.yaml, where it is there. kind: of all goldens, whatever it says; NULL: as it says. root: the option,
 * with which scenes_find was called, and which goes before its `root` if it is given; may be NULL. False, with the reason told.
 * Either way to be freed. */
bool golden_settings_read(struct golden_settings *settings, const char *folder,
                          const enum monge_golden_kind *kind, const struct option_value *root,
                          const struct loader *loader);
void golden_settings_free(struct golden_settings *settings);

/* The root as one would name it from here, where it is below; NULL: there is none. To be freed. */
char *golden_settings_root(const struct golden_settings *settings);

/* The rule for a scene, by its name. */
struct golden_rule *golden_settings_find(const struct golden_settings *settings, const char *name);

/* The name of a scene: from the root, where there is one; NULL: it is not below that. To be freed. */
char *golden_settings_name(const struct golden_settings *settings, const struct scene_file *scene);

#endif
