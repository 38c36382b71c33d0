/* --old: the picture of a golden that is a hash, by the program that made it. */
#include <errno.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/golden_folder.h"
#include "cli/golden_run.h"
#include "cli/interrupt.h"
#include "cli/say.h"

/* Whether the command, a shell's, ends well. */
static bool run_command(char *command) {
    char *words[] = {"sh", "-c", command, NULL};
    pid_t child;
    int status;
    if (posix_spawn(&child, "/bin/sh", NULL, NULL, words, environ) != 0) return false;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) return false;
        kill(child, SIGTERM);
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/* An old program may not know passes. */
static bool render(const char *program, const struct golden_case *c, const char *path, bool passes) {
    char *quoted_program = golden_quoted(program), *quoted_path = golden_quoted(path);
    char *command =
        say_text("exec %s render %s -o %s --quiet%s </dev/null >/dev/null 2>&1", quoted_program, c->arguments,
                 quoted_path, passes ? " --aov object,material,depth,normal,shadow" : "");
    const bool good = run_command(command);
    free(command);
    free(quoted_path);
    free(quoted_program);
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
    char *folder = golden_path(run->output, "old", ""), *path = golden_path(folder, c->name, ".png");
    const bool made = golden_make_folders(path) && render(run->old_program, c, path, c->aov),
               same = made && is_golden(c, path);
    if (!made)
        golden_add_message(c, "%s makes no picture of it", run->old_program);
    else if (!same)
        golden_add_message(c, "%s makes another picture of it than the golden, as the scene is now",
                           run->old_program);
    if (same)
        c->golden_path = path;
    else
        unlink(path); /* not its folder, which others may be about to write into */
    if (!same) free(path);
    free(folder);
    return same;
}
