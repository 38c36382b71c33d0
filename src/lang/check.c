/* Checks nodes against the grammar's tables and makes typed values of them. One function for each
 * form of the language; which keys there are, only the tables know. Where a name is not known yet
 * (ck->waiting), false is returned and nothing reported. */
#include <assert.h>
#include <string.h>

#include "lang/checker.h"

/* ---- Lists and names ---- */

/* The items of a list, as they come. */
struct collection {
    const struct grammar_kind *kind;
    const struct node *item; /* that is read */
    struct object_list list;
    uint32_t room;
};

static void collect(struct checker *ck, void *context) {
    struct collection *c = context;
    const struct node *when =
        node_resolve(c->item)->kind == NODE_MAPPING ? node_get(node_resolve(c->item), "when") : NULL;
    bool holds = true;
    if (!place_count_step(ck, c->item)) return;
    if (when && grammar_find_key(c->kind, "when") >= 0 && loop_condition(ck, when, &holds) == QUANTITY_OK &&
        !holds)
        return;
    struct object_value *object = check_object(ck, c->kind, c->item);
    if (!object) return;
    if (c->list.count == c->room) {
        c->room = c->room ? 2 * c->room : 4;
        struct object_value **larger = arena_array(ck->arena, c->room, sizeof *larger);
        if (c->list.count) memcpy(larger, c->list.items, c->list.count * sizeof *larger);
        c->list.items = larger;
    }
    c->list.items[c->list.count++] = object;
}

static void collect_item(struct checker *ck, struct collection *c, const struct node *item) {
    const struct binding *b = scope_stands_for(ck, item);
    if (b && b->kind == BINDING_UNKNOWN) return;
    const struct scope *outer = ck->scope;
    const struct diag_frame frame = scope_frame(ck, item);
    if (b) ck->scope = b->scope;
    if (b) ck->diag->frame = &frame;
    c->item = b ? b->node : item;
    const struct node *n = node_resolve(c->item);
    const struct node *loop =
        n->kind == NODE_MAPPING && grammar_find_key(c->kind, "for") >= 0 ? node_get(n, "for") : NULL;
    if (loop)
        loop_run(ck, loop, collect, c);
    else
        collect(ck, c);
    ck->diag->frame = frame.outer;
    ck->scope = outer;
}

static bool check_list_of(struct checker *ck, const struct grammar_key *key, const struct node *node,
                          struct value *out) {
    const struct node *n = node_resolve(node);
    const bool objects = key->of == &grammar_kinds[KIND_OBJECT], one = n->kind == NODE_MAPPING && key->single;
    if (n->kind != NODE_SEQUENCE && !one) {
        report_no_list(ck, key, node);
        return false;
    }
    if (objects) {
        out->node = node;
        return true;
    }
    struct collection c = {.kind = key->of};
    if (one) collect_item(ck, &c, node);
    for (const struct node *item = one ? NULL : n->first; item; item = item->next) collect_item(ck, &c, item);
    out->list = c.list;
    return true;
}

static bool key_is_word(struct checker *ck, const struct grammar_kind *kind, const struct node *key) {
    if (node_resolve(key)->kind == NODE_SCALAR) return true;
    diag_error(ck->diag, key->span, "key-not-a-word", "a key of %s is a word, found %s", kind->title,
               found_text(ck, key));
    return false;
}

/* The definition that a scalar names; NULL: reported, or not there yet. */
static struct definition *find_definition(struct checker *ck, const struct grammar_key *key,
                                          const struct definitions *among, const struct node *node) {
    const struct node *n = node_resolve(node);
    if (n->kind != NODE_SCALAR || n->count == 0) {
        diag_error(ck->diag, node->span, "not-a-text", "`%s`: expected a name, found %s", key->name,
                   found_text(ck, node));
        return NULL;
    }
    struct definition *def = table_find(&among->names, n->text);
    if (def) return def;
    if (ck->provisional && among != &ck->presets)
        ck->waiting = true;
    else if (!ck->names_lost)
        report_no_name(ck, key, among, node);
    return NULL;
}

