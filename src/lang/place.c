/* The objects of a scene, one by one: loops turn, conditions hold or not, templates are opened, and the
 * shapes and groups that come of it go to the sink. Nothing of an object stays in memory after that. */
#include <string.h>

#include "lang/checker.h"
#include "lang/spelling.h"

static const struct grammar_kind *object_kind(void) { return &grammar_kinds[KIND_OBJECT]; }

/* Whether what is read goes to the sink. */
static bool is_live(const struct checker *ck) { return !ck->rehearsing && !ck->waiting && !ck->stopped; }

bool place_descend(struct checker *ck, struct span span) {
    if (ck->stopped) return false;
    if (ck->depth++ < ck->input->limits.recursion) return true;
    ck->depth--;
    ck->stopped = true;
    struct diagnostic *d = diag_error(ck->diag, span, "limit-recursion",
                                      "more than %u templates within each other (the limit `recursion`)",
                                      ck->input->limits.recursion);
    diag_help(ck->diag, d, "end it by a `when`, or raise the limit: `--limit recursion=N`");
    return false;
}

bool place_nest(struct checker *ck, struct span span, unsigned *depth, unsigned most, const char *what) {
    if (ck->stopped) return false;
    if ((*depth)++ < most) return true;
    --*depth;
    ck->stopped = true;
    diag_error(ck->diag, span, "limit-nesting", "more than %u %s", most, what);
    return false;
}

/* What a file writes out is bounded by its size: only what is repeated counts. */
bool place_count_step(struct checker *ck, const struct node *node) {
    if (ck->stopped) return false;
    if (ck->depth == 0 && !ck->scope) return true;
    if (++ck->steps <= ck->input->limits.steps) return true;
    ck->stopped = true;
    struct diagnostic *d =
        diag_error(ck->diag, node->span, "limit-steps",
                   "more than %zu objects and turns of loops (the limit `steps`)", ck->input->limits.steps);
    diag_help(ck->diag, d, "`--limit steps=N` allows more");
    return false;
}

static bool count_object(struct checker *ck, const struct object_value *object) {
    if (++ck->objects <= ck->input->limits.objects) return true;
    ck->stopped = true;
    struct diagnostic *d =
        diag_error(ck->diag, object->span, "limit-objects", "more than %zu shapes (the limit `objects`)",
                   ck->input->limits.objects);
    diag_help(ck->diag, d, "`--limit objects=N` allows more");
    return false;
}

void place_list(struct checker *ck, const struct node *list) {
    const struct node *n = node_resolve(list);
    if (n->kind != NODE_SEQUENCE) {
        place_item(ck, list);
        return;
    }
    for (const struct node *item = n->first; item && !ck->stopped; item = item->next) place_item(ck, item);
}

void place_members(struct checker *ck, int kind, int key, const struct node *list) {
    const struct surrounding outer = ck->around;
    struct arena *arena = ck->arena;
    ck->around = (struct surrounding){&grammar_kinds[kind], &grammar_kinds[kind].keys[key]};
    ck->arena = &ck->memory->scratch; /* each object leaves nothing behind */
    place_list(ck, list);
    ck->arena = arena;
    ck->around = outer;
}

/* ---- Templates ---- */

struct use {
    struct diag_frame frame; /* first: what is told of it */
    const char *name;
    const struct scope *arguments;
};

static const char *use_text(struct arena *arena, const struct diag_frame *frame) {
    const struct use *use = (const struct use *)frame;
    const char *with = loop_bindings_text(arena, use->arguments);
    return *with ? arena_format(arena, "`%s` is used here, with %s", use->name, with)
                 : arena_format(arena, "`%s` is used here", use->name);
}

const char *lang_use_arguments(struct arena *arena, const struct diag_frame *frame) {
    return frame && frame->text == use_text
               ? loop_bindings_text(arena, ((const struct use *)frame)->arguments)
               : "";
}

/* The value of a parameter where it is declared: the mapping's `default`, or the value itself. */
const struct node *place_default(const struct node *declared) {
    const struct node *n = node_resolve(declared);
    const struct node *given = n->kind == NODE_MAPPING ? node_get(n, "default") : NULL;
    return given ? given : declared;
}

static void report_unknown_argument(struct checker *ck, const struct definition *template,
                                    const struct node *parameters, const struct node *name) {
    struct spelling s = spelling_begin(node_resolve(name)->text);
    const char *all = "";
    for (const struct node *p = parameters ? parameters->first : NULL; p; p = p->next->next) {
        spelling_offer(&s, node_resolve(p)->text);
        all = append_name(ck, all, node_resolve(p)->text);
    }
    struct diagnostic *d = diag_error(ck->diag, name->span, "unknown-argument", "`%s` has no parameter `%s`",
                                      template->name, short_text(ck, s.word));
    if (s.best) diag_help(ck->diag, d, "did you mean `%s`?", s.best);
    diag_note(ck->diag, d, *all ? "`%s` takes %s" : "`%s` takes none", template->name, all);
    diag_related(ck->diag, d, template->span, "`%s` is defined here", template->name);
}

