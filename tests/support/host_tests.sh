# Sourced by sanitize.sh and coverage.sh: builds and runs the tests that reach host code, each binary in one process. source_dir is the repository.
# TESTS and SCRIPTS choose some of them; with an empty SCRIPTS the program itself is not built.

host_tests=${TESTS-"test_spectral test_image test_mesh test_scene test_compiled test_device test_view test_cli_view test_reference_film test_reference_samplers
  test_reference_truth"}
host_scripts=${SCRIPTS-"exit_codes outputs merge new import resume status tools resume_opencl device_faults"}
failures=0

# configure_and_build BUILD_FOLDER OPTIONS...
configure_and_build() {
  local build=$1
  shift
  mkdir -p "$build" || return
  cmake -S "$source_dir" -B "$build" -G Ninja -DSTOKES_BENCH=OFF -DCMAKE_BUILD_TYPE=Debug "$@" > "$build/configure.txt" 2>&1 || {
    cat "$build/configure.txt"
    return 1
  }
  # shellcheck disable=SC2086
  ninja -C "$build" -j "${JOBS:-2}" --quiet ${host_scripts:+stokes opencl_faults} $host_tests
}

# run NAME COMMAND...: its output is shown where it fails, its time always; $logs holds the rest.
run() {
  local name=$1 begin=$SECONDS verdict=passed
  shift
  "$@" > "$logs/$name.txt" 2>&1 || {
    verdict=FAILED
    failures=$((failures + 1))
    tail -30 "$logs/$name.txt"
  }
  echo "$name: $verdict, $((SECONDS - begin)) s"
}

# run_host_tests BUILD_FOLDER LOG_FOLDER
run_host_tests() {
  local build=$1 test script
  logs=$2
  mkdir -p "$logs"
  for test in $host_tests; do run "$test" "$(find "$build/tests" -name "$test" -type f)" --gtest_brief=1; done
  for script in $host_scripts; do
    case $script in
      resume_opencl) run "$script" sh "$source_dir/tests/cli/resume.sh" "$build/stokes" auto ;;
      device_faults) run "$script" sh "$source_dir/tests/faults/device_faults.sh" "$build/stokes" "$build/tests/faults/opencl_faults.so" ;;
      *) run "$script" sh "$source_dir/tests/cli/$script.sh" "$build/stokes" ;;
    esac
  done
}
