#include "image/changes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "image/camera_change.h"
#include "image/conditions_change.h"
#include "image/material_change.h"

enum { OLDER, NEWER, SIDES };

enum { FEW_OBJECTS = 4 /* that follow from what else has changed: more are summed up */ };

#define NOBODY UINT32_MAX /* a pixel without a cause; an entry without a partner */

/* An object in both pictures, or in one of them. */
struct track {
    const struct monge_entry *entry[SIDES]; /* NULL: nothing of it is seen there */
    bool has_inside;                        /* a pixel of it is not at an edge, in either picture */
    bool other_material;                    /* somewhere; or whether it is the same is not known */
    uint64_t firm[MONGE_CHANGES];           /* pixels that accuse it by themselves */
    uint64_t pixels[MONGE_CHANGES];
    struct monge_region bounds[MONGE_CHANGES];
};

struct inquiry {
    const struct monge_layers *layers[SIDES];
    const uint8_t *differs; /* NULL: not known */
    struct arena *arena;
    uint32_t width, height;
    struct track *tracks; /* 0: the background */
    uint32_t track_count;
    uint32_t *object[SIDES]; /* the track of each pixel */
    uint32_t *cause;         /* the track that is the cause of a difference, or NOBODY */
    uint8_t *kind;           /* enum monge_change_kind of that */
    struct conditions_change conditions;
};

static bool both(const struct inquiry *c, enum monge_layer layer) {
    return (c->layers[OLDER]->set & c->layers[NEWER]->set) >> layer & 1;
}

/* ---- Geometry ---- */

/* Another program rounds in another way; what moves less than that is not seen. */
static bool same_depth(float a, float b) {
    return a == b || fabsf(a - b) <= 4e-6f * fmaxf(fabsf(a), fabsf(b));
}

static bool same_normal(const uint16_t *a, const uint16_t *b) {
    for (int i = 0; i < 3; i++)
        if (abs(a[i] - b[i]) > 2) return false;
    return true;
}

static bool same_geometry(const struct inquiry *c, size_t i) {
    const struct monge_layers *a = c->layers[OLDER], *b = c->layers[NEWER];
    return (!both(c, MONGE_LAYER_DEPTH) || same_depth(a->depth[i], b->depth[i])) &&
           (!both(c, MONGE_LAYER_NORMAL) || same_normal(a->normals + 3 * i, b->normals + 3 * i));
}

/* ---- Which objects are the same ----
 * By key first, which is the name or else the kind: where one of each side has it. Then those that are seen at the
 * same places, of the same key or, as it may have been renamed, of another; and at last by their order. */

struct matching {
    struct inquiry *inquiry;
    const struct layer_entries *entries[SIDES];
    uint32_t *partner[SIDES]; /* by index of entry: that of the other side, or NOBODY */
    uint32_t *alike[SIDES];   /* by index of entry: a number for its key, the same on both sides */
    uint32_t key_count;
};

/* An entry by its key. */
struct keyed {
    const struct monge_entry *entry;
    uint32_t *number; /* of the key */
};

static int compare_keys(const void *a, const void *b) {
    const struct monge_entry *p = ((const struct keyed *)a)->entry, *q = ((const struct keyed *)b)->entry;
    if (!p->name != !q->name) return p->name ? -1 : 1;
    return p->name ? strcmp(p->name, q->name) : strcmp(p->kind, q->kind);
}

static void number_keys(struct matching *m) {
    const uint32_t total = m->entries[OLDER]->count + m->entries[NEWER]->count;
    struct keyed *sorted = arena_array(m->inquiry->arena, (size_t)total + 1, sizeof *sorted), *to = sorted;
    for (int side = 0; side < SIDES; side++)
        for (uint32_t i = 0; i < m->entries[side]->count; i++)
            *to++ = (struct keyed){&m->entries[side]->list[i], &m->alike[side][i]};
    qsort(sorted, total, sizeof *sorted, compare_keys);
    for (uint32_t i = 0; i < total; i++) {
        m->key_count += i > 0 && compare_keys(&sorted[i - 1], &sorted[i]) != 0;
        *sorted[i].number = m->key_count;
    }
    m->key_count++;
}

static void match(struct matching *m, uint32_t older, uint32_t newer) {
    m->partner[OLDER][older] = newer;
    m->partner[NEWER][newer] = older;
}

static bool is_free(const struct matching *m, int side, uint32_t index) {
    return m->partner[side][index] == NOBODY;
}