static bool check_arguments(struct checker *ck, const struct definition *template,
                            const struct node *parameters, const struct node *with) {
    bool good = true;
    for (const struct node *name = with ? with->first : NULL; name; name = name->next->next) {
        const struct node *word = node_resolve(name);
        if (word->kind == NODE_SCALAR && parameters && node_get(parameters, word->text)) continue;
        if (word->kind == NODE_SCALAR)
            report_unknown_argument(ck, template, parameters, name);
        else
            diag_error(ck->diag, name->span, "key-not-a-word", "the name of a parameter is a word, found %s",
                       found_text(ck, name));
        good = false;
    }
    return good;
}

/* The mapping of `params` of a template, `with` of a use; NULL: not given. */
static const struct node *values_of(const struct object_value *object, int key) {
    return object->fields[key] ? node_resolve(object->fields[key]->node) : NULL;
}

/* The template's variables: those given here, in the scope of here; the others by their defaults, in
 * the scope of the parameters before them. */
static bool bind_arguments(struct checker *ck, const struct node *parameters, const struct node *with,
                           struct scope *arguments) {
    const uint32_t count = parameters ? parameters->count : 0;
    struct binding *bindings = arena_array(ck->arena, count ? count : 1, sizeof *bindings);
    const struct scope *here = ck->scope;
    bool good = true;
    *arguments = (struct scope){NULL, bindings, 0};
    for (const struct node *p = count ? parameters->first : NULL; p; p = p->next->next) {
        const char *name = node_resolve(p)->text;
        const struct node *given = with ? node_get(with, name) : NULL;
        ck->scope = given ? here : arguments;
        const struct node *value = given ? given : place_default(p->next);
        good &= scope_bind(ck, name, value, &bindings[arguments->count]) &&
                define_in_range(ck, name, p->next, value);
        ck->scope = here;
        arguments->count++;
    }
    return good;
}

/* What the objects of the use depend on. False: on more than can be told, *hash is of the template. */
static bool use_contents(const struct definition *template, const struct scope *arguments,
                         struct hash *hash) {
    hash_begin(hash);
    hash_integer(hash, template->number);
    for (unsigned i = 0; i < arguments->count; i++) {
        const struct binding *b = &arguments->bindings[i];
        hash_integer(hash, b->kind);
        if (b->kind == BINDING_QUANTITY) {
            hash_integer(hash, b->quantity.count);
            for (unsigned k = 0; k < b->quantity.count; k++) hash_double(hash, b->quantity.v[k]);
        } else if (!b->scope && !node_resolve(b->node)->passing) {
            hash_integer(hash, (uintptr_t)node_resolve(b->node));
        } else if (node_resolve(b->node)->kind == NODE_SCALAR && !b->scope) {
            const struct node *n = node_resolve(b->node);
            hash_integer(hash, n->count);
            hash_bytes(hash, n->text, n->count);
        } else {
            hash_begin(hash);
            hash_integer(hash, template->number);
            return false;
        }
    }
    return true;
}

static void open_template(struct checker *ck, const struct object_value *object,
                          const struct definition *template, const struct scope *arguments) {
    const struct lang_sink *sink = ck->input->sink;
    struct hash contents;
    const bool exact = use_contents(template, arguments, &contents);
    if (!place_descend(ck, object_span(object, KEY_OBJECT_USE))) return;
    struct use use = {
        {object_span(object, KEY_OBJECT_USE), use_text, ck->diag->frame}, template->name, arguments};
    const struct scope *outer = ck->scope;
    ck->scope = arguments;
    ck->diag->frame = &use.frame;
    bool again = is_live(ck) && sink->open_use(sink->context, object, &contents, exact) == LANG_USE_READ;
    while (again) {
        if (is_live(ck))
            place_members(ck, KIND_TEMPLATE, KEY_TEMPLATE_OBJECTS,
                          values_of(template->object, KEY_TEMPLATE_OBJECTS));
        again = sink->close_use(sink->context); /* what is open is closed, live or not */
    }
    ck->diag->frame = use.frame.outer;
    ck->scope = outer;
    ck->depth--;
}

