#include <string.h>

#include "lang/importer.h"

enum kind { KIND_CAMERA, KIND_LIGHT, KIND_SHAPE, KIND_GROUP, KIND_MESH, KIND_SOLID, KIND_NONE };

/* Each with its kind. */
static const char *const kind_names[] = {"camera",   "light", "sphere", "plane",    "cube",
                                         "cylinder", "cone",  "group",  "triangle", "smooth-triangle",
                                         "obj",      "csg",   NULL};
static const enum kind kinds[] = {KIND_CAMERA, KIND_LIGHT, KIND_SHAPE, KIND_SHAPE, KIND_SHAPE, KIND_SHAPE,
                                  KIND_SHAPE,  KIND_GROUP, KIND_MESH,  KIND_MESH,  KIND_MESH,  KIND_SOLID};

enum { TOP_INDENT = 2 }; /* of what is in no group */

static enum kind find_kind(const char *name) {
    for (size_t i = 0; kind_names[i]; i++)
        if (strcmp(kind_names[i], name) == 0) return kinds[i];
    return KIND_NONE;
}

/* What is added in the end: the book's own kind, and the layers from the use down to it. */
struct addition {
    enum kind kind;
    const char *name; /* of the kind */
    struct layer *layers;
};

/* Follows `add: NAME` through the definitions. False: reported. */
static bool resolve(struct importer *im, struct place_in_book item, struct addition *out) {
    struct layer **end = &out->layers, *part = import_layers(im, item, NULL);
    *out = (struct addition){.kind = KIND_NONE};
    for (int depth = 0;; depth++) {
        if (!part || !import_depth(im, part->mapping, depth)) return false;
        *end = part;
        while (*end) end = &(*end)->under;
        const struct place_in_book add = layer_find(part, "add");
        const struct node *name = add.node ? node_resolve(add.node) : NULL;
        if (!name || name->kind != NODE_SCALAR) {
            diag_error(im->diag, part->mapping->span, "import-missing",
                       "an object needs `add`, the name of what it is");
            return false;
        }
        out->name = name->text;
        out->kind = find_kind(name->text);
        if (out->kind != KIND_NONE) return true;
        const struct book_definition *definition = import_definition(im, name->text, add.knows);
        if (!definition) {
            import_unknown_name(im, add.node, "`add`", kind_names);
            return false;
        }
        part = import_layers(im, (struct place_in_book){definition->value, definition->number - 1},
                             definition->extend);
    }
}

/* ---- Objects ---- */

/* The transforms of all layers: that of the definition acts before that of its use. */
static void add_transforms(struct importer *im, struct steps *steps, const struct layer *layers) {
    if (!layers) return;
    add_transforms(im, steps, layers->under);
    const struct node *transform = mapping_find(layers->mapping, "transform");
    if (transform) import_transform(im, steps, (struct place_in_book){transform, layers->knows});
}

static void write_transform(struct importer *im, struct text *text, int indent, const struct layer *layers) {
    struct steps steps = {.map = AFFINE_IDENTITY};
    affine inverse;
    add_transforms(im, &steps, layers);
    const struct place_in_book at = layer_find(layers, "transform");
    if (at.node && !affine_invert(steps.map, &inverse))
        diag_error(im->diag, at.node->span, "import-flat",
                   "this transform leaves nothing to see: it flattens the object");
    steps_write(text, indent, &steps);
}

static void check_shadow(struct importer *im, const struct layer *layers) {
    const struct place_in_book at = layer_find(layers, "shadow");
    bool shadow = true;
    if (at.node && import_boolean(im, "`shadow`", at, &shadow) && !shadow)
        diag_warning(im->diag, at.node->span, "import-shadow",
                     "everything has a shadow here: `shadow: false` is left out");
}

/* What was written of an object: BARE if something in it has no material, and gets the book's own. */
enum presence { ABSENT, COVERED, BARE };

static enum presence import_object(struct importer *im, struct text *text, int indent,
                                   struct place_in_book item);

static enum presence import_group(struct importer *im, struct text *text, int indent,
                                  const struct layer *layers) {
    static const char *const keys[] = {"add", "extend", "material", "transform", "shadow", "children", NULL};
    const struct place_in_book children = layer_find(layers, "children");
    const struct node *list = children.node ? node_resolve(children.node) : NULL;
    import_check_keys(im, layers, "a group", keys, IMPORT_NO_WORDS);
    if (!list || list->kind != NODE_SEQUENCE) {
        if (list)
            diag_error(im->diag, children.node->span, "import-value", "`children`: expected a list, found %s",
                       found_in_book(im, list));
        else
            diag_warning(im->diag, layers->mapping->span, "import-empty",
                         "a group without `children`: left out");
        return ABSENT;
    }
    text_add(text, "%*s- group:\n", indent, "");
    enum presence all = ABSENT;
    for (const struct node *item = list->first; item; item = item->next) {
        const enum presence one =
            import_object(im, text, indent + 4, (struct place_in_book){item, children.knows});
        if (one > all) all = one;
    }
    return all;
}

/* An object without a material has that of the nearest group around it that has one. */
static enum presence import_added(struct importer *im, struct text *text, int indent,
                                  const struct addition *added) {
    const struct place_in_book material = layer_find(added->layers, "material");
    const bool own = material.node && !node_is_null(node_resolve(material.node)), top = indent == TOP_INDENT;
    const size_t before = text->size;
    enum presence presence = added->kind == KIND_GROUP ? import_group(im, text, indent, added->layers)
                             : import_shape(im, text, indent, added->name, added->layers) ? BARE
                                                                                          : ABSENT;
    if (presence == ABSENT) {
        text_cut(text, before);
        return ABSENT;
    }
    check_shadow(im, added->layers);
    if (own)
        import_material(im, text, indent + 2, material);
    else if (top && presence == BARE)
        import_plain_material(im, text, indent + 2);
    write_transform(im, text, indent + 2, added->layers);
    return own ? COVERED : presence;
}

static void leave_out(struct importer *im, const struct addition *added) {
    const char *what = added->kind == KIND_MESH ? "meshes" : "solids by union, intersection and difference";
    diag_warning(im->diag, added->layers->mapping->span, "import-left-out",
                 "%s are not there yet: this `%s` is left out", what, added->name);
}

static enum presence import_resolved(struct importer *im, struct text *text, int indent,
                                     const struct addition *added) {
    const bool top = indent == TOP_INDENT;
    switch (added->kind) {
    case KIND_SHAPE:
    case KIND_GROUP: return import_added(im, text, indent, added);
    case KIND_MESH:
    case KIND_SOLID: leave_out(im, added); break;
    case KIND_CAMERA:
        if (top) import_camera(im, added->layers);
        break;
    case KIND_LIGHT:
        if (top) import_light(im, added->layers);
        break;
    case KIND_NONE: break;
    }
    if (!top && (added->kind == KIND_CAMERA || added->kind == KIND_LIGHT))
        diag_error(im->diag, added->layers->mapping->span, "import-value", "a %s is no member of a group",
                   added->name);
    return ABSENT;
}

static enum presence import_object(struct importer *im, struct text *text, int indent,
                                   struct place_in_book item) {
    struct addition added;
    if (!import_enter(im, item.node)) return ABSENT;
    const enum presence presence =
        resolve(im, item, &added) ? import_resolved(im, text, indent, &added) : ABSENT;
    import_leave(im);
    return presence;
}

void import_add(struct importer *im, struct place_in_book item) {
    import_object(im, &im->objects, TOP_INDENT, item);
}
