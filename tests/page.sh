#!/bin/sh
# The report of `monge test` in Chromium: tests/page.sh MONGE
# The packages are in BROWSER_FOLDER, where `make test` has put them; without them, or without Chromium, nothing is tested,
# but with CI set that fails. Screenshots to look at are in page/ beside the program.
monge=$1 folder=${BROWSER_FOLDER:-build/browser}
if ! command -v node >/dev/null 2>&1 || ! { command -v chromium || command -v chromium-browser; } >/dev/null 2>&1 ||
    [ ! -e "$folder/installed-lock.json" ]; then
    echo "NOT TESTED: no node, no chromium, or no packages in $folder (tools/deps --browser $folder)"
    echo "0 passed, 0 failed"
    [ -z "$CI" ]
    exit
fi
case $monge in /*) ;; *) monge=$PWD/$monge ;; esac
shots=$(dirname "$monge")/page drive=$PWD/tests/browser/page.mjs
mkdir -p "$shots" || exit 2
scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
folder=$(realpath "$folder") shots=$(realpath "$shots")
cd "$scratch" || exit 2

mkdir scenes
scene() { printf 'image: {size: [60, 40], background: "%s"}\ncamera: {eye: [0, 1, 6], look_at: [0, 0, 0]}\nscene:\n%s\n' "$2" "$3" >"scenes/$1.yaml"; }
scene moved '#203040' '  - {sphere: {}, name: ball}'
scene painted '#203040' '  - {sphere: {}, name: ball, material: {diffuse: tomato}}'
scene still '#102030' '  - sphere: {}'
mkdir goldens
printf 'rules: [{scenes: "*", aov: true}]\n' >goldens/golden.yaml
"$monge" test scenes --golden goldens --update-only-failed -q >/dev/null 2>&1 # the goldens
scene moved '#203040' '  - {sphere: {center: [0.4, 0, 0]}, name: ball}'
scene painted '#204060' '  - {sphere: {}, name: ball, material: {diffuse: gold}}'
scene fresh '#302010' '  - {box: {}}'
scene bad '#203040' '  - {sphere: {radios: 1}}'
"$monge" test scenes --golden goldens --report report >said 2>&1
status=$?
[ $status -eq 1 ] || { echo "FAILED: monge test is $status:"; cat said; echo "0 passed, 1 failed"; exit 1; }
node "$drive" "$folder" report/index.html "$shots"
