/* Checks nodes against the grammar's tables and makes typed values of them. One function for each
 * form of the language; which keys there are, only the tables know. */
#include <string.h>

#include "lang/checker.h"
#include "lang/spelling.h"

static struct object_value *check_object(struct checker *ck, const struct grammar_kind *kind, const struct node *node);

bool check_count(struct checker *ck, const struct node *node) {
    if (++ck->values <= ck->limits->values) return true;
    if (ck->values == ck->limits->values + 1)
        diag_error(ck->diag, node->span, "more than %zu values, those behind aliases counted each time (the limit `values`)",
                   ck->limits->values);
    return false;
}

const char *check_found(struct checker *ck, const struct node *node) {
    const struct node *n = node_resolve(node);
    struct arena *arena = &ck->diag->arena;
    if (n->kind == NODE_SEQUENCE) return arena_format(arena, "a list of %u", (unsigned)n->count);
    if (n->kind == NODE_MAPPING) return n->first && n->first->kind == NODE_SCALAR
                                            ? arena_format(arena, "a mapping with `%.40s`", n->first->text)
                                            : "a mapping";
    if (node_is_null(n)) return "nothing";
    return n->count > 40 ? arena_format(arena, "`%.40s...`", n->text) : arena_format(arena, "`%s`", n->text);
}

/* ---- Keys ---- */

static const char *key_names(struct checker *ck, const struct grammar_kind *kind, bool alternatives) {
    const char *all = "";
    for (int i = 0; i < kind->key_count; i++)
        if (kind->keys[i].type != GRAMMAR_LATER && (!alternatives || kind->keys[i].alternative))
            all = arena_format(ck->arena, "%s%s%s", all, *all ? ", " : "", kind->keys[i].name);
    return all;
}

static bool has_word(const char *const *words, const char *word) {
    for (; words && *words; words++)
        if (strcmp(*words, word) == 0) return true;
    return false;
}

/* The key of the kind that other renderers call `word`, or NULL. */
static const char *key_instead(const struct grammar_kind *kind, const char *word) {
    for (int i = 0; i < kind->key_count; i++)
        if (has_word(kind->keys[i].instead, word)) return kind->keys[i].name;
    return NULL;
}

/* The only other kind that has the key, or NULL. */
static const struct grammar_kind *kind_with_key(const char *word) {
    const struct grammar_kind *found = NULL;
    for (int i = 0; i < grammar_kind_count; i++) {
        if (grammar_find_key(&grammar_kinds[i], word) < 0) continue;
        if (found) return NULL;
        found = &grammar_kinds[i];
    }
    return found;
}

/* `radius:0.5` is one word to YAML. */
static bool is_glued(const struct grammar_kind *kind, const char *word, char key[64], const char **value) {
    const char *colon = strchr(word, ':');
    if (!colon || colon - word >= 64) return false;
    memcpy(key, word, (size_t)(colon - word));
    key[colon - word] = '\0';
    *value = colon + 1;
    return grammar_find_key(kind, key) >= 0;
}

static void report_unknown_key(struct checker *ck, const struct grammar_kind *kind, const struct node *key) {
    char glued[64];
    const char *value, *word = key->text, *instead = key_instead(kind, word);
    struct spelling s = spelling_begin(word);
    for (int i = 0; i < kind->key_count; i++)
        if (kind->keys[i].type != GRAMMAR_LATER) spelling_offer(&s, kind->keys[i].name);

    struct diagnostic *d = diag_error(ck->diag, key->span, "%s has no key `%.100s`", kind->title, word);
    const struct grammar_kind *home = kind_with_key(word);
    if (is_glued(kind, word, glued, &value)) diag_help(ck->diag, d, "a space after the colon: `%s: %.40s`", glued, value);
    else if (instead) diag_help(ck->diag, d, "it is called `%s` here", instead);
    else if (s.best && s.distance <= 1) diag_help(ck->diag, d, "did you mean `%s`?", s.best);
    else if (home) diag_help(ck->diag, d, "it is a key of %s", home->title);
    else if (s.best) diag_help(ck->diag, d, "did you mean `%s`?", s.best);
    diag_note(ck->diag, d, "%s takes %s", kind->title, key_names(ck, kind, false));
}

static bool key_is_word(struct checker *ck, const struct grammar_kind *kind, const struct node *key) {
    if (node_resolve(key)->kind == NODE_SCALAR) return true;
    diag_error(ck->diag, key->span, "a key of %s is a word, found %s", kind->title, check_found(ck, key));
    return false;
}

