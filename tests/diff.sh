#!/usr/bin/env bash
# Tests of monge diff on the command line: tests/diff.sh [PROGRAM], build/monge by default. Works in a folder of its own.
# What the numbers must be is tested by tests/unit/test_compare.c and test_flip.c.

. "$(dirname "$0")/lib/testing.sh"

# ---- Pictures: an empty one in a grey, and one with a dot of four pixels in it ----

cat >empty.yaml <<'END'
image: {size: [40, 30], background: shade, samples: 1}
params: {shade: "#808080", at: -100}
camera: {eye: [0, 0, 10], look_at: [0, 0, 0], fov: 60}
scene:
  - box: {min: [-0.3, -0.3, at - 0.3], max: [0.3, 0.3, at + 0.3]}
    material: {diffuse: "#b3b3b3"}
END
render() { "$monge" render -q --shading signature empty.yaml "$@" 2>/dev/null || { echo "FAILED: cannot render $*"; failed=1; }; }
render -o grey.png -D at=200
render -o again.png -D at=300
render -o lighter.png -D at=200 -D 'shade=#838383'
render -o dot.png -D at=0
render -o small.png -D at=200 --size 20x30
render -o deep.png -D at=200 --bits 16
render -o linear.png -D at=200 --encoding linear
cp grey.png copy.png

# ---- The verdict ----

exits 0 diff grey.png copy.png; out_is 'same: all of 1200 pixels are equal'; no_err
exits 0 diff grey.png again.png; out_is 'same: all of 1200 pixels are equal'
ok "that was not the same file" sh -c '! cmp -s grey.png again.png'
exits 1 diff grey.png lighter.png; no_err
out_is 'different: 1200 of 1200 pixels (100 %), largest difference 0.01176 at 0,0'
exits 1 diff grey.png dot.png
out_has 'different: 4 of 1200 pixels (0.333 %), largest difference 0.2 at 19,14'
exits 1 diff grey.png small.png; out_is 'different: their sizes are 40 x 30 and 20 x 30 pixels'
exits 1 diff grey.png linear.png; out_is 'different: their colour spaces are sRGB and gamma 1'
exits 1 diff grey.png deep.png; out_has 'different: they have 8 and 16 bits a channel; '
exits 1 diff -q grey.png dot.png; no_out; no_err
exits 0 diff --quiet grey.png again.png; no_out; no_err

# ---- Tolerances ----

exits 0 diff grey.png lighter.png --max-delta 0.0118; out_has 'within the limits: 1200 of 1200 pixels'
exits 1 diff grey.png lighter.png --max-delta 0.0117
out_is 'different: 1200 of 1200 pixels (100 %), largest difference 0.01176 at 0,0; 1200 beyond --max-delta'
exits 1 diff grey.png lighter.png --max-pixels 3; out_lacks 'beyond'
exits 0 diff grey.png dot.png --max-pixels 4; out_has 'within the limits: 4 of 1200'
exits 1 diff grey.png dot.png --max-pixels 3
exits 0 diff grey.png dot.png --max-pixels 0.34%
exits 1 diff grey.png dot.png --max-pixels 0.33%
exits 0 diff grey.png dot.png --max-delta 0.2
exits 1 diff grey.png dot.png --max-delta 0.19; out_has '4 of 1200'
exits 0 diff lighter.png dot.png --max-delta 0.02 --max-pixels 4; out_has '; 4 beyond --max-delta'
exits 1 diff lighter.png dot.png --max-delta 0.02 --max-pixels 3
exits 1 diff lighter.png dot.png --max-delta 0.01 --max-pixels 4
exits 1 diff grey.png small.png --max-delta 1 --max-pixels 100%
exits 1 diff grey.png linear.png --max-delta 1 --max-pixels 100%
exits 0 diff grey.png deep.png --max-delta 0.002
# of the verdict first: of bits where they decide, else of pixels
exits 1 diff lighter.png deep.png; out_is 'different: they have 8 and 16 bits a channel; 1200 of 1200 pixels (100 %), largest difference 0.01176 at 0,0'
exits 1 diff lighter.png deep.png --max-delta 0.01; out_is 'different: 1200 of 1200 pixels (100 %), largest difference 0.01176 at 0,0; 1200 beyond --max-delta; they have 8 and 16 bits a channel'
exits 0 diff lighter.png deep.png --max-pixels 1200; out_is 'within the limits: 1200 of 1200 pixels (100 %), largest difference 0.01176 at 0,0; they have 8 and 16 bits a channel'

