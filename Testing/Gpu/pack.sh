#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Makes build-gpu-carry/carry.tar.xz of what build.sh built, the libraries that it needs, and real
# scenes, for one-shot.sh on a machine that has none of them.
#   bash Testing/Gpu/pack.sh DATA [PROGRAM...]
# DATA has *.scene.json; further programs travel, too. Programs are taken from LIMPID_GPU_PROGRAMS
# (build-gpu/bin), and packed in LIMPID_GPU_CARRY (build-gpu-carry) if these are given. It fails if
# the working tree with that folder is larger than what travels, 64 MiB.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
data="${1:?the folder of the scenes}"
shift
programs="${LIMPID_GPU_PROGRAMS:-$root/build-gpu/bin}"
carried="${LIMPID_GPU_CARRY:-$root/build-gpu-carry}"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

bash "$root/Testing/Gpu/collect-dependencies.sh" "$work/dependencies"
mkdir -p "$work/bin" "$carried"
cp "$programs"/{test_,limpid_bench_gpu}* "$@" "$work/bin"
strip "$work"/bin/*
python3="$(command -v /usr/bin/python3 || command -v python3)" # the one that Debian's VTK is for
"$python3" "$root/Testing/Gpu/pack-scenes.py" "$data" "$work/scenes"
# -9: its dictionary is large enough to find the core, which all programs have, in the one before.
tar -cf - -C "$work" bin dependencies scenes | xz -T0 -9 > "$carried/carry.tar.xz"

packed="$(stat -c %s "$carried/carry.tar.xz")"
tree="$(cd "$root" && git ls-files -z --cached --others --exclude-standard |
  { xargs -0 stat -c %s 2> /dev/null || true; } | awk '{ sum += $1 } END { print sum + 0 }')"
echo "$carried/carry.tar.xz: $((packed >> 10)) KiB; the working tree: $((tree >> 10)) KiB; of 65536 KiB that travel"
if ((packed + tree > 64 << 20)); then
  echo "That is too much (it would not travel). Pack fewer scenes." >&2
  exit 1
fi
