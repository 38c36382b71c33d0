#include "image/layers_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "image/layer_table.h"
#include "image/pfm.h"
#include "image/picture.h"
#include "image/samples.h"

/* ---- Names ---- */

static const char *const layer_names[MONGE_LAYERS] = {"object", "material", "depth", "normal", "shadow"};

const char *monge_layer_name(enum monge_layer layer) { return layer_names[layer]; }

size_t monge_layer_path(enum monge_layer layer, const char *picture, char *path, size_t size) {
    const size_t length = strlen(picture);
    const bool is_png = length > 4 && strcasecmp(picture + length - 4, ".png") == 0;
    return (size_t)snprintf(path, size, "%.*s.%s.%s", (int)(is_png ? length - 4 : length), picture,
                            layer_names[layer], layer == MONGE_LAYER_DEPTH ? "pfm" : "png");
}

/* ---- Numbers and their channels ---- */

/* How many bits the numbers of a layer have, in every region of the picture. */
static unsigned bits_of(const struct monge_layers *layers, enum monge_layer layer) {
    if (layer == MONGE_LAYER_SHADOW)
        return layers->light_count < MONGE_LAYER_LIGHTS ? layers->light_count : MONGE_LAYER_LIGHTS;
    return layers->entries[layer].highest > UINT16_MAX ? 32 : 16;
}

static uint64_t number_at(const struct monge_layers *layers, enum monge_layer layer, size_t i) {
    return layer == MONGE_LAYER_SHADOW ? layers->lights[i] : layers->ids[layer][i];
}

static void set_number(struct monge_layers *layers, enum monge_layer layer, size_t i, uint64_t number) {
    if (layer == MONGE_LAYER_SHADOW)
        layers->lights[i] = number;
    else
        layers->ids[layer][i] = (uint32_t)number;
}

/* ---- Hashes ---- */

/* What the pixel has of the layer. */
static uint64_t pixel_value(const struct monge_layers *layers, enum monge_layer layer, size_t i) {
    uint32_t depth;
    const uint16_t *n = layers->normals;
    switch (layer) {
    case MONGE_LAYER_DEPTH: memcpy(&depth, &layers->depth[i], sizeof depth); return depth;
    case MONGE_LAYER_NORMAL: return (uint64_t)n[3 * i] << 32 | (uint64_t)n[3 * i + 1] << 16 | n[3 * i + 2];
    default: return layers->lights[i];
    }
}

bool monge_layer_hash(const struct monge_layers *layers, enum monge_layer layer, char text[MONGE_HASH_SIZE]) {
    struct hash hash;
    const bool known =
        layer == MONGE_LAYER_DEPTH || layer == MONGE_LAYER_NORMAL || layer == MONGE_LAYER_SHADOW;
    if (!known || !(layers->set >> layer & 1)) return false;
    hash_begin(&hash);
    hash_integer(&hash, layers->region.width);
    hash_integer(&hash, layers->region.height);
    for (size_t i = 0; i < layers_pixels(layers); i++) hash_integer(&hash, pixel_value(layers, layer, i));
    hash_text(&hash, text);
    return true;
}

/* ---- Writing ---- */

static bool write_samples(const struct monge_layers *layers, const char *path, struct samples *samples,
                          char *message, size_t size) {
    const struct monge_region r = layers->region;
    const bool is_part = r.width != layers->width || r.height != layers->height;
    char region[80];
    snprintf(region, sizeof region, "%u,%u,%u,%u of %ux%u", r.x, r.y, r.width, r.height, layers->width,
             layers->height);
    samples->width = r.width;
    samples->height = r.height;
    samples_add_text(samples, "Software", "Monge " MONGE_VERSION);
    samples_add_text(samples, "monge:scene", *layers->scene ? layers->scene : NULL);
    samples_add_text(samples, "monge:region", is_part ? region : NULL);
    return samples_write(path, samples, message, size);
}

