#include <string.h>

#include "lang/importer.h"

/* How far the end of what is endless to one side alone stands away. */
static const double far_away = 1e5;

/* What a cylinder or cone has of the y axis; infinite unless given. */
struct extent {
    double min, max;
    bool closed;
};

static bool read_extent(struct importer *im, const struct layer *layers, struct extent *e) {
    const struct place_in_book min = layer_find(layers, "min"), max = layer_find(layers, "max");
    const struct place_in_book closed = layer_find(layers, "closed");
    *e = (struct extent){-INFINITY, INFINITY, false};
    const bool low = !min.node || import_extent(im, "`min`", min, &e->min);
    const bool high = !max.node || import_extent(im, "`max`", max, &e->max);
    const bool caps = !closed.node || import_boolean(im, "`closed`", closed, &e->closed);
    if (!low || !high || !caps) return false;
    if (e->min < e->max) return true;
    diag_warning(im->diag, layers->mapping->span, "import-empty",
                 "nothing is between `min` and `max`: left out");
    return false;
}

static bool is_endless(const struct extent *e) { return e->min == -INFINITY && e->max == INFINITY; }

/* Gives what is endless to one side an end there. */
static void end_somewhere(struct importer *im, struct text *text, int indent, const struct layer *layers,
                          struct extent *e) {
    if (isfinite(e->min) && isfinite(e->max)) return;
    if (e->max == INFINITY)
        e->max = fmax(far_away, 2.0 * e->min);
    else
        e->min = fmin(-far_away, 2.0 * e->max);
    const double end = fabs(e->max) > fabs(e->min) ? e->max : e->min;
    diag_warning(im->diag, layers->mapping->span, "import-endless",
                 "endless to one side: here it ends at y = %g", end);
    text_add(text, "%*s# Endless in the book; here it ends at y = %s.\n", indent, "",
             number_text(im->arena, end));
}

static const char *between(struct importer *im, double from, double to) {
    return arena_format(im->arena, "from: [0, %s, 0], to: [0, %s, 0]", number_text(im->arena, from),
                        number_text(im->arena, to));
}

static const char *open_key(bool open) { return open ? ", open: true" : ""; }

static bool import_cylinder(struct importer *im, struct text *text, int indent, const struct layer *layers) {
    struct extent e;
    if (!read_extent(im, layers, &e)) return false;
    if (is_endless(&e)) {
        text_add(text, "%*s- quadric: {xx: 1, zz: 1, constant: -1}\n", indent, "");
        return true;
    }
    end_somewhere(im, text, indent, layers, &e);
    text_add(text, "%*s- cylinder: {%s%s}\n", indent, "", between(im, e.min, e.max), open_key(!e.closed));
    return true;
}

/* One half of the double cone, with its apex at the origin. */
static void write_half(struct importer *im, struct text *text, int indent, double base, bool open) {
    const char *radius =
        fabs(base) == 1.0 ? "" : arena_format(im->arena, ", radius: %s", number_text(im->arena, fabs(base)));
    text_add(text, "%*s- cone: {%s%s%s}\n", indent, "", between(im, base, 0.0), radius, open_key(open));
}

/* Part of one half, without the apex: a stretch of x^2 + z^2 = y^2. */
static void write_frustum(struct importer *im, struct text *text, int indent, const struct extent *e) {
    const double radius = fmax(fabs(e->min), fabs(e->max));
    text_add(text, "%*s- quadric: {xx: 1, yy: -1, zz: 1%s}\n", indent, "", open_key(!e->closed));
    text_add(text, "%*sbounds: {min: %s, ", indent + 2, "",
             vec3_text(im->arena, (vec3){-radius, e->min, -radius}));
    text_add(text, "max: %s}\n", vec3_text(im->arena, (vec3){radius, e->max, radius}));
}

static bool import_cone(struct importer *im, struct text *text, int indent, const struct layer *layers) {
    struct extent e;
    if (!read_extent(im, layers, &e)) return false;
    if (is_endless(&e)) {
        text_add(text, "%*s- quadric: {xx: 1, yy: -1, zz: 1}\n", indent, "");
        return true;
    }
    end_somewhere(im, text, indent, layers, &e);
    if (e.min < 0.0 && e.max > 0.0) {
        text_add(text, "%*s- group:\n", indent, "");
        write_half(im, text, indent + 4, e.min, !e.closed);
        write_half(im, text, indent + 4, e.max, !e.closed);
    } else if (e.max == 0.0 || e.min == 0.0) {
        write_half(im, text, indent, e.max == 0.0 ? e.min : e.max, !e.closed);
    } else {
        write_frustum(im, text, indent, &e);
    }
    return true;
}

bool import_shape(struct importer *im, struct text *text, int indent, const char *kind,
                  const struct layer *layers) {
    static const char *const keys[] = {"add", "extend", "material", "transform", "shadow", NULL};
    static const char *const long_keys[] = {"min", "max", "closed", NULL};
    const bool cylinder = strcmp(kind, "cylinder") == 0, cone = strcmp(kind, "cone") == 0;
    import_check_keys(im, layers, arena_format(im->arena, "a %s", kind), keys,
                      cylinder || cone ? long_keys : IMPORT_NO_WORDS);
    if (cylinder) return import_cylinder(im, text, indent, layers);
    if (cone) return import_cone(im, text, indent, layers);
    const char *shape = strcmp(kind, "cube") == 0    ? "box: {min: [-1, -1, -1], max: [1, 1, 1]}"
                        : strcmp(kind, "plane") == 0 ? "plane: {normal: [0, 1, 0]}"
                                                     : "sphere: {}";
    text_add(text, "%*s- %s\n", indent, "", shape);
    return true;
}
