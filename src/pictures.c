/* The library's face: pictures and how they differ. */
#include <stdlib.h>
#include <string.h>

#include "face.h"
#include "image/compare.h"
#include "image/heat.h"

static bool is_standard(const char *name) { return strcmp(name, "-") == 0; }
static const char *shown(const char *name) { return is_standard(name) ? "standard input" : name; }

static bool report_damage(struct diagnostics *diag, const struct monge_picture *picture, const char *reason) {
    diag_failure(diag, "bad-picture", "cannot use %s: %s", shown(picture->name), reason);
    return false;
}

struct monge_picture *monge_picture_read(const char *path, struct monge_diagnostics *diag) {
    char reason[PICTURE_REASON_SIZE] = "";
    bool system = false;
    struct monge_picture *picture = calloc(1, sizeof *picture);
    if (!picture) {
        diag_failure(&diag->list, "out-of-memory", "%s: out of memory", path);
        return NULL;
    }
    if (picture_open(picture, path, reason, &system)) return picture;
    if (system)
        diag_failure(&diag->list, "cannot-read", "cannot read %s: %s", shown(path), reason);
    else
        report_damage(&diag->list, picture, reason);
    monge_picture_free(picture);
    return NULL;
}

void monge_picture_free(struct monge_picture *picture) {
    if (!picture) return;
    picture_close(picture);
    free(picture);
}

uint32_t monge_picture_width(const struct monge_picture *picture) { return picture->width; }
uint32_t monge_picture_height(const struct monge_picture *picture) { return picture->height; }
unsigned monge_picture_bits(const struct monge_picture *picture) { return picture->bits; }
unsigned monge_picture_channels(const struct monge_picture *picture) { return picture->channels; }
const char *monge_picture_color_space(const struct monge_picture *picture) { return picture->space.name; }
const uint8_t *monge_picture_row(const struct monge_picture *picture, uint32_t y) {
    return picture_row(picture, y);
}

const char *monge_picture_text(const struct monge_picture *picture, const char *key) {
    for (size_t i = 0; i < picture->text_count; i++)
        if (strcmp(picture->texts[i].key, key) == 0) return picture->texts[i].text;
    return NULL;
}

bool monge_picture_decode(struct monge_picture *picture, struct monge_diagnostics *diag) {
    char reason[PICTURE_REASON_SIZE] = "";
    return picture_decode(picture, reason) || report_damage(&diag->list, picture, reason);
}

bool monge_compare(struct monge_picture *a, struct monge_picture *b, const struct monge_compare *how,
                   struct monge_difference *out, struct monge_diagnostics *diag) {
    char reason[PICTURE_REASON_SIZE] = "";
    const struct monge_picture *about = a;
    return compare_pictures(a, b, how, out, reason, &about) || report_damage(&diag->list, about, reason);
}

bool monge_heat_map_write(struct monge_picture *a, struct monge_picture *b, const struct monge_compare *how,
                          const char *path, struct monge_diagnostics *diag) {
    char reason[PICTURE_REASON_SIZE] = "";
    const struct monge_picture *about = NULL;
    if (heat_map_write(a, b, how, path, reason, &about)) return true;
    if (about) return report_damage(&diag->list, about, reason);
    diag_failure(&diag->list, "cannot-write", "cannot write %s: %s",
                 is_standard(path) ? "standard output" : path, reason);
    return false;
}
