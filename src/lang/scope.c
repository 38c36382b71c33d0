#include "lang/scope.h"

#include <ctype.h>
#include <string.h>

#include "lang/checker.h"

static bool is_letter(char c) { return isalpha((unsigned char)c) || c == '_' || (unsigned char)c >= 0x80; }

bool scope_is_name(const char *text) {
    if (!is_letter(*text)) return false;
    while (is_letter(*text) || isdigit((unsigned char)*text)) text++;
    return !*text;
}

/* ---- Finding ---- */

/* What runs during an animation: `frame`, `t` from 0 to just under 1, `time` in seconds. */
static const char *const moving[] = {"frame", "t", "time"};

static int which_moving(const char *name) {
    int which = 0;
    while (which < 3 && strcmp(name, moving[which]) != 0) which++;
    return which;
}

bool scope_needs_animation(const struct checker *ck, const char *name) {
    return !ck->animation && which_moving(name) < 3;
}

static const struct binding *find_moving(struct checker *ck, const char *name) {
    const int which = which_moving(name);
    if (which == 3 || !ck->animation) return NULL;
    const double frames = object_number(ck->animation, KEY_ANIMATION_FRAMES);
    const double fps = object_number(ck->animation, KEY_ANIMATION_FPS),
                 since = (double)ck->input->frame - 1.0;
    const double values[] = {since + 1.0, since / frames, since / fps};
    struct binding *b = arena_alloc(ck->arena, sizeof *b);
    *b = (struct binding){.name = moving[which], .quantity = {1, {values[which]}}};
    ck->moved = true;
    return b;
}

/* Whether a name that is not there yet can be that of a parameter, or of the animation. */
static bool may_come(const char *name) { return which_moving(name) < 3 || !define_name_taken(name); }

static const struct binding *find(struct checker *ck, const char *name) {
    for (const struct scope *s = ck->scope; s; s = s->outer)
        for (unsigned i = s->count; i-- > 0;)
            if (strcmp(s->bindings[i].name, name) == 0) return &s->bindings[i];
    struct parameter *parameter = table_find(&ck->parameters, name);
    if (parameter) return define_parameter(ck, parameter);
    const struct binding *found = find_moving(ck, name);
    if (!found && ck->provisional && may_come(name)) ck->waiting = true;
    return found;
}

/* In a rehearsal no variable has a value: it may be of a turn that there is not. */
const struct binding *scope_find(struct checker *ck, const char *name) {
    static const struct binding unknown = {.name = "", .kind = BINDING_UNKNOWN};
    const struct binding *b = find(ck, name);
    return b && ck->rehearsing ? &unknown : b;
}

static const char *frame_text(struct arena *arena, const struct diag_frame *frame) {
    (void)arena;
    (void)frame;
    return "it is used here";
}

struct diag_frame scope_frame(struct checker *ck, const struct node *node) {
    return (struct diag_frame){node->span, frame_text, ck->diag->frame};
}

const struct binding *scope_stands_for(struct checker *ck, const struct node *node) {
    const struct node *n = node_resolve(node);
    if (n->kind != NODE_SCALAR || n->quoted || !scope_is_name(n->text)) return NULL;
    const bool waiting = ck->waiting;
    const struct binding *b = scope_find(ck, n->text);
    if (!b) ck->waiting = waiting; /* a word may be many things besides a variable */
    return b && b->kind != BINDING_QUANTITY ? b : NULL;
}

static enum expr_found find_quantity(void *context, const char *name, struct quantity *out) {
    struct checker *ck = context;
    const struct binding *b = scope_find(ck, name);
    if (!b) return ck->waiting || ck->variables_lost || ck->stopped ? EXPR_LATER : EXPR_MISSING;
    if (b->kind == BINDING_UNKNOWN) return EXPR_LATER;
    if (b->kind == BINDING_QUANTITY) {
        *out = b->quantity;
        return EXPR_FOUND;
    }
    if (!place_descend(ck, b->node->span)) return EXPR_LATER;
    const struct scope *outer = ck->scope;
    ck->scope = b->scope;
    const enum quantity_result result = scope_quantity(ck, name, b->node, out);
    ck->scope = outer;
    ck->depth--;
    return result == QUANTITY_OK ? EXPR_FOUND : result == QUANTITY_NONE ? EXPR_OTHER : EXPR_LATER;
}

