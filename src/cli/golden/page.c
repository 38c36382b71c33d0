#include "cli/golden/page.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/say.h"
#include "monge.h"

/* ---- Parts ---- */

/* A JSON document within HTML: `<` stands in its texts alone, where it may be written otherwise. */
static void put_json(const char *json, FILE *out) {
    for (const char *c = json; *c; c++)
        if (*c == '<')
            fputs("\\u003c", out);
        else
            putc(*c, out);
}

static void put_attribute(const char *text, FILE *out) {
    for (const char *c = text; *c; c++) switch (*c) {
        case '&': fputs("&amp;", out); break;
        case '"': fputs("&quot;", out); break;
        case '<': fputs("&lt;", out); break;
        default: putc(*c, out);
        }
}

/* RFC 4648. */
static void put_base64(const unsigned char *bytes, size_t size, FILE *out) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        const unsigned second = i + 1 < size ? bytes[i + 1] : 0, third = i + 2 < size ? bytes[i + 2] : 0;
        const unsigned all = (unsigned)bytes[i] << 16 | second << 8 | third;
        putc(digits[all >> 18], out);
        putc(digits[all >> 12 & 63], out);
        putc(i + 1 < size ? digits[all >> 6 & 63] : '=', out);
        putc(i + 2 < size ? digits[all & 63] : '=', out);
    }
}

static void put_picture(const char *path, FILE *out) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_text file;
    if (diag && monge_text_read(path, NULL, &file, diag)) {
        fputs("<script type=\"text/plain\" class=\"picture\" data-path=\"", out);
        put_attribute(path, out);
        fputs("\">", out);
        put_base64((const unsigned char *)file.bytes, file.size, out);
        fputs("</script>\n", out);
        monge_text_free(&file);
    }
    monge_diagnostics_free(diag);
}

/* ---- The page ---- */

static void put_page(const char *results, char *const *pictures, size_t count, FILE *out) {
    static const char results_mark[] = "/*RESULTS*/", pictures_mark[] = "<!--PICTURES-->";
    const char *json = strstr(page_text, results_mark), *elements = strstr(page_text, pictures_mark);
    fwrite(page_text, 1, (size_t)(json - page_text), out);
    put_json(results, out);
    json += sizeof results_mark - 1;
    fwrite(json, 1, (size_t)(elements - json), out);
    for (size_t i = 0; i < count; i++) put_picture(pictures[i], out);
    fputs(elements + sizeof pictures_mark - 1, out);
}

static bool write_text(const char *path, const struct monge_text *text) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    const bool written = diag && monge_text_write(path, text, diag);
    if (diag && !written) monge_diagnostics_print(diag, stderr);
    monge_diagnostics_free(diag);
    return written;
}

bool page_write(const char *path, const char *results, char *const *pictures, size_t count) {
    struct monge_text page = {NULL, 0};
    FILE *out = open_memstream(&page.bytes, &page.size);
    if (out) put_page(results, pictures, count, out);
    const bool made = out && !ferror(out) && fclose(out) == 0;
    if (!made) say_error("%s: no memory for the report", path);
    const bool written = made && write_text(path, &page);
    free(page.bytes);
    return written;
}
