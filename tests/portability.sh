#!/bin/bash
# Runs the device tests, a parity of small scenes and a comparison of bits on every OpenCL runtime that can be had on Debian 12: PoCL, Intel's CPU runtime,
# Oclgrind (which also finds races and accesses out of bounds) and Mesa's Rusticl. What is missing is installed: Debian's packages if this is root,
# Intel's runtime from PyPI into a folder.
# Usage: tests/portability.sh BUILD_FOLDER [pocl] [intel] [oclgrind] [rusticl]     (default: all; INTEL_DIR=/tmp/stokes-intel, LIMIT=1800 seconds a program)
# A runtime that cannot be had counts as a failure when it was asked for by name, and is named as skipped otherwise.
set -u
source_dir=$(cd "$(dirname "$0")/.." && pwd)
build=$(cd "${1:?usage: $0 BUILD_FOLDER [runtime...]}" && pwd) || exit 64
shift
runtimes=${*:-pocl intel oclgrind rusticl}
asked=$#
intel_dir=${INTEL_DIR:-/tmp/stokes-intel}
limit="timeout -k 10 ${LIMIT:-1800}"
vendors=$(mktemp -d)
trap 'rm -rf "$vendors"' EXIT
export XDG_CACHE_HOME=$vendors/cache
failures=0
skipped=

# run NAME COMMAND...: runs it and remembers a failure.
run() {
  local begin=$SECONDS
  echo "== $1: ${*:2}"
  if "${@:2}"; then echo "== $1: passed, $((SECONDS - begin)) s"; else
    echo "== $1: FAILED ($?), $((SECONDS - begin)) s"
    failures=$((failures + 1))
  fi
}

missing() {
  echo "== $1: SKIPPED, not installed"
  skipped="$skipped $1"
  [ "$asked" -eq 0 ] || failures=$((failures + 1))
}

# has FILE PACKAGE: is the file there, if need be by installing the package?
has() {
  [ -e "$1" ] || { [ "$(id -u)" -eq 0 ] && DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "$2" > "$vendors/apt.txt" 2>&1; }
  [ -e "$1" ]
}

# only FILE_OR_LIBRARY...: makes these the only OpenCL vendors.
only() {
  rm -f "$vendors"/*.icd
  local library
  for library in "$@"; do echo "$library" > "$vendors/$(basename "$library").icd"; done
  export OCL_ICD_VENDORS=$vendors
}

device_tests() { $limit "$build/tests/unit/test_device" --gtest_brief=1 --gtest_filter="${1:-*}"; }

parity() {
  local scene
  for scene in "$@"; do
    $limit "$build/stokes" parity "$source_dir/scenes/$scene.json" --devices 0:0 --spp 64 --size 32x32 || return
  done
}

# Renders small scenes for same_bits; the runtime's name is in the files'.
pictures() {
  local scene
  for scene in jensen_box fog_box; do
    $limit "$build/stokes" render "$source_dir/scenes/$scene.json" --size 32x32 --spp 16 -q -o "$vendors/$scene.$1.exr" || return
  done
}

# Division and square root are correctly rounded on both, and the kernels leave nothing else to the runtime: not a bit may differ.
same_bits() {
  local scene
  for scene in jensen_box fog_box; do
    "$build/stokes" compare --exact "$vendors/$scene.$1.exr" "$vendors/$scene.$2.exr" || return
  done
}

# Intel's wheel brings a newer TBB than Debian's, which Embree loads first: ours must find the newer one, and only that.
install_intel() {
  if [ ! -e "$intel_dir/lib/libintelocl.so" ]; then
    python3 -m venv "$intel_dir" && "$intel_dir/bin/pip" install -q intel-opencl-rt intel-cmplr-lib-rt || return
  fi
  mkdir -p "$intel_dir/tbb" && ln -sf "$intel_dir"/lib/libtbb.so.12 "$intel_dir/tbb/"
}

# Oclgrind exits 0 whatever it finds: its log is read.
under_oclgrind() {
  local log
  log=$(mktemp)
  # Its interpreter does not know an intrinsic that LLVM's inliner leaves behind, so no passes run.
  $limit oclgrind --build-options -disable-llvm-passes --log "$log" --data-races "$@"
  local status=$?
  if [ -s "$log" ]; then
    head -40 "$log"
    status=1
  fi
  rm -f "$log"
  return $status
}

for runtime in $runtimes; do
  unset RUSTICL_ENABLE LD_LIBRARY_PATH
  case $runtime in
    pocl)
      has /etc/OpenCL/vendors/pocl.icd pocl-opencl-icd || { missing pocl; continue; }
      only "$(cat /etc/OpenCL/vendors/pocl.icd)"
      run pocl device_tests
      run pocl parity jensen_box fog_box
      run pocl pictures pocl
      ;;
    intel)
      install_intel || { missing intel; continue; }
      only "$intel_dir/lib/libintelocl.so"
      export LD_LIBRARY_PATH=$intel_dir/tbb
      run intel device_tests
      run intel parity jensen_box fog_box
      run intel pictures intel
      ;;
    oclgrind)
      has /usr/bin/oclgrind oclgrind || { missing oclgrind; continue; }
      # Simulated: without the tests that spin for seconds, and no caches, whose binaries are not checked.
      run oclgrind under_oclgrind "$build/tests/unit/test_device" --gtest_brief=1 --gtest_filter="DeviceTest.*-*Pass*:*Cache*:*BuildLog*"
      run oclgrind under_oclgrind "$build/stokes" render "$source_dir/scenes/jensen_box.json" --size 8x8 --spp 2 -q -o "$vendors/oclgrind.exr"
      ;;
    rusticl)
      has /etc/OpenCL/vendors/rusticl.icd mesa-opencl-icd || { missing rusticl; continue; }
      only "$(cat /etc/OpenCL/vendors/rusticl.icd)"
      export RUSTICL_ENABLE=llvmpipe
      # The render kernel takes it minutes to build, and its image is wrong (runtime/device/README.md): the machinery is tested.
      run rusticl device_tests "DeviceTest.*"
      ;;
    *) echo "unknown runtime $runtime"; exit 64 ;;
  esac
done
# The pictures outlive their runtime; comparing them needs none.
if [ -e "$vendors/fog_box.pocl.exr" ] && [ -e "$vendors/fog_box.intel.exr" ]; then run bits same_bits pocl intel; fi
echo "$failures failures on: $runtimes${skipped:+; skipped:$skipped}"
exit $((failures > 0))
