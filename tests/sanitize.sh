#!/bin/bash
# Builds with sanitizers in a folder of its own and runs the tests there that reach host code.
# Usage: tests/sanitize.sh address|thread [BUILD_FOLDER]     (default: build-address, build-thread; JOBS=2, CMAKE_OPTIONS for more options)
#   address: AddressSanitizer, LeakSanitizer, UndefinedBehaviorSanitizer; thread: ThreadSanitizer.
# TESTS="test_image test_view" SCRIPTS= chooses some. What they find is read from their logs, because a process may end well in spite of it. Left out are the tests whose time goes into kernels, which
# no sanitizer sees; support/sanitizers.txt says what is forgiven to libraries.
set -u
source_dir=$(cd "$(dirname "$0")/.." && pwd)
kind=${1:-}
case $kind in
  address) sanitizers=address,undefined ;;
  thread) sanitizers=thread ;;
  *)
    echo "usage: $0 address|thread [BUILD_FOLDER]" >&2
    exit 64
    ;;
esac
build=${2:-$source_dir/build-$kind}
. "$source_dir/tests/support/host_tests.sh"

# shellcheck disable=SC2086
configure_and_build "$build" -DSTOKES_SANITIZE=$sanitizers "-DCMAKE_CXX_FLAGS_DEBUG=-O0 -g1" ${CMAKE_OPTIONS:-} || exit 1

found=$build/sanitizer-findings
rm -rf "$found"
mkdir "$found"
for which in leak thread; do sed -n "s/^$which: *//p" "$source_dir/tests/support/sanitizers.txt" > "$found/$which.suppressions"; done
# A library that is preloaded (opencl_faults) comes before the sanitizer's own, which would refuse to run.
export ASAN_OPTIONS=log_path=$found/log:verify_asan_link_order=0
export UBSAN_OPTIONS=print_stacktrace=1:log_path=$found/log
export LSAN_OPTIONS=suppressions=$found/leak.suppressions:print_suppressions=0
export TSAN_OPTIONS=log_path=$found/log:suppressions=$found/thread.suppressions
# Other drivers, which are only listed, leak in libraries that are unloaded by the end and so have no name to be forgiven by.
export OCL_ICD_VENDORS=/etc/OpenCL/vendors/pocl.icd
run_host_tests "$build" "$build/sanitizer-logs"

count=$(find "$found" -name 'log.*' | wc -l)
[ "$count" -eq 0 ] || head -25 "$found"/log.*
echo "$kind: $count processes with findings ($found), $failures failed tests"
exit $((count + failures > 0))
