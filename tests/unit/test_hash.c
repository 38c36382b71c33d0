/* FNV-1a with 128 bits. The first four digests are those of the reference (and of Go's hash/fnv); the
 * others come from the definition, in Python. */
#include <string.h>

#include "base/hash.h"
#include "near.h"

static struct vector {
    const char *name, *bytes;
    size_t size;
    const char *want;
} vectors[] = {
    {"nothing", "", 0, "6c62272e07bb014262b821756295c58d"},
    {"a", "a", 1, "d228cb696f1a8caf78912b704e4a8964"},
    {"ab", "ab", 2, "08809544bbab1be95aa0733055b69a62"},
    {"abc", "abc", 3, "a68d622cec8b5822836dbc7977af7f3b"},
    {"foobar", "foobar", 6, "343e1662793c64bf6f0d3597ba446f18"},
    {"a zero byte", "", 1, "d228cb69101a8caf78912b704e4a147f"},
};

static void assert_digest(const struct hash *hash, const char *want) {
    char text[HASH_TEXT_SIZE];
    hash_text(hash, text);
    assert_string_equal(text, want);
}

static void check_vector(void **state) {
    const struct vector *row = *state;
    struct hash hash, pieces;
    hash_begin(&hash);
    hash_bytes(&hash, row->bytes, row->size);
    assert_digest(&hash, row->want);
    hash_begin(&pieces);
    for (size_t i = 0; i < row->size; i++) hash_bytes(&pieces, row->bytes + i, 1);
    assert_digest(&pieces, row->want);
}

static void numbers_go_in_as_bytes_least_first(void **state) {
    (void)state;
    struct hash hash, bytes;
    hash_begin(&hash);
    hash_begin(&bytes);
    hash_integer(&hash, 0x0102030405060708u);
    hash_bytes(&bytes, "\x08\x07\x06\x05\x04\x03\x02\x01", 8);
    assert_memory_equal(&hash, &bytes, sizeof hash);
    hash_double(&hash, 1.5);
    hash_bytes(&bytes, "\0\0\0\0\0\0\xf8\x3f", 8);
    assert_memory_equal(&hash, &bytes, sizeof hash);
    hash_vec3(&hash, (vec3){1, -2, 3});
    hash_bytes(&bytes, "\0\0\0\0\0\0\xf0\x3f\0\0\0\0\0\0\0\xc0\0\0\0\0\0\0\x08\x40", 24);
    assert_memory_equal(&hash, &bytes, sizeof hash);
}

/* 8 bytes as one number of 64 bits, the rest one by one, and the size. */
static void many_bytes_go_in_as_words(void **state) {
    (void)state;
    struct hash bulk, want;
    hash_begin(&bulk);
    hash_bulk(&bulk, "\x08\x07\x06\x05\x04\x03\x02\x01xy", 10);
    const unsigned __int128 basis = (unsigned __int128)0x6c62272e07bb0142u << 64 | 0x62b821756295c58du,
                            prime = ((unsigned __int128)1 << 88) + 0x13b,
                            sum = (basis ^ 0x0102030405060708u) * prime;
    want = (struct hash){(uint64_t)(sum >> 64), (uint64_t)sum};
    hash_bytes(&want, "xy", 2);
    hash_integer(&want, 10);
    assert_memory_equal(&bulk, &want, sizeof want);
}

static void both_zeros_are_one_value(void **state) {
    (void)state;
    struct hash plus, minus;
    hash_begin(&plus);
    hash_begin(&minus);
    hash_double(&plus, 0.0);
    hash_double(&minus, -0.0);
    assert_memory_equal(&plus, &minus, sizeof plus);
}

int main(void) {
    struct CMUnitTest tests[COUNT(vectors)];
    for (size_t i = 0; i < COUNT(vectors); i++)
        tests[i] = (struct CMUnitTest){vectors[i].name, check_vector, NULL, NULL, &vectors[i]};
    const struct CMUnitTest others[] = {cmocka_unit_test(numbers_go_in_as_bytes_least_first),
                                        cmocka_unit_test(many_bytes_go_in_as_words),
                                        cmocka_unit_test(both_zeros_are_one_value)};
    return cmocka_run_group_tests_name("vectors", tests, NULL, NULL) +
           cmocka_run_group_tests_name("hash", others, NULL, NULL);
}
