# The card: each number is what its own verb says, each requirement the design's; pages, refusals.
. "$(dirname "$0")/lib.sh"
table1=$source_dir/search/patterns/table1.json
block='"design": { "from_deg": 140, "thickness_mm": 0.5, "miscut_mm": 0.02, "play_mm": 0.002,
  "springs": { "stiffness_n_per_mm": 2, "stroke_limit": 0.08, "preload_n": 0.01, "largest_force_n": 3 },
  "hinges": { "friction_n_mm_per_mm": 0.00001, "pin_friction_mm": 0.05 },
  "wanted": { "margin_to_deg": 20, "static_margin": 0.5, "energy_margin": 2, "yield": 0.9, "landing_deg_per_s": 1e6 },
  "material": { "name": "birch", "e_gpa": 12, "density_g_per_cm3": 0.68, "strength_mpa": 40 } }'
sed "s|\"accept\"|${block//$'\n'/ }, \"accept\"|" "$source_dir/search/campaigns/miura-4x4.json" > mine.json
"$program" search mine.json --draws 200 --catalogue mine.db > /dev/null 2>&1 || fail "search"
draw=$(sql mine.db 'SELECT draw FROM candidates ORDER BY miscut_margin_mm DESC LIMIT 1')
# card CODE ARGUMENT...: a card that ends with this code, 0 where it passes and 6 where it does not.
card() {
  "$program" card "${@:2}" --no-remedies
  [ $? = "$1" ] || fail "card ${*:2} ends with another code than $1"
}
card 6 mine.db "$draw" --trials 200 --json > card.json 2> err || fail "card: $(cat err)"

# line KEY WHAT: "found", say, of a requirement.
line() { sqlite3 :memory: "SELECT value ->> '\$.$2' FROM json_each(readfile('card.json'), '\$.lines') WHERE value ->> '\$.key' = '$1'"; }
# is KEY WANTED FOUND: to 1e-12 of itself.
is() {
  [ "$(line "$1" wanted)" = "$2" ] || fail "$1: asked are $(line "$1" wanted), not $2"
  [ "$(sqlite3 :memory: "SELECT abs($(line "$1" found) - ($3)) <= 1e-12 * abs($3)")" = 1 ] ||
    fail "$1: found is $(line "$1" found), not $3"
}
of() { "$program" "$1" mine.db "$draw" --json "${@:3}" > of.json 2> err && field of.json "$2" || fail "$*: $(cat err)"; }
is deploys_from_deg 140.0 "$(sql mine.db "SELECT deploys_from_deg FROM candidate WHERE draw = $draw")"
is certified_deg 140.0 "$(of certify certified_deg)"
is thickness_mm 0.5 "$(of contact thickness.largest_mm)"
is energy_margin 2.0 "$(of deploy bent.bent_critical_friction_n_mm_per_mm) / 1e-5 - 1"
is static_margin 0.5 "$(of deploy bent.static_margin)"
[ "$(of deploy bent.to_deg)" = 20.0 ] || fail "margins down to the angle that is wanted"
is largest_stress_mpa 40.0 "$(of deploy bent.largest_stress_mpa)"
is landing_deg_per_s 1000000.0 "abs($(of deploy events[1].rate_deg_per_s))"
is pin_margin_in_middle 2.0 "$(of deploy pins.in_middle.critical_mm) / 0.05 - 1"
is pin_margin_at_ends 2.0 "$(of deploy pins.at_ends.critical_mm) / 0.05 - 1"
is buckling_factor 1.5 "$(of deploy bent.buckling.least.factor)"
is unstable_modes_at_flat 0.0 "$(of deploy bent.preload.unstable_modes_at_flat)"
is spring_clearance_mm 0.0 "$(of contact springs.springs.closest.clear_mm --diameter 5)"
is stroke 0.08 "$("$program" actuators mine.db "$draw" --json > of.json && sqlite3 :memory: "SELECT max(abs(value ->> '\$.force_n' / 2
  + value ->> '\$.free_mm' - f) / f) FROM (SELECT value, value ->> '\$.free_mm' + sign(value ->> '\$.force_n') * 0.005 AS f
  FROM json_each(readfile('of.json'), '\$.forces'))")"
"$program" replay mine.db "$draw" --json > replayed.json || fail "replay"
is least_stroke_mm 0.02 "$(sqlite3 :memory: "SELECT min((SELECT max(abs(value - d.value ->> '\$.flat_mm')) FROM json_each(d.value, '\$.length_mm')
  WHERE key < 140)) FROM json_each(readfile('replayed.json'), '\$.diagonals') AS d")"
