#include "cli/completion.h"

#include <string.h>

#include "cli/help.h"
#include "cli/limits.h"
#include "monge.h"

/* ---- Words ---- */

static void print_commands(FILE *out) {
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++)
        fprintf(out, "%s%s", c > 1 ? " " : "", COMMAND_TABLE[c].name);
}

static void print_codes(FILE *out) {
    for (size_t i = 0; monge_code(i); i++) fprintf(out, "%s%s", i > 0 ? " " : "", monge_code(i));
}

static void print_limits(FILE *out, const char *after) {
    for (size_t i = 0; limits_name(i); i++) fprintf(out, "%s%s%s", i > 0 ? " " : "", limits_name(i), after);
}

static void print_help_words(FILE *out) {
    print_commands(out);
    fputs(" language functions presets", out);
    for (size_t i = 0; monge_kind(i); i++)
        if (command_find(monge_kind(i)) == COMMAND_NONE) fprintf(out, " %s", monge_kind(i));
}

/* The words that an argument may be, with spaces between; `choices` is a|b|c of the table. */
static void print_words(FILE *out, enum argument argument, const char *choices) {
    if (argument == ARGUMENT_HELP)
        print_help_words(out);
    else if (argument == ARGUMENT_CODE)
        print_codes(out);
    else
        for (; *choices; choices++) fputc(*choices == '|' ? ' ' : *choices, out);
}

static void print_options(FILE *out, enum command_id command) {
    const char *space = "";
    for (enum option_id o = 0; o < OPTIONS; o++) {
        if (!command_takes(command, o)) continue;
        fprintf(out, "%s--%s", space, OPTION_TABLE[o].name);
        if (OPTION_TABLE[o].letter) fprintf(out, " -%c", OPTION_TABLE[o].letter);
        space = " ";
    }
}

/* ---- bash ---- */

static const char bash_functions[] =
    "_monge_words() { mapfile -t COMPREPLY < <(compgen -W \"$1\" -- \"$word\"); }\n"
    "_monge_list() { # words with commas between\n"
    "    local before=\n"
    "    if [[ $word == *,* ]]; then before=${word%,*},; fi\n"
    "    mapfile -t COMPREPLY < <(compgen -P \"$before\" -W \"$1\" -- \"${word##*,}\")\n"
    "}\n"
    "_monge_names() { # NAME=\n"
    "    compopt +o filenames -o nospace 2>/dev/null\n"
    "    _monge_words \"$1\"\n"
    "}\n"
    "_monge_files() { # folders, and files of a pattern\n"
    "    mapfile -t COMPREPLY < <(compgen -d -- \"$word\"; compgen -f -X \"!$1\" -- \"$word\")\n"
    "}\n"
    "_monge_scenes() {\n"
    "    local typed=${COMP_LINE:0:COMP_POINT} file end\n"
    "    typed=${typed##*[[:space:]]}\n"
    "    if [[ $typed != @* ]]; then _monge_files '*.y*ml'; return; fi\n"
    "    compopt +o filenames -o nospace 2>/dev/null # which would quote the @\n"
    "    while IFS= read -r file; do\n"
    "        if [[ -d $file ]]; then end=/; else end=' '; fi\n"
    "        printf -v file '@%q%s' \"$file\" \"$end\"\n"
    "        COMPREPLY+=(\"$file\")\n"
    "    done < <(compgen -f -- \"${typed:1}\")\n"
    "}\n";

/* The call of what completes the argument. */
static void print_bash_argument(FILE *out, enum argument argument, const char *choices) {
    switch (argument) {
    case ARGUMENT_NONE: fputs(":", out); break;
    case ARGUMENT_FILE: fputs("_monge_files '*'", out); break;
    case ARGUMENT_FOLDER: fputs("_monge_files ''", out); break;
    case ARGUMENT_SCENE: fputs("_monge_scenes", out); break;
    case ARGUMENT_PICTURE: fputs("_monge_files '*.[pP][nN][gG]'", out); break;
    case ARGUMENT_LIMIT:
        fputs("_monge_names '", out);
        print_limits(out, "=");
        fputs("'", out);
        break;
    case ARGUMENT_WORDS:
    case ARGUMENT_LIST:
    case ARGUMENT_CODE:
    case ARGUMENT_HELP:
        fputs(argument == ARGUMENT_LIST ? "_monge_list '" : "_monge_words '", out);
        print_words(out, argument, choices);
        fputs("'", out);
        break;
    }
}

/* A case branch that completes the value of an option. */
static void print_bash_value(FILE *out, enum command_id command, enum option_id option) {
    const struct option_row *row = &OPTION_TABLE[option];
    const char *name = COMMAND_TABLE[command].name;
    fprintf(out, "    %s,--%s", name, row->name);
    if (row->letter) fprintf(out, " | %s,-%c", name, row->letter);
    fputs(") ", out);
    print_bash_argument(out, option_argument(option), row->value);
    fputs("; return ;;\n", out);
}

