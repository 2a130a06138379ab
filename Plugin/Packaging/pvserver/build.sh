#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Makes the Debian package of the plugin in a fresh Debian: bash build.sh FOLDER

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)"
folder="$(realpath -m "${1:?the folder for the package}")"

bash "$root/Testing/install-packages.sh" dpkg-dev file
bash "$root/Testing/build.sh"
cd "$root/build"
cpack -G DEB -B "$folder"
