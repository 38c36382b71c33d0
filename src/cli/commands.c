#include "cli/commands.h"

#include <stdio.h>
#include <string.h>

#include "cli/check.h"
#include "cli/diff.h"
#include "cli/explain.h"
#include "cli/fmt.h"
#include "cli/golden/accept.h"
#include "cli/golden/test.h"
#include "cli/help.h"
#include "cli/import.h"
#include "cli/info.h"
#include "cli/options.h"
#include "cli/render.h"
#include "cli/say.h"
#include "cli/scene_path.h"
#include "cli/schema.h"
#include "cli/suggest.h"
#include "monge.h"

#define IN_NONE    (1u << COMMAND_NONE)
#define IN_RENDER  (1u << COMMAND_RENDER)
#define IN_CHECK   (1u << COMMAND_CHECK)
#define IN_INFO    (1u << COMMAND_INFO)
#define IN_TEST    (1u << COMMAND_TEST)
#define IN_ACCEPT  (1u << COMMAND_ACCEPT)
#define IN_FMT     (1u << COMMAND_FMT)
#define IN_DIFF    (1u << COMMAND_DIFF)
#define IN_EXPLAIN (1u << COMMAND_EXPLAIN)
#define IN_IMPORT  (1u << COMMAND_IMPORT)
#define IN_SCHEMA  (1u << COMMAND_SCHEMA)
#define IN_HELP    (1u << COMMAND_HELP)
#define IN_ALL     ((1u << COMMANDS) - 1)

#define LIMITS_TEXT                                                                                          \
    "--limit bounds what a scene may take, for files from strangers: file_bytes (of one file: 1G), "         \
    "memory_bytes (of a load: 8G), values (of one file: 100M), nesting (of lists and mappings: 100), "       \
    "recursion (of templates: 100), steps (objects and turns of loops: 10M), objects (shapes: 20M), "        \
    "pixels (of the picture: 268435456). k, M and G are powers of 1000, of bytes powers of 1024."

#define SCENES_TEXT                                                                                          \
    "A SCENE is a file; a folder, which stands for all *.yaml and *.yml below it that are scenes, by name "  \
    "(what is hidden, links to folders, and files of definitions are passed by); a pattern in quotes, as "   \
    "'scenes/**/k*.yaml', in which ** stands for any folders; or @FILE, a list with one of these a line, "   \
    "where # at the beginning of a line makes it a comment, blanks around it do not count, and paths are "   \
    "from the current folder. A list with a NUL in it has names between NULs, just as they stand. "

/* Where `make install` puts it, below a prefix that the program does not know. */
#define IN_DOCUMENTS(file) file ", in share/doc/monge,"

