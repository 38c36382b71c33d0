/* Checks nodes against the grammar's tables and makes typed values of them. One function for each
 * form of the language; which keys there are, only the tables know. */
#include <assert.h>
#include <string.h>

#include "lang/checker.h"
#include "lang/problem.h"

static struct object_value *check_object(struct checker *ck, const struct grammar_kind *kind, const struct node *node);

/* ---- Aliases ----
 * What an anchor names is read once in each role: the time and the memory follow the text, not what its
 * aliases would make of it. */

static struct reading *find_reading(const struct checker *ck, const struct node *node, const void *as) {
    struct reading *r = node->anchor < ck->readings_room ? ck->readings[node->anchor] : NULL;
    while (r && r->as != as) r = r->next;
    return r;
}

static void keep_reading(struct checker *ck, const struct node *node, struct reading reading) {
    if (!node->anchor) return;
    if (node->anchor >= ck->readings_room) {
        const uint32_t room = 2 * node->anchor;
        struct reading **larger = arena_array(ck->arena, room, sizeof *larger);
        if (ck->readings) memcpy(larger, ck->readings, ck->readings_room * sizeof *larger);
        ck->readings = larger;
        ck->readings_room = room;
    }
    struct reading *kept = arena_alloc(ck->arena, sizeof *kept);
    *kept = reading;
    kept->next = ck->readings[node->anchor];
    ck->readings[node->anchor] = kept;
}

/* The same object at the place of an alias; a named one is still the named one. */
static struct object_value *read_again(struct checker *ck, const struct object_value *object, struct span span) {
    struct object_value *again = arena_alloc(ck->arena, sizeof *again);
    *again = *object;
    again->span = span;
    return again;
}

/* ---- Lists and names ---- */

static bool check_list_of(struct checker *ck, const struct grammar_key *key, const struct node *node, struct object_list *out) {
    const struct node *n = node_resolve(node), *first = n->first;
    uint32_t count = n->count;
    if (n->kind == NODE_MAPPING && key->single) {
        first = node;
        count = 1;
    } else if (n->kind != NODE_SEQUENCE) {
        report_no_list(ck, key, node);
        return false;
    }
    const struct reading *known = find_reading(ck, n, key);
    if (known) {
        *out = known->list;
        return true;
    }
    struct object_value **items = arena_array(ck->arena, count ? count : 1, sizeof *items);
    uint32_t good = 0;
    for (uint32_t i = 0; i < count; i++, first = first->next) {
        struct object_value *item = check_object(ck, key->of, first);
        if (item) items[good++] = item;
    }
    *out = (struct object_list){items, good};
    keep_reading(ck, n, (struct reading){.as = key, .list = *out});
    return true;
}

static bool key_is_word(struct checker *ck, const struct grammar_kind *kind, const struct node *key) {
    if (node_resolve(key)->kind == NODE_SCALAR) return true;
    diag_error(ck->diag, key->span, "key-not-a-word", "a key of %s is a word, found %s", kind->title, found_text(ck, key));
    return false;
}

static void define(struct checker *ck, const struct node *name, struct object_value *object) {
    struct definition *def = arena_alloc(ck->arena, sizeof *def);
    *def = (struct definition){.name = node_resolve(name)->text, .object = object, .span = name->span};
    table_put(ck->arena, &ck->names, def->name, def);
    *ck->definitions_end = def;
    ck->definitions_end = &def->next;
}

/* Stands for a definition that is no mapping, which was reported: its name is known all the same. */
static struct object_value *failed_object(struct checker *ck, const struct grammar_kind *kind, struct span span) {
    struct object_value *object = arena_alloc(ck->arena, sizeof *object);
    *object = (struct object_value){.kind = kind, .span = span, .failed = true};
    object->fields = arena_array(ck->arena, (size_t)kind->key_count, sizeof *object->fields);
    return object;
}

