#!/usr/bin/env bash
# The long fuzzing of the FOLD reader: fuzz.sh [INPUTS [SANITIZED_INPUTS [SEED]]]
# INPUTS (ten million) by the release build on two cores, SANITIZED_INPUTS (500,000) more under the
# address and undefined-behaviour sanitizers, a tenth of them chosen by libFuzzer's coverage. Stops at the
# first crash, leak or hang, and prints the input.
set -euo pipefail
cd "$(dirname "$0")/../.."
. scripts/packages.sh
need_packages $build_packages clang libclang-rt-dev
inputs=${1:-10000000} sanitized=${2:-500000} seed=${3:-1}

cmake --preset release > /dev/null
cmake --build --preset release --target fold_fuzz
both() { # PROGRAM INPUTS: half on each core, with seeds of their own
  "$1" $(($2 / 2)) "$seed" & local one=$!
  "$1" $(($2 / 2)) $((seed + 1)) & local other=$!
  wait $one && wait $other
}
both build/release/tests/fold_fuzz "$inputs"

# What the reader needs, without the rest of the program.
sources="schema/fold_format.cpp schema/input.cpp schema/pattern_file.cpp schema/plane_mesh.cpp solver/base_folding.cpp
  solver/crease_pattern.cpp solver/degree_four.cpp solver/half_angle.cpp solver/loop_closure.cpp
  solver/mechanism.cpp solver/miura.cpp solver/newton.cpp solver/perforation.cpp"
work=build/fuzz
mkdir -p $work/corpus
sanitized_build() { # OUTPUT COMPILER FLAG...
  local output=$1
  shift
  "$@" -std=c++20 -O1 -g1 -ffp-contract=off -fno-sanitize-recover=all -I. -isystem /usr/include/eigen3 \
    -DMISALIGN_SOURCE_DIR="\"$PWD\"" tests/stress/fold_fuzz.cpp $sources -o "$output"
}
sanitized_build $work/fold_fuzz g++ -fsanitize=address,undefined
both $work/fold_fuzz $((sanitized * 9 / 10))
sanitized_build $work/libfuzzer clang++ -fsanitize=fuzzer,address,undefined -DMISALIGN_LIBFUZZER
$work/fold_fuzz --corpus $work/corpus
$work/libfuzzer -runs=$((sanitized / 10)) -seed="$seed" -timeout=10 -max_len=8192 -artifact_prefix=$work/ \
  -print_final_stats=1 $work/corpus
