#!/bin/sh
# Installs what is missing, builds everything, and runs the tests: ./test.sh [ctest arguments, such as -L unit].
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
. "$root/.ci/setup.sh"

install_packages "$root"
if python_environment "$root"; then
  build "$root" all -DSTOKES_PYTHON:BOOL=ON "-DPython_EXECUTABLE:FILEPATH=$root/build/venv/bin/python"
else
  build "$root" all
fi
cd "$root/build"
exec ctest --output-on-failure --parallel "$(nproc)" "$@"