static void report_no_value(struct checker *ck, const struct grammar_key *key, const struct node *name) {
    struct diagnostic *d = diag_error(ck->diag, name->span, "`%s` has no value", key->name);
    if (key->type == GRAMMAR_OBJECT) diag_help(ck->diag, d, "for all its defaults write `%s: {}`", key->name);
    else if (key->type == GRAMMAR_COLOR || key->type == GRAMMAR_AMOUNT)
        diag_help(ck->diag, d, "give it one or remove it; a colour like \"#ffd700\" needs its quotes");
    else diag_help(ck->diag, d, "give it one, or remove the key");
}

/* ---- Values ---- */

static bool check_list_of(struct checker *ck, const struct grammar_key *key, const struct node *node, struct object_list *out) {
    const struct node *n = node_resolve(node), *first = n->first;
    uint32_t count = n->count;
    if (!check_count(ck, node)) return false;
    if (n->kind == NODE_MAPPING && key->single) {
        first = node;
        count = 1;
    } else if (n->kind != NODE_SEQUENCE) {
        struct diagnostic *d = diag_error(ck->diag, node->span, "`%s`: expected a list of %ss, found %s", key->name,
                                          strchr(key->of->title, ' ') + 1, check_found(ck, node));
        if (n->kind == NODE_MAPPING) diag_help(ck->diag, d, "start each one with `- `");
        return false;
    }
    struct object_value **items = arena_array(ck->arena, count ? count : 1, sizeof *items);
    uint32_t good = 0;
    for (uint32_t i = 0; i < count; i++, first = first->next) {
        struct object_value *item = check_object(ck, key->of, first);
        if (item) items[good++] = item;
        if (ck->values > ck->limits->values) break;
    }
    *out = (struct object_list){items, good};
    return true;
}

static void define(struct checker *ck, const struct node *name, struct object_value *object) {
    struct definition *def = arena_alloc(ck->arena, sizeof *def);
    *def = (struct definition){.name = name->text, .object = object, .span = name->span};
    table_put(ck->arena, &ck->names, def->name, def);
    *ck->definitions_end = def;
    ck->definitions_end = &def->next;
}

static bool check_map_of(struct checker *ck, const struct grammar_key *key, const struct node *node, struct object_list *out) {
    const struct node *n = node_resolve(node);
    if (!check_count(ck, node)) return false;
    if (n->kind != NODE_MAPPING) {
        struct diagnostic *d = diag_error(ck->diag, node->span, "`%s`: expected names, each with %s, found %s", key->name,
                                          key->of->title, check_found(ck, node));
        diag_help(ck->diag, d, "as in `%s: {gold: {...}}`", key->name);
        return false;
    }
    struct object_value **items = arena_array(ck->arena, n->count ? n->count : 1, sizeof *items);
    uint32_t good = 0;
    for (const struct node *name = n->first; name; name = name->next->next) {
        if (!key_is_word(ck, key->of, name)) continue;
        const struct node *word = node_resolve(name);
        const struct definition *before = table_find(&ck->names, word->text);
        if (before) {
            struct diagnostic *d = diag_error(ck->diag, name->span, "`%s` is defined twice", word->text);
            diag_related(ck->diag, d, before->span, "first defined here");
            continue;
        }
        struct object_value *item = check_object(ck, key->of, name->next);
        if (!item) { /* reported; the name is known all the same */
            item = arena_alloc(ck->arena, sizeof *item);
            *item = (struct object_value){.kind = key->of, .span = name->span, .failed = true,
                                          .fields = arena_array(ck->arena, (size_t)key->of->key_count, sizeof *item->fields)};
        }
        item->name = word->text;
        item->definition = good;
        items[good++] = item;
        define(ck, word, item);
    }
    *out = (struct object_list){items, good};
    return true;
}

static struct object_value *check_name(struct checker *ck, const struct grammar_key *key, const struct node *node) {
    const char *name = node_resolve(node)->text;
    struct definition *def = table_find(&ck->names, name);
    if (def) {
        def->used = true;
        return def->object;
    }
    struct spelling s = spelling_begin(name);
    for (def = ck->definitions; def; def = def->next) spelling_offer(&s, def->name);
    struct diagnostic *d = diag_error(ck->diag, node->span, "no %s is named `%.100s`", key->name, name);
    if (s.best) {
        diag_help(ck->diag, d, "did you mean `%s`?", s.best);
        def = table_find(&ck->names, s.best);
        diag_related(ck->diag, d, def->span, "`%s` is defined here", s.best);
    } else {
        diag_help(ck->diag, d, ck->definitions ? "define it under `%ss:`" : "define it: `%ss: {%.40s: {...}}`", key->name, name);
    }
    return NULL;
}

