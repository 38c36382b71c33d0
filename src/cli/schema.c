#include "cli/schema.h"

#include <stdio.h>

#include "cli/say.h"
#include "monge.h"

enum status schema_command(const struct arguments *args) {
    if (args->count > 0) {
        say_usage(COMMAND_SCHEMA, "schema: expected nothing more, found `%s`", args->operands[0]);
        return STATUS_TROUBLE;
    }
    fputs(monge_schema(), stdout);
    return STATUS_YES;
}
