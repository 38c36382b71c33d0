#!/usr/bin/env bash
# Batches that are killed at random moments: tests/kill.sh [PROGRAM]. KILLS: how many, 6 by default (`make kill`: 200);
# SEED: of the moments. After each kill every picture is to the byte that of the scene as it is now or as it was before,
# and nothing else is under a picture's name. A run afterwards finishes the rest, and nothing is left over.

. "$(dirname "$0")/lib/testing.sh"
kills=${KILLS:-6} RANDOM=${SEED:-$$}
seed=${SEED:-$$} during=0 mixed=0 resumed=0

fail() {
    failed=$((failed + 1))
    echo "FAILED: $1 (SEED=$seed)"
}

# scenes VERSION: six short ones, and one that takes longer
scenes() {
    for i in 1 2 3 4 5 6; do
        printf 'image: {size: [%s, 90]}\nscene: [{sphere: {radius: %s}}, {box: {min: [0, 0, 0], max: [2, 1, %s]}}]\n' 12$i 1.$1 $i
    done | split -l 2 --additional-suffix=.yaml - s/short-
    { printf 'image: {size: [128, 96], samples: %s}\nrender: {depth: 12}\nlights: [{point: {at: [4, 6, %s]}}]\nscene:\n' $samples 1$1
      for x in -1 0 1; do printf '  - sphere: {center: [%s, 0, 0], radius: 0.6}\n    material: {diffuse: [0.2, 0.2, 0.2], reflection: 0.6, refraction: 0.3, index: 1.3}\n' $x; done; } >s/long.yaml
}

# batch: all of them into p/, with checkpoints
batch() { "$monge" render s -o p/ --resume -j 2 --threads $((RANDOM % 3 + 1)) >said 2>&1; }

mkdir s versions
samples=1; scenes 1
samples=$(samples_for 3.5 s/long.yaml) # on two threads more than the second between two checkpoints
for version in 1 2; do
    scenes $version
    begun=$(date +%s%N)
    "$monge" render -q s -o versions/$version/ || fail "version $version is rendered"
    took=$((($(date +%s%N) - begun) / 1000000 + 1))
done
for f in versions/1/*; do cmp -s "$f" versions/2/"${f##*/}" && fail "the versions differ"; done

# Each picture as a whole is of one of the versions; of which, is told.
check_pictures() {
    local now=0 before=0
    for f in p/*; do
        [ -e "$f" ] || continue
        if cmp -s "$f" versions/$version/"${f##*/}"; then now=$((now + 1))
        elif cmp -s "$f" versions/$((3 - version))/"${f##*/}"; then before=$((before + 1))
        else fail "$f is wrong"; fi
    done
    [ $now -gt 0 ] && [ $before -gt 0 ] && mixed=$((mixed + 1))
}

finish() {
    batch || fail "the run afterwards"
    grep -q ^resumed said && resumed=$((resumed + 1))
    for f in versions/$version/*; do cmp -s "$f" p/"${f##*/}" || fail "the run afterwards has left ${f##*/} wrong"; done
    [ "$(find p -name '*.png' | wc -l)" -eq 7 ] || fail "there are other pictures"
    [ -z "$(find p -name '*.partial')" ] || fail "a checkpoint is left over"
}

version=2 complete=1
for ((n = 1; during < kills && n <= 5 * kills; n++)); do
    # a run that begins anew, with pictures of before or without, or goes on where the last one was killed
    case $((complete ? 0 : RANDOM % 4)) in
    0) version=$((3 - version)); scenes $version ;;
    1) [ $((RANDOM % 4)) -eq 0 ] && rm -rf p ;;
    esac
    complete=0
    "$monge" render s -o p/ --resume -j 2 --threads $((RANDOM % 3 + 1)) >/dev/null 2>&1 & pid=$!
    sleep "$(awk -v r=$RANDOM -v took=$took 'BEGIN { printf "%.3f", r / 32768 * took * 1.1 / 1000 }')"
    kill -9 $pid 2>/dev/null
    wait $pid 2>/dev/null
    if [ $? -eq 137 ]; then during=$((during + 1)); else complete=1; fi
    before=$failed
    check_pictures
    if [ $((RANDOM % 4)) -eq 0 ]; then finish; complete=1; fi
    [ $failed -eq $before ] && passed=$((passed + 1))
done
finish
version=$((3 - version)); scenes $version # all pictures are of before now, and as fresh as they can be
finish
[ $during -eq "$kills" ] || fail "only $during of $((n - 1)) runs were at work when they were killed"
[ "$kills" -lt 50 ] || [ $resumed -gt 0 ] || fail "no run went on from a checkpoint"
echo "kill: $during of $((n - 1)) runs killed at work, $mixed with pictures of both versions, $resumed runs went on from checkpoints"
[ -z "$(find p -name '*.tmp')" ] || echo "kill: $(find p -name '*.tmp' | wc -l) temporary files"
told
