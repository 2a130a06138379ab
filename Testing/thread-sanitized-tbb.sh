#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Builds oneTBB from the source of Debian's package with the sanitizer of threads, into a folder.
#   bash Testing/thread-sanitized-tbb.sh FOLDER
# The sanitizer does not see what happens in a library that was built without it: with Debian's own,
# every hand-over from one thread to another is reported as a race.
# Says on its last line where the CMake package is.

set -euo pipefail

folder="$(mkdir -p "$1" && cd "$1" && pwd)"
if [[ ! -d "$folder/installed" ]]; then
  # The same places that packages come from, asked for sources.
  mkdir -p "$folder/sources.d" "$folder/lists" "$folder/source"
  for file in /etc/apt/sources.list.d/*.sources; do
    [[ -f "$file" ]] && sed 's/^Types:.*/Types: deb-src/' "$file" > "$folder/sources.d/$(basename "$file")"
  done
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [[ -f "$file" ]] && sed -n 's/^deb /deb-src /p' "$file" > "$folder/sources.d/$(basename "$file" .list).list"
  done
  apt=(apt-get -q -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$folder/sources.d"
    -o Dir::State::Lists="$folder/lists" -o APT::Sandbox::User=root)
  "${apt[@]}" update
  (cd "$folder" && "${apt[@]}" source --download-only onetbb)
  tar -C "$folder/source" --strip-components=1 -xf "$folder"/onetbb_*.orig.tar.*
  cmake -S "$folder/source" -B "$folder/build" -G Ninja -Wno-dev \
    -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DTBB_SANITIZE=thread -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF \
    -DCMAKE_INSTALL_PREFIX="$folder/made"
  cmake --build "$folder/build"
  cmake --install "$folder/build" > /dev/null
  mv "$folder/made" "$folder/installed"
fi
dirname "$(find "$folder/installed" -name TBBConfig.cmake)"
