#!/usr/bin/env bash
# Installs what is missing, builds and runs every unit test and the system tests that are quick; after scripts/run.sh,
# only tests are left to be built. --all: with warnings as errors, every test there is, ESLint, four minutes of
# clang-tidy, and what is built on request only. --sanitized: the unit tests once more under the address and
# undefined-behaviour sanitizers, which takes as long again; results/reliability/README.md says when it last ran.
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

# Two programs at a time. *Slow* are those that take minutes here and run no code of their own.
sanitized() {
  stage "packages"
  need_packages $build_packages $quick_packages
  stage "build with sanitizers"
  cmake --preset asan -DMISALIGN_WERROR=ON > /dev/null
  # The largest files first, so that no core is idle at the end.
  cmake --build --preset asan --target search_test
  cmake --build --preset asan --target solver_test schema_test certificate_test
  stage "unit tests with sanitizers"
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
  stage "release: every test"
  ctest --preset release -j 3
  stage "studies, which are built on request"
  cmake --build --preset release --target studies
  stage "the core alone"
  bash tests/system/core.sh "$PWD/build/release/misalign" "$PWD" -DMISALIGN_WERROR=ON $once
}

case "${1-}" in
  "") quick ;;
  --all) all ;;
  --sanitized) sanitized ;;
  *) echo "usage: scripts/test.sh [--all | --sanitized]" >&2; exit 2 ;;
esac
stage "done"
echo "== in all: $SECONDS s"
[ $# -gt 0 ] || echo "scripts/test.sh --all adds: warnings as errors, the long system tests (Python, browser, cluster," \
  "packages, core alone), ESLint, four minutes of clang-tidy and the programs of the studies. With sanitizers:" \
  "scripts/test.sh --sanitized. clang-tidy of all rooms: scripts/check.sh --tidy."