static bool check_map_of(struct checker *ck, const struct grammar_key *key, const struct node *node, struct object_list *out) {
    const struct node *n = node_resolve(node);
    if (n->kind != NODE_MAPPING) {
        report_no_map(ck, key, node);
        return false;
    }
    struct object_value **items = arena_array(ck->arena, n->count ? n->count : 1, sizeof *items);
    uint32_t good = 0;
    for (const struct node *name = n->first; name; name = name->next->next) {
        if (!key_is_word(ck, key->of, name)) continue;
        const struct definition *before = table_find(&ck->names, node_resolve(name)->text);
        if (before) {
            struct diagnostic *d = diag_error(ck->diag, name->span, "defined-twice", "`%s` is defined twice", short_text(ck, before->name));
            diag_related(ck->diag, d, before->span, "first defined here");
            continue;
        }
        struct object_value *item = check_object(ck, key->of, name->next);
        if (!item) item = failed_object(ck, key->of, name->span);
        item->name = node_resolve(name)->text;
        item->definition = good;
        items[good++] = item;
        define(ck, name, item);
    }
    *out = (struct object_list){items, good};
    return true;
}

static struct object_value *check_name(struct checker *ck, const struct grammar_key *key, const struct node *node) {
    struct definition *def = table_find(&ck->names, node_resolve(node)->text);
    if (!def) {
        if (!ck->names_lost) report_no_name(ck, key, node);
        return NULL;
    }
    def->used = true;
    return def->object;
}

/* ---- Values ---- */

static bool check_mapping_value(struct checker *ck, const struct grammar_key *key, const struct node *node, struct value *out) {
    const bool name = key->named && node_resolve(node)->kind == NODE_SCALAR;
    out->object = name ? check_name(ck, key, node) : check_object(ck, key->of, node);
    out->is_object = true;
    return out->object != NULL;
}

/* One value of the key's type. False: reported. */
static bool check_value(struct checker *ck, const struct grammar_key *key, const struct node *node, struct value *out) {
    out->span = node->span;
    switch (key->type) {
    case GRAMMAR_NUMBER: return check_number(ck, key, node, &out->number);
    case GRAMMAR_INTEGER: return check_integer(ck, key, node, &out->number);
    case GRAMMAR_BOOLEAN: return check_boolean(ck, key, node, &out->choice);
    case GRAMMAR_CHOICE: return check_choice(ck, key, node, &out->choice);
    case GRAMMAR_TEXT: return check_text(ck, key, node, &out->text);
    case GRAMMAR_POINT:
    case GRAMMAR_DIRECTION:
    case GRAMMAR_FACTORS: return check_vector(ck, key, node, &out->vector);
    case GRAMMAR_COLOR:
    case GRAMMAR_AMOUNT:
        if (key->of && node_resolve(node)->kind == NODE_MAPPING) return check_mapping_value(ck, key, node, out);
        return check_color(ck, key, node, &out->vector);
    case GRAMMAR_SIZE: return check_size(ck, key, node, &out->vector);
    case GRAMMAR_MATRIX: return check_matrix(ck, key, node, &out->matrix);
    case GRAMMAR_OBJECT: return check_mapping_value(ck, key, node, out);
    case GRAMMAR_LIST: return check_list_of(ck, key, node, &out->list);
    case GRAMMAR_MAP: return check_map_of(ck, key, node, &out->list);
    default: break;
    }
    return false;
}

/* ---- Mappings ---- */

/* The value of `key` of an object of `kind`; NULL when something was reported. */
static struct value *check_field(struct checker *ck, const struct grammar_kind *kind, const struct grammar_key *key, const struct node *name) {
    if (node_is_null(name->next)) {
        report_no_value(ck, key, name);
        return NULL;
    }
    const struct surrounding outer = ck->around;
    struct value *value = arena_alloc(ck->arena, sizeof *value);
    ck->around = (struct surrounding){kind, key};
    const bool ok = check_value(ck, key, name->next, value);
    ck->around = outer;
    return ok ? value : NULL;
}

static void report_twice(struct checker *ck, const struct grammar_key *key, const struct node *name, const struct node *first) {
    struct diagnostic *d = diag_error(ck->diag, name->span, "key-twice", "`%s` is given twice", key->name);
    diag_related(ck->diag, d, first->span, "first given here");
}

/* What stands under a key that nobody knows is checked as what was probably meant, so that its
 * mistakes come to light in the same run. */
