#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Measures, and draws the plots of Documentation/Benchmarks:
#   bash Testing/Benchmarks/run.sh [--quick] [--thorough] [--pages LIST] [--build FOLDER]
#     [--output FOLDER] [SCENE.scene.json ...]
# LIST: errors, resolutions, scaling and kernels, unless others are named; plots alone: from the
# numbers that are there; all: these and solvers, rendering and viewpoints. --quick: fewer settings
# and repeats; --thorough: finer grids of the paper's. FOLDERs: with the programs (build), for the
# pages (Documentation/Benchmarks). Scenes: those of LIMPID_TEST_DATA unless some are named.
# Builds and installs nothing, but says what is missing. Wants a quiet machine, and half an hour for
# seven scenes on two cores.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
here="$root/Testing/Benchmarks"
build="$root/build"
output="$root/Documentation/Benchmarks"
pages=errors,resolutions,scaling,kernels
quick=()
thorough=()
scenes=()
while (($# > 0)); do
  case "$1" in
    --quick) quick=(--quick) ;;
    --thorough) thorough=(--grid-seconds 250 --grid-gigabytes 14) ;;
    --pages) pages="${2:?--pages needs a list}"; shift ;;
    --build) build="${2:?--build needs a folder}"; shift ;;
    --output) output="${2:?--output needs a folder}"; shift ;;
    --*)
      echo "The option $1 is unknown (nothing would come of it). The head of $0 has those there" \
        "are." >&2
      exit 1
      ;;
    *) scenes+=("$1") ;;
  esac
  shift
done
[[ "$pages" == all ]] && pages=errors,resolutions,scaling,kernels,solvers,rendering,viewpoints
mkdir -p "$output/Plots"
output="$(cd "$output" && pwd)"

python=/usr/bin/python3 # Debian's, for which apt installs matplotlib
[[ -x "$python" ]] || python=python3
if ! "$python" -c "import matplotlib, numpy" 2> /dev/null; then
  echo "$python has no matplotlib or no numpy (they draw the plots). Install them; on Debian:" \
    "bash Testing/install-packages.sh" >&2
  exit 1
fi

wants() { [[ ",$pages," == *",$1,"* ]]; }

missing=()
for page in ${pages//,/ }; do
  case "$page" in
    plots) continue ;;
    errors) program=limpid_bench_error ;;
    *) program="limpid_bench_$page" ;;
  esac
  [[ -x "$build/bin/$program" ]] || missing+=("$program")
done
if ((${#missing[@]} > 0)); then
  {
    echo "Not in $build/bin: ${missing[*]} (they measure). Build them, or choose --pages:"
    echo "  cmake -G Ninja -S $root -B $build -DCMAKE_BUILD_TYPE=Release" \
      "-DLIMPID_BUILD_TESTING=ON -DLIMPID_TEST_DATA=FOLDER"
    echo "  ninja -C $build ${missing[*]}"
    echo "FOLDER has the scenes. The kernels need Google Benchmark (libbenchmark-dev), the others" \
      "VTK and nlohmann-json."
  } >&2
  exit 1
fi

# measure PAGE PROGRAM ARGUMENT...: a page is replaced only when it is complete.
measure() {
  local page="$1" program="$2"
  shift 2
  echo "== $page"
  "$build/bin/$program" --output "$numbers/$page.md" "$@"
  mv "$numbers/$page.md" "$output/$page.md"
}

numbers="$build/benchmarks" # pages in the making, and pictures that only plots show
mkdir -p "$numbers"
start=$SECONDS
if wants errors; then
  measure Errors limpid_bench_error --json "$numbers/Errors.json" "${quick[@]}" "${thorough[@]}" \
    "${scenes[@]}"
  mv "$numbers/Errors.json" "$output/Errors.json"
fi
if wants resolutions; then
  chosen=("${scenes[@]}")
  if ((${#chosen[@]} == 0)); then # two that show much, where the other pages have all
    data="$(sed -n 's/^LIMPID_TEST_DATA:PATH=//p' "$build/CMakeCache.txt")"
    chosen=("$data/skull_phantom.scene.json" "$data/visible_male.scene.json")
  fi
  measure Resolutions limpid_bench_resolutions --repeats 3 --json "$numbers/Resolutions.json" \
    "${chosen[@]}"
fi
if wants scaling; then
  smaller=()
  ((${#quick[@]} == 0)) || smaller=(--largest 192 --repeats 2)
  measure Scaling limpid_bench_scaling --json "$numbers/Scaling.json" "${smaller[@]}" \
    "${scenes[@]}"
  mv "$numbers/Scaling.json" "$output/Scaling.json"
fi
if wants kernels; then
  measure Kernels limpid_bench_kernels --json "$numbers/Kernels.json" "${quick[@]}" "${scenes[@]}"
  mv "$numbers/Kernels.json" "$output/Kernels.json"
fi
for page in Solvers Rendering Viewpoints; do
  if wants "${page,,}"; then
    measure "$page" "limpid_bench_${page,,}" "${scenes[@]}"
  fi
done

echo "== plots"
if [[ -f "$output/Errors.json" ]]; then
  "$python" "$here/plot_benchmarks.py" "$output/Errors.json" --output "$output/Plots"
fi
if [[ -f "$numbers/Resolutions.json" ]]; then
  "$python" "$here/plot_resolutions.py" "$numbers/Resolutions.json" --output "$output/Plots"
fi
drawn=()
[[ -f "$output/Scaling.json" ]] && drawn+=(--scaling "$output/Scaling.json")
[[ -f "$output/Kernels.json" ]] && drawn+=(--kernels "$output/Kernels.json")
if ((${#drawn[@]} > 0)); then
  "$python" "$here/plot_scaling.py" "${drawn[@]}" --output "$output/Plots"
fi
echo "Done in $((SECONDS - start)) s: $output"
