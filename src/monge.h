/* Monge: from a scene file to a picture. This is the whole public interface; the command line uses
 * nothing behind it.
 *
 *     struct monge_diagnostics *diag = monge_diagnostics_new();
 *     struct monge_scene *scene = monge_load_file("king.yaml", NULL, diag);
 *     if (scene) {
 *         struct monge_settings settings = monge_scene_settings(scene);
 *         struct monge_film *film = monge_render(scene, &settings, NULL, NULL, NULL);
 *         if (film) monge_film_write_png(film, "king.png", diag);
 *         monge_film_free(film);
 *     }
 *     monge_diagnostics_print(diag, stderr);
 *     monge_scene_free(scene);
 *     monge_diagnostics_free(diag);
 *
 * Nothing here exits, prints unasked, or keeps global state; different scenes may be used from
 * different threads at once. Every *_free takes NULL. */
#ifndef MONGE_H
#define MONGE_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

const char *monge_version(void); /* "1.2.3", static */

enum { MONGE_HASH_SIZE = 33 }; /* 32 hexadecimal digits and the final zero */

/* A hash of the sources that the program was built from; static. Equal ones make equal pictures. */
const char *monge_program(void);

/* ---- The scene language ---- */

/* The JSON Schema (draft-07) of scene files, by which editors complete and check them; static. */
const char *monge_schema(void);

/* A short scene to begin with, as YAML; static. */
const char *monge_example(void);

/* Prints the manual of a word of the language: a kind of mapping ("material"), a key of any of them
 * ("radius"), a function or a constant of expressions ("sin"), or "language" for all kinds, "functions",
 * "presets". False, printing nothing, when there is no such word. */
bool monge_help(const char *word, FILE *out);

/* The word for monge_help that was probably meant; static. NULL: none is near. */
const char *monge_help_nearest(const char *word);

/* The kinds of mappings by their number, from 0; static. NULL after the last. */
const char *monge_kind(size_t index);

/* ---- Diagnostics: what is wrong with a scene or a file, with its place ---- */

struct monge_diagnostics;

struct monge_diagnostics *monge_diagnostics_new(void); /* NULL: no memory */
void monge_diagnostics_free(struct monge_diagnostics *diag);
unsigned monge_diagnostics_errors(const struct monge_diagnostics *diag);   /* in scenes, so far */
unsigned monge_diagnostics_warnings(const struct monge_diagnostics *diag); /* in scenes, so far */
unsigned
monge_diagnostics_failures(const struct monge_diagnostics *diag); /* of the system, so far: files, memory */

/* For a program that has more to tell: a failure, or a warning without a place. code is one of monge_code's. */
void monge_diagnostics_fail(struct monge_diagnostics *diag, const char *code, const char *message);
void monge_diagnostics_warn(struct monge_diagnostics *diag, const char *code, const char *message);

/* Adds what `from` has, which stays as it is; again: of the scene that was added last, told again, which is kept once. */
void monge_diagnostics_append(struct monge_diagnostics *diag, const struct monge_diagnostics *from,
                              bool again);

/* The first error or failure, by place, of those told since the last call. False: there is none. The texts live as
 * long as diag; file is NULL where there is no place. */
struct monge_problem {
    const char *code, *message, *file;
    unsigned line, column; /* from 1 */
};
bool monge_diagnostics_take(struct monge_diagnostics *diag, struct monge_problem *first);

/* All so far as text for people, `file:line:col: error[code]: ...` and the line with a caret; by place. */
void monge_diagnostics_print(const struct monge_diagnostics *diag, FILE *out);

/* Those that this has not printed yet: for scenes with many frames, of which each tells the same. */
void monge_diagnostics_print_new(struct monge_diagnostics *diag, FILE *out);

/* All so far as a document, for people (as monge_diagnostics_print has it) or for programs: a JSON array of
 * objects, or SARIF 2.1.0. README.md has their members. */
enum monge_format { MONGE_FORMAT_TEXT, MONGE_FORMAT_JSON, MONGE_FORMAT_SARIF };
void monge_diagnostics_write(const struct monge_diagnostics *diag, enum monge_format format, FILE *out);

/* The codes of diagnostics, sorted, from 0: NULL past the last. Static, as is what one means in a sentence. */
const char *monge_code(size_t index);
const char *monge_code_summary(size_t index);

/* Prints what a code means, why it matters and how to mend it, with an example. False, with nothing printed, where
 * there is no such code. */
