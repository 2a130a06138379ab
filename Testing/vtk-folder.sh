#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Prints the folder with the CMake files of the VTK that Debian's ParaView uses: the one inside
# ParaView (5.x: no other can be installed beside it), or Debian's own (6.x).
#   bash Testing/vtk-folder.sh

set -euo pipefail
shopt -s nullglob

folders=(/usr/lib/*/cmake/paraview-*/vtk)
if ((${#folders[@]} == 0)); then
  folders=(/usr/lib/*/cmake/vtk-*)
fi
if ((${#folders[@]} == 0)); then
  echo "There are no CMake files of a VTK in /usr/lib/*/cmake (tests from Python alone need them):" \
    "run Testing/install-packages.sh." >&2
  exit 1
fi
printf '%s\n' "${folders[@]}" | sort -V | tail -1
