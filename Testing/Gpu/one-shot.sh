#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Everything that one call on a machine with a GPU can tell, most valuable first:
#   bash Testing/Gpu/one-shot.sh OUT [SECONDS]
# Needs build-gpu-carry/carry.tar.xz (pack.sh) and what a CUDA toolkit has; see README.md. What was
# carried and does not start there is built there. Every step has a limit of its own and stops nothing
# after it, but nothing follows where not even the smallest scene works. Output and figures are in
# OUT as they come, so that what is there is complete whenever this ends, and summary.md names the
# steps that did not end. OUT gets 8 files at most: summary.md Gpu.json Gpu.md tests.log
# benchmark.log profile.log sanitizers.log, and either build.log or one that is being written.

set -uo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
out="${1:?where to}"
total="${2:-520}" # seconds of all
reserve=8         # of these, for the last step to be killed and for the end
sizes=(256 304 472) effort=()
if [[ -n "${LIMPID_ONE_SHOT_REHEARSAL:-}" ]]; then # on a processor, see rehearse.py
  sizes=(24 28 32) effort=(--quick)
fi
work="$(mktemp -d)"
build="$root/build-gpu"
carried="$root/build-gpu-carry"
dependencies="$work/dependencies"
bin="$build/bin"
summary="$out/summary.md"
mkdir -p "$out" "$bin" "$dependencies"
PATH="$PATH:/usr/local/cuda/bin"

left() { echo $((total - reserve - SECONDS)); }
fail() { : > "$work/failed"; }
note() { echo "| $1 | $2 | $3 | $SECONDS |" >> "$summary"; echo "[$SECONDS s] $1: $2 ($3 s)"; }
began() { echo "| $1 | began, not finished | | $SECONDS |" >> "$summary"; }

# limited SECONDS COMMAND...
limited() {
  local limit="$1"
  shift
  ((limit > $(left))) && limit="$(left)"
  timeout --kill-after=5 "$limit" "$@" 2>&1 < /dev/null
}

# Adds what comes to the file LOG at once, up to an eighth of what it may still grow: a file comes
# back only if it is small, and no step may fill it.
keep() { # LOG
  local size rest
  size="$(stat -c %s "$1" 2> /dev/null || echo 0)"
  dd bs=65536 iflag=count_bytes count=$(((12000000 - size) / 8)) status=none >> "$1"
  rest="$(wc -c)"
  ((rest == 0)) || printf '\n(%s bytes more are left out)\n' "$rest" >> "$1"
}

# step NAME LIMIT LOG COMMAND...: what it printed is in $last.
step() {
  local name="$1" limit="$2" log="$out/$3" start=$SECONDS status
  last="$work/${name//[^a-zA-Z0-9_-]/_}"
  shift 3
  if (($(left) < 4)); then note "$name" "not run: no time was left" 0; fail; return 1; fi
  began "$name"
  printf '\n===== %s: %s\n' "$name" "$*" >> "$log"
  limited "$limit" "$@" | tee "$last" | keep "$log"
  status=${PIPESTATUS[0]}
  local word="done"
  ((status == 0)) || { word="FAILED, status $status"; fail; }
  ((status == 124 || status == 137)) && word="STOPPED after $((SECONDS - start)) s"
  word+="$(grep -ao '[0-9]* tests\? ran\|PASSED  \] [0-9]* tests\|[0-9]* FAILED TESTS\?\|\(ERROR\|RACECHECK\) SUMMARY.*' "$last" | sort -u | head -4 | sed 's/^/, /' | tr -d '\n')"
  note "$name" "$word" $((SECONDS - start))
  return "$status"
}

# --- 0: the machine -------------------------------------------------------------------------------
{
  printf '# One shot\n\n```\n'
  timeout 20 nvidia-smi --query-gpu=name,driver_version,memory.total,memory.free,compute_cap,clocks.sm,clocks.mem,clocks.max.sm,temperature.gpu,mig.mode.current --format=csv
  nvcc --version | tail -2; g++ --version | head -1; cmake --version | head -1; ninja --version
  ldd --version | head -1; uname -r; nproc; free -g | sed -n 2p; command -v ncu compute-sanitizer nsys python3
  printf '```\n\n| step | result | s | at |\n| --- | --- | ---: | ---: |\n'
} 2>&1 | tee "$summary"

# --- 1: programs ------------------------------------------------------------------------------------
core=(test_core_backends test_core_closed_form test_core_invariance test_core_modes
  test_core_stress test_core_input test_core_progressive test_core_renderer)
