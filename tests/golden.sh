#!/usr/bin/env bash
# Tests of monge test and monge accept: tests/golden.sh [PROGRAM], build/monge by default. Works in a folder of its own.
# Tests that need a tool which is not here (python3, git, perl) are left out.

. "$(dirname "$0")/lib/testing.sh"
tools=$project/tools/ci
export NO_COLOR=1

# says STATUS NAME: the line of a golden.
says() { ok "$2 is $1" grep -qE "^$1 +$2(  |$)" out; }
# flip FILE N: another last bit of the byte at N, of N + 1 bytes from the beginning.
flip() {
    byte=$(od -An -tu1 -j "$2" -N 1 "$1")
    # shellcheck disable=SC2059
    printf "\\$(printf %03o $((byte ^ 1)))" | dd of="$1" bs=1 seek="$2" conv=notrunc 2>dd-err
}
# foresees STATUS [OPTION...]: monge accept, and before it the same with --dry-run, which writes nothing and tells the same.
foresees() {
    wanted=$1; shift
    find g monge-test -exec stat -c '%n %i %y' {} + | sort >before
    exits "$wanted" accept --golden g --dry-run "$@"; cp out dry; cp err dry-err
    find g monge-test -exec stat -c '%n %i %y' {} + | sort >after; ok 'nothing is written' cmp -s before after
    exits "$wanted" accept --golden g "$@"
    sed 's/^would take /took /; s/^would remove /removed /; s/ would be taken/ taken/' dry >x
    ok 'what is told of each is what becomes of it' cmp -s x out; ok 'so is what is wrong' cmp -s dry-err err
}
sums() { find "$1" -type f -exec cksum {} + | sort; }

# scene FILE COLOUR [X]: small, of three objects with names.
scene() {
    mkdir -p "$(dirname "$1")"
    cat >"$1" <<YAML
image: {size: [40, 30], samples: 1}
camera: {eye: [0, 3, 8], look_at: [0, 0, 0]}
lights: [{point: {at: [3, 8, 3]}}]
scene:
  - sphere: {center: [-1.5, 0, 0]}
    name: ball
    material: {diffuse: $2}
  - box: {}
    name: lid
    transform: {translate: [${3:-1.5}, 0, 0]}
  - plane: {normal: [0, 1, 0]}
    name: floor
    transform: {translate: [0, -1, 0]}
YAML
}
# fresh [GOLDEN.YAML]: three scenes in s/, no goldens, no run.
fresh() {
    rm -rf s g monge-test
    scene s/one.yaml red
    scene s/two.yaml gold
    scene 's/in/a b%.yaml' teal
    mkdir g
    [ $# -eq 0 ] || printf '%s\n' "$@" >g/golden.yaml
}

# ---- Usage ----

fresh
exits 2 test s; err_has '--golden DIR is missing'
exits 2 test --golden g; err_has 'test: no scene given; --root, or `root` in g/golden.yaml, would tell where they are'
exits 2 accept; err_has '--golden DIR is missing'
exits 2 accept --golden g; err_has 'monge-test/results.json is not there: `monge test` makes it'
exits 2 test none.yaml --golden g; says broken none; out_has 'No such file or directory'
exits 2 test nowhere/ --golden g; out_has 'cannot read nowhere/: No such file'
exits 2 test s --golden g --golden-kind jpg; err_has 'expected png, hash or both'
exits 2 test s --golden g --json - --junit -; err_has 'standard output can take only one of them'
last='test - --golden g'; "$monge" test - --golden g <s/one.yaml >out 2>err; status=$?
ok 'a scene on stdin is exit 2' [ $status -eq 2 ]; err_has 'a scene on standard input has no name'
echo s/one.yaml | "$monge" test - --golden g >out 2>err; says new one

# the folder of the goldens: one that is not there yet, or is none
fresh; rm -r g
exits 1 test s --golden g; says new one; ok 'a note, once' [ "$(cat err)" = 'there is no folder g yet: `monge accept --golden g` makes it' ]
exits 1 test s --golden g -q; no_err
exits 2 test --golden g; ok 'and no scenes' [ "$(cat err)" = 'monge: --golden g: there is no such folder' ]
exits 0 test s --golden g --update-only-failed; err_has 'there is no folder g yet: this run makes it'
exits 0 test s --golden g; no_err
fresh 'kind: hash'; exits 0 test s --golden g --update-only-failed -q
for command in 'test s' accept; do
    for file in golden.yaml golden.lock; do
        exits 2 $command --golden g/$file; ok 'one message' [ "$(cat err)" = "monge: --golden g/$file: it takes the folder, g" ]
    done
    exits 2 $command --golden s/one.yaml; err_has '--golden s/one.yaml: it takes a folder'
done
(cd g && "$monge" test ../s --golden golden.yaml) >out 2>err; err_has '--golden golden.yaml: it takes the folder, .'
fresh; echo 'kind: hash' >g/golden.yml
exits 1 test s --golden g; err_has 'monge: warning: g/golden.yml is not read: it must be called golden.yaml'
mv g/golden.yml g/golden.yaml; exits 1 test s --golden g; no_err
# options of render
refers() { local options=$1; shift; exits 2 test s --golden g "$@"; err_has "no option \`${1%%=*}\`; it goes into golden.yaml, \`rules: [{scenes: \"*\", $options}]\`"; }
refers 'options: "--size 10x10"' --size 10x10
refers 'options: "--size 10x10"' --size=10x10
refers 'options: "--size WxH"' --size
refers 'options: "-D a=1"' -D a=1
refers 'options: "-D NAME=VALUE"' -D 'a="b"'
refers 'options: --no-shadows' --no-shadows
refers 'options: "--frames 1-3"' --frames 1-3
refers 'aov: true' --aov depth
exits 2 test s --golden g -Da=1; err_has 'options: "-D a=1"'
for option in --tolerance=0.1 --max-delta=0.1 --max-pixels=5 --metric=flip --ignore=0,0,9,9 --mask=m.png; do
    case $option in --ignore* | --mask*) note='all pixels of a golden count; ' ;; *) note= ;; esac
    exits 2 test s --golden g $option; err_has "no option \`${option%=*}\`; ${note}a tolerance stands in golden.yaml, \`rules: [{scenes: \"*\", tolerance: {max: 0.004, pixels: 0.1%, reason: edges differ}}]\`, or in the scene"
done
echo 'rules: [{scenes: "*", tolerance: {max: 0.004, pixels: 0.1%, reason: edges differ}}]' >g/golden.yaml; exits 1 test s --golden g -q; no_err; rm g/golden.yaml
exits 2 accept --golden g --tolerance 1; err_lacks golden.yaml
exits 2 test s --golden g --resume; err_lacks golden.yaml # no picture differs by that
exits 2 accept --golden g --size 10x10; err_lacks golden.yaml

# ---- The life of a golden, of each kind ----

for kind in png hash both; do
    fresh "kind: $kind"
    exits 1 test s --golden g; no_err
    says new one; says new 'in/a b%'; out_has 'monge render '"'s/in/a b%.yaml'"' -o '"'a b%.png'"
    out_has '3 goldens: 3 new, in'; out_has '`monge accept --golden g` takes the new pictures'
    there monge-test/new/one.png; there 'monge-test/new/in/a b%.png'; there monge-test/results.json
    ok 'the run keeps itself out of git' [ "$(cat monge-test/.gitignore)" = '*' ]
    ok 'nothing in the goldens yet' [ "$(ls g)" = golden.yaml ]
    exits 0 accept --golden g; out_has 'took one'; out_has '3 taken'
    case $kind in
    png) there 'g/in/a b%.png'; missing g/golden.lock ;;
    hash) missing g/one.png; ok 'three lines' [ "$(grep -vc '^#' g/golden.lock)" -eq 3 ] ;;
    both) there g/one.png; there g/golden.lock ;;
    esac
    [ $kind = png ] || ok 'a name is escaped' grep -q '^in/a%20b%25 40x30x8 pixels=' g/golden.lock
    [ $kind = png ] || ok 'lines are sorted' sh -c 'grep -v "^#" g/golden.lock | LC_ALL=C sort -c'
    sums g >before
    exits 0 test s --golden g; says same one; says same 'in/a b%'; out_has '3 goldens: 3 same'
    ok 'no new pictures' [ -z "$(find monge-test -name '*.png')" ]
    exits 0 test s --golden g -q; no_out; no_err

    scene s/one.yaml '"#ff0001"'
    exits 1 test s --golden g; says changed one; says same two
    out_has "the scene's text differs; the options and the program are the same"
    out_has 'new: monge-test/new/one.png'; out_has '3 goldens: 2 same, 1 changed'
    [ $kind = hash ] || out_has 'flip'
    exits 1 test s --golden g --jobs 1; says changed one
    exits 1 test s/two.yaml s/one.yaml --golden g
    ok 'the order of the operands' [ "$(grep -oE '^(same|changed) +[a-z]+' out | tr -s ' ' | tr '\n' ,)" = 'same two,changed one,' ]
    ok 'a run touches no golden' [ "$(sums g)" = "$(cat before)" ]

    exits 2 accept two 'x*' --golden g; err_has 'x*: no golden of the last run is called so'; err_lacks 'did you mean'
    exits 2 accept s/one.yaml --golden g; err_has 's/one.yaml: no golden of the last run is called so; did you mean `one`?'
    exits 0 accept two --golden g; out_has '0 taken'
    ok 'what did not fail is not touched' [ "$(sums g)" = "$(cat before)" ]
    cp s/one.yaml kept; echo '# more' >>s/one.yaml
    exits 1 accept --golden g; err_has 'one is left as it is: the scene has changed since the run'
    ok 'a refusal touches nothing' [ "$(sums g)" = "$(cat before)" ]
    cp kept s/one.yaml
    exits 0 accept 'o*' --golden g; out_has 'took one'; out_has '1 taken'
    exits 0 test s --golden g; says same one
    ok 'the others are as before' [ "$(sums g | grep -v 'one.png\|lock')" = "$(grep -v 'one.png\|lock' before)" ]

    rm s/two.yaml
    exits 1 test s --golden g; says orphan two; out_has 'no scene makes it any more'
    exits 0 test s/one.yaml --golden g; out_lacks orphan
    exits 1 test s --golden g -q --output "a run"
    out_has "\`monge accept --golden g --output 'a run' --prune\` removes it"; rm -r 'a run'
    exits 1 test s --golden g -q
    out_has '`monge accept --golden g --prune` removes it'
    exits 0 accept --golden g; ok 'the orphan is counted' [ "$(cat out)" = $'0 taken\n1 orphan is left: `monge accept --golden g --prune` removes it' ]
    exits 0 accept 'tw*' one --golden g; out_has "1 orphan is left: \`monge accept --golden g --prune 'tw*' one\` removes it"
    exits 0 accept --golden g -q; no_out; exits 0 accept one --golden g; out_lacks orphan; exits 0 accept two --golden g -n; out_has '1 orphan is left'
    mv 's/in/a b%.yaml' kept.yaml; exits 1 test s --golden g -q; out_has '`monge accept --golden g --prune` removes it'
    exits 0 accept --golden g; out_has '2 orphans are left: `monge accept --golden g --prune` removes them'; mv kept.yaml 's/in/a b%.yaml'
    exits 0 accept --golden g; out_has '1 orphan is left'; exits 1 test s --golden g
    exits 0 accept --golden g --prune; out_has 'removed two'; out_lacks 'left'; missing g/two.png
    exits 0 accept --golden g; out_lacks orphan
    exits 0 test s --golden g; out_has '2 goldens: 2 same'
    echo 'scene: [{sphre: {}}]' >s/one.yaml
    exits 1 test s --golden g; says broken one; out_has 'did you mean `sphere`?'; out_lacks orphan
    exits 1 accept --golden g; out_has '0 taken, 1 left as they are'; err_has 'one is left as it is: it is broken'
    scene s/three.yaml blue
    scene s/one.yaml lime
    exits 0 test s --golden g --update-only-failed; says new three; says changed one; out_has '2 of 2 new pictures are goldens now'; out_has '3 goldens: 1 same, 2 taken, in '; out_lacks ' 1 new'
    exits 0 test s --golden g
    exits 0 accept --golden g; out_has '0 taken'
done

# a report of what is taken shows what the golden was
fresh 'rules: [{scenes: one, aov: true}]'; exits 0 test s --golden g -q --update-only-failed; cp -r g gkept
scene s/one.yaml blue; exits 0 test s --golden g -q --update-only-failed --report page
for file in one.png one.object.png one.depth.pfm; do ok "$file is kept" cmp -s gkept/$file monge-test/old/$file; done
ok 'the report has it' grep -q 'data-path="monge-test/old/one.png"' page/index.html; ok 'the golden is the new one' cmp -s g/one.png monge-test/new/one.png
exits 0 test s --golden g; missing monge-test/old/one.png monge-test/old/one.object.png; rm -rf page gkept

# ---- Goldens that others change between run and accept ----

