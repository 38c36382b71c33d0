#include "render/examine.h"

#include <stdlib.h>

#include "render/camera.h"
#include "shape/range.h"

struct examination {
    const struct scene *scene;
    const struct accel *accel;
    struct arena *arena;
    struct diagnostics *diag;
    struct view view;
    uint32_t *placed;          /* how many primitives each origin has placed, in all sets */
    struct accel_watch *watch; /* where it has stopped nothing is known of what is around a point */
};

static struct span span_of(const struct examination *e, uint32_t origin) {
    return origins_span(&e->scene->origins, origin);
}

/* "`king`", or "a sphere". */
static const char *name_of(const struct examination *e, uint32_t origin) {
    const struct origin *o = &e->scene->origins.list[origin];
    return o->name ? arena_format(e->arena, "`%s`", o->name) : scene_kind_title(o->kind);
}

static bool is_clear(const struct scene *scene, uint32_t material) {
    return vec3_max_abs(scene->materials[material].refraction) > 0.0;
}

/* ---- Solids around a point ---- */

enum { MAX_SOLIDS = 16 };

/* The opaque solids that a point is inside of; past the last there is room for, further ones are left out. */
struct solids {
    int count;
    struct occurrence which[MAX_SOLIDS];
    uint32_t origin[MAX_SOLIDS];
};

static void add_solid(void *context, const struct hit *hit, ray in_set) {
    struct solids *s = context;
    if (s->count == MAX_SOLIDS || !shape_contains(hit->set, hit->ref, in_set.org)) return;
    s->which[s->count] = hit->which;
    s->origin[s->count++] = hit->set->info[primitives_number(hit->set, hit->ref)].origin;
}

static void solids_at(const struct examination *e, vec3 point, struct solids *out) {
    out->count = 0;
    accel_around_opaque(e->accel, e->watch, (ray){point, {0, 0, 1}}, add_solid, out);
}

static bool is_among(const struct occurrence *which, const struct solids *solids) {
    for (int i = 0; i < solids->count; i++)
        if (occurrence_equal(which, &solids->which[i])) return true;
    return false;
}

static box3 bounds_of(const struct examination *e, uint32_t number) {
    const struct primitives *p = &e->scene->primitives;
    const primitive_ref ref = p->info[number].ref;
    if (primitive_ref_kind(ref) == PRIMITIVE_INSTANCE)
        return accel_placed_bounds(e->accel, primitive_ref_index(ref));
    return shape_bounds(p, ref);
}

static vec3 corner_of(box3 box, int i) {
    return (vec3){i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                  i & 4 ? box.max.z : box.min.z};
}

/* ---- What is in view ---- */

/* What lies behind one of them, dot(inward, p) < at, is not seen. */
struct wall {
    vec3 inward;
    double at;
};

enum { WALLS = 5 }; /* the first: behind the camera */

static struct wall side_wall(const struct view *view, vec3 edge, double sign) {
    const vec3 axis = vec3_scale(vec3_normalize(edge), -sign);
    if (view->orthographic) return (struct wall){axis, vec3_dot(axis, view->eye) - vec3_length(edge)};
    const vec3 inward = vec3_madd(axis, vec3_length(edge), view->forward);
    return (struct wall){inward, vec3_dot(inward, view->eye)};
}

static void walls_of(const struct view *view, struct wall walls[WALLS]) {
    walls[0] = (struct wall){view->forward, vec3_dot(view->forward, view->eye)};
    walls[1] = side_wall(view, view->right, 1.0);
    walls[2] = side_wall(view, view->right, -1.0);
    walls[3] = side_wall(view, view->up, 1.0);
    walls[4] = side_wall(view, view->up, -1.0);
}

static double box_support(box3 box, vec3 direction) {
    double most = -INFINITY;
    for (int i = 0; i < 8; i++) most = box3_upper(most, vec3_dot(corner_of(box, i), direction));
    return most;
}

static double support_of(const struct examination *e, uint32_t number, vec3 direction) {
    const struct primitives *p = &e->scene->primitives;
    const primitive_ref ref = p->info[number].ref;
    if (primitive_ref_kind(ref) != PRIMITIVE_INSTANCE) return shape_support(p, ref, direction);
    const box3 box = bounds_of(e, number);
    return box3_is_empty(box) ? -INFINITY : box3_is_bounded(box) ? box_support(box, direction) : INFINITY;
}

