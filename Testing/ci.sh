#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# The jobs of public CI. GitHub (.github/workflows) and GitLab (.gitlab-ci.yml) run them as root in fresh
# containers of Debian.
#   bash Testing/ci.sh JOB
# lint       layout, spelling, licences, files for GitHub and GitLab, and Testing/House: two minutes.
# tests      builds everything and runs the quick tests.
# wheel      builds the Python package, installs it and tests it.
# docs       builds the documentation. Output is in build/docs.
# tidy       builds the product and runs clang-tidy on the sources that differ from the commit LIMPID_BASE.
# sanitize   runs a selection of the tests with the sanitizers of addresses and of undefined behaviour.
# threads    runs the tests of threads with the sanitizer of threads.
# coverage   measures the share of the core's lines that its quick tests run.
# ccache keeps compiled files in build/ccache, which the hosts keep from run to run.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
cd "$root"
job="${1:-}"

# In a container, the sources may belong to another user: git refuses to read them otherwise.
export GIT_CONFIG_COUNT=1 GIT_CONFIG_KEY_0=safe.directory GIT_CONFIG_VALUE_0="$root"

use_ccache()
{
  bash Testing/install-packages.sh ccache
  export CCACHE_DIR="$root/build/ccache" CCACHE_BASEDIR="$root" CCACHE_NOHASHDIR=1 CCACHE_MAXSIZE=1G
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
  mkdir -p "$CCACHE_DIR"
  ccache --zero-stats > /dev/null
  trap 'ccache --show-stats' EXIT
}

case "$job" in
  lint)
    bash Testing/install-packages.sh ca-certificates git python3-venv python3-yaml
    bash Testing/check.sh format spelling licences hosting
    for test in Testing/House/Test*.py; do
      python3 -B "$test"
    done
    ;;
  tests)
    use_ccache
    bash Testing/run.sh
    ;;
  wheel)
    use_ccache
    bash Testing/wheel.sh
    ;;
  docs)
    bash Testing/install-packages.sh ca-certificates git python3-venv
    bash Documentation/build.sh
    ;;
  tidy)
    bash Testing/install-packages.sh git
    base="${LIMPID_BASE:-main}"
    git rev-parse --verify "$base^{commit}"
    if git diff --quiet --merge-base "$base" -- '*.h' '*.cxx'; then
      echo "No source differs from $base."
      exit 0
    fi
    use_ccache
    bash Testing/build.sh
    bash Testing/check.sh tidy-changed
    ;;
  sanitize | threads | coverage)
    use_ccache
    bash Testing/install-packages.sh ca-certificates git python3-venv
    bash Testing/check.sh "$job"
    ;;
  *)
    echo "Unknown job: '$job'. The head of Testing/ci.sh lists the jobs." >&2
    exit 2
    ;;
esac