static void check_unknown(struct checker *ck, struct object_value *object, struct mapping *mapping, const struct node *name) {
    const int index = report_unknown_key(ck, object->kind, mapping, name);
    if (index < 0) return;
    const bool again = mapping->given[index] || mapping->meant[index];
    mapping->meant[index] = true;
    if (!again) check_field(ck, object->kind, &object->kind->keys[index], name);
}

/* The pair's value goes to its field. False: something of it was reported. */
static bool check_pair(struct checker *ck, struct object_value *object, struct mapping *mapping, const struct node *name, int index) {
    if (!key_is_word(ck, object->kind, name)) return false;
    if (index < 0) {
        check_unknown(ck, object, mapping, name);
        return false;
    }
    const struct grammar_key *key = &object->kind->keys[index];
    if (mapping->given[index] != name) {
        report_twice(ck, key, name, mapping->given[index]);
        return false;
    }
    if (key->type >= GRAMMAR_ANY) {
        diag_error(ck->diag, name->span, "not-there-yet", "`%s` is not there yet: %s", key->name, key->doc);
        return false;
    }
    object->fields[index] = check_field(ck, object->kind, key, name);
    if (!object->fields[index] && key->type == GRAMMAR_MAP) ck->names_lost = true;
    return object->fields[index] != NULL;
}

static void check_required(struct checker *ck, struct object_value *object, const struct mapping *mapping) {
    for (int i = 0; i < object->kind->key_count; i++) {
        const struct grammar_key *key = &object->kind->keys[i];
        if (!key->required || mapping->given[i]) continue;
        object->failed = true;
        if (mapping->meant[i]) continue; /* reported as an unknown key */
        struct diagnostic *d = diag_error(ck->diag, object->span, "missing-key", "%s needs the key `%s`", object->kind->title, key->name);
        if (key->example) diag_help(ck->diag, d, "as in `%s`", key->example);
    }
}

static void report_beside(struct checker *ck, const struct object_value *object, const struct node *key, const struct node *first) {
    const char *one = node_resolve(first)->text;
    struct diagnostic *d = diag_error(ck->diag, key->span, "one-of-them", "`%s` beside `%s`: %s is one of them", node_resolve(key)->text, one, object->kind->title);
    diag_related(ck->diag, d, first->span, "`%s` is given here", one);
    const bool item = ck->around.key && ck->around.key->type == GRAMMAR_LIST;
    diag_note(ck->diag, d, item ? "write each as an item of its own, starting with `- `" : "keep one of them; another is a step of its own");
}

static bool in_order(const struct node *a, const struct node *b) {
    return a->span.line != b->span.line ? a->span.line < b->span.line : a->span.column < b->span.column;
}

/* Exactly one of the alternatives, where the kind has any. Counts what is written, right or wrong. */
static void check_alternatives(struct checker *ck, struct object_value *object, const struct mapping *mapping, bool unknown) {
    const struct node *first = NULL;
    bool any = false;
    for (int i = 0; i < object->kind->key_count; i++) {
        const struct node *key = mapping->given[i];
        const bool alternative = object->kind->keys[i].alternative;
        any |= alternative;
        if (alternative && key && (!first || in_order(key, first))) first = key;
        unknown |= key && object->kind->keys[i].needs; /* its companion is the one: reported there */
    }
    for (int i = 0; i < object->kind->key_count; i++) {
        if (!object->kind->keys[i].alternative || !mapping->given[i] || mapping->given[i] == first) continue;
        report_beside(ck, object, mapping->given[i], first);
        object->failed = true;
    }
    if (!any || first || unknown) return; /* an unknown key was probably meant to be the one */
    report_no_alternative(ck, object);
    object->failed = true;
}

/* `key` of the kind stands at `here`; `other` stands at `there` or nowhere. */
static void check_companion(struct checker *ck, struct object_value *object, const struct mapping *mapping, int index) {
    const struct grammar_key *key = &object->kind->keys[index];
    const struct node *here = mapping->given[index];
    for (const char *const *other = key->excludes; other && *other; other++) {
        const struct node *there = mapping->given[grammar_find_key(object->kind, *other)];
        if (!there || in_order(here, there)) continue; /* reported at the later of the two */
        struct diagnostic *d = diag_error(ck->diag, here->span, "contradiction", "`%s` contradicts `%s`", key->name, *other);
        diag_help(ck->diag, d, "keep one of them");
        diag_related(ck->diag, d, there->span, "`%s` is given here", *other);
        object->failed = true;
    }
    for (const char *const *other = key->needs; other && *other; other++) {
        const int needed = grammar_find_key(object->kind, *other);
        if (mapping->given[needed]) continue;
        object->failed = true;
        if (mapping->meant[needed]) continue;
        struct diagnostic *d = diag_error(ck->diag, here->span, "missing-key", "`%s` needs `%s` beside it", key->name, *other);
        if (key->example) diag_help(ck->diag, d, "as in `%s`", key->example);
    }
}

