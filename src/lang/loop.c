/* `for` and `when`. */
#include <math.h>
#include <string.h>

#include "lang/checker.h"

struct loop {
    struct diag_frame frame; /* first: what is told of a turn */
    struct checker *ck;
    struct scope scope; /* the loop's own variables, as many as have their values */
    struct binding *bindings;
    void (*turn)(struct checker *ck, void *context);
    void *context;
    bool good, turned;
};

/* ---- What is told of a turn ---- */

const char *quantity_text(struct arena *arena, const struct quantity *q) {
    const char *text = arena_format(arena, "%s%.6g", q->count > 1 ? "[" : "", q->v[0]);
    for (unsigned i = 1; i < q->count; i++) text = arena_format(arena, "%s, %.6g", text, q->v[i]);
    return q->count > 1 ? arena_format(arena, "%s]", text) : text;
}

const char *loop_bindings_text(struct arena *arena, const struct scope *scope) {
    const char *text = "";
    for (unsigned i = 0; i < scope->count && i < 8; i++) {
        const struct binding *b = &scope->bindings[i];
        const struct node *n = b->kind == BINDING_NODE ? node_resolve(b->node) : NULL;
        const char *value = b->kind == BINDING_QUANTITY ? quantity_text(arena, &b->quantity)
                            : n && n->kind == NODE_SCALAR && n->count < 40 ? n->text
                                                                           : "...";
        text = arena_format(arena, "%s%s%s = %s", text, *text ? ", " : "", b->name, value);
    }
    return text;
}

static const char *turn_text(struct arena *arena, const struct diag_frame *frame) {
    const struct loop *loop = (const struct loop *)frame;
    return arena_format(arena, "in the turn %s", loop_bindings_text(arena, &loop->scope));
}

/* ---- Turns ---- */

static void run_variables(struct loop *loop, const struct node *name);

/* The variables after `name`. The turns of the last are counted as its objects. */
static void run_rest(struct loop *loop, const struct node *name) {
    const struct node *next = name->next->next;
    if (!next || place_count_step(loop->ck, next)) run_variables(loop, next);
}

static void run_turn(struct loop *loop, const struct node *name, struct quantity value) {
    struct binding *b = &loop->bindings[loop->scope.count];
    *b = (struct binding){.name = node_resolve(name)->text,
                          .kind = loop->ck->rehearsing ? BINDING_UNKNOWN : BINDING_QUANTITY,
                          .quantity = value};
    loop->scope.count++;
    run_rest(loop, name);
    loop->scope.count--;
}

static bool may_turn(struct checker *ck, const struct node *node, double turns) {
    if (turns <= (double)ck->input->limits.steps) return true;
    struct diagnostic *d = diag_error(
        ck->diag, node->span, "limit-steps", "a loop of %s turns: more than %zu (the limit `steps`)",
        isfinite(turns) ? arena_format(ck->arena, "%.15g", turns) : "endless", ck->input->limits.steps);
    diag_help(ck->diag, d, "a smaller loop, or `--limit steps=N`");
    return false;
}

static bool run_numbers(struct loop *loop, const struct node *name, double from, double step, double turns) {
    if (loop->ck->rehearsing) turns = 1;
    if (!may_turn(loop->ck, name->next, turns)) return false;
    for (double i = 0; i < turns && !loop->ck->stopped && !loop->ck->waiting; i++)
        run_turn(loop, name, (struct quantity){1, {from + i * step}});
    return true;
}

/* `0..3`, `0 to 3`, `0:3`; of `0-3` the value is negative. Other numbers of that form are counts. */
static bool report_range_text(struct checker *ck, const char *name, const struct node *node) {
    static const char *const between[] = {"...", "..", " to ", ":", "-"};
    const struct node *n = node_resolve(node);
    if (n->kind != NODE_SCALAR || n->count > 40 || n->text[strspn(n->text, "0123456789.-: to")]) return false;
    for (size_t i = 0; i < sizeof between / sizeof *between; i++) {
        const char *at = n->count > 0 ? strstr(n->text + 1, between[i]) : NULL;
        double from, to;
        if (!at) continue;
        const char *first = arena_text(ck->arena, n->text, (size_t)(at - n->text)),
                   *second = at + strlen(between[i]);
        first = arena_text(ck->arena, first, strcspn(first, " "));
        second += strspn(second, " ");
        if (!scalar_number(ck, first, &from) || !scalar_number(ck, second, &to) || (*at == '-' && from >= to))
            continue;
        struct diagnostic *d = diag_error(ck->diag, node->span, "not-a-number",
                                          "`%s`: expected a whole number, a list or a range, found %s", name,
                                          found_text(ck, node));
        diag_help(ck->diag, d, "a range is written {from: %.15g, to: %.15g}, and has both ends", from, to);
        return true;
    }
    return false;
}

