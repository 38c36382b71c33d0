/* A change in words. */
#include <stdio.h>

#include "monge.h"

static const char *const kind_words[MONGE_CHANGES] = {
    [MONGE_CHANGE_GEOMETRY] = "geometry moved",
    [MONGE_CHANGE_APPEARED] = "appeared",
    [MONGE_CHANGE_DISAPPEARED] = "disappeared",
    [MONGE_CHANGE_MATERIAL] = "shading changed, geometry equal: another material",
    [MONGE_CHANGE_SHADOW] = "shadow changed",
    [MONGE_CHANGE_SHADING] = "shading changed, geometry equal",
    [MONGE_CHANGE_CAMERA] = "moved",
    [MONGE_CHANGE_VIEW] = "view changed",
    [MONGE_CHANGE_FRAMING] = "framing by the scene's bounds changed",
    [MONGE_CHANGE_OTHERS] = "other changes too, which cannot be told by object under another camera",
    [MONGE_CHANGE_LIGHT_PLACE] = "moved",
    [MONGE_CHANGE_LIGHT_COLOR] = "colour or strength changed",
    [MONGE_CHANGE_LIGHT] = "moved, colour or strength changed",
};

/* Spaces for control characters, those of two bytes too: names come from scenes, and this goes to terminals. */
static void make_harmless(char *text) {
    for (unsigned char *c = (unsigned char *)text; *c; c++) {
        const bool wide = c[0] == 0xc2 && c[1] >= 0x80 && c[1] < 0xa0;
        if (wide) c[1] = ' ';
        if (wide || *c < 0x20 || *c == 0x7f) *c = ' ';
    }
}

static int print_setting(const struct monge_change *change, char *text, size_t size) {
    return snprintf(text, size, "settings: %s %s -> %s", change->setting, change->older, change->newer);
}

static int print_following(const struct monge_change *change, char *text, size_t size) {
    return snprintf(text, size, "shading of %u object%s changed by that, geometry and materials equal",
                    change->objects, change->objects == 1 ? "" : "s");
}

static int print_entry(const struct monge_change *change, char *text, size_t size) {
    const struct monge_entry *o = change->object;
    const char *words = kind_words[change->kind], *before = o->name ? "object \"" : o->kind,
               *name = o->name ? o->name : "", *after = o->name ? "\"" : "";
    const char *was = change->kind == MONGE_CHANGE_DISAPPEARED ? "was at " : ""; /* the scene of then */
    return o->file ? snprintf(text, size, "%s%s%s (%s%s:%u): %s", before, name, after, was, o->file, o->line,
                              words)
                   : snprintf(text, size, "%s%s%s: %s", before, name, after, words);
}

size_t monge_change_text(const struct monge_change *change, char *text, size_t size) {
    const enum monge_change_kind kind = change->kind;
    const int length = kind == MONGE_CHANGE_SETTING     ? print_setting(change, text, size)
                       : kind == MONGE_CHANGE_FOLLOWING ? print_following(change, text, size)
                       : kind == MONGE_CHANGE_OTHERS    ? snprintf(text, size, "%s", kind_words[kind])
                       : change->object                 ? print_entry(change, text, size)
                                                        : snprintf(text, size, "background: colour changed");
    if (size > 0) make_harmless(text);
    return (size_t)length;
}
