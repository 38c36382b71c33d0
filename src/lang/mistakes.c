/* What is wrong with keys and mappings, and the smallest fix. Whether there is a mistake, check.c
 * decides; nothing here changes what is read. */
#include <ctype.h>
#include <string.h>

#include "lang/checker.h"
#include "lang/spelling.h"

/* ---- What was found ---- */

const char *append_name(struct checker *ck, const char *all, const char *name) {
    enum { LONG = 1000 };
    const size_t length = strlen(all);
    if (length > LONG) return all[length - 1] == '.' ? all : arena_format(ck->arena, "%s, ...", all);
    return arena_format(ck->arena, "%s%s%s", all, *all ? ", " : "", short_text(ck, name));
}

bool only_counted(struct checker *ck, struct span span) {
    if (!diag_full(ck->diag)) return false;
    diag_error(ck->diag, span, "beyond", " ");
    return true;
}

/* The bytes of the first characters of a text: at most 40. */
static int short_length(const char *text) {
    const size_t size = strlen(text);
    size_t n = size > 40 ? 40 : size;
    while (n < size && n > 0 && ((unsigned char)text[n] & 0xc0) == 0x80) n--;
    return (int)n;
}

const char *short_text(struct checker *ck, const char *text) {
    const int n = short_length(text);
    if (diag_full(ck->diag)) return "";
    return text[n] ? arena_format(ck->arena, "%.*s...", n, text) : text;
}

const char *found_text(struct checker *ck, const struct node *node) {
    const struct node *n = node_resolve(node);
    if (diag_full(ck->diag)) return "";
    if (n->kind == NODE_SEQUENCE)
        return n->count == 0 ? "an empty list" : arena_format(ck->arena, "a list of %u", (unsigned)n->count);
    if (n->kind == NODE_MAPPING) {
        const struct node *key = n->first ? node_resolve(n->first) : NULL;
        if (!key) return "an empty mapping";
        return key->kind == NODE_SCALAR
                   ? arena_format(ck->arena, "a mapping with `%s`", short_text(ck, key->text))
                   : "a mapping";
    }
    if (node_is_null(n)) return "nothing";
    return n->count == 0 ? "an empty text" : arena_format(ck->arena, "`%s`", short_text(ck, n->text));
}

const char *found_quantity(struct checker *ck, const struct node *node, const struct quantity *value) {
    if (diag_full(ck->diag)) return "";
    if (node_resolve(node)->kind == NODE_MAPPING)
        return value->count == 1 ? "keyframes of numbers"
                                 : arena_format(ck->arena, "keyframes of vectors of %u", value->count);
    return arena_format(ck->arena, "%s, which is %s", found_text(ck, node), quantity_text(ck->arena, value));
}

/* ---- What was meant ---- */

static bool takes_mapping(const struct grammar_key *key) {
    return key->type == GRAMMAR_OBJECT || key->type == GRAMMAR_LIST;
}

static bool has_key(const struct grammar_kind *kind, const char *word) {
    const int index = kind ? grammar_find_key(kind, word) : -1;
    return index >= 0 && kind->keys[index].type != GRAMMAR_LATER;
}

static const char *key_names(struct checker *ck, const struct grammar_kind *kind, bool alternatives) {
    const char *all = "";
    for (int i = 0; i < kind->key_count; i++)
        if (kind->keys[i].type != GRAMMAR_LATER && (!alternatives || kind->keys[i].alternative))
            all = arena_format(ck->arena, "%s%s%s", all, *all ? ", " : "", kind->keys[i].name);
    return all;
}

static const char *shape_names(struct checker *ck) {
    const struct grammar_kind *kind = &grammar_kinds[KIND_OBJECT];
    const char *all = "";
    for (int i = 0; i < kind->key_count; i++)
        if (kind->keys[i].alternative && kind->keys[i].type == GRAMMAR_OBJECT)
            all = arena_format(ck->arena, "%s%s%s", all, *all ? ", " : "", kind->keys[i].name);
    return all;
}