static void match_single_keys(struct matching *m) {
    struct arena *arena = m->inquiry->arena;
    uint32_t *often[SIDES], *which[SIDES];
    for (int side = 0; side < SIDES; side++) {
        often[side] = arena_array(arena, m->key_count, sizeof *often[side]);
        which[side] = arena_array(arena, m->key_count, sizeof *which[side]);
        for (uint32_t i = 0; i < m->entries[side]->count; i++) {
            often[side][m->alike[side][i]]++;
            which[side][m->alike[side][i]] = i;
        }
    }
    for (uint32_t key = 0; key < m->key_count; key++)
        if (often[OLDER][key] == 1 && often[NEWER][key] == 1) match(m, which[OLDER][key], which[NEWER][key]);
}

/* Pixels that show the same geometry of two entries. */
struct overlap {
    uint32_t older, newer;
    uint64_t pixels;
};

static int compare_pairs(const void *a, const void *b) {
    const struct overlap *p = a, *q = b;
    if (p->older != q->older) return p->older < q->older ? -1 : 1;
    return (p->newer > q->newer) - (p->newer < q->newer);
}

static int compare_overlaps(const void *a, const void *b) {
    const struct overlap *p = a, *q = b;
    if (p->pixels != q->pixels) return p->pixels > q->pixels ? -1 : 1;
    return compare_pairs(a, b);
}

/* Gathers runs of equal pairs into the first of each; the count of what is left. */
static size_t merge_overlaps(struct overlap *list, size_t count) {
    size_t kept = 0;
    qsort(list, count, sizeof *list, compare_pairs);
    for (size_t i = 0; i < count; i++) {
        if (kept > 0 && compare_pairs(&list[kept - 1], &list[i]) == 0)
            list[kept - 1].pixels += list[i].pixels;
        else
            list[kept++] = list[i];
    }
    return kept;
}

/* Runs of pixels within a row are one pair from the start: a picture has few of them. */
static struct overlap *list_overlaps(const struct matching *m, size_t *count) {
    const struct inquiry *c = m->inquiry;
    const size_t pixels = (size_t)c->width * c->height;
    size_t room = 256;
    struct overlap *list = arena_array(c->arena, room, sizeof *list);
    *count = 0;
    for (size_t i = 0; i < pixels; i++) {
        const uint32_t a = c->object[OLDER][i], b = c->object[NEWER][i];
        if (!a || !b || !is_free(m, OLDER, a - 1) || !is_free(m, NEWER, b - 1) || !same_geometry(c, i))
            continue;
        struct overlap *last = *count ? &list[*count - 1] : NULL;
        if (last && last->older == a - 1 && last->newer == b - 1) {
            last->pixels++;
            continue;
        }
        if (*count == room) {
            list = arena_resize(c->arena, list, room * sizeof *list, 2 * room * sizeof *list);
            room *= 2;
        }
        list[(*count)++] = (struct overlap){a - 1, b - 1, 1};
    }
    *count = merge_overlaps(list, *count);
    qsort(list, *count, sizeof *list, compare_overlaps);
    return list;
}

static void match_overlaps(struct matching *m) {
    size_t count;
    const struct overlap *list = list_overlaps(m, &count);
    for (int renamed = 0; renamed < 2; renamed++)
        for (size_t i = 0; i < count; i++) {
            const uint32_t a = list[i].older, b = list[i].newer;
            if (is_free(m, OLDER, a) && is_free(m, NEWER, b) &&
                (renamed || m->alike[OLDER][a] == m->alike[NEWER][b]))
                match(m, a, b);
        }
}

static void match_in_order(struct matching *m) {
    const uint32_t count[SIDES] = {m->entries[OLDER]->count, m->entries[NEWER]->count};
    uint32_t *next = arena_array(m->inquiry->arena, m->key_count, sizeof *next); /* newer one to look at */
    for (uint32_t a = 0; a < count[OLDER]; a++) {
        if (!is_free(m, OLDER, a)) continue;
        const uint32_t key = m->alike[OLDER][a];
        while (next[key] < count[NEWER] &&
               (m->alike[NEWER][next[key]] != key || !is_free(m, NEWER, next[key])))
            next[key]++;
        if (next[key] < count[NEWER]) match(m, a, next[key]);
    }
}

