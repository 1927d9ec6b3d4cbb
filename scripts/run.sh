#!/usr/bin/env bash
# Installs what is missing, builds, runs the main campaign on all cores for about a minute (again: goes
# on from there), shows the best candidates, exports the best one and writes a report to look at.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/packages.sh
need_packages $build_packages

cmake --preset release -DMISALIGN_TESTS=OFF -DMISALIGN_PYTHON=ON > /dev/null
cmake --build --preset release  # all that `cmake --install` takes
program=build/release/misalign

summary=$("$program" search search/campaigns/miura-6x6.json --ranks all --draws 1000000000 \
  --max-time "${1:-60}")
catalogue=${summary%%:*}

echo
echo "$summary"
"$program" status "$catalogue"
echo
echo "The best candidates (misalign query $catalogue best):"
"$program" query "$catalogue" best --no-pager
echo
echo "The best one, as JSON:"
"$program" export "$catalogue" --best 1 --format json --output results/candidates
echo
echo "Everything to look at, in a browser:"
"$program" report "$catalogue" --output results/report.html
