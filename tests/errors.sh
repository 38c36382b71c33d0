#!/usr/bin/env bash
# Each tests/errors/NAME.yaml gives the messages of NAME.txt, byte for byte, and exit code 1; or 0 when
# they are warnings alone, or none: tests/errors.sh [PROGRAM [--update]]. --update writes the .txt anew: read them.

. "$(dirname "$0")/lib/testing.sh"
update=$2 wanted=$project/tests/errors
cp -R "$wanted"/. .

# gives TEXT: whether the messages are those of the file, and the exit status that of them.
gives() {
    local expected=0
    grep -q -E '^[^ ]+: error\[' "$1" && expected=1
    diff -u "$1" err && [ "$status" -eq $expected ]
}
for scene in *.yaml; do
    want=$wanted/${scene%.yaml}.txt
    run check "$scene"
    [ "$update" = --update ] && cp err "$want"
    ok "$scene" gives "$want"
done
for want in *.txt; do
    [ -e "${want%.txt}.yaml" ] || ok "$want has its scene" false
done

told
