#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Runs a tool in the fixed version of Testing/tools.txt.
#   bash Testing/tool.sh NAME [ARGUMENT]...
# If the system's program has this version, it is run. Otherwise pip installs the Python package of this name
# into the virtual environment build/tools/NAME-VERSION, which needs a network the first time.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
name="${1:-}"
package="$(grep -E "^$name(\[.*\])?==" "$root/Testing/tools.txt" || true)"
version="${package#*==}"
if [[ -z "$name" || -z "$version" ]]; then
  echo "There is no tool '$name' in Testing/tools.txt, which lists those that can be run." >&2
  exit 2
fi
shift

# Whether a program exists and has the version.
is_right()
{
  local told
  told="$("$1" --version 2> /dev/null || true)"
  grep -qwF -- "$version" <<< "$told"
}

for program in "$name-${version%%.*}" "$name"; do
  if is_right "$program"; then
    exec "$program" "$@"
  fi
done

folder="$root/build/tools/$name-$version"
if [[ ! -e "$folder/complete" ]]; then
  echo "Installing $name $version into build/tools." >&2
  rm -rf "$folder"
  if ! { python3 -m venv "$folder" &&
    "$folder/bin/pip" --disable-pip-version-check install --quiet "$package"; } >&2; then
    echo "$name $version could not be installed (other versions give other results, so they are not" \
      "used). Install python3-venv and connect to the network, or install this version of $name." >&2
    exit 2
  fi
  touch "$folder/complete"
fi
exec "$folder/bin/$name" "$@"
