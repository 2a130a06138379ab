#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Runs a tool in the version that Testing/tools.txt names, whatever the system has.
#   bash Testing/tool.sh NAME [ARGUMENT]...
# The system's own is taken if it has that version. Otherwise pip installs the Python package of that name
# into a virtual environment, build/tools/NAME-VERSION, once; without a network this fails, and says so.

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

# Whether a program is there and has the version.
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
    echo "$name $version could not be installed (results depend on its version, so no other one is" \
      "taken). Install python3-venv, allow pip to reach packages, or install this version of $name." >&2
    exit 2
  fi
  touch "$folder/complete"
fi
exec "$folder/bin/$name" "$@"
