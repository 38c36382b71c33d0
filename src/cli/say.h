/* What the program itself has to say, and the state of its standard streams. */
#ifndef MONGE_CLI_SAY_H
#define MONGE_CLI_SAY_H

#include <stdarg.h>
#include <stdio.h>

#include "cli/commands.h"

/* Where the lines of this thread go: stderr, or a stream that it has been diverted to (NULL: no longer). */
FILE *say_stream(void);
void say_divert(FILE *stream);

/* "monge: ..." as a line on that stream, with control characters, which may come from file names, made harmless. */
void say_error(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The same, and then where to read about the command. */
void say_usage(enum command_id command, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* What this thread's errors are of, "goldens/golden.yaml:3", which they begin with from now on, and say nothing of where to
 * read more; NULL: no longer. */
void say_of(const char *place);

/* A line there, like say_error's but without "monge: ". */
void say_note(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* A line of text into any stream, the same way. */
void say_line(FILE *out, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* As asprintf; ends the program where there is no memory. To be freed. */
char *say_text(const char *format, ...) __attribute__((format(printf, 1, 2)));

char *say_text_list(const char *format, va_list args);

/* A stream that makes a text, as open_memstream, and its end; either ends the program where there is no memory. */
FILE *say_text_begin(char **text, size_t *size);
void say_text_end(FILE *out);

/* Says so, on stderr itself, and ends the program. */
_Noreturn void say_no_memory(void);

/* Before all else: a stream that was closed must not become a file that is opened later. */
void streams_open(void);

/* For commands with files to write: a reader of stdout or stderr that goes away, as head(1), makes an error of that output,
 * where the signal would end the program before the files are written. */
void streams_outlive_readers(void);

void streams_flush(void); /* of stdout, so that its lines keep their place among those of stderr */

/* At the end: the exit status, STATUS_TROUBLE where stdout did not take everything. */
enum status streams_close(enum status status);

#endif
