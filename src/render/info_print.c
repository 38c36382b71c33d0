/* The numbers of a scene for people and for programs. */
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/json.h"
#include "render/camera.h"
#include "render/info.h"

static const char *projection_name(const struct view *view) {
    return view->orthographic ? "orthographic" : "perspective";
}

static vec3 looked_at(const struct view *view) { return vec3_madd(view->eye, view->distance, view->forward); }

static uint32_t endless(const struct scene *scene) {
    uint32_t planes = 0;
    for (uint32_t i = 0; i < scene->primitives.flat_count; i++)
        planes += scene->primitives.flats[i].outline == FLAT_PLANE;
    return planes;
}

static uint32_t lights_of(const struct scene *scene, enum light_kind kind) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->light_count; i++) count += scene->lights[i].kind == kind;
    return count;
}

/* ---- For people ---- */

/* 1234567 as "1,234,567". */
static const char *grouped(uint64_t number, char text[32]) {
    char digits[24];
    const int count = snprintf(digits, sizeof digits, "%" PRIu64, number);
    char *to = text;
    for (int i = 0; i < count; i++) {
        if (i > 0 && (count - i) % 3 == 0) *to++ = ',';
        *to++ = digits[i];
    }
    *to = '\0';
    return text;
}

static void print_number(FILE *out, const char *before, uint64_t number, const char *after) {
    char text[32];
    fprintf(out, "%s%s%s", before, grouped(number, text), after);
}

static void print_vec3(FILE *out, const char *before, vec3 v) {
    fprintf(out, "%s[%.4g, %.4g, %.4g]", before, v.x, v.y, v.z);
}

static void print_bytes(FILE *out, uint64_t bytes) {
    static const char *const units[] = {"bytes", "KiB", "MiB", "GiB"};
    double number = (double)bytes;
    int unit = 0;
    for (; unit < 3 && number >= 1024.0; unit++) number /= 1024.0;
    fprintf(out, unit ? "%.1f %s" : "%.0f %s", number, units[unit]);
}

static void print_picture(const struct scene *scene, const struct accel *accel, FILE *out) {
    const struct monge_settings *s = &scene->settings;
    const struct view view = camera_view(scene, accel, s->width, s->height);
    const box3 bounds = accel_extent(accel);
    const uint32_t planes = endless(scene);
    fprintf(out, "image       %" PRIu32 " x %" PRIu32 ", %" PRIu32 " sample%s a pixel, %u bits\n", s->width,
            s->height, s->samples, s->samples == 1 ? "" : "s", s->bits);
    fprintf(out, "camera      %s", projection_name(&view));
    print_vec3(out, ", eye: ", view.eye);
    print_vec3(out, ", look_at: ", looked_at(&view));
    print_vec3(out, ", up: ", vec3_normalize(view.up));
    if (view.orthographic)
        fprintf(out, ", height: %.4g\n", 2.0 * vec3_length(view.up));
    else
        fprintf(out, ", fov: %.4g\n", scene->camera.fov_deg);
    if (scene->default_lights)
        fputs("lights      the default ones\n", out);
    else
        fprintf(out, "lights      %" PRIu32 " point, %" PRIu32 " ambient\n", lights_of(scene, LIGHT_POINT),
                lights_of(scene, LIGHT_AMBIENT));
    fputs("bounds      ", out);
    if (box3_is_bounded(bounds)) {
        print_vec3(out, "", bounds.min);
        print_vec3(out, " to ", bounds.max);
    } else {
        fputs("none", out);
    }
    fprintf(out, planes ? ", and %" PRIu32 " endless plane%s\n" : "\n", planes, planes == 1 ? "" : "s");
}

/* A text of the scene, or the name of a file, for a terminal: without its control characters. */
static void print_text(FILE *out, const char *before, const char *text, const char *after) {
    fputs(before, out);
    for (const char *c = text; *c; c++) fputc((unsigned char)*c < 0x20 || *c == 0x7f ? '?' : *c, out);
    fputs(after, out);
}

/* At the beginning of a line, with a column of its own. */
static void print_name(FILE *out, const char *name) {
    const int room = 18 - (int)strlen(name);
    print_text(out, "  ", name, "");
    fprintf(out, "%*s", room > 0 ? room : 0, "");
}

static void print_count(FILE *out, const char *name, const struct info_count *c, const char *what) {
    print_name(out, name);
    print_number(out, "", c->stored, what);
    if (c->placed != c->stored) print_number(out, ", placed ", c->placed, "");
    fputc('\n', out);
}

