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
LIMPID_SCENE="${3:+$(realpath "$3")}"
export LIMPID_SCENE
here="$(dirname "${BASH_SOURCE[0]}")"
bash "$here/in_window.sh" "$1" "$2" "$here/gui_screenshots.py"
