#include <string.h>

#include "lang/importer.h"

static const double degrees_of_radian = 57.295779513082320877;

/* ---- One step. z is turned round: what moves along z, turns about x or y, or slants z or by z
 * changes its sign. ---- */

struct step {
    const char *entry; /* in our language */
    affine map;        /* in the axes of the book */
};

static struct step translate(struct arena *arena, const double *n) {
    const char *by = vec3_text(arena, (vec3){n[0], n[1], -n[2]});
    return (struct step){arena_format(arena, "translate: %s", by),
                         affine_translate((vec3){n[0], n[1], n[2]})};
}

static struct step scale(struct arena *arena, const double *n) {
    const vec3 by = {n[0], n[1], n[2]};
    const char *factors = by.x == by.y && by.y == by.z ? number_text(arena, by.x) : vec3_text(arena, by);
    return (struct step){arena_format(arena, "scale: %s", factors), affine_scale(by)};
}

static struct step rotate(struct arena *arena, const char *name, vec3 axis, double sign, double radians) {
    const double degrees = tidy(radians * degrees_of_radian);
    return (struct step){arena_format(arena, "rotate: {%s: %s}", name, number_text(arena, sign * degrees)),
                         affine_rotate(axis, degrees)};
}

static struct step rotate_x(struct arena *arena, const double *n) {
    return rotate(arena, "x", (vec3){1, 0, 0}, -1.0, n[0]);
}
static struct step rotate_y(struct arena *arena, const double *n) {
    return rotate(arena, "y", (vec3){0, 1, 0}, -1.0, n[0]);
}
static struct step rotate_z(struct arena *arena, const double *n) {
    return rotate(arena, "z", (vec3){0, 0, 1}, 1.0, n[0]);
}

static struct step shear(struct arena *arena, const double *n) {
    static const struct {
        const char *key;
        double sign;
    } parts[] = {{"xy", 1}, {"xz", -1}, {"yx", 1}, {"yz", -1}, {"zx", -1}, {"zy", -1}};
    const char *text = "";
    for (int i = 0; i < 6; i++)
        if (n[i] != 0.0)
            text = arena_format(arena, "%s%s%s: %s", text, *text ? ", " : "", parts[i].key,
                                number_text(arena, parts[i].sign * n[i]));
    return (struct step){
        arena_format(arena, "shear: {%s}", *text ? text : "xy: 0"),
        affine_columns((vec3){1, n[2], n[4]}, (vec3){n[0], 1, n[5]}, (vec3){n[1], n[3], 1}, (vec3){0, 0, 0})};
}

enum { MAX_NUMBERS = 6 };

static const struct step_kind {
    const char *name;
    uint32_t numbers;
    struct step (*read)(struct arena *arena, const double *n);
} step_kinds[] = {
    {"translate", 3, translate}, {"scale", 3, scale},       {"rotate-x", 1, rotate_x},
    {"rotate-y", 1, rotate_y},   {"rotate-z", 1, rotate_z}, {"shear", 6, shear},
};

static const struct step_kind *find_kind(const struct node *name) {
    for (size_t i = 0; name && name->kind == NODE_SCALAR && i < sizeof step_kinds / sizeof *step_kinds; i++)
        if (strcmp(step_kinds[i].name, name->text) == 0) return &step_kinds[i];
    return NULL;
}

/* ---- Lists of steps ---- */

static void add_step(struct importer *im, struct steps *steps, struct step step) {
    if (steps->count == steps->room) {
        const size_t room = 2 * steps->room + 4;
        const char **larger = arena_array(im->arena, room, sizeof *larger);
        if (steps->count) memcpy(larger, steps->entries, steps->count * sizeof *larger);
        steps->entries = larger;
        steps->room = room;
    }
    steps->entries[steps->count++] = step.entry;
    steps->map = affine_compose(step.map, steps->map);
}

static const struct node *head_of(const struct node *list) {
    return list->kind == NODE_SEQUENCE && list->first ? node_resolve(list->first) : NULL;
}

/* step = [translate, x, y, z] and the like */
static void import_step(struct importer *im, struct steps *steps, struct place_in_book at) {
    const struct node *n = node_resolve(at.node), *name = head_of(n);
    const struct step_kind *kind = find_kind(name);
    double numbers[MAX_NUMBERS];
    if (!name) {
        diag_error(im->diag, at.node->span, "import-value",
                   "expected a step like [translate, 1, 2, 3], found %s", found_in_book(im, n));
        return;
    }
    if (!kind) {
        struct diagnostic *d = diag_error(im->diag, at.node->span, "import-value",
                                          "a transform has no step %s", found_in_book(im, name));
        diag_help(im->diag, d, "translate, scale, rotate-x, rotate-y, rotate-z or shear");
        return;
    }
    if (n->count != kind->numbers + 1) {
        diag_error(im->diag, at.node->span, "import-value", "`%s`: expected %u number%s, found %u",
                   kind->name, kind->numbers, kind->numbers == 1 ? "" : "s", n->count - 1);
        return;
    }
    const struct node *item = n->first->next;
    for (uint32_t i = 0; i < kind->numbers; i++, item = item->next)
        if (!import_number(im, arena_format(im->arena, "`%s`", kind->name),
                           (struct place_in_book){item, at.knows}, &numbers[i]))
            return;
    add_step(im, steps, kind->read(im->arena, numbers));
}

static void import_defined(struct importer *im, struct steps *steps, struct place_in_book at) {
    const struct book_definition *definition = import_definition(im, node_resolve(at.node)->text, at.knows);
    if (!definition) {
        import_unknown_name(im, at.node, "`transform`", IMPORT_NO_WORDS);
        return;
    }
    const uint32_t knows = definition->number - 1;
    if (definition->extend) import_transform(im, steps, (struct place_in_book){definition->extend, knows});
    import_transform(im, steps, (struct place_in_book){definition->value, knows});
}

static void import_list(struct importer *im, struct steps *steps, struct place_in_book at) {
    const struct node *list = node_resolve(at.node);
    if (find_kind(head_of(list))) { /* one step without a list around it */
        import_step(im, steps, at);
        return;
    }
    for (const struct node *item = list->first; item; item = item->next) {
        const struct place_in_book step = {item, at.knows};
        if (node_resolve(item)->kind == NODE_SCALAR)
            import_transform(im, steps, step);
        else
            import_step(im, steps, step);
    }
}

void import_transform(struct importer *im, struct steps *steps, struct place_in_book at) {
    const struct node *n = node_resolve(at.node);
    if (node_is_null(n) || !import_enter(im, at.node)) return;
    if (n->kind == NODE_SCALAR)
        import_defined(im, steps, at);
    else if (n->kind == NODE_SEQUENCE)
        import_list(im, steps, at);
    else
        diag_error(im->diag, at.node->span, "import-value",
                   "`transform`: expected a list of steps like [translate, 1, 2, 3], found a mapping");
    import_leave(im);
}

void steps_write(struct text *text, int indent, const struct steps *steps) {
    if (steps->count) text_list(text, indent, "transform", steps->entries, steps->count);
}
