#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Makes the Debian package of a build tree of the plugin and tries it in a Debian of its own: installs
# it with what it depends on, shows a volume with the plugin in it, and removes it.
#   bash Testing/deb.sh [BUILD-TREE]
# That Debian has this machine's release. debootstrap makes it anew in LIMPID_CHROOTS (BUILD-TREE/chroots):
# nothing of this machine is in it but the package, the test, and a /proc of its own. 3 GB of disk, some
# minutes. Ends with 77 where this cannot be done.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
source "$root/Testing/another-debian.sh"
build="$(cd "${1:-$root/build}" && pwd)"
chroots="${LIMPID_CHROOTS:-$build/chroots}"

if ! can_make_debian || ! command -v dpkg-shlibdeps > /dev/null; then
  echo "Not tried: a Debian of its own needs root, debootstrap and dpkg-dev."
  exit 77
fi
# As apt calls it: /etc/os-release of sid has the name of the release to come.
# shellcheck disable=SC2016
release="$(apt-get indextargets --format '$(CODENAME)' 'Created-By: Packages' | sed -n 1p)"
debian="$chroots/$release"

make_package()
{
  rm -rf "$build/packages"
  (cd "$build" && cpack -G DEB -B "$build/packages" > "$build/packages.log")
  ls "$build"/packages/*.deb
}

install_package()
{
  cp "$1" "$debian/tmp/limpid.deb"
  inside "$debian" apt-get -q -y --no-install-recommends install /tmp/limpid.deb
  inside "$debian" dpkg -L limpid-paraview > "$chroots/files"
  plugin="$(grep '/Limpid\.so$' "$chroots/files")"
}

expect_all_libraries()
{
  # shellcheck disable=SC2016
  inside "$debian" bash -c '! ldd "$1" | grep "not found"' _ "$plugin"
}

show_a_volume()
{
  inside "$debian" apt-get -q -y --no-install-recommends install \
    python3-paraview xvfb xauth libgl1-mesa-dri
  (cd "$root" && tar -c Testing/with-display.sh Testing/Install Testing/Python/runner.py) |
    tar -x -C "$debian/tmp"
  inside "$debian" env "PV_PLUGIN_PATH=$(dirname "$plugin")" bash /tmp/Testing/with-display.sh \
    pvpython /tmp/Testing/Install/TestInstalledPlugin.py
}

# What belonged to the package is gone, or is a folder of other packages.
remove_package()
{
  inside "$debian" apt-get -q -y purge limpid-paraview
  local left
  # shellcheck disable=SC2016
  left="$(inside "$debian" bash -c '
    while read -r path; do
      if [[ -e "$path" ]] && ! dpkg -S "$path" &> /dev/null; then echo "$path"; fi
    done' < "$chroots/files")"
  if [[ -n "$left" ]]; then
    echo "Still there after the removal of the package: $left" >&2
    return 1
  fi
}

package="$(make_package)"
make_debian "$release" "$debian"
inside "$debian" apt-get -q update
install_package "$package"
expect_all_libraries
show_a_volume
remove_package
rm -rf --one-file-system "$debian"
echo "$(basename "$package"): installed, used and removed in $release"
