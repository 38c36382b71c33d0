// Counts what passed, tells what failed, and finds the scenes.
import fs from "node:fs";
import path from "node:path";

let passed = 0, failed = 0;

export function verdict(name, ok, why) {
    if (ok) passed++;
    else {
        failed++;
        console.log(`FAILED: ${name}${why ? `: ${why}` : ""}`);
    }
}

export function yamlFiles(folder) {
    return fs.readdirSync(folder, { recursive: true }).map(String).filter((name) => name.endsWith(".yaml")).sort()
        .map((name) => path.join(folder, name));
}

process.on("exit", (code) => {
    console.log(`${passed} passed, ${failed} failed`);
    if (failed > 0 && code === 0) process.exitCode = 1;
});