for kind in png hash both; do
    fresh "kind: $kind"
    scene s/one.yaml blue; exits 0 test s --golden g --update-only-failed -q; cp -r g theirs
    scene s/one.yaml red; exits 0 test s --golden g --update-only-failed -q; cp -r g ours
    scene s/one.yaml lime; exits 1 test s --golden g; says changed one
    cp theirs/* g 2>/dev/null; sums g >before
    exits 1 accept --golden g; err_has 'one is left as it is: its golden has changed since the run: `monge test` compares it anew'
    out_has '0 taken, 1 left as they are'; ok 'what others have accepted stays' [ "$(sums g)" = "$(cat before)" ]
    rm -f g/one.png; [ $kind = png ] || sed -i '/^one /d' g/golden.lock
    exits 1 accept --golden g; err_has 'one is left as it is: its golden has changed since the run'
    exits 1 test s --golden g; says new one; cp theirs/* g 2>/dev/null
    exits 1 accept --golden g; err_has 'one is left as it is: its golden has changed since the run'
    exits 1 test s --golden g; says changed one; exits 0 accept --golden g; out_has '1 taken'; sums g >before

    # what is taken is taken once
    exits 0 accept --golden g; out_has 'one is taken already'; out_has '0 taken, 1 done already'; out_lacks 'took one'
    ok 'nothing has changed' [ "$(sums g)" = "$(cat before)" ]
    scene s/one.yaml teal; exits 0 test s --golden g --update-only-failed -q
    exits 0 accept --golden g; out_has 'one is taken already'
    cp ours/* g 2>/dev/null; exits 1 accept --golden g; err_has 'one is left as it is: its golden has changed since the run'
    rm s/two.yaml; exits 1 test s --golden g -q; exits 0 accept two --golden g --prune; out_has 'removed two'
    exits 0 accept two --golden g --prune; out_has 'two is removed already'; out_lacks 'removed two'
    rm -rf theirs ours
done
fresh 'kind: both'; exits 0 test s --golden g --update-only-failed -q; scene s/one.yaml lime
exits 1 test s --golden g; says changed one; sed -i '/^one /s/text=..../text=0000/' g/golden.lock
exits 1 accept --golden g; err_has 'one is left as it is: its golden has changed since the run' # its line alone
# a golden whose passes are gone is not the one that was taken
fresh 'rules: [{scenes: one, aov: true}]'; exits 1 test s --golden g -q; exits 0 accept --golden g -q
rm g/one.depth.pfm; exits 1 accept --golden g; out_has 'two is taken already'; out_lacks 'one is taken'
# during the run, too: a program of --old changes the line
fresh 'kind: hash'; exits 0 test s --golden g --update-only-failed -q; scene s/one.yaml lime
printf '#!/bin/sh\n[ "$1" = --version ] || sed -i "/^one /s/pixels=..../pixels=0000/" g/golden.lock\n' >old; chmod +x old
exits 1 test s --golden g --old ./old --update-only-failed; err_has 'one is left as it is: its golden has changed during the run'
out_has '0 of 1 new pictures are goldens now'; out_has ' 1 changed, in '; out_lacks ' taken'; ok 'the line of others stays' grep -q '^one .*pixels=0000' g/golden.lock

# ---- Names that could be another line ----

for name in '#h' '=======' '<<<<<<< a' '>>>>>>>' '|||||||' '=' '%23'; do
    fresh 'kind: hash'; scene "s/$name.yaml" blue; exits 0 test s --golden g --update-only-failed -q
    exits 0 test s --golden g; out_has '4 goldens: 4 same'; exits 1 test s --golden g --golden-kind both; out_lacks orphan
    scene "s/$name.yaml" red; exits 1 test s --golden g -q; exits 0 accept "[$name]*" --golden g; exits 0 test s --golden g
    rm "s/$name.yaml"; exits 1 test s --golden g; out_has '1 orphan'; exits 0 accept --golden g --prune
    ok 'its line is gone' [ "$(grep -c pixels= g/golden.lock)" -eq 3 ]
done

# ---- Missing goldens ----

fresh 'kind: both'
exits 0 test s --golden g --update-only-failed -q
cp -r g gkept
rm g/one.png
exits 1 test s --golden g; says missing one; out_has 'g/golden.lock has a line for it, but g/one.png is not there'
rm -rf g; cp -r gkept g; sed -i '/^one /d' g/golden.lock
exits 1 test s --golden g; says missing one; out_has 'g/one.png is there, but g/golden.lock has no line for it'
rm -rf g; cp -r gkept g; cp g/two.png g/one.png
exits 1 test s --golden g; says missing one; out_has 'its line in g/golden.lock is not that of the picture g/one.png'
rm -rf g; cp -r gkept g; head -c 300 gkept/one.png >g/one.png
exits 1 test s --golden g; says missing one; out_has 'cannot use g/one.png'
exits 0 accept --golden g; exits 0 test s --golden g
echo 'version https://git-lfs' >g/one.png
exits 1 test s --golden g --golden-kind png; says missing one
rm -rf g gkept; mkdir g; exits 0 test s --golden g --golden-kind hash --update-only-failed -q
exits 1 test s --golden g --golden-kind png; says missing one; out_has 'has a line for it, but g/one.png'

# ---- Lock files that are hostile ----

fresh 'kind: hash'
exits 0 test s --golden g --update-only-failed -q
cp g/golden.lock lock
lock() { cp lock g/golden.lock; printf "$@" >>g/golden.lock; exits 2 test s --golden g; no_out; }
hash=0123456789abcdef0123456789abcdef
lock '<<<<<<< ours\n'; err_has 'g/golden.lock:5: a conflict of a merge that is not resolved'
lock '=======\n'; err_has 'conflict'
lock '../x 1x1x8 pixels=%s\n' $hash; err_has 'no name of a golden'
lock '/x 1x1x8 pixels=%s\n' $hash; err_has 'no name of a golden'
lock 'x//y 1x1x8 pixels=%s\n' $hash; err_has 'no name of a golden'
lock 'x%%2F..%%2Fy 1x1x8 pixels=%s\n' $hash; err_has 'no name of a golden'
lock 'x%%23 1x1x8 pixels=%s\n' $hash; err_has 'no name of a golden' # not as it is written
lock 'x%%00 1x1x8 pixels=%s\n' $hash; err_has 'no name of a golden'
lock ' x 1x1x8 pixels=%s\n' $hash; err_has 'no name of a golden'
lock 'x\n'; err_has 'a size is expected'
lock 'x 1x1 pixels=%s\n' $hash; err_has 'a size is expected'
lock 'x 1x1x9 pixels=%s\n' $hash; err_has 'a size is expected'
lock 'x 99999x1x8 pixels=%s\n' $hash; err_has 'a size is expected'
lock 'x 4294967297x1x8 pixels=%s\n' $hash; err_has 'a size is expected'
lock 'x 1x1x8\n'; err_has 'it has no pixels='
lock 'x 1x1x8 pixels=%s0\n' $hash; err_has 'each once and with a hash'
lock 'x 1x1x8 pixels=%s pixels=%s\n' $hash $hash; err_has 'each once'
lock 'x 1x1x8 pixels=%s more=%s\n' $hash $hash; err_has 'each once'
lock 'x 1x1x8 pixels=%s  text=%s\n' $hash $hash; err_has 'each once'
lock 'x 1x1x8 pixels=%s' $hash; err_has 'the line is cut off'
lock 'x 1x1x8 pix\0els=%s\n' $hash; err_has 'NUL'
lock 'x 1x1x8 pixels=%s options=\x01\n' $hash; err_has 'must be written as %XX'
lock 'one 1x1x8 pixels=%s\n' $hash; err_has 'g/golden.lock:5: a second line for one, as line 3 is: keep one of them'
cp lock g/golden.lock; exits 0 test s --golden g

printf 'a%%0Ab%%1B[31m%%7F 1x1x8 pixels=%s\n' $hash >>g/golden.lock; exits 1 test s --golden g
says orphan 'a[?]b[?]\[31m[?]'; ok 'nothing but print' sh -c '! LC_ALL=C grep -q "[^[:print:]]" out'; exits 1 test s --golden g --tap -q; out_has 'a?b?[31m?'
exits 0 accept --golden g --prune; ok 'accept tells it so too' grep -qx 'removed a?b?\[31m?' out
ok 'and forgets it' cmp lock g/golden.lock
printf 'image: {size: [20, 10], samples: 1}\nscene: [{sphere: {}}]\n' >"s/$(printf 'c\nd')".yaml
exits 1 test s --golden g; says new 'c[?]d'; out_has 'monge-test/new/c?d.png'
out_lacks again: # it would be another command
ok 'the results have it' grep -qF '"command": "monge render '"'s/c\\nd.yaml' -o 'c\\nd.png'"'"' monge-test/results.json; exits 0 accept --golden g; ok 'a name is a line' grep -qx 'took c?d' out

# ---- golden.yaml ----

fresh 'rules: [{scenes: one, optoins: --samples 2}]'
exits 2 test s --golden g; err_has 'g/golden.yaml:1:23: error[unknown-key]'; err_has 'did you mean `options`?'
wrong() {
    fresh "rules:" "  - {scenes: one, options: $1}"; exits 2 test s --golden g
    ok 'one message' [ "$(wc -l <err)" -eq 1 ]; err_has 'monge: g/golden.yaml:2: options: '; err_has "$2"
}
wrong '--sizee 3x3' 'options: no option `--sizee`; did you mean `--size`?'
wrong '-D a' '-D: expected NAME=VALUE, found `a`'
wrong '--size 3' 'expected WxH'
wrong '-o x.png' '--output does not change pixels'
wrong '--threads 1' '--threads does not change pixels'
wrong 'x.yaml' 'expected options alone, found `x.yaml`'
wrong "\"-D 'a=1\"" 'a quote is not closed'
wrong '--shadow 0.5 --no-shadows' 'give one of them'
fresh 'rules: [{scenes: one, tolerance: {max: 0.1}}]'; exits 2 test s --golden g; err_has 'a tolerance needs the key `reason`'
# one without rules
for empty in '' '# kind: hash' '   # a' $'\n\n# a\n' '---' '--- # a' $'# a\r\n---\n\t'; do fresh "$empty"; exits 1 test s --golden g; no_err; says new one; done
fresh; : >g/golden.yaml; exits 1 test s --golden g; no_err; exits 0 accept --golden g; there g/one.png
for other in '-' '- # a' '--' 'a' '# a'$'\n''a'; do fresh "$other"; exits 2 test s --golden g; err_has 'g/golden.yaml:'; done
fresh 'root: ../nowhere'; exits 2 test s --golden g; err_has '`root`: g/../nowhere: No such file'
fresh 'rules: [{scenes: one, options: --frames 2}]'; exits 1 test s --golden g; says broken one; out_has 'has no animation'
# its command shows what is wrong, too
for options in '--frames 2 --size 20x15' '--size 20x15 --frames 2-3' '--size 20x15 --frames 1-4:2'; do
    fresh "rules: [{scenes: one, options: $options}]"; exits 1 test s --golden g; says broken one; frames=${options#*--frames }
    out_has "again: monge render s/one.yaml --size 20x15 --frames ${frames% --*} -o 'one-{frame}.png'"
    sed -n '/^broken/,/^new/s/^ *again: //p' out >command; sed -i "s,^monge,'$monge'," command; sh ./command >out 2>err; status=$?
    ok 'it is what it shows' [ "$status" -eq 2 ]; err_has 'has no animation'
done
# of a name with what patterns of -o have a meaning for: the command makes the picture under the golden's name
printf 'image: {size: [20, 10]}\nanimation: {frames: 2}\nscene: [{sphere: {radius: 1 + t}}]\n' >moves.yaml
for frames in '' ' --frames 2'; do
    fresh "rules: [{scenes: '*', options: '--samples 1$frames'}]"; rm -r s; mkdir s; cp moves.yaml 's/{b}%d}.yaml'; name="{b}%d}${frames:+-0002}"
    exits 1 test s --golden g; says new "$name"; sed -n 's/^ *again: //p' out >command; sed -i "s,^monge,'$monge'," command
    sh ./command >out 2>err; ok 'the command of it ends well' [ $? -eq 0 ]; same "$name.png" "monge-test/new/$name.png"; rm "$name.png"
done
# so does an old program
fresh 'kind: hash'; mv s/one.yaml 's/{b}.yaml'; exits 0 test s --golden g --update-only-failed -q; sed -i 's/red/blue/' 's/{b}.yaml'
printf '#!/bin/sh\nsed -i s/blue/red/ "s/{b}.yaml"; "%s" "$@"; sed -i s/red/blue/ "s/{b}.yaml"\n' "$monge" >old; chmod +x old
exits 1 test s --golden g --old ./old; says changed '[{]b}'; there 'monge-test/old/{b}.png'; out_has flip; rm old
fresh 'rules: [{scenes: one, options: --frames 2}]'; echo 'scene: [{sphre: {}}]' >s/one.yaml; exits 1 test s --golden g; out_has "s/one.yaml --frames 2 -o 'one-{frame}.png'"
fresh 'rules: [{scenes: one, options: --frames all}]'; exits 1 test s --golden g; says new one; out_has 'monge render s/one.yaml -o one.png'
fresh 'rules: [{scenes: one, options: "--region 0,0,99,99"}]'; exits 1 test s --golden g; says broken one; out_has 'does not lie within'

fresh 'rules:' '  - {scenes: [one, "in/*"], options: --size 20x10}' '  - {scenes: "*", options: --samples 2}'
exits 0 test s --golden g --update-only-failed -q
ok 'the first rule that matches' grep -qa 'options.*--size 20x10' g/one.png
ok 'it alone' sh -c '! grep -qa -e --samples g/one.png'
ok 'a rule for the rest' grep -qa -e '--samples 2' g/two.png
sed -i 's/20x10/21x10/' g/golden.yaml
exits 1 test s --golden g; says changed one; out_has 'another size: 21x10, the golden 20x10'; ok 'in JSON, too' grep -q '"message": "another size: 21x10, the golden 20x10"' monge-test/results.json; out_has 'the options differ'; out_has '--size 21x10 -o one.png'
sed -i 's/21x10/22x10/' g/golden.yaml
exits 1 accept --golden g; err_has 'one is left as it is: its options in golden.yaml have changed since the run'

# Rules that no scene is left for, in runs of all scenes.
fresh 'root: ../s' 'rules:' '  - {scenes: one}' '  - {scenes: [tow, two]}' '  - {scenes: "in/*.yaml"}' '  - scenes: "*"' '    aov: true' '  - {scenes: "in/*"}' '  - {scenes: thre}'
warnings() { ok "${#} warnings" [ "$(cat err)" = "$(printf 'monge: warning: g/golden.yaml:%s\n' "$@")" ]; }
exits 1 test --golden g
warnings '4: no scene matches `tow`; did you mean `two`?' '5: no scene matches `in/*.yaml`' '8: earlier rules match all its scenes' '9: no scene matches `thre`'
exits 0 accept --golden g -q; exits 0 test --golden g --changed -q; ok 'quietly too' [ "$(wc -l <err)" -eq 4 ]
exits 0 test s/one.yaml s/two.yaml --golden g; no_err; exits 0 test s/in --golden g; no_err
sed -i 1d g/golden.yaml; exits 0 test s --golden g; err_has 'g/golden.yaml:4: no scene matches `in/*.yaml`'
exits 1 test s/in --golden g; no_err
fresh 'rules:' '  - {scenes: one}' '  - {scenes: elsewhere}'; scene extra/elsewhere.yaml lime # scenes of another run
exits 0 test s extra --golden g --update-only-failed; exits 0 test s --golden g; out_has 'not in this run'; no_err
rm -r extra; exits 1 test s --golden g; says orphan elsewhere; warnings '3: no scene matches `elsewhere`'

# Frames and parameters: a golden each.
fresh 'rules:' '  - {scenes: turn, options: "--frames 1-3:2 -D tint=red,\"hsv(120, 1, 1)\""}'
printf 'params: {tint: white}\nanimation: {frames: 4}\nimage: {size: [8, 6], samples: 1}\nscene:\n  - box: {}\n    material: {diffuse: tint}\n    transform: {rotate: {y: 90 * t + 10}}\n' >s/turn.yaml
exits 1 test s --golden g; says new turn-tint=red-0001; says new turn-tint=hsv_120_1_1-0003
out_has "monge render s/turn.yaml -D 'tint=hsv(120, 1, 1)' --frames 3 -o turn-tint=hsv_120_1_1-0003.png"
exits 0 accept --golden g; out_has '7 taken'
exits 0 test s --golden g; sed -i 's/1-3:2/1/' g/golden.yaml
exits 1 test s --golden g; says orphan turn-tint=red-0003; says same turn-tint=red-0001
sed -i 's/box/bxo/' s/turn.yaml; exits 1 test s --golden g; says broken turn-tint=red; out_lacks orphan

# A root: the same names however a scene is named, and orphans by what is there.
fresh 'root: ../s'
exits 1 test --golden g; says new 'in/a b%'; out_has "monge render 's/in/a b%.yaml'"
exits 2 accept "./s/in/a b%.yaml" --golden g; err_has 'did you mean `in/a b%`?'; exits 0 accept --golden g
exits 0 test 's/in/a b%.yaml' --golden g; says same 'in/a b%'; out_has '1 golden: 1 same'
exits 0 test s/in --golden g; says same 'in/a b%'
mv s/two.yaml kept.yaml
exits 0 test s/one.yaml --golden g; out_lacks orphan
exits 0 test s/in --golden g; out_lacks orphan; exits 1 test --golden g; says orphan two
mv kept.yaml s/two.yaml
exits 1 accept --golden g --prune; err_has 'two is left as it is: its scene is there again'; there g/two.png
exits 0 test --golden g
scene one.yaml blue
exits 2 test s/one.yaml one.yaml --golden g; err_has "one.yaml: it is not below \`root\`, $work/s"; out_has '1 golden: 1 same'
exits 0 test s s/one.yaml --golden g; out_has '3 goldens: 3 same'
rm one.yaml
# the name of a golden in place of its scene
exits 2 test one --golden g; ok 'in a line' [ "$(cat err)" = 'monge: cannot read one: No such file or directory; did you mean `s/one.yaml`?' ]
exits 2 test 'in/a b%' --golden g; says broken 'a b%'; out_has 'did you mean `s/in/a b%.yaml`?'
mv g/golden.yaml rules; exits 0 test s --golden g -q; exits 2 test 'in/a b%' --golden g; says broken 'a b%'; out_has 'did you mean `s/in/a b%.yaml`?'
exits 0 test s --golden g -q; exits 2 test none --golden g; out_lacks 'did you mean'; mv rules g/golden.yaml
for root in '' --root=s; do exits 2 test one.yaml --golden g $root; err_has 'cannot read one.yaml: No such file or directory'; err_lacks 'not below'; done

# Many orphans among what is there.
fresh 'kind: hash'
exits 0 test s/one.yaml s/two.yaml --golden g --update-only-failed -q
line=$(grep '^one ' g/golden.lock); line=${line#one}
seq -f "a%04g$line" 3000 >>g/golden.lock; seq -f "s%04g$line" 3000 >>g/golden.lock
exits 1 test s --golden g; out_has '6003 goldens: 2 same, 1 new, 6000 orphan'
exits 0 accept 'a*' 'in/*' --golden g --prune -q
ok 'the new line is at its place' sh -c 'grep -v "^#" g/golden.lock | LC_ALL=C sort -c'; exits 1 test s --golden g; out_has '3003 goldens: 3 same, 3000 orphan'
exits 0 accept --golden g --prune; out_has '0 taken, 3000 removed'; exits 0 test s --golden g -q
ok 'the lines that are left' [ "$(grep -o '^[^# ]*' g/golden.lock | tr '\n' ,)" = in/a%20b%25,one,two, ]
# What a frame makes may be called as another scene.
printf 'rules: [{scenes: turn, options: --frames all}]\n' >g/golden.yaml
printf 'image: {size: [20, 10], samples: 1}\nanimation: {frames: 3}\nscene: [{sphere: {}}]\n' >s/turn.yaml
cp s/one.yaml s/turn-0002.yaml
exits 2 test s --golden g -q; err_has 's/turn.yaml and s/turn-0002.yaml would both write turn-0002.png: rename one of them'

# ---- Orphans are told by runs of folders alone, and not of scenes that are there ----

for kind in png hash; do
    fresh "kind: $kind"; exits 0 test s --golden g --update-only-failed -q; sums g >before
    rm s/two.yaml # so that there is an orphan to find
    for from in 's/*.yaml' 's/**/*.yaml' s/one.yaml @list; do
        echo s/one.yaml >list
        for root in '' --root=s; do
            exits 0 test "$from" --golden g $root; says same one; out_lacks orphan
            exits 0 accept --golden g --prune; out_has '0 taken'
        done
    done
    last='test - --root s'; echo 's/in/a b%.yaml' | "$monge" test - --golden g --root s >out 2>err; status=$?
    ok 'a list on stdin' [ $status -eq 0 ]; says same 'in/a b%'; out_lacks orphan; exits 0 accept --golden g --prune
    ok "$kind: nothing is removed" [ "$(sums g)" = "$(cat before)" ]
    # a part of the folder: names count from there, and what is gone elsewhere may have moved, out of sight
    exits 1 test s/in --golden g; says new 'a b%'; out_lacks orphan
    (cd s && "$monge" test in --golden ../g --output ../monge-test >../out); out_lacks orphan
    exits 0 test s/in --golden g --root s; says same 'in/a b%'; out_lacks orphan
    exits 1 test s s/in --golden g --root s; says orphan two; ok 'the others are no orphans' [ "$(grep -c ^orphan out)" -eq 1 ]
    # of another root than golden.yaml has, and so of other names
    printf 'root: ../s\nkind: %s\n' $kind >g/golden.yaml
    exits 1 test --golden g --root s/in; says new 'a b%'; out_lacks orphan; exits 1 test --golden g --root ./s; says orphan two
    echo "kind: $kind" >g/golden.yaml
    scene s/two.YML gold; exits 0 test s --golden g; out_lacks orphan
    mv s/two.YML s/two.yaml; exits 0 test s --golden g; out_lacks orphan
    echo 'params: {a: 1}' >s/two.yaml; exits 1 test s --golden g; says orphan two # a library makes no picture
    echo 'Scene: [{sphere: {}}]' >s/two.yaml; exits 1 test s --golden g; says broken two; out_has 'did you mean `scene`?'; out_lacks orphan
    ok "$kind: the goldens are as they were" [ "$(sums g)" = "$(cat before)" ]
    # what comes back, or cannot be looked for any more, before the goldens go
    rm s/two.yaml; exits 1 test s --golden g; says orphan two
    scene s/two.yaml gold; exits 1 accept --golden g --prune; err_has 'two is left as it is: its scene is there again'
    rm s/two.yaml; exits 1 test s --golden g -q; mv s away; exits 1 accept --golden g --prune; err_has 'two is left as it is'; mv away s
    ok "$kind: and still are" [ "$(sums g)" = "$(cat before)" ]
    # other folders of an earlier run
    scene s/two.yaml gold; scene extra/in/more.yaml lime; rm -rf g/*.png g/in g/golden.lock; exits 0 test s extra --golden g --update-only-failed -q; sums g >before
    exits 0 test s --golden g; out_has '1 golden is of scenes that are not in this run'; exits 0 accept --golden g --prune
    exits 0 test extra --golden g; out_has '3 goldens are of scenes'; exits 0 accept --golden g --prune; ok "$kind: all are kept" [ "$(sums g)" = "$(cat before)" ]
    mkdir extra/bin; mv extra/in/more.yaml extra/bin/more.yaml; exits 1 test s --golden g; says orphan in/more
    mv s/two.yaml s/in/two.yaml; exits 1 test s --golden g; says orphan two; says new in/two; mv s/in/two.yaml s/two.yaml
    mv extra/bin/more.yaml s/more.yaml; exits 1 test s --golden g; says orphan in/more; out_lacks 'not in this run'
    rm -r extra s/more.yaml; exits 1 test s --golden g; says orphan in/more; exits 0 accept --golden g --prune; rm s/two.yaml; sums g >before
    # an operand that is nothing: the run is not of all
    mkdir empty; exits 2 test s empty --golden g; err_has 'there is no scene in this folder'; out_lacks orphan
    exits 2 test empty --golden g; out_lacks orphan; rmdir empty
    exits 1 test s --golden g -q; exits 0 accept --golden g --prune; out_has 'removed two'
done

# --root: the same names for every operand, before the root of golden.yaml
fresh 'root: nowhere'
exits 2 test --golden g; err_has 'g/golden.yaml: `root`: g/nowhere: No such file'
exits 1 test --golden g --root s; says new one; says new 'in/a b%'
exits 1 test 's/in/*.yaml' s/one.yaml --golden g --root ./s/../s; says new one; says new 'in/a b%'
exits 1 test s s/in s/one.yaml --golden g --root .; says new s/one; says new 's/in/a b%'; out_has '3 goldens: 3 new'
exits 2 test s --golden g --root s/in; err_has 's/one.yaml: it is not below the folder of --root'; says new 'a b%'
exits 2 test s --golden g --root none; err_has '--root none: No such file or directory'
: | "$monge" test @- --golden g --root s >out 2>err; status=$?; last='test @-'; ok 'an empty list' [ $status -eq 0 ]
err_has 'the list is empty: nothing to test'; out_has '0 goldens'
fresh; scene other/one.yaml red; exits 2 test s other --golden g; err_has 's/one.yaml and other/one.yaml would have the same golden, one: give --root, or golden.yaml a `root`'; rm -r other
# no root tells extensions apart
fresh; cp s/one.yaml s/one.yml
for root in '' --root=s; do
    exits 2 test s --golden g $root; ok 'a name is what helps' [ "$(cat err)" = 'monge: s/one.yaml and s/one.yml would have the same golden, one: rename one of them' ]
done
# files of two scenes: a pass that is called as a picture, and a folder that is
shared() { exits 2 test s --golden g; ok 'a line' [ "$(cat err)" = "monge: $1: rename one of them" ]; no_out; missing monge-test; }
fresh 'rules: [{scenes: one, aov: true}]'; cp s/one.yaml s/one.object.yaml; cp s/one.yaml s/one.depth.yaml
shared 's/one.yaml and s/one.object.yaml would both write one.object.png'
mv s/one.object.yaml s/one.objects.yaml; exits 1 test s --golden g -q; no_err # nor is depth a PNG
fresh 'rules: [{scenes: one, aov: true, options: "-D a=1,2"}]'; sed -i '1i params: {a: 1}' s/one.yaml; cp s/one.yaml s/one-a=2.normal.yaml
shared 's/one.yaml and s/one-a=2.normal.yaml would both write one-a=2.normal.png'
fresh 'kind: both'; mkdir s/golden.lock; cp s/two.yaml s/golden.lock/x.yaml
shared 'monge test writes golden.lock, which is a folder of what s/golden.lock/x.yaml writes, golden.lock/x.png'
fresh; mkdir s/one.png; cp s/two.yaml s/one.png/x.yaml; cp s/two.yaml 's/one.png!.yaml'
shared 's/one.yaml writes one.png, which is a folder of what s/one.png/x.yaml writes, one.png/x.png'
fresh 'rules: [{scenes: one, aov: true, options: --frames all}]'; sed -i '1i animation: {frames: 2}' s/one.yaml
cp s/two.yaml s/one.object.yaml; exits 1 test s --golden g -q; no_err # the frames have other names
cp s/two.yaml s/one-0001.object.yaml; sums g >before
exits 2 test s --golden g -q --update-only-failed; err_has 's/one.yaml and s/one-0001.object.yaml would both write one-0001.object.png: rename one of them'
ok 'nothing is taken' [ "$(sums g)" = "$(cat before)" ]
fresh; exits 1 test 's/**/*.yaml' --golden g; says new one; says new 'in/a b%'

