#include "cli/golden/results.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/aov.h"
#include "cli/golden/folder.h"
#include "cli/golden/take.h"
#include "cli/golden/tell.h"
#include "cli/paths.h"
#include "cli/say.h"
#include "cli/words.h"

size_t golden_count(const struct golden_results *results, enum golden_status status) {
    size_t count = 0;
    for (size_t i = 0; i < results->count; i++) count += results->cases[i].status == status;
    return count;
}

char *golden_summary(const struct golden_results *results) {
    char *text = say_text("%zu golden%s", results->count, results->count == 1 ? "" : "s");
    size_t counts[GOLDEN_STATUSES + 1] = {0}; /* the last of what is taken, whatever it was */
    const char *before = ": ";
    for (size_t i = 0; i < results->count; i++)
        counts[results->cases[i].taken ? GOLDEN_STATUSES : results->cases[i].status]++;
    for (enum golden_status s = 0; s <= GOLDEN_STATUSES; s++) {
        if (counts[s] == 0) continue;
        char *longer =
            say_text("%s%s%zu %s", text, before, counts[s], s < GOLDEN_STATUSES ? GOLDEN_STATUS[s] : "taken");
        free(text);
        text = longer;
        before = ", ";
    }
    return text;
}

char *golden_accept_words(const char *folder, const char *output) {
    char *quoted_folder = word_quoted(folder), *quoted_output = word_quoted(output ? output : "");
    char *words = say_text("monge accept --golden %s%s%s", quoted_folder, output ? " --output " : "",
                           output ? quoted_output : "");
    free(quoted_output);
    free(quoted_folder);
    return words;
}

char *golden_interruption(const struct golden_results *results) {
    const size_t scenes = results->interrupted;
    return scenes ? say_text("interrupted: %zu scene%s not judged", scenes, scenes == 1 ? "" : "s") : NULL;
}

/* ---- Writing ---- */

static void put_key(FILE *out, const char *key) { fprintf(out, ",\n     \"%s\": ", key); }

static void put_text(FILE *out, const char *key, const char *text) {
    if (!text) return;
    put_key(out, key);
    monge_write_json_string(text, out);
}

static void put_flag(FILE *out, const char *key, bool flag) {
    if (!flag) return;
    put_key(out, key);
    fputs("true", out);
}

/* What JSON has no word for is null. */
static void put_number(FILE *out, double number) {
    if (isfinite(number))
        fprintf(out, "%.9g", number);
    else
        fputs("null", out);
}

static void put_difference(FILE *out, const struct monge_difference *d) {
    const struct {
        const char *name;
        double value;
    } metrics[] = {{"exact", (double)d->different / (double)(d->pixels ? d->pixels : 1)},
                   {"max", d->max},
                   {"mae", d->mae},
                   {"rmse", d->rmse},
                   {"psnr", d->psnr},
                   {"ssim", d->ssim},
                   {"flip", d->flip}};
    if (isnan(d->max)) return;
    put_key(out, "pixels");
    fprintf(out, "{\"compared\": %llu, \"different\": %llu, \"bounds\": [%u, %u, %u, %u]}",
            (unsigned long long)d->pixels, (unsigned long long)d->different, d->bounds.x, d->bounds.y,
            d->bounds.width, d->bounds.height);
    put_key(out, "metrics");
    const char *before = "{";
    for (size_t i = 0; i < sizeof metrics / sizeof *metrics; i++) {
        if (isnan(metrics[i].value)) continue;
        fprintf(out, "%s\"%s\": ", before, metrics[i].name);
        put_number(out, metrics[i].value);
        before = ", ";
    }
    fputs("}", out);
}

static void put_tolerance(FILE *out, const struct golden_case *c) {
    if (!c->tolerance_text) return;
    put_key(out, "tolerance");
    fputs("{\"text\": ", out);
    monge_write_json_string(c->tolerance_text, out);
    fputs(", \"reason\": ", out);
    monge_write_json_string(c->tolerance.reason, out);
    char *beyond = golden_beyond_text(c);
    if (beyond) fputs(", \"beyond\": ", out);
    if (beyond) monge_write_json_string(beyond, out);
    free(beyond);
    fputs("}", out);
}

