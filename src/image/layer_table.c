#include "image/layer_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/json.h"

/* ---- Writing ---- */

static void write_text(FILE *out, const char *key, const char *text) {
    fprintf(out, ", \"%s\": ", key);
    if (text)
        json_string(text, out);
    else
        fputs("null", out);
}

/* A text that is written to `out`. */
struct printing {
    FILE *out; /* NULL: no memory */
    char *text;
    size_t size;
};

static void printing_begin(struct printing *p) {
    *p = (struct printing){.text = NULL};
    p->out = open_memstream(&p->text, &p->size);
}

/* To be freed; NULL: no memory. */
static char *printing_end(struct printing *p) {
    const bool good = !ferror(p->out);
    if (fclose(p->out) == 0 && good) return p->text;
    free(p->text);
    return NULL;
}

static void write_place(FILE *out, const struct monge_entry *e) {
    write_text(out, "file", e->file);
    fprintf(out, ", \"line\": %u, \"column\": %u", e->line, e->column);
}

char *layer_table_text(const struct layer_entries *entries) {
    struct printing p;
    printing_begin(&p);
    if (!p.out) return NULL;
    fputc('[', p.out);
    for (uint32_t i = 0; i < entries->count; i++) {
        const struct monge_entry *e = &entries->list[i];
        fprintf(p.out, "%s\n  {\"id\": %u", i ? "," : "", e->id);
        write_text(p.out, "name", e->name);
        write_text(p.out, "kind", e->kind);
        write_place(p.out, e);
        if (e->hash) write_text(p.out, "hash", e->hash);
        fputc('}', p.out);
    }
    fputs("\n]\n", p.out);
    return printing_end(&p);
}

static void write_vec3(FILE *out, const char *before, const char *key, vec3 v) {
    fprintf(out, "%s\"%s\": [%.17g, %.17g, %.17g]", before, key, v.x, v.y, v.z);
}

char *layer_camera_text(const struct layer_camera *camera) {
    const struct view *v = &camera->view;
    struct printing p;
    printing_begin(&p);
    if (!p.out) return NULL;
    fprintf(p.out, "{\n  \"projection\": \"%s\"", v->orthographic ? "orthographic" : "perspective");
    write_vec3(p.out, ",\n  ", "eye", v->eye);
    write_vec3(p.out, ", ", "forward", v->forward);
    write_vec3(p.out, ", ", "right", v->right);
    write_vec3(p.out, ", ", "up", v->up);
    fprintf(p.out, ",\n  \"given\": \"%s\", \"others\": \"%s\"", camera->given, camera->others);
    if (*camera->objects) write_text(p.out, "objects", camera->objects);
    write_place(p.out, &camera->entry);
    fputs("\n}\n", p.out);
    return printing_end(&p);
}

char *layer_lights_text(const struct layer_conditions *conditions) {
    struct printing p;
    printing_begin(&p);
    if (!p.out) return NULL;
    fputc('[', p.out);
    for (uint32_t i = 0; i < conditions->light_count; i++) {
        const struct layer_light *light = &conditions->lights[i];
        fprintf(p.out, "%s\n  {\"kind\": ", i ? "," : "");
        json_string(light->entry.kind, p.out);
        write_vec3(p.out, ", ", "at", light->at);
        write_vec3(p.out, ", ", "color", light->color);
        write_place(p.out, &light->entry);
        fputc('}', p.out);
    }
    fputs("\n]\n", p.out);
    return printing_end(&p);
}

char *layer_settings_text(const struct layer_conditions *conditions) {
    struct printing p;
    printing_begin(&p);
    if (!p.out) return NULL;
    for (uint32_t i = 0; i < conditions->setting_count; i++) {
        fputs(i ? ", " : "{", p.out);
        json_string(conditions->settings[i].name, p.out);
        fputs(": ", p.out);
        json_string(conditions->settings[i].value, p.out);
    }
    fputs("}\n", p.out);
    return printing_end(&p);
}

/* ---- Reading ---- */

/* What is left of the text. Each reader below takes what it is called for, and white space behind; false: it is not
 * there. */
struct scan {
    const char *at;
    struct arena *arena;
};

static bool take(struct scan *s, const char *word) {
    const size_t length = strlen(word);
    if (strncmp(s->at, word, length) != 0) return false;
    s->at += length;
    s->at += strspn(s->at, " \t\r\n");
    return true;
}

static bool read_number(struct scan *s, uint32_t *number) {
    uint64_t value = 0;
    const char *begin = s->at;
    for (; *s->at >= '0' && *s->at <= '9' && value <= UINT32_MAX; s->at++)
        value = value * 10 + (uint64_t)(*s->at - '0');
    *number = (uint32_t)value;
    return s->at > begin && value <= UINT32_MAX && take(s, "");
}

