/* The picture of a golden that is a hash: by --old, the program that made it, or by a command that takes the scene of then. */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/golden/folder.h"
#include "cli/golden/run.h"
#include "cli/golden/settings.h"
#include "cli/interrupt.h"
#include "cli/paths.h"
#include "cli/pattern.h"
#include "cli/say.h"
#include "cli/words.h"

/* ---- --old ---- */

/* Waits for the child; a signal ends that too. */
static bool ends_well(pid_t child) {
    int status;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) return false;
        kill(child, SIGTERM);
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool golden_check_old(const char *program) {
    char *words[] = {(char *)program, "--version", NULL};
    posix_spawn_file_actions_t quiet;
    pid_t child;
    posix_spawn_file_actions_init(&quiet);
    posix_spawn_file_actions_addopen(&quiet, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const int why = posix_spawnp(&child, program, &quiet, NULL, words, environ);
    posix_spawn_file_actions_destroy(&quiet);
    if (why == 0) {
        ends_well(child); /* or not: what it says of itself does not matter */
        return true;
    }
    const bool sought = why == ENOENT && !strchr(program, '/');
    say_error("--old %s: %s", program, sought ? "there is no such program in the PATH" : strerror(why));
    return false;
}

/* A command of a shell. */
static bool run_command(char *command) {
    char *words[] = {"sh", "-c", command, NULL};
    pid_t child;
    return posix_spawn(&child, "/bin/sh", NULL, NULL, words, environ) == 0 && ends_well(child);
}

/* An old program may not know passes. */
static bool render(const char *program, const struct golden_case *c, const char *path, bool passes) {
    char *pattern = pattern_of(path, c->has_frames);
    char *quoted_program = word_quoted(program), *quoted_path = word_quoted(pattern);
    char *command =
        say_text("exec %s render %s -o %s --quiet%s </dev/null >/dev/null 2>&1", quoted_program, c->arguments,
                 quoted_path, passes ? " --aov object,material,depth,normal,shadow" : "");
    const bool good = run_command(command);
    free(command);
    free(quoted_path);
    free(quoted_program);
    free(pattern);
    return good || (passes && !interrupt_pending() && render(program, c, path, false));
}

/* Whether the picture is the one that the golden is the hash of. */
static bool is_golden(const struct golden_case *c, const char *path) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_picture *picture = diag ? monge_picture_read(path, diag) : NULL;
    const char *pixels = picture ? monge_picture_text(picture, "monge:pixels") : NULL;
    const bool same = pixels && strcmp(pixels, c->old.pixels) == 0;
    monge_picture_free(picture);
    monge_diagnostics_free(diag);
    return same;
}

bool golden_render_old(const struct golden_run *run, struct golden_case *c) {
    char *folder = path_below(run->output, "old", ""), *path = path_below(folder, c->name, ".png");
    const bool made = path_make_folders(path) && render(run->old_program, c, path, c->aov),
               same = made && is_golden(c, path);
    if (!made)
        golden_add_message(c, "%s makes no picture of it", run->old_program);
    else if (!same)
        golden_add_message(c,
                           "%s does not make the golden's picture of it: the scene has changed, or that is "
                           "not the program of then",
                           run->old_program);
    if (same)
        c->golden_path = path;
    else
        golden_remove(NULL, path);
    if (!same) free(path);
    free(folder);
    return same;
}

/* ---- The command ---- */

/* Options as asked_text prints them, each with a blank before it. They may come from anybody, by way of the golden: each
 * of their words is quoted anew. */
static char *quoted_options(const char *options) {
    char *all = say_text("%s", ""), *copy = say_text("%s", options), *at = copy;
    bool open = false;
    for (char *word; (word = word_next(&at, &open));) {
        char *quoted = word_quoted(word), *longer = say_text("%s %s", all, quoted);
        free(all);
        free(quoted);
        all = longer;
    }
    free(copy);
    return all;
}

/* Whether a commit can give another picture than there is now: it has the line, and the scene or its options were others.
 * Texts are words for a shell. */
static bool is_in_history(const struct golden_case *c, const char *line, const char *lock,
                          const char *scene) {
    const struct monge_causes causes = golden_causes(c);
    if (causes.text == MONGE_SAME && causes.options == MONGE_SAME) return false;
    char *command = say_text("exec </dev/null >/dev/null 2>&1; git grep -qF -e %s HEAD -- %s && "
                             "git ls-files --error-unmatch -- %s",
                             line, lock, scene);
    const bool there = run_command(command);
    free(command);
    return there;
}

void golden_set_old_command(const struct golden_run *run, struct golden_case *c) {
    char *options = quoted_options(c->old.options ? c->old.options : "");
    char *line = golden_lock_line(c->name, &c->old), *quoted_line = word_quoted(line);
    char *lock = word_quoted(run->lock.path), *scene = word_quoted(c->scene);
    if (is_in_history(c, quoted_line, lock, scene))
        c->old_command = say_text(
            "old=$(mktemp -d) && git worktree add \"$old\" \"$(git log -1 --format=%%h -S %s -- %s)\" && "
            "monge render \"$old/$(git ls-files --full-name %s)\"%s -o old.png; "
            "git worktree remove --force \"$old\"",
            quoted_line, lock, scene, options);
    free(options);
    free(scene);
    free(lock);
    free(quoted_line);
    free(line);
    if (!run->old_program && golden_causes(c).program == MONGE_DIFFERENT)
        golden_add_message(
            c,
            "the golden is of another program (sources %.12s): `--old PROGRAM` shows it, where you have that",
            c->old.program);
}
