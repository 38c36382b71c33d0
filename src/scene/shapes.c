/* From the shapes of the language to primitives: each is a canonical form under a transform. The
 * parameters a person thinks in (center, from, to, ...) are a transform of their own, applied before
 * those of the node. */
#include "scene/builder.h"

#define UNIT_EXTENT(z0, z1)                                                                                  \
    {                                                                                                        \
        {-1, -1, z0}, { 1, 1, z1 }                                                                           \
    }
#define SLAB(z0, z1)                                                                                         \
    {                                                                                                        \
        {-INFINITY, -INFINITY, z0}, { INFINITY, INFINITY, z1 }                                               \
    }

/* Indexed by `open`. */
static const struct quadric_form ellipsoid_form = {
    .xx = 1,
    .yy = 1,
    .zz = 1,
    .constant = -1,
    .clip = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}},
    .extent = UNIT_EXTENT(-1, 1)};
static const struct quadric_form cylinder_form[2] = {
    {.xx = 1, .yy = 1, .constant = -1, .clip = SLAB(-0.5, 0.5), .extent = UNIT_EXTENT(-0.5, 0.5)},
    {.xx = 1,
     .yy = 1,
     .constant = -1,
     .clip = SLAB(-0.5, 0.5),
     .extent = UNIT_EXTENT(-0.5, 0.5),
     .open = true}};
static const struct quadric_form cone_form[2] = {
    {.xx = 1, .yy = 1, .zz = -1, .clip = SLAB(-1, 0), .extent = UNIT_EXTENT(-1, 0)},
    {.xx = 1, .yy = 1, .zz = -1, .clip = SLAB(-1, 0), .extent = UNIT_EXTENT(-1, 0), .open = true}};
static const struct quadric_form paraboloid_form[2] = {
    {.xx = 1, .yy = 1, .z = -1, .clip = SLAB(0, 1), .extent = UNIT_EXTENT(0, 1)},
    {.xx = 1, .yy = 1, .z = -1, .clip = SLAB(0, 1), .extent = UNIT_EXTENT(0, 1), .open = true}};
#define SQRT2_UP 1.4142135623730952
#define RIM_EXTENT                                                                                           \
    {                                                                                                        \
        {-SQRT2_UP, -SQRT2_UP, -1}, { SQRT2_UP, SQRT2_UP, 1 }                                                \
    }
static const struct quadric_form hyperboloid_form[2] = {
    {.xx = 1, .yy = 1, .zz = -1, .constant = -1, .clip = SLAB(-1, 1), .extent = RIM_EXTENT},
    {.xx = 1, .yy = 1, .zz = -1, .constant = -1, .clip = SLAB(-1, 1), .extent = RIM_EXTENT, .open = true}};
static const struct quadric_form box_form = {.constant = -1,
                                             .clip = {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}},
                                             .extent = {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}};

/* ---- Primitives ---- */

struct placement {
    struct span span; /* of the shape */
    affine world_from_object;
    uint32_t material;
};

static void add_info(struct builder *b, const struct placement *at, enum primitive_kind kind,
                     uint32_t index) {
    struct primitives *p = &b->set->primitives;
    p->info = builder_grow(b, p->info, p->count, &b->set->info_room, sizeof *p->info);
    p->info[p->count++] =
        (struct primitive_info){primitive_ref_make(kind, index), at->material, b->origin, b->object};
}

/* Room for one more primitive of a kind and its number; false when there can be no more. */
static bool make_room(struct builder *b, const struct placement *at, void **array, uint32_t **number,
                      uint32_t count, uint32_t *room, size_t size) {
    if (count >= PRIMITIVE_MAX - 1) {
        diag_error(b->diag, at->span, "limit-objects", "more than %d primitives of one kind",
                   PRIMITIVE_MAX - 1);
        return false;
    }
    uint32_t number_room = *room;
    *array = builder_grow(b, *array, count, room, size);
    *number = builder_grow(b, *number, count, &number_room, sizeof **number);
    (*number)[count] = b->set->primitives.count;
    return true;
}

static void report_out_of_range(struct builder *b, struct span span, const char *what) {
    struct diagnostic *d = diag_error(b->diag, span, "flat-transform",
                                      "%s is flattened, or its size or place is out of range", what);
    diag_help(b->diag, d, "its sizes and transforms together must lie within 1e-100 to 1e100");
}