/* Makes the tracks, and gives each pixel its own. */
static void make_tracks(struct inquiry *c, const struct matching *m) {
    const uint32_t older = m->entries[OLDER]->count, newer = m->entries[NEWER]->count;
    uint32_t *track_of = arena_array(c->arena, newer + 1, sizeof *track_of);
    c->tracks = arena_array(c->arena, older + newer + 1, sizeof *c->tracks);
    c->track_count = older + 1;
    for (uint32_t i = 0; i < older; i++) {
        c->tracks[i + 1].entry[OLDER] = &m->entries[OLDER]->list[i];
        if (!is_free(m, OLDER, i)) track_of[m->partner[OLDER][i]] = i + 1;
    }
    for (uint32_t i = 0; i < newer; i++) {
        if (is_free(m, NEWER, i)) track_of[i] = c->track_count++;
        c->tracks[track_of[i]].entry[NEWER] = &m->entries[NEWER]->list[i];
    }
    for (size_t i = 0; i < (size_t)c->width * c->height; i++)
        if (c->object[NEWER][i]) c->object[NEWER][i] = track_of[c->object[NEWER][i] - 1];
}

static void match_objects(struct inquiry *c) {
    struct matching m = {.inquiry = c};
    for (int side = 0; side < SIDES; side++) {
        m.entries[side] = &c->layers[side]->entries[MONGE_LAYER_OBJECT];
        const uint32_t count = m.entries[side]->count;
        m.partner[side] = arena_array(c->arena, count + 1, sizeof *m.partner[side]);
        m.alike[side] = arena_array(c->arena, count + 1, sizeof *m.alike[side]);
        for (uint32_t i = 0; i < count; i++) m.partner[side][i] = NOBODY;
    }
    number_keys(&m);
    match_single_keys(&m);
    match_overlaps(&m);
    match_in_order(&m);
    make_tracks(c, &m);
}

/* The index of each pixel's entry, from 1; 0 in the background. False where there is a number that the table does
 * not have. */
static bool index_objects(struct inquiry *c, int side) {
    const struct monge_layers *layers = c->layers[side];
    const struct monge_entry *list = layers->entries[MONGE_LAYER_OBJECT].list, *last = NULL;
    for (size_t i = 0; i < layers_pixels(layers); i++) {
        const uint32_t id = layers->ids[MONGE_LAYER_OBJECT][i];
        if (!id) continue;
        if (!last || last->id != id) last = monge_layers_entry(layers, MONGE_LAYER_OBJECT, id);
        if (!last) return false;
        c->object[side][i] = (uint32_t)(last - list) + 1;
    }
    return true;
}

/* ---- Edges ---- */

/* The pixels around one, and itself. */
struct around {
    uint32_t x0, y0, x1, y1;
};

static struct around around_of(const struct inquiry *c, uint32_t x, uint32_t y) {
    return (struct around){x ? x - 1 : 0, y ? y - 1 : 0, x + 1 < c->width ? x + 1 : x,
                           y + 1 < c->height ? y + 1 : y};
}

/* Whether another object is beside the pixel, in either picture. */
static bool at_edge(const struct inquiry *c, uint32_t x, uint32_t y) {
    const struct around n = around_of(c, x, y);
    const uint32_t own = c->object[OLDER][(size_t)y * c->width + x];
    for (uint32_t v = n.y0; v <= n.y1; v++)
        for (uint32_t u = n.x0; u <= n.x1; u++) {
            const size_t i = (size_t)v * c->width + u;
            if (c->object[OLDER][i] != own || c->object[NEWER][i] != own) return true;
        }
    return false;
}

/* Whether a shadow ends beside the pixel, in either picture. */
static bool at_shadow_edge(const struct inquiry *c, uint32_t x, uint32_t y) {
    const struct around n = around_of(c, x, y);
    const size_t at = (size_t)y * c->width + x;
    if (!both(c, MONGE_LAYER_SHADOW)) return false;
    for (int side = 0; side < SIDES; side++) {
        const uint64_t *lights = c->layers[side]->lights;
        for (uint32_t v = n.y0; v <= n.y1; v++)
            for (uint32_t u = n.x0; u <= n.x1; u++)
                if (lights[(size_t)v * c->width + u] != lights[at]) return true;
    }
    return false;
}

static void find_insides(struct inquiry *c) {
    for (uint32_t y = 0; y < c->height; y++)
        for (uint32_t x = 0; x < c->width; x++) {
            struct track *track = &c->tracks[c->object[OLDER][(size_t)y * c->width + x]];
            if (!track->has_inside && !at_edge(c, x, y)) track->has_inside = true;
        }
}

