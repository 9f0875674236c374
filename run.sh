#!/bin/sh
# Installs what is missing, builds, and renders: ./run.sh [SCENE.json ...]. Done once, a later run only renders.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
. "$root/.ci/setup.sh"

install_packages "$root"
build "$root" stokes
mkdir -p "$root/out"
[ $# -gt 0 ] || set -- "$root/scenes/jensen_box.json"
for scene in "$@"; do
  name=$(basename -- "$scene" .json)
  printf 'rendering %s\n' "$scene" >&2
  "$root/build/stokes" render "$scene" -o "$root/out/$name.exr" --png >/dev/null
  printf 'picture: %s\n' "$root/out/$name.png"
  printf 'floats:  %s\n' "$root/out/$name.exr"
done
