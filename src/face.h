/* What the files of the library's face share: not for others. */
#ifndef MONGE_FACE_H
#define MONGE_FACE_H

#include "accel/accel.h"
#include "base/diag.h"
#include "lang/lang.h"
#include "monge.h"
#include "scene/scene.h"

struct monge_diagnostics {
    struct diagnostics list;
};

/* The part of `scene` that a later frame made lives in `view`; what it could keep, in `body` as before. */
struct monge_scene {
    struct arena body, view;
    struct scene scene;
    struct accel *accel; /* in `body`; NULL: not prepared */
    /* Of an animation, else empty: */
    struct arena texts;      /* its files, and what `input` points to */
    struct lang_input input; /* to read it again */
    struct lang_files files;
    size_t memory_bytes;              /* for that */
    struct lang_memory memory;        /* of the reading, where only the file itself depends on the frame */
    struct lang_result result;        /* in `memory` */
    struct hash texts_hash;           /* of all files that were read */
    char *included;                   /* owned: those that it includes, one a line */
    struct monge_tolerance tolerance; /* its reason is owned; NULL: the scene states none */
    struct outline *outline;          /* NULL: not wanted */
    size_t built_bytes;               /* of the scene, without the hierarchy */
};

/* Each limit as it is given, or its default; within what the program can do. given may be NULL. */
struct monge_limits face_limits(const struct monge_limits *given);

/* The same, for lang/. */
struct lang_limits face_lang_limits(const struct monge_limits *limits);

/* What a mapping of kind tolerance says; its reason as long as the object. False: something in it is reported. */
bool face_tolerance(struct diagnostics *diag, const struct object_value *object, struct monge_tolerance *out);

/* Reports that the limit of memory was reached, or that there is no more. */
void face_report_full(struct diagnostics *diag, const char *name, size_t memory_bytes);

#endif
