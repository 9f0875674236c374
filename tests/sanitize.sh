#!/bin/bash
# Builds with sanitizers in a folder of its own and runs the tests there.
# Usage: tests/sanitize.sh address|thread [BUILD_FOLDER [CTEST_ARGUMENTS...]]     (default: build-address, build-thread, and all tests but most of
#   those that support/host_tests.sh calls long; JOBS=2, STRIDE=1 for every long one, CMAKE_OPTIONS for more options)
#   address: AddressSanitizer, LeakSanitizer, UndefinedBehaviorSanitizer; thread: ThreadSanitizer.
# With CMAKE_OPTIONS=-DSTOKES_COVERAGE=ON, `coverage.sh BUILD_FOLDER --report` then says which lines that run executed.
# What they find is read from their logs, because a process may end well in spite of it; support/sanitizers.txt says what is forgiven to libraries.
set -u
source_dir=$(cd "$(dirname "$0")/.." && pwd)
kind=${1:-}
case $kind in
  address) sanitizers=address,undefined ;;
  thread) sanitizers=thread ;;
  *)
    echo "usage: $0 address|thread [BUILD_FOLDER [CTEST_ARGUMENTS...]]" >&2
    exit 64
    ;;
esac
build=${2:-$source_dir/build-$kind}
shift $(($# < 2 ? $# : 2))
. "$source_dir/tests/support/host_tests.sh"

configure_and_build "$build" -DSTOKES_SANITIZE=$sanitizers || exit 1

found=$build/sanitizer-findings
rm -rf "$found"
mkdir "$found"
for which in leak thread; do sed -n "s/^$which: *//p" "$source_dir/tests/support/sanitizers.txt" > "$found/$which.suppressions"; done
# A library that is preloaded (opencl_faults) may come before the sanitizer's own; its crashes are the supervisor's to see. clang 14's tracking of
# thread-local storage in loaded libraries takes wrong addresses from glibc 2.36, on which LeakSanitizer dies.
export ASAN_OPTIONS=log_path=$found/log:verify_asan_link_order=0:handle_segv=0:handle_sigbus=0:intercept_tls_get_addr=0
export UBSAN_OPTIONS=print_stacktrace=1:log_path=$found/log
export LSAN_OPTIONS=suppressions=$found/leak.suppressions:print_suppressions=0
export TSAN_OPTIONS=log_path=$found/log:suppressions=$found/thread.suppressions:ignore_noninstrumented_modules=1:handle_segv=0:handle_sigbus=0
# Other drivers, which are only listed, leak in libraries that are unloaded by the end and so have no name to be forgiven by.
export OCL_ICD_VENDORS=/etc/OpenCL/vendors/pocl.icd
run_tests "$build" "$@"
status=$?

count=$(find "$found" -name 'log.*' | wc -l)
[ "$count" -eq 0 ] || head -25 "$found"/log.*
echo "$kind: $count processes with findings ($found), ctest's exit code $status"
exit $((count + status > 0))