/* A case branch that completes the options and operands of a command. */
static void print_bash_command(FILE *out, enum command_id command) {
    fprintf(out, "    %s)\n        if [[ $word == -* ]]; then _monge_words '", COMMAND_TABLE[command].name);
    print_options(out, command);
    fputs("'; else ", out);
    print_bash_argument(out, COMMAND_TABLE[command].argument, NULL);
    fputs("; fi ;;\n", out);
}

static void print_bash(FILE *out) {
    fputs("# bash completion of monge, made by: monge help --completion bash\n", out);
    fputs(bash_functions, out);
    fputs("_monge() {\n"
          "    local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}\n"
          "    if [[ $word == = ]]; then word=; elif [[ $previous == = ]]; then "
          "previous=${COMP_WORDS[COMP_CWORD - 2]}; fi\n"
          "    COMPREPLY=()\n"
          "    if ((COMP_CWORD == 1)); then\n"
          "        _monge_words '",
          out);
    print_commands(out);
    fputs(" ", out);
    print_options(out, COMMAND_NONE);
    fputs("'\n"
          "        return\n"
          "    fi\n"
          "    case ${COMP_WORDS[1]},$previous in\n",
          out);
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++)
        for (enum option_id o = 0; o < OPTIONS; o++)
            if (command_takes(c, o) && OPTION_TABLE[o].value) print_bash_value(out, c, o);
    fputs(
        "    esac\n"
        "    # behind the = of NAME=VALUE\n"
        "    if [[ ${COMP_WORDS[COMP_CWORD]} == = || ${COMP_WORDS[COMP_CWORD - 1]} == = ]]; then return; fi\n"
        "    case ${COMP_WORDS[1]} in\n",
        out);
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++) print_bash_command(out, c);
    fputs("    esac\n"
          "}\n"
          "complete -o filenames -F _monge monge\n",
          out);
}

/* ---- zsh ---- */

/* Within '...' and an _arguments specification: no quotes, and brackets and colons by a backslash. */
static void print_zsh_text(FILE *out, const char *text) {
    for (; *text; text++) {
        if (*text == '\'') continue;
        if (strchr("[]:\\", *text)) fputc('\\', out);
        fputc(*text, out);
    }
}

/* The action of an _arguments specification. */
static void print_zsh_argument(FILE *out, enum argument argument, const char *choices) {
    switch (argument) {
    case ARGUMENT_NONE: break;
    case ARGUMENT_FILE: fputs("_files", out); break;
    case ARGUMENT_FOLDER: fputs("_files -/", out); break;
    case ARGUMENT_SCENE: fputs("_monge_scenes", out); break;
    case ARGUMENT_PICTURE: fputs("_files -g \"*.(png|PNG)\"", out); break;
    case ARGUMENT_LIMIT:
        fputs("compadd -S = - ", out);
        print_limits(out, "");
        break;
    case ARGUMENT_LIST:
        fputs("_values -s , word ", out);
        print_words(out, argument, choices);
        break;
    case ARGUMENT_WORDS:
    case ARGUMENT_CODE:
    case ARGUMENT_HELP:
        fputs("(", out);
        print_words(out, argument, choices);
        fputs(")", out);
        break;
    }
}

/* '(-o --output)'{-o,--output}'[doc]:VALUE:_files', and _arguments' = lets --output=VALUE pass. */
static void print_zsh_option(FILE *out, enum option_id option) {
    const struct option_row *row = &OPTION_TABLE[option];
    const enum argument argument = option_argument(option);
    const bool words = argument == ARGUMENT_WORDS || argument == ARGUMENT_LIST;
    char doc[160];
    const char *value = row->value ? row->letter ? "+" : "=" : "";
    if (row->letter)
        fprintf(out, "            '(-%c --%s)'{-%c%s,--%s%s}'[", row->letter, row->name, row->letter, value,
                row->name, row->value ? "=" : "");
    else
        fprintf(out, "            '--%s%s[", row->name, value);
    print_zsh_text(out, help_option_doc(option, doc, sizeof doc));
    fputs("]", out);
    if (row->value) {
        fputs(":", out);
        print_zsh_text(out, words ? row->name : row->value);
        fputs(":", out);
        print_zsh_argument(out, argument, row->value);
    }
    fputs("' \\\n", out);
}

static void print_zsh_command(FILE *out, enum command_id command) {
    const enum argument argument = COMMAND_TABLE[command].argument;
    fprintf(out, "    %s)\n        _arguments -s -S \\\n", COMMAND_TABLE[command].name);
    for (enum option_id o = 0; o < OPTIONS; o++)
        if (command_takes(command, o)) print_zsh_option(out, o);
    if (argument != ARGUMENT_NONE) {
        fputs(argument == ARGUMENT_HELP ? "            '1:word:" : "            '*:argument:", out);
        print_zsh_argument(out, argument, NULL);
        fputs("' \\\n", out);
    }
    fputs("            && return\n        ;;\n", out);
}

