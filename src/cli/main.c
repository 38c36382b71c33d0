#include "cli/commands.h"
#include "cli/say.h"

int main(int argc, char **argv) {
    streams_open();
    return (int)streams_close(command_run(argc > 0 ? argc - 1 : 0, argv + 1));
}
