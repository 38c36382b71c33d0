/* Scenes in the YAML of "The Ray Tracer Challenge" by Jamis Buck (2019), as scenes of this language.
 *
 *     - define: leaf                             materials:
 *       value: {color: [0, 1, 0]}                  leaf: {ambient: [0, 0.1, 0], diffuse: [0, 0.9, 0], ...}
 *     - add: sphere                      ->      scene:
 *       material: leaf                             - sphere: {}
 *       transform:                                   material: leaf
 *         - [translate, 1, 2, 3]                     transform: [{translate: [1, 2, -3]}]
 *
 * The book's axes are left-handed, ours right-handed: each z changes its sign. */
#ifndef MONGE_LANG_IMPORT_H
#define MONGE_LANG_IMPORT_H

#include "base/diag.h"
#include "lang/lang.h"

/* The scene in `source` as YAML of this language, zero-terminated, in the arena. What the language
 * cannot say is in diag as warnings. NULL when the source is wrong; diag says why. */
const char *lang_import(struct arena *arena, struct diagnostics *diag, const struct source *source,
                        const struct lang_limits *limits);

#endif
