#include "image/layers_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "image/layer_table.h"
#include "image/pfm.h"
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

/* ---- Writing ---- */

static bool write_samples(const struct monge_layers *layers, const char *path, struct samples *samples,
                          char *message, size_t size) {
    const struct monge_region r = layers->region;
    char software[] = "Monge " MONGE_VERSION, software_key[] = "Software", region_key[] = "monge:region";
    char region[80];
    samples->width = r.width;
    samples->height = r.height;
    samples->texts[samples->text_count++] = (struct samples_text){software_key, software};
    snprintf(region, sizeof region, "%u,%u,%u,%u of %ux%u", r.x, r.y, r.width, r.height, layers->width,
             layers->height);
    if (r.width != layers->width || r.height != layers->height)
        samples->texts[samples->text_count++] = (struct samples_text){region_key, region};
    return samples_write(path, samples, message, size);
}

static bool write_normals(const struct monge_layers *layers, const char *path, char *message, size_t size) {
    struct samples samples = {.channels = 3, .values = layers->normals};
    return write_samples(layers, path, &samples, message, size);
}

static bool write_numbers(const struct monge_layers *layers, enum monge_layer layer, const char *path,
                          char *message, size_t size) {
    const size_t pixels = layers_pixels(layers);
    const bool has_table = layer != MONGE_LAYER_SHADOW;
    char key[] = "monge:table", *table = has_table ? layer_table_text(&layers->entries[layer]) : NULL;
    struct samples samples = {.channels = bits_of(layers, layer) > 16 ? 3 : 1};
    samples.values = malloc(pixels * samples.channels * sizeof *samples.values);
    bool good = samples.values && (table || !has_table);
    if (!good) snprintf(message, size, "cannot write %s: out of memory", path);
    for (size_t i = 0; good && i < pixels; i++)
        for (unsigned c = 0; c < samples.channels; c++)
            samples.values[samples.channels * i + c] =
                (uint16_t)(number_at(layers, layer, i) >> (16 * c));
    if (has_table) samples.texts[samples.text_count++] = (struct samples_text){key, table};
    good = good && write_samples(layers, path, &samples, message, size);
    free(samples.values);
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
    bool good = false;
    layers->arena.on_full = &full;
    if (setjmp(full) == 0) good = layer_table_read(text, &layers->arena, &layers->entries[layer]);
    layers->arena.on_full = NULL;
    return good;
}

static bool take_numbers(struct reading *reading, enum monge_layer layer, const char *path,
                         const struct samples *samples) {
    struct monge_layers *layers = reading->layers;
    const char *table = samples->texts[0].text;
    for (size_t i = 0; i < layers_pixels(layers); i++) {
        uint64_t number = 0;
        for (unsigned c = 0; c < samples->channels; c++)
            number |= (uint64_t)samples->values[samples->channels * i + c] << (16 * c);
        set_number(layers, layer, i, number);
    }
    if (layer == MONGE_LAYER_SHADOW) {
        layers->light_count = samples->channels == 3 ? MONGE_LAYER_LIGHTS : 16;
        return true;
    }
    return (table && read_table(layers, layer, table)) ||
           fail(reading, path, "it has no table of what its numbers stand for");
}

static bool take_samples(struct reading *reading, enum monge_layer layer, const char *path,
                         const struct samples *samples) {
    if (layer == MONGE_LAYER_NORMAL && samples->channels != 3)
        return fail(reading, path, "normals have three channels");
    if (!add_layer(reading, layer, path, samples->width, samples->height)) return false;
    read_region(reading->layers, samples->texts[1].text);
    if (layer != MONGE_LAYER_NORMAL) return take_numbers(reading, layer, path, samples);
    memcpy(reading->layers->normals, samples->values,
           3 * layers_pixels(reading->layers) * sizeof *samples->values);
    return true;
}

static bool read_samples(struct reading *reading, enum monge_layer layer, const char *path) {
    char table[] = "monge:table", region[] = "monge:region";
    struct samples samples = {.texts = {{table, NULL}, {region, NULL}}, .text_count = 2};
    const bool good = samples_read(path, MONGE_MAX_PIXELS, &samples, reading->message, reading->size) &&
                      take_samples(reading, layer, path, &samples);
    samples_free(&samples);
    return good;
}

static bool read_depth(struct reading *reading, const char *path) {
    uint32_t width, height;
    float *values;
    if (!pfm_read(path, MONGE_MAX_PIXELS, &width, &height, &values, reading->message, reading->size))
        return false;
    const bool good = add_layer(reading, MONGE_LAYER_DEPTH, path, width, height);
    if (good) memcpy(reading->layers->depth, values, layers_pixels(reading->layers) * sizeof *values);
    free(values);
    return good;
}

static bool read_layer(struct reading *reading, enum monge_layer layer, const char *picture) {
    const size_t length = monge_layer_path(layer, picture, NULL, 0) + 1;
    char *path = malloc(length);
    if (!path) return fail(reading, picture, "out of memory");
    monge_layer_path(layer, picture, path, length);
    const bool there = access(path, F_OK) == 0;
    const bool good =
        !there || (layer == MONGE_LAYER_DEPTH ? read_depth(reading, path) : read_samples(reading, layer, path));
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
