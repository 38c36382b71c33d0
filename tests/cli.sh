#!/usr/bin/env bash
# Tests of the command line: tests/cli.sh [PROGRAM], build/monge by default. Works in a folder of its
# own. Tests that need a tool which is not here (python3, perl, script, man, zsh, fish) are left out.

monge=$(realpath "${1:-build/monge}")
[ -x "$monge" ] || { echo "cli: no program $monge" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
unset COLUMNS

passed=0 failed=0

# ---- How to test ----

# run ARGS...: out, err and $status are what monge made of it.
run() {
    last=$*
    "$monge" "$@" >out 2>err </dev/null
    status=$?
}

# ok NAME COMMAND...: a test that passes when the command succeeds.
ok() {
    local name=$1
    shift
    if "$@" >/dev/null 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $name"
        echo "    failed: $*; after: monge $last; exit $status; stderr:"
        sed 's/^/    | /' err
    fi
}

# exits STATUS ARGS...: runs monge; a test of its exit status.
exits() {
    local want=$1
    shift
    run "$@"
    ok "exit $want: monge $*" [ "$status" -eq "$want" ]
}

out_has() { ok "stdout has \`$1\`" grep -qF -e "$1" out; }
err_has() { ok "stderr has \`$1\`" grep -qF -e "$1" err; }
no_out() { ok "nothing on stdout" [ ! -s out ]; }
no_err() { ok "nothing on stderr" [ ! -s err ]; }
is_png() { ok "$1 is a PNG" sh -c 'head -c 8 "$1" | od -An -tx1 | tr -d " \n" | grep -qx 89504e470d0a1a0a' sh "$1"; }
missing() { ok "$1 is not there" [ ! -e "$1" ]; }
no_temporaries() { ok "no temporary files" [ -z "$(find . -name '*.tmp')" ]; }

# png_size FILE WIDTH HEIGHT
png_size() {
    ok "$1 is $2x$3" [ "$(od -An -tu1 -j16 -N8 "$1" | awk '{print $3 * 256 + $4, $7 * 256 + $8}')" = "$2 $3" ]
}

# The size and the sum of what is in a picture, without its text.
pixels() { tail -c "+$(grep -abo IDAT "$1" | head -n 1 | cut -d: -f1)" "$1" | cksum; }
same_pixels() { [ "$(pixels "$1")" = "$(pixels "$2")" ]; }
other_pixels() { ! same_pixels "$1" "$2"; }

have() { command -v "$1" >/dev/null; }

# signalled SIGNAL SECONDS ARGS...: sends the signal to monge after some time. $status is what waitpid
# has: the number of the signal that ended monge, 256 times its exit status, or 9 if it had to be killed.
signalled() {
    last="${*:3} (signal $1)"
    perl -e '
        my ($signal, $seconds, @command) = @ARGV;
        my $pid = fork;
        if (!$pid) { $SIG{INT} = $ENV{IGNORED} ? "IGNORE" : "DEFAULT"; exec @command or exit 99; }
        select undef, undef, undef, $seconds;
        kill $signal, $pid;
        if ($ENV{THEN}) { select undef, undef, undef, 0.2; system $ENV{THEN}; }
        $SIG{ALRM} = sub { kill "KILL", $pid };
        alarm 8;
        waitpid $pid, 0;
        print STDERR "";
        open my $file, ">", "wait"; print $file $?;
    ' "$1" "$2" "$monge" "${@:3}" >out 2>err
    status=$(cat wait)
}

small=(--size 16x12)
long=(--size 4000x4000 --samples 65536)
lively=(--size 4000x4000 --samples 64) # long, and its tiles are short
printf 'scene:\n  - sphere: {}\n' >one.yaml
cp one.yaml two.yml
cp one.yaml 'with space.yaml'
printf 'scene:\n  - sphere: {raduis: 2}\n  - sphere: {}\n' >wrong.yaml
mkdir a b
cp one.yaml a/
cp one.yaml b/
echo text >file

# Devices of our own: a test that fails as root would replace those of /dev.
device() {
    if [ "$(id -u)" -ne 0 ]; then ln -s "/dev/$1" "$1"; return; fi
    mknod -m 666 "$1" c 1 "$2" && : >"$1" 2>/dev/null || rm -f "$1"
}
device null 3
device full 7

# ---- Help and version ----

exits 0 --version; out_has 'monge '; no_err
exits 0 --help; out_has 'usage: monge COMMAND'; out_has 'render SCENE...'; no_err
exits 0 -h; out_has 'usage: monge COMMAND'
exits 0 help; out_has 'usage: monge COMMAND'
exits 2; err_has 'usage: monge COMMAND'; no_out
for command in render check fmt explain import schema help; do
    exits 0 help $command; out_has "usage: monge $command"
    cp out expected
    exits 0 $command --help; ok "$command --help is help $command" cmp out expected
    exits 0 $command -h; ok "$command -h is help $command" cmp out expected
done
exits 0 help render; out_has '--samples N'; out_has '(1 to 65536)'
ok "help fits 80 columns" [ -z "$(grep -E '.{81}' out)" ]
exits 0 render no-such-file.yaml --samples 3 --help; out_has 'usage: monge render'
exits 2 help rendre; err_has 'did you mean `render`?'
exits 2 help render check; err_has 'help: expected one word'

exits 0 help material; out_has 'material: a material'; out_has 'shininess: number, from 0 to 1000000; default: 32'
out_has 'The key `material` of object:'; no_err
exits 0 help radius; out_has 'The key `radius` of sphere, disc, cylinder:'; out_has 'The radius of the base.'
exits 0 help eye; out_has 'default: in front of the scene'; ok "one kind has it" [ "$(grep -c 'The key' out)" -eq 1 ]
exits 0 help ellipsoid; out_has 'not there yet'
exits 0 help render; out_has '`render` is also a word of scenes'; out_has 'shading: `phong`, `diffuse`, `signature`; default: phong'
exits 0 help look_at; exits 0 help rotate; out_has 'Its keys; exactly one of those with a * must be given:'; out_has 'x *: number, degrees'
exits 2 help raduis; err_has 'no command and no word of scenes `raduis`; did you mean `radius`?'; no_out
exits 2 help kone; err_has 'did you mean `cone`?'
exits 2 help xyzzy; err_has 'no word of scenes `xyzzy`'; ok "nothing is near" sh -c '! grep -q mean err'
exits 0 help sin; out_has 'In expressions, sin(x):'; out_has 'As in: sin(30), which is 0.5'; no_err
exits 0 help sqrt; out_has 'Takes 0 or more.'
exits 0 help pi; out_has 'In expressions, pi: 3.14159265358979'
exits 0 help step; out_has 'step: a transform'; out_has 'The key `step` of range:'; out_has 'In expressions, step(edge, x):'
exits 2 help smoothstp; err_has 'did you mean `smoothstep`?'; no_out
exits 2 help tua; err_has 'did you mean `tau`?'
exits 0 help functions; out_has '  mix(a, b, t) '; out_has '  tau '; ok "functions fit 80 columns" [ -z "$(grep -E '.{81}' out)" ]
functions=0
for name in $(sed -n 's/^  \([a-z][a-z0-9]*\)[( ].*/\1/p' out); do
    exits 0 help "$name"; out_has "In expressions, $name"
    functions=$((functions + 1))
done
ok "there were functions" [ $functions -gt 30 ]
exits 0 help presets; out_has '  glass '; out_has 'refraction: 0.9, index: 1.5'; no_err
ok "presets fit 80 columns" [ -z "$(grep -E '.{81}' out)" ]
presets=$(sed -n 's/^  \([a-z][a-z]*\) .*/\1/p' out)
{ echo 'scene:'; printf '  - {sphere: {}, material: {preset: %s}}\n' $presets; } >presets.yaml
exits 0 check presets.yaml; no_err
ok "there were presets" [ "$(wc -l <presets.yaml)" -gt 15 ]
exits 0 help language; out_has '  sphere '; out_has 'monge help presets'
ok "the language fits 80 columns" [ -z "$(grep -E '.{81}' out)" ]
for kind in $(sed -n '/^The mappings/,$s/^  \([a-z_0-9]*\) .*/\1/p' out); do
    exits 0 help $kind; out_has "$kind"
done
ok "there were kinds" [ "$last" = 'help shear' ]
run help language; sed -n '/^A scene:/,/^A scene file/s/^    //p' out >example.yaml
exits 0 check example.yaml; no_err
exits 0 schema; out_has '"$schema": "http://json-schema.org/draft-07/schema#"'; no_err
exits 2 schema x; err_has 'schema: expected nothing more, found `x`'; no_out

exits 0 help --man; out_has '.TH MONGE 1'; out_has '.SH EXIT STATUS'; out_has '.SH SCENES'; out_has 'material: jade'
for option in output size samples region shading shadow no\\-shadows depth bits encoding threads stats progress format check quiet; do
    out_has "\\-\\-$option"
done
have man && ok "the manual page has no roff warnings" [ -z "$(LC_ALL=C.UTF-8 man --warnings -l out 2>&1 >/dev/null)" ]
exits 0 help --completion bash; cp out completion.bash
ok "the bash completion parses" bash -n completion.bash
complete_bash() { bash --norc -c 'source ./completion.bash; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _monge; printf "%s\n" "${COMPREPLY[@]}"' bash "$@" | sort | tr '\n' ' '; }
ok "bash completes a command" [ "$(complete_bash monge re)" = 'render ' ]
ok "bash completes a word of scenes" [ "$(complete_bash monge help mat)" = 'material ' ]
ok "bash completes nothing after schema" [ "$(complete_bash monge schema '')" = ' ' ]
ok "bash completes an option" [ "$(complete_bash monge render --sh)" = '--shading --shadow ' ]
ok "bash completes a choice" [ "$(complete_bash monge render --shading '')" = 'diffuse phong signature ' ]
ok "bash completes a choice after =" [ "$(complete_bash monge render --shading = d)" = 'diffuse ' ]
ok "bash completes a code" [ "$(complete_bash monge explain no-li)" = 'no-light ' ]
ok "bash completes a scene" [ "$(complete_bash monge check w)" = 'with space.yaml wrong.yaml ' ]
exits 0 help --completion=zsh; out_has '#compdef monge'
have zsh && ok "the zsh completion parses" zsh -n out
exits 0 help --completion fish; out_has 'complete -c monge'
have fish && ok "the fish completion parses" fish -n out
exits 2 help --completion tcsh; err_has '--completion: expected bash, zsh or fish, found `tcsh`'

# ---- Usage errors: exit 2, say which, point to help, render nothing ----

exits 2 rander; err_has 'no command `rander`; did you mean `render`?'; err_has 'see `monge help`'
exits 2 one.yaml; err_has 'did you mean `monge render one.yaml`?'
exits 2 xyzzy; err_has 'no command `xyzzy`'; ok "nothing is near xyzzy" sh -c '! grep -q mean err'
exits 2 $'\033[31m'; ok "no control characters" sh -c '! grep -q "$(printf "\033")" err'
exits 2 render; err_has 'render: no scene given'; err_has 'see `monge help render`'
exits 2 check; err_has 'check: no scene given'
exits 2 fmt; err_has 'fmt: no scene given'
exits 2 render one.yaml --sample 2; err_has 'no option `--sample`; did you mean `--samples`?'
exits 2 render one.yaml --thr 2; err_has 'did you mean `--threads`?'
exits 2 render one.yaml --szie=4x4; err_has 'no option `--szie`; did you mean `--size`?'
exits 2 check one.yaml --size 4x4; err_has 'no option `--size`'
exits 2 render one.yaml -x; err_has 'no option `-x`'
exits 2 --quiet; err_has 'no option `--quiet`'
exits 2 render one.yaml --quiet=yes; err_has '--quiet takes no value, found `yes`'
exits 2 render one.yaml --size; err_has '--size: expected WxH like 640x480, each from 1 to 65535, found nothing'
exits 2 render one.yaml -o ''; err_has '-o: expected FILE|DIR/|PATTERN, found ``'
exits 2 render one.yaml --samples x; err_has '--samples: expected a whole number from 1 to 65536, found `x`'
for bad in 0 65537 -1 +1 1.5 '' ' 1' 0x10 18446744073709551617; do
    exits 2 render one.yaml --samples "$bad"; err_has "found \`$bad\`"
done
for bad in 0x4 4x0 4 4x x4 4x4x4 4X4 65536x1 -4x4; do
    exits 2 render one.yaml --size "$bad"; err_has "--size: expected WxH"
done
for bad in 0,0,4 0,0,4,0 0,0,4,4,4 -1,0,4,4 0,0,4,4x 0.5,0,4,4; do
    exits 2 render one.yaml --region "$bad"; err_has "--region: expected X,Y,W,H"
done
for bad in -0.1 1.1 nan inf x '' 0x1p-1 1e; do
    exits 2 render one.yaml --shadow "$bad"; err_has "--shadow: expected a number from 0 to 1, found \`$bad\`"
done
exits 2 render one.yaml --shading flat; err_has 'expected phong, diffuse or signature, found `flat`'
exits 2 render one.yaml --bits 12; err_has '--bits: expected 8 or 16'
exits 2 render one.yaml --encoding gamma; err_has '--encoding: expected srgb or linear'
exits 2 render one.yaml --depth 65; err_has '--depth: expected a whole number from 1 to 64'
exits 2 render one.yaml --threads 0; err_has '--threads: expected a whole number from 1'
exits 2 render one.yaml --progress yes; err_has '--progress: expected auto, always or never'
exits 2 render one.yaml --shadow 0.5 --no-shadows; err_has '--shadow and --no-shadows'
missing one.png
exits 2 render one.yaml "${small[@]}" --region 10,0,7,1; err_has '--region 10,0,7,1'; err_has '16x12'; missing one.png
exits 2 render one.yaml --size 65535x65535; err_has 'one.yaml: '; missing one.png

# ---- Where pictures go ----

exits 0 render one.yaml "${small[@]}"; is_png one.png; png_size one.png 16 12; no_out; no_temporaries
err_has 'wrote one.png  16x12  '
ok "one line for one picture" [ "$(wc -l <err)" -eq 1 ]
cp one.png expected.png
for form in '-o x.png' '-ox.png' '--output x.png' '--output=x.png' '-qo x.png'; do
    rm -f x.png
    exits 0 render $form "${small[@]}" one.yaml; ok "$form gives the same bytes" cmp x.png expected.png
done
rm -f one.png x.png
exits 0 render "${small[@]}" one.yaml -q --threads=1 two.yml; is_png one.png; is_png two.png; no_err
ok "one thread gives the same bytes" cmp one.png expected.png
rm -f one.png two.png
exits 0 render "${small[@]}" -- one.yaml; is_png one.png
cp one.yaml ./-odd.yaml
exits 0 render "${small[@]}" -q -- -odd.yaml; is_png ./-odd.png
exits 0 render "${small[@]}" -q 'with space.yaml'; is_png 'with space.png'
exits 0 render "${small[@]}" a/one.yaml -o deep/er/; is_png deep/er/one.png
exits 0 render "${small[@]}" one.yaml -o deep; is_png deep/one.png
exits 0 render "${small[@]}" one.yaml two.yml -o 'p-{name}.png'; is_png p-one.png; is_png p-two.png
exits 0 render "${small[@]}" one.yaml two.yml -o 'q/{name}/'; is_png q/one/one.png; is_png q/two/two.png
exits 2 render one.yaml -o '{nmae}.png'; err_has '-o: expected {name}, found `{nmae}.png`'
[ -e null ] && exits 0 render "${small[@]}" one.yaml two.yml -o null --stats null && ok "it stays a device" [ -c null ]
exits 0 render "${small[@]}" --region 4,3,5,2 one.yaml -o region.png; png_size region.png 5 2
exits 0 render "${small[@]}" one.yaml --bits 16 --encoding linear -o bits.png
ok "16 bits" [ "$(od -An -tu1 -j24 -N1 bits.png)" -eq 16 ]
ok "gAMA" grep -q gAMA bits.png
ok "the program's name is in the picture" grep -q 'Monge ' bits.png
for option in '--threads 3' '--progress never'; do
    exits 0 render "${small[@]}" -q $option one.yaml -o x.png; ok "$option changes nothing" cmp x.png expected.png
done
cat >floor.yaml <<'YAML'
lights: [{point: {at: [3, 6, 4], color: [1, 1, 1]}}]
scene:
  - sphere: {}
    material: {reflection: 0.5}
  - square: {}
    transform: [{scale: 8}, {rotate: {x: -90}}, {translate: [0, -1, 0]}]
YAML
# a pair of options that must give different pictures
for pair in '--shading phong:--shading diffuse' '--shading diffuse:--shading signature' '--shadow 0:--shadow 0.5' \
    '--shadow 0.5:--no-shadows' '--depth 1:--depth 2' '--samples 1:--samples 9' '--bits 8:--bits 16' \
    '--encoding srgb:--encoding linear'; do
    exits 0 render --size 64x48 -q ${pair%:*} floor.yaml -o x.png
    exits 0 render --size 64x48 -q ${pair#*:} floor.yaml -o y.png
    ok "not the same: $pair" other_pixels x.png y.png
done
run render --size 64x48 -q --shadow 1 floor.yaml -o x.png
run render --size 64x48 -q --no-shadows floor.yaml -o y.png
ok "--no-shadows is --shadow 1" cmp x.png y.png

rm -f one.png two.png x.png
exits 2 render one.yaml two.yml -o x.png; err_has '-o x.png is one file for 2 scenes'; missing x.png
exits 2 render a/one.yaml b/one.yaml; err_has 'a/one.yaml and b/one.yaml would both write'; missing one.png
exits 2 render one.yaml ./one.yaml; err_has 'would both write'; missing one.png
ln -s . link
exits 2 render one.yaml two.yml -o 'link/{name}.png' --stats one.png; err_has 'would both write'; missing one.png
exits 2 render one.yaml -o one.yaml; err_has 'one.yaml would be written over'
exits 2 render one.yaml two.yml -o link/one.yaml; err_has 'is one file'
ln -s one.yaml alias.png
exits 2 render one.yaml -o alias.png; err_has 'one.yaml would be written over'
exits 2 render one.yaml --stats link/one.yaml; err_has 'one.yaml would be written over by the output of --stats'
ok "the scene is whole" cmp one.yaml a/one.yaml

exits 2 render one.yaml -o none/x.png; err_has 'none/x.png: No such file or directory'; missing none
exits 2 render one.yaml -o file/x.png; err_has 'file/x.png: Not a directory'
exits 2 render one.yaml -o file/; err_has 'cannot make the folder file'
if [ -e full ]; then
    exits 2 render "${small[@]}" one.yaml -o full; err_has 'cannot write full: No space left on device'
    exits 2 render "${small[@]}" one.yaml -o x.png --stats full; err_has 'cannot write full: No space left on device'
    ok "it stays a device" [ -c full ]
fi
if [ "$(id -u)" -ne 0 ]; then
    mkdir shut && chmod a-w shut
    exits 2 render one.yaml -o shut/x.png; err_has 'shut/x.png: Permission denied'
    echo old >kept.png && chmod a-w kept.png
    exits 2 render one.yaml -o kept.png; err_has 'kept.png: Permission denied'
fi
echo old >kept.png
last='render with a full disk'
(trap '' XFSZ; ulimit -f 0; "$monge" render "${small[@]}" -q one.yaml -o kept.png 2>/dev/null); status=$?
ok "a full disk is exit 2" [ $status -eq 2 ]
ok "a full disk leaves the old picture" [ "$(cat kept.png)" = old ]
no_temporaries
ln -s kept.png through.png
exits 0 render "${small[@]}" one.yaml -o through.png; is_png kept.png; ok "a link stays one" [ -L through.png ]

# ---- Standard streams ----

last='render - < one.yaml'
"$monge" render "${small[@]}" - <one.yaml >out 2>err; status=$?
ok "stdin to stdout" cmp out expected.png; err_has 'wrote standard output  16x12'
"$monge" render "${small[@]}" - -o fromstdin.png <one.yaml >out 2>err; status=$?
ok "stdin to a file" cmp fromstdin.png expected.png; no_out
"$monge" render "${small[@]}" - -o deep/ <one.yaml >out 2>err; status=$?
ok "the name of stdin" cmp deep/stdin.png expected.png
exits 0 render "${small[@]}" one.yaml -o -; ok "a file to stdout" cmp out expected.png
exits 2 render one.yaml two.yml -o -; err_has 'standard output can take only one picture'; no_out
exits 2 render - - -o deep/; err_has 'standard input can be only one scene'
exits 2 render one.yaml -o - --stats -; err_has '--stats -: standard output takes the picture'; no_out
rm -f x.png
exits 1 render - -o x.png; err_has 'error'; missing x.png
last='check - < one.yaml'
"$monge" check - <one.yaml >out 2>err; ok "check reads stdin" grep -qx -e '-: ok' out

for command in --version --help 'help render' 'help --man' 'help --completion bash' 'check one.yaml' \
    'render -q --size 8x8 one.yaml -o -' 'render -q --size 8x8 one.yaml --stats -'; do
    last="$command >/dev/full"
    "$monge" $command >/dev/full 2>err; status=$?
    ok "$command into a full device is exit 2" [ $status -eq 2 ]; err_has 'cannot write standard output: No space left'
    ok "said once" [ "$(grep -c 'cannot write' err)" -eq 1 ]
    last="$command >&-"
    "$monge" $command >&- 2>err; status=$?
    ok "$command without stdout is exit 2" [ $status -eq 2 ]; err_has 'cannot write standard output: Bad file desc'
done
rm -f x.png
last='render without stderr and stdin'
"$monge" render "${small[@]}" one.yaml -o x.png 2>&- <&-; status=$?
ok "render without stderr and stdin" [ $status -eq 0 ]; ok "its picture" cmp x.png expected.png

# ---- Scenes that are wrong ----

rm -f one.png two.png
exits 1 render wrong.yaml "${small[@]}"; err_has 'wrong.yaml:2:'; err_has 'raduis'; missing wrong.png
exits 2 render absent.yaml; err_has 'absent.yaml'; err_has 'No such file or directory'; missing absent.png
exits 1 render "${small[@]}" one.yaml wrong.yaml two.yml; is_png one.png; is_png two.png; missing wrong.png
err_has '2 rendered, 1 failed'
rm -f one.png
exits 2 render "${small[@]}" wrong.yaml absent.yaml one.yaml; is_png one.png; err_has '1 rendered, 2 failed'
exits 1 render "${small[@]}" -q wrong.yaml one.yaml; ok "quiet has no summary" sh -c '! grep -q rendered err'
err_has 'raduis'

exits 0 check one.yaml; ok "one: ok" [ "$(cat out)" = 'one.yaml: ok' ]; no_err
exits 0 check -q one.yaml two.yml; no_out; no_err
exits 1 check one.yaml wrong.yaml two.yml
ok "the verdicts in order" [ "$(cat out)" = "$(printf 'one.yaml: ok\nwrong.yaml: 1 error\ntwo.yml: ok')" ]
err_has 'wrong.yaml:2:'
exits 1 check --quiet one.yaml wrong.yaml; ok "quiet says what is wrong" [ "$(cat out)" = 'wrong.yaml: 1 error' ]
exits 2 check wrong.yaml absent.yaml; out_has 'absent.yaml: not read'; err_has 'No such file or directory'

exits 1 check --format json one.yaml wrong.yaml; out_has '"code": "unknown-key"'; no_err
exits 0 check --quiet --format sarif one.yaml; out_has '"version": "2.1.0"'; no_err
exits 2 check --format xml one.yaml; err_has 'expected text, json or sarif'
exits 2 check --format json one.yaml --nonsense; no_out
exits 1 render --format json "${small[@]}" wrong.yaml one.yaml -o formats/; err_has '"code": "unknown-key"'; no_out
ok "the document is all there is" [ "$(head -c 1 err)$(tail -n 1 err)" = '[]' ]
is_png formats/one.png
exits 0 render --format json "${small[@]}" one.yaml -o - ; ok "no mistakes" [ "$(cat err)" = '[]' ]; is_png out

# ---- explain ----

exits 0 explain; out_has 'unknown-key '; no_err
ok "a line for each code" [ "$(wc -l <out)" -gt 50 ]
exits 0 explain unknown-key; out_has 'unknown-key (error)'; out_has 'raduis'; no_err
exits 0 explain unknown-key no-light; out_has 'unknown-key (error)'; out_has 'no-light (warning)'
exits 2 explain unknown-kye; err_has 'did you mean `unknown-key`?'; no_out
exits 2 explain zzzzzzzz; err_has '`monge explain` lists them'; no_out
exits 2 explain --format json; err_has '--format'

# ---- Importing ----

printf -- '- add: sphere\n- add: light\n  at: [-10, 10, -10]\n  intensity: [1, 1, 1]\n' >book.yml
printf -- '- add: sphre\n' >wrongbook.yml
exits 0 import book.yml; out_has '- sphere: {}'; err_has 'book.yml:1:1: warning[import-missing]: there is no camera'
cp out imported.yaml
exits 0 import book.yml -o book.yaml; ok "-o gives the same" cmp imported.yaml book.yaml; no_out; no_temporaries
exits 0 check book.yaml
last='import - <book.yml | render -'
"$monge" import - <book.yml 2>err | "$monge" render "${small[@]}" -q - >out 2>>err; status=$?
is_png out
exits 1 import wrongbook.yml -o none.yaml; err_has 'did you mean `sphere`?'; missing none.yaml
exits 2 import; err_has 'import: no scene given'
exits 2 import book.yml one.yaml; err_has 'import: expected one file, found `one.yaml` as well'
exits 2 import absent.yml; err_has 'No such file or directory'
exits 2 import book.yml -o ./book.yml; err_has 'book.yml would be written over'
exits 2 import book.yml -o none/x.yaml; err_has 'cannot write none/x.yaml: No such file or directory'
exits 2 import book.yml --size 4x4; err_has 'no option `--size`'
[ -e full ] && exits 2 import book.yml -o full && err_has 'cannot write full: No space left on device'
exits 0 help import; out_has '-o, --output FILE'

# ---- Statistics ----

exits 1 render "${small[@]}" --threads 2 one.yaml wrong.yaml -o deep/ --stats s.json; no_out
cp one.yaml $'od"d\\\377\n.yaml'
run render "${small[@]}" -q $'od"d\\\377\n.yaml' --stats odd.json
ok "an odd name" [ $status -eq 0 ]
{ echo 'scene:'; for i in $(seq 300); do echo "  - sphere: {center: [$i, 0, 0]}"; done; } >many.yaml
exits 0 render "${small[@]}" -q many.yaml --stats many.json
if have python3; then
    ok "the statistics" python3 - <<'PYTHON'
import json
stats = json.load(open("s.json"))
good, bad = stats["pictures"]
assert stats["version"]
assert (good["scene"], good["output"]) == ("one.yaml", "deep/one.png")
assert (good["width"], good["height"]) == (16, 12) and 1 <= good["threads"] <= 2
assert good["samples"] >= 1 and good["primitives"] == 1 and good["peak_memory_bytes"] > 100000
assert set(good["seconds"]) == {"load", "build", "render", "write"}
assert all(0 <= s < 60 for s in good["seconds"].values()) and good["seconds"]["write"] > 0
rays = good["rays"]
assert rays["camera"] == 16 * 12 * good["samples"]
assert rays["total"] == sum(rays[k] for k in ("camera", "shadow", "reflection", "refraction"))
built = json.load(open("many.json"))["pictures"][0]
assert built["primitives"] == 300 and built["seconds"]["build"] > 0
assert bad == {"scene": "wrong.yaml", "output": "deep/wrong.png", "error": True}
assert json.load(open("odd.json"))["pictures"][0]["scene"] == 'od"d\\\ufffd\n.yaml'
PYTHON
fi
exits 0 render "${small[@]}" -q one.yaml --stats -; out_has '"pictures"'
echo old >s.json; chmod 604 s.json
exits 0 render "${small[@]}" -q one.yaml --stats s.json
ok "the file keeps its permissions" [ "$(stat -c %a s.json)" = 604 ]
exits 2 render one.yaml --stats none/s.json; err_has 'none/s.json: No such file or directory'
last='render -o - --stats t.json with a full disk'
(trap '' XFSZ; ulimit -f 0; "$monge" render "${small[@]}" -q one.yaml -o - --stats t.json 2>&1 >/dev/null | cat >/dev/null; exit "${PIPESTATUS[0]}")
status=$?
ok "a full disk for the statistics is exit 2" [ $status -eq 2 ]; missing t.json
no_temporaries

# ---- Progress ----

exits 0 render --size 640x480 --samples 16 --threads 1 one.yaml --progress always -o p.png
ok "a bar, which the last line replaces" grep -qE $'^\rone  \\[.*left.*\r +\rwrote p.png' err
ok "one line in the end" [ "$(wc -l <err)" -eq 1 ]
rm -f p.png
if have perl; then
    signalled INT 1 render "${lively[@]}" one.yaml --progress always -o p.png
    ok "always: a bar" grep -qE 'one  \[[#-]+\] +[0-9]+%  [0-9:]+ left' err
    ok "at most ten a second" [ "$(tr '\r' '\n' <err | grep -c left)" -le 11 ]
    ok "no line breaks, no escapes" [ "$(tr -d '\r' <err | wc -l)" -eq 0 -a "$(grep -c $'\033' err)" -eq 0 ]
    ok "the line is blank in the end" [ -z "$(tr '\r' '\n' <err | tail -n 1 | tr -d ' ')" ]
    ok "the cursor is at its start" [ "$(tail -c 1 err)" = $'\r' ]
    signalled INT 0.5 render "${lively[@]}" one.yaml -o p.png
    ok "auto: nothing in a pipe" [ ! -s err ]
fi
if have script && have perl; then
    on_terminal() { script -qec "stty cols ${columns:-60}; $*" /dev/null </dev/null >terminal 2>&1; status=$?; last="on a terminal: $*"; }
    bar="perl -e 'my \$p = fork; exec \"$monge\", qw(render ${lively[*]} one.yaml -o p.png) if !\$p; select undef, undef, undef, 0.6; kill TERM => \$p; waitpid \$p, 0'"
    on_terminal "$bar"
    ok "auto: a bar on a terminal" grep -q 'left' terminal
    ok "no wider than the terminal" [ -z "$(tr '\r' '\n' <terminal | grep -E '.{60}')" ]
    columns=20 on_terminal "$bar"
    ok "no wider than a narrow terminal" [ -z "$(tr '\r' '\n' <terminal | grep -E '.{20}')" ]
    on_terminal "$monge render -q ${small[*]} one.yaml -o -"
    ok "no PNG to a terminal" grep -q 'not for a terminal' terminal
    ok "that is exit 2" [ $status -eq 2 ]
fi

# ---- Signals ----

if have perl; then
    rm -f p.png
    for row in 'INT 2' 'TERM 15' 'HUP 1'; do
        signalled ${row% *} 0.4 render "${long[@]}" one.yaml -o p.png --stats p.json
        ok "SIG${row% *} ends monge by the same signal" [ "$status" -eq "${row#* }" ]
        missing p.png; missing p.json; no_temporaries; no_out
    done
    mkfifo pipe
    sleep 3 | signalled TERM 0.3 render - -o p.png
    status=$(cat wait)
    ok "SIGTERM while a scene is read" [ "$status" -eq 15 ]
    signalled INT 0.4 render "${small[@]}" one.yaml -o pipe
    ok "SIGINT while a pipe has no reader" [ "$status" -eq 2 ]; no_err
    IGNORED=1 THEN='cat pipe > frompipe.png' signalled INT 0.4 render "${small[@]}" -q one.yaml -o pipe
    ok "an ignored SIGINT stays ignored" [ "$status" -eq 0 ]
    ok "a pipe takes a picture" cmp frompipe.png expected.png
fi

last='render -o - into a pipe that closes'
"$monge" render --size 900x900 --bits 16 -q one.yaml -o - | head -c 10 >/dev/null
status=${PIPESTATUS[0]}
ok "a closed pipe ends monge by SIGPIPE" [ "$status" -eq 141 ]
no_temporaries

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
