# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# For scripts to source that try something in another Debian: one in a folder that debootstrap fills.
# Nothing of this machine is in it but what a script copies there. All needs root and debootstrap.

can_make_debian() { ((EUID == 0)) && command -v debootstrap > /dev/null; }

# Makes Debian's smallest system anew: make_debian RELEASE FOLDER
make_debian()
{
  rm -rf --one-file-system "$2"
  mkdir -p "$(dirname "$2")"
  debootstrap --variant=minbase "$1" "$2" > "$2-debootstrap.log"
  # debootstrap leaves this to who installs a machine.
  echo "127.0.0.1 localhost" > "$2/etc/hosts"
  # A mirror of some weeks ago will do.
  echo 'Acquire::Check-Valid-Until "false";' > "$2/etc/apt/apt.conf.d/any-mirror"
}

# Runs a command there, with processes and memory files of its own: inside FOLDER COMMAND...
# The first process is a shell that waits: others do not hear what they expect of their parent, if
# that is the first (Xvfb, timeout).
inside()
{
  # shellcheck disable=SC2016
  unshare --mount --pid --fork --kill-child bash -c '
    mount -t proc proc "$0/proc"
    mkdir -p "$0/dev/shm"
    mount -t tmpfs tmpfs "$0/dev/shm"
    env -i HOME=/root LANG=C.UTF-8 TERM=dumb DEBIAN_FRONTEND=noninteractive \
      PATH=/usr/sbin:/usr/bin:/sbin:/bin chroot "$0" bash -c "\"\$@\"; exit \$?" _ "$@"
    exit $?' "$@"
}