static bool write_normals(const struct monge_layers *layers, const char *path, char *message, size_t size) {
    struct samples samples = {.channels = 3, .values = layers->normals};
    return write_samples(layers, path, &samples, message, size);
}

static void fill_numbers(const struct monge_layers *layers, enum monge_layer layer, struct samples *samples) {
    const size_t pixels = layers_pixels(layers);
    for (size_t i = 0; i < pixels; i++)
        for (unsigned c = 0; c < samples->channels; c++)
            samples->values[samples->channels * i + c] = (uint16_t)(number_at(layers, layer, i) >> (16 * c));
}

/* What the file of the objects tells of the whole picture; NULL: not known, or no memory. */
struct whole_texts {
    char *camera, *lights, *settings;
};

/* False: no memory. */
static bool make_texts(const struct monge_layers *layers, struct whole_texts *texts) {
    const struct layer_conditions *c = &layers->conditions;
    const bool has_camera = layers->camera.entry.kind;
    texts->camera = has_camera ? layer_camera_text(&layers->camera) : NULL;
    texts->lights = c->lights ? layer_lights_text(c) : NULL;
    texts->settings = c->settings ? layer_settings_text(c) : NULL;
    return (texts->camera || !has_camera) && (texts->lights || !c->lights) &&
           (texts->settings || !c->settings);
}

static void add_texts(const struct whole_texts *texts, struct samples *samples) {
    samples_add_text(samples, "monge:camera", texts->camera);
    samples_add_text(samples, "monge:lights", texts->lights);
    samples_add_text(samples, "monge:settings", texts->settings);
}

static void free_texts(struct whole_texts *texts) {
    free(texts->settings);
    free(texts->lights);
    free(texts->camera);
}

static bool write_numbers(const struct monge_layers *layers, enum monge_layer layer, const char *path,
                          char *message, size_t size) {
    const bool has_table = layer != MONGE_LAYER_SHADOW, is_object = layer == MONGE_LAYER_OBJECT;
    struct whole_texts texts = {.camera = NULL};
    char *table = has_table ? layer_table_text(&layers->entries[layer]) : NULL;
    char depth[HASH_TEXT_SIZE];
    const bool has_depth = is_object && monge_layer_hash(layers, MONGE_LAYER_DEPTH, depth);
    struct samples samples = {.channels = bits_of(layers, layer) > 16 ? 3 : 1};
    samples.values = malloc(layers_pixels(layers) * samples.channels * sizeof *samples.values);
    bool good = samples.values && (table || !has_table) && (!is_object || make_texts(layers, &texts));
    if (good) {
        fill_numbers(layers, layer, &samples);
        samples_add_text(&samples, "monge:table", table);
        add_texts(&texts, &samples);
        samples_add_text(&samples, "monge:depth", has_depth ? depth : NULL);
        good = write_samples(layers, path, &samples, message, size);
    } else {
        snprintf(message, size, "cannot write %s: out of memory", path);
    }
    free(samples.values);
    free_texts(&texts);
    free(table);
    return good;
}

bool layer_file_write(const struct monge_layers *layers, enum monge_layer layer, const char *path,
                      char *message, size_t size) {
    if (layer == MONGE_LAYER_NORMAL) return write_normals(layers, path, message, size);
    if (layer != MONGE_LAYER_DEPTH) return write_numbers(layers, layer, path, message, size);
    return pfm_write(path, layers->region.width, layers->region.height, layers->depth, message, size);
}

/* ---- Reading ---- */

/* Layers that are read one after another; the first tells the size. */
struct reading {
    struct monge_layers *layers; /* NULL: none yet */
    char *message;
    size_t size;
};

static bool fail(const struct reading *reading, const char *path, const char *reason) {
    snprintf(reading->message, reading->size, "cannot read %s: %s", path, reason);
    return false;
}

