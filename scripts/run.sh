#!/usr/bin/env bash
# Installs what is missing, builds half of the program, runs the main campaign with it on all cores for about a minute
# (again: goes on from there), shows candidates after ten seconds and the best at the end, builds the whole program,
# exports the best one, writes a report to look at, and builds the rest.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/packages.sh
need_packages $build_packages

cmake --preset release -DMISALIGN_TESTS=OFF -DMISALIGN_PYTHON=ON > /dev/null
program=build/release/misalign
if [ ! -x $program ]; then  # half of it first; later calls use the whole one
  echo "Building what searches first; what exports, reports and checks is built after the search."
  cmake --build --preset release --target misalign_first
  program=build/release/first/misalign
else
  cmake --build --preset release --target misalign
fi

search() {  # for so many seconds; sets catalogue and what is said of it
  summary=$("$program" search search/campaigns/miura-6x6.json --ranks all --draws 1000000000 --max-time "$1")
  catalogue=${summary%%:*}
}
best() {
  echo
  echo "$1 (misalign query $catalogue best):"
  "$program" query "$catalogue" best --no-pager
}
seconds=${1:-60} first_s=10
if [ "${seconds%.*}" -gt $first_s ]; then
  search $first_s
  best "The best candidates so far"
  echo
  search $((${seconds%.*} - first_s))
else
  search "$seconds"
fi

echo
echo "$summary"
"$program" status "$catalogue"
best "The best candidates"
echo
echo "Building the whole program:"
cmake --build --preset release --target misalign
program=build/release/misalign
echo
echo "The best one, as JSON:"
"$program" export "$catalogue" --best 1 --format json --output results/candidates
echo
echo "Everything to look at, in a browser:"
"$program" report "$catalogue" --output results/report.html
echo
echo "Building the rest:"
cmake --build --preset release  # all that `cmake --install` takes