static bool check_name(struct checker *ck, const struct grammar_key *key, const struct node *node,
                       struct value *out) {
    const bool template = key->of == &grammar_kinds[KIND_TEMPLATE],
               preset = key == &grammar_kinds[KIND_MATERIAL].keys[KEY_MATERIAL_PRESET];
    out->definition = find_definition(ck, key,
                                      template ? &ck->templates
                                      : preset ? define_presets(ck)
                                               : &ck->materials,
                                      node);
    return out->definition != NULL;
}

/* A material's keys that are not given are those of the one that it extends. False: reported. */
static bool inherit(struct checker *ck, struct object_value *object) {
    struct value *base = object->fields[KEY_MATERIAL_PRESET] ? object->fields[KEY_MATERIAL_PRESET]
                                                             : object->fields[KEY_MATERIAL_EXTENDS];
    if (!base || !base->definition) return true; /* none; or in a rehearsal: a variable names it */
    const struct object_value *from = define_read(ck, base->definition);
    if (!from) return false;
    for (int i = 0; i < object->kind->key_count; i++)
        if (!object->fields[i]) object->fields[i] = from->fields[i];
    object->failed |= from->failed;
    return true;
}

/* ---- Values ---- */

static bool check_mapping_value(struct checker *ck, const struct grammar_key *key, const struct node *node,
                                struct value *out) {
    out->is_object = true;
    if (key->named && node_resolve(node)->kind == NODE_SCALAR && node_resolve(node)->count > 0) {
        struct definition *def = find_definition(ck, key, &ck->materials, node);
        out->object = def ? define_read(ck, def) : NULL;
    } else {
        out->object = check_object(ck, key->of, node);
    }
    return out->object != NULL;
}

/* Names, each with a value that gets its meaning elsewhere. */
static bool check_values(struct checker *ck, const struct grammar_key *key, const struct node *node,
                         struct value *out) {
    const struct node *n = node_resolve(node);
    out->node = node;
    if (n->kind != NODE_MAPPING) {
        report_no_map(ck, key, node);
        return false;
    }
    bool good = true;
    for (const struct node *name = n->first; name; name = name->next->next) {
        if (!node_is_null(name->next) || key->type == GRAMMAR_MAP) continue; /* define.c reads a map's */
        good = false;
        if (only_counted(ck, name->span) || report_cut_before(ck, n, name)) continue;
        const char *word = node_resolve(name)->kind == NODE_SCALAR ? node_resolve(name)->text : "";
        struct diagnostic *d = diag_error(ck->diag, name->span, "no-value", "`%s` has no value",
                                          *word ? short_text(ck, word) : "it");
        if (!report_help_comma(ck, d, n, name) && !report_help_glued(ck, d, word) &&
            !report_help_hash(ck, d, name))
            diag_help(ck->diag, d, "give it one, or remove the key");
    }
    return good || key == &grammar_kinds[KIND_TEMPLATE]
                               .keys[KEY_TEMPLATE_PARAMS]; /* the others are known all the same */
}

static bool check_written(struct checker *ck, const struct grammar_key *key, const struct node *node,
                          struct value *out);

/* In a rehearsal: what stands for a value that is not known. */
static void take_any(struct checker *ck, const struct grammar_key *key, struct value *out) {
    out->is_object = key->type == GRAMMAR_OBJECT;
    if (!out->is_object) return;
    out->object = arena_alloc(ck->arena, sizeof *out->object);
    *out->object = (struct object_value){.kind = key->of, .span = out->span, .failed = true};
    out->object->fields = arena_array(ck->arena, (size_t)key->of->key_count, sizeof *out->object->fields);
}

static bool may_vary(const struct grammar_key *key) {
    switch (key->type) {
    case GRAMMAR_TEXT:
    case GRAMMAR_ANY:
    case GRAMMAR_VALUES:
    case GRAMMAR_RANGES:
    case GRAMMAR_CONDITION:
    case GRAMMAR_FILES:
    case GRAMMAR_MAP: return false;
    default: return true;
    }
}

