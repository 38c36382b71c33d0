#!/usr/bin/env bash
# monge fmt: tests/fmt.sh [PROGRAM [--update]]. Each tests/fmt/NAME.yaml becomes NAME.out, byte for byte;
# --update writes the .out anew: read them. Of these and of all scenes that are YAML: what is formatted
# stays as it is, `monge check` says the same of it, and no comment is lost.

. "$(dirname "$0")/lib/testing.sh"
update=$2
ln -s "$project"/{tests,scenes,grammar,README.md} .

# formats FILE: what run does, for standard input.
formats() {
    last="fmt - <$1"
    "$monge" fmt - <"$1" >out 2>err
    status=$?
}

# ---- What comes out ----

for scene in tests/fmt/*.yaml; do
    formats "$scene"
    [ "$update" = --update ] && cp out "${scene%.yaml}.out"
    ok "$scene" diff -u "${scene%.yaml}.out" out
    no_err
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

awk '
    /^```yaml/ { file = sprintf("example-%s-%d.yaml", FILENAME, FNR); gsub("/", "_", file); next }
    /^```/ { if (file) close(file); file = "" }
    file { print > file }' README.md grammar/*.md
formatted=0
for scene in tests/fmt/*.yaml tests/errors/*.yaml $(find scenes/ -name '*.yaml' | sort) example*.yaml; do
    formats "$scene"
    err_lacks 'mistake in Monge'
    if [ $status -ne 0 ]; then
        ok "$scene: exit 2, with a reason, and no text" [ $status -eq 2 -a -s err -a ! -s out ]
        continue
    fi
    formatted=$((formatted + 1))
    "$monge" fmt - <out >again
    ok "$scene stays formatted" diff -u out again
    ok "$scene means the same" same_verdict "$scene" out
    case $scene in tests/fmt/*) continue ;; esac # some have `#` in texts that are not in one piece
    ok "$scene keeps its comments" same_remarks "$scene" out
done
ok "most scenes are YAML" [ "$formatted" -gt 150 ]

# In final.yaml a table of short rows would become a mixture of one line and three.
ok "the scenes are formatted" "$monge" fmt --check $(find scenes/ -name '*.yaml' ! -name final.yaml)

# ---- The command ----

fresh() { printf 'scene:\n- sphere:   {}   # a ball\n' >"$1"; }
printf 'scene:\n  - sphere: {}  # a ball\n' >want
printf 'scene: [{sphere: {}]\n' >broken.yaml

fresh a.yaml && chmod 604 a.yaml && ln -s a.yaml link.yaml
exits 1 fmt --check want link.yaml a.yaml; out_is "$(printf 'link.yaml\na.yaml')"
ok "--check writes nothing" grep -q '^- sphere:   {}' a.yaml
exits 0 fmt link.yaml; same a.yaml want
ok "says so" [ "$(cat err)" = 'formatted link.yaml' ]
ok "a link stays one" [ -L link.yaml ]
ok "permissions are kept" [ "$(stat -c %a a.yaml)" = 604 ]
touch -d 2001-01-01 a.yaml
before=$(stat -c '%i %Y' a.yaml)
run fmt a.yaml
ok "a formatted file is not touched" [ "$(stat -c '%i %Y' a.yaml)" = "$before" ]
ok "nothing to say" [ $status -eq 0 -a ! -s out -a ! -s err ]
run fmt --check a.yaml
ok "--check of a formatted file" [ $status -eq 0 -a ! -s out ]
run fmt -q a.yaml
ok "--quiet" [ $status -eq 0 -a ! -s err ]

fresh b.yaml
cp broken.yaml broken.copy
exits 2 fmt broken.yaml missing.yaml b.yaml; err_has 'broken.yaml:1:'; err_has 'cannot read missing.yaml'
same broken.yaml broken.copy; same b.yaml want
exits 2 fmt --check broken.yaml
fresh c.yaml
(trap '' XFSZ; ulimit -f 0; exec "$monge" fmt -q c.yaml 2>&1) | cat >err
ok "a full disk is exit 2" [ "${PIPESTATUS[0]}" -eq 2 ]
ok "and is told" grep -qx 'monge: error\[cannot-write\]: cannot write c.yaml: File too large' err
"$monge" fmt - <c.yaml >/dev/full 2>err
ok "a full device is exit 2" [ $? -eq 2 ]
ok "and is told" grep -qx 'monge: error\[cannot-write\]: cannot write standard output: No space left on device' err
fresh c.want
same c.yaml c.want; no_leftovers

printf '\357\273\277scene:\r\n- sphere:\t{}\t# a ball\r\n\r\n\r\n' >crlf.yaml
run fmt crlf.yaml; same crlf.yaml want # line feeds, no byte order mark
printf '\357\273\277' | cat - want >marked.yaml
exits 1 fmt --check marked.yaml # a byte order mark is not canonical
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

told
