#!/usr/bin/env bash
# monge info tells what is in tests/info/NAME.txt of each tests/info/NAME.yaml, and the same numbers as JSON:
#   tests/info.sh [PROGRAM [--update]]
# Bytes are left out: they differ between machines. --update writes the .txt anew: read them.

. "$(dirname "$0")/lib/testing.sh"
update=$2 wanted=$project/tests/info
cp "$wanted"/*.yaml .

without_bytes() { sed -E '/^memory/d; s/, [0-9.]+ (bytes|KiB|MiB|GiB)$//'; }

for scene in *.yaml; do
    want=$wanted/${scene%.yaml}.txt
    run info "$scene"
    without_bytes <out >found
    [ "$update" = --update ] && cp found "$want"
    ok "$scene" diff -u "$want" found
    no_err
    run info --json "$scene"
    stored=$(sed -n -E 's/^primitives +([0-9,]+).*/\1/p' "$want" | tr -d ,)
    out_has "  \"primitives\": {\"stored\": $stored,"
    if have python3; then ok "$scene: JSON" python3 -m json.tool out; fi
done

printf 'scene: [{spere: {}}]\n' >wrong.yaml
exits 1 info wrong.yaml; no_out; err_has 'error[unknown-key]'
exits 2 info none.yaml

told