/* The words of a choice stand in the order of the enum that they become. */
const struct option_row OPTION_TABLE[OPTIONS] = {
    [OPTION_OUTPUT] = {"output", 'o', VALUE_FILE, IN_RENDER, "FILE|DIR/|PATTERN", 0, 0,
                       "where the picture goes: a file, a folder, a pattern with {name}, or -"},
    [OPTION_ROOT] = {"root", 0, VALUE_FILE, IN_RENDER | IN_TEST, "DIR", 0, 0,
                     "the folder that the names of all scenes count from"},
    [OPTION_DEFINE] =
        {"define", 'D', VALUE_PAIR, IN_RENDER | IN_CHECK | IN_INFO, "NAME=VALUE", 0, 0,
         "set a parameter of the scene; a list a,b,c or a range 1..9:2 makes a sweep; repeatable"},
    [OPTION_FRAMES] = {"frames", 0, VALUE_FRAMES, IN_RENDER, "N|A-B|A-|all", 1, 1000000,
                       "frames of the animation; with :STEP behind it every so many"},
    [OPTION_IMPORT_OUTPUT] = {"output", 'o', VALUE_FILE, IN_IMPORT, "FILE", 0, 0,
                              "where the scene goes; - is standard output, which is the default"},
    [OPTION_SIZE] = {"size", 0, VALUE_SIZE, IN_RENDER, "WxH", 1, MONGE_MAX_SIDE,
                     "size of the picture in pixels"},
    [OPTION_SAMPLES] = {"samples", 0, VALUE_WHOLE, IN_RENDER, "N", 1, MONGE_MAX_SAMPLES, "samples a pixel"},
    [OPTION_REGION] = {"region", 0, VALUE_REGION, IN_RENDER, "X,Y,W,H", 1, MONGE_MAX_SIDE,
                       "only these pixels, from the top left corner; the file is of that size"},
    [OPTION_SHADING] = {"shading", 0, VALUE_CHOICE, IN_RENDER, "phong|diffuse|signature", 0, 0,
                        "all of the light; ambient and diffuse alone; or flat colours, unlit"},
    [OPTION_SHADOW] = {"shadow", 0, VALUE_FRACTION, IN_RENDER, "F", 0, 1,
                       "the part of a light that reaches its shadow"},
    [OPTION_NO_SHADOWS] = {"no-shadows", 0, VALUE_NONE, IN_RENDER, NULL, 0, 0, "the same as --shadow 1"},
    [OPTION_DEPTH] = {"depth", 0, VALUE_WHOLE, IN_RENDER, "N", 1, MONGE_MAX_DEPTH,
                      "depth of reflection and refraction; 1 has neither"},
    [OPTION_BITS] = {"bits", 0, VALUE_CHOICE, IN_RENDER, "8|16", 0, 0, "bits a channel in the file"},
    [OPTION_ENCODING] = {"encoding", 0, VALUE_CHOICE, IN_RENDER, "srgb|linear", 0, 0,
                         "how colours are encoded in the file"},
    [OPTION_AOV] = {"aov", 0, VALUE_CHOICES, IN_RENDER, "object|material|depth|normal|shadow", 0, 0,
                    "write auxiliary passes beside the picture; several with commas between"},
    [OPTION_THREADS] = {"threads", 0, VALUE_WHOLE, IN_RENDER | IN_DIFF | IN_TEST, "N", 1, 1024,
                        "threads for each picture; one for each processor by default"},
    [OPTION_JOBS] = {"jobs", 'j', VALUE_WHOLE, IN_RENDER | IN_TEST, "N", 1, 256,
                     "scenes to render at once; as many as processors by default"},
    [OPTION_SKIP_UNCHANGED] = {"skip-unchanged", 0, VALUE_NONE, IN_RENDER, NULL, 0, 0,
                               "leave pictures alone that program, options and files would make again"},
    [OPTION_RESUME] = {"resume", 0, VALUE_NONE, IN_RENDER, NULL, 0, 0,
                       "go on where a run with --resume was stopped; implies --skip-unchanged"},
    [OPTION_DRY_RUN] = {"dry-run", 'n', VALUE_NONE, IN_RENDER | IN_ACCEPT, NULL, 0, 0,
                        "write nothing; tell what would become of each picture"},
    [OPTION_KEEP_GOING] = {"keep-going", 'k', VALUE_NONE, IN_RENDER, NULL, 0, 0,
                           "after a failure render the others all the same; this is the default"},
    [OPTION_FAIL_FAST] = {"fail-fast", 0, VALUE_NONE, IN_RENDER, NULL, 0, 0,
                          "begin no further scene after a failure"},
    [OPTION_STATS] = {"stats", 0, VALUE_FILE, IN_RENDER, "FILE|-", 0, 0,
                      "write times, rays and memory as JSON"},
    [OPTION_LOG] = {"log", 0, VALUE_FILE, IN_RENDER, "FILE|-", 0, 0,
                    "add a line of JSON to the file for each picture"},
    [OPTION_PROGRESS] =
        {"progress", 0, VALUE_CHOICE, IN_RENDER | IN_TEST, "auto|always|never|json", 0, 0,
         "show a progress bar; auto: where standard error is a terminal, not a dumb one; json: for programs"},
    [OPTION_FORMAT] = {"format", 0, VALUE_CHOICE, IN_RENDER | IN_CHECK, "text|json|sarif", 0, 0,
                       "how to report what is wrong: for people, or as one document for programs"},
    [OPTION_METRIC] = {"metric", 0, VALUE_CHOICES, IN_DIFF, "exact|max|mae|rmse|psnr|ssim|flip", 0, 0,
                       "what to measure; several with commas between; repeatable"},
    [OPTION_MAX_DELTA] = {"max-delta", 0, VALUE_FRACTION, IN_DIFF, "F", 0, 1,
                          "by how much channels may differ, or what is measured may be"},
    [OPTION_MAX_PIXELS] = {"max-pixels", 0, VALUE_AMOUNT, IN_DIFF, "N|P%", 0, 0,
                           "how many pixels may differ, by more than --max-delta where it is given"},
    [OPTION_IGNORE] = {"ignore", 0, VALUE_AREA, IN_DIFF, "X,Y,W,H|MASK", 1, INT32_MAX,
                       "leave out these pixels, repeatable; or those that a PNG is not black in"},
    [OPTION_MASK] = {"mask", 0, VALUE_FILE, IN_DIFF, "MASK", 0, 0, "the same as --ignore MASK"},
    [OPTION_PPD] = {"ppd", 0, VALUE_FRACTION, IN_DIFF, "F", 1, 1000,
                    "pixels per degree of sight, for flip; 67 by default"},
    [OPTION_HEAT_MAP] = {"out", 'o', VALUE_FILE, IN_DIFF, "FILE|DIR", 0, 0,
                         "write a picture of where they differ; - is standard output; of folders: a folder"},
    [OPTION_DIFF_JSON] = {"json", 0, VALUE_NONE, IN_DIFF, NULL, 0, 0,
                          "as one JSON object, of folders a list of them"},
    [OPTION_LIMIT] = {"limit", 0, VALUE_PAIR, IN_RENDER | IN_CHECK | IN_INFO | IN_TEST | IN_ACCEPT,
                      "NAME=VALUE", 0, 0, "what a scene may take, see above; with k, M or G; repeatable"},
    [OPTION_UNTRUSTED] = {"untrusted", 0, VALUE_NONE, IN_RENDER | IN_CHECK | IN_INFO | IN_TEST, NULL, 0, 0,
                          "the scene may include files of its own folder alone"},
    [OPTION_JSON] = {"json", 0, VALUE_NONE, IN_INFO, NULL, 0, 0, "as JSON, one object a scene"},
    [OPTION_GOLDEN] = {"golden", 0, VALUE_FILE, IN_TEST | IN_ACCEPT, "DIR", 0, 0,
                       "the folder of the goldens, with their golden.yaml and golden.lock; must be given"},
    [OPTION_TEST_OUTPUT] = {"output", 'o', VALUE_FILE, IN_TEST | IN_ACCEPT, "DIR", 0, 0,
                            "the folder of the last run; monge-test by default"},
    [OPTION_GOLDEN_KIND] =
        {"golden-kind", 0, VALUE_CHOICE, IN_TEST, "png|hash|both", 0, 0,
         "how goldens are kept, whatever golden.yaml says: pictures, lines of golden.lock, or both"},
    [OPTION_CHANGED] =
        {"changed", 0, VALUE_NONE, IN_TEST, NULL, 0, 0,
         "render only scenes whose text, options or program are not those of the golden, or of a run in "
         "which they were the same"},
    [OPTION_UPDATE_ONLY_FAILED] =
        {"update-only-failed", 0, VALUE_NONE, IN_TEST, NULL, 0, 0,
         "make the new pictures of what has failed the goldens, and touch no other golden"},
    [OPTION_OLD] = {"old", 0, VALUE_FILE, IN_TEST, "PROGRAM", 0, 0,
                    "the monge that made the goldens, to have a picture of those that are hashes"},
    [OPTION_TEST_JSON] = {"json", 0, VALUE_FILE, IN_TEST, "FILE|-", 0, 0, "write the results as JSON"},
    [OPTION_JUNIT] = {"junit", 0, VALUE_FILE, IN_TEST, "FILE|-", 0, 0,
                      "write the results as XML, as JUnit has it"},
    [OPTION_TAP] = {"tap", 0, VALUE_NONE, IN_TEST, NULL, 0, 0, "tell the results as TAP, version 13"},
    [OPTION_REPORT] = {"report", 0, VALUE_FILE, IN_TEST, "DIR", 0, 0,
                       "write the results with their pictures as one page, DIR/index.html"},
    [OPTION_PRUNE] = {"prune", 0, VALUE_NONE, IN_ACCEPT, NULL, 0, 0, "remove goldens whose scenes are gone"},
    [OPTION_CHECK_ONLY] = {"check", 0, VALUE_NONE, IN_FMT, NULL, 0, 0,
                           "write nothing; list what is not formatted, exit status 1 if any"},
    [OPTION_QUIET] = {"quiet", 'q', VALUE_NONE, IN_RENDER | IN_CHECK | IN_FMT | IN_DIFF | IN_TEST | IN_ACCEPT,
                      NULL, 0, 0, "report nothing but what is wrong"},
    [OPTION_MAN] = {"man", 0, VALUE_NONE, IN_HELP, NULL, 0, 0, "print the manual page, as roff"},
    [OPTION_COMPLETION] = {"completion", 0, VALUE_CHOICE, IN_HELP, "bash|zsh|fish", 0, 0,
                           "print the completion script of a shell"},
    [OPTION_HELP] = {"help", 'h', VALUE_NONE, IN_ALL, NULL, 0, 0, "show this help"},
    [OPTION_VERSION] = {"version", 'V', VALUE_NONE, IN_NONE, NULL, 0, 0, "show the version"},
};