static void put_stamp(FILE *out, const char *key, const struct golden_stamp *s) {
    const char *const hashes[][2] = {
        {"pixels", s->pixels}, {"scene", s->scene}, {"text", s->text}, {"program", s->program}};
    const char *before = "";
    if (!*s->pixels && !*s->text) return;
    put_key(out, key);
    fputs("{", out);
    for (size_t i = 0; i < 4; i++) {
        if (!*hashes[i][1]) continue;
        fprintf(out, "%s\"%s\": \"%s\"", before, hashes[i][0], hashes[i][1]);
        before = ", ";
    }
    for (int i = 0; i < GOLDEN_LAYERS; i++)
        if (*s->layers[i])
            fprintf(out, "%s\"%s\": \"%s\"", before, monge_layer_name(GOLDEN_LAYER[i]), s->layers[i]);
    if (s->width) fprintf(out, "%s\"size\": [%u, %u], \"bits\": %u", before, s->width, s->height, s->bits);
    if (s->options) {
        fputs(", \"options\": ", out);
        monge_write_json_string(s->options, out);
    }
    fputs("}", out);
}

static void put_pictures(FILE *out, const char *golden, const char *new) {
    if (!golden && !new) return;
    put_key(out, "pictures");
    fputs("{", out);
    if (golden) fputs("\"golden\": ", out);
    if (golden) monge_write_json_string(golden, out);
    if (new) fputs(golden ? ", \"new\": " : "\"new\": ", out);
    if (new) monge_write_json_string(new, out);
    fputs("}", out);
}

/* Those that are there of the files beside the two pictures. */
static void put_layers(FILE *out, const struct golden_case *c) {
    const char *const pictures[] = {c->golden_path, c->new_path}, *const keys[] = {"golden", "new"},
                      *before = NULL;
    for (enum monge_layer layer = 0; layer < MONGE_LAYERS; layer++) {
        const char *inner = NULL;
        for (int side = 0; side < 2; side++) {
            char *path = pictures[side] ? aov_path(layer, pictures[side]) : NULL;
            if (path && path_is_file(path)) {
                if (!before) put_key(out, "layers");
                if (!inner) fprintf(out, "%s\"%s\": ", before ? before : "{", monge_layer_name(layer));
                fprintf(out, "%s\"%s\": ", inner ? inner : "{", keys[side]);
                monge_write_json_string(path, out);
                before = inner = ", ";
            }
            free(path);
        }
        if (inner) fputs("}", out);
    }
    if (before) fputs("}", out);
}

static void put_changes(FILE *out, const struct golden_case *c) {
    if (c->change_count == 0) return;
    put_key(out, "changes");
    for (size_t i = 0; i < c->change_count; i++) {
        fputs(i == 0 ? "[" : ", ", out);
        monge_write_json_string(c->changes[i], out);
    }
    fputs("]", out);
}

static void put_causes(FILE *out, const struct golden_case *c) {
    static const char *const words[] = {"null", "false", "true"};
    const struct monge_causes causes = golden_causes(c);
    if (!*c->old.text) return;
    put_key(out, "differs");
    fprintf(out, "{\"text\": %s, \"options\": %s, \"program\": %s}", words[causes.text],
            words[causes.options], words[causes.program]);
}

/* The name as a glob that only it matches. */
static char *glob_of(const char *name) {
    char *glob = malloc(2 * strlen(name) + 1), *to = glob;
    if (!glob) say_no_memory();
    for (; *name; *to++ = *name++)
        if (strchr("*?[\\", *name)) *to++ = '\\';
    *to = '\0';
    return glob;
}