bool monge_explain(const char *code, FILE *out);

/* A text as a JSON string, in quotes; what is no UTF-8 in it becomes U+FFFD. */
void monge_write_json_string(const char *text, FILE *out);

/* The words of a text in lines of 80 columns, from `column` on, where the cursor is; further lines begin at `indent`. Ends
 * the last one. */
void monge_write_wrapped(const char *text, int column, int indent, FILE *out);

/* ---- Scenes ---- */

/* What one load may use. Past a limit the load ends with an error that names it. 0: the default. */
struct monge_limits {
    size_t file_bytes;   /* of one file: 1 GiB */
    size_t memory_bytes; /* of one load: 8 GiB */
    size_t values;       /* values read from one file, aliases expanded: 100,000,000 */
    size_t nesting;      /* lists and mappings within each other: 100 */
    size_t recursion;    /* templates in use within each other: 100; at most 1000 */
    size_t steps;        /* objects of templates and loops, placed or not: 10,000,000 */
    size_t objects;      /* shapes: 20,000,000, those of a template placed many times once */
};

/* A parameter of the scene and its value, as a scene writes it: "3", "[0, 1, 0]", "gold". */
struct monge_define {
    const char *name, *value;
};

/* How to read a scene. Zeroed: in no special way. */
struct monge_load_options {
    struct monge_limits limits;
    const struct monge_define *defines;
    size_t define_count;
    unsigned frame; /* of an animation, from 1; 0: the first */
    bool untrusted; /* the scene reads files in its own folder alone */
    bool outline;   /* for monge_scene_info to have the tree of the scene: takes more time */
    bool
        again; /* the scene that diag was last told of, with other defines: what is told again is kept once */
};

struct monge_scene;

/* Reads a scene; "-" is standard input. options may be NULL. NULL when the scene is wrong or cannot
 * be read: diag says why, monge_diagnostics_failures which of the two. The caller frees the scene. */
struct monge_scene *monge_load_file(const char *path, const struct monge_load_options *options,
                                    struct monge_diagnostics *diag);

/* The same from memory: `size` bytes of UTF-8 YAML, free to go when this returns; `name` stands for
 * the file in messages, and what the scene includes is found from it. */
struct monge_scene *monge_load_memory(const char *name, const char *text, size_t size,
                                      const struct monge_load_options *options,
                                      struct monge_diagnostics *diag);

/* The frames of the scene's animation; 0: it has none. */
unsigned monge_scene_frames(const struct monge_scene *scene);

/* Moves the scene to a frame of its animation, 1 .. monge_scene_frames(scene): from then on it is as if it had been
 * loaded so. No file is read again. Where no object, material, template or parameter depends on the frame, only
 * settings, camera and lights are evaluated; else all is, and the acceleration structure is kept where the
 * objects are still the same. False, the scene being as it was, when it is wrong at that frame or there is
 * no memory: diag says why; what it has been told of the scene before is kept once. */
bool monge_scene_set_frame(struct monge_scene *scene, unsigned frame, struct monge_diagnostics *diag);

void monge_scene_free(struct monge_scene *scene);

/* The hash of the files that a scene is read from: the one in `path`, and `files`, those that it includes, relative to
 * its folder, one a line. Equal to that of a picture (its text chunks monge:text and monge:files) where none has
 * changed since. False, a failure in diag, where one cannot be read. limits may be NULL. */
bool monge_files_hash(const char *path, const char *files, const struct monge_limits *limits,
                      struct monge_diagnostics *diag, char hash[MONGE_HASH_SIZE]);

/* The same of a scene that is loaded, as it was when it was read. */
void monge_scene_text_hash(const struct monge_scene *scene, char hash[MONGE_HASH_SIZE]);

/* How many primitives the scene has become. */
size_t monge_scene_primitives(const struct monge_scene *scene);

/* Builds the acceleration structure, which monge_render does itself where it has not been done.
 * False when there is no memory for it. */
bool monge_scene_prepare(struct monge_scene *scene);

/* Looks for what would render wrong, without rendering: nothing in view, the camera inside of a solid, objects and
 * lights without effect. Each is a warning in diag. Prepares the scene; where there is no memory for that, nothing. */
void monge_scene_examine(struct monge_scene *scene, struct monge_diagnostics *diag);

