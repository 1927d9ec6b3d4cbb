#!/usr/bin/env bash
# Makes the manual as a site: search/manual, the other Markdown files, reference pages from the program, and figures
# that the scripts of search/python/gallery draw. Nothing is fetched. The first page is build/site/html/index.html.
# site.sh [BUILD [SITE]]: with the program of that build folder [build/release], into that folder [build/site].
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/packages.sh
need_packages $site_packages
build=$(realpath "${1:-build/release}")
export MISALIGN_SITE
MISALIGN_SITE=$(realpath -m "${2:-build/site}")
[ -x "$build/misalign" ] || { echo "$build/misalign is not there: scripts/run.sh 1 builds it" >&2; exit 1; }
[ -d "$build/python" ] || { echo "$build has no Python package: cmake -DMISALIGN_PYTHON=ON" >&2; exit 1; }
begun_s=$SECONDS

# Only what this script has made is removed.
mark=$MISALIGN_SITE/made-by-site.sh
if [ -n "$(ls -A "$MISALIGN_SITE" 2> /dev/null)" ] && [ ! -e "$mark" ]; then
  echo "$MISALIGN_SITE is there, and no site that this script made; remove it, or name another folder" >&2
  exit 2
fi
rm -rf "$MISALIGN_SITE"
mkdir -p "$MISALIGN_SITE"
touch "$mark"
export PATH="$build:$PATH" PYTHONPATH="$build/python" PYTHONDONTWRITEBYTECODE=1 MPLBACKEND=Agg LC_ALL=C.UTF-8
/usr/bin/python3 scripts/site/stage.py "$build/misalign" "$MISALIGN_SITE"
/usr/bin/python3 -m sphinx -q -W --keep-going -j auto -c scripts/site -d "$MISALIGN_SITE/doctrees" \
  "$MISALIGN_SITE/pages" "$MISALIGN_SITE/html.part"
# Debian 12's furo is not bundled: its script imports another, which a page that is a file may not, and its style one of
# a web server.
theme=$MISALIGN_SITE/html.part/_static
if grep -q '^import Gumshoe' "$theme/scripts/furo.js"; then
  { cat "$theme/scripts/gumshoe-patched.js"; grep -v '^import Gumshoe' "$theme/scripts/furo.js"; } > "$theme/bundled.js"
  mv "$theme/bundled.js" "$theme/scripts/furo.js"
fi
sed -i '/^@import url(.*normalize/d' "$theme/styles/furo.css"
mv "$MISALIGN_SITE/html.part" "$MISALIGN_SITE/html"  # whole, whenever it is there
pages=$(find "$MISALIGN_SITE/html" -name '*.html' | wc -l)
echo "$MISALIGN_SITE/html/index.html: $pages pages in $((SECONDS - begun_s)) s"
