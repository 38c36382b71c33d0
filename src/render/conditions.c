#include "render/conditions.h"

#include <string.h>

struct monge_entry conditions_entry(const struct span *place, const char *kind, struct arena *arena) {
    if (!place->source) return (struct monge_entry){.kind = kind};
    return (struct monge_entry){.kind = kind,
                                .file = arena_text(arena, place->source->name, strlen(place->source->name)),
                                .line = place->line + 1,
                                .column = place->column + 1};
}

/* ---- Lights ---- */

static struct layer_light light_of(const struct scene *scene, uint32_t i, struct arena *arena) {
    const struct light *light = &scene->lights[i];
    const char *kind = light->kind == LIGHT_POINT ? "point light" : "ambient light";
    return (struct layer_light){conditions_entry(&scene->light_places[i], kind, arena), light->at,
                                light->color};
}

static void list_lights(struct layer_conditions *c, const struct scene *scene, struct arena *arena) {
    if (scene->light_count > LAYER_LIGHTS_MOST) return;
    c->lights = arena_array(arena, scene->light_count + 1, sizeof *c->lights);
    if (scene->default_lights) c->lights[c->light_count++].entry.kind = "default lights";
    for (uint32_t i = 0; i < scene->light_count; i++) c->lights[c->light_count++] = light_of(scene, i, arena);
}

/* ---- Settings ---- */

static const char *background_text(const struct background *b, struct arena *arena) {
    return arena_format(arena, "bottom [%.9g, %.9g, %.9g], top [%.9g, %.9g, %.9g]", b->bottom.x, b->bottom.y,
                        b->bottom.z, b->top.x, b->top.y, b->top.z);
}

static void list_settings(struct layer_conditions *c, const struct scene *scene,
                          const struct monge_settings *s, struct arena *arena) {
    static const char *const shadings[] = {[MONGE_SHADING_PHONG] = "phong",
                                           [MONGE_SHADING_DIFFUSE] = "diffuse",
                                           [MONGE_SHADING_SIGNATURE] = "signature"};
    const struct layer_setting all[] = {
        {"samples", arena_format(arena, "%u", s->samples)},
        {"bits", arena_format(arena, "%u", s->bits)},
        {"encoding", s->encoding == MONGE_ENCODING_LINEAR ? "linear" : "srgb"},
        {"background", background_text(&scene->background, arena)},
        {"shading", shadings[s->shading]},
        {"depth", arena_format(arena, "%u", s->depth)},
        {"shadow", arena_format(arena, "%.9g", s->shadow)},
        {"two_sided", scene->two_sided ? "true" : "false"},
        {"highlight", scene->highlight_always ? "always" : "lit"},
    };
    c->setting_count = sizeof all / sizeof *all;
    c->settings = arena_array(arena, c->setting_count, sizeof *c->settings);
    memcpy(c->settings, all, sizeof all);
}

struct layer_conditions conditions_of(const struct scene *scene, const struct monge_settings *settings,
                                      struct arena *arena) {
    struct layer_conditions c = {.lights = NULL};
    list_lights(&c, scene, arena);
    list_settings(&c, scene, settings, arena);
    return c;
}
