// What an editor shows of scenes, asked of the real yaml-language-server: node editor.mjs MODULES SCHEMA
import fs from "node:fs";
import { pathToFileURL } from "node:url";
import { Editor } from "./client.mjs";
import { verdict, yamlFiles } from "./report.mjs";

const editor = new Editor(process.argv[2], process.argv[3]);
let opened = 0;

// The place of the bar in a text, and the text without it.
function cut(marked) {
    const before = marked.slice(0, marked.indexOf("|")).split("\n");
    return { text: marked.replace("|", ""), position: { line: before.length - 1, character: before.at(-1).length } };
}

async function ask(what, marked) {
    const { text, position } = cut(marked);
    const name = `asked-${++opened}.yaml`;
    await editor.open(name, text);
    return editor.at(what, name, position);
}

// Among what is offered at the bar are all of `wanted` and none of `unwanted`, and nothing twice.
async function offers(marked, wanted, unwanted = []) {
    const labels = (await ask("completion", marked)).items.map((item) => item.label);
    const missing = wanted.filter((word) => !labels.includes(word));
    const wrong = labels.filter((word, i) => unwanted.includes(word) || labels.indexOf(word) !== i);
    verdict(`completion in ${JSON.stringify(marked)}`, missing.length + wrong.length === 0,
        `missing: ${missing}; not wanted or twice: ${wrong}; found: ${labels}`);
}

// The text that is inserted for a word.
async function inserts(marked, word, wanted) {
    const item = (await ask("completion", marked)).items.find((one) => one.label === word);
    verdict(`\`${word}\` in ${JSON.stringify(marked)} inserts ${JSON.stringify(wanted)}`, item?.insertText === wanted, item?.insertText);
}

async function shows(marked, ...wanted) {
    const shown = (await ask("hover", marked))?.contents.value ?? "nothing";
    const missing = wanted.filter((text) => !shown.includes(text));
    verdict(`hover in ${JSON.stringify(marked)}`, missing.length === 0, `\`${missing}\` is not in: ${shown}`);
}

// The diagnostics of the text are `message` for exactly the part between two bars; none where there are none.
async function marks(marked, message) {
    const start = cut(marked), end = cut(start.text);
    const found = await editor.open(`marked-${++opened}.yaml`, end.text);
    const exact = found.filter((d) => d.message.includes(message) && JSON.stringify(d.range) === JSON.stringify({ start: start.position, end: end.position }));
    verdict(`a mark in ${JSON.stringify(marked)}`, exact.length === 1, JSON.stringify(found.map((d) => [d.range, d.message])));
}

async function marksNothing(name, text) {
    const found = await editor.open(`plain/${name}`, text);
    verdict(`${name} has no marks`, found.length === 0, JSON.stringify(found.map((d) => [d.range, d.message])));
}

// A document that names its schema itself, in a comment.
async function marksByModeline() {
    const text = "# yaml-language-server: $schema=grammar/scene.schema.json\nscene: [{sphere: {raduis: 2}}]";
    const found = await editor.open(pathToFileURL("modeline.yml").href, text);
    verdict("a comment names the schema", found.length === 1 && found[0].message.includes("raduis"), JSON.stringify(found));
    const without = await editor.open(pathToFileURL("none.yml").href, text.replace("$schema", "schema"));
    verdict("without it there is none", without.length === 0, JSON.stringify(without));
}

await editor.start();
await Promise.all([
    offers("|", ["scene", "camera", "materials", "define", "animation"], ["sphere"]),
    offers("scene:\n  - |", ["sphere", "box", "group", "material", "use", "for"], ["ellipsoid", "difference", "radius"]),
    offers("scene:\n  - sphere:\n      |", ["center", "radius"], ["size"]),
    offers("scene:\n  - sphere: {}\n    |", ["material", "transform", "name"], ["sphere"]),
    offers("scene:\n  - sphere: {}\n    material:\n      |", ["diffuse", "shininess", "preset"], ["radius"]),
    offers("scene:\n  - sphere: {}\n    transform:\n      - |", ["translate", "rotate", "scale"], ["axis"]),
    offers("define:\n  leg:\n    objects:\n      - |\nscene: []", ["sphere", "when"]),
    offers("render:\n  |\nscene: []", ["shading", "depth", "two_sided"]),
    offers("render:\n  shading: |\nscene: []", ["phong", "diffuse", "signature"]),
    offers("params: {mode: phong}\nrender:\n  shading: |\nscene: []", ["phong", "diffuse", "signature"]),
    offers("scene:\n  - cylinder:\n      open: |", ["true", "false"]),
    offers("image:\n  background: |\nscene: []", ["white", "rebeccapurple"]),
    inserts("render:\n  |\nscene: []", "shading", "shading: ${1:phong}"),
    inserts("scene:\n  - |", "box", "box:\n    "),
    inserts("scene:\n  - sphere:\n      center: |", "[0, 0, 0]", "[${1:0}, ${2:0}, ${3:0}]"),
    shows("scene:\n  - sphere: {rad|ius: 2}", "Its radius.", "over 0, scene units", "default: 1"),
    shows("scene:\n  - sph|ere: {radius: 2}", "A ball."),
    shows("render: {sha|ding: phong}\nscene: []", "is the whole model", "signature"),
    shows("scene:\n  - sphere: {}\n    mat|erial: gold", "A name of `materials`"),
    shows("scene:\n  - sphere: {}\n    mat|erial: {diffuse: red}", "A name of `materials`"),
    shows("image: {background: {bot|tom: white, top: red}}\nscene: []", "The colour straight down."),
    shows("scene:\n  - {sphere: {}, f|or: {i: 9}}", "Repeats the object", "Example: `for:"),
    marks("scene:\n  - sphere: {|raduis|: 2}", "raduis is not allowed"),
    marks("scene:\n  - sphere: {}\n    |colour|: red", "colour is not allowed"),
    marks("materials: {a: {|difuse|: red}}\nscene: []", "difuse is not allowed"),
    marks("materials: {a: &a {diffuse: red}, b: {<<: {|difuse|: red}}}\nscene: []", "difuse is not allowed"),
    marks("define: {leg: {objects: [{sphere: {|raduis|: 1}}]}}\nscene: []", "raduis is not allowed"),
    marks("render: {shading: |phnog|}\nscene: []", "Valid values"),
    marks("scene: [{sphere: {radius: |45deg|}}]", "not an expression"),
    marks("scene: [{sphere: {radius: |-1|}}]", "minimum of 0"),
    marks("scene: [{sphere: |big|}]", "not a mapping"),
    marks("scene: [{cylinder: {open: |yes|}}]", "not true or false"),
    marks("scene: |sphere|", "not a list"),
    marks("scene: [{sphere: {}, |box|: {}}]", "an object is one of them"),
    marks("scene: []\nlights: [{area: |{}|}]", "not there yet"),
    marks("camera: {look_at: [0, 0, 0], |direction|: [0, 0, 1]}\nscene: []", "contradicts `look_at`"),
    marks("camera: {direction: |[0, 0, 0]|}\nscene: []", "no direction"),
    marks("materials: {a: {diffuse: |[255, 0, 0]|}}\nscene: []", "linear"),
    marksByModeline(),
    marksNothing("anchors.yaml", "materials: {a: &a {diffuse: red}, b: {<<: *a, specular: white}}\nscene: [{sphere: &s {radius: 2}}, {sphere: *s}, {sphere: {<<: *s, radius: 3}}]"),
    ...["scenes", "tests/editor/accepted"].flatMap(yamlFiles).map((file) => marksNothing(file, fs.readFileSync(file, "utf8"))),
]);
await editor.stop();
