#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Measures, and makes the pages and plots of Documentation/Benchmarks:
#   bash Testing/Benchmarks/run.sh [--quick] [--thorough] [--pages LIST] [--build FOLDER]
#     [--output FOLDER] [SCENE.scene.json ...]
# LIST: errors, resolutions, scaling and kernels, unless others are named; all: these and solvers,
# rendering and viewpoints; plots: measures nothing and makes all pages and plots from the numbers
# that are there. --quick: fewer settings and repeats; --thorough: finer grids of the paper's.
# FOLDERs: with the program (build), for numbers and pages (Documentation/Benchmarks). Scenes: those
# of LIMPID_TEST_DATA unless some are named. Builds and installs nothing, but says what is missing.
# Wants a quiet machine, and half an hour for seven scenes on two cores.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
source "$root/Testing/Benchmarks/checks.sh"
build="$root/build"
output="$root/Documentation/Benchmarks"
pages=errors,resolutions,scaling,kernels
quick=0
grids=()
scenes=()
while (($# > 0)); do
  case "$1" in
    --quick) quick=1 ;;
    --thorough) grids=(--grid-seconds 250 --grid-gigabytes 14) ;;
    --pages) pages="${2:?--pages needs a list}"; shift ;;
    --build) build="${2:?--build needs a folder}"; shift ;;
    --output) output="${2:?--output needs a folder}"; shift ;;
    --*) refuse_option "$1" ;;
    *) scenes+=("$1") ;;
  esac
  shift
done
[[ "$pages" == all ]] && pages=errors,resolutions,scaling,kernels,solvers,rendering,viewpoints

python=/usr/bin/python3 # Debian's, for which apt installs matplotlib
[[ -x "$python" ]] || python=python3
need_to_draw "$python"
if [[ "$pages" != plots && ! -x "$build/bin/limpid_bench" ]]; then
  {
    echo "There is no $build/bin/limpid_bench (it measures). Build it:"
    echo "  cmake -G Ninja -S $root -B $build -DCMAKE_BUILD_TYPE=Release" \
      "-DLIMPID_BUILD_TESTING=ON -DLIMPID_TEST_DATA=FOLDER"
    echo "  ninja -C $build limpid_bench"
    echo "FOLDER has the scenes. It needs VTK and nlohmann-json, and Google Benchmark for kernels."
  } >&2
  exit 1
fi

numbers="$build/benchmarks" # in the making, and pictures that only plots show
mkdir -p "$numbers" "$output"
start=$SECONDS
for page in ${pages//,/ }; do
  options=()
  chosen=("${scenes[@]}")
  ((quick)) && options+=(--quick)
  case "$page" in
    plots) continue ;;
    errors) options+=("${grids[@]}") ;;
    scaling) ((quick)) && options+=(--largest 192 --repeats 2) ;;
    resolutions)
      options+=(--repeats 3)
      if ((${#chosen[@]} == 0)); then # two that show much, where the other pages have all
        data="$(sed -n 's/^LIMPID_TEST_DATA:PATH=//p' "$build/CMakeCache.txt")"
        chosen=("$data/skull_phantom.scene.json" "$data/visible_male.scene.json")
      fi
      ;;
  esac
  echo "== $page"
  "$build/bin/limpid_bench" "$page" --output "$numbers/$page.json" "${options[@]}" "${chosen[@]}"
  mv "$numbers/$page.json" "$output/${page^}.json" # only when it is complete
done

echo "== pages"
made=()
[[ "$pages" == plots ]] || made=(--pages "${pages/,plots/}")
[[ "$pages" == *resolutions* ]] && made+=(--pictures "$numbers")
"$python" -B "$root/Testing/Benchmarks/pages/make.py" "$output" "${made[@]}"
echo "Done in $((SECONDS - start)) s: $output"
