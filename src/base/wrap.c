#include "base/wrap.h"

#include <stdbool.h>
#include <string.h>

void wrap_print(FILE *out, const char *text, int column, int indent) {
    for (bool first = true; *text; first = false) {
        const int length = (int)strcspn(text, " \n");
        if (!first && column + 1 + length > WRAP_WIDTH) {
            fprintf(out, "\n%*s", indent, "");
            column = indent;
        } else if (!first) {
            fputc(' ', out);
            column++;
        }
        fprintf(out, "%.*s", length, text);
        column += length;
        text += length;
        text += strspn(text, " \n");
    }
    fputc('\n', out);
}