static bool has_word(const char *const *words, const char *word) {
    for (; words && *words; words++)
        if (strcmp(*words, word) == 0) return true;
    return false;
}

/* The key of the kind that others call `word`, or -1; `near`: the nearest to what they call so. */
static int key_instead(const struct grammar_kind *kind, const char *word, bool near) {
    for (int i = 0; i < kind->key_count; i++)
        if (has_word(near ? kind->keys[i].near : kind->keys[i].instead, word)) return i;
    return -1;
}

/* `radius:0.5` is one word to YAML. Returns the length of the key, or 0. */
static int glued_key(const struct grammar_kind *kind, const char *word) {
    const char *colon = strchr(word, ':');
    for (int i = 0; colon && i < kind->key_count; i++)
        if (strlen(kind->keys[i].name) == (size_t)(colon - word) &&
            strncmp(kind->keys[i].name, word, (size_t)(colon - word)) == 0)
            return (int)(colon - word);
    return 0;
}

static bool help_glued(struct checker *ck, struct diagnostic *d, const struct grammar_kind *kind,
                       const char *word) {
    const int length = glued_key(kind, word);
    if (!length) return false;
    const char *value = word + length + 1;
    if (strncmp(value, "\xc2\xa0", 2) == 0) {
        diag_help(ck->diag, d, "the space after the colon is a non-breaking one (U+00A0): write `%.*s: %s`",
                  length, word, short_text(ck, value + 2));
        return true;
    }
    diag_help(ck->diag, d, "a space after the colon: `%.*s: %s`", length, word, short_text(ck, value));
    return true;
}

static bool help_invisible(struct checker *ck, struct diagnostic *d, const char *word) {
    static const char *const marks[][2] = {{"\xc2\xa0", "a non-breaking space (U+00A0)"},
                                           {"\xe2\x80\x8b", "a zero-width space (U+200B)"},
                                           {"\xe3\x80\x80", "an ideographic space (U+3000)"},
                                           {"\xef\xbb\xbf", "a byte order mark (U+FEFF)"}};
    for (size_t i = 0; i < sizeof marks / sizeof *marks; i++) {
        if (!strstr(word, marks[i][0])) continue;
        diag_help(ck->diag, d, "it has %s in it: YAML takes plain spaces alone", marks[i][1]);
        return true;
    }
    return false;
}

/* In `{radius: 1,5}` the 5 is a key without a value. */
bool report_help_comma(struct checker *ck, struct diagnostic *d, const struct node *mapping,
                       const struct node *key) {
    const struct node *before = NULL;
    if (diag_full(ck->diag)) return false;
    for (const struct node *k = mapping->first; k && k != key; k = k->next->next) before = k->next;
    if (!before || !node_is_null(key->next) || before->kind != NODE_SCALAR ||
        before->span.line != key->span.line)
        return false;
    const char *word = node_resolve(key)->text;
    const size_t at = key->span.source ? source_offset(key->span) : 0;
    if (at == 0 || key->span.source->text[at - 1] != ',' || !scalar_is_number(before->text) ||
        strspn(word, "0123456789") != strlen(word))
        return false;
    diag_help(ck->diag, d, "a decimal point is a point: did you mean %s.%s?", short_text(ck, before->text),
              short_text(ck, word));
    return true;
}

bool report_help_glued(struct checker *ck, struct diagnostic *d, const char *word) {
    const char *colon = strchr(word, ':');
    if (!colon || !scope_is_name(arena_text(ck->arena, word, (size_t)(colon - word)))) return false;
    diag_help(ck->diag, d, "a space after the colon: `%.*s: %s`", (int)(colon - word), word,
              short_text(ck, colon + 1));
    return true;
}

/* How many `(` of the text are not closed in it. */
static int open_brackets(const char *text) {
    int open = 0;
    for (; *text; text++) open += *text == '(' || *text == '[' ? 1 : *text == ')' || *text == ']' ? -1 : 0;
    return open;
}

