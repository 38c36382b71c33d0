#!/usr/bin/env bash
# monge fmt: tests/fmt.sh [PROGRAM [--update]]. Each tests/fmt/NAME.yaml becomes NAME.out, byte for byte;
# --update writes the .out anew: read them. Of these and of all scenes that are YAML: what is formatted
# stays as it is, `monge check` says the same of it, and no comment is lost.
monge=$(realpath "${1:-build/monge}") || exit 2
update=$2
cd "$(dirname "$0")/.." || exit 2
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
passed=0 failed=0

# ok NAME COMMAND...: a test that passes when the command succeeds.
ok() {
    local name=$1
    shift
    if "$@" >"$work/log" 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $name"
        cat "$work/log"
    fi
}

# ---- What comes out ----

for scene in tests/fmt/*.yaml; do
    "$monge" fmt - <"$scene" >"$work/out" 2>"$work/err"
    [ "$update" = --update ] && cp "$work/out" "${scene%.yaml}.out"
    ok "$scene" diff -u "${scene%.yaml}.out" "$work/out"
    ok "$scene gives no message" diff -u /dev/null "$work/err"
done
for out in tests/fmt/*.out; do ok "$out has its scene" [ -e "${out%.out}.yaml" ]; done

# ---- What must hold of every scene ----

# What check says, without the places.
verdict() {
    "$monge" check - <"$1" 2>&1 >/dev/null | sed -n 's/^[^ ]*: \(\(error\|warning\)\[.*\)/\1/p' | sed 's/lines\{0,1\} [0-9]*/line N/g' | sort
}
same_verdict() { diff <(verdict "$1") <(verdict "$2"); }

# The words behind each # that may begin a comment are there again.
remarks() { tr '\r' '\n' <"$1" | grep -oE '(^|[[:space:]])#.*' | grep -o '[[:alnum:]]*' | sort; }
same_remarks() { diff <(remarks "$1") <(remarks "$2"); }

awk -v base="$work/example" '
    /^```yaml/ { file = sprintf("%s-%s-%d.yaml", base, FILENAME, FNR); gsub("/", "_", file); sub(/.*_example/, base, file); next }
    /^```/ { if (file) close(file); file = "" }
    file { print > file }' README.md grammar/*.md
