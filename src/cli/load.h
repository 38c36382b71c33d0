/* Loading scenes by the options that all commands share, with everything that is wrong told to the report. */
#ifndef MONGE_CLI_LOAD_H
#define MONGE_CLI_LOAD_H

#include "cli/limits.h"
#include "cli/report.h"
#include "cli/scenes.h"
#include "cli/sweep.h"

/* Which scenes the command line names, and how it wants them to be read. */
struct loader {
    struct sweep sweep;
    struct limits limits;
    bool untrusted;
    bool outline;     /* for monge info */
    bool serial;      /* one load at a time: of a sweep through a scene, what is told again is told once */
    const char *path; /* of the last scene, where it is so, */
    struct monge_diagnostics *diag; /* and what there was to tell of it; owned */
    struct report report;
    struct scenes scenes;
};

/* Reads -D, --limit, --untrusted and --format, and finds the scenes, of which not all need be there: see
 * scenes.status. False, with the reason on stderr, when an option is wrong. Either way to be ended, which writes the
 * document of a --format to `out`; NULL: none. */
bool loader_begin(struct loader *loader, const struct arguments *args);
void loader_end(struct loader *loader, FILE *out);

struct load {
    struct monge_scene *scene;      /* owned; NULL where there is none */
    struct monge_diagnostics *diag; /* of this scene; NULL: no memory */
    unsigned errors, warnings;      /* of this scene */
    enum status status;
};

/* Loads a scene with a combination of the sweep, at a frame (0: the first). To be closed. */
struct load load_scene(struct loader *loader, const char *path, const struct monge_define *defines,
                       unsigned frame);

/* Moves it to another frame; the status as of a load. */
enum status load_frame(struct loader *loader, struct load *load, unsigned frame);

/* Tells what is not wrong as a text, but would render wrong. */
void load_examine(struct loader *loader, struct load *load);

void load_close(struct loader *loader, struct load *load);

/* Whether a picture of these settings keeps to the limits; if not, the reason is told. */
bool load_allows(const struct loader *loader, const char *path, const struct monge_settings *settings);

#endif
