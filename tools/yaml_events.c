/* The bare loop over libyaml's events of a file, as a measure for the loader: yaml_events FILE */
#include <stdbool.h>
#include <stdio.h>
#include <yaml.h>

static bool loop(yaml_parser_t *parser) {
    yaml_event_t event;
    for (bool over = false; !over;) {
        if (!yaml_parser_parse(parser, &event)) return false;
        over = event.type == YAML_STREAM_END_EVENT;
        yaml_event_delete(&event);
    }
    return true;
}

int main(int argc, char **argv) {
    yaml_parser_t parser;
    FILE *file = argc == 2 ? fopen(argv[1], "rb") : NULL;
    if (!file || !yaml_parser_initialize(&parser)) {
        fprintf(stderr, "usage: yaml_events FILE\n");
        return 2;
    }
    yaml_parser_set_input_file(&parser, file);
    const bool good = loop(&parser);
    yaml_parser_delete(&parser);
    fclose(file);
    return !good;
}
