#!/usr/bin/env bash
# Tests of the command line: tests/cli.sh [PROGRAM], build/monge by default. Works in a folder of its
# own. Tests that need a tool which is not here (python3, perl, script, man, zsh, fish) are left out.

. "$(dirname "$0")/lib/testing.sh"

# png_size FILE WIDTH HEIGHT
png_size() {
    ok "$1 is $2x$3" [ "$(od -An -tu1 -j16 -N8 "$1" | awk '{print $3 * 256 + $4, $7 * 256 + $8}')" = "$2 $3" ]
}

# The size and the sum of what is in a picture, without its text.
pixels() { tail -c "+$(grep -abo IDAT "$1" | head -n 1 | cut -d: -f1)" "$1" | cksum; }
same_pixels() { [ -s "$1" ] && [ "$(pixels "$1")" = "$(pixels "$2")" ]; }
other_pixels() { [ -s "$1" ] && [ -s "$2" ] && ! same_pixels "$1" "$2"; }

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
cp out expected
for form in -V version; do exits 0 $form; ok "$form is --version" cmp out expected; done
printf 'params: {a: 0, b: 0}\nscene: [{sphere: {radius: 1 + a + b}}]\n' >two-params.yaml
exits 0 render -q two-params.yaml --size 9x8 --no-shadows --depth 2 -D b=2 -D a=1 -o asked.png
ok 'a picture tells its options' grep -qa -e '--size 9x8 --shadow 1 --depth 2 -D a=1 -D b=2' asked.png
exits 0 render -q two-params.yaml --size 09x8 --samples 02 --region 0,00,9,8 --shadow .50 -D a=-0.20 -D 'b=1 + 2' -o asked.png
ok 'numbers by their value, words as a shell takes them' \
    grep -qa -e "--size 9x8 --samples 2 --region 0,0,9,8 --shadow 0.5 -D a=-0.2 -D 'b=1 + 2'" asked.png
exits 2 version x; err_has 'version: expected nothing more'
exits 0 --help; out_has 'usage: monge COMMAND'; out_has 'render SCENE...'; no_err
ok "lines of at most 80 columns" [ -z "$(awk 'length > 80' out)" ]
exits 0 -h; out_has 'usage: monge COMMAND'
exits 0 help render; cp out expected
for form in --help -h; do exits 0 $form render; ok "$form render is help render" cmp out expected; done
ok "its end are the examples" [ "$(tail -n 1 expected)" = '`render` is also a word of scenes: `monge help language render`.' ]
ok "and no page follows" [ "$(tail -n 3 expected | head -n 1)" = '      from a program to a program' ]
exits 0 help language render; out_has 'depth'; ok "which is not that of the command" sh -c '! grep -q usage: out'
exits 0 --help material; cp out expected; exits 0 help language material; ok "others have one" cmp out expected
exits 2 --help rendr; err_has 'did you mean `render`?'
exits 2 help language rendr; err_has 'did you mean `render`?'
exits 2 help language render more; err_has 'help: expected one word, found `more` as well'
exits 0 help; out_has 'usage: monge COMMAND'; out_has '`monge help --man`'
exits 2; err_has 'usage: monge COMMAND'; no_out
for command in render check info test accept fmt explain import schema version help; do
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
exits 0 help render; out_has '`render` is also a word of scenes'; exits 0 help language render; out_has 'shading: `phong`, `diffuse`, `signature`; default: phong'
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
n=0; { echo 'scene:'; for preset in $presets; do echo "  - {sphere: {center: [$((n++)), 5, 0]}, material: {preset: $preset}}"; done; } >presets.yaml
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
for option in output size samples region shading shadow no\\-shadows depth bits encoding aov threads stats progress format check quiet define frames limit untrusted; do
    out_has "\\-\\-$option"