formatted=0
for scene in tests/fmt/*.yaml tests/errors/*.yaml $(find scenes -name '*.yaml' | sort) "$work"/example*.yaml; do
    "$monge" fmt - <"$scene" >"$work/out" 2>"$work/err"
    status=$?
    ok "$scene: no mistake of the formatter" sh -c '! grep -q "mistake in Monge" "$1"' sh "$work/err"
    if [ $status -ne 0 ]; then
        ok "$scene: exit 2, with a reason, and no text" [ $status -eq 2 -a -s "$work/err" -a ! -s "$work/out" ]
        continue
    fi
    formatted=$((formatted + 1))
    "$monge" fmt - <"$work/out" >"$work/again"
    ok "$scene stays formatted" diff -u "$work/out" "$work/again"
    ok "$scene means the same" same_verdict "$scene" "$work/out"
    case $scene in tests/fmt/*) continue ;; esac # some have `#` in texts that are not in one piece
    ok "$scene keeps its comments" same_remarks "$scene" "$work/out"
done
ok "most scenes are YAML" [ "$formatted" -gt 150 ]

# In final.yaml a table of short rows would become a mixture of one line and three.
ok "the scenes are formatted" "$monge" fmt --check $(find scenes -name '*.yaml' ! -name final.yaml)

# ---- The command ----

cd "$work" || exit 2
run() {
    "$monge" fmt "$@" >out 2>err </dev/null
    status=$?
}
fresh() { printf 'scene:\n- sphere:   {}   # a ball\n' >"$1"; }
printf 'scene:\n  - sphere: {}  # a ball\n' >want
printf 'scene: [{sphere: {}]\n' >broken.yaml

fresh a.yaml && chmod 604 a.yaml && ln -s a.yaml link.yaml
run --check want link.yaml a.yaml
ok "--check is exit 1" [ $status -eq 1 ]
ok "--check lists" [ "$(cat out)" = "$(printf 'link.yaml\na.yaml')" ]
ok "--check writes nothing" grep -q '^- sphere:   {}' a.yaml
run link.yaml
ok "in place" cmp a.yaml want
ok "exit 0" [ $status -eq 0 ]
ok "says so" [ "$(cat err)" = 'formatted link.yaml' ]
ok "a link stays one" [ -L link.yaml ]
ok "permissions are kept" [ "$(stat -c %a a.yaml)" = 604 ]
touch -d 2001-01-01 a.yaml
before=$(stat -c '%i %Y' a.yaml)
run a.yaml
ok "a formatted file is not touched" [ "$(stat -c '%i %Y' a.yaml)" = "$before" ]
ok "nothing to say" [ $status -eq 0 -a ! -s out -a ! -s err ]
run --check a.yaml
ok "--check of a formatted file" [ $status -eq 0 -a ! -s out ]
run -q a.yaml
ok "--quiet" [ $status -eq 0 -a ! -s err ]

fresh b.yaml
cp broken.yaml broken.copy
run broken.yaml missing.yaml b.yaml
ok "not YAML is exit 2" [ $status -eq 2 ]
ok "its message has a place" grep -q 'broken.yaml:1:' err
ok "a missing file is told" grep -q 'cannot read missing.yaml' err
ok "the broken one is left alone" cmp broken.yaml broken.copy
ok "the others are formatted" cmp b.yaml want
run --check broken.yaml
ok "--check of what is not YAML is exit 2" [ $status -eq 2 ]
fresh c.yaml
(trap '' XFSZ; ulimit -f 0; exec "$monge" fmt -q c.yaml 2>&1) | cat >err
ok "a full disk is exit 2" [ "${PIPESTATUS[0]}" -eq 2 ]
ok "and is told" grep -qx 'monge: error\[cannot-write\]: cannot write c.yaml: File too large' err
"$monge" fmt - <c.yaml >/dev/full 2>err
ok "a full device is exit 2" [ $? -eq 2 ]
ok "and is told" grep -qx 'monge: error\[cannot-write\]: cannot write standard output: No space left on device' err
fresh c.want
ok "a full disk leaves the file" cmp c.yaml c.want
ok "no temporary files" [ -z "$(find . -name '*.tmp')" ]

printf '\357\273\277scene:\r\n- sphere:\t{}\t# a ball\r\n\r\n\r\n' >crlf.yaml
run crlf.yaml
ok "line feeds, no byte order mark" cmp crlf.yaml want
printf '\357\273\277' | cat - want >marked.yaml
run --check marked.yaml
ok "a byte order mark is not canonical" [ $status -eq 1 ]
printf 'scene: [{sphere: {}}]' | "$monge" fmt - >out
ok "the last line gets its end" [ "$(od -An -c out | tail -n 1 | grep -c '\\n')" -eq 1 ]
printf 'scene: |\n text' | "$monge" fmt - >out
ok "but not a text" [ "$(cat out)" = "$(printf 'scene: |-\n  text')" ]
for odd in '? scene\n: []\n' '{[a]: b}\n' '{[a,\n b]: c}\n' 'a: "\342\200\250"\n' 'a: !mine b\n' '# nothing\n'; do
    printf "$odd" | "$monge" fmt - >out 2>err
    ok "refused: $odd" [ $? -eq 2 -a -s err -a ! -s out ]
done
printf '? scene\n: []\n' | "$monge" fmt - 2>err
cat >told <<'END'
<stdin>:1:1: error[odd-key]: a key behind `?`, or one that is no word, has no canonical form
    1 | ? scene
      | ^ write `key: value`
END
ok "an odd key is told" diff -u told err
printf 'scene: [] # \342\200\250\n' | "$monge" fmt - 2>err
printf '<stdin>:1:13: error[bad-character]: %s\n    1 | scene: [] # \n      |             ^ remove it\n' \
    'a line separator (U+2028) or paragraph separator (U+2029)' >told
ok "a separator is told" diff -u told err

echo "fmt: $passed passed, $failed failed"
[ "$failed" -eq 0 ]
