#!/usr/bin/env bash
# Installs what is missing, builds and runs every unit test and the system tests that are quick; after scripts/run.sh,
# only tests are left to be built. --all: with warnings as errors, every test there is, ESLint, four minutes of
# clang-tidy, what is built on request only, and the unit tests once more under the address and undefined-behaviour
# sanitizers.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/packages.sh

stage() {  # ends the last stage with how long it took, and begins the next
  [ -z "${begun_s-}" ] || echo "== $stage: $((SECONDS - begun_s)) s"
  stage=$1 begun_s=$SECONDS
}
configure() { cmake --preset release -DMISALIGN_TESTS=ON -DMISALIGN_PYTHON=ON "$@" > /dev/null; }

quick() {
  stage "packages and layout"
  need_packages $build_packages $quick_packages
  scripts/check.sh
  stage "build"
  configure
  cmake --build --preset release --target quick
  stage "unit tests and quick system tests"
  ctest --preset release -L quick -j 3
}

# The unit tests, two programs at a time. *Slow* are those that take minutes here and run no code of their own.
sanitized() {
  cmake --preset asan -DMISALIGN_WERROR=ON > /dev/null
  # The largest files first, so that no core is idle at the end.
  cmake --build --preset asan --target search_test -- -j 2
  cmake --build --preset asan --target solver_test schema_test certificate_test -- -j 2
  printf '%s\n' {search,solver,schema,certificate}_test\ {0,1} | GTEST_FILTER='-*Slow*' GTEST_TOTAL_SHARDS=2 \
    xargs -P 2 -L 1 sh -c 'cd build/asan/tests && GTEST_SHARD_INDEX=$1 ./"$0" --gtest_brief=1'
}

all() {
  # What the core and the whole program compile alike is compiled once.
  once=-DCMAKE_CXX_COMPILER_LAUNCHER=ccache
  export CCACHE_DIR=$PWD/build/ccache CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1 CCACHE_DEPEND=1 CCACHE_MAXSIZE=1G
  stage "packages and layout"
  need_packages $build_packages $quick_packages ccache
  scripts/check.sh
  stage "ESLint"
  scripts/check.sh --lint
  stage "build; packages of the other tests beside it"
  mkdir -p build
  need_packages $test_packages $hosts_packages > build/packages.log 2>&1 &
  packages=$!
  configure -DMISALIGN_WERROR=ON $once
  cmake --build --preset release
  wait $packages || { cat build/packages.log; exit 1; }
  stage "clang-tidy: what the last commits changed, then rooms in turn"
  scripts/check.sh --tidy --for 240
  # Beside the tests of the release, of which many wait.
  stage "release: every test; sanitizers beside it"
  log=build/sanitizers.log
  set -m  # a process group of its own: whoever ends it ends its compilers and tests
  sanitized > $log 2>&1 &
  sanitizers=$!
  set +m
  trap 'kill -- -$sanitizers 2> /dev/null && wait $sanitizers || true' EXIT
  ctest --preset release -j 3
  stage "sanitizers, what was left of them"
  wait $sanitizers || { cat $log; exit 1; }
  grep PASSED $log
  stage "studies, which are built on request"
  cmake --build --preset release --target studies
  stage "the core alone"
  bash tests/system/core.sh "$PWD/build/release/misalign" "$PWD" -DMISALIGN_WERROR=ON $once
}

case "${1-}" in
  "") quick ;;
  --all) all ;;
  *) echo "usage: scripts/test.sh [--all]" >&2; exit 2 ;;
esac
stage "done"
echo "== in all: $SECONDS s"
[ "${1-}" = --all ] || echo "scripts/test.sh --all adds: warnings as errors, the long system tests (Python, browser," \
  "cluster, packages, core alone), sanitizers, ESLint, four minutes of clang-tidy and the programs of the" \
  "studies. clang-tidy of all rooms: scripts/check.sh --tidy."