/* The names of presets are the program's: no variable hides one. */
static bool is_preset(struct checker *ck, const struct grammar_key *key, const struct node *node) {
    const struct node *n = node_resolve(node);
    if (key != &grammar_kinds[KIND_MATERIAL].keys[KEY_MATERIAL_PRESET] || n->kind != NODE_SCALAR)
        return false;
    return table_find(&define_presets(ck)->names, n->text) != NULL;
}

/* One value of the key's type, or a variable that has one. False: reported, or not known yet. */
static bool check_value(struct checker *ck, const struct grammar_key *key, const struct node *node,
                        struct value *out) {
    const struct binding *b = may_vary(key) && !is_preset(ck, key, node) ? scope_stands_for(ck, node) : NULL;
    out->span = node->span;
    if (!b) return check_written(ck, key, node, out);
    if (key->type == GRAMMAR_LIST && key->of == &grammar_kinds[KIND_OBJECT]) {
        out->node = node; /* place.c follows it */
        return true;
    }
    if (b->kind == BINDING_UNKNOWN) {
        take_any(ck, key, out);
        return ck->rehearsing;
    }
    if (!place_descend(ck, node->span)) return false;
    const struct scope *outer = ck->scope;
    const struct diag_frame frame = scope_frame(ck, node);
    ck->scope = b->scope;
    ck->diag->frame = &frame;
    const bool good = check_value(ck, key, b->node, out);
    out->computed = true;
    ck->diag->frame = frame.outer;
    ck->scope = outer;
    ck->depth--;
    return good;
}

static bool node_is_number(const struct node *node) {
    const struct node *n = node_resolve(node);
    return n->kind == NODE_SCALAR && scalar_is_number(n->text);
}

static bool check_written(struct checker *ck, const struct grammar_key *key, const struct node *node,
                          struct value *out) {
    switch (key->type) {
    case GRAMMAR_NUMBER:
        out->computed = !node_is_number(node);
        return check_number(ck, key, node, &out->number);
    case GRAMMAR_INTEGER: return check_integer(ck, key, node, &out->number);
    case GRAMMAR_BOOLEAN: return check_boolean(ck, key, node, &out->choice);
    case GRAMMAR_CHOICE: return check_choice(ck, key, node, &out->choice);
    case GRAMMAR_TEXT: return check_text(ck, key, node, &out->text);
    case GRAMMAR_POINT:
    case GRAMMAR_DIRECTION:
    case GRAMMAR_FACTORS: return check_vector(ck, key, node, &out->vector);
    case GRAMMAR_COLOR:
    case GRAMMAR_AMOUNT:
        if (key->of && node_resolve(node)->kind == NODE_MAPPING && !keyframes_is(node_resolve(node)))
            return check_mapping_value(ck, key, node, out);
        return check_color(ck, key, node, &out->vector);
    case GRAMMAR_SIZE: return check_size(ck, key, node, &out->vector);
    case GRAMMAR_MATRIX: return check_matrix(ck, key, node, &out->matrix);
    case GRAMMAR_OBJECT: return check_mapping_value(ck, key, node, out);
    case GRAMMAR_LIST: return check_list_of(ck, key, node, out);
    case GRAMMAR_NAME: return check_name(ck, key, node, out);
    case GRAMMAR_MAP:
    case GRAMMAR_VALUES: return check_values(ck, key, node, out);
    case GRAMMAR_ANY:
    case GRAMMAR_RANGES:
    case GRAMMAR_CONDITION:
    case GRAMMAR_FILES: out->node = node; return true;
    case GRAMMAR_LATER: break;
    }
    return false;
}

/* ---- Mappings ---- */