static void place_use(struct checker *ck, const struct object_value *object) {
    struct definition *template = object->fields[KEY_OBJECT_USE]->definition;
    if (!template) return; /* in a rehearsal: a variable names it */
    const struct object_value *read = ck->rehearsing ? NULL : define_read(ck, template);
    template->used = true;
    const struct node *parameters = node_resolve(template->node);
    parameters = parameters->kind == NODE_MAPPING ? node_get(parameters, "params") : NULL;
    if (parameters) parameters = node_resolve(parameters);
    if (parameters && parameters->kind != NODE_MAPPING) return;
    const struct node *with = values_of(object, KEY_OBJECT_WITH);
    struct scope arguments;
    if (!check_arguments(ck, template, parameters, with) || !bind_arguments(ck, parameters, with, &arguments))
        return;
    if (is_live(ck) && read && !read->failed) open_template(ck, object, template, &arguments);
}

/* ---- Objects ---- */

static void place_group(struct checker *ck, const struct object_value *object) {
    const struct lang_sink *sink = ck->input->sink;
    enum { MOST = 1000 };
    const bool live = is_live(ck);
    if (!place_nest(ck, object->span, &ck->groups, MOST, "groups within each other")) return;
    if (live) sink->open_group(sink->context, object);
    place_members(ck, KIND_OBJECT, KEY_OBJECT_GROUP, object->fields[KEY_OBJECT_GROUP]->node);
    if (live) sink->close_group(sink->context);
    ck->groups--;
}

static void place_object(struct checker *ck, const struct object_value *object) {
    const int key = object_alternative(object);
    if (key == KEY_OBJECT_GROUP)
        place_group(ck, object);
    else if (key == KEY_OBJECT_USE)
        place_use(ck, object);
    else if (key >= 0 && is_live(ck) && count_object(ck, object))
        ck->input->sink->shape(ck->input->sink->context, object);
}

/* Checks what is not placed: once is enough. */
static void rehearse(struct checker *ck, const struct node *node) {
    struct node *n =
        (struct node *)node_resolve(node); /* remembers that it was checked, and means what it meant */
    if (n->rehearsed) return;
    const bool outer = ck->rehearsing;
    n->rehearsed = true;
    ck->rehearsing = true;
    struct object_value *object = check_object(ck, object_kind(), node);
    if (object) place_object(ck, object);
    ck->rehearsing = outer;
    if (ck->waiting) n->rehearsed = false;
}

/* The object as it is in this turn. */
static void place_turn(struct checker *ck, void *context) {
    const struct node *node = context, *n = node_resolve(node), *when = node_get(n, "when");
    if (!place_count_step(ck, node)) return;
    const struct arena_mark before = arena_mark(ck->arena);
    bool holds = true;
    const enum quantity_result known =
        when && !node_is_null(when) ? loop_condition(ck, when, &holds) : QUANTITY_OK;
    if (ck->rehearsing || (known == QUANTITY_OK && !holds)) {
        rehearse(ck, node);
    } else if (known == QUANTITY_OK) {
        struct object_value *object = check_object(ck, object_kind(), node);
        if (object) place_object(ck, object);
    }
    arena_release(ck->arena, before);
}

/* A variable where an object stands: an object or a list of them. */
static bool place_variable(struct checker *ck, const struct node *node) {
    const struct binding *b = scope_stands_for(ck, node);
    if (!b || b->kind == BINDING_UNKNOWN) return b != NULL;
    if (!place_descend(ck, node->span)) return true;
    const struct scope *outer = ck->scope;
    const struct diag_frame frame = scope_frame(ck, node);
    ck->scope = b->scope;
    ck->diag->frame = &frame;
    place_list(ck, b->node);
    ck->diag->frame = frame.outer;
    ck->scope = outer;
    ck->depth--;
    return true;
}

void place_item(struct checker *ck, const struct node *node) {
    const struct node *n = node_resolve(node);
    if (ck->stopped || place_variable(ck, node)) return;
    if (n->kind == NODE_SCALAR && ck->provisional && scope_is_name(n->text)) {
        ck->waiting = true; /* a parameter that comes later may have the object */
        return;
    }
    const struct node *loop = n->kind == NODE_MAPPING ? node_get(n, "for") : NULL;
    const struct binding *b = n->kind == NODE_SCALAR && !n->quoted ? scope_find(ck, n->text) : NULL;
    if (b)
        diag_error(ck->diag, node->span, "not-a-mapping", "expected an object, found %s",
                   found_quantity(ck, node, &b->quantity));
    else if (n->kind != NODE_MAPPING)
        report_no_mapping(ck, object_kind(), node);
    else if (!loop || node_is_null(loop))
        place_turn(ck, (void *)node);
    else
        loop_run(ck, loop, place_turn, (void *)node);
}
