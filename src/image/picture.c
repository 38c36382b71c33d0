#include "image/picture.h"

#include <errno.h>
#include <fcntl.h>
#include <libdeflate.h>
#include <png.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/pages.h"

/* What a file may take: pictures as large as can be rendered have less. */
#define MAX_FILE ((size_t)4 << 30)
enum {
    MAX_CHUNK_MEMORY = 1 << 23,
    MAX_CHUNKS_KEPT = 128,
    MAX_PACKED_TEXT = 1 << 16, /* of all compressed texts: at most 66 MB when it is inflated */
    SIGNATURE = 8,
    CHUNK_FRAME = 12 /* length, type, check sum */
};

static bool fail(char reason[PICTURE_REASON_SIZE], const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static bool fail(char reason[PICTURE_REASON_SIZE], const char *format, ...) {
    va_list args;
    va_start(args, format);
    vsnprintf(reason, PICTURE_REASON_SIZE, format, args);
    va_end(args);
    return false;
}

/* ---- The file ---- */

static bool has_signature(const uint8_t *bytes, size_t size) {
    return size >= SIGNATURE && png_sig_cmp(bytes, 0, SIGNATURE) == 0;
}

/* Reads on until the end; of what does not begin as PNG files do, no more than that: it may have no end. */
static bool read_stream(int fd, size_t room, uint8_t **bytes, size_t *size) {
    *size = 0;
    for (;;) {
        uint8_t *larger = *size < room ? *bytes : realloc(*bytes, room *= 2);
        if (!larger) return false;
        *bytes = larger;
        const size_t wanted = *size < SIGNATURE ? SIGNATURE - *size : room - *size;
        const ssize_t count = read(fd, *bytes + *size, wanted);
        if (count == 0) return true;
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return false;
        *size += (size_t)count;
        if (*size == SIGNATURE && !has_signature(*bytes, *size)) return true;
        errno = EFBIG;
        if (*size > MAX_FILE) return false;
    }
}

static bool read_descriptor(int fd, uint8_t **bytes, size_t *size) {
    struct stat status;
    if (fstat(fd, &status) != 0) return false;
    errno = EISDIR;
    if (S_ISDIR(status.st_mode)) return false;
    errno = EFBIG;
    if (status.st_size > (off_t)MAX_FILE) return false;
    const size_t room = S_ISREG(status.st_mode) ? (size_t)status.st_size + SIGNATURE : 1 << 16;
    *bytes = pages_alloc(room);
    return *bytes && read_stream(fd, room, bytes, size);
}

static bool read_file(struct monge_picture *picture, const char *path, char reason[PICTURE_REASON_SIZE]) {
    const bool standard = strcmp(path, "-") == 0;
    const int fd = standard ? STDIN_FILENO : open(path, O_RDONLY | O_CLOEXEC);
    const bool good = fd >= 0 && read_descriptor(fd, &picture->file, &picture->file_size);
    const int why = errno;
    if (fd >= 0 && !standard) close(fd);
    return good || fail(reason, "%s", strerror(why));
}

/* ---- Chunks: PNG specification, chapter 5 ---- */

static uint32_t read_big(const uint8_t *at) {
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

static bool chunk_is(const uint8_t *chunk, const char *type) { return memcmp(chunk + 4, type, 4) == 0; }

/* Checks one chunk, of which `left` bytes are there. */
static bool check_chunk(const uint8_t *chunk, size_t left, char reason[PICTURE_REASON_SIZE]) {
    if (left < CHUNK_FRAME) return fail(reason, "the file is cut off");
    for (int i = 4; i < 8; i++)
        if (!((chunk[i] | 32) >= 'a' && (chunk[i] | 32) <= 'z')) return fail(reason, "it is damaged");
    const uint32_t size = read_big(chunk);
    if (size > left - CHUNK_FRAME) return fail(reason, "the file is cut off");
    if (libdeflate_crc32(0, chunk + 4, size + 4) == read_big(chunk + 8 + size)) return true;
    return fail(reason, "it is damaged: the check sum of its chunk %.4s is wrong", (const char *)chunk + 4);
}

/* A compressed text: zTXt, or iTXt with the flag behind its key that says so. */
static bool is_packed_text(const uint8_t *chunk) {
    const uint8_t *end = memchr(chunk + 8, '\0', read_big(chunk));
    return chunk_is(chunk, "zTXt") ||
           (chunk_is(chunk, "iTXt") && end && end + 1 < chunk + 8 + read_big(chunk) && end[1] != 0);
}

/* A few kilobytes can be gigabytes of text: of what is beyond the limit libpng is to know nothing. */
static void hide_long_text(uint8_t *chunk, size_t *packed) {
    if (!is_packed_text(chunk)) return;
    *packed += read_big(chunk);
    if (*packed > MAX_PACKED_TEXT) memcpy(chunk + 4, "xtXt", 4); /* one that nobody knows */
}

static void write_big(uint8_t *at, size_t number) {
    for (int i = 0; i < 4; i++) at[i] = (uint8_t)(number >> (24 - 8 * i));
}

/* Moves what an IDAT chunk has to the end of what those before it have. */
static void join_data(struct picture_data *data, uint8_t *file, size_t at) {
    const size_t size = read_big(file + at);
    if (!data->last) data->first = at;
    memmove(file + data->first + 8 + data->bytes, file + at + 8, size);
    data->bytes += size;
    data->last = at + size + CHUNK_FRAME;
}

static bool finish_data(struct monge_picture *picture, char reason[PICTURE_REASON_SIZE]) {
    if (!picture->data.last) return fail(reason, "it has no pixels");
    if (picture->data.bytes > PNG_UINT_31_MAX) return fail(reason, "it is too large");
    write_big(picture->file + picture->data.first, picture->data.bytes);
    return true;
}

static bool check_chunks(struct monge_picture *picture, char reason[PICTURE_REASON_SIZE]) {
    struct picture_data *data = &picture->data;
    size_t packed = 0;
    if (!has_signature(picture->file, picture->file_size))
        return fail(reason, picture->file_size ? "it is no PNG file" : "the file is empty");
    for (size_t at = SIGNATURE, next;; at = next) {
        uint8_t *chunk = picture->file + at;
        if (!check_chunk(chunk, picture->file_size - at, reason)) return false;
        hide_long_text(chunk, &packed);
        next = at + read_big(chunk) + CHUNK_FRAME;
        if (chunk_is(chunk, "IDAT")) {
            if (data->last && data->last != at)
                return fail(reason, "it is damaged: its pixels are in pieces");
            join_data(data, picture->file, at);
        } else if (chunk_is(chunk, "IEND")) {
            data->end = at;
            return finish_data(picture, reason);
        }
    }
}

/* ---- Reading by libpng, from memory ---- */

/* A stretch of bytes, and what follows. */
struct stretch {
    const uint8_t *at, *end;
};

/* Everything that libpng's longjmp must not lose lives here. */
struct reader {
    png_structp png;
    png_infop info;
    struct stretch *stretch, *last; /* what is to be read, in this order */
    char *reason;
};

static void on_error(png_structp png, png_const_charp text) {
    struct reader *r = png_get_error_ptr(png);
    fail(r->reason, "it is damaged: %s", text);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp text) { (void)png, (void)text; }

static void on_read(png_structp png, png_bytep bytes, size_t size) {
    struct reader *r = png_get_io_ptr(png);
    while (size > 0) {
        while (r->stretch < r->last && r->stretch->at == r->stretch->end) r->stretch++;
        if (r->stretch == r->last) png_error(png, "it ends too early");
        const size_t there = (size_t)(r->stretch->end - r->stretch->at), count = there < size ? there : size;
        memcpy(bytes, r->stretch->at, count);
        r->stretch->at += count;
        bytes += count;
        size -= count;
    }
}

/* Begins to read. The check sums are known to be right. */
static bool reader_begin(struct reader *r) {
    r->png = png_create_read_struct(PNG_LIBPNG_VER_STRING, r, on_error, on_warning);
    if (r->png) r->info = png_create_info_struct(r->png);
    if (!r->info) return fail(r->reason, "%s", strerror(ENOMEM));
    png_set_read_fn(r->png, r, on_read);
    png_set_user_limits(r->png, PNG_UINT_31_MAX, PNG_UINT_31_MAX); /* the pixels together have one */
    png_set_crc_action(r->png, PNG_CRC_QUIET_USE, PNG_CRC_QUIET_USE);
    png_set_chunk_malloc_max(r->png, MAX_CHUNK_MEMORY);
    png_set_chunk_cache_max(r->png, MAX_CHUNKS_KEPT);
    return true;
}

static void reader_end(struct reader *r) { png_destroy_read_struct(&r->png, &r->info, NULL); }

/* ---- The header ---- */

static void take_palette(struct monge_picture *picture, struct reader *r) {
    png_colorp colors = NULL;
    png_bytep alphas = NULL;
    int count = 0, alpha_count = 0;
    png_get_PLTE(r->png, r->info, &colors, &count);
    png_get_tRNS(r->png, r->info, &alphas, &alpha_count, NULL);
    for (int i = 0; i < 256; i++) {
        const png_color color = i < count ? colors[i] : (png_color){0, 0, 0}; /* as libpng has it */
        const uint8_t alpha = i < alpha_count ? alphas[i] : 255;
        memcpy(picture->palette[i], (uint8_t[4]){color.red, color.green, color.blue, alpha}, 4);
    }
}

/* Grey of at most 8 bits, as a palette: of 8 bits, and with alpha where a grey is transparent. */
static void take_greys(struct monge_picture *picture, unsigned bits, const png_color_16 *key) {
    const unsigned most = (1u << bits) - 1;
    for (unsigned i = 0; i <= most; i++) {
        const uint8_t alpha = key && (key->gray & most) == i ? 0 : 255; /* as libpng has it */
        memcpy(picture->palette[i], (uint8_t[2]){(uint8_t)(i * 255 / most), alpha}, 2);
    }
}

static void take_key(struct monge_picture *picture, const png_color_16 *key, bool colors) {
    const uint16_t numbers[3] = {colors ? key->red : key->gray, key->green, key->blue};
    uint8_t *to = picture->key;
    for (unsigned i = 0; i < 3; i++) {
        if (picture->bits == 16) *to++ = (uint8_t)(numbers[i] >> 8);
        *to++ = (uint8_t)numbers[i];
    }
}

/* How the pixels are in the file. */
static void take_form(struct monge_picture *picture, struct reader *r, int type, int bits) {
    png_color_16p key = NULL;
    png_get_tRNS(r->png, r->info, NULL, NULL, &key);
    picture->number_bits = (unsigned)bits;
    picture->interlaced = png_get_interlace_type(r->png, r->info) != PNG_INTERLACE_NONE;
    picture->indexed =
        type == PNG_COLOR_TYPE_PALETTE || (type == PNG_COLOR_TYPE_GRAY && (bits < 8 || (bits == 8 && key)));
    picture->keyed = key && !picture->indexed;
    if (type == PNG_COLOR_TYPE_PALETTE)
        take_palette(picture, r);
    else if (picture->indexed)
        take_greys(picture, (unsigned)bits, key);
    else if (key)
        take_key(picture, key, type & PNG_COLOR_MASK_COLOR);
}

static bool take_size(struct monge_picture *picture, struct reader *r) {
    const int type = png_get_color_type(r->png, r->info), bits = png_get_bit_depth(r->png, r->info);
    const bool keyed = png_get_valid(r->png, r->info, PNG_INFO_tRNS);
    const bool alpha = type & PNG_COLOR_MASK_ALPHA || keyed;
    picture->width = png_get_image_width(r->png, r->info);
    picture->height = png_get_image_height(r->png, r->info);
    picture->bits = bits == 16 ? 16 : 8;
    picture->channels = (type & PNG_COLOR_MASK_COLOR ? 3u : 1u) + alpha;
    take_form(picture, r, type, bits);
    if ((uint64_t)picture->width * picture->height <= MONGE_MAX_PIXELS) return true;
    return fail(r->reason, "it is too large: %u x %u pixels, of at most %d together", picture->width,
                picture->height, MONGE_MAX_PIXELS);
}

static bool take_profile(struct color_space *space, struct reader *r) {
    png_charp name;
    png_bytep profile;
    png_uint_32 size;
    int compression;
    if (!png_get_iCCP(r->png, r->info, &name, &compression, &profile, &size)) return true;
    space->kind = COLOR_PROFILE;
    space->profile_size = size;
    /* Many are called "ICC profile". */
    snprintf(space->name, sizeof space->name, "%s%.79s",
             strncasecmp(name, "icc profile", 11) == 0 ? "" : "ICC profile ", name);
    space->profile = malloc(size);
    if (!space->profile) return fail(r->reason, "%s", strerror(ENOMEM));
    memcpy(space->profile, profile, size);
    return true;
}

static bool take_primaries(int32_t xy[8], struct reader *r) {
    return png_get_cHRM_fixed(r->png, r->info, &xy[0], &xy[1], &xy[2], &xy[3], &xy[4], &xy[5], &xy[6],
                              &xy[7]);
}

/* What programs write beside an sRGB chunk, or for want of one: PNG specification, 11.3.2.5. */
static bool is_like_srgb(const struct color_space *space, bool has_primaries) {
    static const int32_t usual[8] = {31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000};
    bool like = abs(space->gamma - 45455) <= 50;
    for (int i = 0; has_primaries && i < 8; i++) like = like && abs(space->primaries[i] - usual[i]) <= 50;
    return like;
}

static void take_gamma(struct color_space *space) {
    space->kind = COLOR_GAMMA;
    snprintf(space->name, sizeof space->name, "gamma %.5g", space->gamma / 100000.0);
}

static bool take_space(struct color_space *space, struct reader *r) {
    int intent;
    snprintf(space->name, sizeof space->name, "sRGB");
    if (!png_get_sRGB(r->png, r->info, &intent) && png_get_gAMA_fixed(r->png, r->info, &space->gamma) &&
        space->gamma > 0) {
        if (is_like_srgb(space, take_primaries(space->primaries, r)))
            memset(space->primaries, 0, sizeof space->primaries);
        else
            take_gamma(space);
    }
    return take_profile(space, r);
}

static bool take_texts(struct monge_picture *picture, struct reader *r) {
    png_textp texts;
    const int count = png_get_text(r->png, r->info, &texts, NULL);
    if (count <= 0) return true;
    picture->texts = calloc((size_t)count, sizeof *picture->texts);
    for (int i = 0; picture->texts && i < count; i++) {
        const char *key = texts[i].key, *text = texts[i].text ? texts[i].text : "";
        struct picture_text *to = &picture->texts[i];
        to->key = malloc(strlen(key) + strlen(text) + 2);
        if (!to->key) break;
        to->text = stpcpy(to->key, key) + 1;
        strcpy(to->text, text);
        picture->text_count++;
    }
    return picture->text_count == (size_t)count || fail(r->reason, "%s", strerror(ENOMEM));
}

/* The texts behind the pixels: room for them, and how many there are. */
static size_t find_texts(const struct monge_picture *picture, struct stretch *found, size_t room) {
    size_t count = 0;
    for (size_t at = picture->data.last; at < picture->data.end && count < room;) {
        const uint8_t *chunk = picture->file + at;
        const size_t size = read_big(chunk) + (size_t)CHUNK_FRAME;
        if (chunk_is(chunk, "tEXt") || chunk_is(chunk, "zTXt") || chunk_is(chunk, "iTXt"))
            found[count++] = (struct stretch){chunk, chunk + size};
        at += size;
    }
    return count;
}

static bool read_header_by(struct reader *r, struct monge_picture *picture) {
    if (setjmp(png_jmpbuf(r->png))) return false;
    png_read_info(r->png, r->info); /* up to the length and type of the first IDAT */
    return take_size(picture, r) && take_space(&picture->space, r) && take_texts(picture, r);
}

/* Lets libpng read all chunks but those of the pixels: the texts that stand behind them go before. */
static bool read_header(struct monge_picture *picture, char reason[PICTURE_REASON_SIZE]) {
    const uint8_t *file = picture->file, *data = file + picture->data.first;
    struct stretch stretches[MAX_CHUNKS_KEPT + 2] = {{file, data}};
    const size_t texts = find_texts(picture, stretches + 1, MAX_CHUNKS_KEPT);
    stretches[1 + texts] = (struct stretch){data, data + 8};
    struct reader r = {.stretch = stretches, .last = stretches + texts + 2, .reason = reason};
    const bool good = reader_begin(&r) && read_header_by(&r, picture);
    reader_end(&r);
    return good;
}

bool picture_open(struct monge_picture *picture, const char *path, char reason[PICTURE_REASON_SIZE],
                  bool *system) {
    picture->name = strdup(path);
    *system = !picture->name || !read_file(picture, path, reason);
    if (!picture->name) return fail(reason, "%s", strerror(ENOMEM));
    return !*system && check_chunks(picture, reason) && read_header(picture, reason);
}

void picture_close(struct monge_picture *picture) {
    for (size_t i = 0; i < picture->text_count; i++) free(picture->texts[i].key);
    free(picture->texts);
    free(picture->space.profile);
    free(picture->filtered);
    free(picture->memory);
    free(picture->file);
    free(picture->name);
}

/* ---- Pixels, by libpng ---- */

static bool read_rows(struct reader *r, struct monge_picture *picture) {
    if (setjmp(png_jmpbuf(r->png))) return false;
    png_read_info(r->png, r->info);
    png_set_expand(r->png);
    const int passes = png_set_interlace_handling(r->png);
    png_read_update_info(r->png, r->info);
    if (png_get_rowbytes(r->png, r->info) != picture->stride)
        png_error(r->png, "its rows are of another size");
    for (int pass = 0; pass < passes; pass++)
        for (uint32_t y = 0; y < picture->height; y++)
            png_read_row(r->png, picture->rows + y * picture->stride, NULL);
    png_read_end(r->png, NULL);
    return true;
}

/* Whether the data can be of that many pixels, of a bit at least: before memory is taken for them. */
static bool has_data(const struct monge_picture *picture) {
    return (uint64_t)picture->width * picture->height / 8 / DEFLATE_MAX_RATIO <= picture->data.bytes;
}

static bool decode_by_libpng(struct monge_picture *picture, char reason[PICTURE_REASON_SIZE]) {
    static const uint8_t any_sum[4];
    const uint8_t *file = picture->file;
    const struct picture_data *data = &picture->data;
    struct stretch stretches[] = {{file, file + data->first + 8 + data->bytes},
                                  {any_sum, any_sum + sizeof any_sum},
                                  {file + data->last, file + picture->file_size}};
    struct reader r = {.stretch = stretches, .last = stretches + 3, .reason = reason};
    picture->stride = picture->width * picture_pixel_size(picture);
    picture->rows = picture->memory = calloc(picture->height, picture->stride);
    if (!picture->memory) return fail(reason, "%s", strerror(ENOMEM));
    const bool good = reader_begin(&r) && read_rows(&r, picture);
    reader_end(&r);
    if (good) return true;
    free(picture->memory);
    picture->memory = NULL;
    return false;
}

bool picture_inflate(struct monge_picture *picture, char reason[PICTURE_REASON_SIZE]) {
    if (picture->memory) return true;
    if (!has_data(picture)) return fail(reason, "it is damaged: it has too few pixels");
    picture_inflate_plain(picture);
    return picture->memory || decode_by_libpng(picture, reason);
}

bool picture_decode(struct monge_picture *picture, char reason[PICTURE_REASON_SIZE]) {
    if (!picture_inflate(picture, reason)) return false;
    return picture_undo(picture, NULL) || fail(reason, "%s", strerror(ENOMEM));
}