/* Whether one of the rays at the corners of the picture, and so any at all, goes towards the endless plane. */
static bool sees_plane(const struct view *view, const struct flat *plane) {
    for (int i = 0; i < 4; i++) {
        const ray r = affine_ray(&plane->object_from_world, camera_ray(view, i & 1, i >> 1));
        if (r.org.z * r.dir.z < 0.0) return true;
    }
    return false;
}

/* Whether the primitive may be in view; if not, whether it is behind the camera. */
static bool may_be_seen(const struct examination *e, const struct wall walls[WALLS], uint32_t number,
                        bool *behind) {
    const struct primitives *p = &e->scene->primitives;
    const primitive_ref ref = p->info[number].ref;
    *behind = false;
    if (primitive_ref_kind(ref) == PRIMITIVE_FLAT && p->flats[primitive_ref_index(ref)].outline == FLAT_PLANE)
        return sees_plane(&e->view, &p->flats[primitive_ref_index(ref)]);
    for (int i = 0; i < WALLS; i++)
        if (support_of(e, number, walls[i].inward) < walls[i].at) {
            *behind = i == 0;
            return false;
        }
    return true;
}

static void help_look(const struct examination *e, struct diagnostic *d) {
    const box3 bounds = accel_extent(e->accel);
    if (!box3_is_bounded(bounds)) {
        diag_help(e->diag, d, "nothing has a middle to look at: give the camera an `eye` and a `look_at`");
        return;
    }
    const vec3 c = box3_center(bounds);
    const bool there =
        vec3_length(vec3_sub(c, e->view.eye)) > 1e-6 * vec3_length(vec3_sub(bounds.max, bounds.min));
    if (there)
        diag_help(e->diag, d, "`look_at: [%.3g, %.3g, %.3g]` is the middle of what there is", c.x, c.y, c.z);
}

/* Returns whether something may be in view. */
static bool examine_view(const struct examination *e) {
    const struct primitives *p = &e->scene->primitives;
    struct wall walls[WALLS];
    bool all_behind = true, behind;
    walls_of(&e->view, walls);
    for (uint32_t i = 0; i < p->count; i++) {
        if (may_be_seen(e, walls, i, &behind)) return true;
        all_behind &= behind;
    }
    if (p->count == 0) return false; /* told while it was built */
    const char *where = all_behind ? "everything is behind the camera"
                                   : "everything is beside or behind what the camera sees";
    struct diagnostic *d = diag_warning(e->diag, e->scene->camera_span, "nothing-in-view",
                                        "%s: only the background will be seen", where);
    help_look(e, d);
    return false;
}

/* ---- The camera inside of a solid ---- */

static bool is_inside(const struct examination *e, vec3 point, const struct occurrence *which) {
    struct solids solids;
    solids_at(e, point, &solids);
    return is_among(which, &solids);
}

static bool box_is_inside(const struct examination *e, box3 box, const struct occurrence *which) {
    if (!box3_is_bounded(box) || !is_inside(e, box3_center(box), which)) return false;
    for (int i = 0; i < 8; i++)
        if (!is_inside(e, corner_of(box, i), which)) return false;
    return true;
}

/* Whether the solid is meant to be lived in: there is a light or an object inside as well. */
static bool is_room(const struct examination *e, const struct occurrence *which) {
    const struct scene *scene = e->scene;
    for (uint32_t i = 0; i < scene->light_count; i++)
        if (scene->lights[i].kind == LIGHT_POINT && is_inside(e, scene->lights[i].at, which)) return true;
    for (uint32_t i = 0; i < scene->primitives.count; i++)
        if (i != which->number[0] && box_is_inside(e, bounds_of(e, i), which)) return true;
    return false;
}

static void examine_eye(const struct examination *e, const struct solids *around_eye) {
    for (int i = 0; i < around_eye->count; i++) {
        if (is_room(e, &around_eye->which[i]) || e->watch->stop) continue;
        const uint32_t origin = around_eye->origin[i];
        struct diagnostic *d = diag_warning(e->diag, e->scene->eye_span, "camera-inside",
                                            "the camera is inside of %s: only that from within will be seen",
                                            name_of(e, origin));
        diag_help(e->diag, d, "move `eye` out of it");
        diag_related(e->diag, d, span_of(e, origin), "the solid is here");
        return;
    }
}

