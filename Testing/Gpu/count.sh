#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Without a GPU: counts what a GPU would have to do, and makes Counts.json and Counts.md.
#   bash Testing/Gpu/count.sh [--build FOLDER] [--output FOLDER] [--data FOLDER]
# Launches, waits of all threads for each other, and bytes between host and device come from the
# processor in the role of a GPU; instructions, loads and registers from the compiler's output.
# FOLDERs: with limpid_bench_pretended_gpu (build; bash Testing/build.sh --tests), for the page
# (Documentation/Benchmarks), with real scenes (LIMPID_TEST_DATA; without, their tiles are not
# counted). Needs nvcc and cuobjdump, which comes with the CUDA toolkit or with
# pip's nvidia-cuda-cuobjdump and nvidia-cuda-nvdisasm, on PATH. Builds nothing else. Takes a minute.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
here="$root/Testing/Gpu"
build="$root/build"
output="$root/Documentation/Benchmarks"
data="${LIMPID_TEST_DATA:-$root/../shared/data}"
while (($# > 0)); do
  case "$1" in
    --build) build="${2:?--build needs a folder}"; shift ;;
    --output) output="${2:?--output needs a folder}"; shift ;;
    --data) data="${2:?--data needs a folder}"; shift ;;
    *) echo "The argument $1 is not understood. Give --build, --output or --data FOLDER." >&2; exit 1 ;;
  esac
  shift
done
for place in /usr/local/cuda/bin /opt/cuda/bin; do
  if ! command -v nvcc > /dev/null && [[ -x "$place/nvcc" ]]; then
    PATH="$PATH:$place"
  fi
done
program="$build/bin/limpid_bench_pretended_gpu"
if [[ ! -x "$program" ]]; then
  echo "There is no $program (it counts launches). Build it: bash Testing/build.sh --tests" >&2
  exit 1
fi
for tool in nvcc cuobjdump nvdisasm; do
  if ! command -v "$tool" > /dev/null; then
    echo "There is no $tool (the compiler's output cannot be counted). Install the CUDA toolkit, or" \
      "pip's nvidia-cuda-cuobjdump and nvidia-cuda-nvdisasm, and add it to PATH." >&2
    exit 1
  fi
done

parts="$build/benchmarks/gpu-counts"
mkdir -p "$parts" "$output"
echo "== launches"
"$program" --quick --sizes 256 --scenes onion --parts policy,frame,set-up --output "$parts/launches.json"
echo "== tiles"
scenes="$(printf '%s\n' "$data"/*.scene.json | paste -sd,)"
[[ -f "${scenes%%,*}" ]] || scenes=""
"$build/bin/limpid_count_tiles" --files "$scenes" --output "$parts/tiles.json"
echo "== instructions"
: > "$parts/counted.sass"
: > "$parts/registers.txt"
for source in "$here/cuda/Counted.cu" "$root/cuda/compute/CudaBackend.cxx"; do
  nvcc -std=c++17 -O3 -arch=sm_90 --expt-relaxed-constexpr -x cu -I "$root/cuda" -cubin \
    -o "$parts/counted.cubin" "$source"
  cuobjdump -sass "$parts/counted.cubin" >> "$parts/counted.sass"
  cuobjdump -res-usage "$parts/counted.cubin" >> "$parts/registers.txt" 2>&1
done
/usr/bin/python3 -B "$here/count.py" "$parts" "$output/Counts.json"
/usr/bin/python3 -B "$root/Testing/Benchmarks/pages/make.py" "$output" --pages counts --no-plots
