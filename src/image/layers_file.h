/* Layers and their files, beside the picture that they are of: monge.h tells what they have. */
#ifndef MONGE_IMAGE_LAYERS_FILE_H
#define MONGE_IMAGE_LAYERS_FILE_H

#include "render/layers.h"

/* False: the reason is in `message`, and nothing is left behind. */
bool layer_file_write(const struct monge_layers *layers, enum monge_layer layer, const char *path,
                      char *message, size_t size);

/* Of the layers `wanted` those whose files are beside `picture`. NULL: there are none, and `message` is "", or it
 * has the reason why one cannot be read. */
struct monge_layers *layer_files_read(const char *picture, unsigned wanted, char *message, size_t size);

#endif
