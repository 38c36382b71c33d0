/* Settings, camera, lights and materials of a file. */
#include <string.h>

#include "base/elementary.h"
#include "scene/builder.h"

/* ---- Image and render ---- */

const char *monge_settings_check(const struct monge_settings *s) {
    if (s->width < 1 || s->width > MONGE_MAX_SIDE) return "the width must be 1 to 65535 pixels";
    if (s->height < 1 || s->height > MONGE_MAX_SIDE) return "the height must be 1 to 65535 pixels";
    if ((uint64_t)s->width * s->height > MONGE_MAX_PIXELS)
        return "a picture has at most 268435456 pixels, as 16384 x 16384: they take 3 GiB of memory";
    if (s->samples < 1 || s->samples > MONGE_MAX_SAMPLES) return "the samples must be 1 to 65536 a pixel";
    if (s->bits != 8 && s->bits != 16) return "the bits of a channel must be 8 or 16";
    if (s->depth < 1 || s->depth > MONGE_MAX_DEPTH) return "the depth must be 1 (camera rays alone) to 64";
    if (!(s->shadow >= 0.0 && s->shadow <= 1.0)) return "the shadow must be 0 (physical) to 1 (no shadows)";
    return NULL;
}

static void background_build(struct scene *scene, const struct object_value *image) {
    const struct object_value *backdrop = image ? object_object(image, KEY_IMAGE_BACKGROUND) : NULL;
    if (backdrop) {
        scene->background.bottom = object_vec3(backdrop, KEY_BACKDROP_BOTTOM);
        scene->background.top = object_vec3(backdrop, KEY_BACKDROP_TOP);
    } else if (image && object_has(image, KEY_IMAGE_BACKGROUND)) {
        scene->background.bottom = scene->background.top = object_vec3(image, KEY_IMAGE_BACKGROUND);
    } else {
        scene->background.bottom = (vec3){0.72, 0.71, 0.70};
        scene->background.top = (vec3){0.16, 0.21, 0.30};
    }
}

void settings_build(struct builder *b, const struct object_value *file) {
    struct scene *scene = b->scene;
    struct monge_settings *s = &scene->settings;
    const struct object_value none_image = {.kind = &grammar_kinds[KIND_IMAGE],
                                            .fields = (struct value *[KEYS_IMAGE]){0}};
    const struct object_value none_render = {.kind = &grammar_kinds[KIND_RENDER],
                                             .fields = (struct value *[KEYS_RENDER]){0}};
    const struct object_value *image = object_object(file, KEY_FILE_IMAGE),
                              *render = object_object(file, KEY_FILE_RENDER);
    background_build(scene, image);
    if (!image) image = &none_image;
    if (!render) render = &none_render;
    const vec3 size = object_vec3(image, KEY_IMAGE_SIZE);
    *s = (struct monge_settings){
        .width = (uint32_t)size.x,
        .height = (uint32_t)size.y,
        .samples = (uint32_t)object_number(image, KEY_IMAGE_SAMPLES),
        .bits = object_choice(image, KEY_IMAGE_BITS) == CHOICE_IMAGE_BITS_16 ? 16 : 8,
        .encoding = object_choice(image, KEY_IMAGE_ENCODING) == CHOICE_IMAGE_ENCODING_LINEAR
                        ? MONGE_ENCODING_LINEAR
                        : MONGE_ENCODING_SRGB,
        .shading = (enum monge_shading)object_choice(render, KEY_RENDER_SHADING),
        .depth = (unsigned)object_number(render, KEY_RENDER_DEPTH),
        .shadow = object_number(render, KEY_RENDER_SHADOW),
    };
    scene->two_sided = object_choice(render, KEY_RENDER_TWO_SIDED);
    scene->highlight_always = object_choice(render, KEY_RENDER_HIGHLIGHT) == CHOICE_RENDER_HIGHLIGHT_ALWAYS;
    const char *wrong = monge_settings_check(s);
    if (!wrong) return;
    struct diagnostic *d =
        diag_error(b->diag, object_span(image, KEY_IMAGE_SIZE), "image-too-large", "%s", wrong);
    diag_help(b->diag, d, "%u x %u would take %.3g GiB", (unsigned)s->width, (unsigned)s->height,
              12.0 * s->width * s->height / (1 << 30));
}