if [[ -f $carried/carry.tar.xz ]]; then
  began unpacked
  tar -xJf "$carried/carry.tar.xz" -C "$work" && cp -f "$work"/bin/* "$bin"
  status=$?
  programs=("$work"/bin/*)
  scenes=("$work"/scenes/*.scene.json)
  note unpacked "status $status, ${#programs[@]} programs, ${#scenes[@]} scenes" "$SECONDS"
fi
export LD_LIBRARY_PATH="$dependencies/usr/lib/x86_64-linux-gnu${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
background=0
finish() { # STATUS, once every step has ended
  ((background)) && kill -- "-$background" 2> /dev/null
  grep -v '| began, not finished | |' "$summary" > "$summary.part" && mv "$summary.part" "$summary"
  rm -rf "$work"
  exit "$1"
}
starts() { # PROGRAM: prints why not
  local option=--gtest_list_tests
  [[ $1 == limpid_bench_gpu ]] && option=--help
  timeout 20 "$bin/$1" "$option" 2>&1 > /dev/null | tail -1 | cut -c1-200 | tr '|' ' '
  return "${PIPESTATUS[0]}"
}
both_start() { starts limpid_bench_gpu && starts test_gpu; }
faulty=""
for program in limpid_bench_gpu test_gpu "${core[@]}"; do
  why="$(starts "$program")" || { faulty="$program does not start: $why"; break; }
done
if [[ -z $faulty ]]; then
  note programs "those that were carried" "$SECONDS"
else
  began "programs ($faulty)"
  rm -f "$bin"/* # else they could be taken for built ones
  LIMPID_GPU_DEPENDENCIES="$dependencies" setsid bash "$root/Testing/Gpu/build.sh" >> "$out/build.log" 2>&1 &
  background=$!
  while kill -0 "$background" 2> /dev/null && ((SECONDS < total / 2)) && ! both_start > /dev/null; do sleep 1; done
  if ! why="$(both_start)"; then
    note "programs ($faulty)" "FAILED: not built here, either ($why)" "$SECONDS"
    tail -20 "$out/build.log"
    finish 1
  fi
  note "programs ($faulty)" "built here, the core's tests go on" "$SECONDS"
fi
bench="$bin/limpid_bench_gpu"

# --- 2: does it run at all, and what does waiting cost ------------------------------------------------
if ! step smoke 25 benchmark.log "$bench" --quick --sizes 64 --scenes onion --output "$work/smoke.json"; then
  grep -v '^ *"' "$last" | tail -5
  step smoke_checked 60 sanitizers.log compute-sanitizer --tool memcheck --print-limit 5 "$bench" --quick --sizes 24 --scenes onion --output "$work/x.json"
  tail -40 "$last"
  finish 1
fi
grep -ao '"missing": .*' "$work/smoke.json" 2> /dev/null | sort | uniq -c | head -5
step latencies_built 30 benchmark.log nvcc -std=c++20 -O3 -arch=sm_90 -o "$work/run_latencies" "$root/Testing/Gpu/Latencies.cu" &&
  step latencies 20 benchmark.log "$work/run_latencies" && cat "$last"

# --- 3: figures, each scene and size in a process of its own -------------------------------------------
figures() { # NAME LIMIT OPTION...
  local name="$1" limit="$2"
  shift 2
  step "bench_$name" "$limit" benchmark.log "$bench" "${effort[@]}" "$@" --append --output "$out/Gpu.json"
  [[ -s $out/Gpu.json ]] || return
  python3 -B "$root/Testing/Benchmarks/pages/make.py" --pages gpu --no-plots "$out" >> "$out/benchmark.log" 2>&1 ||
    { note "page of $name" "FAILED" 0; fail; }
  python3 - "$out/Gpu.json" << 'PYTHON'
import json, sys
scene = json.load(open(sys.argv[1]))["scenes"][-1]
for key in ("policy", "adam", "frame"):
    figure = scene.get(key, {})
    print(scene.get("scene"), scene.get("nodes"), key, "%.3g ms" % (1e3 * figure["seconds"]) if "seconds" in figure else figure.get("missing"))
    for part in figure.get("parts", []):
        print("   %-16s %6.3g launches %8.3g ms %6.0f waits" % (part["label"], part["launches"], 1e3 * part["seconds"], part["waits"]))
print({k: "%.3g ms" % (1e3 * scene[k]["seconds"]) for k in scene if isinstance(scene[k], dict) and "seconds" in scene[k]}, scene.get("run_iterations"))
PYTHON
}
figures "onion-${sizes[0]}" 40 --scenes onion --sizes "${sizes[0]}"

# --- 4: is it right -----------------------------------------------------------------------------------
step tests 90 tests.log "$bin/test_gpu"; tested="$last" # alone: some tests take all memory that there is
# Those that were wrong, and those that ended their process, alone: one failure can spoil what follows.
{
  grep -ahoP '^\[  FAILED  \] \K[^ ,]+(?=.* ms\)$)' "$tested"
  grep -q '^\[==========\].*ran' "$tested" || grep -a '^\[ RUN ' "$tested" | tail -1 | cut -c14-
} | tr -d ',' | sort -u | head -6 > "$work/suspects"
while read -r name; do
  step "alone: $name" 20 tests.log "$bin/test_gpu" "--gtest_filter=$name"
done < "$work/suspects"

# --- 5: what limits the kernels --------------------------------------------------------------------------
if command -v ncu > /dev/null; then
  sections=()
  for section in SpeedOfLight SchedulerStats WarpStateStats InstructionStats MemoryWorkloadAnalysis LaunchStats Occupancy; do
    sections+=(--section "$section")
  done
  step profile 75 profile.log ncu --clock-control none "${sections[@]}" --filter-mode per-launch-config --launch-skip 2 --launch-count 1 \
    --kernel-name-base demangled --kernel-name 'regex:VisitTiles|GradientKernel|ScoreKernel|TransmittanceKernel|SumPhases|DrawnPixel|MovedNode' \
    "$bench" --quick --sizes "${sizes[0]}" --scenes onion --output "$work/profiled.json"
  grep -aE '^  [a-z].*\(.*\)|Duration|Memory Throughput|Compute \(SM\) Throughput|Executed Ipc Active|No Eligible|Achieved Occupancy|Stall' "$last" | cut -c1-110 | head -70
else
  note profile "not run: there is no ncu" 0
fi

# --- 6: more figures ------------------------------------------------------------------------------------
figures "waves-${sizes[0]}" 30 --scenes waves --sizes "${sizes[0]}"
for file in "$work"/scenes/*.scene.json; do
  name="$(basename "$file" .scene.json)"
  [[ -f $file ]] && figures "$name" 25 --files "$file"
done
figures "onion-${sizes[2]}" 40 --scenes onion --sizes "${sizes[2]}"
figures "along-x-${sizes[0]}" 30 --scenes onion --sizes "${sizes[0]}" --along-x
figures "dense-${sizes[0]}" 30 --scenes dense --sizes "${sizes[0]}"
figures "dense-${sizes[2]}" 45 --scenes dense --sizes "${sizes[2]}"
figures "onion-${sizes[1]}" 30 --scenes onion --sizes "${sizes[1]}"

# --- 7: the core's tests, the sanitizers ------------------------------------------------------------------
if ((background)); then
  while kill -0 "$background" 2> /dev/null && (($(left) > 60)); do sleep 1; done
fi
core_test() { # PROGRAM
  [[ -x $bin/$1 ]] || { note "$1" "not run: it was not built" 0; fail; return; }
  (($(left) >= 4)) || { note "$1" "not run: no time was left" 0; fail; return; }
  local start=$SECONDS status
  began "$1"
  OMP_NUM_THREADS=4 limited 75 "$bin/$1" | tee "$work/$1" | sed -u "s/^/$1: /" | keep "$out/tests.log"
  status=${PIPESTATUS[0]}
  note "$1" "status $status, $(grep -c '^\[       OK' "$work/$1") right, wrong:$(grep -ahoP '^\[  FAILED  \] \K[^ ,]+(?=.* ms\)$)' "$work/$1" | head -8 | sed 's/^/ /' | tr -d '\n,')" $((SECONDS - start))
  ((status == 0)) || fail
}
core_pids=()
for program in "${core[@]}"; do
  core_test "$program" &
  core_pids+=($!)
done
wait "${core_pids[@]}"
while read -r name; do
  step "memcheck: $name" 30 sanitizers.log compute-sanitizer --print-limit 3 "$bin/test_gpu" "--gtest_filter=$name"
done < "$work/suspects"
checked='Device.*:CudaDevice.Runs*:CudaDevice.Works*:*LeavesNothingBehind*:AdamOfDevice.*:BackendOfDevice.*'
checked+=':*PolicyOfDevice*/Outside:*PolicyOfDevice*/Inside:*PolicyOfDevice*/AlongX:*TransmittanceOfDevice.IsThatOfTheProcessor/Point*:*Picture*/LitAndChanged'
step memcheck 50 sanitizers.log compute-sanitizer --tool memcheck --error-exitcode 9 --print-limit 10 --track-stream-ordered-races all "$bin/test_gpu" "--gtest_filter=$checked"
step initcheck 35 sanitizers.log compute-sanitizer --tool initcheck --error-exitcode 9 --print-limit 10 "$bin/test_gpu" "--gtest_filter=$checked"
step synccheck 30 sanitizers.log compute-sanitizer --tool synccheck --error-exitcode 9 --print-limit 10 "$bin/test_gpu" "--gtest_filter=$checked"

# --- what came out ---------------------------------------------------------------------------------------
timeout 3 nvidia-smi --query-gpu=clocks.sm,clocks.mem,temperature.gpu,power.draw --format=csv,noheader >> "$summary" 2>&1
rm -f "$out"/*.part # of a benchmark that was stopped
[[ -f $out/Gpu.md ]] && awk '/^## / { ++section } section < 2' "$out/Gpu.md"
cat "$summary"
failed=0
[[ -e $work/failed ]] && failed=1
finish "$failed"