/* The value of `key` of an object of `kind`; NULL when something was reported. */
static struct value *check_field(struct checker *ck, const struct grammar_kind *kind,
                                 const struct grammar_key *key, const struct node *name) {
    if (node_is_null(name->next)) {
        report_no_value(ck, key, name);
        return NULL;
    }
    const struct surrounding outer = ck->around;
    struct value *value = arena_room(ck->arena, sizeof *value);
    *value = (struct value){.span = name->next->span};
    ck->around = (struct surrounding){kind, key};
    const bool ok = check_value(ck, key, name->next, value);
    ck->around = outer;
    return ok ? value : NULL;
}

static void report_twice(struct checker *ck, const struct grammar_key *key, const struct node *name,
                         const struct node *first) {
    struct diagnostic *d = diag_error(ck->diag, name->span, "key-twice", "`%s` is given twice", key->name);
    diag_related(ck->diag, d, first->span, "first given here");
}

static bool is_meant(const struct mapping *mapping, int index) { return mapping->meant >> index & 1; }

/* What stands under a key that nobody knows is checked as what was probably meant, so that its
 * mistakes come to light in the same run. */
static void check_unknown(struct checker *ck, struct object_value *object, struct mapping *mapping,
                          const struct node *name) {
    const int index = report_unknown_key(ck, object->kind, mapping, name);
    if (index < 0) return;
    const bool again = mapping->given[index] || is_meant(mapping, index);
    mapping->meant |= (uint64_t)1 << index;
    const struct grammar_key *key = &object->kind->keys[index];
    const struct value *value =
        again || is_number_for_row(key, name->next) ? NULL : check_field(ck, object->kind, key, name);
    const bool knows_names =
        object->kind != &grammar_kinds[KIND_TEMPLATE]; /* its parameters are not in scope here */
    if (value && knows_names && key->type == GRAMMAR_LIST && key->of == &grammar_kinds[KIND_OBJECT])
        place_members(ck, (int)(object->kind - grammar_kinds), index, value->node);
}

/* The pair's value goes to its field. False: something of it was reported. */
static bool check_pair(struct checker *ck, struct object_value *object, struct mapping *mapping,
                       const struct node *name, int index) {
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
    if (key->type == GRAMMAR_LATER) {
        diag_error(ck->diag, name->span, "not-there-yet", "`%s` is not there yet: %s", key->name, key->doc);
        return false;
    }
    object->fields[index] = check_field(ck, object->kind, key, name);
    return object->fields[index] != NULL;
}

static void check_required(struct checker *ck, struct object_value *object, const struct mapping *mapping) {
    for (int i = 0; i < object->kind->key_count; i++) {
        const struct grammar_key *key = &object->kind->keys[i];
        if (!key->required || mapping->given[i] ||
            (ck->included && object->kind == &grammar_kinds[KIND_FILE]))
            continue;
        object->failed = true;
        if (is_meant(mapping, i)) continue; /* reported as an unknown key */
        struct diagnostic *d = diag_error(ck->diag, object->span, "missing-key", "%s needs the key `%s`",
                                          object->kind->title, key->name);
        if (key->example) diag_help(ck->diag, d, "as in `%s`", key->example);
    }
}

static void report_beside(struct checker *ck, const struct object_value *object, const struct node *key,
                          const struct node *first) {
    const char *one = node_resolve(first)->text;
    struct diagnostic *d =
        diag_error(ck->diag, key->span, "one-of-them", "`%s` beside `%s`: %s is one of them",
                   node_resolve(key)->text, one, object->kind->title);
    diag_related(ck->diag, d, first->span, "`%s` is given here", one);
    const bool item = ck->around.key && ck->around.key->type == GRAMMAR_LIST;
    diag_note(ck->diag, d,
              item ? "write each as an item of its own, starting with `- `"
                   : "keep one of them; another is a step of its own");
}

static bool in_order(const struct node *a, const struct node *b) {
    return a->span.line != b->span.line ? a->span.line < b->span.line : a->span.column < b->span.column;
}

