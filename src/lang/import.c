#include "lang/import.h"

#include <string.h>

#include "lang/importer.h"
#include "lang/problem.h"

static void import_item(struct importer *im, const struct node *item) {
    const struct node *n = node_resolve(item);
    const bool mapping = n->kind == NODE_MAPPING;
    if (mapping && mapping_find(n, "define"))
        import_define(im, n);
    else if (mapping && mapping_find(n, "add"))
        import_add(im, (struct place_in_book){item, im->defined});
    else if (mapping)
        diag_warning(im->diag, item->span, "import-unknown-key", "neither `add` nor `define`: left out");
    else
        diag_error(im->diag, item->span, "import-value", "expected `add: ...` or `define: ...`, found %s",
                   found_in_book(im, item));
}

/* The list of the file. NULL: it is something else; reported. */
static const struct node *items_of(struct importer *im, const struct node *root) {
    if (root->kind == NODE_SEQUENCE) return root;
    struct diagnostic *d =
        diag_error(im->diag, root->span, "import-no-list", "expected a list of `add` and `define`, found %s",
                   found_in_book(im, root));
    if (root->kind == NODE_MAPPING && mapping_find(root, "scene"))
        diag_help(im->diag, d,
                  "it looks like a scene of this language already: `monge render` takes it as it is");
    return NULL;
}

/* Of what the scene lacks as a whole, and what it defines in vain. */
static void check_whole(struct importer *im, const struct node *root) {
    if (!im->camera)
        diag_warning(im->diag, root->span, "import-missing",
                     "there is no camera: one is chosen that frames the scene");
    if (!im->lights.size)
        diag_warning(im->diag, root->span, "import-missing", "there is no light: everything is black");
    if (!im->objects.size) diag_warning(im->diag, root->span, "import-empty", "there is nothing to see");
    for (const struct book_definition *d = im->first; d; d = d->next)
        if (!d->used)
            diag_warning(im->diag, d->span, "import-unused", "`%s` is never used: left out", d->name);
}

static const char *base_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* ---- The whole text ---- */

static void write_head(struct importer *im, struct text *text, const struct source *source) {
    const struct node name = {.kind = NODE_SCALAR, .text = base_name(source->name)};
    text_add(text, "# Imported from %s, a scene in the format of \"The Ray Tracer Challenge\".\n",
             node_text(im->arena, &name));
    text_add(text, "# Its axes are left-handed, these right-handed: each z has changed its sign.\n");
    text_add(text, "monge: 1\n");
    if (im->view.size)
        text_add(text, "%s", im->view.bytes);
    else
        text_add(text, "image: {samples: 1, background: black, encoding: linear}\n");
    text_add(text, "render: {depth: 6}\n"); /* the book's rays are reflected 5 times */
}

static void write_lights(struct importer *im, struct text *text) {
    if (!im->lights.size) {
        text_add(text, "\nlights: []\n");
        return;
    }
    const vec3 sum = tidy_vec3(im->ambient);
    text_add(text,
             "\nlights:\n  - ambient: {color: %s} # the sum: in the book each light has its ambient part\n",
             vec3_text(im->arena, sum));
    text_add(text, "%s", im->lights.bytes);
}

static const char *whole_text(struct importer *im, const struct source *source) {
    struct text text = {.arena = im->arena};
    write_head(im, &text, source);
    write_lights(im, &text);
    if (im->materials.size) text_add(&text, "\nmaterials:\n%s", im->materials.bytes);
    if (im->objects.size)
        text_add(&text, "\nscene:\n%s", im->objects.bytes);
    else
        text_add(&text, "\nscene: []\n");
    return text.bytes;
}

const char *lang_import(struct arena *arena, struct diagnostics *diag, const struct source *source,
                        const struct lang_limits *limits) {
    const struct node_limits node_limits = {limits->nesting, limits->values};
    struct node_problem problem = {0};
    const unsigned errors = diag->errors;
    struct importer im = {.arena = arena,
                          .diag = diag,
                          .view = {.arena = arena},
                          .lights = {.arena = arena},
                          .materials = {.arena = arena},
                          .objects = {.arena = arena}};
    im.end = &im.first;
    const struct node *root = node_parse(arena, diag, source, &node_limits, NULL, &problem);
    if (!root && problem.text) problem_report(diag, &problem);
    const struct node *items = root ? items_of(&im, root) : NULL;
    if (!items) return NULL;
    for (const struct node *item = items->first; item; item = item->next) import_item(&im, item);
    if (diag->errors != errors) return NULL;
    check_whole(&im, root);
    return whole_text(&im, source);
}
