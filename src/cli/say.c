#include "cli/say.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static _Thread_local FILE *diverted;

static _Thread_local const char *place; /* NULL: none */

FILE *say_stream(void) { return diverted ? diverted : stderr; }
void say_divert(FILE *stream) { diverted = stream; }
void say_of(const char *what) { place = what; }

void say_no_memory(void) {
    fputs("monge: out of memory\n", stderr);
    exit(STATUS_TROUBLE);
}

char *say_text_list(const char *format, va_list args) {
    char *text = NULL;
    if (vasprintf(&text, format, args) < 0) say_no_memory();
    return text;
}

static void print_line(FILE *out, const char *format, va_list args) {
    char *text = say_text_list(format, args);
    for (char *c = text; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f) *c = '?';
    fprintf(out, "%s\n", text);
    free(text);
}

static void print_error(const char *format, va_list args) {
    char *text = say_text_list(format, args);
    say_line(say_stream(), "monge: %s%s%s", place ? place : "", place ? ": " : "", text);
    free(text);
}

void say_error(const char *format, ...) {
    va_list args;
    va_start(args, format);
    print_error(format, args);
    va_end(args);
}

void say_usage(enum command_id command, const char *format, ...) {
    va_list args;
    va_start(args, format);
    print_error(format, args);
    va_end(args);
    if (place) return;
    if (command == COMMAND_NONE)
        fputs("see `monge help`\n", say_stream());
    else
        fprintf(say_stream(), "see `monge help %s`\n", COMMAND_TABLE[command].name);
}

void say_note(const char *format, ...) {
    va_list args;
    va_start(args, format);
    print_line(say_stream(), format, args);
    va_end(args);
}

void say_line(FILE *out, const char *format, ...) {
    va_list args;
    va_start(args, format);
    print_line(out, format, args);
    va_end(args);
}

char *say_text(const char *format, ...) {
    va_list args;
    va_start(args, format);
    char *text = say_text_list(format, args);
    va_end(args);
    return text;
}

FILE *say_text_begin(char **text, size_t *size) {
    FILE *out = open_memstream(text, size);
    if (!out) say_no_memory();
    return out;
}

void say_text_end(FILE *out) {
    const bool good = !ferror(out);
    if (fclose(out) != 0 || !good) say_no_memory();
}

/* open takes the lowest number that is free, the missing stream's; the wrong mode makes each use of it fail. A file that
 * grows over the limit of its size fails with EFBIG, where the signal would end the program without a word. */
void streams_open(void) {
    signal(SIGXFSZ, SIG_IGN);
    for (int fd = 0; fd <= 2; fd++)
        if (fcntl(fd, F_GETFD) < 0) (void)!open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
    static char buffer[1 << 18]; /* whatever is printed at once is flushed at once: its errno is known */
    setvbuf(stdout, buffer, _IOFBF, sizeof buffer);
}

void streams_outlive_readers(void) { signal(SIGPIPE, SIG_IGN); }

static int output_error; /* of stdout: the first errno, which later calls on a stream that has failed lose */

/* Why a stream failed that has forgotten it: it fails again. */
static int find_reason(void) {
    clearerr(stdout);
    errno = 0;
    if (fputc('\n', stdout) != EOF) fflush(stdout);
    return errno ? errno : EIO;
}

void streams_flush(void) {
    const bool failed = ferror(stdout);
    if (fflush(stdout) == 0 && !failed) return;
    if (!output_error) output_error = failed ? find_reason() : errno;
}

enum status streams_close(enum status status) {
    streams_flush();
    if (!output_error || status == STATUS_TROUBLE) return status;
    say_error("cannot write standard output: %s", strerror(output_error));
    return STATUS_TROUBLE;
}