# ---- Tolerances ----

fresh
exits 0 test s --golden g --update-only-failed -q
scene s/one.yaml '"#fd0000"'
tolerance() { printf 'rules: [{scenes: one, tolerance: {%s, reason: "why not"}}]\n' "$1" >g/golden.yaml; exits "$2" test s --golden g; }
rm -f g/golden.yaml; exits 1 test s --golden g; says changed one
tolerance 'max: 0.02' 0; says same one; out_has 'within its tolerance (why not): '; missing monge-test/new/one.png
tolerance 'max: 0.001' 1; says changed one; out_has 'allowed: no pixel by over 0.001'
tolerance 'pixels: 100%' 0
tolerance 'pixels: 1%' 1; ok 'a part' grep -qE '^ *allowed: at most 1% of the pixels$' out
tolerance 'pixels: 5' 1; ok 'a number' grep -qE '^ *allowed: at most 5 pixels$' out
tolerance 'pixels: 1' 1; ok 'one' grep -qE '^ *allowed: at most 1 pixel$' out
tolerance 'pixels: 5, max: 0.001' 1; out_has 'allowed: at most 5 pixels by over 0.001'
tolerance 'max: 0' 1; ok 'none' grep -qE '^ *allowed: no pixel$' out
tolerance 'pixels: 1200' 0
tolerance 'max: 0.001, pixels: 50%' 0
tolerance 'mae: 0.01' 0; tolerance 'mae: 0.0000001' 1
tolerance 'rmse: 0.01' 0; tolerance 'rmse: 0.0000001' 1
tolerance 'psnr: 30' 0; tolerance 'psnr: 100' 1
tolerance 'ssim: 0.9' 0; tolerance 'ssim: 1' 1
tolerance 'flip: 0.1' 0; tolerance 'flip: 0.0000001' 1
tolerance 'flip: 0.1, max: 0.001' 1
tolerance 'flip: 0.1, max: 0.02' 0
# what was measured beyond it is told, as it is in the metrics
if have python3; then
    for limit in 'mae: 0.0000001' 'rmse: 0.0000001' 'psnr: 100' 'ssim: 1' 'flip: 0.0000001'; do
        tolerance "max: 1, $limit" 1; last="beyond $limit"
        ok 'the value' [ "$(sed -n 's/^ *beyond: //p' out)" = "$(python3 -c '
import json, sys
scene, = [s for s in json.load(open("monge-test/results.json"))["scenes"] if s["name"] == "one"]
print(sys.argv[1], "%.6g" % scene["metrics"][sys.argv[1]])' "${limit%%:*}")" ]
    done
fi
tolerance 'pixels: 5, mae: 0, psnr: 1' 1; ok 'all that is beyond, alone' grep -qE '^ *beyond: [0-9]+ pixels, mae [0-9.e-]+$' out
ok 'in the results, too' grep -qE '"beyond": "[0-9]+ pixels, mae [0-9.e-]+"}' monge-test/results.json
tolerance 'pixels: 1%' 1; ok 'of all, as it is allowed' grep -qE '^ *beyond: [0-9.]+% of the pixels$' out
tolerance 'max: 0.02' 0; out_lacks 'beyond'; exits 0 test s --golden g --tap --junit junit.xml
ok 'TAP says what it passes by' grep -qE '^# within its tolerance \(why not\): [0-9]+ of 1200 pixels' out
ok 'so does JUnit, of it alone' [ "$(grep -cE '^ *<system-out>within its tolerance \(why not\): [0-9]+ of 1200 pixels.*</system-out>$' junit.xml)" -eq 1 ]
! have python3 || ok 'as XML' python3 -c 'import xml.etree.ElementTree as t; assert len(t.parse("junit.xml").getroot()[0]) == 3'
rm g/golden.yaml; echo 'tolerance: {flip: 0.1, reason: it says so itself}' >>s/one.yaml
exits 0 test s --golden g; out_has 'within its tolerance (it says so itself)'
tolerance 'max: 0.001' 1; says changed one # the settings go before the scene
printf 'rules: [{scenes: one, options: --size 41x30, tolerance: {pixels: 100%%, reason: r}}]\n' >g/golden.yaml
exits 1 test s --golden g; says changed one; out_has 'another size'
rm -rf g; exits 0 test s --golden g --golden-kind hash --update-only-failed -q; scene s/one.yaml '"#fe0000"'
echo 'tolerance: {flip: 0.1, reason: r}' >>s/one.yaml
none='its tolerance counts for nothing: a golden that is a hash has no pixels to compare, which `kind: png` keeps'
exits 1 test s --golden g --golden-kind hash; says changed one; out_has "$none"; out_lacks allowed; no_err
exits 0 accept --golden g; exits 0 test s --golden g --golden-kind hash; says same one; out_has "$none"
exits 0 test s --golden g --golden-kind hash --changed; says same one; out_has "$none"
ok 'of one scene alone' [ "$(grep -cF "$none" out)" -eq 1 ]
exits 0 test s --golden g --golden-kind both --update-only-failed; out_lacks 'counts for nothing'
fresh 'kind: hash' 'rules:' '  - {scenes: one, tolerance: {flip: 0.1, reason: r}}' '  - {scenes: two, kind: both, tolerance: {flip: 0.1, reason: r}}'
none='monge: warning: g/golden.yaml:3: the tolerance of this rule counts for nothing: goldens that are hashes have no pixels to compare, which `kind: png` keeps'
exits 1 test s --golden g; err_has "$none"; ok 'of one rule alone' [ "$(wc -l <err)" -eq 1 ]
exits 0 accept --golden g; no_err; exits 0 test s --golden g -q; err_has "$none"
exits 0 test s --golden g -q --old "$monge"; no_err
exits 1 test s --golden g -q --golden-kind png; no_err

# ---- Scenes of other names ----

for kind in png hash both; do
    fresh "kind: $kind"; cp s/two.yaml s/twin.yaml; exits 0 test s --golden g --update-only-failed -q
    mv s/one.yaml s/uno.yaml; rm s/twin.yaml; scene s/three.yaml blue
    exits 1 test s --golden g --junit junit.xml; says orphan one; says new uno; says new three; says orphan twin
    for tap in '' --tap; do
        exits 1 test s --golden g $tap
        out_has 'its picture is that of uno, which is new: was the scene renamed?'
        out_has 'its picture is that of the orphan one: was the scene renamed?'
        ok 'of none but these' [ "$(grep -c renamed out)" -eq 2 ]
    done
    exits 1 test s --golden g --junit junit.xml
    for file in junit.xml monge-test/results.json; do
        ok "$file has it of both" [ "$(grep -o 'its picture is that of the orphan one: was the scene renamed?\|its picture is that of uno, which is new: was the scene renamed?' $file | sort -u | wc -l)" -eq 2 ]
    done
    [ $kind != png ] || { head -c 200 g/one.png >x; cp x g/one.png; exits 1 test s --golden g; says orphan one; out_lacks renamed; }
    exits 0 accept --golden g --prune; exits 0 test s --golden g; out_has '4 goldens: 4 same'
done

# ---- From pictures to hashes ----

fresh; exits 0 test s --golden g --update-only-failed -q; echo 'kind: hash' >g/golden.yaml
exits 1 test s --golden g; out_has '3 goldens: 3 new'; out_has 'g/in/a b%.png and 2 more pictures are not compared: their goldens are hashes'
exits 0 accept --golden g; exits 0 test s --golden g; out_has 'and 2 more pictures are not compared'
exits 0 test s --golden g -q; out_lacks 'not compared'
exits 0 test s/one.yaml --golden g; out_has 'g/one.png is not compared: its golden is a hash'
mkdir g/shown; mv g/*.png g/in g/shown; exits 0 test s --golden g; out_lacks 'not compared' # for something else

# ---- Pictures of other kinds ----

for kind in png hash both; do
    fresh "kind: $kind" 'rules: [{scenes: one, options: "--bits 16 --encoding linear --region 3,4,20,21"}]'
    exits 0 test s --golden g --update-only-failed -q; exits 0 test s --golden g; exits 0 test s --golden g --changed
    [ $kind = png ] || ok 'a region of 16 bits' grep -q '^one 20x21x16 ' g/golden.lock
    sed -i 's/ --encoding linear//' g/golden.yaml; exits 1 test s --golden g; says changed one
    [ $kind = hash ] || out_has 'another colour space'
    sed -i 's/--bits 16/--encoding linear/' g/golden.yaml; exits 1 test s --golden g; says changed one
done
if have python3; then # a golden that somebody else has made
    fresh
    printf 'image: {size: [8, 6], samples: 1, background: black}\ncamera: {eye: [0, 0, 5], look_at: [0, 0, 10]}\nscene: [{sphere: {}}]\n' >s/dark.yaml
    python3 - <<'PYTHON'
import struct, zlib
def chunk(kind, data): return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
rows = b"".join(b"\0" + bytes(8) for _ in range(6))
open("g/dark.png", "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 8, 6, 8, 0, 0, 0, 0)) +
                               chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
PYTHON
    exits 0 test s/dark.yaml --golden g; says same dark
    rm -rf monge-test; exits 0 test s/dark.yaml --golden g --changed; out_lacks unchanged
    exits 0 test s/dark.yaml --golden g --changed; out_has unchanged
    sed -i 's/background: black/background: "#000001"/' s/dark.yaml
    exits 1 test s/dark.yaml --golden g; says changed dark; out_lacks 'the options'
fi

# ---- --changed ----

for kind in png hash both; do
    fresh "kind: $kind"
    exits 0 test s --golden g --update-only-failed -q
    exits 0 test s --golden g --changed; out_has '3 goldens: 3 same'; ok 'all are unchanged' [ "$(grep -c '  unchanged$' out)" -eq 3 ]
    rm -rf monge-test
    exits 0 test s --golden g --changed; ok 'without a run before too' [ "$(grep -c '  unchanged$' out)" -eq 3 ]
    echo '# a comment' >>s/one.yaml
    exits 0 test s --golden g --changed; says same one; ok 'the one is rendered' [ "$(grep -c '  unchanged$' out)" -eq 2 ]
    exits 0 test s --golden g --changed; ok 'and then unchanged since the run' [ "$(grep -c '  unchanged$' out)" -eq 3 ]
    scene s/one.yaml blue
    exits 1 test s --golden g --changed; says changed one
    exits 1 test s --golden g --changed; says changed one
    # a golden that is not what it was; of a hash that cannot be told without rendering
    if [ $kind = png ]; then
        "$monge" render -q s/two.yaml --size 40x31 -o x.png; cp x.png g/two.png
        exits 1 test s --golden g --changed; says changed two
    elif [ $kind = both ]; then
        sed -i '/^two /s/pixels=..../pixels=0000/' g/golden.lock
        exits 1 test s --golden g --changed; says missing two
    fi
done
if have python3; then # a picture that was edited by something that keeps its texts
    fresh
    exits 0 test s --golden g --update-only-failed -q
    "$monge" render -q s/one.yaml --shading signature -o x.png
    python3 - <<'PYTHON'
import struct
def chunks(path):
    data, at = open(path, "rb").read(), 8
    while at < len(data):
        size = struct.unpack(">I", data[at:at + 4])[0] + 12
        yield data[at + 4:at + 8], data[at:at + size]
        at += size
golden = open("g/one.png", "rb").read()[:8]
new = b"".join(c for kind, c in chunks("x.png") if kind == b"IDAT")
for kind, chunk in list(chunks("g/one.png")):
    if kind == b"IDAT": chunk, new = new, b""
    golden += chunk
open("g/one.png", "wb").write(golden)
PYTHON
    exits 1 test s --golden g --changed; says changed one; out_lacks 'the options and the program'
fi
fresh
printf 'include: ../common.yaml\nimage: {size: [8, 6], samples: 1}\nscene: [{sphere: {}, material: m}]\n' >s/three.yaml
echo 'materials: {m: {diffuse: red}}' >common.yaml
exits 0 test s --golden g --update-only-failed -q
echo 'materials: {m: {diffuse: blue}}' >common.yaml
exits 1 test s --golden g --changed; says changed three; ok 'only that' [ "$(grep -c '  unchanged$' out)" -eq 3 ]
exits 1 test s --golden g -q; echo 'materials: {m: {diffuse: lime}}' >common.yaml
exits 1 accept --golden g; err_has 'three is left as it is: the scene has changed since the run'

# ---- What changed ----

fresh 'rules: [{scenes: "*", aov: true}]'
exits 0 test s --golden g --update-only-failed -q
there g/one.object.png; there g/one.depth.pfm
exits 0 test s --golden g; out_lacks orphan
scene s/one.yaml blue 1.7
exits 1 test s --golden g
out_has 'object "ball" (s/one.yaml:5): shading changed, geometry equal: another material'
out_has 'object "lid" (s/one.yaml:8): geometry moved'
out_has 'object "floor" (s/one.yaml:11): shadow changed'
exits 0 accept --golden g; exits 0 test s --golden g
# what is gone has a place in the scene of then alone
cp s/one.yaml kept; sed -i '/^  - box/,/translate/d; s/^lights/\n\nlights/' s/one.yaml
exits 1 test s --golden g --json j.json --report r; out_has 'object "lid" (was at s/one.yaml:8): disappeared'; out_has 'object "floor" (s/one.yaml:'
for file in j.json r/index.html; do ok "$file has that place" grep -qF 'object \"lid\" (was at s/one.yaml:8): disappeared' $file; done
mv kept s/one.yaml; rm -r j.json r
# another camera: it alone, and no object is accused
sed -i 's/eye: \[0, 3, 8\]/eye: [0, 3, 7]/' s/one.yaml
exits 1 test s --golden g --json j.json --report r
out_has 'camera (s/one.yaml:2): moved'; out_lacks 'object "'; out_lacks 'other changes'
ok 'results say so too' grep -qF '"changes": ["camera (s/one.yaml:2): moved"]' j.json
ok 'and the page' grep -qF 'camera (s/one.yaml:2): moved' r/index.html
scene s/one.yaml blue 1.2; sed -i 's/look_at:/fov: 30, look_at:/' s/one.yaml
exits 1 test s --golden g
out_has 'camera (s/one.yaml:2): view changed'; out_has 'other changes too, which cannot be told by object under another camera'
out_lacks 'object "'
if have python3; then # a golden of a program that did not tell its camera
    cp g/one.object.png kept.png
    python3 - <<'PYTHON'
import struct
data = open("g/one.object.png", "rb").read()
at, kept = 8, data[:8]
while at < len(data):
    end = at + 12 + struct.unpack(">I", data[at:at + 4])[0]
    if not data[at + 8:].startswith(b"monge:camera\0"): kept += data[at:end]
    at = end
assert len(kept) < len(data)
open("g/one.object.png", "wb").write(kept)
PYTHON
    exits 1 test s --golden g; out_lacks 'camera ('; out_lacks 'other changes'; out_has 'object "ball" (s/one.yaml:5): geometry moved'
    cp kept.png g/one.object.png
fi
sed -i '/^camera/d' s/one.yaml; exits 1 test s --golden g -q; exits 0 accept --golden g -q
scene s/one.yaml blue 1.9; sed -i '/^camera/d' s/one.yaml
exits 1 test s --golden g; out_has "camera: framing by the scene's bounds changed"; out_has 'other changes too'; out_lacks 'object "'
# lights and settings: these, and what follows from them
scene s/one.yaml blue; exits 1 test s --golden g -q; exits 0 accept --golden g -q
sed -i 's/at: \[3/at: [-3/; s/^image: {/&background: "#203040", /' s/one.yaml
exits 1 test s --golden g --json j.json --report r
out_has 'point light (s/one.yaml:3): moved'; out_has 'background: colour changed'
out_has 'object "floor" (s/one.yaml:11): shadow changed'; out_has 'object "lid" (s/one.yaml:8): shading changed, geometry equal'
ok 'results say so too, the causes first' grep -qF '"changes": ["point light (s/one.yaml:3): moved", "background: colour changed", "object' j.json
ok 'and the page' grep -qF 'point light (s/one.yaml:3): moved' r/index.html
rm -r j.json r
scene s/one.yaml red; sed -i 's/at: \[3/color: [1, 1, 0.9], &/; s/samples: 1/samples: 2/' s/one.yaml
exits 1 test s --golden g
out_has 'point light (s/one.yaml:3): colour or strength changed'; out_has 'settings: samples 1 -> 2'
out_has 'object "floor" (s/one.yaml:11): shading changed, geometry equal'; out_has 'object "ball" (s/one.yaml:5): shading changed, geometry equal: another material'
if have python3; then # a golden of a program that did not tell them is told as by that program, and is left alone while it is the same
    scene s/one.yaml blue; exits 0 test s --golden g -q
    ok 'passes as of then' python3 - <<'PYTHON'
import re, struct, zlib
def chunk(kind, data): return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
for name in "object", "material":
    path = f"g/one.{name}.png"
    data = open(path, "rb").read()
    at, kept, gone = 8, data[:8], 0
    while at < len(data):
        size = struct.unpack(">I", data[at:at + 4])[0]
        kind, content = data[at + 4:at + 8], data[at + 8:at + 8 + size]
        at += 12 + size
        key = content.split(b"\0")[0]
        if kind == b"iTXt" and key in (b"monge:lights", b"monge:settings"):
            gone += 1
            continue
        if kind == b"iTXt" and key == b"monge:table" and name == "material":
            packed, text = content[len(key) + 1], content[len(key) + 5:]
            text, gone = re.subn(rb', "hash": "[0-9a-f]{32}"', b"", zlib.decompress(text) if packed else text)
            content = key + bytes(5) + text
        kept += chunk(kind, content)
    assert gone == 2, (name, gone) # two texts; two materials
    open(path, "wb").write(kept)
PYTHON
    before=$(sums g); exits 0 test s --golden g --update-only-failed -q; ok 'the same is left as it is' [ "$before" = "$(sums g)" ]
    cp g/one.object.png old.png; cp g/two.png g/one.png; exits 1 test s --golden g -q; exits 0 accept --golden g -q
    ok 'what is accepted tells them, of the same scene too' grep -q monge:lights g/one.object.png
    mv old.png g/one.object.png; sed -i 's/at: \[3/at: [-3/' s/one.yaml; exits 1 test s --golden g
    out_lacks 'point light'; out_lacks 'by that'; out_has 'object "ball" (s/one.yaml:5): shading changed, geometry equal'
    exits 0 accept --golden g -q
fi
rm s/one.yaml; exits 1 test s --golden g; exits 0 accept --golden g --prune; missing g/one.object.png
# other bits or another encoding alone are no shading; what moved or is of another material is told still
for options in '--bits 16' '--encoding linear'; do
    fresh 'rules: [{scenes: one, aov: true}]'; sed -i 's/^    material: {diffuse: red}/    material: m/; 1i materials: {m: {diffuse: red}, n: {diffuse: blue}}' s/one.yaml
    exits 0 test s --golden g --update-only-failed -q; sed -i "s/aov: true/&, options: $options/" g/golden.yaml
    exits 1 test s --golden g; says changed one; out_lacks ' changed, geometry'; out_lacks 'shadow changed'; out_lacks 'background'; out_lacks 'geometry moved'
    case $options in *16) out_has 'settings: bits 8 -> 16' ;; *) out_has 'settings: encoding srgb -> linear' ;; esac
    sed -i 's/material: m$/material: n/; s/\[1.5, 0/[1.7, 0/' s/one.yaml; exits 1 test s --golden g
    out_has 'object "ball" (s/one.yaml:6): shading changed, geometry equal: another material'; out_has 'object "lid" (s/one.yaml:9): geometry moved'; out_lacks floor; out_lacks background
done
fresh 'kind: hash' 'rules: [{scenes: one, aov: true}]'; exits 0 test s --golden g --update-only-failed -q; sed -i "s/aov: true/&, options: --bits 16/" g/golden.yaml
exits 1 test s --golden g; out_has 'geometry and shadow equal'; out_lacks 'shading changed'
fresh 'kind: hash' 'rules: [{scenes: "*", aov: true}]'
exits 0 test s --golden g --update-only-failed -q
ok 'hashes of passes' grep -qE '^one .* depth=[0-9a-f]{32} normal=[0-9a-f]{32} shadow=[0-9a-f]{32}$' g/golden.lock
scene s/one.yaml blue; exits 1 test s --golden g; out_has 'shading changed, geometry and shadow equal'
scene s/one.yaml red 1.7; exits 1 test s --golden g; out_has 'geometry changed'
scene s/one.yaml red; sed -i 's/at: \[3/at: [-3/' s/one.yaml; exits 1 test s --golden g; out_has 'shadow changed, geometry equal'

# ---- The old picture of a hash ----

fresh 'kind: hash'
sed -i 's/diffuse: red/diffuse: tint/; 1iparams: {tint: red}' s/one.yaml
exits 0 test s --golden g --update-only-failed -q
sed -i 's/tint: red/tint: blue/' s/one.yaml
printf '#!/bin/sh\nexec "%s" "$@" -D tint=red\n' "$monge" >old; printf '#!/bin/sh\nexit 1\n' >older; chmod +x old older
exits 1 test s --golden g --old ./old; says changed one; out_has 'flip'; there monge-test/old/one.png
exits 1 test s --golden g --old ./older; out_has './older makes no picture of it'; missing monge-test/old/one.png
# a program that cannot be run at all
echo >plain; chmod -x plain
for old in /nonexist ./old/x plain/ . s/ ./plain 'monge --x' nowhere-at-all; do
    exits 2 test s --golden g --old "$old"; no_out
    case $old in
    */nonexist) why='No such file or directory' ;;
    ./old/x | plain/) why='Not a directory' ;;
    . | s/ | ./plain) why='Permission denied' ;;
    *) why='there is no such program in the PATH' ;;
    esac
    ok 'the reason, once' [ "$(cat err)" = "monge: --old $old: $why" ]
