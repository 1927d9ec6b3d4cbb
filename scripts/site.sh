#!/usr/bin/env bash
# Makes the manual as a site, build/site/html/index.html: search/manual, the other Markdown files, reference pages
# from the program, and figures that the scripts of search/python/gallery draw. Nothing is fetched.
# site.sh [FOLDER]: with the program of that build folder [build/release].
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/packages.sh
need_packages $site_packages
build=$(realpath "${1:-build/release}")
[ -x "$build/misalign" ] || { echo "$build/misalign is not there: scripts/run.sh 1 builds it" >&2; exit 1; }
begun_s=$SECONDS

rm -rf build/site
mkdir -p build/site
export PATH="$build:$PATH" PYTHONPATH="$build/python" PYTHONDONTWRITEBYTECODE=1 MPLBACKEND=Agg LC_ALL=C.UTF-8
/usr/bin/python3 scripts/site/stage.py "$build/misalign" build/site
/usr/bin/python3 -m sphinx -q -W --keep-going -j auto -c scripts/site -d build/site/doctrees \
  build/site/pages build/site/html
echo "build/site/html/index.html: $(find build/site/html -name '*.html' | wc -l) pages in $((SECONDS - begun_s)) s"
