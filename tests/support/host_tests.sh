# Sourced by sanitize.sh and coverage.sh: an instrumented build, and ctest's own list of tests in it. source_dir is the repository.

# Their time goes into kernels, which no instrument sees, or into more samples of the same host code; every 12th of them is run.
long_tests='^(opencl_truth|planted_bugs|scene_parity|parity_uniform|reference_truth|lanes):'
stride=${STRIDE:-12}

# configure_and_build BUILD_FOLDER OPTIONS...: clang's, whose instrumented code is made in half the time of GCC's. Counts of an earlier build go.
configure_and_build() {
  local build=$1
  shift
  mkdir -p "$build" || return
  # shellcheck disable=SC2086
  cmake -S "$source_dir" -B "$build" -G Ninja -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DSTOKES_BENCH=OFF -DSTOKES_PATIENCE=6 -DCMAKE_BUILD_TYPE=Debug \
    "-DCMAKE_CXX_FLAGS_DEBUG=-O1 -g1 -Wno-pass-failed" "$@" ${CMAKE_OPTIONS:-} > "$build/configure.txt" 2>&1 || {
    cat "$build/configure.txt"
    return 1
  }
  find "$build" -name '*.gcda' -delete
  ninja -C "$build" -j "${JOBS:-2}" --quiet
}

# numbers_of_tests BUILD_FOLDER: all but the long ones and a sample of those, as ctest -I wants them.
numbers_of_tests() {
  ctest --test-dir "$1" -N | awk -v long="$long_tests" -v stride="$stride" '
    $2 ~ /^#[0-9]+:/ { if ($3 !~ long || n++ % stride == 0) { gsub("[#:]", "", $2); list = list "," $2 } }
    END { print "0,0,0" list }'
}

# run_tests BUILD_FOLDER CTEST_ARGUMENTS...: those that are given, or else the sample.
run_tests() {
  local build=$1
  shift
  [ $# -gt 0 ] || set -- -I "$(numbers_of_tests "$build")"
  ctest --test-dir "$build" --parallel "${JOBS:-2}" --output-on-failure "$@"
}