done
mkdir -p bin; cp old bin/old-monge; last='test --old from the PATH'
PATH=$work/bin:$PATH "$monge" test s --golden g --old old-monge >out 2>err; says changed one; there monge-test/old/one.png; rm -r bin plain
cp g/golden.lock lock; sed -i '/^one /s/program=......../program=00000000/' g/golden.lock
exits 1 test s --golden g; out_has 'the golden is of another program (sources 00000000'; out_has '`--old PROGRAM` shows it, where you have that'
exits 1 test s --golden g --old "$monge"; out_lacks 'where you have that'; cp lock g/golden.lock
exits 1 test s --golden g --old "$monge"; says changed one; out_has 'one  its pixels are not those of the hash'
out_has "$monge does not make the golden's picture of it: the scene has changed, or that is not the program of then"
if have git; then
    export GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a
    sed -i 's/tint: blue/tint: red/' s/one.yaml
    git init -q . && git add s g && git commit -qm old && echo >>g/golden.lock && git commit -qam later
    cp monge-test/../s/one.yaml was.yaml
    sed -i 's/tint: red/tint: blue/' s/one.yaml
    exits 1 test s --golden g; out_has 'old: old=$(mktemp -d) && git worktree add'
    sed -n 's/^ *old: //p' out >command
    PATH=$(dirname "$monge"):$PATH sh command >/dev/null 2>&1
    "$monge" render -q was.yaml -o was.png
    ok 'the command gives the old picture' sh -c 'grep -qa "$(grep -ao "monge:pixels.[0-9a-f]*" was.png | tail -c 32)" old.png'
    # not where nothing can come of it
    cp -r g gkept; sed -i 's/pixels=..../pixels=0000/' g/golden.lock
    exits 1 test s --golden g; says changed two; out_lacks 'old: ' # no commit has the line
    git commit -qam edited; exits 1 test s --golden g
    ok 'nor for a scene that is the same' [ "$(grep -c 'old: ' out)" -eq 1 ]; says changed two
    git rm -q --cached s/one.yaml; exits 1 test s --golden g; says changed one; out_lacks 'old: ' # no commit has the scene
    rm -rf .git g; mv gkept g
    exits 1 test s --golden g; says changed one; out_lacks 'old: '