# ---- What is not quite all is not told as all ----

if command -v python3 >/dev/null; then # all but a pixel, all, and numbers of 16 bits that are nearly 0 and 1
    cat >pictures.py <<'END'
import struct, zlib

def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

def write(name, width, height, bits, rows, *chunks):
    open(name, "wb").write(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, bits, 0, 0, 0, 0))
        + b"".join(chunk(*c) for c in chunks)
        + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + r for r in rows))) + chunk(b"IEND", b""))
END
    python3 -c '
from pictures import *
write("zeros.png", 160, 120, 8, [bytes(160)] * 120)
write("nearly.png", 160, 120, 8, [b"\0" + b"\xff" * 159] + [b"\xff" * 160] * 119)
write("ones.png", 160, 120, 8, [b"\xff" * 160] * 120)
write("least.png", 1, 1, 16, [b"\0\0"])
write("most.png", 1, 1, 16, [b"\xff\xfe"])'
    exits 1 diff zeros.png nearly.png --metric exact; out_has '19199 of 19200 pixels (99.99 %)'; out_has 'exact  0.999948'
    exits 1 diff zeros.png ones.png --metric exact; out_has '(100 %), largest difference 1 at 0,0'; ok "all" grep -qx 'exact  1' out
    exits 1 diff least.png most.png --metric max; out_has 'largest difference 0.99998 at'; out_has 'max    0.999985'
fi

# ---- What other programs write of colour spaces ----

if command -v python3 >/dev/null; then
    python3 -c '
from pictures import *
def gama(g): return b"gAMA", struct.pack(">I", g)
def chrm(*v): return b"cHRM", struct.pack(">8I", *v)
def profile(name, intent): # the least that libpng takes for one, filled up with what cannot be packed
    noise = bytes(x * x * x % 251 for x in range(200))
    p = bytearray(128)
    p[0:4], p[8] = struct.pack(">I", 144 + 12 + len(noise)), 2
    p[12:24], p[36:40], p[64:80] = b"mntrGRAYXYZ ", b"acsp", struct.pack(">IIII", intent, 0xf6d6, 0x10000, 0xd32d)
    tag = struct.pack(">I4sII", 1, b"cprt", 144, 12) + b"text\0\0\0\0abc\0"
    return b"iCCP", name + b"\0\0" + zlib.compress(bytes(p) + tag + noise)
srgb, cicp = (b"sRGB", b"\0"), (b"cICP", bytes([9, 16, 0, 1]))
usual = chrm(31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000)
adobe = chrm(31270, 32900, 64000, 33000, 21000, 71000, 15000, 6000)
for name, *chunks in (("unsaid",), ("srgb", srgb), ("gama", gama(45455)), ("gama-chrm", gama(45455), usual), ("chrm", adobe),
                      ("srgb-gama", srgb, gama(100000)), ("cicp", cicp), ("adobe", gama(45455), adobe), ("gama-2", gama(50000)),
                      ("icc", profile(b"ICC Profile", 0)), ("p3", profile(b"P3", 0)), ("p3-too", profile(b"P3", 0)),
                      ("p3-other", profile(b"P3", 1)), ("srgb-icc", profile(b"P3", 0), srgb)):
    write(name + ".png", 3, 2, 8, [b"\1\2\3", b"\4\5\6"], *chunks)
