#!/bin/sh
# Each tests/errors/NAME.yaml gives the messages of NAME.txt, byte for byte, and exit code 1; or 0 when
# they are warnings alone, or none: tests/errors.sh MONGE [--update]. --update writes the .txt anew: read them.
monge=$(realpath "$1") || exit 2
update=$2
cd "$(dirname "$0")/errors" || exit 2
found=$(mktemp) || exit 2
trap 'rm -f "$found"' EXIT
passed=0 failed=0

for scene in *.yaml; do
    want=${scene%.yaml}.txt
    "$monge" check "$scene" >/dev/null 2>"$found" </dev/null
    status=$?
    [ "$update" = --update ] && cp "$found" "$want"
    if [ ! -e "$want" ]; then
        failed=$((failed + 1))
        echo "FAILED $scene: $want is missing"
        continue
    fi
    expected=0
    grep -q -E '^[^ ]+: error\[' "$want" && expected=1
    if [ $status -eq $expected ] && cmp -s "$found" "$want"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $scene: exit code $status, expected $expected"
        diff -u "$want" "$found"
    fi
done
for want in *.txt; do
    [ -e "${want%.txt}.yaml" ] && continue
    failed=$((failed + 1))
    echo "FAILED $want: its scene is missing"
done

echo "errors: $passed passed, $failed failed"
[ "$passed" -gt 0 ] && [ "$failed" -eq 0 ]
