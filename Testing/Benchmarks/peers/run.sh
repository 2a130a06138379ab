#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Measures Limpid beside others' programs, and makes Peers.json, Peers.md and their picture:
#   bash Testing/Benchmarks/peers/run.sh [--quick] [--build FOLDER] [--output FOLDER]
# Builds and installs nothing. It needs a release build with tests, with the Python package limpid
# (bash Testing/build.sh --tests), numpy and matplotlib; what else is missing is left out, which it
# says here and on the page:
#   vdb_render  Debian's libopenvdb-tools and python3-openvdb
#   PyTorch     pip's torch and numpy, in a virtual environment in build/peers (or PEERS_PYTHON)
#   Mitsuba 3   pip's mitsuba and numpy there, and LLVM 19 (16 was seen to fail), such as Debian's libllvm19
#   another VTK pip's vtk and numpy there
# --quick: small and few, to see whether it works. FOLDERs: with the programs (build), for the page
# (Documentation/Benchmarks). Takes half an hour on two cores.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)"
here="$root/Testing/Benchmarks/peers"
source "$root/Testing/Benchmarks/checks.sh"
build="$root/build"
output="$root/Documentation/Benchmarks"
command="bash Testing/Benchmarks/peers/run.sh"
energy=()
pictures=()
while (($# > 0)); do
  case "$1" in
    --quick)
      energy=(--nodes 32 48 --repeats 2 --pixels 64 128)
      pictures=(--nodes 64 --size 128 --repeats 1 --frames 3)
      command+=" --quick"
      ;;
    --build) build="$(realpath "${2:?--build needs a folder}")"; shift ;;
    --output) output="$(realpath -m "${2:?--output needs a folder}")"; shift ;;
    *) refuse_option "$1" ;;
  esac
  shift
done

python=/usr/bin/python3 # Debian's, which ParaView's and OpenVDB's packages are made for
limpid="$(ls -d "$build"/vtk/lib/python3*/*-packages "$build"/lib/python3*/*-packages \
  2> /dev/null | tail -1 || true)"
if [[ ! -x "$build/bin/limpid_energy" || -z "$limpid" ]]; then
  echo "There is no $build/bin/limpid_energy or no Python package limpid in $build (both are" \
    "measured). Build them: bash Testing/build.sh --tests" >&2
  exit 1
fi
need_to_draw "$python"

absent=()
lacks() # what is left out, and how to get it
{
  echo "Left out: $1. To measure it: $2" >&2
  absent+=("$1")
}

peers="${PEERS_PYTHON:-$build/peers/bin/python3}"
environment="python3 -m venv build/peers && build/peers/bin/pip install numpy torch mitsuba vtk"
if [[ ! -x "$peers" ]]; then
  echo "There is no $peers; without it: $python." >&2
  peers="$python"
fi
without=()
"$peers" -c "import torch" 2> /dev/null || { lacks PyTorch "$environment"; without+=(torch); }
another=()
if [[ "$peers" != "$python" ]] && "$peers" -c "import vtkmodules, numpy" 2> /dev/null; then
  another=(--another-vtk "$peers")
else
  lacks "another VTK" "$environment"
fi
if ! "$peers" -c "import mitsuba" 2> /dev/null; then
  lacks "Mitsuba 3" "$environment"
  without+=(mitsuba)
elif [[ -z "${DRJIT_LIBLLVM_PATH:-}" ]]; then
  # Mitsuba takes the first LLVM that it finds, and ends with a message of an older one's.
  newest="$(ls /usr/lib/*/libLLVM*.so* /usr/lib/llvm-*/lib/libLLVM*.so* 2> /dev/null |
    sed -nE 's/.*libLLVM(-|\.so\.)([0-9]+).*/\2 &/p' | sort -n | tail -1 || true)"
  if ((${newest%% *} >= 19)); then
    export DRJIT_LIBLLVM_PATH="${newest#* }"
  else
    lacks "Mitsuba 3" "apt-get install libllvm19 (it needs LLVM 19; 16 was seen to fail)"
    without+=(mitsuba)
  fi
fi
if ! "$python" -c "import shutil, pyopenvdb; assert shutil.which('vdb_render')" 2> /dev/null; then
  lacks vdb_render "apt-get install libopenvdb-tools python3-openvdb"
fi

parts="$build/benchmarks/peers"
mkdir -p "$parts" "$output"
rm -f "$parts"/*.npy
echo "== pictures"
PYTHONPATH="$limpid" bash "$root/Testing/with-display.sh" "$python" -B "$here/pictures.py" \
  "${pictures[@]}" "${another[@]}" --folder "$parts" --output "$parts/pictures.json"
echo "== energy"
"$peers" -B "$here/energy.py" --limpid "$build/bin/limpid_energy" "${energy[@]}" \
  --without "${without[@]}" --output "$parts/energy.json"
"$python" -B "$here/join.py" "$output/Peers.json" "$command" "$parts/pictures.json" \
  "$parts/energy.json" "${absent[@]}"
"$python" -B "$root/Testing/Benchmarks/pages/make.py" "$output" --pages peers --pictures "$parts"