static bool run_count(struct loop *loop, const struct node *name) {
    const struct grammar_key key = {
        .name = node_resolve(name)->text, .type = GRAMMAR_INTEGER, .has_min = true};
    const struct node *n = node_resolve(name->next);
    double count = 1;
    if (n->kind == NODE_SCALAR && n->count == 0) {
        struct diagnostic *d =
            diag_error(loop->ck->diag, name->span, "no-value", "`%s` has no value", key.name);
        diag_help(loop->ck->diag, d, "how often, as in `for: {%s: 9}`", key.name);
        return false;
    }
    if (report_range_text(loop->ck, key.name, name->next)) return false;
    if (!check_integer(loop->ck, &key, name->next, &count)) return false;
    return run_numbers(loop, name, 0, 1, count);
}

static bool run_range(struct loop *loop, const struct node *name) {
    struct checker *ck = loop->ck;
    const struct object_value *range = check_object(ck, &grammar_kinds[KIND_RANGE], name->next);
    if (!range || range->failed) return false;
    const double from = object_number(range, KEY_RANGE_FROM), to = object_number(range, KEY_RANGE_TO);
    const double step = object_number(range, KEY_RANGE_STEP);
    if (ck->rehearsing) return run_numbers(loop, name, from, step, 1);
    if (step == 0.0 || (to - from) * step < 0.0) {
        struct diagnostic *d = diag_error(ck->diag, object_span(range, KEY_RANGE_STEP), "bad-range",
                                          "steps of %.15g never lead from %.15g to %.15g", step, from, to);
        diag_help(ck->diag, d, step == 0.0 ? "any other step will do" : "give a `step` of the other sign");
        return false;
    }
    /* The last counts when it is hit to within rounding. */
    return run_numbers(loop, name, from, step, floor((to - from) / step * (1.0 + 1e-12) + 1e-9) + 1.0);
}

/* `scope`: of the names in the list. */
static bool run_list(struct loop *loop, const struct node *name, const struct node *list,
                     const struct scope *scope) {
    struct checker *ck = loop->ck;
    const struct scope *here = ck->scope;
    for (const struct node *item = list->first; item && !ck->stopped; item = item->next) {
        struct binding *b = &loop->bindings[loop->scope.count];
        ck->scope = scope;
        const bool good = scope_bind(ck, node_resolve(name)->text, item, b);
        ck->scope = here;
        if (!good) return false;
        loop->scope.count++;
        run_rest(loop, name);
        loop->scope.count--;
    }
    return true;
}

static bool run_vector(struct loop *loop, const struct node *name, const struct quantity *q) {
    for (unsigned i = 0; i < q->count && !loop->ck->stopped && !loop->ck->waiting; i++)
        run_turn(loop, name, (struct quantity){1, {q->v[i]}});
    return true;
}

static bool run_variable(struct loop *loop, const struct node *name) {
    struct checker *ck = loop->ck;
    const struct node *n = node_resolve(name->next);
    const struct binding *b =
        n->kind == NODE_SCALAR && scope_is_name(n->text) ? scope_find(ck, n->text) : NULL;
    const struct node *list = b && b->kind == BINDING_NODE ? node_resolve(b->node) : NULL;
    if (b && b->kind == BINDING_QUANTITY && b->quantity.count > 1)
        return run_vector(loop, name, &b->quantity);
    if (list && list->kind == NODE_SEQUENCE) return run_list(loop, name, list, b->scope);
    if (n->kind == NODE_SEQUENCE) return run_list(loop, name, n, ck->scope);
    return n->kind == NODE_MAPPING && !keyframes_is(n) ? run_range(loop, name) : run_count(loop, name);
}

