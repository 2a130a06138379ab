#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Plays a story (story.py) in ParaView's window, then its NAME.replay.py, if any, in pvpython.
#   bash run-story.sh NAME FOLDER VOLUME PLUGIN...
# FOLDER is emptied, and holds afterwards what the story leaves. The story finds there the plugins
# and, as volume.vti, the file VOLUME, which has the point array "ct". Needs a display.
# LIMPID_WINDOW=WIDTHxHEIGHT in the environment sets the size of the window, which is small: where
# it is pressed does not depend on the size, how long a picture takes does.

set -euo pipefail

here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
name="$1"
folder="$2"
volume="$3"
plugins=("${@:4}")
if [[ ! -f "$volume" ]]; then
  echo "There is no file $volume for the story to open. Name one with a point array \"ct\"." >&2
  exit 2
fi
rm -rf "$folder"
mkdir -p "$folder/replay"
cd "$folder"

# The settings of whoever runs the test must not matter, nor be changed.
export XDG_CONFIG_HOME="$folder/settings" PV_MACRO_PATH="$here/Macros"
# As under ctest: ParaView takes its questions ("Delete All?") for answered, else it waits for ever.
export DASHBOARD_TEST_FROM_CTEST=1
export PYTHONPATH="$here:$here/../Python${PYTHONPATH:+:$PYTHONPATH}"

for plugin in "${plugins[@]}"; do
  ln -s "$plugin" .
done
ln -s "$volume" volume.vti

# The events, in words of the ParaView that is there.
words=(-f "$here/events.sed")
version="$(pvpython --version 2>&1 | grep -oE '[0-9]+\.[0-9]+' | tail -1)"
if [[ "$(printf '5.12\n%s\n' "$version" | sort -V | head -1)" == 5.12 ]]; then
  words+=(-e 's|pqRescaleRangeDialog|RescaleScalarRangeToCustomDialog|')
  words+=(-e 's|PluginManagerDialog/pqFileDialog|PluginManagerDialog/1pqFileDialog0|')
fi
sed "${words[@]}" "$here/$name.xml" > events.xml

# Not for ever: an event that fails can leave a dialog open.
timeout --kill-after=5 540 paraview --dr -geometry "${LIMPID_WINDOW:-805x633}+0+0" --test-directory="$folder" \
  --script="$here/$name.py" --test-script="$folder/events.xml" --exit ||
  echo "ParaView ended with $?."
cat report.txt
[[ "$(tail -1 report.txt)" == "The story ended well." ]]
if [[ -f "$here/$name.replay.py" ]]; then
  cd replay
  pvpython "$here/$name.replay.py"
fi
