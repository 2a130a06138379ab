#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Installs the package of the plugin, ParaView and a display without a screen, and makes the user
# pvserver: bash install.sh PACKAGE.deb

set -euo pipefail

package="$(realpath "${1:?the package}")"

apt-get -q update
DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends install \
  "$package" paraview xvfb xauth libgl1-mesa-dri
rm -rf /var/lib/apt/lists/*
useradd --create-home pvserver
