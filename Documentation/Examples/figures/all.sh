#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Makes all figures of the paper, and their captions in Documentation/Gallery.md.
#   bash Documentation/Examples/figures/all.sh [--build FOLDER] [--data FOLDER] [--output FOLDER]
#     [--only NAME]... [OPTION]...
# FOLDERs: with the plugin (build), with the scenes (LIMPID_TEST_DATA, or shared/data beside the
# repository), for pictures and numbers (Documentation/Pictures/figures, whose captions go into the
# gallery; any other folder leaves the gallery alone). OPTIONs are those of make.py. Builds nothing,
# but says what is missing; scenes that are absent are named and left out, the phantom is always
# there. Takes 14 minutes on two cores. --only table_methods, S of all methods from all sides, takes
# another 20 minutes and is made only if it is named. The captions say how long each took.

set -euo pipefail

here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
root="$(cd "$here/../../.." && pwd)"
build="$root/build"
data="${LIMPID_TEST_DATA:-$root/../shared/data}"
pictures="$root/Documentation/Pictures/figures"
output="$pictures"
only=()
options=()
while (($# > 0)); do
  case "$1" in
    --build) build="${2:?--build needs a folder}"; shift ;;
    --data) data="${2:?--data needs a folder}"; shift ;;
    --output) output="${2:?--output needs a folder}"; shift ;;
    --only) only+=("${2:?--only needs the name of a figure}"); shift ;;
    *) options+=("$1") ;;
  esac
  shift
done

plugin="$build/lib/Limpid/Limpid.so"
if [[ ! -e "$plugin" ]]; then
  echo "There is no $plugin (it draws the figures). Build it: bash Testing/build.sh" >&2
  exit 1
fi
((${#only[@]} == 0)) || options+=(--only "${only[@]}")
[[ "$output" != "$pictures" ]] || options+=(--gallery "$root/Documentation/Gallery.md")
shopt -s nullglob
exec bash "$root/Testing/with-display.sh" pvpython "$here/make.py" --plugin "$plugin" \
  --output "$output" "${options[@]}" -- "$data"/*.scene.json