static void add_sphere(struct builder *b, const struct placement *at, double radius) {
    struct primitives *p = &b->set->primitives;
    void *array = p->spheres;
    if (!make_room(b, at, &array, &p->sphere_number, p->sphere_count, &b->set->sphere_room,
                   sizeof *p->spheres))
        return;
    p->spheres = array;
    p->spheres[p->sphere_count] = (struct sphere){affine_column(at->world_from_object, 3), radius};
    add_info(b, at, PRIMITIVE_SPHERE, p->sphere_count++);
}

static void add_flat(struct builder *b, const struct placement *at, affine object_from_world,
                     enum flat_outline outline) {
    struct primitives *p = &b->set->primitives;
    void *array = p->flats;
    if (!make_room(b, at, &array, &p->flat_number, p->flat_count, &b->set->flat_room, sizeof *p->flats))
        return;
    p->flats = array;
    p->flats[p->flat_count] = (struct flat){object_from_world, at->world_from_object, outline};
    add_info(b, at, PRIMITIVE_FLAT, p->flat_count++);
}

static void add_quadric(struct builder *b, const struct placement *at, affine object_from_world,
                        const struct quadric_form *form) {
    struct primitives *p = &b->set->primitives;
    void *array = p->quadrics;
    if (!make_room(b, at, &array, &p->quadric_number, p->quadric_count, &b->set->quadric_room,
                   sizeof *p->quadrics))
        return;
    p->quadrics = array;
    p->quadrics[p->quadric_count] = (struct quadric){object_from_world, at->world_from_object, form};
    add_info(b, at, PRIMITIVE_QUADRIC, p->quadric_count++);
}

void instance_add(struct builder *b, struct span span, affine world_from_object, uint32_t geometry,
                  const uint32_t *materials) {
    const struct placement at = {.span = span, .world_from_object = world_from_object};
    struct primitives *p = &b->set->primitives;
    affine inverse;
    if (!affine_invert(world_from_object, &inverse)) {
        report_out_of_range(b, span, "what is placed here");
        return;
    }
    void *array = p->instances;
    if (!make_room(b, &at, &array, &p->instance_number, p->instance_count, &b->set->instance_room,
                   sizeof *p->instances))
        return;
    p->instances = array;
    p->instances[p->instance_count] = (struct instance){inverse, world_from_object, materials, geometry};
    add_info(b, &at, PRIMITIVE_INSTANCE, p->instance_count++);
}

/* ---- The parameters a person thinks in ---- */

/* Axes of length one, z along `direction` (Duff et al. 2017, Building an Orthonormal Basis,
 * Revisited); the identity for +z. */
static affine along(vec3 direction, double radius, vec3 z_axis, vec3 origin) {
    const vec3 n = vec3_normalize(direction);
    const double sign = copysign(1.0, n.z), a = -1.0 / (sign + n.z), c = n.x * n.y * a;
    const vec3 x = {1.0 + sign * n.x * n.x * a, sign * c, -sign * n.x};
    const vec3 y = {c, sign + n.y * n.y * a, -n.y};
    return affine_columns(vec3_scale(x, radius), vec3_scale(y, radius), z_axis, origin);
}

/* One end without the other leaves the default one, where hardly anybody wants it. */
static void warn_half_given(struct builder *b, const struct object_value *shape, int one, int other) {
    if (object_has(shape, one) == object_has(shape, other)) return;
    const int given = object_has(shape, one) ? one : other, missing = given == one ? other : one;
    const vec3 v = object_vec3(shape, missing);
    const char *name = shape->kind->keys[missing].name;
    struct diagnostic *d = diag_warning(b->diag, object_span(shape, given), "half-given",
                                        "`%s` is given, but not `%s`", shape->kind->keys[given].name, name);
    diag_help(b->diag, d, "`%s` is [%g, %g, %g] unless it is given", name, v.x, v.y, v.z);
}

/* A shape of revolution about the line from `from` to `to`; z_from and z_to are the heights of those
 * points in its canonical form. False when the points are one; reported. */
static bool between(struct builder *b, const struct object_value *shape, int from_key, int to_key,
                    int radius_key, double z_from, double z_to, affine *out) {
    const vec3 from = object_vec3(shape, from_key), to = object_vec3(shape, to_key);
    const vec3 axis = vec3_scale(vec3_sub(to, from), 1.0 / (z_to - z_from));
    if (!(vec3_max_abs(axis) > 0.0)) {
        const struct span span =
            object_has(shape, to_key) ? object_span(shape, to_key) : object_span(shape, from_key);
        struct diagnostic *d = diag_error(b->diag, span, "no-length",
                                          "`to` is where `from` is: %s has a length", shape->kind->title);
        if (!object_has(shape, to_key))
            diag_help(b->diag, d, "`to` is [%g, %g, %g] unless it is given", to.x, to.y, to.z);
        if (!object_has(shape, from_key))
            diag_help(b->diag, d, "`from` is [%g, %g, %g] unless it is given", from.x, from.y, from.z);
        return false;
    }
    warn_half_given(b, shape, from_key, to_key);
    const vec3 origin = vec3_madd(from, -z_from, axis);
    *out = along(axis, object_number(shape, radius_key), axis, origin);
    return true;
}

