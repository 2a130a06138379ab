#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Builds the recipes for conda-forge by rattler-build and runs the tests that stand in them, with what
# Debian has installed in place of the channel's packages: see Testing/Packaging/build_conda.py.
#   bash Testing/recipes.sh [RECIPE]...
# RECIPE  limpid, limpid-vtk or limpid-paraview; all three by default.
# The packages are in build/recipes/output/linux-64. rattler-build, and the Python packages that the recipes
# want, come from where pip has them. With CCACHE_DIR and ccache, that is used.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
folder="$root/build/recipes"

bash "$root/Testing/install-packages.sh"
bash "$root/Testing/install-packages.sh" python3-venv
mkdir -p "$folder"
if [[ ! -x "$folder/venv/bin/python" ]]; then
  /usr/bin/python3 -m venv "$folder/venv"
fi
"$folder/venv/bin/pip" --disable-pip-version-check install --quiet 'py-rattler-build==0.73.*'
"$folder/venv/bin/python" -u -B "$root/Testing/Packaging/build_conda.py" "$folder" "$@"
