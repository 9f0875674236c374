#!/bin/bash
# Compiles the kernels with clang, warnings as errors, over a matrix of lane counts, wavelengths and scene features.
# Usage: lint_kernels.sh [clang]   (from anywhere; exit 77 when there is no clang)
set -u
cd "$(dirname "$0")/../.." || exit 1
clang=${1:-clang}
command -v "$clang" >/dev/null || { echo "lint_kernels: no $clang"; exit 77; }

features="TRIANGLES SPHERES ELLIPSOIDS QUADS TEXTURES BLENDS ENVIRONMENT BACKGROUND MEDIA CHROMATIC_MEDIA THIN_MEDIA INTERFACES
FLUORESCENT_SURFACES FLUORESCENT_MEDIA RERADIATION METAL CONDUCTOR SMOOTH_DIELECTRIC ROUGH_DIELECTRIC PHONG DISPERSION
EMISSION_TEXTURES SMOOTH_NORMALS LENS"
everything=$(echo $features)
failures=0

# check NAME LANES BVH_WIDTH WAVELENGTHS INTEGRATOR CHANNELS SPECTRAL RGB X86 "FEATURES"
check() {
  local options="-DLANES=$2 -DBVH_WIDTH=$3 -DWAVELENGTHS=$4 -DINTEGRATOR=$5 -DFILM_CHANNELS=$6 -DFILM_SPECTRAL=$7 -DSCENE_RGB=$8 -DSTOKES_X86=$9"
  local has=" ${10} " feature
  for feature in $features; do
    case "$has" in *" $feature "*) options+=" -DSCENE_HAS_$feature=1" ;; *) options+=" -DSCENE_HAS_$feature=0" ;; esac
  done
  # With one lane masks are plain integers, and the mask rule looks odd to the compiler.
  [ "$2" = 1 ] && options+=" -Wno-bitwise-instead-of-logical -Wno-logical-not-parentheses"
  if ! "$clang" -x cl -cl-std=CL1.2 -D__OPENCL_VERSION__=120 -Xclang -finclude-default-header -fsyntax-only -Wall -Wextra -Wconversion -Werror \
      -Ikernels $options kernels/render.cl; then
    echo "lint_kernels: FAILED: $1 ($options)"
    failures=$((failures + 1))
  fi
}

surfaces="QUADS SPHERES METAL SMOOTH_DIELECTRIC"
check "everything, one lane"     1 2 4 2 15 1 0 0 "$everything"
check "everything, 8 lanes"      8 8 4 2 15 1 0 0 "$everything"
check "everything, 16 lanes"    16 8 8 2 15 1 0 0 "$everything"
check "everything, 4-wide"       8 4 1 1 0 0 0 0 "$everything"
check "nothing"                  8 8 4 2 0 0 0 0 ""
check "plain box"                8 8 4 2 0 0 0 0 "$surfaces"
check "plain box, one lane"      1 2 1 0 0 0 0 0 "$surfaces"
check "rgb"                      8 8 3 2 15 0 1 0 "QUADS TRIANGLES MEDIA CHROMATIC_MEDIA INTERFACES BACKGROUND TEXTURES BLENDS ENVIRONMENT CONDUCTOR PHONG"
check "fog in a box"             8 8 4 2 0 0 0 0 "$surfaces MEDIA THIN_MEDIA INTERFACES"
check "skin"                     8 8 4 2 0 0 0 0 "TRIANGLES QUADS MEDIA SMOOTH_DIELECTRIC BACKGROUND"
check "fluorescent surfaces"     8 8 4 2 8 0 0 0 "QUADS FLUORESCENT_SURFACES"
check "fluorescent media"        1 2 8 2 8 0 0 0 "SPHERES MEDIA FLUORESCENT_MEDIA INTERFACES"
check "normals"                  8 8 4 3 15 0 0 0 "$everything"
check "ambient occlusion"        1 2 4 4 0 0 0 0 "TRIANGLES"
check "triangles and background" 8 8 4 2 0 0 0 0 "TRIANGLES BACKGROUND"
[ $failures = 0 ] && echo "lint_kernels: 15 combinations are clean"
exit $((failures > 0))
