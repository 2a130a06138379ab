#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Installs a build tree, moves what was installed into FOLDER, and fails if any file of it names the
# source folder, the build tree, or the place that it was moved from.
#   bash Testing/Install/install-and-move.sh BUILD-TREE FOLDER

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
build="$(cd "$1" && pwd)"
folder="$2"
first="$folder.first"

rm -rf "$folder" "$first"
"${CMAKE_COMMAND:-cmake}" --install "$build" --prefix "$first"
mv "$first" "$folder"

# A path begins where no name or variable goes on: /limpid is not part of include/limpid.
status=0
for name in "$root" "$build" "$first"; do
  pattern="(^|[^[:alnum:]_./}-])$(sed 's/[^[:alnum:]/_-]/[&]/g' <<< "$name")"
  if files="$(LC_ALL=C grep --recursive --files-with-matches --text --extended-regexp \
    -- "$pattern" "$folder")"; then
    printf 'These name %s:\n%s\n' "$name" "$files" >&2
    status=1
  fi
done
exit $status