static enum status version_command(const struct arguments *args) {
    if (args->count > 0) {
        say_usage(COMMAND_VERSION, "version: expected nothing more, found `%s`", args->operands[0]);
        return STATUS_TROUBLE;
    }
    printf("monge %s (sources %.12s)\n", monge_version(), monge_program());
    return STATUS_YES;
}

const char *const STATUS_DOC[] = {
    [STATUS_YES] = "all is well",
    [STATUS_NO] = ("a scene is wrong, not formatted (fmt --check) or not the same as its golden (test), the "
                   "others having been dealt with; or pictures differ (diff)"),
    [STATUS_TROUBLE] = "trouble: wrong usage, a file that cannot be read or written, no memory",
};

const char SIGNAL_DOC[] =
    "SIGINT (Ctrl-C), SIGTERM and SIGHUP end render and test by the signal, which a shell shows as 130, 143 "
    "and 129, "
    "after a line that tells what is done; another one, half a second later, ends them at once.";

const struct command_row COMMAND_TABLE[COMMANDS] = {
    [COMMAND_NONE] =
        {
            .name = "monge",
            .doc = "renders scenes that are data",
            .text = {"A scene is a YAML file that describes a camera, lights, materials and "
                     "transformed quadrics. Monge turns it into a PNG picture: the same bytes with "
                     "any number of threads and on any machine."},
        },
    [COMMAND_RENDER] =
        {
            .name = "render",
            .operands = "SCENE...",
            .doc = "render scenes to PNG pictures",
            .text =
                {"Renders each scene to NAME.png in the current folder; NAME is the scene's file name "
                 "without .yaml or .yml; of a scene below a folder that is given, the path from there; of "
                 "one that a pattern stands for, the path from the first part that varies; with --root, the "
                 "path from that folder. The options override what the scene says.",
                 SCENES_TEXT
                 "- is standard input: a list, if each of its entries names something that is "
                 "there or ends in .yaml or .yml, and else a scene; @- is always a list, and an "
                 "empty one is fine. A file that comes twice under the same name counts once. The "
                 "picture of a scene on standard input goes to standard output unless -o says "
                 "otherwise.",
                 "-o FILE names the picture of a single scene, with its extension. For several, and for a "
                 "folder, a pattern or a list of however many scenes, -o DIR/ puts the "
                 "pictures into a folder, which is made where it is missing, and in a pattern "
                 "{name} stands for NAME, and {{ for a {, }} for a }; folders of a pattern are made "
                 "too. A picture is complete under its name, or what was there before stays.",
                 "-D sets parameters of the scene. Lists make a sweep: -D a=1,2 -D b=x,y renders a=1 "
                 "with b=x, a=1 with b=y, a=2 with b=x, a=2 with b=y. Commas within brackets or quotes do "
                 "not split. In a "
                 "pattern {a} stands for the value of a; without -o pictures are called "
                 "NAME-a=1-b=x.png.",
                 "--frames renders frames of a scene with an `animation`; without it, the first. With "
                 "--frames all a "
                 "scene without one is rendered too, under its plain name, {frame} being 1. In "
                 "a pattern {frame} is the number, with leading zeros; so is one %d or %04d, and %% "
                 "is a %. Without -o, and in a folder, pictures are called NAME-0001.png.",
                 "--aov writes auxiliary passes beside the picture: NAME.object.png and so on, and "
                 "NAME.depth.pfm. They tell of each pixel which object and which material the ray "
                 "through its centre meets first, how far in front of the eye, with which normal, and "
                 "which point lights reach it there. " IN_DOCUMENTS(
                     "manual.md") " tells what is in the files.",
                 "-o - is standard output.",
                 "--stats and --log take no name of a scene or a picture (.yaml, .yml, .png), nor of a list "
                 "of "
                 "the run; what scenes include under other names is not known to them.",
                 "--jobs scenes are rendered at once, each on --threads threads; messages, the document of "
                 "--format, --log and "
                 "--stats keep the order of the batch, and of more than one picture a line at the end counts "
                 "what has become of them; what was asked for and is not there has failed. What fails does "
                 "not "
                 "keep the others from being rendered, unless --fail-fast is given.",
                 "--skip-unchanged leaves a picture alone that is whole and says, in its text chunks, that "
                 "this program made it of these files with these options; with --aov, its passes too. "
                 "--resume does "
                 "so as well, and for a picture that takes longer than a second keeps the tiles that are "
                 "done in .NAME.png.partial "
                 "beside it: the same command, given again after the first run was stopped in whatever way, "
                 "goes on from there, to the same bytes. The file goes when the picture is complete; it "
                 "counts for nothing where the scene, the settings or the program are no longer the same. "
                 "Of two runs for the same picture one keeps the tiles, and both make the picture. When a "
                 "signal ends a batch, it tells what is done; --stats and --log have that, and nothing of "
                 "what "
                 "was cut short.",
                 "--dry-run writes nothing: it prints `SCENE -> FILE: would be rendered`, with "
                 "--skip-unchanged or "
                 "--resume `: its text differs` or what else the reason is, or `unchanged`. Scenes are read "
                 "only "
                 "with --frames; what is wrong in others is for `monge check` to tell.",
                 "--progress json writes a line when the first picture is begun, for each that is done, at "
                 "most ten "
                 "a second when others are begun or pixels are done, and about one a second else: an object "
                 "with done, total, rendered, unchanged, failed (pictures), part (0 to "
                 "1), seconds, seconds_left (null: unknown), and running, a list of objects with scene, "
                 "output, "
                 "frame, pixels, of_pixels; --quiet is implied.",
                 "--log adds a line for each picture to a file, in the order of the batch: started (when the "
                 "run "
                 "began), pid (its process), scene, output, frame, params, status (rendered, unchanged, "
                 "failed), error (of a "
                 "failed "
                 "one: code, message, file, line, column), and what --stats has, with hashes. Lines whose "
                 "turn has "
                 "not come wait in .FILE.waiting beside it; after a kill the next run with this log moves "
                 "them "
                 "over.",
                 "With --format json or sarif everything that is wrong, with files too, comes as one "
                 "document on "
                 "standard error at the end, with --quiet implied; wrong usage is still told as "
                 "text. `monge help check` tells what is in it.",
                 LIMITS_TEXT},
            .examples = {{"monge render king.yaml", "writes king.png"},
                         {"monge render scenes/ -o pictures/ --size 320x240", "small pictures of many"},
                         {"monge render scenes/ -o pictures/ --resume --log pictures.log",
                          "a long batch: to be given again if it is stopped"},
                         {"monge render scenes/ -o pictures/ --resume --dry-run", "what that would render"},
                         {"monge render king.yaml -o 'draft-{name}.png' --shading diffuse --no-shadows",
                          "a quick look, in draft-king.png"},
                         {"monge render king.yaml -D roughness=0.1,0.2,0.4 -o 'king-{roughness}.png'",
                          "three pictures"},
                         {"monge render orbit.yaml --frames all -o orbit/", "orbit/orbit-0001.png and so on"},
                         {"generate | monge render - | display", "from a program to a program"}},
            .operand = "scene",
            .argument = ARGUMENT_SCENE,
            .run = render_command,
        },
    [COMMAND_CHECK] =
        {
            .name = "check",
            .operands = "SCENE...",
            .doc = "check scenes without rendering them",
            .text = {"Reads each scene and reports everything that is wrong with it on standard "
                     "error, each with its line and column; then `SCENE: ok`, or how many errors "
                     "there are, on standard output.",
                     "With --format json or sarif, standard output gets one document about all scenes "
                     "instead. JSON: an array of objects with file, line, column, endLine, "
                     "endColumn, severity (error, warning, failure), code, message, help, note and "
                     "related, a list of objects with file, line, column and message; null is what "
                     "there is not. SARIF 2.1.0: one run; failures, which have no place, are "
                     "notifications of the tool. Lines and columns count from 1, columns in characters, "
                     "an end is the first column behind.",
                     "With lists of values, as in -D a=1,2, each combination is checked.", LIMITS_TEXT,
                     SCENES_TEXT "The scene - is standard input."},
            .examples = {{"monge check --quiet scenes/", "a step of a build: silent where all is well"},
                         {"monge check --format sarif scenes/*.yaml > monge.sarif",
                          "for what shows SARIF beside the code"}},
            .operand = "scene",
            .argument = ARGUMENT_SCENE,
            .run = check_command,
        },
    [COMMAND_INFO] =
        {
            .name = "info",
            .operands = "SCENE...",
            .doc = "tell what scenes consist of, without rendering them",
            .text =
                {"Reads each scene and prints what has become of it: the picture's size, the camera as it is "
                 "framed, the lights, the bounds, how many primitives of each kind there are, the materials "
                 "with their uses, the memory that it takes and what each template costs.",
                 "Then the scene as a tree, each line with its place in the file. What a loop or a template "
                 "places many times is one line with a count; of more than 20 members the rest is counted.",
                 "Primitives are counted as they are kept, those of a template that is placed as a whole "
                 "once; "
                 "`placed` is their number with all of that carried out.",
                 "With --json: one object for each scene, with the same.",
                 SCENES_TEXT "The scene - is standard input."},
            .examples = {{"monge info king.yaml", "what king.yaml consists of"},
                         {"monge info --json king.yaml | jq .camera", "the camera that it is framed by"}},
            .operand = "scene",
            .argument = ARGUMENT_SCENE,
            .run = info_command,
        },
    [COMMAND_TEST] =
        {
            .name = "test",
            .operands = "[SCENE...]",
            .doc = "compare scenes with golden pictures",
            .text =
                {"Renders each scene and compares its picture with the golden of its name in the folder of "
                 "--golden: exactly, "
                 "unless the scene or DIR/golden.yaml states a tolerance with its reason. Tells what has "
                 "become of each: "
                 "same; changed; new, without a golden yet; missing, a golden that ought to be there; "
                 "orphan, a golden "
                 "whose scene is gone; broken, a scene that gives no picture.",
                 "A golden is a picture, DIR/NAME.png, or a line with its hash in DIR/golden.lock, or both. "
                 "DIR/golden.yaml may have rules: options of render for some scenes, tolerances, kinds of "
                 "goldens; and "
                 "`root`, the folder of the scenes, which names count from; --root goes before it. With it "
                 "scenes need not be given; without it names are as those of render.",
                 "The new pictures of what has failed, and results.json, are in the folder of the run, for "
                 "`monge accept` "
                 "to take. Orphans are looked for where no scenes are given, or folders alone, with a root "
                 "the root itself; a "
                 "golden "
                 "whose scene is still there, below the root or else in a folder of the run, one above it, "
                 "or elsewhere below the current one, is none.",
                 "A run that a signal ends writes what it has judged, for `monge accept` to take. --progress "
                 "is "
                 "that of render; in JSON, output is the golden.",
                 "Exit status 1 where anything is not the same. " IN_DOCUMENTS(
                     "testing.md") " has all of it.",
                 LIMITS_TEXT},
            .examples = {{"monge test scenes/ --golden goldens/", "all scenes of a folder"},
                         {"monge test scenes/ --golden goldens/ --update-only-failed",
                          "for the first goldens, or new ones"},
                         {"monge test --golden goldens/ --changed -q",
                          "before a commit, with `root` in golden.yaml"},
                         {"monge test --golden goldens/ --junit junit.xml --json -",
                          "for servers and programs"}},
            .argument = ARGUMENT_SCENE,
            .run = test_command,
        },
    [COMMAND_ACCEPT] =
        {
            .name = "accept",
            .operands = "[GLOB...]",
            .doc = "make new pictures of the last test the goldens",
            .text = {"Takes the new pictures of the last `monge test` with this folder of goldens, all or "
                     "those whose names "
                     "match a GLOB. One is left as it is where it is broken, or its scene, what that "
                     "includes, its "
                     "options or the program have changed since the run; a golden that did not fail is never "
                     "touched.",
                     "With --prune, goldens whose scenes were gone in that run are removed. Exit status 1 "
                     "where something "
                     "that was asked for is left as it is, with --dry-run where it would be."},
            .examples = {{"monge accept --golden goldens/", "all of them"},
                         {"monge accept --golden goldens/ --dry-run", "which that would be"},
                         {"monge accept 'gallery/*' --golden goldens/ --prune",
                          "some, and away with orphans"}},
            .run = accept_command,
        },
    [COMMAND_EXPLAIN] =
        {
            .name = "explain",
            .operands = "[CODE...]",
            .doc = "explain the code of an error or a warning",
            .text = {"Every message has a code in brackets, as in error[unknown-key]. Tells what it "
                     "means, why it matters and how to mend it, with a wrong and a right example. "
                     "Codes are stable, the words of messages are not.",
                     "Without a code: all codes, each with what it means in a sentence."},
            .examples = {{"monge explain unknown-key", "the story behind error[unknown-key]"},
                         {"monge explain | grep camera", "the codes that have to do with the camera"}},
            .argument = ARGUMENT_CODE,
            .run = explain_command,
        },
    [COMMAND_IMPORT] =
        {
            .name = "import",
            .operands = "FILE",
            .doc = "turn a scene of The Ray Tracer Challenge into one of ours",
            .text = {"Reads a scene in the YAML format of Jamis Buck's book The Ray Tracer Challenge, "
                     "a list of `add` and `define`, and writes it as a scene of this language. What "
                     "the language cannot say is left out or approximated, each with a warning and "
                     "its place on standard error.",
                     "The file is complete or absent, and absent when the scene is wrong. The FILE "
                     "- is standard input."},
            .examples = {{"monge import cover.yml -o cover.yaml", "writes cover.yaml"},
                         {"monge import cover.yml | monge render - -o cover.png", "straight to a picture"}},
            .operand = "scene",
            .argument = ARGUMENT_FILE,
            .run = import_command,
        },
    [COMMAND_FMT] =
        {
            .name = "fmt",
            .operands = "SCENE...",
            .doc = "lay scenes out in the canonical style",
            .text = {"Rewrites each scene with two spaces a level, one space after `:` and `,`, at most "
                     "one blank line, and lists and mappings in brackets that do not fit into 100 columns "
                     "as blocks. Values, comments and the order of keys stay as they are; quotes and "
                     "numbers are kept as written. A scene need not be right, but must be YAML.",
                     "A file that is formatted is not touched; another one is replaced as a whole. With "
                     "--check nothing is written, and the files that are not formatted are listed on "
                     "standard output.",
                     SCENES_TEXT
                     "Of a folder, files with definitions alone are formatted too. The scene - is "
                     "standard input, and goes to standard output."},
            .examples = {{"monge fmt scenes/", "in place"},
                         {"monge fmt --check scenes/",
                          "a step of a build: 1 where something is not formatted"},
                         {"monge fmt - < king.yaml | diff king.yaml -", "what it would change"}},
            .operand = "scene",
            .argument = ARGUMENT_SCENE,
            .run = fmt_command,
        },
    [COMMAND_DIFF] =
        {
            .name = "diff",
            .operands = "A B",
            .doc = "tell whether two pictures, or two folders of them, are the same, and how they differ",
            .text =
                {
                    "Two pictures are the same when they have the same size, bits a channel, colour space "
                    "and "
                    "pixels. Text, compression, and whether there is a palette do not count; grey is equal "
                    "red, "
                    "green and blue, a picture without alpha is opaque, and one that names no colour space "
                    "is sRGB, as is one of gAMA 45455 without other primaries. ICC profiles, which stand "
                    "before sRGB and gAMA, are the same where their bytes are; cICP is passed by. Any PNG "
                    "of at most 268435456 pixels will do. Prints a line about what differs; exit status 0 "
                    "where they are "
                    "the "
                    "same, 1 where they are not, 2 where one cannot be read or no pixel is left to compare. "
                    "Files with the same bytes are "
                    "the "
                    "same "
                    "without being decoded: that the pixels of both are damaged is not told.",
                    "Of two folders all PNG files below them are compared by their names, several at once; "
                    "what "
                    "is "
                    "hidden and links to folders are passed by. Prints a line for each that differs, beyond "
                    "the "
                    "limits where "
                    "some are given, or that one folder alone has, and one that counts; exit status 1 means "
                    "that "
                    "there are such. --out is then a folder, where each that is not the same gets its heat "
                    "map "
                    "under "
                    "its name; it may be no place where these would be among the pictures. A picture and a "
                    "folder: the picture of that name in the folder.",
                    "With --max-delta pixels differ where a channel does by more than that, on a scale from "
                    "0 "
                    "to 1; "
                    "with --max-pixels that many, or that part, may; with both, that many by more than that. "
                    "Bits a "
                    "channel may then differ.",
                    "--metric measures: exact (the part of the pixels that differ), max (the largest "
                    "difference "
                    "of a "
                    "channel), mae and rmse (the mean of the differences, the root of the mean of their "
                    "squares), "
                    "psnr (in decibels), ssim (structural similarity of luma, 0.299 R + 0.587 G + 0.114 B, 1 "
                    "for equal ones; Wang et al. "
                    "2004) "
                    "and flip (what is seen when they alternate, from 0 to 1; Andersson et al. 2020, --ppd "
                    "pixels "
                    "per degree; their order matters little). For ssim and flip, which are of what is seen, "
                    "pictures with alpha are looked at over black and over white, and the worse counts: of "
                    "flip at each pixel; the others compare alpha as one more channel, and colours that it "
                    "hides. Where it names none of exact and max, "
                    "--max-delta is a limit for what it names instead: mae, rmse, flip, 1 - ssim, the rmse "
                    "of "
                    "psnr; else it is the limit of channels alone. What is beyond is marked.",
                    "--ignore leaves out a rectangle, or what is neither black nor transparent in a PNG of "
                    "the "
                    "same size. A rectangle may reach over the edge, but not lie outside; to leave out all "
                    "is "
                    "an error. Where ssim and flip look around a pixel, what is left out is taken as equal.",
                    "--out writes a heat map: the first picture in dim grey, and what differs in colours "
                    "from "
                    "violet "
                    "by orange to pale yellow, the root of the largest difference of a channel, or of FLIP's "
                    "error with "
                    "--metric flip.",
                    "--json prints an object: same (as the exit status has it), why (what differs: size, "
                    "color space, bits, pixels "
                    "or null; with limits pixels before bits), a and b (file, width, height, bits, channels, "
                    "colorSpace), pixels "
                    "(compared), ignored, different, "
                    "beyond (by more than --max-delta), bounds and largest (where; null where nothing "
                    "differs), "
                    "and each "
                    "metric by its name. Without --metric these are exact and max. A metric is null where "
                    "the "
                    "pixels "
                    "cannot be compared; psnr, which is then infinite, also where all are the same. Of "
                    "folders "
                    "it "
                    "is a list of such objects, each with its name before. Where nothing could be compared, "
                    "same, why (trouble, or in folders missing), a and b (file; null where there is none) "
                    "are all."},
            .examples = {{"monge diff golden.png new.png", "exit status 0 where they are the same"},
                         {"monge diff before/ after/ --out heat/", "all of two folders, with heat maps"},
                         {"monge diff a.png b.png --max-delta 0.01 --max-pixels 0.1%",
                          "one pixel in a thousand may differ by more than 0.01"},
                         {"monge diff a.png b.png --metric flip --max-delta 0.02 --out heat.png",
                          "whether a viewer could tell, and where"},
                         {"monge diff a.png b.png --metric ssim,psnr --json | jq .ssim", "for programs"},
                         {"monge diff a.png b.png --ignore 0,0,120,20 --ignore mask.png",
                          "but for these pixels"}},
            .operand = "picture",
            .argument = ARGUMENT_PICTURE,
            .run = diff_command,
        },
    [COMMAND_SCHEMA] =
        {
            .name = "schema",
            .operands = "",
            .doc = "print the JSON Schema of scenes, for editors",
            .text = {"Prints what editors and validators need to complete, explain and check scenes, as "
                     "JSON Schema, draft-07. It knows the keys, the types and the ranges; `monge check` "
                     "knows what the names and the values mean as well."},
            .examples = {{"monge schema > scene.schema.json",
                          "for `# yaml-language-server: $schema=scene.schema.json` in a scene"}},
            .run = schema_command,
        },
    [COMMAND_VERSION] =
        {
            .name = "version",
            .operands = "",
            .doc = "show the version",
            .text = {"The same as monge --version."},
            .examples = {{"monge version", "as `monge 1.2.3`"}},
            .run = version_command,
        },
    [COMMAND_HELP] =
        {
            .name = "help",
            .operands = "[COMMAND|WORD|language WORD]",
            .doc = "tell how to use monge, or what a word of a scene means",
            .text = {"Without a word: what there is. The manual page and the completion scripts come "
                     "from the same table as this text. A word is any that a scene may have as a key, "
                     "the kind of one of its mappings, or what an expression may call or name; `language`, "
                     "`functions` and `presets` list what there is. Where a command is called so too, "
                     "`language WORD` is "
                     "the word of scenes. `monge --help` may stand for `monge help`."},
            .examples = {{"monge help render", "the options of render"},
                         {"monge help language", "a scene to begin with, and the kinds of mappings"},
                         {"monge help material", "the keys of a material, with types and defaults"},
                         {"monge help presets", "the materials that come with the program"},
                         {"source <(monge help --completion bash)", "completion in this shell"}},
            .argument = ARGUMENT_HELP,
            .run = help_command,
        },
};

