#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The pictures of Documentation/Tutorial.md and Segmentations.md: the screenshots of the tests that do
# what the pages say.
#   bash Documentation/Examples/tutorial.sh PLUGIN-DIRECTORY OUTDIR FILE.vti
# PLUGIN-DIRECTORY is build/lib, FILE a CT of a head. OUTDIR gets NAME.jpg, one a step. Needs
# ImageMagick and, without a screen, xvfb.

set -euo pipefail

if (($# != 3)); then
  sed -n '6,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
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
play() { # NAME
  bash "$root/Testing/with-display.sh" bash "$root/Testing/Gui/run-story.sh" "$1" "$story/$1" \
    "$volume" "$plugins/Limpid/Limpid.so" "$plugins/LimpidGui/LimpidGui.so"
}
keep() { # PICTURE NAME: the window, which is smaller than the screen
  convert "$1" -crop 1306x934+0+0 +repage -resize 900x -quality 78 "$out/$2.jpg"
}
play TestSegmentation
for picture in opened ticked targets; do
  keep "$story/TestSegmentation/$picture.png" "segmentation-$picture"
done
play TestTutorial
cd "$story/TestTutorial"
for picture in tutorial-*.png; do
  name="${picture#tutorial-}"
  keep "$picture" "${name%.png}"
done
montage movie.*.png -tile 3x -geometry 298x+1+1 -quality 82 "$out/movie.jpg"
