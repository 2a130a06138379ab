#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The pictures of Documentation/Tutorial.md: the screenshots of the test that does what the page says.
#   bash Documentation/Examples/tutorial.sh PLUGIN-DIRECTORY OUTDIR FILE.vti
# PLUGIN-DIRECTORY is build/lib, FILE a CT of a head. OUTDIR gets NAME.jpg, one a step. Needs
# ImageMagick and, without a screen, xvfb.

set -euo pipefail

if (($# != 3)); then
  sed -n '5,8s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 2
fi
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
plugins="$(cd "$1" && pwd)"
mkdir -p "$2"
out="$(cd "$2" && pwd)"
volume="$(realpath "$3")"
story="$(mktemp -d)"
trap 'rm -rf "$story"' EXIT
export LIMPID_WINDOW=1305x933 # a view of about 1000 x 700 pixels
bash "$root/Testing/with-display.sh" bash "$root/Testing/Gui/run-story.sh" TestTutorial "$story" \
  "$volume" "$plugins/Limpid/Limpid.so" "$plugins/LimpidGui/LimpidGui.so"
cd "$story"
for picture in tutorial-*.png; do # the window, which is smaller than the screen
  name="${picture#tutorial-}"
  convert "$picture" -crop 1306x934+0+0 +repage -resize 900x -quality 78 "$out/${name%.png}.jpg"
done
montage movie.*.png -tile 3x -geometry 298x+1+1 -quality 82 "$out/movie.jpg"