/* ---- Causes ---- */

/* Of two objects that stand at a pixel before and after: the one in front has come, or gone. */
static uint32_t one_in_front(const struct inquiry *c, size_t i) {
    const uint32_t a = c->object[OLDER][i], b = c->object[NEWER][i];
    if (!a || !b) return a ? a : b;
    if (both(c, MONGE_LAYER_DEPTH)) return c->layers[OLDER]->depth[i] < c->layers[NEWER]->depth[i] ? a : b;
    return c->tracks[b].entry[OLDER] ? a : b;
}

/* Why a pixel of an object that has not moved is of another colour. */
static enum monge_change_kind kind_of(const struct inquiry *c, size_t i) {
    const enum material_change materials = material_change(c->layers[OLDER], c->layers[NEWER], i);
    if (materials == OTHER_MATERIAL) return MONGE_CHANGE_MATERIAL;
    if (materials != SAME_MATERIAL) c->tracks[c->object[NEWER][i]].other_material = true;
    const bool shadow =
        both(c, MONGE_LAYER_SHADOW) && c->layers[OLDER]->lights[i] != c->layers[NEWER]->lights[i];
    return shadow ? MONGE_CHANGE_SHADOW : MONGE_CHANGE_SHADING;
}

static bool looks_different(const struct inquiry *c, size_t i) {
    return c->differs ? c->differs[i]
                      : material_change(c->layers[OLDER], c->layers[NEWER], i) == OTHER_MATERIAL;
}

static void accuse(struct inquiry *c, size_t i, uint32_t track, enum monge_change_kind kind) {
    c->cause[i] = track;
    c->kind[i] = (uint8_t)kind;
}

/* Each pixel by itself. */
static void find_causes(struct inquiry *c) {
    for (uint32_t y = 0; y < c->height; y++)
        for (uint32_t x = 0; x < c->width; x++) {
            const size_t i = (size_t)y * c->width + x;
            const uint32_t a = c->object[OLDER][i];
            c->cause[i] = NOBODY;
            if (a != c->object[NEWER][i])
                accuse(c, i, one_in_front(c, i), MONGE_CHANGE_GEOMETRY);
            else if (a && !same_geometry(c, i))
                accuse(c, i, a, MONGE_CHANGE_GEOMETRY);
            else if (looks_different(c, i))
                accuse(c, i, a, kind_of(c, i));
            if (c->cause[i] == NOBODY) continue;
            struct track *track = &c->tracks[c->cause[i]];
            if (c->kind[i] == MONGE_CHANGE_GEOMETRY || !track->has_inside ||
                (!at_edge(c, x, y) && (c->kind[i] != MONGE_CHANGE_SHADING || !at_shadow_edge(c, x, y))))
                track->firm[c->kind[i]]++;
        }
}

static enum monge_change_kind main_kind(const struct track *track) {
    enum monge_change_kind best = 0;
    for (enum monge_change_kind kind = 0; kind < MONGE_CHANGES; kind++)
        if (track->firm[kind] > track->firm[best]) best = kind;
    return best;
}

/* The object beside a pixel that has changed most surely, or NOBODY. */
static uint32_t changed_beside(const struct inquiry *c, uint32_t x, uint32_t y) {
    const struct around n = around_of(c, x, y);
    const uint32_t own = c->object[OLDER][(size_t)y * c->width + x];
    uint32_t best = NOBODY;
    uint64_t most = 0;
    for (uint32_t v = n.y0; v <= n.y1; v++)
        for (uint32_t u = n.x0; u <= n.x1; u++)
            for (int side = 0; side < SIDES; side++) {
                const uint32_t other = c->object[side][(size_t)v * c->width + u];
                const struct track *track = &c->tracks[other];
                const uint64_t firm = track->firm[main_kind(track)];
                if (other == own || firm <= most) continue;
                best = other;
                most = firm;
            }
    return best;
}

/* A pixel that differs by its colour alone, and whose own object has no firm pixel of that kind. */
static void settle_edge(struct inquiry *c, uint32_t x, uint32_t y) {
    const size_t i = (size_t)y * c->width + x;
    const struct track *own = &c->tracks[c->cause[i]];
    if (own->firm[c->kind[i]]) return;
    if (c->kind[i] == MONGE_CHANGE_SHADING && own->firm[MONGE_CHANGE_SHADOW] && at_shadow_edge(c, x, y)) {
        c->kind[i] = MONGE_CHANGE_SHADOW;
        return;
    }
    const uint32_t other = changed_beside(c, x, y);
    if (other != NOBODY) accuse(c, i, other, main_kind(&c->tracks[other]));
}