/* Tells what the scene has become: counts, bounds, the camera as it is framed, materials, what each template
 * costs, and the tree where the load has kept its outline. As text, or as one JSON object (README.md has its members).
 * Prepares the scene; false, with nothing told, when there is no memory for that. */
bool monge_scene_info(struct monge_scene *scene, enum monge_format format, FILE *out);

/* ---- Scenes of others ---- */

/* Writes the scene in `path`, in the YAML format of "The Ray Tracer Challenge", to `out_path` in our
 * language; "-" is standard input and output. A regular file appears complete under its name or not
 * at all, and nothing is written when the scene is wrong. What the language cannot say is in diag as
 * warnings. limits may be NULL. False: diag says why, monge_diagnostics_failures which of the two. */
bool monge_import(const char *path, const char *out_path, const struct monge_limits *limits,
                  struct monge_diagnostics *diag);

/* ---- Formatting: the text of a scene in the canonical style ---- */

/* Bytes that the caller frees with monge_text_free, and only where a function says that it made them. */
struct monge_text {
    char *bytes; /* with a final zero after `size` bytes */
    size_t size;
};
void monge_text_free(struct monge_text *text);

/* Reads all bytes of a file; "-" is standard input. False, a failure in diag, when it cannot be read. */
bool monge_text_read(const char *path, const struct monge_limits *limits, struct monge_text *text,
                     struct monge_diagnostics *diag);

/* What a text is by the keys at its top. */
enum monge_text_kind {
    MONGE_TEXT_SCENE, /* it has `scene`, or a key of a scene beside one that is none, or nearly `scene`; or it is not
                         YAML: so that what is wrong with it will be told */
    MONGE_TEXT_DEFINITIONS, /* it has no `scene`, and all of its keys may be in a file that scenes include */
    MONGE_TEXT_OTHER,       /* it has no key of a scene, */
    MONGE_TEXT_EMPTY,       /* as it has nothing but comments */
};
enum monge_text_kind monge_text_kind(const struct monge_text *text, const struct monge_limits *limits);

/* Writes a file, which appears complete under its name or stays as it was, with its permissions; symbolic
 * links are followed; "-" is standard output. False, a failure in diag, when it cannot be written. */
bool monge_text_write(const char *path, const struct monge_text *text, struct monge_diagnostics *diag);

/* Lays a scene out in the canonical style: the same values, the same comments in the same order. The
 * scene must be YAML, but may be wrong otherwise. To format the result changes nothing. False, with the
 * reason in diag, when it is not YAML. *formatted is made by the function, for the caller to free. */
bool monge_format(const char *name, const struct monge_text *text, const struct monge_limits *limits,
                  struct monge_text *formatted, struct monge_diagnostics *diag);

/* ---- Documents: YAML or JSON as it stands, without a meaning ---- */

struct monge_document;
struct monge_value; /* of a document, and as long as it */

/* Reads a file of one document. NULL when it cannot be read or is no YAML: diag says why. limits may be NULL. */
struct monge_document *monge_document_read(const char *path, const struct monge_limits *limits,
                                           struct monge_diagnostics *diag);
void monge_document_free(struct monge_document *document);
const struct monge_value *monge_document_root(const struct monge_document *document);

/* The value of a key; NULL: there is none, or `mapping` is NULL or no mapping. */
const struct monge_value *monge_value_get(const struct monge_value *mapping, const char *key);

/* The items of a list: NULL at its end, of an empty one, and of what is NULL or no list. */
const struct monge_value *monge_value_first(const struct monge_value *list);
const struct monge_value *monge_value_next(const struct monge_value *item);

/* What a scalar says; NULL of any other value, of NULL and of null. */
const char *monge_value_text(const struct monge_value *value);

/* ---- Settings: what an author writes in the file and a user may override ---- */

enum monge_shading {
    MONGE_SHADING_PHONG,     /* ambient, diffuse and specular, reflection and refraction */
    MONGE_SHADING_DIFFUSE,   /* ambient and diffuse alone */
    MONGE_SHADING_SIGNATURE, /* each object in its flat diffuse colour, unlit */
};
enum monge_encoding { MONGE_ENCODING_SRGB, MONGE_ENCODING_LINEAR };

enum {
    MONGE_MAX_SIDE = 65535,
    MONGE_MAX_PIXELS = 1 << 28, /* of a picture: 3 GiB of film */
    MONGE_MAX_SAMPLES = 65536,
    MONGE_MAX_DEPTH = 64
};

