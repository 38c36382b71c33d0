/* Names that the files define: parameters, templates and materials, in any order. */
#include <stdlib.h>
#include <string.h>

#include "lang/checker.h"
#include "lang/file.h"
#include "lang/problem.h"
#include "lang/spelling.h"

/* ---- What may be a name ---- */

const char *define_name_taken(const char *name) {
    static const char *const moving[] = {"frame", "t", "time"};
    vec3 color;
    for (int i = 0; i < 3; i++)
        if (strcmp(name, moving[i]) == 0) return "the animation has that name";
    for (int i = 0; i < grammar_constant_count; i++)
        if (strcmp(name, grammar_constants[i].name) == 0) return "a constant has that name";
    return color_parse(name, &color) ? "a colour has that name" : NULL;
}

bool define_name_allowed(struct checker *ck, const char *what, const struct node *name) {
    const struct node *n = node_resolve(name);
    if (n->kind != NODE_SCALAR) {
        diag_error(ck->diag, name->span, "key-not-a-word", "the name of %s is a word, found %s", what,
                   found_text(ck, name));
        return false;
    }
    const char *taken = scope_is_name(n->text) ? define_name_taken(n->text)
                                               : "letters, digits and _ make a name, the first no digit";
    if (!taken) return true;
    struct diagnostic *d = diag_error(ck->diag, name->span, "bad-name", "%s cannot be named `%s`", what,
                                      short_text(ck, n->text));
    if (!report_help_glued(ck, d, n->text)) diag_help(ck->diag, d, "%s", taken);
    return false;
}

static void report_twice(struct checker *ck, const struct node *name, struct span before) {
    struct diagnostic *d = diag_error(ck->diag, name->span, "defined-twice", "`%s` is defined twice",
                                      short_text(ck, node_resolve(name)->text));
    diag_related(ck->diag, d, before, "first defined here");
}

/* ---- Parameters ---- */

static struct node *given_from_outside(struct checker *ck, const char *name) {
    for (size_t i = ck->input->define_count; i-- > 0;) {
        const struct lang_define *def = &ck->input->defines[i];
        if (strcmp(def->name, name) != 0) continue;
        struct arena *arena = &ck->memory->kept;
        const char *title = arena_format(arena, "-D %s", name);
        const struct source *source = file_from_memory(arena, title, def->value, strlen(def->value));
        const struct node_limits limits = {ck->input->limits.nesting, ck->input->limits.values};
        struct node_problem problem = {0};
        struct node *node = *def->value && *def->value != '#'
                                ? node_parse(arena, ck->diag, source, &limits, NULL, &problem)
                                : NULL;
        if (node) return node;
        if (problem.text) problem_report(ck->diag, &problem);
        node = arena_alloc(arena, sizeof *node); /* a colour, or nothing */
        *node = (struct node){.span = {source, 0, 0, (uint32_t)strlen(def->value)},
                              .text = def->value,
                              .count = (uint32_t)strlen(def->value)};
        return node;
    }
    return NULL;
}

/* Neither a name nor a value: `h:1`, or what a comma cut off. check.c reports it. */
static bool is_no_pair(const struct node *name) {
    const struct node *n = node_resolve(name);
    return node_is_null(name->next) && n->kind == NODE_SCALAR && !scope_is_name(n->text);
}

static void declare_parameters(struct checker *ck, const struct node *value) {
    const struct node *n = node_resolve(value);
    if (n->kind != NODE_MAPPING) {
        ck->variables_lost = true; /* reported with the rest of the file */
        return;
    }
    for (const struct node *name = n->first; name; name = name->next->next) {
        if (is_no_pair(name)) { /* its name is not known */
            ck->variables_lost = true;
            continue;
        }
        if (!define_name_allowed(ck, "a parameter", name)) continue;
        const struct parameter *before = table_find(&ck->parameters, node_resolve(name)->text);
        if (before) {
            report_twice(ck, name, before->span);
            continue;
        }
        struct parameter *p = arena_alloc(&ck->memory->kept, sizeof *p);
        *p = (struct parameter){.name = node_resolve(name)->text, .span = name->span, .node = name->next};
        p->given = given_from_outside(ck, p->name);
        table_put(&ck->memory->kept, &ck->parameters, p->name, p);
        *ck->parameters_end = p;
        ck->parameters_end = &p->next;
    }
}