/* A code point below 0x10000 as UTF-8; halves of a pair become U+FFFD. Returns what follows it. */
static char *put_code(char *to, unsigned code) {
    if (code >= 0xd800 && code < 0xe000) code = 0xfffd;
    if (code < 0x80) {
        *to++ = (char)code;
    } else if (code < 0x800) {
        *to++ = (char)(0xc0 | code >> 6);
        *to++ = (char)(0x80 | (code & 0x3f));
    } else {
        *to++ = (char)(0xe0 | code >> 12);
        *to++ = (char)(0x80 | (code >> 6 & 0x3f));
        *to++ = (char)(0x80 | (code & 0x3f));
    }
    return to;
}

/* What follows a backslash. */
static bool read_escape(struct scan *s, char **to) {
    static const char *const escapes = "\"\"\\\\//b\bf\fn\nr\rt\t";
    unsigned code;
    for (const char *e = escapes; *e; e += 2)
        if (*e == *s->at) {
            *(*to)++ = e[1];
            s->at++;
            return true;
        }
    if (*s->at != 'u' || strspn(s->at + 1, "0123456789abcdefABCDEF") < 4 ||
        sscanf(s->at + 1, "%4x", &code) != 1 || code == 0)
        return false;
    *to = put_code(*to, code);
    s->at += 5;
    return true;
}

/* A text or null. */
static bool read_text(struct scan *s, const char **text) {
    *text = NULL;
    if (take(s, "null")) return true;
    const char *end = s->at;
    if (*end++ != '"') return false;
    for (; *end && *end != '"'; end++)
        if (*end == '\\' && end[1]) end++;
    char *result = arena_alloc(s->arena, (size_t)(end - s->at) + 1), *to = result;
    for (s->at++; *s->at && *s->at != '"';) {
        if (*s->at != '\\')
            *to++ = *s->at++;
        else if (s->at++, !read_escape(s, &to))
            return false;
    }
    *text = result;
    return take(s, "\"");
}

static bool read_member(struct scan *s, struct monge_entry *entry) {
    const char *key, *text;
    uint32_t number;
    if (*s->at != '"' || !read_text(s, &key) || !take(s, ":")) return false;
    if (strcmp(key, "id") == 0) return read_number(s, &entry->id);
    if (strcmp(key, "line") == 0) return read_number(s, &entry->line);
    if (strcmp(key, "column") == 0) return read_number(s, &entry->column);
    if (strcmp(key, "name") == 0) return read_text(s, &entry->name);
    if (strcmp(key, "kind") == 0) return read_text(s, &entry->kind);
    if (strcmp(key, "file") == 0) return read_text(s, &entry->file);
    if (strcmp(key, "hash") == 0) return read_text(s, &entry->hash);
    return read_number(s, &number) || read_text(s, &text);
}

static bool read_entry(struct scan *s, struct monge_entry *entry) {
    *entry = (struct monge_entry){.id = 0};
    if (!take(s, "{")) return false;
    do
        if (!read_member(s, entry)) return false;
    while (take(s, ","));
    return entry->kind && take(s, "}");
}

bool layer_table_read(const char *text, struct arena *arena, struct layer_entries *entries) {
    struct scan s = {.at = text, .arena = arena};
    uint32_t room = 0;
    *entries = (struct layer_entries){.list = NULL};
    if (!take(&s, "") || !take(&s, "[")) return false;
    if (take(&s, "]")) return !*s.at;
    do {
        if (entries->count == room) {
            const size_t before = room * sizeof *entries->list;
            room = room ? 2 * room : 16;
            entries->list = arena_resize(arena, entries->list, before, room * sizeof *entries->list);
        }
        struct monge_entry *entry = &entries->list[entries->count++];
        if (!read_entry(&s, entry) || entry->id <= entries->highest) return false;
        entries->highest = entry->id;
    } while (take(&s, ","));
    return take(&s, "]") && !*s.at;
}

/* ---- Reading a camera ---- */

static bool read_real(struct scan *s, double *number) {
    char *end;
    *number = strtod(s->at, &end);
    if (end == s->at || !isfinite(*number)) return false;
    s->at = end;
    return take(s, "");
}

static bool read_vec3(struct scan *s, vec3 *v) {
    return take(s, "[") && read_real(s, &v->x) && take(s, ",") && read_real(s, &v->y) && take(s, ",") &&
           read_real(s, &v->z) && take(s, "]");
}

static bool read_hash(struct scan *s, char hash[HASH_TEXT_SIZE]) {
    const char *text;
    if (!read_text(s, &text) || !text || strlen(text) != HASH_TEXT_SIZE - 1) return false;
    memcpy(hash, text, HASH_TEXT_SIZE);
    return true;
}