struct monge_settings {
    uint32_t width, height; /* pixels, 1 .. MONGE_MAX_SIDE each, MONGE_MAX_PIXELS together */
    uint32_t samples;       /* a pixel, 1 .. MONGE_MAX_SAMPLES */
    unsigned bits;          /* of a channel in the file, 8 or 16 */
    enum monge_encoding encoding;
    enum monge_shading shading;
    unsigned depth; /* of rays, 1 (camera rays alone) .. MONGE_MAX_DEPTH */
    double shadow;  /* the part of a light that reaches a shadow, 0 (physical) .. 1 (no shadows) */
};

struct monge_settings monge_scene_settings(const struct monge_scene *scene); /* as the file has them */

/* NULL if every setting is within its range, else which is not, for people; static. */
const char *monge_settings_check(const struct monge_settings *settings);

/* ---- Golden pictures: how scenes are tested ---- */

enum monge_golden_kind { MONGE_GOLDEN_PNG, MONGE_GOLDEN_HASH, MONGE_GOLDEN_BOTH };

/* How far a picture may be from its golden one: all that is stated must hold. */
struct monge_tolerance {
    double max;    /* of a channel, 0 .. 1; 0 where only `pixels` is stated; NaN: neither is */
    double pixels; /* that may be farther than max; or, where percent, so many of a hundred */
    bool percent;
    double mae, rmse, flip; /* at most; NaN: not stated */
    double psnr, ssim;      /* at least; NaN: not stated */
    const char *reason;
};

struct monge_golden_rule {
    const char *const *scenes; /* names or patterns of names, up to a NULL; at least one */
    const char *options;       /* as monge render takes them; "": none */
    enum monge_golden_kind kind;
    bool aov;
    const struct monge_tolerance *tolerance; /* NULL: what the scene says */
    unsigned line;                           /* of the rule, from 1 */
};

/* The file golden.yaml. grammar/reference.md has its keys. */
struct monge_goldens {
    const char *root;            /* as it is written, from the folder of the file; NULL: not given */
    enum monge_golden_kind kind; /* where no rule matches */
    const struct monge_golden_rule *rules;
    size_t count;
};

/* NULL when it is wrong or cannot be read: diag says why, monge_diagnostics_failures which of the two. The caller
 * frees it. limits may be NULL. */
struct monge_goldens *monge_goldens_read(const char *path, const struct monge_limits *limits,
                                         struct monge_diagnostics *diag);
void monge_goldens_free(struct monge_goldens *goldens);

/* What the scene says itself; NULL: nothing. As long as the scene. */
const struct monge_tolerance *monge_scene_tolerance(const struct monge_scene *scene);

/* ---- Rendering ---- */

/* Pixels of the whole picture, from its top left corner. */
struct monge_region {
    uint32_t x, y, width, height;
};

enum monge_ray {
    MONGE_RAY_CAMERA,
    MONGE_RAY_SHADOW,
    MONGE_RAY_REFLECTION,
    MONGE_RAY_REFRACTION,
    MONGE_RAY_KINDS
};

unsigned monge_processors(void); /* that this process may run on; at least 1 */

/* For pictures that take long: keeps the tiles that have been rendered, to give them back when the same picture is
 * rendered again. known and done are called from any threads at once. `tile` is in pixels of the whole picture; its pixels are
 * at `rgb`, three floats each, `stride` floats from row to row, as monge_film_pixels has them. */
struct monge_tiles {
    void *context;
    /* Puts the pixels of a tile to `rgb` and returns true, or leaves it to be rendered. */
    bool (*known)(void *context, const struct monge_region *tile, float *rgb, size_t stride);
    /* A tile has been rendered. rgb stays as it is until monge_render returns. */
    void (*done)(void *context, const struct monge_region *tile, const float *rgb, size_t stride);
    /* The rendering ends early: this is the last look at what was done. */
    void (*stopped)(void *context);
};

/* How to render: nothing in it changes a pixel. */
struct monge_job {
    unsigned threads; /* 0: one for each processor */
    void (*progress)(void *context, uint64_t done,
                     uint64_t total); /* pixels; from any one thread at a time; may be NULL */
    void *context;
    const atomic_bool *cancel;      /* set it to stop early: it takes less than a second; may be NULL */
    struct monge_diagnostics *diag; /* what is wrong with the scene when it cannot be rendered; may be NULL */
    const struct monge_tiles *tiles; /* may be NULL */
    const char *options; /* what is not as the scene has it, as text for the picture's file; may be NULL */
};

