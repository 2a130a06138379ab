#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Installs what is missing and builds the plugin in build/, with the tests if asked for.
#   bash Testing/build.sh [--tests]
# With nvcc, the CUDA backend is built for the GPU that is there, or else for the oldest one, whose
# code drivers translate for newer ones; tests that need a GPU only where there is one. Says on its last line where the plugin is.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build="$root/build"
tests=OFF
if [[ "${1:-}" == --tests ]]; then
  tests=ON
fi

bash "$root/Testing/install-packages.sh"

# Another Python on the PATH may hide Debian's, which ParaView's packages are made for.
python=-DPython3_EXECUTABLE=/usr/bin/python3

# Configures the plugin. What was chosen before stays.
configure()
{
  local chosen=()
  if [[ ! -f "$build/CMakeCache.txt" ]]; then
    chosen=(-DLIMPID_BUILD_TESTING=OFF)
    if nvidia-smi -L > /dev/null 2>&1; then
      chosen+=(-DCMAKE_CUDA_ARCHITECTURES=native)
    else
      chosen+=(-DCMAKE_CUDA_ARCHITECTURES=75 -DLIMPID_BUILD_GPU_TESTS=OFF)
    fi
  fi
  cmake -S "$root" -B "$build" -G Ninja -Wno-dev "$python" "${chosen[@]}" "$@"
}

if [[ $tests == ON ]]; then
  vtk="$(bash "$root/Testing/vtk-folder.sh")"
  configure -DLIMPID_BUILD_TESTING=ON
  # The Python package, against the VTK that ParaView uses, with the core of the plugin.
  cmake -S "$root" -B "$build/vtk" -G Ninja -Wno-dev "$python" \
    -DLIMPID_ENABLE_PARAVIEW=OFF -DLIMPID_BUILD_TESTING=OFF -DLIMPID_ENABLE_CUDA=OFF \
    -DLIMPID_CORE_BUILD="$build" -DVTK_DIR="$vtk"
  cmake --build "$build/vtk"
  python_path="$(ls -d "$build"/vtk/lib/python3*/*-packages | tail -1)"
  configure -DLIMPID_PYTHON_PATH="$python_path" -DLIMPID_VTK_BUILD="$build/vtk"
else
  configure
fi
cmake --build "$build"
find "$build/lib" -name Limpid.so
