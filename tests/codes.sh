#!/usr/bin/env bash
# The codes of diagnostics: src/ and grammar/diagnostics.yaml have the same ones, each is seen in a test, and the
# examples give what they say: tests/codes.sh BUILD/monge
monge=$(realpath "$1") || exit 2
tool=$(dirname "$monge")/tools/diagnostics
cd "$(dirname "$0")/.." || exit 2
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
passed=0 failed=0

# Explained already, not used in src/ yet.
pending=''

# Not in the expected texts of tests/errors/ and tests/import/: what no scene gives.
elsewhere='
bad-picture         no scene: tests/diff.sh
cannot-make-folder  no scene: tests/batch.sh
cannot-read         no scene: tests/formats/expected.json
cannot-write        no scene: tests/formats.sh
format-differs      a mistake in Monge, none is known that gives it: tests/unit/test_format.c
given-twice         an option: tests/cli.sh
include-outside     a scene of a stranger: tests/unit/test_diagnostics.c
limit-file-bytes    a file of over 1 GiB: tests/unit/test_diagnostics.c
limit-instances     a render, which check has not: tests/cli.sh
limit-memory        a scene of over 8 GiB: tests/unit/test_diagnostics.c
limit-objects       more primitives than there is memory for: tests/unit/test_scene_mistakes.c
limit-pixels        an option: tests/cli.sh
no-frame            an option: tests/cli.sh
no-match            no scene: tests/batch.sh
nothing-compared    no scene: tests/diff.sh
odd-key             for monge fmt alone: tests/fmt.sh
out-of-memory       a system without memory: tests/unit/test_memory.c
outside-region      an option: tests/cli.sh
unknown-parameter   a value from outside: tests/unit/test_diagnostics.c
'

check() { # check NAME COMMAND...: a test that passes when the command succeeds.
    if "${@:2}" >"$work/said" 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $1"
        sed 's/^/    /' "$work/said"
    fi
}
same() { diff -u "$1" "$2"; }
words() { tr -s ' ' '\n' <<<"$1" | grep . | sort -u; }

# ---- The same codes in src/ and in the definition ----

