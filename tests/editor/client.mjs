// An editor as yaml-language-server sees it: JSON-RPC over the standard streams of the real server.
import { spawn } from "node:child_process";
import path from "node:path";
import { pathToFileURL } from "node:url";

export class Editor {
    #server;
    #answers = new Map(); // what waits, by the number of its request
    #diagnosed = new Map(); // what waits for diagnostics, by document
    #input = Buffer.alloc(0);
    #last = 0;

    // The schema is for all documents *.yaml.
    constructor(modules, schema) {
        const program = path.join(modules, "node_modules/yaml-language-server/bin/yaml-language-server");
        this.settings = {
            yaml: { schemas: { [pathToFileURL(path.resolve(schema)).href]: "*.yaml" }, schemaStore: { enable: false }, format: { enable: false } },
            http: {},
            "[yaml]": {},
            editor: {},
            files: {},
        };
        this.#server = spawn(process.execPath, [program, "--stdio"], { stdio: ["pipe", "pipe", "inherit"] });
        this.#server.stdout.on("data", (data) => this.#read(data));
        setTimeout(() => this.#giveUp("the server does not answer"), 300_000).unref();
        this.#server.on("exit", (code) => {
            if (code !== 0) this.#giveUp(`the server ended with ${code}`);
        });
    }

    async start() {
        await this.request("initialize", {
            processId: process.pid,
            rootUri: null,
            capabilities: {
                workspace: { configuration: true, didChangeConfiguration: { dynamicRegistration: true } },
                textDocument: {
                    completion: { completionItem: { snippetSupport: true, documentationFormat: ["markdown"] } },
                    hover: { contentFormat: ["markdown"] },
                    publishDiagnostics: {},
                },
            },
        });
        this.#notify("initialized", {});
        this.#notify("workspace/didChangeConfiguration", { settings: this.settings });
    }

    async stop() {
        await this.request("shutdown", null);
        this.#notify("exit", null);
    }

    request(method, params) {
        const id = ++this.#last;
        this.#send({ id, method, params });
        return new Promise((resolve, reject) => this.#answers.set(id, { resolve, reject }));
    }

    // Opens a document, by its name or its whole URI; its diagnostics.
    open(name, text) {
        const uri = name.startsWith("file:") ? name : `file:///scenes/${name}`;
        const diagnostics = new Promise((resolve) => this.#diagnosed.set(uri, resolve));
        this.#notify("textDocument/didOpen", { textDocument: { uri, languageId: "yaml", version: 1, text } });
        return diagnostics;
    }

    // Asks at a place of an open document: completion, hover.
    at(what, name, position) {
        return this.request(`textDocument/${what}`, { textDocument: { uri: `file:///scenes/${name}` }, position });
    }

    #giveUp(why) {
        console.log(`FAILED: ${why}`);
        this.#server.kill();
        process.exit(2);
    }

    #notify(method, params) {
        this.#send({ method, params });
    }

    #send(message) {
        const body = JSON.stringify({ jsonrpc: "2.0", ...message });
        this.#server.stdin.write(`Content-Length: ${Buffer.byteLength(body)}\r\n\r\n${body}`);
    }

    #read(data) {
        this.#input = Buffer.concat([this.#input, data]);
        for (;;) {
            const end = this.#input.indexOf("\r\n\r\n");
            const length = end < 0 ? NaN : Number(/Content-Length: (\d+)/i.exec(this.#input.subarray(0, end))[1]);
            if (!(this.#input.length >= end + 4 + length)) return;
            const body = this.#input.subarray(end + 4, end + 4 + length).toString();
            this.#input = this.#input.subarray(end + 4 + length);
            this.#take(JSON.parse(body));
        }
    }

    #take(message) {
        if (message.method === "textDocument/publishDiagnostics") {
            this.#diagnosed.get(message.params.uri)?.(message.params.diagnostics);
        } else if (message.method === "workspace/configuration") {
            this.#send({ id: message.id, result: message.params.items.map((item) => this.settings[item.section] ?? null) });
        } else if (message.method && message.id !== undefined) {
            this.#send({ id: message.id, result: null });
        } else if (this.#answers.has(message.id)) {
            const { resolve, reject } = this.#answers.get(message.id);
            this.#answers.delete(message.id);
            if (message.error) reject(new Error(message.error.message));
            else resolve(message.result);
        }
    }
}