/* What the reading of a definition must not see: it is the same wherever it is needed first. */
struct elsewhere {
    struct arena *arena;
    const struct scope *scope;
    const struct diag_frame *frame;
    struct surrounding around;
    bool rehearsing;
};

/* After place_descend. */
static struct elsewhere leave(struct checker *ck) {
    const struct elsewhere here = {ck->arena, ck->scope, ck->diag->frame, ck->around, ck->rehearsing};
    ck->arena = &ck->memory->kept;
    ck->scope = NULL;
    ck->diag->frame = NULL;
    ck->around = (struct surrounding){0};
    ck->rehearsing = false;
    return here;
}

static void come_back(struct checker *ck, const struct elsewhere *here) {
    ck->arena = here->arena;
    ck->scope = here->scope;
    ck->diag->frame = here->frame;
    ck->around = here->around;
    ck->rehearsing = here->rehearsing;
    ck->depth--;
}

/* Whether the mapping declares a parameter; else it is a value, as a material might be. */
static bool is_declaration(const struct node *mapping) {
    for (const struct node *name = mapping->first; name; name = name->next->next) {
        const struct node *word = node_resolve(name);
        if (word->kind != NODE_SCALAR) continue;
        if (strcmp(word->text, "default") == 0 || strcmp(word->text, "doc") == 0 ||
            meant_key(&grammar_kinds[KIND_PARAM], word->text) == KEY_PARAM_DEFAULT)
            return true;
    }
    return false;
}

bool define_in_range(struct checker *ck, const char *name, const struct node *declared,
                     const struct node *value) {
    const struct node *n = node_resolve(declared);
    if (n->kind != NODE_MAPPING || !is_declaration(n)) return true;
    const struct object_value *object = check_object(ck, &grammar_kinds[KIND_PARAM], declared);
    if (!object || object->failed) return false;
    struct grammar_key key = {.name = name,
                              .type = GRAMMAR_NUMBER,
                              .has_min = object_has(object, KEY_PARAM_MIN),
                              .has_max = object_has(object, KEY_PARAM_MAX),
                              .min = object_number(object, KEY_PARAM_MIN),
                              .max = object_number(object, KEY_PARAM_MAX)};
    double ignored;
    if (key.has_min && key.has_max && key.min > key.max) {
        diag_error(ck->diag, object_span(object, KEY_PARAM_MAX), "contradiction",
                   "`%s`: the `max` is less than the `min`", name);
        return false;
    }
    return !(key.has_min || key.has_max) || check_number(ck, &key, value, &ignored);
}

static void report_parameter_cycle(struct checker *ck, const struct parameter *p) {
    enum { MOST = 6 };
    const struct parameter *chain[MOST] = {NULL}; /* from the one that needs p back to p */
    int count = 0;
    struct diagnostic *d =
        diag_error(ck->diag, p->span, "definition-cycle", "the parameter `%s` is defined by itself", p->name);
    for (const struct parameter *at = ck->parameter; at; at = at == p ? NULL : at->needed_by)
        chain[count++ % MOST] = at;
    for (int i = count; i-- > (count > MOST ? count - MOST : 0);) {
        const struct parameter *at = chain[i % MOST], *next = i > 0 ? chain[(i - 1) % MOST] : p;
        diag_related(ck->diag, d, at->node->span, "`%s` needs `%s`", at->name, next->name);
    }
}

