#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Everything that one call on a machine with a GPU can tell, most valuable first:
#   bash Testing/Gpu/one-shot.sh OUT [SECONDS]
# Programs, libraries and scenes are made before, elsewhere, by pack.sh, which fills build-gpu-carry/; what
# of them does not run there is built there. Every step has its own limit, writes its result at once, and
# stops nothing after it, but nothing follows where not even the smallest scene works. OUT gets 8 files at
# most: summary.md Gpu.json Gpu.md build.log tests.log benchmark.log profile.log sanitizers.log.

set -uo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
out="${1:?where to}"
total="${2:-520}" # seconds of all
work="$(mktemp -d)"
build="$root/build-gpu"
carried="$root/build-gpu-carry"
dependencies="$work/dependencies"
bin="$build/bin"
summary="$out/summary.md"
failed=0
mkdir -p "$out" "$build" "$dependencies"
[[ -f $carried/carry.tar.xz ]] && tar -xJf "$carried/carry.tar.xz" -C "$work" && mkdir -p "$bin" && cp -f "$work"/bin/* "$bin"
export LD_LIBRARY_PATH="$dependencies/usr/lib/x86_64-linux-gnu${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
PATH="$PATH:/usr/local/cuda/bin"
printf '# One shot\n\n| step | result | s | at |\n| --- | --- | ---: | ---: |\n' > "$summary"

note() { echo "| $1 | $2 | $3 | $SECONDS |" >> "$summary"; echo "[$SECONDS s] $1: $2 ($3 s)"; }

# step NAME LIMIT LOG COMMAND...: what it printed is in $last.
step() {
  local name="$1" limit="$2" log="$out/$3" start=$SECONDS status
  last="$work/${name//[^a-zA-Z0-9_-]/_}"
  shift 3
  ((limit > total - SECONDS)) && limit=$((total - SECONDS))
  if ((limit < 4)); then note "$name" "not run: no time was left" 0; failed=1; return 1; fi
  timeout --kill-after=5 "$limit" "$@" > "$last" 2>&1
  status=$?
  { printf '\n===== %s: %s\n' "$name" "$*"; cat "$last"; } >> "$log"
  local word="done"
  ((status == 0)) || { word="FAILED, status $status"; failed=1; }
  ((status == 124 || status == 137)) && word="STOPPED after $limit s"
  word+="$(grep -ao '[0-9]* tests\? ran\|PASSED  \] [0-9]* tests\|[0-9]* FAILED TESTS\?\|\(ERROR\|RACECHECK\) SUMMARY.*' "$last" | sort -u | head -4 | sed 's/^/, /' | tr -d '\n')"
  note "$name" "$word" $((SECONDS - start))
  return "$status"
}

# --- 0: the machine -------------------------------------------------------------------------------
{
  echo; echo '```'
  nvidia-smi --query-gpu=name,driver_version,memory.total,memory.free,compute_cap,clocks.sm,clocks.mem,clocks.max.sm,temperature.gpu,mig.mode.current --format=csv 2>&1
  nvcc --version 2>&1 | tail -2; g++ --version 2>&1 | head -1; cmake --version 2>&1 | head -1; ninja --version 2>&1
  ldd --version 2>&1 | head -1; uname -r; nproc; free -g | sed -n 2p; command -v ncu compute-sanitizer nsys python3
  echo '```'; echo
} > "$work/machine" 2>&1
cat "$work/machine"

# --- 1: programs ------------------------------------------------------------------------------------
core=(test_core_backends test_core_closed_form test_core_invariance test_core_modes
  test_core_stress test_core_input test_core_progressive test_core_renderer)
background=0
usable() { "$bin/$1" "${@:2}" > /dev/null 2>&1; }
if usable test_gpu --gtest_list_tests && [[ -x $bin/limpid_bench_gpu ]] && ! ldd "$bin/limpid_bench_gpu" | grep -q 'not found'; then
  note programs "those that were carried" 0
else
  LIMPID_GPU_DEPENDENCIES="$dependencies" setsid bash "$root/Testing/Gpu/build.sh" > "$work/built" 2>&1 &
  background=$!
  while kill -0 "$background" 2> /dev/null && ! [[ -x $bin/test_gpu && -x $bin/limpid_bench_gpu ]] && ((SECONDS < 240)); do sleep 1; done
  note programs "built here, the core's tests go on" "$SECONDS"
fi
bench="$bin/limpid_bench_gpu"

# --- 2: does it run at all, and what does waiting cost ------------------------------------------------
if ! step smoke 25 benchmark.log "$bench" --quick --sizes 64 --scenes onion --output "$work/smoke.json"; then
  grep -v '^ *"' "$last" | tail -5
  step smoke_checked 60 sanitizers.log compute-sanitizer --tool memcheck --print-limit 5 "$bench" --quick --sizes 24 --scenes onion --output "$work/x.json"
  tail -40 "$last"
  rm -rf "$work"
  exit 1
fi
grep -ao '"missing": .*' "$work/smoke.json" 2> /dev/null | sort | uniq -c | head -5
if [[ -f $root/Testing/Gpu/Latencies.cu ]]; then
  step latencies_built 30 build.log nvcc -std=c++20 -O3 -arch=sm_90 -o "$work/run_latencies" "$root/Testing/Gpu/Latencies.cu"
  step latencies 20 benchmark.log "$work/run_latencies" && cat "$last"
fi

# --- 3: figures, each scene and size in a process of its own -------------------------------------------
figures() { # NAME LIMIT OPTION...
  local name="$1" limit="$2"
  shift 2
  step "bench_$name" "$limit" benchmark.log "$bench" "$@" --output "$work/figures-$name.json"
  python3 - "$out/Gpu.json" "$work/figures-$name.json" "$work"/figures-*.json << 'PYTHON'
import json, sys
merged = None
def read(name):
    try:
        return json.load(open(name))
    except (OSError, ValueError):
        return {"scenes": []}
for one in map(read, sys.argv[3:]):
    if not one["scenes"]:
        continue
    if merged is None:
        merged = one
    else:
        merged["scenes"] += one["scenes"]
if merged:
    json.dump(merged, open(sys.argv[1], "w"), indent=1)
for scene in read(sys.argv[2])["scenes"]:
    for key in ("policy", "adam", "frame"):
        figure = scene.get(key, {})
        print(scene.get("scene"), scene.get("nodes"), key, "%.3g ms" % (1e3 * figure["seconds"]) if "seconds" in figure else figure.get("missing"))
        for part in figure.get("parts", []):
            print("   %-16s %6.3g launches %8.3g ms %6.0f waits" % (part["label"], part["launches"], 1e3 * part["seconds"], part["waits"]))
    print({k: "%.3g ms" % (1e3 * scene[k]["seconds"]) for k in scene if isinstance(scene[k], dict) and "seconds" in scene[k]}, scene.get("run_iterations"))
PYTHON
}
figures onion-256 40 --scenes onion --sizes 256

# --- 4: is it right -----------------------------------------------------------------------------------
step tests 90 tests.log "$bin/test_gpu"; tested="$last" # alone: some tests take all memory that there is
# Those that were wrong, and those that ended their process, alone: one failure can spoil what follows.
{
  grep -ahoP '^\[  FAILED  \] \K[^ ,]+(?=.* ms\)$)' "$tested"
  grep -q '^\[==========\].*ran' "$tested" || grep -a '^\[ RUN ' "$tested" | tail -1 | cut -c14-
} | tr -d ',' | sort -u | head -6 > "$work/suspects"
while read -r name; do
  step "alone: $name" 20 tests.log "$bin/test_gpu" "--gtest_filter=$name"
  step "memcheck: $name" 30 sanitizers.log compute-sanitizer --print-limit 3 "$bin/test_gpu" "--gtest_filter=$name"
done < "$work/suspects"

# --- 5: what limits the kernels --------------------------------------------------------------------------
if command -v ncu > /dev/null; then
  sections=()
  for section in SpeedOfLight SchedulerStats WarpStateStats InstructionStats MemoryWorkloadAnalysis LaunchStats Occupancy; do
    sections+=(--section "$section")
  done
  step profile 75 profile.log ncu --clock-control none "${sections[@]}" --filter-mode per-launch-config --launch-skip 2 --launch-count 1 \
    --kernel-name-base demangled --kernel-name 'regex:VisitTiles|GradientKernel|ScoreKernel|TransmittanceKernel|SumPhases|DrawnPixel|MovedNode' \
    "$bench" --quick --sizes 256 --scenes onion --output "$work/profiled.json"
  grep -aE '^  [a-z].*\(.*\)|Duration|Memory Throughput|Compute \(SM\) Throughput|Executed Ipc Active|No Eligible|Achieved Occupancy|Stall' "$last" | cut -c1-110 | head -70
else
  note profile "not run: there is no ncu" 0
fi

# --- 6: more figures ------------------------------------------------------------------------------------
figures waves-256 30 --scenes waves --sizes 256
for file in "$work"/scenes/*.scene.json; do
  name="$(basename "$file" .scene.json)"
  [[ -f $file ]] && figures "$name" 25 --files "$file"
done
figures onion-472 40 --scenes onion --sizes 472
figures along-x-256 30 --scenes onion --sizes 256 --along-x
figures dense-256 30 --scenes dense --sizes 256
figures dense-472 45 --scenes dense --sizes 472
figures onion-304 30 --scenes onion --sizes 304
[[ -f $out/Gpu.json ]] && step page 15 benchmark.log python3 -B "$root/Testing/Benchmarks/pages/make.py" --pages gpu --no-plots "$out"

# --- 7: the core's tests, the sanitizers ------------------------------------------------------------------
if ((background)); then
  while kill -0 "$background" 2> /dev/null && ((total - SECONDS > 60)); do sleep 1; done
  cat "$work/built" >> "$out/build.log"
fi
core_pids=()
core_names=()
for program in "${core[@]}"; do
  [[ -x $bin/$program ]] || { note "$program" "not run: it was not built" 0; failed=1; continue; }
  OMP_NUM_THREADS=4 timeout --kill-after=5 75 "$bin/$program" > "$work/$program" 2>&1 &
  core_pids+=($!); core_names+=("$program")
done
for n in "${!core_pids[@]}"; do
  wait "${core_pids[n]}"; status=$?
  { printf '\n===== %s, status %s\n' "${core_names[n]}" "$status"; cat "$work/${core_names[n]}"; } >> "$out/tests.log"
  note "${core_names[n]}" "status $status, $(grep -c '^\[       OK' "$work/${core_names[n]}") right, wrong:$(grep -ahoP '^\[  FAILED  \] \K[^ ,]+(?=.* ms\)$)' "$work/${core_names[n]}" | head -8 | sed 's/^/ /' | tr -d '\n,')" 0
  ((status == 0)) || failed=1
done
checked='Device.*:CudaDevice.Runs*:CudaDevice.Works*:*LeavesNothingBehind*:AdamOfDevice.*:BackendOfDevice.*'
checked+=':*PolicyOfDevice*/Outside:*PolicyOfDevice*/Inside:*PolicyOfDevice*/AlongX:*TransmittanceOfDevice.IsThatOfTheProcessor/Point*:*Picture*/LitAndChanged'
step memcheck 50 sanitizers.log compute-sanitizer --tool memcheck --error-exitcode 9 --print-limit 10 --track-stream-ordered-races all "$bin/test_gpu" "--gtest_filter=$checked"
step initcheck 35 sanitizers.log compute-sanitizer --tool initcheck --error-exitcode 9 --print-limit 10 "$bin/test_gpu" "--gtest_filter=$checked"
step synccheck 30 sanitizers.log compute-sanitizer --tool synccheck --error-exitcode 9 --print-limit 10 "$bin/test_gpu" "--gtest_filter=$checked"

# --- what came out ---------------------------------------------------------------------------------------
cat "$work/machine" >> "$summary"
nvidia-smi --query-gpu=clocks.sm,clocks.mem,temperature.gpu,power.draw --format=csv,noheader >> "$summary" 2>&1
for log in tests.log sanitizers.log profile.log benchmark.log build.log; do # 16 MiB come back of each
  [[ -f $out/$log ]] && (($(stat -c %s "$out/$log") > 15000000)) && { head -c 15000000 "$out/$log" > "$work/cut"; mv "$work/cut" "$out/$log"; }
done
[[ -f $out/Gpu.md ]] && awk '/^## / { ++section } section < 2' "$out/Gpu.md"
cat "$summary"
rm -rf "$work"
exit "$failed"
