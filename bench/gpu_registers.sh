#!/bin/bash
# What the kernels take of a GPU, without one: compiles them with the GPU's constants (LANES 1, two children a node) to PTX and prints
# what ptxas says, and to AMD's code and prints what LLVM says. Usage: gpu_registers.sh [NVIDIA architecture [AMD processor]].
# Needs clang 15 and libclc-15; ptxas for the first half (CLANG, LLC, PTXAS, CLC name others). Exit code 77 without clang or libclc.
set -u
cd "$(dirname "$0")/.." || exit 1
nvidia=${1:-sm_90}
amd=${2:-gfx906}
clang=${CLANG:-clang-15}
ptxas=${PTXAS:-ptxas}
library=${CLC:-/usr/lib/clc}
command -v "$clang" >/dev/null || { echo "gpu_registers: no $clang"; exit 77; }
[ -e "$library/nvptx64--nvidiacl.bc" ] || { echo "gpu_registers: no $library/nvptx64--nvidiacl.bc"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

features="TRIANGLES SPHERES ELLIPSOIDS QUADS TEXTURES BLENDS ENVIRONMENT BACKGROUND MEDIA CHROMATIC_MEDIA THIN_MEDIA INTERFACES
FLUORESCENT_SURFACES FLUORESCENT_MEDIA RERADIATION METAL CONDUCTOR SMOOTH_DIELECTRIC ROUGH_DIELECTRIC PHONG DISPERSION
EMISSION_TEXTURES SMOOTH_NORMALS LENS"
failures=0

# compile TARGET LIBRARY "OPTIONS" OUT "FEATURES"
compile() {
  local options="-DLANES=1 -DBVH_WIDTH=2 -DWAVELENGTHS=4 -DINTEGRATOR=2 -DFILM_CHANNELS=0 -DFILM_SPECTRAL=0 -DSCENE_RGB=0 -DSTOKES_X86=0" feature
  for feature in $features; do
    case " $5 " in *" $feature "*) options+=" -DSCENE_HAS_$feature=1" ;; *) options+=" -DSCENE_HAS_$feature=0" ;; esac
  done
  # shellcheck disable=SC2086
  "$clang" -x cl -cl-std=CL1.2 -D__OPENCL_VERSION__=120 -Xclang -finclude-default-header -w -O2 -target "$1" $3 \
    -Xclang -mlink-builtin-bitcode -Xclang "$library/$2" -Ikernels $options -S -o "$4" kernels/render.cl
}

# report NAME "FEATURES"
report() {
  local ptx="$folder/kernel.ptx" isa="$folder/kernel.s"
  if ! command -v "$ptxas" >/dev/null; then
    echo "$1: $nvidia: not measured: no $ptxas"
  elif compile nvptx64-nvidia-nvcl nvptx64--nvidiacl.bc "-Xclang -target-cpu -Xclang sm_80 -Xclang -target-feature -Xclang +ptx70" "$ptx" "$2" &&
      "$ptxas" -v "-arch=$nvidia" -o /dev/null "$ptx" >"$folder/said" 2>&1; then
    sed -n "/Compiling entry function 'render'/,/Used/p" "$folder/said" | grep -E 'stack frame|Used' | tr '\n' ' ' |
      sed -E "s/ptxas info *: //; s/ +/ /g; s/^/$1: $nvidia:/; s/\$/\n/"
  else
    cat "$folder/said" 2>/dev/null
    echo "$1: $nvidia: FAILED"
    failures=$((failures + 1))
  fi
  if [ ! -e "$library/amdgcn--amdhsa.bc" ]; then
    echo "$1: $amd: not measured: no amdgcn--amdhsa.bc"
  elif compile amdgcn-amd-amdhsa amdgcn--amdhsa.bc "-nogpulib -mcpu=$amd" "$isa" "$2"; then
    awk -v name="$1: $amd:" '/^; Kernel info/ { seen = 0 } /^render:/ { want = 1 }
      want && /^; (NumVgprs|NumSgprs|ScratchSize|Occupancy):/ { sub("^; ", ""); name = name " " $0; if (/Occupancy/) { print name; exit } }' "$isa"
  else
    echo "$1: $amd: FAILED"
    failures=$((failures + 1))
  fi
}

box="QUADS SPHERES METAL SMOOTH_DIELECTRIC"
report "box (s1)" "$box"
report "box in fog (s2)" "$box MEDIA THIN_MEDIA INTERFACES"
report "mesh in a box" "QUADS TRIANGLES"
report "skin (s3)" "TRIANGLES QUADS MEDIA SMOOTH_DIELECTRIC BACKGROUND"
report "everything" "$(echo $features)"
exit $((failures > 0))