/* Makes room for a layer of this region. */
static bool add_layer(struct reading *reading, enum monge_layer layer, const char *path, uint32_t width,
                      uint32_t height) {
    const struct monge_region region = {0, 0, width, height};
    if (!reading->layers) reading->layers = layers_new(width, height, region, 0);
    struct monge_layers *layers = reading->layers;
    if (!layers) return fail(reading, path, "out of memory");
    if (layers->region.width != width || layers->region.height != height)
        return fail(reading, path, "it has not the size of the other layers");
    return layers_add(layers, layer) || fail(reading, path, "out of memory");
}

/* Whether the layer is of the same picture as those before it. */
static bool take_scene(struct monge_layers *layers, const char *scene) {
    if (!scene) return true;
    if (*layers->scene) return strcmp(layers->scene, scene) == 0;
    snprintf(layers->scene, sizeof layers->scene, "%s", scene);
    return true;
}

/* Where the pixels are in the whole picture. */
static void read_region(struct monge_layers *layers, const char *text) {
    struct monge_region r;
    uint32_t width, height;
    if (!text || sscanf(text, "%u,%u,%u,%u of %ux%u", &r.x, &r.y, &r.width, &r.height, &width, &height) != 6)
        return;
    if (r.width != layers->region.width || r.height != layers->region.height) return;
    layers->region = r;
    layers->width = width;
    layers->height = height;
}

static bool read_table(struct monge_layers *layers, enum monge_layer layer, const char *text) {
    jmp_buf full;
    layers->arena.on_full = &full;
    const bool good = setjmp(full) == 0 && layer_table_read(text, &layers->arena, &layers->entries[layer]);
    layers->arena.on_full = NULL;
    return good;
}

static unsigned sample_at(const struct monge_picture *picture, uint32_t y, size_t i) {
    const uint8_t *at = picture_row(picture, y) + 2 * i;
    return (unsigned)at[0] << 8 | at[1];
}

static void take_normals(uint16_t *normals, const struct monge_picture *picture) {
    for (uint32_t y = 0; y < picture->height; y++)
        for (size_t i = 0; i < 3 * (size_t)picture->width; i++)
            *normals++ = (uint16_t)sample_at(picture, y, i);
}

static void take_numbers(struct monge_layers *layers, enum monge_layer layer,
                         const struct monge_picture *picture) {
    const unsigned channels = picture->channels;
    size_t at = 0;
    for (uint32_t y = 0; y < picture->height; y++)
        for (size_t x = 0; x < picture->width; x++) {
            uint64_t number = 0;
            for (unsigned c = 0; c < channels; c++)
                number |= (uint64_t)sample_at(picture, y, channels * x + c) << (16 * c);
            set_number(layers, layer, at++, number);
        }
}

static const char *text_of(const struct monge_picture *picture, const char *key) {
    for (size_t i = 0; i < picture->text_count; i++)
        if (strcmp(picture->texts[i].key, key) == 0) return picture->texts[i].text;
    return NULL;
}

/* What the file of the objects tells of the whole picture. What cannot be read is not known, as in files of older
 * programs. */
static void read_whole(struct monge_layers *layers, const struct monge_picture *picture) {
    const char *camera = text_of(picture, "monge:camera"), *lights = text_of(picture, "monge:lights"),
               *settings = text_of(picture, "monge:settings");
    jmp_buf full;
    layers->arena.on_full = &full;
    if (setjmp(full) == 0) {
        if (camera) layer_camera_read(camera, &layers->arena, &layers->camera);
        if (lights) layer_lights_read(lights, &layers->arena, &layers->conditions);
        if (settings) layer_settings_read(settings, &layers->arena, &layers->conditions);
    }
    layers->arena.on_full = NULL;
}

