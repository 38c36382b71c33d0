/* Patterns of paths that the shell has left alone. */
#ifndef MONGE_CLI_MATCHES_H
#define MONGE_CLI_MATCHES_H

#include <stdbool.h>
#include <stddef.h>

/* Paths that a pattern stands for, sorted, each once. */
struct matches {
    char **paths;
    size_t count;
};

bool is_pattern(const char *path);

/* What is there and matches: `*`, `?` and `[...]` within the name of a file or folder, `**`, as the name of a folder, for any
 * folders or none; what is hidden only where a pattern says so. To be freed. */
struct matches matches_find(const char *pattern);
void matches_free(struct matches *matches);

/* What is behind the pattern's fixed beginning, the folders before the first part that varies, in a path that it stands for,
 * and behind `.` and `..`:
 *
 *     scenes/x*.yaml       scenes/x1.yaml       x1.yaml
 *     scenes/s??/x*.yaml   scenes/sub/x1.yaml   sub/x1.yaml */
const char *matches_varying(const char *pattern, const char *path);

/* The names of what is in a folder ("": the current one), but for the hidden, sorted, up to a NULL. NULL: errno says why. To be
 * freed. */
char **folder_names(const char *folder);
void folder_names_free(char **names);

#endif
