/* Makes what is generated from the definition of the language:
 *
 *     grammar tables-header FOLDER OUT    enums of kinds, keys, choices and functions
 *     grammar tables        FOLDER OUT    the loader's tables
 *     grammar reference     FOLDER OUT    the reference manual, Markdown
 *     grammar schema        FOLDER OUT    the schema for editors, JSON Schema draft-07
 *     grammar schema-source FOLDER OUT    the same as a text of the program
 *
 * FOLDER holds language.yaml, functions.yaml, colors.yaml and types.yaml; beside it is scenes/presets.yaml. Exit 0, or 2 with a message and no OUT. */
#include <string.h>

#include "definition.h"

static const struct {
    const char *name;
    void (*write)(FILE *out, const struct definition *language);
} products[] = {
    {"tables-header", write_header},        {"tables", write_tables},
    {"reference", write_reference},         {"schema", write_schema},
    {"schema-source", write_schema_source},
};

static int write_product(const struct definition *language, size_t product, const char *path) {
    FILE *out = fopen(path, "w");
    if (!out) {
        perror(path);
        return 2;
    }
    products[product].write(out, language);
    if (fclose(out) == 0) return 0;
    perror(path);
    remove(path);
    return 2;
}

int main(int argc, char **argv) {
    size_t product = 0;
    const size_t count = sizeof products / sizeof *products;
    while (argc == 4 && product < count && strcmp(argv[1], products[product].name) != 0) product++;
    if (argc != 4 || product == count) {
        fprintf(stderr, "usage: grammar tables-header|tables|reference|schema|schema-source FOLDER OUT\n");
        return 2;
    }
    const struct definition language = definition_read(argv[2]);
    const int status = write_product(&language, product, argv[3]);
    definition_free();
    return status;
}