/* ---- Without effect: objects ---- */

static void examine_empty(const struct examination *e, const struct primitives *p) {
    const struct quadric_form *before = NULL;
    for (uint32_t i = 0; i < p->quadric_count; i++) {
        const struct quadric_form *form = p->quadrics[i].form;
        if (form == before || !form_is_empty(form)) continue;
        before = form;
        const bool cut = form->clip.min.x > -INFINITY;
        struct diagnostic *d = diag_warning(
            e->diag, span_of(e, p->info[p->quadric_number[i]].origin), "no-effect",
            "the quadric has no surface%s: nothing will be seen of it", cut ? " within its `bounds`" : "");
        diag_help(e->diag, d, "a sphere is {xx: 1, yy: 1, zz: 1, constant: -1}: mind the sign of `constant`");
    }
}

/* A primitive by its place and shape. */
struct key {
    struct hash hash;
    uint32_t number;
};

static int key_order(const void *a, const void *b) {
    const struct key *x = a, *y = b;
    if (x->hash.high != y->hash.high) return x->hash.high < y->hash.high ? -1 : 1;
    if (x->hash.low != y->hash.low) return x->hash.low < y->hash.low ? -1 : 1;
    return x->number < y->number ? -1 : x->number > y->number;
}

/* What is placed by loops and templates may well coincide; what stands for itself should not. */
static bool stands_alone(const struct examination *e, const struct primitive_info *info) {
    return e->placed[info->origin] == 1 && primitive_ref_kind(info->ref) != PRIMITIVE_INSTANCE;
}

enum { MAX_EXAMINED = 1 << 18 }; /* objects, of a scene with more of them each one says little */

/* Pairs of objects of the same shape at the same place: the first one listed is seen. */
static void examine_twins(const struct examination *e) {
    const struct primitives *p = &e->scene->primitives;
    if (p->count > MAX_EXAMINED) return;
    struct key *keys = arena_array(e->arena, p->count + 1, sizeof *keys);
    uint32_t count = 0;
    for (uint32_t i = 0; i < p->count; i++) {
        if (!stands_alone(e, &p->info[i])) continue;
        keys[count].number = i;
        hash_begin(&keys[count].hash);
        shape_hash(p, p->info[i].ref, &keys[count++].hash);
    }
    qsort(keys, count, sizeof *keys, key_order);
    for (uint32_t i = 1; i < count; i++) {
        const struct primitive_info *first = &p->info[keys[i - 1].number], *second = &p->info[keys[i].number];
        if (keys[i].hash.high != keys[i - 1].hash.high || keys[i].hash.low != keys[i - 1].hash.low) continue;
        if (is_clear(e->scene, first->material)) continue;
        struct diagnostic *d = diag_warning(e->diag, span_of(e, second->origin), "no-effect",
                                            "this is just where %s of the same size is: it will not be seen",
                                            name_of(e, first->origin));
        diag_help(e->diag, d, "remove or move it");
        diag_related(e->diag, d, span_of(e, first->origin), "the other one is here");
    }
}

/* Whether all of the box lies inside the solid. */
static bool holds_box(const struct primitives *p, primitive_ref ref, box3 box) {
    const uint32_t index = primitive_ref_index(ref);
    if (primitive_ref_kind(ref) == PRIMITIVE_QUADRIC) {
        const struct quadric *q = &p->quadrics[index];
        box3 around = BOX3_EMPTY;
        for (int i = 0; i < 8; i++)
            around = box3_add_point(around, affine_point(&q->object_from_world, corner_of(box, i)));
        return form_holds_box(q->form, around);
    }
    for (int i = 0; i < 8; i++)
        if (!shape_contains(p, ref, corner_of(box, i))) return false;
    return primitive_ref_kind(ref) == PRIMITIVE_SPHERE;
}

