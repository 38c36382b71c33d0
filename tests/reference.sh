#!/bin/sh
# What is generated from grammar/*.yaml is up to date: tests/reference.sh BUILD/monge
build=$(dirname "$1")
check() { # check PRODUCT FILE
    "$build/tools/grammar" "$1" grammar "$build/gen/$2" || exit 1
    cmp "$build/gen/$2" "grammar/$2" || { echo "grammar/$2 is out of date: make reference"; exit 1; }
}
check reference reference.md
check schema scene.schema.json
"$1" schema | cmp - grammar/scene.schema.json || { echo "monge schema does not print grammar/scene.schema.json"; exit 1; }