is largest_force_n 3.0 "$(sqlite3 :memory: "SELECT max(abs(value ->> '\$.force_n')) FROM json_each(readfile('of.json'), '\$.forces')")"
is yield 0.9 "$(of tolerance from_threshold.share --trials 200 --no-keep)"
is play_mm 0.002 "$(of tolerance largest.backlash_mm --trials 200 --backlash 0.002)"
for key in deploys_from_deg largest_force_n; do
  case $key in *force*) sign="<=" ;; *) sign=">=" ;; esac
  [ "$(line $key passes)" = "$(sqlite3 :memory: "SELECT $(line $key found) $sign $(line $key wanted)")" ] || fail "$key passes"
done
passed=$(sqlite3 :memory: "SELECT count(*) FROM json_each(readfile('card.json'), '\$.lines') WHERE value ->> '\$.passes'")
[ "$(field card.json passed)" = "$passed" ] || fail "how many pass"
"$program" card mine.db "$draw" --no-remedies --trials 200 --jobs 2 --json | cmp -s - card.json || fail "threads change the card"

# An exported candidate has the same card, but for seeds of copies; the page says the same.
"$program" export mine.db --draw "$draw" --output out > names || fail "export"
card 6 "$(cat names)" --trials 200 --output card.html > words
asked=$(field card.json asked)
grep -q ": fails $((asked - $(field card.json passed))) of $asked requirements$" words || fail "the words: $(head -1 words)"
[ "$(grep -c '^pass\|^FAIL' words)" = "$asked" ] || fail "a row for each requirement"
[ "$(grep -o '<td>pass</td>\|<td>FAIL</td>' card.html | wc -l)" = "$asked" ] || fail "the page's rows"
grep -q '<td>A[0-9]*-A[0-9]*</td>' card.html && grep -q '<svg' card.html || fail "springs and pictures"

# Pages that fail, that pass, and that pass if held at flat: banner and bars are the JSON's, text can be read.
# page CODE ARGUMENT...: of a card that ends with this code.
page() {
  card "$@" --json --output look.html > look.json
  python3 -B "$source_dir/tests/system/card_page.py" "$source_dir/schema/report/page.css" look.html look.json ||
    fail "the page of card ${*:2}"
}
one_a_hole='{"kind": "springs", "on": "one_a_hole"}'
page 6 mine.db "$draw" --trials 200
page 0 "$table1" --from 60 --fill "$one_a_hole"
page 6 "$table1" --from 60 --fill "${one_a_hole%\}}, \"preload_n\": 0.1}"
page 6 "$table1"
chromium=${CHROMIUM:-/usr/bin/chromium}
if [ -x "$chromium" ]; then  # 6 x 6 panels and 16 springs on one side of A4
  "$chromium" --headless --no-sandbox --disable-gpu --user-data-dir="$work/browser" --no-pdf-header-footer \
    --print-to-pdf=look.pdf look.html > out.txt 2>&1
  [ "$(grep -ac '/Type /Page$' look.pdf)" = 1 ] || fail "pages of A4: $(grep -ac '/Type /Page$' look.pdf)"
fi

# A bare pattern is judged by what every sheet needs; one spring a hole from 60 degrees has it all.
card 6 "$table1" --json > bare.json
[ "$(field bare.json asked) $(field bare.json passed)" = "6 5" ] || fail "a bare card asks $(field bare.json asked)"
[ "$(sqlite3 :memory: "SELECT group_concat(value ->> '\$.key') FROM json_each(readfile('bare.json'), '\$.lines') WHERE NOT value ->> '\$.passes'")" = \
  spring_clearance_mm ] || fail "what fails of a bare card"
[ "$(field bare.json from_deg)" = 156.0 ] || fail "up to D"
card 0 "$table1" --from 60 --fill '{"kind": "springs", "on": "one_a_hole"}' > words
grep -q "used between 60° and flat: meets all 7 requirements$" words || fail "one spring a hole: $(cat words)"
card 6 "$table1" --from 170 --json > far.json
[ "$(field far.json passes)" = 0 ] && [ "$(field far.json passed)" = 4 ] || fail "beyond D passes: $(field far.json passed)"

# A preload pushes the sheet out of flat: a part holds it, by the design or by an option.
preloaded='{"kind": "springs", "on": "one_a_hole", "preload_n": 0.1}'
card 6 "$table1" --from 60 --fill "$preloaded" > words
grep -q ": meets all 8 requirements if a stop, latch or frame holds it flat$" words || fail "a preload: $(head -1 words)"
card 0 "$table1" --from 60 --fill "$preloaded" --hold-flat > words
grep -q ": meets all 7 requirements$" words || fail "held at flat: $(head -1 words)"
sed 's|"holes"|"design": { "hold_flat": true }, "holes"|' "$table1" > held.json
card 0 held.json --from 60 --fill "$preloaded" > /dev/null
sed 's|true|"yes"|' held.json > bad.json
"$program" card bad.json > out.txt 2> err
[ $? = 3 ] && grep -q 'design.hold_flat = "yes"' err || fail "hold_flat as a word: $(cat err)"