const struct binding *define_parameter(struct checker *ck, struct parameter *p) {
    p->used = true;
    if (p->state == READING_DONE) return p->binding.name ? &p->binding : NULL;
    if (p->state == READING_UNDER_WAY) {
        report_parameter_cycle(ck, p);
        p->binding = (struct binding){.name = p->name, .kind = BINDING_UNKNOWN};
        return &p->binding;
    }
    enum { MOST = 40 }; /* expressions, each 100 levels deep */
    if (!place_nest(ck, p->span, &ck->waiters, MOST, "parameters that wait for each other")) return NULL;
    if (!place_descend(ck, p->node->span)) {
        ck->waiters--;
        return NULL;
    }
    const struct elsewhere here = leave(ck);
    const struct node *value = p->given ? p->given : place_default(p->node);
    p->state = READING_UNDER_WAY;
    p->needed_by = ck->parameter;
    ck->parameter = p;
    const bool waited = ck->waiting;
    ck->waiting = false;
    const bool good =
        scope_bind(ck, p->name, value, &p->binding) && define_in_range(ck, p->name, p->node, value);
    ck->parameter = p->needed_by;
    p->state = ck->waiting ? READING_UNREAD : READING_DONE;
    const bool later = ck->waiting;
    ck->waiting |= waited;
    come_back(ck, &here);
    ck->waiters--;
    if (later) return NULL;
    if (!good) p->binding.kind = BINDING_UNKNOWN; /* reported: what uses it is not to blame */
    return &p->binding;
}

/* ---- Materials and templates ---- */

static void declare(struct checker *ck, struct definitions *all, const struct grammar_kind *kind,
                    const struct node *value) {
    const struct node *n = node_resolve(value);
    if (n->kind != NODE_MAPPING) {
        if (all == &ck->materials) ck->names_lost = true;
        return;
    }
    for (const struct node *name = n->first; name; name = name->next->next) {
        if (node_resolve(name)->kind != NODE_SCALAR) {
            diag_error(ck->diag, name->span, "key-not-a-word", "the name of %s is a word, found %s",
                       kind->title, found_text(ck, name));
            continue;
        }
        const struct definition *before = table_find(&all->names, node_resolve(name)->text);
        if (before) {
            report_twice(ck, name, before->span);
            continue;
        }
        struct definition *def = arena_alloc(&ck->memory->kept, sizeof *def);
        *def = (struct definition){.kind = kind,
                                   .name = node_resolve(name)->text,
                                   .span = name->span,
                                   .node = name->next,
                                   .number = all->count++};
        table_put(&ck->memory->kept, &all->names, def->name, def);
        if (!all->first) all->end = &all->first;
        *all->end = def;
        all->end = &def->next;
    }
}

/* The template as its author wrote it, with any values of its parameters: so that no slip in it waits
 * for somebody to use it. */
static void rehearse_template(struct checker *ck, const struct node *node,
                              const struct object_value *template) {
    const struct value *parameters = template->fields[KEY_TEMPLATE_PARAMS],
                       *objects = template->fields[KEY_TEMPLATE_OBJECTS];
    const struct node *declared = parameters ? node_resolve(parameters->node) : NULL;
    if (!parameters && node_resolve(node)->kind == NODE_MAPPING && node_get(node_resolve(node), "params"))
        return; /* reported: its names are not known */
    const bool lost = ck->variables_lost;
    struct arena *kept = ck->arena;
    ck->arena = &ck->memory->scratch;
    const struct arena_mark before = arena_mark(ck->arena);
    struct binding *bindings =
        arena_array(ck->arena, declared && declared->count ? declared->count : 1, sizeof *bindings);
    struct scope scope = {NULL, bindings, 0};
    ck->rehearsing = ck->in_template = true;
    for (const struct node *name = declared ? declared->first : NULL; name; name = name->next->next) {
        struct binding ignored;
        if (is_no_pair(name) || !define_name_allowed(ck, "a parameter", name)) {
            ck->variables_lost = true; /* its uses are not to blame */
            continue;
        }
        ck->scope = &scope;
        const struct node *value = place_default(name->next);
        if (!node_is_null(name->next) && scope_bind(ck, node_resolve(name)->text, value, &ignored))
            define_in_range(ck, node_resolve(name)->text, name->next, value);
        bindings[scope.count++] = (struct binding){.name = node_resolve(name)->text, .kind = BINDING_UNKNOWN};
    }
    ck->scope = &scope;
    if (objects) place_members(ck, KIND_TEMPLATE, KEY_TEMPLATE_OBJECTS, objects->node);
    ck->rehearsing = ck->in_template = false;
    ck->variables_lost = lost;
    arena_release(ck->arena, before);
    ck->arena = kept;
}

