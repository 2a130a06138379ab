#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# What ParaView's window shows when one opens data, chooses "Optimized Volume" and does nothing else.
#   bash Documentation/Examples/first_pictures.sh PLUGIN-DIRECTORY OUTDIR FILE.vti...
# PLUGIN-DIRECTORY is build/lib. OUTDIR gets NAME.png (the window), NAME-ordinary.png and
# NAME-optimized.png (the view) for every file, first-pictures.jpg with all of them, and report.txt.
# Needs what in_window.sh needs.

set -euo pipefail

if (($# < 3)); then
  sed -n '5,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 2
fi
here="$(dirname "${BASH_SOURCE[0]}")"
LIMPID_FILES="$(realpath "${@:3}")" # a line each: names may have spaces
export LIMPID_FILES
bash "$here/in_window.sh" "$1" "$2" "$here/first_pictures.py"
cd "$2"
pictures=()
while IFS= read -r file; do
  name="$(basename "$file" .vti)"
  for way in ordinary optimized; do # the middle of the view, without the text in its corner
    convert "$name-$way.png" -gravity center -crop 60x86%+0+0 +repage -resize x300 "cut-$name-$way.png"
    pictures+=("cut-$name-$way.png")
  done
done <<< "$LIMPID_FILES"
montage "${pictures[@]}" -tile 4x -geometry +3+3 -background white -depth 8 -quality 88 \
  first-pictures.jpg
rm "${pictures[@]}"
