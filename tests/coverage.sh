#!/bin/bash
# Which lines of the host code the tests execute: builds with counters in a folder of its own, runs the tests that reach host code, and prints gcovr's
# table (Debian's gcovr). Usage: tests/coverage.sh [BUILD_FOLDER]     (default: build-coverage; JOBS=2, CMAKE_OPTIONS for more options)
# Left out are the tests whose time goes into kernels; they execute the same host code as the rest.
set -u
source_dir=$(cd "$(dirname "$0")/.." && pwd)
build=${1:-$source_dir/build-coverage}
command -v gcovr > /dev/null || { echo 'gcovr is missing: apt-get install gcovr' >&2; exit 1; }
. "$source_dir/tests/support/host_tests.sh"

# shellcheck disable=SC2086
configure_and_build "$build" -DSTOKES_COVERAGE=ON "-DCMAKE_CXX_FLAGS_DEBUG=-O0 -g1" ${CMAKE_OPTIONS:-} || exit 1
find "$build" -name '*.gcda' -delete
run_host_tests "$build" "$build/coverage-logs"
# Lines that only fatal errors of the system reach count like all others; tests and embedded pages do not.
gcovr --root "$source_dir" --filter "$source_dir/runtime/" --exclude-unreachable-branches --sort-percentage "$build" > "$build/coverage.txt"
awk '/^runtime/ {split($1, p, "/"); n[p[2]] += $2; hit[p[2]] += $3}
     END {for (f in n) printf "%-12s %6d lines %6.1f %%\n", f, n[f], 100 * hit[f] / n[f]}' "$build/coverage.txt" | sort
tail -2 "$build/coverage.txt"
echo "each file: $build/coverage.txt; $failures failed tests"
exit $((failures > 0))
