#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Prints the versions of what Limpid is built with and for, a name and a version per line.
#   bash Testing/versions.sh

set -euo pipefail

here="$(dirname "${BASH_SOURCE[0]}")"

# The upstream part of the version of the first of some packages that is installed.
version_of()
{
  dpkg-query -W -f '${db:Status-Status} ${Version}\n' "$@" 2> /dev/null |
    sed -nE 's/^installed ([0-9]+:)?([0-9.]+).*/\2/p' | head -1
}

echo "Debian $(cat /etc/debian_version)"
echo "ParaView $(version_of paraview)"
echo "VTK $(sed -nE 's/.*set\(PACKAGE_VERSION "([0-9.]+).*/\1/p' \
  "$(bash "$here/vtk-folder.sh")"/*-config-version.cmake | head -1)"
echo "Qt $(version_of libqt6core6t64 libqt6core6 libqt5core5a)"
echo "g++ $(g++ -dumpfullversion)"
echo "clang $(clang -dumpversion 2> /dev/null)"
echo "CMake $(cmake --version | sed -n '1s/[^0-9]*//p')"
echo "Python $(/usr/bin/python3 -c 'import platform; print(platform.python_version())')"