/* Objects that lie inside of opaque solids, where no ray comes from outside. */
static void examine_hidden(const struct examination *e, const struct solids *around_eye) {
    const struct primitives *p = &e->scene->primitives;
    struct solids solids;
    if (p->count > MAX_EXAMINED) return;
    for (uint32_t i = 0; i < p->count; i++) {
        const box3 box = stands_alone(e, &p->info[i]) ? shape_bounds(p, p->info[i].ref) : BOX3_ALL;
        if (!box3_is_bounded(box)) continue;
        solids_at(e, box3_center(box), &solids);
        for (int k = 0; k < solids.count; k++) {
            const uint32_t other = solids.which[k].number[0];
            if (solids.which[k].depth || other == i || is_among(&solids.which[k], around_eye)) continue;
            if (!holds_box(p, p->info[other].ref, box)) continue;
            struct diagnostic *d =
                diag_warning(e->diag, span_of(e, p->info[i].origin), "no-effect",
                             "this is all inside of %s, which is opaque: it will not be seen",
                             name_of(e, p->info[other].origin));
            diag_related(e->diag, d, span_of(e, p->info[other].origin), "the solid around is here");
            break;
        }
    }
}

/* ---- Without effect: lights ---- */

/* Whether a material that is used gives it back. */
static bool is_given_back(const struct scene *scene, const struct light *ambient) {
    for (uint32_t i = 0; i < scene->material_count; i++)
        if (scene->material_info[i].given &&
            vec3_max_abs(vec3_mul(scene->materials[i].ambient, ambient->color)) > 0.0)
            return true;
    return false;
}

/* Beside others: of ambient light alone everything is black, which has been told. */
static void examine_ambient(const struct examination *e, uint32_t i) {
    bool beside = false;
    for (uint32_t k = 0; k < e->scene->light_count; k++) beside |= e->scene->lights[k].kind != LIGHT_AMBIENT;
    if (!beside || is_given_back(e->scene, &e->scene->lights[i])) return;
    diag_help(e->diag,
              diag_warning(e->diag, e->scene->light_spans[i], "no-effect",
                           "no material gives ambient light of this colour back"),
              "give a material an `ambient` colour, or remove the light");
}

static void examine_light(const struct examination *e, uint32_t i, const struct solids *around_eye) {
    const struct light *light = &e->scene->lights[i];
    const struct span span = e->scene->light_spans[i];
    if (!(vec3_max_abs(light->color) > 0.0)) {
        diag_help(e->diag, diag_warning(e->diag, span, "no-effect", "the light is black: it gives no light"),
                  "give it a `color`, or remove it");
        return;
    }
    struct solids solids;
    if (light->kind == LIGHT_AMBIENT) examine_ambient(e, i);
    if (light->kind != LIGHT_POINT || e->scene->settings.shadow > 0.0) return;
    solids_at(e, light->at, &solids);
    for (int k = 0; k < solids.count; k++) {
        if (is_among(&solids.which[k], around_eye)) continue;
        struct diagnostic *d = diag_warning(
            e->diag, span, "no-effect", "the light is inside of %s, which is opaque: nothing of it comes out",
            name_of(e, solids.origin[k]));
        diag_help(e->diag, d, "move it out, or make the solid clear by `refraction`");
        diag_related(e->diag, d, span_of(e, solids.origin[k]), "the solid is here");
        return;
    }
}

/* ---- All of it ---- */

static void count_placed(struct examination *e, const struct primitives *p) {
    for (uint32_t i = 0; i < p->count; i++) e->placed[p->info[i].origin]++;
}

void examine_scene(const struct scene *scene, const struct accel *accel, bool moves, struct arena *arena,
                   struct diagnostics *diag) {
    struct accel_watch watch = {.cancel = NULL};
    struct examination e = {.scene = scene, .accel = accel, .arena = arena, .diag = diag, .watch = &watch};
    struct solids around_eye = {.count = 0};
    e.view = camera_view(scene, accel, scene->settings.width, scene->settings.height);
    e.placed = arena_array(arena, scene->origins.count + 1, sizeof *e.placed);
    count_placed(&e, &scene->primitives);
    for (uint32_t i = 0; i < scene->geometry_count; i++) count_placed(&e, &scene->geometries[i]);

    solids_at(&e, e.view.eye, &around_eye);
    if (examine_view(&e) && scene->camera.has_eye) examine_eye(&e, &around_eye);
    examine_empty(&e, &scene->primitives);
    for (uint32_t i = 0; i < scene->geometry_count; i++) examine_empty(&e, &scene->geometries[i]);
    if (moves) return;
    examine_twins(&e);
    if (watch.stop) return;
    examine_hidden(&e, &around_eye);
    for (uint32_t i = 0; i < scene->light_count; i++) examine_light(&e, i, &around_eye);
}
