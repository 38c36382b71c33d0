#include "definition.h"

static bool is_later(const struct node *key) { return type_is(key, "later"); }

static void reference_kind(FILE *out, const char *name, const struct node *kind) {
    fprintf(out, "\n## %s\n\n%s\n", name, text_of(kind, "doc"));
    bool alternatives = false;
    for (const struct node *k = keys_of(kind); k; k = k->next->next)
        alternatives |= is_true(k->next, "alternative");
    if (alternatives) fprintf(out, "Exactly one of the keys marked with a dot (•) must be given.\n");
    fprintf(out, "\n| key | value | range | default | |\n| --- | --- | --- | --- | --- |\n");
    for (const struct node *k = keys_of(kind); k; k = k->next->next) {
        if (is_later(k->next)) continue;
        const char *otherwise = default_text(k->next);
        const char *example = text_of(k->next, "example");
        fprintf(out, "| `%s`%s | %s | %s | %s | %s%s |\n", k->text,
                is_true(k->next, "alternative") ? " •" : "", type_text(k->next, true), range_text(k->next),
                is_true(k->next, "required") ? "must be given"
                : otherwise                  ? otherwise
                                             : "-",
                text_of(k->next, "doc"), example ? format(" `%s`", example) : "");
    }
}

static void reference_later(FILE *out, const char *name, const struct node *kind) {
    for (const struct node *k = keys_of(kind); k; k = k->next->next)
        if (is_later(k->next)) fprintf(out, "| `%s` | %s | %s |\n", k->text, name, text_of(k->next, "doc"));
}

void write_reference(FILE *out, const struct definition *language) {
    fputs("# Reference of the scene language\n\nGenerated from `language.yaml`. A *color* is linear `[r, g, "
          "b]`, each 0 to 1, or sRGB: a string "
          "like `\"#ffd700\"` or a CSS name like `gold`. Angles are in degrees. A *point* is in the space of "
          "the object that has the key.\n",
          out);
    for (const struct node *k = language->kinds->first; k; k = k->next->next)
        reference_kind(out, k->text, k->next);
    fputs("\n## Words that are reserved\n\nThis version knows these words and says that they are not there "
          "yet.\n\n"
          "| word | in | for |\n| --- | --- | --- |\n",
          out);
    for (const struct node *k = language->kinds->first; k; k = k->next->next)
        reference_later(out, k->text, k->next);
}
