#!/bin/sh
# grammar/reference.md and grammar/errors.md are what grammar/*.yaml make of them: tests/reference.sh BUILD/monge
build=$(dirname "$1")
"$build/tools/grammar" reference grammar "$build/gen/reference.md" || exit 1
status=0
renewed() { # renewed GENERATED FILE
    cmp "$1" "$2" || { echo "$2 is out of date: make reference"; status=1; }
}
renewed "$build/gen/reference.md" grammar/reference.md
"$build/tools/diagnostics" reference grammar/diagnostics.yaml "$build/gen/errors.md" || exit 1
renewed "$build/gen/errors.md" grammar/errors.md
exit $status
