# Kits of plates with hinges, to cut and to print, rebuilt from their files and folded by coordinates.
. "$(dirname "$0")/lib.sh"
patterns=$source_dir/search/patterns
for python in /usr/bin/python3 python3 none; do
  "$python" -c 'import ezdxf, numpy' 2> /dev/null && break
done
[ "$python" != none ] || { fail "no Python has ezdxf and numpy"; finish; }
export PYTHONPATH=$source_dir/tests/system

echo '{ "name": "8x6", "pattern": { "family": "miura", "rows": 8, "columns": 6, "panel_width_mm": 60,
  "panel_height_mm": 90, "zigzag_offset_mm": 20 }, "misalignment": { "amplitude_mm": 0.4 },
  "accept": { "deploys_from_deg": 120 }, "seed": 1 }' > 8x6-campaign.json
"$program" search 8x6-campaign.json --catalogue w.db --draws 100 --progress none > /dev/null || fail "search 8x6"
"$program" export w.db --draw "$(sql w.db 'SELECT min(draw) FROM candidate')" --output drawn > names &&
  mv "$(cat names)" 8x6.json

"$program" shape "$patterns/dome-6x6.json" --output dome.json > /dev/null || fail "shape"

# kit FILE CREASE THICKNESS FROM OPTION...: a kit to cut of plates, to be looked at below.
kits=0
kit() {
  local file=$1 crease=$2 thickness=$3 from=$4 sheet checked
  shift 4
  kits=$((kits + 1))
  sheet=sheets/$(basename "$file" .json).fold
  [ -f "$sheet" ] || "$program" export "$file" --format fold --step 10 --output sheets > /dev/null || fail "$file: fold"
  "$program" export "$file" --format dxf --kit --crease "$crease" --thickness "$thickness" --from "$from" --gap 15 \
    "$@" --output kit$kits > names || fail "$file $crease"
  checked=$*
  echo "$sheet $(head -1 names) --crease $crease --thickness $thickness --from $from $checked"
}
bores="--joint-bore 1.2 --spring-bore 1.5"
{
  # shellcheck disable=SC2086
  kit "$patterns/table1.json" film 3 90 $bores
  # shellcheck disable=SC2086
  kit "$patterns/table1.json" bevel 3 90 $bores
  # shellcheck disable=SC2086
  kit "$patterns/table1.json" pin 3 90 $bores --barrel 3 --clearance 0.2
  # shellcheck disable=SC2086
  kit 8x6.json film 2 60 $bores --clearance 0.1
  kit 8x6.json bevel 2 60
  kit 8x6.json pin 2 60 --barrel 2 --clearance 0.2
  kit dome.json pin 2 90 --barrel 2 --clearance 0.2
  # shellcheck disable=SC2086
  kit "$patterns/table1.json" offset 1.5 90 $bores --spacer 0.2
  kit 8x6.json offset 1 60 --clearance 0.1
  kit dome.json film 2 90
  kit dome.json offset 1 90
} > checks
spacers=$(echo kit8/*-kit-spacers.dxf)
# shellcheck disable=SC2086
echo "sheets/table1.fold $spacers --crease offset --thickness 0.2 --from 90 $bores" >> checks
# What sees nothing wrong must be able to: thicker plates of the same contours overlap.
sed -n '1,2s/$/ --thicker 3.4 --wrong/p; 3s/$/ --thicker 6 --wrong/p; 8s/$/ --thicker 2 --wrong/p' checks > wrong
"$python" -B "$source_dir/tests/system/plate_kit_check.py" < checks || fail "kits of plates"
"$python" -B "$source_dir/tests/system/plate_kit_check.py" < wrong > /dev/null || fail "thicker plates: nothing overlaps"

# Ball joints: their play is that of the drawn bores in folded plates, a card judges it, and so do trials.
options="--crease bevel --thickness 3 --from 90 --joint loop --joint-bore 1.5 --wire 1.2"
# shellcheck disable=SC2086
"$program" export "$patterns/table1.json" --format dxf --kit $options --guide --gap 15 --output joints > names || fail "joints"
play=$(grep -o 'play is [0-9.]* mm' "$(tail -1 names)" | grep -o '[0-9.]*[0-9]')
echo "sheets/table1.fold $(head -1 names) ${options/--joint loop/} --play $play" |
  "$python" -B "$source_dir/tests/system/plate_kit_check.py" || fail "play of ball joints"
echo "sheets/table1.fold $(head -1 names) ${options/--joint loop/} --play 0.31 --wrong" |
  "$python" -B "$source_dir/tests/system/plate_kit_check.py" > /dev/null || fail "another play is not seen"
# The card of a design with plates and these hinges has the play of its kit.
sed 's/"holes"/"design": { "from_deg": 90, "thickness_mm": 3, "hinges": { "kind": "bevel" }, "joints": { "kind": "loop", "bore_mm": 1.5, "wire_mm": 1.2 } }, "holes"/' "$patterns/table1.json" > plates.json
"$program" card plates.json --no-remedies --trials 5 --json > card.json 2> err
of_plates=$(sqlite3 :memory: "SELECT json_extract(value, '\$.wanted') FROM json_each(json_extract(readfile('card.json'),
  '\$.lines')) WHERE json_extract(value, '\$.key') = 'play_mm'")
[ "$(printf '%.2f' "$of_plates")" = "$(printf '%.2f' "$play")" ] || fail "plates: the card's play is $of_plates, the kit's $play"
"$program" card "$patterns/table1.json" --from 60 --no-remedies --trials 5 --json --joint loop --joint-bore 1.5 \
  --wire 1.2 > card.json 2> err
"$program" export "$patterns/table1.json" --format dxf --kit --from 60 --joint loop --joint-bore 1.5 --wire 1.2 --guide \
  --output scored > names || fail "joints of a scored kit"
play=$(grep -o 'play is [0-9.]* mm' "$(tail -1 names)" | grep -o '[0-9.]*[0-9]')
wanted=$(sqlite3 :memory: "SELECT json_extract(value, '\$.wanted') FROM json_each(json_extract(readfile('card.json'),
  '\$.lines')) WHERE json_extract(value, '\$.key') = 'play_mm'")
[ "$(printf '%.2f' "$wanted")" = "$(printf '%.2f' "$play")" ] || fail "the card's play is $wanted, the kit's $play: $(cat err)"
sed 's/"holes"/"design": { "from_deg": 60, "joints": { "kind": "ball", "clearance_mm": 0.01 } }, "holes"/' \
  "$patterns/table1.json" > balls.json
"$program" tolerance balls.json --trials 5 --json > loose.json || fail "trials of joints"
grep -q '"backlash_mm": 0.005' loose.json || fail "the play of balls: $(grep backlash loose.json)"

# Films of the hinge table: their free length is the least gap.
kit "$patterns/table1.json" film 1 60 --hinge "polyester film 0.1 mm" > film
sed -i 's/--hinge.*/--film 2/' film
"$python" -B "$source_dir/tests/system/plate_kit_check.py" < film || fail "films with a free length"

# Plates to print: closed, and clear of each other.
for crease in film bevel pin; do
  options="--kit --crease $crease --thickness 4 --from 90 --joint-bore 1.5 --spring-bore 1.5"
  [ $crease = pin ] || options+=" --clearance 0.1"
  for format in stl 3mf; do
    # shellcheck disable=SC2086
    "$program" export "$patterns/table1.json" --format $format $options --output print-$crease > names-$format ||
      fail "print $crease as $format"
  done
  # shellcheck disable=SC2046
  "$python" -B "$source_dir/tests/system/print_check.py" sheets/table1.fold 90 "$(cat names-3mf)" $(cat names-stl) ||
    fail "printed plates: $crease"
done

# Balls in sockets: closed shells, clear of each other; where they swing too far they are refused.
options="--kit --crease bevel --thickness 4 --from 60 --trim 6 --joint ball --ball 5 --clearance 0.1"
for format in stl 3mf; do
  # shellcheck disable=SC2086
  "$program" export "$patterns/table1.json" --format $format $options --output print-ball > names-$format ||
    fail "print balls as $format"
done
# shellcheck disable=SC2046
"$python" -B "$source_dir/tests/system/print_check.py" sheets/table1.fold 60 "$(cat names-3mf)" $(cat names-stl) ||
  fail "printed balls"

# Tabs: a strip for each joint.
"$program" export "$patterns/table1.json" --format dxf --kit --joint tab --joint-bore 1.2 --output tabs > names || fail "tabs"
# The corners of plates are trimmed by 5 mm: nothing clamps a tab nearer to its vertex.
"$program" export "$patterns/table1.json" --format dxf --kit --crease film --thickness 2 --from 60 --joint tab --joint-bore 1.2 \
  --output thick-tabs > others || fail "tabs of plates"
grep -q "free length of 10 mm" thick-tabs/table1-kit.html || fail "tabs of plates are clamped where no plate is"
grep -q "kit-strips.dxf" names || fail "no strips of tabs: $(cat names)"

# Plates for 60 degrees are within one another at 90.
for format in stl 3mf; do
  "$program" export "$patterns/table1.json" --format $format --kit --crease film --thickness 4 --from 60 --output early \
    > names-$format || fail "print for 60 degrees"
done
# shellcheck disable=SC2046
"$python" -B "$source_dir/tests/system/print_check.py" sheets/table1.fold 90 "$(cat names-3mf)" $(cat names-stl) \
  > out 2>&1 && fail "plates for 60 degrees at 90: nothing is seen"
grep -q "lie within" out || fail "plates for 60 degrees: $(tail -1 out)"

# refused WORDS OPTION...: one sentence.
refused() {
  local words=$1
  shift
  "$program" export "$patterns/table1.json" --kit --output never "$@" > /dev/null 2> err && fail "$*: not refused"
  [ "$(wc -l < err)" = 1 ] && grep -q -- "$words" err || fail "$*: $(cat err)"
}
refused "more than a tenth of their thickness" --format dxf --crease butt --thickness 0.2 --from 90
refused "allow-misfit" --format dxf --crease butt --thickness 0.2 --from 90
refused "too thick" --format dxf --crease film --thickness 9 --from 90
refused "add --thickness" --format dxf --crease film
refused "thicker than the bores" --format dxf --joint loop --joint-bore 1 --wire 1.2
refused "have no bores" --format dxf --joint ball --joint-bore 1
refused "no hinge of printed plates" --format stl --crease score --thickness 3 --from 90
refused "less than 0.6 mm of material" --format stl --crease pin --thickness 2 --from 90
refused "no meaning without" --format dxf --crease pin --thickness 3 --from 90 --pin 1
refused "no meaning without --crease offset" --format dxf --crease film --thickness 3 --from 90 --spacer 1
refused "no meaning without --crease offset" --format dxf --spacer 1
refused "no meaning without --crease pin" --format dxf --barrel 3
refused "no meaning without --joint ball" --format stl --crease bevel --thickness 3 --from 60 --ball 5
refused "take --spring-at panel" --format dxf --joint tab --joint-bore 1.2 --spring-bore 1.5
refused "a height, spacers included" --format dxf --crease offset --thickness 9 --from 90
refused "no hinge of printed plates" --format stl --crease offset --thickness 1 --from 90
refused "not held by its socket" --format stl --crease bevel --thickness 1 --from 150 --joint ball
refused "less than the radius of sockets" --format stl --crease bevel --thickness 2 --from 60 --trim 2 --joint ball --ball 5
refused "too long for the tab" --format dxf --joint tab --joint-bore 1.2 --bore-edge 0.1
"$program" export "$patterns/table1.json" --format 3mf --output never > /dev/null 2> err && fail "3mf without --kit"
grep -q "add --kit" err || fail "3mf without --kit: $(cat err)"
"$program" export "$patterns/table1.json" --format dxf --kit --crease butt --thickness 0.2 --from 90 --allow-misfit \
  --output butt > names || fail "butt with consent"
grep -q "miss by" butt/table1-kit.html || fail "the misfit is not said"

# Without a thickness hinges of a design are cut creases, as before.
sed 's/"holes"/"design": { "hinges": { "like": "printed pin hinge" } }, "holes"/' "$patterns/table1.json" > pins.json
"$program" export pins.json --format svg --kit --output pins > names || fail "pins without a thickness"
"$program" export "$patterns/table1.json" --format svg --kit --crease cut --output cut > others || fail "cut"
cmp -s <(grep -v misalign: "$(head -1 names)") <(grep -v misalign: "$(head -1 others)") || fail "pins without a thickness are no cut creases"
finish