# The first text of a call is its code; and, but for the import, every text that looks like one: some are passed on.
# `beyond` is what only_counted gives to a list that is full: it is never kept.
codes_of_src() {
    cat src/*.c src/{base,lang,scene,render,cli,cli/golden}/*.c | tr '\n' ' ' |
        grep -oE '(diag|report)_(error|warning|failure)\([^"]*"[a-z]+(-[a-z]+)*"' | grep -oE '"[a-z-]+"$' | tr -d '"'
    find src/lang src/scene src/*.c -name '*.c' ! -name 'import_*.c' -exec cat {} + |
        grep -oE '"[a-z]+(-[a-z]+)+"' | tr -d '"'
}
codes_of_src | grep -vx beyond | sort -u >"$work/src"

"$tool" examples grammar/diagnostics.yaml "$work/example" || exit 1
cut -f1 "$work/example" >"$work/all"
words "$pending" >"$work/pending"
comm -23 "$work/all" "$work/pending" >"$work/defined"
check "src/ (-) and grammar/diagnostics.yaml (+) have the same codes" same "$work/src" "$work/defined"
check "what is pending is explained and not in src/ yet" \
    [ -z "$(comm -23 "$work/pending" "$work/all"; comm -12 "$work/pending" "$work/src")" ]
check "there are codes" [ "$(wc -l <"$work/defined")" -gt 50 ]

# ---- Each is seen ----

seen() { cat tests/{errors,import}/*.txt | grep -oE '(error|warning)\[[a-z-]+\]' | sed 's/.*\[\(.*\)\]/\1/' | sort -u; }
seen >"$work/seen"
awk 'NF { print $1 }' <<<"$elsewhere" | sort >"$work/elsewhere"
comm -23 "$work/defined" "$work/elsewhere" >"$work/scenes"
check "tests/errors/ and tests/import/ (-) have each of the codes (+)" same "$work/seen" "$work/scenes"

while read -r code why; do
    file=$(grep -o 'tests/[^ ]*' <<<"$why") && check "$code is in $file" grep -qw -e "$code" "$file"
done <<<"$elsewhere"

# ---- Each text is seen ----

# The texts in the calls that report, as `FILE:LINE<tab>regular expression`: what is filled in matches anything.
texts_of_src() {
    awk '
    function flush() {
        if (length(text) > 2 && text !~ /^[a-z]+(-[a-z]+)+$/) print FILENAME ":" line "\t" pattern(text)
        text = ""
    }
    function pattern(text) {
        gsub(/\\"/, "\"", text)
        gsub(/\\\\/, "\\", text)
        gsub(/[][\\.*^$(){}+?|]/, "[&]", text)
        gsub(/\[\^\]/, "\\^", text)
        gsub(/%%/, "\001", text)
        gsub(/%[-0-9]*(\[[.*]\])*[0-9]*[lz]*[a-z]/, ".*", text)
        gsub(/\001/, "%", text)
        return text
    }
    {
        rest = $0
        while (match(rest, /"([^"\\]|\\.)*"|[^ ]/)) {
            token = substr(rest, RSTART, RLENGTH)
            if (!depth) {
                if (!match(rest, / ((diag|report)_(error|warning|failure)|diag_(help|note|related)|wrong|wrong_value|bad|slip)\(/)) break
                depth = 1
                line = FNR
            } else if (token ~ /^"/) {
                text = text substr(token, 2, length(token) - 2)
            } else {
                flush()
                depth += (token == "(") - (token == ")")
            }
            rest = substr(rest, RSTART + RLENGTH)
        }
    }' src/*.c src/{base,lang,scene,render,cli,cli/golden}/*.c
}
known_texts() { # in C, one that is cut into pieces is put together
    cat tests/{errors,import}/*.txt tests/*.sh
    cat tests/unit/*.c | tr '\n' ' ' | sed 's/\\"/\x01/g; s/" *"//g; s/"/\n/g; s/\x01/"/g'
}
known_texts >"$work/known"
texts_of_src >"$work/texts"
while IFS=$'\t' read -r place text; do
    check "$place: a test knows its text, $text" grep -qE -e "$text" "$work/known"
done <"$work/texts"
check "there are texts" [ "$(wc -l <"$work/texts")" -gt 400 ]

# ---- The severities are those of the code ----

severities() { # of every code in the expected texts
    cat tests/{errors,import}/*.txt | grep -oE ' (error|warning)\[[a-z-]+\]' | tr -d ' ]' | tr '[' ' ' | sort -u |
        awk '{ all[$2] = all[$2] ? all[$2] " or " $1 : $1 } END { for (code in all) print code "\t" all[code] }' | sort
}
severities >"$work/severities"
awk -F'\t' 'NR == FNR { seen[$1] = 1; next } $1 in seen { print $1 "\t" $3 }' "$work/seen" "$work/example" | sort >"$work/stated"
check "severities in the tests (-) and in grammar/diagnostics.yaml (+)" same "$work/severities" "$work/stated"

# ---- The examples ----

codes_in() { grep -oE '(error|warning)\[[a-z-]+\]' "$1" | sed 's/.*\[\(.*\)\]/\1/' | sort -u; }
gives() { [ "$(codes_in "$1")" = "$2" ] || { echo "it gives: $(codes_in "$1")"; cat "$1"; false; }; }
expected() { case $1 in import-fresnel) printf '%s\n' "$1" import-shadow ;; *) echo "$1" ;; esac; } # glass has both
silent() { [ ! -s "$1" ] || { cat "$1"; false; }; }

monge() { "$monge" "$@"; }
export monge
export -f monge
mkdir "$work/run"
printf 'scene: [{sphere: {}}]\n' >"$work/run/king.yaml"
cd "$work/run" || exit 2
while IFS=$'\t' read -r code kind severity; do
    grep -qx -e "$code" "$work/pending" && continue
    wrong=$work/example.$code.wrong right=$work/example.$code.right
    case $kind in
    book)
        "$monge" import "$wrong" -o book.yaml >/dev/null 2>"$work/wrong"
        "$monge" import "$right" -o book.yaml >/dev/null 2>"$work/right"
        ;;
    scene)
        "$monge" check "$wrong" >/dev/null 2>"$work/wrong"
        "$monge" check "$right" >/dev/null 2>"$work/right"
        ;;
    commands)
        bash "$wrong" >/dev/null 2>"$work/wrong"
        bash "$right" >/dev/null 2>"$work/right"
        sed -i '/^wrote /d' "$work/right"
        ;;
    sketch)
        case $code in format-differs | *limit* | out-of-memory) continue ;; esac
        check "$code: $severity has an example that can be tried" false
        continue
        ;;
    esac
    check "$code: the wrong example gives it alone" gives "$work/wrong" "$(expected "$code")"
    check "$code: the right example is right" silent "$work/right"
done <"$work/example"

# ---- monge explain ----

while read -r code; do
    check "monge explain $code" "$monge" explain "$code"
done <"$work/all"
"$monge" explain | awk '{ print $1 }' >"$work/listed"
check "monge explain lists all" same "$work/all" "$work/listed"

echo "codes: $passed passed, $failed failed"
[ "$failed" -eq 0 ]
