#!/bin/sh
# Builds the fuzz targets with clang's libFuzzer, AddressSanitizer and UndefinedBehaviorSanitizer, and runs each that often:
#   tests/fuzz/fuzz.sh [RUNS [TARGET...]]      (1000000 of each; the build folder is build-fuzz)
# A finding is left in the build folder as crash-*, and its target's log ends with the report. Exit code 1.
set -u
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
runs=${1:-1000000}
[ $# -gt 0 ] && shift
targets=${*:-scene obj spectrum checkpoint part mitsuba pbrt ply foreign_obj}
build=$root/build-fuzz
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo -DSTOKES_FUZZ=ON -DSTOKES_BENCH=OFF \
  -DSTOKES_SANITIZE='fuzzer-no-link,address,undefined,float-cast-overflow' -DCMAKE_CXX_FLAGS=-fno-sanitize-recover=all >"$build.log" 2>&1 || { cat "$build.log"; exit 1; }
# shellcheck disable=SC2046
ninja -C "$build" --quiet $(printf 'fuzz_%s ' $targets) || exit 1
cd "$build" || exit 1
failures=0
for target in $targets; do
  case $target in
    scene) seeds=$root/scenes limits='-max_len=4096' ;;
    obj) seeds=$root/scenes/meshes limits='-max_len=1024' ;;
    spectrum) seeds=$root/scenes/spectra limits='-max_len=1024' ;;
    foreign_obj) seeds=$root/tests/fuzz/corpus/obj limits='-max_len=1024' ;;
    mitsuba | pbrt | ply) seeds=$root/tests/cli/import limits='-max_len=4096' ;;
    *) seeds='' limits='-max_len=2048' ;;
  esac
  mkdir -p "corpus-$target"
  # Only files of a seed folder itself: libFuzzer would walk into pictures and meshes.
  mkdir -p "seeds-$target"
  find "$root/tests/fuzz/corpus/$target" ${seeds:+"$seeds"} -maxdepth 1 -type f -exec cp {} "seeds-$target" \;
  dictionary=$root/tests/fuzz/$target.dict
  # shellcheck disable=SC2086
  if "$(find . -name "fuzz_$target" -type f | head -n 1)" -runs="$runs" -seed=1 -timeout=10 -rss_limit_mb=1024 $limits -print_final_stats=1 \
    $([ -f "$dictionary" ] && printf -- '-dict=%s' "$dictionary") "corpus-$target" "seeds-$target" >"$target.log" 2>&1; then
    printf '%s: %s\n' "$target" "$(grep -E 'stat::number_of_executed_units|^Done' "$target.log" | tr '\n' ' ')"
  else
    printf '%s: FAILED\n' "$target"
    tail -n 40 "$target.log"
    failures=1
  fi
done
exit $failures