write("wide.png", 1000001, 1, 8, [bytes(1000001)])
write("wider.png", 1000001, 1, 8, [b"\1" * 1000001])
write("huge.png", 60000, 60000, 8, [b"\0" * 100])'
    for name in srgb gama gama-chrm chrm srgb-gama cicp; do exits 0 diff unsaid.png $name.png; out_is 'same: all of 6 pixels are equal'; done
    exits 1 diff unsaid.png adobe.png; out_is 'different: their colour spaces are sRGB and gamma 0.45455'
    exits 1 diff adobe.png gama-2.png; out_is 'different: their colour spaces are gamma 0.45455 and gamma 0.5'
    exits 1 diff unsaid.png icc.png; out_is 'different: their colour spaces are sRGB and ICC Profile'
    exits 1 diff srgb.png srgb-icc.png; out_is 'different: their colour spaces are sRGB and ICC profile P3'
    exits 0 diff icc.png p3.png; exits 0 diff p3.png p3-too.png; exits 0 diff p3.png srgb-icc.png
    exits 1 diff p3.png p3-other.png; out_is 'different: their colour spaces are not the same, though both are called ICC profile P3'
    exits 1 diff wide.png wider.png --out heat.png; out_has '1000001 of 1000001 pixels'; is_png heat.png
    exits 2 diff wide.png huge.png; err_has 'cannot use huge.png: it is too large: 60000 x 60000 pixels, of at most 268435456 together'
fi

# ---- Metrics ----

exits 1 diff grey.png dot.png --metric mae,rmse --metric psnr,ssim,flip
for metric in mae rmse psnr ssim flip; do out_has "$metric "; done
ok "in the order of the table" [ "$(sed 1d out | cut -d' ' -f1 | tr '\n' ' ')" = 'mae rmse psnr ssim flip ' ]
exits 1 diff grey.png dot.png --metric exact; out_has 'exact  0.00333333'
exits 0 diff grey.png dot.png --metric mae --max-delta 0.00067
exits 1 diff grey.png dot.png --metric mae --max-delta 0.00066
exits 0 diff grey.png dot.png --metric rmse,psnr --max-delta 0.0116
exits 1 diff grey.png dot.png --metric psnr --max-delta 0.0115
exits 1 diff grey.png dot.png --metric mae,rmse,flip --max-delta 0.001
ok "which of them is beyond" [ "$(grep -c beyond out)" -eq 2 ]; out_has 'mae    0.000666667'; out_lacks 'mae    0.000666667 '
ok "the rmse is" grep -qx 'rmse   0.0[0-9]*  beyond --max-delta' out; ok "flip is" grep -qx 'flip   0.[0-9]*  beyond --max-delta' out
exits 1 diff grey.png dot.png --metric mae --max-delta 0.1 --max-pixels 3; out_has '; more than --max-pixels'; out_lacks 'beyond'
exits 0 diff grey.png dot.png --metric mae --max-delta 0.1 --max-pixels 4; out_lacks 'more than'
exits 1 diff grey.png dot.png --metric max,flip --max-delta 0.1; out_has '; 4 beyond --max-delta'
ok "the largest difference" grep -qx 'max    0.2  beyond --max-delta' out; ok "flip has no limit" grep -qx 'flip   0[0-9.]*' out
exits 0 diff grey.png dot.png --metric max,flip --max-delta 0.2; out_has '; 0 beyond --max-delta'; ok "max is not" grep -qx 'max    0.2' out
exits 1 diff grey.png dot.png --metric mae --max-delta 0.1 --max-pixels 3
exits 0 diff grey.png dot.png --metric mae --max-delta 0.1 --max-pixels 4
exits 1 diff grey.png dot.png --metric flip --max-delta 0.001
exits 0 diff grey.png dot.png --metric flip --max-delta 0.1
exits 0 diff grey.png dot.png --metric ssim --max-delta 0.5
exits 1 diff grey.png dot.png --metric ssim --max-delta 0.001
exits 1 diff grey.png dot.png --metric max,flip --max-delta 0.1
flip() { exits 1 diff grey.png dot.png --metric flip --json "$@"; flip=$(sed -n 's/.*"flip": //p' out); }
flip; first=$flip
for threads in 1 2 5; do flip --threads $threads; ok "$threads threads" [ "$flip" = "$first" ]; done
flip --ppd 67; ok "67 is the default of --ppd" [ "$flip" = "$first" ]
flip --ppd 20; ok "--ppd matters" [ "$flip" != "$first" ]

