#!/usr/bin/env bash
# Installs what is missing, builds with warnings as errors, runs every test, and the unit tests once
# more under the address and undefined-behaviour sanitizers.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/packages.sh

stage() {  # ends the last stage with how long it took, and begins the next
  [ -z "${begun_s-}" ] || echo "== $stage: $((SECONDS - begun_s)) s"
  stage=$1 begun_s=$SECONDS
}
stage "packages and layout"
need_packages $build_packages $test_packages $hosts_packages
scripts/check.sh

stage "build"
cmake --preset release -DMISALIGN_TESTS=ON -DMISALIGN_WERROR=ON -DMISALIGN_PYTHON=ON > /dev/null
cmake --build --preset release

# Beside the tests of the release, of which many wait: the unit tests under the sanitizers, two programs at a
# time. Tests that follow hundreds of paths, or a path in steps of 0.01 degrees, take minutes there and run no
# code of their own; the lanes are templates, of which the narrowest will do. Without line numbers, which take time to make, and without checks of every pointer
# (for null, size, alignment and overflow: what it does wrong the address sanitizer sees) it takes half of the
# time: what is found is looked at again with the preset as it is, which checks all.
sanitized() {
  cmake --preset asan -DMISALIGN_WERROR=ON -DMISALIGN_REPORT=OFF -DMISALIGN_WIDE_LANES=OFF \
    -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-Og -fno-sanitize=null,alignment,object-size,pointer-overflow" > /dev/null
  # The largest files first, so that no core is idle at the end.
  cmake --build --preset asan --target search_test -- -j 2
  cmake --build --preset asan --target solver_test schema_test certificate_test -- -j 2
  local many_paths
  many_paths='*IsometryOnEverySample*:*StepsOfTheSolver*:*SamplesDoNotMove*:*LargeShifts*:DrawEvaluator.Instr*:DrawEvaluator.TurnsNext*'
  many_paths+=':ToleranceTest.Instr*:ToleranceTest.Trials*:ToleranceTest.Most*:ToleranceTest.NoErr*:ToleranceTest.Threads*'
  many_paths+=':MergeTest.Pieces*:MergeTest.Overlaps*:MergeTest.Disagree*:MergeTest.Verdicts*:MergeTest.Undecided*'
  many_paths+=':Splitting.EveryInstr*:Splitting.Pilots*:Splitting.PiecesKeep*:Splitting.Accepted*:Score.IsTheSame*:VerifyTest.AGood*'
  many_paths+=':SoftStop.IsTheSame*:*BatchTest.Failing*/baseline:Drawn/Acceptance*/3:DegreeFour.FoldsAs*'
  many_paths+=':*BatchTest*/avx2:Golden.AllV*:FewDiagonals.OfMany*:LookBetween.Sees*:*ExactBumps.AreThose*'
  many_paths+=':*OlderCatalogues*/1:*OlderCatalogues*/2:*OlderCatalogues*/3:*OlderCatalogues*/4:*OlderCatalogues*/5:SnapshotTest*:DrawEvaluator.UnitsThatAreFull*:VerifyTest.ARemoved*:NothingFound.Guesses*:StoredCertificates.AreJoined*:*OlderCatalogues.AreVerified*:HostilePieces.PiecesThatLie*'
  printf '%s\n' {search,solver,schema,certificate}_test\ {0,1} | GTEST_FILTER="-$many_paths" GTEST_TOTAL_SHARDS=2 \
    xargs -P 2 -L 1 sh -c 'cd build/asan/tests && GTEST_SHARD_INDEX=$1 ./"$0" --gtest_brief=1'
}
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
stage "all"
echo "== all: $SECONDS s"