bool report_cut(struct checker *ck, const char *what, const struct node *value) {
    const struct node *n = node_resolve(value);
    if (n->kind != NODE_SCALAR || n->quoted || !n->span.source || !strchr(n->text, '(') ||
        open_brackets(n->text) <= 0)
        return false;
    size_t stop, i = source_offset(n->span);
    const char *text = n->span.source->text, *begin = text + i;
    source_line(n->span.source, n->span.line, &stop);
    if (i + n->count >= stop || text[i + n->count] != ',') return false;
    for (int open = 0; i < stop; i++) { /* to where the value was meant to end */
        if (open == 0 && strchr(",]}", text[i])) break;
        open += strchr("([{", text[i]) ? 1 : strchr(")]}", text[i]) ? -1 : 0;
    }
    struct diagnostic *d = diag_error(ck->diag, n->span, "bad-expression",
                                      "`%s`: a comma ends the value here, within its ( )", what);
    const int length = (int)(text + i - begin);
    if (*begin == '(' && begin[length - 1] == ')')
        diag_help(ck->diag, d, "a list stands in [ ]: write [%.*s]", length - 2, begin + 1);
    else
        diag_help(ck->diag, d, "put it into quotes: \"%.*s\"", length, begin);
    return true;
}

bool report_cut_in(struct checker *ck, const char *what, const struct node *list) {
    for (const struct node *item = list->first; item; item = item->next)
        if (report_cut(ck, what, item)) return true;
    return false;
}

bool report_cut_before(struct checker *ck, const struct node *mapping, const struct node *key) {
    const struct node *name = NULL; /* of the last value that is there */
    if (!node_is_null(key->next) || diag_full(ck->diag)) return false;
    enum { MOST = 16 }; /* arguments of a call: a longer row of keys without values is something else */
    int since = 0;
    for (const struct node *k = mapping->first; k && k != key; k = k->next->next, since++)
        if (!node_is_null(k->next)) name = k, since = 0;
    return name && since <= MOST && node_resolve(name)->kind == NODE_SCALAR &&
           report_cut(ck, node_resolve(name)->text, name->next);
}

/* The key of the kind under which `word` belongs, because its mappings have it: one that is given, or
 * the only one that might be. NULL: none. */
static const struct grammar_key *key_around(const struct grammar_kind *kind, const struct mapping *mapping,
                                            const char *word) {
    const struct grammar_key *found = NULL;
    unsigned count = 0;
    for (int i = 0; i < kind->key_count; i++) {
        const struct grammar_key *key = &kind->keys[i];
        if (!takes_mapping(key) || !has_key(key->of, word) || key->of == kind) continue;
        if (mapping->given[i]) return key;
        if (key->alternative) continue;
        found = key;
        count++;
    }
    return count == 1 ? found : NULL;
}

static bool help_around(struct checker *ck, struct diagnostic *d, const struct grammar_kind *kind,
                        struct mapping *mapping, const char *word) {
    const struct grammar_key *inner = key_around(kind, mapping, word);
    const struct surrounding *around = &ck->around;
    const bool outer = around->kind && around->kind != kind &&
                       (has_key(around->kind, word) || key_instead(around->kind, word, false) >= 0);
    if (inner && inner->type == GRAMMAR_LIST && !inner->single)
        diag_help(ck->diag, d, "it is a key of %s: write `%s: [{%s: ...}]`", inner->of->title, inner->name,
                  word);
    else if (inner)
        diag_help(ck->diag, d, "it is a key of %s: write `%s: {%s: ...}`", inner->of->title, inner->name,
                  word);
    else if (outer)
        diag_help(ck->diag, d, "it belongs beside `%s`, not into it", around->key->name);
    if (inner) mapping->meant |= (uint64_t)1 << (inner - kind->keys);
    return inner || outer;
}

