#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Runs both commands of the README on releases of Debian, from a clone of the last commit, and writes
# what came of them into Documentation/Compatibility.md.
#   bash Testing/releases.sh [--keep] [--clang] [RELEASE]...
# RELEASE   bookworm, trixie or sid; all three by default.
# --keep    goes on in the folder of the last run: its packages and its build stay.
# --clang   builds the core by the release's clang, too, and runs its tests.
# Each release is a folder of LIMPID_RELEASES (/var/tmp/limpid-releases) that debootstrap makes anew:
# nothing of this machine is in it but the clone, the test scenes and a /proc of its own. Needs root
# and debootstrap, about 6 GB of disk and half an hour on two cores for each.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
source "$root/Testing/another-debian.sh"
folders="${LIMPID_RELEASES:-/var/tmp/limpid-releases}"
scenes="${LIMPID_TEST_DATA:-$root/../shared/data}"
keep=0
clang=0
releases=()
for argument in "$@"; do
  case "$argument" in
    --keep) keep=1 ;;
    --clang) clang=1 ;;
    bookworm | trixie | sid) releases+=("$argument") ;;
    *)
      echo "$argument is no release that is tried here. Use: releases.sh [--keep] [--clang]" \
        "[bookworm|trixie|sid]..." >&2
      exit 2
      ;;
  esac
done
if ((${#releases[@]} == 0)); then
  releases=(bookworm trixie sid)
fi
if ! can_make_debian; then
  echo "Other releases are installed into folders of their own: that needs root and debootstrap." >&2
  exit 1
fi

# Fills a release's folder with Debian's smallest system and a clone of the last commit.
prepare()
{
  local folder="$folders/$1"
  if ((!keep)) || [[ ! -d "$folder" ]]; then
    make_debian "$1" "$folder"
  fi
  local clone="$folder/limpid"
  if [[ ! -d "$clone/.git" ]]; then
    git clone --quiet --no-hardlinks "$root" "$clone"
  fi
  git -C "$clone" fetch --quiet "$root" HEAD
  git -C "$clone" reset --quiet --hard FETCH_HEAD
  if [[ -d "$scenes" && ! -d "$folder/shared/data" ]]; then
    mkdir -p "$folder/shared"
    cp -r "$scenes" "$folder/shared/data"
  fi
}

# Runs a command of the repository in a release and notes its exit code and its seconds.
note()
{
  local release="$1" name="$2"
  shift 2
  local start=$SECONDS code=0
  inside "$folders/$release" bash -c 'cd /limpid && exec "$@"' _ "$@" \
    > "$folders/$release-$name.log" 2>&1 || code=$?
  echo "$name $code $((SECONDS - start))" >> "$folders/$release-commands"
  echo "$release: $* ended with $code after $((SECONDS - start)) s ($folders/$release-$name.log)"
}

failed=0
for release in "${releases[@]}"; do
  prepare "$release"
  : > "$folders/$release-commands"
  note "$release" demo bash Documentation/Examples/demo.sh
  note "$release" tests bash Testing/run.sh
  if ((clang)); then
    note "$release" clang bash Testing/check.sh clang
  fi
  inside "$folders/$release" bash /limpid/Testing/versions.sh > "$folders/$release-versions"
  if grep -qv " 0 [0-9]*$" "$folders/$release-commands"; then
    failed=1
  fi
  python3 "$root/Testing/releases_page.py" "$root/Documentation" "$folders" "$release"
done
exit "$failed"
