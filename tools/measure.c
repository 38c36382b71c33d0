/* Runs commands in turn, several times each, and prints of each the least processor time, the most
 * memory and the least time that it took:
 *
 *     measure RUNS COMMAND [ARGUMENT...] [-- COMMAND [ARGUMENT...]]...
 *
 * One line for each: seconds (user and system), peak kilobytes, seconds by the clock. Their output is thrown away. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { MAX_COMMANDS = 16 };

struct command {
    char **words;
    double seconds, elapsed;
    long kilobytes;
};

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static double seconds_of(struct timeval t) { return (double)t.tv_sec + 1e-6 * (double)t.tv_usec; }

static void run(struct command *c) {
    struct rusage used;
    int status;
    const double begin = now();
    const pid_t child = fork();
    if (child == 0) {
        const int nothing = open("/dev/null", O_WRONLY);
        dup2(nothing, STDOUT_FILENO);
        execvp(c->words[0], c->words);
        perror(c->words[0]);
        _exit(127);
    }
    if (child < 0 || wait4(child, &status, 0, &used) != child || status != 0) {
        fprintf(stderr, "measure: %s failed\n", c->words[0]);
        exit(1);
    }
    const double elapsed = now() - begin;
    if (c->elapsed == 0.0 || elapsed < c->elapsed) c->elapsed = elapsed;
    const double seconds = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
    if (c->seconds == 0.0 || seconds < c->seconds) c->seconds = seconds;
    if (used.ru_maxrss > c->kilobytes) c->kilobytes = used.ru_maxrss;
}

int main(int argc, char **argv) {
    struct command commands[MAX_COMMANDS] = {{NULL, 0, 0, 0}};
    int count = 0;
    if (argc < 3) {
        fprintf(stderr, "usage: measure RUNS COMMAND [ARGUMENT...] [-- COMMAND...]...\n");
        return 2;
    }
    commands[count++].words = &argv[2];
    for (int i = 3; i < argc && count < MAX_COMMANDS; i++)
        if (strcmp(argv[i], "--") == 0) {
            argv[i] = NULL;
            commands[count++].words = &argv[i + 1];
        }
    for (int r = atoi(argv[1]); r > 0; r--)
        for (int i = 0; i < count; i++) run(&commands[i]);
    for (int i = 0; i < count; i++) printf("%.3f %ld %.3f\n", commands[i].seconds, commands[i].kilobytes, commands[i].elapsed);
    return 0;
}