struct monge_stats {
    double build_seconds, render_seconds; /* build: 0 where it had been done before */
    uint64_t rays[MONGE_RAY_KINDS];
    unsigned threads;
};

/* The picture of linear colour that rendering makes. */
struct monge_film;

/* Renders `region` (NULL: the whole picture) with settings that monge_settings_check accepts. job
 * and stats may be NULL. NULL when cancelled, out of memory, the region is empty or not inside the picture,
 * or the scene is too much for a ray: that alone is an error in job->diag. The caller frees the film. The same bits for every number of threads and every way
 * to cut a picture into regions. */
struct monge_film *monge_render(struct monge_scene *scene, const struct monge_settings *settings,
                                const struct monge_region *region, const struct monge_job *job,
                                struct monge_stats *stats);

/* The hash of the scene, as it was evaluated, and of the settings: of all that can change a pixel. Equal to that of
 * the film that is rendered of them, monge_film_scene_hash. */
void monge_scene_hash(const struct monge_scene *scene, const struct monge_settings *settings,
                      char hash[MONGE_HASH_SIZE]);

void monge_film_free(struct monge_film *film);
struct monge_region monge_film_region(const struct monge_film *film);

/* Linear red, green, blue of each pixel, row by row from the top left; width * height * 3 floats,
 * >= 0, not clamped. Valid as long as the film. */
const float *monge_film_pixels(const struct monge_film *film);

/* The hash of the pixels that monge_film_write_png would write. False: no memory. */
bool monge_film_hash(const struct monge_film *film, char hash[MONGE_HASH_SIZE]);

/* The hash of the scene, as it was evaluated, and of the settings: of all that can change a pixel. */
void monge_film_scene_hash(const struct monge_film *film, char hash[MONGE_HASH_SIZE]);

/* Notes the passes that are in files beside the film's picture, for its text chunk monge:passes: of each a line with its
 * name and the hash of its file, as monge_files_hash has it. False: no memory. */
bool monge_film_note_passes(struct monge_film *film, const char *passes);

/* Writes the film as PNG, with the bits and the encoding of the settings it was rendered with, and
 * what it was made from in text chunks (README.md has them). path "-" is standard output. A regular file appears complete under
 * its name or not at all. False when it cannot: diag says why, as a failure. */
bool monge_film_write_png(const struct monge_film *film, const char *path, struct monge_diagnostics *diag);

/* ---- Pictures: PNG files, and how they differ ---- */

/* A PNG file in memory. Its pixels are decoded when they are first needed; until then it costs its file's bytes. */
struct monge_picture;

/* Reads a PNG file, "-" being standard input, and checks its chunks: their order and check sums, its header, its
 * colour space, its texts. NULL: diag says why, as a failure. The caller frees the picture. */
struct monge_picture *monge_picture_read(const char *path, struct monge_diagnostics *diag);

/* The same of two files at once; at most one is standard input. False: at least one is NULL. The caller frees both. */
bool monge_picture_read_pair(const char *path_a, const char *path_b, struct monge_picture **a,
                             struct monge_picture **b, struct monge_diagnostics *diag);
void monge_picture_free(struct monge_picture *picture);

uint32_t monge_picture_width(const struct monge_picture *picture);
uint32_t monge_picture_height(const struct monge_picture *picture);

/* As its pixels are decoded: 8 or 16 bits a channel, fewer becoming 8; 1 channel is grey, 2 grey with alpha, 3 red,
 * green, blue, 4 those with alpha. A palette is looked up, and a transparent colour becomes alpha. */
unsigned monge_picture_bits(const struct monge_picture *picture);
unsigned monge_picture_channels(const struct monge_picture *picture);

/* "sRGB", which one that says nothing counts as; "gamma 1"; "ICC profile NAME". As long as the picture. */
const char *monge_picture_color_space(const struct monge_picture *picture);

/* The text of the first text chunk of that key, as long as the picture; NULL: there is none. */
const char *monge_picture_text(const struct monge_picture *picture, const char *key);

/* Decodes the pixels, where that has not been done. False: diag says why, as a failure. Not from two threads at once. */
bool monge_picture_decode(struct monge_picture *picture, struct monge_diagnostics *diag);