static int key_index(const struct grammar_kind *kind, const struct node *key) {
    const struct node *word = node_resolve(key);
    return word->kind == NODE_SCALAR ? grammar_find_key(kind, word->text) : -1;
}

/* The pairs whose key defines names, or the others. Returns whether a key is unknown. */
static bool check_pairs(struct checker *ck, struct object_value *object, struct mapping *mapping, bool defining) {
    bool unknown = false;
    for (const struct node *name = mapping->node->first; name; name = name->next->next) {
        const int index = key_index(object->kind, name);
        unknown |= index < 0;
        if ((index >= 0 && object->kind->keys[index].type == GRAMMAR_MAP) != defining) continue;
        if (!check_pair(ck, object, mapping, name, index)) object->failed = true;
    }
    return unknown;
}

/* A mapping of the kind; what is wrong in it is reported and left out. NULL: it is no mapping. */
static struct object_value *check_object(struct checker *ck, const struct grammar_kind *kind, const struct node *node) {
    struct mapping mapping = {.node = node_resolve(node)};
    if (mapping.node->kind != NODE_MAPPING) {
        report_no_mapping(ck, kind, node);
        return NULL;
    }
    const struct reading *known = find_reading(ck, mapping.node, kind);
    if (known) return read_again(ck, known->object, node->span);
    assert(kind->key_count <= CHECK_MAX_KEYS);
    for (const struct node *name = mapping.node->first; name; name = name->next->next) {
        const int index = key_index(kind, name);
        if (index >= 0 && !mapping.given[index]) mapping.given[index] = name;
    }
    struct object_value *object = arena_alloc(ck->arena, sizeof *object);
    object->kind = kind;
    object->span = node->span;
    object->fields = arena_array(ck->arena, (size_t)kind->key_count, sizeof *object->fields);
    mapping.object = object;
    check_pairs(ck, object, &mapping, true); /* definitions come before uses, wherever they stand */
    const bool unknown = check_pairs(ck, object, &mapping, false);
    check_required(ck, object, &mapping);
    check_alternatives(ck, object, &mapping, unknown);
    for (int i = 0; i < kind->key_count; i++)
        if (mapping.given[i]) check_companion(ck, object, &mapping, i);
    keep_reading(ck, mapping.node, (struct reading){.as = kind, .object = object});
    return object;
}

/* A definition that nothing refers to is probably a slip of the pen somewhere. */
static void warn_unused(struct checker *ck) {
    for (const struct definition *def = ck->definitions; def; def = def->next)
        if (!def->used) {
            const char *title = def->object->kind->title;
            struct diagnostic *d = diag_warning(ck->diag, def->span, "unused-definition", "the %s `%s` is never used", strchr(title, ' ') + 1, short_text(ck, def->name));
            diag_help(ck->diag, d, "use it, or remove it");
        }
}

struct object_value *lang_read(struct arena *arena, struct diagnostics *diag, const struct source *source,
                               const struct lang_limits *limits) {
    const struct node_limits node_limits = {limits->nesting, limits->values};
    struct node_problem problem = {0};
    const unsigned errors = diag->errors;
    struct checker ck = {.arena = arena, .diag = diag};
    ck.definitions_end = &ck.definitions;
    const struct node *root = node_parse(arena, diag, source, &node_limits, &problem);
    if (!root) {
        if (problem.text) problem_report(diag, &problem);
        return NULL;
    }
    struct object_value *file = check_object(&ck, &grammar_kinds[KIND_FILE], root);
    if (file) file->failed = diag->errors != errors;
    if (file && !file->failed) warn_unused(&ck);
    return file;
}
