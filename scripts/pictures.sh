#!/usr/bin/env bash
# Makes the pictures of README, of results/report, and those of the manual that show the page, the gallery or moving
# sheets: pictures.sh [BUILD [WORK]]: with the program and the web tests of that build folder [build/release]; campaigns,
# reports and frames are kept in WORK [build/pictures]; campaigns that are there are resumed, and the elastic panels not
# run again.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/packages.sh
need_packages $site_packages python3-pil chromium
build=$(realpath "${1:-build/release}")
work=$(realpath -m "${2:-build/pictures}")
[ -d "$build/tests/report/node_modules" ] || { echo "$build has no web tests: cmake -DMISALIGN_TESTS=ON" >&2; exit 1; }
export PATH="$build:$PATH" PYTHONPATH="$build/python" PYTHONDONTWRITEBYTECODE=1 MPLBACKEND=Agg LC_ALL=C.UTF-8
export NODE_PATH=$build/tests/report/node_modules
mkdir -p "$work"
draw=50666  # the best of the first million
campaigns=search/campaigns patterns=search/patterns manual=search/manual/pictures results=results/report

pictures() { /usr/bin/python3 scripts/pictures.py "$@"; }
search() { misalign search "$@" --progress none --log-level error > "$work/search.txt"; }
report() { (cd "$work" && misalign report "$@"); }  # pages show commands: no paths of this machine
# shots PAGE FOLDER PARTS [ADDRESS]: into FOLDER, with fewer colours.
shots() {
  node tests/report/screenshots.mjs "$1" "$work/shots" "$3" "${4:-}"
  pictures smaller "$work"/shots/*.png
  mkdir -p "$2"
  mv "$work"/shots/*.png "$2"
}

# The main campaign, from 165 degrees.
sed 's/"deploys_from_deg": 170/"deploys_from_deg": 165/' $campaigns/miura-6x6.json > "$work/six.json"
search "$work/six.json" --catalogue "$work/six.db" --draws 1000000 --ranks 2
misalign tolerance "$work/six.db" --best 20 --amplitude 0.05 --trials 100 > "$work/tolerance.txt"
report six.db --stroke-limit 0.08 --output six.html
shots "$work/six.html" $results overview,candidates,folding,charts,facts draw=$draw
rm -rf "$work/film"
node tests/report/screenshots.mjs "$work/six.html" "$work/film" film draw=$draw
pictures moving "$work/film" $results/deployment.webp

# The paper's sheet, rigid and with elastic panels.
misalign report $patterns/table1.json --output "$work/table1.html"
shots "$work/table1.html" $results/pattern overview,folding,charts,facts
[ -e "$work/stress/table1-stress.json" ] ||
  misalign stress $patterns/table1.json --output "$work/stress" > "$work/stress.txt"  # minutes
misalign report $patterns/table1.json --stress "$work/stress/table1-stress.json" --contact --output "$work/stress.html"
shots "$work/stress.html" $results/stress folding,charts

# A campaign that is watched.
rm -f "$work"/{four.db*,url}
search $campaigns/miura-4x4.json --catalogue "$work/four.db" --draws 1000
(cd "$work" && exec misalign watch four.db --port 0 > url) &
watcher=$!
misalign search $campaigns/miura-4x4.json --catalogue "$work/four.db" --draws 100000000 --progress none --log-level error &
searcher=$!
end() { kill $watcher $searcher 2> /dev/null || true; wait; }
trap end EXIT
until [ -s "$work/url" ]; do sleep 0.2; done
sleep 15  # some ten thousand candidates
shots "$(grep -o 'http:[^ ]*' "$work/url")" "$work/kept" watch
end
cp "$work/kept/watch-light.png" $results

# The manual: the page in tutorials, two figures of the gallery, drawings.
search $campaigns/miura-4x4.json --catalogue "$work/first.db" --draws 20000
report first.db --best 5 --output first.html
shots "$work/first.html" "$work/kept" candidates
cp "$work/kept/candidates-light.png" $manual/campaign.png
cp $results/pattern/folding-light.png $manual/first-sheet.png
for figure in target_shapes acceptance_by_angle; do
  pictures figure $figure "$manual/${figure//_/-}.png"
done
/usr/bin/python3 scripts/drawing.py
/usr/bin/python3 scripts/moving_picture.py
git status --short results/report search/manual