/* Whether each parameter of the template has a name and a value; where not, it is reported elsewhere. */
static bool parameters_good(const struct object_value *template) {
    const struct value *parameters = template->fields[KEY_TEMPLATE_PARAMS];
    for (const struct node *name = parameters ? node_resolve(parameters->node)->first : NULL; name;
         name = name->next->next) {
        const struct node *n = node_resolve(name);
        if (node_is_null(name->next) || n->kind != NODE_SCALAR || !scope_is_name(n->text)) return false;
    }
    return true;
}

static struct object_value *failed_object(struct checker *ck, const struct definition *def) {
    struct object_value *object = arena_alloc(ck->arena, sizeof *object);
    *object = (struct object_value){.kind = def->kind, .span = def->span, .failed = true};
    object->fields = arena_array(ck->arena, (size_t)def->kind->key_count, sizeof *object->fields);
    return object;
}

static void report_extends_cycle(struct checker *ck, const struct definition *def) {
    struct diagnostic *d = diag_error(ck->diag, def->span, "definition-cycle",
                                      "the material `%s` extends itself", short_text(ck, def->name));
    const struct definition *at = def;
    for (int i = 0; at && i < 6 && (at != def || i == 0); i++) {
        const struct node *base = node_get(node_resolve(at->node), "extends");
        diag_related(ck->diag, d, base->span, "`%s` extends `%s`", short_text(ck, at->name),
                     short_text(ck, node_resolve(base)->text));
        at = table_find(&ck->materials.names, node_resolve(base)->text);
    }
}

struct object_value *define_read(struct checker *ck, struct definition *def) {
    def->used = true;
    if (def->state == READING_DONE) return def->object;
    if (def->state == READING_UNDER_WAY) {
        if (def->kind != &grammar_kinds[KIND_TEMPLATE]) report_extends_cycle(ck, def);
        return NULL;
    }
    if (!place_descend(ck, def->node->span)) return NULL;
    const struct elsewhere here = leave(ck);
    const bool waited = ck->waiting;
    const unsigned errors = ck->diag->errors;
    ck->waiting = false;
    def->state = READING_UNDER_WAY;
    def->object = check_object(ck, def->kind, def->node);
    if (!def->object) def->object = failed_object(ck, def);
    if (def->kind == &grammar_kinds[KIND_TEMPLATE] && !ck->waiting)
        rehearse_template(ck, def->node, def->object);
    def->object->failed |= ck->diag->errors != errors; /* what was told before is not counted again */
    if (def->kind == &grammar_kinds[KIND_TEMPLATE]) def->object->failed |= !parameters_good(def->object);
    def->object->name = def->name;
    def->object->definition = def->number;
    def->state = ck->waiting ? READING_UNREAD : READING_DONE;
    const bool later = ck->waiting;
    ck->waiting |= waited;
    come_back(ck, &here);
    return later ? NULL : def->object;
}

static void read_all(struct checker *ck, struct definitions *all) {
    for (struct definition *def = all->first; def && !ck->stopped; def = def->next) {
        const bool used = def->used;
        define_read(ck, def);
        def->used = used;
    }
}

/* ---- Presets ---- */

struct definitions *define_presets(struct checker *ck) {
    if (ck->presets.first) return &ck->presets;
    struct arena *arena = &ck->memory->kept;
    const struct source *source =
        file_from_memory(arena, "presets.yaml", grammar_presets, strlen(grammar_presets));
    const struct node_limits limits = {20, 100000};
    struct node_problem problem = {0};
    const struct node *root = node_parse(arena, ck->diag, source, &limits, NULL, &problem);
    if (root) declare(ck, &ck->presets, &grammar_kinds[KIND_MATERIAL], node_get(root, "materials"));
    return &ck->presets;
}

/* ---- Files ---- */

static void read_animation(struct checker *ck, const struct node *value) {
    if (!place_descend(ck, value->span)) return;
    const struct elsewhere here = leave(ck);
    const struct object_value *animation = check_object(ck, &grammar_kinds[KIND_ANIMATION], value);
    if (animation && !animation->failed)
        ck->animation = animation;
    else
        ck->variables_lost = true;
    come_back(ck, &here);
}