/* ---- Camera ---- */

static bool parallel(vec3 a, vec3 c) {
    return vec3_length(vec3_cross(vec3_normalize(a), vec3_normalize(c))) < 1e-9;
}

/* Reports a camera that has no direction, or whose `up` says nothing. */
static void camera_check(struct builder *b, const struct object_value *object, const struct camera *camera) {
    const vec3 view = camera->has_direction ? camera->direction : vec3_sub(camera->look_at, camera->eye);
    if (!camera->has_direction && !(camera->has_eye && camera->has_look_at)) return;
    if (!(vec3_max_abs(view) > 0.0)) {
        struct diagnostic *d =
            diag_error(b->diag, object_span(object, KEY_CAMERA_LOOK_AT), "no-view-direction",
                       "`look_at` is where `eye` is: no direction to look in");
        diag_related(b->diag, d, object_span(object, KEY_CAMERA_EYE), "`eye` is given here");
        return;
    }
    if (!camera->has_up || !parallel(view, camera->up)) return;
    const vec3 n = vec3_abs(vec3_normalize(view));
    struct diagnostic *d = diag_error(b->diag, object_span(object, KEY_CAMERA_UP), "up-along-view",
                                      "`up` points along the view, which leaves open what is up");
    diag_help(b->diag, d, "%s will do", n.y > 0.9 ? "[0, 0, -1]" : "[0, 1, 0]");
}

static void projection_check(struct builder *b, const struct object_value *object,
                             const struct camera *camera) {
    const bool perspective = camera->projection == CAMERA_PERSPECTIVE;
    const int other = perspective ? KEY_CAMERA_HEIGHT : KEY_CAMERA_FOV;
    if (!object_has(object, other)) return;
    struct diagnostic *d =
        diag_error(b->diag, object_span(object, other), "wrong-projection", "`%s` is for %s camera",
                   object->kind->keys[other].name, perspective ? "an orthographic" : "a perspective");
    diag_help(b->diag, d,
              perspective ? "use `fov`, or add `projection: orthographic`"
                          : "use `height`, or remove `projection: orthographic`");
}

void camera_build(struct builder *b, const struct object_value *file) {
    struct camera *camera = &b->scene->camera;
    const struct object_value *object = object_object(file, KEY_FILE_CAMERA);
    *camera =
        (struct camera){.up = {0, 1, 0}, .fov_deg = grammar_kinds[KIND_CAMERA].keys[KEY_CAMERA_FOV].value[0]};
    b->scene->camera_span = object_span(file, object ? KEY_FILE_CAMERA : KEY_FILE_SCENE);
    b->scene->camera_place = object ? b->scene->camera_span : (struct span){.source = NULL};
    if (!object) return;
    *camera = (struct camera){
        .projection = object_choice(object, KEY_CAMERA_PROJECTION) == CHOICE_CAMERA_PROJECTION_ORTHOGRAPHIC
                          ? CAMERA_ORTHOGRAPHIC
                          : CAMERA_PERSPECTIVE,
        .has_eye = object_has(object, KEY_CAMERA_EYE),
        .has_look_at = object_has(object, KEY_CAMERA_LOOK_AT),
        .has_direction = object_has(object, KEY_CAMERA_DIRECTION),
        .has_up = object_has(object, KEY_CAMERA_UP),
        .has_height = object_has(object, KEY_CAMERA_HEIGHT),
        .eye = object_vec3(object, KEY_CAMERA_EYE),
        .look_at = object_vec3(object, KEY_CAMERA_LOOK_AT),
        .direction = object_vec3(object, KEY_CAMERA_DIRECTION),
        .up = object_has(object, KEY_CAMERA_UP) ? object_vec3(object, KEY_CAMERA_UP) : (vec3){0, 1, 0},
        .fov_deg = object_number(object, KEY_CAMERA_FOV),
        .height = object_number(object, KEY_CAMERA_HEIGHT),
    };
    if (object->failed) return;
    const int looks = camera->has_direction ? KEY_CAMERA_DIRECTION
                      : camera->has_look_at ? KEY_CAMERA_LOOK_AT
                                            : KEY_CAMERA_EYE;
    if (object_has(object, looks)) b->scene->camera_span = object_span(object, looks);
    b->scene->eye_span = object_span(object, KEY_CAMERA_EYE);
    camera_check(b, object, camera);
    projection_check(b, object, camera);
}

