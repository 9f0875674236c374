#!/bin/sh
# Builds the Python package and runs its tests, as test.sh does among all others: python/test.sh [pytest arguments].
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
. "$root/.ci/setup.sh"

install_packages "$root"
python_environment "$root" || exit 1
for target in stokes stokes_python; do
  build "$root" "$target" -DSTOKES_PYTHON:BOOL=ON "-DPython_EXECUTABLE:FILEPATH=$root/build/venv/bin/python"
done
PYTHONPATH=$root/build/python PYTHONDONTWRITEBYTECODE=1 STOKES=$root/build/stokes \
  exec "$root/build/venv/bin/python" -m pytest -q -p no:cacheprovider "$root/python/tests" "$@"
