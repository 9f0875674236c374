#!/bin/sh
# Remakes the golden images by the CPU reference: means and variances of these means. Usage: tests/golden/make.sh path/to/stokes
# Only when a scene or the reference itself has changed for a reason that closed forms confirm; never to make a test pass.
set -eu
stokes=$1
folder=$(cd "$(dirname "$0")" && pwd)
while read -r scene samples; do
  "$stokes" render "$folder/../../scenes/$scene.json" --device reference --size 48x48 --spp "$samples" --seed 20260101 --aov variance -q -o "$folder/$scene.exr"
done <<LIST
jensen_box 512
fog_box 512
fluorescent_box 512
dispersion_sphere 512
LIST
