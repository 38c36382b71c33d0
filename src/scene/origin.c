#include "scene/origin.h"

#include <string.h>

enum {
    KEPT_TEXT = 4 << 20
}; /* bytes of sources that stay for messages; places in longer ones have no excerpt */

static void *grow(struct arena *arena, void *array, uint32_t count, uint32_t *room, size_t size) {
    if (count < *room) return array;
    const uint32_t before = *room;
    *room = before ? 2 * before : 16;
    return arena_resize(arena, array, before * size, *room * size);
}

static bool same_name(const char *a, const char *b) { return a == b || (a && b && strcmp(a, b) == 0); }

static bool same_origin(const struct origin *a, const struct origin *b) {
    return a->line == b->line && a->column == b->column && a->file == b->file && a->template == b->template &&
           a->kind == b->kind && same_name(a->name, b->name);
}

/* The last one is in most cases the one. */
uint32_t origins_file(struct origins *origins, struct arena *arena, const struct source *source) {
    for (uint32_t i = origins->file_count; i-- > 0;)
        if (origins->files[i] == source) return i;
    origins->files =
        grow(arena, origins->files, origins->file_count, &origins->file_room, sizeof *origins->files);
    origins->files[origins->file_count] = source;
    return origins->file_count++;
}

/* A name that the origin before it has too is copied once. */
static const char *keep_name(const struct origins *origins, struct arena *arena, const char *name) {
    const struct origin *before = origins->count ? &origins->list[origins->count - 1] : NULL;
    if (!name) return NULL;
    return before && same_name(before->name, name) ? before->name : arena_text(arena, name, strlen(name));
}

static uint32_t *recent_of(uint32_t recent[ORIGINS_RECENT], struct span span) {
    return &recent[(span.line * 31 + span.column) % ORIGINS_RECENT];
}

uint32_t origins_add(struct origins *origins, struct arena *arena, struct span span, struct origin origin) {
    origin.line = span.line;
    origin.column = span.column;
    origin.file = origins_file(origins, arena, span.source) & 0xffffff;
    uint32_t *recent = recent_of(origins->recent, span);
    if (*recent < origins->count && same_origin(&origins->list[*recent], &origin)) return *recent;
    origins->list = grow(arena, origins->list, origins->count, &origins->room, sizeof *origins->list);
    origin.name = keep_name(origins, arena, origin.name);
    origins->list[origins->count] = origin;
    return *recent = origins->count++;
}

uint32_t origins_add_object(struct origins *origins, struct arena *arena, struct span span, const char *name,
                            const char *kind, const char *used) {
    const uint32_t file = origins_file(origins, arena, span.source);
    uint32_t *recent = recent_of(origins->recent_objects, span);
    const struct object_place *there = *recent < origins->object_count ? &origins->objects[*recent] : NULL;
    if (there && there->line == span.line && there->column == span.column && there->file == file &&
        same_name(there->name, name))
        return *recent;
    origins->objects =
        grow(arena, origins->objects, origins->object_count, &origins->object_room, sizeof *origins->objects);
    origins->objects[origins->object_count] =
        (struct object_place){.name = name ? arena_text(arena, name, strlen(name)) : NULL,
                              .kind = used ? arena_format(arena, "%s %s", kind, used) : kind,
                              .line = span.line,
                              .column = span.column,
                              .file = file};
    return *recent = origins->object_count++;
}

void origins_keep(struct origins *origins, struct arena *arena) {
    size_t left = KEPT_TEXT;
    for (uint32_t i = 0; i < origins->file_count; i++) {
        const struct source *source = origins->files[i];
        struct source *kept = arena_alloc(arena, sizeof *kept);
        kept->name = arena_text(arena, source->name, strlen(source->name));
        kept->text = "";
        if (source->size <= left) {
            kept->text = arena_text(arena, source->text, source->size);
            kept->size = source->size;
            left -= source->size;
        }
        origins->files[i] = kept;
    }
}

struct span origins_span(const struct origins *origins, uint32_t index) {
    const struct origin *o = &origins->list[index];
    return (struct span){origins->files[o->file], o->line, o->column, 1};
}