static bool read_projection(struct scan *s, bool *orthographic) {
    *orthographic = take(s, "\"orthographic\"");
    return *orthographic || take(s, "\"perspective\"");
}

static bool read_camera_member(struct scan *s, struct layer_camera *camera) {
    struct view *view = &camera->view;
    const char *const at = s->at, *key;
    if (*s->at != '"' || !read_text(s, &key) || !take(s, ":")) return false;
    if (strcmp(key, "projection") == 0) return read_projection(s, &view->orthographic);
    if (strcmp(key, "eye") == 0) return read_vec3(s, &view->eye);
    if (strcmp(key, "forward") == 0) return read_vec3(s, &view->forward);
    if (strcmp(key, "right") == 0) return read_vec3(s, &view->right);
    if (strcmp(key, "up") == 0) return read_vec3(s, &view->up);
    if (strcmp(key, "given") == 0) return read_hash(s, camera->given);
    if (strcmp(key, "others") == 0) return read_hash(s, camera->others);
    if (strcmp(key, "objects") == 0) return read_hash(s, camera->objects);
    s->at = at;
    return read_member(s, &camera->entry);
}

/* Axes are not zero, so what is not there is noticed. */
static bool is_whole(const struct layer_camera *camera) {
    const struct view *view = &camera->view;
    return vec3_max_abs(view->forward) > 0.0 && vec3_max_abs(view->right) > 0.0 &&
           vec3_max_abs(view->up) > 0.0 && *camera->given && *camera->others;
}

bool layer_camera_read(const char *text, struct arena *arena, struct layer_camera *camera) {
    struct scan s = {.at = text, .arena = arena};
    struct layer_camera found = {.entry = {.id = 0}};
    *camera = found;
    if (!take(&s, "") || !take(&s, "{")) return false;
    do
        if (!read_camera_member(&s, &found)) return false;
    while (take(&s, ","));
    if (!take(&s, "}") || *s.at || !is_whole(&found)) return false;
    *camera = found;
    camera->entry.kind = "camera";
    return true;
}

/* ---- Reading lights and settings ---- */

static bool read_light_member(struct scan *s, struct layer_light *light) {
    const char *const at = s->at, *key;
    if (*s->at != '"' || !read_text(s, &key) || !take(s, ":")) return false;
    if (strcmp(key, "at") == 0) return read_vec3(s, &light->at);
    if (strcmp(key, "color") == 0) return read_vec3(s, &light->color);
    s->at = at;
    return read_member(s, &light->entry);
}

static bool read_light(struct scan *s, struct layer_light *light) {
    if (!take(s, "{")) return false;
    do
        if (!read_light_member(s, light)) return false;
    while (take(s, ","));
    return light->entry.kind && take(s, "}");
}

static bool read_lights(struct scan *s, struct layer_light **list, uint32_t *count) {
    if (!take(s, "") || !take(s, "[")) return false;
    *list = arena_array(s->arena, LAYER_LIGHTS_MOST, sizeof **list);
    if (take(s, "]")) return !*s->at;
    do
        if (*count == LAYER_LIGHTS_MOST || !read_light(s, &(*list)[(*count)++])) return false;
    while (take(s, ","));
    return take(s, "]") && !*s->at;
}

bool layer_lights_read(const char *text, struct arena *arena, struct layer_conditions *conditions) {
    struct scan s = {.at = text, .arena = arena};
    struct layer_light *list = NULL;
    uint32_t count = 0;
    const bool good = read_lights(&s, &list, &count);
    conditions->lights = good ? list : NULL;
    conditions->light_count = good ? count : 0;
    return good;
}

static bool read_setting(struct scan *s, struct layer_setting *setting) {
    return *s->at == '"' && read_text(s, &setting->name) && take(s, ":") && read_text(s, &setting->value) &&
           setting->value;
}

static bool read_settings(struct scan *s, struct layer_setting *list, uint32_t *count) {
    if (!take(s, "") || !take(s, "{")) return false;
    do
        if (*count == LAYER_SETTINGS_MOST || !read_setting(s, &list[(*count)++])) return false;
    while (take(s, ","));
    return take(s, "}") && !*s->at;
}

bool layer_settings_read(const char *text, struct arena *arena, struct layer_conditions *conditions) {
    struct scan s = {.at = text, .arena = arena};
    struct layer_setting *list = arena_array(arena, LAYER_SETTINGS_MOST, sizeof *list);
    uint32_t count = 0;
    const bool good = read_settings(&s, list, &count);
    conditions->settings = good ? list : NULL;
    conditions->setting_count = good ? count : 0;
    return good;
}
