#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Makes build-gpu-carry/carry.tar.xz of what build.sh built, the libraries that it needs, and real
# scenes, for one-shot.sh on a machine that has none of them.
#   bash Testing/Gpu/pack.sh DATA [PROGRAM...]
# DATA has *.scene.json; further programs travel, too.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
data="${1:?the folder of the scenes}"
shift
carried="$root/build-gpu-carry"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

bash "$root/Testing/Gpu/collect-dependencies.sh" "$work/dependencies"
mkdir -p "$work/bin" "$carried"
cp "$root"/build-gpu/bin/{test_,limpid_bench_gpu}* "$@" "$work/bin"
strip "$work"/bin/*
python3="$(command -v /usr/bin/python3 || command -v python3)" # the one that Debian's VTK is for
"$python3" "$root/Testing/Gpu/pack-scenes.py" "$data" "$work/scenes"
tar -cf - -C "$work" bin dependencies scenes | xz -T0 > "$carried/carry.tar.xz"
du -h "$carried/carry.tar.xz"
