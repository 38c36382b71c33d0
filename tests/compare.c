/* compare WANT.png GOT.png [X Y]: are the pixels of GOT those of WANT? X Y: GOT is the part of WANT whose
 * top left corner is there. Compares the numbers in the files as they are, without regard to gamma.
 * Prints what differs. Exit 0: the same, 1: they differ, 2: trouble. */
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct picture {
    png_uint_32 width, height;
    int bits, color_type;
    size_t channels;
    png_bytepp rows; /* 16-bit numbers: high byte first */
};

static void read_picture(const char *path, struct picture *out) {
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    FILE *file = fopen(path, "rb");
    if (!file) {
        perror(path);
        exit(2);
    }
    if (setjmp(png_jmpbuf(png))) exit(2); /* libpng has said why */
    png_init_io(png, file);
    png_read_png(png, info, PNG_TRANSFORM_IDENTITY, NULL);
    *out = (struct picture){png_get_image_width(png, info), png_get_image_height(png, info), png_get_bit_depth(png, info),
                            png_get_color_type(png, info),  png_get_channels(png, info),     png_get_rows(png, info)};
    fclose(file);
}

static int number(const struct picture *p, size_t x, size_t y, size_t channel) {
    const png_byte *at = p->rows[y] + (x * p->channels + channel) * (size_t)(p->bits / 8);
    return p->bits == 16 ? at[0] << 8 | at[1] : at[0];
}

int main(int argc, char **argv) {
    struct picture want, got;
    if (argc != 3 && argc != 5) {
        fprintf(stderr, "usage: compare WANT.png GOT.png [X Y]\n");
        return 2;
    }
    const size_t left = argc == 5 ? strtoul(argv[3], NULL, 10) : 0, top = argc == 5 ? strtoul(argv[4], NULL, 10) : 0;
    read_picture(argv[1], &want);
    read_picture(argv[2], &got);
    if (want.bits < 8 || want.bits != got.bits || want.color_type != got.color_type) {
        printf("%d bits of type %d instead of %d of type %d\n", got.bits, got.color_type, want.bits, want.color_type);
        return 1;
    }
    if (argc == 3 ? want.width != got.width || want.height != got.height
                  : left + got.width > want.width || top + got.height > want.height) {
        printf("%ux%u pixels instead of %ux%u\n", (unsigned)got.width, (unsigned)got.height, (unsigned)want.width,
               (unsigned)want.height);
        return 1;
    }
    unsigned long differ = 0;
    int largest = 0;
    for (size_t y = 0; y < got.height; y++)
        for (size_t x = 0; x < got.width; x++) {
            int worst = 0;
            for (size_t c = 0; c < got.channels; c++) {
                const int difference = abs(number(&want, left + x, top + y, c) - number(&got, x, y, c));
                if (difference > worst) worst = difference;
            }
            differ += worst > 0;
            if (worst > largest) largest = worst;
        }
    if (!differ) return 0;
    printf("%lu of %lu pixels differ, by up to %d\n", differ, (unsigned long)got.width * got.height, largest);
    return 1;
}
