#!/usr/bin/env bash
# Builds the fuzz targets with clang and runs each for some seconds, from its corpus:
#   tests/fuzz/run.sh [SECONDS [BUILD_FOLDER [TARGET..]]]
# What crashes, takes a second or a gigabyte is left in BUILD_FOLDER/found, and the exit status is 1.
set -euo pipefail

seconds=${1:-20}
root=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/../.." && pwd -P)
build=${2:-$root/build-fuzz}
targets=("${@:3}")
[[ ${#targets[@]} -gt 0 ]] || targets=(case_file expression command_line)

# A folder that is configured already keeps its flags.
if [[ ! -f $build/build.ninja ]]; then
  launcher=()
  if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
  cmake -S "$root" -B "$build" -G Ninja -DCASIMIR_FUZZ=ON -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS_RELEASE="-O1 -gline-tables-only" -DCMAKE_CXX_COMPILER=clang++ \
    "${launcher[@]}" >"$build.log" 2>&1 || { cat "$build.log"; exit 4; }
fi
ninja -C "$build" "${targets[@]/#/fuzz_}" >>"$build.log" 2>&1 || { tail -n 60 "$build.log"; exit 4; }

mkdir -p "$build/found"
"$root/tests/fuzz/pack.sh" unpack "$build/kept"
# Memory that GiNaC and FLINT keep for later is no leak.
export ASAN_OPTIONS=detect_leaks=0:quarantine_size_mb=4:malloc_context_size=3:max_malloc_fill_size=0
export LLVM_PROFILE_FILE=/dev/null  # where the build counts for coverage
failed=0
for target in "${targets[@]}"; do
  dictionary=()
  if [[ -f $root/tests/fuzz/$target.dict ]]; then dictionary=("-dict=$root/tests/fuzz/$target.dict"); fi
  mkdir -p "$build/corpus/$target"
  log=$build/$target.log
  if "$build/tests/fuzz/fuzz_$target" -max_total_time="$seconds" -max_len=400 -timeout=20 -report_slow_units=1 \
      -rss_limit_mb=1024 -print_final_stats=1 -detect_leaks=0 -artifact_prefix="$build/found/$target-" \
      "${dictionary[@]}" "$build/corpus/$target" "$build/kept/corpus/$target" >"$log" 2>&1; then
    printf '%-14s %s runs\n' "$target" "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")"
  else
    failed=1
    tail -n 60 "$log"
    printf '%-14s FAILED: the input is in %s\n' "$target" "$build/found"
  fi
done
exit "$failed"
