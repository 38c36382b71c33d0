/* The library's face: pictures and how they differ. */
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"
#include "face.h"
#include "image/compare.h"
#include "image/heat.h"
#include "image/pixels.h"

static bool is_standard(const char *name) { return strcmp(name, "-") == 0; }
static const char *shown(const char *name) { return is_standard(name) ? "standard input" : name; }

static bool report_damage(struct diagnostics *diag, const struct monge_picture *picture, const char *reason) {
    diag_failure(diag, "bad-picture", "cannot use %s: %s", shown(picture->name), reason);
    return false;
}

struct reading {
    const char *path;
    struct monge_picture *picture; /* NULL: out of memory */
    char reason[PICTURE_REASON_SIZE];
    bool good, system;
};

static void begin_reading(void *context, unsigned number) {
    struct reading *r = (struct reading *)context + number;
    r->picture = calloc(1, sizeof *r->picture);
    r->good = r->picture && picture_open(r->picture, r->path, r->reason, &r->system);
}

static struct monge_picture *end_reading(const struct reading *r, struct diagnostics *diag) {
    if (r->good) return r->picture;
    if (!r->picture)
        diag_failure(diag, "out-of-memory", "%s: out of memory", r->path);
    else if (r->system)
        diag_failure(diag, "cannot-read", "cannot read %s: %s", shown(r->path), r->reason);
    else
        report_damage(diag, r->picture, r->reason);
    monge_picture_free(r->picture);
    return NULL;
}

struct monge_picture *monge_picture_read(const char *path, struct monge_diagnostics *diag) {
    struct reading reading = {.path = path};
    begin_reading(&reading, 0);
    return end_reading(&reading, &diag->list);
}

bool monge_picture_read_pair(const char *path_a, const char *path_b, struct monge_picture **a,
                             struct monge_picture **b, struct monge_diagnostics *diag) {
    struct reading readings[] = {{.path = path_a}, {.path = path_b}};
    parallel_run(2, begin_reading, readings);
    *a = end_reading(&readings[0], &diag->list);
    *b = end_reading(&readings[1], &diag->list);
    return *a && *b;
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

bool monge_picture_hash(struct monge_picture *picture, struct monge_diagnostics *diag,
                        char hash[MONGE_HASH_SIZE]) {
    struct hash pixels;
    const bool linear = picture->space.kind == COLOR_GAMMA && picture->space.gamma == 100000;
    if (!monge_picture_decode(picture, diag)) return false;
    if (picture->channels != 3 || (picture->space.kind != COLOR_SRGB && !linear)) return false;
    pixels_hash_begin(&pixels, picture->width, picture->height, picture->bits,
                      linear ? MONGE_ENCODING_LINEAR : MONGE_ENCODING_SRGB);
    for (uint32_t y = 0; y < picture->height; y++)
        hash_bulk(&pixels, picture_row(picture, y), picture->width * picture_pixel_size(picture));
    hash_text(&pixels, hash);
    return true;
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
