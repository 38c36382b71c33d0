#include "cli/completion.h"

#include <string.h>

#include "cli/help.h"
#include "monge.h"

/* The words of a|b|c with spaces between. */
static void print_choices(FILE *out, const char *choices) {
    for (; *choices; choices++) fputc(*choices == '|' ? ' ' : *choices, out);
}

static bool is_choice(const struct option_row *row) {
    return row->kind == VALUE_CHOICE || row->kind == VALUE_CHOICES;
}
static bool is_file(const struct option_row *row) {
    return row->kind == VALUE_FILE || row->kind == VALUE_AREA;
}

static void print_commands(FILE *out) {
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++)
        fprintf(out, "%s%s", c > 1 ? " " : "", COMMAND_TABLE[c].name);
}

static void print_codes(FILE *out) {
    for (size_t i = 0; monge_code(i); i++) fprintf(out, "%s%s", i > 0 ? " " : "", monge_code(i));
}

/* What `monge help` may be followed by. */
static void print_help_words(FILE *out) {
    print_commands(out);
    fputs(" language functions presets", out);
    for (size_t i = 0; monge_kind(i); i++)
        if (command_find(monge_kind(i)) == COMMAND_NONE) fprintf(out, " %s", monge_kind(i));
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

/* A case branch that completes the value of an option. */
static void print_bash_value(FILE *out, enum command_id command, enum option_id option) {
    const struct option_row *row = &OPTION_TABLE[option];
    const char *name = COMMAND_TABLE[command].name;
    fprintf(out, "    %s,--%s", name, row->name);
    if (row->letter) fprintf(out, " | %s,-%c", name, row->letter);
    fputs(") ", out);
    if (is_choice(row)) {
        fputs("mapfile -t COMPREPLY < <(compgen -W '", out);
        print_choices(out, row->value);
        fputs("' -- \"$word\")", out);
    } else if (is_file(row)) {
        fputs("mapfile -t COMPREPLY < <(compgen -f -- \"$word\")", out);
    } else {
        fputs(":", out);
    }
    fputs("; return ;;\n", out);
}

static void print_bash(FILE *out) {
    fputs("# bash completion of monge, made by: monge help --completion bash\n"
          "_monge() {\n"
          "    local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} words=\n"
          "    if [[ $word == = ]]; then word=; elif [[ $previous == = ]]; then "
          "previous=${COMP_WORDS[COMP_CWORD - 2]}; fi\n"
          "    COMPREPLY=()\n"
          "    if ((COMP_CWORD == 1)); then\n"
          "        mapfile -t COMPREPLY < <(compgen -W '",
          out);
    print_commands(out);
    fputs(" ", out);
    print_options(out, COMMAND_NONE);
    fputs("' -- \"$word\")\n"
          "        return\n"
          "    fi\n"
          "    case ${COMP_WORDS[1]},$previous in\n",
          out);
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++)
        for (enum option_id o = 0; o < OPTIONS; o++)
            if (command_takes(c, o) && OPTION_TABLE[o].value) print_bash_value(out, c, o);
    fputs("    esac\n    case ${COMP_WORDS[1]} in\n", out);
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++) {
        fprintf(out, "    %s) words='", COMMAND_TABLE[c].name);
        print_options(out, c);
        fputs("' ;;\n", out);
    }
    fputs("    esac\n"
          "    if [[ $word == -* ]]; then\n"
          "        mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
          "    elif [[ ${COMP_WORDS[1]} == help ]]; then\n"
          "        mapfile -t COMPREPLY < <(compgen -W '",
          out);
    print_help_words(out);
    fputs("' -- \"$word\")\n"
          "    elif [[ ${COMP_WORDS[1]} == explain ]]; then\n"
          "        mapfile -t COMPREPLY < <(compgen -W '",
          out);
    print_codes(out);
    fputs("' -- \"$word\")\n"
          "    elif [[ ${COMP_WORDS[1]} != schema && ${COMP_WORDS[1]} != version ]]; then\n"
          "        mapfile -t COMPREPLY < <(compgen -d -- \"$word\"; compgen -f -X '!*.y*ml' -- \"$word\")\n"
          "    fi\n"
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

/* '(-o --output)'{-o,--output}'[doc]:VALUE:_files', and _arguments' = lets --output=VALUE pass. */
static void print_zsh_option(FILE *out, enum option_id option) {
    const struct option_row *row = &OPTION_TABLE[option];
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
        print_zsh_text(out, is_choice(row) ? row->name : row->value);
        fputs(":", out);
        if (is_file(row)) fputs("_files", out);
        if (is_choice(row)) {
            fputs("(", out);
            print_choices(out, row->value);
            fputs(")", out);
        }
    }
    fputs("' \\\n", out);
}

static void print_zsh(FILE *out) {
    fputs("#compdef monge\n"
          "# zsh completion of monge, made by: monge help --completion zsh\n"
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
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++) {
        fprintf(out, "    %s)\n        _arguments -s -S \\\n", COMMAND_TABLE[c].name);
        for (enum option_id o = 0; o < OPTIONS; o++)
            if (command_takes(c, o)) print_zsh_option(out, o);
        if (COMMAND_TABLE[c].operand) {
            fprintf(out, "            '*:%s:_files -g \"%s\"'\n        ;;\n", COMMAND_TABLE[c].operand,
                    c == COMMAND_DIFF ? "*.png" : "*.y(a|)ml");
            continue;
        }
        if (c == COMMAND_HELP || c == COMMAND_EXPLAIN) {
            fputs(c == COMMAND_HELP ? "            '1:word:(" : "            '*:code:(", out);
            (c == COMMAND_HELP ? print_help_words : print_codes)(out);
            fputs(")' \\\n", out);
        }
        fputs("            && return\n        ;;\n", out);
    }
    fputs("    esac\n"
          "}\n"
          "_monge \"$@\"\n",
          out);
}

/* ---- fish ---- */

static void print_fish_option(FILE *out, enum command_id command, enum option_id option) {
    const struct option_row *row = &OPTION_TABLE[option];
    char doc[160];
    if (command == COMMAND_NONE)
        fputs("complete -c monge -n __fish_use_subcommand", out);
    else
        fprintf(out, "complete -c monge -n '__fish_seen_subcommand_from %s'", COMMAND_TABLE[command].name);
    fprintf(out, " -l %s", row->name);
    if (row->letter) fprintf(out, " -s %c", row->letter);
    if (is_file(row))
        fputs(" -r", out);
    else if (row->value)
        fputs(" -x", out);
    if (is_choice(row)) {
        fputs(" -a '", out);
        print_choices(out, row->value);
        fputs("'", out);
    }
    fprintf(out, " -d '%s'\n", help_option_doc(option, doc, sizeof doc));
}

static void print_fish(FILE *out) {
    fputs("# fish completion of monge, made by: monge help --completion fish\n", out);
    fputs("complete -c monge -n __fish_use_subcommand -f\n", out);
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++)
        fprintf(out, "complete -c monge -n __fish_use_subcommand -a %s -d '%s'\n", COMMAND_TABLE[c].name,
                COMMAND_TABLE[c].doc);
    fputs("complete -c monge -n '__fish_seen_subcommand_from help' -f -a '", out);
    print_help_words(out);
    fputs("'\ncomplete -c monge -n '__fish_seen_subcommand_from explain' -f -a '", out);
    print_codes(out);
    fputs("'\ncomplete -c monge -n '__fish_seen_subcommand_from schema version' -f\n", out);
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
