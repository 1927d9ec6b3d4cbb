#!/usr/bin/env bash
# Format of the C++ files, that standard output has one door, and that files and functions are short and
# no include points to a later folder; with --tidy also clang-tidy on the build in build/release.
set -euo pipefail
cd "$(dirname "$0")/.."
mapfile -t files < <(git ls-files '*.cpp' '*.hpp')
clang-format --dry-run --Werror "${files[@]}"
if git grep -nE 'std::(printf|puts|putchar|cout)\b|fwrite\(|fput[sc]\(.*stdout|^ *stdout\);|STDOUT_FILENO,' -- \
  'search/*.cpp' 'schema/*.cpp' ':!search/terminal/terminal.cpp'; then
  echo "text goes to standard output by put, put_json and put_csv (search/terminal/terminal.hpp)" >&2
  exit 1
fi
python3 scripts/house.py --check
if [ "${1:-}" = --tidy ]; then
  clang-tidy -p build/release --quiet $(git ls-files 'solver/*.cpp' 'schema/*.cpp' 'search/*.cpp')
fi
