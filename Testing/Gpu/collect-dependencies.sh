#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Copies what the core and its tests need beside a compiler, GLM, oneTBB, GoogleTest and
# nlohmann-json, from this Debian machine into a folder, for a machine with a GPU that has none:
#   bash Testing/Gpu/collect-dependencies.sh [FOLDER]
# FOLDER: build-gpu-dependencies, if it is not given.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
folder="${1:-$root/build-gpu-dependencies}"
packages=(libglm-dev libgtest-dev nlohmann-json3-dev libtbb-dev libtbb12 libtbbbind-2-5 libtbbmalloc2)

if ! command -v dpkg > /dev/null || ! dpkg --listfiles "${packages[@]}" > /dev/null; then
  echo "The packages ${packages[*]} are not all installed (their files are to be copied). Run" \
    "Testing/install-packages.sh on Debian." >&2
  exit 1
fi

mkdir -p "$folder"
# Links become files, so that the folder survives whatever carries it. No documentation.
dpkg --listfiles "${packages[@]}" | sort -u | while read -r file; do
  case "$file" in
    */doc/* | */lintian/* | */pkgconfig/*) continue ;;
  esac
  if [[ -f "$file" ]]; then
    install -D -m 644 "$(readlink -f "$file")" "$folder$file"
  fi
done
du -sh "$folder"
