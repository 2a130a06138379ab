#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Installs the Debian packages that building, testing and the demo need, if any is missing.
#   bash Testing/install-packages.sh

set -euo pipefail

packages=(
  # build
  g++ cmake ninja-build libglm-dev libtbb-dev
  # ParaView and what its CMake files look for
  paraview-dev python3-paraview python3-dev libopenmpi-dev libglew-dev libfreetype-dev
  # the button in ParaView's window (optional, see LIMPID_ENABLE_GUI)
  qtbase5-dev libqt5opengl5-dev qttools5-dev
  # tests and benchmarks
  libgtest-dev nlohmann-json3-dev libbenchmark-dev
  # checks of layout and of mistakes, and a second compiler
  clang clang-format clang-tidy
  # pictures without a screen
  xvfb xauth libgl1-mesa-dri python3-numpy python3-matplotlib
)

if ! command -v dpkg-query > /dev/null; then
  echo "This is no Debian system: install what ${packages[*]} hold by hand." >&2
  exit 0
fi

missing=()
for package in "${packages[@]}"; do
  if [[ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null)" != installed ]]; then
    missing+=("$package")
  fi
done
if ((${#missing[@]} == 0)); then
  exit 0
fi

echo "Installing Debian packages: ${missing[*]}"
as_root=()
if ((EUID != 0)); then
  as_root=(sudo)
fi
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -q -y --no-install-recommends "${missing[@]}"