# ---- What is ignored ----

exits 0 diff grey.png dot.png --ignore 19,14,2,2; out_is 'same: all of 1196 pixels are equal; 4 ignored'
exits 1 diff grey.png dot.png --ignore 19,14,2,1; out_has '2 of 1198 pixels'
exits 0 diff grey.png dot.png --ignore 0,0,20,30 --ignore=20,0,1000,29; out_is 'same: all of 20 pixels are equal; 1180 ignored'
render -o white.png -D at=0 -D 'shade=#000000'
exits 0 diff grey.png dot.png --ignore white.png; out_has 'all of 1196 pixels'
exits 0 diff grey.png dot.png --mask white.png; out_has 'all of 1196 pixels'
exits 0 diff grey.png dot.png --mask white.png --ignore 0,0,1,1; out_has 'all of 1195 pixels'
exits 2 diff grey.png dot.png --mask small.png; err_has 'small.png: it is 20 x 30 pixels'; no_out
for masks in '--mask white.png --ignore white.png' '--mask white.png --mask white.png' '--ignore white.png --ignore white.png'; do
    exits 2 diff grey.png dot.png $masks; err_has 'there can be only one mask'; no_out
done
cp white.png 0,0,1,1; exits 0 diff grey.png dot.png --mask 0,0,1,1; out_has 'all of 1196 pixels' # a file, whatever it is called

# of nothing, nothing can be said
nothing='error[nothing-compared]: nothing is left to compare in grey.png: all pixels are ignored'
for other in dot.png again.png copy.png; do
    exits 2 diff grey.png $other --ignore 0,0,20,30 --ignore=20,0,1000,1000; err_has "$nothing"; err_lacks 'a mask'; no_out
done
render -o bright.png -D at=200
exits 2 diff grey.png dot.png --mask bright.png; err_has "$nothing; a mask leaves out what is not black in it"; no_out
exits 2 diff grey.png dot.png --ignore 0,0,40,30 --out none.png --json; err_has "$nothing"; out_has '"why": "trouble"'; missing none.png
exits 2 diff grey.png dot.png --ignore 0,0,40,30 --max-pixels 0 --max-delta 1; err_has "$nothing"
exits 1 diff grey.png small.png --ignore 0,0,40,30; out_has 'different: their sizes'
outside='error[outside-region]: --ignore 40,0,1,1 lies outside of grey.png, which is 40x30'
exits 2 diff grey.png dot.png --ignore 40,0,1,1; err_has "$outside"; no_out
exits 2 diff grey.png grey.png --ignore 0,0,1,1 --ignore 40,0,1,1; err_has "$outside"
exits 2 diff grey.png dot.png --ignore 0,30,1,1; err_has '--ignore 0,30,1,1 lies outside of grey.png'
exits 0 diff grey.png dot.png --ignore 19,14,2,2 --ignore 39,29,9,9; out_has 'all of 1195 pixels'

exits 2 diff grey.png dot.png --ignore 1,2,3; err_has '--ignore: expected X,Y,W,H'
exits 2 diff grey.png dot.png --ignore absent.png; err_has 'cannot read absent.png: '

# ---- JSON ----

