# Sourced by sanitize.sh and coverage.sh: an instrumented build, and ctest's own list of tests in it. source_dir is the repository.

# Their time goes into kernels, which no instrument sees, or into more samples of the same host code; every 12th of them is run.
long_tests='^(opencl_truth|planted_bugs|scene_parity|parity_uniform|reference_truth|lanes):'
stride=${STRIDE:-12}

# configure_and_build BUILD_FOLDER OPTIONS...: clang's, whose instrumented code is made in half the time of GCC's.
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
  ninja -C "$build" -j "${JOBS:-2}" --quiet
}

# run_tests BUILD_FOLDER CTEST_ARGUMENTS...: those that are given, or else all but the long ones and a sample of those.
run_tests() {
  local ctest="ctest --test-dir $1 --parallel ${JOBS:-2} --output-on-failure"
  shift
  if [ $# -gt 0 ]; then
    $ctest "$@"
  else
    local status=0
    $ctest -E "$long_tests" || status=$?
    $ctest -R "$long_tests" -I "1,,$stride" || status=$?
    return $status
  fi
}
