#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# On a machine with a GPU, in less than eight minutes: builds the core without VTK, runs the tests
# of the CUDA backend on the GPU, repeats some of them under compute-sanitizer, and measures.
#   bash Testing/Gpu/run.sh [--out FOLDER] [--build-only]
# FOLDER (build-gpu/results) gets summary.md, Gpu.json, logs and, where there is a python3, Gpu.md.
# --build-only needs no GPU. Needs nvcc and CMake. GLM, oneTBB, GoogleTest and nlohmann-json may lie in
# build-gpu-dependencies, where collect-dependencies.sh puts them, or where LIMPID_GPU_DEPENDENCIES
# says. Fails if a step fails; what could not be run is in the summary with the reason.

set -uo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
build="$root/build-gpu"
out="$build/results"
dependencies="${LIMPID_GPU_DEPENDENCIES:-$root/build-gpu-dependencies}"
build_only=0
while (($# > 0)); do
  case "$1" in
    --out) out="${2:?--out needs a folder}"; shift ;;
    --build-only) build_only=1 ;;
    *) echo "The argument $1 is not understood. Give --out FOLDER or --build-only." >&2; exit 1 ;;
  esac
  shift
done

total_seconds=465
reserve=0 # of these, for the steps to come
# With the backend Auto these compute on the GPU; without one they are the processor's tests.
core_tests=(test_core_backends test_core_closed_form test_core_invariance test_core_modes
  test_core_stress test_core_input test_core_progressive test_core_renderer)
# One of everything that launches, and what makes or frees memory.
sanitized='Device.*:CudaDevice.Runs*:CudaDevice.Works*:CudaDevice.Gives*:*LeavesNothingBehind*'
sanitized+=':AdamOfDevice.*:BackendOfDevice.*:*ViewsOfDevice*/Onion:*ViewsOfDevice*/ParallelWaves'
sanitized+=':*PolicyOfDevice*/Outside:*PolicyOfDevice*/Inside:*PolicyOfDevice*/InView'
sanitized+=':*TransmittanceOfDevice.IsThatOfTheProcessor/Point*:*Renderer*:*Picture*'

mkdir -p "$build" "$out"
out="$(cd "$out" && pwd)"
summary="$out/summary.md"
failed=0

note() { # STEP RESULT SECONDS
  echo "| $1 | $2 | $3 |" >> "$summary"
  echo "$1: $2 ($3 s)"
}

give_up() { # MESSAGE
  note "$1" "" "$SECONDS"
  echo "$1" >&2
  exit 1
}

# step NAME LIMIT LOG WORDS COMMAND...: runs a command within its own time and that of the whole.
# WORDS turns the log of a success into the result in the table.
step() {
  local name="$1" limit="$2" log="$out/$3" words="$4" own="$build/step.log" start=$SECONDS
  local status result
  shift 4
  if ((limit > total_seconds - reserve - SECONDS)); then
    limit=$((total_seconds - reserve - SECONDS))
  fi
  if ((limit < 3)); then
    note "$name" "not run: no time was left" 0
    failed=1
    return
  fi
  timeout --kill-after=5 "$limit" "$@" > "$own" 2>&1
  status=$?
  { printf '\n===== %s: %s\n' "$name" "$*"; cat "$own"; } >> "$log"
  if ((status == 0)); then
    result="$("$words" "$own")"
  else
    failed=1
    result="FAILED, status $status"
    if ((status == 124 || status == 137)); then
      result="FAILED: stopped after $limit s"
    fi
    result+="$(grep -ao '\(ERROR\|RACECHECK\) SUMMARY.*' "$own" | tail -1 | sed 's/^/, /')"
    result+="$(grep -a '^\[  FAILED  \] [^ ]*\.' "$own" | sed 's/^\[  FAILED  \] /, /; s/ (.*//' | sort -u | head -12 | tr -d '\n')"
  fi
  note "$name" "$result" "$((SECONDS - start))"
}

say_done() { echo "done"; }

say_built() { echo "done, $(grep -c 'warning' "$1") warnings"; }