all=exact,max,mae,rmse,psnr,ssim,flip
exits 1 diff grey.png dot.png --json --metric $all
exits 1 diff grey.png dot.png --json; out_has '"exact": 0.003333333'; out_has '"max": 0.2'
out_has '"same": false'; out_has '"why": "pixels"'; out_has '"bounds": {"x": 19, "y": 14, "width": 2, "height": 2}'
ok "no metric that is not asked for" sh -c '! grep -q flip out'
exits 0 diff grey.png again.png --json --metric psnr; out_has '"psnr": null'; out_has '"why": null'; out_has '"bounds": null'
exits 1 diff grey.png small.png --json --metric $all; out_has '"why": "size"'; out_has '"flip": null'; out_has '"ignored": 0'
exits 1 diff grey.png dot.png --json --ignore 19,14,1,1 --ignore 0,0,9,2; out_has '"pixels": 1181'; out_has '"ignored": 19'; out_has '"different": 3'
exits 0 diff grey.png grey.png --json; out_has '"pixels": 1200'; out_has '"ignored": 0'
# bits are a reason where they decide, or nothing else differs
exits 1 diff grey.png deep.png --json; out_has '"why": "bits"'
exits 0 diff grey.png deep.png --json --max-delta 0; out_has '"why": "bits"'
exits 1 diff deep.png lighter.png --json; out_has '"why": "bits"'
for limits in '1 --max-delta 0.01' '0 --max-delta 0.02' '1 --max-pixels 3' '0 --max-pixels 100%' '1 --max-delta 0.01 --metric mae'; do
    # shellcheck disable=SC2086
    exits "${limits%% *}" diff deep.png lighter.png --json ${limits#* }; out_has '"why": "pixels"'
done
exits 0 diff grey.png dot.png --json --max-pixels 4; out_has '"same": true'; out_has '"why": "pixels"'; out_has '"beyond": 4'
if command -v python3 >/dev/null; then
    for pair in dot.png again.png copy.png small.png linear.png deep.png; do
        "$monge" diff grey.png $pair --json --metric $all >out
        ok "JSON of $pair" python3 -c '
import json, sys
d = json.load(open("out"))
assert {"same", "why", "a", "b", "pixels", "ignored", "different", "beyond", "bounds", "largest"} | set(sys.argv[1].split(",")) == set(d)
assert all(d[m] is None or 0 <= d[m] <= 1 for m in ("exact", "max", "mae", "rmse", "flip"))' $all
    done
fi

# ---- Heat maps ----

exits 1 diff grey.png dot.png --out heat.png; is_png heat.png; out_has '4 of 1200'
exits 0 diff grey.png again.png --out even.png; is_png even.png
exits 1 diff heat.png even.png --json; out_has '"different": 4'
exits 1 diff grey.png dot.png --metric flip --out flip.png; is_png flip.png
exits 1 diff heat.png flip.png --quiet
exits 1 diff grey.png dot.png --ignore 19,14,1,2 --out heat.png
exits 1 diff heat.png even.png --json; out_has '"different": 2'
exits 1 diff grey.png dot.png --out -; is_png out
exits 1 diff grey.png small.png --out none.png; err_has 'no heat map'; ok "none.png is not there" [ ! -e none.png ]
for name in map.jpg map; do
    exits 2 diff grey.png dot.png --out $name; err_has "--out $name: pictures are PNG; did you mean map.png?"; missing $name; no_out
done
exits 2 diff grey.png dot.png --out folder/heat.png; err_has 'cannot write folder/heat.png'
exits 2 diff grey.png dot.png --out - --json; err_has '--out -: standard output takes the JSON object'
cp dot.png kept.png
exits 2 diff grey.png kept.png --out ./kept.png; err_has 'would write over a picture'
ok "kept.png is as it was" cmp -s kept.png dot.png
cp white.png kept-mask.png
for option in --mask --ignore; do
    exits 2 diff grey.png dot.png $option kept-mask.png --out ./kept-mask.png
    err_has '--out ./kept-mask.png would write over the mask'; no_out; same kept-mask.png white.png
done
exits 2 diff grey.png dot.png --out /dev/full; err_has 'cannot write /dev/full: No space left on device'
ok "no temporary files" [ -z "$(find . -name '*.tmp' -o -name '.*.tmp')" ]

# ---- Folders ----

head -c 100 grey.png >cut.png
mkdir -p a/sub/deeper b/sub/deeper
for folder in a b; do cp grey.png $folder/grey.png; cp dot.png $folder/.hidden.png; cp empty.yaml $folder/; done
cp again.png b/grey.png
cp grey.png a/sub/dot.png; cp dot.png b/sub/dot.png
cp grey.png a/sub/deeper/size.PNG; cp small.png b/sub/deeper/size.PNG
cp grey.png a/light.png; cp lighter.png b/light.png
cp grey.png a/gone.png; cp grey.png b/sub/new.png
line="largest difference 0.01176 at 0,0"
cat >expected <<END
only in a/: gone.png
different  light.png: 1200 of 1200 pixels (100 %), $line
different  sub/deeper/size.PNG: their sizes are 40 x 30 and 20 x 30 pixels
different  sub/dot.png: 4 of 1200 pixels (0.333 %), largest difference 0.2 at 19,14
only in b: sub/new.png
6 pictures: 1 same, 3 different, 1 only in a/, 1 only in b
END
exits 1 diff a/ b; ok "the folders" cmp out expected; no_err
for threads in 1 3; do exits 1 diff a/ b --threads $threads; ok "$threads threads" cmp out expected; done
exits 1 diff -q a b; no_out; no_err
exits 0 diff a a/; out_is '5 pictures: 5 same'
exits 1 diff a b --max-delta 0.012; out_has '6 pictures: 1 same, 1 within the limits, 2 different, 1 only in a, 1 only in b'
ok "what is within the limits has no line" sh -c '! grep -q light.png out'
exits 1 diff a b --metric flip,mae; out_has '           mae    0.000666667'; out_has '           flip   0.'
exits 1 diff a b --ignore 19,14,2,2; out_has '2 same, 2 different'
mkdir one two; cp grey.png one/x.png; cp dot.png two/x.png; cp white.png 'two/y.png'
exits 1 diff one two; out_is "different  x.png: 4 of 1200 pixels (0.333 %), largest difference 0.2 at 19,14
only in two: y.png
2 pictures: 1 different, 1 only in two"
exits 1 diff one two --mask white.png; out_is "only in two: y.png
2 pictures: 1 same, 1 only in two"
exits 2 diff one two --ignore 0,0,40,30; out_is "only in two: y.png
2 pictures: 1 only in two, 1 cannot be used"; err_has 'nothing is left to compare in one/x.png: all pixels are ignored'
rm two/y.png; exits 0 diff one two --max-pixels 4; out_is '1 picture: 1 within the limits'
exits 2 diff one two --mask small.png; err_has 'small.png: it is 20 x 30 pixels'; out_is '1 picture: 1 cannot be used'

# heat maps: of what differs, under the same names
exits 1 diff a b --out heats/deep; is_png heats/deep/light.png; is_png heats/deep/sub/dot.png
ok "no others" [ "$(find heats -type f | wc -l)" -eq 2 ]
"$monge" diff a/sub/dot.png b/sub/dot.png --out heat.png >out 2>err
ok "the same heat map" cmp heat.png heats/deep/sub/dot.png
# a reader that goes away ends none of it
for folder in a b; do cp cut.png $folder/cut.png; done
unread diff a b --out unread; ok "it is output that fails" [ "$status" -eq 2 ]; is_png unread/sub/dot.png
rm a/cut.png b/cut.png
for folder in a a/sub b/heats; do
    exits 2 diff a b --out $folder; no_out
    err_has "--out $folder: the heat map $folder/grey.png would be among the pictures of ${folder%%/*}"
done
rm -rf b/heats
# what is hidden is not found, and a folder above may hold heat maps, but where a name leads back
exits 1 diff a b --out b/.heats; is_png b/.heats/sub/dot.png; exits 0 diff b b; rm -r b/.heats
mkdir -p above/s above/t; cp grey.png above/s/x.png; cp dot.png above/t/x.png
exits 1 diff above/s above/t --out above; is_png above/x.png; exits 1 diff above/s above/t; out_has '1 picture:'
(cd above/s && "$monge" diff . ../t --out ..) >out 2>err; ok "from within" grep -q '1 picture: 1 different' out; no_err
mkdir above/s/t above/t/t; cp grey.png above/s/t/y.png; cp dot.png above/t/t/y.png
exits 2 diff above/s above/t --out above; err_has '--out above: the heat map above/t/y.png would be among the pictures of above/t'
missing above/t/y.png
rm above/x.png; cp dot.png above/x.png; ln -sf ../x.png above/t/x.png; rm -r above/s/t above/t/t
exits 2 diff above/s above/t --out above; err_has '--out above: the heat map above/x.png would write over a picture that is compared'
same above/x.png dot.png
mkdir masks; cp white.png masks/x.png
exits 2 diff one two --mask masks/x.png --out masks; err_has '--out masks: the heat map masks/x.png would write over the mask'
same masks/x.png white.png
exits 2 diff a b --out -; err_has '--out -: the heat maps of folders need a folder'
exits 2 diff a b --out grey.png; err_has 'cannot make the folder grey.png: '

# JSON
exits 1 diff a b --json
if command -v python3 >/dev/null; then
    ok "JSON of folders" python3 -c '
import json
d = json.load(open("out"))
assert [(e["name"], e["same"], e["why"]) for e in d] == [
    ("gone.png", False, "missing"), ("grey.png", True, None), ("light.png", False, "pixels"),
    ("sub/deeper/size.PNG", False, "size"), ("sub/dot.png", False, "pixels"), ("sub/new.png", False, "missing")], d
assert d[0]["a"] == {"file": "a/gone.png"} and d[0]["b"] is None and d[5]["a"] is None
assert d[4]["different"] == 4 and d[4]["b"]["file"] == "b/sub/dot.png"'
fi

# names that a terminal should not get, and what cannot be used
mkdir odd even; cp grey.png $'odd/a\nb\ec.png'; cp grey.png 'odd/two words.png'; cp dot.png 'even/two words.png'
exits 1 diff odd even; out_is "only in odd: a?b?c.png
different  two words.png: 4 of 1200 pixels (0.333 %), largest difference 0.2 at 19,14
2 pictures: 1 different, 1 only in odd"
mkdir bad good; cp cut.png bad/cut.png; cp grey.png good/cut.png; ln -s nowhere.png bad/link.png; cp grey.png good/link.png
mkfifo good/pipe.png; ln -s . good/loop.png; ln -s ../grey.png bad/z.png; cp grey.png good/z.png
exits 2 diff bad good; err_has 'cannot use bad/cut.png: the file is cut off'; err_has 'cannot read bad/link.png: No such file'
out_is '3 pictures: 1 same, 2 cannot be used'
exits 2 diff bad good --json; out_has '"why": "trouble"'
mkdir none1 none2; exits 2 diff none1 none2; err_has 'there is no PNG file below none1 or none2'; no_out
exits 1 diff none1 one; out_is "only in one: x.png
1 picture: 1 only in one"
if [ "$(id -u)" -ne 0 ]; then
    mkdir -m 0 none1/shut; exits 2 diff none1 one; err_has 'cannot read none1/shut/: '; rmdir none1/shut
fi

# a file and a folder: the file of its name
exits 0 diff grey.png a; out_is 'same: all of 1200 pixels are equal'
exits 1 diff b/light.png a/; out_has 'different: 1200'
exits 1 diff a/ b/light.png; out_has 'different: 1200'
exits 2 diff dot.png a; err_has 'cannot read a/dot.png: No such file'
exits 2 diff a Bb; ok "what is not there alone" [ "$(cat err)" = 'monge: error[cannot-read]: cannot read Bb: No such file or directory' ]
exits 2 diff Bb a; ok "on either side" [ "$(cat err)" = 'monge: error[cannot-read]: cannot read Bb: No such file or directory' ]
exits 2 diff - a; err_has 'standard input has no name to look for in a'
exits 2 diff a/grey.png b --out b/grey.png; err_has 'would write over a picture'

# ---- Trouble ----

cp cut.png cut2.png
: >none
exits 2 diff grey.png absent.png; err_has 'cannot read absent.png: No such file'; no_out
exits 2 diff grey.png cut.png; err_has 'cannot use cut.png: the file is cut off'
exits 2 diff grey.png cut.png --json; err_has 'cannot use cut.png: the file is cut off'
out_is '{
  "same": false,
  "why": "trouble",
  "a": {"file": "grey.png"},
  "b": {"file": "cut.png"}
}'
exits 2 diff - grey.png --json; out_has '"a": {"file": "-"}'; out_has '"why": "trouble"'
exits 2 diff cut.png cut2.png; err_has 'cannot use cut.png'
if command -v python3 >/dev/null; then # pixels that cannot be inflated, with the right check sum
    python3 -c '