fi

# ---- For programs ----

fresh
exits 0 test s/one.yaml --golden g --update-only-failed -q
scene s/one.yaml blue; echo 'scene: [{sphre: {}}]' >'s/b&<"d#.yaml'
exits 1 test s --golden g --tap; no_err
ok 'TAP' [ "$(head -n 1 out)" = 'TAP version 13' ]
ok 'its plan' grep -qx '1..4' out
ok 'its escapes' grep -qx 'not ok 1 - b&<"d\\#' out
ok 'its first error' [ "$(sed -n '/^not ok 1 /,/^  lines/s/^  detail: //p' out)" = '"s/b&<\"d#.yaml:1:10: error[unknown-key]: an object has no key `sphre`"' ]
ok 'as many as planned' [ "$(grep -cE '^(not )?ok [0-9]+ - ' out)" -eq 4 ]
cp 's/b&<"d#.yaml' kept.yaml; printf 'scene:\n  - sphere: {}\n    transform: {rotate: {x: 1.5708}}\n  - sphre: {}\n' >'s/b&<"d#.yaml'
exits 1 test s --golden g --tap --junit junit.xml; ok 'a warning goes before it' grep -q '^  lines: ".*: warning\[.*: error\[' out
ok 'and is not it' grep -q '^  detail: ".*:4:5: error\[' out; ok 'in JUnit, too' grep -q '<error type="broken" message="[^"]*:4:5: error\[' junit.xml; cp kept.yaml 's/b&<"d#.yaml'
exits 1 test s --golden g --junit junit.xml --json results.json --report r
there r/index.html; ok 'the same document' cmp results.json monge-test/results.json
exits 1 test s --golden g --json -; err_has 'changed  one'; ok 'a document alone' [ "$(head -c 10 out)" = '{"about": ' ]
if have python3; then
    ok 'JSON' python3 - <<'PYTHON'
import json, re
run = json.load(open("results.json"))
assert run["summary"] == {"same": 0, "changed": 1, "new": 2, "missing": 0, "orphan": 0, "broken": 1}, run["summary"]
assert run["golden"] == "g" and re.fullmatch("[0-9a-f]{32}", run["program"])
by = {s["name"]: s for s in run["scenes"]}
assert list(by) == ['b&<"d#', "in/a b%", "one", "two"], list(by)
one = by["one"]
assert one["status"] == "changed" and one["scene"] == "s/one.yaml" and one["command"].startswith("monge render s/one.yaml")
assert set(one["metrics"]) == {"exact", "max", "mae", "rmse", "psnr", "ssim", "flip"}
assert 0 < one["metrics"]["flip"] < 1 and one["pixels"]["different"] > 0
assert one["differs"] == {"text": True, "options": False, "program": False}
assert one["pictures"] == {"golden": "g/one.png", "new": "monge-test/new/one.png"}
assert one["stamp"]["size"] == [40, 30] and one["stamp"]["pixels"] != one["golden_stamp"]["pixels"]
assert "sphre" in by['b&<"d#']["message"]
PYTHON
    ok 'JUnit' python3 - <<'PYTHON'
