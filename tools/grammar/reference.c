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

static void reference_expressions(FILE *out, const struct definition *language) {
    fputs("\n## Expressions\n\nWherever a number is expected, an expression may stand: numbers, colours, "
          "names, `[x, y, z]`, and, "
          "from what binds most to what binds least,\n\n"
          "| | |\n| --- | --- |\n"
          "| `v.x` `v.y` `v.z` `c.r` `c.g` `c.b` `v[i]` | parts of a vector or colour; i counts from 0 |\n"
          "| `a ^ b` | power, from right to left: `2 ^ 3 ^ 2` is `2 ^ 9`, `-2 ^ 2` is -4 |\n"
          "| `-a` `+a` `!a` | negative, itself, not |\n"
          "| `a * b` `a / b` `a % b` | product, quotient, the rest of it with the sign of b |\n"
          "| `a + b` `a - b` | sum, difference |\n"
          "| `a < b` `a <= b` `a > b` `a >= b` | comparisons; they give 1 or 0, and do not chain |\n"
          "| `a == b` `a != b` | equal, not equal |\n"
          "| `a && b` | and; b is not looked at where a is 0 |\n"
          "| `a \\|\\| b` | or; b is not looked at where a is not 0 |\n"
          "| `a ? b : c` | b where a is not 0, else c |\n\n"
          "Vectors go through arithmetic and through the functions of numbers part by part; a number meets a "
          "vector by being repeated. "
          "Angles are in degrees. Every result must be a finite number. `#rgb`, `#rrggbb` and the names of "
          "CSS are linear colours; no "
          "parameter and no loop variable can have the name of a colour or a constant.\n\n"
          "| function | | example | gives |\n| --- | --- | --- | --- |\n",
          out);
    for (const struct node *k = language->functions->first; k; k = k->next->next) {
        const char *call = text_of(k->next, "call"), *doc = text_of(k->next, "doc");
        const char *domain = text_of(k->next, "domain"), *example = text_of(k->next, "example");
        fprintf(out, "| `%s` | %s%s |", call, doc, domain ? format(" Takes %s.", domain) : "");
        if (example)
            fprintf(out, " `%s` | `%s` |\n", example, text_of(k->next, "gives"));
        else
            fputs(" | |\n", out);
    }
    fputs("\n| constant | | value |\n| --- | --- | --- |\n", out);
    for (const struct node *k = language->constants->first; k; k = k->next->next)
        fprintf(out, "| `%s` | %s | %s |\n", k->text, text_of(k->next, "doc"), text_of(k->next, "value"));
}

void write_reference(FILE *out, const struct definition *language) {
    fputs("# Reference of the scene language\n\nGenerated from `language.yaml` and `functions.yaml`. A "
          "*color* is linear `[r, g, "
          "b]`, each 0 to 1, or sRGB: a string "
          "like `\"#ffd700\"` or a CSS name like `gold`. Angles are in degrees. A *point* is in the space of "
          "the object that has the key.\n",
          out);
    for (const struct node *k = language->kinds->first; k; k = k->next->next)
        reference_kind(out, k->text, k->next);
    reference_expressions(out, language);
    fputs("\n## Words that are reserved\n\nThis version knows these words and says that they are not there "
          "yet.\n\n"
          "| word | in | for |\n| --- | --- | --- |\n",
          out);
    for (const struct node *k = language->kinds->first; k; k = k->next->next)
        reference_later(out, k->text, k->next);
}
