#!/usr/bin/env bash
# Each tests/import/NAME.yml, in the format of "The Ray Tracer Challenge", becomes NAME.yaml with the messages
# of NAME.txt, byte for byte; that loads without an error and renders. A wrong one has no NAME.yaml, and
# leaves the file of -o as it is: tests/import.sh [PROGRAM [--update]]. --update writes both anew: read them.

. "$(dirname "$0")/lib/testing.sh"
update=$2 wanted=$project/tests/import
cp "$wanted"/*.yml .

renders() { "$monge" render -q "$1" --size 24x16 -o picture.png 2>said && ! grep -q 'error\[' said || { cat said; false; }; }

# The same through standard streams, but for the first line, which has the name.
pipes() { "$monge" import - <"$1" 2>/dev/null | sed 1d | diff <(sed 1d "$2") -; }

# What must hold of a book that `monge import` has just read to made.yaml.
becomes() {
    local book=$1.yml text=$wanted/$1.txt scene=$wanted/$1.yaml
    diff -u "$text" err && [ ! -s out ] || return
    if [ -e "$scene" ]; then
        [ "$status" -eq 0 ] && diff -u "$scene" made.yaml && renders made.yaml && pipes "$book" made.yaml
    else
        [ "$status" -eq 1 ] && [ "$(cat made.yaml)" = before ]
    fi
}
for book in *.yml; do
    name=${book%.yml}
    echo before >made.yaml
    run import "$book" -o made.yaml
    if [ "$update" = --update ]; then
        cp err "$wanted/$name.txt"
        [ "$status" -eq 0 ] && cp made.yaml "$wanted/$name.yaml"
    fi
    ok "$book" becomes "$name"
done

told
