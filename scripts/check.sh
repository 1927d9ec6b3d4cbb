#!/usr/bin/env bash
# Format of the C++ files, that standard output has one door, that files and functions are short and no
# include points to a later folder, that no number of scripts/house.json is worse, that what is said of the code names
# what it has, that the manual holds together, is spelled and uses the field's words, and that all files name one version.
# Instead with
#   --lint [--write]: ESLint and Prettier on the page's JavaScript; --write lays it out;
#   --tidy [PATTERN] [--for SECONDS]: clang-tidy on every room, or on those that match, such as 'solver/(pattern|linear)';
#     the first time takes many minutes, then what has changed since it was clean.
set -euo pipefail
cd "$(dirname "$0")/.."
tidy() {
  # Needs the package clang-tidy. A configuration of its own: g++'s precompiled headers are none of clang's.
  cmake --preset release -B build/tidy -DMISALIGN_TESTS=OFF -DMISALIGN_PYTHON=ON \
    -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON > /dev/null
  cmake --build build/tidy --target build_info > /dev/null  # generated, and a source
  python3 scripts/tidy.py build/tidy "$@"
}
# ESLint and Prettier as the lock file pins them, beside what they are told.
lint() {
  mkdir -p build/lint
  cp scripts/lint/* scripts/lint/.npmrc build/lint
  (cd build/lint && npm ci --silent)
  build/lint/node_modules/.bin/prettier --config build/lint/prettier.json --log-level warn "${1:---check}" \
    {schema,tests}/report/'*.{js,mjs}'
  build/lint/node_modules/.bin/eslint --config build/lint/eslint.config.js schema/report tests/report
}
case "${1:-}" in
  --tidy) shift; tidy "$@"; exit ;;
  --lint) lint "${2:-}"; exit ;;
esac

mapfile -t files < <(git ls-files '*.cpp' '*.hpp')
clang-format --dry-run --Werror "${files[@]}"
if git grep -nE 'std::(printf|puts|putchar|cout)\b|fwrite\(|fput[sc]\(.*stdout|^ *stdout\);|STDOUT_FILENO,' -- \
  'search/*.cpp' 'schema/*.cpp' ':!search/terminal/terminal.cpp'; then
  echo "text goes to standard output by put, put_json and put_csv (search/terminal/terminal.hpp)" >&2
  exit 1
fi
python3 scripts/house.py --check
python3 scripts/names.py
python3 scripts/manual.py
python3 scripts/words.py --check
# mpirun's own options are known to who starts it.
if git grep -nE '\bkExit[A-Z]|search/verbs/border|^[^/]*"--[a-z]' -- 'solver/*.[ch]pp' 'schema/*.[ch]pp' 'search/*.[ch]pp' \
  ':!search/verbs' ':!search/python/errors.cpp' | grep -vE '"--(host|bind-to)"'; then
  echo "exit codes and options are known to search/verbs; below, a Cause, an OptionFault or parameter(...)" >&2
  exit 1
fi
# One version everywhere.
version=$(sed -nE 's/^project\(misalign VERSION ([0-9.]+) .*/\1/p' CMakeLists.txt)
for place in 'CITATION.cff:^version: ' 'scripts/Containerfile:version="' 'scripts/conda/meta.yaml:version = "' \
  'scripts/spack/spack_repo/misalign/packages/misalign/package.py:version("'; do
  grep -q "${place#*:}$version" "${place%%:*}" || { echo "${place%%:*}: its version is not $version" >&2; exit 1; }
done
[ "$(sed -nE 's/^## \[([0-9.]+)\].*/\1/p' CHANGELOG.md | head -1)" = "$version" ] ||
  { echo "CHANGELOG.md: its latest version is not $version" >&2; exit 1; }