/* ---- Lights ---- */

static struct light light_build(const struct object_value *object) {
    const struct object_value *ambient = object_object(object, KEY_LIGHT_AMBIENT),
                              *point = object_object(object, KEY_LIGHT_POINT);
    if (ambient)
        return (struct light){LIGHT_AMBIENT, {0, 0, 0}, object_vec3(ambient, KEY_AMBIENT_LIGHT_COLOR)};
    if (point)
        return (struct light){LIGHT_POINT, object_vec3(point, KEY_POINT_LIGHT_AT),
                              object_vec3(point, KEY_POINT_LIGHT_COLOR)};
    return (struct light){LIGHT_AMBIENT, {0, 0, 0}, {0, 0, 0}}; /* a reported one */
}

/* Where it says where the light is, or else its colour. */
static struct span light_span(const struct object_value *object) {
    const struct object_value *ambient = object_object(object, KEY_LIGHT_AMBIENT),
                              *point = object_object(object, KEY_LIGHT_POINT);
    if (point) return object_span(point, KEY_POINT_LIGHT_AT);
    return ambient ? object_span(ambient, KEY_AMBIENT_LIGHT_COLOR) : object->span;
}

void lights_build(struct builder *b, const struct object_value *file) {
    struct scene *scene = b->scene;
    const struct object_list list = object_list(file, KEY_FILE_LIGHTS);
    scene->default_lights = !object_has(file, KEY_FILE_LIGHTS);
    scene->lights = arena_array(b->arena, list.count ? list.count : 1, sizeof *scene->lights);
    scene->light_places = arena_array(b->arena, list.count ? list.count : 1, sizeof *scene->light_places);
    scene->light_spans = arena_array(b->arena, list.count ? list.count : 1, sizeof *scene->light_spans);
    scene->light_count = list.count;
    for (uint32_t i = 0; i < list.count; i++) {
        scene->lights[i] = light_build(list.items[i]);
        scene->light_places[i] = list.items[i]->span;
        scene->light_spans[i] = light_span(list.items[i]);
    }
}

static bool is_black(vec3 color) { return !(vec3_max_abs(color) > 0.0); }

/* Whether the object gives back nothing of the lights, nor of what is around it. */
static bool looks_black(const struct scene *scene, const struct material *m) {
    bool lit = false;
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const struct light *light = &scene->lights[i];
        const bool takes = light->kind == LIGHT_AMBIENT ? !is_black(m->ambient)
                                                        : !is_black(m->diffuse) || !is_black(m->specular);
        lit |= takes && !is_black(light->color);
    }
    return !lit && is_black(m->reflection) && is_black(m->refraction);
}

/* Whether everything is black that `p` makes with the materials that it has itself. */
static bool all_black(const struct scene *scene, const struct primitives *p, const bool *black) {
    for (uint32_t i = 0; i < p->count; i++) {
        uint32_t count;
        const uint32_t *materials = primitives_materials(p, scene->geometries, i, &count);
        for (uint32_t k = 0; k < count; k++)
            if (!(materials[k] & MATERIAL_SLOT) && !black[materials[k]]) return false;
    }
    return true;
}