static void print_counts(const struct info *info, const struct scene *scene, FILE *out) {
    print_number(out, "primitives  ", info->all.stored, "");
    if (info->all.placed != info->all.stored) print_number(out, ", placed ", info->all.placed, "");
    fputc('\n', out);
    for (uint32_t kind = 0; kind < INFO_KINDS; kind++)
        if (info->kinds[kind].stored) print_count(out, scene_kind_name(kind), &info->kinds[kind], "");
    if (scene->geometry_count) {
        print_number(out, "geometries  ", scene->geometry_count, "");
        print_number(out, ", in ", info->instances.stored, " instances");
        if (info->instances.placed != info->instances.stored)
            print_number(out, ", placed ", info->instances.placed, "");
        fputc('\n', out);
    }
    fputs("memory      ", out);
    print_bytes(out, info->scene_bytes + info->accel_bytes);
    if (info->accel_bytes) fputs(", of which the hierarchy ", out);
    if (info->accel_bytes) print_bytes(out, info->accel_bytes);
    fputc('\n', out);
}

static void print_materials(const struct info *info, const struct scene *scene, FILE *out) {
    struct info_count others = {0, 0};
    uint32_t unnamed = 0;
    print_number(out, "materials   ", scene->material_count, "\n");
    for (uint32_t i = 0; i < scene->material_count; i++) {
        if (scene->material_info[i].name) {
            print_count(out, scene->material_info[i].name, &info->materials[i],
                        info->materials[i].stored == 1 ? " time" : " times");
            continue;
        }
        unnamed++;
        others.stored += info->materials[i].stored;
        others.placed = others.placed > UINT64_MAX - info->materials[i].placed
                            ? UINT64_MAX
                            : others.placed + info->materials[i].placed;
    }
    if (unnamed) print_count(out, "(without a name)", &others, others.stored == 1 ? " time" : " times");
}

static void print_templates(const struct info *info, FILE *out) {
    bool any = false;
    for (uint32_t i = 0; i < info->template_count; i++) {
        const struct info_template *t = &info->templates[i];
        if (!t->name) continue;
        if (!any) fputs("templates   each without those that it uses\n", out);
        any = true;
        print_name(out, t->name);
        print_number(out, "used ", t->uses, t->uses == 1 ? " time" : " times");
        print_number(out, ", primitives ", t->primitives.stored, "");
        if (t->primitives.placed != t->primitives.stored)
            print_number(out, ", placed ", t->primitives.placed, "");
        fputs(", ", out);
        print_bytes(out, t->bytes);
        fputc('\n', out);
    }
}

static void print_members(const struct outline_node *node, int depth, const char *file, FILE *out) {
    for (const struct outline_node *n = node->first; n; n = n->next) {
        fprintf(out, "%*s", 2 * depth, "");
        print_text(out, n->is_use ? "use " : "", n->what, "");
        if (n->name) print_text(out, " `", n->name, "`");
        if (n->with && *n->with) print_text(out, " (", n->with, n->varies ? ", ...)" : ")");
        if (n->count > 1) print_number(out, " x", n->count, "");
        if (n->loop) print_text(out, " for ", n->loop, "");
        if (n->material) print_text(out, ", ", n->material, "");
        fputs("  ", out);
        if (!file || n->file != file) print_text(out, "", n->file, ":");
        fprintf(out, "%" PRIu32 ":%" PRIu32 "\n", n->line, n->column);
        print_members(n, depth + 1, n->file, out);
    }
    if (!node->more) return;
    fprintf(out, "%*s", 2 * depth, "");
    print_number(out, "... and ", node->more, " more\n");
}

void info_print(const struct info *info, const struct scene *scene, const struct accel *accel,
                const struct outline *outline, FILE *out) {
    print_picture(scene, accel, out);
    print_counts(info, scene, out);
    print_materials(info, scene, out);
    print_templates(info, out);
    if (!outline) return;
    fputs("scene\n", out);
    print_members(&outline->root, 1, NULL, out);
}

/* ---- For programs ---- */

static void write_integer(struct json *json, const char *key, uint64_t number) {
    json_key(json, key);
    fprintf(json->out, "%" PRIu64, number);
}

static void write_real(struct json *json, const char *key, double number) {
    json_key(json, key);
    fprintf(json->out, "%.17g", number);
}

static void write_vec3(struct json *json, const char *key, vec3 v) {
    json_key(json, key);
    fprintf(json->out, "[%.17g, %.17g, %.17g]", v.x, v.y, v.z);
}

