#include "cli/picture.h"

#include <inttypes.h>
#include <stdlib.h>
#include <unistd.h>

void picture_free(struct picture *picture) {
    free(picture->output);
    problem_free(&picture->problem);
}

static const char *const OUTCOMES[] = {
    [PICTURE_FAILED] = "failed", [PICTURE_RENDERED] = "rendered", [PICTURE_UNCHANGED] = "unchanged"};

static void print_rays(FILE *out, const uint64_t rays[MONGE_RAY_KINDS]) {
    static const char *const names[MONGE_RAY_KINDS] = {
        [MONGE_RAY_CAMERA] = "camera",
        [MONGE_RAY_SHADOW] = "shadow",
        [MONGE_RAY_REFLECTION] = "reflection",
        [MONGE_RAY_REFRACTION] = "refraction",
    };
    uint64_t total = 0;
    fputs(", \"rays\": {", out);
    for (int kind = 0; kind < MONGE_RAY_KINDS; kind++) {
        fprintf(out, "\"%s\": %" PRIu64 ", ", names[kind], rays[kind]);
        total += rays[kind];
    }
    fprintf(out, "\"total\": %" PRIu64 "}", total);
}

static void print_params(FILE *out, const struct picture *p) {
    fputs(", \"params\": {", out);
    for (size_t i = 0; i < p->define_count; i++) {
        fputs(i > 0 ? ", " : "", out);
        monge_write_json_string(p->defines[i].name, out);
        fputs(": ", out);
        monge_write_json_string(p->defines[i].value, out);
    }
    fputs("}", out);
}

static void print_rendering(FILE *out, const struct picture *p) {
    fprintf(out, ", \"samples\": %u, \"threads\": %u, \"primitives\": %zu", p->settings.samples,
            p->stats.threads, p->primitives);
    fprintf(out, ", \"seconds\": {\"load\": %.6f, \"build\": %.6f, \"render\": %.6f, \"write\": %.6f}",
            p->load_seconds, p->stats.build_seconds, p->stats.render_seconds, p->write_seconds);
    print_rays(out, p->stats.rays);
    fprintf(out, ", \"peak_memory_bytes\": %" PRIu64, p->peak_memory_bytes);
}

/* Of one that is there: what it is. */
static void print_file(FILE *out, const struct picture *p) {
    fprintf(out, ", \"width\": %u, \"height\": %u", p->region.width, p->region.height);
    fprintf(out, ", \"program\": \"%s\", \"scene_hash\": \"%s\", \"pixel_hash\": \"%s\"", monge_program(),
            p->scene_hash, p->pixel_hash);
}

static void print_text(FILE *out, const char *text) {
    if (text)
        monge_write_json_string(text, out);
    else
        fputs("null", out);
}

static void print_number(FILE *out, unsigned number) {
    if (number)
        fprintf(out, "%u", number);
    else
        fputs("null", out);
}

static void print_problem(FILE *out, const struct problem *problem) {
    fputs(", \"error\": {\"code\": ", out);
    print_text(out, problem->code);
    fputs(", \"message\": ", out);
    print_text(out, problem->message);
    fputs(", \"file\": ", out);
    print_text(out, problem->file);
    fputs(", \"line\": ", out);
    print_number(out, problem->line);
    fputs(", \"column\": ", out);
    print_number(out, problem->column);
    fputs("}", out);
}

void picture_write_json(const struct picture *p, const char *started, FILE *out) {
    fputs("{", out);
    if (started) fprintf(out, "\"started\": \"%s\", \"pid\": %ld, ", started, (long)getpid());
    fputs("\"scene\": ", out);
    monge_write_json_string(p->scene, out);
    fputs(", \"output\": ", out);
    print_text(out, p->output);
    if (p->frame) fprintf(out, ", \"frame\": %u", p->frame);
    if (p->define_count > 0) print_params(out, p);
    fprintf(out, ", \"status\": \"%s\"", OUTCOMES[p->outcome]);
    if (p->outcome == PICTURE_FAILED) print_problem(out, &p->problem);
    if (p->outcome != PICTURE_FAILED) print_file(out, p);
    if (p->outcome == PICTURE_RENDERED) print_rendering(out, p);
    fputs("}", out);
}
