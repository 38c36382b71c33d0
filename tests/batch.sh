#!/usr/bin/env bash
# Tests of batches: scenes by folders, patterns and lists, several at once, --log, --progress json, --skip-unchanged,
# --resume, and what can go wrong: tests/batch.sh [PROGRAM], build/monge by default. Works in a folder of its own. What
# needs a tool or a right that is not here (python3, mounts) is left out, and told.

. "$(dirname "$0")/lib/testing.sh"

small=(--size 16x12)

# ---- Scenes: folders, patterns, lists ----

mkdir -p s/inner/deep s/.hidden
for f in s/a s/inner/b s/inner/deep/c s/.hidden/h; do echo 'scene: [{sphere: {}}]' >$f.yaml; done
mv s/inner/b.yaml s/inner/b.yml
ln -s .. s/inner/loop
printf 'params: {r: 1}\n' >s/defs.yaml
printf 'jobs: {build: {}}\n' >s/ci.yml
printf '{"scene": [{"sphere": {}}]}' >s/json.yaml
echo text >s/README.md
all=$(printf 's/%s: ok\n' a.yaml inner/b.yml inner/deep/c.yaml json.yaml)

exits 0 check s; out_is "$all"; err_has '2 files without a `scene` are left out: s/ci.yml, s/defs.yaml'
exits 0 check -q s; no_err
exits 0 info s; err_has '1 file without a `scene` is left out: s/ci.yml'; err_lacks defs
exits 0 check 's/**'; out_is "$all"
exits 0 check 's/**/[bc].y*ml'; out_is "$(printf 's/inner/%s: ok\n' b.yml deep/c.yaml)"
exits 0 check 's/*/*.yml'; out_is 's/inner/b.yml: ok'
exits 0 check "$work/s/inn*/d*/*.yaml"; out_is "$work/s/inner/deep/c.yaml: ok"
exits 0 info s/inner; ok "info of a folder" [ "$(grep -c '^s/inner/' out)" -eq 2 ]
exits 1 check s/defs.yaml; err_has 'needs the key `scene`'
exits 2 check 'x*.yaml' s/a.yaml; err_has 'error[no-match]: x*.yaml: no file matches'; out_is 's/a.yaml: ok'
mkdir empty; exits 2 check empty; err_has 'error[no-match]: empty: there is no scene in this folder'
touch 'q[1].yaml'; exits 1 check 'q[1].yaml'; err_has 'q[1].yaml'; rm 'q[1].yaml'
echo 'scene: [{sphere: {}' >s/broken.yaml; exits 1 check s; err_has 's/broken.yaml:'; rm s/broken.yaml

printf '# two\r\ns/a.yaml\r\n\n  \ns/inner/*.yml\n' >list
exits 0 check @list; out_is "$(printf 's/%s: ok\n' a.yaml inner/b.yml)"
for from in - @-; do
    last="check $from <list"; "$monge" check $from <list >out 2>err; status=$?
    ok "a list from standard input" [ $status -eq 0 ]; out_is "$(printf 's/%s: ok\n' a.yaml inner/b.yml)"
done
last='check - <scene'; "$monge" check - <s/a.yaml >out 2>err; out_is '-: ok'
last='check -'; printf 'gone.yaml\ns/a.yaml\n' | "$monge" check - >out 2>err; status=$?
ok "a list with what has gone" [ $status -eq 2 ]; err_has 'gone.yaml: No such file'; out_is "$(printf 'gone.yaml: not read\ns/a.yaml: ok')"
echo '@list' >lists; exits 2 check @lists; err_has 'error[no-match]: lists: a list cannot have a list in it'
exits 2 check @/dev/null; err_has 'error[no-match]: /dev/null: the list is empty'
for command in check render; do # an empty list of another program is none of our trouble
    last="$command @-"; printf '# none\n\n' | "$monge" $command @- >out 2>err; status=$?
    ok "nothing on standard input" [ $status -eq 0 ]; ok "is told" grep -qx "the list is empty: nothing to $command" err
    "$monge" $command @- --format json </dev/null >out 2>err; status=$?; ok "a document has no notes" sh -c '! grep -h "the list" out err'
done
"$monge" render @- -q -o nothing/ </dev/null 2>err; no_err; missing nothing
exits 0 render @- s/a.yaml "${small[@]}" -o nothing/; there nothing/a.png
mkdir solo; cp s/a.yaml solo/; echo solo/a.yaml >solo.list
for several in solo 'solo/*.yaml' @solo.list; do # of one scene today
    exits 2 render "$several" -o solo.png; err_has "-o solo.png is one file for a folder, a pattern or a list of scenes: end it in / for a folder, or write -o 'solo-{name}.png'"
    exits 2 render "$several" --frames all -o 'x{frame}.png'; err_has "-o x{frame}.png is one file for a folder, a pattern or a list of scenes: end it in / for a folder, or write -o 'x{frame}-{name}.png'"
    exits 2 render "$several" -o -; err_has '-o -: standard output can take only one picture'; no_out; missing solo.png
    exits 0 render "$several" -q "${small[@]}" -o 'solo-{name}.png'; there solo-a.png; rm solo-a.png
    exits 0 render "$several" -q "${small[@]}" -o solo.d/; there solo.d/a.png; rm -r solo.d
    exits 0 render "$several" -q "${small[@]}" -o /dev/null
done
exits 0 render solo/a.yaml -q "${small[@]}" -o solo.png; there solo.png
exits 1 check -; err_has 'the file is empty'
printf '\xEF\xBB\xBF  s/a.yaml \t\r\n  # not this\n \ts/inner/b.yml\n' >marked; cp s/a.yaml 's/#n.yaml'; printf ' #s/json.yaml\ns/#n.yaml\n' >>marked
exits 0 check @marked; out_is "$(printf 's/%s: ok\n' a.yaml inner/b.yml '#n.yaml')"
cp list list.txt; exits 2 check list.txt s/a.yaml; err_has 'list.txt: a list of scenes is given as @list.txt'; out_is 's/a.yaml: ok'
cp s/a.yaml scene.txt; exits 0 check scene.txt; out_is 'scene.txt: ok'
last='check (a pipe)'; "$monge" check <(cat s/a.yaml) >out 2>err; status=$?; ok "a pipe is read once" [ $status -eq 0 ]

# names that would write to a terminal what they like
mkdir wild; wild=$'wild/a\e[31m\nb'; cp s/a.yaml "$wild.yaml"; echo 'scene: [{sphere: {raduis: 1}}]' >"$wild-wrong.yaml"; : >"$wild-empty.yaml"
printf 'materials: {"m\\e[31m": {diffuse: red}}\nscene: [{sphere: {}, material: "m\\e[31m", name: "x\\n"}]\n' >wild/c.yaml
for command in check 'check -D a=1,2' info 'fmt --check' 'render -n' 'render --size 16x12 -o wild.d/' fmt; do
    run $command wild; cat err out >said; ok "no control characters: monge $command" sh -c '! tr -d "\n" <said | grep -q "[[:cntrl:]]"'
    ok "and one line: monge $command" sh -c '! grep -q "^b[.:-]" said'
done
exits 1 check wild; out_is "$(printf 'wild/%s\n' 'a?[31m?b.yaml: ok' 'a?[31m?b-wrong.yaml: 1 error' 'c.yaml: ok')"
rm -r wild wild.d said

