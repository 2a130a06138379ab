#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Checks the sources in ways that the build does not.
#   bash Testing/check.sh [format] [tidy] [tidy-tests] [clang] [sanitize] [threads] [fuzz]
#     [sanitize-all] [threads-all]
# Without arguments: all but the last two.
# format        compares the layout of all sources with .clang-format.
# tidy          runs clang-tidy on the product, as the C++ compiler sees it in build/: build there first.
# tidy-tests    does so on Testing/, which takes as long again and more.
# clang         builds the core and its tests with clang, in build/clang, and runs the quick ones.
# sanitize      builds core, filters and their tests with the sanitizers of addresses and of undefined
#               behaviour, in build/sanitize, and runs a selection of the quick ones.
# sanitize-all  runs all of the quick ones there, which takes half an hour.
# threads       builds the same with the sanitizer of threads, in build/sanitize-thread, against a
#               oneTBB that is built so, and runs what has threads.
# threads-all   runs all of the quick tests there.
# fuzz          feeds solver and filter with what libFuzzer makes up of LIMPID_FUZZ_SEED (1), which is
#               about the same each time, for LIMPID_FUZZ_SECONDS (60) each, in build/sanitize, which
#               keeps what it has found: the next run goes on from there.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
cd "$root"
# Each version of clang-format has a layout of its own.
layout_version=14

check_format()
{
  local formatter=clang-format
  if command -v "clang-format-$layout_version" > /dev/null; then
    formatter="clang-format-$layout_version"
  fi
  local version
  version="$("$formatter" --version | grep -oE 'version [0-9]+')"
  if [[ "$version" != "version $layout_version" ]]; then
    echo "The layout is not checked: it is that of clang-format $layout_version, here is $version."
    return
  fi
  find Documentation cuda Filters Plugin Representations Testing -name '*.h' -print0 -o -name '*.cxx' -print0 |
    xargs -0 "$formatter" --dry-run -Werror
}

# Runs clang-tidy on the sources in some folders.
tidy()
{
  if [[ ! -f build/compile_commands.json ]]; then
    echo "There is no build/ to tell how sources are compiled. Run Testing/run.sh first." >&2
    exit 1
  fi
  # What nvcc compiles has options that clang does not know, and the C++ compiler sees most of it.
  mkdir -p build/tidy
  python3 - "$root" "$@" > build/tidy/sources << 'EOF'
import json, pathlib, sys
root = pathlib.Path(sys.argv[1])
folders = [root / name for name in sys.argv[2:]]
commands = [entry for entry in json.loads((root / "build/compile_commands.json").read_text())
            if "nvcc" not in entry["command"].split()[0]
            and any(folder in pathlib.Path(entry["file"]).parents for folder in folders)]
(root / "build/tidy/compile_commands.json").write_text(json.dumps(commands))
print("\n".join(sorted({entry["file"] for entry in commands})))
EOF
  xargs -P "$(nproc)" -n 4 -a build/tidy/sources \
    clang-tidy -p build/tidy --quiet --warnings-as-errors='*' 2> build/tidy/messages ||
    { grep -E "error:" build/tidy/messages || true; return 1; }
}

check_tidy() { tidy cuda Filters Plugin Representations; }
check_tidy-tests() { tidy Testing; }

check_clang()
{
  cmake --preset clang
  cmake --build --preset clang
  ctest --preset clang --label-regex '^quick$' --parallel "$(nproc)"
}

# Configures a preset of sanitizers, with the VTK that ParaView uses; then come other options.
configure_sanitized()
{
  local vtk
  vtk="$(bash Testing/vtk-folder.sh)"
  cmake --preset "$1" -Wno-dev -DVTK_DIR="$vtk" -DPython3_EXECUTABLE=/usr/bin/python3 "${@:2}"
}

# VTK and the drivers keep some things to the end, which are no leaks.
sanitizer_options()
{
  export ASAN_OPTIONS=detect_leaks=0
  export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
  export TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1
}

# Python would have to load the sanitizer first. What tests the references, or pretends to be a GPU,
# takes long and tells nothing of the product.
not_sanitized='^(Python|House|Benchmarks|Scenes|PretendedGpu|RayMarch|PictureMarch|PaperScheme)'

check_sanitize-all()
{
  configure_sanitized sanitize
  cmake --build --preset sanitize
  sanitizer_options
  ctest --preset sanitize --label-regex '^quick$' --parallel "$(nproc)" --exclude-regex "$not_sanitized"
}

# Some of the random scenes, and no tests that take more than seconds.
check_sanitize()
{
  configure_sanitized sanitize
  cmake --build --preset sanitize
  sanitizer_options
  LIMPID_ONE_OF=25 ctest --preset sanitize --label-regex '^quick$' --parallel "$(nproc)" \
    --exclude-regex "$not_sanitized|^Quick/|FindViewpoints|ViewScore|ScoreDerivative|ObliqueView|TurnedBox|ScoredBox|AndSearch|OfTheViewpoint|Guide|^Faults|OfDevice|^Gpu|RealSharedScene|DependOnThePieces"
}

check_threads()
{
  configure_sanitized sanitize-thread \
    -DTBB_DIR="$(bash Testing/thread-sanitized-tbb.sh build/sanitize-thread/tbb | tail -1)"
  cmake --build --preset sanitize-thread --target test_core_plan test_core_properties \
    test_core_sequences test_core_invariance test_core_renderer test_filter_threads
  sanitizer_options
  LIMPID_ONE_OF=25 ctest --preset sanitize-thread --parallel "$(nproc)" --tests-regex \
    '^(ThreadTeam|FilterThreads|SceneProperties|Sequences|SolverInvariance|SolverSkips|RendererInvariance)'
}

check_threads-all()
{
  check_threads
  cmake --build --preset sanitize-thread
  ctest --preset sanitize-thread --label-regex '^quick$' --parallel "$(nproc)" --exclude-regex "$not_sanitized"
}

check_fuzz()
{
  configure_sanitized sanitize
  cmake --build --preset sanitize --target fuzz_solver fuzz_filter
  for fuzzer in fuzz_solver fuzz_filter; do
    mkdir -p "build/sanitize/corpus/$fuzzer"
    "build/sanitize/bin/$fuzzer" -seed="${LIMPID_FUZZ_SEED:-1}" \
      -max_total_time="${LIMPID_FUZZ_SECONDS:-60}" -max_len=4096 \
      -len_control=0 -detect_leaks=0 -print_final_stats=1 -verbosity=0 \
      -artifact_prefix="build/sanitize/$fuzzer-" "build/sanitize/corpus/$fuzzer"
  done
}

bash Testing/install-packages.sh
for check in "${@:-all}"; do
  case "$check" in
    all)
      check_format; check_tidy; check_tidy-tests; check_clang; check_sanitize; check_threads; check_fuzz ;;
    format | tidy | tidy-tests | clang | sanitize | sanitize-all | threads | threads-all | fuzz) "check_$check" ;;
    *)
      echo "Unknown check: $check. There are those that the first lines of this file name." >&2
      exit 1
      ;;
  esac
done