# Shifts of 0.04 micrometres, as a mesh written with four decimals has them: it deploys on paper alone.
sed 's/0\.4/0.00004/g' "$table1" > tiny.json
"$program" fold tiny.json > words && grep -q '^strokes of 16 of 16 diagonals are below 0.01 mm: ' words || fail "strokes in words: $(head -4 words)"
"$program" fold "$table1" > words && ! grep -q '^strokes' words || fail "strokes of table1 in words"
card 6 "$table1" --from 150 --json > card.json && least=$(line least_stroke_mm found)
card 6 tiny.json --from 150 --json > card.json
[ "$(field card.json passed) of $(field card.json asked)" = "4 of 6" ] && [ "$(line least_stroke_mm passes)" = 0 ] || fail "tiny strokes pass"
# Strokes are in proportion to small shifts.
[ "$(sqlite3 :memory: "SELECT $(line least_stroke_mm found) / (0.0001 * $least) BETWEEN 0.8 AND 1.25")" = 1 ] ||
  fail "the least stroke: $(line least_stroke_mm found), of table1 $least"
card 6 tiny.json --from 150 --miscut 0.00001 --json > card.json && [ "$(line least_stroke_mm passes)" = 1 ] || fail "a cutter for them"

# Nothing that is undecided passes: all creases of this sheet close at 180 degrees at once, where its path is lost.
echo '{ "family": "miura", "rows": 10, "columns": 10 }' > ten.json
"$program" construct ten.json --amplitude 1 --rim --output made.json > out.txt || fail "construct 10 x 10"
sqlite3 :memory: "SELECT json_object('pattern', json(readfile('made.json')), 'sampling', json('{\"end_deg\": 180}'))" > lost.json
"$program" verify lost.json --json > verdict.json 2> err
[ "$(field verdict.json verdict.first_fault)" = undecided ] || fail "no example of an undecided sheet: $(field verdict.json verdict)"
card 6 lost.json --from 60 --json > card.json 2> err
[ "$(field card.json passes)" = 0 ] && [ "$(line deploys_from_deg passes)" = 0 ] || fail "an undecided sheet passes"
line deploys_from_deg note | grep -q "^undecided: the path is lost beyond 179" || fail "the note: $(line deploys_from_deg note)"

# Springs in bores: rigid panels, and it says so.
sed 's/"holes"/"springs": { "attach": { "inset_mm": 8 } }, "holes"/' "$table1" > bored.json
card 6 bored.json --from 90 --friction 0.001 > words
grep -q '^pass .*rigid panels' words && grep -q 'need springs on the vertices' words || fail "bores: $(cat words)"

# Files for other programs know no preload, and say so; a construction carries the design.
"$program" export "$source_dir/results/deployment/wing.json" --format mjcf --output never > out.txt 2> err
[ $? = 2 ] && [ ! -s out.txt ] && grep -q "^misalign: design.springs.preload_n = 3: is not known" err && grep -q -- "add --preload 0" err || fail "mjcf: $(cat err)"
"$program" export "$source_dir/results/deployment/wing.json" --format mjcf --preload 0 --output mjcf > names || fail "mjcf without"
"$program" construct "$source_dir/results/deployment/wing.json" --output again.json > /dev/null || fail "construct"
[ "$(field again.json design.springs.preload_n)" = 3.0 ] || fail "the design of a construction"

# refused WORDS ARGUMENT...: by one sentence, nothing written.
refused() {
  local words=$1
  shift
  "$program" card "$@" --output page.html > out.txt 2> err
  [ $? -gt 1 ] && [ ! -s out.txt ] && [ ! -e page.html ] && [ "$(wc -l < err)" = 1 ] && grep -q -- "$words" err ||
    fail "$*: $(cat err)"
}
refused "no DRAW is given" mine.db
refused "is not a number from 0 to" "$table1" --miscut -1
refused "must be below" "$table1" --miscut 30
refused "nowhere.json: there is no such file; check the path" nowhere.json
refused "cannot be opened" "$table1" --material nowhere.json
for bad in '"springs": { "preload_n": -1 }' '"hinges": { "film": { "e_gpa": 2, "length_mm": 1 } }' '"wanted": { "yield": 2 }' '"wanted": { "margin": 2 }'; do
  sed "s|\"holes\"|\"design\": { $bad }, \"holes\"|" "$table1" > bad.json
  refused "bad.json: " bad.json
done
echo '{ "strength_mpa": -3 }' > weak.json
refused "strength_mpa" "$table1" --material weak.json
finish
