#!/usr/bin/env bash
# Diagnostics for programs: tests/formats.sh [PROGRAM [--update]]. The documents about two scenes and two files that are
# missing are those of tests/formats/, byte for byte; with python3, their structure is tested on more of them.

. "$(dirname "$0")/lib/testing.sh"
export LC_ALL=C
update=$2 wanted=$project/tests/formats
cp "$wanted"/*.yaml .

version() { sed 's/^\(          "version": \)"[0-9.]*"/\1"x.y.z"/' "$1"; } # of monge, not of SARIF

# ---- The exact documents ----

for format in json sarif; do
    exits 2 check --format $format wrong.yaml ok.yaml absent.yaml $'100% "gr\xc3\xb6\xc3\x9fe"\xff.yaml'; no_err
    version out >expected.$format
    [ "$update" = --update ] && cp expected.$format "$wanted"
    ok "$format: the document" diff -u "$wanted/expected.$format" expected.$format
done

# ---- Where documents go ----

exits 1 check --format json wrong.yaml; cp out json
exits 0 check --format json ok.yaml; out_is '[]'; cp out empty
run check wrong.yaml; cp err text
run check --format text wrong.yaml; same err text # text is what there is without --format
exits 1 render --format json --size 8x8 wrong.yaml ok.yaml -o ./; no_out
there ok.png
same json err
"$monge" render --format sarif --size 8x8 ok.yaml -o - >/dev/full 2>full.sarif
ok "render: exit 2 where a picture cannot be written" [ $? -eq 2 ]
ok "render: a failure is a notification" grep -q '"id": "cannot-write"' full.sarif

# ---- Files that cannot be read, written or found ----

echo 'scene: [{sphere: {}}]' >still.yaml; cp still.yaml also.yaml; echo >file
codes() { python3 -c 'import json, sys; print(*[d["severity"] + " " + d["code"] for d in json.load(open(sys.argv[1]))], sep="; ")' "$1"; }
# fails CODES ARGS...: what `monge render --format json ARGS` has in its document, with exit 2 and nothing else on stderr.
fails() {
    exits 2 render --format json --size 8x8 "${@:2}"
    cp err failed.json
    have python3 && ok "$1: render ${*:2}" [ "$(codes failed.json)" = "$1" ]
}
fails 'failure no-match' 'x*.yaml' still.yaml
there still.png # the others are rendered
fails 'failure no-match' 'x*.yaml'
fails 'failure cannot-read' @none
fails 'failure cannot-make-folder' still.yaml -o file/
fails 'failure cannot-write' still.yaml -o none/x.png
fails 'failure cannot-write' still.yaml --stats none/x.json
fails 'failure cannot-write' still.yaml --log none/log
fails 'failure cannot-write' still.yaml --log /dev/full
fails 'failure cannot-write' still.yaml --stats /dev/full
fails 'failure no-frame; failure no-frame' still.yaml also.yaml --frames 2 -o '{name}-{frame}.png'
fails 'failure outside-region' still.yaml --region 4,4,8,8
fails 'failure limit-pixels' still.yaml --limit pixels=10
fails 'failure no-match; failure cannot-make-folder' 'x*.yaml' still.yaml -o file/
run check --format sarif 'x*.yaml'; out_has '"id": "no-match"'; cp out match.sarif
run check 'x*.yaml'
ok "a code in text as well" [ "$(cat err)" = 'monge: error[no-match]: x*.yaml: no file matches' ]

# ---- Structure ----

{ echo 'scene:'; for i in $(seq 60); do echo "  - sphere: {x$i: 1}"; done; } >many.yaml
cp many.yaml more.yaml
"$monge" check --format json many.yaml more.yaml wrong.yaml >many.json
"$monge" check --format sarif many.yaml >many.sarif
"$monge" check --format json "$project"/tests/errors/*.yaml >all.json
"$monge" check --format sarif "$project"/tests/errors/*.yaml >all.sarif
"$monge" check --format sarif "$PWD/wrong.yaml" >absolute.sarif
printf 'scene: []' | "$monge" check --format sarif - >stdin.sarif
printf 'scene:\n  - sphere: {raduis: 2}' | "$monge" check --format json - >stdin.json

structure() {
    python3 - <<'PYTHON'
import json, re

def read(name):
    with open(name, encoding="utf-8") as file:
        return json.load(file)

MEMBERS = ["file", "line", "column", "endLine", "endColumn", "severity", "code", "message", "help", "note", "related"]
def check_json(document):
    assert isinstance(document, list)
    for d in document:
        assert list(d) == MEMBERS, d
        assert d["severity"] in ("error", "warning", "failure", "note")
        assert isinstance(d["message"], str) and d["message"]
        if d["file"] is not None:
            assert d["line"] >= 1 and d["column"] >= 1 and d["endLine"] == d["line"] and d["endColumn"] >= d["column"]
        else:
            assert [d[m] for m in MEMBERS[:5]] == [None] * 5
        for r in d["related"]:
            assert list(r) == ["file", "line", "column", "message"]

def check_message(message):
    assert set(message) == {"text"} and message["text"]
    assert not re.search("[{}]", message["text"].replace("{{", "").replace("}}", "")), message

def check_location(location):
    physical = location["physicalLocation"]
    uri = physical["artifactLocation"]["uri"]
    assert re.fullmatch(r"(file:///)?([A-Za-z0-9._~/-]|%[0-9A-F]{2})+", uri), uri
    region = physical["region"]
    assert set(region) == {"startLine", "startColumn", "endLine", "endColumn"}
    assert 1 <= region["startLine"] == region["endLine"] and 1 <= region["startColumn"] <= region["endColumn"]

def check_sarif(document):
    assert set(document) == {"$schema", "version", "runs"} and document["version"] == "2.1.0"
    run, = document["runs"]
    assert set(run) == {"tool", "columnKind", "invocations", "results"}
    assert run["columnKind"] == "unicodeCodePoints"
    driver = run["tool"]["driver"]
    assert driver["name"] == "monge" and re.fullmatch(r"\d+\.\d+\.\d+", driver["version"])
    for rule in driver["rules"] + driver["notifications"]:
        assert set(rule) == {"id", "shortDescription", "fullDescription"}
        check_message(rule["shortDescription"])
        check_message(rule["fullDescription"])
    ids = [rule["id"] for rule in driver["rules"]]
    assert ids == sorted(set(ids)) and set(ids) == {r["ruleId"] for r in run["results"]}
    for result in run["results"]:
        assert result["level"] in ("error", "warning")
        check_message(result["message"])
        for location in result["locations"] + result.get("relatedLocations", []):
            check_location(location)
        for location in result.get("relatedLocations", []):
            check_message(location["message"])
    invocation, = run["invocations"]
    notifications = invocation["toolExecutionNotifications"]
    failed = [n for n in notifications if n["level"] == "error"]
    assert {n["descriptor"]["id"] for n in failed} == {rule["id"] for rule in driver["notifications"]}
    assert invocation["executionSuccessful"] == (not failed)
    for n in notifications:
        check_message(n["message"])

for name in ("json", "empty", "many.json", "all.json", "stdin.json", "expected.json", "failed.json"):
    check_json(read(name))
for name in ("many.sarif", "all.sarif", "absolute.sarif", "stdin.sarif", "full.sarif", "match.sarif"):
    check_sarif(read(name))

many = read("many.json")
assert len(many) == 50 + 50 + len(read("json")) + 1, len(many) # of each scene as many as of one alone
assert many[-1]["severity"] == "note" and many[-1]["message"] == "and 20 more"
assert read("many.sarif")["runs"][0]["invocations"][0]["toolExecutionNotifications"][0]["message"]["text"] == "and 10 more"

everything = read("all.json")
results = read("all.sarif")["runs"][0]["results"]
assert len(results) == sum(d["severity"] in ("error", "warning") for d in everything) > 300
for d, result in zip((d for d in everything if d["file"]), results):
    assert d["code"] == result["ruleId"]
    lines = [line for line in (d["message"], d["help"], d["note"]) if line]
    assert result["message"]["text"].replace("{{", "{").replace("}}", "}") == "\n".join(lines)

# Columns count code points.
with open("wrong.yaml", encoding="utf-8") as file:
    lines = file.read().split("\n")
key = next(d for d in read("json") if d["code"] == "unknown-key")
assert lines[key["line"] - 1][key["column"] - 1:key["endColumn"] - 1] == "raduis"
uri = read("absolute.sarif")["runs"][0]["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
assert uri.startswith("file:///")
assert read("stdin.json")[0]["file"] == "<stdin>"
PYTHON
}
if have python3; then ok "structure" structure; fi

told