/* The hash of its pixels, as monge_film_hash has it and the text chunk monge:pixels: equal where the file is as it was
 * written. Decodes them. False when the file is damaged: diag says why; or is of another kind than is written here. */
bool monge_picture_hash(struct monge_picture *picture, struct monge_diagnostics *diag,
                        char hash[MONGE_HASH_SIZE]);

/* A row of a picture that has been decoded: width * channels numbers of bits / 8 bytes, the high byte first. */
const uint8_t *monge_picture_row(const struct monge_picture *picture, uint32_t y);

enum monge_metric {
    MONGE_METRIC_EXACT, /* the part of the pixels that are not the same */
    MONGE_METRIC_MAX,   /* the largest difference of a channel */
    MONGE_METRIC_MAE,   /* the mean of the differences of channels */
    MONGE_METRIC_RMSE,  /* the root of the mean of their squares */
    MONGE_METRIC_PSNR,  /* -20 log10 of that, in decibels; infinite for equal ones */
    MONGE_METRIC_SSIM,  /* structural similarity of luma, 1 for equal ones: Wang et al. 2004 */
    MONGE_METRIC_FLIP,  /* what an eye sees when they alternate, 0 .. 1: Andersson et al. 2020 */
    MONGE_METRICS
};

/* SSIM and FLIP are of what is seen: pictures with alpha are looked at over black and over white. FLIP's error of a pixel
 * is then the larger one, SSIM the smaller one. The others compare alpha as a channel, and colours that it hides. */

/* How to compare. Zeroed: exactly, with the first four metrics and PSNR, which cost nothing. */
struct monge_compare {
    unsigned metrics;                  /* 1 << MONGE_METRIC_SSIM, 1 << MONGE_METRIC_FLIP: those as well */
    double max_delta;                  /* a pixel whose channels differ by no more is not `beyond`; 0 .. 1 */
    double ppd;                        /* FLIP: pixels per degree of sight; 0: MONGE_DEFAULT_PPD */
    const struct monge_region *ignore; /* pixels that are left out; may reach over the picture's edge */
    size_t ignore_count;
    struct monge_picture *mask; /* left out too: what is neither black nor transparent in it; NULL: none */
    unsigned threads;           /* 0: one for each processor */
};
#define MONGE_DEFAULT_PPD 67.0

enum monge_unlike { MONGE_UNLIKE_NOTHING, MONGE_UNLIKE_SIZE, MONGE_UNLIKE_COLOR_SPACE, MONGE_UNLIKE_BITS };

/* Differences are on the scale 0 .. 1 of the numbers in the files, whatever their bits and their encoding. A picture
 * without alpha is opaque, and grey is equal red, green and blue: neither is a difference. */
struct monge_difference {
    bool same;                /* in every respect: size, colour space, bits, pixels that are not ignored */
    enum monge_unlike unlike; /* the first of these that is not the same */
    /* Below: NaN and 0 where pixels cannot be compared, their size or colour space not being the same. */
    uint64_t pixels;    /* that are compared: all that are not ignored */
    uint64_t different; /* of these, not the same */
    uint64_t beyond;    /* of these, with a channel that differs by more than max_delta */
    double max, mae, rmse, psnr;
    double ssim, flip;          /* NaN where they are not asked for */
    struct monge_region bounds; /* of the pixels that are not the same; empty when there are none */
    uint32_t max_x, max_y;      /* the first pixel with the largest difference */
};

/* Compares b with a. The same numbers for every number of threads. False when a file turns out to be damaged, or the
 * mask to be of another size: diag says why, as a failure. Files with the same bytes are not decoded. */
bool monge_compare(struct monge_picture *a, struct monge_picture *b, const struct monge_compare *how,
                   struct monge_difference *out, struct monge_diagnostics *diag);

/* Writes a picture of where they differ, of their size: a in dim grey, and what differs in colours from violet by
 * orange to pale yellow, after the largest difference of a channel, or FLIP's error where how->metrics has it. A
 * file appears complete under its name or not at all; "-" is standard output. False: diag says why. */
bool monge_heat_map_write(struct monge_picture *a, struct monge_picture *b, const struct monge_compare *how,
                          const char *path, struct monge_diagnostics *diag);

/* ---- Layers: auxiliary passes, what a picture shows rather than how it looks ---- */

