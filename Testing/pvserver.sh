#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Runs what Plugin/Packaging/pvserver/Dockerfile runs for its server, in a Debian 12 of its own, and
# connects pvpython of this machine to it, which shows a phantom as Optimized Volume.
#   bash Testing/pvserver.sh PLUGIN PACKAGE.deb PICTURE.png
# PLUGIN: Limpid.so for this machine's ParaView 5.11. PACKAGE.deb: limpid-paraview of Debian 12, from
# `cpack -G DEB` or Plugin/Packaging/pvserver/build.sh. That Debian is LIMPID_CHROOTS/pvserver
# (/var/tmp/limpid-chroots). Ends with 77 where this cannot be done.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
source "$root/Testing/another-debian.sh"
plugin="$(realpath "${1:?the plugin}")"
package="$(realpath "${2:?the package}")"
picture="$(realpath -m "${3:?the picture to write}")"
debian="${LIMPID_CHROOTS:-/var/tmp/limpid-chroots}/pvserver"

if ! can_make_debian || ! command -v pvpython > /dev/null; then
  echo "Not tried: a Debian of its own needs root and debootstrap, the client pvpython."
  exit 77
fi

make_debian bookworm "$debian"
mkdir -p "$debian/packages" "$debian/opt/limpid"
cp "$package" "$debian/packages/limpid-paraview.deb"
cp "$root"/Plugin/Packaging/pvserver/* "$root/Testing/with-display.sh" "$debian/opt/limpid/"
inside "$debian" bash /opt/limpid/install.sh /packages/limpid-paraview.deb

log="$debian-server.log"
inside "$debian" timeout 600 su --login pvserver \
  --command "bash /opt/limpid/serve.sh --server-port=0" > "$log" 2>&1 &
server=$!
trap 'kill "$server" 2> /dev/null || true' EXIT
port=
for ((second = 0; second < 120; ++second)); do
  port="$(sed -nE 's/.*Accepting connection\(s\): .*:([0-9]+)$/\1/p' "$log")"
  [[ -z "$port" ]] || break
  sleep 1
done
if [[ -z "$port" ]]; then
  echo "pvserver did not accept connections within two minutes. It said:" >&2
  cat "$log" >&2
  exit 1
fi
bash "$root/Testing/with-display.sh" pvpython "$root/Plugin/Packaging/pvserver/test_server.py" \
  "$plugin" "$port" "$picture"
