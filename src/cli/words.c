#include "cli/words.h"

#include <stdlib.h>
#include <string.h>

#include "cli/say.h"

char *word_quoted(const char *text) {
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=+,:@%";
    if (*text && strspn(text, plain) == strlen(text)) return say_text("%s", text);
    char *all = say_text("%s", "'");
    for (const char *c = text; *c; c++) {
        char *longer = *c == '\'' ? say_text("%s'\\''", all) : say_text("%s%c", all, *c);
        free(all);
        all = longer;
    }
    char *closed = say_text("%s'", all);
    free(all);
    return closed;
}

char *word_next(char **at, bool *open) {
    char *c = *at + strspn(*at, " \t\n"), *const word = c, *to = c, quote = 0;
    if (!*c) return NULL;
    for (; *c && (quote || !strchr(" \t\n", *c)); c++) {
        if (quote ? *c == quote : *c == '"' || *c == '\'')
            quote = quote ? 0 : *c;
        else
            *to++ = *c == '\\' && quote != '\'' && c[1] ? *++c : *c;
    }
    *at = *c ? c + 1 : c;
    *to = '\0';
    *open = quote != 0;
    return word;
}
