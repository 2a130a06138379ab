#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Builds the documentation site and checks it: any warning, and any link to a page, a file or a
# heading that does not exist, is an error.
#   bash Documentation/build.sh [--external] [OUTDIR]      default: build/docs/html
# --external: also try the links to other sites, which OUTDIR/external-links.txt lists.
# It needs Python 3.11 with venv; Sphinx comes from Site/requirements.txt into build/docs/venv, the
# first time from the network. LIMPID_DOCS_PYTHON: a Python that has these packages already.
# LIMPID_DOCS_WORK: folder for all of it in place of build/docs.

set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
site="$root/Documentation/Site"
work="${LIMPID_DOCS_WORK:-$root/build/docs}"

external=0
if [[ "${1:-}" == --external ]]; then
  external=1
  shift
fi
output="$(realpath -m "${1:-$work/html}")"
mkdir -p "$work"

python="${LIMPID_DOCS_PYTHON:-}"
if [[ -z "$python" ]]; then
  python="$work/venv/bin/python"
  if ! cmp -s "$site/requirements.txt" "$work/venv/requirements.txt"; then
    echo "Installing Sphinx in $work/venv"
    python3 -m venv --clear "$work/venv"
    "$python" -m pip install --quiet --disable-pip-version-check -r "$site/requirements.txt"
    cp "$site/requirements.txt" "$work/venv/"
  fi
fi

export PYTHONDONTWRITEBYTECODE=1
sphinx()
{
  "$python" -m sphinx --fresh-env --fail-on-warning --keep-going --quiet -b "$1" -c "$site" -d "$work/doctrees" "$root" "$2"
}
rm -rf "$output"
sphinx html "$output"
echo '<meta http-equiv="refresh" content="0; url=Documentation/README.html">' > "$output/index.html"
"$python" "$site/check_links.py" "$output"
if ((external)); then
  sphinx linkcheck "$work/linkcheck"
fi
echo "The documentation is in $output/index.html"
