#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Runs a script in ParaView's window, with fresh settings and both plugins.
#   bash Documentation/Examples/in_window.sh PLUGIN-DIRECTORY OUTDIR SCRIPT.py
# PLUGIN-DIRECTORY is build/lib: it holds Limpid/Limpid.so and LimpidGui/LimpidGui.so. The script
# finds OUTDIR in LIMPID_OUTPUT and leaves report.txt there, which is printed. Needs xdotool,
# ImageMagick and, without a screen, xvfb.

set -euo pipefail

if (($# != 3)); then
  sed -n '5,10s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
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
export LIMPID_OUTPUT
script="$(realpath "$3")"
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
  --script="$script" > paraview.log 2>&1 || true
cat report.txt