static void list_names(void *context, void (*each)(void *to, const char *name), void *to) {
    struct checker *ck = context;
    for (const struct scope *s = ck->scope; s; s = s->outer)
        for (unsigned i = s->count; i-- > 0;) each(to, s->bindings[i].name);
    for (const struct parameter *p = ck->first_parameter; p; p = p->next) each(to, p->name);
    if (!ck->animation) return;
    for (int i = 0; i < 3; i++) each(to, moving[i]);
}

struct expr_scope scope_names(struct checker *ck) {
    return (struct expr_scope){ck, find_quantity, list_names};
}

/* ---- Quantities ---- */

/* A part of a scalar's text, where it is written as it is read; else all of the scalar. */
static struct span span_within(const struct node *n, size_t offset, size_t length) {
    uint32_t before = 0, within = 0, all = 0;
    for (size_t i = 0; i < n->count; i++) {
        if (((unsigned char)n->text[i] & 0xc0) == 0x80) continue;
        all++;
        if (i < offset)
            before++;
        else if (i < offset + length)
            within++;
    }
    const uint32_t quote = n->quoted ? 1 : 0;
    if (n->span.length != all + 2 * quote) return n->span;
    struct span span = n->span;
    span.column += quote + before;
    span.length = within ? within : 1;
    return span;
}

/* An expression that something is wrong with. */
struct wrong_expression {
    struct checker *ck;
    struct diagnostic *diagnostic;
    const struct node *told; /* the value that was told last */
};

static bool is_given(const struct checker *ck, const struct node *value) {
    const struct parameter *p = ck->first_parameter;
    while (p && !(p->given && p->given->span.source == value->span.source)) p = p->next;
    return p != NULL;
}

static enum expr_found tell_given(void *context, const char *name, struct quantity *out) {
    (void)out;
    struct wrong_expression *wrong = context;
    const struct binding *b = scope_find(wrong->ck, name);
    const struct node *value = b && b->node && is_given(wrong->ck, b->node) ? b->node : NULL;
    if (value && value != wrong->told)
        diag_related(wrong->ck->diag, wrong->diagnostic, value->span, "`%s` is given here", name);
    if (value) wrong->told = value;
    return EXPR_LATER;
}

void scope_tell_given(struct checker *ck, struct diagnostic *d, const struct node *node) {
    const struct node *n = node_resolve(node);
    struct wrong_expression wrong = {ck, d, NULL};
    const struct expr_scope scope = {&wrong, tell_given, list_names};
    struct expr_error ignored;
    if (n->kind == NODE_SCALAR && n->expr) expr_check(n->expr, &scope, ck->arena, &ignored);
}

static enum quantity_result report(struct checker *ck, const char *what, const struct node *n,
                                   const struct expr_error *error) {
    if (report_cut(ck, what, n)) return QUANTITY_WRONG;
    struct diagnostic *d = diag_error(ck->diag, span_within(n, error->offset, error->length), error->code,
                                      "`%s`: %s", what, error->message);
    scope_tell_given(ck, d, n);
    if (strcmp(error->code, "unknown-variable") == 0 &&
        scope_needs_animation(ck, arena_text(ck->arena, n->text + error->offset, error->length)))
        diag_help(ck->diag, d, "for `frame`, `t` and `time` add `animation: {frames: 24}`");
    else if (error->help)
        diag_help(ck->diag, d, "%s", error->help);
    return QUANTITY_WRONG;
}

/* The scalar as an expression; NULL: *error says why it is none. It is parsed once, unless the node is
 * one that goes by. */
static const struct expr *parse(struct checker *ck, const struct node *n, struct expr_error *error) {
    if (n->expr) return n->expr;
    struct arena *arena = n->passing ? &ck->memory->nodes : &ck->memory->kept;
    struct expr *expr = expr_parse(arena, n->text, n->count, error);
    ((struct node *)n)->expr = expr; /* a memory of what the text is; the node means what it meant */
    return expr;
}

/* Whether somebody who wrote this meant to compute something. */
static bool looks_computed(const struct node *n) {
    if (n->count > 0 && n->text[0] == '#') return false;
    if (n->text[strspn(n->text, "+-.0123456789 ")] == '%' && n->text[n->count - 1] == '%')
        return false; /* a percentage */
    for (const char *c = n->text; *c; c++)
        if (iscntrl((unsigned char)*c)) return false;
    return strpbrk(n->text, "*/()<>?^=&|[%") || strstr(n->text, " +") || strstr(n->text, " -");
}

