#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Builds in build-gpu/ what one-shot.sh runs: the core without VTK for a GPU, its tests and the benchmark.
#   bash Testing/Gpu/build.sh [ARCHITECTURE]
# ARCHITECTURE: 90, say, which is the default. Needs nvcc and CMake; no GPU. GLM, oneTBB, GoogleTest and
# nlohmann-json may lie in the folder LIMPID_GPU_DEPENDENCIES, where collect-dependencies.sh put them.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
build="$root/build-gpu"
for place in /usr/local/cuda/bin /opt/cuda/bin; do
  if ! command -v nvcc > /dev/null && [[ -x "$place/nvcc" ]]; then
    PATH="$place:$PATH"
  fi
done
if ! command -v nvcc > /dev/null || ! command -v cmake > /dev/null; then
  echo "There is no nvcc or no cmake (nothing can be built). Install the CUDA toolkit and CMake, or add them to PATH." >&2
  exit 1
fi

# The compiler there may be another than the developers': its warnings do not stop this.
configuration=(-S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DLIMPID_ENABLE_VTK=OFF
  -DLIMPID_ENABLE_CUDA=ON -DLIMPID_BUILD_TESTING=ON -DLIMPID_WARNINGS_AS_ERRORS=OFF
  "-DCMAKE_CUDA_ARCHITECTURES=${1:-90}" "-DCMAKE_CUDA_COMPILER=$(command -v nvcc)")
if command -v ninja > /dev/null && [[ ! -f "$build/CMakeCache.txt" ]]; then
  configuration+=(-G Ninja)
fi
if [[ -d "${LIMPID_GPU_DEPENDENCIES:-}" ]]; then
  for package in glm GTest TBB nlohmann_json; do
    file="$(find "$LIMPID_GPU_DEPENDENCIES" -name "${package}Config.cmake" | head -1)"
    configuration+=("-D${package}_DIR=$(dirname "$file")")
  done
fi
cmake "${configuration[@]}"
# What matters most first: the time may not be enough for all.
for targets in "test_gpu limpid_bench_gpu" "test_core_backends test_core_closed_form test_core_invariance
    test_core_modes test_core_stress test_core_input test_core_progressive test_core_renderer"; do
  read -r -d '' -a names <<< "$targets" || true
  cmake --build "$build" --parallel "$(nproc)" --target "${names[@]}"
done
