#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Installs what is missing, builds the plugin and shows what it does.
#   bash Documentation/Examples/demo.sh [OUTDIR] [--directions N] [--scene FILE.scene.json]...
# OUTDIR (demo-output) gets, per scene: before.png, paper.png, after.png, result.vti, convergence.csv and
# report.md; and s-sphere.vtp, s-sphere.png, the best and the worst view before and after,
# viewpoints.md and camera files. Without --scene the scene is the embedded phantom of a head; with
# several scenes each has a folder of its own, NAME, or NAME-2 for the second file NAME.scene.json, and
# there are contact sheets of all. N (642) is the number of directions of the S-sphere.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
examples="$root/Documentation/Examples"
output=demo-output
scenes=()
directions=642
while (($# > 0)); do
  case "$1" in
    --scene)
      if (($# < 2)); then
        echo "--scene has no file behind it. Give it a FILE.scene.json." >&2
        exit 2
      fi
      scenes+=("$2")
      shift 2
      ;;
    --directions)
      if (($# < 2)); then
        echo "--directions has no number behind it. Say how many, for instance 2562." >&2
        exit 2
      fi
      directions="$2"
      shift 2
      ;;
    -*)
      echo "$1 is no option of this script." \
        "Use: demo.sh [OUTDIR] [--directions N] [--scene FILE.scene.json]..." >&2
      exit 2
      ;;
    *)
      output="$1"
      shift
      ;;
  esac
done

if ((${#scenes[@]} > 0)); then
  python3 "$examples/scene_file.py" "${scenes[@]}"
fi
mkdir -p "$output"

# Runs a command with its output in a file; meanwhile says how far it is: every second on a terminal,
# every half minute elsewhere. The last line of the file is what the command is doing.
with_progress() {
  local log="$1" pause=30 ending='\n' clear=
  shift
  if [[ -t 1 ]]; then
    pause=1 ending= clear='\r\e[K'
  fi
  local start=$SECONDS next=$((SECONDS + pause))
  "$@" > "$log" 2>&1 &
  local command=$!
  while kill -0 "$command" 2> /dev/null; do
    sleep 1
    if ((SECONDS >= next)); then
      next=$((SECONDS + pause))
      printf "$clear%3d:%02d  %s$ending" $(((SECONDS - start) / 60)) $(((SECONDS - start) % 60)) \
        "$(tail -1 "$log" | tr -d '\r' | cut -c -90)"
    fi
  done
  printf "$clear"
  wait "$command"
}

echo "1 of 2: installing what is missing and building. The first time, building takes 3 to 6 minutes on" \
  "two cores (details in $output/build.log)."
with_progress "$output/build.log" bash "$root/Testing/build.sh" || {
  tail -40 "$output/build.log" >&2
  echo "The build failed; its whole output is in $output/build.log." >&2
  exit 1
}
plugin="$(tail -1 "$output/build.log")"
echo "2 of 2: optimising, searching viewpoints and making pictures, about a minute per scene."

show() {
  bash "$root/Testing/with-display.sh" pvpython "$examples/optimize_scene.py" \
    --plugin "$plugin" "$@"
  bash "$root/Testing/with-display.sh" pvpython "$examples/viewpoints.py" \
    --plugin "$plugin" --directions "$directions" "$@"
}

# Prints a folder for a scene that none of the other arguments is.
folder_for() {
  local name taken number=1
  name="$output/$(basename "$1" .scene.json)"
  taken=$'\n'"$(printf '%s\n' "${@:2}")"$'\n'
  local folder="$name"
  while [[ "$taken" == *$'\n'"$folder"$'\n'* ]]; do
    number=$((number + 1))
    folder="$name-$number"
  done
  printf '%s\n' "$folder"
}

case ${#scenes[@]} in
  0) show --output "$output" ;;
  1) show --output "$output" --scene "${scenes[0]}" ;;
  *)
    folders=()
    for scene in "${scenes[@]}"; do
      folder="$(folder_for "$scene" "${folders[@]}")"
      show --output "$folder" --scene "$scene"
      folders+=("$folder")
    done
    /usr/bin/python3 "$examples/contact_sheet.py" "$output/contact-sheet.png" "${folders[@]}"
    /usr/bin/python3 "$examples/sphere_sheet.py" "$output/s-spheres.png" "${folders[@]}"
    ;;
esac