/* Each tells of a pixel what the ray through its centre meets first, whatever the picture's samples are. */
enum monge_layer {
    MONGE_LAYER_OBJECT,   /* the number of the object, 0: the background */
    MONGE_LAYER_MATERIAL, /* the number of its material, 0: the background */
    MONGE_LAYER_DEPTH,    /* how far in front of the eye, along the direction of view; background: infinity */
    MONGE_LAYER_NORMAL,   /* world space, unit, on the side that is shaded */
    MONGE_LAYER_SHADOW,   /* which point lights reach it */
    MONGE_LAYERS
};
enum { MONGE_LAYERS_ALL = (1 << MONGE_LAYERS) - 1 }; /* of sets of layers, a bit 1 << layer for each */

const char *monge_layer_name(enum monge_layer layer); /* "object", as in king.object.png; static */

/* Some layers of one picture. */
struct monge_layers;

/* What a number of the layers object and material stands for. An object is the innermost with a name of those in
 * the scene's own list and its groups; else the innermost with a name within templates; else the shape or the use
 * of a template that the list has. What a loop places is one object. */
struct monge_entry {
    uint32_t id;           /* from 1; the same for every region of a picture */
    const char *name;      /* NULL: it has none */
    const char *kind;      /* "sphere", "group", "use of leg", "material" */
    const char *file;      /* NULL: the default material, which is in no file */
    uint32_t line, column; /* from 1 */
    const char *hash;      /* of what a material is; NULL: not known, or no material */
};

/* Renders the layers of the set `wanted` as monge_render does the picture. NULL when cancelled, out of memory, or
 * settings or region are not right. The caller frees them. The same for every number of threads. */
struct monge_layers *monge_render_layers(struct monge_scene *scene, const struct monge_settings *settings,
                                         const struct monge_region *region, unsigned wanted,
                                         const struct monge_job *job);
void monge_layers_free(struct monge_layers *layers);

unsigned monge_layers_set(const struct monge_layers *layers);               /* which there are */
struct monge_region monge_layers_region(const struct monge_layers *layers); /* that they are of */

/* The pixels, row by row from the top left; NULL where the layer is not there. Valid as long as the layers.
 *   ids      object or material
 *   depth    in world units; 0 or more, infinite in the background
 *   normals  x, y, z of each pixel, -1 .. 1 as 0 .. 65535; 0, 0, 0 in the background
 *   lights   a bit 1 << i for each point light that reaches the surface from the side that is seen: light i of
 *            the scene, ambient ones left out, of the first MONGE_LAYER_LIGHTS. What is clear lets light pass. */
enum { MONGE_LAYER_LIGHTS = 48 };
const uint32_t *monge_layers_ids(const struct monge_layers *layers, enum monge_layer layer);
const float *monge_layers_depth(const struct monge_layers *layers);
const uint16_t *monge_layers_normals(const struct monge_layers *layers);
const uint64_t *monge_layers_lights(const struct monge_layers *layers);

/* What an id of object or material stands for; NULL: nothing that is in the picture. */
const struct monge_entry *monge_layers_entry(const struct monge_layers *layers, enum monge_layer layer,
                                             uint32_t id);

/* The file of a layer beside its picture, "king.depth.pfm" of "king.png": as snprintf, with its result. */
size_t monge_layer_path(enum monge_layer layer, const char *picture, char *path, size_t size);

/* Writes one layer that is there. PNG of 16 bits, of one channel or where that is not enough of three, the lowest
 * 16 bits in red, then green and blue; objects and materials with their entries as JSON in the text chunk
 * monge:table, objects with the camera in monge:camera, lights in monge:lights, settings in monge:settings and the hash of
 * the depth, where that is there, in monge:depth. Depth is a PFM. A file is complete or absent. False: diag says why,
 * as a failure. */
bool monge_layer_write(const struct monge_layers *layers, enum monge_layer layer, const char *path,
                       struct monge_diagnostics *diag);

/* Reads those layers of `wanted` again that are beside the picture. NULL when none of them is there, which is no
 * failure, or when one cannot be read, does not fit the others, or is a depth of which the file of the objects, wanted
 * or not, has another hash: then diag has a failure. */
struct monge_layers *monge_layers_read(const char *picture, unsigned wanted, struct monge_diagnostics *diag);

/* A hash of one of the layers depth, normal and shadow, of what each pixel has: equal ones show the same. False: it is
 * another layer, or not there. */
bool monge_layer_hash(const struct monge_layers *layers, enum monge_layer layer, char hash[MONGE_HASH_SIZE]);

/* ---- What changed between two pictures of a scene ---- */