static enum quantity_result rehearse(struct checker *ck, const struct expr *expr,
                                     const struct expr_scope *scope, struct quantity *out,
                                     struct expr_error *error) {
    const enum expr_result names = expr_check(expr, scope, ck->arena, error);
    if (names == EXPR_WRONG) return QUANTITY_WRONG;
    const enum expr_result value = expr_evaluate(expr, scope, ck->arena, out, error);
    return value == EXPR_OK ? QUANTITY_OK : value == EXPR_WAIT ? QUANTITY_UNKNOWN : QUANTITY_WRONG;
}

static enum quantity_result scalar_quantity(struct checker *ck, const char *what, const struct node *n,
                                            struct quantity *out) {
    struct expr_error error = {0};
    if (n->count == 0) return QUANTITY_NONE;
    const struct expr *expr = parse(ck, n, &error);
    if (!expr) return looks_computed(n) ? report(ck, what, n, &error) : QUANTITY_NONE;
    const struct expr_scope scope = scope_names(ck);
    const unsigned errors = ck->diag->errors;
    enum quantity_result result;
    if (ck->rehearsing) {
        result = rehearse(ck, expr, &scope, out, &error);
    } else {
        const enum expr_result value = expr_evaluate(expr, &scope, ck->arena, out, &error);
        result = value == EXPR_OK ? QUANTITY_OK : value == EXPR_WAIT ? QUANTITY_UNKNOWN : QUANTITY_WRONG;
    }
    if (result == QUANTITY_UNKNOWN && ck->diag->errors != errors)
        return QUANTITY_WRONG; /* of a variable: reported there */
    if (result != QUANTITY_WRONG) return result;
    if (expr_name(expr) && !looks_computed(n)) return QUANTITY_NONE; /* a word that is no variable */
    return report(ck, what, n, &error);
}

static enum quantity_result list_quantity(struct checker *ck, const char *what, const struct node *n,
                                          struct quantity *out) {
    if (report_cut_in(ck, what, n)) return QUANTITY_WRONG;
    if (n->count < 2 || n->count > 4) return QUANTITY_NONE;
    enum quantity_result all = QUANTITY_OK;
    struct quantity vector = {.count = 0};
    for (const struct node *item = n->first; item; item = item->next) {
        struct quantity part = {0};
        if (node_resolve(item)->kind != NODE_SCALAR) return QUANTITY_NONE;
        const enum quantity_result result = scope_quantity(ck, what, item, &part);
        if (result == QUANTITY_NONE || result == QUANTITY_WRONG) return result;
        if (result == QUANTITY_UNKNOWN)
            all = result;
        else if (part.count != 1)
            return QUANTITY_NONE;
        vector.v[vector.count++] = part.v[0];
    }
    *out = vector;
    return all;
}

enum quantity_result scope_quantity(struct checker *ck, const char *what, const struct node *node,
                                    struct quantity *out) {
    const struct node *n = node_resolve(node);
    switch (n->kind) {
    case NODE_SCALAR: {
        double number;
        if (!scalar_number(ck, n->text, &number)) return scalar_quantity(ck, what, n, out);
        *out = (struct quantity){1, {number}};
        return QUANTITY_OK;
    }
    case NODE_SEQUENCE: return list_quantity(ck, what, n, out);
    case NODE_MAPPING: return keyframes_is(n) ? keyframes_read(ck, n, out) : QUANTITY_NONE;
    case NODE_ALIAS: break;
    }
    return QUANTITY_NONE;
}

/* ---- Binding ---- */

/* The variables of now: more may come into the same scope. */
static const struct scope *snapshot(struct checker *ck) {
    if (!ck->scope) return NULL;
    struct scope *copy = arena_alloc(ck->arena, sizeof *copy);
    *copy = *ck->scope;
    return copy;
}

bool scope_bind(struct checker *ck, const char *name, const struct node *node, struct binding *out) {
    *out = (struct binding){.name = name, .kind = BINDING_UNKNOWN, .node = node};
    const struct node *n = node_resolve(node);
    if (n->kind == NODE_SCALAR && !n->quoted && scope_is_name(n->text)) {
        const bool waiting = ck->waiting;
        const struct binding *same = scope_find(ck, n->text);
        if (same) {
            *out = *same;
            out->name = name;
            return true;
        }
        ck->waiting = waiting;
    } else { /* not of a word alone: `gold` may be a material or a colour */
        const enum quantity_result result = scope_quantity(ck, name, n, &out->quantity);
        if (result == QUANTITY_OK) out->kind = BINDING_QUANTITY;
        if (result != QUANTITY_NONE)
            return result == QUANTITY_OK || (result == QUANTITY_UNKNOWN && !ck->waiting);
    }
    out->kind = BINDING_NODE;
    out->scope = snapshot(ck);
    return true;
}
