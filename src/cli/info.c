#include "cli/info.h"

#include <stdio.h>
#include <stdlib.h>

#include "cli/load.h"
#include "cli/say.h"

static enum status tell(struct loader *loader, const char *path, const struct monge_define *defines,
                        enum monge_format format, bool titled) {
    struct load load = load_scene(loader, path, defines, 0);
    if (load.scene) {
        char *with = sweep_describe(&loader->sweep, defines);
        if (titled) say_line(stdout, "%s%s%s", path, *with ? " with " : "", with);
        free(with);
        if (!monge_scene_info(load.scene, format, stdout)) {
            say_error("%s: no memory for %zu primitives", path, monge_scene_primitives(load.scene));
            load.status = STATUS_TROUBLE;
        }
        streams_flush();
    }
    load_close(loader, &load);
    return load.status;
}

static enum status tell_all(struct loader *loader, bool json) {
    struct monge_define *defines = calloc(loader->sweep.count + 1, sizeof *defines);
    const size_t all = loader->scenes.count * loader->sweep.total;
    enum status worst = defines ? loader->scenes.status : STATUS_TROUBLE;
    if (!defines) say_error("out of memory");
    for (size_t i = 0; defines && i < all; i++) {
        if (i > 0 && !json) printf("\n");
        sweep_combination(&loader->sweep, i % loader->sweep.total, defines);
        const enum status status = tell(loader, loader->scenes.all[i / loader->sweep.total].path, defines,
                                        json ? MONGE_FORMAT_JSON : MONGE_FORMAT_TEXT, all > 1 && !json);
        if (status > worst) worst = status;
    }
    free(defines);
    return worst;
}

enum status info_command(const struct arguments *args) {
    struct loader loader;
    const bool good = loader_begin(&loader, args);
    loader.outline = loader.serial = true;
    const enum status status = good ? tell_all(&loader, args->option[OPTION_JSON].given) : STATUS_TROUBLE;
    loader_end(&loader, good ? stdout : NULL);
    return status;
}
