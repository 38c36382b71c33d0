/* Values over time: {keys: {1: 0, 12: 3, 24: 1}, ease: smooth}. */
#include <string.h>

#include "lang/checker.h"

struct keyframe {
    double frame;
    struct quantity value;
};

bool keyframes_is(const struct node *node) { return node->kind == NODE_MAPPING && node_get(node, "keys"); }

/* One frame and its value, put in its place among the `count` before it. */
static enum quantity_result read_frame(struct checker *ck, const struct node *name, struct keyframe *frames,
                                       unsigned count) {
    const struct grammar_key key = {.name = "keys", .type = GRAMMAR_NUMBER};
    struct keyframe f;
    if (!check_number(ck, &key, name, &f.frame)) return ck->waiting ? QUANTITY_UNKNOWN : QUANTITY_WRONG;
    const enum quantity_result result = scope_quantity(ck, "keys", name->next, &f.value);
    if (result == QUANTITY_NONE)
        diag_error(ck->diag, name->next->span, "not-a-quantity",
                   "`keys`: expected a number, a vector or a colour, found %s", found_text(ck, name->next));
    if (result != QUANTITY_OK) return result == QUANTITY_UNKNOWN ? result : QUANTITY_WRONG;
    if (count > 0 && f.value.count != frames[0].value.count) {
        diag_error(ck->diag, name->next->span, "not-a-quantity", "`keys`: %u number%s here, %u in the first",
                   f.value.count, f.value.count == 1 ? "" : "s", frames[0].value.count);
        return QUANTITY_WRONG;
    }
    unsigned at = count;
    for (; at > 0 && frames[at - 1].frame > f.frame; at--) frames[at] = frames[at - 1];
    if (at > 0 && frames[at - 1].frame == f.frame) {
        diag_error(ck->diag, name->span, "key-twice", "`keys`: the frame %.15g is given twice", f.frame);
        return QUANTITY_WRONG;
    }
    frames[at] = f;
    return QUANTITY_OK;
}

/* How far from one frame to the next; both ends are exact. */
static double eased(int ease, double part) {
    switch (ease) {
    case CHOICE_KEYFRAMES_EASE_SMOOTH: return part * part * (3.0 - 2.0 * part);
    case CHOICE_KEYFRAMES_EASE_STEP: return 0.0;
    default: return part;
    }
}

static struct quantity value_at(const struct keyframe *frames, unsigned count, int ease, double frame) {
    unsigned next = 0;
    while (next < count && frames[next].frame <= frame) next++;
    if (next == 0) return frames[0].value;
    if (next == count) return frames[count - 1].value;
    const struct keyframe *a = &frames[next - 1], *b = &frames[next];
    const double part = eased(ease, (frame - a->frame) / (b->frame - a->frame));
    struct quantity q = a->value;
    for (unsigned i = 0; i < q.count; i++) q.v[i] += (b->value.v[i] - q.v[i]) * part;
    return q;
}

enum quantity_result keyframes_read(struct checker *ck, const struct node *node, struct quantity *out) {
    const unsigned errors = ck->diag->errors;
    const struct object_value *object = check_object(ck, &grammar_kinds[KIND_KEYFRAMES], node);
    if (!ck->animation && !ck->provisional && !ck->variables_lost && ck->diag->errors == errors) {
        struct diagnostic *d =
            diag_error(ck->diag, node->span, "no-animation", "keyframes in a scene that does not move");
        diag_help(ck->diag, d, "add `animation: {frames: 24}`");
    }
    if (!ck->animation) {
        ck->waiting |= ck->provisional;
        return ck->provisional ? QUANTITY_UNKNOWN : QUANTITY_WRONG;
    }
    if (!object || object->failed) return ck->waiting ? QUANTITY_UNKNOWN : QUANTITY_WRONG;
    const struct node *keys = node_resolve(node_get(node, "keys"));
    struct keyframe *frames = arena_array(ck->arena, keys->count ? keys->count : 1, sizeof *frames);
    unsigned count = 0;
    enum quantity_result all = QUANTITY_OK;
    for (const struct node *name = keys->first; name; name = name->next->next) {
        const enum quantity_result result = read_frame(ck, name, frames, count);
        if (result == QUANTITY_WRONG) return result;
        if (result == QUANTITY_UNKNOWN)
            all = result;
        else
            count++;
    }
    if (all == QUANTITY_OK && count == 0) {
        diag_help(ck->diag, diag_error(ck->diag, keys->span, "no-value", "`keys` without any frame"),
                  "as in {keys: {1: 0, 24: 1}}");
        return QUANTITY_WRONG;
    }
    ck->moved = true;
    if (all == QUANTITY_OK)
        *out = value_at(frames, count, object_choice(object, KEY_KEYFRAMES_EASE), ck->input->frame);
    return all;
}