void lights_check(struct builder *b, const struct object_value *file) {
    const struct scene *scene = b->scene;
    if (scene->default_lights || scene->settings.shading == MONGE_SHADING_SIGNATURE) return;
    bool ambient_alone = scene->light_count > 0;
    for (uint32_t i = 0; i < scene->light_count; i++) ambient_alone &= scene->lights[i].kind == LIGHT_AMBIENT;
    bool *black = arena_array(b->arena, scene->material_count, sizeof *black);
    for (uint32_t i = 0; i < scene->material_count; i++) black[i] = looks_black(scene, &scene->materials[i]);
    for (uint32_t i = 0; i < scene->geometry_count; i++)
        if (!all_black(scene, &scene->geometries[i], black)) return;
    if (!all_black(scene, &scene->primitives, black)) return;
    struct diagnostic *d = diag_warning(
        b->diag, object_span(file, KEY_FILE_LIGHTS), "no-light",
        scene->light_count == 0 ? "no light: everything will be black"
                                : "no light that any material gives back: everything will be black");
    if (ambient_alone)
        diag_help(b->diag, d, "give the materials an `ambient` colour, or add a point light");
    else if (scene->light_count > 0)
        diag_help(b->diag, d, "give a material a `diffuse` colour, or a light a `color`, that is not black");
    else
        diag_help(b->diag, d, "add one, or remove `lights` for the default ones");
}

/* ---- Materials ---- */

/* At the one of the two that is written here, where the other is of a preset or of another file. */
static void report_too_much_light(struct builder *b, const struct object_value *object, double sum) {
    const struct span mirrored = object_span(object, KEY_MATERIAL_REFLECTION),
                      through = object_span(object, KEY_MATERIAL_REFRACTION);
    const bool own = through.source == object->span.source;
    struct diagnostic *d =
        diag_error(b->diag, own ? through : mirrored, "too-much-light",
                   "`reflection` and `refraction` add up to %g: more light than comes in", sum);
    diag_help(b->diag, d, "their sum is at most 1");
    diag_related(b->diag, d, own ? mirrored : through, "`%s` is given here",
                 own ? "reflection" : "refraction");
}

static struct material material_of(struct builder *b, const struct object_value *object) {
    struct material m = {
        .ambient = object_vec3(object, KEY_MATERIAL_AMBIENT),
        .specular = object_vec3(object, KEY_MATERIAL_SPECULAR),
        .shininess = object_number(object, KEY_MATERIAL_SHININESS),
        .reflection = object_vec3(object, KEY_MATERIAL_REFLECTION),
        .refraction = object_vec3(object, KEY_MATERIAL_REFRACTION),
        .index = object_number(object, KEY_MATERIAL_INDEX),
    };
    const vec3 sum = vec3_add(m.reflection, m.refraction);
    const double most = sum.x > sum.y ? (sum.x > sum.z ? sum.x : sum.z) : (sum.y > sum.z ? sum.y : sum.z);
    if (most > 1.0 + 1e-9 && !object->failed) {
        report_too_much_light(b, object, most);
    }
    const vec3 left = vec3_scale(vec3_sub(vec3_all(1), sum), 0.8);
    const vec3 matte = {left.x > 0 ? left.x : 0, left.y > 0 ? left.y : 0, left.z > 0 ? left.z : 0};
    m.diffuse = object_has(object, KEY_MATERIAL_DIFFUSE) ? object_vec3(object, KEY_MATERIAL_DIFFUSE) : matte;
    return m;
}

static uint32_t add_material(struct builder *b, struct material material, struct material_info info) {
    struct scene *scene = b->scene;
    scene->materials =
        builder_grow(b, scene->materials, scene->material_count, &b->material_room, sizeof *scene->materials);
    scene->material_info = builder_grow(b, scene->material_info, scene->material_count,
                                        &b->material_info_room, sizeof *scene->material_info);
    scene->materials[scene->material_count] = material;
    scene->material_info[scene->material_count] = info;
    return scene->material_count++;
}

