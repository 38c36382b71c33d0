#include "image/conditions_change.h"

#include <string.h>

#include "base/same.h"

#define NOBODY UINT32_MAX /* a light without a partner */

/* ---- Which lights are the same ----
 * A light has no name: it is that of the same place and colour, else that of one of these, else the next of its kind. */

struct pairing {
    const struct layer_conditions *older, *newer;
    uint32_t *partner; /* by index of the newer light: the older one, or NOBODY */
    bool *taken;       /* by index of the older light */
};

typedef bool alike(const struct layer_light *a, const struct layer_light *b);

static bool same_place(const struct layer_light *a, const struct layer_light *b) {
    return same_vector(a->at, b->at);
}

static bool same_color(const struct layer_light *a, const struct layer_light *b) {
    return same_vector(a->color, b->color);
}

static bool same_light(const struct layer_light *a, const struct layer_light *b) {
    return same_place(a, b) && same_color(a, b);
}

static bool any_light(const struct layer_light *a, const struct layer_light *b) { return a && b; }

static void pair_by(struct pairing *p, alike *is_alike) {
    for (uint32_t n = 0; n < p->newer->light_count; n++)
        for (uint32_t o = 0; o < p->older->light_count && p->partner[n] == NOBODY; o++) {
            const struct layer_light *a = &p->older->lights[o], *b = &p->newer->lights[n];
            if (p->taken[o] || strcmp(a->entry.kind, b->entry.kind) != 0 || !is_alike(a, b)) continue;
            p->partner[n] = o;
            p->taken[o] = true;
        }
}

static void pair_lights(struct pairing *p, struct arena *arena) {
    static alike *const by[] = {same_light, same_place, same_color, any_light};
    p->partner = arena_array(arena, p->newer->light_count + 1, sizeof *p->partner);
    p->taken = arena_array(arena, p->older->light_count + 1, sizeof *p->taken);
    for (uint32_t n = 0; n < p->newer->light_count; n++) p->partner[n] = NOBODY;
    for (size_t i = 0; i < sizeof by / sizeof *by; i++) pair_by(p, by[i]);
}

/* ---- Lights ---- */

static bool same_line(const struct monge_change *a, const struct monge_change *b) {
    const struct monge_entry *p = a->object, *q = b->object;
    return a->kind == b->kind && p->line == q->line && p->column == q->column &&
           same_text(p->file, q->file) && strcmp(p->kind, q->kind) == 0;
}

/* Lights that a loop makes come one after another, and are told once. */
static void add_light(struct conditions_change *c, enum monge_change_kind kind,
                      const struct monge_entry *entry) {
    const struct monge_change change = {.kind = kind, .object = entry};
    if (c->count > 0 && same_line(&c->list[c->count - 1], &change)) return;
    c->list[c->count++] = change;
}

static void list_lights(struct conditions_change *c, const struct pairing *p) {
    for (uint32_t n = 0; n < p->newer->light_count; n++) {
        const struct layer_light *b = &p->newer->lights[n],
                                 *a = p->partner[n] == NOBODY ? NULL : &p->older->lights[p->partner[n]];
        if (a && same_light(a, b)) continue;
        add_light(c,
                  !a                 ? MONGE_CHANGE_APPEARED
                  : same_place(a, b) ? MONGE_CHANGE_LIGHT_COLOR
                  : same_color(a, b) ? MONGE_CHANGE_LIGHT_PLACE
                                     : MONGE_CHANGE_LIGHT,
                  &b->entry);
    }
    for (uint32_t o = 0; o < p->older->light_count; o++)
        if (!p->taken[o]) add_light(c, MONGE_CHANGE_DISAPPEARED, &p->older->lights[o].entry);
}

/* Whether lights stand in another order, by which the layer of shadows has their bits. */
static bool reordered(const struct pairing *p) {
    uint32_t last = 0;
    for (uint32_t n = 0; n < p->newer->light_count; n++) {
        if (p->partner[n] == NOBODY) continue;
        if (p->partner[n] < last) return true;
        last = p->partner[n];
    }
    return false;
}

/* Shadows fall as before where lights have changed their colours alone. */
static bool shadows_follow(const struct conditions_change *c, const struct pairing *p) {
    if (p->partner && reordered(p)) return true;
    for (uint32_t i = 0; i < c->count; i++)
        if (c->list[i].object && c->list[i].kind != MONGE_CHANGE_LIGHT_COLOR) return true;
    return false;
}

/* ---- Settings ---- */

static const char *value_of(const struct layer_conditions *c, const char *name) {
    for (uint32_t i = 0; i < c->setting_count; i++)
        if (strcmp(c->settings[i].name, name) == 0) return c->settings[i].value;
    return NULL;
}

/* Of the background only that it changed: it is seen. */
static struct monge_change setting_change(const char *name, const char *older, const char *newer) {
    if (strcmp(name, "background") == 0) return (struct monge_change){.kind = MONGE_CHANGE_SHADING};
    return (struct monge_change){
        .kind = MONGE_CHANGE_SETTING, .setting = name, .older = older, .newer = newer};
}

static void list_settings(struct conditions_change *c, const struct layer_conditions *older,
                          const struct layer_conditions *newer) {
    for (uint32_t i = 0; i < newer->setting_count; i++) {
        const char *name = newer->settings[i].name, *is = newer->settings[i].value,
                   *was = value_of(older, name);
        if (was && strcmp(was, is) != 0) c->list[c->count++] = setting_change(name, was, is);
    }
}

struct conditions_change conditions_change(const struct layer_conditions *older,
                                           const struct layer_conditions *newer, struct arena *arena) {
    const size_t most = (size_t)older->light_count + newer->light_count + newer->setting_count + 1;
    struct conditions_change c = {.list = arena_array(arena, most, sizeof *c.list)};
    struct pairing p = {.older = older, .newer = newer};
    if (older->lights && newer->lights) {
        pair_lights(&p, arena);
        list_lights(&c, &p);
    }
    list_settings(&c, older, newer);
    if (c.count > 0) c.follow |= 1u << MONGE_CHANGE_SHADING;
    if (c.count > 0 && shadows_follow(&c, &p)) c.follow |= 1u << MONGE_CHANGE_SHADOW;
    return c;
}