static void settle_edges(struct inquiry *c) {
    for (uint32_t y = 0; y < c->height; y++)
        for (uint32_t x = 0; x < c->width; x++)
            if (c->cause[(size_t)y * c->width + x] != NOBODY) settle_edge(c, x, y);
}

/* ---- Counting ---- */

static void extend(struct monge_region *bounds, uint32_t x, uint32_t y) {
    if (!bounds->width) *bounds = (struct monge_region){x, y, 1, 1};
    if (x < bounds->x) bounds->width += bounds->x - x, bounds->x = x;
    if (y < bounds->y) bounds->height += bounds->y - y, bounds->y = y;
    if (x - bounds->x >= bounds->width) bounds->width = x - bounds->x + 1;
    if (y - bounds->y >= bounds->height) bounds->height = y - bounds->y + 1;
}

static void move_pixels(struct track *track, enum monge_change_kind from, enum monge_change_kind to) {
    track->pixels[to] += track->pixels[from];
    track->pixels[from] = 0;
}

/* What looks different of an object that has moved is because it has; its bounds are where it has moved. */
static void sum_up(struct track *track) {
    if (!track->pixels[MONGE_CHANGE_GEOMETRY]) return;
    move_pixels(track, MONGE_CHANGE_SHADOW, MONGE_CHANGE_GEOMETRY);
    move_pixels(track, MONGE_CHANGE_SHADING, MONGE_CHANGE_GEOMETRY);
    const enum monge_change_kind kind = !track->entry[OLDER]   ? MONGE_CHANGE_APPEARED
                                        : !track->entry[NEWER] ? MONGE_CHANGE_DISAPPEARED
                                                               : MONGE_CHANGE_GEOMETRY;
    if (kind == MONGE_CHANGE_GEOMETRY) return;
    track->bounds[kind] = track->bounds[MONGE_CHANGE_GEOMETRY];
    move_pixels(track, MONGE_CHANGE_GEOMETRY, kind);
}

static void count_pixels(struct inquiry *c) {
    for (uint32_t y = 0; y < c->height; y++)
        for (uint32_t x = 0; x < c->width; x++) {
            const size_t i = (size_t)y * c->width + x;
            if (c->cause[i] == NOBODY) continue;
            struct track *track = &c->tracks[c->cause[i]];
            track->pixels[c->kind[i]]++;
            extend(&track->bounds[c->kind[i]], x, y);
        }
    for (uint32_t t = 0; t < c->track_count; t++) sum_up(&c->tracks[t]);
}

/* Whether it can come from another object: by its shadow, or in a mirror. */
static bool can_follow(enum monge_change_kind kind) {
    return kind == MONGE_CHANGE_SHADOW || kind == MONGE_CHANGE_SHADING;
}

static int compare_changes(const void *a, const void *b) {
    const struct monge_change *p = a, *q = b;
    if (can_follow(p->kind) != can_follow(q->kind)) return can_follow(p->kind) ? 1 : -1;
    if (p->pixels != q->pixels) return p->pixels > q->pixels ? -1 : 1;
    const uint32_t m = p->object ? p->object->id : 0, n = q->object ? q->object->id : 0;
    if (m != n) return m < n ? -1 : 1;
    return (p->kind > q->kind) - (p->kind < q->kind);
}

/* The first changes, and how many there are. */
struct listing {
    struct monge_change *changes;
    size_t room, count;
};

static void put(struct listing *l, struct monge_change change) {
    if (l->count < l->room) l->changes[l->count] = change;
    l->count++;
}

/* What looks different by lights and settings alone. */
static bool follows(const struct inquiry *c, const struct track *track, enum monge_change_kind kind) {
    return track->pixels[kind] && !track->other_material && c->conditions.follow >> kind & 1;
}

static struct monge_change sum_following(const struct inquiry *c) {
    struct monge_change sum = {.kind = MONGE_CHANGE_FOLLOWING};
    for (uint32_t t = 0; t < c->track_count; t++) {
        const struct track *track = &c->tracks[t];
        const uint64_t before = sum.pixels;
        for (enum monge_change_kind kind = 0; kind < MONGE_CHANGES; kind++) {
            const struct monge_region r = track->bounds[kind];
            if (!follows(c, track, kind)) continue;
            sum.pixels += track->pixels[kind];
            extend(&sum.bounds, r.x, r.y);
            extend(&sum.bounds, r.x + r.width - 1, r.y + r.height - 1);
        }
        sum.objects += t > 0 && sum.pixels > before;
    }
    return sum;
}

