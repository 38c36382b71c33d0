#!/bin/sh
# What is generated from grammar/*.yaml is up to date: tests/reference.sh BUILD/monge
build=$(dirname "$1")
status=0
renewed() { # renewed GENERATED FILE
    cmp "$1" "grammar/$2" || { echo "grammar/$2 is out of date: make reference"; status=1; }
}
check() { # check PRODUCT FILE
    "$build/tools/grammar" "$1" grammar "$build/gen/$2" || exit 1
    renewed "$build/gen/$2" "$2"
}
check reference reference.md
check schema scene.schema.json
"$1" schema | cmp - grammar/scene.schema.json || { echo "monge schema does not print grammar/scene.schema.json"; status=1; }
"$build/tools/diagnostics" reference grammar/diagnostics.yaml "$build/gen/errors.md" || exit 1
renewed "$build/gen/errors.md" errors.md
exit $status