static bool check_mapping_value(struct checker *ck, const struct grammar_key *key, const struct node *node, struct value *out) {
    const bool name = key->named && node_resolve(node)->kind == NODE_SCALAR;
    if (name && !check_count(ck, node)) return false;
    out->object = name ? check_name(ck, key, node) : check_object(ck, key->of, node);
    out->is_object = true;
    return out->object != NULL;
}

static bool check_boolean_value(struct checker *ck, const struct grammar_key *key, const struct node *node, struct value *out) {
    return check_boolean(ck, key, node, &out->choice);
}

/* One value of the key's type. False: reported. */
static bool check_value(struct checker *ck, const struct grammar_key *key, const struct node *node, struct value *out) {
    out->span = node->span;
    switch (key->type) {
    case GRAMMAR_NUMBER: return check_number(ck, key, node, &out->number);
    case GRAMMAR_INTEGER: return check_integer(ck, key, node, &out->number);
    case GRAMMAR_BOOLEAN: return check_boolean_value(ck, key, node, out);
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
    case GRAMMAR_LATER: break;
    }
    return false;
}

/* ---- Mappings ---- */

static const struct node *key_node(const struct node *mapping, const char *name) {
    for (const struct node *key = mapping->first; key; key = key->next->next)
        if (node_resolve(key)->kind == NODE_SCALAR && strcmp(node_resolve(key)->text, name) == 0) return key;
    return NULL;
}

static void report_later(struct checker *ck, const struct grammar_key *key, const struct node *name) {
    diag_error(ck->diag, name->span, "`%s` is not there yet: %s", key->name, key->doc);
}

/* The pair's value goes to its field. False: something of it was reported. */
static bool check_pair(struct checker *ck, struct object_value *object, const struct node *mapping, const struct node *name) {
    if (!key_is_word(ck, object->kind, name)) return false;
    const struct node *word = node_resolve(name);
    const int index = grammar_find_key(object->kind, word->text);
    if (index < 0) {
        report_unknown_key(ck, object->kind, &(struct node){.span = name->span, .text = word->text});
        return false;
    }
    const struct grammar_key *key = &object->kind->keys[index];
    const struct node *first = key_node(mapping, word->text);
    if (first != name) {
        struct diagnostic *d = diag_error(ck->diag, name->span, "`%s` is given twice", key->name);
        diag_related(ck->diag, d, first->span, "first given here");
        return false;
    }
    if (key->type == GRAMMAR_LATER) {
        report_later(ck, key, name);
        return false;
    }
    if (node_is_null(name->next)) {
        report_no_value(ck, key, name);
        return false;
    }
    struct value *value = arena_alloc(ck->arena, sizeof *value);
    if (!check_value(ck, key, name->next, value)) return false;
    object->fields[index] = value;
    return true;
}

static void check_required(struct checker *ck, struct object_value *object, const struct node *mapping) {
    for (int i = 0; i < object->kind->key_count; i++) {
        const struct grammar_key *key = &object->kind->keys[i];
        if (!key->required || key_node(mapping, key->name)) continue;
        struct diagnostic *d = diag_error(ck->diag, object->span, "%s needs the key `%s`", object->kind->title, key->name);
        if (key->example) diag_help(ck->diag, d, "as in `%s`", key->example);
        object->failed = true;
    }
}

/* Exactly one of the alternatives, where the kind has any. Counts what is written, right or wrong. */
static void check_alternatives(struct checker *ck, struct object_value *object, const struct node *mapping) {
    const struct node *found = NULL;
    bool any = false, unknown = false;
    for (int i = 0; i < object->kind->key_count; i++) any |= object->kind->keys[i].alternative;
    if (!any) return;
    for (const struct node *key = mapping->first; key; key = key->next->next) {
        const struct node *word = node_resolve(key);
        const int index = word->kind == NODE_SCALAR ? grammar_find_key(object->kind, word->text) : -1;
        unknown |= index < 0;
        if (index < 0 || !object->kind->keys[index].alternative) continue;
        if (found && strcmp(node_resolve(found)->text, word->text) != 0) {
            struct diagnostic *d = diag_error(ck->diag, key->span, "`%s` beside `%s`: %s is one of them", word->text,
                                              node_resolve(found)->text, object->kind->title);
            diag_related(ck->diag, d, found->span, "`%s` is given here", node_resolve(found)->text);
            diag_note(ck->diag, d, "write each as an item of its own, starting with `- `");
            object->failed = true;
        }
        if (!found) found = key;
    }
    if (found || unknown) return; /* an unknown key was probably meant to be the one */
    struct diagnostic *d = diag_error(ck->diag, object->span, "%s without its kind", object->kind->title);
    diag_note(ck->diag, d, "%s has one of %s", object->kind->title, key_names(ck, object->kind, true));
    object->failed = true;
}