static void write_count(struct json *json, const char *key, const struct info_count *c) {
    json_key(json, key);
    fprintf(json->out, "{\"stored\": %" PRIu64 ", \"placed\": %" PRIu64 "}", c->stored, c->placed);
}

static void write_picture(struct json *json, const struct scene *scene, const struct accel *accel) {
    const struct monge_settings *s = &scene->settings;
    const struct view view = camera_view(scene, accel, s->width, s->height);
    const box3 bounds = accel_extent(accel);
    json_open(json, "image", '{');
    write_integer(json, "width", s->width);
    write_integer(json, "height", s->height);
    write_integer(json, "samples", s->samples);
    write_integer(json, "bits", s->bits);
    json_close(json, '}');
    json_open(json, "camera", '{');
    json_text(json, "projection", projection_name(&view));
    write_vec3(json, "eye", view.eye);
    write_vec3(json, "look_at", looked_at(&view));
    write_vec3(json, "up", vec3_normalize(view.up));
    if (view.orthographic)
        write_real(json, "height", 2.0 * vec3_length(view.up));
    else
        write_real(json, "fov", scene->camera.fov_deg);
    json_close(json, '}');
    json_open(json, "lights", '{');
    json_word(json, "default", scene->default_lights ? "true" : "false");
    write_integer(json, "point", lights_of(scene, LIGHT_POINT));
    write_integer(json, "ambient", lights_of(scene, LIGHT_AMBIENT));
    json_close(json, '}');
    if (box3_is_bounded(bounds)) {
        json_open(json, "bounds", '{');
        write_vec3(json, "min", bounds.min);
        write_vec3(json, "max", bounds.max);
        json_close(json, '}');
    } else {
        json_word(json, "bounds", "null");
    }
    write_integer(json, "endless_planes", endless(scene));
}

static void write_materials(struct json *json, const struct info *info, const struct scene *scene) {
    json_open(json, "materials", '[');
    for (uint32_t i = 0; i < scene->material_count; i++) {
        json_open(json, NULL, '{');
        json_text(json, "name", scene->material_info[i].name);
        write_count(json, "primitives", &info->materials[i]);
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void write_templates(struct json *json, const struct info *info) {
    json_open(json, "templates", '[');
    for (uint32_t i = 0; i < info->template_count; i++) {
        if (!info->templates[i].name) continue;
        json_open(json, NULL, '{');
        json_text(json, "name", info->templates[i].name);
        write_integer(json, "uses", info->templates[i].uses);
        write_count(json, "primitives", &info->templates[i].primitives);
        write_integer(json, "bytes", info->templates[i].bytes);
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void write_members(struct json *json, const struct outline_node *node) {
    json_open(json, "members", '[');
    for (const struct outline_node *n = node->first; n; n = n->next) {
        json_open(json, NULL, '{');
        json_text(json, "kind", n->is_use ? "use" : n->what);
        if (n->is_use) json_text(json, "template", n->what);
        json_text(json, "name", n->name);
        json_text(json, "file", n->file);
        write_integer(json, "line", n->line);
        write_integer(json, "column", n->column);
        write_integer(json, "count", n->count);
        json_text(json, "for", n->loop);
        json_text(json, "material", n->material);
        if (n->is_use) json_text(json, "with", n->with);
        if (n->is_use) json_word(json, "varies", n->varies ? "true" : "false");
        write_members(json, n);
        json_close(json, '}');
    }
    json_close(json, ']');
    write_integer(json, "more", node->more);
}

void info_write_json(const struct info *info, const struct scene *scene, const struct accel *accel,
                     const struct outline *outline, FILE *out) {
    struct json json = {.out = out};
    json_open(&json, NULL, '{');
    write_picture(&json, scene, accel);
    write_count(&json, "primitives", &info->all);
    json_open(&json, "kinds", '{');
    for (uint32_t kind = 0; kind < INFO_KINDS; kind++)
        if (info->kinds[kind].stored) write_count(&json, scene_kind_name(kind), &info->kinds[kind]);
    json_close(&json, '}');
    write_integer(&json, "geometries", scene->geometry_count);
    write_count(&json, "instances", &info->instances);
    json_open(&json, "memory", '{');
    write_integer(&json, "bytes", info->scene_bytes + info->accel_bytes);
    write_integer(&json, "hierarchy_bytes", info->accel_bytes);
    json_close(&json, '}');
    write_materials(&json, info, scene);
    write_templates(&json, info);
    if (outline) write_members(&json, &outline->root);
    json_close(&json, '}');
}