/* The box between two corners, as the image of the unit box. False when it has no inside; reported. */
static bool corners(struct builder *b, const struct object_value *box, int min_key, int max_key, box3 *out) {
    const vec3 min = object_vec3(box, min_key), max = object_vec3(box, max_key);
    *out = (box3){min, max};
    if (box->failed) return false;
    const char *axis = !(min.x < max.x) ? "x" : !(min.y < max.y) ? "y" : !(min.z < max.z) ? "z" : NULL;
    if (!axis) return true;
    const struct span span = object_has(box, max_key) ? object_span(box, max_key) : object_span(box, min_key);
    struct diagnostic *d =
        diag_error(b->diag, span, "min-over-max", "`max` must be greater than `min` in %s", axis);
    if (!object_has(box, max_key))
        diag_help(b->diag, d, "`max` is [%g, %g, %g] unless it is given", max.x, max.y, max.z);
    else if (!object_has(box, min_key))
        diag_help(b->diag, d, "`min` is [%g, %g, %g] unless it is given", min.x, min.y, min.z);
    else
        diag_help(b->diag, d, "here [%g, %g, %g] to [%g, %g, %g]", min.x, min.y, min.z, max.x, max.y, max.z);
    return false;
}

/* By a power of two, exactly: an equation means the same at any scale, but its squares must not
 * overflow or underflow. */
static void scale_terms(struct quadric_form *form) {
    double *const terms[] = {&form->xx, &form->yy, &form->zz, &form->xy, &form->yz,
                             &form->zx, &form->x,  &form->y,  &form->z,  &form->constant};
    double most = 0.0;
    int exponent;
    for (size_t i = 0; i < sizeof terms / sizeof *terms; i++) most = box3_upper(most, fabs(*terms[i]));
    frexp(most, &exponent);
    for (size_t i = 0; i < sizeof terms / sizeof *terms; i++) *terms[i] = ldexp(*terms[i], 1 - exponent);
}

static const struct quadric_form *quadric_form_build(struct builder *b, const struct object_value *quadric,
                                                     const struct object_value *bounds) {
    struct quadric_form form = {
        .clip = BOX3_ALL, .extent = BOX3_ALL, .open = object_choice(quadric, KEY_QUADRIC_OPEN)};
    double *const terms[] = {&form.xx, &form.yy, &form.zz, &form.xy, &form.yz,
                             &form.zx, &form.x,  &form.y,  &form.z};
    static const int keys[] = {KEY_QUADRIC_XX, KEY_QUADRIC_YY, KEY_QUADRIC_ZZ, KEY_QUADRIC_XY, KEY_QUADRIC_YZ,
                               KEY_QUADRIC_XZ, KEY_QUADRIC_X,  KEY_QUADRIC_Y,  KEY_QUADRIC_Z};
    bool any = quadric->failed;
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        *terms[i] = object_number(quadric, keys[i]);
        any |= *terms[i] != 0.0;
    }
    form.constant = object_number(quadric, KEY_QUADRIC_CONSTANT);
    scale_terms(&form);
    if (!any) {
        struct diagnostic *d = diag_error(b->diag, quadric->span, "no-surface",
                                          "a quadric without any of x, y and z has no surface");
        diag_help(b->diag, d, "as in {xx: 1, yy: 1, zz: 1, constant: -1}, a sphere");
        return NULL;
    }
    if (bounds) {
        if (!corners(b, bounds, KEY_BOUNDS_MIN, KEY_BOUNDS_MAX, &form.clip)) return NULL;
        form.extent = form.clip;
    }
    struct quadric_form *result = arena_alloc(b->arena, sizeof *result);
    *result = form;
    return result;
}

/* ---- One shape ---- */

/* The map from the canonical form's space to the node's, and the form of a quadric (NULL: sphere or
 * flat). False: reported. */
