# shellcheck shell=bash
# What scripts that test the program have in common. They read it at their beginning, and end with `told`:
#     . "$(dirname "$0")/lib/testing.sh"
# $monge is the program, the script's operand, build/monge by default; the script is in an empty folder, $work, which is
# gone in the end. What needs a tool or a right that is not here is left out, and that is told.

monge=$(realpath "${1:-build/monge}")
[ -x "$monge" ] || { echo "${0##*/}: no program $monge" >&2; exit 1; }
project=$(realpath "$(dirname "$0")/..")
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
unset COLUMNS

passed=0 failed=0 last='' status=0
: >out; : >err

# ok NAME COMMAND...: a test that passes when the command succeeds.
ok() {
    local name=$1
    shift
    if "$@" >"$work/.said" 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $name"
        echo "    failed: $*; after: monge $last; exit $status; then what it said, and what the test did:"
        cat out err "$work/.said" | head -n 60 | tr -d '\0' | sed 's/^/    | /'
    fi
}

# run ARGS...: out, err and $status are what monge made of it.
run() {
    last=$*
    "$monge" "$@" >out 2>err </dev/null
    status=$?
}

# exits STATUS ARGS...: runs monge; a test of its exit status.
exits() {
    local want=$1
    shift
    run "$@"
    ok "exit $want: monge $*" [ "$status" -eq "$want" ]
}

# unread ARGS...: runs monge with both of its streams into a pipe whose reader has gone.
unread() {
    last="$* (into a closed pipe)"
    rm -f gone
    { await '[ -e gone ]'; "$monge" "$@" 2>&1; } < /dev/null | { exec <&-; : >gone; }
    status=${PIPESTATUS[0]}
}

out_is() { ok "stdout is $(tr '\n' '|' <<<"$1")" [ "$(cat out)" = "$1" ]; }
out_has() { ok "stdout has \`$1\`" grep -qF -e "$1" out; }
out_lacks() { ok "stdout lacks \`$1\`" sh -c '! grep -qF -e "$1" out' sh "$1"; }
no_out() { ok "nothing on stdout" [ ! -s out ]; }
err_has() { ok "stderr has \`$1\`" grep -qF -e "$1" err; }
err_lacks() { ok "stderr lacks \`$1\`" sh -c '! grep -qF -e "$1" err' sh "$1"; }
no_err() { ok "nothing on stderr" [ ! -s err ]; }

there() { for f in "$@"; do ok "$f is there" [ -s "$f" ]; done; }
missing() { for f in "$@"; do ok "$f is not there" [ ! -e "$f" ]; done; }
same() { ok "$1 is $2" cmp "$1" "$2"; }
is_png() { ok "$1 is a PNG" sh -c 'head -c 8 "$1" | od -An -tx1 | tr -d " \n" | grep -qx 89504e470d0a1a0a' sh "$1"; }
no_leftovers() { ok "nothing is left over" [ -z "$(find . -name '*.tmp' -o -name '*.partial' -o -name '*.waiting')" ]; }

have() { command -v "$1" >/dev/null; }
left_out() { echo "${0##*/}: left out: $1"; }

# ---- What takes time: a test waits for what it needs, however fast or busy the machine is ----

# await CONDITION: until the shell command succeeds; false when that takes more than a minute.
await() {
    local end=$((SECONDS + 60))
    until eval "$1" 2>/dev/null; do
        [ $SECONDS -lt $end ] || return
        sleep 0.02
    done
}

# signalled SIGNAL CONDITION ARGS...: sends monge the signal when it is at work and the shell command CONDITION succeeds.
# $status is what waitpid has: the number of the signal that ended monge, or 256 times its exit status; $took: seconds.
signalled() {
    last="${*:3} (signal $1)"
    perl "$project/tests/lib/signalled.pl" "$1" "$2" "$monge" "${@:3}" >out 2>err 3>"$work/.waited"
    read -r status took <"$work/.waited"
}

# patient TEXT ARGS...: monge renders with more and more samples, until that takes long enough for the text on stderr.
patient() {
    local samples
    for samples in 4 16 64 256 1024 4096 16384; do
        exits 0 render "${@:2}" --samples $samples --threads 1
        grep -qF -e "$1" err && break
    done
    err_has "$1"
}

# samples_for SECONDS SCENE: so many that a picture of the scene takes that much of a processor
samples_for() {
    local samples=1 took TIMEFORMAT=%U
    while :; do
        took=$({ time "$monge" render -q "$2" --samples $samples --threads 1 -o - >/dev/null 2>&1; } 2>&1)
        awk -v took="$took" 'BEGIN { exit took < 0.2 }' && break
        samples=$((2 * samples))
    done
    awk -v samples=$samples -v took="$took" -v want="$1" 'BEGIN { print int(samples * want / took) + 1 }'
}

# The last line of a script, for tools/test.
told() {
    echo "$passed passed, $failed failed"
    [ "$failed" -eq 0 ]
}