/* "a key of a light and of a plane"; false: of none, or of too many to tell. */
static bool help_elsewhere(struct checker *ck, struct diagnostic *d, const char *word) {
    const char *all = "";
    int count = 0;
    for (int i = 0; i < grammar_kind_count; i++)
        if (has_key(&grammar_kinds[i], word) && ++count <= 3)
            all = arena_format(ck->arena, "%s%s%s", all, *all ? " and of " : "", grammar_kinds[i].title);
    if (count == 0 || count > 3) return false;
    diag_help(ck->diag, d, "it is a key of %s", all);
    return true;
}

/* ---- Unknown keys ---- */

static struct spelling nearest_key(const struct grammar_kind *kind, const char *word) {
    struct spelling s = spelling_begin(word);
    for (int i = 0; i < kind->key_count; i++)
        if (kind->keys[i].type != GRAMMAR_LATER) spelling_offer(&s, kind->keys[i].name);
    return s;
}

int meant_key(const struct grammar_kind *kind, const char *word) {
    const int instead = key_instead(kind, word, false);
    const struct spelling s = nearest_key(kind, word);
    return instead >= 0 || !s.best || s.distance == 0 ? instead : grammar_find_key(kind, s.best);
}

/* Shapes that other renderers have. */
static bool is_foreign_shape(const char *word) {
    static const char *const shapes[] = {
        "triangle",     "triangles", "polygon", "mesh",        "mesh2",      "trimesh",
        "obj",          "model",     "torus",   "blob",        "text",       "heightfield",
        "height_field", "prism",     "pyramid", "tetrahedron", "capsule",    "superellipsoid",
        "lathe",        "sor",       "bezier",  "curve",       "isosurface", "metaball",
        "rounded_box",  "round_box", "ring",    "annulus",     "tube",       NULL};
    return has_word(shapes, word);
}

/* A number, or a row of three, without expressions. */
static bool written_numbers(struct checker *ck, const struct node *node, double out[3]) {
    const struct node *n = node_resolve(node), *item = n->first;
    if (n->kind == NODE_SCALAR && scalar_number(ck, n->text, &out[0])) {
        out[1] = out[2] = out[0];
        return true;
    }
    if (n->kind != NODE_SEQUENCE || n->count != 3) return false;
    for (int i = 0; i < 3; i++, item = item->next) {
        const struct node *part = node_resolve(item);
        if (part->kind != NODE_SCALAR || !scalar_number(ck, part->text, &out[i])) return false;
    }
    return true;
}

static bool is_box_word(const char *word) {
    static const char *const words[] = {"size",  "center", "centre", "position", "at",
                                        "width", "height", "depth",  "side",     NULL};
    return has_word(words, word);
}

/* Whether the box's size or middle has been answered, at a key before this one. */
static bool is_box_told(const struct node *box, const struct node *key) {
    bool told = false;
    for (const struct node *k = box->first; k != key; k = k->next->next)
        told |= node_resolve(k)->kind == NODE_SCALAR && is_box_word(node_resolve(k)->text);
    return told && is_box_word(node_resolve(key)->text);
}

/* `box: {size: 2, center: [1, 0, 0]}`: its corners, where both are numbers that are written there. */
static bool help_box(struct checker *ck, struct diagnostic *d, const struct node *box, const char *word) {
    if (!is_box_word(word)) return false;
    const struct node *center = node_get(box, "center"), *size = node_get(box, "size");
    double middle[3] = {0, 0, 0}, sides[3] = {1, 1, 1};
    if (size && written_numbers(ck, size, sides) && (!center || written_numbers(ck, center, middle)))
        diag_help(ck->diag, d, "write {min: [%g, %g, %g], max: [%g, %g, %g]}", middle[0] - sides[0] / 2,
                  middle[1] - sides[1] / 2, middle[2] - sides[2] / 2, middle[0] + sides[0] / 2,
                  middle[1] + sides[1] / 2, middle[2] + sides[2] / 2);
    else
        diag_help(ck->diag, d,
                  "give its corners `min` and `max`, or scale and move `box: {}` by a `transform`");
    return true;
}