import xml.etree.ElementTree as tree
suite = tree.parse("junit.xml").getroot().find("testsuite")
assert (suite.get("tests"), suite.get("failures"), suite.get("errors")) == ("4", "3", "1"), suite.attrib
cases = {(c.get("classname"), c.get("name")): c for c in suite}
assert cases["in", "a b%"].find("failure").get("type") == "new"
assert "sphre" in cases["scenes", 'b&<"d#'].find("error").text
assert "monge render" in cases["scenes", "one"].find("failure").text
error = cases["scenes", 'b&<"d#'].find("error")
assert error.get("message").endswith("error[unknown-key]: an object has no key `sphre`"), error.get("message")
assert error.text.startswith(error.get("message") + "\n") and "did you mean" in error.text, error.text
PYTHON
fi
exits 0 accept one --golden g; exits 0 test s/one.yaml --golden g --changed --junit junit.xml --tap
out_has '# SKIP unchanged'; ok 'JUnit skips' grep -q '<skipped' junit.xml
# what is taken passes, and says so; what cannot be does not
fresh; exits 1 test s --golden g -q; exits 0 accept two --golden g -q; scene s/two.yaml lime; mkdir away; ln -s ../away g/in
exits 2 test s --golden g --update-only-failed --tap --junit junit.xml; cp out tap
ok 'taken' [ "$(grep -A 1 '^ok' tap | cut -d ' ' -f 1,4- | tr '\n' '|')" = 'ok one|# taken: the new picture is its golden now|ok two|# taken: the new picture is its golden now|' ]
ok 'each as what it was' [ "$(grep '^# .*, and taken' tap | cut -c 3-9)" = $'new, an\nchanged' ]; ok 'left' grep -qx 'not ok 1 - in/a b%' tap
ok 'the counts of JUnit' grep -q 'tests="3" failures="1" errors="0"' junit.xml; ok 'what fails there' [ "$(grep -c '<failure' junit.xml)" -eq 1 ]
ok 'JUnit says so' [ "$(grep -o '<system-out>.*<' junit.xml | tr '\n' '|')" = '<system-out>new, and taken: the new picture is its golden now<|<system-out>changed, and taken: the new picture is its golden now<|' ]
rm -r g/in away; exits 1 test s --golden g --tap; ok 'they are' [ "$(grep -c '^ok' out)" -eq 2 ]
scene s/one.yaml lime; exits 0 test s --golden g --update-only-failed -q; ok 'quietly, too' [ "$(grep -c '^ *taken: the new picture is its golden now$' out)" -eq 2 ]

fresh; printf 'animation: {frames: 2}\nimage: {size: [400, 300]}\nscene: [{sphere: {}}]\n' >s/two.yaml; printf 'scene: [{spere: {}}]\n' >s/in/wrong.yaml
printf 'rules: [{scenes: two, options: --frames all}]\n' >g/golden.yaml
exits 1 test s --golden g -j 2 --progress json; out_has '5 goldens: 4 new, 1 broken'
ok 'all are done in the end' grep -q '^{"done": 5, "total": 5, "rendered": 4, "unchanged": 0, "failed": 1, "part": 1.0000, .*"seconds_left": 0.000, "running": \[\]}$' err
ok 'a line for each' [ "$(grep -o '^{"done": [0-9]*' err | sort -u | grep -vc ' 0$')" -eq 5 ]; ok 'and nothing else' [ "$(grep -vc '^{"done": ' err)" -eq 0 ]
exits 1 test s --golden g --progress json --json -; err_has 'broken   in/wrong'; err_lacks 'monge accept'
mkdir many; for i in {1..300}; do cp s/in/wrong.yaml many/$i.yaml; done
for i in 1 2 3 4 5; do # threads do not speak in between, whoever is first
    exits 1 test many --golden g -j 4 --progress json --json -
    ok 'lines are whole' [ "$(grep -cx 'broken   [0-9]*' err)" -eq 300 ]; ok 'so are objects' [ "$(grep -c '^{"done": .*}$' err)" -eq "$(grep -c '"done"' err)" ]
done
rm -r many monge-test
exits 1 test s --golden g --progress always -q; exits 1 accept --golden g; err_has 'in/wrong is left as it is: it is broken'
exits 1 test s --golden g --changed --progress json; ok 'what is not rendered' grep -q '"rendered": 0, "unchanged": 4, "failed": 1, "part": 1.0000' err
exits 1 test s --golden g; no_err
for samples in 4 16 64 256 1024; do
    printf 'rules: [{scenes: two, options: --frames all --samples %s}]\n' $samples >g/golden.yaml
    exits 1 test s --golden g -j 1 --threads 1 --progress always; grep -q 'pictures  two' err && break
done
ok 'a bar, which is gone in the end' grep -qE $'^\r[1-4] of [45] pictures  two-000[12]  \\[.*\r +\r$' <(tr -d '\n' <err; echo)

if have script; then
    script -qec "'$monge' test s --golden g -j 1 --threads 1 --progress always" /dev/null </dev/null >terminal 2>&1
    ok 'a bar on the terminal' grep -q 'pictures  two' terminal
    ok 'what is told has lines of its own' sh -c '! tr "\r" "\n" <terminal | grep -q "\].*two-000"'
fi

# ---- What is in tools/ci ----

fresh 'root: ../s' 'kind: hash'
mv g goldens
mkdir -p .monge/build; ln -sf "$monge" .monge/build/monge
step() { sed -n 's/^ *run: \(\.monge.*\)/\1/p' "$tools/goldens.yml" >step; last='the step of the workflow'; sh step >out 2>err; status=$?; ok "the step of the workflow is $1" [ $status -eq "$1" ]; }
step 1; says new one; there monge-report/index.html; there monge-report/junit.xml
exits 0 accept --golden goldens; step 0
have python3 && python3 -c 'import yaml' 2>/dev/null && for file in "$tools"/*.yml; do
    ok "$file is YAML" python3 -c 'import sys, yaml; assert yaml.safe_load(open(sys.argv[1]))["jobs"]' "$file"
done
if have python3 && python3 -c 'import yaml' 2>/dev/null; then # as the server does: bash -e
    python3 -c 'import sys, yaml; print(yaml.safe_load(open(sys.argv[1]))["jobs"]["goldens"]["steps"][0]["run"])' "$tools/goldens.yml" >step
    asks() { last='the first step'; env "${@:2}" bash -e step >out 2>err; status=$?; ok "the first step is $1 with ${*:2}" [ $status -eq "$1" ]; }
    asks 0 MONGE_REPOSITORY=a/b MONGE_VERSION=v1; no_out; no_err
    asks 1 MONGE_REPOSITORY= MONGE_VERSION=; out_has '::error::variables of this repository are missing: MONGE_REPOSITORY MONGE_VERSION (Settings,'
    asks 1 MONGE_REPOSITORY=a/b MONGE_VERSION=; out_has 'are missing: MONGE_VERSION ('
fi
if have git; then
    export GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a
    # the five steps of grammar/testing.md, as somebody would type them
    mkdir -p steps/mine/scenes steps/bin steps/monge/tools; ln -s "$monge" steps/bin/monge; ln -s "$tools" steps/monge/tools/ci
    scene steps/mine/scenes/one.yaml red
    sed -n '/^## In continuous integration/,/^## /p' "$tools/../../grammar/testing.md" | awk '/^```sh/ { on = 1; next } /^```/ { on = 0 } on' >steps/all
    mine() { last='the five steps'; (cd steps/mine && PATH=$work/steps/bin:$PATH "$@") >out 2>err; status=$?; }
    mine git init -q .; mine sh ../all; says new one; out_has '1 taken'; ok 'the steps end well' [ $status -eq 0 ]
    ok 'two commits' [ "$(git -C steps/mine log --oneline | wc -l)" -eq 2 ]; ok 'of all there is' [ -z "$(git -C steps/mine status --short)" ]
    there steps/mine/.github/workflows/goldens.yml
    mine monge test --golden goldens; says same one; ok 'and the scenes are the same' [ $status -eq 0 ]
    scene steps/mine/scenes/one.yaml blue; mine git commit -qam x; ok 'the hook stops a change' [ $status -ne 0 ]
    mine monge test --golden goldens; says changed one; out_has 'old: '
    mine monge accept --golden goldens; mine git add goldens; mine git commit -qam x; ok 'which is meant' [ $status -eq 0 ]
    rm -rf steps monge-test monge-report
    git init -q . && git add s goldens && cp "$tools/pre-commit" .git/hooks/pre-commit
    commit() { last='git commit'; MONGE=$monge git commit -qm "$2" >out 2>err; status=$?; ok "git commit is $1: $2" [ $status -eq "$1" ]; }
    commit 0 'goldens as they are'
    scene s/one.yaml blue
    commit 1 'nothing to commit' # git says so itself
    git add s; commit 1 'a scene that changes'; err_has '`'"$monge"' accept --golden goldens` takes what is meant'
    exits 1 test --golden goldens -q; exits 0 accept --golden goldens
    commit 1 'the golden is not in the index'
    git add goldens; commit 0 'a scene with its golden'
    echo '# comment' >>s/two.yaml; git add s; commit 0 'a scene that stays as it looks'; err_lacks pre-commit
    scene s/one.yaml lime; git add s; commit 1 'as it is in the folder'; err_lacks 'git add'
    scene s/one.yaml blue; commit 1 'a change that is staged alone'
    ok 'what to stage is told first' [ "$(sed 2q err)" = "pre-commit: in $work, files are not staged as they are; where they belong to the commit:
    git add s/one.yaml" ]; err_has "pre-commit: else, in $work, "'`'"$monge test --golden goldens"'` shows it, and'
    exits 0 test --golden goldens -q; git add s
    for broken in 'scene: [{sphere: {raduis: 1}}]' 'scene: ['; do
        echo "$broken" >s/one.yaml; git add s; commit 1 'a scene that is broken'; err_has 'test --golden goldens` shows it'; err_lacks 'takes what is meant'; err_lacks 'git add'
    done
    scene s/one.yaml blue; git add s
    scene s/forgotten.yaml red; scene other.yaml red; exits 1 test --golden goldens -q; exits 0 accept --golden goldens; git add goldens
    commit() { last='git commit'; MONGE=$monge git commit -qm "$2" >err 2>&1; status=$?; ok "git commit is $1: $2" [ $status -eq "$1" ]; } # as a terminal shows it
    commit 1 'a golden whose scene is not staged'; ok 'what to stage is told first' [ "$(sed -n '2p; 3s/ .*//p' err)" = '    git add s/forgotten.yaml