/* The variable at `name` and those after it; after the last, the turn itself. */
static void run_variables(struct loop *loop, const struct node *name) {
    struct checker *ck = loop->ck;
    if (ck->stopped) return;
    if (name) {
        enum { MOST = 1000 };
        if (!place_nest(ck, name->span, &ck->loops, MOST, "variables of loops within each other")) return;
        loop->good &= run_variable(loop, name);
        ck->loops--;
        return;
    }
    const struct diag_frame *outer = ck->diag->frame;
    loop->frame.outer = outer;
    loop->turned = true;
    if (!ck->rehearsing) ck->diag->frame = &loop->frame;
    loop->turn(ck, loop->context);
    ck->diag->frame = outer;
}

static bool names_allowed(struct checker *ck, const struct node *n) {
    if (n->rehearsed) return true;
    bool good = true;
    for (const struct node *name = n->first; name; name = name->next->next) {
        good &= !report_cut_before(ck, n, name) && define_name_allowed(ck, "a loop variable", name);
        for (const struct node *before = n->first; good && before != name; before = before->next->next)
            if (strcmp(node_resolve(before)->text, node_resolve(name)->text) == 0) {
                struct diagnostic *d = diag_error(ck->diag, name->span, "key-twice", "`%s` is given twice",
                                                  node_resolve(name)->text);
                diag_related(ck->diag, d, before->span, "first given here");
                good = false;
            }
    }
    ((struct node *)n)->rehearsed = good; /* remembers that it was checked, and means what it meant */
    return good;
}

/* A loop that never turns or whose variables are wrong: the turn is checked all the same. */
static void rehearse(struct loop *loop, const struct node *n) {
    struct checker *ck = loop->ck;
    const bool outer = ck->rehearsing;
    loop->scope.count = 0;
    for (const struct node *name = n->first; name; name = name->next->next)
        if (node_resolve(name)->kind == NODE_SCALAR)
            loop->bindings[loop->scope.count++] =
                (struct binding){.name = node_resolve(name)->text, .kind = BINDING_UNKNOWN};
    ck->rehearsing = true;
    loop->turn(ck, loop->context);
    ck->rehearsing = outer;
}

void loop_run(struct checker *ck, const struct node *node, void (*turn)(struct checker *ck, void *context),
              void *context) {
    const struct node *n = node_resolve(node);
    if (n->kind != NODE_MAPPING || n->count == 0) {
        struct diagnostic *d =
            diag_error(ck->diag, node->span, "not-a-map",
                       "`for`: expected variables, each with how often, found %s", found_text(ck, node));
        diag_help(ck->diag, d, "as in `for: {i: 9}`");
        return;
    }
    enum { MOST = 16 };
    if (n->count > MOST) {
        diag_error(ck->diag, node->span, "limit-nesting", "a loop of %u variables: more than %d", n->count,
                   MOST);
        return;
    }
    const bool allowed = names_allowed(ck, n);
    struct binding *bindings = arena_array(ck->arena, n->count, sizeof *bindings);
    struct loop loop = {.frame = {.span = node->span, .text = turn_text},
                        .ck = ck,
                        .scope = {ck->scope, bindings, 0},
                        .bindings = bindings,
                        .turn = turn,
                        .context = context,
                        .good = true};
    ck->scope = &loop.scope;
    if (allowed) run_variables(&loop, n->first);
    if (!(loop.good && loop.turned) && !ck->waiting && !ck->stopped) rehearse(&loop, n);
    ck->scope = loop.scope.outer;
}

/* ---- Conditions ---- */

enum quantity_result loop_condition(struct checker *ck, const struct node *node, bool *out) {
    const struct node *n = node_resolve(node);
    struct quantity q = {0};
    const enum quantity_result result =
        n->kind == NODE_SCALAR ? scope_quantity(ck, "when", node, &q) : QUANTITY_NONE;
    *out = q.v[0] != 0.0;
    if (result != QUANTITY_NONE && !(result == QUANTITY_OK && q.count != 1)) return result;
    struct diagnostic *d = diag_error(ck->diag, node->span, "not-a-condition",
                                      "`when`: expected a condition, found %s", found_text(ck, node));
    if (n->kind == NODE_SCALAR && scalar_help_truth(ck, d, n->text)) return QUANTITY_WRONG;
    if (n->kind == NODE_SCALAR && scope_is_name(n->text))
        scalar_help_variable(ck, d, n->text);
    else if (n->kind != NODE_SCALAR || !scalar_help_expression(ck, d, n->text))
        diag_help(ck->diag, d, "as in `when: depth > 0`");
    return QUANTITY_WRONG;
}
