#include <ctype.h>
#include <string.h>
#include <strings.h>

#include "lang/importer.h"

/* A material of the book, its defaults filled in. */
struct book_material {
    vec3 color;
    const struct node *pattern;      /* that the colour stands for, or NULL */
    vec3 ambient, diffuse, specular; /* with the colour */
    double shininess, reflective, transparency, index;
};

static const struct book_material plain_material = {.color = {1, 1, 1},
                                                    .ambient = {0.1, 0.1, 0.1},
                                                    .diffuse = {0.9, 0.9, 0.9},
                                                    .specular = {0.9, 0.9, 0.9},
                                                    .shininess = 200,
                                                    .index = 1};

/* ---- Reading ---- */

/* A number that is moved into the range where it must be. */
static void read_part(struct importer *im, const struct layer *layers, const char *key, double min,
                      double max, double *out) {
    const struct place_in_book at = layer_find(layers, key);
    double value;
    if (!at.node || !import_number(im, arena_format(im->arena, "`%s`", key), at, &value)) return;
    *out = fmin(fmax(value, min), max);
    if (*out == value) return;
    const char *range = isfinite(max) ? arena_format(im->arena, "%g to %g", min, max)
                                      : arena_format(im->arena, "%g or more", min);
    diag_warning(im->diag, at.node->span, "import-range", "`%s`: must be %s here: %g becomes %g", key, range,
                 value, *out);
}

/* A part of the light, times the colour: 0 to 1 in each channel. */
static vec3 read_light(struct importer *im, const struct layer *layers, const char *key, double part,
                       vec3 color) {
    read_part(im, layers, key, 0.0, INFINITY, &part);
    const vec3 light = tidy_vec3(vec3_scale(color, part));
    if (vec3_max_abs(light) > 1.0)
        diag_warning(im->diag, layers->mapping->span, "import-range",
                     "`%s` gives back more light than there is: what is over 1 becomes 1", key);
    return (vec3){fmin(light.x, 1.0), fmin(light.y, 1.0), fmin(light.z, 1.0)};
}

static bool mean_color(struct importer *im, struct place_in_book pattern, vec3 *out);

/* A colour, or a pattern in its turn. */
static bool read_color(struct importer *im, struct place_in_book at, vec3 *out) {
    if (node_resolve(import_named(im, at).node)->kind != NODE_MAPPING)
        return import_color(im, "`colors`", at, out);
    if (!import_enter(im, at.node)) return false;
    const bool read = mean_color(im, at, out);
    import_leave(im);
    return read;
}

/* The mean of the pattern's colours. False: it has none. */
static bool mean_color(struct importer *im, struct place_in_book pattern, vec3 *out) {
    const struct place_in_book at = import_named(im, pattern);
    const struct node *n = node_resolve(at.node),
                      *colors = n->kind == NODE_MAPPING ? mapping_find(n, "colors") : NULL;
    const struct place_in_book named = {colors, at.knows};
    const struct place_in_book list = colors ? import_named(im, named) : named;
    if (!colors || node_resolve(list.node)->kind != NODE_SEQUENCE || node_resolve(list.node)->count == 0)
        return false;
    vec3 sum = {0, 0, 0}, color;
    for (const struct node *item = node_resolve(list.node)->first; item; item = item->next) {
        if (!read_color(im, (struct place_in_book){item, list.knows}, &color)) return false;
        sum = vec3_add(sum, color);
    }
    *out = vec3_scale(sum, 1.0 / node_resolve(list.node)->count);
    return true;
}

static void read_pattern(struct importer *im, struct place_in_book at, struct book_material *m) {
    const struct place_in_book pattern = import_named(im, at);
    m->pattern = pattern.node;
    if (mean_color(im, pattern, &m->color))
        diag_warning(im->diag, at.node->span, "import-pattern",
                     "patterns are not there yet: the mean of its colours stands for it");
    else
        diag_warning(im->diag, at.node->span, "import-pattern",
                     "patterns are not there yet, and this one has no list of colours: left out");
}

/* The mean of Schlick's reflectance over a ball as one sees it: that over all angles of incidence,
 * weighted by their cosines. The book takes it at each point. */
static double mean_reflectance(double index) {
    const double head_on = (1.0 - index) / (1.0 + index) * ((1.0 - index) / (1.0 + index));
    return head_on + (1.0 - head_on) / 21.0;
}

static void read_transparency(struct importer *im, const struct layer *layers, struct book_material *m) {
    const struct place_in_book at = layer_find(layers, "transparency");
    if (m->transparency > 0.0 && !im->shadow_told) {
        diag_warning(im->diag, at.node->span, "import-shadow",
                     "light passes what is transparent here: its shadow is lighter than in the book");
        im->shadow_told = true;
    }
    if (!(m->transparency > 0.0 && m->reflective > 0.0)) return;
    const double reflectance = mean_reflectance(m->index);
    m->reflective *= reflectance;
    m->transparency *= 1.0 - reflectance;
    diag_warning(im->diag, at.node->span, "import-fresnel",
                 "the book shares light between `reflective` and `transparency` by the angle; here by the "
                 "mean of that, "
                 "%.3g to %.3g",
                 reflectance, 1.0 - reflectance);
}

