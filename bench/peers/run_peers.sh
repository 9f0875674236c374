#!/bin/sh
# Stokes against other renderers, side by side: installs them into virtual environments (build/peers, build/cycles, build/lux) and libllvm19
# where they are missing, builds, and runs run_peers.py with the arguments given, such as --only s1,s2 or --out bench/results/mine.
#   run_peers.sh ...                against Mitsuba        run_peers.sh --peer cycles ...    against Cycles (PyPI's bpy, 350 MB)
#   run_peers.sh --peer lux ...     against LuxCore (PyPI's pyluxcore, 500 MB)
#   run_peers.sh --goals ...        every goal, with what was measured and whether it is met (goals.py)
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
root=$(CDPATH='' cd -- "$here/../.." && pwd)
. "$root/.ci/setup.sh"
script=run_peers.py mitsuba=yes cycles=no lux=no
case "${1:-} ${2:-}" in
  "--goals "*) script=goals.py cycles=yes; shift ;;
  "--peer cycles" | "--peer=cycles "*) mitsuba=no cycles=yes ;;
  "--peer lux" | "--peer=lux "*) mitsuba=no lux=yes ;;
esac

install_packages "$root"
build "$root" stokes
build "$root" bench_export_mesh
if [ "$script" = goals.py ]; then build "$root" bench_traversal; fi

# A virtual environment with a package of PyPI, made where none is given or there; prints its Python.
environment() { # folder python module requirement
  python=${2:-$root/build/$1/bin/python}
  if ! "$python" -c "import $3" >/dev/null 2>&1; then
    python3 -m venv "$root/build/$1" >&2
    python=$root/build/$1/bin/python
    "$python" -m pip install --quiet "$4" numpy >&2 || return 1
  fi
  printf '%s\n' "$python"
}

python=python3
if [ "$mitsuba" = yes ]; then
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
  python=$(environment peers "${STOKES_PEERS_PYTHON:-}" mitsuba mitsuba==3.9.1)
fi
cycles_python=
if [ "$cycles" = yes ]; then
  # The wheels of 4.5 want Python 3.11. The table of goals says so where they cannot be had; a run against Cycles ends.
  if ! cycles_python=$(environment cycles "${STOKES_CYCLES_PYTHON:-}" bpy 'bpy>=4.5,<4.6'); then
    [ "$script" = goals.py ] || exit 1
    cycles_python=
  fi
fi
lux_python=
if [ "$lux" = yes ]; then lux_python=$(environment lux "${STOKES_LUX_PYTHON:-}" pyluxcore pyluxcore==2.11.2); fi

cd "$root"
exec "$python" "$here/$script" --stokes "$root/build/stokes" --export-mesh "$root/build/bench/peers/bench_export_mesh" \
  --cycles-python "$cycles_python" --lux-python "$lux_python" "$@"
