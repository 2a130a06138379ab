#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Runs a command with an X server of its own: ParaView's programs need one to render.
#   bash Testing/with-display.sh COMMAND [ARGUMENT]...

set -euo pipefail

if ! command -v xvfb-run > /dev/null; then
  exec "$@"
fi
# Two servers that start at the same moment would both take the first free number, so each starts
# looking at a number of its own: not that of its process, which other Debians on this machine have,
# too, and the same sockets. -noreset: a server without clients for a moment lives on.
exec xvfb-run --auto-servernum --server-num=$((100 + RANDOM % 900)) \
  --server-args="-screen 0 1600x1000x24 -noreset" "$@"