bool is_number_for_row(const struct grammar_key *key, const struct node *value) {
    const struct node *n = node_resolve(value);
    return (key->type == GRAMMAR_POINT || key->type == GRAMMAR_DIRECTION) && n->kind == NODE_SCALAR &&
           scalar_is_number(n->text);
}

/* What the key was meant to be: `point`, or `point: [x, y, z]` where a number stands under it. */
static const char *meant_text(struct checker *ck, const struct grammar_key *meant, const struct node *key) {
    return is_number_for_row(meant, key->next) ? arena_format(ck->arena, "%s: [x, y, z]", meant->name)
                                               : meant->name;
}

/* The help for an unknown key, the surest first; returns the key that was meant, or -1. */
static int help_unknown(struct checker *ck, struct diagnostic *d, const struct grammar_kind *kind,
                        struct mapping *mapping, const struct node *key) {
    const char *word = node_resolve(key)->text;
    if (help_glued(ck, d, kind, word) || help_invisible(ck, d, word) ||
        report_help_comma(ck, d, mapping->node, key))
        return -1;
    if (kind == &grammar_kinds[KIND_BOX] && help_box(ck, d, mapping->node, word)) return -1;
    if (kind == &grammar_kinds[KIND_SPHERE] && strcmp(word, "radii") == 0) {
        diag_help(ck->diag, d, "an ellipsoid is a sphere under `transform: {scale: [1, 2, 3]}`");
        return -1;
    }
    const struct spelling s = nearest_key(kind, word);
    const int instead = key_instead(kind, word, false), near = key_instead(kind, word, true);
    if (kind == &grammar_kinds[KIND_OBJECT] && is_foreign_shape(word)) {
        diag_help(ck->diag, d, "this shape is not there");
        return -1;
    }
    if (instead >= 0) {
        diag_help(ck->diag, d, "it is called `%s` here", meant_text(ck, &kind->keys[instead], key));
        return instead;
    }
    const int best = s.best ? grammar_find_key(kind, s.best) : -1;
    if (s.best && s.distance <= 1) {
        diag_help(ck->diag, d, "did you mean `%s`?", meant_text(ck, &kind->keys[best], key));
        return best;
    }
    if (help_around(ck, d, kind, mapping, word)) return -1;
    if (near >= 0)
        diag_help(ck->diag, d, "the nearest is `%s`: %s", kind->keys[near].name, kind->keys[near].doc);
    else if (s.best)
        diag_help(ck->diag, d, "did you mean `%s`?", meant_text(ck, &kind->keys[best], key));
    else
        help_elsewhere(ck, d, word);
    return near < 0 ? best : -1;
}

int report_unknown_key(struct checker *ck, const struct grammar_kind *kind, struct mapping *mapping,
                       const struct node *key) {
    if (only_counted(ck, key->span) || report_cut_before(ck, mapping->node, key)) return -1;
    if (kind == &grammar_kinds[KIND_BOX] && is_box_told(mapping->node, key)) return -1;
    const char *word = node_resolve(key)->text;
    const bool shape = kind == &grammar_kinds[KIND_OBJECT] && is_foreign_shape(word);
    struct diagnostic *d = diag_error(ck->diag, key->span, "unknown-key", "%s has no key `%s`", kind->title,
                                      short_text(ck, word));
    const int meant = help_unknown(ck, d, kind, mapping, key);
    if (shape)
        diag_note(ck->diag, d, "the shapes are %s", shape_names(ck));
    else
        diag_note(ck->diag, d, "%s takes %s", kind->title, key_names(ck, kind, false));
    if (key->merged || mapping->object->span.line != mapping->node->span.line ||
        mapping->object->span.column != mapping->node->span.column)
        diag_related(ck->diag, d, mapping->object->span, "%s is read here", kind->title);
    return meant;
}