static struct book_material read_material(struct importer *im, const struct layer *layers) {
    static const char *const keys[] = {
        "color",      "pattern",      "ambient",          "diffuse", "specular", "shininess",
        "reflective", "transparency", "refractive-index", "extend",  NULL};
    struct book_material m = plain_material;
    const struct place_in_book color = layer_find(layers, "color"), pattern = layer_find(layers, "pattern");
    import_check_keys(im, layers, "a material", keys, IMPORT_NO_WORDS);
    if (color.node) import_color(im, "`color`", color, &m.color);
    if (pattern.node && !node_is_null(pattern.node)) read_pattern(im, pattern, &m);
    m.ambient = read_light(im, layers, "ambient", plain_material.ambient.x, m.color);
    m.diffuse = read_light(im, layers, "diffuse", plain_material.diffuse.x, m.color);
    m.specular = read_light(im, layers, "specular", plain_material.specular.x, vec3_all(1.0));
    read_part(im, layers, "shininess", 0.0, 1e6, &m.shininess);
    read_part(im, layers, "reflective", 0.0, 1.0, &m.reflective);
    read_part(im, layers, "transparency", 0.0, 1.0, &m.transparency);
    read_part(im, layers, "refractive-index", 0.1, 10.0, &m.index);
    read_transparency(im, layers, &m);
    return m;
}

/* ---- Writing ---- */

static void write_material(struct importer *im, struct text *text, int indent, const char *head,
                           const struct book_material *m) {
    struct arena *arena = im->arena;
    struct block block = {.count = 0};
    const bool glass = m->transparency > 0.0 && m->reflective > 0.0;
    block_add(&block, arena, "ambient", vec3_text(arena, m->ambient));
    block_add(&block, arena, "diffuse", vec3_text(arena, m->diffuse));
    if (vec3_max_abs(m->specular) > 0.0) {
        block_add(&block, arena, "specular", vec3_text(arena, m->specular));
        block_add(&block, arena, "shininess", number_text(arena, m->shininess));
    }
    if (m->reflective > 0.0) block_add(&block, arena, "reflection", number_text(arena, tidy(m->reflective)));
    if (m->transparency > 0.0)
        block_add(&block, arena, "refraction", number_text(arena, tidy(m->transparency)));
    if (m->transparency > 0.0) block_add(&block, arena, "index", number_text(arena, m->index));
    if (m->pattern)
        text_add(text, "%*s# In place of the pattern %s\n", indent, "", node_text(arena, m->pattern));
    if (glass)
        text_add(text, "%*s# reflection and refraction share the light by their mean over all angles.\n",
                 indent, "");
    text_block(text, indent, head, &block);
}

/* A name that needs no quotes and that no material has yet. */
static const char *new_name(struct importer *im, const char *wanted) {
    static const char *const words[] = {"null", "true", "false", "yes", "no", "on", "off", "y", "n"};
    bool odd = !isalpha((unsigned char)*wanted);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) odd |= strcasecmp(wanted, words[i]) == 0;
    char *name = arena_format(im->arena, "%s%s", odd ? "material-" : "", wanted);
    for (char *c = name; *c; c++)
        if (!isalnum((unsigned char)*c) && *c != '-' && *c != '_') *c = '_';
    const char *unique = name;
    for (int i = 2; table_find(&im->material_names, unique); i++)
        unique = arena_format(im->arena, "%s-%d", name, i);
    table_put(im->arena, &im->material_names, unique, (void *)unique);
    return unique;
}

/* The definition that a name means in the end; NULL: there is none, reported. */
static struct book_definition *material_definition(struct importer *im, struct place_in_book at) {
    for (;;) {
        struct book_definition *definition = import_definition(im, node_resolve(at.node)->text, at.knows);
        if (!definition) import_unknown_name(im, at.node, "`material`", IMPORT_NO_WORDS);
        if (!definition || node_resolve(definition->value)->kind != NODE_SCALAR) return definition;
        at = (struct place_in_book){definition->value, definition->number - 1};
    }
}

/* NULL: it is not a material; reported. */
static const char *defined_name(struct importer *im, struct place_in_book at) {
    struct book_definition *definition = material_definition(im, at);
    if (!definition || definition->material) return definition ? definition->material : NULL;
    const struct place_in_book value = {definition->value, definition->number - 1};
    const struct layer *layers = import_layers(im, value, definition->extend);
    if (!layers) return NULL;
    const struct book_material m = read_material(im, layers);
    definition->material = new_name(im, definition->name);
    write_material(im, &im->materials, 2, definition->material, &m);
    return definition->material;
}

static void import_inline(struct importer *im, struct text *text, int indent, struct place_in_book at) {
    const struct layer *layers = import_layers(im, at, NULL);
    if (!layers) return;
    const struct book_material m = read_material(im, layers);
    write_material(im, text, indent, "material", &m);
}

void import_material(struct importer *im, struct text *text, int indent, struct place_in_book at) {
    const struct node *n = node_resolve(at.node);
    if (n->kind == NODE_MAPPING) {
        import_inline(im, text, indent, at);
        return;
    }
    if (n->kind != NODE_SCALAR)
        diag_error(im->diag, at.node->span, "import-value",
                   "`material`: expected a mapping or a name, found %s", found_in_book(im, n));
    const char *name = n->kind == NODE_SCALAR ? defined_name(im, at) : NULL;
    if (name) text_add(text, "%*smaterial: %s\n", indent, "", name);
}

void import_plain_material(struct importer *im, struct text *text, int indent) {
    if (!im->plain_material) {
        im->plain_material = new_name(im, "book-default");
        write_material(im, &im->materials, 2, im->plain_material, &plain_material);
    }
    text_add(text, "%*smaterial: %s\n", indent, "", im->plain_material);
}
