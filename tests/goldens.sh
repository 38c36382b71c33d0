#!/bin/sh
# Renders every scene of scenes/report/ and scenes/gallery/ and compares its pixels with tests/golden/NAME.png: they must be
# equal. Then renders each small with 1, 2 and 5 threads, and in four regions: again the same pixels.
#   tests/goldens.sh [PROGRAM] [--update]
#   tests/goldens.sh --list     only says what there is: NAME SCENE OPTIONS, a line each
# The new pictures stay in goldens/ beside the program; --update makes them the goldens. The golden of
# chess.yaml is the README's picture too: of the scene's own size.
set -u
cd "$(dirname "$0")/.." || exit 2
program=build/monge update='' list=''
for word; do
    case $word in
    --update) update=1 ;;
    --list) list=1 ;;
    -*) echo "usage: tests/goldens.sh [PROGRAM] [--update | --list]" >&2; exit 2 ;;
    *) program=$word ;;
    esac
done
scenes=$(ls scenes/report/*.yaml scenes/gallery/*.yaml scenes/presets.yaml)
# The repository should not swell: most goldens are half the size of their scene.
size_of() {
    case $(basename "$1" .yaml) in
    view1 | view2 | chess) ;;
    final) echo '--samples 16' ;;
    figure1) echo '--size 320x240' ;;
    king) echo '--size 270x360' ;;
    *) case $1 in scenes/report/*) echo '--size 360x240' ;; *) echo '--size 192x128 --samples 1' ;; esac ;;
    esac
}
if [ -n "$list" ]; then
    for file in $scenes; do echo "$(basename "$file" .yaml) $file $(size_of "$file")"; done
    exit 0
fi

[ -x "$program" ] || { echo "goldens: no program $program" >&2; exit 2; }
case $program in /*) ;; *) program=./$program ;; esac
pictures=$(dirname "$program")/goldens
small=$pictures/small
rm -rf "$pictures"
mkdir -p "$small" || exit 2

# shellcheck disable=SC2046
${CC:-cc} -O1 -o "$pictures/compare" tests/compare.c $(pkg-config --cflags --libs libpng 2>/dev/null || echo -lpng) || exit 2

passed=0 failed=0
# check SCENE WHAT COMMAND...: a test, passed when the command succeeds; else what it says is shown.
check() {
    scene=$1 what=$2
    shift 2
    if why=$("$@" 2>&1); then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $scene: $what: $why"
    fi
}

render() { "$program" render --quiet --progress never "$@"; }

# $size is options of render, or empty.
# shellcheck disable=SC2086
golden() {
    render "$scene" -o "$pictures/$name.png" $size || return
    [ -z "$update" ] || cp "$pictures/$name.png" "tests/golden/$name.png" || return
    [ -f "tests/golden/$name.png" ] || { echo "no golden tests/golden/$name.png"; return 1; }
    "$pictures/compare" "tests/golden/$name.png" "$pictures/$name.png"
}

threads() {
    for count in 1 2 5; do
        render "$scene" -o "$small/$name-$count.png" --size 120x90 --samples 2 --threads $count || return
        cmp "$small/$name-1.png" "$small/$name-$count.png" || return
    done
}

# The picture's parts, cut off the tiles' borders.
regions() {
    for part in 0,0,57,41 57,0,63,41 0,41,57,49 57,41,63,49; do
        x=${part%%,*} y=${part#*,} y=${y%%,*}
        render "$scene" -o "$small/$name-part.png" --size 120x90 --samples 2 --region $part || return
        "$pictures/compare" "$small/$name-1.png" "$small/$name-part.png" "$x" "$y" || return
    done
}

for file in $scenes; do
    name=$(basename "$file" .yaml)
    size=$(size_of "$file")
    scene=$file
    check "$file" 'the golden picture' golden
    check "$file" '1, 2 and 5 threads' threads
    check "$file" 'four regions' regions
done

for picture in tests/golden/*.png; do
    name=$(basename "$picture" .png)
    [ -n "$(find scenes -name "$name.yaml")" ] || { echo "FAILED $picture has no scene"; failed=$((failed + 1)); }
done
[ "$passed" -gt 0 ] || [ "$failed" -gt 0 ] || { echo "FAILED: no scenes found"; failed=1; }
echo "goldens: $passed passed, $failed failed"
[ "$failed" -eq 0 ]
