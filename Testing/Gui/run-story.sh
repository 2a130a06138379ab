#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Plays a story (story.py) in ParaView's window, then, if it has one, its NAME.replay.py in pvpython.
#   bash run-story.sh NAME FOLDER
# FOLDER is emptied, and holds afterwards what the story leaves. Needs PV_PLUGIN_PATH and a display.

set -euo pipefail

here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
name="$1"
folder="$2"
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"

# The settings of whoever runs the test must not matter, nor be changed.
export XDG_CONFIG_HOME="$folder/settings" PV_MACRO_PATH="$here/Macros"
export PYTHONPATH="$here:$here/../Python${PYTHONPATH:+:$PYTHONPATH}"

paraview --dr --test-directory="$folder" --script="$here/$name.py" \
  --test-script="$here/$name.xml" --exit || echo "ParaView ended with $?."
cat report.txt
[[ "$(tail -1 report.txt)" == "The story ended well." ]]
if [[ -f "$here/$name.replay.py" ]]; then
  pvpython "$here/$name.replay.py"
fi
