#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Runs pvserver with the plugin on a display of its own: bash serve.sh [PVSERVER-ARGUMENT]...
# Debian 12's ParaView draws by X alone.

set -euo pipefail

plugin="$(dpkg -L limpid-paraview | grep '/Limpid\.so$')"
export PV_PLUGIN_PATH="${plugin%/*}"
exec bash "$(dirname "${BASH_SOURCE[0]}")/with-display.sh" pvserver "$@"