/* Exactly one of the alternatives, where the kind has any. Counts what is written, right or wrong. */
static void check_alternatives(struct checker *ck, struct object_value *object, const struct mapping *mapping,
                               bool unknown) {
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
static void check_companion(struct checker *ck, struct object_value *object, const struct mapping *mapping,
                            int index) {
    const struct grammar_key *key = &object->kind->keys[index];
    const struct node *here = mapping->given[index];
    for (const char *const *other = key->excludes; other && *other; other++) {
        const struct node *there = mapping->given[grammar_find_key(object->kind, *other)];
        if (!there || in_order(here, there)) continue; /* reported at the later of the two */
        struct diagnostic *d =
            diag_error(ck->diag, here->span, "contradiction", "`%s` contradicts `%s`", key->name, *other);
        diag_help(ck->diag, d, "keep one of them");
        diag_related(ck->diag, d, there->span, "`%s` is given here", *other);
        object->failed = true;
    }
    for (const char *const *other = key->needs; other && *other; other++) {
        const int needed = grammar_find_key(object->kind, *other);
        if (mapping->given[needed]) continue;
        object->failed = true;
        if (is_meant(mapping, needed)) continue;
        struct diagnostic *d =
            diag_error(ck->diag, here->span, "missing-key", "`%s` needs `%s` beside it", key->name, *other);
        if (key->example) diag_help(ck->diag, d, "as in `%s`", key->example);
    }
}

static int key_index(const struct grammar_kind *kind, const struct node *key) {
    const struct node *word = node_resolve(key);
    return word->kind == NODE_SCALAR ? grammar_find_key(kind, word->text) : -1;
}

/* Returns whether a key is unknown. */
static bool check_pairs(struct checker *ck, struct object_value *object, struct mapping *mapping) {
    bool unknown = false;
    int pair = 0;
    for (const struct node *name = mapping->node->first; name; name = name->next->next, pair++) {
        const int index = pair < CHECK_MAX_KEYS ? mapping->index[pair] : key_index(object->kind, name);
        unknown |= index < 0;
        if (!check_pair(ck, object, mapping, name, index)) object->failed = true;
    }
    return unknown;
}

/* Bit i: key i of the kind is in the mapping. */
static uint64_t find_given(const struct grammar_kind *kind, struct mapping *mapping) {
    uint64_t given = 0;
    int pair = 0;
    memset(mapping->given, 0, (size_t)kind->key_count * sizeof *mapping->given);
    mapping->meant = 0;
    for (const struct node *name = mapping->node->first; name; name = name->next->next, pair++) {
        const int index = key_index(kind, name);
        if (pair < CHECK_MAX_KEYS) mapping->index[pair] = (signed char)index;
        if (index < 0 || mapping->given[index]) continue;
        mapping->given[index] = name;
        given |= (uint64_t)1 << index;
    }
    return given;
}

static bool is_one(uint64_t bits) { return bits && !(bits & (bits - 1)); }

struct object_value *check_object(struct checker *ck, const struct grammar_kind *kind,
                                  const struct node *node) {
    struct mapping mapping;
    mapping.node = node_resolve(node);
    if (mapping.node->kind != NODE_MAPPING) {
        report_no_mapping(ck, kind, node);
        return NULL;
    }
    assert(kind->key_count <= CHECK_MAX_KEYS);
    const uint64_t given = find_given(kind, &mapping);
    struct object_value *object =
        arena_alloc(ck->arena, sizeof *object + (size_t)kind->key_count * sizeof *object->fields);
    object->kind = kind;
    object->span = node->span;
    object->fields = (struct value **)(object + 1);
    mapping.object = object;
    const bool unknown = check_pairs(ck, object, &mapping);
    if (kind->required & ~given) check_required(ck, object, &mapping);
    if (kind->alternatives && !is_one(kind->alternatives & given))
        check_alternatives(ck, object, &mapping, unknown);
    for (int i = 0; i < kind->key_count && (kind->companions & given) >> i; i++)
        if (mapping.given[i]) check_companion(ck, object, &mapping, i);
    if (kind == &grammar_kinds[KIND_MATERIAL] && !inherit(ck, object)) object->failed = true;
    return object;
}