static void put_accept_command(FILE *out, const char *accept, const struct golden_case *c) {
    if (!accept || !golden_can_take(c) || c->taken) return;
    char *glob = glob_of(c->name), *word = word_quoted(glob);
    char *command = say_text("%s %s%s", accept, *c->name == '-' ? "-- " : "", word);
    put_text(out, "accept_command", command);
    free(command);
    free(word);
    free(glob);
}

/* Where pixels cannot be compared there are no metrics: why that is so. */
static void put_unlike(FILE *out, const struct golden_case *c) {
    if (!c->compared || !isnan(c->difference.max) || c->message) return;
    char *detail = golden_detail(c);
    put_text(out, "message", detail);
    free(detail);
}

static void put_case(FILE *out, const char *accept, const struct golden_case *c) {
    fputs("    {\"name\": ", out);
    monge_write_json_string(c->name, out);
    put_text(out, "status", GOLDEN_STATUS[c->status]);
    put_text(out, "scene", c->scene);
    put_text(out, "scene_name", c->scene_name);
    put_text(out, "kind", GOLDEN_KIND[c->kind]);
    put_text(out, "rule_options", c->rule_options);
    put_flag(out, "unchanged", c->unchanged);
    put_flag(out, "within_tolerance", c->within);
    put_flag(out, "taken", c->taken);
    put_text(out, "message", c->message);
    if (c->compared) put_difference(out, &c->difference);
    put_unlike(out, c);
    put_tolerance(out, c);
    put_changes(out, c);
    put_causes(out, c);
    put_pictures(out, c->golden_path, c->new_path);
    put_layers(out, c);
    put_stamp(out, "stamp", &c->now);
    put_stamp(out, "golden_stamp", &c->old);
    if (*c->golden_file) put_text(out, "golden_file", c->golden_file);
    put_text(out, "golden_line", c->golden_line);
    put_text(out, "command", c->command);
    put_text(out, "old_command", c->old_command);
    put_accept_command(out, accept, c);
    put_key(out, "seconds");
    fprintf(out, "%.3f}", c->seconds);
}

static void put_places(FILE *out, const struct golden_places *places) {
    if (places->root) {
        fputs(",\n \"root\": ", out);
        monge_write_json_string(places->root, out);
    }
    for (size_t i = 0; i < places->count; i++) {
        fputs(i == 0 ? ",\n \"folders\": [" : ", ", out);
        monge_write_json_string(places->folders[i], out);
    }
    if (places->count > 0) fputs("]", out);
}

static void put_head(FILE *out, const struct golden_results *results) {
    char *summary = golden_summary(results), *interruption = golden_interruption(results);
    char *about = say_text("monge %s, %s, in %.1f s%s%s", monge_version(), summary, results->seconds,
                           interruption ? ", " : "", interruption ? interruption : "");
    fputs("{\"about\": ", out);
    monge_write_json_string(about, out);
    fprintf(out, ",\n \"version\": \"%s\",\n \"program\": \"%s\",\n \"golden\": ", monge_version(),
            monge_program());
    monge_write_json_string(results->folder, out);
    if (results->from) fputs(",\n \"from\": ", out);
    if (results->from) monge_write_json_string(results->from, out);
    put_places(out, &results->places);
    fputs(",\n \"summary\": {", out);
    for (enum golden_status s = 0; s < GOLDEN_STATUSES; s++)
        fprintf(out, "%s\"%s\": %zu", s ? ", " : "", GOLDEN_STATUS[s], golden_count(results, s));
    fputs("}", out);
    if (results->interrupted) fprintf(out, ",\n \"interrupted\": %zu", results->interrupted);
    fprintf(out, ",\n \"seconds\": %.3f,\n \"scenes\": [\n", results->seconds);
    free(about);
    free(interruption);
    free(summary);
}

char *golden_results_text(const struct golden_results *results) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = say_text_begin(&text, &size);
    put_head(out, results);
    for (size_t i = 0; i < results->count; i++) {
        put_case(out, results->accept, &results->cases[i]);
        fputs(i + 1 < results->count ? ",\n" : "\n", out);
    }
    fputs(" ]}\n", out);
    say_text_end(out);
    return text;
}