orphan' ]; err_lacks 'takes what is meant'; err_lacks --prune
    scene "s/it's new.yaml" red; echo >>s/two.yaml; commit 1 'one more'; ok 'each is told' [ "$(sed -n 2,4p err)" = "    git add s/forgotten.yaml
    git add 's/it'\\''s new.yaml'
    git add s/two.yaml" ]; rm "s/it's new.yaml"; git checkout -q s/two.yaml
    for i in 1 2 3 4 5 6 7 8 9; do echo x >s/a$i.yaml; done; commit 1 'very many'; ok 'some are told' [ "$(sed -n 10,11p err)" = '    git add s/a9.yaml
    and 1 more, see git status' ]; rm s/a?.yaml
    git add s; commit 0 'with its scene'
    last='git commit'; ln -s "$monge" program; MONGE=./program git commit --allow-empty -qm x >out 2>err; ok 'a program in the folder' [ $? -eq 0 ]
    mkdir -p s/deep; cd s/deep; MONGE=./program git commit --allow-empty -qm x >../../out 2>../../err; ok 'from the top' [ $? -eq 0 ]; cd ../..; rm program
    git rm -qf s/two.yaml; commit 1 'a scene that is gone'; err_has '`'"$monge"' accept --golden goldens --prune` takes what is meant'
    exits 1 test --golden goldens -q; exits 0 accept --golden goldens --prune; git add goldens; commit 0 'its golden, too'
    last='git commit'; MONGE=no/monge git commit --allow-empty -qm x >out 2>err; ok 'no program' [ $? -eq 1 ]
    ok 'is told in a line' [ "$(cat err)" = 'pre-commit: there is no program no/monge: MONGE=/path/to/monge git commit, or write that path into .git/hooks/pre-commit' ]
    rm -rf .git
fi
rm -rf goldens

# ---- Commands to copy ----

# of options that somebody else has written, nothing is a command
fresh 'kind: hash' 'rules:' '  - {scenes: one, options: "--samples 2 -D '"'"'a=1 + 2'"'"' -D b=3"}'
sed -i '1i params: {a: 1, b: 2}' s/one.yaml
exits 1 test s --golden g -q; exits 0 accept --golden g
if have git; then
    export GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a
    git init -q . && git add s g && git commit -qm first; echo '# more' >>s/one.yaml
    sed -i 's/pixels=......../pixels=00000000/' g/golden.lock; git commit -qm second g
    exits 1 test s --golden g; out_has "--samples 2 -D 'a=1 + 2' -D b=3 -o old.png"
    sed -i 's/options=.*/options=--samples 2;touch hurt $(touch hurt) -D a=`touch hurt`/' g/golden.lock
    exits 1 test s --golden g; out_has "--samples '2;touch' hurt '\$(touch' 'hurt)' -D 'a=\`touch' 'hurt\`' -o old.png"
    sed -i "s/options=.*/options=-D 'a=it'\\\\''s 1 -D b=2' -D c=''/" g/golden.lock; git commit -qm fourth g
    exits 1 test s --golden g; out_has "-D 'a=it'\\''s 1 -D b=2' -D c= -o old.png"
    rm -rf .git
fi
fresh

# that of a report takes one, and no other: not what its name would match as a glob, nor whatever a shell makes of it
rm -rf s 'g h' t; scene 's/a*.yaml' red; scene 's/ab.yaml' gold; scene "s/[a] 'b.yaml" teal; scene s/-c.yaml teal
exits 1 test s --golden 'g h' --output t; out_has "\`monge accept --golden 'g h' --output t\` takes"
mkdir bin; ln -s "$monge" bin/monge
if have python3; then
    for name in 'a*' "[a] 'b" -c; do
        python3 -c 'import json, sys; print([s["accept_command"] for s in json.load(open("t/results.json"))["scenes"] if s["name"] == sys.argv[1]][0])' "$name" >command
        env PATH="$PWD/bin:$PATH" sh ./command >out 2>err; ok "$name is taken by its command" [ -s "g h/$name.png" ]
        ok 'alone' [ "$(grep -c '^took' out)" -eq 1 ]
    done
    ok 'the other one is not' [ ! -e 'g h/ab.png' ]
fi
rm -rf bin 'g h' t

# ---- What goes wrong ----

fresh 'kind: hash'; exits 1 test s --golden g -q
last='two times accept at once'
for _ in 1 2 3 4 5; do
    rm -f g/golden.lock
    "$monge" accept one --golden g -q & first=$!
    "$monge" accept two --golden g -q; wait $first
    ok 'neither undoes the other' [ "$(grep -c pixels= g/golden.lock)" -eq 2 ]
done
for file in golden.lock golden.yaml; do
    fresh; rm -f g/golden.yaml; ln -s /dev/zero g/$file
    exits 2 test s --golden g; err_has "g/$file is not a file"
    rm g/$file
done
# what is no file is told as that
for way in 'mkdir' 'mkfifo' 'ln -s /dev/null' 'ln -s nowhere'; do
    for kind in png both; do
        fresh "kind: $kind"; $way g/one.png
        exits 1 test s --golden g; says broken one; out_has 'g/one.png is not a file: it is in the way of the golden'
        exits 1 test s --golden g --changed; says broken one; exits 1 accept one --golden g; out_has '0 taken'; err_has 'one is left as it is: it is broken'; exits 1 accept --golden g; out_has '2 taken, 1 left as they are'
        ok 'it stays as it is' [ ! -f g/one.png ]; rm -rf g/one.png
        exits 1 test s --golden g; says new one
    done
done
fresh; mkfifo g/pipe.png; exits 1 test s --golden g; out_lacks orphan
fresh; exits 0 test s --golden g --update-only-failed -q; mkfifo pipe; ln -s ../pipe g/pipe.png; exits 1 test s --golden g; says orphan pipe; rm pipe
# goldens where the run writes
fresh; exits 1 test s --golden g -q; exits 0 accept --golden g -q; sums g >before; ln -sfn g link
for folder in g ./g g/ g/. g/../g link link/. "$work/g" s/../link; do
    exits 2 test s --golden g --output "$folder"; err_has "--output $folder would write into the folder of the goldens, g"
    exits 2 test s --golden "$folder" --output g; no_out
done
mkdir -p run/new run/old
for folder in run/new run/old/ run; do exits 2 test s --golden $folder --output run; err_has 'would write into the folder of the goldens'; done
ok 'the goldens are as before' [ "$(sums g)" = "$(cat before)" ]; rm -rf link run
for folder in g/run g/in/../run ./g/a/b "$work/g/run"; do
    exits 2 test s --golden g --output "$folder"; err_has "--output $folder would write into the folder of the goldens, g"; no_out
    exits 2 test s --golden g --report "$folder"; err_has "--report $folder would write into the folder of the goldens, g"; no_out
done
exits 2 test s --golden g-too/new/x --output g-too; err_has 'would write into the folder of the goldens'
exits 0 test s --golden g --output g-too -q; rm -rf g-too # another folder, though its name begins so
ok 'the goldens are as before' [ "$(sums g)" = "$(cat before)" ]
# documents over what is read, or over each other
ln s/two.yaml hard; ln -s g/one.png soft; echo 'image: {}' >more.yml; sums s >scenes; rm -rf monge-test
for option in json junit; do
    refuses() { exits 2 test s --golden g --$option "$1"; ok 'a line' [ "$(cat err)" = "monge: --$option $1$2" ]; no_out; missing monge-test; }
    for file in g/golden.yaml g/one.png g/golden.lock g/new.json soft; do refuses $file ' would write into the folder of the goldens, g'; done
    refuses hard ' would write over a scene of the run'; refuses s/two.yaml ' would write over a scene of the run'
    for file in more.yml s/none.YAML x.png x.lock; do refuses $file ': the name ends as those of scenes and goldens do: choose another'; done
done
exits 2 test s --golden g --json j --junit ./j; err_has '--json and --junit would write the same file, ./j'; missing j
exits 2 test s --golden g --junit monge-test/results.json; err_has '--output and --junit would write the same file'
exits 2 test s --golden g --report r --json r/index.html; err_has '--report and --json would write the same file'
exits 0 test s --golden g --json monge-test/results.json --junit j -q; exits 0 test s --golden g --json /dev/null --junit /dev/null -q
ok 'nothing that is read is touched' [ "$(sums g; sums s)" = "$(cat before scenes)" ]; rm -f hard soft more.yml j
exits 2 test s --golden g --report ./g; err_has '--report ./g would write into the folder of the goldens, g'; missing g/index.html
exits 2 test s --golden fresh --output new/../fresh; err_has 'would write into'; missing fresh; missing new
exits 1 test s --golden fresh --output /fresh/../$work/./away/../fresh.2 -q; rm -rf fresh.2
# passes that are asked for later
for kind in png hash both; do
    fresh "kind: $kind"; exits 1 test s --golden g -q; exits 0 accept --golden g -q; exits 0 test s --golden g -q
    printf 'kind: %s\nrules: [{scenes: one, aov: true}]\n' $kind >g/golden.yaml
    exits 1 test s --golden g; says missing one; out_has 'the golden has not all the passes that `aov: true` asks for'; out_has '2 same, 1 missing'
    exits 0 accept --golden g -q; exits 0 test s --golden g -q
    if [ $kind != hash ]; then # one that has gone, and a picture that has, whose passes are no goldens of their own
        rm g/one.depth.pfm; exits 1 test s --golden g; says missing one; exits 0 accept --golden g -q; there g/one.depth.pfm
        rm g/one.png; exits 1 test s --golden g; out_lacks orphan; exits 0 accept --golden g --prune; out_lacks removed
        exits 0 test s --golden g -q
    fi
    scene s/one.yaml red 1.2; exits 1 test s --golden g; says changed one; out_has 'geometry'
done
# passes that are damaged, and what is left of a golden whose picture has gone
for kind in png both; do
    fresh "kind: $kind" 'rules: [{scenes: one, aov: true}]'; exits 0 test s --golden g --update-only-failed -q; exits 0 test s --golden g; no_err
    for pass in object.png material.png depth.pfm normal.png shadow.png; do
        head -c 100 g/one.$pass >x; ok "less than all of $pass" sh -c "! cmp -s x g/one.$pass"; cp x g/one.$pass
        exits 1 test s --golden g; says missing one; out_has " g/one.$pass: "; out_has '2 same, 1 missing'
        exits 1 test s --golden g --changed; says missing one
        exits 0 accept --golden g -q; exits 0 test s --golden g
    done
    # a PFM has no sums: the hash that the objects have tells
    flip g/one.depth.pfm 1000; exits 1 test s --golden g; says missing one; out_has '2 same, 1 missing'
    out_has 'cannot read g/one.depth.pfm: it is damaged, or not of the rendering that the layer object is of'
    flip g/one.depth.pfm 1000; exits 0 test s --golden g; flip g/one.depth.pfm 1000
    exits 1 test s --golden g -q; exits 0 accept --golden g -q; exits 0 test s --golden g
    [ $kind != png ] || { rm g/one.png; exits 1 test s --golden g; says missing one; out_has 'g/one.png is not there, but its passes are'; }
    exits 0 test s --golden g --update-only-failed -q
    # without aov nothing is said of them but that they are there
    echo "kind: $kind" >g/golden.yaml; head -c 300 g/one.depth.pfm >x; cp x g/one.depth.pfm
    exits 0 test s --golden g; out_has 'the passes of one are not compared: its rule has no `aov: true`'; there g/one.object.png
    cp g/one.depth.pfm g/two.depth.pfm; exits 0 test s --golden g; out_has 'the passes of one and 1 more goldens are not compared: their rules have no `aov: true`'
    exits 0 test s --golden g -q; out_lacks passes
    [ $kind != png ] || { rm g/one.png; exits 1 test s --golden g; says missing one; }
done
# what is wrong with a folder is told once
fresh; for path in nowhere s/one.yaml/x; do
    exits 2 test --golden g --root $path; ok 'a root that is not there, once' [ "$(grep -c "^monge: --root $path: " err)" -eq 1 -a "$(wc -l <err)" -eq 1 ]
    exits 2 test s --golden g --root $path; ok 'nor with scenes twice' [ "$(wc -l <err)" -eq 1 ]
done
if [ "$(id -u)" -ne 0 ]; then
    for kind in png hash both; do
        fresh 'root: ../s' "kind: $kind"; exits 1 test --golden g -q; chmod a-w g
        foresees 2; ok 'once' [ "$(cat err)" = 'monge: cannot write into g: Permission denied' ]; ok 'nothing is taken' [ "$(cat out)" = '0 taken' ]
        chmod u+w g; exits 0 accept --golden g -q; rm s/one.yaml 's/in/a b%.yaml'; exits 1 test --golden g -q; chmod a-w g
        foresees 2 --prune; ok 'once' [ "$(cat err)" = 'monge: cannot write into g: Permission denied' ]
        chmod u+w g; exits 0 accept --golden g --prune -q
    done
    fresh; exits 1 test s --golden g -q; exits 0 accept --golden g -q 'in/*'; chmod a-w g/in; scene 's/in/a b%.yaml' red; exits 1 test s --golden g -q
    foresees 2; err_has 'cannot write into g/in: Permission denied'; out_has '2 taken'; chmod u+w g/in
else
    left_out 'folders that cannot be written: root can'
fi
# what may not be read is told as that: by another user, where this one is root
fresh 'root: ../s'; cp "$monge" any; chmod 755 "$work"; chmod 0 g; last='test with goldens that may not be read'
as=(); [ "$(id -u)" -ne 0 ] || as=(setpriv --reuid=65534 --clear-groups)
if "${as[@]}" ./any help >out 2>&1; then
    "${as[@]}" ./any test --golden g >out 2>err; ok 'exit 2' [ $? -eq 2 ]
    grep -v '^profiling:' err >reason # nor may this user count what it runs
    ok 'the reason' [ "$(cat reason)" = 'monge: cannot read g/golden.yaml: Permission denied' ]
else
    left_out 'goldens that may not be read: root can'
fi
chmod 755 g; rm any
# of an option that counts for nothing, with its place
fresh 'rules:' '  - {scenes: one, options: "-D a=1 -D a=2"}'; sed -i '1i params: {a: 1}' s/one.yaml
exits 1 test s --golden g
ok 'a parameter that is set twice, once' [ "$(cat err)" = 'monge: warning[given-twice]: g/golden.yaml:2: options: -D a=1 counts for nothing, -D a=2 is given later; -D a=1,2 gives both' ]
# quietly only what is wrong is told, and a document that was asked for
fresh; exits 0 test s --golden g --update-only-failed; out_has '3 of 3 new pictures are goldens now'
scene s/one.yaml lime; exits 1 test s --golden g -q; cp out x; says changed one; ok 'no line of what is the same' sh -c '! grep -q ^same out'; out_lacks goldens; no_err
exits 0 test s --golden g --update-only-failed -q; sed 's/^ *new: .*//; /^ *taken: the new picture is its golden now$/d' out >y; out_has '  taken: the'; says changed one; out_lacks goldens
ok 'what has failed is told in the same lines' [ "$(sed 's/^ *new: .*//' x)" = "$(cat y)" ]
exits 0 test s --golden g -q; no_out; no_err; exits 0 test s --golden g --changed -q; no_out; no_err
exits 0 test s --golden g -q --tap; out_has '# 3 goldens: 3 same'; exits 0 test s --golden g -q --json -; out_has '"same": 3'
# a dry run tells what another one would do then, and writes nothing
for kind in png hash both; do
    fresh 'root: ../s' "kind: $kind" 'rules: [{scenes: one, aov: true}]'; exits 1 test --golden g -q
    exits 0 accept --golden g -n; out_has 'would take one'; out_has '3 would be taken'; out_lacks took; no_err; missing g/golden.lock
    foresees 0; out_has '3 taken'; foresees 0; out_has '0 taken, 3 done already'
    scene s/one.yaml lime; scene s/two.yaml red; scene s/new.yaml red; rm 's/in/a b%.yaml'; exits 1 test --golden g -q
    scene s/two.yaml teal
    exits 1 accept 'in/*' two --golden g --prune -nq; no_out; err_has 'two is left as it is: the scene has changed since the run'
    foresees 1 --prune; ok 'the lines of a dry run' [ "$(cat dry)" = 'would remove in/a b%
would take new
would take one
2 would be taken, 1 removed, 1 left as they are' ]
done
fresh; exits 1 test s --golden g -q; mkdir elsewhere; ln -s ../elsewhere g/in
foresees 2; err_has 'g/in is a link: goldens are files in their folder'; rm -r elsewhere
exits 2 accept -n; err_has '--golden DIR is missing'
# what is taken leaves files alone that are the same already: by their bytes, or by all that a pass has to say
stamps() { stat -c '%n %i %y' "$@"; }
for kind in png both; do
    fresh "kind: $kind" 'rules: [{scenes: one, aov: true}]'; exits 0 test s --golden g --update-only-failed -q
    passes='g/one.object.png g/one.material.png g/one.normal.png g/one.shadow.png'
    # shellcheck disable=SC2086
    stamps $passes g/one.png g/golden.yaml g/two.png $([ $kind = png ] || echo g/golden.lock) >before
    rm g/one.depth.pfm; exits 1 test s --golden g -q; exits 0 accept --golden g; out_has 'took one'; there g/one.depth.pfm
    # shellcheck disable=SC2086
    stamps $passes g/one.png g/golden.yaml g/two.png $([ $kind = png ] || echo g/golden.lock) >after
    ok 'of a golden without its depth only that is written' cmp -s before after
    stamps g/one.depth.pfm >before; stamps g/one.object.png >object; scene s/one.yaml blue; exits 1 test s --golden g -q
    exits 0 accept --golden g; stamps g/one.depth.pfm >after; ok 'depth that is equal is not written' cmp -s before after
    stamps g/one.object.png >after; ok 'passes of another rendering are written' sh -c '! cmp -s object after'
    exits 0 test s --golden g; out_lacks passes
done
if command -v python3 >where; then
    # rewrite FILE FROM TO: a text in a chunk of a PNG, with its sum, and the pixels not compressed.
    cat >rewrite.py <<'PY'
import struct, sys, zlib
path, old, new = sys.argv[1], sys.argv[2].encode(), sys.argv[3].encode()
data, out, pixels, at, found = open(path, 'rb').read(), b'', b'', 8, 0
def chunk(kind, body): return struct.pack('>I', len(body)) + kind + body + struct.pack('>I', zlib.crc32(kind + body))
while at < len(data):
    size, kind = struct.unpack('>I4s', data[at:at + 8])
    body, at = data[at + 8:at + 8 + size], at + 12 + size
    if kind == b'IDAT': pixels += body
    elif kind == b'IEND': out += chunk(b'IDAT', zlib.compress(zlib.decompress(pixels), 0)) + chunk(kind, body)
    else: found += body.count(old); out += chunk(kind, body.replace(old, new))
assert found == 1
open(path, 'wb').write(data[:8] + out)
PY
    fresh 'rules: [{scenes: one, aov: true}]'; exits 0 test s --golden g --update-only-failed -q
    cp g/one.object.png x; python3 rewrite.py g/one.object.png 'Software' 'Swftoare'; cp g/one.material.png y
    python3 rewrite.py g/one.material.png 'monge:table' 'monge:tabel'
    ok 'other bytes' sh -c '! cmp -s g/one.object.png x && ! cmp -s g/one.material.png y'
    stamps g/one.object.png >before; rm g/one.depth.pfm; exits 1 test s --golden g -q; exits 0 accept --golden g; out_has 'took one'
    stamps g/one.object.png >after; ok 'a pass with the same pixels and texts is not written' cmp -s before after
    ok 'one without its table is' cmp -s g/one.material.png y
    exits 0 accept --golden g; out_has 'one is taken already'
    exits 0 test s --golden g -q
fi
# what a link in the folder leads to stays as it is
fresh; mkdir -p away; echo mine >away/victim; cp away/victim away/kept
ln -s ../away/victim g/one.png; ln -s ../away g/in; exits 1 test s --golden g -q
exits 2 accept --golden g; err_has 'g/one.png is a link: goldens are files in their folder'; err_has 'g/in is a link'
ok 'nothing is written outside of the goldens' cmp away/victim away/kept
ok 'and nothing is made there' [ "$(ls away)" = "$(printf 'kept\nvictim')" ]; there g/two.png
fresh
# an orphan whose scene has come back, and one that a scene with other frames has left
printf 'root: ../s\nrules:\n  - {scenes: turn, options: --frames all}\n' >g/golden.yaml
printf 'image: {size: [20, 10], samples: 1}\nanimation: {frames: 3}\nscene: [{sphere: {center: [t, 0, 0]}}]\n' >s/turn.yaml
exits 1 test --golden g -q; exits 0 accept --golden g; mv s/turn.yaml kept
exits 1 test --golden g; says orphan turn-0002; mv kept s/turn.yaml
exits 1 accept --prune --golden g; err_has 'turn-0002 is left as it is: its scene is there again'; there g/turn-0002.png
sed -i 's/frames: 3/frames: 2/' s/turn.yaml; exits 1 test --golden g; says orphan turn-0003
exits 0 accept --prune --golden g; missing g/turn-0003.png; there g/turn-0002.png

fresh
echo '{"a": 1}' >here.json; mkdir other; cp here.json other/results.json
exits 2 test s --golden g --output other; err_has 'other/results.json: no results of `monge test`'; there other/results.json; no_out
exits 2 accept --golden g --output other; err_has 'no results of'
exits 1 test s --golden g -q
# a run that was cut off, or edited
cp monge-test/results.json whole
for damage in ':>' 'head -c 500 whole >' 'echo nonsense >' "head -c 99 /dev/zero >" 'sed "s/\"name\"/\"n\"/" whole >' 'sed "s/\"golden\": \"g\"/\"golden\": {}/" whole >'; do
    eval "$damage monge-test/results.json"
    exits 2 accept --golden g; err_has 'monge-test/results.json is damaged: `monge test` makes it anew'; missing g/one.png
    exits 1 test s --golden g --changed; says new one
    err_has 'monge: warning: monge-test/results.json is damaged: this run goes as if there had been none before, and replaces it'
    exits 1 test s --golden g; no_err
done
# and what such a run has left is not taken for what belongs to a new picture
echo depth >monge-test/new/one.depth.pfm; echo >monge-test/results.json
exits 1 test s --golden g -q; missing monge-test/new/one.depth.pfm
exits 2 accept --golden other; err_has 'the last run was with the goldens of g'
sed 's/"name": "one"/"name": "..\/one"/' monge-test/results.json >x; cp x monge-test/results.json
exits 2 accept --golden g; err_has '`../one` is no name of a golden'; missing one.png
exits 1 test s --golden g -q
cp monge-test/new/two.png monge-test/new/one.png
exits 1 accept --golden g; err_has 'one is left as it is: its new picture is not that of the run'
if have python3; then
    # its texts as they were, its pixels others, or none
    cat >repaint.py <<'PYTHON'
import struct, sys, zlib
data = open(sys.argv[1], "rb").read()
out, at = data[:8], 8
while at < len(data):
    size, = struct.unpack(">I", data[at:at + 4])
    kind, body = data[at + 4:at + 8], data[at + 8:at + 8 + size]
    if kind == b"IHDR": width, height, bits = struct.unpack(">IIB", body[:9])
    if kind == b"IDAT": body = zlib.compress(bytes((1 + width * 3 * bits // 8) * height)) if sys.argv[2] == "black" else b"?"
    out += struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    at += 12 + size
open(sys.argv[1], "wb").write(out)
PYTHON
    for how in black none; do
        fresh 'kind: hash'; exits 1 test s --golden g -q
        python3 repaint.py monge-test/new/one.png $how
        exits 1 accept one --golden g; err_has 'one is left as it is: its new picture is not that of the run'; missing g/golden.lock
    done
    fresh
fi
for edit in 's/"size": \[40, 30\]/"size": [0, 30]/' 's/"bits": 8/"bits": 9/' 's/\("stamp": .*"scene": "\)[0-9a-f]\{32\}/\1x\\n3456789012345678901234567890x/' \
    's/\("stamp": .*"options": "\)/\1--size 9x9/'; do
    fresh 'kind: hash'; exits 1 test s/one.yaml --golden g -q
    sed "$edit" monge-test/results.json >x; ok "$edit changes it" sh -c '! cmp -s x monge-test/results.json'; cp x monge-test/results.json
    exits 1 accept --golden g; err_has 'one is left as it is: its new picture is not that of the run'; missing g/golden.lock
done
fresh
exits 1 test s --golden "$work/g" -q
(mkdir -p away; cd away; "$monge" accept one --golden "$work/g" --output ../monge-test >out 2>err); cp away/err err
ok 'the folder is told' [ "$(cat err)" = "monge: one is left as it is: its scene cannot be read from here: run it from $work, where the test ran" ]
exits 1 test s --golden g -q; mkdir -p away; sums g >before
(cd away; "$monge" accept --golden ../g --output ../monge-test >out 2>err; echo $? >status); cp away/err err; cp away/out out; last='accept from another folder'
ok 'it is refused' [ "$(cat away/status)" -eq 2 ]; ok 'for what is true' [ "$(cat err)" = "monge: ../monge-test/results.json: run it from $work, where the test ran" ]; no_out
mkdir -p away/g; (cd away; "$monge" accept --golden g --output ../monge-test >out 2>err); cp away/err err
ok 'goldens called so there are others' [ "$(cat err)" = "monge: ../monge-test/results.json: the last run was with the goldens of $work/g" ]
ok 'nothing is taken' [ "$(sums g)" = "$(cat before)" ]
ln -sfn . here; (cd here; "$monge" accept --golden ./g -n >out 2>err); out_has '3 would be taken'; no_err; rm -r here away
exits 1 test s --golden g -q; rm monge-test/new/one.png
exits 1 accept --golden g; err_has 'one is left as it is: its new picture cannot be read any more'
exits 1 test s --golden g -q
sed "s/\"program\": \"[0-9a-f]*\", \"size\"/\"program\": \"$hash\", \"size\"/" monge-test/results.json >x; cp x monge-test/results.json
rm -rf g; mkdir g; exits 1 accept --golden g; err_has 'the program has changed since the run'; ok 'nothing is taken' [ -z "$(ls g)" ]
echo keep >file; for path in file file/ file/x/y; do
    for option in output report; do exits 2 test s --golden g --$option $path; ok "a file for --$option" [ "$(cat err)" = "monge: --$option $path: file is no folder" ]; no_out; done
    exits 2 accept --golden g --output $path; ok 'of accept' [ "$(cat err)" = "monge: --output $path: file is no folder" ]
    exits 1 test s --golden g -q --report none/$path; rm -r none
done
exits 2 test s --golden g --json s; ok 'a folder for a file' [ "$(cat err)" = 'monge: --json s: it is a folder' ]
exits 2 test s --golden .; ok 'where nobody said where' [ "$(cat err)" = 'monge: the run would write into the folder of the goldens, ., as its own is monge-test: --output names another' ]
exits 2 test s --golden g --output file; ok 'a file is no folder' [ "$(cat file)" = keep ]
mkdir mine; echo text >mine/own; exits 1 test s --golden g --output mine -q; missing mine/.gitignore; there mine/own
exits 2 test s --golden g --junit none/dir/\0/x.xml --output file
if [ "$(id -u)" -ne 0 ]; then
    mkdir sealed; chmod 500 sealed
    exits 2 test s --golden g --output sealed/run; err_has 'cannot make the folder sealed/run'
    chmod 700 sealed
fi
# a reader that goes away is output that fails, and no more than that
fresh; exits 1 test s --golden g -q; exits 0 accept one --golden g -q; scene s/one.yaml lime
for command in "test s" "test s --tap" "test s --json -"; do
    rm -rf monge-test; unread $command --golden g --junit z.xml --report r; ok 'it is output that fails' [ "$status" -eq 2 ]
    ok 'the run is whole' grep -q '"new": 2' monge-test/results.json; there monge-test/new/one.png z.xml r/index.html; rm -r z.xml r
done
rm gone; { await '[ -e gone ]'; "$monge" test s --golden g 2>err; } | { exec <&-; : >gone; }; ok 'that is told' [ "$(cat err)" = 'monge: cannot write standard output: Broken pipe' ]
unread test s --golden g --update-only-failed; exits 0 test s --golden g -q
scene s/one.yaml blue; scene s/two.yaml lime; exits 1 test s --golden g -q; scene s/one.yaml red # it says so before it writes the lock
unread accept --golden g; ok 'of accept, too' [ "$status" -eq 2 ]; exits 0 test s/two.yaml --golden g -q
last='test with a full disk'
rm -rf monge-test
(trap '' XFSZ; ulimit -f 0; "$monge" test s --golden g -q 2>err | cat >out; exit "${PIPESTATUS[0]}"); status=$?
ok 'a full disk is exit 2' [ $status -eq 2 ]
ok 'no temporary files' [ -z "$(find . -name '*.tmp')" ]
if have perl; then
    fresh; sed -i 's/40, 30/3000, 3000/; s/samples: 1/samples: 4096/' s/one.yaml
    signalled INT 'sleep 0.3' test s --golden g
    ok 'SIGINT ends the run by the signal' [ $status -eq 2 ]; ok 'one is not judged' grep -q '"interrupted": ' monge-test/results.json
    missing monge-test/new/one.png
    # interrupted ARGS...: of five scenes and a golden without one, b and c are judged when the signal comes, d is rendered
    interrupted() {
        fresh; rm -rf s/*; for i in b c e f; do printf 'image: {size: [40, 30]}\nscene: [{sphere: {}}]\n' >s/$i.yaml; done
        cp s/b.yaml s/gone.yaml; exits 1 test s --golden g -q; exits 0 accept --golden g -q; rm s/gone.yaml
        sed -i 's/40/50/' s/*.yaml; printf 'image: {size: [3000, 3000], samples: 4096}\nscene: [{sphere: {}}]\n' >s/d.yaml
        last="test $* (SIGTERM)"
        "$monge" test s --golden g -j 1 "$@" >out 2>err & local pid=$!
        await "grep -q '[0-9 ]  *- c$\|^changed  *c ' out"
        sleep 0.2; kill -TERM $pid; wait $pid; status=$?
        ok 'it ends by the signal' [ $status -eq 143 ]; ok 'and says so' [ "$(cat err)" = 'interrupted: 3 of 5 scenes not judged' ]
        ok 'only what is judged is there' [ "$(find monge-test -name '*.png' | sort | xargs -n 1 basename | tr '\n' ' ')" = 'b.png c.png ' ]
    }
    interrupted --junit x.xml --report r; ok 'a count' grep -qx '2 goldens: 2 changed, in [0-9.]* s' out
    ok 'no orphans' sh -c '! grep -q orphan out'; ok 'marked in the results' grep -qx ' "interrupted": 3,' monge-test/results.json
    ok 'the page says so' grep -q 'interrupted: 3 scenes not judged' r/index.html
    ok 'an error for JUnit' grep -q '<error message="interrupted: 3 scenes not judged"/>' x.xml; ok 'which counts' grep -q 'tests="3" failures="2" errors="1"' x.xml
    exits 0 accept --golden g --prune; ok 'what is judged is taken' [ "$(cat out)" = $'took b\ntook c\n2 taken' ]
    ok 'accept says what is not' [ "$(cat err)" = 'the run was interrupted: 3 scenes not judged' ]; there g/gone.png
    interrupted --tap; ok 'TAP bails out' [ "$(tail -n 1 out)" = 'Bail out! interrupted: 3 scenes not judged' ]
    interrupted --update-only-failed; ok 'no golden is touched' [ -z "$(find g -newer s/d.yaml -name '*.png')" ]
    rm s/d.yaml; exits 1 test s --golden g; ok 'then all is judged' grep -q '4 changed, 1 orphan' out; ok 'a whole run' sh -c '! grep -q interrupted monge-test/results.json'
fi

told
