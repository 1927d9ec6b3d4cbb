#!/usr/bin/env bash
# Installs what is missing, builds with warnings as errors, runs every test, and the unit tests once
# more under the address and undefined-behaviour sanitizers.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/packages.sh
need_packages $build_packages $test_packages $hosts_packages

scripts/check.sh

cmake --preset release -DMISALIGN_TESTS=ON -DMISALIGN_WERROR=ON > /dev/null
cmake --build --preset release
cmake --preset asan -DMISALIGN_WERROR=ON > /dev/null
cmake --build --preset asan --target solver_test schema_test search_test

# Tests that follow hundreds of paths take minutes under the sanitizers and run no code of their own.
echo "== sanitizers: unit tests"
many_paths='IsometryOnEverySample|StepsOfTheSolver|SamplesDoNotMove|LargeShifts|Trial.Instr'
many_paths+='|ToleranceTest.(Instr|Trials|Most|NoErr|Threads)|MergeTest.(Pieces|Overlaps|Disagree)'
many_paths+='|SnapshotTest|Trial.UnitsThatAreFull|VerifyTest.ARemoved|NothingFound.Guesses'
ctest --preset asan -E "^system|^stress|NOT_BUILT|$many_paths" -j 2
echo "== release: every test"
ctest --preset release -j 3  # many of them wait