/* Lights and settings, with what these have made different together. Of the background there is no more to tell. */
static void list_conditions(const struct inquiry *c, const struct monge_change *following,
                            struct listing *l) {
    for (uint32_t i = 0; i < c->conditions.count; i++) {
        struct monge_change change = c->conditions.list[i];
        change.pixels = following->pixels;
        change.bounds = following->bounds;
        put(l, change);
    }
}

/* But for those that follow where these are summed up, and the background where it does. */
static void list_objects(const struct inquiry *c, bool summed, struct listing *l) {
    struct monge_change *all = arena_array(c->arena, (size_t)c->track_count * MONGE_CHANGES, sizeof *all);
    size_t count = 0;
    for (uint32_t t = 0; t < c->track_count; t++) {
        const struct track *track = &c->tracks[t];
        for (enum monge_change_kind kind = 0; kind < MONGE_CHANGES; kind++)
            if (track->pixels[kind] && !((summed || t == 0) && follows(c, track, kind)))
                all[count++] = (struct monge_change){.kind = kind,
                                                     .object = track->entry[NEWER] ? track->entry[NEWER]
                                                                                   : track->entry[OLDER],
                                                     .pixels = track->pixels[kind],
                                                     .bounds = track->bounds[kind]};
    }
    qsort(all, count, sizeof *all, compare_changes);
    for (size_t i = 0; i < count; i++) put(l, all[i]);
}

static void list_all(const struct inquiry *c, struct listing *l) {
    const struct monge_change following = sum_following(c);
    const bool summed = following.objects > FEW_OBJECTS;
    list_conditions(c, &following, l);
    if (summed) put(l, following);
    list_objects(c, summed, l);
}

/* ---- The camera ---- */

static void list_camera(const struct inquiry *c, enum monge_change_kind kind, struct listing *l) {
    struct monge_change camera = {.kind = kind, .object = &c->layers[NEWER]->camera.entry};
    const struct monge_change others = {.kind = MONGE_CHANGE_OTHERS};
    for (uint32_t y = 0; y < c->height; y++)
        for (uint32_t x = 0; x < c->width; x++) {
            if (c->differs && !c->differs[(size_t)y * c->width + x]) continue;
            camera.pixels++;
            extend(&camera.bounds, x, y);
        }
    put(l, camera);
    list_conditions(c, &(struct monge_change){.pixels = 0}, l);
    if (camera_others_changed(c->layers[OLDER], c->layers[NEWER])) put(l, others);
}

/* ---- All of it ---- */

static bool compare(struct inquiry *c, struct listing *l) {
    const struct monge_layers *a = c->layers[OLDER], *b = c->layers[NEWER];
    const size_t pixels = (size_t)c->width * c->height;
    enum monge_change_kind camera;
    for (int side = 0; side < SIDES; side++) {
        c->object[side] = arena_array(c->arena, pixels, sizeof *c->object[side]);
        if (!index_objects(c, side)) return false;
    }
    c->conditions = conditions_change(&a->conditions, &b->conditions, c->arena);
    if (camera_change(&a->camera, &b->camera, &camera)) {
        list_camera(c, camera, l);
        return true;
    }
    c->cause = arena_array(c->arena, pixels, sizeof *c->cause);
    c->kind = arena_array(c->arena, pixels, sizeof *c->kind);
    match_objects(c);
    find_insides(c);
    find_causes(c);
    settle_edges(c);
    count_pixels(c);
    list_all(c, l);
    return true;
}

bool changes_find(const struct monge_layers *older, const struct monge_layers *newer, const uint8_t *differs,
                  struct monge_change *changes, size_t room, size_t *count) {
    jmp_buf full;
    struct arena arena = {.on_full = &full};
    struct inquiry c = {.layers = {older, newer},
                        .differs = differs,
                        .arena = &arena,
                        .width = older->region.width,
                        .height = older->region.height};
    if (!both(&c, MONGE_LAYER_OBJECT) || c.width != newer->region.width || c.height != newer->region.height)
        return false;
    if (setjmp(full)) {
        arena_free(&arena);
        return false;
    }
    struct listing list = {changes, room, 0};
    const bool done = compare(&c, &list);
    *count = list.count;
    arena_free(&arena);
    return done;
}
