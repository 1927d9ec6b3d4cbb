#!/usr/bin/env bash
# Makes methods.csv, mesh.csv and their figures anew (six minutes on one core): installs what is
# missing, builds, measures, draws. With `draw` only the figures, from the tables that are there.
set -euo pipefail
cd "$(dirname "$0")/../.."
. scripts/packages.sh
command -v python3 > /dev/null || need_packages python3
here=results/work-precision

if [ "${1:-}" != draw ]; then
  need_packages $build_packages $test_packages libsundials-dev
  cmake --preset release -DMISALIGN_TESTS=ON > /dev/null
  cmake --build --preset release --target work_precision
  program=build/release/tests/work_precision
  "$program" --mesh > "$here/mesh.csv.new"
  "$program" > "$here/methods.csv.new"
  mv "$here/mesh.csv.new" "$here/mesh.csv"
  mv "$here/methods.csv.new" "$here/methods.csv"
fi
python3 "$here/draw.py"