/* `diffuse: #ff0000`: a comment to YAML. */
bool report_help_hash(struct checker *ck, struct diagnostic *d, const struct node *name) {
    const struct source *source = name->span.source;
    size_t end;
    source_line(source, name->span.line, &end);
    const char *c = source->text + source_offset(name->span), *stop = source->text + end;
    while (c < stop && *c != '#') c++;
    vec3 ignored;
    const char *word = arena_text(ck->arena, c, (size_t)(stop - c));
    word = arena_text(ck->arena, word, strcspn(word, " \r"));
    if (*word != '#' || !color_parse(word, &ignored)) return false;
    diag_help(ck->diag, d, "`#` starts a comment: write \"%s\", in quotes", word);
    return true;
}

void report_no_value(struct checker *ck, const struct grammar_key *key, const struct node *name) {
    if (only_counted(ck, name->span)) return;
    struct diagnostic *d = diag_error(ck->diag, name->span, "no-value", "`%s` has no value", key->name);
    const struct node *next = name->next->next ? node_resolve(name->next->next) : NULL; /* the key after it */
    if (takes_mapping(key) && next && next->kind == NODE_SCALAR && has_key(key->of, next->text))
        diag_help(ck->diag, d, "indent `%s` further, so that it belongs to `%s`", next->text, key->name);
    else if (key->type == GRAMMAR_OBJECT && !key->named)
        diag_help(ck->diag, d, "for all its defaults write `%s: {}`", key->name);
    else if (report_help_hash(ck, d, name))
        return;
    else if (key->type == GRAMMAR_COLOR || key->type == GRAMMAR_AMOUNT)
        diag_help(ck->diag, d, "give it one or remove it; a colour like \"#ffd700\" needs its quotes");
    else if (key->required && key->example)
        diag_help(ck->diag, d, "give it one, as in `%s`", key->example);
    else
        diag_help(ck->diag, d, "give it one, or remove the key");
}

/* ---- Something else than a mapping, a list or a name ---- */

static bool has_choice(const struct grammar_key *key, const char *word) {
    return key->type == GRAMMAR_CHOICE && has_word(key->choices, word);
}

/* Whether the node alone would be a value of the key: for "write {key: value}". */
static bool fits(const struct grammar_key *key, const struct node *n) {
    vec3 color;
    const bool word = n->kind == NODE_SCALAR && n->count > 0, row = n->kind == NODE_SEQUENCE && n->count == 3;
    switch (key->type) {
    case GRAMMAR_NUMBER: return word && scalar_is_number(n->text);
    case GRAMMAR_INTEGER: return key->required && word && scalar_is_number(n->text);
    case GRAMMAR_CHOICE: return word && has_choice(key, n->text);
    case GRAMMAR_POINT: return row;
    case GRAMMAR_COLOR: return row || (word && color_parse(n->text, &color));
    default: return false;
    }
}

/* The only key that the node would fit, one that must be given before others; of a material's
 * colours, its colour. */
static const struct grammar_key *fitting_key(const struct grammar_kind *kind, const struct node *n) {
    const struct grammar_key *found = NULL,
                             *diffuse = &grammar_kinds[KIND_MATERIAL].keys[KEY_MATERIAL_DIFFUSE];
    if (kind == &grammar_kinds[KIND_MATERIAL] && fits(diffuse, n)) return diffuse;
    for (int i = 0; i < kind->key_count; i++) {
        if (!fits(&kind->keys[i], n)) continue;
        if (kind->keys[i].required) return &kind->keys[i];
        if (found) return NULL;
        found = &kind->keys[i];
    }
    return found;
}

/* The scalar or the row of scalars as one would write it. */
static const char *written(struct checker *ck, const struct node *n) {
    if (n->kind == NODE_SCALAR)
        return arena_format(ck->arena, *n->text == '#' ? "\"%s\"" : "%s", short_text(ck, n->text));
    const char *all = "[";
    for (const struct node *item = n->first; item; item = item->next) {
        const struct node *i = node_resolve(item);
        all = arena_format(ck->arena, "%s%s%s", all, i->kind == NODE_SCALAR ? short_text(ck, i->text) : "...",
                           item->next ? ", " : "]");
    }
    return all;
}