static void print_zsh(FILE *out) {
    fputs("#compdef monge\n"
          "# zsh completion of monge, made by: monge help --completion zsh\n"
          "_monge_scenes() {\n"
          "    if compset -P @; then _files; else _files -g \"*.y(a|)ml\"; fi\n"
          "}\n"
          "_monge() {\n"
          "    local -a commands=(\n",
          out);
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++)
        fprintf(out, "        '%s:%s'\n", COMMAND_TABLE[c].name, COMMAND_TABLE[c].doc);
    fputs("    )\n"
          "    if ((CURRENT == 2)); then\n"
          "        _describe command commands\n"
          "        _arguments \\\n",
          out);
    for (enum option_id o = 0; o < OPTIONS; o++)
        if (command_takes(COMMAND_NONE, o)) print_zsh_option(out, o);
    fputs("            && return\n"
          "        return\n"
          "    fi\n"
          "    local command=$words[2]\n"
          "    shift words\n"
          "    ((CURRENT--))\n"
          "    case $command in\n",
          out);
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++) print_zsh_command(out, c);
    fputs("    esac\n"
          "}\n"
          "_monge \"$@\"\n",
          out);
}

/* ---- fish ---- */

static const char fish_functions[] = "function __monge_files # FOLDERS FILE: of the token's, those that "
                                     "match; the token may be --option=FILE\n"
                                     "    set -l token (commandline -ct | string replace -r '^--[^=]*=' '')\n"
                                     "    complete -C \"__monge_no_command $token\" | string replace -r "
                                     "'\\t.*' '' | string match -r \".*(?:/|$argv)\\$\"\n"
                                     "end\n"
                                     "function __monge_scenes\n"
                                     "    set -l token (commandline -ct)\n"
                                     "    if string match -q '@*' -- $token\n"
                                     "        printf '@%s\\n' (complete -C \"__monge_no_command \"(string "
                                     "sub -s 2 -- $token) | string replace -r "
                                     "'\\t.*' '')\n"
                                     "    else\n"
                                     "        __monge_files '\\.ya?ml'\n"
                                     "    end\n"
                                     "end\n";

/* What `complete` is to be told of an argument. */
static void print_fish_argument(FILE *out, enum argument argument, const char *choices) {
    switch (argument) {
    case ARGUMENT_NONE: fputs(" -f", out); break;
    case ARGUMENT_FILE: fputs(" -F", out); break;
    case ARGUMENT_FOLDER: fputs(" -f -a '(__monge_files /)'", out); break;
    case ARGUMENT_SCENE: fputs(" -f -a '(__monge_scenes)'", out); break;
    case ARGUMENT_PICTURE: fputs(" -f -a '(__monge_files \"\\.(?i)png\")'", out); break;
    case ARGUMENT_LIMIT:
        fputs(" -f -a '", out);
        print_limits(out, "=");
        fputs("'", out);
        break;
    case ARGUMENT_WORDS:
    case ARGUMENT_LIST:
    case ARGUMENT_CODE:
    case ARGUMENT_HELP:
        fputs(argument == ARGUMENT_LIST ? " -f -a '(__fish_append , " : " -f -a '", out);
        print_words(out, argument, choices);
        fputs(argument == ARGUMENT_LIST ? ")'" : "'", out);
        break;
    }
}

static void print_fish_option(FILE *out, enum command_id command, enum option_id option) {
    const struct option_row *row = &OPTION_TABLE[option];
    char doc[160];
    if (command == COMMAND_NONE)
        fputs("complete -c monge -n __fish_use_subcommand", out);
    else
        fprintf(out, "complete -c monge -n '__fish_seen_subcommand_from %s'", COMMAND_TABLE[command].name);
    fprintf(out, " -l %s", row->name);
    if (row->letter) fprintf(out, " -s %c", row->letter);
    if (row->value) {
        fputs(" -r", out);
        print_fish_argument(out, option_argument(option), row->value);
    }
    fprintf(out, " -d '%s'\n", help_option_doc(option, doc, sizeof doc));
}

static void print_fish(FILE *out) {
    fputs("# fish completion of monge, made by: monge help --completion fish\n", out);
    fputs(fish_functions, out);
    fputs("complete -c monge -n __fish_use_subcommand -f\n", out);
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++) {
        fprintf(out, "complete -c monge -n __fish_use_subcommand -a %s -d '%s'\n", COMMAND_TABLE[c].name,
                COMMAND_TABLE[c].doc);
        fprintf(out, "complete -c monge -n '__fish_seen_subcommand_from %s'", COMMAND_TABLE[c].name);
        print_fish_argument(out, COMMAND_TABLE[c].argument, NULL);
        fputs("\n", out);
    }
    for (enum command_id c = COMMAND_NONE; c < COMMANDS; c++)
        for (enum option_id o = 0; o < OPTIONS; o++)
            if (command_takes(c, o)) print_fish_option(out, c, o);
}

void completion_print(FILE *out, enum completion_shell shell) {
    switch (shell) {
    case COMPLETION_BASH: print_bash(out); break;
    case COMPLETION_ZSH: print_zsh(out); break;
    case COMPLETION_FISH: print_fish(out); break;
    }
}
