#!/bin/sh
# Builds the Python package in a folder of its own (build-python, or $STOKES_PYTHON_BUILD) and runs its tests. Arguments go to pytest.
# Of its own, because the package needs position-independent libraries, and `stokes` itself is built without.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
folder=${STOKES_PYTHON_BUILD:-$root/build-python}
venv=$folder/venv

if ! "$venv/bin/python" -c 'import nanobind, numpy, pytest' 2>/dev/null; then
  printf 'installing nanobind, numpy and pytest into %s\n' "$venv" >&2
  if ! { python3 -m venv "$venv" && "$venv/bin/pip" install --quiet --disable-pip-version-check nanobind numpy pytest; } >&2; then
    printf 'the Python package cannot be tested: it needs python3-dev, python3-venv and, from PyPI, nanobind, numpy and pytest\n' >&2
    exit 1
  fi
fi
cmake -S "$root" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DSTOKES_PYTHON=ON -DPython_EXECUTABLE="$venv/bin/python" >"$folder/configure.log" ||
  { cat "$folder/configure.log" >&2; exit 1; }
ninja -C "$folder" --quiet stokes_python stokes >&2
PYTHONPATH=$folder/python PYTHONDONTWRITEBYTECODE=1 STOKES=$folder/stokes \
  exec "$venv/bin/python" -m pytest -q -p no:cacheprovider "$root/python/tests" "$@"