static bool help_fitting(struct checker *ck, struct diagnostic *d, const struct grammar_kind *kind,
                         const struct node *n) {
    const bool grey =
        kind == &grammar_kinds[KIND_AMBIENT_LIGHT] && n->kind == NODE_SCALAR && scalar_is_number(n->text);
    if (grey) diag_help(ck->diag, d, "write {color: [%s, %s, %s]}", n->text, n->text, n->text);
    if (grey) return true;
    const struct grammar_key *key = fitting_key(kind, n);
    if (key) diag_help(ck->diag, d, "write {%s: %s}", key->name, written(ck, n));
    return key != NULL;
}

/* Items that start with `- ` where keys are expected. */
static bool is_list_of_mappings(const struct node *n) {
    return n->kind == NODE_SEQUENCE && n->first && node_resolve(n->first)->kind == NODE_MAPPING;
}

void report_no_mapping(struct checker *ck, const struct grammar_kind *kind, const struct node *node) {
    if (only_counted(ck, node->span)) return;
    const struct node *n = node_resolve(node);
    struct diagnostic *d = diag_error(ck->diag, node->span, "not-a-mapping", "expected %s, found %s",
                                      kind->title, found_text(ck, node));
    const bool word = n->kind == NODE_SCALAR;
    const int index = word ? grammar_find_key(kind, n->text) : -1;
    const struct spelling s = word ? nearest_key(kind, n->text) : spelling_begin("");
    if (index >= 0 && kind->keys[index].type == GRAMMAR_OBJECT)
        diag_help(ck->diag, d, "write `%s: {}`", n->text);
    else if (kind == &grammar_kinds[KIND_FILE])
        diag_help(ck->diag, d, "the smallest scene is:  scene: [{sphere: {}}]");
    else if (index >= 0 && kind->keys[index].type != GRAMMAR_LATER)
        diag_help(ck->diag, d, "write {%s: ...}", n->text);
    else if (kind == &grammar_kinds[KIND_ROTATE] && n->kind == NODE_SEQUENCE)
        diag_help(ck->diag, d, "a step for each axis, as in [{rotate: {x: 30}}, {rotate: {y: 45}}]");
    else if (kind == &grammar_kinds[KIND_ROTATE])
        diag_help(ck->diag, d, "name the axis: `rotate: {z: 45}`");
    else if (kind == &grammar_kinds[KIND_TEMPLATE] && (n->kind == NODE_SEQUENCE || node_is_null(n)))
        diag_help(ck->diag, d, "write {objects: [...]}");
    else if (node_is_null(n))
        diag_help(ck->diag, d,
                  kind->keys[0].alternative ? "write one, or remove the item"
                                            : "for all its defaults write {}");
    else if (word && help_glued(ck, d, kind, n->text))
        return;
    else if (is_list_of_mappings(n))
        diag_help(ck->diag, d, "write its keys without `- `");
    else if (!help_fitting(ck, d, kind, n)) {
        if (s.best) diag_help(ck->diag, d, "did you mean `%s`?", s.best);
        diag_note(ck->diag, d, "%s takes %s", kind->title, key_names(ck, kind, false));
    }
}

void report_no_list(struct checker *ck, const struct grammar_key *key, const struct node *node) {
    if (only_counted(ck, node->span)) return;
    const struct node *n = node_resolve(node);
    struct diagnostic *d =
        diag_error(ck->diag, node->span, "not-a-list", "`%s`: expected a list of %ss, found %s", key->name,
                   strchr(key->of->title, ' ') + 1, found_text(ck, node));
    const struct node *first = n->kind == NODE_MAPPING && n->first ? node_resolve(n->first) : NULL;
    if (first && first->kind == NODE_SCALAR && first->text[0] == '-' &&
        isalpha((unsigned char)first->text[1]))
        diag_help(ck->diag, d, "a space after the dash: write `- %s`", short_text(ck, first->text + 1));
    else if (n->kind == NODE_MAPPING)
        diag_help(ck->diag, d, "start each one with `- `");
    else if (n->kind == NODE_SCALAR && has_key(key->of, n->text))
        diag_help(ck->diag, d, "write `%s: [{%s: ...}]`", key->name, n->text);
    else if (key->example)
        diag_help(ck->diag, d, "as in `%s`", key->example);
}

