#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# Checks the sources in ways that the build does not.
#   bash Testing/check.sh [format] [spelling] [licences] [hosting] [tidy] [tidy-tests] [clang]
#     [sanitize] [threads] [fuzz] [tidy-changed] [sanitize-all] [threads-all] [coverage]
# Without arguments: all but the last four. The first four take seconds and need no build. Testing/tools.txt
# sets the versions of their tools.
# format        compares the layout of all sources with .clang-format.
# spelling      looks for misspelt words. .codespellrc lists exceptions.
# licences      checks that every file states its copyright and licence (REUSE).
# hosting       checks the files for GitHub and GitLab against their schemas.
# tidy          runs clang-tidy on the product, as the C++ compiler sees it in build/: build there first.
# tidy-tests    does so on Testing/, which takes as long again and more.
# tidy-changed  does so on the sources that differ from the commit LIMPID_BASE (main). For a header, it
#               takes the source of the same name, or else one that includes it.
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
# coverage      builds the core and its tests in build/coverage, runs the quick ones, and prints the share
#               of the core's lines that ran. build/coverage/report/index.html shows the lines.

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
cd "$root"

tool() { bash Testing/tool.sh "$@"; }

check_format()
{
  find Documentation cuda Filters Plugin Representations Testing -name '*.h' -print0 -o -name '*.cxx' -print0 |
    xargs -0 bash Testing/tool.sh clang-format --dry-run -Werror
}

check_spelling() { git ls-files -z | xargs -0 bash Testing/tool.sh codespell; }

check_licences() { tool reuse lint --lines; }

check_hosting()
{
  tool check-jsonschema --builtin-schema vendor.github-workflows .github/workflows/*.yml
  tool check-jsonschema --builtin-schema vendor.gitlab-ci .gitlab-ci.yml
  tool check-jsonschema --builtin-schema vendor.github-issue-forms .github/ISSUE_TEMPLATE/[!c]*.yml
  tool check-jsonschema --builtin-schema vendor.github-issue-config .github/ISSUE_TEMPLATE/config.yml
  tool check-jsonschema --builtin-schema vendor.citation-file-format CITATION.cff
}

# Runs clang-tidy on some sources, or on those in some folders.
tidy()
{
  if [[ ! -f build/compile_commands.json ]]; then
    echo "There is no build/ to tell how sources are compiled. Run Testing/run.sh first." >&2
    exit 1
  fi
  # What nvcc compiles has options that clang does not know, and the C++ compiler sees most of it.
  mkdir -p build/tidy
  python3 - "$root" "$@" > build/tidy/sources << 'EOF'
import json, pathlib, re, sys
root = pathlib.Path(sys.argv[1])
named = [root / name for name in sys.argv[2:]]
def is_named(file):
    return any(path == file or path in file.parents for path in named)
# The sources that are compiled by a command: several if CMake has joined them in a file.
def sources_of(entry):
    file = pathlib.Path(entry["file"])
    joined = "Unity" in file.parts and file.exists()
    return re.findall(r'#include "([^"]+)"', file.read_text()) if joined else [entry["file"]]
commands = [{**entry, "file": source, "command": entry["command"].replace(entry["file"], source)}
            for entry in json.loads((root / "build/compile_commands.json").read_text())
            if "nvcc" not in entry["command"].split()[0]
            for source in sources_of(entry) if is_named(pathlib.Path(source))]
(root / "build/tidy/compile_commands.json").write_text(json.dumps(commands))
print("\n".join(sorted({entry["file"] for entry in commands})))
EOF
  xargs -r -P "$(nproc)" -n 4 -a build/tidy/sources \
    clang-tidy -p build/tidy --quiet --warnings-as-errors='*' 2> build/tidy/messages ||
    { grep -E "error:" build/tidy/messages || true; return 1; }
}

check_tidy() { tidy cuda Filters Plugin Representations; }
check_tidy-tests() { tidy Testing; }

# The sources that have changed since a commit, and one for each header that has.
changed_sources()
{
  local file
  while read -r file; do
    if [[ "$file" == *.h && -f "${file%.h}.cxx" ]]; then
      echo "${file%.h}.cxx"
    elif [[ "$file" == *.h ]]; then
      grep -rlE --include='*.cxx' "[\"/]$(basename "$file")\"" cuda Filters Plugin Representations Testing |
        head -1 || true
    else
      echo "$file"
    fi
  done < <(git diff --name-only --diff-filter=d --merge-base "$1" -- '*.h' '*.cxx')
}

check_tidy-changed()
{
  local base="${LIMPID_BASE:-main}" sources
  if ! git rev-parse --quiet --verify "$base^{commit}" > /dev/null; then
    echo "There is no commit $base to compare with. Set LIMPID_BASE to one, and fetch it first." >&2
    exit 1
  fi
  mapfile -t sources < <(changed_sources "$base" | sort -u)
  echo "Sources that differ from $base: ${sources[*]:-none}"
  if ((${#sources[@]} > 0)); then
    tidy "${sources[@]}"
  fi
}

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
  local tbb
  tbb="$(bash Testing/thread-sanitized-tbb.sh build/sanitize-thread/tbb | tail -1)"
  configure_sanitized sanitize-thread -DTBB_DIR="$tbb"
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

check_coverage()
{
  cmake --preset coverage
  cmake --build --preset coverage
  find build/coverage -name '*.gcda' -delete
  ctest --preset coverage --label-regex '^quick$' --parallel "$(nproc)" --exclude-regex '^(House|Install)'
  mkdir -p build/coverage/report
  # Threads count without locks, so a few counts are wrong. Only whether a line ran is used.
  tool gcovr --root . --filter cuda/ --object-directory build/coverage build/coverage/cuda build/coverage/Testing \
    --gcov-ignore-parse-errors=negative_hits.warn --gcov-ignore-parse-errors=suspicious_hits.warn \
    --merge-mode-functions=merge-use-line-0 \
    --exclude-unreachable-branches --html-details build/coverage/report/index.html --print-summary \
    --txt build/coverage/report/files.txt
}

quick=(format spelling licences hosting)
usual=("${quick[@]}" tidy tidy-tests clang sanitize threads fuzz)
others=(tidy-changed sanitize-all threads-all coverage)
if (($# == 0)); then
  set -- "${usual[@]}"
fi
for check; do
  if [[ " ${usual[*]} ${others[*]} " != *" $check "* ]]; then
    echo "Unknown check: $check. There are: ${usual[*]} ${others[*]}." >&2
    exit 1
  fi
  if [[ " ${quick[*]} " != *" $check "* ]]; then
    bash Testing/install-packages.sh
  fi
  "check_$check"
done