static bool placement_of(struct builder *b, const struct object_value *shape,
                         const struct object_value *bounds, affine *node_from_object,
                         const struct quadric_form **form) {
    *form = NULL;
    *node_from_object = AFFINE_IDENTITY;
    box3 box;
    switch ((int)(shape->kind - grammar_kinds)) {
    case KIND_SPHERE: {
        const double r = object_number(shape, KEY_SPHERE_RADIUS);
        *node_from_object = along((vec3){0, 0, 1}, r, (vec3){0, 0, r}, object_vec3(shape, KEY_SPHERE_CENTER));
        *form = &ellipsoid_form;
        return true;
    }
    case KIND_PLANE: {
        const vec3 n = object_vec3(shape, KEY_PLANE_NORMAL);
        *node_from_object = along(n, 1.0, vec3_normalize(n), object_vec3(shape, KEY_PLANE_POINT));
        return true;
    }
    case KIND_SQUARE:
        *node_from_object = affine_compose(affine_translate(object_vec3(shape, KEY_SQUARE_CENTER)),
                                           affine_scale(vec3_all(object_number(shape, KEY_SQUARE_SIZE))));
        return true;
    case KIND_DISC: {
        const vec3 n = object_vec3(shape, KEY_DISC_NORMAL);
        *node_from_object = along(n, object_number(shape, KEY_DISC_RADIUS), vec3_normalize(n),
                                  object_vec3(shape, KEY_DISC_CENTER));
        return true;
    }
    case KIND_BOX:
        *form = &box_form;
        if (!corners(b, shape, KEY_BOX_MIN, KEY_BOX_MAX, &box)) return false;
        warn_half_given(b, shape, KEY_BOX_MIN, KEY_BOX_MAX);
        *node_from_object =
            affine_compose(affine_translate(box3_center(box)), affine_scale(vec3_sub(box.max, box.min)));
        return true;
    case KIND_CYLINDER:
        *form = &cylinder_form[object_choice(shape, KEY_CYLINDER_OPEN)];
        return between(b, shape, KEY_CYLINDER_FROM, KEY_CYLINDER_TO, KEY_CYLINDER_RADIUS, -0.5, 0.5,
                       node_from_object);
    case KIND_CONE:
        *form = &cone_form[object_choice(shape, KEY_CONE_OPEN)];
        return between(b, shape, KEY_CONE_FROM, KEY_CONE_TO, KEY_CONE_RADIUS, -1, 0, node_from_object);
    case KIND_PARABOLOID:
        *form = &paraboloid_form[object_choice(shape, KEY_PARABOLOID_OPEN)];
        return between(b, shape, KEY_PARABOLOID_FROM, KEY_PARABOLOID_TO, KEY_PARABOLOID_RADIUS, 0, 1,
                       node_from_object);
    case KIND_HYPERBOLOID:
        *form = &hyperboloid_form[object_choice(shape, KEY_HYPERBOLOID_OPEN)];
        return between(b, shape, KEY_HYPERBOLOID_FROM, KEY_HYPERBOLOID_TO, KEY_HYPERBOLOID_RADIUS, -1, 1,
                       node_from_object);
    default: *form = quadric_form_build(b, shape, bounds); return *form != NULL;
    }
}

/* Whether the unit ball stays a ball, of a size and at a place that can be turned back. */
static bool is_round(affine map, double *radius) {
    return affine_is_similarity(map, radius) && *radius > 1e-100 && *radius < 1e100 &&
           vec3_max_abs(affine_column(map, 3)) < 1e100;
}

void shape_build(struct builder *b, const struct object_value *shape, const struct object_value *bounds,
                 affine world_from_node, uint32_t material) {
    const struct quadric_form *form;
    affine node_from_object, object_from_world;
    if (shape->failed) return;
    if (bounds && shape->kind != &grammar_kinds[KIND_QUADRIC]) {
        struct diagnostic *d = diag_error(b->diag, bounds->span, "bounds-of-no-quadric",
                                          "`bounds` cut a quadric; %s has none", shape->kind->title);
        diag_help(b->diag, d, "remove them, or write the shape as a `quadric`");
        return;
    }
    if (!placement_of(b, shape, bounds, &node_from_object, &form)) return;
    const struct placement at = {shape->span, affine_compose(world_from_node, node_from_object), material};
    double radius;
    if (form == &ellipsoid_form && is_round(at.world_from_object, &radius)) {
        add_sphere(b, &at, radius);
        return;
    }
    if (!affine_invert(at.world_from_object, &object_from_world)) {
        report_out_of_range(b, shape->span, shape->kind->title);
        return;
    }
    if (form)
        add_quadric(b, &at, object_from_world, form);
    else
        add_flat(b, &at, object_from_world,
                 shape->kind == &grammar_kinds[KIND_PLANE]  ? FLAT_PLANE
                 : shape->kind == &grammar_kinds[KIND_DISC] ? FLAT_DISC
                                                            : FLAT_SQUARE);
}
