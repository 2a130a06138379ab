#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Installs what is missing and builds the plugin in build/, with the tests if asked for.
#   bash Testing/build.sh [--tests]
# Says on its last line where the plugin is.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build="$root/build"
tests=OFF
if [[ "${1:-}" == --tests ]]; then
  tests=ON
fi

bash "$root/Testing/install-packages.sh"

# Another Python on the PATH may hide Debian's, which ParaView's packages are made for.
configure=(-DPython3_EXECUTABLE=/usr/bin/python3)
if [[ $tests == ON ]]; then
  # The Python package, against the VTK that ParaView uses.
  vtk="$(bash "$root/Testing/vtk-folder.sh")"
  cmake -S "$root" -B "$build/vtk" -G Ninja -Wno-dev \
    -DLIMPID_ENABLE_PARAVIEW=OFF -DLIMPID_BUILD_TESTING=OFF -DLIMPID_ENABLE_CUDA=OFF -DVTK_DIR="$vtk" "${configure[@]}"
  cmake --build "$build/vtk"
  python_path="$(ls -d "$build"/vtk/lib/python3*/*-packages | tail -1)"
  configure+=(-DLIMPID_PYTHON_PATH="$python_path" -DLIMPID_VTK_BUILD="$build/vtk")
  # No test needs code for every GPU there is.
  configure+=(-DLIMPID_BUILD_TESTING=ON -DCMAKE_CUDA_ARCHITECTURES="75;90")
elif [[ ! -f "$build/CMakeCache.txt" ]]; then
  configure+=(-DLIMPID_BUILD_TESTING=OFF)
fi

cmake -S "$root" -B "$build" -G Ninja -Wno-dev "${configure[@]}"
cmake --build "$build"
find "$build/lib" -name Limpid.so
