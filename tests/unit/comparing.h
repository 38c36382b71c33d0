/* Comparing PNG files that are made for it. */
#ifndef MONGE_TESTS_COMPARING_H
#define MONGE_TESTS_COMPARING_H

#include "pictures.h"

static inline struct monge_difference compare_files(const char *a, const char *b, struct monge_compare how) {
    struct monge_diagnostics *diag = monge_diagnostics_new();
    struct monge_difference d;
    struct monge_picture *of_a = read_good(a), *of_b = read_good(b);
    if (!monge_compare(of_a, of_b, &how, &d, diag)) {
        monge_diagnostics_print(diag, stdout);
        fail_msg("cannot be compared");
    }
    monge_picture_free(of_a);
    monge_picture_free(of_b);
    monge_diagnostics_free(diag);
    return d;
}

static inline struct monge_difference compare_with(const struct sample *a, const struct sample *b,
                                                   struct monge_compare how) {
    write_sample("a.png", a);
    write_sample("b.png", b);
    return compare_files("a.png", "b.png", how);
}

static inline struct monge_difference compare(const struct sample *a, const struct sample *b) {
    return compare_with(a, b, (struct monge_compare){0});
}

#endif