void report_no_map(struct checker *ck, const struct grammar_key *key, const struct node *node) {
    if (only_counted(ck, node->span)) return;
    const bool values = key->type == GRAMMAR_VALUES;
    struct diagnostic *d =
        diag_error(ck->diag, node->span, "not-a-map", "`%s`: expected names, each with %s, found %s",
                   key->name, values ? "a value" : key->of->title, found_text(ck, node));
    if (values && key->example)
        diag_help(ck->diag, d, "as in `%s`", key->example);
    else if (is_list_of_mappings(node_resolve(node)))
        diag_help(ck->diag, d, "write names instead of `- `, as in `%s: {gold: {...}}`", key->name);
    else
        diag_help(ck->diag, d, "as in `%s: {gold: {...}}`", key->name);
}

/* `material: glass`, where there is a preset of that name. */
static bool help_preset(struct checker *ck, struct diagnostic *d, const char *word) {
    const struct definitions *presets = define_presets(ck);
    struct spelling s = spelling_begin(word);
    for (const struct definition *def = presets->first; def; def = def->next) spelling_offer(&s, def->name);
    const bool is = s.best && s.distance <= 1;
    if (is) diag_help(ck->diag, d, "write {preset: %s}", s.best);
    return is;
}

void report_no_name(struct checker *ck, const struct grammar_key *key, const struct definitions *among,
                    const struct node *node) {
    if (only_counted(ck, node->span)) return;
    const struct node *n = node_resolve(node);
    const char *what = strchr(key->of->title, ' ') + 1;
    struct spelling s = spelling_begin(n->text);
    for (const struct definition *def = among->first; def; def = def->next) spelling_offer(&s, def->name);
    struct diagnostic *d = diag_error(ck->diag, node->span, "unknown-name", "no %s is named `%s`",
                                      among == &ck->presets ? "preset" : what, short_text(ck, n->text));
    if (s.best) {
        const struct definition *def = table_find(&among->names, s.best);
        diag_help(ck->diag, d, "did you mean `%s`?", s.best);
        if (among != &ck->presets) diag_related(ck->diag, d, def->span, "`%s` is defined here", s.best);
    } else if (among == &ck->presets) {
        const char *all = "";
        for (const struct definition *def = among->first; def; def = def->next)
            all = arena_format(ck->arena, "%s%s%s", all, *all ? ", " : "", def->name);
        diag_note(ck->diag, d, "the presets are %s", all);
    } else if (!scope_is_name(n->text) && strpbrk(n->text, "?(")) {
        diag_help(ck->diag, d,
                  "a name is not computed: give each its own item, with a `when`; or loop over names, `for: "
                  "{part: [a, b]}`");
    } else if (among == &ck->templates) {
        diag_help(ck->diag, d, "define it: `define: {%s: {objects: [...]}}`", short_text(ck, n->text));
    } else if (!help_preset(ck, d, n->text) && !help_fitting(ck, d, key->of, n)) {
        diag_help(ck->diag, d, among->first ? "define it under `%ss:`" : "define it: `%ss: {%s: {...}}`",
                  what, short_text(ck, n->text));
    }
}

void report_no_alternative(struct checker *ck, const struct object_value *object) {
    if (only_counted(ck, object->span)) return;
    struct diagnostic *d =
        diag_error(ck->diag, object->span, "no-alternative", "%s without its kind", object->kind->title);
    diag_note(ck->diag, d, "%s has one of %s", object->kind->title, key_names(ck, object->kind, true));
}
