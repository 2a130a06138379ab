#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Installs the Debian packages that building, testing and the demo need, or those that are named, if
# any is missing.
#   bash Testing/install-packages.sh [PACKAGE]...

set -euo pipefail

packages=(
  # build
  g++ cmake ninja-build libglm-dev libtbb-dev zlib1g-dev
  # ParaView and what its CMake files look for
  paraview-dev python3-paraview python3-dev libopenmpi-dev
  # tests and benchmarks
  libgtest-dev nlohmann-json3-dev libbenchmark-dev python3-yaml
  # checks of layout and of mistakes, and a second compiler
  clang clang-format clang-tidy glslang-tools libclang-rt-dev llvm xz-utils
  # pictures without a screen
  xvfb xauth libgl1-mesa-dri python3-numpy python3-matplotlib
)
# ParaView with a VTK of its own, or on Debian's
with_own_vtk=(libglew-dev libfreetype-dev)
with_debians_vtk=(libvtk9-dev)
# the parts for ParaView's window (optional, see LIMPID_ENABLE_GUI)
with_qt5=(qtbase5-dev libqt5opengl5-dev qttools5-dev qtxmlpatterns5-dev-tools)
with_qt6=(qt6-base-dev qt6-tools-dev qt6-5compat-dev)
with_qt6_and_debians_vtk=(libvtk9-qt-dev)

if (($# > 0)); then
  packages=("$@")
fi
if ! command -v dpkg-query > /dev/null; then
  echo "This is no Debian system: install what ${packages[*]} hold by hand." >&2
  exit 0
fi

is_installed() { [[ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2> /dev/null)" == installed ]]; }

as_root=()
if ((EUID != 0)); then
  as_root=(sudo)
fi

# Brings the lists of packages, once.
updated=0
update_lists()
{
  if ((!updated)); then
    "${as_root[@]}" apt-get update -q
    updated=1
  fi
}

# What the ParaView that is installed, or would be, was built with decides on some packages.
add_what_paraview_needs()
{
  local paraview vtk=own
  if is_installed paraview; then
    paraview="$(dpkg-query -W -f '${Depends}' paraview)"
  else
    update_lists
    paraview="$(apt-cache show --no-all-versions paraview | grep '^Depends:')"
  fi
  if [[ "$paraview" =~ libvtk9 ]]; then
    vtk=debians
  fi
  if [[ $vtk == debians ]]; then
    packages+=("${with_debians_vtk[@]}")
  else
    packages+=("${with_own_vtk[@]}")
  fi
  if [[ "$paraview" =~ libqt6 ]]; then
    packages+=("${with_qt6[@]}")
    if [[ $vtk == debians ]]; then
      packages+=("${with_qt6_and_debians_vtk[@]}")
    fi
  else
    packages+=("${with_qt5[@]}")
  fi
}

if (($# == 0)); then
  add_what_paraview_needs
fi

missing=()
for package in "${packages[@]}"; do
  if ! is_installed "$package"; then
    missing+=("$package")
  fi
done
if ((${#missing[@]} == 0)); then
  exit 0
fi

echo "Installing Debian packages: ${missing[*]}"
update_lists
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -q -y --no-install-recommends "${missing[@]}"