done
out_has '.SH FILES'; out_has '.NAME.png.partial'; out_has 'monge\-test/'; out_has '.SH ENVIRONMENT'; out_has 'in share/doc/monge,'
for variable in $(grep -rhoE 'getenv\("[A-Z_]+' "$project/src" | cut -d'"' -f2 | sort -u); do out_has ".B $variable"; done
ok "no folder that is not installed" sh -c '! grep -q grammar/ out'
have man && ok "the manual page has no roff warnings" [ -z "$(LC_ALL=C.UTF-8 man --warnings -l out 2>&1 >/dev/null)" ]
exits 0 help --completion bash; cp out completion.bash
ok "the bash completion parses" bash -n completion.bash
complete_bash() { bash --norc -c 'source ./completion.bash; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); COMP_LINE=$*; COMP_POINT=${#COMP_LINE}; _monge; printf "%s\n" "${COMPREPLY[@]}"' bash "$@" | sort | tr '\n' ' '; }
ok "bash completes a command" [ "$(complete_bash monge re)" = 'render ' ]
ok "bash completes a word of scenes" [ "$(complete_bash monge help mat)" = 'material ' ]
ok "bash completes nothing after schema" [ "$(complete_bash monge schema '')" = ' ' ]
ok "bash completes an option" [ "$(complete_bash monge render --sh)" = '--shading --shadow ' ]
ok "bash completes a choice" [ "$(complete_bash monge render --shading '')" = 'diffuse phong signature ' ]
ok "bash completes a pass" [ "$(complete_bash monge render --aov d)" = 'depth ' ]
ok "bash completes a choice after =" [ "$(complete_bash monge render --shading = d)" = 'diffuse ' ]
ok "bash completes a code" [ "$(complete_bash monge explain no-li)" = 'no-light ' ]
ok "bash completes a scene" [ "$(complete_bash monge check w)" = 'with space.yaml wrong.yaml ' ]
mkdir -p tab/folder tab/goldens; touch tab/{a.png,b.PNG,s.yaml,t.yml,list.txt,'two words.txt'}
tab() { (cd tab && . ../completion.bash && COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMP_LINE=$* && COMP_POINT=${#COMP_LINE} && _monge && printf '%s\n' "${COMPREPLY[@]}") | sort -u | tr '\n' '|'; }
offers() { ok "bash completes monge ${*:2}" [ "$(tab monge "${@:2}")" = "$1" ]; }
offers 'a.png|b.PNG|folder|goldens|' diff ''
offers 'folder|goldens|s.yaml|t.yml|' render ''
offers '@list.txt |' test @li
offers '@two\ words.txt |' fmt @tw
offers '@folder/|' info @f
offers '|' accept ''
offers 'folder|goldens|' accept --golden ''
offers 'goldens|' test --golden = go
offers 'a.png|b.PNG|folder|goldens|' diff --mask ''
offers 'memory_bytes=|' check --limit m
offers '|' check --limit memory_bytes = ''
offers '|' render -D ''
offers 'object,depth|' render --aov object,d
offers 'mae,max,ssim|' diff --metric mae,max,ss
offers 'a.png|b.PNG|folder|goldens|list.txt|s.yaml|t.yml|two words.txt|' import ''
exits 0 help --completion=zsh; out_has '_files -g "*.(png|PNG)"'; out_has ':DIR:_files -/'; out_has ':aov:_values -s , word object '; out_has 'compadd -S = - file_bytes '
exits 0 help --completion=zsh; out_has '#compdef monge'
have zsh && ok "the zsh completion parses" zsh -n out
exits 0 help --completion fish; out_has 'complete -c monge'
if have fish; then
    cp out completion.fish; ok "the fish completion parses" fish -n out
    offers() { ok "fish completes monge $2" [ "$(cd tab && fish --no-config -c "source ../completion.fish; complete -C 'monge $2'" | cut -f1 | sort | tr '\n' '|')" = "$1" ]; }
    offers 'a.png|b.PNG|folder/|goldens/|' 'diff '
    offers 'folder/|goldens/|s.yaml|t.yml|' 'render '
    offers '@list.txt|' 'test @li'
    offers '' 'accept '
    offers 'folder/|goldens/|' 'accept --golden '
    offers '--golden=goldens/|' 'test --golden=go'
    offers 'memory_bytes=|' 'check --limit m'
    offers 'object,depth|' 'render --aov object,d'
fi
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
for side in width height; do exits 2 render one.yaml --$side 3; err_has "no option \`--$side\`; did you mean \`--size WxH\`?"; done
exits 2 check one.yaml --width 3; err_lacks 'size'
exits 2 render one.yaml --szie=4x4; err_has 'no option `--szie`; did you mean `--size`?'
exits 2 check one.yaml --size 4x4; err_has 'no option `--size`'
exits 2 render one.yaml -x; err_has 'no option `-x`'
exits 2 --quiet; err_has 'no option `--quiet`'
exits 2 render one.yaml --quiet=yes; err_has '--quiet takes no value, found `yes`'
exits 2 render one.yaml --size; err_has '--size: expected WxH like 640x480, each from 1 to 65535, found nothing'
exits 2 render one.yaml --log -o junk.png; err_has 'monge: --log: expected FILE|-, found the option -o; a file of that name is ./-o'; missing -o junk.png
exits 2 render one.yaml -o --size 4x4; err_has '-o: expected FILE|DIR/|PATTERN, found the option --size; a file of that name is ./--size'
exits 2 render one.yaml --stats --size=4x4; err_has 'found the option --size=4x4'
exits 2 diff a.png b.png --ignore -q; err_has '--ignore: expected X,Y,W,H|MASK, found the option -q'
for form in '--log -draft' '--log=-o' '--log ./-k'; do exits 0 render "${small[@]}" one.yaml -q -o x.png $form; done
there ./-draft ./-o ./-k; rm ./-draft ./-o ./-k
for command in render check info fmt import test; do exits 2 $command ''; err_has "monge: $command: an operand is empty"; no_out; done
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
exits 2 render one.yaml --progress yes; err_has '--progress: expected auto, always, never or json'
exits 2 render one.yaml --shadow 0.5 --no-shadows; err_has '--shadow and --no-shadows'
missing one.png
exits 2 render one.yaml "${small[@]}" --region 10,0,7,1; err_has 'error[outside-region]: --region 10,0,7,1 does not lie within the picture of one.yaml, which is 16x12'; missing one.png
exits 2 render one.yaml --size 65535x65535; err_has 'one.yaml: '; missing one.png

# ---- Where pictures go ----

exits 0 render one.yaml "${small[@]}"; is_png one.png; png_size one.png 16 12; no_out; no_leftovers
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
exits 2 render one.yaml -o 'x/{nope}.png'; err_has '-o: expected {name}, {frame} with --frames, {NAME} with -D NAME=VALUE, found `{nope}`'
exits 2 render one.yaml -o 'x/{nope}.png' --frames all -D a=1; err_has '-o: expected {name}, {frame}, {a}, found `{nope}`'
exits 0 render "${small[@]}" -q one.yaml -o '{{nope}}.png'; is_png '{nope}.png'
exits 0 render "${small[@]}" -q one.yaml -o '{{{name}}}-}.png'; is_png '{one}-}.png'
exits 0 render "${small[@]}" -q one.yaml two.yml -o '{name}{{}}.png'; is_png 'one{}.png'; is_png 'two{}.png'
exits 2 render one.yaml two.yml -o '{{name}}.png'; err_has '-o {{name}}.png is one file for 2 scenes'
exits 2 render one.yaml -o '{name.png'; err_has 'or {{ for a {, found `{name.png`'; exits 2 render one.yaml -o '{{{name}.png}'
exits 2 render one.yaml -o '{{a}}/x.png'; err_has '; -o {{a}}/ would make the folder'; missing '{a}'
exits 0 render "${small[@]}" -q one.yaml -o '{{a}}/'; is_png '{a}/one.png'; rm -r {{a},{nope},{one}-,one{}}*
for word in -dash.yaml -king.yml -z.png; do
    exits 2 render $word; ok "$word is a file" grep -qx "monge: no option \`-[diz]\`; a file of that name is ./$word" err
done
exits 2 render -z; ok 'a letter is none' [ "$(head -n 1 err)" = 'monge: no option `-z`' ]
exits 2 render one.yaml -o '{nmae}.png'; err_has 'found `{nmae}`; did you mean {name}?'
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
exits 2 render a/one.yaml b/one.yaml; err_has 'a/one.yaml and b/one.yaml would both write'; err_has 'one.png; with --root DIR they keep their folders'; missing one.png
ln -s . link
exits 2 render one.yaml --stats x.json --log link/x.json; err_has 'would both write'; missing one.png x.json
cp two.yml new.yml; for name in one.yaml new.yml none.YAML notes.txt; do
    exits 2 render one.yaml -o $name; err_has "-o $name: pictures are PNG; did you mean ${name%.*}.png?"
done
ok "the other scene is whole" cmp new.yml two.yml; missing none.YAML notes.txt; rm new.yml
for option in stats:json log:log; do
    exits 2 render one.yaml -q --${option%:*} two.yml; err_has "--${option%:*} two.yml is called like a scene; did you mean two.${option#*:}?"
    ok "the other scene is whole" grep -q scene two.yml
    exits 2 render one.yaml -q --${option%:*} none.PNG; err_has "--${option%:*} none.PNG is called like a picture; did you mean none.${option#*:}?"; missing none.PNG
done
exits 2 render one.yaml two.yml -o link/one.yaml; err_has 'is one file'
ln -s one.yaml alias.png
exits 2 render one.yaml -o alias.png; err_has 'one.yaml would be written over'
ln one.yaml hard.json; for option in --stats --log; do
    exits 2 render one.yaml $option link/hard.json; err_has "one.yaml would be written over by the output of $option"
done
ok "the scene is whole" cmp one.yaml a/one.yaml

for name in x.jpg x.JPEG none/y.gif; do exits 2 render one.yaml -o $name; err_has "-o $name: pictures are PNG; did you mean ${name%.*}.png?"; missing $name; done
for name in picture none/picture none.d/picture .png '{name}' 'x.{name}'; do
    exits 2 render one.yaml -o "$name"; err_has "-o $name: pictures are PNG; did you mean $name.png?"; missing "$name"
done
exits 2 render turn.yaml --frames all -o 'x.%04d'; err_has 'did you mean x.%04d.png?'
exits 2 render one.yaml -o ball-0.5; err_has 'did you mean ball-0.5.png?'
exits 0 render "${small[@]}" -q one.yaml -o x.y.PNG; is_png x.y.PNG
exits 0 render "${small[@]}" -q one.yaml -o 'made/{name}/of.{name}.png'; is_png made/one/of.one.png
exits 2 render one.yaml -o none/x.png; err_has 'error[cannot-write]: cannot write none/x.png: No such file or directory; -o none/ would make the folder'; missing none
for name in file/x.png file/deep/x.png; do exits 2 render one.yaml -o $name; err_has "error[cannot-write]: cannot write $name: file is a file"; err_lacks 'would make'; done
exits 2 render one.yaml -o file/; err_has 'error[cannot-make-folder]: cannot make the folder file: it is a file'
if [ -e full ]; then
    exits 2 render "${small[@]}" one.yaml -o full; err_has 'cannot write full: No space left on device'
    exits 2 render "${small[@]}" one.yaml -o x.png --stats full; err_has 'cannot write full: No space left on device'
    ok "it stays a device" [ -c full ]
fi
if [ "$(id -u)" -ne 0 ]; then
    mkdir shut && chmod a-w shut
    exits 2 render one.yaml -o shut/x.png; err_has 'shut/x.png: Permission denied'
    exits 2 render one.yaml --log shut/log; err_has 'shut/log: Permission denied'
    echo old >kept.png && chmod a-w kept.png
    exits 2 render one.yaml -o kept.png; err_has 'kept.png: Permission denied'
fi
echo old >kept.png
last='render with a full disk'
(trap '' XFSZ; ulimit -f 0; "$monge" render "${small[@]}" -q one.yaml -o kept.png 2>/dev/null); status=$?
ok "a full disk is exit 2" [ $status -eq 2 ]
ok "a full disk leaves the old picture" [ "$(cat kept.png)" = old ]
no_leftovers
ln -s kept.png through.png
exits 0 render "${small[@]}" one.yaml -o through.png; is_png kept.png; ok "a link stays one" [ -L through.png ]

# ---- Auxiliary passes ----

rm -f one.png
exits 0 render one.yaml "${small[@]}" -q -o expected.png
exits 0 render one.yaml "${small[@]}" --aov object,material,depth,normal,shadow; is_png one.png; no_leftovers
ok "passes change nothing of the picture" same_pixels one.png expected.png
for pass in object material normal shadow; do
    is_png one.$pass.png; png_size one.$pass.png 16 12
    ok "$pass has 16 bits" [ "$(od -An -tu1 -j24 -N1 one.$pass.png)" -eq 16 ]
done
for pass in object material shadow; do ok "$pass is grey" [ "$(od -An -tu1 -j25 -N1 one.$pass.png)" -eq 0 ]; done
ok "normal is RGB" [ "$(od -An -tu1 -j25 -N1 one.normal.png)" -eq 2 ]
ok "objects have a table" grep -qa monge:table one.object.png
ok "materials have a table" grep -qa monge:table one.material.png
ok "depth is a PFM" [ "$(head -n 3 one.depth.pfm | tr '\n' ' ')" = 'Pf 16 12 -1.0 ' ]
ok "depth has a float a pixel" [ "$(wc -c <one.depth.pfm)" -eq $((14 + 4 * 16 * 12)) ]
mkdir passes
exits 0 render one.yaml "${small[@]}" --threads 1 --samples 7 --aov shadow,normal,depth,material,object -o passes/one.png
ok "the same depth with one thread and other samples" cmp one.depth.pfm passes/one.depth.pfm
for pass in object material normal shadow; do
    ok "the same $pass with one thread and other samples" same_pixels one.$pass.png passes/one.$pass.png
done
exits 0 render one.yaml two.yml "${small[@]}" -q --aov depth -o 'passes/p-{name}.png'
is_png passes/p-two.png; ok "each has its own" [ -s passes/p-one.depth.pfm -a -s passes/p-two.depth.pfm ]
missing passes/p-one.object.png
exits 0 render one.yaml "${small[@]}" --region 4,3,5,2 -q --aov depth,normal -o passes/part.png; png_size passes/part.normal.png 5 2
ok "a part of the depth" [ "$(sed -n 2p passes/part.depth.pfm)" = '5 2' ]
printf 'animation: {frames: 3}\nscene: [{sphere: {radius: 1 + t}}]\n' >grow.yaml
exits 0 render grow.yaml "${small[@]}" -q --frames all --aov object -o passes/
for frame in 0001 0002 0003; do is_png passes/grow-$frame.png; is_png passes/grow-$frame.object.png; done
exits 0 render one.yaml "${small[@]}" -q --aov depth -o passes/UPPER.PNG; ok "PNG is no part of the name" [ -s passes/UPPER.depth.pfm ]

for bad in beauty depth, ,depth '' object,,depth Depth; do
    exits 2 render one.yaml --aov "$bad"; err_has "--aov: expected some of object, material, depth, normal and shadow"; err_has "found \`$bad\`"
done
exits 2 render one.yaml --aov object,objct,depth; err_has 'with commas between, found `objct`; did you mean `object`?'
exits 2 render one.yaml --aov depth -o -; err_has '--aov: passes are files beside the picture; give -o FILE'; no_out
exits 2 render - --aov depth; err_has 'give -o FILE'
[ -e null ] && exits 2 render one.yaml --aov depth -o null && err_has 'which null is not'
cp one.yaml clash.yaml; cp one.yaml clash.object.yaml; rm -f clash*.png
exits 2 render clash.yaml clash.object.yaml --aov object; err_has 'would both write'; err_has 'clash.object.png'; missing clash.png
exits 0 render clash.yaml clash.object.yaml "${small[@]}" -q --aov depth; is_png clash.object.png
exits 2 render clash.yaml --aov depth --stats clash.depth.pfm; err_has 'would both write'
cp one.yaml clash.depth.pfm
exits 2 render clash.depth.pfm --aov depth -o clash.png; err_has 'clash.depth.pfm would be written over'
mkdir clash.normal.png
exits 2 render clash.yaml "${small[@]}" --aov normal,depth; err_has 'cannot write clash.normal.png'; no_leftovers
rmdir clash.normal.png
signalled INT 'sleep 0.2' render one.yaml "${long[@]}" --aov object -q -o passes/never.png
ok "an interrupted picture has no passes" [ "$status" -eq 2 -a ! -e passes/never.png -a ! -e passes/never.object.png ]
no_leftovers

# ---- Parameters and sweeps ----

cat >params.yaml <<'YAML'
params: {a: 1, b: 0.5, v: [0, 0, 0], tint: white}
scene:
  - sphere: {radius: a, center: v}
    material: {diffuse: tint}
  - box: {}
    transform: [{scale: b}, {translate: [12, 1, 0]}]
YAML
# literally NAME A B V TINT: the same scene with the values written in it
literally() { printf 'scene:\n  - sphere: {radius: %s, center: %s}\n    material: {diffuse: "%s"}\n  - box: {}\n    transform: [{scale: %s}, {translate: [12, 1, 0]}]\n' "$2" "$4" "$5" "$3" >"$1.yaml"; }
literally literal 2 0.25 '[0, 1, 0]' tomato
exits 0 render -q "${small[@]}" literal.yaml
exits 0 render -q "${small[@]}" params.yaml -D a=2 --define b=0.25 '-Dv=[0, 1, 0]' --define=tint=tomato; no_err
ok "-D is as if it were written" same_pixels params.png literal.png
exits 0 render -q "${small[@]}" params.yaml -D a=1 -D a=2 -D b=0.25 -D 'v=[0, 1, 0]' -D 'tint="tomato"'
ok "the last -D of a name counts" same_pixels params.png literal.png
err_has 'monge: warning[given-twice]: -D a=1 counts for nothing, -D a=2 is given later; -D a=1,2 gives both'
exits 0 check -q params.yaml -D a=1 -D b=1 -D a=1,2 -D 'tint="#fff"' -Da=3 --define 'tint=rgb(1, 0, 0)'
ok "each that does not count" [ "$(cat err)" = 'monge: warning[given-twice]: -D a=1 counts for nothing, -D a=3 is given later; -D a=1,3 gives both
monge: warning[given-twice]: -D a=1,2 counts for nothing, -D a=3 is given later; -D a=1,2,3 gives both
monge: warning[given-twice]: -D '\''tint="#fff"'\'' counts for nothing, -D '\''tint=rgb(1, 0, 0)'\'' is given later; -D '\''tint="#fff",rgb(1, 0, 0)'\'' gives both' ]
exits 0 check params.yaml -D a=1 -D b=1 -D a=1; no_err
exits 0 check params.yaml -D a=1 -D a=2 --format json; out_has '"code": "given-twice"'; out_has '"severity": "warning"'; no_err
exits 0 check params.yaml -D a=2; ok "one value is no sweep" [ "$(cat out)" = 'params.yaml: ok' ]
exits 1 render params.yaml -D aa=2; err_has 'error[unknown-parameter]'; err_has 'its parameters: a, b, v, tint'
exits 1 check params.yaml -D a=-2; out_has '1 error'
for bad in a =3 ''; do exits 2 render params.yaml -D "$bad"; err_has "-D: expected NAME=VALUE, found \`$bad\`"; done
exits 2 render params.yaml -D; err_has '-D: expected NAME=VALUE, found nothing'
for bad in 1a=3 'a b=3' a-b=3; do exits 2 check params.yaml -D "$bad"; err_has "-D $bad: a parameter has letters"; done
for bad in a=1, a=,1 a=1,,2; do exits 2 check params.yaml -D "$bad"; err_has '-D a: an empty value in'; done
exits 1 check params.yaml -D a=tomatoo; err_has '-D a:1:1: error[not-a-number]: `radius`: expected a number, found `tomatoo`'
cat >given.yaml <<'YAML'
params: {a: 1, v: [0, 0, 0], tint: white, n: 2}
image: {samples: n}
scene:
  - {sphere: {radius: 1 / a + a, center: v}, material: {diffuse: tint}}
YAML
for given in a=abc a=0 'a=[1, 2]' a=-1 v=3 'tint=[1, 2]' n=1.5 n=0; do
    exits 1 check given.yaml -D "$given"; err_has "-D ${given%%=*}:1:1: note: \`${given%%=*}\` is given here"
    ok "once, with the value" [ "$(grep -c 'note:' err)" -eq 1 -a "$(grep -cxF "    1 | ${given#*=}" err)" -eq 1 ]
done
sed 's/a: 1/a: 0/' given.yaml >within.yaml
exits 1 check within.yaml -D v=1; err_has 'division by zero'; ok "what is in the file is there to be read" [ "$(grep -c 'given here' err)" -eq 1 ]
exits 2 check params.yaml -D a=; err_has 'monge: -D a=: the value is empty'
exits 0 check params.yaml -D 'tint=#fff'
for step in 0 -1; do exits 2 check params.yaml -D a=1..2:$step; err_has "-D a: the step of \`1..2:$step\` must be over 0; 4..1 goes down"; done
exits 2 check params.yaml -D a=1..9000000; err_has '-D a: `1..9000000` is no range of at most 1000000 values'
exits 2 check params.yaml -D a=1..2000 -D b=1..2000; err_has '-D: more than 1000000 combinations'
exits 2 fmt params.yaml -D a=1; err_has 'no option `-D`'

# combinations ARGS...: what `check` says there are, one a line
combinations() { run check params.yaml "$@"; sed 's/params.yaml with //; s/: ok$//' out; }
ok "later lists run fastest" [ "$(combinations -D a=1,2 -D b=3,4 | tr '\n' ';')" = 'a=1, b=3;a=1, b=4;a=2, b=3;a=2, b=4;' ]
ok "brackets and quotes do not split" [ "$(combinations -D 'v=[1,2,3],[a, (b), 1]' -D 'tint="#fff",rgb(1,0,0)' | wc -l)" -eq 4 ]
ok "a single list is not a sweep" [ "$(combinations -D 'v=[1,2,3]')" = params.yaml ]
ok "ranges" [ "$(combinations -D a=1..3,7 | tr '\n' ';')" = 'a=1;a=2;a=3;a=7;' ]
ok "ranges with steps" [ "$(combinations -D a=1..2:0.25 | tr '\n' ';')" = 'a=1;a=1.25;a=1.5;a=1.75;a=2;' ]
ok "ranges with exponents" [ "$(combinations -D a=1e0..1.5E+0:5e-1 | tr '\n' ';')" = 'a=1;a=1.5;' ]
ok "ranges that fall" [ "$(combinations -D a=9..4:3 | tr '\n' ';')" = 'a=9;a=6;' ]
exits 1 check -q params.yaml -D a=1,-1,2; ok "each is checked" [ "$(cat out)" = 'params.yaml with a=-1: 1 error' ]

mkdir sweep && cd sweep && cp ../params.yaml ../one.yaml .
exits 0 render "${small[@]}" params.yaml -D a=1,2 -D b=0.5 -D 'tint=gold,"#ff0000"'
ok "their names" [ "$(ls ./*.png | tr '\n' ' ')" = './params-a=1-tint=ff0000.png ./params-a=1-tint=gold.png ./params-a=2-tint=ff0000.png ./params-a=2-tint=gold.png ' ]
ok "their order" [ "$(sed -n 's/^wrote params-\(.*\).png .*/\1/p' err | tr '\n' ' ')" = 'a=1-tint=gold a=1-tint=ff0000 a=2-tint=gold a=2-tint=ff0000 ' ]
exits 0 render -q "${small[@]}" params.yaml -D a=2 -D tint=gold -o x.png; ok "as by itself" same_pixels x.png params-a=2-tint=gold.png
exits 0 render -q "${small[@]}" params.yaml -D a=1,2 -o 'p/{a}/{name}-{a}.png'; is_png p/1/params-1.png; is_png p/2/params-2.png
exits 0 render -q "${small[@]}" params.yaml -D a=1,2 -o 'd/'; is_png d/params-a=1.png; is_png d/params-a=2.png
exits 0 render -q "${small[@]}" params.yaml -D 'v=[0, 0, 1]' -o 'v{v}.png'; is_png v0_0_1.png
exits 0 render -q "${small[@]}" params.yaml -D 'tint="#00f"' -o '{tint}%d.png'; is_png 00f%d.png
exits 1 render params.yaml -D a=.. -o 'up/{a}/x.png'; ok "a value is never a way up" [ -d up/_ ]
rm -f x.png
exits 2 render params.yaml -D a=1,2 -o x.png; err_has "-o x.png is one file for 2 pictures: end it in / for a folder, or write -o 'x-{a}.png'"; missing x.png
exits 2 render params.yaml -D a=1,2 -D b=1,2 -o 'x{a}.png'
err_has 'params.yaml with a=1, b=1 and params.yaml with a=1, b=2 would both write'; err_has "write -o 'x{a}-{b}.png'"; missing x1.png
exits 2 render params.yaml -D a=1,1; err_has 'would both write'
exits 2 render params.yaml one.yaml -D a=1,2 -o '{a}.png'; err_has "write -o '{a}-{name}.png'"
exits 2 render params.yaml -D a=1,2 -o '{a}{c}.png'; err_has '-o: expected {name}, {frame} with --frames, {a}, found `{c}`'
exits 2 render params.yaml -D tint=red,gold -o '{tnit}.png'; err_has 'did you mean {tint}?'
exits 2 render params.yaml -o '{a}.png'; err_has '{NAME} with -D NAME=VALUE, or {{ for a {, found `{a}`'
exits 2 render params.yaml -o '{a'; err_has 'found `{a`'
last='render - -D a=1,2 <params.yaml'
"$monge" render -q "${small[@]}" - -D a=1,2 -o 's{a}.png' <params.yaml >out 2>err; status=$?
ok "standard input with a sweep" [ $status -eq 0 ]; ok "its first" cmp s1.png p/1/params-1.png; ok "its second" cmp s2.png p/2/params-2.png
"$monge" check - -D a=1,2 <params.yaml >out 2>err; ok "check of it" [ "$(grep -c ok out)" -eq 2 ]
exits 0 render "${small[@]}" -q params.yaml -D a=1,2 -D b=1 --stats s.json
ok "the statistics have the parameters" grep -qF '"params": {"a": "2", "b": "1"}' s.json
patient '0 of 2 pictures  params  [' params.yaml -D a=1,2 --size 640x480 --progress always -o 'p{a}.png'
exits 1 render "${small[@]}" params.yaml -D a=1,-1,2; err_has '2 rendered, 1 failed'
cd ..

# ---- Animation ----

mkdir frames && cd frames && cp ../one.yaml .
cat >view.yaml <<'YAML'
animation: {frames: 12}
camera: {eye: [6*cos(2*pi*t), 2, 6*sin(2*pi*t)], look_at: [0, 0, 0]}
lights: [{point: {at: [4, 4 + t, 4]}}]
params: {a: 1}
scene:
  - sphere: {radius: a}
  - box: {}
    transform: [{translate: [40, 1, 0]}]
YAML
cat >move.yaml <<'YAML'
animation: {frames: 12}
camera: {eye: [2, 2, 6 + t], look_at: [0, 0, 0]}
scene:
  - sphere: {radius: 0.5 + t}
  - box: {}
    material: {diffuse: [t, 0, 0], reflection: {keys: {1: 0, 12: 0.5}}}
    transform: [{translate: [40, 1, 0]}]
YAML
sed 's/0.5 + t/0.5/' move.yaml >paint.yaml
for scene in view move paint; do
    exits 0 render "${small[@]}" $scene.yaml --frames all -o all/
    ok "$scene: 12 pictures" [ "$(ls all/$scene-00??.png | wc -l)" -eq 12 -a "$(grep -c '^wrote' err)" -eq 12 ]
    ok "$scene: no two are the same" [ "$(for f in all/$scene-*.png; do pixels "$f"; done | sort -u | wc -l)" -eq 12 ]
    for frame in 01 02 07 12; do
        exits 0 render -q "${small[@]}" $scene.yaml --frames $((10#$frame)) -o alone.png
        ok "$scene: frame $frame is as by itself" cmp alone.png all/$scene-00$frame.png
    done
    exits 0 render -q "${small[@]}" $scene.yaml -o first.png; no_err
    ok "$scene: without --frames the first" cmp first.png all/$scene-0001.png
done
exits 0 render -q "${small[@]}" view.yaml --frames 3; is_png view-0003.png
for row in '2-4:2 3 4' '11-:11 12' '12:12' '2-9/3:2 5 8' '4-:4 5 6 7 8 9 10 11 12' 'all/5:1 6 11' '7-7:7'; do
    rm -rf range
    frames=${row%:*}
    exits 0 render -q "${small[@]}" view.yaml --frames "${frames/\//:}" -o range/
    ok "frames ${row%:*}" [ "$(ls range | sed 's/view-0*//; s/.png//' | tr '\n' ' ')" = "${row#*:} " ]
done
for bad in 0 0-3 3-2 -3 x 1-x 1:0 1: all: 1-2-3 '' 1000001 allx; do
    exits 2 render view.yaml --frames "$bad"; err_has "--frames: expected N, A-B, A- or all, perhaps with :STEP, from 1, found \`$bad\`"
done
for row in '2-13 2-' '3-13:2 3-:2'; do
    exits 2 render view.yaml --frames "${row% *}"; err_has "has 12 frames; ${row#* } goes to the last"
done
for bad in 13 13-14; do exits 2 render view.yaml --frames $bad; err_lacks 'goes to'; done
for bad in 13 12-13 13- 13-14; do exits 2 render view.yaml --frames $bad; err_has "error[no-frame]: --frames $bad: view.yaml has 12 frames"; done
for asked in 1 1-3 2-; do
    exits 2 render one.yaml --frames $asked; err_has "--frames $asked: one.yaml"; err_has 'one.yaml has no animation; `animation: {frames: 48}` makes one'
done
# a still among animations is one picture
exits 0 render -q "${small[@]}" one.yaml -o plain.png
for asked in all 1- all:5; do
    exits 0 render "${small[@]}" one.yaml view.yaml --frames $asked -o mixed/ --log mixed.log
    ok "$asked: a still under its plain name" cmp mixed/one.png plain.png; is_png mixed/view-0001.png
    missing mixed/one-0001.png; ok "and the animation" [ "$(ls mixed/view-* | wc -l)" -eq "$([ $asked = all:5 ] && echo 3 || echo 12)" ]
    ok "without a frame in the log" [ "$(grep -c '"frame"' mixed.log)" -eq "$(ls mixed/view-* | wc -l)" ]
    rm -r mixed mixed.log
done
exits 0 render -q "${small[@]}" one.yaml --frames all -o 'still-{name}-{frame}-%03d.png'; ok "in a pattern it is frame 1" cmp still-one-1-001.png plain.png
exits 2 render one.yaml --frames all -o plain.png; err_has 'is one file for many frames'
rm -f one.png; exits 0 render -q "${small[@]}" one.yaml
exits 0 render "${small[@]}" one.yaml --frames all --skip-unchanged; err_has 'unchanged one.png'
missing one-0001.png
exits 2 render one.yaml view.yaml --frames 1 "${small[@]}" -o both/; is_png both/view-0001.png; err_has '1 rendered, 1 failed'

exits 0 render -q "${small[@]}" view.yaml --frames 9-10 -o 'p/{name}/f{frame}.png'; is_png p/view/f09.png; is_png p/view/f10.png
exits 0 render -q "${small[@]}" view.yaml --frames 9-10 -o 'p/%d/{frame}.png'; is_png p/9/09.png; is_png p/10/10.png
exits 0 render -q "${small[@]}" view.yaml --frames 9 -o 'p/%03d%%.png'; is_png p/009%.png
exits 0 render -q "${small[@]}" view.yaml --frames 9 -o 'just.png'; is_png just.png
exits 0 render -q "${small[@]}" view.yaml -o 'p/../50%d.png'; is_png 50%d.png
exits 0 render -q "${small[@]}" view.yaml -D a=1,2 --frames 1-2; is_png view-a=1-0001.png; is_png view-a=2-0002.png
for bad in '%' '%s' '%4d' '%00d' '%d%' '%-4d'; do exits 2 render view.yaml --frames 1-2 -o "$bad.png"; err_has 'with --frames, expected %d, %04d'; done
exits 2 render view.yaml --frames 1-2 -o '%d-%04d.png'; err_has 'one %d is enough'
exits 2 render view.yaml -o '{frame}.png'; err_has '-o: {frame} is for --frames'
exits 2 render view.yaml --frames 1-2 -o x.png; err_has "-o x.png is one file for many frames: end it in / for a folder, or write -o 'x-{frame}.png'"
exits 2 render view.yaml --frames all -D a=1,2 -o x.png; err_has "'x-{a}-{frame}.png'"
exits 2 render view.yaml move.yaml --frames all -o 'x{frame}.png'; err_has 'would both write'
exits 2 render view.yaml --frames all -o -; err_has 'only one picture'; no_out
exits 0 render -q "${small[@]}" view.yaml --frames 2 -o -; ok "one frame to stdout" cmp out all/view-0002.png
cp view.yaml 07.yaml
ln -s 07.yaml 07.png; exits 2 render 07.yaml --frames 6-8 -o '{frame}.png'; err_has '07.yaml would be written over'
ok "the scene is whole" cmp view.yaml 07.yaml

# an include serves all frames; a scene is read once, as only a pipe can tell
printf 'params: {r: 0.5}\nscene: []\n' >defs.yaml
sed 's/^animation/include: defs.yaml\nanimation/; s/0.5 + t/r + t/' move.yaml >included.yaml
mkfifo scene.pipe
exits 0 render -q "${small[@]}" included.yaml --frames 1-3 -o once/
for frame in 1 2 3; do ok "and used for frame $frame" same_pixels once/included-000$frame.png all/move-000$frame.png; done
for scene in view move; do
    last="render $scene.yaml by a pipe"
    cat $scene.yaml >scene.pipe & feeder=$!
    timeout 20 "$monge" render -q "${small[@]}" scene.pipe --frames 1-3 -o once/ >out 2>err; status=$?
    ok "$scene is read once" [ $status -eq 0 ]; kill $feeder 2>/dev/null
    ok "$scene: its third frame" cmp once/scene.pipe-0003.png all/$scene-0003.png
    "$monge" render -q "${small[@]}" - --frames 1-3 -o once/ <$scene.yaml 2>err; ok "$scene from stdin" cmp once/stdin-0003.png all/$scene-0003.png
    "$monge" render -q "${small[@]}" - -D a=1,2 --frames 1-3 -o 'twice/{a}-{frame}.png' <view.yaml 2>err; ok "with a sweep" same_pixels twice/1-03.png all/view-0003.png
done

for scene in view move paint; do run render -q "${small[@]}" $scene.yaml --frames all -o all/ --stats $scene.json; done
if have python3; then
    ok "the hierarchy is kept where it serves" python3 - <<'PYTHON'
import json
for scene, kept in ("view", True), ("paint", True), ("move", False):
    pictures = json.load(open(scene + ".json"))["pictures"]
    assert [p["frame"] for p in pictures] == list(range(1, 13))
    assert pictures[2]["output"] == f"all/{scene}-0003.png"
    builds = [p["seconds"]["build"] for p in pictures[1:]]
    assert not kept or sum(builds) < 0.001, builds
PYTHON
fi

# a frame that is wrong, and what each frame would say again
sed 's/0.5 + t/3 - frame/' move.yaml >wrong.yaml
exits 1 render "${small[@]}" wrong.yaml --frames 1-4 -o wrong/; is_png wrong/wrong-0002.png; missing wrong/wrong-0003.png
err_has 'frame 3 of wrong.yaml is left out'; err_has '`3 - frame`, which is 0'; err_has '2 rendered, 2 failed'
sed 's/eye: .*t)\]/fov: 60 - 20*frame/' view.yaml >wrong.yaml
exits 1 render "${small[@]}" wrong.yaml --frames 1-4 -o wrong/; err_has '2 rendered, 2 failed'
sed 's/^scene/materials: {unused: {}}\nscene/; s/radius: 1/radius: 0.5 + t/' view.yaml >warned.yaml
exits 0 render "${small[@]}" warned.yaml --frames all -o w/; ok "a warning is told once" [ "$(grep -c warning err)" -eq 1 ]
exits 0 render "${small[@]}" warned.yaml --frames all -o w/ --format json; ok "in JSON as well" [ "$(grep -c '"warning"' err)" -eq 1 ]

patient 'view  frame 5 of 12  [' view.yaml --frames 5 --size 640x480 --progress always -o p.png
if have perl; then
    signalled INT '[ -e cut/view-0001.png ]' render --size 300x200 --samples 64 --threads 1 view.yaml --frames all -o cut/ --stats cut.json
    ok "SIGINT between frames ends monge" [ "$status" -eq 2 ]; missing cut/view-0012.png; no_leftovers
    ok "statistics are of what is there" [ "$(grep -o 'cut/view-[0-9]*.png' cut.json)" = "$(ls cut/*.png 2>/dev/null)" ]
    ok "and so is what is told" grep -q "^interrupted: $(ls cut | wc -l) of 12 rendered" err
    ok "what is there is whole" [ -z "$(for f in cut/*.png; do [ ! -e "$f" ] || tail -c 8 "$f" | grep -q IEND || echo "$f"; done)" ]
fi
cd ..

# ---- Limits ----

# Two at one place, in each of 28 levels.
cat >nest.yaml <<'END'
define:
  nest:
    params: {levels: 0, balls: 16}
    objects:
      - {when: levels == 0, for: {i: balls}, sphere: {center: [i % 16, 0, 0]}}
      - {when: levels > 0, for: {i: 2}, use: nest, with: {levels: levels - 1, balls: balls}}
params: {levels: 28, balls: 16}
scene:
  - sphere: {center: [0, 5, 0]}
  - use: nest
    with: {levels: levels, balls: balls}
END
exits 1 render nest.yaml "${small[@]}" -o nest.png; err_has 'nest.yaml:10:5: error[limit-instances]'; no_out; missing nest.png
err_has 'instances at one place multiply with each level: move them apart, or place one alone'
ok "it says no more than that" [ "$(grep -c -e error -e memory err)" -eq 1 ]
exits 1 render nest.yaml -D levels=28,3 "${small[@]}" -o 'nest-{levels}.png'; err_has '1 rendered, 1 failed'
missing nest-28.png; is_png nest-3.png; no_leftovers
exits 1 render nest.yaml "${small[@]}" --format json -o nest.png; err_has '"code": "limit-instances"'; missing nest.png
exits 0 check nest.yaml

exits 0 check one.yaml --limit file_bytes=1k --limit memory_bytes=1G --limit steps=2M --limit=objects=1 --untrusted
exits 2 check one.yaml --limit file_bytes=10; err_has 'limit-file-bytes'
exits 1 check one.yaml --limit nesting=1; err_has 'limit-nesting'
exits 1 render wrong.yaml --limit objects=1 --limit values=3; err_has 'limit-values'
exits 2 check one.yaml --limit memory_bytes=1; err_has 'limit-memory'
{ echo 'scene:'; for i in 1 2 3 4 5 6; do echo "  - sphere: {center: [$((3 * i)), 0, 0]}"; done; } >six.yaml
exits 1 check six.yaml --limit objects=5; err_has 'limit-objects'; exits 0 check six.yaml --limit objects=6
printf 'scene:\n  - sphere: {center: [3 * i, 0, 0]}\n    for: {i: {from: 1, to: 50}}\n' >loop.yaml
exits 1 check loop.yaml --limit steps=20; err_has 'limit-steps'; exits 0 check loop.yaml --limit steps=1k
exits 1 check one.yaml --limit pixels=1000; err_has 'error[limit-pixels]: one.yaml: a picture of 640x480 has more than 1000 pixels (the limit `pixels`)'; out_has '1 error'
exits 1 render one.yaml --limit pixels=1k -o x.png; err_has 'the limit `pixels`'
exits 2 render one.yaml --limit pixels=1k --size 100x100 -o x.png; err_has 'a picture of 100x100'
exits 0 render -q one.yaml --limit pixels=192 "${small[@]}" -o x.png
exits 2 check one.yaml --limit objcts=5; err_has '--limit: no limit `objcts`; did you mean `objects`?'
exits 2 check one.yaml --limit xyzzy=5; err_has 'there are file_bytes, memory_bytes, values, nesting, recursion, steps, objects, pixels'
exits 2 check one.yaml --limit steps; err_has '--limit: expected NAME=VALUE'
for bad in 0 x '' -1 5K 5kk 1.5 k 99999999999999999999 99999999999999999G; do
    exits 2 check one.yaml --limit "steps=$bad"; err_has "--limit steps=$bad: expected a whole number from 1, as"
done
exits 2 check one.yaml --limit nesting=1001; err_has 'from 1 to 1000'
exits 2 check one.yaml --limit pixels=1G; err_has 'from 1 to 268435456'
for command in render check; do
    exits 0 help $command; for limit in 'file_bytes (of one file: 1G)' 'memory_bytes (of a load:' 'pixels (of the'; do
        ok "help $command tells $limit" sh -c 'tr "\n" " " <out | grep -qF "$1"' sh "$limit"
    done
done
mkdir inside && printf 'include: ../params.yaml\nscene:\n  - sphere: {radius: a}\n' >inside/out.yaml
exits 0 check inside/out.yaml
exits 1 check --untrusted inside/out.yaml; err_has 'include-outside'
exits 1 render --untrusted inside/out.yaml; err_has 'include-outside'

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
exits 0 import book.yml -o book.yaml; ok "-o gives the same" cmp imported.yaml book.yaml; no_out; no_leftovers
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
sed -n 's/^wrong.yaml:.*error\[\(.*\)\].*/\1/p' err | head -n 1 >s.code
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
assert (bad["scene"], bad["output"], bad["status"]) == ("wrong.yaml", "deep/wrong.png", "failed") and "started" not in good
error = bad["error"]
assert list(error) == ["code", "message", "file", "line", "column"]
assert (error["file"], error["code"]) == ("wrong.yaml", open("s.code").read().strip())
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
no_leftovers

# ---- Progress ----

patient 'left' one.yaml --size 640x480 --progress always -o p.png
ok "a bar, which the last line replaces" grep -qE $'^\rone  \\[.*left.*\r +\rwrote p.png' err
ok "one line in the end" [ "$(wc -l <err)" -eq 1 ]
rm -f p.png
if have perl; then
    signalled INT 'grep -q left err && sleep 1' render "${lively[@]}" one.yaml --progress always -o p.png
    ok "always: a bar" grep -qE 'one  \[[#-]+\] +[0-9]+%  [0-9:]+ left' err
    ok "at most ten a second" [ "$(tr '\r' '\n' <err | grep -c left)" -le "$(awk -v took=$took 'BEGIN { print int(10 * took) }')" ]
    ok "one line, no escapes" [ "$(tr -d '\r' <err | wc -l)" -eq 1 -a "$(grep -c $'\033' err)" -eq 0 ]
    ok "the bar is gone in the end" grep -qE $'\r +\rinterrupted: 0 of 1 rendered$' err
    signalled INT 'sleep 0.5' render "${lively[@]}" one.yaml -o p.png
    ok "auto: no bar in a pipe" [ "$(cat err)" = 'interrupted: 0 of 1 rendered' ]
fi
if have script && have perl; then
    on_terminal() { script -qec "stty cols ${columns:-60}; export TERM=${term:-xterm}; $*" /dev/null </dev/null >terminal 2>&1; status=$?; last="on a terminal: $*"; }
    bar() { on_terminal "perl '$project/tests/lib/signalled.pl' TERM '$1' '$monge' render ${lively[*]} one.yaml -o p.png 3>waited"; }
    bar 'grep -q left terminal'
    ok "auto: a bar on a terminal" grep -q 'left' terminal
    ok "no wider than the terminal" [ -z "$(tr '\r' '\n' <terminal | grep -E '.{60}')" ]
    term=dumb bar 'sleep 0.5'; ok "auto: none on a dumb one" [ "$(tr -d '\r' <terminal)" = 'interrupted: 0 of 1 rendered' ]
    columns=20 bar 'grep -q % terminal'; ok "a bar on a narrow terminal" grep -q % terminal
    ok "no wider than a narrow terminal" [ -z "$(tr '\r' '\n' <terminal | grep -v ^interrupted | grep -E '.{20}')" ]
    on_terminal "$monge render -q ${small[*]} one.yaml -o -"
    ok "no PNG to a terminal" grep -q 'not for a terminal' terminal
    ok "that is exit 2" [ $status -eq 2 ]
fi

# ---- Signals ----

exits 0 help; out_has 'shell shows as 130, 143 and 129'; exits 0 help --man; out_has 'which a shell shows as 130, 143 and 129'

if have perl; then
    rm -f p.png
    for row in 'INT 2' 'TERM 15' 'HUP 1'; do
        signalled ${row% *} 'sleep 0.2' render "${long[@]}" one.yaml -o p.png --stats p.json
        ok "SIG${row% *} ends monge by the same signal" [ "$status" -eq "${row#* }" ]
        ok "SIG${row% *} is told" [ "$(cat err)" = 'interrupted: 0 of 1 rendered' ]
        ok "statistics of nothing" grep -q '"pictures"' p.json; rm -f p.json
        missing p.png; no_leftovers; no_out
    done
    # 2^18 times a geometry at one place, and 60,000 rays in the only pixel: it takes hours
    signalled TERM 'sleep 0.8' render nest.yaml -D levels=18 -D balls=100000 --size 1x1 --samples 60000 -o p.png
    ok "SIGTERM while a ray is on its way" [ "$status" -eq 15 ]; missing p.png; no_leftovers
    mkfifo pipe
    exec 4<>pipe; EARLY=1 signalled TERM 'sleep 0.5' render - -o p.png <&4; exec 4<&- # there is no handler before there is work
    ok "SIGTERM while a scene is read" [ "$status" -eq 15 ]
    signalled INT 'sleep 0.2' render "${small[@]}" one.yaml -o pipe
    ok "SIGINT while a pipe has no reader" [ "$status" -eq 2 ]; ok "nothing but that is told" [ "$(cat err)" = 'interrupted: 0 of 1 rendered' ]
    signalled INT 'sleep 0.2' render -q "${long[@]}" one.yaml -o p.png; ok "SIGINT, quiet" [ "$status" -eq 2 ]; no_err
    IGNORED=1 THEN='sleep 0.2; cat pipe > frompipe.png' signalled INT 'sleep 0.2' render "${small[@]}" -q one.yaml -o pipe
    ok "an ignored SIGINT stays ignored" [ "$status" -eq 0 ]
    ok "a pipe takes a picture" cmp frompipe.png expected.png
fi

last='render -o - into a pipe that closes'
"$monge" render --size 900x900 --bits 16 -q one.yaml -o - | head -c 10 >/dev/null
status=${PIPESTATUS[0]}
ok "a closed pipe ends monge by SIGPIPE" [ "$status" -eq 141 ]
no_leftovers

told
