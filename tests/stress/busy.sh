#!/usr/bin/env bash
# Tests on a busy machine: beside loops that never rest, each of them so many times.
#   busy.sh [--loops N] TIMES TEST...
# N loops (8); a TEST is one of ctest's in build/release, such as system.watch. Says how often each passed, and ends
# with 1 if one did not every time.
set -euo pipefail
cd "$(dirname "$0")/../.."
loops=8
[ "${1:-}" = --loops ] && loops=$2 && shift 2
times=$1
shift
busy=()
trap 'kill "${busy[@]}"' EXIT
for ((k = 0; k < loops; ++k)); do
  while :; do :; done &
  busy+=($!)
done
log=build/busy.log failed=0
for test; do
  passed=0 longest_s=0
  for ((k = 0; k < times; ++k)); do
    begin=$SECONDS
    if ctest --test-dir build/release -R "^${test//./\\.}\$" --no-tests=error --output-on-failure > $log 2>&1; then
      passed=$((passed + 1))
    else
      cat $log
      failed=1
    fi
    [ $((SECONDS - begin)) -gt $longest_s ] && longest_s=$((SECONDS - begin))
  done
  echo "$test: $passed of $times passed beside $loops loops on $(nproc) cores, the longest in $longest_s s"
done
exit $failed