/* What help calls a value tells what it is. */
enum argument option_argument(enum option_id option) {
    const struct option_row *row = &OPTION_TABLE[option];
    switch (row->kind) {
    case VALUE_CHOICE: return ARGUMENT_WORDS;
    case VALUE_CHOICES: return ARGUMENT_LIST;
    case VALUE_AREA: return ARGUMENT_PICTURE;
    case VALUE_PAIR: return option == OPTION_LIMIT ? ARGUMENT_LIMIT : ARGUMENT_NONE;
    case VALUE_FILE:
        if (strcmp(row->value, "MASK") == 0) return ARGUMENT_PICTURE;
        return strcmp(row->value, "DIR") == 0 ? ARGUMENT_FOLDER : ARGUMENT_FILE;
    default: return ARGUMENT_NONE;
    }
}

enum command_id command_find(const char *name) {
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++)
        if (strcmp(COMMAND_TABLE[c].name, name) == 0) return c;
    return COMMAND_NONE;
}

static bool looks_like_a_scene(const char *word) { return scene_extension(word) != NULL; }

enum status command_unknown(const char *name) {
    struct suggestion nearest = {.word = name};
    for (enum command_id c = COMMAND_NONE + 1; c < COMMANDS; c++)
        suggestion_try(&nearest, COMMAND_TABLE[c].name);
    const char *best = suggestion_best(&nearest);
    if (looks_like_a_scene(name))
        say_usage(COMMAND_NONE, "no command `%s`; did you mean `monge render %s`?", name, name);
    else if (best)
        say_usage(COMMAND_NONE, "no command `%s`; did you mean `%s`?", name, best);
    else
        say_usage(COMMAND_NONE, "no command `%s`", name);
    return STATUS_TROUBLE;
}

