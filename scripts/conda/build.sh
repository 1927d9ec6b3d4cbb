#!/usr/bin/env bash
# Called by conda build, with its own compilers and prefix.
set -euo pipefail
cmake -G Ninja -S "$SRC_DIR" -B build $CMAKE_ARGS -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON \
  -DCMAKE_UNITY_BUILD_BATCH_SIZE=32 -DMISALIGN_TESTS=OFF
cmake --build build -j "$CPU_COUNT"
cmake --install build --prefix "$PREFIX"
