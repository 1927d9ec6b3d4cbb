#!/usr/bin/env bash
# Format of the C++ files; with --tidy also clang-tidy on the build in build/release.
set -euo pipefail
cd "$(dirname "$0")/.."
mapfile -t files < <(git ls-files '*.cpp' '*.hpp')
clang-format --dry-run --Werror "${files[@]}"
if [ "${1:-}" = --tidy ]; then
  clang-tidy -p build/release --quiet $(git ls-files 'solver/*.cpp' 'schema/*.cpp' 'search/*.cpp')
fi
