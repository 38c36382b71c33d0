/* A run of `monge test`: what its parts share, from one thread or many. */
#ifndef MONGE_CLI_GOLDEN_RUN_H
#define MONGE_CLI_GOLDEN_RUN_H

#include "cli/golden/lock.h"
#include "cli/golden/results.h"
#include "cli/golden/settings.h"
#include "cli/progress.h"

/* A scene, on one thread at a time. */
struct golden_scene {
    const char *path;
    char *name; /* owned */
    struct golden_rule *rule;
    struct golden_case *cases; /* owned */
    size_t count;
    bool done; /* no signal has come before its last case was judged */
    struct progress_unit progress;
};

struct golden_run {
    const char *folder, *output; /* of the goldens; of what the run leaves */
    const char *old_program;     /* --old; NULL: none */
    bool changed_only;           /* --changed */
    unsigned threads, jobs;      /* for each picture, and pictures at once */
    struct loader loader;
    struct golden_settings settings;
    struct golden_lock lock;
    struct golden_results last; /* the run before; empty where there was none */
    struct golden_scene *scenes;
    size_t count;
    struct progress progress;
};

/* Renders the pictures of a scene, and judges them: its cases. One that a signal has cut short is none, and leaves nothing
 * behind. */
void golden_scene_run(struct golden_run *run, struct golden_scene *scene);

/* The scene that is meant by the name of its golden in place of a path: one that is there, below the root or, without a root,
 * of the run before. To be freed; NULL: none. */
char *golden_find_meant(const struct golden_run *run, const char *name);

/* Whether goldens of this kind have pixels, so that a difference can be within a tolerance: hashes have with --old alone. */
bool golden_knows_tolerance(const struct golden_run *run, enum monge_golden_kind kind);

/* What the golden of a case is, before its picture is rendered: c->old, c->golden_path, c->golden_file; and, where
 * there is none or half of it, the status. False: there is nothing to compare with. */
bool golden_find(const struct golden_run *run, struct golden_case *c);

/* Whether the picture need not be rendered, with --changed. */
bool golden_is_unchanged(const struct golden_run *run, const struct golden_case *c);

/* Judges a picture that is rendered against the golden that golden_find has found, if it has. The picture stays in the
 * run's folder unless it is the same. */
void golden_judge(const struct golden_run *run, struct golden_case *c, const struct monge_film *film,
                  bool has_golden);

/* Whether there is a program that --old may mean. False: told. */
bool golden_check_old(const char *program);

/* The golden's picture where it is a hash, by the program of --old, in the run's folder. False: it is another one, or
 * there is none; the message of the case tells. */
bool golden_render_old(const struct golden_run *run, struct golden_case *c);

/* c->old_command, which makes the golden's picture of the commit that brought its line, where one is known that can. */
void golden_set_old_command(const struct golden_run *run, struct golden_case *c);

/* Writes the passes of the scene, as it is now, beside the case's new picture, their hashes into c->now; and tells what
 * has changed since the golden, where that has passes too, or hashes of them. What goes wrong is a message. */
void golden_judge_layers(const struct golden_run *run, struct monge_scene *scene,
                         const struct monge_settings *settings, const struct monge_region *region,
                         struct golden_case *c);

/* What the case says beside its message. */
void golden_add_message(struct golden_case *c, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
