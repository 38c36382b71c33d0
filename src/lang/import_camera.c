#include <string.h>

#include "base/elementary.h"
#include "lang/importer.h"

/* The book's z points away from the viewer, ours towards. */
static vec3 turn_round(vec3 v) { return (vec3){v.x, v.y, -v.z}; }

/* ---- The camera ---- */

struct book_camera {
    double width, height, fov; /* radians, over the longer side */
    vec3 from, to, up;
};

static bool read_number(struct importer *im, const struct layer *camera, const char *key, double min,
                        double max, double *out) {
    const struct place_in_book at = layer_find(camera, key);
    if (!at.node) {
        diag_error(im->diag, camera->mapping->span, "import-missing", "the camera needs `%s`", key);
        return false;
    }
    double value;
    if (!import_number(im, arena_format(im->arena, "`%s`", key), at, &value)) return false;
    *out = value;
    if (value >= min && value <= max) return true;
    diag_error(im->diag, at.node->span, "import-value", "`%s`: must be %g to %g, found %g", key, min, max,
               value);
    return false;
}

static bool read_side(struct importer *im, const struct layer *camera, const char *key, double *out) {
    if (!read_number(im, camera, key, 1, 65535, out)) return false;
    if (*out == floor(*out)) return true;
    diag_error(im->diag, layer_find(camera, key).node->span, "import-value",
               "`%s`: expected a whole number of pixels, found %g", key, *out);
    return false;
}

static bool read_point(struct importer *im, const struct layer *camera, const char *key, vec3 *out) {
    const struct place_in_book at = layer_find(camera, key);
    return !at.node || import_vec3(im, arena_format(im->arena, "`%s`", key), at, out);
}

/* As far as scene/ looks at it too. */
static bool check_view(struct importer *im, const struct layer *camera, const struct book_camera *c) {
    const vec3 view = vec3_sub(c->to, c->from);
    const bool same = !(vec3_length(view) > 0.0);
    const bool along = vec3_length(vec3_cross(vec3_normalize(view), vec3_normalize(c->up))) < 1e-6;
    if (same)
        diag_error(im->diag, camera->mapping->span, "import-view",
                   "the camera's `to` is where its `from` is");
    else if (along)
        diag_error(im->diag, camera->mapping->span, "import-view", "the camera's `up` is along its view");
    return !same && !along;
}

/* A camera without a place looks along -z from the origin, as the book's does. */
static bool read_camera(struct importer *im, const struct layer *camera, struct book_camera *c) {
    static const char *const keys[] = {"add",  "extend", "width", "height", "field-of-view",
                                       "from", "to",     "up",    NULL};
    *c = (struct book_camera){.from = {0, 0, 0}, .to = {0, 0, -1}, .up = {0, 1, 0}};
    import_check_keys(im, camera, "a camera", keys, IMPORT_NO_WORDS);
    const bool width = read_side(im, camera, "width", &c->width),
               height = read_side(im, camera, "height", &c->height);
    const bool fov = read_number(im, camera, "field-of-view", 1e-6, 3.12, &c->fov);
    const bool from = read_point(im, camera, "from", &c->from), to = read_point(im, camera, "to", &c->to);
    const bool up = read_point(im, camera, "up", &c->up);
    if (width && height && c->width * c->height > 1 << 28) {
        diag_error(im->diag, camera->mapping->span, "import-value",
                   "a picture has at most 268435456 pixels, as 16384 x 16384; this one has %g x %g", c->width,
                   c->height);
        return false;
    }
    return width && height && fov && from && to && up && check_view(im, camera, c);
}

void import_camera(struct importer *im, const struct layer *camera) {
    const struct node *before = im->camera;
    struct book_camera c;
    im->camera = camera->mapping;
    if (before) {
        struct diagnostic *d = diag_warning(im->diag, camera->mapping->span, "import-cameras",
                                            "a second camera: it replaces the first");
        diag_related(im->diag, d, before->span, "the first is here");
    }
    if (!read_camera(im, camera, &c)) return;
    const double degrees = c.fov * 57.295779513082320877, aspect = c.width / c.height;
    const double fov =
        aspect > 1.0 ? 2.0 * elementary_atan_deg(elementary_tan_deg(0.5 * degrees) / aspect) : degrees;
    text_cut(&im->view, 0);
    text_add(&im->view, "image: {size: [%g, %g], samples: 1, background: black, encoding: linear}\n", c.width,
             c.height);
    text_add(&im->view, "camera: {eye: %s, ", vec3_text(im->arena, turn_round(c.from)));
    text_add(&im->view, "look_at: %s, ", vec3_text(im->arena, turn_round(c.to)));
    text_add(&im->view, "up: %s, fov: %s}\n", vec3_text(im->arena, turn_round(c.up)),
             number_text(im->arena, tidy(fov)));
}

/* ---- Lights ---- */

/* Where the light is; of an area light, its middle. */
static bool read_place(struct importer *im, const struct layer *light, vec3 *out) {
    const struct place_in_book at = layer_find(light, "at"), corner = layer_find(light, "corner");
    const struct place_in_book u = layer_find(light, "uvec"), v = layer_find(light, "vvec");
    vec3 along_u, along_v;
    if (at.node) return import_vec3(im, "`at`", at, out);
    if (!corner.node || !u.node || !v.node) {
        diag_error(im->diag, light->mapping->span, "import-missing", "a light needs `at`");
        return false;
    }
    if (!import_vec3(im, "`corner`", corner, out) || !import_vec3(im, "`uvec`", u, &along_u) ||
        !import_vec3(im, "`vvec`", v, &along_v))
        return false;
    *out = tidy_vec3(vec3_madd(*out, 0.5, vec3_add(along_u, along_v)));
    diag_warning(im->diag, light->mapping->span, "import-area-light",
                 "area lights are not there yet: a point light in its middle stands for it");
    return true;
}

void import_light(struct importer *im, const struct layer *light) {
    static const char *const keys[] = {"add", "extend", "at", "intensity", NULL};
    static const char *const area_keys[] = {"corner", "uvec", "vvec", "usteps", "vsteps", "jitter", NULL};
    const struct place_in_book intensity = layer_find(light, "intensity");
    vec3 at, color = {1, 1, 1};
    import_check_keys(im, light, "a light", keys,
                      layer_find(light, "corner").node ? area_keys : IMPORT_NO_WORDS);
    if (!intensity.node)
        diag_error(im->diag, light->mapping->span, "import-missing", "a light needs `intensity`");
    const bool placed = read_place(im, light, &at);
    if (!intensity.node || !import_color(im, "`intensity`", intensity, &color) || !placed) return;
    im->ambient = vec3_add(im->ambient, color);
    text_add(&im->lights, "  - point: {at: %s, color: %s}\n", vec3_text(im->arena, turn_round(at)),
             vec3_text(im->arena, color));
}
