#!/bin/sh
# `stokes new`: starters that are read and rendered, what it refuses, and comments in scenes.
. "$(dirname -- "$0")/common.sh" "$@"

for kind in box skin fluorescent; do
  expect 0 "$STOKES" new $kind $kind.json
  says out.txt "^$kind.json$"
  grep -q '^ *//' $kind.json || fail "the starter $kind has no comments"
  expect 0 "$STOKES" check $kind.json
  [ -s err.txt ] && fail "the starter $kind has warnings: $(cat err.txt)"
  expect 0 "$STOKES" render $kind.json --device reference -q --size 24x16 --spp 2
done
[ -s schema.json ] || fail 'no schema beside the starter'

expect 5 "$STOKES" new skin box.json
says err.txt 'box.json exists already; --force'
expect 0 "$STOKES" new skin box.json --force
cmp -s box.json skin.json || fail '--force did not overwrite'
# A schema that is there is left alone.
printf mine >schema.json
mkdir sub
expect 0 "$STOKES" new box again.json
[ "$(cat schema.json)" = mine ] || fail 'the schema was overwritten'
expect 0 "$STOKES" new sub/short.json --no-schema
[ "$(ls sub)" = short.json ] || fail '--no-schema wrote more than the scene'
expect 5 "$STOKES" new box no/such/folder/x.json
expect 64 "$STOKES" new
expect 64 "$STOKES" new boxx x.json
expect 64 "$STOKES" new box
expect 64 "$STOKES" new box schema.json --force

# An error behind comments is at its place.
sed 's/"vfov": 39.3/"vfov": 393/' sub/short.json >bad.json
expect 2 "$STOKES" check bad.json
says err.txt '^bad.json:10:13: error: /camera/vfov: '
finish
