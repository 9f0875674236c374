#!/bin/sh
# Stokes against Mitsuba, side by side: installs Mitsuba into a virtual environment (build/peers) and libllvm19 where they are missing,
# builds, and runs run_peers.py with the arguments given, such as --only s1,s2 or --out bench/results/mine.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
root=$(CDPATH='' cd -- "$here/../.." && pwd)
. "$root/.ci/setup.sh"
version=3.9.1

install_packages "$root"
build "$root" stokes
build "$root" bench_export_mesh

# Mitsuba's LLVM variants load the library themselves; versions up to 16 lack instructions that they use.
llvm=$(find /usr/lib -name 'libLLVM.so.19*' -print -quit 2>/dev/null || true)
if [ -z "$llvm" ]; then
  if [ "$(id -u)" -ne 0 ]; then
    printf 'please run\n  sudo apt-get install --no-install-recommends -y libllvm19\nand then this script again\n' >&2
    exit 1
  fi
  { apt-get update && apt-get install --no-install-recommends -y libllvm19; } >&2
  llvm=$(find /usr/lib -name 'libLLVM.so.19*' -print -quit)
fi
export DRJIT_LIBLLVM_PATH="$llvm"

python=${STOKES_PEERS_PYTHON:-$root/build/peers/bin/python}
if ! "$python" -c "import mitsuba" 2>/dev/null; then
  python3 -m venv "$root/build/peers"
  python=$root/build/peers/bin/python
  "$python" -m pip install --quiet "mitsuba==$version" numpy
fi

cd "$root"
exec "$python" "$here/run_peers.py" --stokes "$root/build/stokes" --export-mesh "$root/build/bench/peers/bench_export_mesh" "$@"
