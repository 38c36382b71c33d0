#include "base/utf8.h"

uint32_t utf8_decode(const char *text, size_t left, size_t *bytes) {
    const unsigned char *t = (const unsigned char *)text;
    const size_t n = t[0] < 0x80   ? 1
                     : t[0] < 0xc2 ? 0
                     : t[0] < 0xe0 ? 2
                     : t[0] < 0xf0 ? 3
                     : t[0] < 0xf5 ? 4
                                   : 0;
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    *bytes = 1;
    if (n == 0 || n > left) return UINT32_MAX;
    uint32_t code = n == 1 ? t[0] : t[0] & (0x7fu >> n);
    for (size_t i = 1; i < n; i++) {
        if ((t[i] & 0xc0) != 0x80) return UINT32_MAX;
        code = code << 6 | (t[i] & 0x3f);
    }
    if (code < least[n] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return UINT32_MAX;
    *bytes = n;
    return code;
}
