#!/bin/bash
# Which lines of the host code the tests execute: builds with counters in a folder of its own, runs the tests, and prints gcovr's table (Debian's gcovr).
# Usage: tests/coverage.sh [BUILD_FOLDER [--report | CTEST_ARGUMENTS...]]     (default: build-coverage; JOBS=2, STRIDE=12, CMAKE_OPTIONS for more options)
# --report only says what earlier runs in that folder executed, such as those of `CMAKE_OPTIONS=-DSTOKES_COVERAGE=ON tests/sanitize.sh address BUILD_FOLDER`.
set -u
source_dir=$(cd "$(dirname "$0")/.." && pwd)
build=${1:-$source_dir/build-coverage}
[ $# -gt 0 ] && shift
command -v gcovr > /dev/null || { echo 'gcovr is missing: apt-get install gcovr' >&2; exit 1; }
. "$source_dir/tests/support/host_tests.sh"

status=0
if [ "${1:-}" != --report ]; then
  configure_and_build "$build" -DSTOKES_COVERAGE=ON || exit 1
  run_tests "$build" "$@"
  status=$?
fi
# Lines that only fatal errors of the system reach count like all others; tests and embedded pages do not.
gcovr --gcov-executable 'llvm-cov gcov' --root "$source_dir" --filter "$source_dir/runtime/" --exclude-unreachable-branches --exclude-directories counters_of_the_killed --sort-percentage "$build" > "$build/coverage.txt"
awk '/^runtime/ {split($1, p, "/"); n[p[2]] += $2; hit[p[2]] += $3}
     END {for (f in n) printf "%-12s %6d lines %6.1f %%\n", f, n[f], 100 * hit[f] / n[f]}' "$build/coverage.txt" | sort
tail -2 "$build/coverage.txt"
echo "each file: $build/coverage.txt; ctest's exit code $status"
exit $((status > 0))
