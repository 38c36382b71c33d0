#!/bin/sh
# Each tests/import/NAME.yml, in the format of "The Ray Tracer Challenge", becomes NAME.yaml with the messages
# of NAME.txt, byte for byte; that loads without an error and renders. A wrong one has no NAME.yaml, and
# leaves the file of -o as it is: tests/import.sh MONGE [--update]. --update writes both anew: read them.
monge=$(realpath "$1") || exit 2
update=$2
cd "$(dirname "$0")/import" || exit 2
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
passed=0 failed=0

fail() {
    failed=$((failed + 1))
    echo "FAILED $*"
}

for book in *.yml; do
    name=${book%.yml}
    echo before >"$work/out.yaml"
    "$monge" import "$book" -o "$work/out.yaml" >"$work/stdout" 2>"$work/messages" </dev/null
    status=$?
    if [ "$update" = --update ]; then
        cp "$work/messages" "$name.txt"
        [ $status -eq 0 ] && cp "$work/out.yaml" "$name.yaml"
    fi
    expected=0
    [ -e "$name.yaml" ] || expected=1
    if [ $status -ne $expected ] || ! cmp -s "$name.txt" "$work/messages" || [ -s "$work/stdout" ]; then
        fail "$book: exit code $status, expected $expected"
        diff -u "$name.txt" "$work/messages"
    elif [ $status -ne 0 ]; then
        if [ "$(cat "$work/out.yaml")" = before ]; then passed=$((passed + 1)); else fail "$book: wrong, but written"; fi
    elif ! diff -u "$name.yaml" "$work/out.yaml"; then
        fail "$book: not what it was"
    elif ! "$monge" render -q "$work/out.yaml" --size 24x16 -o "$work/out.png" 2>"$work/messages" ||
        grep -q 'error\[' "$work/messages"; then
        fail "$name.yaml does not render"
        cat "$work/messages"
    elif "$monge" import - <"$book" 2>/dev/null | sed 1d >"$work/piped" && # the first line has the name
        ! sed 1d "$work/out.yaml" | cmp -s - "$work/piped"; then
        fail "$book: not the same through standard streams"
    else
        passed=$((passed + 1))
    fi
done

echo "import: $passed passed, $failed failed"
[ "$passed" -gt 0 ] && [ "$failed" -eq 0 ]
