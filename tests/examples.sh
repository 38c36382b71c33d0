#!/bin/sh
# Renders every scene of the manuals (```yaml blocks) and of scenes/ small: none may have an error or a warning.
#   tests/examples.sh [PROGRAM]
set -u
cd "$(dirname "$0")/.." || exit 2
program=$(realpath "${1:-build/monge}") || exit 2
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
passed=0 failed=0

for manual in README.md grammar/*.md; do
    awk -v base="$work/$(basename "$manual" .md)" '
        /^```yaml/ { file = sprintf("%s-line%d.yaml", base, NR); next }
        /^```/ { if (file) close(file); file = "" }
        file { print > file }' "$manual"
done

for scene in "$work"/*.yaml $(find scenes -name '*.yaml' | sort); do
    if "$program" render "$scene" --size 64x48 --samples 1 -o "$work/picture.png" 2>"$work/messages" &&
        ! grep -q 'warning\[\|error\[' "$work/messages"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED ${scene##*/}"
        cat "$work/messages"
    fi
done
[ "$passed" -gt 5 ] || { echo "FAILED: no examples found"; failed=$((failed + 1)); }
echo "examples: $passed passed, $failed failed"
[ "$failed" -eq 0 ]
