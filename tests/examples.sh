#!/bin/sh
# Renders every scene of the manuals (```yaml blocks) and of scenes/ small: none may have an error or a warning. One
# that begins with a comment `# NAME.yaml` has that name too, for those of the same manual to include.
#   tests/examples.sh [PROGRAM]
set -u
cd "$(dirname "$0")/.." || exit 2
program=$(realpath "${1:-build/monge}") || exit 2
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
passed=0 failed=0

for manual in README.md grammar/*.md; do
    folder=$work/$(basename "$manual" .md)
    mkdir -p "$folder"
    awk -v folder="$folder" '
        /^```yaml/ { file = sprintf("%s/line%d.yaml", folder, NR); first = 1; next }
        /^```/ { if (file) close(file); if (named) close(named); file = named = "" }
        file && first { first = 0; if (/^# [a-z]*[.]yaml$/) named = folder "/" $2 }
        file { print > file }
        named { print > named }' "$manual"
done

for scene in "$work"/*/*.yaml $(find scenes -name '*.yaml' | sort); do
    if "$program" render "$scene" --size 64x48 --samples 1 -o "$work/picture.png" 2>"$work/messages" &&
        ! grep -q 'warning\[\|error\[' "$work/messages"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED ${scene#"$work"/}"
        cat "$work/messages"
    fi
done
[ "$passed" -gt 5 ] || { echo "FAILED: no examples found"; failed=$((failed + 1)); }
echo "examples: $passed passed, $failed failed"
[ "$failed" -eq 0 ]
