#!/bin/sh
# grammar/scene.schema.json against the scenes, the loader's mistakes and yaml-language-server: tests/schema.sh MONGE
# The packages are in NODE_FOLDER, where `make test` has put them; without them nothing is tested, but with CI set that fails.
folder=${NODE_FOLDER:-build/editor}
if ! command -v node >/dev/null 2>&1 || [ ! -e "$folder/installed-lock.json" ]; then
    echo "NOT TESTED: no node, or no packages in $folder (tools/deps --editor $folder)"
    echo "0 passed, 0 failed"
    [ -z "$CI" ]
    exit
fi
found=$(mktemp) || exit 2
trap 'rm -f "$found"' EXIT
for part in validate editor; do
    node "tests/editor/$part.mjs" "$folder" grammar/scene.schema.json || echo "$part ended with $?"
done >"$found"
for scene in tests/editor/rejected/*.yaml; do
    "$1" check -q "$scene" >/dev/null 2>&1
    status=$?
    if [ $status -eq 1 ]; then echo "1 passed, 0 failed"; else echo "FAILED: check $scene is $status"; echo "0 passed, 1 failed"; fi
done >>"$found"
grep -v -E '^[0-9]+ passed, [0-9]+ failed$' "$found"
awk '/ passed, / { passed += $1; failed += $3; parts++ }
     / ended with / && !/ ended with 1$/ { failed++ }
     END { if (parts < 3) failed++; print passed + 0 " passed, " failed + 0 " failed"; exit failed > 0 || passed == 0 }' "$found"
