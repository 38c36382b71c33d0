#!/bin/sh
# The scenes of scenes/ against their goldens, which are hashes in tests/golden/golden.lock, by `monge test`. Then each that
# has a picture in tests/golden/ small with 1, 2 and 5 threads, and in four regions: the same pixels.
#   tests/goldens.sh [PROGRAM] [--update]
#   tests/goldens.sh --list     only says what there is: NAME SCENE OPTIONS, a line each
# The run, with a report, stays in goldens/ beside the program; --update makes its new pictures the goldens, in the lock and
# in tests/golden/*.png, which are to be looked at: tests/unit/test_shown.c sees to it that they are those of the lock.
set -u
cd "$(dirname "$0")/.." || exit 2
program=build/monge update=''
list() {
    awk '/^#/ || !NF { next } { path = $1; options = ""; if (match($0, / options=/)) options = substr($0, RSTART + 9); print path, options }' \
        tests/golden/golden.lock |
        while read -r path options; do
            [ ! -f "tests/golden/$(basename "$path").png" ] || echo "$(basename "$path") scenes/$path.yaml${options:+ $options}"
        done
}
for word; do
    case $word in
    --update) update=1 ;;
    --list) list; exit 0 ;;
    -*) echo "usage: tests/goldens.sh [PROGRAM] [--update | --list]" >&2; exit 2 ;;
    *) program=$word ;;
    esac
done
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

"$program" test --golden tests/golden --output "$pictures/run" --report "$pictures/report" --tap \
    ${update:+--update-only-failed} >"$pictures/tap"
status=$?
passed=$(grep -c '^ok ' "$pictures/tap") failed=$(grep -c '^not ok ' "$pictures/tap")
if [ $status -ne 0 ] || [ "$failed" -ne 0 ]; then
    sed -n '/^not ok /,/^  \.\.\./p' "$pictures/tap"
    echo "The report is $pictures/report/index.html"
fi
[ $status -le 1 ] && [ "$passed" -gt 20 ] || failed=$((failed + 1))
if [ -n "$update" ]; then
    list | while read -r name path _; do
        new=$pictures/run/new/${path#scenes/} new=${new%.yaml}.png
        [ ! -f "$new" ] || cp "$new" "tests/golden/$name.png"
    done
fi

list >"$pictures/list"
while read -r name scene _; do
    check "$scene" '1, 2 and 5 threads' threads
    check "$scene" 'four regions' regions
done <"$pictures/list"

for picture in tests/golden/*.png; do
    grep -q "^$(basename "$picture" .png) " "$pictures/list" || { echo "FAILED $picture has no scene"; failed=$((failed + 1)); }
done
echo "goldens: $passed passed, $failed failed"
[ "$failed" -eq 0 ]