/* Of a material that an object has: what it takes over from another one may well be idle. */
static void warn_idle(struct builder *b, const struct object_value *m) {
    static const struct {
        int key, needs;
    } pairs[] = {{KEY_MATERIAL_SHININESS, KEY_MATERIAL_SPECULAR},
                 {KEY_MATERIAL_INDEX, KEY_MATERIAL_REFRACTION}};
    if (m->failed || object_has(m, KEY_MATERIAL_EXTENDS) || object_has(m, KEY_MATERIAL_PRESET) ||
        diag_full(b->diag))
        return;
    for (int i = 0; i < 2; i++) {
        if (!object_has(m, pairs[i].key) || object_has(m, pairs[i].needs)) continue;
        const char *key = m->kind->keys[pairs[i].key].name, *needs = m->kind->keys[pairs[i].needs].name;
        struct diagnostic *d = diag_warning(b->diag, object_span(m, pairs[i].key), "no-effect",
                                            "`%s` has no effect without `%s`", key, needs);
        diag_help(b->diag, d, "give the material a `%s`, or remove `%s`", needs, key);
    }
}

/* Materials written in place are often the same: of those one is enough. */
static uint32_t inline_material(struct builder *b, const struct object_value *object) {
    const struct material material = material_of(b, object);
    struct hash hash;
    char name[HASH_TEXT_SIZE];
    hash_begin(&hash);
    material_hash(&material, &hash);
    hash_text(&hash, name);
    const uint32_t *known = table_find(&b->inline_materials, name);
    if (known) return *known;
    uint32_t *index = arena_alloc(b->arena, sizeof *index);
    *index = add_material(b, material, (struct material_info){.span = object->span, .given = true});
    warn_idle(b, object);
    table_put(b->arena, &b->inline_materials, arena_text(b->arena, name, HASH_TEXT_SIZE - 1), index);
    return *index;
}

static uint32_t named_material(struct builder *b, const struct object_value *material) {
    while (b->named_room <= material->definition) {
        const uint32_t before = b->named_room;
        b->named_materials =
            builder_grow(b, b->named_materials, before, &b->named_room, sizeof *b->named_materials);
        for (uint32_t i = before; i < b->named_room; i++) b->named_materials[i] = NO_MATERIAL;
    }
    uint32_t *index = &b->named_materials[material->definition];
    if (*index != NO_MATERIAL) return *index;
    const char *name = arena_text(b->arena, material->name, strlen(material->name));
    return *index = add_material(b, material_of(b, material),
                                 (struct material_info){.name = name, .span = material->span});
}

void material_add_named(struct builder *b, const struct object_value *material) {
    named_material(b, material);
}

void material_hold(struct builder *b, const struct object_value *material, struct span span) {
    if (!material->name || material->failed) return;
    struct material_info *info = &b->scene->material_info[named_material(b, material)];
    if (!info->held.source) info->held = span;
}

void materials_check(struct builder *b) {
    for (uint32_t i = 0; i < b->scene->material_count; i++) {
        const struct material_info *info = &b->scene->material_info[i];
        if (info->given || !info->held.source) continue;
        struct diagnostic *d = diag_warning(
            b->diag, info->held, "unused-material",
            "`%s` can be seen on nothing: all that is in here has materials of its own", info->name);
        diag_help(b->diag, d, "remove it, or the material of a member");
    }
}

/* A light clay, with a soft highlight. */
static const struct material default_material = {.ambient = {0.62, 0.36, 0.22},
                                                 .diffuse = {0.62, 0.36, 0.22},
                                                 .specular = {0.25, 0.25, 0.25},
                                                 .shininess = 40,
                                                 .index = 1};

uint32_t material_index(struct builder *b, const struct object_value *material) {
    if (material && !material->name) return inline_material(b, material);
    if (material) {
        const uint32_t index = named_material(b, material);
        if (!b->scene->material_info[index].given) warn_idle(b, material);
        b->scene->material_info[index].given = true;
        return index;
    }
    if (b->set->outer) return MATERIAL_INHERITED;
    if (b->default_material == NO_MATERIAL)
        b->default_material = add_material(b, default_material, (struct material_info){.given = true});
    return b->default_material;
}
