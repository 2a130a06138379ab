#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Pictures of ParaView's window with an optimised volume, for README.md.
#   bash Documentation/Examples/gui_screenshots.sh PLUGIN-DIRECTORY OUTDIR [FILE.scene.json]
# PLUGIN-DIRECTORY is build/lib: it holds Limpid/Limpid.so and LimpidGui/LimpidGui.so. Without a
# scene the volume is the embedded phantom of a head. OUTDIR gets
#   before.png, after.png, context.png, turned.png     the view
#   window-NAME.png                       the whole window, likewise, and window-turning.png
#   panel-1.png, panel-2.png              the properties of the volume, two pages
#   report.txt                            scores and times
# Needs xdotool, ImageMagick and, without a screen, xvfb.

set -euo pipefail

if (($# < 2)); then
  sed -n '5,14s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 2
fi
for program in paraview xdotool import; do
  if ! command -v "$program" > /dev/null; then
    echo "There is no program $program (it is needed for the pictures). Install" \
      "paraview, xdotool and imagemagick." >&2
    exit 1
  fi
done

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
plugins="$(cd "$1" && pwd)"
mkdir -p "$2"
LIMPID_OUTPUT="$(cd "$2" && pwd)"
LIMPID_SCENE="${3:+$(realpath "$3")}"
export LIMPID_OUTPUT LIMPID_SCENE
# The settings of whoever runs this must not show, nor be changed.
XDG_CONFIG_HOME="$(mktemp -d)"
export XDG_CONFIG_HOME
trap 'rm -rf "$XDG_CONFIG_HOME"' EXIT
export PV_PLUGIN_PATH="$plugins/Limpid:$plugins/LimpidGui"
modules="$root/Testing/Gui:$root/Testing/Python:$root/Documentation/Examples"
export PYTHONPATH="$modules${PYTHONPATH:+:$PYTHONPATH}"

cd "$LIMPID_OUTPUT"
with_display=()
if [[ -z "${DISPLAY:-}" ]]; then
  with_display=(bash "$root/Testing/with-display.sh")
fi
"${with_display[@]}" paraview --dr -geometry 1600x1000+0+0 \
  --script="$root/Documentation/Examples/gui_screenshots.py" > paraview.log 2>&1 || true
cat report.txt
