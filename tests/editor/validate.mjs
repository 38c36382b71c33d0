// Scenes and grammar/scene.schema.json: what the loader accepts validates, what it refuses for a reason that
// a schema can see does not: node validate.mjs MODULES SCHEMA
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { verdict, yamlFiles } from "./report.mjs";

const require = createRequire(path.resolve(process.argv[2], "index.js"));
const Ajv = require("ajv");
const YAML = require("yaml");
const validate = new Ajv({ strict: false, allErrors: false }).compile(JSON.parse(fs.readFileSync(process.argv[3], "utf8")));

// The codes of mistakes that a schema can see.
const CATCHABLE = new Set(`unknown-key missing-key no-value one-of-them no-alternative contradiction not-there-yet
    not-a-mapping not-a-list not-a-map not-a-row not-a-matrix not-a-number not-a-color not-a-choice not-a-boolean not-a-text
    wrong-count out-of-range not-whole color-of-bytes null-direction`.split(/\s+/));

// Scenes whose mistakes have such codes and still cannot be seen, with the reason.
const EXCEPTIONS = {
    color_grey_variable: "only the loader knows what a parameter stands for",
    color_unknown: "a word may be the name of a parameter",
    expr_names: "a word may be the name of a parameter",
    expr_values: "only the loader knows what an expression gives",
    include_mistakes: "they are in the included file",
    include_not_mapping: "the included file is none",
    keyframes_still: "a word may be the name of a parameter; that keyframes need an animation, no kind of the definition says",
    number_octal: "0x1f and 0o17 are numbers to YAML, and 010 is ten",
    number_text: "a word may be the name of a parameter",
    objects_variable: "what an argument must be, the template tells where it uses it",
    param_range_template: "values of parameters and their ranges, which a schema cannot compare",
    param_value: "only the loader knows what a parameter stands for",
    point_words: "a word may be the name of a parameter",
    scope_template: "a word may be the name of a parameter",
    size_expression: "only the loader knows what an expression gives",
    text_long: "a word may be the name of a parameter",
    text_long_utf8: "a word may be the name of a parameter",
    tolerance_nothing: "any one of the bounds will do",
    tolerance_pixels: "pixels are a text with or without %",
    tolerance_pixels_over: "the same",
    tolerance_pixels_part: "the same",
};

function read(text) {
    return YAML.parse(text, { merge: true, maxAliasCount: 10000, logLevel: "silent" });
}

function problem(text) {
    try {
        return validate(read(text)) ? null : `${validate.errors[0].instancePath}: ${validate.errors[0].message}`;
    } catch (error) {
        return `not YAML: ${error.message}`;
    }
}

const codes = (txt) => [...txt.matchAll(/^[^ ]+: error\[([a-z-]+)\]/gm)].map((match) => match[1]);

for (const file of [...yamlFiles("scenes"), ...yamlFiles("tests/editor/accepted")]) {
    const wrong = problem(fs.readFileSync(file, "utf8"));
    verdict(`${file} validates`, !wrong, wrong);
}
for (const file of ["README.md", "grammar/manual.md"])
    for (const [, text] of fs.readFileSync(file, "utf8").matchAll(/^```yaml\n(.*?)^```/gms))
        verdict(`an example of ${file} validates`, !problem(text), `${problem(text)}\n${text}`);
const example = read(fs.readFileSync("grammar/language.yaml", "utf8")).kinds.file.example;
verdict("the language's example validates", !problem(example), problem(example));

for (const file of yamlFiles("tests/editor/rejected"))
    verdict(`${file} does not validate`, problem(fs.readFileSync(file, "utf8")) !== null);

for (const file of yamlFiles("tests/errors").filter((file) => path.dirname(file) === "tests/errors")) { // not what they include
    const found = codes(fs.readFileSync(file.replace(/\.yaml$/, ".txt"), "utf8"));
    const wrong = problem(fs.readFileSync(file, "utf8"));
    const name = path.basename(file, ".yaml");
    const catchable = found.filter((code) => CATCHABLE.has(code));
    if (found.length === 0) verdict(`${file} validates`, !wrong, wrong);
    else if (name in EXCEPTIONS) verdict(`${file} is still an exception`, !wrong && catchable.length > 0, wrong ?? found.join(" "));
    else if (catchable.length > 0)
        verdict(`${file} does not validate`, wrong !== null, `it has ${catchable.join(" ")}; if a schema cannot see that, it belongs to EXCEPTIONS`);
}
for (const name in EXCEPTIONS) verdict(`the exception ${name} is a scene`, fs.existsSync(`tests/errors/${name}.yaml`));

// Settings of goldens: the same definitions by another door.
const ajv = new Ajv({ strict: false });
ajv.addSchema(JSON.parse(fs.readFileSync(process.argv[3], "utf8")), "scene.schema.json");
const goldens = ajv.compile(JSON.parse(fs.readFileSync(path.join(path.dirname(process.argv[3]), "golden.schema.json"), "utf8")));
const settings = read(fs.readFileSync("tests/golden/golden.yaml", "utf8"));
verdict("tests/golden/golden.yaml validates", goldens(settings), goldens.errors?.[0]?.message);
for (const wrong of [{ kidn: "png" }, { kind: "jpg" }, { rules: [{ options: "--samples 1" }] }, { rules: [{ scenes: "a", tolerance: { max: 0.1 } }] }])
    verdict(`${JSON.stringify(wrong)} does not validate as settings of goldens`, !goldens(wrong));
