#!/bin/sh
# monge info tells what is in tests/info/NAME.txt of each tests/info/NAME.yaml, and the same numbers as JSON:
#   tests/info.sh MONGE [--update]
# Bytes are left out: they differ between machines. --update writes the .txt anew: read them.
monge=$(realpath "$1") || exit 2
update=$2
cd "$(dirname "$0")/info" || exit 2
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
passed=0 failed=0

check() { # check NAME COMMAND...
    name=$1
    shift
    if "$@" >"$work/said" 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $name"
        sed 's/^/    /' "$work/said"
    fi
}

without_bytes() { sed -E '/^memory/d; s/, [0-9.]+ (bytes|KiB|MiB|GiB)$//'; }

for scene in *.yaml; do
    want=${scene%.yaml}.txt
    "$monge" info "$scene" 2>"$work/errors" </dev/null | without_bytes >"$work/found"
    [ "$update" = --update ] && cp "$work/found" "$want"
    check "$scene" diff -u "$want" "$work/found"
    check "$scene: silent on standard error" cmp "$work/errors" /dev/null
    "$monge" info --json "$scene" >"$work/json" 2>&1 </dev/null
    stored=$(sed -n -E 's/^primitives +([0-9,]+).*/\1/p' "$want" | tr -d ,)
    check "$scene: as many primitives in JSON" grep -q "^  \"primitives\": {\"stored\": $stored," "$work/json"
    if command -v python3 >/dev/null; then check "$scene: JSON" python3 -m json.tool "$work/json"; fi
done

printf 'scene: [{spere: {}}]\n' >"$work/wrong.yaml"
"$monge" info "$work/wrong.yaml" >"$work/out" 2>"$work/errors"
check "a wrong scene: exit code 1" [ $? -eq 1 ]
check "a wrong scene: nothing on standard output" cmp "$work/out" /dev/null
check "a wrong scene: why" grep -qF 'error[unknown-key]' "$work/errors"
"$monge" info "$work/none.yaml" >"$work/out" 2>"$work/errors"
check "no file: exit code 2" [ $? -eq 2 ]

echo "info: $passed passed, $failed failed"
[ "$passed" -gt 0 ] && [ "$failed" -eq 0 ]