static void check_companions(struct checker *ck, struct object_value *object, const struct node *mapping) {
    for (int i = 0; i < object->kind->key_count; i++) {
        const struct grammar_key *key = &object->kind->keys[i];
        const struct node *here = key_node(mapping, key->name);
        for (const char *const *other = key->excludes; here && other && *other; other++) {
            const struct node *there = key_node(mapping, *other);
            if (!there || (there->span.line == here->span.line ? there->span.column > here->span.column : there->span.line > here->span.line))
                continue; /* reported at the later of the two */
            struct diagnostic *d = diag_error(ck->diag, here->span, "`%s` contradicts `%s`", key->name, *other);
            diag_help(ck->diag, d, "keep one of them");
            diag_related(ck->diag, d, there->span, "`%s` is given here", *other);
            object->failed = true;
        }
        for (const char *const *other = key->needs; here && other && *other; other++) {
            if (key_node(mapping, *other)) continue;
            diag_error(ck->diag, here->span, "`%s` needs `%s` beside it", key->name, *other);
            object->failed = true;
        }
    }
}

static void report_no_mapping(struct checker *ck, const struct grammar_kind *kind, const struct node *node) {
    const struct node *n = node_resolve(node);
    struct diagnostic *d = diag_error(ck->diag, node->span, "expected %s, found %s", kind->title, check_found(ck, node));
    const int index = n->kind == NODE_SCALAR ? grammar_find_key(kind, n->text) : -1;
    if (index >= 0 && kind->keys[index].type == GRAMMAR_OBJECT) diag_help(ck->diag, d, "write `%s: {}`", n->text);
    else if (kind == &grammar_kinds[KIND_FILE]) diag_help(ck->diag, d, "the smallest scene is:  scene: [{sphere: {}}]");
    else if (kind == &grammar_kinds[KIND_ROTATE]) diag_help(ck->diag, d, "name the axis: `rotate: {z: 45}`");
    else diag_note(ck->diag, d, "%s takes %s", kind->title, key_names(ck, kind, false));
}

/* The file's keys that define names come before those that use them, wherever they stand. */
static bool defines_names(const struct grammar_kind *kind, const struct node *name) {
    const struct node *word = node_resolve(name);
    const int index = word->kind == NODE_SCALAR ? grammar_find_key(kind, word->text) : -1;
    return index >= 0 && kind->keys[index].type == GRAMMAR_MAP;
}

/* A mapping of the kind; what is wrong in it is reported and left out. NULL: it is no mapping. */
static struct object_value *check_object(struct checker *ck, const struct grammar_kind *kind, const struct node *node) {
    const struct node *n = node_resolve(node);
    if (!check_count(ck, node)) return NULL;
    if (n->kind != NODE_MAPPING) {
        report_no_mapping(ck, kind, node);
        return NULL;
    }
    struct object_value *object = arena_alloc(ck->arena, sizeof *object);
    object->kind = kind;
    object->span = node->span;
    object->fields = arena_array(ck->arena, (size_t)kind->key_count, sizeof *object->fields);
    for (int pass = 0; pass < 2; pass++)
        for (const struct node *name = n->first; name; name = name->next->next)
            if (defines_names(kind, name) == (pass == 0) && !check_pair(ck, object, n, name)) object->failed = true;
    check_required(ck, object, n);
    check_alternatives(ck, object, n);
    check_companions(ck, object, n);
    return object;
}

/* A definition that nothing refers to is probably a slip of the pen somewhere. */
static void warn_unused(struct checker *ck) {
    for (const struct definition *def = ck->definitions; def; def = def->next)
        if (!def->used) {
            const char *title = def->object->kind->title;
            struct diagnostic *d = diag_warning(ck->diag, def->span, "the %s `%s` is never used", strchr(title, ' ') + 1, def->name);
            diag_help(ck->diag, d, "use it, or remove it");
        }
}

struct object_value *lang_read(struct arena *arena, struct diagnostics *diag, const struct source *source,
                               const struct lang_limits *limits) {
    const struct node_limits node_limits = {limits->nesting, limits->values};
    struct checker ck = {.arena = arena, .diag = diag, .limits = limits};
    ck.definitions_end = &ck.definitions;
    const struct node *root = node_parse(arena, diag, source, &node_limits);
    if (!root) return NULL;
    struct object_value *file = check_object(&ck, &grammar_kinds[KIND_FILE], root);
    if (file && diag->errors == 0) warn_unused(&ck);
    return file;
}
