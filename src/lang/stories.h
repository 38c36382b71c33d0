/* What the codes of diagnostics mean; generated from grammar/diagnostics.yaml. */
#ifndef MONGE_LANG_STORIES_H
#define MONGE_LANG_STORIES_H

#include "base/diag_write.h"

extern const struct diag_stories stories;

#endif
