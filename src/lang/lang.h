/* From text to a checked, evaluated description. */
#ifndef MONGE_LANG_LANG_H
#define MONGE_LANG_LANG_H

#include "base/hash.h"
#include "base/table.h"
#include "lang/description.h"

struct lang_limits {
    size_t file_bytes;  /* of one file */
    unsigned nesting;   /* collections within each other */
    size_t values;      /* in one file, those behind aliases each time */
    unsigned recursion; /* templates in use within each other */
    size_t steps;       /* objects looked at, placed or not, and turns of loops */
    size_t objects;     /* shapes placed, those of templates that stand once for many once */
};

/* What becomes of a template in use, see lang_sink. */
enum lang_use {
    LANG_USE_PLACED, /* it is known and placed: its objects need not be read */
    LANG_USE_READ,   /* read its objects, then close it */
};

/* Who takes the objects of the scene, in their order. The object_values live until the call returns;
 * of a group or a use until it is closed. */
struct lang_sink {
    void *context;
    void (*shape)(void *context, const struct object_value *object);
    void (*open_group)(void *context, const struct object_value *object);
    void (*close_group)(void *context);
    /* The template and its arguments as a hash. exact: uses of equal hash have equal objects; else it
     * is of the template alone, and the objects may be others each time. */
    enum lang_use (*open_use)(void *context, const struct object_value *object, const struct hash *contents,
                              bool exact);
    bool (*close_use)(void *context); /* true: read the objects once more, and close again */
    /* What was placed since the mark is taken back. */
    void (*mark)(void *context);
    void (*take_back)(void *context);
};

/* What a template in use was given, as "depth = 3", in the arena: of the frame that is under way while the sink
 * opens it. */
const char *lang_use_arguments(struct arena *arena, const struct diag_frame *frame);

struct lang_define {
    const char *name, *value; /* of `-D name=value` */
};

/* What a scene includes, by path: read once, however often the scene is. Zeroed, but for the arena. */
struct lang_files {
    struct arena *arena;
    struct table included;
};

struct lang_input {
    const struct source *source; /* the scene; outlives the reading */
    const char *path; /* of it, for what it includes; "-" or a name that is no file: the working folder */
    struct lang_limits limits;
    const struct lang_define *defines;
    size_t define_count;
    unsigned frame;           /* of an animation, from 1; 0: the first */
    bool untrusted;           /* includes stay in the folder of the scene */
    struct lang_files *files; /* NULL: nothing has been read yet */
    const struct lang_sink *sink;
};

/* The memory of a reading: zeroed, with `nodes` set up as the owner likes; the others are its children.
 * When it is full, reading leaves by longjmp. */
struct lang_memory {
    struct arena nodes;   /* texts and trees of the files */
    struct arena kept;    /* definitions, and the result */
    struct arena scratch; /* the object that is read */
};
void lang_memory_free(struct lang_memory *memory);

struct checker;

/* A file that was read. */
struct lang_text {
    const char *
        path; /* the scene's as it was given; of others, from there: relative to the scene's folder, or absolute */
    const struct source *source;
};

struct lang_result {
    const struct object_value *file; /* NULL when nothing can be said of the text as a scene */
    struct object_list materials;    /* all that have names, by their `definition` */
    bool moves;                      /* an object depends on the frame */
    unsigned frames;                 /* of the animation; 0: there is none */
    struct checker *reading;         /* for lang_read_frame */
    const struct lang_text *texts;   /* the scene first, then what it includes, in the order of reading */
    uint32_t text_count;
};

/* Reads the scene, all its mistakes reported to `diag`; diag tells whether it was right. The objects go
 * to the sink; the rest is the result, which lives in `memory`. */
struct lang_result lang_read(struct lang_memory *memory, struct diagnostics *diag,
                             const struct lang_input *input);

/* Reads the settings of goldens: an object of kind goldens, or NULL. All that is wrong is reported to `diag`. Of the
 * input the source, its path and the limits count. */
const struct object_value *lang_read_goldens(struct lang_memory *memory, struct diagnostics *diag,
                                             const struct lang_input *input);

/* The file's settings, camera and lights at another frame, of a scene that was right and whose objects do not
 * move; its memory, and what its input points to but for the sink, are still there. *result is renewed, and
 * good until the next call. */
void lang_read_frame(struct lang_result *result, struct diagnostics *diag, unsigned frame);

#endif