import struct, zlib
data = open("grey.png", "rb").read()
at = data.index(b"IDAT") - 4
size = struct.unpack(">I", data[at:at + 4])[0]
bad = b"IDAT" + b"\xff" * size
open("bad.png", "wb").write(data[:at + 4] + bad + struct.pack(">I", zlib.crc32(bad)) + data[at + 12 + size:])'
    cp bad.png bad2.png
    exits 2 diff grey.png bad.png; err_has 'cannot use bad.png: it is damaged'
    exits 0 diff bad.png bad2.png; out_has 'same: ' # as its help says
    "$monge" help diff | tr '\n' ' ' >out; out_has 'Files with the same bytes are the same without being decoded'
fi
exits 2 diff grey.png none; err_has 'error[bad-picture]: cannot use none: the file is empty'
exits 2 diff grey.png empty.yaml; err_has 'it is no PNG file'
exits 2 diff /dev/zero /dev/zero; err_has 'cannot use /dev/zero: it is no PNG file' # and not: it is too large
"$monge" diff grey.png - < <(printf '\x89PN'; sleep 0.1; printf 'g\r\n\x1a\n'; exec yes) >out 2>err; status=$? last='diff grey.png -'
ok "an endless pipe that is no PNG" [ $status -eq 2 ]; err_has 'cannot use standard input: it is no PNG file'
exits 2 diff grey.png; err_has 'diff: expected two pictures, found 1'; err_has 'see `monge help diff`'
exits 2 diff grey.png again.png dot.png; err_has 'found 3'
exits 2 diff; err_has 'diff: no picture given'
exits 2 diff grey.png ''; err_has 'monge: diff: an operand is empty'
exits 2 diff - -; err_has 'standard input can be only one picture'
exits 2 diff grey.png dot.png --metric blip; err_has '--metric: expected some of exact, max, mae, rmse, psnr, ssim and flip, with commas between, found `blip`; did you mean `flip`?'
exits 2 diff grey.png dot.png --metric ssim,maxx,mae; err_has 'with commas between, found `maxx`; did you mean `max`?'
exits 2 diff grey.png dot.png --metric max,quality; err_has 'with commas between, found `quality`'; err_lacks 'did you mean'
exits 2 diff grey.png dot.png --metric mae,,max; err_has '--metric: expected'
exits 2 diff grey.png dot.png --metric mae,; err_has '--metric: expected'
for wrong in nan -0.1 1.1 x ''; do
    exits 2 diff grey.png dot.png --max-delta "$wrong"; err_has '--max-delta: expected a number from 0 to 1'
done
for wrong in nan -1 101% 1.5 % '' 5%%; do
    exits 2 diff grey.png dot.png --max-pixels "$wrong"; err_has '--max-pixels: expected a whole number, or 0 to 100 and %'
done
exits 2 diff grey.png dot.png --ppd 0; err_has '--ppd: expected a number from 1 to 1000'

# ---- Streams ----

"$monge" diff - grey.png <again.png >out 2>err; status=$? last='diff - grey.png'
ok "standard input" [ $status -eq 0 ]
cat dot.png | "$monge" diff grey.png - >out 2>err; status=$? last='diff grey.png -'
ok "a pipe" [ $status -eq 1 ]
exits 2 diff grey.png -; err_has 'cannot use standard input: the file is empty'

told
