/* The distance from its definition, and which candidates are near. */
#include <string.h>

#include "lang/spelling.h"
#include "near.h"

static int lower(char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; }

static bool same(char a, char b) { return lower(a) == lower(b); }

/* Optimal string alignment, as it is defined: by all ways to begin. */
static unsigned distance_by_definition(const char *a, const char *b) {
    if (!*a || !*b) return (unsigned)(strlen(a) + strlen(b));
    const unsigned removed = distance_by_definition(a + 1, b) + 1,
                   added = distance_by_definition(a, b + 1) + 1;
    unsigned best = distance_by_definition(a + 1, b + 1) + !same(*a, *b);
    if (removed < best) best = removed;
    if (added < best) best = added;
    if (a[1] && b[1] && same(a[0], b[1]) && same(a[1], b[0])) {
        const unsigned swapped = distance_by_definition(a + 2, b + 2) + 1;
        if (swapped < best) best = swapped;
    }
    return best;
}

static void random_word(struct random *r, char *word, unsigned most) {
    const unsigned length = random_below(r, most + 1);
    for (unsigned i = 0; i < length; i++) word[i] = "abcAB"[random_below(r, 5)];
    word[length] = '\0';
}

static void distances_are_as_defined(void **state) {
    (void)state;
    struct random r = random_begin();
    for (int i = 0; i < 3000; i++) {
        char a[10], b[10];
        random_word(&r, a, 7);
        random_word(&r, b, 7);
        if (spelling_distance(a, b) != distance_by_definition(a, b))
            fail_msg("%s and %s: got %u, want %u", a, b, spelling_distance(a, b),
                     distance_by_definition(a, b));
    }
}

/* What spelling_offer may answer, by the rule of its header. */
static bool is_near(const char *word, const char *candidate, unsigned *distance) {
    const size_t m = strlen(word), n = strlen(candidate), third = (m > n ? m : n) / 3;
    bool start = m >= 3 && m < n;
    for (size_t i = 0; start && i < m; i++) start = same(word[i], candidate[i]);
    *distance = distance_by_definition(word, candidate);
    if (start && *distance > third) *distance = (unsigned)third;
    return *distance <= third;
}

static void offers_keep_the_first_of_the_nearest(void **state) {
    (void)state;
    struct random r = random_begin();
    for (int i = 0; i < 500; i++) {
        char word[10], candidates[6][10];
        random_word(&r, word, 7);
        struct spelling s = spelling_begin(word);
        const char *best = NULL;
        unsigned least = 1000, distance;
        for (int j = 0; j < 6; j++) {
            random_word(&r, candidates[j], 7);
            spelling_offer(&s, candidates[j]);
            if (is_near(word, candidates[j], &distance) && distance < least) {
                best = candidates[j];
                least = distance;
            }
        }
        assert_ptr_equal(s.best, best);
        if (best) assert_int_equal(s.distance, least);
    }
}

#define SIXTY_FOUR "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef"

static struct row {
    const char *name, *word, *candidate;
    unsigned distance;
    bool near;
} rows[] = {
    {"the same", "radius", "radius", 0, true},
    {"letter case apart", "Radius", "rADIUS", 0, true},
    {"two letters swapped", "raduis", "radius", 1, true},
    {"a letter left out", "spere", "sphere", 1, true},
    {"a letter too many", "spheere", "sphere", 1, true},
    {"another letter", "cilinder", "cylinder", 1, true},
    {"a third of the letters", "colour", "color", 1, true},
    {"more than a third", "ball", "box", 3, false},
    {"one of two letters", "at", "to", 2, false},
    {"one of three letters", "fof", "fov", 1, true},
    {"how it begins", "ortho", "orthographic", 7, true},
    {"how it begins, in capitals", "ORTHO", "orthographic", 7, true},
    {"two letters are no beginning", "or", "orthographic", 10, false},
    {"longer than the candidate", "orthographic", "ortho", 7, false},
    {"nothing", "", "sphere", 6, false},
    {"64 letters", SIXTY_FOUR, "x" SIXTY_FOUR, 64, false},
    {"65 letters count as far", SIXTY_FOUR "x", SIXTY_FOUR "x", 64, false},
};

static void check_row(void **state) {
    const struct row *row = *state;
    struct spelling s = spelling_begin(row->word);
    assert_int_equal(spelling_distance(row->word, row->candidate), row->distance);
    assert_int_equal(spelling_distance(row->candidate, row->word), row->distance);
    spelling_offer(&s, row->candidate);
    assert_ptr_equal(s.best, row->near ? row->candidate : NULL);
}

int main(void) {
    struct CMUnitTest tests[COUNT(rows)];
    for (size_t i = 0; i < COUNT(rows); i++)
        tests[i] = (struct CMUnitTest){rows[i].name, check_row, NULL, NULL, &rows[i]};
    const struct CMUnitTest others[] = {cmocka_unit_test(distances_are_as_defined),
                                        cmocka_unit_test(offers_keep_the_first_of_the_nearest)};
    return cmocka_run_group_tests_name("rows", tests, NULL, NULL) +
           cmocka_run_group_tests_name("spelling", others, NULL, NULL);
}