/* monge without a command. */
static enum status run_alone(const struct arguments *args) {
    if (args->option[OPTION_HELP].given)
        help_print(stdout, COMMAND_NONE);
    else if (args->option[OPTION_VERSION].given)
        return version_command(args);
    else {
        help_print(stderr, COMMAND_NONE);
        return STATUS_TROUBLE;
    }
    return STATUS_YES;
}

static enum status run(const struct arguments *args) {
    const struct command_row *row = &COMMAND_TABLE[args->command];
    if (args->command == COMMAND_NONE) return run_alone(args);
    if (args->option[OPTION_HELP].given) {
        help_print(stdout, args->command);
        return STATUS_YES;
    }
    if (args->count == 0 && row->operand) {
        say_usage(args->command, "%s: no %s given", row->name, row->operand);
        return STATUS_TROUBLE;
    }
    for (size_t i = 0; i < args->count; i++) {
        if (*args->operands[i]) continue;
        say_usage(args->command, "%s: an operand is empty", row->name);
        return STATUS_TROUBLE;
    }
    return row->run(args);
}

/* monge --help COMMAND, which may be any word of `monge help`. */
static bool asks_for_help(int argc, char **argv) {
    return argc > 1 && (strcmp(argv[0], "--help") == 0 || strcmp(argv[0], "-h") == 0) && argv[1][0] != '-';
}

enum status command_run(int argc, char **argv) {
    if (asks_for_help(argc, argv)) argv[0] = "help";
    const bool alone = argc == 0 || argv[0][0] == '-';
    const enum command_id command = alone ? COMMAND_NONE : command_find(argv[0]);
    if (!alone && command == COMMAND_NONE) return command_unknown(argv[0]);
    struct arguments args;
    const bool good = options_parse(command, alone ? argc : argc - 1, alone ? argv : argv + 1, &args);
    const enum status status = good ? run(&args) : STATUS_TROUBLE;
    options_free(&args);
    return status;
}
