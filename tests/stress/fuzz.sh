#!/usr/bin/env bash
# The long fuzzing of all that is read: meshes, campaign and pattern files, exported candidates, catalogues.
#   fuzz.sh [--sanitized] [MESHES [CAMPAIGNS [CANDIDATES [CATALOGUES [SEED]]]]]
# So many inputs each (ten million, ten million, 1,000,000, 100,000; 0 leaves a kind out) by the release
# build on two cores, and then a twentieth as many under the address and undefined-behaviour sanitizers, a
# tenth of those of meshes and campaigns chosen by libFuzzer's coverage; --sanitized: so many of each, under
# the sanitizers alone. In parts of seeds SEED, SEED + 1, ... (1),
# whose results are kept in build/fuzz: a part that is there is not run again. Stops at the first crash,
# leak or hang, and keeps the input as a file there.
set -euo pipefail
cd "$(dirname "$0")/../.."
. scripts/packages.sh
need_packages $build_packages clang libclang-rt-dev
sanitized=
[ "${1:-}" = --sanitized ] && sanitized=yes && shift
meshes=${1:-10000000} campaigns=${2:-10000000} candidates=${3:-1000000} catalogues=${4:-100000} seed=${5:-1}
parts=20
work=build/fuzz
mkdir -p $work
trap 'kill $(jobs -p) 2> /dev/null || true' EXIT

run_part() { # PRESET NAME INPUTS SEED
  local result=$PWD/$work/$1-$2-$3-$4.txt program=$PWD/build/$1/tests/$2
  [ -f "$result" ] && return
  (cd $work && "$program" "$3" "$4" > "$result.part") || return
  mv "$result.part" "$result"
}
run() { # PRESET NAME INPUTS: in parts, half of them on each core
  local inputs=$(($3 / parts)) lane part
  [ $inputs -gt 0 ] || return 0
  for lane in 0 1; do
    for ((part = lane; part < parts; part += 2)); do
      run_part "$1" "$2" $inputs $((seed + part)) || exit
    done &
  done
  wait -n
  wait -n
  echo "$2, $1: $parts times $inputs inputs, seeds $seed to $((seed + parts - 1))"
  for ((part = 0; part < parts; ++part)); do
    tail -n +2 $work/"$1-$2-$inputs-$((seed + part)).txt"
  done
}
all() { # PRESET SHARE
  cmake --preset "$1" > /dev/null
  cmake --build --preset "$1" --target fold_fuzz campaign_fuzz candidate_fuzz catalogue_fuzz
  run "$1" fold_fuzz $((meshes / $2))
  run "$1" campaign_fuzz $((campaigns / $2))
  run "$1" candidate_fuzz $((candidates / $2))
  run "$1" catalogue_fuzz $((catalogues / $2))
}
if [ -n "$sanitized" ]; then
  all asan 1
  exit
fi
all release 1
all asan 20

# What the readers of JSON need, without the rest of the program; the list of keys is made by CMake.
sources=$(ls schema/files/*.cpp schema/pattern/*.cpp schema/campaign/*.cpp schema/catalogue/digest.cpp solver/pattern/*.cpp \
  solver/kinematics/*.cpp solver/linear/{mobility,newton}.cpp | grep -v key_list)
by_coverage() { # NAME INPUTS
  [ "$2" -gt 0 ] || return 0
  clang++ -std=c++20 -O1 -g1 -ffp-contract=off -fno-sanitize-recover=all -fsanitize=fuzzer,address,undefined \
    -DMISALIGN_LIBFUZZER -DMISALIGN_SOURCE_DIR="\"$PWD\"" -I. -isystem /usr/include/eigen3 \
    "tests/stress/$1.cpp" $sources -lfmt -lsqlite3 -lxxhash -o $work/"$1-libfuzzer"
  build/release/tests/"$1" --corpus $work/"$1-corpus"
  $work/"$1-libfuzzer" -runs="$2" -seed="$seed" -timeout=60 -max_len=8192 -artifact_prefix=$work/ \
    -print_final_stats=1 $work/"$1-corpus"
}
by_coverage fold_fuzz $((meshes / 200))
by_coverage campaign_fuzz $((campaigns / 200))
