#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Installs what is missing, builds everything and runs the tests: one on each core and one more, since
# some of them wait.
#   bash Testing/run.sh [--long] [CTEST-ARGUMENT]...
# --long, or LIMPID_TEST_LONG=1 in the environment, adds the tests that take minutes.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
long="${LIMPID_TEST_LONG:-0}"
if [[ "${1:-}" == --long ]]; then
  long=1
  shift
fi
export LIMPID_TEST_LONG="$long" # some quick tests then take whole scenes
export CTEST_PARALLEL_LEVEL="${CTEST_PARALLEL_LEVEL:-$(($(nproc) + 1))}"

bash "$root/Testing/build.sh" --tests

selection=(--label-exclude '^long$')
if [[ "$long" == 1 ]]; then
  selection=()
fi
ctest --test-dir "$root/build" --output-on-failure --no-tests=error "${selection[@]}" "$@"
