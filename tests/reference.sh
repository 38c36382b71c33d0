#!/bin/sh
# grammar/reference.md is what grammar/*.yaml make of it: tests/reference.sh BUILD/monge
build=$(dirname "$1")
"$build/tools/grammar" reference grammar "$build/gen/reference.md" || exit 1
cmp "$build/gen/reference.md" grammar/reference.md ||
    { echo "grammar/reference.md is out of date: make reference"; exit 1; }
