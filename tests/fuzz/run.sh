#!/bin/sh
# Fuzzes the loader: tests/fuzz/run.sh [SECONDS [FOLDER]], by libFuzzer where clang has it. Seeds are the
# scenes of tests/errors/ and scenes/; what it finds goes to FOLDER, /tmp/monge-fuzz. Without libFuzzer
# it runs the seeds alone, each cut short in 20 places.
cd "$(dirname "$0")/../.." || exit 2
seconds=${1:-60} folder=${2:-/tmp/monge-fuzz}
mkdir -p "$folder/corpus" "$folder/seeds" || exit 2
make BUILD="$folder/build" "$folder/build/gen/grammar_tables.c" "$folder/build/gen/grammar_tables.h" "$folder/build/gen/grammar_schema.c" "$folder/build/gen/stories.c" "$folder/build/gen/program.c" >/dev/null || exit 2
find tests/errors scenes -name '*.yaml' | while read -r scene; do cp "$scene" "$folder/seeds/$(echo "$scene" | tr / _)"; done

sources="$(ls src/*.c src/[!c]*/*.c) $folder/build/gen/grammar_tables.c $folder/build/gen/grammar_schema.c $folder/build/gen/stories.c $folder/build/gen/program.c tests/fuzz/load.c"
flags="-std=c17 -g -O1 -D_GNU_SOURCE -DMONGE_VERSION=\"fuzz\" -ffp-contract=off -Isrc -I$folder/build/gen -fno-sanitize-recover=all"
libs="$(pkg-config --libs yaml-0.1 libpng libdeflate sleef) -lpthread -lm"
if clang $flags -fsanitize=fuzzer,address,undefined -o "$folder/fuzz" $sources $libs 2>"$folder/log"; then
    exec "$folder/fuzz" -max_total_time="$seconds" -max_len=4096 -timeout=10 -rss_limit_mb=2048 -artifact_prefix="$folder/" \
        -dict=tests/fuzz/yaml.dict "$folder/corpus" "$folder/seeds"
fi
echo "no libFuzzer here: the seeds alone"
gcc $flags -fsanitize=address,undefined -DMONGE_FUZZ_STDIN -o "$folder/fuzz" $sources $libs || exit 2
for seed in "$folder"/seeds/*; do
    size=$(wc -c < "$seed")
    for part in $(seq 0 20); do
        head -c $((size * part / 20)) "$seed" | "$folder/fuzz" || { echo "FAILED $seed, its first $((size * part / 20)) bytes"; exit 1; }
    done
done