# what is between NULs is a name as it stands
mkdir names; odd=("names/two
lines.yaml" ' names/blank .yaml' '@names/at.yaml' '#names/hash.yaml' 'names/[ab].yaml' -.yaml)
mkdir -p ' names' '@names' '#names'; for f in "${odd[@]}"; do cp s/a.yaml "./$f"; done
printf '%s\0' "${odd[@]}" >zeros; printf '%s\0\0%s' "${odd[@]:0:2}" >unended
for from in @zeros - @-; do
    last="check $from <zeros"; "$monge" check $from <zeros >out 2>err; status=$?
    ok "all names" [ $status -eq 0 ]; out_is "$(printf '%s: ok\n' "${odd[@]//$'\n'/?}")"
done
exits 0 check @unended; out_is "$(printf '%s: ok\n' 'names/two?lines.yaml' "${odd[1]}")"
last='render @-'; find names -name '*.yaml' -print0 | sort -z | "$monge" render @- -q "${small[@]}" -o zero/ 2>err; there zero/'two
lines.png' zero/'[ab].png'

# the recipe of the README, in a repository
if have git; then
    mkdir repo && cd repo || exit 1
    recipe=$(grep '^git diff' "$project/README.md"); recipe=${recipe/monge render/'"$monge" render -q'}
    git() { command git -c user.name=n -c user.email=e -c core.quotePath=true "$@"; }
    export monge; export -f git
    changed() { rm -rf changed; last=$recipe; bash -o pipefail -c "$recipe" >out 2>err; status=$?; }
    mkdir -p 'a b'; for f in same.yaml grün.yaml gone.yaml 'a b/same.yaml'; do cp ../s/a.yaml "$f"; done
    sed -i '1i image: {size: [16, 12], samples: 1}' ./*.yaml */*.yaml
    git init -q . && git add . && git commit -qm one
    changed; ok "nothing has changed" [ $status -eq 0 ]; missing changed
    echo '# more' >>grün.yaml; echo '# more' >>'a b/same.yaml'; echo '# more' >>same.yaml; rm gone.yaml; echo x >x.txt; git add x.txt
    changed; ok "the recipe" [ $status -eq 0 ]; there changed/grün.png changed/same.png 'changed/a b/same.png'
    ok "and no more" [ "$(find changed -type f | wc -l)" -eq 3 ]
    unset -f git; cd ..
else left_out "the recipe of the README: no git"; fi
exits 2 check @none; err_has 'cannot read none'
for twice in 'check - @-' 'info - -' 'fmt --check @- -' 'render - - -o twice/ --stats twice.json --log twice.log'; do
    last=$twice; "$monge" $twice <s/a.yaml >out 2>err; status=$?
    ok "standard input twice" [ $status -eq 2 ]; err_has 'standard input can be only one'; no_out; missing twice twice.json twice.log
done
for order in LE BE; do # as some editors save texts; names between NULs, one of which is the folder
    printf '\xFF\xFEs\x00/\x00a\x00.\x00y\x00a\x00m\x00l\x00\n\x00' >wide
    [ $order = LE ] || printf '\xFE\xFF\x00s\x00/\x00a\x00.\x00y\x00a\x00m\x00l\x00\n' >wide
    exits 2 render @wide "${small[@]}" -o l/; ok "a list in UTF-16$order" [ "$(cat err)" = 'monge: error[no-match]: wide: this list is in UTF-16: save it as UTF-8' ]; missing l
    tail -c +3 wide >bare; exits 2 render @bare "${small[@]}" -o l/; err_has 'bare: this list is in UTF-16: save it as UTF-8'; missing l
    last='render @- <wide'; "$monge" render @- "${small[@]}" -o l/ <wide >out 2>err; ok "is refused" [ $? -eq 2 ]; err_has 'standard input: this list is in UTF-16: save it as UTF-8'; missing l
    last='render - <wide'; "$monge" render - "${small[@]}" -o l/ <wide >out 2>err; ok "with - too" [ $? -ne 0 ]; err_has 'save the file as UTF-8'; rm -rf l
done
exits 2 render @s/a.yaml "${small[@]}" -o l/; ok "a scene is no list" [ "$(cat err)" = 'monge: error[no-match]: s/a.yaml: this is a scene, and no list: give it without the @' ]; missing l
cp list list.yml; exits 0 check @list.yml; out_is "$(printf 's/%s: ok\n' a.yaml inner/b.yml)"; rm list.yml
cp list piped
for option in --stats --log; do for stream in - @-; do
    last="render $stream $option piped <piped"; "$monge" render $stream "${small[@]}" -o l/ $option piped <piped >out 2>err; status=$?
    ok 'a list on standard input is spared' [ $status -eq 2 ]; err_has "piped would be written over by the output of $option"; ok 'it is as it was' cmp -s list piped; missing l
done; done
cp list list.before; ln list list.hard; ln -s list list.soft
for option in --stats --log; do for over in list ./list list.hard list.soft; do
    exits 2 render s/a.yaml @list "${small[@]}" -o l/ $option $over; err_has "list would be written over by the output of $option"; same list list.before; missing l
done; done
mkdir l; cp list l/a.png; exits 2 render @l/a.png "${small[@]}" -o l/; err_has 'l/a.png would be written over by the output of s/a.yaml'; same l/a.png list; rm -r l list.*
exits 2 render @ -o l/; err_has 'error[no-match]: @: a list has a name, or is @-, standard input'; missing l
exits 0 render s/a.yaml -q "${small[@]}" -o picture.png; exits 2 render @picture.png -o l/; missing l
ok "a picture is no list" [ "$(cat err)" = 'monge: error[no-match]: picture.png: this is a picture, and no list of scenes' ]; rm picture.png

# what has a key of a scene beside others, or nearly `scene`, is meant as one; what has none is told, but for settings by name
mkdir kinds; echo 'scene: [{sphere: {}}]' >kinds/a.yaml
for key in scenes Scene scen; do
    echo "$key: [{sphere: {}}]" >kinds/slip.yaml
    exits 1 check kinds; err_has "kinds/slip.yaml:1:1: error[unknown-key]: a scene has no key \`$key\`"; err_has 'did you mean `scene`?'
    exits 1 render -q kinds "${small[@]}" -o slip/; there slip/a.png; missing slip/slip.png
done
printf 'camera: {fov: 40}\nsphere: {}\n' >kinds/slip.yaml; exits 1 check kinds; err_has 'no key `sphere`'
rm kinds/slip.yaml; printf 'root: .\nkind: hash\n' >kinds/golden.yaml; printf 'include: x.yaml\nparams: {a: 1}\n' >kinds/lib.yaml
exits 0 render kinds "${small[@]}" -o slip/; err_lacks 'left out'
exits 0 check kinds; err_has '2 files without a `scene` are left out: kinds/golden.yaml, kinds/lib.yaml'
cp kinds/a.yaml kinds/B.YAML; cp kinds/a.yaml kinds/c.Yml; cp kinds/a.yaml kinds/d.yamlx
exits 0 check -q kinds; exits 0 check kinds; out_is "$(printf 'kinds/%s: ok\n' B.YAML a.yaml c.Yml)"
exits 0 render -q kinds "${small[@]}" -o case/; there case/a.png case/B.png case/c.png
exits 0 render -q kinds/B.YAML "${small[@]}"; there B.png
for i in $(seq 10 21); do echo 'on: push' >kinds/$i.yml; done
exits 0 info kinds; err_has '12 files without a `scene` are left out: kinds/10.yml, '; err_has 'kinds/19.yml, ...'; err_lacks kinds/20.yml
exits 0 check kinds; err_has 'kinds/21.yml, kinds/golden.yaml'

# what is empty and what may never end are left out, but for those that are named
mkdir left; cp s/a.yaml left/; : >left/empty.yaml; printf '# to be written\n\n' >left/idea.yml; mkfifo left/pipe.yaml
left='2 files without a `scene` are left out: left/empty.yaml, left/idea.yml'
for from in left 'left/*.y*ml' 'left/**/*'; do
    for command in 'check' 'info' 'fmt --check' 'render --size 16x12 -o left.d/' 'render -n'; do
        last="$command $from"; timeout -s KILL 60 "$monge" $command "$from" >out 2>err </dev/null; status=$?
        ok "a pipe that nobody writes to" [ $status -eq 0 ]; err_has "$left"; err_has '1 pipe, socket or device is left out: left/pipe.yaml'
    done
    "$monge" check "$from" >out 2>err; out_is 'left/a.yaml: ok'
done
mkfifo left/q.yaml; exits 0 info left; err_has '2 pipes, sockets or devices are left out: left/pipe.yaml, left/q.yaml'
exits 0 render -q left "${small[@]}" -o left.d/; no_err
last='check left/[pq]*.yaml'; timeout -s KILL 60 "$monge" check 'left/[pqe]*.yaml' >out 2>err; status=$?
ok "none is left" [ $status -eq 2 ]; err_has 'error[no-match]: left/[pqe]*.yaml: no scene matches'
cat s/a.yaml >left/pipe.yaml & exits 0 check left/pipe.yaml; wait $!; out_is 'left/pipe.yaml: ok'
exits 1 check left/empty.yaml; err_has 'error[empty-file]'

printf 'scene:   []\n' >s/odd.yaml; printf 'params:   {r: 1}\n' >s/defs.yaml
exits 1 fmt --check s; out_is "$(printf 's/%s\n' defs.yaml json.yaml odd.yaml)"
rm s/odd.yaml

# ---- Where pictures go ----

exits 0 render -q s "${small[@]}"; there a.png inner/b.png inner/deep/c.png; missing .hidden defs.png h.png
exits 0 render -q s "${small[@]}" -o 'p/{name}-x.png'; there p/a-x.png p/inner/deep/c-x.png
mkdir made; exits 0 render -q s/ "${small[@]}" -o made; there made/inner/b.png
cat list | "$monge" render - -q "${small[@]}" -o l/ 2>err; there l/a.png l/b.png
exits 0 render s/a.yaml s/inner/deep "${small[@]}" ./s/a.yaml "$work/s/a.yaml" s/a.yaml; ok "once is enough" [ "$(grep -c '^wrote a.png' err)" -eq 1 ]
printf 's/a.yaml\ns/a.yaml\n' >twice; exits 0 check @twice; out_is 's/a.yaml: ok'
exits 0 render -q s s/inner "${small[@]}" -o other/; there other/inner/b.png other/b.png
mkdir -p t/inner; cp s/a.yaml t; ln s/inner/b.yml t/inner/b.yml
exits 2 render s/a.yaml t/a.yaml s/a.yaml; err_has 's/a.yaml and t/a.yaml would both write'; err_has 'with --root DIR they keep their folders'
exits 2 render nowhere.yaml nowhere/ -o n/; missing n; err_has 'cannot read nowhere/'
exits 2 render 'no*.yaml' empty -o n/; missing n
exits 2 render nowhere.yaml s/a.yaml "${small[@]}" -o n/; there n/a.png

# A pattern keeps the folders that vary; with a root all scenes are called from there.
exits 0 render -q 's/**/[abc].y*ml' "${small[@]}" -o v/; there v/a.png v/inner/b.png v/inner/deep/c.png
exits 0 render -q './s//inn*/*/c.yaml' "${small[@]}" -o v2/; there v2/inner/deep/c.png
exits 0 render -q "$work"'/s/inner/d*' s/inner/'*.yml' "${small[@]}" -o v3/; there v3/deep/c.png v3/b.png
exits 0 render '[s]/../s/inner/b*' "${small[@]}" -o v4/; err_has 'wrote v4/s/inner/b.png'; (cd s && "$monge" render -q '**' "${small[@]}" -o ../v5/); there v5/inner/b.png
exits 0 render -q s/inner/b.yml s/inner/deep '[s]/a.yaml' @twice --root s "${small[@]}" -o v6/; there v6/a.png v6/inner/b.png v6/inner/deep/c.png
ok "and no more" [ "$(find v6 -type f | wc -l)" -eq 3 ]
exits 0 render -q s/a.yaml t/a.yaml --root . "${small[@]}" -o 'v7/{name}-x.png'; there v7/s/a-x.png v7/t/a-x.png
exits 2 render -q s/inner t/a.yaml --root ./s/inner/.. "${small[@]}" -o v8/; err_has 't/a.yaml: it is not below the folder of --root'; there v8/inner/b.png
exits 2 render s/a.yaml --root nowhere -o v9/; err_has '--root nowhere: No such file or directory'; missing v9
exits 2 render no/a.yaml --root s; err_has 'cannot read no/a.yaml'
exits 0 render -q s/a.yaml --root / "${small[@]}" -o v9/; there "v9$work/s/a.png"
last='render - --root'; "$monge" render - --root s "${small[@]}" <s/a.yaml >out 2>err; status=$?; ok "a scene on standard input has no folder" [ $status -eq 0 ]
exits 2 check s --root s; err_has 'no option `--root`'

# ---- Several at once: the order is that of the batch ----

mkdir many && cd many || exit 1
printf 'image: {size: [200, 150], samples: 16}\nscene: [{sphere: {}}]\n' >01-slow.yaml
for i in 02 03 04 06 07 08; do echo 'scene: [{sphere: {}}, {box: {min: [2, 0, 0], max: [3, 1, 1]}}]' >$i.yaml; done
echo 'scene: [{sphere: {raduis: 1}}]' >05-wrong.yaml
timeless() { sed 's/  [0-9.]* s$//' "$1"; }
run render . -j 1 -o one/ "${small[@]}"; timeless err >one.err; ok "exit 1" [ $status -eq 1 ]
run render . -j 4 -o one/ "${small[@]}"; timeless err >four.err; ok "exit 1" [ $status -eq 1 ]
same one.err four.err
ok "all are told" [ "$(grep -c ^wrote one.err)" -eq 7 ]
ok "the summary is the last line" [ "$(tail -n 1 four.err)" = '7 rendered, 1 failed' ]
exits 0 render 02.yaml 03.yaml -o one/ "${small[@]}"; ok "of all that are well too" [ "$(tail -n 1 err)" = '2 rendered' ]
exits 0 render 02.yaml -o one/ "${small[@]}"; ok "of one there is none" [ "$(wc -l <err)" -eq 1 ]
printf '02.yaml\n03.yaml\nx*.yaml\n' >list; exits 2 render @list gone.yaml -o one/ "${small[@]}"
ok "what stands for nothing has failed" [ "$(tail -n 1 err)" = '2 rendered, 2 failed' ]; rm list
mid=(--size 100x75)
exits 1 render . -j 4 -o some/ --log log "${mid[@]}"; ok "the slow one comes first" sh -c 'head -n 1 err | grep -q 01-slow'
ok "lines in order" [ "$(grep -o '"output": "[^"]*' log | cut -d'"' -f4 | sort -c && wc -l <log)" -eq 8 ]
exits 1 render . -j 1 -o other/ -q "${mid[@]}"; for f in some/*.png; do same $f other/${f#some/}; done
exits 1 render . -j 3 "${small[@]}" -q --log log; ok "a log grows" [ "$(wc -l <log)" -eq 16 ]
printf other >>log; exits 0 render 02.yaml -q "${small[@]}" --log log; ok "behind a line of others" sh -c 'tail -n 2 log | head -n 1 | grep -qx other'
cp log log.before
for torn in '{' '{"started": "20' "$(tail -n 1 log | head -c -2)"; do
    cp log.before log; printf '%s' "$torn" >>log; exits 0 render 02.yaml -q "${small[@]}" --log log
    ok "a torn line is cut off" sh -c 'head -n -1 log | cmp - log.before && tail -n 1 log | grep -q "}$"'
    printf '%s' "$torn" >log; exits 0 render 02.yaml -q "${small[@]}" --log log; ok "the only one" [ "$(wc -l <log)" -eq 1 ]
done
printf '{"started": "mine"}' >log; exits 0 render 02.yaml -q "${small[@]}" --log log; ok "a whole one stays" [ "$(head -n 1 log)" = '{"started": "mine"}' -a "$(wc -l <log)" -eq 2 ]
rm log.before; head -c 8000 /dev/zero | tr '\0' '\n' >log
(ulimit -f 8; "$monge" render 02.yaml 03.yaml 04.yaml -q "${small[@]}" --log log 2>err); status=$?; last='render under ulimit -f'
ok "no room for a line" [ $status -eq 2 ]; err_has 'cannot write log: File too large'; ok "and no part of it" sh -c '[ "$(wc -c <log)" -eq 8000 ] || tail -c 2 log | grep -q "}$"'
exits 2 render 02.yaml 03.yaml -q "${small[@]}" --log /dev/full; err_has 'error[cannot-write]: cannot write /dev/full: No space'; there 03.png; ok "told once" [ "$(grep -c 'No space' err)" -eq 1 ]
exits 2 render 02.yaml --log no/log; err_has 'error[cannot-write]: cannot write no/log'
exits 2 render 02.yaml -o - --log -; err_has '--log -: standard output takes the picture'
exits 0 render 02.yaml 03.yaml -q "${small[@]}" --log -; ok "a log on stdout" [ "$(grep -c '"status": "rendered"' out)" -eq 2 ]

exits 1 render 0[1-3].yaml 05-wrong.yaml 06.yaml 07.yaml -j 1 --fail-fast "${small[@]}" -o fast/
err_has '2 rendered, 1 failed, 2 not begun'; missing fast/06.png
exits 1 render 05-wrong.yaml 06.yaml -k "${small[@]}" -o kept/; there kept/06.png
exits 2 render 06.yaml -k --fail-fast; err_has 'give one of them'
for i in 1 2 3 4; do cp 06.yaml more-$i.yaml; done
exits 1 render . -o lots/ "${small[@]}"; ok "failures, then counts" [ "$(tail -n 2 err)" = "$(printf 'failed lots/05-wrong.png  from ./05-wrong.yaml\n11 rendered, 1 failed')" ]
exits 1 render . -j 4 -o doc/ "${small[@]}" --format json
if have python3; then ok "a document alone" python3 -c 'import json; assert json.load(open("err"))[0]["code"] == "unknown-key"'; fi
cp 05-wrong.yaml 09-wrong.yaml; echo 'scene: [' >10-wrong.yaml
for format in json sarif; do # in the order of the batch, whatever ends first
    for jobs in 1 4; do run render . gone.yaml -j $jobs -o doc/ "${small[@]}" --format $format; ok "exit 2" [ $status -eq 2 ]; mv err doc.$jobs; done
    ok "all are told" [ "$(grep -c '05-wrong\|09-wrong\|10-wrong\|gone.yaml' doc.1)" -ge 4 ]; same doc.1 doc.4
    mkfifo p1.yaml p2.yaml; last="render of two pipes, --format $format"
    "$monge" render p1.yaml p2.yaml -j 2 -o doc/ "${small[@]}" --format $format 2>err & pid=$!
    ok "the second is read while the first waits" timeout 60 sh -c 'cat 05-wrong.yaml >p2.yaml'
    timeout 60 sh -c 'cat 09-wrong.yaml >p1.yaml'; wait $pid; status=$?; rm p1.yaml p2.yaml
    ok "exit 1" [ $status -eq 1 ]; ok "the first is told first" [ "$(grep -o 'p[12].yaml' err | uniq | tr '\n' ' ')" = 'p1.yaml p2.yaml ' ]
done
rm 09-wrong.yaml 10-wrong.yaml doc.*
printf '%s\n' . gone.yaml "x*.yaml" >list; exits 2 render @list -o lots/ "${small[@]}"
ok "what stands for nothing as well" [ "$(tail -n 4 err)" = "$(printf 'failed x*.yaml\nfailed lots/05-wrong.png  from ./05-wrong.yaml\nfailed lots/gone.png  from gone.yaml\n11 rendered, 3 failed')" ]
rm more-* list

run render . -j 2 -o bar/ --progress json --log log2 "${mid[@]}"
if have python3; then
    ok "progress and log" python3 - <<'PYTHON'
import json, re
lines = [json.loads(line) for line in open("err") if line.startswith("{")]
assert [line["done"] for line in lines] == sorted(line["done"] for line in lines) and len(lines) >= 8
assert [line["part"] for line in lines] == sorted(line["part"] for line in lines)
last = lines[-1]
assert (last["done"], last["total"], last["rendered"], last["failed"]) == (8, 8, 7, 1)
assert last["part"] == 1 and last["seconds_left"] == 0 and lines[0]["seconds"] >= 0
assert all(list(line) == ["done", "total", "rendered", "unchanged", "failed", "part", "seconds", "seconds_left", "running"] for line in lines)
assert all(0 <= line["part"] <= 1 and line["done"] == line["rendered"] + line["unchanged"] + line["failed"] for line in lines)
assert all(line["seconds_left"] is None or line["seconds_left"] >= 0 for line in lines) and last["running"] == []
assert any(line["running"] for line in lines)
for picture in [picture for line in lines for picture in line["running"]]:
    assert list(picture) == ["scene", "output", "pixels", "of_pixels"] and 0 <= picture["pixels"] <= picture["of_pixels"] == 100 * 75
    assert picture["output"] == picture["scene"].replace("./", "bar/").replace(".yaml", ".png")
log = [json.loads(line) for line in open("log2")]
assert [p["status"] for p in log] == ["rendered"] * 4 + ["failed"] + ["rendered"] * 3
assert log[0]["rays"]["camera"] == 100 * 75 * 16 and len(log[0]["pixel_hash"]) == 32 and log[1]["primitives"] == 2
assert log[1]["scene_hash"] == log[2]["scene_hash"] != log[0]["scene_hash"]
assert log[4]["error"] == {"code": "unknown-key", "message": "a sphere has no key `raduis`", "file": "./05-wrong.yaml", "line": 1, "column": 19}
assert len({p["started"] for p in log}) == 1 and re.fullmatch(r"20\d\d-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z", log[0]["started"])
PYTHON
else left_out "progress and log: no python3"; fi
exits 0 render 02.yaml 03.yaml -j 1 -o bar/ --progress json "${small[@]}" # of one tile each
ok "a line as the first picture begins" [ "$(head -n 1 err | grep -c '"done": 0, "total": 2, .*"part": 0.0000, .*"running": \[{"scene": "02.yaml", "output": "bar/02.png", "pixels": 0, ')" -eq 1 ]
last='render --progress json of a pipe'; mkfifo pipe.yaml; "$monge" render pipe.yaml 02.yaml -j 1 -o bar/ --progress json "${small[@]}" 2>err & pid=$!
await 'grep -q "\"part\": 0.0000.*\"running\": \[\]" err'; ok "lines while a scene is read" grep -q '"done": 0, "total": 2' err
cat 02.yaml >pipe.yaml; wait $pid; rm pipe.yaml bar/pipe.png
patient '--] ' 02.yaml -o bar/ --size 32x32 --progress always # of a single tile
printf 'image: {size: [32, 32]}\nscene: [{sphere: {}}]\n' >tile.yaml; exits 0 render tile.yaml -o bar/ --threads 1 --progress json --samples "$(samples_for 1 tile.yaml)"
ok "within it the time that is left is known" sh -c 'grep -v "\"pixels\": 1024, " err | grep -q "\"seconds_left\": [0-9]*[.].*\"pixels\": [1-9]"'; rm tile.yaml
patient '1 of 2 pictures  03  [' 0[1-3].yaml -j 1 -o bar/ --size 400x300 --progress always
cd ..

# ---- What is told of failures ----

mkdir told && cd told || exit 1
printf 'animation: {frames: 3}\nscene: [{sphere: {raduis: 1}}]\n' >broken.yaml
printf 'animation: {frames: 3}\nscene: [{sphere: {}}]\n' >good.yaml
for i in 1 2 3; do cp good.yaml good$i.yaml; done
exits 1 render . --frames all -o 'z/{name}-{frame}.png' "${small[@]}" --log log; err_lacks '{frame}'
ok "a scene without pictures by itself" [ "$(tail -n 2 err)" = "$(printf 'failed ./broken.yaml\n12 rendered, 1 failed')" ]
ok "null for a path that is not known" grep -q '"scene": "./broken.yaml", "output": null, "status": "failed"' log
printf 'params: {a: 1}\nscene: [{sphere: {raduis: 1}}]\n' >sweep.yaml; printf 'params: {a: 1}\nscene: [{sphere: {radius: a}}]\n' >fine.yaml
exits 1 render sweep.yaml fine.yaml -D a=1..10 -j 2 -o s/ "${small[@]}" --log s.log
ok "an error of ten combinations is told once" [ "$(grep -c 'error\[' err)" -eq 1 ]
ok "and counted" grep -qx 'sweep.yaml: the same for 9 more combinations' err
ok "before what comes next" [ "$(grep -A 1 'the same for' err | tail -n 1 | cut -c1-17)" = 'wrote s/fine-a=1.' ]
ok "each has its line" [ "$(grep -c '"code": "unknown-key"' s.log)" -eq 10 ]
run render sweep.yaml -D a=1..10 -j 1 -o s/ "${small[@]}"; ok "of one at a time as well" [ "$(grep -c 'error\[' err)" -eq 1 -a "$(grep -c 'for 9 more' err)" -eq 1 ]
printf 'params: {a: 1}\nscene: [{sphere: {radius: a - 2}}]\n' >some.yaml
run render some.yaml -D a=1,2,3 -o s/ "${small[@]}"; ok "another error is told" [ "$(grep -c 'error\[' err)" -eq 2 ]; err_lacks 'the same'
exits 1 check sweep.yaml -D a=1..10; ok "check: once" [ "$(grep -c 'error\[' err)" -eq 1 -a "$(grep -c ': 1 error' out)" -eq 10 ]
exits 1 check sweep.yaml -D a=1..10 --format json; ok "in JSON as well" [ "$(grep -c '"unknown-key"' out)" -eq 1 ]
exits 1 render sweep.yaml -D a=1..10 --format json -o s/ --log s2.log; ok "of render too" [ "$(grep -c '"unknown-key"' err)" -eq 1 ]
ok "and has its lines" [ "$(grep -c '"code": "unknown-key"' s2.log)" -eq 10 ]
cd ..

# ---- Lines of a log that wait ----

mkdir waiting && cd waiting || exit 1
for i in 1 2 3 4 5 6; do echo "scene: [{sphere: {radius: $i}}]" >$i.yaml; done
exits 0 render . -j 2 "${small[@]}" --log log -q; missing .log.waiting
sed 's/"started": "[^"]*"/"started": "before"/' log >all
line() { sed -n "$1p" all; }
{ line 1; line 2; } >log # a run that was killed there: of what waits some has been written, and the last line is torn
{ printf '0\n'; for i in 5 2 4 1; do printf '%d\t' $((i - 1)); line $i; done; printf '5\t{"started": "be'; } >.log.waiting
exits 0 render 6.yaml "${small[@]}" --log log -q; missing .log.waiting
head -n 4 log >first; { line 1; line 2; line 4; line 5; } | cmp -s - first; ok "what waited is moved, in the order of the batch" [ $? -eq 0 ]
ok "and what comes is behind it" [ "$(wc -l <log)" -eq 5 -a "$(tail -n 1 log | grep -c '"scene": "6.yaml"')" -eq 1 ]
printf 'image: {size: [1200, 900], samples: 200}\nlights: [{point: {at: [4, 6, 9]}}]\nscene: [{sphere: {}}]\n' >0-slow.yaml
rm log *.png; "$monge" render . -j 2 -q --log log 2>err & pid=$!; last='render . --log log, killed'
await '[ "$(grep -c pixel_hash .log.waiting)" = 6 ]'
kill -KILL $pid; wait $pid 2>/dev/null
ok "all wait behind a slow one" [ "$(grep -c pixel_hash .log.waiting)" -eq 6 -a ! -s log ]
exits 0 render [1-6].yaml -q --resume --log log; missing .log.waiting
ok "the next run has them first" [ "$(grep -o '"scene": "[^"]*", "output": "[^"]*", "status": "[a-z]*"' log | grep -n . | sed -n '1p;6p;7p;12p' | cut -d'"' -f1,4,12 | tr -d '"' | tr '\n' ' ')" = '1:./1.yamlrendered 6:./6.yamlrendered 7:1.yamlunchanged 12:6.yamlunchanged ' ]
hashes() { grep "$1" log | grep -o '"width".*"height": [0-9]*\|"program.*' | sed 's/, "samples.*//; s/}$//'; }
ok "what is unchanged has its hashes" [ "$(hashes rendered)" = "$(hashes unchanged)" -a -n "$(hashes unchanged)" ]
"$monge" render 1.yaml "${small[@]}" -q --log pids & first=$!; "$monge" render 2.yaml 3.yaml "${small[@]}" -q --log pids & second=$!
wait $first $second; last='two runs at once with one log'
ok "each has its process" [ "$(grep -o '"pid": [0-9]*' pids | sort | uniq -c | awk '{ print $3, $1 }' | sort)" = "$(printf '%s\n' "$first 1" "$second 2" | sort)" ]
ok "two runs" [ "$(grep -o '"started": "[^"]*"' log | sort -u | wc -l)" -eq 2 ]
cd ..

# ---- Unchanged pictures ----

mkdir unchanged && cd unchanged || exit 1
printf 'include: lib/defs.yaml\nparams: {a: 1}\nscene: [{sphere: {radius: a * r}}]\n' >one.yaml
mkdir lib; echo 'params: {r: 2}' >lib/defs.yaml
printf 'animation: {frames: 3}\nscene: [{sphere: {radius: 1 + t}}, {box: {}}]\n' >two.yaml
skip() { run render "${small[@]}" one.yaml --skip-unchanged "$@"; }
wrote() { ok "$1: rendered" grep -q '^wrote one.png' err; skip; ok "$1: and then not" grep -qx 'unchanged one.png' err; }
skip; wrote new
touch one.yaml; skip; err_has 'unchanged one.png'
ok "left as it is" [ one.png -ot one.yaml ]
echo '# a comment' >>one.yaml; skip; wrote "the scene"
echo 'params: {r: 3}' >lib/defs.yaml; skip; wrote "what it includes"
skip --samples 2; ok "options" grep -q ^wrote err; skip; wrote "other options"
skip -D a=2; ok "a parameter" grep -q ^wrote err; skip -D a=2; err_has 'unchanged one.png'; skip; wrote "without it"
skip -D a=2.50 --shadow 1; ok "numbers" grep -q ^wrote err
for same in '-D a=2.5 --shadow 1.0' '-D a=2.500 --no-shadows' '-D a=2.5 --shadow 1e0'; do
    skip $same; ok "$same is the same" grep -q '^unchanged one.png' err
done
for other in 2.05 2.5e0 '2.5 + 0' 25 250; do skip -D "a=$other" --shadow 1; ok "$other is another" grep -q ^wrote err; done
skip -D a=25 --shadow 1; skip; wrote "other numbers"
head -c -1 one.png >cut; mv cut one.png; skip; wrote "a torn picture"
cp one.png good.png
rm lib/defs.yaml; skip; ok "what has gone is an error" [ $status -eq 1 ]; same one.png good.png
echo 'params: {r: 3}' >lib/defs.yaml; skip; err_has 'unchanged one.png'
cp one.yaml copy.yaml; exits 0 render "${small[@]}" copy.yaml -o one.png --skip-unchanged; err_has 'unchanged one.png'
if have python3; then
    cat >edit.py <<'PYTHON'
# edit.py KIND: changes a pixel, or the program, of one.png, and what the chunks need to be whole
import struct, sys, zlib
data, out, pixels, texts = open("one.png", "rb").read(), b"\x89PNG\r\n\x1a\n", b"", []
at, chunks = 8, []
while at < len(data):
    size, kind = struct.unpack(">I4s", data[at:at + 8])
    chunks.append([kind, data[at + 8:at + 8 + size]])
    at += size + 12
for chunk in chunks:
    if sys.argv[1] == "pixel" and chunk[0] == b"IDAT":
        rows = bytearray(zlib.decompress(chunk[1]))
        rows[-1] ^= 1
        chunk[1] = zlib.compress(bytes(rows))
    if sys.argv[1] == "program" and chunk[1].startswith(b"monge:program"):
        chunk[1] = b"monge:program\0" + b"0" * 32
    out += struct.pack(">I", len(chunk[1])) + chunk[0] + chunk[1] + struct.pack(">I", zlib.crc32(chunk[0] + chunk[1]))
open("one.png", "wb").write(out)
PYTHON
    for kind in pixel program; do
        python3 edit.py $kind; ok "$kind: it is another file" sh -c '! cmp -s one.png good.png'
        skip; wrote "another $kind"; same one.png good.png
    done
    python3 edit.py nothing; skip; err_has 'unchanged one.png'
else left_out "edited pictures: no python3"; fi

# what would be rendered, and why: nothing is written
files() { find . ! -name out ! -name err -type f -printf '%p %T@ %s\n' -o -type d -print | sort; }
foresee() { files >../before; run render "${small[@]}" --dry-run "$@"; files | cmp -s - ../before || ok "nothing is written: $*" false; }
foresees() { ok "foreseen: $1" grep -qxF -e "one.yaml -> one.png: $1" out; ok "exit 0" [ $status -eq 0 ]; }
rm -f one.png; skip
foresee one.yaml; foresees 'would be rendered'; no_err
for option in --skip-unchanged --resume; do
    foresee one.yaml $option; foresees unchanged
    foresee one.yaml $option --samples 2; foresees 'would be rendered: its options differ'
    foresee one.yaml $option -D a=2; foresees 'would be rendered: its options differ'
    foresee one.yaml $option --aov depth; foresees 'would be rendered: its passes are not all whole'
done
echo '# another comment' >>one.yaml; foresee one.yaml --skip-unchanged; foresees 'would be rendered: its text differs'
skip; echo 'params: {r: 2.5}' >lib/defs.yaml; foresee one.yaml --skip-unchanged; foresees 'would be rendered: its text differs'
skip; cp one.png whole.png; head -c -1 whole.png >one.png; foresee one.yaml --skip-unchanged; foresees 'would be rendered: it is damaged'
if have python3; then
    for row in 'pixel:it is damaged' 'program:the program differs'; do
        cp whole.png one.png; python3 edit.py "${row%%:*}"; foresee one.yaml --skip-unchanged; foresees "would be rendered: ${row#*:}"
    done
fi
"$monge" diff -q whole.png whole.png --out one.png; foresee one.yaml --skip-unchanged
foresees 'would be rendered: it does not say what it was made of'
rm one.png; foresee one.yaml --skip-unchanged; foresees 'would be rendered: it is not there'
mv whole.png one.png
foresee one.yaml two.yaml -D a=1,2 -o 'new/{name}/{a}.png' --resume --log new.log --stats new.json --progress always
ok "in their order" diff out - <<'END'
one.yaml with a=1 -> new/one/1.png: would be rendered: it is not there
one.yaml with a=2 -> new/one/2.png: would be rendered: it is not there
two.yaml with a=1 -> new/two/1.png: would be rendered: it is not there
two.yaml with a=2 -> new/two/2.png: would be rendered: it is not there
END
err_has '4 would be rendered'; ok 'and no more' [ "$(wc -l <err)" -eq 1 ]
foresee one.yaml two.yaml --skip-unchanged; err_has '1 would be rendered, 1 unchanged'
exits 0 render "${small[@]}" two.yaml --frames 1-2 --skip-unchanged -q
foresee two.yaml --frames all --skip-unchanged
ok "frames" diff out - <<'END'
two.yaml -> two-0001.png: unchanged
two.yaml -> two-0002.png: unchanged
two.yaml -> two-0003.png: would be rendered: it is not there
END
rm two-*.png
foresee absent.yaml one.yaml; ok "a scene that is not there" [ $status -eq 2 ]; err_has 'cannot read absent.yaml: No such file'; err_has '1 would be rendered, 1 failed'
foresee one.yaml -n -q; ok 'quiet' [ ! -s out ]; no_err
exits 2 render one.yaml two.yaml -n -o same.png; err_has 'is one file for 2 scenes'
passes() { run render "${small[@]}" one.yaml --skip-unchanged --aov "$1"; }
made() { ok "$1: rendered" grep -q '^wrote one.png' err; passes depth,object; ok "$1: and then not" grep -qx 'unchanged one.png' err; }
passes depth,object; made "passes"; cp one.png good.png; cp one.depth.pfm good.pfm
passes depth; ok "fewer of them" grep -qx 'unchanged one.png' err; skip; ok "none of them" grep -qx 'unchanged one.png' err
passes depth,normal; ok "another one" grep -q '^wrote one.png' err; passes depth,object; made "those of before"
for pass in one.depth.pfm one.object.png; do
    printf x | dd of=$pass bs=1 seek=90 conv=notrunc 2>/dev/null; passes depth,object; made "an edited $pass"
    head -c -1 $pass >cut; mv cut $pass; passes depth,object; made "a torn $pass"
    rm $pass; passes depth,object; made "without $pass"
done
same one.png good.png; same one.depth.pfm good.pfm
run render "${small[@]}" one.yaml --aov depth,object --samples 2; passes depth,object; made "passes of other options"
exits 0 render "${small[@]}" two.yaml --frames 1-2 --skip-unchanged; err_lacks unchanged
exits 0 render "${small[@]}" two.yaml --frames all --skip-unchanged --log log --stats s.json
err_has 'unchanged two-0002.png'; err_has 'wrote two-0003.png'; err_has '1 rendered, 2 unchanged'
ok "the log says so" [ "$(grep -c '"status": "unchanged"' log)" -eq 2 ]; ok "so do statistics" grep -q unchanged s.json
"$monge" render "${small[@]}" two.yaml --frames 3 -o alone.png 2>err; ok "a frame after unchanged ones" cmp alone.png two-0003.png
cd ..

# ---- Checkpoints ----

mkdir resume && cd resume || exit 1
printf 'image: {size: [320, 240], samples: 9}\nlights: [{point: {at: [4, 6, 9]}}]\nscene:\n' >long.yaml
for x in -2 -1 0 1 2; do printf '  - sphere: {center: [%s, 0, 0], radius: 0.6}\n    material: {diffuse: [0.2, 0.2, 0.2], reflection: 0.6, refraction: 0.3, index: 1.3}\n' $x; done >>long.yaml
sed -i 's/^scene/render: {depth: 12}\nscene/' long.yaml
long=(--threads 1 --samples "$(samples_for 2.5 long.yaml)") # seconds, and what is told of a signal comes in them
"$monge" render -q long.yaml "${long[@]}" -o whole.png
# kept SIGNAL ARGS...: sends the signal as soon as there is a checkpoint with some tiles. False: it was too late.
kept() {
    "$monge" render -q long.yaml "${@:2}" --resume 2>err & local pid=$!
    await '[ "$(stat -c %s .long.png.partial)" -gt 20000 ]'
    kill -"$1" $pid; wait $pid 2>/dev/null
    [ -s .long.png.partial ] && [ ! -e long.png ]
}
for signal in KILL TERM; do
    rm -f long.png .long.png.partial; last="render --resume (signal $signal)"
    ok "$signal leaves a checkpoint" kept $signal "${long[@]}"
    cp .long.png.partial saved
    exits 0 render long.yaml "${long[@]}" --threads 3 --resume; err_has 'resumed long.png  '; same long.png whole.png; missing .long.png.partial
    cp saved .long.png.partial # as of a run that was stopped when the picture was in place
    exits 0 render long.yaml "${long[@]}" --resume; err_has 'unchanged long.png'; missing .long.png.partial
done
last='several, stopped'; for i in 1 2 3 4; do cp long.yaml stop-$i.yaml; done
"$monge" render stop-*.yaml -j 3 -q "${long[@]}" -o stopped/ --log stop.log 2>err & pid=$!
await '[ -d stopped ]'; sleep 0.1; kill -TERM $pid; wait $pid; status=$?
ok "the signal ends it" [ $status -eq 143 ]; ok "nothing is left" [ -z "$(ls -A stopped)" ]; no_err
# stopped SIGNAL ARGS...: a picture, and then one that is cut short by the signal
stopped() {
    last="render ${*:2} (signal $1)"; rm -rf stopped cut.*
    "$monge" render probe.yaml long.yaml stop-1.yaml -j 1 "${long[@]}" -o stopped/ --log cut.log --stats cut.json "${@:2}" 2>err & local pid=$!
    await '[ -s cut.log ]'; sleep 0.1; kill -$1 $pid; { wait $pid; } 2>/dev/null; status=$?
}
echo 'image: {size: [8, 6]}
scene: [{sphere: {}}]' >probe.yaml
for row in 'TERM 143' 'HUP 129'; do
    stopped ${row% *}; ok "the status tells the signal" [ $status -eq ${row#* } ]
    ok "what is done, and how to go on" [ "$(tail -n 1 err)" = 'interrupted: 1 of 3 rendered; the same command with --resume goes on' ]
    ok "a line of the log for what is done" [ "$(grep -c '"status": "rendered"' cut.log)" -eq 1 -a "$(wc -l <cut.log)" -eq 1 ]
    ok "statistics of what is done" [ "$(grep -c '"status": ' cut.json)" -eq 1 ]
done
stopped TERM --resume; ok "with --resume" [ "$(tail -n 1 err)" = 'interrupted: 1 of 3 rendered; the same command goes on' ]
for i in $(seq 11 21); do echo 'scene: [{sphere: {raduis: 1}}]' >broken-$i.yaml; done; rm -f cut.log
last='render of broken scenes (signal TERM)'; "$monge" render broken-*.yaml long.yaml -j 1 "${long[@]}" -o stopped/ --log cut.log 2>err & pid=$!
await '[ "$(wc -l <cut.log)" -eq 11 ]'; sleep 0.1; kill -TERM $pid; { wait $pid; } 2>/dev/null
ok "what has failed is listed" [ "$(tail -n 12 err | head -n 1)" = 'failed stopped/broken-11.png  from broken-11.yaml' -a "$(grep -c '^failed stopped/broken-' err)" -eq 11 ]
ok "before what is done" [ "$(tail -n 1 err)" = 'interrupted: 0 of 12 rendered, 11 failed' ]; rm broken-*
mkfifo waits.yaml; last='render of a pipe that nobody writes to (signal TERM)'; rm -rf stopped cut.log
"$monge" render probe.yaml waits.yaml stop-1.yaml -j 1 -o stopped/ --log cut.log 2>err & pid=$!
await '[ -s cut.log ]'; sleep 0.3; kill -TERM $pid; { wait $pid; } 2>/dev/null; status=$?
ok "the signal ends the reading" [ $status -eq 143 -a "$(wc -l <cut.log)" -eq 1 ]; err_lacks error
ok "which is no failure" [ "$(tail -n 1 err)" = 'interrupted: 1 of 3 rendered; the same command with --resume goes on' ]; rm waits.yaml
mkfifo waits.yaml; rm cut.log; last='render --format json of a pipe that nobody writes to (signal TERM)'
"$monge" render probe.yaml waits.yaml -j 1 -o stopped/ --log cut.log --format json 2>err & pid=$!
await '[ -s cut.log ]'; sleep 0.3; kill -TERM $pid; { wait $pid; } 2>/dev/null
ok "nor in a document" [ "$(tr -d ' \n' <err)" = '[]' ]; rm waits.yaml
last='render (two signals at once)'; rm -rf stopped cut.log
if have perl; then # as some programs send them
    AND=TERM signalled INT 'sleep 0.2' render long.yaml -j 1 "${long[@]}" --samples 60000 -o stopped/ --resume
    ok "two signals at once are one" [ "$(cat err)" = 'interrupted: 0 of 1 rendered; the same command goes on' ]
fi
rm -rf stopped
part() { run render long.yaml --samples 1 --shadow 0.9 --resume -o "${1:-long.png}"; }
rm long.png; cp saved .long.png.partial; part; err_lacks resumed; missing .long.png.partial
run render --samples 1 --shadow 0.9 -q long.yaml -o short.png; same long.png short.png
cp saved .long.png.partial; run render long.yaml --samples 1 -q; missing .long.png.partial # no --resume
run render probe.yaml -q; cp saved .probe.png.partial; run render probe.yaml --skip-unchanged; err_has unchanged; missing .probe.png.partial
: >.probe.png.partial; run render probe.yaml -q; missing .probe.png.partial # of a run that was stopped when it had just made it
echo mine >.probe.png.partial; run render probe.yaml -q; there .probe.png.partial; rm .probe.png.partial
rm long.png; { head -c -1000 saved; head -c 5000 /dev/urandom; } >.long.png.partial
exits 0 render long.yaml "${long[@]}" --resume; err_has resumed; same long.png whole.png
rm long.png; cp saved .long.png.partial; printf XXXX | dd of=.long.png.partial bs=1 seek=9000 conv=notrunc 2>/dev/null
exits 0 render long.yaml "${long[@]}" --resume; same long.png whole.png
rm long.png; cp saved .long.png.partial
if have flock; then
    flock .long.png.partial -c "'$monge' render long.yaml --samples 1 --size 64x48 --resume" 2>err; last='render --resume beside another'
    err_has 'is rendered by another run as well'; there long.png .long.png.partial; rm -f .long.png.partial
    rm long.png; cp saved .long.png.partial; flock .long.png.partial sleep 0.3 & while flock -n .long.png.partial true; do sleep 0.01; done
    exits 0 render long.yaml "${long[@]}" --resume; wait; err_has 'resumed long.png'; same long.png whole.png; missing .long.png.partial
    rm long.png; : >.long.png.partial; last='render --resume beside another that ends' # which takes ten seconds
    flock -o .long.png.partial sh -c "'$monge' render long.yaml ${long[*]} --samples $((5 * ${long[3]})) --resume 2>err & echo \$! >pid; until grep -q 'another run' err; do sleep 0.05; done; sleep 1.5"
    await '[ "$(stat -c %s .long.png.partial)" -gt 2000 ]'
    kill -KILL "$(cat pid)"; ok "it has the checkpoint in the end, from the first tile on" sh -c "head -c 400 .long.png.partial | od -An -tx1 | tr -d ' \n' | grep -qE '0(1020304|4030201)0a0a0{16}'"; rm -f .long.png.partial
else left_out "a locked checkpoint: no flock"; fi
ln -s nowhere .other.png.partial; part other.png; there other.png; rm .other.png.partial
exits 0 render -q long.yaml --samples 1 --size 64x48 --resume -o -; ok "standard output" [ -s out ]
cd ..

# ---- What can go wrong ----

mkdir wrong && cd wrong || exit 1
for i in 1 2 3 4 5; do echo 'scene: [{sphere: {}}]' >$i.yaml; mkdir $i; done
rmdir 3; echo file >3
exits 2 render ?.yaml -j 2 "${small[@]}" -o '{name}/x.png'; err_has 'error[cannot-make-folder]: cannot make the folder 3: it is a file'; there 1/x.png 2/x.png 4/x.png 5/x.png; err_has '4 rendered, 1 failed'
exits 2 render ?.yaml -j 2 "${small[@]}" -o 3/; ok "a folder that cannot be made is told once" [ "$(cat err)" = $'monge: error[cannot-make-folder]: cannot make the folder 3: it is a file\n0 rendered, 5 failed' ]
rm -f ?/x.png
apart= # a shell that may mount
for how in -m -rm; do unshare $how sh -c 'mount -t tmpfs none 4' 2>/dev/null && apart="unshare $how sh -c" && break; done
if [ -n "$apart" ]; then
    last='with a read-only folder'
    $apart "mount -t tmpfs -o ro none 4; '$monge' render ?.yaml -j 2 ${small[*]} -o '{name}/x.png'" >out 2>err; status=$?
    ok "a read-only folder" [ $status -eq 2 ]; err_has 'cannot write 4/x.png: Read-only file system'; there 1/x.png 2/x.png 5/x.png
    last='with a log in a read-only folder'
    $apart "mount -t tmpfs -o ro none 4; '$monge' render 1.yaml ${small[*]} -o 1/ --log 4/log" >out 2>err; status=$?
    ok "a log in a read-only folder" [ $status -eq 2 ]; err_has 'error[cannot-write]: cannot write 4/log: Read-only file system'
    rm -f ?/x.png; last='with a full disk'
    $apart "mount -t tmpfs -o size=4k none 2; '$monge' render ?.yaml --size 300x200 -o '{name}/x.png'; status=\$?; ls -A 2 >left.ls; exit \$status" >out 2>err; status=$?
    ok "a full disk" [ $status -eq 2 ]; err_has 'cannot write 2/x.png: No space left'; there 1/x.png 5/x.png; ok "nothing is left there" [ ! -s left.ls ]
    last='with a disk that gets full'
    $apart "mount -t tmpfs -o size=8k none 2; '$monge' render [1245].yaml -j 1 --size 300x200 --log 4/log -o 2/; '$monge' render 1.yaml --size 16x12 -o 2/; head -c 8000 /dev/zero >2/rest; '$monge' render 1.yaml --size 300x200 -o 2/" >out 2>err
    ok "what there is no room for is told" [ "$(grep -c 'cannot write 2/[1245].png: No space' err)" -eq 5 ]
    ok "and not rendered after the first" [ "$(grep -c 'cannot write 2/[1245].png: No space left on device; it is not rendered' err)" -eq 4 ]; err_has 'wrote 2/1.png'; rm -f 4/log
    last='with a log on a full disk'; mkdir logs
    $apart "mount -t tmpfs -o size=12k none 2; head -c 4000 /dev/zero | tr '\\0' '\\n' >2/log; head -c 8192 /dev/zero >2/rest; '$monge' render 1.yaml 4.yaml --size 16x12 -q -o logs/ --log 2/log; echo \$? >left.ls; cp 2/log logs/; rm 2/rest; '$monge' render 1.yaml --size 16x12 -q -o logs/ --log 2/log; cp 2/log logs/after" >out 2>err
    ok "a log on a full disk" [ "$(cat left.ls)" = 2 ]; err_has 'cannot write 2/log: No space left'; ok "has no part of a line" [ "$(wc -c <logs/log)" -eq 4000 ]
    ok "and then a whole one" [ "$(wc -l <logs/after)" -eq 4001 -a "$(tail -n 1 logs/after | grep -c '^{"started.*}$')" -eq 1 ]; rm -r logs
    last='with a link out of a full disk'; mkdir elsewhere; echo old >elsewhere/1.png
    $apart "mount -t tmpfs -o size=4k none 2; ln -s ../elsewhere/1.png 2/1.png; head -c 4096 /dev/zero >2/rest; '$monge' render 1.yaml --size 16x12 -q -o 2/" 2>err; status=$?
    ok "the file is elsewhere" [ $status -eq 0 ]; ok "it is written" [ "$(wc -c <elsewhere/1.png)" -gt 100 ]
    last='with a full disk and a checkpoint'; cp ../resume/long.yaml .
    $apart "mount -t tmpfs -o size=200k none 2; '$monge' render long.yaml ${long[*]} --resume -o 2/; status=\$?; ls -A 2 >left.ls; cp 2/long.png .; exit \$status" >out 2>err; status=$?
    ok "a checkpoint that has no room" [ $status -eq 0 ]; err_has 'warning[cannot-write]: cannot write the checkpoint 2/.long.png.partial: No space'; same long.png ../resume/whole.png; ok "it leaves the room" [ "$(cat left.ls)" = long.png ]
else left_out "a read-only folder, a full disk: no mounts here"; fi
(ulimit -f 8; "$monge" render 1.yaml 2.yaml 4.yaml --size 300x200 -q -o limited/ 2>err); status=$?; last='render under ulimit -f'
ok "files too large" [ $status -eq 2 ]; for i in 1 2 4; do err_has "cannot write limited/$i.png: File too large"; missing limited/$i.png; done
mkfifo slow.yaml; last='render with an input that vanishes' # while the scene before it is read
"$monge" render "${small[@]}" -q -j 1 slow.yaml 2.yaml 4.yaml -o vanished/ 2>err & pid=$!
exec 3>slow.yaml; mv 2.yaml gone.yaml; cat 1.yaml >&3; exec 3>&-; wait $pid; status=$?; mv gone.yaml 2.yaml; rm slow.yaml
ok "a vanished input" [ $status -eq 2 ]; err_has 'cannot read 2.yaml: No such file'; there vanished/slow.png vanished/4.png
last='two batches at once'
"$monge" render ?.yaml --size 200x150 -q -j 2 -o both/ 2>err2 & "$monge" render ?.yaml --size 200x150 -q -j 2 -o both/ 2>err; status=$?
wait $!; ok "the other" [ $? -eq 0 ]; ok "two batches at once" [ $status -eq 0 ]
"$monge" render ?.yaml --size 200x150 -q -o single/; for f in single/*.png; do same both/${f#single/} $f; done
cd ..
rm -f resume/saved; no_leftovers

told
