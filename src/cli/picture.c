#include "cli/picture.h"

#include <inttypes.h>

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
    fprintf(out, ", \"width\": %u, \"height\": %u, \"samples\": %u, \"threads\": %u, \"primitives\": %zu",
            p->region.width, p->region.height, p->settings.samples, p->stats.threads, p->primitives);
    fprintf(out, ", \"seconds\": {\"load\": %.6f, \"build\": %.6f, \"render\": %.6f, \"write\": %.6f}",
            p->load_seconds, p->stats.build_seconds, p->stats.render_seconds, p->write_seconds);
    print_rays(out, p->stats.rays);
    fprintf(out, ", \"peak_memory_bytes\": %" PRIu64, p->peak_memory_bytes);
    fprintf(out, ", \"program\": \"%s\", \"scene_hash\": \"%s\", \"pixel_hash\": \"%s\"", monge_program(),
            p->scene_hash, p->pixel_hash);
}

void picture_write_json(const struct picture *p, FILE *out) {
    fputs("{\"scene\": ", out);
    monge_write_json_string(p->scene, out);
    fputs(", \"output\": ", out);
    monge_write_json_string(p->output, out);
    if (p->frame) fprintf(out, ", \"frame\": %u", p->frame);
    if (p->define_count > 0) print_params(out, p);
    fprintf(out, ", \"status\": \"%s\"", OUTCOMES[p->outcome]);
    if (p->outcome == PICTURE_FAILED) fputs(", \"error\": true", out);
    if (p->outcome == PICTURE_RENDERED) print_rendering(out, p);
    fputs("}", out);
}