static bool take_picture(struct reading *reading, enum monge_layer layer, const char *path,
                         const struct monge_picture *picture) {
    const char *table = text_of(picture, "monge:table");
    if (picture->bits != 16 || (picture->channels != 1 && picture->channels != 3))
        return fail(reading, path, "a layer has 16 bits, grey or RGB");
    if (layer == MONGE_LAYER_NORMAL && picture->channels != 3)
        return fail(reading, path, "normals have three channels");
    if (!add_layer(reading, layer, path, picture->width, picture->height)) return false;
    struct monge_layers *layers = reading->layers;
    if (!take_scene(layers, text_of(picture, "monge:scene")))
        return fail(reading, path, "it is of another rendering than the other layers");
    read_region(layers, text_of(picture, "monge:region"));
    if (layer == MONGE_LAYER_NORMAL) {
        take_normals(layers->normals, picture);
        return true;
    }
    take_numbers(layers, layer, picture);
    if (layer == MONGE_LAYER_SHADOW) {
        layers->light_count = 16 * picture->channels;
        return true;
    }
    if (layer == MONGE_LAYER_OBJECT) read_whole(layers, picture);
    return (table && read_table(layers, layer, table)) ||
           fail(reading, path, "it has no table of what its numbers stand for");
}

static bool read_picture(struct reading *reading, enum monge_layer layer, const char *path) {
    struct monge_picture picture = {.name = NULL};
    char reason[PICTURE_REASON_SIZE] = "";
    bool system;
    const bool good = picture_open(&picture, path, reason, &system) && picture_decode(&picture, reason)
                          ? take_picture(reading, layer, path, &picture)
                          : fail(reading, path, reason);
    picture_close(&picture);
    return good;
}

/* The file of a layer beside the picture. To be freed; NULL: no memory. */
static char *path_of(enum monge_layer layer, const char *picture) {
    const size_t size = monge_layer_path(layer, picture, NULL, 0) + 1;
    char *path = malloc(size);
    if (path) monge_layer_path(layer, picture, path, size);
    return path;
}

/* Whether the depth is that which the objects were written with: a PFM has no sums of its own. Objects that cannot be
 * read, or that say nothing of it, do not tell. */
static bool is_depth_of(const struct monge_layers *layers, const char *objects) {
    struct monge_picture picture = {.name = NULL};
    char reason[PICTURE_REASON_SIZE], depth[HASH_TEXT_SIZE];
    bool system;
    const char *said =
        picture_open(&picture, objects, reason, &system) ? text_of(&picture, "monge:depth") : NULL;
    const bool same =
        !said || (monge_layer_hash(layers, MONGE_LAYER_DEPTH, depth) && strcmp(said, depth) == 0);
    picture_close(&picture);
    return same;
}

static bool read_depth(struct reading *reading, const char *path, const char *objects) {
    uint32_t width, height;
    float *values;
    if (!pfm_read(path, MONGE_MAX_PIXELS, &width, &height, &values, reading->message, reading->size))
        return false;
    bool good = add_layer(reading, MONGE_LAYER_DEPTH, path, width, height);
    if (good) {
        memcpy(reading->layers->depth, values, layers_pixels(reading->layers) * sizeof *values);
        good = is_depth_of(reading->layers, objects) ||
               fail(reading, path, "it is damaged, or not of the rendering that the layer object is of");
    }
    free(values);
    return good;
}

static bool read_layer(struct reading *reading, enum monge_layer layer, const char *picture) {
    char *path = path_of(layer, picture), *objects = path_of(MONGE_LAYER_OBJECT, picture);
    bool good = path && objects;
    if (!good)
        fail(reading, picture, "out of memory");
    else if (access(path, F_OK) == 0)
        good = layer == MONGE_LAYER_DEPTH ? read_depth(reading, path, objects)
                                          : read_picture(reading, layer, path);
    free(objects);
    free(path);
    return good;
}

struct monge_layers *layer_files_read(const char *picture, unsigned wanted, char *message, size_t size) {
    struct reading reading = {.message = message, .size = size};
    *message = '\0';
    for (enum monge_layer layer = 0; layer < MONGE_LAYERS; layer++) {
        if (!(wanted >> layer & 1) || read_layer(&reading, layer, picture)) continue;
        monge_layers_free(reading.layers);
        return NULL;
    }
    return reading.layers;
}
