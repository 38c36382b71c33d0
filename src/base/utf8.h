/* UTF-8, of texts that may be in any bytes. */
#ifndef MONGE_BASE_UTF8_H
#define MONGE_BASE_UTF8_H

#include <stddef.h>
#include <stdint.h>

/* The code point of the UTF-8 at text[0], of `left` bytes, at least 1, and its length in bytes;
 * UINT32_MAX and 1 for what is none (Unicode 15, table 3-7). */
uint32_t utf8_decode(const char *text, size_t left, size_t *bytes);

#endif