enum monge_change_kind {
    MONGE_CHANGE_GEOMETRY,    /* it has moved or another shape */
    MONGE_CHANGE_APPEARED,    /* nothing of it was seen before */
    MONGE_CHANGE_DISAPPEARED, /* nothing of it is seen any more */
    MONGE_CHANGE_MATERIAL,    /* geometry equal, another material; of an older file: of another name */
    MONGE_CHANGE_SHADOW,      /* geometry equal, other lights reach it */
    MONGE_CHANGE_SHADING, /* geometry equal, and no other reason: what it mirrors, or of older files all else */
    MONGE_CHANGE_CAMERA,      /* the camera stands elsewhere */
    MONGE_CHANGE_VIEW,        /* it stands as before: turned, of another angle, height or projection */
    MONGE_CHANGE_FRAMING,     /* what the scene leaves open of it follows other bounds of the scene */
    MONGE_CHANGE_OTHERS,      /* beside the camera there is more; of which object is not known */
    MONGE_CHANGE_LIGHT_PLACE, /* a light stands elsewhere */
    MONGE_CHANGE_LIGHT_COLOR, /* it is of another colour, or stronger or weaker */
    MONGE_CHANGE_LIGHT,       /* both */
    MONGE_CHANGE_SETTING,     /* of the image or the rendering */
    MONGE_CHANGE_FOLLOWING,   /* objects that look different by lights or settings alone */
    MONGE_CHANGES
};

/* `object` is what changed, as the newer layers have it, or the older ones where it is gone; or the newer camera, or a
 * light. */
struct monge_change {
    enum monge_change_kind kind;
    const struct monge_entry *object;    /* NULL: the background, a setting, or what is not known */
    const char *setting, *older, *newer; /* its name, and its values as texts; NULL: it is no setting */
    uint32_t objects;                    /* how many, of MONGE_CHANGE_FOLLOWING; else 0 */
    uint64_t pixels;                     /* that this made different; 0: not known */
    struct monge_region bounds; /* around them, from the top left corner; of what has moved, around where */
};

/* Tells what changed from the older picture to the newer, of which the pixels differ that monge_compare counts as
 * `beyond`. Both sets of layers have the layer object and are of the rendering of their pictures; of the other layers
 * those count that both have. Objects are the same by their names; those without one, or with one name for several, by kind
 * and by what is seen at the same place, then by their order. The first `room` changes: shadows and shading behind what may
 * be their cause, and of each those of most pixels first; *count is how many there are. They point into the layers. Of
 * pictures with other bits or in another colour space, which differ everywhere by that, geometry and materials are told
 * alone, behind the settings.
 *
 * Where lights, the background or settings have changed, these are the first changes, and their pixels those of all
 * objects that look different by them alone: of which, where they are more than four, only the number is told, by one change
 * behind. Lights have no names: they are the same by place and colour, by one of these, then by their order; those that a
 * loop makes and that changed alike are one.
 *
 * With another camera the passes do not tell which objects moved: then the camera is the first change, lights and
 * settings are next, and where more of the scene has changed, that is the last. Layers of files that do not tell
 * their camera, lights or settings are taken to have the same. False: diag says why, as a failure. */
bool monge_changes(struct monge_picture *older, const struct monge_layers *older_layers,
                   struct monge_picture *newer, const struct monge_layers *newer_layers,
                   const struct monge_compare *how, struct monge_change *changes, size_t room, size_t *count,
                   struct monge_diagnostics *diag);

/* The change as a text: `object "lid" (scene.yaml:41): geometry moved`. As snprintf, with its result; no control
 * characters are in it. */
size_t monge_change_text(const struct monge_change *change, char *text, size_t size);

/* What a picture was made of, by the text chunks of its file; NULL: it does not tell. */
struct monge_stamp {
    const char *program, *scene, *text, *options; /* monge:program and so on; no options: "" */
};

/* What is different between those of two pictures. */
enum monge_sameness { MONGE_UNKNOWN, MONGE_SAME, MONGE_DIFFERENT };
struct monge_causes {
    enum monge_sameness program, scene, text, options;
};
struct monge_causes monge_causes(const struct monge_stamp *older, const struct monge_stamp *newer);

/* The same as a sentence: "the scene's text differs; the options and the program are the same". As snprintf. */
size_t monge_causes_text(const struct monge_causes *causes, char *text, size_t size);

#endif