say_tests() {
  if grep -q 'SKIPPED \] all tests' "$1"; then
    echo "all skipped"
    return
  fi
  sed -n 's/^\[  \(PASSED\|SKIPPED\) *\] \([0-9]*\) tests\?[.,].*/\2 \L\1/p' "$1" |
    paste -sd , | sed 's/,/, /'
}

say_findings() { # the tool's own last line, then the tests
  echo "$(grep -ao '\(ERROR\|RACECHECK\) SUMMARY.*' "$1" | tail -1), $(say_tests "$1")"
}

say_figures() { # milliseconds of the first figure of each step, scene by scene
  sed -n 's/^   "\(scene\|nodes\)": "\?\([^",]*\).*/\2/p
    s/^   "\([a-z_]*\)": {$/\1/p; s/^    "seconds": \([^,]*\),$/= \1/p' "$out/Gpu.json" |
    awk '$1 == "=" { printf " %s %.3g ms,", step, 1000 * $2; next }
      $1 ~ /^(onion|dense)$/ { printf "; %s", $1; next }
      $1 ~ /^[0-9]+$/ { printf " %s:", $1; next } { step = $1 }' | sed 's/^; //; s/,\(;\|$\)/\1/g'
}

# program_step NAME LIMIT LOG WORDS PROGRAM ARGUMENT...: step, if there is such a program.
program_step() {
  if [[ -x "$build/bin/$5" ]]; then
    step "$1" "$2" "$3" "$4" "${launcher[@]}" "$build/bin/$5" "${@:6}"
  else
    note "$1" "not run: $5 was not built" 0
    failed=1
  fi
}

printf '# GPU run\n\n| step | result | s |\n| --- | --- | ---: |\n' > "$summary"
rm -f "$out"/{build,tests,sanitizers,benchmark,profile}.log "$out"/Gpu.{md,json}
launcher=()

# --- what there is -----------------------------------------------------------------------------

for place in /usr/local/cuda/bin /opt/cuda/bin; do
  if ! command -v nvcc > /dev/null && [[ -x "$place/nvcc" ]]; then
    PATH="$place:$PATH"
  fi
done
command -v nvcc > /dev/null || give_up "There is no nvcc (the CUDA backend cannot be compiled). Install the CUDA toolkit or add it to PATH."
command -v cmake > /dev/null || give_up "There is no cmake (nothing can be built). Install it or add it to PATH."

architecture="$(nvidia-smi --query-gpu=compute_cap --format=csv,noheader 2> /dev/null | head -1 | tr -dc 0-9)"
if [[ -z "$architecture" ]]; then # not on PATH, perhaps: the CUDA toolkit may know
  architecture="$(__nvcc_device_query 2> /dev/null | cut -d, -f1 | tr -dc 0-9)"
fi
if [[ -z "$architecture" ]]; then
  ((build_only)) || give_up "There is no GPU, or neither nvidia-smi nor the CUDA toolkit sees it (there is nothing to run on). Run this where there is one, or give --build-only."
  architecture=90
fi
gpu="$(nvidia-smi --query-gpu=name,driver_version,memory.total --format=csv,noheader 2> /dev/null | head -1)"
note "machine" "${gpu:-no GPU}, nvcc $(nvcc --version | sed -n 's/.*release \([0-9.]*\).*/\1/p'), $(nproc) cores, sm_$architecture" 0

# --- build ---------------------------------------------------------------------------------------

# The compiler here may be another than the developers': its warnings do not stop this run.
configuration=(-S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DLIMPID_ENABLE_VTK=OFF
  -DLIMPID_ENABLE_CUDA=ON -DLIMPID_BUILD_TESTING=ON -DLIMPID_WARNINGS_AS_ERRORS=OFF
  "-DCMAKE_CUDA_ARCHITECTURES=$architecture" "-DCMAKE_CUDA_COMPILER=$(command -v nvcc)")
if command -v ninja > /dev/null && [[ ! -f "$build/CMakeCache.txt" ]]; then
  configuration+=(-G Ninja)
fi
if [[ -d "$dependencies" ]]; then
  for package in glm GTest TBB nlohmann_json; do
    file="$(find "$dependencies" -name "${package}Config.cmake" | head -1)"
    configuration+=("-D${package}_DIR=$(dirname "$file")")
  done
fi
targets=(test_gpu limpid_bench_gpu "${core_tests[@]}")
step "configure" 60 build.log say_done cmake "${configuration[@]}"
if ((failed)); then
  grep -v '^--' "$build/step.log" | head -40
  give_up "CMake cannot configure the core (see above). If GLM, oneTBB, GoogleTest or nlohmann-json is missing here, run Testing/Gpu/collect-dependencies.sh on a Debian machine that has them and bring build-gpu-dependencies along."
fi
keep_going=(-- -k)
if grep -q 'CMAKE_GENERATOR:INTERNAL=Ninja' "$build/CMakeCache.txt" 2> /dev/null; then
  keep_going=(-- -k 0)
fi
build_limit=200
if ((build_only)); then
  total_seconds=86400
  build_limit=86400
fi
step "build" "$build_limit" build.log say_built \
  cmake --build "$build" --parallel "$(nproc)" --target "${targets[@]}" "${keep_going[@]}"
if ((build_only)); then
  tail -25 "$build/step.log"
  exit "$failed"
fi
if ((failed)); then
  grep -aE -A3 'error|Error|FAILED' "$out/build.log" | head -60
fi

# --- tests, benchmark, sanitizers ----------------------------------------------------------------

reserve=190
program_step "devices" 60 tests.log say_tests test_gpu
if grep -q 'SKIPPED \] all tests' "$build/step.log"; then
  give_up "The GPU cannot be used: $(grep -A1 ': Skipped$' "$build/step.log" | sed -n 2p). Nothing was tested."
fi

# What matters most comes first: the time may not be enough for all.
reserve=60
program_step "benchmark" 150 benchmark.log say_figures limpid_bench_gpu --output "$out/Gpu.json"

reserve=40
for program in "${core_tests[@]}"; do
  program_step "${program#test_core_}" 40 tests.log say_tests "$program"
done

# Not racecheck, which sees shared memory alone: test_gpu repeats a run 50 times, bit by bit.
reserve=20
for tool in memcheck synccheck initcheck; do
  if ! command -v compute-sanitizer > /dev/null; then
    note "$tool" "not run: there is no compute-sanitizer" 0
    continue
  fi
  launcher=(compute-sanitizer --tool "$tool" --error-exitcode 9 --print-limit 10)
  if [[ $tool == memcheck ]]; then
    launcher+=(--leak-check full --track-stream-ordered-races all)
  fi
  program_step "$tool" 45 sanitizers.log say_findings test_gpu "--gtest_filter=$sanitized"
done
launcher=()
reserve=0

# The page, and sweeps by the hardware's own counters; nothing depends on them.
before=$failed
if [[ -f "$out/Gpu.json" ]] && command -v python3 > /dev/null; then
  step "page" 20 benchmark.log say_done \
    python3 -B "$root/Testing/Benchmarks/pages/make.py" --pages gpu --no-plots "$out"
  failed=$before
fi
if command -v ncu > /dev/null && ((total_seconds - SECONDS > 20)); then
  launcher=(ncu --clock-control none --section SpeedOfLight --section MemoryWorkloadAnalysis
    --section LaunchStats --section Occupancy --kernel-name "regex:VisitEach|VisitPhases"
    --launch-skip 200 --launch-count 24)
  program_step "profile" 60 profile.log say_done \
    limpid_bench_gpu --quick --sizes 256 --scenes onion
  failed=$before
else
  note "profile" "not run: there is no ncu, or no time was left" 0
fi

# --- what came out -------------------------------------------------------------------------------

grep -ahE -B12 '^\[  FAILED  \] [^ ]*\..* \(' "$out/tests.log" | head -80
grep -ah '^=========' "$out/sanitizers.log" | grep -v 'COMPUTE-SANITIZER\|SUMMARY: 0' | head -40
if [[ -f "$out/Gpu.md" ]]; then
  awk '/^## / { ++section } section < 3' "$out/Gpu.md" # the bars and the first scene
else
  echo "There is no page: see the step \"benchmark\". With Gpu.json, Testing/Benchmarks/pages/make.py" \
    "makes it anywhere."
fi
echo
cat "$summary"
echo "$SECONDS s in all"
exit "$failed"