static void declare_pair(struct checker *ck, const struct unit *unit, const char *word,
                         const struct node *value) {
    if (node_is_null(value)) {
        ck->names_lost |= strcmp(word, "materials") == 0;
        ck->variables_lost |= strcmp(word, "params") == 0;
        return;
    }
    if (strcmp(word, "params") == 0)
        declare_parameters(ck, value);
    else if (strcmp(word, "define") == 0)
        declare(ck, &ck->templates, &grammar_kinds[KIND_TEMPLATE], value);
    else if (strcmp(word, "materials") == 0)
        declare(ck, &ck->materials, &grammar_kinds[KIND_MATERIAL], value);
    else if (strcmp(word, "include") == 0)
        include_files(ck, unit, value);
    else if (strcmp(word, "animation") == 0 && !unit->includer && !ck->animation)
        read_animation(ck, value);
}

/* The names under a misspelt key are known all the same: the key alone is reported. */
static const char *meant_word(const char *word) {
    const struct grammar_kind *file = &grammar_kinds[KIND_FILE];
    const int meant = grammar_find_key(file, word) < 0 ? meant_key(file, word) : -1;
    return meant < 0 ? word : file->keys[meant].name;
}

void define_names(struct checker *ck, struct unit *unit) {
    if (unit->root->kind != NODE_MAPPING) return;
    const struct node *name = unit->declared ? unit->declared->next->next : unit->root->first;
    for (; name; name = name->next->next) {
        if (node_resolve(name)->kind == NODE_SCALAR)
            declare_pair(ck, unit, meant_word(node_resolve(name)->text), name->next);
        unit->declared = name;
    }
    if (unit->includer) return; /* read with those of the scene */
    for (struct parameter *p = ck->first_parameter; p; p = p->next) {
        const bool used = p->used;
        define_parameter(ck, p);
        p->used = used;
    }
    read_all(ck, &ck->materials);
    read_all(ck, &ck->templates);
    ck->waiting = false;
}

/* ---- Uses ---- */

static void warn_unused(struct checker *ck, const struct definitions *all) {
    for (const struct definition *def = all->first; def; def = def->next)
        if (!def->used && def->span.source == ck->input->source) {
            const char *title = def->kind->title;
            struct diagnostic *d =
                diag_warning(ck->diag, def->span, "unused-definition", "the %s `%s` is never used",
                             strchr(title, ' ') + 1, short_text(ck, def->name));
            diag_help(ck->diag, d, "use it, or remove it");
        }
}

static void report_unknown_parameter(struct checker *ck, const char *name) {
    struct spelling s = spelling_begin(name);
    const char *all = "";
    for (const struct parameter *p = ck->first_parameter; p; p = p->next) {
        spelling_offer(&s, p->name);
        all = append_name(ck, all, p->name);
    }
    struct span nowhere = {ck->input->source, 0, 0, 1};
    struct diagnostic *d = diag_error(ck->diag, nowhere, "unknown-parameter",
                                      "the scene has no parameter `%s` to set by -D", short_text(ck, name));
    if (s.best) diag_help(ck->diag, d, "did you mean `%s`?", s.best);
    diag_note(ck->diag, d, *all ? "its parameters: %s" : "it has none: `params: {%s: 1}` makes one",
              *all ? all : short_text(ck, name));
}

void define_check_given(struct checker *ck) {
    for (size_t i = 0; i < ck->input->define_count; i++)
        if (!table_find(&ck->parameters, ck->input->defines[i].name))
            report_unknown_parameter(ck, ck->input->defines[i].name);
}

void define_warn_unused(struct checker *ck) {
    for (const struct parameter *p = ck->first_parameter; p; p = p->next)
        if (!p->used && p->span.source == ck->input->source)
            diag_help(ck->diag,
                      diag_warning(ck->diag, p->span, "unused-definition", "the parameter `%s` is never used",
                                   p->name),
                      "use it, or remove it");
    warn_unused(ck, &ck->materials);
    warn_unused(ck, &ck->templates);
}
