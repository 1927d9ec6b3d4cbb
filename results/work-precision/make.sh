#!/usr/bin/env bash
# Makes methods.csv, mesh.csv, their figures and the README's tables anew (under ten minutes on one
# core): installs what is missing, builds, measures, draws. With `draw` only figures and tables, from
# the CSV files that are there.
set -euo pipefail
cd "$(dirname "$0")/../.."
. scripts/packages.sh
python3 -c 'import matplotlib' 2> /dev/null || need_packages python3-matplotlib
here=results/work-precision

if [ "${1:-}" != draw ]; then
  need_packages $build_packages $quick_packages $test_packages libsundials-dev
  cmake --preset release -DMISALIGN_TESTS=ON > /dev/null
  cmake --build --preset release --target work_precision
  program=build/release/tests/work_precision
  "$program" --mesh > "$here/mesh.csv.new"
  "$program" > "$here/methods.csv.new"
  mv "$here/mesh.csv.new" "$here/mesh.csv"
  mv "$here/methods.csv.new" "$here/methods.csv"
fi
python3 -B "$here/draw.py"
python3 -B "$here/tables.py"
